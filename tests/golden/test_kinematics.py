"""What exams print as results of their questions on kinematics, held against what dynsolve derives.

`kinematics.json` names for each value the problem file in `kinematics/`, the source, the
quantity, and where the value belongs to a state, the state; to as many digits as were printed.
"""

from __future__ import annotations

import json
import random
import re
from pathlib import Path
from typing import Any

import pytest

from tests.support import FUNCTIONS, assert_close, numbers, solve_json

HERE = Path(__file__).parent
CASES = json.loads((HERE / "kinematics.json").read_text(encoding="utf-8"))
NAME = re.compile(r"[A-Za-z_]\w*")


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case['problem']}-{case['quantity']}")
def test_the_published_result_comes_out(case: dict[str, Any]) -> None:
    results = solve_json(HERE / "kinematics" / f"{case['problem']}.yaml")["results"]
    ours, theirs = results[case["quantity"]], case["value"]
    draw = random.Random(case["source"])
    for _ in range(3):
        names = [name for name in NAME.findall(f"{ours} {theirs}") if name not in FUNCTIONS]
        values = {name: draw.uniform(0.5, 2.0) for name in names}
        values |= {name: numbers(value, {}) for name, value in case.get("at", {}).items()}
        assert_close(
            numbers(ours, values), numbers(theirs, values), case["source"], case.get("tolerance", 1e-9)
        )
