"""The identities that are named make the trees equal, each angle having a sine and a cosine of its own."""

from __future__ import annotations

import math
from collections.abc import Mapping
from random import Random

import pytest
from hypothesis import given, settings

import dynsolve
from dynsolve.algebra.angles import Angle, angle_from_tree
from dynsolve.algebra.ring import Ring
from dynsolve.algebra.ring_values import build_ring
from dynsolve.algebra.trig_identities import Used, angles_in, used_between
from dynsolve.explain.working import identities
from dynsolve.notation.text import read
from dynsolve.notation.tree import Function, Node, Symbol, mapped, walk
from dynsolve.notation.tree_values import DOTS, evaluate
from tests.robots import robots

Line = tuple[Node, Node, Used]

CASES = {
    # a difference, the sine of which stands in the line before, too
    ("sin(a + b)*cos(a) - cos(a + b)*sin(a) + sin(b)*sin(a)", "sin(b) + sin(b)*sin(a)"): ["sin(b)"],
    # two pairs of angles in one line
    (
        "x*(sin(a + b)*cos(a) - cos(a + b)*sin(a)) + y*(sin(a + b)*cos(b) - cos(a + b)*sin(b))",
        "x*sin(b) + y*sin(a)",
    ): ["sin(b)", "sin(a)"],
    # a sum is opened
    ("x*sin(a + b) - x*sin(b - a)", "2*x*sin(a)*cos(b)"): ["sin(a + b)", "sin(b - a)"],
    ("1 - cos(2*a)", "2*sin(a)^2"): ["sin² a", "cos(2*a)"],
    # a sum becomes what another term takes away
    ("x*sin(a)*cos(b - a) + x*cos(a)*sin(b - a) - x*sin(b) + y*cos(a)", "y*cos(a)"): ["sin(b)"],
    # of an angle that is none of the ring's
    ("(x*sin(b - a))^2 + (x*cos(b - a))^2", "x^2"): ["sin² b - a"],
    ("sin(a)^2*(sin(b)^2 + cos(b)^2) + cos(a)^2", "1"): ["sin² a", "sin² b"],
    # nothing but a root and an inverse
    ("sqrt(3)*sqrt(3)*sin(a)/x", "3*sin(a)/x"): [],
}


def ring() -> Ring:
    angles = [Angle.of("a"), Angle.of("a") + Angle.of("b")]
    roots = [read(text).tree for text in ("sqrt(3)", "1/x")]
    return build_ring(
        [("a", "revolute"), ("b", "revolute")], [read("x").tree, read("y").tree, *roots], angles
    )


@pytest.mark.parametrize("before, after", CASES)
def test_what_is_used(before: str, after: str) -> None:
    trees = read(before).tree, read(after).tree
    used = used_between(ring(), *trees)
    assert used is not None and used.is_found
    expected = [
        ("sin²", angle_from_tree(read(name.removeprefix("sin² ")).tree))
        if name.startswith("sin²")
        else (name[:3], angle_from_tree(read(name[4:-1]).tree))
        for name in CASES[before, after]
    ]
    found = [*(("sin²", angle) for angle in used.squared), *((x.name, x.whole) for x in used.additions)]
    assert found == expected
    assert is_enough(*trees, used)


def test_an_angle_in_degrees_has_an_identity_of_its_own() -> None:
    before, after = read("x*(sin(25deg)^2 + cos(25deg)^2)").tree, read("x").tree
    (angle,) = angles_in(before)
    fixed = build_ring([("a", "revolute")], [after], [Angle.of("a"), angle])
    assert used_between(fixed, before, after) == Used((angle,))


def test_trees_that_are_not_equal() -> None:
    assert used_between(ring(), read("sin(a)").tree, read("sin(b)").tree) is None


def test_one_identity_after_the_other_is_not_found() -> None:
    used = used_between(ring(), read("cos(2*a)^2 + 4*sin(a)^2*cos(a)^2").tree, read("1").tree)
    assert used is not None and not used.is_found


@settings(max_examples=10, deadline=None)
@given(robots(max_joints=3))
def test_the_identities_that_are_named_are_enough(problem: str) -> None:
    with pytest.MonkeyPatch.context() as patch:
        for line in found_in(problem, patch):
            assert is_enough(*line), (line, problem)


ROWS = """
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: -q1*, a: l3}]
masses: [{mass: m, link: 3, center: tip}]
gravity: [0, -g, 0]
"""
FINGERS = """
dh: [{theta: w*}, {from: 1, theta: f*, a: l}, {from: 1, theta: -f*, a: l}]
masses: [{mass: m, link: 2, center: tip}, {mass: m, link: 3, center: tip}]
gravity: [0, -g, 0]
"""


@pytest.mark.parametrize("problem", [ROWS, FINGERS])
def test_rows_that_share_a_coordinate(problem: str, monkeypatch: pytest.MonkeyPatch) -> None:
    lines = found_in("title: coupled" + problem, monkeypatch)
    assert lines and all(used.is_found and is_enough(before, after, used) for before, after, used in lines)


def found_in(problem: str, patch: pytest.MonkeyPatch) -> list[Line]:
    """The lines of a solution that identities lead to, with these."""
    lines: list[Line] = []

    def noted(ring: Ring, before: Node, after: Node) -> Used | None:
        used = used_between(ring, before, after)
        if used is not None and used.is_found:
            lines.append((before, after, used))
        return used

    patch.setattr(identities, "used_between", noted)
    assert list(dynsolve.solve(problem).steps)
    return lines


def is_enough(before: Node, after: Node, used: Used) -> bool:
    """Whether trees have one value where angles have nothing to do with each other but by what is used.

    Angles of one addition theorem are as they are; any other has a sine and a cosine by chance, on the unit
    circle only where sin² + cos² = 1 is used.
    """
    random = Random(7)
    names = {part.name for tree in (before, after) for part in walk(tree) if isinstance(part, Symbol)}
    angles = angles_in(before, after)
    groups = [{angle, -angle} for angle in angles]
    for each in used.additions:
        of_it = {each.whole, each.first, each.second}
        together = [group for group in groups if group & of_it]
        groups = [group for group in groups if not group & of_it] + [of_it.union(*together)]
    known = {angle for each in used.additions for angle in (each.whole, each.first, each.second)}
    known |= {angle for each in used.squared for angle in (each, -each)}
    values: dict[Angle, tuple[float, float]] = {}
    for group in groups:
        own = {name: random.uniform(0.5, 1.5) for name in names}
        is_free = not group & known and all(angle.terms for angle in group)
        radius = random.uniform(0.5, 1.5) if is_free else 1.0
        for angle in group:
            values[angle] = radius * math.cos(angle.radians(own)), radius * math.sin(angle.radians(own))
    chance = {name + dots: random.uniform(0.5, 1.5) for name in names for dots in DOTS}
    first, second = (value(tree, values, chance) for tree in (before, after))
    return math.isclose(first, second, rel_tol=1e-9, abs_tol=1e-9)


def value(tree: Node, angles: Mapping[Angle, tuple[float, float]], chance: Mapping[str, float]) -> float:
    """That of a tree, its sines and cosines given."""
    put: dict[str, float] = {}

    def own(node: Node) -> Node:
        if not isinstance(node, Function) or node.name not in ("sin", "cos"):
            return node
        name = f"of_angle{len(put)}"
        put[name] = angles[angle_from_tree(node.argument)][node.name == "sin"]
        return Symbol(name)

    return float(evaluate(mapped(tree, own), {**put, **chance}))
