"""Groups: what a group handed in counts for each of its members, in `groups.csv` beside the `set.yaml`.

    group,student
    Group A,41
    Group A,ada@uni.example

A group is called as its files are; a student as in `grades.csv`, or as the platform's list says:
by number, name or address.  `platforms.members` has whose the files are.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from dynsolve.grading.listed import Fault, read_list

FILE = "groups.csv"
_KEYS = ("group", "student")


@dataclass(frozen=True, slots=True)
class Membership:
    """A student of a group."""

    group: str
    student: str


def read_groups(folder: Path) -> tuple[Membership, ...]:
    """The members that a folder's `groups.csv` names; raises ProblemError for a faulty one."""
    return read_list(folder / FILE, _KEYS, _KEYS, _membership)


def _membership(cells: dict[str, str]) -> Membership | Fault:
    if not (cells["group"] and cells["student"]):
        return "a row names a group and a student", "write Group A,41"
    return Membership(cells["group"], cells["student"])
