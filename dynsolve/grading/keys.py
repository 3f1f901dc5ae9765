"""The keys of the problems of which something waits, kept in the record for the page of the queue."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any

from dynsolve.grading.fingerprints import program, short
from dynsolve.grading.problem_set import Item, ProblemSet
from dynsolve.grading.record import Record
from dynsolve.grading.run import Pool, payload_of_problem


def keep_keys(record: Record, problems: ProblemSet, stems: Iterable[str], pool: Pool) -> None:
    """Have the keys of these problems set, as far as the record has not those of today."""
    due = {stem: problems.item(stem) for stem in stems}
    due = {stem: item for stem, item in due.items() if _kept(record, stem).get("of") != _of(item)}
    asked = {stem: pool.submit({**payload_of_problem(item), "key": True}) for stem, item in due.items()}
    for stem, future in asked.items():
        data = {"of": _of(due[stem]), "keys": future.result().get("result", {})}
        record.set_run(f"key {stem}", json.dumps(data))


def kept_keys(record: Record, stem: str) -> dict[str, str]:
    """The keys of a problem's answers, in HTML, as far as they are known."""
    found: dict[str, str] = _kept(record, stem).get("keys", {})
    return found


def _kept(record: Record, stem: str) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(record.run(f"key {stem}") or "{}")
    return found


def _of(item: Item) -> str:
    return short([item.text, sorted(item.problem.marks), program()])
