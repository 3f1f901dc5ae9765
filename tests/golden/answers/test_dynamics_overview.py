"""The equations of the IN3140 dynamics overview, as they stand in its file, handed in to its own exercise.

Checked by hand against the document (University of Oslo, IN3140, March 12, 2020):
c_1² - s_1² for c_1² + s_1² in (22), a lost dot in (29), I_1zz lost and 2 L̇_2² for
2 L_2 L̇_2 in (37), m_2 lost in (40), and L_2 lost in (44).
"""

from __future__ import annotations

from functools import lru_cache

import pytest

from dynsolve.answers.judge import check
from dynsolve.answers.reading.files import read_submission
from dynsolve.answers.verdict import JudgedAnswer, Report
from dynsolve.solution.solution import load
from tests.support import COURSE_DOCUMENT

VERDICTS = {
    "correct": {"A1": 3, "H1": 3, "A2": 4, "H2": 5, "Jv": 9, "Jw": 10, "v1": 19, "v2": 20, "w1": 24,
                "P1": 14, "P2": 15, "P": 30, "Kv1": 21, "Kw1": 27, "I_body1": 1, "g": 46},
    "wrong": {"Kv2": 22, "K": 29, "ddt1": 37, "dLdqd2": 40, "tau": 44},
    "follows": {"L": 32, "dLdqd1": 36, "dLdq1": 38, "tau1": 39, "ddt2": 41, "dLdq2": 42, "f2": 43,
                "D": 46, "C": 46},
}  # fmt: skip
FROM = {
    "L": {"Kv2"},
    "dLdqd1": {"L"},
    "dLdq1": {"L"},
    "dLdq2": {"L"},
    "ddt2": {"dLdqd2"},
    "D": {"tau"},
    "C": {"tau"},
}
SLIPS = {
    "Kv2": {"double_angle"}, "K": {"dropped_dot"}, "ddt1": {"dropped_inertia", "extra_dot"},
    "dLdqd2": {"dropped_mass", "dimensions"}, "tau": {"dropped_factor", "dimensions"},
}  # fmt: skip


@lru_cache
def report() -> Report:
    problem = load("in3140-rp")
    return check(problem, read_submission(problem, COURSE_DOCUMENT.read_bytes(), COURSE_DOCUMENT.name))


def one(name: str) -> JudgedAnswer:
    return next(a for a in report().answers if a.name == name)


@pytest.mark.parametrize("verdict", VERDICTS)
def test_each_equation_has_its_verdict(verdict: str) -> None:
    found = {a.name: a.label for a in report().answers if a.verdict == verdict}
    assert found == {name: f"({number})" for name, number in VERDICTS[verdict].items()}


def test_the_first_slip_is_22() -> None:
    assert report().first_wrong == "Kv2"


@pytest.mark.parametrize("name", FROM)
def test_what_follows_says_from_what(name: str) -> None:
    assert set(one(name).follows_from) == FROM[name]


@pytest.mark.parametrize("name", SLIPS)
def test_each_slip_is_named(name: str) -> None:
    assert SLIPS[name] <= {d.code for d in one(name).diagnosis}


def test_the_entries_of_44_and_46() -> None:
    assert [str(e.verdict) for e in one("tau").entries] == ["wrong", "follows"]
    assert [str(e.verdict) for e in one("D").entries] == ["follows", "correct", "correct", "follows"]
    assert [str(e.verdict) for e in one("C").entries] == ["follows", "follows"]


def test_the_misread_coordinate_of_42_is_noted() -> None:
    assert any("L_0" in note for note in one("dLdq2").notes)


def test_each_place_is_a_line_of_the_file() -> None:
    lines = COURSE_DOCUMENT.read_text(encoding="utf-8").splitlines()
    place = one("Kv2").place
    assert place is not None
    assert r"\cos(2\theta_1)" in lines[place.line - 1]
