"""Remarks of a problem's author: at which steps they stand, in which words, in every format."""

from __future__ import annotations

import pytest

import dynsolve
from dynsolve.errors import ProblemError
from dynsolve.explain.step import Detail, Step
from dynsolve.problem import read_problem
from dynsolve.render.files import Format
from dynsolve.solution.reports import report

RP = """
dh: [{theta: theta1*, d: L1, alpha: 90deg}, {d: L2*}]
masses: [{mass: m1, link: 1, center: midpoint, inertia: {zz: I1zz}}, {mass: m2, link: 2}]
"""

STEPS = {
    "Kv2": "Kv2",
    "f2": "tau2",  # a force by its own name, the step by that of its rule
    "M": "D",
    "d12": "D",
    "c121": "christoffel",
    "Jw2": "Jv2",  # both are results of one step
    "tau": "tau2",  # no step of its own: the last of its parts
    "DH": "dh",
}
"""The step at which a remark on a result stands."""


def noted(steps: tuple[Step, ...], text: str) -> list[str]:
    """The steps with a note of these words."""
    return [step.id for step in steps if (text,) in step.notes]


@pytest.mark.parametrize("name", STEPS)
def test_a_remark_stands_at_the_step_of_its_result(name: str) -> None:
    solution = dynsolve.solve(read_problem(f"remarks: {{{name}: the squares add up}}{RP}"))
    assert noted(solution.steps, "the squares add up") == [STEPS[name]]


def test_a_remark_is_words_and_may_have_several_lines() -> None:
    text = "remarks: {K: ['1 + 1 =  2, $x$ <b>', second]}" + RP
    solution = dynsolve.solve(read_problem(text))
    (step,) = (step for step in solution.to_json()["steps"] if step["id"] == "K")
    assert step["notes"][-2:] == ["1 + 1 = 2, $x$ <b>", "second"]
    assert "$x$ &lt;b&gt;" in report(solution, Format.HTML).decode()
    assert r"\$x\$ \textless{}b\textgreater{}" in report(solution, Format.LATEX, detail=Detail.FULL).decode()


def test_a_remark_on_what_has_no_step_is_an_error_at_its_place() -> None:
    problem = read_problem("remarks:\n  I_body2: a point has none" + RP)  # body 2 is a point
    with pytest.raises(ProblemError, match="no step of I_body2") as error:
        _ = dynsolve.solve(problem).steps
    assert [(finding.line, finding.column) for finding in error.value.findings] == [(2, 12)]
