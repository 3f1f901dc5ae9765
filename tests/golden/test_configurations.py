"""Singular configurations and inverse kinematics of exams, held against what dynsolve derives.

Two sets are the same where each equation of one alternative is a multiple of one of the other;
two solutions, where they give the same configurations at values that the arm reaches.
"""

from __future__ import annotations

import json
import math
import random
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

import dynsolve
from tests.support import FUNCTIONS, solve_json

HERE = Path(__file__).parent
CASES = json.loads((HERE / "configurations.json").read_text(encoding="utf-8"))
NAME = re.compile(r"[A-Za-z_]\w*")
KNOWN = FUNCTIONS | {name: getattr(math, name) for name in ("asin", "acos", "atan2")}


def of(quantity: str) -> list[Any]:
    return [pytest.param(case, id=case["problem"]) for case in CASES if case["quantity"] == quantity]


def value(text: str, values: Mapping[str, float]) -> float:
    return float(eval(text, dict(KNOWN), dict(values)))  # noqa: S307 - text of our own


def results(problem: str) -> dict[str, Any]:
    found: dict[str, Any] = solve_json(HERE / "kinematics" / f"{problem}.yaml")["results"]
    return found


# -- singular configurations -----------------------------------------------------------------------


def is_multiple(mine: str, theirs: str) -> bool:
    """Whether mine/theirs has one value at all of some random configurations."""
    draw = random.Random(mine)
    names = {name for name in NAME.findall(f"{mine} {theirs}") if name not in KNOWN}
    ratios = []
    for _ in range(4):
        at = {name: draw.uniform(0.5, 1.4) for name in sorted(names)}
        ratios.append(value(mine, at) / value(theirs, at))
    return max(ratios) - min(ratios) < 1e-9 * max(map(abs, ratios))


def same_together(mine: list[str], theirs: list[str]) -> bool:
    return len(mine) == len(theirs) and all(any(is_multiple(a, b) for a in mine) for b in theirs)


@pytest.mark.parametrize("case", of("singular"))
def test_the_published_singular_configurations(case: dict[str, Any]) -> None:
    ours = [[text.removesuffix(" = 0") for text in one] for one in results(case["problem"])["singular"]]
    theirs = [[text.removesuffix(" = 0") for text in one.split(" and ")] for one in case["value"]]
    assert len(ours) == len(theirs)
    assert all(any(same_together(mine, one) for mine in ours) for one in theirs)


# -- inverse kinematics ----------------------------------------------------------------------------


def configuration(branch: Mapping[str, str], given: Mapping[str, float]) -> dict[str, float] | None:
    q = dict(given)
    waiting = dict(branch)
    while waiting:  # a formula may hold coordinates that are written after it
        for name, text in list(waiting.items()):
            if not {n for n in NAME.findall(text) if n in waiting}:
                try:
                    q[name] = value(text, q)
                except ValueError:
                    return None
                del waiting[name]
    return {name: q[name] for name in branch}


def distance(mine: Mapping[str, float], theirs: Mapping[str, float], angles: set[str]) -> float:
    gaps = ((name, mine[name] - theirs[name]) for name in theirs)
    return max(
        abs((gap + math.pi) % (2 * math.pi) - math.pi if name in angles else gap) for name, gap in gaps
    )


@pytest.mark.parametrize("case", of("inverse"))
def test_the_published_inverse(case: dict[str, Any]) -> None:
    solution = solve_json(HERE / "kinematics" / f"{case['problem']}.yaml")
    ours, r = solution["results"]["inverse"], solution["results"]["r"]
    angles = {q["name"] for q in solution["coordinates"] if q["type"] == "revolute"}
    text = (HERE / "kinematics" / f"{case['problem']}.yaml").read_text(encoding="utf-8")
    reach = re.search(r"reach: \[(.*)\]", text)
    assert reach is not None
    names = reach[1].split(", ")
    draw = random.Random(case["problem"])
    symbols = {name for name in NAME.findall(" ".join(r)) if name not in KNOWN}
    for _ in range(20):
        state = {name: draw.uniform(0.4, 1.5) for name in sorted(symbols)}
        given = {k: v for k, v in state.items() if k not in {q["name"] for q in solution["coordinates"]}}
        given |= {name: value(entry, state) for name, entry in zip(names, r, strict=True)}
        mine = [q for q in (configuration(branch, given) for branch in ours) if q is not None]
        theirs = [q for q in (configuration(branch, given) for branch in case["value"]) if q is not None]
        assert len(mine) == len(theirs)
        for one in theirs:
            assert min(distance(q, one, angles) for q in mine) < 1e-6


def test_what_is_lost_where_an_elbow_is_stretched_or_its_hand_is_above_its_base() -> None:
    """Spong, Hutchinson, Vidyasagar (2006), section 4.9.2: forces across the arm, and along it."""
    text = """
dh: [{theta: q1*, d: L1, alpha: 90deg}, {theta: q2*, a: L2}, {theta: q3*, a: L3}]
gravity: none
find: [singular]
"""
    steps = {step["id"]: step for step in dynsolve.solve(text).to_json()["steps"]}
    # where both hold, the arm being stretched along its first axis, the rank is 1
    assert all(
        "the rank is in general 2 instead of 3" in steps[name]["why"] for name in ("singular_1", "singular_2")
    )
    assert steps["singular_1"]["text"].endswith("𝐰 = [[s₁], [-c₁], [0]]")
    assert steps["singular_2"]["text"].endswith("𝐰 = [[c₁ c₂], [s₁ c₂], [s₂]]")


def test_a_jacobian_that_nobody_could_take_apart_is_left_out_with_its_reason() -> None:
    text = (HERE.parent.parent / "problems" / "panda-7r.yaml").read_text(encoding="utf-8")
    text = re.sub(r"masses:\n(  .*\n)+", "", re.sub(r"find: .*", "find: [singular]", text))
    solution = dynsolve.solve(text)
    assert "too long" in solution.to_json()["results"]["singular"]["skipped"]
    assert [warning.message.split()[0] for warning in solution.warnings] == ["singular"]
