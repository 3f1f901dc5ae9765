"""Which student a teacher means: as in `grades.csv`, or by name, number or address as the roster says."""

from __future__ import annotations

import re
from collections.abc import Iterator
from unicodedata import normalize

from dynsolve.errors import UsageError
from dynsolve.grading.platforms.registry import names, people
from dynsolve.grading.record import Record
from dynsolve.problem.fields import did_you_mean

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
    return " or ".join(_with_names(students[:_MOST], called)) + more


def _with_names(students: list[str], called: dict[str, str]) -> Iterator[str]:
    for student in students:
        name = called.get(student, "")
        yield f"`{student}` ({name})" if name and name not in student else f"`{student}`"


def _words(name: str) -> list[str]:
    """The words of a name in no order: Lovelace, Ada is Ada Lovelace."""
    return sorted(re.findall(r"[^\W_]+", normalize("NFC", name).casefold()))
