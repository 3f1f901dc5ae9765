"""Hand-ins made by hand: answers in plain text, judged without reading a file."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

from dynsolve.answers.judge import Checker
from dynsolve.answers.verdict import Answer, JudgedAnswer, Place, Report, Submission
from dynsolve.derivation.graph import Derivation
from dynsolve.derivation.rules import derive
from dynsolve.notation import tree
from dynsolve.notation.text import read
from dynsolve.notation.tree import Node
from dynsolve.problem import Problem, read_problem
from dynsolve.solution.solution import load

Text = str | list[list[str]]


def node(text: Text) -> Node:
    """A scalar, or a matrix of scalars, in plain text."""
    if isinstance(text, list):
        return tree.Matrix(tuple(tuple(read(entry, dots=True).tree for entry in row) for row in text))
    return read(text, dots=True).tree


def answer(name: str, text: Text, chain: int = 0, member: int = 0) -> Answer:
    """One answer, as if it stood on line chain + 1."""
    return Answer(
        name, f"({chain + 1})", node(text), Place(chain + 1, 1), str(text), occurrence=(chain, member)
    )


def submission(answers: Mapping[str, Text]) -> Submission:
    """A hand-in with these answers, in this order."""
    return Submission(
        "",
        "s1",
        "answers.yaml",
        tuple(answer(name, text, i) for i, (name, text) in enumerate(answers.items())),
    )


@lru_cache(maxsize=32)
def problem(stem: str) -> Problem:
    """A bundled problem, or the text of one."""
    return read_problem(stem, "own.yaml") if "\n" in stem else load(stem)


@lru_cache(maxsize=32)
def key(stem: str) -> Derivation:
    """Its key."""
    return derive(problem(stem).robot)


@lru_cache(maxsize=32)
def checker(stem: str) -> Checker:
    """Judges hand-ins to it."""
    return Checker(problem(stem), key(stem))


def judge(stem: str, answers: Mapping[str, Text]) -> Report:
    """The report on a hand-in."""
    return checker(stem)(submission(answers))


def judged(stem: str, name: str, text: Text, **beside: Text) -> JudgedAnswer:
    """What is said of one answer, with others beside it."""
    report = judge(stem, {**beside, name: text})
    return next(a for a in report.answers if a.name == name)


def verdicts(report: Report) -> dict[str, str]:
    """The verdicts by name."""
    return {a.name: str(a.verdict) for a in report.answers}


def codes(answer: JudgedAnswer) -> list[str]:
    """The codes of an answer's diagnosis."""
    return [d.code for d in answer.diagnosis]
