"""The student's own names: `symbols:` and `let:` of an answer file."""

from __future__ import annotations

import pytest

from dynsolve.answers.reading.files import FileReader
from tests.unit.answers.reading.submissions import hand_in, last, problem, shown, shown_last


def test_abbreviations_and_own_symbols() -> None:
    head = "symbols: {q1: theta1, d2: L2, qd1: theta1_dot}\nlet: {h: -m2*L2*sin(q1)}\n"
    found = hand_in(head + "answers:\n  tau1: h*qd1 + \\ddot q_1 + \\dot{d}_2 + dd2\n", "in3140-rp")
    assert shown_last(found, "tau1") == "-(m₂ L₂ sin(θ₁)) θ̇₁ + θ̈₁ + L̇₂ + L̇₂"


OWN = [
    ("q1: theta1 - 90deg", "sin(q1)*dq1", "sin(θ₁ - 90°) θ̇₁"),
    ("q1: 90deg - theta1", "s1*q1'", "sin(90° - θ₁) (-θ̇₁)"),
    ("phi: theta1", r"\dot\phi^2 \cos\phi", "θ̇₁² cos(θ₁)"),
    ("x: L2 - L1", r"\dot{x}", "L̇₂"),
    ("M: m1", "M*g", "m₁ g"),
    (r"\varphi_1: \theta_1", r"\ddot\varphi_1", "θ̈₁"),
    ("w: theta1_dot", "w^2", "θ̇₁²"),
    ("I: I1zz", r"\frac12 I \dot\theta_1^2", "1/2 I_1zz θ̇₁²"),
]


@pytest.mark.parametrize(("symbols", "value", "expected"), OWN)
def test_a_symbol_of_the_students_own(symbols: str, value: str, expected: str) -> None:
    found = hand_in(f"symbols:\n  {symbols}\nanswers:\n  tau1: {value}\n", "in3140-rp")
    assert found.faults == ()
    assert shown_last(found, "tau1").replace("½", "1/2") == expected


def test_a_definition_that_cannot_be_read_is_a_fault_of_its_own() -> None:
    found = hand_in("let: {h: sin(}\nanswers:\n  K: h\n  P: m1\n")
    assert len(found.faults) == 1
    assert last(found, "K").node is None
    assert "definition" in last(found, "K").expected
    assert shown_last(found, "P") == "m₁"


LATE = "$$P_1 = m_1 g l_{c1} s_1$$\n\nwhere $s_1 = \\sin(q_1 + q_2)$\n"


def test_what_one_hand_in_reads_is_no_other_ones() -> None:
    """A value is kept for all hand-ins to a problem, and what they define is their own, before and after."""
    read = FileReader(problem("planar-2r"))
    plain = LATE.partition("where")[0]
    first, late, again = (read(text, "report.md") for text in (plain, LATE, plain))
    assert (shown(first.answers[0]), shown(late.answers[0])) == (
        "m₁ g l_c1 sin(q₁)",
        "m₁ g l_c1 sin(q₁ + q₂)",
    )
    assert again == first
