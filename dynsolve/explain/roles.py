"""What the parameters of a problem are, by where they stand: a mass, a length of the table, a moment."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from enum import Enum

from dynsolve.algebra.angles import names_of
from dynsolve.algebra.expr import Expr
from dynsolve.notation.walk import names_in as names_in_trees
from dynsolve.robot.actions import Actions
from dynsolve.robot.dimensions import Dimensions
from dynsolve.robot.model import Robot
from dynsolve.robot.units import ENERGY, si


class Role(Enum):
    """A role: its meaning for several parameters and for one, in the order in which they are listed."""

    GRAVITY = "acceleration of gravity", "acceleration of gravity"
    LENGTH = "lengths in the table", "length in the table"
    ANGLE = "constant angles in the table", "constant angle in the table"
    BASE = "place of frame 0 in the world", "place of frame 0 in the world"
    TURN = "angles by which frame 0 is turned in the world", "angle by which frame 0 is turned in the world"
    MASS = "masses of the bodies", "mass of a body"
    INERTIA = "given moments of inertia", "given moment of inertia"
    PRODUCT = "given products of inertia", "given product of inertia"
    SHAPE = "dimensions of the bodies", "dimension of a body"
    CENTER = "place of the mass centres in their links", "place of a mass centre in its link"
    POSITION = "lengths in the given positions", "length in the given positions"
    ROTOR = "moments of inertia of the rotors", "moment of inertia of a rotor"
    RATIO = "ratios of the gears", "ratio of a gear"
    STIFFNESS = "stiffnesses of the springs", "stiffness of a spring"
    REST = "where the springs are relaxed", "where a spring is relaxed"
    VISCOUS = "coefficients of viscous friction", "coefficient of viscous friction"
    COULOMB = "coefficients of Coulomb friction", "coefficient of Coulomb friction"
    DAMPING = "coefficients of the dampers", "coefficient of a damper"
    OTHER = "parameters of the problem", "parameter of the problem"

    @property
    def meaning(self) -> str:
        """What several are."""
        return self.value[0]

    @property
    def of_one(self) -> str:
        """What one is."""
        return self.value[1]


def roles(robot: Robot) -> dict[str, tuple[Role, str]]:
    """The role and the SI unit of every parameter; the first role counts where one has several."""
    found: dict[str, Role] = {}
    for role, names in _places(robot):
        for name in names:
            if name in robot.parameters:
                found.setdefault(name, role)
    dimensions = _dimensions(robot)
    return {
        name: (role := found.get(name, Role.OTHER), "rad" if role is Role.TURN else dimensions.get(name, ""))
        for name in robot.parameters
    }


def _dimensions(robot: Robot) -> dict[str, str]:
    """Units of the parameters: a torque, or the stiffness of a torsion spring, is no energy."""
    known = Dimensions(robot.ring, robot)
    units: dict[str, str] = {}
    for generator in robot.ring.generators:
        if generator.kind == "symbol" and not generator.dots:
            found = known.of_generator(generator)
            units[generator.name] = "" if found is None else "N m" if found == ENERGY else si(found)
    return units


def _places(robot: Robot) -> Iterator[tuple[Role, Iterable[str]]]:
    """Where parameters stand, the strongest role first."""
    for entry in robot.gravity.entries:
        yield Role.GRAVITY, names_in(entry)
    for joint in robot.joints:
        yield Role.LENGTH, (*names_in(joint.d), *names_in(joint.a))
        yield Role.ANGLE, (*names_of(joint.theta), *names_of(joint.alpha))
    for entry in robot.base_position.entries:
        yield Role.BASE, names_in(entry)
    yield Role.TURN, names_in_trees(*(angle for _, angle in robot.base_turns))
    for body in robot.bodies:
        if body.density is None:
            yield Role.MASS, names_in(body.mass)
        elif body.density.shape is not None:
            for _, size in body.density.shape.dimensions:
                yield Role.SHAPE, names_in(size)
            yield Role.MASS, names_in_trees(body.density.formula)
    for body in robot.bodies:
        given = body.inertia.rows if body.inertia is not None else ()
        for i, j in ((i, j) for i, row in enumerate(given) for j in range(len(row))):
            own = Role.INERTIA if i == j else Role.PRODUCT
            yield own if body.shape is None else Role.SHAPE, names_in(given[i][j])
    for body in robot.bodies:
        for entry in body.center.entries:
            yield Role.CENTER if robot.has_table else Role.POSITION, names_in(entry)
        for turn in body.turns:
            yield Role.POSITION, (name for rate in turn.rates.entries for name in names_in(rate))
    yield from _places_in(robot.actions)


def _places_in(acting: Actions) -> Iterator[tuple[Role, Iterable[str]]]:
    """Where the parameters of what acts stand."""
    for motor in acting.motors:
        yield Role.ROTOR, names_in(motor.inertia)
        yield Role.RATIO, names_in(motor.ratio)
    for law in (spring.law for spring in acting.springs if spring.law):
        yield Role.STIFFNESS, names_in(law.stiffness)
        yield Role.REST, names_in(law.rest)
    for one in acting.friction:
        yield Role.VISCOUS, names_in(one.viscous)
        yield Role.COULOMB, names_in(one.coulomb)
    for damper in acting.dampers:
        yield Role.DAMPING, names_in(damper.damping)


def names_in(expr: Expr) -> Iterator[str]:
    """The symbols of a value."""
    for generator, degree in zip(expr.ring.generators, expr.poly.degrees(), strict=True):
        if degree > 0 and generator.kind == "symbol":
            yield generator.name
