"""What acts, as a file has it -> the robot's `Actions`, with exact values."""

from __future__ import annotations

from collections.abc import Sequence

from dynsolve.algebra.expr import Expr
from dynsolve.problem.actions import ParsedActions, ParsedFriction, ParsedMotor, ParsedSpring
from dynsolve.problem.cells import Cell
from dynsolve.problem.values import CellValues
from dynsolve.robot.actions import Actions, Damper, Elastic, JointFriction, Motor, Spring
from dynsolve.robot.shapes import AXES

HIGHEST_DEGREE = 8
"""The highest degree of an energy in coordinates, sines and cosines."""


def actions(values: CellValues, parsed: ParsedActions) -> Actions:
    """The actions of a file; what was reported is left out."""
    names = values.ring.names
    dampers = [(_constant(values, one.damping), _linear(values, one.of)) for one in parsed.dampers if one.of]
    springs = [_spring(values, one) for one in parsed.springs]
    motors = [_motor(values, one) for one in parsed.motors]
    return Actions(
        friction=tuple(_friction(values, one) for one in parsed.friction),
        dampers=tuple(Damper(b, x) for b, x in dampers if b is not None and x is not None),
        springs=tuple(spring for spring in springs if spring),
        motors=tuple(motor for motor in motors if motor),
        passive=tuple(sorted({names.index(name) for name in parsed.passive})),
    )


def _constant(values: CellValues, cell: Cell | None) -> Expr | None:
    """The value of a constant; a negative number is reported."""
    value = values.expr(cell) if cell else None
    if cell and value is not None and value.is_number and value.number < 0:
        values.faults.error(cell.span, f"{cell.what} is negative", "stiffness, friction and inertia are not")
    return value


def _friction(values: CellValues, parsed: ParsedFriction) -> JointFriction:
    viscous, coulomb = (_constant(values, cell) for cell in (parsed.viscous, parsed.coulomb))
    zero = values.ring.zero
    return JointFriction(values.ring.names.index(parsed.coordinate), viscous or zero, coulomb or zero)


def _linear(values: CellValues, cell: Cell) -> Expr | None:
    """A form that is linear in the coordinates, None (reported) where it is none."""
    value, ring = values.expr(cell), values.ring
    if value is None:
        return None
    slopes = [ring.diff(value, k) for k in range(len(ring.names))]
    rest = ring.at_rest(value)
    if all(slope.is_zero for slope in slopes):
        values.faults.error(cell.span, f"{cell.what} contains no coordinate", "write of: q2 - q1")
    elif any(map(ring.depends_on_coordinates, slopes)):
        help = "write a linear form: q2 - q1; a spring that is not linear is given by its `energy`"
        values.faults.error(cell.span, f"{cell.what} is not linear in the coordinates", help)
    elif not rest.is_zero:
        help = "a constant of a spring stands under `rest`"
        values.faults.error(cell.span, f"{cell.what} has a part without coordinates", help)
    else:
        return value
    return None


def _spring(values: CellValues, parsed: ParsedSpring) -> Spring | None:
    if parsed.energy:
        energy = values.expr(parsed.energy)
        return Spring(energy) if energy is not None and _is_admitted(values, parsed.energy, energy) else None
    stiffness = _constant(values, parsed.stiffness)
    x = _linear(values, parsed.of) if parsed.of else None
    rest = values.expr(parsed.rest) if parsed.rest else values.ring.zero
    if stiffness is None or x is None or rest is None:
        return None
    return Spring(stiffness * (x - rest) ** 2 / 2, Elastic(stiffness, x, rest))


def _is_admitted(values: CellValues, cell: Cell, energy: Expr) -> bool:
    """Whether an energy holds coordinates, of no higher degree than is read; else it is reported."""
    ring = values.ring
    if not ring.depends_on_coordinates(energy):
        values.faults.error(cell.span, f"{cell.what} contains no coordinate", "it is a function of them")
        return False
    moving = [g.index for g in ring.generators if ring.depends_on_coordinates(ring.generator(g.index))]
    degree = max(sum(exponents[i] for i in moving) for exponents in energy.poly.monoms())
    if degree > HIGHEST_DEGREE:
        message = f"{cell.what} is of degree {degree}; at most {HIGHEST_DEGREE} is read"
        values.faults.error(cell.span, message, "write an energy of a lower degree")
        return False
    return True


def _motor(values: CellValues, parsed: ParsedMotor) -> Motor | None:
    inertia, ratio = _constant(values, parsed.inertia), values.expr(parsed.ratio) if parsed.ratio else None
    names: Sequence[str] = values.ring.names
    if inertia is None or ratio is None or parsed.turns not in names or parsed.carrier is None:
        return None
    assert parsed.turns is not None
    if ratio.is_zero:
        assert parsed.ratio
        values.faults.error(
            parsed.ratio.span, "the ratio of a gear is not 0", "write ratio: kr1, or leave it out"
        )
    axis = AXES.index(parsed.axis) if parsed.axis else 2
    return Motor(names.index(parsed.turns), inertia, ratio, parsed.carrier, axis)
