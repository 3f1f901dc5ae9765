"""Base parameters are as many as the forces have independent coefficients, of every robot of the library."""

from __future__ import annotations

import math
from random import Random

import numpy as np
import pytest
from msgspec.structs import replace

import dynsolve
from dynsolve.derivation.arm_values import arm_at
from dynsolve.derivation.newton_euler import Arm, inverse_dynamics
from dynsolve.derivation.rules import derive
from dynsolve.explain.forms import Forms
from dynsolve.notation.tree import Symbol, walk
from dynsolve.questions.parameters.explain import BaseParameters
from dynsolve.robot.model import Robot
from tests.support import ACTING, STEMS, solved

NUMERIC = {"numeric-2r"}


def lengths_and_gravity(robot: Robot) -> set[str]:
    """The parameters that are no property of a body: they stand in the table, or in gravity."""
    values = [*(e for joint in robot.joints for e in (joint.d, joint.a)), *robot.gravity.entries]
    parts = walk(*map(Forms(robot, derive(robot)).of, values))
    return {part.name for part in parts if isinstance(part, Symbol)} & set(robot.parameters)


def rank_of_the_regressor(robot: Robot, fixed: set[str]) -> int:
    """τ = Y π: the rank of τ by recursive Newton-Euler over random states (rows) and bodies (columns)."""
    random = Random(5)

    def drawn(kept: dict[str, float]) -> Arm:
        values = {name: kept.get(name, random.uniform(0.4, 1.6)) for name in robot.ring.parameters}
        for q in robot.coordinates:
            values |= {name: random.uniform(-1.5, 1.5) for name in (q.name, q.velocity, q.acceleration)}
        return arm_at(robot, {**values, "pi": math.pi})

    table = {name: random.uniform(0.4, 1.6) for name in fixed}
    most = 10 * len(robot.bodies) + 2
    masses = [drawn(table).masses for _ in range(most)]
    states = [drawn(table) for _ in range(most // robot.n + 2)]
    rows = []
    for state in states:
        arms = (replace(state, masses=each) for each in masses)
        forces = [inverse_dynamics(arm, arm.qd, arm.qdd, arm.gravity) for arm in arms]
        rows.append(np.array(forces).T)
    sizes = np.linalg.svd(np.concatenate(rows), compute_uv=False)
    return int((sizes > 1e-9 * sizes[0]).sum())


@pytest.mark.parametrize("problem", sorted(STEMS - NUMERIC - ACTING))
def test_as_many_as_the_rank_of_the_regressor(problem: str) -> None:
    robot = dynsolve.load(problem).robot
    values = derive(robot)
    base = BaseParameters.of(robot, values["D"], values["g"], "kappa")
    count = rank_of_the_regressor(robot, lengths_and_gravity(robot))
    assert len(base.meanings) + len(base.kept) == count


@pytest.mark.slow
@pytest.mark.parametrize(("problem", "own"), [("stanford-6", ["I6zz"]), ("puma560", [])])
def test_one_that_is_a_symbol_already_is_counted_too(problem: str, own: list[str]) -> None:
    """d₆₆ of the Stanford arm is I_6zz: a base parameter without a definition."""
    short = solved(problem).abbreviated()
    assert short is not None
    assert [symbol.name for symbol in short.kept] == own
