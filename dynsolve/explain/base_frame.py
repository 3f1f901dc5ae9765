"""The step of the base frame, H_0 in the world, and the elementary motions that matrices are products of."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.step import Detail, Step
from dynsolve.explain.writing import spong
from dynsolve.notation.tree import Letter, Node, Product, Row, Words, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Robot


def motion(axis: str, amount: Node, turns: bool) -> Node:
    """Rot_{z,θ} or Trans_{z,d}: how far is a value, and set as values are, not as what names an index."""
    return Letter("Rot" if turns else "Trans", _along(axis, amount), style="upright")


def rotation(axis: str, angle: Node) -> Node:
    """R_{z,θ}: the 3×3 part of Rot_{z,θ}."""
    return Letter("R", _along(axis, angle), style="bold")


def turned(turns: Sequence[tuple[str, Node]]) -> Node:
    """R_{z,θ} R_{x,α}: elementary rotations one after the other."""
    factors = tuple(rotation(axis, angle) for axis, angle in turns)
    return Product(factors) if len(factors) > 1 else factors[0]


def _along(axis: str, amount: Node) -> Row:
    return Row((Words(axis), Words(","), Row((amount,))))


def base_step(context: Context) -> Step:
    """H_0, the product of how frame 0 is moved and turned, as the problem writes it."""
    robot = context.robot
    H, turned = letters.H(robot, 0), robot.base_rotation
    moved = tuple(
        motion(axis, context.show(entry), False)
        for axis, entry in zip("xyz", robot.base_position.entries, strict=True)
        if not entry.is_zero
    )
    is_turned = turned != turned.identity(robot.ring, 3)
    how = " and ".join([*["turned"] * is_turned, *["moved"] * bool(moved)])
    why: Prose = (f"Gravity is given in the world w, in which frame 0 is {how}. ",)
    factors = (*moved, *(motion(axis, angle, True) for axis, angle in robot.base_turns))
    is_whole = bool(robot.base_turns) or not is_turned
    if not is_whole:
        why += ("Its axes are the columns of the rotation that the problem gives. ",)
    elif len(factors) > 1:
        why += ("Each motion is along or about an axis of the frame that those before it have led to. ",)
    why += ("The heights, and the vectors below where nothing else is said, are in world coordinates.",)
    return Step(
        id="H0",
        stage=Stage.KINEMATICS,
        title="The base frame in the world",
        why=why,
        formula=equation(H, Product(factors) if len(factors) > 1 else factors[0]) if is_whole else None,
        source=spong("2.7"),
        result=(equation(H, context.form("H0")),),
        notes=tuple(_matters_to(robot)),
        detail=Detail.BRIEF,
    )


def _matters_to(robot: Robot) -> Iterator[Prose]:
    """Where frame 0 is turned against gravity: which of the results depend on how."""
    if robot.bodies and robot.base_rotation @ robot.gravity != robot.gravity:
        yield (
            "In the results, how the base is turned matters to the potential energy and the gravity terms "
            "alone: a constant rotation leaves lengths unchanged, so it cancels in the kinetic energy.",
        )
