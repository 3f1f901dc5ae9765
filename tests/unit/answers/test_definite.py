"""What a student says of matrices, read as YAML and people write it, and judged one by one."""

from __future__ import annotations

import pytest

from dynsolve.answers.judge import check
from dynsolve.answers.reading.files import read_submission
from dynsolve.answers.verdict import JudgedAnswer
from dynsolve.problem import Problem, load, read_problem
from tests.support import ROOT

EXAM = load(ROOT / "problems" / "inertia-candidates.yaml")
ONE = read_problem("model:\n  coordinates: {q: revolute}\n  D: [[a + b*cos(q)]]\nfind: [definite]\n")


def judged(text: str, problem: Problem = EXAM) -> JudgedAnswer:
    (answer,) = check(problem, read_submission(problem, text, "answer.yaml")).answers
    return answer


RIGHT = {
    "words": "definite: {Ma: no, Mb: yes, Mc: no, Md: yes}",
    "quotes": 'answers:\n  definite: {Ma: "no", Mb: "yes", Mc: \'no\', Md: "yes"}',
    "a block": "definite:\n  Ma: No\n  Mb: Yes\n  Mc: false\n  Md: true\n",
    "names with an index": "definite: {M_a: no, M_b: yes, M_c: no, M_d: yes}",
}


@pytest.mark.parametrize("name", RIGHT)
def test_right_verdicts_are_read_and_correct(name: str) -> None:
    answer = judged(RIGHT[name])
    assert answer.verdict == "correct"
    assert [str(entry.verdict) for entry in answer.entries] == ["correct"] * 4


def test_each_matrix_is_judged_by_itself_and_the_reason_told() -> None:
    answer = judged("definite: {Ma: no, Mb: no, Mc: yes, Md: yes}")
    assert [str(entry.verdict) for entry in answer.entries] == ["correct", "wrong", "wrong", "correct"]
    assert [one.code for one in answer.diagnosis] == ["is_definite", "refused_indefinite"]


def test_what_is_not_said_is_missing() -> None:
    answer = judged("definite: {Ma: no, Mb: yes}")
    assert [str(entry.verdict) for entry in answer.entries] == ["correct", "correct", "missing", "missing"]
    assert answer.verdict == "missing"


FAULTS = {
    "neither": ("definite: {Ma: perhaps}", "`perhaps` is neither yes nor no"),
    "another matrix": ("definite: {Mx: no}", "there is no matrix Mx"),
}


@pytest.mark.parametrize("name", FAULTS)
def test_what_cannot_be_read_is_unreadable(name: str) -> None:
    text, fault = FAULTS[name]
    answer = judged(text)
    assert (answer.verdict, answer.fault) == ("unreadable", fault)


@pytest.mark.parametrize(("word", "verdict"), [("if", "correct"), ("yes", "wrong"), ("{D: if}", "correct")])
def test_of_one_matrix_its_name_may_be_left_out(word: str, verdict: str) -> None:
    assert judged(f"definite: {word}", ONE).verdict == verdict


def test_yes_is_right_where_other_minors_than_the_first_see_it() -> None:
    coupled = "[[a + c + 2*b*cos(q), c + b*cos(q)], [c + b*cos(q), c]]"
    text = f"candidates: {{M: {coupled}}}\ncoordinates: {{p: prismatic, q: revolute}}\n"
    problem = read_problem(f"{text}assume: [a > 0, a*c > b^2]\nfind: [definite]\n")
    assert judged("definite: yes", problem).verdict == "correct"
    assert judged("definite: if", problem).verdict == "wrong"
