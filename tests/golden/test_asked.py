"""What exams and books print as results of their questions on the equations of motion.

`asked.json` names the problem file in `asked/`, the source, and the published answers.  They
are handed in as they are printed, and every one must be right: regressors and parameters by
their product, with parameters as few as the source says.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

import dynsolve
from tests.support import solve_json

HERE = Path(__file__).parent
CASES = json.loads((HERE / "asked.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case['problem']}-{'-'.join(case['answers'])}")
def test_the_published_answers_are_right(case: dict[str, Any], tmp_path: Path) -> None:
    problem, hand_in = HERE / "asked" / f"{case['problem']}.yaml", tmp_path / "answers.yaml"
    hand_in.write_text(json.dumps({"answers": case["answers"]}), encoding="utf-8")
    found = {answer.name: str(answer.verdict) for answer in dynsolve.check(problem, hand_in).answers}
    assert {name: found[name] for name in case["answers"]} == dict.fromkeys(case["answers"], "correct")
    if "length" in case:
        assert len(solve_json(problem)["results"]["a"]) == case["length"]
