"""`dynsolve.grade` and `dynsolve.override`: grading a course from Python.

Which student a teacher means: as in `grades.csv`, or by name, number or address as the roster says.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from fractions import Fraction
from pathlib import Path
from unicodedata import normalize

from msgspec import Struct

from dynsolve.answers.marks import shown
from dynsolve.errors import Finding, InputError, UsageError
from dynsolve.grading.cohort import Entry, queue, standings
from dynsolve.grading.fingerprints import changes
from dynsolve.grading.hand_ins import take_in
from dynsolve.grading.outputs import read_by_hand, write_outputs
from dynsolve.grading.platforms import canvas
from dynsolve.grading.platforms.registry import (
    PLATFORMS,
    Groups,
    chosen_roster,
    export,
    keep_names,
    keep_platform,
    late,
    names,
    people,
)
from dynsolve.grading.pool import Bounds, ClusterPool, LocalPool
from dynsolve.grading.record import FILE, Record, Waiting
from dynsolve.grading.run import Pool, grade_all, keep_keys
from dynsolve.grading.set_file import ProblemSet, load_set, store_set, stored_set, with_variants
from dynsolve.grading.uploads import Refused, Uploads, write_copies
from dynsolve.problem.kinds import did_you_mean

# Which student a teacher means

_MOST = 10


def meant_student(record: Record, said: str) -> str:
    """The student who is called so, by a whole name and as the only one.

    Raises UsageError with those who may be meant.
    """
    known = record.students()
    if said in known:
        return said
    called, words = names(record), _words(said)
    whole = [s for s, name in called.items() if _words(name) == words]
    listed = [person for person in people(record) if person.is_called(said)]
    whole += [s for s, id in known.items() for p in listed if s == p.student or (id and id == p.id)]
    found = list(dict.fromkeys(whole))
    if len(found) == 1:
        return found[0]
    if found:
        raise UsageError(f"{len(found)} students are called `{said}`: name one as {_listed(found, called)}")
    near = [s for s in known if words and set(words) <= set(_words(f"{s} {called.get(s, '')}"))]
    help = (
        f"did you mean {_listed(near, called)}?" if near else did_you_mean(said, (*known, *called.values()))
    )
    raise UsageError(f"there is no student `{said}` in grades.csv" + (f"; {help}" if help else ""))


def _listed(students: list[str], called: dict[str, str]) -> str:
    more = f" or {len(students) - _MOST} others" if len(students) > _MOST else ""
    names = ((student, called.get(student, "")) for student in students[:_MOST])
    named = [f"`{s}` ({name})" if name and name not in s else f"`{s}`" for s, name in names]
    return " or ".join(named) + more


def _words(name: str) -> list[str]:
    """The words of a name in no order: Lovelace, Ada is Ada Lovelace."""
    return sorted(re.findall(r"[^\W_]+", normalize("NFC", name).casefold()))


class Grades(Struct, frozen=True):
    """What a run has come to.

    `totals` are the marks of each student, `hand_ins` how many hand-ins there are,
    `computed` how many of them had to be judged, and `remarked` how many had only to be
    marked anew; the others stood in the record.  `waiting` are the files that no program can
    judge, `queue` is all that waits for a human, `refused` are the files that were not taken.
    `changes` are lines on whose marks are not those of the last run, where they were asked
    for, and `warnings` lines on the platform's file.
    """

    folder: Path
    totals: dict[str, Fraction]
    hand_ins: int
    computed: int
    remarked: int
    waiting: tuple[Waiting, ...]
    refused: tuple[Refused, ...]
    changes: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()
    queue: tuple[Entry, ...] = ()


def grade(
    problems: str | os.PathLike[str],
    submissions: str | os.PathLike[str],
    output: str | os.PathLike[str],
    *,
    lms: str | None = None,
    roster: str | os.PathLike[str] | None = None,
    diff: bool = False,
    jobs: int = 0,
    cluster: str = "",
    timeout: float = 20.0,
    memory: int = 1024,
    variants: str | os.PathLike[str] | None = None,
    progress: Callable[[int, int], None] | None = None,
    warn: Callable[[str], None] | None = None,
) -> Grades:
    r"""Grade everything that was handed in, and write the folder `output`.

    `problems` is a path of a problem file or of a folder of them, or the stem of a
    bundled problem; `submissions` a folder or a zip.  With `lms` ("canvas", "moodle" or
    "gradescope") and its `roster` the file that the platform imports is written too,
    and from then on by every run and override.
    `variants` is the folder that `vary` wrote: each student is graded by his own variant.
    `jobs` processes (0: one a core) of this machine do the work, or those of the Dask
    scheduler `cluster`; each hand-in may take `timeout` seconds and `memory` MiB.
    `progress` is told how many are done, and of how many; `warn` what is to be known before.
    Called again, after a stop or a change, it computes only what is not in the record.

    Raises ProblemError for a faulty problem or `set.yaml`, InputError for hand-ins or a
    roster that cannot be read, UsageError where `output` cannot be written or is in use.

    >>> import tempfile
    >>> temporary = tempfile.TemporaryDirectory()
    >>> folder = Path(temporary.name)
    >>> (folder / "in").mkdir()
    >>> _ = (folder / "in" / "anna.yaml").write_text("answers:\n  D: [[I1zz + m2*L2^2, 0], [0, m2]]\n")
    >>> grades = grade("in3140-rp", folder / "in", folder / "out", jobs=1)
    >>> grades.totals, grades.computed
    ({'anna': Fraction(1, 1)}, 1)
    >>> grade("in3140-rp", folder / "in", folder / "out").computed
    0
    >>> override(folder / "out", "anna", "in3140-rp", "tau", marks="1/2", why="correct on paper")
    >>> grade("in3140-rp", folder / "in", folder / "out").totals
    {'anna': Fraction(3, 2)}
    >>> temporary.cleanup()
    """
    folder = Path(output)
    if folder.resolve() == Path(submissions).resolve():
        raise UsageError(f"{folder} is the folder of the hand-ins: give another one for the results")
    if roster is not None and not lms:
        raise UsageError(f"--roster needs --lms, the platform that it is of: {', '.join(PLATFORMS)}")
    chosen = load_set(os.fspath(problems))
    listed = chosen_roster(chosen, lms, Path(roster) if roster is not None else None) if lms else None
    with closing(Uploads(Path(submissions), besides=folder)) as uploads, _opened(folder) as record:
        if lms and listed:
            keep_platform(record, lms, listed)
        bounds = Bounds(timeout, memory << 20)
        made: Pool = (
            ClusterPool(cluster, bounds) if cluster else LocalPool(jobs or os.cpu_count() or 1, bounds)
        )
        with closing(made) as pool:
            delays = late(record)
            unknown = _late_unknown(chosen, uploads, delays)
            if unknown and warn is not None:
                warn(unknown)
            intake = take_in(chosen, uploads, delays, Groups(chosen.groups, people(record)))
            keep_names(record, intake.names)
            store_set(record, chosen)
            own = with_variants(chosen, Path(variants), intake.students) if variants is not None else chosen
            done = grade_all(own, uploads, intake, record, pool, progress)
            waiting = {entry.problem for entry in queue(record, chosen.stems)}
            if variants is None:  # else each student has another key
                keep_keys(record, chosen, waiting.intersection(chosen.stems), pool)
        write_copies(folder, uploads, intake.files)
        waits = write_outputs(folder, chosen, record, names(record))
        warnings = (*export(folder, chosen, record), *filter(None, (unknown,)))
        changed = tuple(changes(record, chosen.policy)) if diff else ()
        record.finish(chosen.policy)
        totals = {standing.student: standing.total for standing in standings(record)}
    return Grades(
        folder,
        totals,
        done.hand_ins,
        done.computed,
        done.rescored,
        intake.waiting,
        tuple(uploads.refused),
        changed,
        warnings,
        waits,
    )


def _late_unknown(problems: ProblemSet, uploads: Uploads, delays: dict[str, int] | None) -> str:
    """What is said where lateness costs marks and nothing tells who was late."""
    if not problems.policy.penalizes_lateness or delays is not None:
        return ""
    if any(canvas.owner((upload.path.name,)) is not None for upload in uploads.files):
        return ""  # Canvas writes LATE into the names
    said = "the policy takes marks for being late, and nothing says who was late: nobody loses any"
    return f"{said}; give the platform's list with --lms and --roster"


def override(
    output: str | os.PathLike[str],
    student: str,
    problem: str,
    answer: str,
    *,
    marks: str | int | float | Fraction | None = None,
    why: str,
) -> None:
    """Set the marks of one answer by hand; no later run changes them.

    The names are those of `answers.csv`, for the student also a full name as the roster has it;
    `marks` is a number or a text such as "5/2", None for a comment that changes no marks; `why`
    is what the student reads.

    Raises UsageError for an answer that is not in the record, or marks that it cannot have.
    """
    with _overriding(Path(output)) as record:
        _override(record, student, problem, answer, "" if marks is None else str(marks), why)


def override_all(output: str | os.PathLike[str], marks: str | os.PathLike[str]) -> int:
    """Set the marks of a CSV with the columns student, problem, answer, marks, comment; how many.

    Raises InputError with every row that cannot be; nothing is changed then.
    """
    rows, findings = list(read_by_hand(Path(marks))), []
    with _overriding(Path(output)) as record:
        record.db.execute("BEGIN")
        for row in rows:
            try:
                why = row.comment or "marked by hand"
                _override(record, row.student, row.problem, row.answer, row.marks, why)
            except UsageError as error:
                findings.append(Finding(str(error), "", os.fspath(marks), row.line, 1))
        record.db.execute("ROLLBACK" if findings else "COMMIT")
        if findings:
            raise InputError(findings)
    return len(rows)


@contextmanager
def _overriding(folder: Path) -> Iterator[Record]:
    """The record of a folder, whose files are written anew."""
    if not (folder / FILE).is_file():
        raise UsageError(f"there is no {FILE} in {folder}: `dynsolve grade` makes it")
    with _opened(folder) as record:
        problems = stored_set(record)
        yield record
        write_outputs(folder, problems, record, names(record))
        export(folder, problems, record)


def _override(record: Record, student: str, problem: str, answer: str, marks: str, why: str) -> None:
    student = meant_student(record, student)
    points = _points(record, student, problem, answer, marks or "0")
    if not why.strip():
        raise UsageError("the reason says nothing: the student reads it")
    record.override(student, problem, answer, str(points) if marks else "", " ".join(why.split()))


def _points(record: Record, student: str, problem: str, answer: str, marks: str) -> Fraction:
    found = {(a.problem, a.answer): a for a in record.answers(student)}
    if (problem, answer) not in found:
        known = ", ".join(f"{p} {a}" for p, a in found)
        raise UsageError(f"{student} has no answer `{answer}` to `{problem}`; there are {known}")
    try:
        points = Fraction(marks)
    except (ValueError, ZeroDivisionError):
        raise UsageError(f"`{marks}` is no number of marks: write 3, 2.5 or 5/2") from None
    of = Fraction(found[problem, answer].of)
    if not 0 <= points <= of:
        raise UsageError(f"{answer} has {shown(of)} marks: give it from 0 to {shown(of)}")
    return points


@contextmanager
def _opened(folder: Path) -> Iterator[Record]:
    """The record of a folder; a full disk and the like become a message that says how to go on."""
    import sqlite3

    if folder.exists() and not folder.is_dir():
        raise UsageError(f"{folder} is a file; name a folder for the results")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        record = Record(folder)
        try:
            yield record
        finally:
            record.close()
    except (sqlite3.Error, OSError) as error:
        said = getattr(error, "strerror", None) or str(error)
        file = getattr(error, "filename", None)
        what = f"writing to {folder} failed: {said.lower()}" + (f" ({file})" if file else "")
        raise UsageError(f"{what}; what is done is kept, and the same command goes on") from error
