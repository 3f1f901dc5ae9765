"""Gradescope: whose each submission is, and its `results.json`, as an autograder writes it.

Whose file it is, as a platform's name of it says, and who there is, as its list of students says.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from fractions import Fraction
from pathlib import Path, PurePosixPath
from typing import Any

from msgspec import Struct

from dynsolve.answers.marks import points
from dynsolve.grading.cohort import Standing, standings
from dynsolve.grading.files import folder_name, remove_others
from dynsolve.grading.platforms.roster import Roster, not_judged
from dynsolve.grading.record import Record
from dynsolve.grading.set_file import ProblemSet
from dynsolve.grading.uploads import printable
from dynsolve.render.files import write_changed

# Whose file it is, as a platform's name of it says, and who there is, as its list of students says


class FileOwner(Struct, frozen=True):
    """Whose file it is: `student` names the row, `id` is the platform's own, empty where there is none.

    `delivery` is what was handed in at once: its files belong together, another delivery
    of the same student is another copy.  `late` are the
    days that it is late, begun ones counted.  `order` grows with the delivery; `name` is the
    file's own name.  A loose file's name is not `certain` to be a student's: what stands
    in the file wins.  `group` is whose it is in the names of the files where a group handed it in.
    `called` is what people call the student, where the platform's name says it.
    """

    student: str
    id: str
    delivery: str
    name: str
    late: int = 0
    order: int = 0
    certain: bool = True
    group: str = ""
    called: str = ""


class Person(Struct, frozen=True):
    """A student of a platform's list: `student` as the names of the files have it, the platform's `id`.

    `name` is what people call the student, `group` the group that the list puts them in; `also`
    are other things that the list says of this student alone, such as an address.
    """

    student: str
    id: str
    name: str
    group: str = ""
    also: tuple[str, ...] = ()

    def is_called(self, said: str) -> bool:
        """Whether this is what the student is called.

        >>> person = Person("Ada Lovelace_41", "41", "Ada Lovelace", also=("ada@uni.example",))
        >>> [person.is_called(said) for said in ("41", "Ada Lovelace", "ada@uni.example", "Ada", "")]
        [True, True, True, False, False]
        """
        return bool(said) and said in (self.student, self.id, self.name, *self.also)


METADATA = "submission_metadata.yml"

Submitters = dict[str, tuple[dict[str, str], ...]]
"""Of each submission of Gradescope who handed it in: `:name`, `:sid`, `:email`."""

_SUBMITTERS = ":submitters"
_DEEPEST = 100

_EXPORT, _SUBMISSION = re.compile(r"assignment_\d+_export"), re.compile(r"submission_\d+")

_ID, _LATENESS = "Submission ID", "Lateness (H:M:S)"


def owners(export: tuple[str, ...], path: PurePosixPath, submitters: Submitters) -> tuple[FileOwner, ...]:
    """Who handed in a file of an export: the members of a group each; nobody for its other files."""
    rest = path.parts[len(export) :]
    if path.parts[: len(export)] != export or not rest:
        return ()
    if len(rest) > 1 and (_SUBMISSION.fullmatch(rest[0]) or rest[0] in submitters):
        return _of_submission(rest[0], "/".join(rest[1:]), submitters)
    return _of_submission(rest[0], rest[0], submitters) if rest[0] in submitters else ()


def _of_submission(submission: str, name: str, submitters: Submitters) -> tuple[FileOwner, ...]:
    id = PurePosixPath(submission).stem
    number = id.removeprefix("submission_")
    order = int(number[:18]) if number.isdigit() else 0
    who = ((_submitter(one, id), printable(one.get(":name", ""))) for one in submitters.get(submission, ()))
    return tuple(FileOwner(s, id, id, name, order=order, called=called) for s, called in who if s) or (
        FileOwner(id, id, id, name, order=order),
    )


def _submitter(one: Mapping[str, str], id: str) -> str:
    """What a student is called: by a number or an address; a name alone may be another's too."""
    known = [one.get(key, "").strip() for key in (":sid", ":email")]
    name = one.get(":name", "").strip()
    return printable(next(filter(None, known), f"{name} ({id})" if name else ""))


def exports(files: Iterable[PurePosixPath]) -> tuple[tuple[str, ...], ...]:
    """The folders that hold an export of Gradescope: `assignment_<id>_export`, or all that there is."""
    files = list(files)
    tops = {path.parts[0] for path in files}
    found: set[tuple[str, ...]] = {(top,) for top in tops if _EXPORT.fullmatch(top)}
    if any(_SUBMISSION.fullmatch(top) for top in tops) or PurePosixPath(METADATA) in files:
        found.add(())
    if len(tops) == 1 and any(_is_of_gradescope(path.parts[1:]) for path in files):
        found.add((files[0].parts[0],))
    return tuple(sorted(found, reverse=True))


def _is_of_gradescope(parts: tuple[str, ...]) -> bool:
    return parts == (METADATA,) or (len(parts) > 1 and bool(_SUBMISSION.fullmatch(parts[0])))


def read_metadata(content: bytes) -> Submitters:
    r"""Gradescope's list of whose each submission is, as far as it can be read.

    It is read event by event: nothing is constructed, expanded or nested.

    >>> read_metadata(b"submission_1:\n  :submitters:\n  - :name: A\n    :sid: '007'\n  :score: 2\n")
    {'submission_1': ({':name': 'A', ':sid': '007'},)}
    """
    import yaml

    found: dict[str, list[dict[str, str]]] = {}
    open_: list[_OpenCollection] = []
    loader: Any = getattr(yaml, "CBaseLoader", yaml.BaseLoader)
    with suppress(yaml.YAMLError, ValueError):
        for event in yaml.parse(content, Loader=loader):
            if len(open_) > _DEEPEST:
                break
            if isinstance(event, yaml.CollectionStartEvent):
                if _kinds(open_) == "mms" and open_[1].key == _SUBMITTERS:
                    found.setdefault(open_[0].key or "", []).append({})
                open_.append(_OpenCollection("m" if isinstance(event, yaml.MappingStartEvent) else "s"))
            elif isinstance(event, yaml.CollectionEndEvent):
                open_.pop()
                if open_:
                    open_[-1].key = "" if open_[-1].key is None else None  # a key, or what stands at one
            elif isinstance(event, yaml.NodeEvent) and open_:
                _scalar(found, open_, event.value if isinstance(event, yaml.ScalarEvent) else "")
    return {submission: tuple(submitters) for submission, submitters in found.items()}


class _OpenCollection(Struct):
    """A collection that is being read: a mapping (m) with the key it is at, or a sequence (s)."""

    kind: str
    key: str | None = None


def _kinds(open_: list[_OpenCollection]) -> str:
    return "".join(one.kind for one in open_[:5])


def _scalar(found: dict[str, list[dict[str, str]]], open_: list[_OpenCollection], value: str) -> None:
    """A key of a mapping, or what stands at one."""
    last = open_[-1]
    if last.kind == "s":
        return
    if last.key is None:
        last.key = value
        return
    if _kinds(open_) == "mmsm" and open_[1].key == _SUBMITTERS:
        found[open_[0].key or ""][-1][last.key] = value
    last.key = None


# -- what Gradescope imports -----------------------------------------------------------------------


def write(folder: Path, problems: ProblemSet, record: Record, roster: Roster) -> Iterator[str]:
    """Write `gradescope/<submission>/results.json`; a group's members share theirs."""
    told: dict[Path, tuple[str, list[float]]] = {}
    all_of = list(standings(record))
    for standing in all_of:
        if len(standing.unjudged) == len(problems.items):
            continue  # nothing of it was judged, and nothing is no zero
        path = folder / "gradescope" / folder_name(standing.id or standing.student) / "results.json"
        results = _results(folder, standing, record, problems)
        scores = [test["score"] for test in results["tests"]]
        first, before = told.setdefault(path, (standing.student, scores))
        if before != scores:
            yield f"{standing.student} and {first} share {path.parent.name}, and their marks differ"
        if first == standing.student:
            text = json.dumps(results, indent=1, ensure_ascii=False) + "\n"
            write_changed(path, text.encode("utf-8", errors="replace"), durable=False)
    remove_others(folder / "gradescope", set(told), (".json",))
    yield from not_judged(all_of)


def people(roster: Roster) -> Iterator[Person]:
    """The students of the list of grades, each called by number, else by address, as in the export."""
    header = roster.header
    if not {"SID", "Email"} <= set(header):
        return
    names = [place for place, name in enumerate(header) if name in ("Name", "First Name", "Last Name")]
    for row in roster.rows[1:]:
        cells = dict(zip(header, row, strict=False))
        sid, email = cells.get("SID", "").strip(), cells.get("Email", "").strip()
        name = " ".join(row[place].strip() for place in names if row[place:])
        if sid or email:
            yield Person(sid or email, "", name, also=(email,))


def late(roster: Roster) -> dict[str, int] | None:
    """The days that submissions are late by the list of grades, None where that does not say it."""
    if not {_ID, _LATENESS} <= set(roster.header):
        return None
    id, lateness = roster.header.index(_ID), roster.header.index(_LATENESS)
    rows = (row for row in roster.rows[1:] if len(row) > max(id, lateness))
    return {f"submission_{row[id].strip()}": _days(row[lateness]) for row in rows if _days(row[lateness])}


def _days(lateness: str) -> int:
    """The days, begun ones counted.

    >>> _days("00:00:00"), _days("00:00:01"), _days("24:00:00"), _days("48:00:10")
    (0, 1, 1, 3)
    """
    found = re.fullmatch(r"\s*(\d+):(\d+):(\d+)\s*", lateness)
    hours, minutes, seconds = map(int, found.groups()) if found else (0, 0, 0)
    return -(-(hours * 3600 + minutes * 60 + seconds) // 86400)


def _results(folder: Path, standing: Standing, record: Record, problems: ProblemSet) -> dict[str, Any]:
    alone = len(problems.items) == 1
    numbers = dict.fromkeys(problems.stems, 0)
    answers = [a for a in record.answers(standing.student) if a.of != "0"]
    told = [
        (a.problem, a.answer, points(a.marks), points(a.of), a.verdict in ("correct", "follows"), a.why)
        for a in answers
    ]
    told += [
        (problem, line.name, line.marks, Fraction(0), False, line.why)
        for problem, line in standing.late.items()
    ]
    tests = []
    for problem, name, marks, of, passed, why in told:
        numbers[problem] += 1
        tests.append(
            {
                "score": float(marks),
                "max_score": float(of),
                "status": "passed" if passed else "failed",
                "name": name if alone else f"{problem}: {name}",
                "number": f"{problems.stems.index(problem) + 1}.{numbers[problem]}",
                "output": why,
                "output_format": "text",
                "visibility": "visible",
            }
        )
    return {
        "score": float(standing.total),
        "output": _pages(folder / "feedback" / folder_name(standing.student), problems),
        "output_format": "md",
        "visibility": "visible",
        "stdout_visibility": "hidden",
        "tests": tests,
    }


def _pages(place: Path, problems: ProblemSet) -> str:
    """What the student gets to read, in Markdown, one problem after the other."""
    paths = (place / f"{stem}.md" for stem in problems.stems)
    return "\n\n".join(path.read_text(encoding="utf-8") for path in paths if path.is_file())
