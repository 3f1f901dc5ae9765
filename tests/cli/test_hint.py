"""Hints: what to do in a stage, without its result or a later one."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pytest

from dynsolve.notation.tree import Matrix, Relation
from dynsolve.notation.unicode import to_unicode
from dynsolve.quantities.stages import COURSE
from dynsolve.render.terminal import render
from tests.cli.running import dynsolve
from tests.support import solved

CHOSEN = ["in3140-rp", "planar-2r-motors", "numeric-2r", "rp-parameters", "scara-rrpr", "five-bar"]


def hint(problem: str, stage: str) -> str:
    solution = solved(problem)
    lines = render(solution.hint(stage), 400, solution.style)
    return "\n".join(line.text for line in lines)


@pytest.mark.parametrize("problem", CHOSEN)
def test_no_result_of_the_stage_or_of_a_later_one(problem: str) -> None:
    """What is to be done holds no formula that comes out; what there is came out of an earlier stage."""
    solution = solved(problem)
    order = list(COURSE)
    for place, stage in enumerate(order):
        there_is, _, to_do = hint(problem, stage).partition("\n1. ")
        for later in order[place:]:
            assert not [result for result in _results(problem, later) if result in to_do], stage
        given = {to_unicode(solution.forms(name), solution.style) for _, name in GIVEN.get(stage, ())}
        assert "too long to be repeated here" in there_is or all(text in there_is for text in given), stage


GIVEN = {"lagrangian": [("𝒦", "K"), ("𝒫", "P")], "torque": [("ℒ", "L")], "vectorized": [("τ₁", "tau1")]}
"""What a stage starts from, as far as it is no matrix."""


@cache
def _results(problem: str, stage: str) -> set[str]:
    """What comes out of a stage: right-hand sides that say something, entries of matrices too."""
    solution = solved(problem)
    found: set[str] = set()
    for step in solution.explain([stage]):
        if step.id in ("dh", "skew", "model"):
            continue
        for node in step.result:
            right = node.parts[-1] if isinstance(node, Relation) else node
            entries = [e for row in right.rows for e in row] if isinstance(right, Matrix) else [right]
            found |= {to_unicode(entry, solution.style) for entry in entries}
    return {text for text in found if re.search(r"[θqLdmI].*[-+ ].*[₀-₉]", text) and len(text) > 12}


@pytest.mark.slow
@pytest.mark.parametrize("stage", COURSE)
def test_every_stage_says_what_there_is_what_to_do_and_what_to_look_out_for(stage: str) -> None:
    ran = dynsolve("solve", "in3140-rp", "--hint", stage)
    assert ran.code == 0 and not ran.err
    assert "You have" in ran.out and "1. " in ran.out and "Look out:" in ran.out
    assert "Verified" not in ran.out


def test_formulas_and_inputs_of_this_robot() -> None:
    energy = hint("in3140-rp", "energy")
    assert "K_ω1 = ½ (𝐈₁)_zz 𝛚₁ᵀ 𝛚₁" in energy and "𝐉_v2 = 𝐉_v " in energy  # the mass is at the tip
    assert "𝐫_c2 = ⎢L₂ s₁⎥" in energy  # what the stage before has given
    assert "θ̇₁²" not in energy
    torque = hint("in3140-rp", "torque")
    assert "ℒ = ½ ((m₂ L₂² + I_1zz) θ̇₁² + m₂ L̇₂²) - m₁ g L₁/2 - m₂ g L₁" in torque and "θ̈₁" not in torque
    assert "What drives θ₁ is a torque; what drives L₂ a force." in torque


def test_it_does_not_tell_what_is_zero() -> None:
    """The slope of P, Christoffel symbols that vanish, a mass centre that stands still are results."""
    for stage in COURSE:
        for problem in ("in3140-rp", "cartesian-pp"):
            text = " ".join(hint(problem, stage).split())
            for words in ("so g is zero", "does not move.", "Zero:", "is constant, so", "at rest here"):
                assert words not in text, (problem, stage, words)


def test_pitfalls_are_those_of_the_robot() -> None:
    assert "The angle of row 1 is θ₁⋆ + 90°" in hint("in3140-rp", "kinematics")
    assert "Craig's convention" in hint("rp-vertical", "kinematics")
    assert "torque" not in hint("cartesian-pp", "torque")
    assert "chain rule" in hint("planar-2r", "torque")
    assert "counts for each coordinate in it" in " ".join(hint("planar-2r-remote", "jacobian").split())
    assert "point" not in hint("elbow-3r", "energy").partition("Look out:")[2]


@pytest.mark.slow
def test_a_robot_without_masses_has_no_energies() -> None:
    ran = dynsolve("solve", "-", "--hint", "energy", stdin="dh: [{theta: q1*, a: l1}]")
    assert ran.code == 2 and "no body has mass" in ran.err
    assert dynsolve("solve", "-", "--hint", "jacobian", stdin="dh: [{theta: q1*, a: l1}]").code == 0


def test_an_unknown_stage_is_a_usage_error() -> None:
    assert dynsolve("solve", "in3140-rp", "--hint", "dynamics").code == 2


@pytest.mark.slow
def test_a_hint_goes_where_it_is_sent(tmp_path: Path) -> None:
    page = tmp_path / "hint.html"
    ran = dynsolve("solve", "in3140-rp", "--hint", "torque", "-o", str(page))
    assert ran.code == 0 and not ran.out
    text = page.read_text(encoding="utf-8")
    assert "You have the Lagrangian" in text and "Verified" not in text
    assert dynsolve("solve", "in3140-rp", "--hint", "torque", "--markdown").out.startswith("# RP manipulator")


@pytest.mark.parametrize("words", [("--json",), ("--stage", "torque"), ("--from", "energy")])
def test_a_hint_is_no_data_and_of_one_stage(words: tuple[str, ...]) -> None:
    ran = dynsolve("solve", "in3140-rp", "--hint", "torque", *words)
    assert ran.code == 2 and not ran.out
    assert "--hint is a text on one stage; it does not go with" in ran.err
