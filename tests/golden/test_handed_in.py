"""Published results of kinematic exercises handed in as students write them: each must be correct.

`handed_in.json` names for each exercise its source, the problem, the results in plain text as an answer
file has them, and the displays of a report with the same results.
"""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from dynsolve.answers.judge import Checker
from dynsolve.answers.reading.files import FileReader
from dynsolve.problem import read_problem
from tests.unit.answers.finder import lost

CASES = {
    case["name"]: case for case in json.loads((Path(__file__).parent / "handed_in.json").read_text("utf-8"))
}


@cache
def exercise(name: str) -> tuple[dict[str, Any], FileReader, Checker]:
    case = CASES[name]
    problem = read_problem("\n".join(case["problem"]) + "\n", f"{name}.yaml")
    return case, FileReader(problem), Checker(problem)


@pytest.mark.parametrize("ending", [".yaml", ".md", ".tex"])
@pytest.mark.parametrize("name", CASES)
def test_the_published_results_are_correct(name: str, ending: str) -> None:
    case, read, judge = exercise(name)
    answers = "".join(f"  {answer}: {text}\n" for answer, text in case["answers"].items())
    text = f"answers:\n{answers}" if ending == ".yaml" else "\n\n".join(case["report"]) + "\n"
    submission = read(text, f"answer{ending}")
    report = judge(submission)
    assert not lost(judge, text, ending[1:], submission, report)
    found = {answer.name: answer.verdict for answer in report.answers}
    assert {answer: found[answer] for answer in case["answers"]} == dict.fromkeys(case["answers"], "correct")
