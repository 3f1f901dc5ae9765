"""`friction`, `springs`, `dampers`, `motors` and `passive` of a problem file, as they are written."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass

from dynsolve.problem.action_keys import DAMPER, FRICTION, MOST_ACTIONS, MOTOR, ROTOR_AXIS, SPRING
from dynsolve.problem.cells import Cell, forbid, made_cell, read_cell
from dynsolve.problem.fields import Fields, describe, items, word
from dynsolve.problem.kinds import Keyed
from dynsolve.problem.motor_coordinates import STARRED
from dynsolve.problem.places import read_link
from dynsolve.problem.source import Faults
from dynsolve.problem.specification import PROBLEM
from dynsolve.problem.table import by_coordinate, coordinate_name, known_coordinate
from dynsolve.problem.yaml_nodes import FaultyNode, MappingNode, ScalarNode, Span, YamlNode

KEYS = ("friction", "springs", "dampers", "motors", "passive")

_CONSTANT = "it is a constant of the problem"


@dataclass(frozen=True, slots=True)
class ParsedFriction:
    """The friction of a coordinate; None for what is not given."""

    coordinate: str
    viscous: Cell | None
    coulomb: Cell | None


@dataclass(frozen=True, slots=True)
class ParsedSpring:
    """A spring by `stiffness`, `of` and `rest`, or by its `energy`."""

    span: Span
    stiffness: Cell | None = None
    of: Cell | None = None
    rest: Cell | None = None
    energy: Cell | None = None


@dataclass(frozen=True, slots=True)
class ParsedDamper:
    """A damper; None where a part of it was reported."""

    damping: Cell | None
    of: Cell | None


@dataclass(frozen=True, slots=True)
class ParsedMotor:
    """A motor; None where a part of it was reported."""

    turns: str | None
    inertia: Cell | None
    ratio: Cell | None
    carrier: int | None
    axis: str | None


@dataclass(frozen=True, slots=True)
class ParsedActions:
    """What acts on the robot, as the file has it."""

    friction: tuple[ParsedFriction, ...] = ()
    springs: tuple[ParsedSpring, ...] = ()
    dampers: tuple[ParsedDamper, ...] = ()
    motors: tuple[ParsedMotor, ...] = ()
    passive: tuple[str, ...] = ()

    @property
    def kinds(self) -> frozenset[str]:
        """What there is of it, as `Actions.kinds`."""
        found = {"friction": self.friction or self.dampers, "springs": self.springs, "motors": self.motors}
        return frozenset(kind for kind, there in found.items() if there)

    @property
    def signs(self) -> tuple[str, ...]:
        """The coordinates with Coulomb friction: the signs of their rates occur."""
        return tuple(one.coordinate for one in self.friction if one.coulomb)

    @property
    def constant(self) -> Iterator[Cell]:
        """The values that are constant."""
        cells = [
            *(cell for one in self.friction for cell in (one.viscous, one.coulomb)),
            *(cell for one in self.springs for cell in (one.stiffness, one.rest)),
            *(one.damping for one in self.dampers),
            *(cell for one in self.motors for cell in (one.inertia, one.ratio)),
        ]
        yield from (cell for cell in cells if cell)

    @property
    def kinds_of_values(self) -> Iterator[tuple[str, Cell]]:
        """What each constant is, in the words of a message."""
        kinds = [
            *(("a coefficient of viscous friction", one.viscous) for one in self.friction),
            *(("a coefficient of Coulomb friction", one.coulomb) for one in self.friction),
            *(("a coefficient of viscous friction", one.damping) for one in self.dampers),
            *(("a stiffness", one.stiffness) for one in self.springs),
            *(("a moment of inertia", one.inertia) for one in self.motors),
        ]
        yield from ((kind, cell) for kind, cell in kinds if cell)

    @property
    def moving(self) -> Iterator[Cell]:
        """The values that hold coordinates."""
        cells = [one.of or one.energy for one in self.springs] + [one.of for one in self.dampers]
        yield from (cell for cell in cells if cell)


NO_ACTIONS = ParsedActions()


def read_actions(faults: Faults, fields: Fields, rows: int, coordinates: Mapping[str, str]) -> ParsedActions:
    """The keys of a file that say what acts; what is wrong with one is reported.

    `rows` are those of the table, `coordinates` the kinds of the coordinates by name.
    """
    friction = tuple(_read_friction(faults, fields.get("friction"), coordinates))
    springs = tuple(_spring(faults, one) for one in _entries(faults, fields, "springs", SPRING))
    dampers = tuple(_damper(faults, one) for one in _entries(faults, fields, "dampers", DAMPER))
    listed = _entries(faults, fields, "motors", MOTOR)
    motors = tuple(_motor(faults, one, rows, coordinates) for one in listed)
    help = PROBLEM["passive"].help
    names = [
        known_coordinate(faults, item, coordinates, help)
        for item in items(faults, fields.get("passive"), "passive", help)
    ]
    parsed = ParsedActions(friction, springs, dampers, motors, tuple(name for name in names if name))
    forbid(faults, parsed.constant, coordinates, _CONSTANT)
    return parsed


_TAKEN = {"springs": ("s", "P_s", "the springs"), "motors": ("m", "K_m", "the rotors")}
"""The body's name, and what it would call by the same letter as these."""


def check_bodies(
    faults: Faults, fields: Fields, parsed: ParsedActions, bodies: Collection[str], has_mass: bool
) -> None:
    """Report that nothing has mass, and a body whose energy would be called as that of springs or rotors."""
    if not has_mass:
        key = next(key for key in KEYS if key in fields)
        message = f"`{key}` stands in the equations of motion, and nothing has mass"
        faults.error(fields.key_span(key), message, "give the bodies under `masses`")
    for kind in sorted(parsed.kinds & _TAKEN.keys()):
        name, letter, of = _TAKEN[kind]
        if name in bodies:
            message = f"{letter} is the energy of {of}, and a body is called {name}, too"
            faults.error(fields.key_span(kind), message, "give the body another name")


def _entries(faults: Faults, fields: Fields, key: str, record: Keyed) -> Iterator[Fields]:
    """The entries of a list of mappings; what is none is reported."""
    help, node = PROBLEM[key].help, fields.get(key)
    listed = items(faults, node, key, help)
    if len(listed) > MOST_ACTIONS and node:
        faults.error(node.span, f"{len(listed)} {key}; at most {MOST_ACTIONS} are read", "leave some out")
        return
    for index, item in enumerate(listed, 1):
        what = f"{key.removesuffix('s')} {index}"
        if isinstance(item, MappingNode):
            entry = Fields(faults, item, record.names, what)
            for required in record.required:
                if entry.lacks(required.name):
                    faults.error(entry.span, f"{what} has no `{required.name}`", f"add {required.help}")
            yield entry
        elif not isinstance(item, FaultyNode):
            faults.error(item.span, f"{what} is not a mapping but {describe(item)}", help)


def _cell(faults: Faults, entry: Fields, key: str) -> Cell | None:
    return read_cell(faults, entry.get(key), f"`{key}` of {entry.what}")


# -- friction --------------------------------------------------------------------------------------


def _read_friction(
    faults: Faults, node: YamlNode | None, coordinates: Mapping[str, str]
) -> Iterator[ParsedFriction]:
    help = PROBLEM["friction"].help
    if not isinstance(node, MappingNode):
        if node is not None and not isinstance(node, FaultyNode):
            faults.error(node.span, "friction is a mapping from coordinates to their friction", help)
        return
    for name, value in by_coordinate(faults, node, coordinates, help):
        yield _friction_of(faults, name, value)


def _friction_of(faults: Faults, name: str, node: YamlNode) -> ParsedFriction:
    what = f"the friction of {name}"
    if not isinstance(node, MappingNode):
        return ParsedFriction(name, read_cell(faults, node, what), None)
    fields = Fields(faults, node, FRICTION.names, what)
    if not any(key in fields for key in FRICTION.names) and all(fields.lacks(k) for k in FRICTION.names):
        faults.error(node.span, f"{what} is empty", PROBLEM["friction"].help)
    return ParsedFriction(name, _cell(faults, fields, "viscous"), _cell(faults, fields, "coulomb"))


# -- springs and dampers ---------------------------------------------------------------------------


def _spring(faults: Faults, entry: Fields) -> ParsedSpring:
    help = PROBLEM["springs"].help
    law = [key for key in ("stiffness", "of", "rest") if key in entry]
    if "energy" in entry and law:
        message = f"{entry.what} has an `energy` and a `{law[0]}`"
        faults.error(entry.key_span(law[0]), message, "give one of them: " + help)
    elif entry.lacks("energy"):
        for key in ("stiffness", "of"):
            if entry.lacks(key):
                faults.error(entry.span, f"{entry.what} has no `{key}`", help)
    return ParsedSpring(entry.span, *(_cell(faults, entry, key) for key in SPRING.names))


def _damper(faults: Faults, entry: Fields) -> ParsedDamper:
    return ParsedDamper(_cell(faults, entry, "damping"), _cell(faults, entry, "of"))


# -- motors ----------------------------------------------------------------------------------------


def _motor(faults: Faults, entry: Fields, rows: int, coordinates: Mapping[str, str]) -> ParsedMotor:
    turns = entry.get("turns")
    name: str | None = None
    if isinstance(turns, ScalarNode) and (starred := STARRED.fullmatch(turns.text.strip())):
        name = coordinate_name(faults, turns, MOTOR["turns"].help)
        if name is not None and coordinates.get(name) is None:
            faults.error(turns.span, f"`{starred[1]}` cannot be a coordinate", MOTOR["turns"].help)
    elif turns is not None:
        name = known_coordinate(faults, turns, coordinates, MOTOR["turns"].help)
    carrier: int | None = 0
    if "carrier" in entry and not rows:
        message = f"{entry.what} has a `carrier`, and there is no table whose links could carry it"
        faults.error(entry.key_span("carrier"), message, "leave it out, or give a `dh` table")
    elif "carrier" in entry:
        carrier = read_link(faults, entry.get("carrier"), rows, "which carries a motor that has no `carrier`")
    elif "axis" in entry:
        message = f"`axis` of {entry.what} is that of a carrier, and there is none"
        faults.error(entry.key_span("axis"), message, "add carrier: 1, or leave `axis` out")
    axis = word(faults, entry.get("axis"), ROTOR_AXIS.choices, f"axis of {entry.what}")
    ratio = _cell(faults, entry, "ratio") if "ratio" in entry else made_cell("ratio", "1")
    return ParsedMotor(
        name, _cell(faults, entry, "inertia"), ratio, carrier, axis if "axis" in entry else "z"
    )
