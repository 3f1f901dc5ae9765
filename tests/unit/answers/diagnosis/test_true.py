"""What a diagnosis says is true of the hand-in, or it is not said."""

from __future__ import annotations

import random

import pytest

from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.diagnosis.diagnoser import Diagnoser
from dynsolve.answers.diagnosis.mends import parts
from dynsolve.answers.diagnosis.own_steps import DerivationSlips, MatrixDiagnoser
from dynsolve.answers.reading.files import read_submission
from dynsolve.answers.verdict import Answer, Place, Submission
from dynsolve.errors import ExplanationWarning
from tests.unit.answers.diagnosis.slip_examples import NUMBERS
from tests.unit.answers.hands import Text, checker, codes, judge, judged, problem
from tests.unit.answers.test_generated import forms, graph

ELBOW, RP = "planar-2r", "in3140-rp"
TURNING = "(m1*lc1^2+I1)*q1_dot^2/2 + I2*(q1_dot+q2_dot)^2/2"
MOVING = "m2*(l1^2*q1_dot^2 + lc2^2*(q1_dot+q2_dot)^2 + 2*l1*lc2*cos(q2)*q1_dot*(q1_dot+q2_dot))/2"
DDT = "m2*(lc2^2 + l1*lc2*cos(q2))*q1_ddot + m2*lc2^2*q2_ddot - m2*l1*lc2*sin(q2)*q1_dot*q2_dot"


def test_what_an_earlier_answer_holds_was_not_left_out() -> None:
    alone = judged(ELBOW, "ddt2", DDT)
    assert "rotation_missing" in codes(alone)
    beside = judged(ELBOW, "ddt2", DDT, K=f"{TURNING} + {MOVING}")
    assert set(codes(beside)) == {"missing_term"}


def test_a_body_that_stands_in_P_was_not_left_out_of_it() -> None:
    P = "m1*g*lc1*sin(q1) + m2*g*(l1*sin(q1) + lc2*sin(q1 + q2))"
    g: Text = [["m1*g*lc1*cos(q1)"], ["0"]]
    assert "body_missing" in codes(judged(ELBOW, "g", g))
    assert "body_missing" not in codes(judged(ELBOW, "g", g, P=P))


def test_a_transposed_C_is_told_as_that() -> None:
    h = "m2*l1*lc2*sin(q2)"
    C = [[f"-{h}*q2_dot", f"{h}*q1_dot"], [f"-{h}*(q1_dot + q2_dot)", "0"]]
    assert codes(judged(ELBOW, "C", C)) == ["transposed"]


@pytest.mark.parametrize(
    ("name", "text", "says"),
    [
        ("g2", "m2*9.81*lc2*cos(q1+q2)", "the number 9.81 stands for g"),
        ("g1", "(m1*lc1+m2*l1)*10*cos(q1)+m2*lc2*10*cos(q1+q2)", "the number 10 stands for g"),
    ],
)
def test_a_number_for_a_symbol_is_one_slip(name: str, text: str, says: str) -> None:
    found = judged(ELBOW, name, text)
    assert says in found.diagnosis[0].message
    assert codes(found) == ["number_for_letter"]


def test_right_terms_with_numbers_of_the_file_belong() -> None:
    rod = """
dh: [{theta: q1*, a: l1}]
gravity: [0, -g, 0]
masses: [{mass: m1, link: 1, center: midpoint, shape: {rod: {length: l1}}}]
values: {g: 9.81, m1: 2}
"""
    found = judged(rod, "tau1", "2*l1^2/3*q1_ddot + 9.81*l1*cos(q1) + 9.81*l1*sin(q1)")
    assert codes(found) == ["extra_term"]
    assert "sin" in found.diagnosis[0].message or "s₁" in found.diagnosis[0].message


@pytest.mark.parametrize(("written", "wanted"), [("m1*lc1^2", "m2*lc2^2")])
def test_one_index_for_another_is_one_slip(written: str, wanted: str) -> None:
    """In a term of its own, a mass and a length with the index of another body."""
    right = f"m1*lc1^2 + m2*(l1^2 + 2*l1*lc2*cos(q2)) + I1 + I2 + {wanted}"
    found = judged(ELBOW, "d11", right.replace(wanted, written))
    assert len(found.diagnosis) <= 2
    assert codes(judged(ELBOW, "d22", f"{written} + I2")) == ["symbol"]


SPHERE = """
dh: [{theta: theta1*, alpha: 90deg}, {theta: theta2* + 90deg, alpha: 90deg}, {d: L2}]
masses: [{mass: m1, link: 3, shape: point, center: tip}]
"""


@pytest.mark.parametrize("written", ["L2*cos(theta1)*sin(theta2)", "L2*sin(theta1)*cos(theta2)"])
def test_sine_for_cosine_in_one_factor_is_told_once(written: str) -> None:
    rest = [["L2*sin(theta1)*cos(theta2)"], ["L2*sin(theta2)"]]
    assert judged(SPHERE, "rc1", [["L2*cos(theta1)*cos(theta2)"], *rest]).verdict == "correct"
    assert codes(judged(SPHERE, "rc1", [[written], *rest])) == ["sin_for_cos"]


def test_the_number_before_a_square_of_a_cosine_is_the_one_that_is_written() -> None:
    found = judged(SPHERE, "Kv1", "m1*L2^2*(2*cos(theta2)^2*theta1_dot^2 + theta2_dot^2)/2")
    assert [d.code for d in found.diagnosis] == ["factor"]
    assert "has 1 in front where ½ belongs" in found.diagnosis[0].message
    assert not found.diagnosis[0].message.startswith("2")


STEMS = [RP, ELBOW, "rp-vertical", "elbow-3r"]
TRUE_OF_A_TERM = {
    -1: {"sign", "sign_all", "gravity_sign", "slope_sign", "factor", "factor_all", "twist_sign"},
    0: {"missing_term", "terms_missing", "product_rule", "chain_rule", "slope_missing", "gravity_missing"},
    2: {"factor", "factor_all", "double_angle"},
}
"""Codes that are true of a term that was made -1, 0 or 2 times as large."""

GENERAL = {
    "terms_differ", "terms_missing", "trig_part", "dimensions", "extra_term", "missing_term", "constant_term",
}  # fmt: skip


@pytest.mark.parametrize("seed", range(40))
@pytest.mark.parametrize("factor", [-1, 0, 2])
def test_a_slip_beside_the_right_answers_before_it_is_told_as_it_is(factor: int, seed: int) -> None:
    """Everything before it is given and right, so that no earlier step went wrong."""
    draw = random.Random(seed)
    stem = draw.choice(STEMS)
    g = graph(stem)
    node = draw.choice(["P", "K", "dLdqd1", "ddt1", "tau2", "g", "D"])
    value = g.key(node)
    entries = list(value.entries) if isinstance(value, Matrix) else [value]
    places = [i for i, e in enumerate(entries) if len(parts(e)) > 1]
    if not places:
        return
    place = draw.choice(places)
    part = draw.choice(list(parts(entries[place]).values()))
    entries[place] = entries[place] + part * (factor - 1)
    width = value.shape[1] if isinstance(value, Matrix) else 1
    rows = [entries[i : i + width] for i in range(0, len(entries), width)]
    wrong = Matrix.of(value.ring, rows) if isinstance(value, Matrix) else entries[0]
    order = ["rc1", "rc2", "P1", "P2", "K1", "K2", "P", "K", "L", "dLdqd1", "ddt1", "dLdq1", "tau1", "dLdqd2",
             "ddt2", "dLdq2", "tau2", "D", "Cqd", "g"]  # fmt: skip
    before = [n for n in order[: order.index(node)] if n in g.answer_ring.rules]
    answers = tuple(
        Answer(g.answer(n), "", forms(stem).of(wrong if n == node else g.key(n)), Place(i + 1, 1), "",
               occurrence=(i, 0))
        for i, n in enumerate([*before, node])
    )  # fmt: skip
    report = checker(stem)(Submission("", "", "", answers))
    found = next(a for a in report.answers if a.name == g.answer(node))
    assert found.verdict == "wrong"
    told = set(codes(found)) - {"dimensions"}
    steps = {"body_missing", "rotation_missing", "translation_missing"} if factor == 0 else set()
    assert told <= TRUE_OF_A_TERM[factor] | GENERAL | steps, (
        stem,
        node,
        [d.message for d in found.diagnosis],
    )


def test_a_hand_in_of_the_key_has_no_diagnosis() -> None:
    report = judge(ELBOW, {"d22": "m2*lc2^2 + I2", "g2": "m2*g*lc2*cos(q1+q2)"})
    assert all(not a.diagnosis for a in report.answers)


def test_what_is_true_of_the_own_answers_alone_says_so() -> None:
    P = "m1*g*lc1*sin(q1) + m2*g*(l1*sin(q1) + lc1*sin(q1 + q2))"
    own = judged(
        ELBOW, "g", [["(m1*lc1 + m2*l1)*g*cos(q1) + m2*g*lc1*cos(q1 + q2)"], ["m2*lc1*cos(q1 + q2)"]], P=P
    )
    told = own.diagnosis[0]
    assert told.message.startswith("By your own answers before it: ") and "g is left out" in told.message
    key = judged(
        ELBOW, "g", [["(m1*lc1 + m2*l1)*g*cos(q1) + m2*g*lc2*cos(q1 + q2)"], ["m2*g*lc2*cos(q1)"]], P=P
    )
    (told,) = key.diagnosis
    assert told.message == "In m₂ g l_c2 c₁ stands c₁ where c₁₂ belongs."


SPRING = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}]
masses: [{mass: m1, link: 1, shape: point, center: tip}]
springs: [{stiffness: k, of: q1}]
"""


def test_gravity_alone_is_not_blamed_where_springs_are_turned_too() -> None:
    assert codes(judged(SPRING, "g", [["-m1*g*l1*cos(q1) - k*q1"]])) == ["sign_all"]
    assert codes(judged(SPRING, "g", [["-m1*g*l1*cos(q1) + k*q1"]])) == ["gravity_sign"]


@pytest.mark.parametrize(
    ("C", "told"),
    [
        ([["0", "-2*h*(q1_dot + q2_dot)"], ["h*q1_dot", "0"]], "Row 1 of C q̇"),
        ([["-2*h*q2_dot", "-h*(q1_dot + q2_dot)"], ["h*q1_dot", "0"]], "Entry (1, 1) of C is 2 times"),
        ([["-h*q2_dot", "-h*(q1_dot + q2_dot)"], ["h*q1_dot", "h"]], "Entry (2, 2) of C"),
        ([["-2*h*q2_dot", "-2*h*(q1_dot + q2_dot)"], ["2*h*q1_dot", "0"]], "The ½ of Christoffel's formula"),
    ],
)
def test_of_C_that_is_spoken_of_which_is_to_be_mended(C: list[list[str]], told: str) -> None:
    h = "m2*l1*lc2*sin(q2)"
    rows = [[entry.replace("h", h) for entry in row] for row in C]
    found = judged(ELBOW, "C", rows)
    assert [d.message.startswith(told) for d in found.diagnosis] == [True], found.diagnosis


def test_an_entry_of_C_that_is_twice_the_keys_is_told_so_beside_a_wrong_D() -> None:
    """By the sine for a cosine in D, C has a cosine, of which -2 sin is no factor that anybody lost."""
    wagon = """
gravity: none
model:
  coordinates: {s: prismatic, phi: revolute}
  D: [[M, m*a*cos(phi)], [m*a*cos(phi), J]]
find: [D, C]
"""
    D: Text = [["M", "m*a*sin(phi)"], ["m*a*sin(phi)", "J"]]
    found = judged(wagon, "C", [["0", "-2*m*a*sin(phi)*phi_dot"], ["0", "0"]], D=D)
    assert [d.message for d in found.diagnosis] == ["Entry (1, 2) of C is 2 times what it should be."]


def test_one_entry_that_is_doubled_is_not_the_whole_matrix() -> None:
    D = [["2*(I1zz + m2*L2^2)", "0"], ["0", "m2"]]
    assert [d.message for d in judged(RP, "D", D).diagnosis] == ["Entry (1, 1) is 2 times what it should be."]
    D[1][1] = "2*m2"
    assert [d.message for d in judged(RP, "D", D).diagnosis] == ["Your answer is 2 times what it should be."]


@pytest.mark.parametrize(
    ("written", "says"),
    [
        ("m2*lc2*g*cos(q1 + q1)", ["stands cos(2q₁) where c₁₂ belongs"]),
        ("m2*lc2*g*cos(q2 + q2)", ["stands cos(2q₂) where c₁₂ belongs"]),
        ("m1*lc2*g*cos(q1 + q2)", ["stands m₁ where m₂ belongs"]),
    ],
)
def test_one_index_is_told_with_it(written: str, says: list[str]) -> None:
    found = judged(ELBOW, "g2", written)
    assert [text in d.message for text, d in zip(says, found.diagnosis, strict=True)] == [True]


def test_a_number_for_a_letter_and_an_index_are_two_slips() -> None:
    found = judged(ELBOW, "g1", "(m1*lc1 + m2*l1)*9.81*cos(q1) + m2*9.81*lc1*cos(q1 + q2)")
    assert codes(found) == ["number_for_letter", "symbol"]
    assert "stands l_c1 where l_c2 belongs" in found.diagnosis[1].message


def test_rates_exchanged_in_two_entries_are_told_in_both() -> None:
    twin = """
gravity: none
model:
  coordinates: {q1: revolute, q2: revolute}
  D: [[a, b*cos(q1 - q2)], [b*cos(q1 - q2), c]]
find: [C]
"""
    C = [["0", "b*sin(q1 - q2)*q1_dot"], ["-b*sin(q1 - q2)*q2_dot", "0"]]
    assert [d.message.count("belongs") for d in judged(twin, "C", C).diagnosis] == [1, 1]


ROLLING = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, gamma: revolute}
  bodies:
    - {mass: M, at: [x, 0, 0], turn: -x/R, about: [0, 0, 1], inertia: {zz: M*R^2/2}}
    - {mass: m, at: [x + l*sin(gamma), -l*cos(gamma), 0]}
passive: [gamma]
linearize: {x: 0, gamma: 0}
find: [D, qdd_forward, linear_A, linear_B]
"""


@pytest.mark.parametrize("name", ["qdd_forward", "linear_A", "linear_B"])
def test_fractions_that_a_slip_leads_to_are_told_of_it(name: str) -> None:
    """M x for 3/2 M x: without the turning of the disk, and all that the other slips lead to."""
    found = set()
    right = graph(ROLLING).key(name)
    for value, told, _ in DerivationSlips(graph(ROLLING)).values(name):
        written = Answer(name, "", forms(ROLLING).of(value), Place(1, 1), name)
        report = checker(ROLLING)(Submission("", "", "", (written,)))
        answer = next(a for a in report.answers if a.name == name)
        assert str(answer.verdict) == ("correct" if value == right else "wrong"), told
        found |= set(codes(answer))
    assert "rotation_missing" in found


@pytest.mark.parametrize(
    ("name", "text", "told"),
    [
        ("P", "23.54*sin(q1) + 9.8*sin(q1+q2)",
         ["23.54 s₁ stands where 23.544 s₁ belongs.", "9.8 s₁₂ stands where 9.81 s₁₂ belongs."]),
        ("D", [["2.66 + 1.2*cos(q2)", "0.5 + 0.6*cos(q2)"], ["0.5 + 0.6*cos(q2)", "0.5"]],
         ["2.66 stands where 1.58 belongs."]),
        ("g", [["23.544*sin(q1) + 9.81*sin(q1+q2)"], ["9.81*cos(q1+q2)"]],
         ["In 23.544 s₁ stands s₁ where c₁ belongs.", "In 9.81 s₁₂ stands s₁₂ where c₁₂ belongs."]),
        ("g", [["23.544*cos(q1) + 9.81*cos(q1+q2)"], ["9.81"]],
         ["In 9.81 the factor c₁₂ is left out."]),
    ],
)  # fmt: skip
def test_a_model_in_numbers_is_spoken_of_by_its_terms(name: str, text: Text, told: list[str]) -> None:
    assert sorted(d.message for d in judged(NUMBERS, name, text).diagnosis) == sorted(told)


HANGING = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, theta: revolute}
  bodies:
    - {mass: M, at: [x, 0, 0]}
    - {mass: m, at: [x + l*sin(theta), -l*cos(theta), 0]}
passive: [theta]
find: [tau]
"""

ATWOOD = """
gravity: [0, -g, 0]
model:
  coordinates: {r: prismatic, theta: revolute}
  bodies:
    - {mass: M, at: [0, r, 0]}
    - {mass: m, at: [r*sin(theta), -r*cos(theta), 0]}
passive: [r, theta]
find: [tau]
"""


@pytest.mark.parametrize(
    ("stem", "equation", "told"),
    [
        (HANGING, "l*theta'' + x''*cos(theta) = g*sin(theta)",
         "Multiplied by m l: The sign of -m g l sin(θ) is wrong."),
        (HANGING, "l*theta'' + x'' + g*sin(theta) = 0",
         "Multiplied by m l: In m l ẍ the factor cos(θ) is left out."),
        (HANGING, "m*l^2*theta'' + m*l*x''*cos(theta) = m*g*l*sin(theta)",
         "The sign of -m g l sin(θ) is wrong."),
        (ATWOOD, "(M+m)*r'' - m*r*theta'^2 + M*g = m*g*cos(theta)\ntheta'' = -(r'*theta' + g*sin(theta))/r",
         "Multiplied by m r²: m r ṙ θ̇ has 1 in front where 2 belongs."),
        (ATWOOD, "r'' - r*theta'^2 + M*g/m - g*cos(theta) = 0",
         "Multiplied by m: The term M r̈ is missing."),
    ],
)  # fmt: skip
def test_an_equation_that_was_divided_is_compared_multiplied(stem: str, equation: str, told: str) -> None:
    """Where no motor drives; the terms alone would lack a mass, and would be of other units."""
    report = checker(stem)(read_submission(problem(stem), equation, "answer.txt"))
    assert [d.message for a in report.answers for d in a.diagnosis] == [told]


@pytest.mark.filterwarnings("always")
def test_a_diagnosis_that_fails_takes_no_verdict_away(monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(*_: object) -> None:
        raise RuntimeError

    monkeypatch.setattr(Diagnoser, "__call__", fails)
    monkeypatch.setattr(MatrixDiagnoser, "__call__", fails)
    with pytest.warns(ExplanationWarning, match="D is left out: RuntimeError"):
        report = judge(ELBOW, {"D": [["m1", "0"], ["0", "m2*lc2^2 + I2"]], "P": "0"})
    found = {a.name: (str(a.verdict), a.diagnosis) for a in report.answers if a.given}
    assert found == {"D": ("wrong", ()), "P": ("wrong", ())}
