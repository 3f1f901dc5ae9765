"""`dynsolve check` as a person or a script meets it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.cli.running import Ran, dynsolve

PROBLEM = """
title: Pendulum
dh: [{theta: q1*, a: l1}]
gravity: [0, -g, 0]
masses: [{mass: m1, link: 1, shape: point}]
find: [tau, g]
marks: {tau: 3, g: 1.5}
"""


def check(*words: str | Path, source: str = "") -> Ran:
    return dynsolve("check", *map(str, words), stdin=source)


@pytest.fixture
def problem(tmp_path: Path) -> Path:
    path = tmp_path / "pendulum.yaml"
    path.write_text(PROBLEM, encoding="utf-8")
    return path


def write(folder: Path, answers: str) -> Path:
    path = folder / "answers.yaml"
    path.write_text(f"student: s1\nanswers:\n{answers}", encoding="utf-8")
    return path


RIGHT = "  tau1: m1*l1^2*q1'' + m1*g*l1*cos(q1)\n  g: [m1*g*l1*cos(q1)]\n"
WRONG = "  tau1: m1*l1*q1'' + m1*g*l1*cos(q1)\n  g: [m1*g*l1*cos(q1)]\n"


def test_all_correct_ends_with_0(problem: Path, tmp_path: Path) -> None:
    done = check(problem, write(tmp_path, RIGHT))
    assert done.code == 0, done.err
    assert "correct" in done.out


def test_a_wrong_answer_ends_with_1_and_json_is_the_contract(problem: Path, tmp_path: Path) -> None:
    done = check(problem, write(tmp_path, WRONG), "--json")
    assert done.code == 1
    report = json.loads(done.out)
    assert list(report) == [
        "format", "problem", "student", "answers", "not_recognized", "first_wrong", "marks", "of",
        "queued", "set_aside",
    ]  # fmt: skip
    assert (report["format"], report["problem"], report["student"]) == ("dynsolve-check/1", "pendulum", "s1")
    assert (report["first_wrong"], report["marks"], report["of"]) == ("tau1", 1.5, 4.5)
    first = next(a for a in report["answers"] if a["name"] == "tau1")
    keys = "name label verdict marks of where read_as note follows_from occurrences entries diagnosis"
    assert set(keys.split()) <= set(first)
    assert first["where"] == {"line": 3, "column": 9}
    assert first["diagnosis"][0]["code"] == "dropped_square"


@pytest.mark.slow
def test_the_ladder_tells_more_and_more(problem: Path, tmp_path: Path) -> None:
    answers = write(tmp_path, WRONG)
    said = [check(problem, answers, "--hints", str(level)).out for level in (1, 2, 3)]
    assert all("tau1" in text for text in said)
    assert ["square" in text for text in said] == [False, True, True]
    assert ["should be squared" in text for text in said] == [False, False, True]
    assert "minus what was expected" in check(problem, answers, "--teacher").out


def test_what_cannot_be_read_ends_with_1_and_nothing_to_read_with_2(problem: Path, tmp_path: Path) -> None:
    done = check(problem, write(tmp_path, "  tau1: m1*\n"))
    assert done.code == 1
    assert "answers.yaml:3:" in done.err
    assert "^" in done.err
    report = tmp_path / "report.md"
    for text, code in (("", 2), ("Only words.\n", 2), ("$$\\tau = D \\ddot q + F x$$\n", 1)):
        report.write_text(text)
        assert check(problem, report).code == code


def test_a_file_that_is_not_there_ends_with_2(problem: Path) -> None:
    done = check(problem, "nowhere.yaml")
    assert done.code == 2
    assert "help:" in done.err


def test_standard_input_is_an_answer_file(problem: Path) -> None:
    assert check(problem, "-", source=f"answers:\n{RIGHT}").code == 0


@pytest.mark.parametrize(("option", "begins"), [("--html", "<!DOCTYPE html>"), ("--markdown", "# ")])
def test_a_report_as_a_page(problem: Path, tmp_path: Path, option: str, begins: str) -> None:
    done = check(problem, write(tmp_path, WRONG), option)
    assert done.code == 1, done.err
    assert done.out.startswith(begins)


def test_readings_are_shown_on_demand(problem: Path, tmp_path: Path) -> None:
    answers = write(tmp_path, RIGHT)
    assert "How the answers were read" not in check(problem, answers).out
    assert "How the answers were read" in check(problem, answers, "--show-reading").out
