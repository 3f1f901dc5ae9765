"""Models without a table against Lagrange's equations of SymPy's mechanics package."""

from __future__ import annotations

import random
import re
from pathlib import Path

import numpy as np
import pytest

from tests.oracle.mechanism import torques
from tests.support import ROOT, assert_close, numbers, solve_json

FILES = sorted((ROOT / "tests" / "golden" / "models").glob("*.yaml"))


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_the_torques_are_those_of_sympy(path: Path) -> None:
    solution = solve_json(path)
    draw = random.Random(path.stem)
    names = {name for q in solution["coordinates"] for name in (q["name"], q["velocity"], q["acceleration"])}
    names |= set(_names(solution["results"]["tau"])) | {"g", "r", "J", "R"}
    values = {name: draw.uniform(0.4, 1.6) for name in sorted(names)}
    ours = np.array(numbers(solution["results"]["tau"], values), dtype=float).ravel()
    assert_close(ours, torques(path, values), "tau")


def _names(texts: list[str]) -> set[str]:
    return {name for text in texts for name in re.findall(r"[A-Za-z_]\w*", text)} - {"sin", "cos", "sqrt"}
