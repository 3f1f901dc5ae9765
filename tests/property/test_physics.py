"""What physics says of every manipulator, held on random robots.

K = ½ q̇ᵀ D q̇;  D is symmetric and positive semidefinite;  Ḋ - 2C is
skew-symmetric (Spong, Hutchinson, Vidyasagar 2006, chapter 7);  the power of
the joints is the rate of the energy, d/dt (K + P) = q̇ᵀ τ;  g = ∂P/∂q.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given, note

from tests.golden.exact import names_in
from tests.robots import robots
from tests.support import ALL_PROBLEMS, assert_close, numbers, solve_json

STEP = 1e-5

NEEDED = {"K", "P", "L", "tau", "D", "C", "g"}
"""What the identities are about: a problem without these asks for something else."""


@dataclass(frozen=True)
class State:
    """A solved robot at a state."""

    results: Mapping[str, Any]
    names: tuple[str, ...]
    values: Mapping[str, float]

    def at(self, name: str, **moved: float) -> Any:
        """A result with numbers put in, some of the values moved."""
        return numbers(self.results[name], {**self.values, **moved})

    def vector(self, suffix: str = "") -> np.ndarray:
        """q, or a derivative of it."""
        return np.array([self.values[name + suffix] for name in self.names])

    def friction(self) -> np.ndarray:
        """The column of what friction and dampers take; zero where there is none."""
        return self.at("friction").ravel() if "friction" in self.results else np.zeros(len(self.names))

    def slope(self, name: str, direction: np.ndarray) -> Any:
        """The derivative of a result along a direction of q; central differences, fourth order."""

        def shifted(steps: int) -> Any:
            moved = self.vector() + steps * STEP * 100 * direction
            return np.asarray(self.at(name, **dict(zip(self.names, map(float, moved), strict=True))))

        return (shifted(-2) - 8 * shifted(-1) + 8 * shifted(1) - shifted(2)) / (12 * STEP * 100)


def kinetic_energy_is_half_qd_D_qd(state: State) -> None:
    qd = state.vector("_dot")
    assert_close(state.at("K"), qd @ state.at("D") @ qd / 2, "K")


def D_is_symmetric_and_positive_semidefinite(state: State) -> None:
    D = state.at("D")
    assert_close(D, D.T, "D")
    assert np.linalg.eigvalsh(D).min() >= -1e-9 * max(1.0, np.abs(D).max())


def D_dot_minus_2C_is_skew_symmetric(state: State) -> None:
    N = state.slope("D", state.vector("_dot")) - 2 * state.at("C")
    assert_close(N + N.T, np.zeros_like(N), "N + Nᵀ", tolerance=1e-6)


def tau_is_D_qdd_plus_C_qd_plus_g_and_friction(state: State) -> None:
    qd, qdd = state.vector("_dot"), state.vector("_ddot")
    parts = state.at("D") @ qdd + state.at("C") @ qd + state.at("g").ravel() + state.friction()
    assert_close(state.at("tau"), parts, "tau")


def power_is_the_rate_of_the_energy_and_what_friction_takes(state: State) -> None:
    qd, qdd = state.vector("_dot"), state.vector("_ddot")
    rate = qd @ state.at("D") @ qdd + state.slope("K", qd) + state.slope("P", qd)
    assert_close(qd @ state.at("tau").ravel(), rate + qd @ state.friction(), "power", tolerance=1e-6)


def g_is_the_gradient_of_P(state: State) -> None:
    gradient = [state.slope("P", direction) for direction in np.eye(len(state.names))]
    assert_close(state.at("g"), gradient, "g", tolerance=1e-6)


def L_is_K_minus_P(state: State) -> None:
    assert_close(state.at("L"), state.at("K") - state.at("P"), "L")


IDENTITIES = [
    kinetic_energy_is_half_qd_D_qd,
    D_is_symmetric_and_positive_semidefinite,
    D_dot_minus_2C_is_skew_symmetric,
    tau_is_D_qdd_plus_C_qd_plus_g_and_friction,
    power_is_the_rate_of_the_energy_and_what_friction_takes,
    g_is_the_gradient_of_P,
    L_is_K_minus_P,
]


def _state(solution: Mapping[str, Any], seed: int = 7) -> State:
    random = np.random.default_rng(seed)
    names = tuple(coordinate["name"] for coordinate in solution["coordinates"])
    moving = [name + suffix for name in names for suffix in ("", "_dot", "_ddot")]
    results = solution["results"]
    parameters = sorted(set().union(*(names_in(results[name]) for name in NEEDED)) - set(moving))
    values = {name: float(random.uniform(0.5, 1.5)) for name in parameters}
    return State(results, names, values | {name: float(random.uniform(-2, 2)) for name in moving})


@lru_cache(maxsize=1)
def _library() -> list[State]:
    # a matrix D that is given is one of a robot under the file's assumptions alone
    solutions = [solve_json(path) for path in ALL_PROBLEMS if "\nassume:" not in path.read_text("utf-8")]
    return [_state(solution) for solution in solutions if solution["results"].keys() >= NEEDED]


@pytest.mark.slow
@pytest.mark.parametrize("identity", IDENTITIES, ids=lambda identity: identity.__name__)
def test_the_library_obeys_physics(identity: Callable[[State], None]) -> None:
    for state in _library():
        identity(state)


@pytest.mark.slow
@given(text=robots(max_joints=3, physical=True))
def test_random_robots_obey_physics(text: str) -> None:
    note(text)
    state = _state(solve_json(text))
    for identity in IDENTITIES:
        identity(state)
