"""What exams and textbooks print of constraints, held against what dynsolve derives.

`constraints.json` names for each value the problem file in `constraints/`, the source and the quantity;
`defs` are names that the source uses in it.
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
CASES = json.loads((HERE / "constraints.json").read_text(encoding="utf-8"))
NAME = re.compile(r"[A-Za-z_]\w*")


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case['problem']}-{case['quantity']}")
def test_the_published_result_comes_out(case: dict[str, Any]) -> None:
    ours = solve_json(HERE / "constraints" / f"{case['problem']}.yaml")["results"][case["quantity"]]
    theirs, defs = case["value"], case.get("defs", {})
    draw = random.Random(case["source"])
    for _ in range(3):
        names = [n for n in NAME.findall(f"{ours} {theirs} {defs}") if n not in FUNCTIONS and n not in defs]
        values = {name: draw.uniform(0.5, 2.0) for name in names}
        values |= {name: numbers(text, values) for name, text in defs.items()}
        assert_close(numbers(ours, values), numbers(theirs, values), case["source"], 1e-9)
