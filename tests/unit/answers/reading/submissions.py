"""Hand-ins to the problems of the library, read; and answers as they are shown."""

from __future__ import annotations

from functools import cache

from dynsolve.answers.reading.files import read_submission
from dynsolve.answers.verdict import Answer, Submission
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem import Problem, load
from dynsolve.problem.reader import find


@cache
def problem(stem: str) -> Problem:
    return load(find(stem))


def report(text: str, file: str = "report.md", stem: str = "planar-2r") -> Submission:
    return read_submission(problem(stem), text, file)


def named(found: Submission) -> list[tuple[str, str]]:
    return [(answer.name, answer.label) for answer in found.answers]


def shown(answer: Answer) -> str:
    assert answer.node is not None, answer.fault
    return to_unicode(answer.node)


def hand_in(text: str, stem: str = "planar-2r") -> Submission:
    return read_submission(problem(stem), text, "answer.yaml")


def last(found: Submission, name: str) -> Answer:
    return [answer for answer in found.answers if answer.name == name][-1]


def shown_last(found: Submission, name: str) -> str:
    return shown(last(found, name))
