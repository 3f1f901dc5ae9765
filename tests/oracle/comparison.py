"""A solution held against Pinocchio at random states."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from tests.oracle.pinocchio_arm import dynamics
from tests.oracle.reading import Array, coordinates_of, parameters_of, read
from tests.support import assert_close, numbers


def random_state(problem: Mapping[str, Any], seed: int) -> tuple[dict[str, float], Array, Array, Array]:
    """Values for every symbol, with q, q_dot and q_ddot."""
    random = np.random.default_rng(seed)
    values = {name: float(random.uniform(0.5, 1.5)) for name in sorted(parameters_of(problem))}
    names = coordinates_of(problem)
    q, qd, qdd = random.uniform(-2, 2, (3, len(names)))
    for suffix, vector in (("", q), ("_dot", qd), ("_ddot", qdd)):
        values |= {name + suffix: float(number) for name, number in zip(names, vector, strict=True)}
    return values, q, qd, qdd


def assert_agrees(problem: Mapping[str, Any], solution: Mapping[str, Any], states: int = 3) -> None:
    """H, r_c, P, K, tau, D, C q_dot and g of `solution` are those of Pinocchio."""
    results = solution["results"]
    names = [coordinate["name"] for coordinate in solution["coordinates"]]
    assert tuple(names) == coordinates_of(problem)
    for seed in range(states):
        values, q, qd, qdd = random_state(problem, seed)
        theirs = dynamics(read(problem, values), q, qd, qdd)
        assert_close(numbers(results["H"], values), theirs.H, "H")
        for body, r_c in zip(results["bodies"], theirs.r_c, strict=True):
            assert_close(numbers(body["r_c"], values), r_c, f"r_c of body {body['name']}")
        assert_close(numbers(results["P"], values), theirs.P, "P")
        assert_close(numbers(results["K"], values), theirs.K, "K")
        assert_close(numbers(results["tau"], values), theirs.tau, "tau")
        assert_close(numbers(results["D"], values), theirs.D, "D")
        assert_close(numbers(results["C"], values) @ qd, theirs.Cqd, "C q_dot")
        assert_close(numbers(results["g"], values), theirs.g, "g")
