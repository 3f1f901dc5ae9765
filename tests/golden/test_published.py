"""What the textbooks print, held against what dynsolve derives; exactly, at random rational states.

`published.json` names for each value the problem file, the source and the
quantity: a key of `results` in the JSON, or a path into it.  C is compared by
C q̇, since several C are right.
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
SAME = {
    "spong-planar-elbow": "planar-2r",
    "spong-elbow-remote": "planar-2r-remote",
    "spong-cartesian": "cartesian-pp",
    "craig-6-5-rp": "rp-vertical",
}
"""Robots of the textbooks that stand in the library too."""
CASES = PUBLISHED + [
    {**case, "problem": SAME[case["problem"]]} for case in PUBLISHED if case["problem"] in SAME
]


def _at(results: Any, path: Any) -> Any:
    for key in [path] if isinstance(path, str) else path:
        results = results[key]
    return results


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case['problem']}-{case['quantity']}")
def test_the_published_result_comes_out(case: dict[str, Any]) -> None:
    solution = solve_json(problem_file(case["problem"]))
    ours, theirs = _at(solution["results"], case["quantity"]), case["value"]
    coordinates = solution["coordinates"]
    angles = [q["name"] for q in coordinates if q["type"] == "revolute"]
    velocities = [q["velocity"] for q in coordinates]
    for seed in range(3):
        state = random_state(names_in(ours) | names_in(theirs) | set(velocities), angles, seed)
        mine, published = exact(ours, state), exact(theirs, state)
        if case["quantity"] == "C":
            qd = [state[name] for name in velocities]
            mine, published = times(mine, qd), times(published, qd)
        assert flat(mine) == flat(published), f"{case['source']}: {ours} is not {theirs}"
