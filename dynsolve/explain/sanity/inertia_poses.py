"""The moments of inertia on the diagonal of D in poses of right angles."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import chain
from math import isqrt

from dynsolve.algebra.expr import Expr
from dynsolve.derivation.jacobian import joint_frame
from dynsolve.document import Inline, Prose, Reference, Table
from dynsolve.explain.context import Context
from dynsolve.explain.sanity.pose import Pose, at, turning_in, written
from dynsolve.explain.step import Step
from dynsolve.explain.working.sums import numbers_in
from dynsolve.explain.writing import and_joined, listed, measured, side_by_side, spong, sum_of
from dynsolve.notation.build import cost
from dynsolve.notation.tree import Node, Number, Power, Product, Sum, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Body, Coordinate, Joint, JointType

LONGEST = 40
"""The operations up to which a moment of inertia is of use to a reader."""

MOST_ANGLES = 2
"""Up to this number of angles a moment of inertia is shown in simple poses."""


def inertia_poses_step(context: Context) -> Step | None:
    """A table of the entries of the diagonal that belong to one turning joint and vary with angles."""
    shown = {q: rows for q in context.robot.coordinates if (rows := list(_rows(context, q)))}
    if not shown:
        return None
    names = [letters.entry("d", q.index, q.index) for q in shown]
    joints = [letters.z(joint_frame(context.robot, _joint(context, q))) for q in shown]
    one = len(shown) == 1
    why: Prose = (*listed(names), f" {'is the moment' if one else 'are the moments'} of inertia about ")
    numbers = [str(_joint(context, q).index) for q in shown]
    moved = f"joint {numbers[0]} moves, {_after(context, next(iter(shown)))} held: "
    if not one:
        moved = f"joints {and_joined(numbers)} move, respectively, the joints after them held: "
    why += (*listed(joints), f" of all that {moved}")
    why += ("each mass times the square of its distance from the axis, and each body's moment of inertia ",)
    why += ("about the parallel axis through its mass centre",)
    why += (", and those of the rotors. " if context.robot.actions.motors else ". ",)
    why += ("In simple poses this gives what ", letters.D, Reference(("D",), " in "), " has there:")
    return Step(
        id="inertia_poses",
        stage=Stage.VECTORIZED,
        title="Check: moments of inertia in simple poses",
        why=why,
        source=spong("7.2"),
        table=Table(("pose", "moment of inertia"), tuple(chain(*shown.values()))),
        outcome=(
            *listed(names),
            f" {'is the moment' if one else 'are the moments'} of inertia of all that the joint moves: ",
            "in simple poses the parallel-axis theorem gives the same.",
        ),
        is_task=False,
    )


def _after(context: Context, q: Coordinate) -> str:
    """joint 2, or the joints after it"""
    first = _joint(context, q).index
    others = [joint.index for joint in context.robot.joints if joint.type and joint.index > first]
    return f"joint {others[0]}" if len(others) == 1 else "the joints after it"


def _joint(context: Context, q: Coordinate) -> Joint:
    """The first joint that a coordinate moves."""
    return next(j for j in context.robot.joints if any(k == q.index - 1 for k, _ in j.rates))


def _turns_one_joint(context: Context, q: Coordinate) -> bool:
    moved = [j for j in context.robot.joints if any(k == q.index - 1 for k, _ in j.rates)]
    return (
        len(moved) == 1
        and moved[0].type is JointType.REVOLUTE
        and [abs(rate) for _, rate in moved[0].rates] == [1]
    )


def _rows(context: Context, q: Coordinate) -> Iterator[tuple[Inline, ...]]:
    """The poses that differ, each with the entry of the diagonal; none where one is too long."""
    value, ring = context.values["D"][q.index - 1, q.index - 1], context.robot.ring
    names = turning_in(context.robot, value)
    if not names or len(names) > MOST_ANGLES or not _turns_one_joint(context, q):
        return
    found: list[tuple[Expr, Pose]] = []
    for pose in _simple(names):
        there = at(ring, value, pose)
        if there not in [known for known, _ in found]:
            found.append((there, pose))
    forms = [context.show(there) for there, _ in found]
    if max(map(cost, forms)) > LONGEST:
        return
    for form, (there, pose) in zip(forms, found, strict=True):
        name = letters.entry("d", q.index, q.index)
        if there.is_number and not context.robot.parameters:
            entry = equation(name, _summed(context, q, pose), measured(form, "kg m²"))
        else:
            entry = equation(name, *_body_by_body(context, q, pose, form))
        yield side_by_side(written(pose)), entry


def _body_by_body(context: Context, q: Coordinate, pose: Pose, collected: Node) -> tuple[Node, ...]:
    """An entry in letters as what each body adds to it, and collected where that adds numbers up."""
    terms = _summed(context, q, pose)
    alike = [Counter(form.terms if isinstance(form, Sum) else (form,)) for form in (terms, collected)]
    if alike[0] == alike[1] or cost(terms) > LONGEST:
        return (collected,)
    return (terms,) if numbers_in(collected) <= numbers_in(terms) else (terms, collected)


def _summed(context: Context, q: Coordinate, pose: Pose) -> Node:
    """An entry as what is added to it: masses times squared distances, moments of inertia."""
    values, k = context.values, q.index - 1
    terms: list[Node] = []
    for body in context.robot.bodies:
        linear, angular = (at(context.robot.ring, values[f"D{part}{body.name}"][k, k], pose) for part in "vw")
        if not linear.is_zero:
            in_numbers = linear.is_number and body.mass.is_number
            terms.append(_mass_at_a_distance(context, body, k, pose) if in_numbers else context.show(linear))
        terms += [] if angular.is_zero else [context.show(angular)]
    rotors = at(context.robot.ring, values["Dm"][k, k], pose) if context.robot.actions.motors else None
    return sum_of([*terms, *([] if rotors is None or rotors.is_zero else [context.show(rotors)])])


def _mass_at_a_distance(context: Context, body: Body, k: int, pose: Pose) -> Node:
    """1.2·0.65², or 1.2 (0.5² + 0.15²) along the base's axes where the distance has no exact decimals."""
    ring = context.robot.ring
    there = {q.name: 0 for q in context.robot.coordinates} | dict(pose)
    along = [at(ring, row[k], there) for row in context.values[f"Jv{body.name}"].rows]
    squared = sum((part * part for part in along), start=ring.zero)
    root = Fraction(isqrt(squared.number.numerator), isqrt(squared.number.denominator))
    if root**2 == squared.number:
        along = [ring.constant(root)]
    elif not all(part.is_number for part in along):
        return Product((context.show(body.mass), context.show(squared)))
    squares = [
        Power(context.show(ring.constant(abs(part.number))), Number(2)) for part in along if not part.is_zero
    ]
    return Product((context.show(body.mass), sum_of(squares)))


def _simple(names: Sequence[str]) -> Iterator[Pose]:
    """All angles 0; one of them at 90° or 180°, the others 0."""
    rest = dict.fromkeys(names, 0)
    yield rest
    for name in names:
        yield from ({**rest, name: value} for value in (90, 180))
