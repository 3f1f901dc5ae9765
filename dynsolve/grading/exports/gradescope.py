"""Gradescope: `results.json` of each submission, as an autograder writes it."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from dynsolve.grading.exports.roster import Roster
from dynsolve.grading.output_paths import folder_name, remove_others
from dynsolve.grading.policy import points
from dynsolve.grading.problem_set import ProblemSet
from dynsolve.grading.record import Record
from dynsolve.grading.totals import Standing, standings
from dynsolve.render.files import write_changed

_ID, _LATENESS = "Submission ID", "Lateness (H:M:S)"


def write(folder: Path, problems: ProblemSet, record: Record, roster: Roster) -> Iterator[str]:
    """Write `gradescope/<submission>/results.json`; a group's members share theirs."""
    told: dict[Path, tuple[str, bytes]] = {}
    for standing in standings(record):
        path = folder / "gradescope" / folder_name(standing.id or standing.student) / "results.json"
        text = json.dumps(_results(standing, record, problems), indent=1, ensure_ascii=False) + "\n"
        data = text.encode("utf-8", errors="replace")
        first, before = told.setdefault(path, (standing.student, data))
        if before != data:
            yield f"{standing.student} and {first} share {path.parent.name}, and their marks differ"
        write_changed(path, told[path][1], durable=False)
    remove_others(folder / "gradescope", set(told), (".json",))


def late(roster: Roster) -> frozenset[str]:
    """The submissions whose lateness in the list of grades is not 00:00:00."""
    if not {_ID, _LATENESS} <= set(roster.header):
        return frozenset()
    id, lateness = roster.header.index(_ID), roster.header.index(_LATENESS)
    rows = (row for row in roster.rows[1:] if len(row) > max(id, lateness))
    return frozenset(f"submission_{row[id].strip()}" for row in rows if re.search("[1-9]", row[lateness]))


def _results(standing: Standing, record: Record, problems: ProblemSet) -> dict[str, Any]:
    alone = len(problems.items) == 1
    numbers = dict.fromkeys(problems.stems, 0)
    tests = []
    for answer in record.answers(standing.student):
        if answer.of == "0":
            continue
        numbers[answer.problem] += 1
        tests.append(
            {
                "score": float(points(answer.marks)),
                "max_score": float(points(answer.of)),
                "status": "passed" if answer.verdict in ("correct", "follows") else "failed",
                "name": answer.answer if alone else f"{answer.problem}: {answer.answer}",
                "number": f"{problems.stems.index(answer.problem) + 1}.{numbers[answer.problem]}",
                "output": answer.why,
                "output_format": "text",
                "visibility": "visible",
            }
        )
    return {
        "score": float(standing.total),
        "visibility": "visible",
        "stdout_visibility": "hidden",
        "tests": tests,
    }
