"""The worked example of the course (IN3140 dynamics overview, University of Oslo, 2020) as a hand-in.

Every slip that it has is found, and none that it has not.
"""

from __future__ import annotations

from functools import lru_cache

import pytest

from dynsolve.answers.verdict import JudgedAnswer, Report
from tests.unit.answers.hands import codes, judge

_IDENTITY_ROW = ["0", "0", "0", "1"]
_KV2 = "m2*(cos(2*theta1)*L2^2*theta1_dot^2 + L2_dot^2)/2"

COURSE: dict[str, str | list[list[str]]] = {
    "H1": [["-sin(theta1)", "0", "cos(theta1)", "0"], ["cos(theta1)", "0", "sin(theta1)", "0"],
           ["0", "1", "0", "L1"], _IDENTITY_ROW],  # (3)
    "A1": [["-sin(theta1)", "0", "cos(theta1)", "0"], ["cos(theta1)", "0", "sin(theta1)", "0"],
           ["0", "1", "0", "L1"], _IDENTITY_ROW],  # (3)
    "A2": [["1", "0", "0", "0"], ["0", "1", "0", "0"], ["0", "0", "1", "L2"], _IDENTITY_ROW],  # (4)
    "H2": [["-sin(theta1)", "0", "cos(theta1)", "cos(theta1)*L2"],
           ["cos(theta1)", "0", "sin(theta1)", "sin(theta1)*L2"],
           ["0", "1", "0", "L1"], _IDENTITY_ROW],  # (5)
    "Jv": [["-sin(theta1)*L2", "cos(theta1)"], ["cos(theta1)*L2", "sin(theta1)"], ["0", "0"]],  # (9)
    "Jw": [["0", "0"], ["0", "0"], ["1", "0"]],  # (10)
    "I_body1": [["0", "0", "0"], ["0", "0", "0"], ["0", "0", "I1zz"]],  # (1)
    "P1": "m1*g*L1/2",  # (14)
    "P2": "m2*g*L1",  # (15)
    "v1": [["0"], ["0"], ["0"]],  # (19)
    "v2": [["-sin(theta1)*L2*theta1_dot + cos(theta1)*L2_dot"],
           ["cos(theta1)*L2*theta1_dot + sin(theta1)*L2_dot"], ["0"]],  # (20)
    "Kv1": "0",  # (21)
    "Kv2": _KV2,  # (22)
    "w1": [["0"], ["0"], ["theta1_dot"]],  # (24)
    "Kw1": "I1zz*theta1_dot^2/2",  # (27)
    "K": "0 + I1zz*theta1_dot^2/2 + m2*(cos(2*theta1)*L2^2*theta1_dot^2 + L2^2)/2 + 0",  # (29)
    "P": "m1*g*L1/2 + m2*g*L1",  # (30)
    "L": f"I1zz*theta1_dot^2/2 + {_KV2} - m1*g*L1/2 - m2*g*L1",  # (32)
    "dLdqd1": "I1zz*theta1_dot + m2*cos(2*theta1)*L2^2*theta1_dot",  # (36)
    "ddt1": "theta1_ddot + m2*cos(2*theta1)*L2^2*theta1_ddot + 2*m2*cos(2*theta1)*L2_dot^2*theta1_dot"
            " - 2*m2*sin(2*theta1)*L2^2*theta1_dot^2",  # (37)
    "dLdq1": "-m2*sin(2*theta1)*L2^2*theta1_dot^2",  # (38)
    "tau1": "theta1_ddot + m2*cos(2*theta1)*L2^2*theta1_ddot + 2*m2*cos(2*theta1)*L2_dot^2*theta1_dot"
            " - m2*sin(2*theta1)*L2^2*theta1_dot^2",  # (39)
    "dLdqd2": "L2_dot",  # (40)
    "ddt2": "L2_ddot",  # (41)
    "dLdq2": "m2*cos(2*theta1)*L2*theta1_dot^2",  # (42)
    "f2": "L2_ddot - m2*cos(2*theta1)*L2*theta1_dot^2",  # (43)
    "tau": [["theta1_ddot + m2*cos(2*theta1)*L2^2*theta1_ddot + 2*m2*cos(2*theta1)*L2_dot*theta1_dot"
             " - m2*sin(2*theta1)*L2^2*theta1_dot^2"],
            ["L2_ddot - m2*cos(2*theta1)*L2*theta1_dot^2"]],  # (44)
    "D": [["m2*cos(2*theta1)*L2^2 + 1", "0"], ["0", "1"]],  # (46)
    "C": [["-m2*sin(2*theta1)*L2^2*theta1_dot", "2*m2*cos(2*theta1)*theta1_dot"],
          ["-m2*cos(2*theta1)*L2*theta1_dot", "0"]],  # (46)
    "g": [["0"], ["0"]],  # (46)
}  # fmt: skip
"""The equations as they stand there, in plain text, slips and all; the number of each is beside it."""

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
