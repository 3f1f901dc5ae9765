"""Of a planar robot the rows that are zero for every q may be left out; of no other."""

from __future__ import annotations

import pytest

from tests.unit.answers.hands import Text, codes, judge, judged, verdicts

ELBOW, RP, SPATIAL = "planar-2r", "in3140-rp", "elbow-3r"
JV = [["-l1*sin(q1) - l2*sin(q1+q2)", "-l2*sin(q1+q2)"], ["l1*cos(q1) + l2*cos(q1+q2)", "l2*cos(q1+q2)"]]
JV1 = [["-lc1*sin(q1)", "0"], ["lc1*cos(q1)", "0"]]
TIP_RP = [["-sin(theta1)*L2", "cos(theta1)"], ["cos(theta1)*L2", "sin(theta1)"]]


@pytest.mark.parametrize(
    ("stem", "name", "text", "verdict"),
    [
        (ELBOW, "Jv", JV, "correct"),
        (ELBOW, "Jv", JV[::-1], "wrong"),
        (ELBOW, "Jv", [JV[0], ["0", "0"]], "wrong"),
        (ELBOW, "Jv", [JV[0]], "wrong"),
        (ELBOW, "J", [*JV, ["1", "1"]], "correct"),
        (ELBOW, "J", [*JV, ["1", "0"]], "wrong"),
        (ELBOW, "J", [["1", "1"], *JV], "wrong"),
        (ELBOW, "J", JV, "wrong"),
        (ELBOW, "Jw", [["1", "1"]], "correct"),
        (ELBOW, "Jw", [["1", "-1"]], "wrong"),
        (ELBOW, "Jw1", [["1", "0"]], "correct"),
        (ELBOW, "Jw", [["0", "0"], ["1", "1"]], "wrong"),
        (ELBOW, "Jv1", JV1, "correct"),
        (ELBOW, "Jv1", [JV1[0], ["l1*cos(q1)", "0"]], "wrong"),
        (ELBOW, "rc1", [["lc1*cos(q1)"], ["lc1*sin(q1)"]], "correct"),
        (ELBOW, "rc1", [["lc1*cos(q1)", "lc1*sin(q1)"]], "correct"),
        (ELBOW, "rc1", [["lc1*cos(q1)"], ["0"]], "wrong"),
        (ELBOW, "v1", [["-lc1*sin(q1)*q1_dot"], ["lc1*cos(q1)*q1_dot"]], "correct"),
        (ELBOW, "v1", [["lc1*sin(q1)*q1_dot"], ["lc1*cos(q1)*q1_dot"]], "wrong"),
        (RP, "Jv", TIP_RP, "correct"),
        (RP, "J", [*TIP_RP, ["1", "0"]], "correct"),
        (RP, "rc2", [["cos(theta1)*L2"], ["sin(theta1)*L2"]], "wrong"),  # the height is L1, not 0
        ("cylindrical-rpp", "Jw", [["1", "0", "0"]], "wrong"),
        (SPATIAL, "v1", [["0"], ["0"]], "wrong"),
        (SPATIAL, "Jw", [["1", "0", "0"]], "wrong"),
    ],
)  # fmt: skip
def test_rows_of_zeros(stem: str, name: str, text: Text, verdict: str) -> None:
    found = judged(stem, name, text)
    assert found.verdict == verdict
    if stem not in (ELBOW, RP):
        assert codes(found) == ["shape"]


def test_what_comes_after_a_vector_of_the_plane_follows() -> None:
    slip = [["-l1*sin(q1)*q1_dot"], ["l1*cos(q1)*q1_dot"]]
    found = verdicts(judge(ELBOW, {"v1": slip, "Kv1": "m1*l1^2*q1_dot^2/2"}))
    assert (found["v1"], found["Kv1"]) == ("wrong", "follows")
