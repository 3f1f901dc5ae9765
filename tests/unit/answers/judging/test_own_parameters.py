"""Pairs (Y, a) are right by their product; each half is right where another half belongs to it."""

from __future__ import annotations

import pytest

from tests.unit.answers.hands import Text, codes, judge, judged, verdicts

ARM = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses:
  - {mass: m1, link: 1, center: {near: [lc1, 0, 0]}, inertia: {zz: I1}}
  - {mass: m2, link: 2, center: {near: [lc2, 0, 0]}, inertia: {zz: I2}}
parameters: {known: [g]}
find: [tau, Y, a]
"""
FIRST = "cos(q2)*(2*q1_ddot + q2_ddot) - sin(q2)*(2*q1_dot*q2_dot + q2_dot^2)"
SECOND = "cos(q2)*q1_ddot + sin(q2)*q1_dot^2"
SPONG_Y: Text = [
    ["q1_ddot", FIRST, "q2_ddot", "g*cos(q1)", "g*cos(q1 + q2)"],
    ["0", SECOND, "q1_ddot + q2_ddot", "0", "g*cos(q1 + q2)"],
]
SPONG_A: Text = [
    ["m1*lc1^2 + m2*(l1^2 + lc2^2) + I1 + I2"], ["m2*l1*lc2"], ["m2*lc2^2 + I2"],
    ["m1*lc1 + m2*l1"], ["m2*lc2"],
]  # fmt: skip
"""Spong, Hutchinson, Vidyasagar (2006), section 7.5.3, equations (7.145) to (7.149)."""


def put(rows: Text, i: int, j: int, entry: str) -> Text:
    assert isinstance(rows, list)
    return [[entry if (k, m) == (i, j) else e for m, e in enumerate(row)] for k, row in enumerate(rows)]


def test_the_pair_of_the_book() -> None:
    found = verdicts(judge(ARM, {"Y": SPONG_Y, "a": SPONG_A}))
    assert (found["Y"], found["a"]) == ("correct", "correct")


@pytest.mark.parametrize(("name", "value"), [("Y", SPONG_Y), ("a", SPONG_A)])
def test_each_half_by_itself(name: str, value: Text) -> None:
    assert judged(ARM, name, value).verdict == "correct"


def test_a_longer_pair_is_right_and_hears_of_it() -> None:
    Y: Text = [["q1_ddot", *SPONG_Y[0]], ["0", *SPONG_Y[1]]]  # type: ignore[list-item]
    a: Text = [["I1"], ["m1*lc1^2 + m2*(l1^2 + lc2^2) + I2"], *SPONG_A[1:]]  # type: ignore[list-item]
    report = judge(ARM, {"Y": Y, "a": a})
    assert verdicts(report)["Y"] == verdicts(report)["a"] == "correct"
    found = next(answer for answer in report.answers if answer.name == "a")
    assert found.notes == ("these are 6 parameters; 5 are enough",)


def test_parameters_that_depend_on_each_other_leave_y_open() -> None:
    Y: Text = [["q1_ddot", "q2_ddot", "0", *SPONG_Y[0][1:2], *SPONG_Y[0][3:]],
               ["q2_ddot", "q1_ddot", "0", *SPONG_Y[1][1:2], *SPONG_Y[1][3:]]]  # fmt: skip
    a: Text = [["m1*lc1^2 + m2*l1^2 + I1 + I2 + m2*lc2^2"], ["I2 + m2*lc2^2"], ["m1*lc1^2 + m2*l1^2 + I1"],
               ["m2*l1*lc2"], ["m1*lc1 + m2*l1"], ["m2*lc2"]]  # fmt: skip
    right = put(put(Y, 1, 0, "0"), 1, 1, "q1_ddot + q2_ddot")
    assert verdicts(judge(ARM, {"Y": right, "a": a}))["Y"] == "correct"
    moved = put(put(put(right, 0, 0, "0"), 0, 1, "q1_ddot + q2_ddot"), 0, 2, "q1_ddot")
    assert verdicts(judge(ARM, {"Y": moved, "a": a}))["Y"] == "correct"
    assert verdicts(judge(ARM, {"Y": Y, "a": a}))["Y"] == "wrong"


def test_where_a_is_right_y_is_compared_with_its_own() -> None:
    Y = put(SPONG_Y, 0, 1, FIRST.replace("2*q1_ddot", "q1_ddot"))
    found = judged(ARM, "Y", Y, a=SPONG_A)
    assert found.verdict == "wrong"
    assert [entry.index for entry in found.entries if entry.verdict == "wrong"] == [(1, 2)]
    assert codes(found) == ["factor"]


def test_where_y_is_right_a_is_compared_with_its_own() -> None:
    a = put(SPONG_A, 3, 0, "m1*lc1")
    report = judge(ARM, {"Y": SPONG_Y, "a": a})
    assert verdicts(report)["Y"] == "correct"
    found = next(answer for answer in report.answers if answer.name == "a")
    assert [entry.index for entry in found.entries if entry.verdict == "wrong"] == [(4, 1)]


def test_parameters_by_themselves_that_are_too_few() -> None:
    found = judged(ARM, "a", SPONG_A[:4])
    assert (found.verdict, codes(found)) == ("wrong", ["parameters"])
    assert "m₂ l_c2" in found.diagnosis[0].message
    moving = judged(ARM, "a", put(SPONG_A, 4, 0, "m2*lc2*cos(q1)"))
    assert "moves" in moving.diagnosis[0].message


def test_what_follows_from_the_students_own_forces() -> None:
    tau: Text = [
        [f"(m1*lc1^2 + m2*(l1^2 + lc2^2) + I1)*q1_ddot + m2*l1*lc2*({FIRST}) + m2*lc2^2*q2_ddot"
         " + (m1*lc1 + m2*l1)*g*cos(q1) + m2*lc2*g*cos(q1 + q2)"],
        [f"m2*l1*lc2*({SECOND}) + m2*lc2^2*(q1_ddot + q2_ddot) + m2*lc2*g*cos(q1 + q2)"],
    ]  # fmt: skip
    a: Text = [["m1*lc1^2 + m2*l1^2 + I1"], ["m2*lc2^2"], *SPONG_A[1:2], *SPONG_A[3:]]
    Y: Text = [
        ["q1_ddot", "q1_ddot + q2_ddot", FIRST, "g*cos(q1)", "g*cos(q1 + q2)"],
        ["0", "q1_ddot + q2_ddot", SECOND, "0", "g*cos(q1 + q2)"],
    ]
    found = verdicts(judge(ARM, {"tau": tau, "a": a, "Y": Y}))
    assert (found["tau"], found["a"]) == ("wrong", "follows")
    assert found["Y"] in ("correct", "follows")


def test_given_parameters_are_judged_entry_by_entry() -> None:
    given = ARM.replace("{known: [g]}", "{known: [g], p1: m1*lc1^2 + m2*l1^2 + I1, p2: m2*lc2^2 + I2, "
                        "p3: m2*l1*lc2, p4: m1*lc1 + m2*l1, p5: m2*lc2}")  # fmt: skip
    assert judged(given, "a", SPONG_A).verdict == "wrong"
    assert judged(given, "Y", SPONG_Y).verdict == "wrong"
    Y: Text = [
        ["q1_ddot", "q1_ddot + q2_ddot", FIRST, "g*cos(q1)", "g*cos(q1 + q2)"],
        ["0", "q1_ddot + q2_ddot", SECOND, "0", "g*cos(q1 + q2)"],
    ]
    assert judged(given, "Y", Y).verdict == "correct"


REFERENCES = ARM.replace("find: [tau, Y, a]", "find: [Yr, a]")
WITH_REFERENCES: Text = [
    ["q1r_ddot", "cos(q2)*(2*q1r_ddot + q2r_ddot) - sin(q2)*(q2_dot*q1r_dot + (q1_dot + q2_dot)*q2r_dot)",
     "q2r_ddot", "g*cos(q1)", "g*cos(q1 + q2)"],
    ["0", "cos(q2)*q1r_ddot + sin(q2)*q1_dot*q1r_dot", "q1r_ddot + q2r_ddot", "0", "g*cos(q1 + q2)"],
]  # fmt: skip


def test_reference_rates() -> None:
    found = judge(REFERENCES, {"Yr": WITH_REFERENCES, "a": SPONG_A})
    assert verdicts(found) == {"Yr": "correct", "a": "correct"}
    assert judged(REFERENCES, "Yr", WITH_REFERENCES).verdict == "correct"


def test_another_c_that_keeps_the_product_but_is_not_skew_is_wrong() -> None:
    other = put(
        WITH_REFERENCES, 0, 1, "cos(q2)*(2*q1r_ddot + q2r_ddot) - sin(q2)*(2*q1_dot + q2_dot)*q2r_dot"
    )
    found = judged(REFERENCES, "Yr", other, a=SPONG_A)
    assert found.verdict == "wrong"


def test_another_skew_c_is_right() -> None:
    """With S skew and S q̇ = 0, C + S is as good as C: three coordinates have such an S."""
    problem = """
gravity: none
dh: [{d: d1*, alpha: 90deg}, {theta: 90deg, d: d2*, alpha: 90deg}, {d: d3*}]
masses: [{mass: m, link: 3, center: origin}]
find: [Yr, a]
"""
    plain: Text = [["d1r_ddot"], ["d2r_ddot"], ["d3r_ddot"]]
    turned: Text = [
        ["d1r_ddot + d3_dot*d2r_dot - d2_dot*d3r_dot"],
        ["d2r_ddot - d3_dot*d1r_dot + d1_dot*d3r_dot"],
        ["d3r_ddot + d2_dot*d1r_dot - d1_dot*d2r_dot"],
    ]
    assert judged(problem, "Yr", plain, a=[["m"]]).verdict == "correct"
    found = judged(problem, "Yr", turned, a=[["m"]])
    assert found.verdict == "correct"
    assert found.notes == ("right with another choice of C than Christoffel's",)
    assert judged(problem, "Yr", put(turned, 0, 0, "d1r_ddot + d2_dot*d3r_dot"), a=[["m"]]).verdict == "wrong"
