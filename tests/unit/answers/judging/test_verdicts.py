"""The verdicts, rule by rule."""

from __future__ import annotations

from dataclasses import replace

import pytest

from dynsolve.answers.answer_verdict import NOT_CHRISTOFFEL, NOT_FROM_OWN
from dynsolve.answers.judge import Checker, check
from dynsolve.answers.submission import Submission
from dynsolve.answers.verdict import JudgedAnswer
from dynsolve.notation import tree
from dynsolve.problem.reader import read_problem
from tests.unit.answers.hands import (
    Text,
    answer,
    checker,
    codes,
    judge,
    judged,
    key,
    problem,
    submission,
    verdicts,
)

RP, ELBOW = "in3140-rp", "planar-2r"

D11 = "m1*lc1^2 + m2*(l1^2 + lc2^2 + 2*l1*lc2*cos(q2)) + I1 + I2"
D12 = "m2*(lc2^2 + l1*lc2*cos(q2)) + I2"
D22 = "m2*lc2^2 + I2"
H = "(-m2*l1*lc2*sin(q2))"
G1 = "(m1*lc1 + m2*l1)*g*cos(q1) + m2*lc2*g*cos(q1 + q2)"
G2 = "m2*lc2*g*cos(q1 + q2)"
TAU2 = f"({D12})*q1_ddot + ({D22})*q2_ddot - {H}*q1_dot^2 + {G2}"
TAU1 = f"({D11})*q1_ddot + ({D12})*q2_ddot + {H}*(2*q1_dot*q2_dot + q2_dot^2) + {G1}"
P = "m1*g*lc1*sin(q1) + m2*g*(l1*sin(q1) + lc2*sin(q1 + q2))"
K = f"({D11})*q1_dot^2/2 + ({D12})*q1_dot*q2_dot + ({D22})*q2_dot^2/2"


def column(*entries: str) -> list[list[str]]:
    return [[entry] for entry in entries]


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


# -- what is free ----------------------------------------------------------------------------------


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


# -- follow-through --------------------------------------------------------------------------------

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


# -- numbers ---------------------------------------------------------------------------------------

ROD = """
dh: [{theta: q1*, a: l1}]
gravity: [0, -g, 0]
masses: [{mass: m1, link: 1, center: midpoint, shape: {rod: {length: l1}}}]
values: {g: 9.81, m1: 2}
"""


@pytest.mark.parametrize(
    ("text", "verdict", "notes"),
    [
        ("m1*l1^2/3", "correct", ()),
        ("0.333*m1*l1^2", "correct", ("rounded",)),
        ("0.33*m1*l1^2", "wrong", ()),
        ("0.334*m1*l1^2", "wrong", ()),
        ("2*l1^2/3", "correct", ()),
        ("0.667*l1^2", "correct", ("rounded",)),
        ("0.66*l1^2", "wrong", ()),
        ("2*m1*l1^2/3", "wrong", ()),
        ("m1*l1^2/4 + 2*l1^2/12", "correct", ()),
        ("m1*l1^2/4 + 2*l1^2/11", "wrong", ()),
    ],
)
def test_decimals_round_and_symbols_have_values(text: str, verdict: str, notes: tuple[str, ...]) -> None:
    answer = judged(ROD, "d11", text)
    assert (str(answer.verdict), answer.notes) == (verdict, notes)


@pytest.mark.parametrize(
    ("text", "verdict", "read_as"),
    [
        ("0.3*m1*l1^2", "wrong", "0.3 m₁ l₁²"),
        ("0.333*m1*l1^2", "correct", "0.333 m₁ l₁²"),
        (r"0.330\,m_1 l_1^2", "wrong", "0.330 m₁ l₁²"),
        ("2.0*l1^2/3.0", "correct", "2.0 l₁²/3.0"),
    ],
)
def test_the_decimals_that_were_written_count(text: str, verdict: str, read_as: str) -> None:
    checker = Checker(read_problem(ROD, "rod.yaml"))
    report = checker(checker.reader(f"answers:\n  d11: {text}\n", "answers.yaml"))
    answer = next(a for a in report.answers if a.name == "d11")
    assert (str(answer.verdict), answer.read_as) == (verdict, read_as)


def test_a_number_for_g() -> None:
    assert judged(ROD, "g1", "9.81*m1*l1*cos(q1)/2").verdict == "correct"
    assert judged(ROD, "g1", "9.82*m1*l1*cos(q1)/2").verdict == "wrong"


def test_a_number_twice_as_large_is_no_rounding() -> None:
    light = ROD.replace("shape: {rod: {length: l1}}", "inertia: {zz: 0.05}").replace(
        "{g: 9.81, m1: 2}", "{g: 9.81}"
    )
    assert judged(light, "Kw1", "0.025*q1_dot^2").notes == ()
    assert judged(light, "Kw1", "0.05*q1_dot^2").verdict == "wrong"
    assert judged(light, "Kw1", "0.0254*q1_dot^2").verdict == "wrong"
    assert judged(light, "I_body1", [["0", "0", "0"], ["0", "0", "0"], ["0", "0", "0.1"]]).verdict == "wrong"


@pytest.mark.parametrize(
    ("name", "text", "verdict", "notes"),
    [
        ("d11", "0.863 + 0.48*cos(q2)", "correct", ("rounded",)),
        ("d11", "0.8628 + 0.480*cos(q2)", "correct", ("rounded",)),
        ("d11", "0.8629 + 0.480*cos(q2)", "wrong", ()),
        ("d11", "0.86 + 0.48*cos(q2)", "wrong", ()),
        ("d11", "0.84 + 0.48*cos(q2)", "wrong", ()),
        ("d11", "0.843 + 0.48*cos(q2)", "wrong", ()),
        ("d11", "0.863 + 0.5*cos(q2)", "wrong", ()),
        ("d11", "2.5*0.25^2 + 2.5*0.5^2/12 + 1.2*(0.5^2 + 0.15^2 + 2*0.5*0.15*cos(q2)) + 0.02"
                " + 0.75*(0.5^2 + 0.4^2 + 2*0.5*0.4*cos(q2))", "correct", ()),
        ("d11", "2.5*0.25^2 + 2.5*0.5^2/12 + 1.2*(0.5^2 + 0.15^2 + 2*0.5*0.15*cos(q2))"
                " + 0.75*(0.5^2 + 0.4^2 + 2*0.5*0.4*cos(q2))", "wrong", ()),
        ("g2", "4.709*cos(q1+q2)", "correct", ("rounded",)),
        ("g2", "4.8*cos(q1+q2)", "wrong", ()),
        ("g2", "4.7*cos(q1+q2)", "wrong", ()),
        ("g2", "10*0.48*cos(q1+q2)", "wrong", ()),
        ("g2", "9.81*0.48*cos(q1+q2)", "correct", ()),
        ("g2", "9.80*0.48*cos(q1+q2)", "wrong", ()),
    ],
)  # fmt: skip
def test_which_numbers_round(name: str, text: str, verdict: str, notes: tuple[str, ...]) -> None:
    """A decimal of three digits that the problem does not give; 0.5, 0.48 and 9.81 are exact."""
    answer = judged("numeric-2r", name, text)
    assert (str(answer.verdict), answer.notes) == (verdict, notes)


def test_half_is_exact() -> None:
    assert judged(RP, "K", "0.5*m2*L2^2*theta1_dot^2 + 0.5*m2*L2_dot^2").verdict == "wrong"
    assert judged(RP, "P", "0.5*m1*g*L1 + m2*g*L1").notes == ()


def test_one_decimal_is_one_number_wherever_it_counts() -> None:
    """Each coefficient by itself would round; the same number before both does not."""
    assert judged(ROD, "tau1", "0.333*m1*l1^2*q1_ddot + 0.5*m1*g*l1*cos(q1)").notes == ("rounded",)
    assert judged(ROD, "tau1", "0.333*(m1*l1^2*q1_ddot + 1.5*m1*g*l1*cos(q1))").verdict == "correct"
    assert judged(ROD, "tau1", "0.333*(m1*l1^2*q1_ddot + 1.503*m1*g*l1*cos(q1))").verdict == "wrong"


TILTED = """
dh: [{theta: q1*, a: l1, alpha: 30deg}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1, shape: point}, {mass: m2, link: 2, shape: point}]
"""


def test_roots_may_be_rounded() -> None:
    exact = judged(TILTED, "P2", "m2*g*l2*sin(q2)/2")
    assert (exact.verdict, exact.notes) == ("correct", ())
    row = ["cos(q1)", "-0.866*sin(q1)", "0.5*sin(q1)", "l1*cos(q1)"]
    rest = [["sin(q1)", "0.866*cos(q1)", "-0.5*cos(q1)", "l1*sin(q1)"], ["0", "0.5", "0.866", "0"],
            ["0", "0", "0", "1"]]  # fmt: skip
    found = judged(TILTED, "A1", [row, *rest])
    assert (found.verdict, found.notes) == ("correct", ("rounded",))
    assert judged(TILTED, "A1", [[row[0], "-0.867*sin(q1)", *row[2:]], *rest]).verdict == "wrong"
    assert judged(TILTED, "A1", [["cos(q1)", "-sqrt(3)/2*sin(q1)", *row[2:]], *rest]).verdict == "correct"


# -- names inside values ---------------------------------------------------------------------------


def _referring(*names: str) -> tree.Node:
    return tree.Sum(tuple(tree.Reference(name) for name in names))


def _with_reference(own: dict[str, Text], name: str, value: tree.Node) -> JudgedAnswer:
    """A hand-in whose last answer names others."""
    hand = submission(own)
    one = replace(answer(name, "0", 99), node=value)
    report = checker(ELBOW)(replace(hand, answers=(*hand.answers, one)))
    return next(a for a in report.answers if a.name == name)


def test_a_name_inside_a_value_is_the_students_own_answer() -> None:
    second = {"P2": "m2*g*(l1*sin(q1) + lc2*sin(q1 + q2))"}
    right = _with_reference({"P1": "m1*g*lc1*sin(q1)", **second}, "P", _referring("P1", "P2"))
    assert right.verdict == "correct"
    carried = _with_reference({"P1": "m1*g*l1*sin(q1)", **second}, "P", _referring("P1", "P2"))
    assert (carried.verdict, carried.follows_from) == ("follows", ("P1",))


@pytest.mark.parametrize("name", ["g2", "c121", "d12", "C12", "K1"])
def test_a_name_that_is_given_nowhere_makes_a_definition(name: str) -> None:
    found = _with_reference({}, name, tree.Reference(name))
    assert (found.verdict, found.given) == ("missing", False)
    assert found.notes == (f"{name} stands in it and is given nowhere: this is a definition",)


def test_a_name_of_an_entry_is_of_the_matrix_that_was_handed_in() -> None:
    own: dict[str, Text] = {"D": [[D11, f"2*({D12})"], [D12, D22]]}
    assert _with_reference(own, "d21", tree.Reference("d12")).verdict == "wrong"


MODEL = r"$$\tau_1 = d_{11}\ddot q_1 + d_{12}\ddot q_2 + c_{121}\dot q_1\dot q_2 + c_{221}\dot q_2^2 + g_1$$"
ENERGY = r"$$K = \frac12(d_{11}\dot q_1^2 + 2d_{12}\dot q_1\dot q_2 + d_{22}\dot q_2^2)$$"
D_ENTRIES = (
    r"$$d_{11} = m_1 l_{c1}^2 + m_2(l_1^2+l_{c2}^2+2l_1 l_{c2} c_2)+I_1+I_2$$"
    r"$$d_{12} = m_2(l_{c2}^2+l_1l_{c2}c_2)+I_2$$ $$d_{22} = m_2 l_{c2}^2+I_2$$"
)
SPEED = r"$$K_1 = \frac12 m_1 v_{c1}^T v_{c1} + \frac12 I_1 \dot q_1^2$$"
JACOBIAN = r"$$J_{v1} = \begin{bmatrix} -l_{c1} s_1 & 0 \\ l_{c1} c_1 & 0\\0&0\end{bmatrix}$$"


@pytest.mark.parametrize(
    ("text", "name", "verdict", "listed"),
    [
        (MODEL, "tau1", "missing", 1),
        (ENERGY, "K", "missing", 1),
        (ENERGY + D_ENTRIES, "K", "correct", 0),
        (D_ENTRIES.replace("+I_1+", "+2I_1+") + ENERGY, "K", "wrong", 0),
        (SPEED, "K1", "missing", 1),
        (SPEED + JACOBIAN, "K1", "correct", 0),
        (MODEL + D_ENTRIES, "tau1", "missing", 1),
        (MODEL + MODEL + D_ENTRIES, "tau1", "missing", 2),
    ],
)
def test_what_only_repeats_a_definition_earns_nothing(
    text: str, name: str, verdict: str, listed: int
) -> None:
    one = checker(ELBOW)
    report = one(one.reader(text, "report.md"))
    found = next(a for a in report.answers if a.name == name)
    assert (str(found.verdict), len(report.not_recognized)) == (verdict, listed)
    assert ("given nowhere" in "".join(found.notes)) == (verdict == "missing")


def test_what_needs_an_answer_that_cannot_be_read_cannot_be_read() -> None:
    one = checker(ELBOW)
    report = one(one.reader("answers:\n  d12: foo(((\n  d21: d12\n", "a.yaml"))
    assert verdicts(report)["d21"] == "unreadable"
