"""Equilibria, the balance of gravity and the linearized equations of motion, as rules."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from dynsolve.derivation.graph import Rule
from dynsolve.questions.equilibria import balance, linearization
from dynsolve.questions.equilibria.solving import constrained_equilibria, equilibria
from dynsolve.questions.forward_dynamics.derive import outside_names
from dynsolve.robot.model import Robot


def rules(robot: Robot) -> Iterator[Rule]:
    """The rules of a robot with masses."""
    if not robot.has_dynamics:
        return
    yield Rule("balance", ("g",), partial(balance.balance, robot))
    if robot.questions.model.steady:
        yield Rule("equilibria", ("D", "C", "g"), partial(linearization.steady_equilibria, robot))
    elif robot.questions.constraints:
        yield Rule("equilibria", ("g", "D", "Ac", "hc"), partial(constrained_equilibria, robot))
    else:
        yield Rule("equilibria", ("g", "D"), partial(equilibria, robot))
    if robot.questions.model.linearize:
        acting = (*outside_names(robot), *robot.actions.resistance)
        yield Rule("linear_A", ("D", "g", *acting), partial(linearization.state_matrix, robot))
        yield Rule("linear_B", ("D", "linear_A"), partial(linearization.input_matrix, robot))
