"""A new question, as `dynsolve/README.md` tells it: a stage and a folder, in a copy of the program.

It asks for the part of each body in the inertia matrix, D = Σ D_b with D_b = m J_vᵀ J_v + J_ωᵀ I J_ω, and so
for its share of the kinetic energy, ½ q̇ᵀ D_b q̇.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import dynsolve

STAGE = '    SHARES = "shares", "The parts of the bodies in the inertia matrix", ASKED, OF_MASSES\n'

FILES = {
    "__init__": '''"""The parts of the bodies in the inertia matrix."""

from dynsolve.notation.tree import Letter, Words
from dynsolve.quantities.family import Family, Owner, of_body
from dynsolve.quantities.stages import Stage

SHARE = Family(
    name="Dshare{b}",
    called="the part|parts {} of the body|bodies in the inertia matrix",
    owner=Owner.BODY,
    stage=Stage.SHARES,
    shape=("n", "n"),
    letter=of_body(lambda body: Letter("D", Words(body.name), None, "bold")),
    spellings=("Mshare{b}",),
)

FAMILIES = (SHARE,)
''',
    "derive": '''"""D_b = m J_vᵀ J_v + J_ωᵀ I J_ω."""

from functools import partial

from dynsolve.derivation.graph import Rule


def rules(robot):
    """The part of each body."""
    for body in robot.bodies:
        b = body.name
        yield Rule(f"Dshare{b}", (f"Jv{b}", f"Jw{b}", f"I{b}"), partial(part, body))


def part(body, Jv, Jw, I):
    """m J_vᵀ J_v + J_ωᵀ I J_ω"""
    return (Jv.T @ Jv).scale(body.mass) + Jw.T @ I @ Jw
''',
    "check": '''"""The parts come to D."""

from itertools import islice

from dynsolve.derivation.arm_values import states_with
from dynsolve.errors import VerificationError
from dynsolve.notation.tree_values import compile_trees


def verify(held):
    """Their sum is D, which has been verified."""
    names = [f"Dshare{body.name}" for body in held.robot.bodies]
    if held.wanted.issuperset(names):
        held.hold(verify_sum, [*names, "D"])


def verify_sum(robot, results, states):
    """Raises VerificationError where it is not."""
    program = compile_trees(list(results.values()))
    for _, (*parts, D) in islice(states_with(robot.ring, program.run), states):
        for i, row in enumerate(D):
            for j, entry in enumerate(row):
                if abs(sum(part[i][j] for part in parts) - entry) > 1e-9:
                    raise VerificationError("the parts are not D")
''',
    "explain": '''"""The step of each body."""

from dynsolve.explain.step import Step
from dynsolve.document.books import spong
from dynsolve.notation.template import formula
from dynsolve.notation.tree import equation
from dynsolve.quantities.index import quantities

AT_HAND = "You have the Jacobians and tensors of the bodies."


def steps(context):
    """Those that are asked for."""
    for name, quantity in quantities(context.robot).items():
        if name.startswith("Dshare") and name in context.wanted:
            letter = quantity.letter(context.robot)
            yield Step(
                id=name,
                title="What a body brings to the inertia matrix",
                why=("Its kinetic energy is quadratic in the rates.",),
                formula=equation(letter, formula("m 𝐉_vᵀ 𝐉_v + 𝐉_ωᵀ 𝓘 𝐉_ω")),
                source=spong("7.2.2"),
                result=(equation(letter, context.form(name)),),
            )
''',
}

PROBLEM = """title: Two links
dh:
  - {theta: q1*, a: l1}
  - {theta: q2*, a: l2}
masses:
  - {mass: m1, link: 1, center: tip, shape: point}
  - {mass: m2, link: 2, center: tip, shape: point}
gravity: none
find: [D, Dshare1, Dshare2]
marks: {Dshare2: 3}
"""

HAND_IN = """answers:
  Dshare1: [[m1*l1^2, 0], [0, 0]]
  Dshare2:
    - [m2*(l1^2 + 2*l1*l2*cos(q2) + l2^2), m2*(l2^2 + l1*l2*cos(q2))]
    - [m2*(l2^2 - l1*l2*cos(q2)), m2*l2^2]
"""


@pytest.fixture(scope="module")
def house(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of the program with the question."""
    house = tmp_path_factory.mktemp("house")
    shutil.copytree(
        Path(dynsolve.__file__).parent, house / "dynsolve", ignore=shutil.ignore_patterns("__pycache__")
    )
    stages = house / "dynsolve/quantities/stages.py"
    text = stages.read_text("utf-8")
    before = '    STATICS = "statics"'
    assert before in text
    stages.write_text(text.replace(before, STAGE + before), "utf-8")
    folder = house / "dynsolve/questions/shares"
    folder.mkdir()
    for name, content in FILES.items():
        (folder / f"{name}.py").write_text(content, "utf-8")
    (house / "arm.yaml").write_text(PROBLEM, "utf-8")
    (house / "answer.yaml").write_text(HAND_IN, "utf-8")
    return house


def run(house: Path, *arguments: str) -> str:
    found = subprocess.run(
        [sys.executable, "-m", "dynsolve", *arguments],
        cwd=house, env={**os.environ, "PYTHONPATH": str(house)}, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert found.returncode in (0, 1), found.stderr
    return found.stdout + found.stderr


def test_it_is_linted(house: Path) -> None:
    assert run(house, "lint", "arm.yaml") == "arm.yaml: nothing to remark\n"


def test_it_is_solved_and_told(house: Path) -> None:
    text = run(house, "solve", "arm.yaml")
    assert "The parts of the bodies in the inertia matrix" in text
    assert "What a body brings to the inertia matrix" in text


def test_it_is_exported_and_verified(house: Path) -> None:
    found = json.loads(run(house, "solve", "arm.yaml", "--json"))
    assert found["results"]["Dshare1"] == [["m1*l1**2", "0"], ["0", "0"]]
    assert found["verified"]["states"]


def test_an_answer_to_it_is_judged_and_has_marks(house: Path) -> None:
    found = json.loads(run(house, "check", "arm.yaml", "answer.yaml", "--json"))
    assert {one["name"]: one["verdict"] for one in found["answers"]} == {
        "Dshare1": "correct",
        "Dshare2": "wrong",
    }


def test_its_hint_is_told(house: Path) -> None:
    assert "You have the Jacobians and tensors" in run(house, "solve", "arm.yaml", "--hint", "shares")
