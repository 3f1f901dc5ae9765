"""Equilibria handed in: in other forms, in part, and wrong; read from files as students write them."""

from __future__ import annotations

from itertools import product
from pathlib import Path

import pytest

import dynsolve

ARM = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
find: [equilibria]
"""
POLE = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, theta: revolute}
  bodies: [{mass: M, at: [x, 0, 0]}, {mass: m, at: [x + l*sin(theta), l*cos(theta), 0]}]
find: [equilibria]
"""
MASSES = """
gravity: none
model:
  coordinates: {q1: prismatic, q2: prismatic, q3: prismatic}
  bodies: [{mass: m1, at: [q1, 0, 0]}, {mass: m2, at: [q2, 0, 0]}, {mass: m3, at: [q3, 0, 0]}]
springs: [{stiffness: k1, of: q1 - q2}, {stiffness: k2, of: q2 - q3}]
find: [equilibria]
"""
ELASTIC = """
gravity: [0, -g, 0]
base: Rz(-90deg)
dh: [{theta: q1*, a: l}]
masses: [{mass: m, link: 1}]
motors: [{turns: q2*, inertia: J}]
springs: [{stiffness: k, of: q1 - q2}]
passive: [q1]
find: [equilibria]
"""
HELD = ELASTIC.replace("find:", "inputs: given\nfind:")
HOOP = """
gravity: [0, 0, -g]
model:
  coordinates: {phi: revolute, theta: revolute}
  bodies: [{mass: m, at: [a*sin(theta)*cos(phi), a*sin(theta)*sin(phi), -a*cos(theta)]}]
steady: {phi: W}
find: [equilibria]
"""
LIFT = "dh: [{d: d1*}]\nmasses: [{mass: m, link: 1}]\nfind: [equilibria]\n"
FLAT = "gravity: none\ndh: [{theta: q1*, a: l}]\nmasses: [{mass: m, link: 1}]\nfind: [equilibria]\n"


@pytest.mark.parametrize(
    ("problem", "written", "code"),
    [
        (ARM, '["cos(q1) = 0 and sin(q2) = 0"]', ""),
        (ARM, '["cos(q1) = 0 and cos(q1 + q2) = 0"]', ""),
        (ARM, "{q1: [pi/2, -pi/2], q2: [0, pi]}", ""),
        (ARM, "{q1: ±pi/2, q2: [0, -pi]}", ""),
        (ARM, "[{q1: 90deg, q2: [0, pi]}, {q1: 270deg, q2: [0, pi]}]", ""),
        (ARM, "{q1: -pi/2, q2: 0}", "equilibria_missing"),
        (ARM, "{q1: [pi/2, -pi/2], q2: [0, pi/2]}", "no_equilibrium"),
        (ARM, '["cos(q1) = 0"]', "no_equilibrium"),
        (ARM, '["cos(q1) = 0 and sin(q2) = 0", "sin(q1) = 0"]', "no_equilibrium"),
        (ARM, '["cos(q1) = 2"]', "condition_never_holds"),
        (POLE, "[sin(theta) = 0]", ""),
        (POLE, "[theta = 0, theta = pi]", ""),
        (POLE, "[theta = k*pi]", ""),
        (POLE, '["theta = 0 and x = 0", "theta = pi and x = 0"]', "equilibria_missing"),
        (MASSES, "[q1 = q2 = q3]", ""),
        (MASSES, '["q1 = q2 and q2 = q3"]', ""),
        (MASSES, "[q1 = q2]", "no_equilibrium"),
        (ELASTIC, '["sin(q1) = 0 and q1 = q2"]', ""),
        (ELASTIC, '["sin(q1) = 0 and sin(q2) = 0"]', "no_equilibrium"),
        (ELASTIC, '["q1 = 0 and q2 = 0", "q1 = pi and q2 = pi"]', ""),
        (ELASTIC, '["q1 = 0 and q2 = 0", "q1 = pi and q2 = 0"]', "no_equilibrium"),
        (ELASTIC, "q1 = q2 = 0; q1 = q2 = pi", ""),
        (HELD, "[m*g*l*sin(q1) + k*(q1 - q2) = 0]", ""),
        (HELD, '["sin(q1) = 0 and q1 = q2"]', "equilibria_missing"),
        (HOOP, "{theta: [0, pi, ±acos(g/(a*W^2))]}", ""),
        (HOOP, "[sin(theta) = 0, theta = ±arccos(g/(a*W^2))]", ""),
        (HOOP, "{theta: [0, pi]}", "equilibria_missing"),
        (HOOP, "[sin(theta) = 0, cos(theta) = W^2*a/g]", "no_equilibrium"),
        (LIFT, "none", ""),
        (LIFT, "[d1 = 0]", "no_equilibrium"),
        (FLAT, "[q1 = 0]", "equilibria_missing"),
    ],
)
def test_verdicts(problem: str, written: str, code: str, tmp_path: Path) -> None:
    (tmp_path / "problem.yaml").write_text(problem, encoding="utf-8")
    (tmp_path / "answer.yaml").write_text(f"answers:\n  equilibria: {written}\n", encoding="utf-8")
    report = dynsolve.check(tmp_path / "problem.yaml", tmp_path / "answer.yaml")
    (found,) = report.answers
    assert str(found.verdict) == ("wrong" if code else "correct"), found
    assert [one.code for one in found.diagnosis] == ([code] if code else [])


BEAD = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, y: prismatic}
  bodies: [{mass: m, at: [x, y, 0]}]
constraints: [y - a*x*x]
find: [equilibria]
"""
SPHERE = """
gravity: [0, 0, -g]
model:
  coordinates: {x: prismatic, y: prismatic, z: prismatic}
  bodies: [{mass: m, at: [x, y, z]}]
passive: [x, y, z]
constraints: [x^2 + y^2 + z^2 - R^2]
find: [equilibria]
"""


@pytest.mark.parametrize(
    ("problem", "written", "codes", "says"),
    [
        (BEAD, '["x = 0 and y = 0"]', [], ""),
        (
            BEAD,
            "[x = 0]",
            ["off_constraint"],
            "alternative 1 holds, and the constraint y - a x² = 0 does not.",
        ),
        (BEAD, "[y = a*x^2]", ["no_equilibrium"], "and the forces are not in balance."),
        (SPHERE, '["x = 0 and y = 0 and z = R", "x = 0 and y = 0 and z = -R"]', [], ""),
        (SPHERE, '["x = 0 and y = 0"]', ["off_constraint"], "the constraint x² + y² + z² - R² = 0 does not."),
        (SPHERE, '["x = R and y = 0 and z = 0"]', ["no_equilibrium"], "and the forces are not in balance."),
    ],
)
def test_what_misses_a_constraint_is_not_said_to_be_out_of_balance(
    problem: str, written: str, codes: list[str], says: str
) -> None:
    """With constraints g(q) itself is not 0: at the bottom of the parabola it is (0, m g)."""
    (found,) = dynsolve.check(problem, f"answers:\n  equilibria: {written}\n").answers
    assert [one.code for one in found.diagnosis] == codes
    for told in found.diagnosis:
        assert says in told.message and "g(q) = A_cᵀ λ" in told.look


def test_no_factors_are_spoken_of_where_a_force_has_none() -> None:
    spring = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l}]
masses: [{mass: m, link: 1}]
springs: [{stiffness: k, of: q1, rest: 90deg}]
find: [equilibria]
"""
    (found,) = dynsolve.check(spring, "answers:\n  equilibria: [q1 = pi/2]\n").answers
    (told,) = found.diagnosis
    assert told.code == "equilibria_missing" and "where what must be 0 is a product" in told.look


THREE_LINKS = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: q3*, a: l3}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}, {mass: m3, link: 3}]
find: [equilibria]
"""
STRAIGHT = list(product(("pi/2", "-pi/2"), ("0", "pi"), ("0", "pi")))


@pytest.mark.parametrize("left", [None, *STRAIGHT])
def test_each_of_eight_counts(left: tuple[str, str, str] | None) -> None:
    """Links that hang or stand, each on its own: no choice of them may be forgotten."""
    kept = [one for one in STRAIGHT if one != left]
    written = ", ".join(f'"q1 = {a} and q2 = {b} and q3 = {c}"' for a, b, c in kept)
    report = dynsolve.check(THREE_LINKS, f"answers:\n  equilibria: [{written}]\n")
    codes = [one.code for one in report.answers[0].diagnosis]
    assert codes == (["equilibria_missing"] if left else [])
