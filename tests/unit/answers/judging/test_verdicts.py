"""The verdicts, rule by rule."""

from __future__ import annotations

import pytest

from dynsolve.answers.answer_verdict import NOT_CHRISTOFFEL
from dynsolve.answers.judge import check
from dynsolve.answers.verdict import Submission
from tests.unit.answers.hands import (
    Text,
    answer,
    codes,
    judge,
    judged,
    key,
    problem,
    verdicts,
)
from tests.unit.answers.judging.elbow import D11, D12, D22, ELBOW, G1, G2, RP, TAU1, TAU2, H, K, P, column

RIGHT: list[tuple[str, str, Text]] = [
    (ELBOW, "D", [[D11, D12], [D12, D22]]),
    (ELBOW, "d21", D12),
    (ELBOW, "g", column(G1, G2)),
    (ELBOW, "g", [[G1, G2]]),
    (ELBOW, "g1", G1),
    (ELBOW, "tau", column(TAU1, TAU2)),
    (ELBOW, "tau2", TAU2),
    (ELBOW, "K", K),
    (ELBOW, "P", P),
    (ELBOW, "g2", "m2*lc2*g*(cos(q1)*cos(q2) - sin(q1)*sin(q2))"),
    (ELBOW, "g2", "m2*lc2*g*(2*cos(q1/2 + q2/2)^2 - 1)"),
    (ELBOW, "g2", "m2*lc2*g*(1 - tan((q1+q2)/2)^2)/(1 + tan((q1+q2)/2)^2)"),
    (ELBOW, "g2", "m2*lc2*g*sin(q1 + q2 + 90deg)"),
    (ELBOW, "g2", "m2*lc2*g*sin(q1 + q2)/tan(q1 + q2)"),
    (ELBOW, "g2", "(m2^2 - 4*I1^2)*lc2*g*cos(q1 + q2)/(m2 - 2*I1) - 2*I1*lc2*g*cos(q1+q2)"),
    (ELBOW, "d12", "m2*lc2^2 + 0.5*l1*lc2*m2*(cos(q2) + cos(-q2)) + I2"),
    (ELBOW, "C", [[f"{H}*q2_dot", f"{H}*(q1_dot + q2_dot)"], [f"-{H}*q1_dot", "0"]]),
    (ELBOW, "C12", f"{H}*(q1_dot + q2_dot)"),
    (ELBOW, "c121", H),
    (ELBOW, "c211", H),
    (ELBOW, "c112", f"-{H}"),
    (ELBOW, "Cqd", column(f"{H}*(2*q1_dot*q2_dot + q2_dot^2)", f"-{H}*q1_dot^2")),
    (RP, "v1", "0"),
    (RP, "rc2", column("cos(theta1)*L2", "sin(theta1)*L2", "L1")),
    (RP, "rc2", column("cos(theta1)*L2", "sin(theta1)*L2", "L1", "1")),
    (RP, "f2", "m2*L2_ddot - m2*L2*theta1_dot^2*(sin(theta1)^2 + cos(theta1)^2)"),
    (RP, "J", [["-sin(theta1)*L2", "cos(theta1)"], ["cos(theta1)*L2", "sin(theta1)"], ["0", "0"],
               ["0", "0"], ["0", "0"], ["1", "0"]]),
]  # fmt: skip


@pytest.mark.parametrize(("stem", "name", "text"), RIGHT, ids=lambda x: str(x)[:40])
def test_what_is_right_is_correct_in_any_dress(stem: str, name: str, text: Text) -> None:
    answer = judged(stem, name, text)
    assert (answer.verdict, answer.fault) == ("correct", "")


@pytest.mark.parametrize(
    ("stem", "name", "text"),
    [
        (ELBOW, "g2", "m2*lc2*g*cos(q1*q2)"),
        (ELBOW, "g2", "m2*lc2*g*cos(q1_dot)"),
        (ELBOW, "g2", "m2*lc2*g*cos(q1 + q2) + 1e-9"),
        (ELBOW, "g2", "m2*lc2*g*cos(90)"),
        (ELBOW, "g2", "m3*lc2*g*cos(q1 + q2)"),
        (ELBOW, "g2", "m2*lc2*g*cos(q1 + q2)/l1"),
        (ELBOW, "g2", "m2*lc2*g*sqrt(cos(q1 + q2)^2)"),
        (ELBOW, "c121", f"2*{H}"),
    ],
)
def test_what_is_not_is_wrong_and_never_unreadable(stem: str, name: str, text: str) -> None:
    assert judged(stem, name, text).verdict == "wrong"


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("m1/(sin(q1)^2 + cos(q1)^2 - 1)", "denominator is zero"),
        ("m1*tan(90deg)", "denominator is zero"),
        ("sqrt(-2)*m1", "root of a negative number"),
        ("cos(20*q1)^8*cos(20*q2)^8", "large"),
        ("cos(q1/20)", "finely"),
        ("+".join(f"x{i}" for i in range(80)), "too many names"),
    ],
)
def test_what_cannot_be_worked_out_is_unreadable(text: str, says: str) -> None:
    answer = judged(ELBOW, "P", text)
    assert answer.verdict == "unreadable"
    assert says in answer.fault


def test_one_answer_over_a_bound_leaves_the_others_alone() -> None:
    report = judge(ELBOW, {"P1": "cos(q1/20)", "g1": G1, "P2": "m1/(q1 - q1)", "g2": G2})
    assert verdicts(report) | {"D": "", "C": "", "tau": "", "g": ""} == {
        "P1": "unreadable", "P2": "unreadable", "g1": "correct", "g2": "correct",
        "D": "", "C": "", "tau": "", "g": "",
    }  # fmt: skip


def test_any_C_with_the_same_product_is_correct() -> None:
    other = [["0", f"{H}*(2*q1_dot + q2_dot)"], [f"-{H}*q1_dot", "0"]]
    answer = judged(ELBOW, "C", other)
    assert answer.verdict == "correct"
    assert answer.notes == (NOT_CHRISTOFFEL.format("not skew-symmetric"),)
    assert [e.index for e in answer.entries] == [(1,), (2,)]


def test_C_is_judged_by_row() -> None:
    answer = judged(ELBOW, "C", [["0", f"{H}*(2*q1_dot + q2_dot)"], [f"{H}*q1_dot", "0"]])
    assert [str(e.verdict) for e in answer.entries] == ["correct", "wrong"]


def test_C_given_by_its_entries_is_judged_by_row_too() -> None:
    report = judge(ELBOW, {"C11": "0", "C12": f"{H}*(2*q1_dot + q2_dot)", "C21": f"-{H}*q1_dot", "C22": "0"})
    assert {n: v for n, v in verdicts(report).items() if n[0] == "C"} == dict.fromkeys(
        ["C", "C11", "C12", "C21", "C22"], "correct"
    )
    report = judge(ELBOW, {"C11": "0", "C12": f"{H}*(2*q1_dot + q2_dot)", "C21": f"{H}*q1_dot", "C22": "0"})
    assert [verdicts(report)[n] for n in ("C11", "C12", "C21", "C")] == [
        "correct",
        "correct",
        "wrong",
        "wrong",
    ]


def test_a_C_with_accelerations_is_none() -> None:
    answer = judged(ELBOW, "C", [["q2_ddot*q2_dot", f"{H}*(2*q1_dot + q2_dot) - q2_ddot*q1_dot"],
                                 [f"-{H}*q1_dot", "0"]])  # fmt: skip
    assert answer.verdict == "wrong"
    assert codes(answer) == ["acceleration_in_C"]


def test_a_matrix_of_the_wrong_size_is_wrong() -> None:
    assert codes(judged(ELBOW, "D", [[D11, D12]])) == ["shape"]


# -- given more than once --------------------------------------------------------------------------


def _several(*answers: object) -> Submission:
    return Submission("", "", "", tuple(answers))  # type: ignore[arg-type]


def test_of_several_the_last_counts_and_each_is_judged() -> None:
    hand = _several(answer("g2", "0", 0), answer("g2", G2, 1))
    found = next(a for a in check(problem(ELBOW), hand, key(ELBOW)).answers if a.name == "g2")
    assert found.verdict == "correct"
    assert [str(o.verdict) for o in found.occurrences] == ["wrong", "correct"]


def test_in_a_chain_the_slip_is_where_it_first_differs() -> None:
    hand = _several(
        answer("g2", G2, 4, 1), answer("g2", "m2*lc2*g*cos(q1)", 4, 2), answer("g2", "m2*g*lc2*cos(q1)", 4, 3)
    )
    found = next(a for a in check(problem(ELBOW), hand, key(ELBOW)).answers if a.name == "g2")
    assert found.verdict == "wrong"
    assert any(G2 in note for note in found.notes)
