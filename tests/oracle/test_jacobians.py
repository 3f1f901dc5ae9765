"""Jacobians and their time derivatives against Pinocchio, of every kind of table."""

from __future__ import annotations

import re

import numpy as np
import pytest

from tests.oracle.comparison import random_state
from tests.oracle.pinocchio_arm import jacobians
from tests.oracle.reading import load, read
from tests.support import assert_close, numbers, problem_file, solve_json

ROBOTS = ("planar-2r-remote", "scara-rrpr", "spherical-rrp", "elbow-3r", "craig-6-5-rp")


@pytest.mark.parametrize("name", ROBOTS)
def test_j_and_its_rate(name: str) -> None:
    text = re.sub(
        r"^(find|marks):.*$", "", problem_file(name).read_text(encoding="utf-8"), flags=re.MULTILINE
    )
    results = solve_json(text + "\nfind: [J_dot, r, Jr, Jr_dot]\n")["results"]
    problem = load(text)
    for seed in range(3):
        values, q, qd, _ = random_state(problem, seed)
        J, J_dot = jacobians(read(problem, values), q, qd)
        ours = np.vstack([numbers(results["Jv"], values), numbers(results["Jw"], values)])
        assert_close(ours, J, "J")
        assert_close(numbers(results["J_dot"], values), J_dot, "J_dot")
        rows = [i for i in range(3) if any(entry != "0" for entry in results["Jv"][i])]
        assert_close(numbers(results["Jr"], values), J[rows], "J_r")
        assert_close(numbers(results["Jr_dot"], values), J_dot[rows], "J_r dot")
