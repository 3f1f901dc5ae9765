"""The moments of inertia on the diagonal of D in poses of right angles."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import chain
from math import isqrt

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.derivation.kinematics import joint_frame
from dynsolve.document import Inline, Prose, Reference, Table
from dynsolve.document.books import spong
from dynsolve.document.sentences import say
from dynsolve.explain.body_parts import linear_name
from dynsolve.explain.context import Context
from dynsolve.explain.named_steps import looked_at
from dynsolve.explain.step import Step
from dynsolve.explain.working.derivatives import numbers_in
from dynsolve.explain.writing import and_joined, is_small, listed, measured, side_by_side, sum_of
from dynsolve.notation.build import cost
from dynsolve.notation.tree import (
    ZERO,
    Degrees,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Sum,
    Symbol,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.robot.model import Body, Coordinate, JointType, Robot

LONGEST = 40
"""The operations up to which a moment of inertia is of use to a reader."""

MOST_ANGLES = 2
"""Up to this number of angles a moment of inertia is shown in simple poses."""


def inertia_poses_step(context: Context) -> Step | None:
    """A table of the entries of the diagonal that belong to one turning joint and vary with angles."""
    shown = {q: rows for q in context.robot.coordinates if (rows := list(_rows(context, q)))}
    if not shown:
        return None
    names = listed([letters.entry("d", q.index, q.index) for q in shown])
    of_rotors = context.values["Dm"] if context.robot.actions.rotors else None
    turned = [q for q in shown if of_rotors is not None and not of_rotors[q.index - 1, q.index - 1].is_zero]
    moved = [context.robot.joints_of(q)[0][0] for q in shown]
    robot = context.robot
    after = [robot.number_of(j) for j in robot.joints if j.type and j.index > moved[0].index]
    following = f"joint {after[0]}" if len(after) == 1 else "the joints after it"
    added = "the rotor adds" if len(context.robot.actions.rotors) == 1 else "the rotors add"
    rotors = say(f", with what {added}") if turned else ()
    if 0 < len(turned) < len(shown):
        to = listed([letters.entry("d", q.index, q.index) for q in turned])
        rotors = say(f", with what {added} to {{to}}", to=to)
    all_that = "the bodies that" if turned else "all that"
    one = len(shown) == 1
    numbers = and_joined([str(robot.number_of(joint)) for joint in moved])
    moves = f"joint {numbers} moves" if one else f"joints {numbers} move"
    are = "is the moment" if one else "are the moments"
    why = say(
        "{names} {are} of inertia about {axes} of {all_that} {moved} held{rotors}: each mass times the "
        "square of its distance from the axis, and each body's moment of inertia about the parallel axis "
        "through its mass centre. In simple poses this gives what $𝐃${where} has there:",
        names=names,
        are=are,
        axes=listed([letters.z(joint_frame(context.robot, joint)) for joint in moved]),
        moved=f"{moves}, {following if one else 'respectively, the joints after them'}",
        all_that=all_that,
        rotors=rotors,
        where=Reference(looked_at(context, "D", [context.result("D")]), " in "),
    )
    linear = (context.values[f"Dv{body.name}"] for body in context.robot.bodies)
    is_off_axis = any(not part[q.index - 1, q.index - 1].is_zero for part in linear for q in shown)
    theorem = ": in simple poses the parallel-axis theorem gives the same"
    theorem += " for the bodies" * bool(turned)
    return Step(
        id="inertia_poses",
        title="Check: moments of inertia in simple poses",
        why=why,
        source=spong("7.2"),
        table=Table(("pose", "moment of inertia"), tuple(chain(*shown.values()))),
        outcome=say(
            "{names} {are} of inertia of {all_that} {moves}{rotors}{theorem}.",
            moves=moves,
            all_that=all_that,
            rotors=rotors,
            theorem=theorem * is_off_axis,
            names=names,
            are=are,
        ),
        is_task=False,
    )


def _rows(context: Context, q: Coordinate) -> Iterator[tuple[Inline, ...]]:
    """The poses that differ, each with the entry of the diagonal; none where one is too long."""
    value, ring = context.values["D"][q.index - 1, q.index - 1], context.robot.ring
    names = turning_in(context.robot, value)
    moved = context.robot.joints_of(q)
    turns_one = len(moved) == 1 and moved[0][0].type is JointType.REVOLUTE and abs(moved[0][1]) == 1
    if not names or len(names) > MOST_ANGLES or not turns_one:
        return
    straight: Pose = dict.fromkeys(names, 0)
    found: dict[Expr, Pose] = {}
    for simple in (straight, *({**straight, name: angle} for name in names for angle in (90, 180))):
        found.setdefault(ring.at_pose(value, simple), simple)
    forms = [context.show(there) for there in found]
    if max(map(cost, forms)) > LONGEST:
        return
    name = letters.entry("d", q.index, q.index)
    for form, (there, pose) in zip(forms, found.items(), strict=True):
        if there.is_number and not context.robot.parameters:
            values = [_summed(context, q, pose), measured(form, "kg m²")]
        else:
            values = _body_by_body(context, q, pose, form)
        written = [equation(Symbol(name), degrees(value)) for name, value in pose.items()]
        yield side_by_side(written), equation(name, *values)


def _body_by_body(context: Context, q: Coordinate, pose: Pose, collected: Node) -> list[Node]:
    """An entry in letters as what each body adds to it, and collected where that adds numbers up."""
    terms = _summed(context, q, pose)
    alike = [Counter(form.terms if isinstance(form, Sum) else (form,)) for form in (terms, collected)]
    if alike[0] == alike[1] or cost(terms) > LONGEST:
        return [collected]
    return [terms] if numbers_in(collected) <= numbers_in(terms) else [terms, collected]


def _summed(context: Context, q: Coordinate, pose: Pose) -> Node:
    """An entry as what is added to it: masses times squared distances, moments of inertia."""
    values, k = context.values, q.index - 1
    terms: list[Node] = []
    for body in context.robot.bodies:
        linear, angular = (
            context.robot.ring.at_pose(values[f"D{part}{body.name}"][k, k], pose) for part in "vw"
        )
        if not linear.is_zero:
            in_numbers = linear.is_number and body.mass.is_number
            terms.append(_mass_at_a_distance(context, body, k, pose) if in_numbers else context.show(linear))
        terms += [] if angular.is_zero else [context.show(angular)]
    rotors = context.robot.ring.at_pose(values["Dm"][k, k], pose) if context.robot.actions.rotors else None
    return sum_of([*terms, *([] if rotors is None or rotors.is_zero else [context.show(rotors)])])


def _mass_at_a_distance(context: Context, body: Body, k: int, pose: Pose) -> Node:
    """1.2·0.65², or 1.2 (0.5² + 0.15²) along the base's axes where the distance has no exact decimals."""
    ring = context.robot.ring
    there = {q.name: 0 for q in context.robot.coordinates} | dict(pose)
    along = [ring.at_pose(row[k], there) for row in context.values[f"Jv{body.name}"].rows]
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


# -- poses: some joint angles at so many degrees, mostly quarter turns, everything else as it was --

Pose = Mapping[str, int]
"""Angles in degrees by the names of coordinates."""


def turning_in(robot: Robot, *values: Expr) -> list[str] | None:
    """The angles that stand in values; None where a pose has no exact value for one."""
    ring = robot.ring
    found = []
    for k, q in enumerate(robot.coordinates):
        if q.type is JointType.REVOLUTE and any(not ring.diff(value, k).is_zero for value in values):
            if any(_stands_bare(ring, value, q.name) for value in values):
                return None
            found.append(q.name)
    return found


def _stands_bare(ring: Ring, value: Expr, name: str) -> bool:
    """Whether a coordinate stands outside of sines and cosines, or halved or in a product inside of them."""
    inside = [(atom, rate) for pair in ring.pairs for atom, rate in pair.angle.terms if name in dict(atom)]
    odd = any(atom != ((name, 1),) or rate.denominator != 1 for atom, rate in inside)
    return odd or value.poly.degrees()[ring.symbol_indices[(name, 0)]] > 0


def degrees(value: int) -> Node:
    """-90°; 0 without a sign of degrees."""
    if not value:
        return ZERO
    node = Degrees(abs(value))
    return Negative(node) if value < 0 else node


# -- d where every body is a point at its mass centre, and what the moments of inertia add ---------


def point_masses_step(context: Context) -> Step | None:
    """D_points = Σ m J_vᵀ J_v and D - D_points; None where the one or the other is nothing.

    None of numbers either, in which what is left over cannot be seen, nor where it is the same in
    every pose and stands beside the masses in the moments of inertia in simple poses.
    """
    values, robot = context.values, context.robot
    if not robot.parameters:
        return None
    parts = [values[f"Dv{body.name}"] for body in robot.bodies]
    points = sum(parts, start=Matrix.zero(robot.ring, robot.n, robot.n))
    if points.is_zero or points == values["D"]:
        return None
    left_over = values["D"] - points
    varies = any(robot.ring.depends_on_coordinates(entry) for entry in left_over.entries)
    mass, rest = context.show(points), context.show(left_over)
    if not is_small(rest) or (not varies and inertia_poses_step(context) is not None):
        return None
    moving = [body for body in robot.bodies if not values[f"Dv{body.name}"].is_zero]
    return Step(
        id="point_masses",
        title="Check: point masses",
        why=_why(context, moving),
        formula=equation(letters.D_POINTS, sum_of([linear_name(context, body) for body in moving])),
        source=spong("7.2.2"),
        result=(
            equation(letters.D_POINTS, mass),
            equation(Sum((letters.D, Negative(letters.D_POINTS))), rest),
        ),
        uses=(*(f"D_direct{body.name}" for body in moving), "D"),
        names=looked_at(context, "D", [context.result("D")])[1:],
        is_task=False,
    )


def _why(context: Context, moving: Sequence[Body]) -> Prose:
    """What is left of D where these mass centres move, and which entries the rest cannot have."""
    robot, values = context.robot, context.values
    still = [body.name for body in robot.bodies if body not in moving]
    zero = "those of bodies {these} are" if len(still) > 1 else "that of body {these} is"
    rotational = [
        f"Dw{body.name}" if body in moving else f"D_direct{body.name}"  # beside a linear part that is zero
        for body in robot.bodies
        if not values[f"Dw{body.name}"].is_zero
    ]
    sliding = [Symbol(q.name) for q in robot.coordinates if q.type is JointType.PRISMATIC]
    turn_none = "; nothing for {names}, which turn{s} no body"
    return say(
        "Without the moments of inertia of the bodies{rotors} each body is a point at its mass centre, and "
        "$𝐃$ is {points}, the sum of the linear parts{zero}. What is left over of $𝐃${where} is what the "
        "turning of the bodies{rotors} adds: the rotational parts{parts}{sliding}.",
        rotors=" and of the rotors" if robot.actions.rotors else "",
        points=letters.D_POINTS,
        zero=say(f" ({zero} zero)", these=and_joined(still)) if still else "",
        where=Reference(looked_at(context, "D", [context.result("D")]), " in "),
        parts=Reference(tuple(rotational), " in "),
        sliding=say(turn_none, names=listed(sliding), s="s" * (len(sliding) == 1))
        if robot.has_table and sliding and not robot.actions.rotors
        else "",
    )
