"""What several tests need: solving a problem, and putting numbers into what comes out.

Results are taken from the JSON that `dynsolve solve --json` prints, the contract
with other programs, so that what is tested is what a user gets.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

import dynsolve

ROOT = Path(__file__).parent.parent
LIBRARY = sorted((ROOT / "problems").glob("*.yaml"))
TEXTBOOKS = sorted((ROOT / "tests" / "golden" / "textbooks").glob("*.yaml"))

FUNCTIONS: dict[str, Any] = {
    "__builtins__": {},
    "sin": math.sin,
    "cos": math.cos,
    "sqrt": math.sqrt,
    "pi": math.pi,
}


def solve_json(problem: Path | str) -> dict[str, Any]:
    """The JSON of a solution; `problem` is a path, or the text of a problem file."""
    return _solved(problem) if isinstance(problem, Path) else _solved.__wrapped__(problem)


@cache
def _solved(problem: Path | str) -> dict[str, Any]:
    return json.loads(json.dumps(dynsolve.solve(problem).to_json()))


def numbers(entries: Any, values: Mapping[str, float]) -> Any:
    """A string, or nested lists of strings, as a number or an array."""
    if isinstance(entries, str):
        return float(eval(compile(entries, "<result>", "eval"), dict(FUNCTIONS), dict(values)))  # noqa: S307
    return np.array([numbers(entry, values) for entry in entries], dtype=float)


def assert_close(ours: Any, theirs: Any, what: str, tolerance: float = 1e-9) -> None:
    """`ours` equals `theirs`, to `tolerance` of the largest entry."""
    ours, theirs = np.asarray(ours, dtype=float), np.asarray(theirs, dtype=float)
    assert ours.size == theirs.size, f"{what}: {ours.shape} is not {theirs.shape}"
    ours = ours.reshape(theirs.shape)
    scale = max(1.0, float(np.abs(theirs).max(initial=0.0)))
    error = float(np.abs(ours - theirs).max(initial=0.0)) / scale
    assert error <= tolerance, f"{what}: off by {error:.1e}\nours\n{ours}\ntheirs\n{theirs}"
