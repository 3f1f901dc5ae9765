"""Numbers in answers: decimals that round, and symbols that have values."""

from __future__ import annotations

import pytest

from dynsolve.answers.judge import Checker
from dynsolve.problem.reader import read_problem
from tests.unit.answers.hands import (
    judged,
)
from tests.unit.answers.judging.elbow import RP

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
