"""What books and exams print of kinematics, constraints, friction, springs and motors, held in numbers.

`kinematics.json`, `constraints.json` and `actions.json` name for each value the problem file, in the
folder of that name, its source and the quantity of `results`; `Cqd` is C times the rates. `defs` are
abbreviations of the source, `at` is the state that a value belongs to, and `tolerance` is of as many
digits as were printed. Springs have coordinates outside of sines and cosines, and sgn is no polynomial.
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
DRAWN_FROM = {"kinematics": (0.5, 2.0), "constraints": (0.5, 2.0), "actions": (-2.0, 2.0)}
CASES = [
    pytest.param(kind, case, id=f"{case['problem']}-{case['quantity']}")
    for kind in DRAWN_FROM
    for case in json.loads((HERE / f"{kind}.json").read_text(encoding="utf-8"))
]
NAME = re.compile(r"[A-Za-z_]\w*")


@pytest.mark.parametrize(("kind", "case"), CASES)
def test_the_published_result_comes_out(kind: str, case: dict[str, Any]) -> None:
    solution = solve_json(HERE / kind / f"{case['problem']}.yaml")
    theirs, defs = case["value"], case.get("defs", {})
    ours = coriolis(solution) if case["quantity"] == "Cqd" else solution["results"][case["quantity"]]
    draw = random.Random(case["source"])
    for _ in range(3):
        names = [n for n in NAME.findall(f"{ours} {theirs} {defs}") if n not in FUNCTIONS and n not in defs]
        values = {name: draw.uniform(*DRAWN_FROM[kind]) for name in names}
        values |= {name: numbers(value, values) for name, value in {**case.get("at", {}), **defs}.items()}
        assert_close(
            numbers(ours, values), numbers(theirs, values), case["source"], case.get("tolerance", 1e-9)
        )


def coriolis(solution: dict[str, Any]) -> list[str]:
    """C q̇ as texts."""
    rates = [coordinate["velocity"] for coordinate in solution["coordinates"]]
    rows = solution["results"]["C"]
    return [" + ".join(f"({c})*{rate}" for c, rate in zip(row, rates, strict=True)) for row in rows]
