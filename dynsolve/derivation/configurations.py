"""Where the arm is singular, and which configurations reach a point: rules where a file asks for them.

What computes them is imported when it is asked for, so that no other solution pays for it.

Branches of the inverse kinematics and singular configurations as they are printed, held in numbers.

A branch is put into r(q) at values of the task that a configuration of a sample reaches; one of the
branches must be that configuration.  Where an alternative of a singular set holds, found by
Newton's method from samples, the Jacobian has less than its greatest rank; at the samples it has
that rank.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import islice, product
from math import pi
from operator import mul
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring_values import evaluate
from dynsolve.algebra.sampling import ENOUGH, samples
from dynsolve.derivation.arm_values import states_with
from dynsolve.derivation.elimination import rank, shortest_step
from dynsolve.derivation.graph import Rule, Skipped
from dynsolve.derivation.inverse.solving import MOST
from dynsolve.derivation.rates import whole_or_task
from dynsolve.derivation.reached import CLOSE, near, same_configuration
from dynsolve.errors import VerificationError
from dynsolve.notation.tree import Node
from dynsolve.notation.tree_values import Program, compile_trees
from dynsolve.quantities.owners import asked_stages
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Robot

if TYPE_CHECKING:
    from dynsolve.derivation.inverse.solving import Branch, Solving
    from dynsolve.derivation.singular.sets import SingularSet

NO_CLOSED_FORM = "no closed form was found"
REDUNDANT = "the arm has more joints than the task: infinitely many configurations reach it"

_STEP = 1e-5


class Inverse(Struct, frozen=True):
    """How a task is solved, and the branches that solve it."""

    solving: Solving
    branches: tuple[Branch, ...]


class NoClosedForm(Struct, frozen=True):
    """A task that the known forms do not solve; what reaches a target in numbers is looked for there."""


def configuration_rules(robot: Robot) -> Iterator[Rule]:
    """The rules of singular configurations and of inverse kinematics, where they are asked for."""
    stages = asked_stages(robot.questions)
    if Stage.SINGULAR in stages:
        yield Rule("singular", (whole_or_task(robot),), where_singular)
    task = robot.questions.task
    if Stage.INVERSE in stages and task is not None and task.reached:
        yield Rule("inverse", ("pose" if task.is_pose else "r",), lambda r: inverse(robot, r))


def where_singular(jacobian: Matrix) -> SingularSet | Skipped:
    """Where a Jacobian has less than its greatest rank (Spong, section 4.9)."""
    from dynsolve.algebra.sampling import Transfer
    from dynsolve.derivation.inverse.equations import search_ring
    from dynsolve.derivation.singular.sets import singular_set

    ring = search_ring(jacobian.ring, (), {})
    found = singular_set(jacobian.map(Transfer(jacobian.ring, ring)))
    return found or Skipped("the Jacobian and its minors are too long to be taken apart into factors")


def inverse(robot: Robot, r: Matrix) -> Inverse | NoClosedForm | Skipped:
    """q from r(q) = r, where a closed form is found (Spong, section 3.3).

    `r` is r(q), m×1, or of a pose its position and the rows of its rotation, 12×1.
    """
    from dynsolve.derivation.inverse.pose import solve_pose
    from dynsolve.derivation.inverse.search import solve_task, with_conditions
    from dynsolve.derivation.inverse.solving import branches

    task, names = robot.questions.task, robot.questions.reached
    is_pose = task is not None and task.is_pose
    solving = solve_pose(robot, r, names) if is_pose else solve_task(r, names)
    found = None if solving is None else branches(solving)
    if solving is not None and found is not None and solving.conditions > 0:
        found = with_conditions(solving, found)
    if solving is None or found is None:
        has_target = robot.questions.target is not None and not without_number(robot, r)
        return NoClosedForm() if has_target else Skipped(REDUNDANT if is_redundant(r) else NO_CLOSED_FORM)
    return Inverse(solving, found)


def is_redundant(r: Matrix) -> bool:
    """Whether joints can move and leave the task where it is, at a sample."""
    names, at = r.ring.names, next(samples(r.ring))
    ends = [
        [evaluate(entry, {**at, name: at[name] + step}) for entry in r.entries]
        for name in names for step in (_STEP, -_STEP)
    ]  # fmt: skip
    columns = [
        [(a - b) / (2 * _STEP) for a, b in zip(*pair, strict=True)]
        for pair in zip(ends[::2], ends[1::2], strict=True)
    ]
    return rank(columns, _STEP) < len(names)


def without_number(robot: Robot, r: Matrix) -> str:
    """The first parameter of the task that has no number where the target has; nothing where all have."""
    if robot.questions.target is None:
        return ""
    at = dict.fromkeys((*robot.ring.names, *dict(robot.questions.target.numbers)), 0.0)
    for entry in r.entries:
        try:
            evaluate(entry, at)
        except KeyError as error:
            return str(error.args[0])
    return ""


# Branches of the inverse kinematics and singular configurations as they are printed, held in numbers

NEWTON_STEPS = 60
MOST_TURNS = 128
DIFFERENCE = 1e-6
SMALL = 1e-9

Values = Mapping[str, float]


class Condition(Struct, frozen=True):
    """Two formulas that are to be equal, angles modulo 2π."""

    sides: tuple[Node, Node]
    is_angle: bool = False


Conditions = tuple[Condition, ...]

NO_VALUE = (KeyError, ValueError, TypeError, ArithmeticError)
"""What is raised where a formula has no real value, or lacks one of a name."""


def verify_inverse(
    robot: Robot, r: Node, angles: Sequence[bool], branches: Sequence[tuple[Mapping[str, Node], Conditions]]
) -> None:
    """Put every branch into r(q), whose components are lengths or `angles`, where its conditions hold.

    Raises VerificationError where one is none, or one is missing.
    """
    task, solutions = compile_trees([r]), [solution_of(*branch) for branch in branches]
    for values in states_of(robot, task, MOST):  # not those that the branches were found with
        reached = reaches(task, values)
        given = {**values, **dict(zip(robot.questions.reached, reached, strict=True))}
        found = [q for q in (solution(given) for solution in solutions) if q is not None]
        if not all(near(reaches(task, q), reached, angles) for q in found):
            raise VerificationError("a branch of the inverse kinematics does not reach what it should")
        if not any(same_configuration(robot.ring, q, values) for q in found):
            raise VerificationError("a branch of the inverse kinematics is missing")


def verify_target(
    robot: Robot,
    r: Node,
    angles: Sequence[bool],
    given: Values,
    configurations: Sequence[tuple[Mapping[str, Node], Sequence[str]]],
) -> None:
    """Put configurations as they are printed into r(q), each with the names of what is free in it.

    `given` are the values of the parameters and of the task.  Raises VerificationError where one
    does not reach the target.
    """
    task = compile_trees([r])
    wanted = [given[name] for name in robot.questions.reached]
    for formulas, free in configurations:
        for place in (0.0, 1.0) if free else (0.0,):
            q = on_branch(formulas, {**given, **dict.fromkeys(free, place)})
            if q is None or not near(reaches(task, q), wanted, angles):
                raise VerificationError("a configuration does not reach the target of the inverse kinematics")


def reaches(task: Program, q: Values) -> list[float]:
    """r(q)"""
    (value,) = task.run(q)
    return _flat(value)


def on_branch(branch: Mapping[str, Node], given: Values) -> dict[str, float] | None:
    """The configuration; None where the branch does not exist, or a formula lacks a value."""
    return solution_of(branch)(given)


def holds(condition: Condition, values: Values) -> bool:
    """Whether both sides of a condition are the same."""
    return solution_of({}, (condition,))(values) is not None


def solution_of(
    branch: Mapping[str, Node], when: Conditions = ()
) -> Callable[[Values], dict[str, float] | None]:
    """The same as `on_branch` for many places; None where a condition does not hold, too."""
    try:
        programs = {name: compile_trees([formula]) for name, formula in branch.items()}
        sides = compile_trees([side for one in when for side in one.sides])
    except NO_VALUE:
        return lambda given: None
    turns = [one.is_angle for one in when]

    def at(given: Values) -> dict[str, float] | None:
        q = dict(given)
        try:
            for name, program in programs.items():
                (q[name],) = program.run(q)
            values = sides.run(q)
        except NO_VALUE:
            return None
        return q if near(values[1::2], values[::2], turns) else None

    return at


class Singular(Struct, frozen=True):
    """Expressions that are 0 together, the rank there, and the directions that are lost, m×1 each."""

    zeros: Sequence[Node]
    rank: int
    lost: Sequence[Node]


def verify_singular(robot: Robot, jacobian: Node, rank: int, cases: Sequence[Singular]) -> None:
    """Compare the rank of a Jacobian at singular and at other configurations.

    Raises VerificationError where it is not what it should be, or a lost direction is none.
    """
    program = compile_trees([jacobian])
    states = states_of(robot, program)
    for values in states:
        if rank_of(program.run(values)[0]) != rank:
            raise VerificationError("the rank of the Jacobian is not what it should be")
    for case in cases:
        zeros, lost = compile_trees(case.zeros), compile_trees(case.lost)
        found = (zero_near(robot, zeros, values) for values in states)
        ranks: list[int] = []
        for at in (values for values in found if values is not None):
            J = program.run(at)[0]
            ranks.append(rank_of(J))
            columns = list(zip(*J, strict=True))
            if any(abs(sum(map(mul, _flat(w), column))) > CLOSE for w in lost.run(at) for column in columns):
                raise VerificationError("a direction that should be lost is not")
        if ranks and max(ranks) != case.rank:  # it is less where an alternative meets itself or another
            raise VerificationError("the rank at a singular configuration is not what it should be")


def states_of(robot: Robot, program: Program, first: int = 0) -> list[dict[str, float]]:
    """Configurations in all quadrants with parameters for which formulas have a value."""
    found = states_with(robot.ring, program.run, first=first)
    return [values for values, _ in islice(found, ENOUGH)]


def zero_near(robot: Robot, zeros: Program, start: Values) -> dict[str, float] | None:
    """A configuration near `start` at which everything is 0, by Newton's method; None where none is found."""
    try:
        return _newton(robot, zeros, start)
    except NO_VALUE:
        return None


def with_half_turns(
    robot: Robot, zeros: Program, points: Iterable[dict[str, float]]
) -> Iterator[dict[str, float]]:
    """Points at which everything is 0, and those that are the first of them with angles half a turn on.

    Which of q = 0 and q = π Newton's method finds of sin q = 0 is chance; these are all.
    """
    turning = [name for name, kind in robot.ring.coordinates if kind == "revolute"]
    for number, q in enumerate(points):
        yield q
        ways = product((0.0, pi), repeat=len(turning)) if number == 0 else ()
        for turns in islice(ways, 1, MOST_TURNS):
            turned = q | {name: q[name] + turn for name, turn in zip(turning, turns, strict=True)}
            if is_zero(zeros, turned):
                yield turned


def is_zero(program: Program, at: Values) -> bool:
    """Whether everything is 0, and has a value."""
    try:
        return all(abs(value) < CLOSE for value in program.run(at))
    except NO_VALUE:
        return False


def _newton(robot: Robot, zeros: Program, start: Values) -> dict[str, float] | None:
    """Until nothing moves any more: near a double root, as of cos q = 1, an equation is 0 long before."""
    at = dict(start)
    names = [q.name for q in robot.coordinates]
    for _ in range(NEWTON_STEPS):
        f = zeros.run(at)
        ahead, behind = (
            [zeros.run({**at, name: at[name] + step}) for name in names] for step in (DIFFERENCE, -DIFFERENCE)
        )
        rows = [
            [(a[k] - b[k]) / (2 * DIFFERENCE) for a, b in zip(ahead, behind, strict=True)]
            for k in range(len(f))
        ]
        step = shortest_step(f, rows)
        for name, x in zip(names, step, strict=True):
            at[name] += x
        moved = max(map(abs, step), default=0.0)
        if moved < SMALL and max(map(abs, f)) < CLOSE**2:
            return at
    return None


def rank_of(rows: Sequence[Sequence[float]]) -> int:
    """The rank of a Jacobian in numbers."""
    return rank(rows, CLOSE, scale=1.0)


def _flat(value: Any) -> list[float]:
    return [entry for row in value for entry in row]
