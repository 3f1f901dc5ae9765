"""Steps of the Euler-Lagrange equations, a coordinate after the other."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.document import Prose
from dynsolve.explain.course import Course, listed, shv, turns
from dynsolve.explain.step import Detail, Step
from dynsolve.notation.tree import Negative, Node, Number, Sum, Symbol, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Coordinate

STAGE = Stage.TORQUE


def steps(course: Course) -> Iterator[Step]:
    """∂L/∂q̇, its rate, ∂L/∂q and the force, for each coordinate."""
    for q in course.robot.coordinates:
        yield _momentum(course, q)
        yield _rate(course, q)
        yield _slope(course, q)
        yield _force(course, q)


def _momentum(course: Course, q: Coordinate) -> Step:
    rate = letters.rate(q)
    return Step(
        id=f"dLdqd{q.index}",
        stage=STAGE,
        title=f"Coordinate {q.index}: generalized momentum",
        why=_partial(course, rate, "coordinate", "rate"),
        formula=None,
        source=shv("7.1"),
        result=(equation(letters.slope(letters.L, rate), course.form(f"dLdqd{q.index}")),),
    )


def _partial(course: Course, by: Node, held: str, like: str) -> Prose:
    """What is differentiated by what, and what is held fixed meanwhile."""
    fixed = f"the {held} is" if course.robot.n == 1 else f"the {held}s and the other {like}s are"
    return ("Differentiate L with respect to ", by, f" alone: {fixed} held fixed.")


def _rate(course: Course, q: Coordinate) -> Step:
    momentum = letters.slope(letters.L, letters.rate(q))
    return Step(
        id=f"ddt{q.index}",
        stage=STAGE,
        title=f"Coordinate {q.index}: time derivative of the momentum",
        why=_rate_why(course, q),
        source=shv("7.1"),
        result=(equation(letters.time_rate(momentum), course.form(f"ddt{q.index}")),),
    )


def _rate_why(course: Course, q: Coordinate) -> Prose:
    ring = course.robot.ring
    momentum = course.values[f"dLdqd{q.index}"]
    moving = [c for k, c in enumerate(course.robot.coordinates) if not ring.diff(momentum, k).is_zero]
    if not moving:
        return ("No coordinate stands in it: each rate becomes an acceleration, and nothing else changes.",)
    rates = "the rate" if course.robot.n == 1 else "the rates"
    return (
        f"Everything that changes with time is differentiated (product and chain rule): {rates}, and also ",
        *listed([Symbol(c.name) for c in moving]),
        ".",
    )


def _slope(course: Course, q: Coordinate) -> Step:
    form = course.form(f"dLdq{q.index}")
    why: Prose = _partial(course, Symbol(q.name), "rate", "coordinate")
    if form == Number(0):
        why = (Symbol(q.name), " itself does not stand in L.")
    return Step(
        id=f"dLdq{q.index}",
        stage=STAGE,
        title=f"Coordinate {q.index}: partial derivative of L",
        why=why,
        source=shv("7.1"),
        result=(equation(letters.slope(letters.L, Symbol(q.name)), form),),
    )


def _force(course: Course, q: Coordinate) -> Step:
    force = letters.force(q)
    momentum = letters.time_rate(letters.slope(letters.L, letters.rate(q)))
    slope = letters.slope(letters.L, Symbol(q.name))
    return Step(
        id=f"tau{q.index}",
        stage=STAGE,
        title=f"Coordinate {q.index}: the {'torque' if turns(q) else 'force'}",
        why=(
            Symbol(q.name),
            " is an angle, so what drives it is a torque."
            if turns(q)
            else " is a length, so what drives it is a force.",
        ),
        formula=equation(force, Sum((momentum, Negative(slope)))),
        source=shv("7.1"),
        result=(equation(force, course.form(f"tau{q.index}")),),
        detail=Detail.BRIEF,
    )
