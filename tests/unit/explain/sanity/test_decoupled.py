"""What decouples a mechanism: the relation between parameters with which D is diagonal."""

from __future__ import annotations

import pytest
import sympy

import dynsolve
from dynsolve.notation.unicode import to_unicode

FIVE_BAR = "five-bar"
"""Spong, Hutchinson, Vidyasagar (2006), section 7.4: m₃ l₂ l_c3 = m₄ l₁ l_c4 decouples it."""


def _told(problem: str) -> str:
    steps = {step.id: step for step in dynsolve.solve(problem).explain()}
    if "decoupled" not in steps:
        return ""
    parts = steps["decoupled"].outcome
    return "".join(part if isinstance(part, str) else to_unicode(part) for part in parts)


def test_the_condition_of_the_book_makes_the_five_bar_two_pendulums() -> None:
    told = _told(FIVE_BAR)
    assert told.startswith("Where m₄ l₁ l_c4 = m₃ l₂ l_c3, D is diagonal")
    assert "the same in all" in told
    solution = dynsolve.solve(FIVE_BAR)
    known = {symbol.name: symbol for symbol in solution.D.free_symbols}
    m4 = known["m3"] * known["l2"] * known["lc3"] / (known["l1"] * known["lc4"])
    decoupled = solution.D.subs(known["m4"], m4).applyfunc(sympy.simplify)
    assert decoupled.is_diagonal()
    assert not {known["q1"], known["q2"]} & decoupled.free_symbols


@pytest.mark.parametrize("problem", ["planar-2r", "elbow-3r", "in3140-rp", "furuta-pendulum"])
def test_nothing_is_said_where_no_relation_of_positive_parameters_does_it(problem: str) -> None:
    assert _told(problem) == ""


SLIDERS = """
gravity: none
model:
  coordinates: {x: prismatic, y: prismatic}
  bodies: [{mass: M, at: [x + y, 0, 0]}, {mass: m, at: [x - y, 0, 0]}]
"""


def test_what_is_assumed_is_not_put_aside_nor_what_is_constant_told_again() -> None:
    told = _told(SLIDERS)
    assert told.startswith("Where M = m, D is diagonal") and "constant" not in told
    assert _told(f"{SLIDERS}assume: [M > m]\n") == ""
