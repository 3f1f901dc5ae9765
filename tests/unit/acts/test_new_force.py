"""A new force, as `dynsolve/README.md` tells it: a name and a folder, in a copy of the program.

It is a spring of constant torque: it turns with the same M wherever it stands, and so has the energy -M x.
"""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

import dynsolve
from tests.unit.questions.test_new_question import run

FILES = {
    "__init__": '''"""Springs of constant torque."""

from dynsolve.problem.kinds import EXPRESSION, PARAMETER, Key, Keyed, list_of

SPRING = Keyed(
    (
        Key("torque", PARAMETER, "M, which turns towards greater x.", "M0", required=True),
        Key("of", EXPRESSION, "x, linear in the coordinates.", "q2 - q1", required=True),
    )
)

KEY = Key(
    "torque_springs",
    list_of("torque spring", SPRING),
    "Springs of constant torque M, of the energy -M x.",
    "[{torque: M0, of: q2}]",
    "none",
    remedy="a torque spring is written {torque: M0, of: q2}",
)
''',
    "act": '''"""Springs of constant torque: -M x."""

from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_values import evaluate
from dynsolve.problem.acting import linear
from dynsolve.robot.actions import Parameter
from dynsolve.robot.model import Stored
from dynsolve.robot.dimensions import measured_along
from dynsolve.robot.units import ENERGY, along, times

TERM = Stored


class TorqueSpring(Stored, frozen=True):
    """A torque M along a linear form x."""

    torque: Expr
    of: Expr

    @property
    def energy(self):
        """-M x"""
        return -self.torque * self.of

    def energy_at(self, values):
        """-M x, each in numbers first."""
        return -evaluate(self.torque, values) * evaluate(self.of, values)

    @property
    def along(self):
        """(x, M)"""
        return self.of, self.torque

    def parameters(self, robot):
        """A torque, or a force."""
        x = measured_along(robot, self.of)
        torque, words = x and times(ENERGY, x, -1), "constant torque|torques of a|the spring|springs"
        yield Parameter(self.torque, words, torque, along(x, "N m", "N"))
        yield Parameter(self.of, dimension=x)


def build(values, spring):
    """The spring with exact values."""
    torque, x = spring["torque"] and values.expr(spring["torque"]), linear(values, spring["of"])
    return None if torque is None or x is None else TorqueSpring(torque, x)
''',
    "explain": '''"""What is told of springs of constant torque."""

from dynsolve.explain.writing import (measured)
from dynsolve.notation.build import negated, times


def given(forms, spring):
    """A spring turns q2 with the constant torque M."""
    torque, _ = (measured(forms.of(one.value), one.unit) for one in spring.parameters(forms.robot))
    return ("A spring turns ", forms.of(spring.of), " with the constant torque ", torque, ".")


def why(springs):
    """What it stores."""
    return "A spring of constant torque gives its torque times the way that it has turned."


def term(context, spring):
    """-M x"""
    return negated(times(1, [(context.show(spring.torque), 1), (context.show(spring.of), 1)]))
''',
}

PROBLEM = """title: Two links
gravity: [0, -g, 0]
dh:
  - {theta: q1*, a: l1}
  - {theta: q2*, a: l2}
masses:
  - {mass: m1, link: 1, center: tip, shape: point}
  - {mass: m2, link: 2, center: tip, shape: point}
springs: [{stiffness: k, of: q1}]
torque_springs: [{torque: M0, of: q2}]
find: [Ps, tau2, g]
marks: {Ps: 3, g: 2}
"""

HAND_IN = """answers:
  Ps: 1/2*k*q1^2 + M0*q2
  g: [m1*g*l1*cos(q1) + m2*g*(l1*cos(q1) + l2*cos(q1+q2)) + k*q1, m2*g*l2*cos(q1+q2) - M0]
"""


@pytest.fixture(scope="module")
def house(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of the program with the force."""
    house = tmp_path_factory.mktemp("house")
    shutil.copytree(
        Path(dynsolve.__file__).parent, house / "dynsolve", ignore=shutil.ignore_patterns("__pycache__")
    )
    kinds = house / "dynsolve/robot/actions.py"
    text = kinds.read_text("utf-8")
    before = '"motors")'
    assert text.count(before) == 1
    kinds.write_text(text.replace(before, '"torque_springs", ' + before), "utf-8")
    folder = house / "dynsolve/acts/torque_springs"
    folder.mkdir()
    for name, content in FILES.items():
        (folder / f"{name}.py").write_text(content, "utf-8")
    (house / "arm.yaml").write_text(PROBLEM, "utf-8")
    (house / "answer.yaml").write_text(HAND_IN, "utf-8")
    return house


def test_it_is_in_the_schema(house: Path) -> None:
    found = json.loads(run(house, "schema"))
    assert found["properties"]["torque_springs"]["items"] == {"$ref": "#/$defs/torque_spring"}


def test_it_is_linted(house: Path) -> None:
    assert run(house, "lint", "arm.yaml") == "arm.yaml: nothing to remark\n"


def test_it_is_solved_and_told(house: Path) -> None:
    text = run(house, "solve", "arm.yaml")
    assert "A spring turns q₂ with the constant torque M₀." in " ".join(text.split())
    assert "A spring of constant torque gives its torque" in text
    assert "P_s = ½ k q₁² - M₀ q₂" in text
    assert "M₀: constant torque of a spring (N m)" in text


def test_it_is_exported_and_verified(house: Path) -> None:
    found = json.loads(run(house, "solve", "arm.yaml", "--json"))
    assert found["results"]["Ps"] == "1/2*k*q1**2 - M0*q2"
    assert found["results"]["g"][1] == "m2*g*l2*cos(q1 + q2) - M0"
    assert found["verified"]["states"]


def test_an_answer_with_it_is_judged_and_has_marks(house: Path) -> None:
    found = json.loads(run(house, "check", "arm.yaml", "answer.yaml", "--json"))
    assert {one["name"]: one["verdict"] for one in found["answers"]} == {"Ps": "wrong", "g": "correct"}
    assert (found["marks"], found["of"]) == (2, 5)
