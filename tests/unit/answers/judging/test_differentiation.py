"""Velocities and Jacobians that follow by differentiating the student's own position."""

from __future__ import annotations

import pytest

from tests.unit.answers.hands import judge, verdicts
from tests.unit.answers.judging.elbow import ELBOW, column

ABSOLUTE = {  # the second link as if q2 were counted from the horizontal
    "rc2": column("l1*cos(q1) + lc2*cos(q2)", "l1*sin(q1) + lc2*sin(q2)", "0"),
}
TWICE = {"rc2": column("l1*cos(q1) + lc2*cos(q1 + 2*q2)", "l1*sin(q1) + lc2*sin(q1 + 2*q2)", "0")}
RATES = column("-l1*sin(q1)*q1_dot - lc2*sin(q2)*q2_dot", "l1*cos(q1)*q1_dot + lc2*cos(q2)*q2_dot", "0")
TIP = [
    ["cos(q1 + q2)", "-sin(q1 + q2)", "0", "l1*cos(q1) + l2*cos(q2)"],
    ["sin(q1 + q2)", "cos(q1 + q2)", "0", "l1*sin(q1) + l2*sin(q2)"],
    ["0", "0", "1", "0"],
    ["0", "0", "0", "1"],
]


@pytest.mark.parametrize(("position", "answers"), [
    (ABSOLUTE, {"Jv2": [["-l1*sin(q1)", "-lc2*sin(q2)"], ["l1*cos(q1)", "lc2*cos(q2)"], ["0", "0"]]}),
    (ABSOLUTE, {"v2": RATES}),
    (ABSOLUTE, {"Kv2": "m2*(l1^2*q1_dot^2 + lc2^2*q2_dot^2 + 2*l1*lc2*cos(q1 - q2)*q1_dot*q2_dot)/2"}),
    (TWICE, {"Jv2": [["-l1*sin(q1) - lc2*sin(q1 + 2*q2)", "-2*lc2*sin(q1 + 2*q2)"],
                     ["l1*cos(q1) + lc2*cos(q1 + 2*q2)", "2*lc2*cos(q1 + 2*q2)"], ["0", "0"]]}),
    ({"H2": TIP}, {"Jv": [["-l1*sin(q1)", "-l2*sin(q2)"], ["l1*cos(q1)", "l2*cos(q2)"], ["0", "0"]]}),
    ({"H2": TIP}, {"J": [["-l1*sin(q1)", "-l2*sin(q2)"], ["l1*cos(q1)", "l2*cos(q2)"], ["0", "0"],
                         ["0", "0"], ["0", "0"], ["1", "1"]]}),
])  # fmt: skip
def test_what_is_differentiated_follows(position: dict[str, object], answers: dict[str, object]) -> None:
    (source,), (name,) = position, answers
    found = {answer.name: answer for answer in judge(ELBOW, position | answers).answers}
    assert found[source].verdict == "wrong"
    assert (found[name].verdict, found[name].follows_from) == ("follows", (source,))


@pytest.mark.parametrize("slip", ["lc2*sin(q2)", "-lc2*cos(q2)", "-2*lc2*sin(q2)"])
def test_a_slip_in_differentiating_does_not(slip: str) -> None:
    own = {"Jv2": [["-l1*sin(q1)", slip], ["l1*cos(q1)", "lc2*cos(q2)"], ["0", "0"]]}
    assert verdicts(judge(ELBOW, ABSOLUTE | own))["Jv2"] == "wrong"
