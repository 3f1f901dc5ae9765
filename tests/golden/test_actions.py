"""Friction, springs and motors as books and exams print them, held at random states.

`actions.json` names for each value the problem file of `actions/`, its source and the quantity of
`results`; `Cqd` is C times the rates, and `defs` are abbreviations of the source.  Springs have
coordinates outside of sines and cosines, and sgn is no polynomial: numbers are compared.
"""

from __future__ import annotations

import json
import random
from pathlib import Path
from typing import Any

import pytest

from tests.golden.exact import flat, names_in
from tests.support import assert_close, numbers, solve_json

HERE = Path(__file__).parent
CASES = json.loads((HERE / "actions.json").read_text(encoding="utf-8"))


def coriolis(C: list[list[str]], velocities: list[str]) -> list[str]:
    """C q̇ as texts."""
    return [" + ".join(f"({c})*{qd}" for c, qd in zip(row, velocities, strict=True)) for row in C]


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case['problem']}-{case['quantity']}")
def test_the_published_result_comes_out(case: dict[str, Any]) -> None:
    solution = solve_json(HERE / "actions" / f"{case['problem']}.yaml")
    results = solution["results"]
    results["Cqd"] = coriolis(results["C"], [q["velocity"] for q in solution["coordinates"]])
    ours, theirs, defs = flat(results[case["quantity"]]), flat(case["value"]), case.get("defs", {})
    draw = random.Random(7)
    for _ in range(3):
        names = sorted({*names_in(ours), *names_in(theirs), *names_in(list(defs.values()))})
        values = {name: draw.uniform(-2, 2) for name in names}
        values |= {name: numbers(text, values) for name, text in defs.items()}
        assert_close(numbers(ours, values), numbers(theirs, values), case["source"])
