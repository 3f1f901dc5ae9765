"""What only some exercises ask, verified by computations that share no formula with it.

`state: reach`: the one configuration within the limits that reaches the target, as a state.
"""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import replace

from dynsolve.algebra.angles import in_degrees
from dynsolve.algebra.matrix import needed_roots
from dynsolve.derivation.graph import Derivation, Skipped, known
from dynsolve.derivation.rules import derive
from dynsolve.errors import AlgebraError, NoStatesError, ProblemError, VerificationError, warn_left_out
from dynsolve.explain.forms import Forms
from dynsolve.notation.python import to_python
from dynsolve.problem import Problem
from dynsolve.quantities.index import quantities
from dynsolve.quantities.owners import asked_stages
from dynsolve.quantities.stages import ASKED_FOR, Stage
from dynsolve.questions.held import Held
from dynsolve.questions.inverse.forms import InverseForms
from dynsolve.questions.inverse.target import Configuration
from dynsolve.questions.statics.check import verify_statics as verify_statics
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import State
from dynsolve.solution.numbers.substitution import robot_with


def verify_asked(robot: Robot, values: Derivation, forms: Forms, states: int) -> Derivation:
    """The values, of which what is asked for beside the course's derivation was verified.

    Where a check fails, what is asked of that question is left out, with a warning; all others stand.
    """
    left_out = {name for name, _ in skipped(robot, values)}
    held = Held(robot, values, forms, values.leading_to(robot.questions.asked) - left_out, states)
    asked = asked_stages(robot.questions)
    wrong: dict[str, Skipped] = {}
    for stage in ASKED_FOR:
        if stage in asked and (question := stage.part("check")) is not None:
            names = [name for name in robot.questions.asked if _stage_of(robot, name) is stage]
            try:
                question.verify(held)
            except VerificationError as error:
                if not names:
                    raise
                why = str(error)
                if not isinstance(error, NoStatesError):
                    warn_left_out(f"the part {stage}", why)
                    why = "its check found it to be wrong"
                wrong |= dict.fromkeys(names, Skipped(why))
    return Derivation(values.rules.values(), wrong) if wrong else values


def _stage_of(robot: Robot, name: str) -> Stage | None:
    quantity = quantities(robot).get(name)
    return quantity.family.stage if quantity is not None else None


def skipped(robot: Robot, values: Derivation) -> Iterator[tuple[str, str]]:
    """The names of what is asked for and was not worked out, with the reasons."""
    for name in sorted(robot.questions.asked & values.rules.keys()):
        value = known(values[name])
        if isinstance(value, Skipped):
            yield name, value.why
        elif name == "inverse" and robot.questions.target is not None:
            lacking = InverseForms(robot, values).without_number
            if lacking:
                yield "inverse in numbers", f"{lacking} has none; give it one under values"


# `state: reach`


def with_reached_state(problem: Problem) -> Problem:
    """The problem with its state as values, in a ring that holds their sines and cosines.

    Raises ProblemError where not exactly one configuration is within the limits, or it is not
    known exactly.
    """
    robot = problem.robot
    one = _within_limits(problem)
    state = State(tuple((name, 0, in_degrees(one.formulas[name])) for name in robot.ring.names))
    try:
        needed = needed_roots(robot.ring, state.by_symbol)
    except AlgebraError:
        raise _fault(
            problem,
            f"{_written(one)} reaches the target: its sines and cosines are no short sums of roots",
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
    forms = InverseForms(robot, derive(robot))
    if forms.target is None:
        raise _fault(problem, "the target has no numbers", "give numbers for its parameters under `values`")
    return forms.target.configurations


def _written(one: Configuration) -> str:
    values = (f"{name}: {to_python(value)}" for name, value in one.formulas.items())
    return f"{{{', '.join(values)}}}"


def _fault(problem: Problem, message: str, help: str) -> ProblemError:
    return ProblemError([problem.finding(("state",), message, help)])
