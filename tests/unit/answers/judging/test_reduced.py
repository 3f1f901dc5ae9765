"""Equations of motion without multipliers: by hand, handed in in other forms, and held in numbers."""

from __future__ import annotations

from pathlib import Path

import pytest

import dynsolve
from dynsolve.derivation.rules import derive
from dynsolve.errors import VerificationError
from dynsolve.explain.forms import Forms
from dynsolve.notation.build import negated, total
from dynsolve.problem import read_problem
from dynsolve.questions.constraints.check import constrained_names, verify_reduced
from dynsolve.questions.constraints.forms import ReducedForms

BLADE = """
gravity: none
model:
  coordinates: {x: prismatic, y: prismatic, phi: revolute}
  bodies: [{mass: m, at: [x, y, 0], turn: phi, about: [0, 0, 1], inertia: {zz: J}}]
constraints: [{rates: x'*sin(phi) - y'*cos(phi)}]
find: [reduced]
"""
PENDULUM = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, y: prismatic}
  bodies: [{mass: m, at: [x, y, 0]}]
constraints: [x^2 + y^2 - l^2]
passive: [x, y]
find: [reduced]
"""
ALONG = "m*(x''*cos(phi) + y''*sin(phi)) = f1*cos(phi) + f2*sin(phi)"


def test_by_hand() -> None:
    """Along the blade; about the pivot of a pendulum in x and y."""
    blade = dynsolve.solve(BLADE).to_json()["results"]["reduced"]
    assert blade == [
        "m*cos(phi)*x_ddot + m*sin(phi)*y_ddot = f2*sin(phi) + f1*cos(phi)",
        "J*phi_ddot = tau3",
    ]
    pendulum = dynsolve.solve(PENDULUM).to_json()["results"]["reduced"]
    assert pendulum == ["m*y*x_ddot - m*x*y_ddot - m*g*x = 0"]


@pytest.mark.parametrize(
    ("problem", "written", "code"),
    [
        (BLADE, f"[{ALONG}, J*phi'' = tau3]", ""),
        (BLADE, f'["{ALONG} and phi\'\' = tau3/J"]', ""),
        (BLADE, "[phi'' = tau3/J, m*x'' = f1*cos(phi)^2 + f2*sin(phi)*cos(phi) - m*phi'*y']", ""),
        (BLADE, f"[{ALONG.replace('+ f2', '- f2')}, J*phi'' = tau3]", "motion_differs"),
        (BLADE, f"[{ALONG}]", "motions_missing"),
        (BLADE, "[J*phi'' = tau3, x''*sin(phi) + x'*phi'*cos(phi) + y'*phi'*sin(phi) = y''*cos(phi)]",
         "motions_missing"),
        (PENDULUM, "[x*y'' - y*x'' + g*x = 0]", ""),
        (PENDULUM, "[l^2*y'' + y*(x'^2 + y'^2) + g*x^2 = 0]", ""),
        (PENDULUM, "[x*y'' - y*x'' = g*x]", "motion_differs"),
        (PENDULUM, "[m*x'' = 0, m*y'' + m*g = 0]", "motion_differs"),
    ],
)  # fmt: skip
def test_verdicts(problem: str, written: str, code: str, tmp_path: Path) -> None:
    (tmp_path / "problem.yaml").write_text(problem, encoding="utf-8")
    (tmp_path / "answer.yaml").write_text(f"answers:\n  reduced: {written}\n", encoding="utf-8")
    (found,) = dynsolve.check(tmp_path / "problem.yaml", tmp_path / "answer.yaml").answers
    assert [one.code for one in found.diagnosis] == ([code] if code else [])
    assert str(found.verdict) == ("wrong" if code else "correct")


def test_in_a_report(tmp_path: Path) -> None:
    (tmp_path / "problem.yaml").write_text(BLADE, encoding="utf-8")
    (tmp_path / "report.md").write_text(
        r"Reduced equations: $m(\ddot x\cos\phi + \ddot y\sin\phi) = f_1\cos\phi + f_2\sin\phi$"
        r" and $J\ddot\phi = \tau_3$",
        encoding="utf-8",
    )
    (found,) = dynsolve.check(tmp_path / "problem.yaml", tmp_path / "report.md").answers
    assert str(found.verdict) == "correct"


@pytest.mark.parametrize("kept", [slice(0, 1), slice(0, 0)])
def test_the_check_finds_an_equation_that_is_missing(kept: slice) -> None:
    robot = read_problem(BLADE).robot
    values = derive(robot)
    forms = {name: Forms(robot, values)(name) for name in constrained_names(robot)}
    sides = ReducedForms(robot, values).reduced
    residuals = [total([left, negated(right)]) for left, right in sides]
    verify_reduced(robot, forms, residuals)
    with pytest.raises(VerificationError):
        verify_reduced(robot, forms, residuals[kept])
    with pytest.raises(VerificationError):
        verify_reduced(robot, forms, [*residuals, sides[1][0]])


def test_the_hint_gives_the_matrices_and_not_the_equations() -> None:
    hint = str(dynsolve.solve(BLADE).hint("constraints"))
    assert "The equations without the multipliers" in hint and "Row by row" not in hint


@pytest.mark.parametrize(
    ("answers", "verdict", "sources"),
    [
        ({"K": "m*(x'^2 + y'^2) + J*phi'^2/2",
          "reduced": f"[{ALONG.replace('m*', '2*m*')}, J*phi'' = tau3]"}, "follows", ("K",)),
        ({"K": "m*(x'^2 + y'^2) + J*phi'^2/2", "reduced": f"[{ALONG.replace('m*', '3*m*')}, J*phi'' = tau3]"},
         "wrong", ()),
        ({"Ac": "[[sin(phi), cos(phi), 0]]",
          "reduced": "[m*(x''*cos(phi) - y''*sin(phi)) = f1*cos(phi) - f2*sin(phi), J*phi'' = tau3]"},
         "follows", ("Ac",)),
    ],
)  # fmt: skip
def test_they_follow_from_an_own_energy_or_matrix_of_the_constraint(
    answers: dict[str, str], verdict: str, sources: tuple[str, ...], tmp_path: Path
) -> None:
    problem = BLADE.replace("[reduced]", "[K, Ac, reduced]")
    (tmp_path / "problem.yaml").write_text(problem, encoding="utf-8")
    written = "".join(f"  {name}: {text}\n" for name, text in answers.items())
    (tmp_path / "answer.yaml").write_text(f"answers:\n{written}", encoding="utf-8")
    judged = dynsolve.check(tmp_path / "problem.yaml", tmp_path / "answer.yaml").answers
    found = next(a for a in judged if a.name == "reduced")
    assert (str(found.verdict), found.follows_from) == (verdict, sources)
