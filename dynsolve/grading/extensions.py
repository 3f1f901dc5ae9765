"""Extensions: who was given more days, in `extensions.csv` beside the `set.yaml`.

    student,days,problem
    lovelaceada_101,3,
    102,7,planar-2r

A student is named as in `grades.csv`, or by the platform's number, or by the name before it;
without a problem the days hold for all of them.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass
from pathlib import Path

from dynsolve.grading.listed import Fault, read_list
from dynsolve.problem.fields import did_you_mean

FILE = "extensions.csv"
_KEYS = ("student", "days", "problem")


@dataclass(frozen=True, slots=True)
class Extension:
    """So many days more for a student, for one problem or (an empty name) for all."""

    student: str
    days: int
    problem: str = ""

    def is_for(self, student: str, id: str) -> bool:
        """Whether it is this student's.

        >>> [Extension(name, 1).is_for("Ada L_7", "7") for name in ("Ada L_7", "7", "Ada L", "Ada")]
        [True, True, True, False]
        """
        return self.student in (student, id, student.removesuffix(f"_{id}") if id else student)


def read_extensions(folder: Path, stems: Collection[str]) -> tuple[Extension, ...]:
    """The extensions of a folder, none where it has no such file; raises ProblemError for a faulty one."""

    def read(cells: dict[str, str]) -> Extension | Fault:
        fault = _fault(cells, stems)
        return fault or Extension(cells["student"], int(cells["days"]), cells["problem"])

    return read_list(folder / FILE, _KEYS, ("student", "days"), read)


def _fault(cells: dict[str, str], stems: Collection[str]) -> Fault | None:
    if not cells["student"]:
        return "no student is named", "write the name as in grades.csv"
    if not (cells["days"].isascii() and cells["days"].isdigit() and len(cells["days"]) < 5):
        return f"`{cells['days'][:40]}` is no number of days", "write 1, 2, 3, ..."
    if cells["problem"] and cells["problem"] not in stems:
        help = did_you_mean(cells["problem"], stems) or f"the problems are {', '.join(stems)}"
        return f"there is no problem `{cells['problem'][:40]}`", help
    return None


def days_late(extensions: Iterable[Extension], student: str, id: str, problem: str, days: int) -> int:
    """How many days late a hand-in is that is so many days after the date for all."""
    given = [e.days for e in extensions if e.problem in ("", problem) and e.is_for(student, id)]
    return max(0, days - max(given, default=0))
