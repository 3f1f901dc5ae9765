"""Forces from outside: by hand on small arms, and against the power of the forces."""

from __future__ import annotations

import pytest

import dynsolve
from dynsolve.derivation.rules import derive
from dynsolve.errors import VerificationError
from dynsolve.explain.forms import Forms
from dynsolve.notation.tree import Matrix, Negative
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem import read_problem
from dynsolve.questions.statics.check import verify_statics as verify_statics
from dynsolve.render.files import Format
from dynsolve.solution.reports import report

ELBOW = "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\n"
SPATIAL = """
convention: modified
base: {rotate: Rx(20deg), move: [0, h, 0]}
dh: [{theta: q1*, d: d1}, {d: q2*, alpha: 90deg, a: a1}, {theta: 2*q3* - q1*, alpha: beta}, {a: a3}]
masses: [{mass: m, link: 3, center: [x, y, z], inertia: {xx: I}}]
points: {P: {link: 3, at: [0, y, 0]}}
forces:
  - {link: 4, at: origin, force: [Fx, q2*Fy, Fz], moment: [Mx, 0, Mz]}
  - {link: 3, at: [0, y, 0], force: [0, F, 0], in: link, by: robot}
  - {link: 2, at: [0, x, 0], moment: [M, 0, 0], in: Rz(30deg)}
find: [Q, tau_static]
"""


def results(text: str) -> dict[str, list[str]]:
    return dynsolve.solve(text).to_json()["results"]


@pytest.mark.parametrize(
    ("force", "Q"),
    [
        ("{link: 2, force: [0, F, 0]}", ["F*(l1*cos(q1) + l2*cos(q1 + q2))", "F*l2*cos(q1 + q2)"]),
        ("{link: 1, force: [0, F, 0]}", ["F*l1*cos(q1)", "0"]),
        ("{link: 2, moment: [0, 0, M]}", ["M", "M"]),
        ("{link: 2, moment: [M, 0, 0]}", ["0", "0"]),
        ("{link: 2, force: [0, F, 0], in: link}", ["F*(l2 + l1*cos(q2))", "F*l2"]),
        ("{link: 2, force: [F, 0, 0], in: Rz(90deg)}", ["F*(l2 + l1*cos(q2))", "F*l2"]),
        ("{link: 2, force: [0, F, 0], in: link, by: robot}", ["-F*(l2 + l1*cos(q2))", "-F*l2"]),
        ("{link: 2, at: {near: [a, 0, 0]}, moment: [0, 0, 1], force: [0, 0, F]}", ["1", "1"]),
    ],
)
def test_the_elbow_by_hand(force: str, Q: list[str]) -> None:
    found = results(f"{ELBOW}forces: [{force}]\nfind: [Q, tau_static]\n")
    assert found["Q"] == Q


def test_weight_is_held_too() -> None:
    text = f"gravity: [0, -g, 0]\n{ELBOW}masses: [{{mass: m, link: 2}}]\nfind: [tau_static]\n"
    weight = "forces: [{link: 2, force: [0, m*g, 0]}]\n"
    assert results(text)["tau_static"] == ["m*g*(l1*cos(q1) + l2*cos(q1 + q2))", "m*g*l2*cos(q1 + q2)"]
    assert results(text + weight)["tau_static"] == ["0", "0"]


@pytest.mark.parametrize(
    ("state", "Q"),
    [
        ("{q1: 90deg}", ["-F*l2*sin(q2)", "-F*l2*sin(q2)"]),
        ("{q2: -90deg}", ["F*(l2*sin(q1) + l1*cos(q1))", "F*l2*sin(q1)"]),
        ("{q1: 45deg, q2: 0}", ["sqrt(2)*F*(l1 + l2)/2", "sqrt(2)*F*l2/2"]),
        ("{q1: beta, q2: -beta}", ["F*(l2 + l1*cos(beta))", "F*l2"]),
        ("{q1: 10deg, q2: 50deg}", ["F*(l2/2 + l1*cos(0.17453292519943295))", "F*l2/2"]),
    ],
)
def test_at_a_state_the_rest_stays_symbols(state: str, Q: list[str]) -> None:
    text = f"{ELBOW}forces: [{{link: 2, force: [0, F, 0]}}]\nstate: {state}\nfind: [Q]\n"
    assert results(text)["Q"] == Q


@pytest.mark.parametrize("name", ["Q", "tau_static"])
@pytest.mark.parametrize("state", ["", "state: {q1: 30deg, q3: 17deg, q2: l}\n"])
def test_the_power_of_the_forces_finds_a_wrong_sign(name: str, state: str) -> None:
    robot = read_problem(SPATIAL + state).robot
    forms = Forms(robot, derive(robot))
    right = forms(name)
    verify_statics(robot, {name: right})
    assert isinstance(right, Matrix)
    (first, *rest) = right.rows
    with pytest.raises(VerificationError, match="differs from the power of the forces"):
        verify_statics(robot, {name: Matrix(((Negative(first[0]),), *rest))})


def test_each_force_has_its_step_and_says_whose_it_is() -> None:
    steps = {step.id: step for step in dynsolve.solve(SPATIAL).steps}
    assert [i for i in steps if steps[i].stage == "statics"] == ["load1", "load2", "load3", "Q", "tau_static"]
    assert "its opposite" in steps["load2"].notes[0][0] and steps["load1"].notes == ()
    assert "of the angular velocity of link 2 gives" in str(steps["load3"].why)  # it is a moment alone


# -- what is said of what holds an arm ---------------------------------------------------------------

SPRUNG = """
gravity: none
dh: [{theta: q1*, a: l1}, {d: q2*, alpha: 90deg}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
springs: [{stiffness: k, of: q2, rest: l0}]
passive: [q1]
find: [tau_static]
"""


def test_without_forces_from_outside_what_holds_is_g_alone_and_none_is_told() -> None:
    steps = {step.id: step for step in dynsolve.solve(SPRUNG).steps}
    assert "Q" not in steps and to_unicode(steps["tau_static"].formula) == "τ_static = g"
    loaded = SPRUNG.replace("find:", "forces: [{link: 2, moment: [0, 0, M], at: tip}]\nfind:")
    steps = {step.id: step for step in dynsolve.solve(loaded).steps}
    assert to_unicode(steps["tau_static"].formula) == "τ_static = g - Q"
    assert steps["load1"].title == "What moment 1 does to the joints"


def test_nothing_but_0_holds_what_no_motor_drives() -> None:
    told = report(dynsolve.solve(SPRUNG), Format.TEXT).decode()
    assert "No motor drives q₁: its entry must be 0." in " ".join(told.split())


@pytest.mark.parametrize(
    ("axes", "told"),
    [
        ("link", "along the axes of frame 2."),
        ("Rz(45deg) Rx(beta)", "along the axes of frame 2 turned by 𝐑_{z,45°} 𝐑_{x,β}."),
        (
            "[[0, -1, 0], [1, 0, 0], [0, 0, 1]]",
            "along axes that, seen from frame 2, are (0, 1, 0), (-1, 0, 0)",
        ),
    ],
)
def test_the_axes_of_a_force_are_given(axes: str, told: str) -> None:
    text = f"{ELBOW}forces: [{{link: 2, force: [F, 0, 0], in: {axes}}}]\nfind: [Q]\n"
    assert told in " ".join(report(dynsolve.solve(text), Format.TEXT).decode().split())


def test_an_entry_of_what_acts_from_outside_is_told_by_its_vector() -> None:
    """Beside a force Q₁ of the problem its letter is another than that of 𝐐."""
    loaded = "masses: [{mass: m, link: 2}]\nforces: [{link: 2, force: [Q1, 0, 0]}]\nfind: [tau]"
    text = f"gravity: none\n{ELBOW}{loaded}"
    told = " ".join(report(dynsolve.solve(text), Format.TEXT).decode().split())
    assert "Ξᵢ, entry i of 𝐐, is what acts from outside." in told
