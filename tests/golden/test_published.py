"""What the textbooks print, held against what dynsolve derives; exactly, at random rational states.

`published.json` and, of models without a table, `models.json` name for each value the problem
file, the source and the quantity: a key of `results` in the JSON, or a path into it.  C is
compared by C q̇, since several C are right; `Cqd` is that vector.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.golden.exact import exact, flat, names_in, random_state, times
from tests.support import problem_file, solve_json

HERE = Path(__file__).parent
PUBLISHED = json.loads((HERE / "published.json").read_text(encoding="utf-8"))
MODELS = json.loads((HERE / "models.json").read_text(encoding="utf-8"))
SAME = {
    "spong-planar-elbow": "planar-2r",
    "spong-elbow-remote": "planar-2r-remote",
    "spong-cartesian": "cartesian-pp",
    "craig-6-5-rp": "rp-vertical",
    "spong-five-bar-trick": "five-bar",
}
"""Robots of the textbooks that stand in the library too."""
CASES = PUBLISHED + [
    {**case, "problem": SAME[case["problem"]]} for case in PUBLISHED if case["problem"] in SAME
]


def _at(results: Any, path: Any) -> Any:
    for key in [path] if isinstance(path, str) else path:
        results = results[key]
    return results


def named(case: dict[str, Any]) -> str:
    return f"{case['problem']}-{case['quantity']}"


@pytest.mark.parametrize("case", CASES, ids=named)
def test_the_published_result_comes_out(case: dict[str, Any]) -> None:
    agrees(solve_json(problem_file(case["problem"])), case)


@pytest.mark.parametrize("case", MODELS, ids=named)
def test_the_published_result_of_a_model_comes_out(case: dict[str, Any]) -> None:
    agrees(solve_json(HERE / "models" / f"{case['problem']}.yaml"), case)


def agrees(solution: dict[str, Any], case: dict[str, Any]) -> None:
    is_vector = case["quantity"] == "Cqd"
    ours = _at(solution["results"], "C" if is_vector else case["quantity"])
    theirs = case["value"]
    coordinates = solution["coordinates"]
    angles = [q["name"] for q in coordinates if q["type"] == "revolute"] + case.get("angles", [])
    velocities = [q["velocity"] for q in coordinates]
    for seed in range(3):
        state = random_state(names_in(ours) | names_in(theirs) | set(velocities), angles, seed)
        mine, published = exact(ours, state), exact(theirs, state)
        if case["quantity"] == "C":
            qd = [state[name] for name in velocities]
            mine, published = times(mine, qd), times(published, qd)
        if is_vector:
            mine = times(mine, [state[name] for name in velocities])
        assert flat(mine) == flat(published), f"{case['source']}: {ours} is not {theirs}"
