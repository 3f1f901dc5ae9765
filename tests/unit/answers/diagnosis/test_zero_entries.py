"""A 0 for an entry that has gravity: it shows that gravity is left out there, and no step long before."""

from __future__ import annotations

import pytest

from tests.unit.answers.hands import judged

G = ["m1*g*lc1*cos(q1) + m2*g*(l1*cos(q1) + lc2*cos(q1 + q2))", "m2*g*lc2*cos(q1 + q2)"]
TURNED = ["-(m1*g*lc1*cos(q1) + m2*g*(l1*cos(q1) + lc2*cos(q1 + q2)))", "-m2*g*lc2*cos(q1 + q2)"]


@pytest.mark.parametrize(("written", "messages"), [
    ([G[0], "0"], ["Entry 2: Gravity is left out."]),
    (["0", G[1]], ["Entry 1: Gravity is left out."]),
    (["0", "0"], ["Gravity is left out."]),
    ([TURNED[0], G[1]], ["Entry 1: The terms with gravity have the wrong sign."]),
    (TURNED, ["The terms with gravity have the wrong sign."]),
    (["m1*g*lc1*cos(q1)", "0"], ["The contribution of body 2 to P is left out."]),
])  # fmt: skip
def test_what_is_told_of_a_vector_of_gravity(written: list[str], messages: list[str]) -> None:
    answer = judged("planar-2r", "g", [[entry] for entry in written])
    assert [one.message for one in answer.diagnosis] == messages
