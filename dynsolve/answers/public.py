"""`dynsolve.check`: judging a hand-in from Python."""

from __future__ import annotations

import os
from pathlib import Path

from dynsolve.answers.judge import Checker
from dynsolve.answers.limits import check_file
from dynsolve.answers.verdict import Report
from dynsolve.problem import Problem, load, read_problem


def check(problem: Problem | str | os.PathLike[str], answer: str | os.PathLike[str]) -> Report:
    r"""Judge a hand-in, within limits of time and memory.

    `problem` is a `Problem`, a path, the stem of a bundled problem, or the text of a
    problem file (with line breaks); `answer` is a path, or the text of an answer file
    (with line breaks).  `report.answers` are the verdicts in the order of the
    derivation, `report.first_wrong` is where it first went wrong;
    `dynsolve.answers.report.to_json` gives what `dynsolve check --json` prints.

    Raises ProblemError for a faulty problem, OSError for a file that cannot be read.
    Nothing that stands in an answer raises.

    >>> report = check("planar-2r", "answers:\n  d22: m2*lc2^2 + I2\n  g2: m2*g*cos(q1 + q2)\n")
    >>> [(a.name, str(a.verdict)) for a in report.answers if a.given]
    [('d22', 'correct'), ('g2', 'wrong')]
    >>> report.answers[-1].diagnosis[0].message
    'In m₂ g c₁₂ the factor l_c2 is left out.'
    """
    text = os.fspath(answer)
    if "\n" in text:
        return check_file(Checker(_problem(problem)), text, "answers.yaml")
    return check_file(Checker(_problem(problem)), Path(text).read_bytes(), text)


def _problem(problem: Problem | str | os.PathLike[str]) -> Problem:
    if isinstance(problem, Problem):
        return problem
    name = os.fspath(problem)
    if "\n" in name:
        return read_problem(name)
    from dynsolve.problem.reader import find

    return load(find(name))
