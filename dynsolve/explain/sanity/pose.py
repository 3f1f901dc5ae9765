"""Poses: some joint angles at so many degrees, mostly quarter turns, everything else as it was."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from itertools import product

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.ring import Ring
from dynsolve.notation.tree import ZERO, Degrees, Negative, Node, Symbol, equation
from dynsolve.robot.model import JointType, Robot

Pose = Mapping[str, int]
"""Angles in degrees by the names of coordinates."""


def at(ring: Ring, expr: Expr, pose: Pose) -> Expr:
    """The value where the angles of a pose have their values."""
    point = [ring.generator(g.index).poly for g in ring.generators]
    used = expr.poly.degrees()
    for pair in ring.pairs:
        if used[pair.sine] > 0 or used[pair.cosine] > 0:
            angle = _angle_at(pair.angle, pose)
            point[pair.sine], point[pair.cosine] = ring.sin(angle).poly, ring.cos(angle).poly
    return Expr(ring, ring.reduce(expr.poly.compose(*point, ctx=ring.ctx)))


def _angle_at(angle: Angle, pose: Pose) -> Angle:
    moved = Angle((), angle.degrees)
    for atom, rate in angle.terms:
        name = atom[0][0]
        fixed = atom == ((name, 1),) and name in pose
        moved = moved + (Angle((), rate * pose[name]) if fixed else Angle(((atom, rate),)))
    return moved


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


def poses(names: Iterable[str], values: tuple[int, ...]) -> Iterator[Pose]:
    """Every choice of values for the angles."""
    names = list(names)
    for chosen in product(values, repeat=len(names)):
        yield dict(zip(names, chosen, strict=True))


def written(pose: Pose) -> list[Node]:
    """q₁ = -90°, q₂ = 0"""
    return [equation(Symbol(name), degrees(value)) for name, value in pose.items()]


def degrees(value: int) -> Node:
    """-90°; 0 without a sign of degrees."""
    if not value:
        return ZERO
    node = Degrees(abs(value))
    return Negative(node) if value < 0 else node
