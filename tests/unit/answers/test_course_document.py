"""The worked example of the course as a hand-in: every slip of its, and none that it has not."""

from __future__ import annotations

from functools import lru_cache

import pytest

from dynsolve.answers.verdict import JudgedAnswer, Report
from tests.unit.answers.course import COURSE
from tests.unit.answers.hands import codes, judge

CORRECT = "A1 H1 A2 H2 Jv Jw v1 v2 w1 P1 P2 P Kv1 Kw1 I_body1 g".split()
FOLLOWS = "L dLdqd1 dLdq1 tau1 ddt2 dLdq2 f2 D C".split()
WRONG = "Kv2 K ddt1 dLdqd2 tau".split()


@lru_cache
def report() -> Report:
    return judge("in3140-rp", COURSE)


def one(name: str) -> JudgedAnswer:
    return next(a for a in report().answers if a.name == name)


@pytest.mark.parametrize(
    ("name", "verdict"),
    [(n, "correct") for n in CORRECT] + [(n, "follows") for n in FOLLOWS] + [(n, "wrong") for n in WRONG],
)
def test_the_verdict_of_each_equation(name: str, verdict: str) -> None:
    assert one(name).verdict == verdict


def test_it_first_went_wrong_at_22() -> None:
    assert report().first_wrong == "Kv2"
    assert [a.name for a in report().answers if a.verdict == "wrong"] == WRONG


def test_22_has_the_difference_of_squares() -> None:
    assert codes(one("Kv2")) == ["double_angle"]


def test_29_lost_the_dot() -> None:
    assert codes(one("K"))[0] == "dropped_dot"


def test_32_follows_from_22_and_not_from_29() -> None:
    assert one("L").follows_from == ("Kv2",)


def test_37_has_two_slips() -> None:
    found = {d.code: d.message for d in one("ddt1").diagnosis}
    assert "I_1zz" in found["dropped_inertia"]
    assert "L₂ L̇₂" in found["extra_dot"]


def test_40_lost_the_mass() -> None:
    assert codes(one("dLdqd2")) == ["dropped_mass", "dimensions"]


def test_44_is_wrong_in_its_first_entry_alone() -> None:
    first, second = one("tau").entries
    assert (first.index, first.verdict) == ((1, 1), "wrong")
    assert (second.index, second.verdict, second.follows_from) == ((2, 1), "follows", ("f2",))
    assert "dimensions" in [d.code for d in first.diagnosis]
    assert "the factor L₂ is left out" in first.diagnosis[0].message


def test_46_follows_44() -> None:
    assert {e.index: str(e.verdict) for e in one("D").entries} == {
        (1, 1): "follows", (1, 2): "correct", (2, 1): "correct", (2, 2): "follows",
    }  # fmt: skip
    assert one("D").follows_from == one("C").follows_from == ("tau",)
    assert [(e.index, str(e.verdict)) for e in one("C").entries] == [((1,), "follows"), ((2,), "follows")]
