"""Answers of the Newton-Euler recursions: what leads to them, and gravity counted in either way."""

from __future__ import annotations

import pytest

from dynsolve.answers.verdict import Verdict
from dynsolve.quantities.index import quantities
from dynsolve.questions.newton_euler.judge import WITH_GRAVITY, WITHOUT_GRAVITY
from tests.unit.answers.hands import judge, judged, problem, verdicts

PENDULUM = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l}]
masses: [{mass: m, link: 1, center: {near: [lc, 0, 0]}, inertia: {zz: I}}]
find: [wl1, wdl1, acl1, fl1, nl1, tau]
"""
MODIFIED = """
convention: modified
gravity: [0, -g, 0]
dh: [{theta: q1*}]
masses: [{mass: m, link: 1, center: [lc, 0, 0], inertia: {zz: I}}]
find: [wl1, wdl1, acl1, fl1, nl1, tau]
"""
STILL = [["-lc*q1_dot^2"], ["lc*q1_ddot"], ["0"]]
LIFTED = [["-lc*q1_dot^2 + g*sin(q1)"], ["lc*q1_ddot + g*cos(q1)"], ["0"]]


@pytest.mark.parametrize(
    ("text", "acceleration", "verdict", "note"),
    [
        (PENDULUM, STILL, Verdict.CORRECT, None),
        (PENDULUM, LIFTED, Verdict.CORRECT, WITH_GRAVITY),
        (MODIFIED, LIFTED, Verdict.CORRECT, None),
        (MODIFIED, STILL, Verdict.CORRECT, WITHOUT_GRAVITY),
        (PENDULUM, [["-lc*q1_dot^2 - g*sin(q1)"], ["lc*q1_ddot - g*cos(q1)"], ["0"]], Verdict.WRONG, None),
        (PENDULUM, [["lc*q1_dot^2"], ["lc*q1_ddot"], ["0"]], Verdict.WRONG, None),
    ],
)
def test_gravity_may_be_an_acceleration_of_the_base(
    text: str, acceleration: list[list[str]], verdict: Verdict, note: str | None
) -> None:
    found = judged(text, "acl1", acceleration)
    assert found.verdict is verdict
    assert [text for text in found.notes if text in (WITH_GRAVITY, WITHOUT_GRAVITY)] == (
        [] if note is None else [note]
    )


def test_a_slip_is_followed_to_the_torque() -> None:
    """Where the weight is forgotten in n, the torque is what that n gives."""
    moment = [["0"], ["0"], ["(m*lc^2 + I)*q1_ddot"]]
    report = judge(PENDULUM, {"nl1": moment, "tau": [["(m*lc^2 + I)*q1_ddot"]]})
    assert verdicts(report)["nl1"] == "wrong"
    assert verdicts(report)["tau"] == "follows"


def test_other_letters_are_read() -> None:
    known = quantities(problem(PENDULUM).robot).spellings
    assert (known["n1"], known["ac1"], known["alpha1"]) == (("nl1",), ("acl1",), ("wdl1",))
