"""The potential energy is right with any zero level, and so is what comes of it."""

from __future__ import annotations

import pytest

from tests.unit.answers.hands import (
    codes,
    judge,
    judged,
    verdicts,
)
from tests.unit.answers.judging.elbow import RP, column


@pytest.mark.parametrize("height", ["h0", "L1", "-L1/2", "(L1 + 3*h0)"])
def test_the_zero_level_is_free(height: str) -> None:
    P1, P2 = f"m1*g*(L1/2 + {height})", f"m2*g*(L1 + {height})"
    report = judge(RP, {"P1": P1, "P2": P2, "P": f"{P1} + {P2}"})
    assert [verdicts(report)[name] for name in ("P1", "P2", "P")] == ["correct"] * 3


@pytest.mark.parametrize("height", ["m1", "g", "L2", "cos(theta1)", "2", "L1^2"])
def test_a_zero_level_is_a_length_and_nothing_else(height: str) -> None:
    answer = judged(RP, "P", f"m1*g*(L1/2 + {height}) + m2*g*(L1 + {height})")
    assert answer.verdict == "wrong"


def test_each_body_has_the_same_zero_level() -> None:
    report = judge(RP, {"P1": "0", "P2": "m2*g*L1", "P": "m2*g*L1"})
    found = {a.name: a for a in report.answers}
    assert (found["P1"].verdict, found["P2"].verdict) == ("wrong", "correct")
    assert "constant_term" in codes(found["P1"])
    assert (found["P"].verdict, found["P"].follows_from) == ("follows", ("P1",))


def test_another_constant_is_wrong_and_the_forces_are_unaffected() -> None:
    tau1 = "(I1zz + m2*L2^2)*theta1_ddot + 2*m2*L2*L2_dot*theta1_dot"
    tau = column(tau1, "m2*L2_ddot - m2*L2*theta1_dot^2")
    report = judge(RP, {"P": "m1*g*L1 + m2*g*L1", "tau": tau})
    found = {a.name: a for a in report.answers}
    assert codes(found["P"])[0] == "constant_term"
    assert (found["tau"].verdict, found["tau"].notes) == ("correct", ())


def test_the_level_of_P_holds_for_L() -> None:
    kinetic = "I1zz*theta1_dot^2/2 + m2*(L2^2*theta1_dot^2 + L2_dot^2)/2"
    shifted = {"P": "-m1*g*L1/2", "L": f"{kinetic} + m1*g*L1/2"}
    assert set(verdicts(judge(RP, shifted)).values()) - {"missing"} == {"correct"}
    mixed = {"P": "-m1*g*L1/2", "L": f"{kinetic} - m1*g*L1/2 - m2*g*L1"}
    assert verdicts(judge(RP, mixed))["L"] == "wrong"
