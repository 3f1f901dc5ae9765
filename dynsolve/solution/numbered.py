"""Solutions in numbers: values put in and solved again, states, and both beside the symbolic results."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from dynsolve.errors import AlgebraError, UsageError
from dynsolve.explain.forms import is_numeric
from dynsolve.solution.numbers import quantities, units
from dynsolve.solution.numbers.assignments import Assignment
from dynsolve.solution.numbers.beside import Numbers, needed
from dynsolve.solution.numbers.given import Given, parameters
from dynsolve.solution.numbers.given import state as read_state
from dynsolve.solution.numbers.robot import put_in
from dynsolve.solution.numbers.rounding import DIGITS
from dynsolve.solution.numbers.state import State
from dynsolve.solution.numbers.valued import Valued
from dynsolve.solution.solution import Solution, solve


def with_values(solution: Solution, given: Given) -> Solution:
    """The solution of the robot with these values in it.

    Raises UsageError where a formula has no meaning with them.
    """
    try:
        robot = put_in(solution.robot, given.values)
        valued = solve(replace(solution.problem, robot=robot))
    except AlgebraError as error:
        raise UsageError(f"with these values the robot has no solution: {error.message}") from error
    entries = {**solution.given.entries, **given.entries}
    return replace(valued, given=Given(entries, given.warnings))


def at_state(solution: Solution, state: Given, digits: int | None = None) -> State:
    """What holds at a state."""
    decimal = solution.given.decimal or digits is not None
    return State(solution.robot, solution.values, state, decimal, digits or DIGITS)


def beside(
    solution: Solution,
    values: Iterable[Assignment] = (),
    state: Iterable[Assignment] | None = None,
    digits: int | None = None,
) -> Solution:
    """The solution with numeric results beside the symbolic ones; see `Solution.beside`."""
    values = tuple(values)
    problem, robot = solution.problem, solution.robot
    whole = bool(needed(robot)) and set(needed(robot)) <= problem.written.keys()
    if not (values or whole or state is not None):
        return solution
    given = parameters(problem, values)
    place = None if state is None else read_state(problem, state)
    numeric = with_values(solution, given) if given.entries else solution
    shown = Valued(
        robot=numeric.robot,
        values=numeric.values,
        forms=numeric.forms,
        given=given,
        decimal=given.decimal or digits is not None or is_numeric(robot),
        digits=digits or DIGITS,
    )
    numbers = Numbers(
        robot=robot,
        given=given,
        valued=shown if given.entries and (values or whole) else None,
        state=None if place is None else at_state(numeric, place, digits),
        units={name: units.si(dim) for name, dim in quantities.of_parameters(robot).items()},
    )
    return replace(solution, numbers=numbers)
