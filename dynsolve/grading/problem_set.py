"""What is graded: problems with their marks and a policy, and how the record keeps them."""

from __future__ import annotations

import json
from dataclasses import dataclass, field, replace
from fractions import Fraction
from pathlib import PurePath

from dynsolve.answers.marking.policy import Policy, from_data, to_data
from dynsolve.errors import UsageError
from dynsolve.grading.extensions import Extension
from dynsolve.grading.groups import Membership
from dynsolve.grading.record import Record
from dynsolve.problem.model import Problem
from dynsolve.problem.reader import read_problem


@dataclass(frozen=True, slots=True)
class Item:
    """One problem of a set, with the text it was read from; its `marks` are those that count."""

    problem: Problem
    text: str

    @property
    def stem(self) -> str:
        """The name by which hand-ins refer to it."""
        return self.problem.stem


@dataclass(frozen=True, slots=True)
class ProblemSet:
    """The problems of a course's assignment, in order, and how they are marked."""

    title: str
    items: tuple[Item, ...]
    policy: Policy = field(default_factory=Policy)
    extensions: tuple[Extension, ...] = ()
    groups: tuple[Membership, ...] = ()

    @property
    def stems(self) -> tuple[str, ...]:
        """The problems by the name that hand-ins call them."""
        return tuple(item.stem for item in self.items)

    def item(self, stem: str) -> Item:
        """The problem of this name."""
        return next(item for item in self.items if item.stem == stem)


# -- in the record -----------------------------------------------------------------------------------

_NAME = "set"


def store_set(record: Record, problems: ProblemSet) -> None:
    """Keep a problem set in the record, without the paths of its files."""
    items = [
        {
            "file": PurePath(item.problem.file).name,
            "text": item.text,
            "marks": {name: str(of) for name, of in item.problem.marks.items()},
        }
        for item in problems.items
    ]
    data = {"title": problems.title, "items": items, "policy": to_data(problems.policy)}
    record.set_run(_NAME, json.dumps(data, ensure_ascii=False))


def stored_set(record: Record) -> ProblemSet:
    """The problem set that the record was made with.

    Raises UsageError where there is none yet.
    """
    text = record.run(_NAME)
    if not text:
        raise UsageError("there are no grades in that folder yet: `dynsolve grade` makes them")
    data = json.loads(text)
    items = []
    for entry in data["items"]:
        marks = {name: Fraction(of) for name, of in entry["marks"].items()}
        problem = replace(read_problem(entry["text"], entry["file"]), marks=marks)
        items.append(Item(problem, entry["text"]))
    return ProblemSet(data["title"], tuple(items), from_data(data["policy"]))


def stored_policy(record: Record) -> Policy:
    """The policy that the record was made with."""
    text = record.run(_NAME)
    return from_data(json.loads(text)["policy"]) if text else Policy()
