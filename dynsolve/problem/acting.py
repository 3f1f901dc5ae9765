"""`friction`, `springs`, `dampers`, `motors` and `passive` of a problem file -> the robot's `Actions`."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from msgspec import Struct

from dynsolve.algebra.expr import Expr
from dynsolve.problem.action_keys import ACTION_KEYS, FRICTION, VISCOUS
from dynsolve.problem.cells import Cell, read_cell
from dynsolve.problem.decoder import Decoder, Record, Stated
from dynsolve.problem.kinds import Fields, items
from dynsolve.problem.specification import PROBLEM
from dynsolve.problem.table import by_coordinate, known_coordinate
from dynsolve.problem.values import CellValues
from dynsolve.problem.yaml_nodes import Faults, FaultyNode, MappingNode, YamlNode
from dynsolve.robot.actions import Actions, Damper, Elastic, JointFriction, Motor, Spring
from dynsolve.robot.shapes import AXES

HIGHEST_DEGREE = 8
"""The highest degree of an energy in coordinates, sines and cosines."""


class Acting(Struct, frozen=True):
    """What acts on the robot, as the file has it; friction by coordinate, viscous and Coulomb's."""

    stated: tuple[Stated, ...] = ()
    friction: Mapping[str, tuple[Cell | None, Cell | None]] = {}
    springs: tuple[Record, ...] = ()
    dampers: tuple[Record, ...] = ()
    motors: tuple[Record, ...] = ()
    passive: tuple[str, ...] = ()

    @property
    def kinds(self) -> frozenset[str]:
        """What there is of it, as `Actions.kinds`."""
        found = {"friction": self.friction or self.dampers, "springs": self.springs, "motors": self.motors}
        return frozenset(kind for kind, there in found.items() if there)

    @property
    def signs(self) -> tuple[str, ...]:
        """The coordinates with Coulomb friction: the signs of their rates occur."""
        return tuple(name for name, (_, coulomb) in self.friction.items() if coulomb)


def read_actions(decoder: Decoder, fields: Fields) -> Acting:
    """The keys of a file that say what acts; what is wrong with one is reported."""
    friction = _read_friction(decoder, fields.get("friction"))
    springs, dampers, motors = (
        tuple(decoder.entries(fields, PROBLEM[key])) for key in ("springs", "dampers", "motors")
    )
    for spring in springs:
        _check_spring(spring)
    for motor in motors:
        _check_motor(motor, decoder.rows)
    help = PROBLEM["passive"].help
    listed = items(decoder.faults, fields.get("passive"), "passive", help)
    names = [known_coordinate(decoder.faults, item, decoder.coordinates, help) for item in listed]
    passive = tuple(name for name in names if name)
    return Acting(tuple(decoder.stated), friction, springs, dampers, motors, passive)


def _read_friction(decoder: Decoder, node: YamlNode | None) -> dict[str, tuple[Cell | None, Cell | None]]:
    faults, help = decoder.faults, PROBLEM["friction"].help
    if not isinstance(node, MappingNode):
        if node is not None and not isinstance(node, FaultyNode):
            faults.error(node.span, "friction is a mapping from coordinates to their friction", help)
        return {}
    found: dict[str, tuple[Cell | None, Cell | None]] = {}
    for name, value in by_coordinate(faults, node, decoder.coordinates, help):
        what = f"the friction of {name}"
        if not isinstance(value, MappingNode):
            found[name] = decoder.cell(VISCOUS, read_cell(faults, value, what)), None
            continue
        record = Record(decoder, value, FRICTION, what)
        if all(record.lacks(key) for key in FRICTION.names):
            faults.error(value.span, f"{what} is empty", help)
        found[name] = record["viscous"], record["coulomb"]
    return found


def _check_spring(spring: Record) -> None:
    help = PROBLEM["springs"].help
    law = [key for key in ("stiffness", "of", "rest") if key in spring]
    if "energy" in spring and law:
        message = f"{spring.what} has an `energy` and a `{law[0]}`"
        spring.faults.error(spring.key_span(law[0]), message, "give one of them: " + help)
    elif spring.lacks("energy"):
        for key in ("stiffness", "of"):
            if spring.lacks(key):
                spring.faults.error(spring.span, f"{spring.what} has no `{key}`", help)


def _check_motor(motor: Record, rows: int) -> None:
    if "carrier" in motor and not rows:
        message = f"{motor.what} has a `carrier`, and there is no table whose links could carry it"
        motor.faults.error(motor.key_span("carrier"), message, "leave it out, or give a `dh` table")
    elif "axis" in motor and "carrier" not in motor:
        message = f"`axis` of {motor.what} is that of a carrier, and there is none"
        motor.faults.error(motor.key_span("axis"), message, "add carrier: 1, or leave `axis` out")


_TAKEN = {"springs": ("s", "P_s", "the springs"), "motors": ("m", "K_m", "the rotors")}
"""The body's name, and what it would call by the same letter as these."""


def check_bodies(
    faults: Faults, fields: Fields, acting: Acting, bodies: Collection[str], has_mass: bool
) -> None:
    """Report that nothing has mass, and a body whose energy would be called as that of springs or rotors."""
    if not has_mass:
        key = next(key.name for key in ACTION_KEYS if key.name in fields)
        message = f"`{key}` stands in the equations of motion, and nothing has mass"
        faults.error(fields.key_span(key), message, "give the bodies under `masses`")
    for kind in sorted(acting.kinds & _TAKEN.keys()):
        name, letter, of = _TAKEN[kind]
        if name in bodies:
            message = f"{letter} is the energy of {of}, and a body is called {name}, too"
            faults.error(fields.key_span(kind), message, "give the body another name")


# -- with exact values -----------------------------------------------------------------------------


def actions(values: CellValues, acting: Acting) -> Actions:
    """The actions of a file; what was reported is left out."""
    names = values.ring.names
    dampers = [(_constant(values, one["damping"]), _linear(values, one["of"])) for one in acting.dampers]
    springs = [_spring(values, one) for one in acting.springs]
    motors = [_motor(values, one) for one in acting.motors]
    return Actions(
        friction=tuple(
            JointFriction(names.index(name), *(_constant(values, cell) or values.ring.zero for cell in cells))
            for name, cells in acting.friction.items()
        ),
        dampers=tuple(Damper(b, x) for b, x in dampers if b is not None and x is not None),
        springs=tuple(spring for spring in springs if spring),
        motors=tuple(motor for motor in motors if motor),
        passive=tuple(sorted({names.index(name) for name in acting.passive})),
    )


def _constant(values: CellValues, cell: Cell | None) -> Expr | None:
    """The value of a constant; a negative number is reported."""
    value = values.expr(cell) if cell else None
    if cell and value is not None and value.is_number and value.number < 0:
        values.faults.error(cell.span, f"{cell.what} is negative", "stiffness, friction and inertia are not")
    return value


def _linear(values: CellValues, cell: Cell | None) -> Expr | None:
    """A form that is linear in the coordinates, None (reported) where it is none."""
    value, ring = values.expr(cell) if cell else None, values.ring
    if cell is None or value is None:
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


def _spring(values: CellValues, spring: Record) -> Spring | None:
    if cell := spring["energy"]:
        energy = values.expr(cell)
        return Spring(energy) if energy is not None and _is_admitted(values, cell, energy) else None
    stiffness, x = _constant(values, spring["stiffness"]), _linear(values, spring["of"])
    rest = values.expr(spring["rest"]) if spring["rest"] else values.ring.zero
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


def _motor(values: CellValues, motor: Record) -> Motor | None:
    names: Sequence[str] = values.ring.names
    inertia = _constant(values, motor["inertia"])
    ratio = values.expr(motor["ratio"]) if motor["ratio"] else values.ring.one
    if inertia is None or ratio is None or motor["turns"] not in names:
        return None
    if ratio.is_zero:
        help = "write ratio: kr1, or leave it out"
        values.faults.error(motor["ratio"].span, "the ratio of a gear is not 0", help)
    axis = AXES.index(motor["axis"] or "z")
    return Motor(names.index(motor["turns"]), inertia, ratio, motor["carrier"] or 0, axis)
