"""What follows from the student's own answers, by whatever way leads there."""

from __future__ import annotations

import pytest

from dynsolve.answers.answer_verdict import NOT_FROM_OWN
from tests.unit.answers.hands import (
    judge,
    verdicts,
)
from tests.unit.answers.judging.elbow import D11, D12, D22, ELBOW, G1, G2, RP, TAU1, TAU2, H, K, column

WRONG_TAU = column(f"{TAU1} + m1*q2_ddot + m2*l1*q1_dot^3 + m1*g", f"2*({TAU2})")


def test_D_C_and_g_follow_from_a_wrong_tau() -> None:
    report = judge(ELBOW, {
        "tau": WRONG_TAU,
        "D": [[D11, f"{D12} + m1"], [f"2*({D12})", f"2*({D22})"]],
        "C": [[f"{H}*q2_dot + m2*l1*q1_dot^2", f"{H}*(q1_dot + q2_dot)"], [f"-2*{H}*q1_dot", "0"]],
        "g": column(f"{G1} + m1*g", f"2*{G2}"),
    })  # fmt: skip
    assert verdicts(report) == {"tau": "wrong", "D": "follows", "C": "follows", "g": "follows"}
    assert report.first_wrong == "tau"
    assert {a.name: a.follows_from for a in report.answers if a.follows_from} == {
        "D": ("tau",), "C": ("tau",), "g": ("tau",),
    }  # fmt: skip


def test_nothing_follows_from_a_tau_that_is_not_linear() -> None:
    report = judge(ELBOW, {
        "tau": column(f"{TAU1} + m1*q2_ddot^2", TAU2), "D": [[D11, f"{D12} + 2*m1*q2_ddot"], [D12, D22]],
    })  # fmt: skip
    assert verdicts(report)["D"] == "wrong"


def test_D_follows_from_K_and_C_from_D() -> None:
    report = judge(ELBOW, {
        "K": f"{K} + m1*l1^2*cos(q2)*q1_dot^2/2",
        "D": [[f"{D11} + m1*l1^2*cos(q2)", D12], [D12, D22]],
        "C": [[f"{H}*q2_dot - m1*l1^2*sin(q2)*q2_dot/2", f"{H}*(q1_dot + q2_dot) - m1*l1^2*sin(q2)*q1_dot/2"],
              [f"-{H}*q1_dot + m1*l1^2*sin(q2)*q1_dot/2", "0"]],
    })  # fmt: skip
    found = {a.name: a for a in report.answers}
    assert (found["D"].verdict, found["D"].follows_from) == ("follows", ("K",))
    assert (found["C"].verdict, found["C"].follows_from) == ("follows", ("D",))


def test_g_follows_from_P() -> None:
    wrong = "m1*g*l1*sin(q1) + m2*g*(l1*sin(q1) + lc2*sin(q1 + q2))"
    report = judge(ELBOW, {"P": wrong, "g": column(G1.replace("lc1", "l1"), G2)})
    found = {a.name: a for a in report.answers}
    assert (found["g"].verdict, found["g"].follows_from) == ("follows", ("P",))


def test_a_slip_is_followed_through_answers_that_were_not_handed_in() -> None:
    """From r_c1 at the end of the link to g, with neither P nor tau in between."""
    report = judge(ELBOW, {"rc1": column("l1*cos(q1)", "l1*sin(q1)", "0"),
                           "g": column(G1.replace("lc1", "l1"), G2)})  # fmt: skip
    found = {a.name: a for a in report.answers}
    assert (found["g"].verdict, found["g"].follows_from) == ("follows", ("rc1",))


def test_what_is_correct_against_the_students_own_slip_is_noted() -> None:
    report = judge(ELBOW, {"P": "m1*g*l1*sin(q1) + m2*g*(l1*sin(q1) + lc2*sin(q1 + q2))",
                           "g": column(G1, G2)})  # fmt: skip
    found = {a.name: a for a in report.answers}
    assert (found["g"].verdict, found["g"].notes) == ("correct", (NOT_FROM_OWN,))


def test_a_slip_that_changes_nothing_is_not_noted() -> None:
    report = judge(RP, {"P": "m2*g*L1", "g": column("0", "0")})
    assert next(a for a in report.answers if a.name == "g").notes == ()


# -- parts and wholes ------------------------------------------------------------------------------


def test_a_whole_is_judged_by_its_parts() -> None:
    report = judge(ELBOW, {"d11": D11, "d12": D12, "d21": D12, "d22": f"2*({D22})",
                           "tau1": TAU1, "tau2": TAU2, "g1": G1})  # fmt: skip
    found = verdicts(report)
    assert (found["D"], found["tau"], found["g"], found["C"]) == ("wrong", "correct", "missing", "missing")


def test_one_half_of_a_symmetric_matrix_is_enough() -> None:
    assert verdicts(judge(ELBOW, {"d11": D11, "d12": D12, "d22": D22}))["D"] == "correct"


def test_C_follows_from_a_D_given_by_its_entries() -> None:
    report = judge(ELBOW, {
        "d11": f"{D11} + m1*l1^2*cos(q2)", "d12": D12, "d22": D22,
        "C": [[f"{H}*q2_dot - m1*l1^2*sin(q2)*q2_dot/2", f"{H}*(q1_dot + q2_dot) - m1*l1^2*sin(q2)*q1_dot/2"],
              [f"-{H}*q1_dot + m1*l1^2*sin(q2)*q1_dot/2", "0"]],
    })  # fmt: skip
    found = {a.name: a for a in report.answers}
    assert (found["C"].verdict, found["C"].follows_from) == ("follows", ("d11",))


@pytest.mark.parametrize("c22", ["0", f"-{H}*q1_dot/2"])
def test_C_follows_from_a_D_that_is_not_symmetric(c22: str) -> None:
    """A slip in d12 alone, which stands for d21 too, or each d_ij is taken from its own place."""
    report = judge(ELBOW, {
        "D": [[D11, f"2*({D12})"], [D12, D22]],
        "C": [[f"2*{H}*q2_dot", f"2*{H}*q2_dot"], [f"-{H}*q1_dot", c22]],
    })  # fmt: skip
    found = {a.name: a for a in report.answers}
    assert (found["C"].verdict, found["C"].follows_from) == ("follows", ("D",))
