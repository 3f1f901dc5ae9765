"""The inertia at the task, and λ, as they are printed: positive denominators, mirror entries alike."""

from __future__ import annotations

import dynsolve
from dynsolve.notation import tree
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem import read_problem

THREE = """
gravity: none
dh: [{theta: q1*, a: l}, {theta: q2*, a: l}, {theta: q3*, a: l}]
masses: [{mass: m, link: 1}, {mass: m, link: 2}, {mass: m, link: 3}]
find: [Lambda]
"""
SLOT = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l}, {theta: q2*, a: l}]
masses:
  - {mass: m, link: 1, center: midpoint, shape: {rod: {length: l}}}
  - {mass: m, link: 2, center: midpoint, shape: {rod: {length: l}}}
constraints: [tip.y]
find: [lambda]
"""


def test_entries_along_x_and_y_have_one_form() -> None:
    """Sines and cosines of q₁ + q₂ + q₃ exchanged, and s₂² + s₃² below both."""
    form = dynsolve.solve(read_problem(THREE)).forms("Lambda")
    assert isinstance(form, tree.Matrix)
    (first, _), (_, last) = form.rows
    alpha = "(q₁ + q₂ + q₃)"
    assert to_unicode(first) == (f"m (1 + cos²{alpha}) + m cos²{alpha} cos²(q₃)/(sin²(q₂) + sin²(q₃))")
    assert to_unicode(last) == to_unicode(first).replace(f"cos²{alpha}", f"sin²{alpha}")


def test_a_divisor_that_is_negative_at_every_state_is_turned_round() -> None:
    """3 c₁ c₁₂ c₂ - c₁² - 4c₁₂² is negative, and without a term in which nothing moves."""
    text = to_unicode(dynsolve.solve(read_problem(SLOT)).forms("lambda"))
    assert "(cos²(q₁) - 3cos(q₁) cos(q₁ + q₂) cos(q₂) + 4cos²(q₁ + q₂))" in text
