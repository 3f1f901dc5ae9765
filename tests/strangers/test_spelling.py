"""Results are written as books write them: of drawn mechanisms, and of uniform shapes and constant angles."""

from __future__ import annotations

import pytest

import dynsolve
from dynsolve import Solution
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.errors import InputError
from dynsolve.explain.step import Detail
from dynsolve.notation.tree import Function, walk
from dynsolve.notation.unicode import to_unicode
from dynsolve.quantities.index import quantities
from dynsolve.solution.documents import solution_document
from tests.strangers.generator import stranger, written
from tests.strangers.oracle import relations
from tests.strangers.spelling import misspelled

PLANE = "gravity: [0, -g, 0]\n"
TWO = PLANE + "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\nmasses:\n"
OWN = {
    "hollow cylinders": TWO
    + "  - {mass: m1, link: 1, center: {near: [c1, 0, 0]}, "
    + "shape: {hollow_cylinder: {outer: r, inner: i, length: l1}}}\n"
    + "  - {mass: m2, link: 2, center: {near: [c2, 0, 0]}, "
    + "shape: {hollow_cylinder: {outer: r, inner: r/2, length: l2}}}\n",
    "rods and a load": TWO
    + "  - {mass: m1, link: 1, center: midpoint, shape: {rod: {length: l1}}}\n"
    + "  - {mass: m2, link: 2, center: midpoint, shape: {rod: {length: l2}}}\n"
    + "  - {mass: mp, name: p, link: 2, shape: point, center: tip}\n",
    "rods of one length": PLANE
    + "dh: [{theta: q1*, a: l}, {theta: q2*, a: l}, {theta: q3*, a: l/2}]\nmasses:\n"
    + "  - {mass: m, name: 1, link: 1, center: midpoint, shape: {rod: {length: l}}}\n"
    + "  - {mass: m, name: 2, link: 2, center: midpoint, shape: {rod: {length: l}}}\n"
    + "  - {mass: m/2, name: 3, link: 3, center: midpoint, shape: {rod: {length: l/2}}}\n",
    "a slope": TWO.replace("[0, -g, 0]", "[-g*sin(beta), -g*cos(beta), 0]")
    + "  - {mass: m1, link: 1, center: {near: [lc1, 0, 0]}, inertia: {zz: I1}}\n"
    + "  - {mass: m2, link: 2, center: {near: [lc2, 0, 0]}, inertia: {zz: I2}}\n",
    "a bent link": PLANE
    + "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: phi + beta, a: l3}]\nmasses:\n"
    + "  - {mass: m2, link: 2, center: midpoint, shape: {cylinder: {radius: r, length: l2}}}\n"
    + "  - {mass: m3, link: 3, center: midpoint, shape: {rod: {length: l3}}}\n",
    "lengths in numbers": PLANE
    + "dh: [{theta: q1*, a: 0.5}, {theta: q2*, a: 0.25}]\nmasses:\n"
    + "  - {mass: m1, link: 1, center: midpoint, shape: {rod: {length: 0.5}}}\n"
    + "  - {mass: m2, link: 2, center: midpoint, shape: {cylinder: {radius: 0.05, length: 0.25}}}\n",
    "decimals beside letters": PLANE + "dh: [{theta: q1*, a: l}]\n"
    "masses: [{mass: m, link: 1, center: midpoint}, {mass: 1.5, link: 1}]\n",
    "decimals of a slide": "gravity: none\n"
    "dh: [{d: x*, alpha: -90deg}, {theta: q*, a: 0.1, alpha: 90deg}, {d: s*}]\n"
    "masses: [{mass: m, link: 3, center: origin}]\nsprings: [{energy: 0.15*k*(x - 0.35)^4}]\n",
    "decimals of a model": "model:\n"
    "  coordinates: {r: prismatic, x: prismatic}\n  K: m*r'^2/2 + M*x'^2/2\n"
    "  P: 0.25*k*(r - 0.35)^2 + m*9.81*x + 0.15*c*x^2\n",
    "decimals of three joints": "gravity: none\n"
    "dh: [{theta: q1*, a: 0.35}, {theta: q2*, a: 0.3, alpha: 90deg}, {theta: q3*, a: 0.15}]\n"
    "masses: [{mass: 1.1, link: 3}]\n",
    "angles of 30°": PLANE
    + "dh: [{theta: q1*, a: l1}, {theta: 30deg, d: d2*, alpha: 60deg}, {theta: q3*, a: l3}]\nmasses:\n"
    + "  - {mass: 2*m, link: 2, shape: point}\n"
    + "  - {mass: 3*m, link: 3, center: midpoint, shape: {rod: {length: l3}}}\n",
    "a pendulum": PLANE + "dh: [{theta: q1*, a: l}]\n"
    "masses: [{mass: m, link: 1, center: midpoint, shape: {cylinder: {radius: r, length: l}}}]\n",
    "a slider": "gravity: [0, 0, -g]\ndh: [{d: d1*, alpha: -90deg}, {theta: 90deg, d: d2*}]\n"
    "masses: [{mass: m1, link: 1, shape: point}, {mass: m2, link: 2, shape: point}]\n",
}  # fmt: skip
SEEDS = (201, 217, 233)
CASES = {**OWN, **{f"seed {seed}": written(stranger(seed)) for seed in SEEDS}}


def faults(solution: Solution) -> list[str]:
    """What is misspelled in the results and, of single lines, in the report."""
    robot = solution.robot
    rules = sorted({q.rule for q in quantities(robot).values()} & set(solution.values.rules))
    forms = [solution.forms(name) for name in rules if isinstance(solution.values[name], Expr | Matrix)]
    blocks = solution_document(solution, Detail.NORMAL).blocks
    printed = [relation for _, relation in relations(blocks)]
    lines = [each for each in misspelled(printed) if each[0] in ("a sum of one term", "a power of 1")]
    return [f"{kind}: {to_unicode(node)}" for kind, node in (*misspelled(forms), *lines)]


@pytest.mark.parametrize("case", CASES)
def test_results_are_written_as_books_write_them(case: str) -> None:
    try:
        assert faults(dynsolve.solve(CASES[case])) == []
    except InputError:
        assert case.startswith("seed")


def test_no_angle_is_written_out_beside_shorthands() -> None:
    """c1 is a distance: so there is no c₂ either; nor beside cos φ, which has no index."""
    beside = "dh: [{theta: phi*, a: a}, {theta: q2*, a: b}]\nmasses: [{mass: m, link: 2}]\nfind: [D]\n"
    assert not dynsolve.solve(beside).style.shorthand
    solution = dynsolve.solve(OWN["hollow cylinders"].replace("c2", "h"))
    assert not solution.style.shorthand
    assert any(isinstance(node, Function) for node in walk(solution.forms("D")))
