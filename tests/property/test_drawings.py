"""The table of random joint axes moves the hand as these do, and keeps the textbook's rules."""

from __future__ import annotations

import pytest
from hypothesis import assume, given, settings

import dynsolve
from dynsolve.derivation.drawn_motion import TOLERANCE, verify_drawing
from dynsolve.errors import ProblemError, VerificationError
from dynsolve.problem import Problem, read_problem
from tests.drawings import drawings


def read(text: str) -> Problem:
    """The problem of a drawing; one with an angle that cannot be written is passed over."""
    try:
        return read_problem(text)
    except ProblemError as error:
        assume("no number of degrees" in str(error))
        assume(False)
        raise


@settings(deadline=None, max_examples=30)
@given(drawings())
def test_the_table_moves_the_hand_as_the_drawn_axes_do(text: str) -> None:
    problem = read(text)
    forms = dynsolve.solve(problem).forms
    assert problem.normals is not None
    assert verify_drawing(problem.normals, forms(f"H{len(problem.robot.joints)}")) < TOLERANCE


def test_a_table_of_other_axes_is_found_out() -> None:
    axes = "axes: [{turn: q1, about: [0, 0, 1], through: [0, 0, 0]}]\n"
    drawn, other = (
        read_problem(f"{axes}tip: [A, 0, 0]"),
        read_problem("dh: [{theta: q1*, a: A, alpha: 90deg}]"),
    )
    shifted = read_problem("dh: [{theta: q1*, a: B}]")
    assert drawn.normals is not None
    assert verify_drawing(drawn.normals, dynsolve.solve(other).forms("H1")) < TOLERANCE
    with pytest.raises((VerificationError, KeyError)):
        verify_drawing(drawn.normals, dynsolve.solve(shifted).forms("H1"))
