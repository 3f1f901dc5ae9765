"""The problem set in the record: what an override needs to write the reports anew."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import PurePath

from dynsolve.errors import UsageError
from dynsolve.grading.policy import from_data, to_data
from dynsolve.grading.problem_set import Item, ProblemSet
from dynsolve.grading.record import Record
from dynsolve.problem.reader import read_problem

_NAME = "set"


def store_set(record: Record, problems: ProblemSet) -> None:
    """Keep a problem set, without where its files lie."""
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
