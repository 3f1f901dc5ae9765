"""What follows from what: slips carried through either way, and inventions, from which nothing follows."""

from __future__ import annotations

from fractions import Fraction

import pytest
from msgspec.structs import replace

from dynsolve.answers.answer_verdict import NOT_FROM_OWN
from dynsolve.answers.judge import Checker
from dynsolve.answers.marks import Policy, mark
from dynsolve.answers.verdict import Report
from dynsolve.quantities.index import quantities
from tests.unit.answers.hands import Text, checker, judge, problem, verdicts
from tests.unit.answers.judging.elbow import D11, D12, D22, G1, G2, TAU1, TAU2, H, K, column

RP, ELBOW = "in3140-rp", "planar-2r"

C = [[f"{H}*q2_dot", f"{H}*(q1_dot + q2_dot)"], [f"-{H}*q1_dot", "0"]]
D = [[D11, D12], [D12, D22]]
G = column(G1, G2)
TAU = column(TAU1, TAU2)

ONE: Text = [["1", "0"], ["0", "1"]]
NOTHING: Text = [["0", "0"], ["0", "0"]]
ZEROS: Text = column("0", "0")
UNIT = column("q1_ddot", "q2_ddot")
UNIT_RP = column("theta1_ddot", "L2_ddot")

TWICE_D22 = [[D11, D12], [D12, f"2*({D22})"]]
TAU_OF_TWICE_D22 = column(TAU1, f"{TAU2} + ({D22})*q2_ddot")
NO_BODY_2 = "m1*g*lc1*cos(q1)"
TAU_OF_NO_BODY_2 = column(TAU1.replace(G1, NO_BODY_2), TAU2.replace(f" + {G2}", ""))
SEVEN = [["7*m1", "0"], ["0", "7*m1"]]
FIVE: Text = [["5*m1*q1_dot", "0"], ["0", "5*m1*q2_dot"]]
THREE = column("3*m1", "3*m1")
TAU_OF_SEVEN = column(
    "7*m1*q1_ddot + 5*m1*q1_dot^2 + 3*m1", "7*m1*q2_ddot + 5*m1*q2_dot^2 + 3*m1"
)  # fmt: skip
D_RP: Text = [["I1zz + 2*m2*L2^2", "0"], ["0", "m2"]]
C_RP: Text = [["2*m2*L2*L2_dot", "2*m2*L2*theta1_dot"], ["-2*m2*L2*theta1_dot", "0"]]
TAU_RP = column(
    "(I1zz + 2*m2*L2^2)*theta1_ddot + 4*m2*L2*L2_dot*theta1_dot", "m2*L2_ddot - 2*m2*L2*theta1_dot^2"
)  # fmt: skip

Rows = list[tuple[str, str, dict[str, Text], str]]

SLIPS: Rows = [
    ("a slip in D, carried into τ", ELBOW, {"D": TWICE_D22, "C": C, "g": G, "tau": TAU_OF_TWICE_D22}, "wccf"),
    ("the same, τ first", ELBOW, {"tau": TAU_OF_TWICE_D22, "D": TWICE_D22, "C": C, "g": G}, "wfcc"),
    ("the same, C and g between", ELBOW,
     {"C": C, "D": TWICE_D22, "tau": TAU_OF_TWICE_D22, "g": G}, "cwfc"),
    ("D from K, τ from D", ELBOW, {"K": f"{K} + ({D22})*q2_dot^2/2", "D": TWICE_D22, "C": C, "g": G,
                                   "tau": TAU_OF_TWICE_D22}, "wfccf"),
    ("D from K, whatever the order", ELBOW, {"tau": TAU_OF_TWICE_D22, "D": TWICE_D22, "C": C, "g": G,
                                             "K": f"{K} + ({D22})*q2_dot^2/2"}, "ffccw"),
    ("g without body 2, carried into τ", ELBOW,
     {"D": D, "C": C, "g": column(NO_BODY_2, "0"), "tau": TAU_OF_NO_BODY_2}, "ccwf"),
    ("τ by its components", ELBOW, {"D": TWICE_D22, "C": C, "g": G, "tau1": TAU1,
                                    "tau2": TAU_OF_TWICE_D22[1][0]}, "wcccf"),
    ("C from D, τ from both", RP, {"D": D_RP, "C": C_RP, "g": ZEROS, "tau": TAU_RP}, "wfcf"),
    ("C and g from a τ with two slips", ELBOW,
     {"tau": column(TAU1.replace(G1, f"2*({G1})"), f"2*({TAU2})"), "g": column(f"2*({G1})", f"2*({G2})"),
      "D": [[D11, D12], [f"2*({D12})", f"2*({D22})"]]}, "wff"),
    ("a mass lost in the only term", RP, {"dLdqd2": "L2_dot", "ddt2": "L2_ddot"}, "wf"),
    ("a dot lost in the only term", RP, {"dLdqd2": "m2*L2", "ddt2": "m2*L2_dot"}, "wf"),
    ("a function lost in the only term", ELBOW,
     {"P1": "m1*g*lc1", "P2": "m2*g*(l1*sin(q1) + lc2*sin(q1 + q2))",
      "P": "m1*g*lc1 + m2*g*(l1*sin(q1) + lc2*sin(q1 + q2))"}, "wcf"),
    ("a height of 0 in a sum", RP, {"P1": "0", "P2": "m2*g*L1", "P": "m2*g*L1"}, "wcf"),
    ("a right g beside a τ without it", ELBOW, {"tau": UNIT, "g": G}, "wc"),
    ("P without body 2, and g of it", ELBOW,
     {"P": "m1*g*lc1*sin(q1)", "g": column(NO_BODY_2, "0")}, "wf"),
    ("frames that do not turn", ELBOW,
     {"H2": [["1", "0", "0", "0"], ["0", "1", "0", "0"], ["0", "0", "1", "0"], ["0", "0", "0", "1"]],
      "Jv": [["0", "0"], ["0", "0"], ["0", "0"]]}, "ww"),
]  # fmt: skip
"""(what, problem, answers in their order, the first letters of their verdicts)"""

INVENTIONS: Rows = [
    ("zeros", ELBOW, {"tau": ZEROS, "D": NOTHING, "C": NOTHING, "g": ZEROS}, "wwww"),
    ("zeros, D first", ELBOW, {"D": NOTHING, "C": NOTHING, "g": ZEROS, "tau": ZEROS}, "wwww"),
    ("zeros by entries", ELBOW, {"tau1": "0", "tau2": "0", "d11": "0", "g1": "0"}, "wwww"),
    ("zeros in K", ELBOW, {"K": "0", "D": NOTHING, "C": NOTHING}, "www"),
    ("zeros in P", ELBOW, {"P": "0", "g": ZEROS}, "ww"),
    ("zeros from the start", ELBOW, {"rc1": column("0", "0", "0"), "v1": column("0", "0", "0"),
                                     "Kv1": "0", "P1": "0"}, "wwww"),
    ("a unit robot, τ first", ELBOW, {"tau": UNIT, "D": ONE, "C": NOTHING, "g": ZEROS}, "wwww"),
    ("a unit robot, τ last", ELBOW, {"D": ONE, "C": NOTHING, "g": ZEROS, "tau": UNIT}, "wwww"),
    ("a unit robot, τ between", ELBOW, {"D": ONE, "tau": UNIT, "C": NOTHING, "g": ZEROS}, "wwww"),
    ("a unit robot, of the RP arm", RP, {"tau": UNIT_RP, "D": ONE, "C": NOTHING}, "www"),
    ("a unit robot, D first", RP, {"D": ONE, "C": NOTHING, "tau": UNIT_RP}, "www"),
    ("a unit robot by components", ELBOW,
     {"tau1": "q1_ddot", "tau2": "q2_ddot", "d11": "1", "d22": "1", "d12": "0"}, "wwwww"),
    ("from the energy of a unit robot", ELBOW,
     {"K": "(q1_dot^2 + q2_dot^2)/2", "D": ONE, "C": NOTHING, "tau": UNIT}, "wwww"),
    ("nobody's robot, D first", ELBOW, {"D": SEVEN, "C": FIVE, "g": THREE, "tau": TAU_OF_SEVEN}, "wwww"),
    ("nobody's robot, τ first", ELBOW, {"tau": TAU_OF_SEVEN, "D": SEVEN, "C": FIVE, "g": THREE}, "wwww"),
    ("a g of nobody's where it is 0", RP,
     {"tau": column("theta1_ddot + 3*m1", "L2_ddot + 3*m1"), "g": column("3*m1", "3*m1")}, "ww"),
    ("nobody's robot, without g", ELBOW, {"D": SEVEN, "C": FIVE, "tau": TAU_OF_SEVEN}, "www"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("what", "stem", "answers", "expected"), SLIPS + INVENTIONS, ids=lambda x: str(x)[:30]
)
def test_what_follows(what: str, stem: str, answers: dict[str, Text], expected: str) -> None:
    found = verdicts(judge(stem, answers))
    assert "".join(found[name][0] for name in answers) == expected, what


@pytest.mark.parametrize(("what", "stem", "answers", "expected"), INVENTIONS, ids=lambda x: str(x)[:30])
def test_inventions_earn_nothing_and_what_agrees_with_them_waits(
    what: str, stem: str, answers: dict[str, Text], expected: str
) -> None:
    given = [replace(a, of=Fraction(4)) for a in judge(stem, answers).answers if a.name in answers]
    earned = {m.name: m.marks for m in mark(given, quantities(problem(stem).robot), Policy())}
    assert earned == dict.fromkeys(answers, 0), what
    agreeing = [a.loss for a in given if a.loss]
    assert all("next to nothing is right" in loss for loss in agreeing)
    assert bool(agreeing) == (what != "nobody's robot, without g")


def report_on(stem: str, source: str) -> Report:
    judges: Checker = checker(stem)
    return judges(judges.reader(source, "report.md"))


@pytest.mark.parametrize("first", ["D", "C"])
def test_a_slip_inside_a_whole_equation_is_that_of_its_matrix(first: str) -> None:
    two = {"D": "2", "C": "2"} | {"C" if first == "D" else "D": "1"}
    report = report_on(
        RP,
        rf"""
$$\begin{{bmatrix}} I_{{1,zz}} + {two["D"]} m_2 L_2^2 & 0 \\ 0 & m_2 \end{{bmatrix}} \ddot q
+ \begin{{bmatrix}} m_2 L_2\dot L_2 & m_2 L_2 \dot\theta_1 \\ -{two["C"]} m_2 L_2 \dot\theta_1 & 0
\end{{bmatrix}} \dot q + \begin{{bmatrix}} 0 \\ 0 \end{{bmatrix}} = \tau$$""",
    )
    found = {a.name: a for a in report.answers}
    assert [name for name, a in found.items() if a.verdict == "wrong"] == [first] == [report.first_wrong]
    assert (found["tau"].verdict, found["tau"].follows_from) == ("follows", (first,))


@pytest.mark.parametrize("tau", [TAU, None])
def test_a_right_tau_beside_a_wrong_D_is_noted(tau: Text | None) -> None:
    torques: dict[str, Text] = {"tau": tau} if tau else {"tau1": TAU1, "tau2": TAU2}
    found = {a.name: a for a in judge(ELBOW, {"D": TWICE_D22, "C": C, "g": G, **torques}).answers}
    noted = [name for name, a in found.items() if NOT_FROM_OWN in a.notes]
    assert noted == (["tau"] if tau else ["tau2"])


@pytest.mark.parametrize(
    ("source", "needs"),
    [
        (r"$$K = \frac12 \dot q^T D \dot q$$", {"K": "D"}),
        (r"$$L = K - P$$", {"L": "K"}),
        (r"$$P = m_1 g L_1$$ $$K = m_2 \dot L_2^2$$ $$L = K - P$$", {}),
        (r"$$\tau = D \ddot q + C \dot q + g$$", {"tau": "D"}),
    ],
)
def test_an_equation_of_names_alone_is_listed_where_it_needs_what_is_given_nowhere(
    source: str, needs: dict[str, str]
) -> None:
    asking = Checker(replace(problem(RP), find=("K", "L", "tau"), marks={}))
    report = asking(asking.reader(source, "report.md"))
    why = {
        name: f"{other} stands in it and is given nowhere: this is a definition"
        for name, other in needs.items()
    }
    assert [one.why for one in report.not_recognized] == list(why.values())
    assert all(a.notes == (why[a.name],) for a in report.answers if a.name in why)


@pytest.mark.parametrize("source", [r"$$K = \frac12 \dot q^T D \dot q$$", "$$L = K - P$$"])
def test_an_equation_of_names_alone_for_what_nobody_asks_is_set_aside(source: str) -> None:
    report = report_on(RP, source)
    assert not report.not_recognized
    assert ["is given nowhere" in one.why for one in report.set_aside] == [True]
