"""The Newton-Euler recursions: a book's worked example, and the Lagrangian's forces on arms of every kind."""

from __future__ import annotations

import pytest
import sympy

import dynsolve
from dynsolve.errors import UsageError, VerificationError
from dynsolve.notation.tree import Matrix, Negative
from dynsolve.problem import read_problem
from dynsolve.questions.newton_euler.check import recursion_names, verify_recursions
from dynsolve.robot.questions import Method
from tests.support import problem_file, solve_json

CRAIG = """
convention: modified
gravity: [0, -g, 0]
dh: [{theta: q1*}, {a: l1, theta: q2*}]
masses:
  - {mass: m1, link: 1, shape: point, center: [l1, 0, 0]}
  - {mass: m2, link: 2, shape: point, center: [l2, 0, 0]}
find: [wl1, wl2, wdl2, al1, al2, acl1, acl2, fl2, nl2, nl1, tau]
"""
A1 = "(m2*l2**2*(q1dd + q2dd) + m2*l1*l2*c2*(2*q1dd + q2dd) + (m1 + m2)*l1**2*q1dd - m2*l1*l2*s2*q2d**2"
A1 += " - 2*m2*l1*l2*s2*q1d*q2d + m2*l2*g*c12 + (m1 + m2)*l1*g*c1)"
AC2 = ["l1*q1dd*s2 - l1*q1d**2*c2 + g*s12 - l2*(q1d + q2d)**2", "l1*q1dd*c2 + l1*q1d**2*s2 + g*c12"]
AC2[1] += " + l2*(q1dd + q2dd)"
PUBLISHED = {
    "wl1": ["0", "0", "q1d"],
    "wl2": ["0", "0", "q1d + q2d"],
    "wdl2": ["0", "0", "q1dd + q2dd"],
    "al1": ["g*s1", "g*c1", "0"],
    "al2": ["l1*q1dd*s2 - l1*q1d**2*c2 + g*s12", "l1*q1dd*c2 + l1*q1d**2*s2 + g*c12", "0"],
    "acl1": ["-l1*q1d**2 + g*s1", "l1*q1dd + g*c1", "0"],
    "acl2": [*AC2, "0"],
    "fl2": [f"m2*({AC2[0]})", f"m2*({AC2[1]})", "0"],
    "nl2": ["0", "0", f"m2*l2*({AC2[1]})"],
    "nl1": ["0", "0", A1],
}
"""Craig, Introduction to Robotics, 3rd ed., section 6.7, the outward and inward iterations."""


def expression(text: str) -> sympy.Expr:
    """An expression in Craig's shorthands, or in the names of the JSON."""
    q1, q2 = sympy.symbols("q1 q2")
    angles = {"1": q1, "2": q2, "12": q1 + q2}
    short = {
        f"{f}{k}": getattr(sympy, name)(a)
        for f, name in (("s", "sin"), ("c", "cos"))
        for k, a in angles.items()
    }
    rates = {f"q{i}{d}": sympy.Symbol(f"q{i}_{'d' * (len(d) - 1)}dot") for i in (1, 2) for d in ("d", "dd")}
    return sympy.sympify(text, {**short, **rates})


@pytest.mark.parametrize("name", PUBLISHED)
def test_the_recursions_of_the_book(name: str) -> None:
    found = solve_text(CRAIG)[name]
    for mine, theirs in zip(found, PUBLISHED[name], strict=True):
        assert (
            sympy.expand_trig(sympy.expand(expression(mine) - expression(theirs), trig=True)).simplify() == 0
        )


def solve_text(text: str) -> dict[str, list[str]]:
    return dynsolve.solve(text).to_json()["results"]


SKEW = """
base: {rotate: Rx(20deg), move: [0, h, 0]}
gravity: [0, -g, 0]
dh:
  - {theta: q1*, a: a1}
  - {theta: 30deg, alpha: 90deg, d: b}
  - {d: q2*, alpha: beta}
  - {theta: 2*q3* - q1*, a: a3}
masses:
  - {mass: m, link: 2, center: [x, y, z], inertia: {xx: I, xy: J}}
  - {name: p, mass: m3, link: 4, center: [x, w, 0], inertia: {zz: I3}, axes: Rz(90deg)}
find: [tau]
"""


@pytest.mark.parametrize(
    "named",
    ["planar-2r", "in3140-rp", "box-cylinder-rod-sphere", "craig-6-5-rp", "rp-vertical", "scara-rrpr",
     SKEW, SKEW.replace("find:", "convention: modified\nfind:")],
    ids=lambda text: text if "\n" not in text else f"own-{'modified' in text}",
)  # fmt: skip
def test_the_forces_are_those_of_the_lagrangian(named: str) -> None:
    text = named if "\n" in named else problem_file(named).read_text(encoding="utf-8")
    problem = read_problem(text, "own.yaml")
    one, other = dynsolve.solve(problem), dynsolve.solve(problem, method="newton-euler")
    assert other.robot.questions.method is Method.NEWTON_EULER
    assert one.values["tau"] == other.values["tau"]
    assert {step.id for step in other.steps} >= {"links", "tau1", "lagrange", "D", "C"}
    assert not {"K", "L", "dLdq1", "D_direct"} & {step.id for step in other.steps}


PRESSED = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l}]
masses: [{mass: m, link: 1, center: tip}]
forces: [{link: 1, at: tip, force: [fx, fy, 0], moment: [0, 0, M], in: link}]
find: [fl1, nl1, tau]
"""


def test_what_acts_from_outside_is_taken_off() -> None:
    """By hand: f = m (a - g) - F and n = r × (m (a - g) - F) - M of a link whose tip carries the mass."""
    results = solve_json(PRESSED)["results"]
    found = [results["fl1"][0], results["fl1"][1], results["nl1"][2]]
    by_hand = (
        "m*g*sin(q1) - m*l*q1_dot**2 - fx",
        "m*l*q1_ddot + m*g*cos(q1) - fy",
        "m*l**2*q1_ddot + m*g*l*cos(q1) - l*fy - M",
    )
    for mine, theirs in zip(found, by_hand, strict=True):
        assert sympy.expand(sympy.sympify(f"{mine} - ({theirs})")) == 0


@pytest.mark.parametrize("convention", ["standard", "modified"])
@pytest.mark.parametrize("frame", ["", ", in: link", ", by: robot"])
def test_with_forces_from_outside_the_recursions_give_the_same_forces(convention: str, frame: str) -> None:
    """f and n are held by an arm in numbers when it is solved, and τ by that of the Lagrangian."""
    text = (
        f"convention: {convention}\ngravity: [0, 0, -g]\n"
        "dh: [{theta: q1*, d: h, alpha: 90deg}, {theta: q2*, a: l, alpha: 90deg}, {d: q3*}]\n"
        "masses: [{mass: m, link: 2, center: [x, 0, 0]}, {mass: m3, link: 3, center: [0, 0, z]}]\n"
        f"forces: [{{link: 3, at: [0, 0, b], force: [fx, fy, fz]{frame}}},"
        " {link: 1, at: tip, moment: [mx, my, mz]}]\nfind: [fl1, nl1, fl2, nl2, fl3, nl3, tau]\n"
    )
    problem = read_problem(text, "own.yaml")
    one, other = dynsolve.solve(problem), dynsolve.solve(problem, method="newton-euler")
    assert one.values["tau"] == other.values["tau"]
    assert one.warnings == ()


@pytest.mark.parametrize("name", ["wl2", "wdl2", "al1", "acl2", "fl1", "nl1"])
def test_a_wrong_result_is_found(name: str) -> None:
    solution = dynsolve.solve("planar-2r", method="newton-euler")
    names = recursion_names(solution.robot, frozenset({name}))
    verify_recursions(solution.robot, {name: solution.forms(name) for name in names})
    form = solution.forms(name)
    assert isinstance(form, Matrix)
    wrong = Matrix(tuple((Negative(entry),) for (entry,) in form.rows))
    with pytest.raises(VerificationError):
        verify_recursions(solution.robot, {name: wrong})


def test_nothing_of_them_is_there_unless_it_is_asked() -> None:
    assert "wl1" not in solve_json(problem_file("planar-2r"))["results"]
    assert "wl1" not in dynsolve.solve("puma560-first3").values


def test_without_masses_there_is_nothing_to_do() -> None:
    with pytest.raises(UsageError, match="no body has mass"):
        dynsolve.solve("dh: [{theta: q1*, a: l1}]\n", method="newton-euler")


def test_longer_arms_are_told_once_for_all_links() -> None:
    solution = dynsolve.solve("scara-rrpr", method="newton-euler")
    ids = [step.id for step in solution.steps]
    assert {"outwards_revolute", "outwards_prismatic", "inwards"} <= set(ids)
    assert not any(name.startswith(("wl", "fl", "nl")) for name in ids)
