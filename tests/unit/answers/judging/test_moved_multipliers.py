"""Equations of motion in which the forces of the constraint stand, in plain text and as a report has them."""

from __future__ import annotations

from pathlib import Path

import pytest

import dynsolve
from dynsolve.answers.verdict import JudgedAnswer
from dynsolve.questions.constraints.judge import OTHER_SIDE, WITHOUT_MULTIPLIERS

BLADE = """
gravity: none
model:
  coordinates: {x: prismatic, y: prismatic, phi: revolute}
  bodies: [{mass: m, at: [x, y, 0], turn: phi, about: [0, 0, 1], inertia: {zz: J}}]
constraints: [{rates: x'*sin(phi) - y'*cos(phi)}]
find: [tau, Ac, lambda]
"""
WHEEL = """
gravity: none
model:
  coordinates: {x: prismatic, y: prismatic, theta: revolute, phi: revolute}
  D: [[m, 0, 0, 0], [0, m, 0, 0], [0, 0, J, 0], [0, 0, 0, I]]
constraints: [{rates: x' - R*phi'*cos(theta)}, {rates: y' - R*phi'*sin(theta)}]
find: [tau, Ac, lambda]
"""
"""A wheel that rolls on a plane without slipping (Murray, Li, Sastry, example 6.1, with its mass)."""


def checked(folder: Path, problem: str, hand_in: str, name: str = "hand-in.yaml") -> dict[str, JudgedAnswer]:
    """The answers of a hand-in as they are judged."""
    (folder / "problem.yaml").write_text(problem, encoding="utf-8")
    (folder / name).write_text(hand_in, encoding="utf-8")
    return {a.name: a for a in dynsolve.check(folder / "problem.yaml", folder / name).answers}


def answered(folder: Path, problem: str, answers: dict[str, str]) -> dict[str, JudgedAnswer]:
    """The same of answers by name."""
    return checked(folder, problem, "answers:\n" + "".join(f"  {n}: {text}\n" for n, text in answers.items()))


@pytest.mark.parametrize(
    ("problem", "answers", "expected"),
    [
        (BLADE, {"tau": "[m*x'' - lambda*sin(phi), m*y'' + lambda*cos(phi), J*phi'']"}, "c"),
        (BLADE, {"tau": "[m*x'' + lambda1*sin(phi), m*y'' - lambda1*cos(phi), J*phi'']"}, "c"),
        (BLADE, {"tau": "[m*x'' - lambda*sin(phi), m*y'' - lambda*cos(phi), J*phi'']"}, "w"),
        (BLADE, {"tau": "[m*x'' - lambda, m*y'' + lambda, J*phi'']"}, "w"),
        (BLADE, {"tau": "[m*x'' - 3*lambda*sin(phi), m*y'' + 3*lambda*cos(phi), J*phi'']"}, "c"),
        (BLADE, {"f1": "m*x'' - lambda*sin(phi)"}, "c"),
        (BLADE, {"f1": "m*x'' - 3*lambda*sin(phi)"}, "w"),
        (BLADE, {"Ac": "[[3*sin(phi), -3*cos(phi), 0]]", "f1": "m*x'' - 3*lambda*sin(phi)"}, "cc"),
        (BLADE, {"f1": "2*m*x'' - lambda*sin(phi)"}, "w"),
        (WHEEL, {"f1": "m*x'' - lambda1", "f2": "m*y'' - lambda2",
                 "tau4": "I*phi'' + R*(lambda1*cos(theta) + lambda2*sin(theta))"}, "ccc"),
        (WHEEL, {"f1": "m*x'' - lambda2", "f2": "m*y'' - lambda1", "tau3": "J*theta''",
                 "tau4": "I*phi'' + R*(lambda2*cos(theta) + lambda1*sin(theta))"}, "cccc"),
        (WHEEL, {"f1": "m*x'' - lambda1", "f2": "m*y'' - lambda2", "tau3": "J*theta''",
                 "tau4": "I*phi'' + R*(lambda1*sin(theta) + lambda2*cos(theta))"}, "cccw"),
    ],
)  # fmt: skip
def test_verdicts(problem: str, answers: dict[str, str], expected: str, tmp_path: Path) -> None:
    found = answered(tmp_path, problem, answers)
    assert "".join(str(found[name].verdict)[0] for name in answers) == expected


def test_the_note_and_the_slips(tmp_path: Path) -> None:
    right = answered(tmp_path, BLADE, {"f1": "m*x'' - lambda*sin(phi)"})["f1"]
    assert WITHOUT_MULTIPLIERS in right.notes
    for written, code in (
        ("m*x'' - lambda", "constraint_forces"),
        ("2*m*x'' - lambda*sin(phi)", "factor_all"),
    ):
        wrong = answered(tmp_path, BLADE, {"f1": written})["f1"]
        assert [one.code for one in wrong.diagnosis] == [code]


def test_what_is_derived_from_such_an_equation_has_no_multipliers(tmp_path: Path) -> None:
    found = answered(tmp_path, BLADE, {"f1": "m*x'' - lambda*sin(phi)", "g": "[0, 0, 0]"})
    assert found["g"].verdict == "correct" and not found["g"].notes


def test_in_a_report(tmp_path: Path) -> None:
    equations = (
        r"$$m\ddot{x} = \lambda\sin\phi + f_1$$ $$m\ddot{y} + \lambda\cos\phi = f_2$$ $$J\ddot\phi = \tau_3$$"
    )
    found = checked(tmp_path, BLADE, equations, "report.md")
    names = ("f1", "f2", "tau3", "tau")
    assert {name: str(found[name].verdict) for name in names} == dict.fromkeys(names, "correct")


def test_multipliers_one_by_one_hold_the_forces_as_their_vector_does(tmp_path: Path) -> None:
    vector = dynsolve.solve(dynsolve.load(_written(tmp_path, WHEEL))).to_json()["results"]["lambda"]
    answers = {f"lambda{k}": text for k, text in enumerate(vector, 1)}
    assert any("tau" in text for text in vector)
    judged = answered(tmp_path, WHEEL, answers)
    assert {judged[name].verdict for name in answers} == {"correct"}
    assert judged["lambda"].verdict == "correct"


def _written(folder: Path, problem: str) -> Path:
    file = folder / "wheel.yaml"
    file.write_text(problem, encoding="utf-8")
    return file


LADDER = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, y: prismatic, theta: revolute}
  bodies: [{mass: m, at: [x, y, 0], turn: theta, about: [0, 0, 1], inertia: {zz: I}}]
passive: [x, y, theta]
constraints: [x - l*cos(theta), y - l*sin(theta)]
find: [lambda]
"""
L1 = "m*l*(m*g*l*sin(theta)*cos(theta)/(m*l^2 + I) - cos(theta)*theta'^2)"
KEYS = {"f1": "m*x'' - lambda1", "f2": "m*y'' + m*g - lambda2"}
OTHER = {"f1": "m*x'' + lambda1", "f2": "m*y'' + m*g + lambda2"}


@pytest.mark.parametrize(
    ("answers", "expected", "is_noted"),
    [
        ({"lambda1": L1}, "c", False),
        ({"lambda1": f"-{L1}"}, "c", True),
        ({"lambda1": f"-2*{L1}"}, "w", False),
        ({**KEYS, "lambda1": L1}, "ccc", False),
        ({**OTHER, "lambda1": f"-{L1}"}, "ccc", True),
        ({**KEYS, "lambda1": f"-{L1}"}, "ccw", False),
        ({**OTHER, "lambda1": L1}, "ccw", False),
    ],
)
def test_the_side_of_the_multipliers_is_that_of_their_equations(
    answers: dict[str, str], expected: str, is_noted: bool, tmp_path: Path
) -> None:
    found = answered(tmp_path, LADDER, answers)
    assert "".join(str(found[name].verdict)[0] for name in answers) == expected
    assert (OTHER_SIDE in found["lambda1"].notes) == is_noted


@pytest.mark.parametrize(("sign", "verdict"), [("+", "correct"), ("-", "wrong")])
def test_a_displayed_equation_in_general_letters_tells_the_side(
    sign: str, verdict: str, tmp_path: Path
) -> None:
    displayed = rf"$$D\ddot q + C\dot q + g {sign} A_c^T\lambda = \tau$$"
    lambda1 = r"$$\lambda_1 = m l (-\frac{m g l \sin\theta\cos\theta}{m l^2 + I} + \cos\theta \dot\theta^2)$$"
    found = checked(tmp_path, LADDER, f"{displayed}\n\n{lambda1}\n", "report.md")
    assert found["lambda1"].verdict == verdict
    assert verdict == "correct" or [one.code for one in found["lambda1"].diagnosis] == ["multiplier_side"]


def test_other_multipliers_in_the_equations_are_those_of_its_matrix(tmp_path: Path) -> None:
    equations = {"tau": "[m*x'' - 3*lambda*sin(phi), m*y'' + 3*lambda*cos(phi), J*phi'']"}
    key = dynsolve.solve(dynsolve.load(_written(tmp_path, BLADE))).to_json()["results"]["lambda"][0]
    for factor, verdict in (("1/3", "correct"), ("-1/3", "wrong"), ("1", "wrong")):
        found = answered(tmp_path, BLADE, {**equations, "lambda": f"({factor})*({key})"})
        assert found["lambda"].verdict == verdict
