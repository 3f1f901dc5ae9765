"""What only some exercises ask, verified by computations that share no formula with it.

`state: reach`: the one configuration within the limits that reaches the target, as a state.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping

from msgspec.structs import replace

from dynsolve.algebra.matrix import needed_roots
from dynsolve.derivation.balance import verify_balance
from dynsolve.derivation.configurations import Singular, verify_inverse, verify_singular, verify_target
from dynsolve.derivation.constraints import ACTING, verify_constraints
from dynsolve.derivation.equilibrium_check import Case, balanced_forces, verify_equilibria
from dynsolve.derivation.forward_dynamics import COMPARED, verify_forward
from dynsolve.derivation.graph import Derivation, Skipped
from dynsolve.derivation.kinematic_check import checked_names, verify_kinematics
from dynsolve.derivation.linearization import linear_names, verify_linear
from dynsolve.derivation.model_check import (
    model_names,
    recursion_names,
    verify_definite,
    verify_model,
    verify_recursions,
    verify_references,
)
from dynsolve.derivation.rate_check import rate_names, verify_rates, verify_statics
from dynsolve.derivation.reached import angle_rows
from dynsolve.derivation.reduced_check import constrained_names, verify_reduced
from dynsolve.derivation.rules import derive
from dynsolve.errors import AlgebraError, ProblemError
from dynsolve.explain.forms import Forms
from dynsolve.explain.inverse_formulas import ConfigurationForms
from dynsolve.explain.target import Configuration
from dynsolve.notation.python import to_python
from dynsolve.notation.tree import Negative, Node, Sum
from dynsolve.problem import Problem
from dynsolve.quantities.owners import asked_stages
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import State
from dynsolve.solution.numbers.substitution import robot_with

# What only some exercises ask, verified by computations that share no formula with it

Verify = Callable[[Robot, Mapping[str, Node], int], object]
"""Holds results, as they are printed, at some states."""


def verify_asked(robot: Robot, values: Derivation, forms: Forms, states: int) -> None:
    """Verify what is asked for beside the course's derivation, and what that is derived from.

    Raises VerificationError where a result is wrong.
    """
    left_out = {name for name, _ in skipped(robot, values)}
    wanted = values.leading_to(robot.questions.asked) - left_out

    def hold(verify: Verify, names: Iterable[str]) -> None:
        verify(robot, {name: forms(name) for name in names}, states)

    hold(verify_kinematics, checked_names(robot, wanted))
    hold(verify_rates, rate_names(robot, wanted))
    hold(verify_statics, (name for name in ("Q", "tau_static") if name in wanted))
    if robot.questions.constraints:
        acting = ("D", *ACTING) if "lambda" in wanted else ()
        kept = ("hc", "Ac", "Ac_dot", "lambda", *acting)
        hold(verify_constraints, (name for name in kept if name in wanted))
    if Stage.NEWTON_EULER in asked_stages(robot.questions):
        hold(verify_recursions, recursion_names(robot, wanted))
    hold(verify_model, (name for name in model_names(wanted) if name in values.rules))
    if "Yr" in wanted:
        hold(verify_references, ("Yr", "a", "D", "C", "g"))
    hold(verify_linear, (name for name in linear_names(wanted) if name in values.rules))
    if "qdd_forward" in wanted:
        forward = (name for name in COMPARED if name in values.rules)
        hold(verify_forward, (name for name in forward if name != "Q" or name in wanted))
    _verify_found(robot, values, forms, wanted)
    _verify_configurations(robot, values, forms, wanted)
    if "definite" in wanted:
        for candidate, found in zip(robot.questions.candidates, values["definite"], strict=True):
            if not isinstance(found, Skipped):
                verify_definite(robot, candidate, found, states)


def skipped(robot: Robot, values: Derivation) -> Iterator[tuple[str, str]]:
    """The names of what is asked for and was not worked out, with the reasons."""
    for name in sorted(robot.questions.asked & values.rules.keys()):
        value = values[name]
        if isinstance(value, Skipped):
            yield name, value.why
        elif name == "inverse" and robot.questions.target is not None:
            lacking = ConfigurationForms(robot, values).without_number
            if lacking:
                yield "inverse in numbers", f"{lacking} has none; give it one under values"


def _verify_found(robot: Robot, values: Derivation, forms: Forms, wanted: frozenset[str]) -> None:
    """Hold equations without multipliers, equilibria, and conditions that balance gravity, as printed."""
    shown = ConfigurationForms(robot, values)
    if "reduced" in wanted and robot.questions.constraints and not isinstance(values["reduced"], Skipped):
        residuals = [Sum((left, Negative(right))) for left, right in shown.reduced]
        verify_reduced(robot, {name: forms(name) for name in constrained_names(robot)}, residuals)
    if "balance" in wanted:
        verify_balance(robot, forms("g"), shown.balance)
    if "equilibria" in wanted:
        cases = [Case(*case) for case in zip(shown.equilibria, values["equilibria"].points, strict=True)]
        verify_equilibria(robot, forms(balanced_forces(robot)), cases)


def _verify_configurations(robot: Robot, values: Derivation, forms: Forms, wanted: frozenset[str]) -> None:
    """Hold the singular configurations and the branches of the inverse, as printed, in numbers."""
    shown = ConfigurationForms(robot, values)
    if "inverse" in wanted and shown.solved is not None:
        (task,) = values.rules["inverse"].inputs
        branches = list(zip(shown.inverse, shown.when, strict=True))
        verify_inverse(robot, forms(task), angle_rows(values[task]), branches)
    if "inverse" in wanted and shown.target is not None:
        target = shown.target
        configurations = [(c.formulas, c.free) for c in target.configurations]
        verify_target(robot, target.task, target.angles, target.numbers, configurations)
    found = shown.singular_set if "singular" in wanted else None
    if found is not None:
        (jacobian,) = values.rules["singular"].inputs
        ranks = [loss.rank for loss in found.losses]
        cases = [Singular(*case) for case in zip(shown.singular, ranks, shown.lost, strict=True)]
        verify_singular(robot, forms(jacobian), found.rank, cases)


# `state


def with_reached_state(problem: Problem) -> Problem:
    """The problem with its state as values, in a ring that holds their sines and cosines.

    Raises ProblemError where not exactly one configuration is within the limits, or it is not
    known exactly.
    """
    robot = problem.robot
    one = _within_limits(problem)
    state = State(tuple((name, 0, one.formulas[name]) for name in robot.ring.names))
    try:
        needed = needed_roots(robot.ring, state.by_symbol)
    except AlgebraError:
        raise _fault(
            problem,
            "the configuration that reaches the target is known in decimals alone",
            "give the state itself: state: {q1: 90deg}",
        ) from None
    questions = replace(robot.questions, state=state)
    return replace(problem, robot=robot_with(replace(robot, questions=questions), {}, needed))


def _within_limits(problem: Problem) -> Configuration:
    """The one configuration within the limits, with no coordinate that is free."""
    found = [one for one in _configurations(problem) if not one.outside]
    if len(found) == 1 and not found[0].free:
        return found[0]
    if found and found[0].free:
        message = f"{found[0].free[0]} may be anything where the target is reached"
        raise _fault(problem, message, "give the state itself: state: {q1: 90deg}")
    if not found:
        message = "no configuration within the limits reaches the target"
        raise _fault(
            problem, message, "look at `reach` and `limits`: `find: [inverse]` shows the configurations"
        )
    named = " and ".join(_written(one) for one in found[:2])
    message = f"{len(found)} configurations reach the target: {named}{', ...' * (len(found) > 2)}"
    raise _fault(problem, message, "give `limits` that leave one of them: limits: {q2: [0, 180deg]}")


def _configurations(problem: Problem) -> tuple[Configuration, ...]:
    """Those that reach the target, whether they are asked for or not."""
    questions = problem.robot.questions
    robot = replace(
        problem.robot,
        questions=replace(questions, asked=questions.asked | {"inverse"}, state_is_reached=False),
    )
    forms = ConfigurationForms(robot, derive(robot))
    if forms.target is None:
        raise _fault(problem, "the target has no numbers", "give numbers for its parameters under `values`")
    return forms.target.configurations


def _written(one: Configuration) -> str:
    values = (f"{name}: {to_python(value)}" for name, value in one.formulas.items())
    return f"{{{', '.join(values)}}}"


def _fault(problem: Problem, message: str, help: str) -> ProblemError:
    return ProblemError([problem.finding(("state",), message, help)])
