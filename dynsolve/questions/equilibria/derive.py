"""Equilibria, the balance of gravity and the linearized equations of motion, as rules."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from dynsolve.derivation.graph import Rule
from dynsolve.questions.equilibria import balance, linearization
from dynsolve.questions.equilibria.solving import equilibria
from dynsolve.questions.forward_dynamics.derive import outside_names
from dynsolve.robot.model import Robot


def rules(robot: Robot) -> Iterator[Rule]:
    """The rules of a robot with masses."""
    if not robot.has_dynamics:
        return
    yield Rule("balance", ("g",), partial(balance.balance, robot))
    held = ("Ac", "hc") if robot.questions.constraints else ()
    if robot.questions.model.steady:
        yield Rule("equilibria", ("D", "C", "g", *held), partial(linearization.steady_equilibria, robot))
    else:
        yield Rule("equilibria", ("g", "D", *held), partial(equilibria, robot))
    if robot.questions.model.linearize:
        acting = (*outside_names(robot), *robot.actions.resistance)
        yield Rule("linear_A", ("D", "g", *acting), partial(linearization.state_matrix, robot))
        yield Rule("linear_B", ("D", "linear_A"), partial(linearization.input_matrix, robot))
