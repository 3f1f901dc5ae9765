"""`friction`, `springs`, `dampers`, `motors` and `passive` of a problem file, as they are written.

`forces` of a problem file: what acts on the links from outside.

`weights` of a problem file: what the rates of the joints cost where a task leaves a choice.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence

from msgspec import Struct

from dynsolve.problem.action_keys import DAMPER, FRICTION, MOST_ACTIONS, MOTOR, ROTOR_AXIS, SPRING
from dynsolve.problem.base import ParsedRotation, read_rotation
from dynsolve.problem.bodies import NOT_DRAWN, DrawnFrames, ParsedPlace, read_link, read_place
from dynsolve.problem.cells import Cell, forbid, made_cell, read_cell, read_vector
from dynsolve.problem.kinds import Fields, Keyed, describe, items, word
from dynsolve.problem.kinematic_keys import BY, BY_INERTIA, FORCE, IN_LINK, MAX_FORCES
from dynsolve.problem.specification import PROBLEM
from dynsolve.problem.table import STARRED, by_coordinate, coordinate_name, known_coordinate
from dynsolve.problem.yaml_nodes import Faults, FaultyNode, ListNode, MappingNode, ScalarNode, Span, YamlNode

# `friction`, `springs`, `dampers`, `motors` and `passive` of a problem file, as they are written

KEYS = ("friction", "springs", "dampers", "motors", "passive")

_CONSTANT = "it is a constant of the problem"


class ParsedFriction(Struct, frozen=True):
    """The friction of a coordinate; None for what is not given."""

    coordinate: str
    viscous: Cell | None
    coulomb: Cell | None


class ParsedSpring(Struct, frozen=True):
    """A spring by `stiffness`, `of` and `rest`, or by its `energy`."""

    span: Span
    stiffness: Cell | None = None
    of: Cell | None = None
    rest: Cell | None = None
    energy: Cell | None = None


class ParsedDamper(Struct, frozen=True):
    """A damper; None where a part of it was reported."""

    damping: Cell | None
    of: Cell | None


class ParsedMotor(Struct, frozen=True):
    """A motor; None where a part of it was reported."""

    turns: str | None
    inertia: Cell | None
    ratio: Cell | None
    carrier: int | None
    axis: str | None


class ParsedActions(Struct, frozen=True):
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


# `forces` of a problem file: what acts on the links from outside

_HELP = PROBLEM["forces"].help


class ParsedLoad(Struct, frozen=True):
    """One entry of `forces:`; None where a part was reported or is not given.

    `in_link`: along the axes of the link, turned by `rotation` where that is given.
    """

    link: int | None
    place: ParsedPlace | None
    written: str
    force: tuple[Cell, ...]
    moment: tuple[Cell, ...]
    in_link: bool
    rotation: ParsedRotation | None
    by_robot: bool


def read_loads(
    faults: Faults,
    node: YamlNode | None,
    rows: int,
    coordinates: Collection[str],
    drawn: DrawnFrames = NOT_DRAWN,
) -> tuple[ParsedLoad, ...]:
    """The entries under `forces:`; everything wrong with one is reported."""
    listed = items(faults, node, "forces", _HELP)
    if len(listed) > MAX_FORCES and node:
        faults.error(node.span, f"{len(listed)} forces; at most {MAX_FORCES} are read", "leave some out")
        return ()
    return tuple(_loads(faults, listed, rows, coordinates, drawn))


def _loads(
    faults: Faults,
    listed: Collection[YamlNode],
    rows: int,
    coordinates: Collection[str],
    drawn: DrawnFrames,
) -> Iterator[ParsedLoad]:
    for index, node in enumerate(listed, 1):
        what = f"force {index}"
        if isinstance(node, MappingNode):
            yield _read_load(faults, Fields(faults, node, FORCE.names, what), what, rows, coordinates, drawn)
        elif not isinstance(node, FaultyNode):
            faults.error(node.span, f"{what} is not a mapping but {describe(node)}", _HELP)


def _read_load(
    faults: Faults,
    fields: Fields,
    what: str,
    rows: int,
    coordinates: Collection[str],
    drawn: DrawnFrames,
) -> ParsedLoad:
    if fields.lacks("link"):
        faults.error(fields.span, f"{what} has no `link`", f"add {FORCE['link'].help}")
    if fields.lacks("force") and fields.lacks("moment"):
        faults.error(fields.span, f"{what} has neither a `force` nor a `moment`", _HELP)
    place: ParsedPlace | None = ParsedPlace("tip", fields.span)
    if "at" in fields:
        place = read_place(faults, fields.get("at"), f"the place of {what}", FORCE["at"].help)
    link = read_link(faults, fields.get("link"), rows, "which does not move")
    place = drawn.place(faults, place, link)
    constant = "it is fixed in the link: joint variables stand in the table"
    forbid(faults, place.cells if place else (), coordinates, constant)
    axes = fields.get("in")
    is_plain = isinstance(axes, ScalarNode) and axes.text in IN_LINK.choices
    rotation = None if is_plain else read_rotation(faults, axes, f"the axes of {what}")
    forbid(faults, rotation.cells if rotation else (), coordinates, constant)
    by = word(faults, fields.get("by"), BY.choices, f"by of {what}") if "by" in fields else ""
    return ParsedLoad(
        link=link,
        place=place,
        written=faults.source.text[slice(*fields.span_of("at"))] if "at" in fields else "tip",
        force=read_vector(faults, fields.get("force"), f"the force of {what}") or (),
        moment=read_vector(faults, fields.get("moment"), f"the moment of {what}") or (),
        in_link=is_plain or rotation is not None,
        rotation=rotation,
        by_robot=by == "robot",
    )


# `weights` of a problem file

_WEIGHTS_CONSTANT = "a weight holds numbers and parameters"


class ParsedWeights(Struct, frozen=True):
    """W by rows, none where it is the inertia matrix; and where it stands."""

    rows: tuple[tuple[Cell, ...], ...]
    span: Span

    @property
    def is_inertia(self) -> bool:
        """Whether W is D(q)."""
        return not self.rows


def read_weights(
    faults: Faults, node: YamlNode | None, coordinates: Mapping[str, str], has_bodies: bool
) -> ParsedWeights | None:
    """W of a file, None where there is none; what is wrong with it is reported."""
    help = PROBLEM["weights"].help
    rows: list[list[Cell | None]] = []
    match node:
        case None | FaultyNode():
            return None
        case ScalarNode() if node.text in BY_INERTIA.choices:
            if not has_bodies:
                faults.error(node.span, "no body has mass, so there is no inertia matrix D", help)
            return ParsedWeights((), node.span)
        case MappingNode():
            rows = _diagonal(faults, node, list(coordinates))
        case ListNode():
            rows = _listed(faults, node, len(coordinates))
        case _:
            faults.error(node.span, f"weights is a mapping or a matrix, not {describe(node)}", help)
    cells = tuple(tuple(cell for cell in row if cell) for row in rows)
    for row in cells:
        forbid(faults, row, coordinates, _WEIGHTS_CONSTANT)
    is_whole = bool(cells) and all(len(row) == len(coordinates) for row in cells)
    return ParsedWeights(cells, node.span) if is_whole else None


def _diagonal(faults: Faults, node: MappingNode, names: Sequence[str]) -> list[list[Cell | None]]:
    """The weights by coordinate; those that are not given are 1."""
    given = {
        name: read_cell(faults, value, f"the weight of {name}")
        for name, value in by_coordinate(faults, node, names, PROBLEM["weights"].help)
    }
    one, zero = (made_cell("a weight", text, node.span[0]) for text in "10")
    return [[given.get(name, one) if name == other else zero for other in names] for name in names]


def _listed(faults: Faults, node: ListNode, size: int) -> list[list[Cell | None]]:
    rows = [row.items if isinstance(row, ListNode) else () for row in node.items]
    if len(rows) != size or any(len(row) != size for row in rows):
        message = f"the matrix of the weights is {size}×{size}, a row and a column for each coordinate"
        faults.error(node.span, message, PROBLEM["weights"].help)
        return []
    return [[read_cell(faults, item, f"a weight, row {i}") for item in row] for i, row in enumerate(rows, 1)]
