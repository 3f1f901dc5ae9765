"""Drawings of the steps of inverse kinematics: what their names say of each other holds where the arm is."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from random import Random

import pytest

import dynsolve
from dynsolve.document.figures import Figure, LineKind
from dynsolve.notation.tree import Node
from dynsolve.notation.tree_values import evaluate
from dynsolve.render.files import Format
from dynsolve.solution.reports import report

ELBOW = (
    "dh: [{theta: q1*, d: L1, alpha: 90deg}, {theta: q2*, a: L2}, {theta: q3*, a: L3}]\nreach: [px, py, pz]"
)
OFFSET = """
dh: [{theta: q1*, alpha: 90deg}, {theta: q2*, a: a2}, {theta: q3*, d: d3, a: a3, alpha: -90deg}, {d: d4}]
reach: [px, py, pz]"""
ARTICULATED = """
dh: [{theta: q1*, d: L1, alpha: 90deg}, {theta: q2*, a: L2}, {theta: q3*, alpha: 90deg}, {d: L4}]
reach: [px, py, pz]"""
PLANAR = "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\nreach: [px, py]"

# (the problem, the step, whether it is the triangle of the law of cosines)
STEPS = [
    (ELBOW, "q1", False),
    (ELBOW, "q3", True),
    (ELBOW, "q2", False),
    (OFFSET, "q1", False),
    (OFFSET, "q3", True),
    (ARTICULATED, "q3", True),
    (PLANAR, "q2", True),
    (PLANAR, "q1", False),
]


def solved(problem: str) -> dynsolve.Solution:
    return dynsolve.solve(f"{problem}\ngravity: none\nfind: [r, inverse]\n")


def figure(solution: dynsolve.Solution, coordinate: str) -> Figure:
    (found,) = (step.figure for step in solution.explain(["inverse"]) if step.id == f"inverse_{coordinate}")
    assert found is not None
    return found


def states(solution: dynsolve.Solution) -> Iterator[dict[str, float]]:
    """Configurations with what they reach; angles at which the lengths drawn are positive."""
    random = Random(3)
    results = solution.to_json()["results"]
    for _ in range(4):
        values = {name: random.uniform(0.5, 1.5) for name in solution.robot.parameters}
        values |= {q.name: random.uniform(0.1, 0.5) for q in solution.robot.coordinates}
        known = {"sin": math.sin, "cos": math.cos, **values}
        reached = [eval(entry, known) for entry in results["r"]]  # noqa: S307 - results of our own
        yield {**values, **dict(zip(solution.robot.questions.reached, reached, strict=True))}


def value(name: Node | None, at: Mapping[str, float]) -> float:
    assert name is not None
    return evaluate(name, at)


@pytest.mark.parametrize(("problem", "coordinate", "is_triangle"), STEPS)
def test_the_names_of_a_drawing_fit_its_geometry(problem: str, coordinate: str, is_triangle: bool) -> None:
    solution = solved(problem)
    shown = figure(solution, coordinate)
    lengths = [line for line in shown.lines if line.kind is LineKind.LENGTH]
    (angle,) = shown.angles
    for at in states(solution):
        if is_triangle:
            a, b = (value(line.name, at) for line in lengths)
            (c,) = (value(line.name, at) for line in shown.lines if line.kind is LineKind.HELP and line.name)
            assert c * c == pytest.approx(a * a + b * b + 2 * a * b * math.cos(value(angle.name, at)))
            continue
        x, y = (value(line.name, at) for line in shown.lines if line.kind is LineKind.HELP and line.name)
        q = value(angle.name, at)
        along, across = x * math.cos(q) + y * math.sin(q), y * math.cos(q) - x * math.sin(q)
        told = [line for line in lengths if line.name]
        drawn_across = lengths[1:2]
        for line in told:
            expected = abs(across) if line in drawn_across else along
            assert value(line.name, at) == pytest.approx(expected)
        if not drawn_across:
            assert across == pytest.approx(0)


def test_drawings_stand_where_there_can_be_any() -> None:
    solution = solved(ELBOW)
    html = report(solution, Format.HTML, stages=["inverse"]).decode()
    normal = html.partition('<article class="normal">')[2].partition("</article>")[0]
    assert normal.count("<figure>") == 3
    assert report(solution, Format.LATEX, stages=["inverse"]).decode().count(r"\begin{picture}") == 3
    assert "not to scale" not in report(solution, Format.MARKDOWN, stages=["inverse"]).decode()
