"""Values that a user gives for parameters and states, read and checked, each fault at its place.

`L1=0.4` on a command line, `L1: 0.4` in a problem file and `L1=0.4` in a call come
here as text; what leaves is exact.

Assignments, `L1=0.4`, as they are written on a command line or in a Python call, with their places.

The unit of every result of a robot: N m, kg m², J, by its role and the type of its coordinates.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from difflib import get_close_matches
from fractions import Fraction

from msgspec import Struct, field

from dynsolve.algebra.angles import angle_from_tree, name_alone
from dynsolve.algebra.rationals import rational_value
from dynsolve.errors import AlgebraError, Finding, InputError, ReadError
from dynsolve.explain.writing import and_joined
from dynsolve.notation.characters import normalize
from dynsolve.notation.text import has_decimals, read, tokens
from dynsolve.notation.tree import Degrees, Negative, Node, Number, Product, number
from dynsolve.problem import Problem
from dynsolve.quantities.family import Family
from dynsolve.quantities.index import quantities
from dynsolve.robot import units
from dynsolve.robot.dimensions import Dimensions
from dynsolve.robot.model import Coordinate, JointType, Robot
from dynsolve.robot.units import Dimension
from dynsolve.solution.numbers.substitution import Replacements

# Assignments, `L1=0.4`, as they are written on a command line or in a Python call, with their places

Plain = int | float | Fraction | str
"""What a Python user may give as a value: a float stands for the decimal it is printed as."""


class Assignment(Struct, frozen=True):
    """`name=value` as it was written, and where: `file` with the line and the columns of both parts."""

    name: str
    value: str
    file: str = ""
    excerpt: str = ""
    line: int = 0
    name_column: int = 0
    value_column: int = 0

    def at_name(self, message: str, help: str = "", offset: int = 0, length: int = 0) -> Finding:
        """A finding at the name."""
        column = self.name_column + offset if self.name_column else 0
        return Finding(message, help, self.file, self.line, column, length or len(self.name), self.excerpt)

    def at_value(self, message: str, help: str = "", offset: int = 0, length: int = 0) -> Finding:
        """A finding at the value, or at a part of it."""
        column = self.value_column + offset if self.value_column else 0
        return Finding(message, help, self.file, self.line, column, length or len(self.value), self.excerpt)


def of_option(option: str, texts: Iterable[str]) -> Iterator[Assignment]:
    """The assignments of an option's values: `theta1=30deg,L2=0.2`.

    Raises InputError for a part that is none.
    """
    for text in texts:
        start = 0
        for part in text.split(","):
            name, equals, value = part.partition("=")
            lead = start + len(part) - len(part.lstrip())
            if not equals or not name.strip() or not value.strip():
                if part.strip() or text.count(",") == 0:
                    message = f"`{part.strip()}` is no assignment" if part.strip() else "nothing is assigned"
                    finding = Finding(
                        message, "write name=value: L1=0.4, theta1=30deg",
                        option, 0, lead + 1, max(len(part.strip()), 1), text,
                    )  # fmt: skip
                    raise InputError([finding])
            else:
                at = start + len(name) + 1 + len(value) - len(value.lstrip())
                yield Assignment(name.strip(), value.strip(), option, text, 0, lead + 1, at + 1)
            start += len(part) + 1


def of_call(values: Mapping[str, Plain]) -> Iterator[Assignment]:
    """The assignments of a Python call."""
    for name, value in values.items():
        text = value if isinstance(value, str) else str(value)
        yield Assignment(name, text.strip(), f"{name}={text.strip()}")


# The unit of every result of a robot

Units = Sequence[Sequence[str]]
"""The unit of every entry, row by row; "" for a pure number."""


def of_coordinate(q: Coordinate, dots: int = 0) -> str:
    """rad or m, with each derivative per second."""
    base = "rad" if q.type is JointType.REVOLUTE else "m"
    return base + ("", "/s", "/s^2")[dots]


def of_parameters(robot: Robot) -> dict[str, Dimension]:
    """The dimension of every parameter, concluded from where it stands; unknown ones are left out."""
    known = Dimensions(robot.ring, robot)
    found = {
        g.name: known.of_generator(g)
        for g in robot.ring.generators
        if g.kind == "symbol" and not g.dots and g.name in robot.parameters
    }
    return {name: dim for name, dim in found.items() if dim is not None}


def of_result(robot: Robot, name: str) -> str | Units:
    """The unit of a result by its name: of a scalar, or of each entry of a matrix.

    Empty for pure numbers, and for what holds lengths beside them.
    A torque is in N m, an energy in J, though both are kg m²/s².
    """
    known = quantities(robot)
    quantity = known.result(name)
    if quantity is None:
        return ""
    if quantity.family.dimension is None:
        whole = known.get(quantity.whole)
        if whole is None or whole.shape is None or not quantity.is_read_off:
            return ""
        return _unit(whole.family, known.dimension(whole, *quantity.entry))
    if quantity.shape is None:
        return _unit(quantity.family, known.dimension(quantity))
    rows, columns = quantity.shape
    entries = [
        [_unit(quantity.family, known.dimension(quantity, i, j)) for j in range(columns)] for i in range(rows)
    ]
    return entries if any(map(any, entries)) else ""


def _unit(family: Family, found: Dimension | None) -> str:
    if found is None:
        return ""
    return family.unit if family.unit and found == family.dimension else units.si(found)


Key = tuple[str, int]
"""A name and its number of dots: ("theta1", 1) is a velocity."""


class GivenValue(Struct, frozen=True):
    """One value: its formula in SI units, the text it was given as, its unit and whether it is a decimal."""

    tree: Node
    text: str
    unit: str = ""
    decimal: bool = False


class Given(Struct, frozen=True):
    """Values by name; `warnings` are what deserves a look."""

    entries: Mapping[Key, GivenValue] = field(default_factory=dict)
    warnings: tuple[Finding, ...] = ()

    @property
    def values(self) -> Replacements:
        """The formulas alone."""
        return {key: entry.tree for key, entry in self.entries.items()}

    @property
    def decimal(self) -> bool:
        """Whether any of them is a decimal, so that results are shown as decimals."""
        return any(entry.decimal for entry in self.entries.values())


def of_file(problem: Problem) -> Iterator[Assignment]:
    """The `values:` of a problem file but for those of coordinates, which belong to a state."""
    coordinates = {q.name for q in problem.robot.coordinates}
    for name, text in problem.written.items():
        if name not in coordinates and name in problem.robot.parameters:
            place = problem.finding(("values", name), "")
            yield Assignment(name, text, place.file, place.excerpt, place.line, place.column, place.column)


# -- parameters ------------------------------------------------------------------------------------


def parameters(problem: Problem, assignments: Iterable[Assignment]) -> Given:
    """The values of a problem file, with further assignments in their place.

    Raises InputError with every fault: an unknown name, an angle without its unit,
    what cannot be read.
    """
    reader = _Reader(problem)
    names = _Names(
        {name: (name, 0) for name in problem.robot.parameters},
        "parameters",
        _states(problem.robot).keys(),
        "{name} changes with the motion of the robot",
        "give it as a state: --at {name}=...",
    )
    of_the_file = reader.all_of(of_file(problem), names)
    return reader.finished({**of_the_file, **reader.all_of(assignments, names)})


# -- states ----------------------------------------------------------------------------------------


def state(problem: Problem, assignments: Iterable[Assignment]) -> Given:
    """A state of the robot: every coordinate, and the velocities and accelerations, 0 unless given.

    Raises InputError with every fault, a coordinate that is missing among them.
    """
    reader, robot = _Reader(problem), problem.robot
    names = _Names(
        _states(robot),
        "coordinates",
        robot.parameters,
        "{name} is a parameter of the robot, not a part of its state",
        "give its value by itself: --set {name}={value}",
    )
    assignments = tuple(assignments)
    option = next((assignment.file for assignment in assignments), "")
    entries = reader.all_of(assignments, names)
    lacking = [q.name for q in robot.coordinates if (q.name, 0) not in entries]
    if lacking and not reader.findings:
        example = ",".join(
            f"{q.name}={'30deg' if q.type is JointType.REVOLUTE else '0.2'}"
            for q in robot.coordinates if q.name in lacking
        )  # fmt: skip
        message = f"the state lacks {and_joined(lacking)}"
        reader.findings.append(Finding(message, f"a state gives every coordinate: add {example}", option))
    whole = {
        (q.name, dots): entries.get((q.name, dots), GivenValue(Number(0), "0", of_coordinate(q, dots)))
        for dots in (0, 1, 2)
        for q in robot.coordinates
    }
    return reader.finished(whole)


def _states(robot: Robot) -> dict[str, Key]:
    found: dict[str, Key] = {}
    for q in robot.coordinates:
        found |= {q.name: (q.name, 0), q.velocity: (q.name, 1), q.acceleration: (q.name, 2)}
    return found


# -- the reading of a value ------------------------------------------------------------------------


class _Written(Struct, frozen=True):
    """A value as it is written: `turned` says that it is an angle by its unit, degrees or `radians`."""

    tree: Node
    turned: bool
    radians: bool
    decimal: bool


class _Names(Struct, frozen=True):
    """The names that may have a value; of the `others` a fault says where they belong."""

    known: Mapping[str, Key]
    what: str
    others: Collection[str]
    fault: str
    help: str


class _Reader:
    """Reads assignments one by one and keeps every fault."""

    def __init__(self, problem: Problem) -> None:
        self.problem, self.robot = problem, problem.robot
        self.findings: list[Finding] = []
        self.warnings: list[Finding] = []
        self.dimensions = of_parameters(self.robot)
        self.angles = _angle_names(self.robot)

    def finished(self, entries: Mapping[Key, GivenValue]) -> Given:
        if self.findings:
            raise InputError(self.findings)
        return Given(entries, tuple(self.warnings))

    def all_of(self, assignments: Iterable[Assignment], names: _Names) -> dict[Key, GivenValue]:
        entries: dict[Key, GivenValue] = {}
        for assignment in assignments:
            key = self.key(assignment, names)
            if key in entries:
                self.findings.append(
                    assignment.at_name(f"{assignment.name} has a value already", "keep one of them")
                )
            elif key is not None and (entry := self.entry(key, assignment)) is not None:
                entries[key] = entry
        return entries

    def key(self, assignment: Assignment, names: _Names) -> Key | None:
        """What an assignment gives a value; None (reported) where there is nothing of its name."""
        name = self.name(assignment)
        if name is None or name in names.known:
            return None if name is None else names.known[name]
        if name in names.others:
            help = names.help.format(name=name, value=assignment.value)
            self.findings.append(assignment.at_name(names.fault.format(name=name), help))
        else:
            self.unknown(assignment, name, list(names.known), names.what)
        return None

    def name(self, assignment: Assignment) -> str | None:
        """The name in its one spelling; θ1' is theta1_dot."""
        text = assignment.name
        dots = len(text) - len(text.rstrip("'"))
        try:
            name = normalize(text.rstrip("'"))
        except ReadError as error:
            self.findings.append(assignment.at_name(error.message, error.help, error.offset, error.length))
            return None
        return name + ("", "_dot", "_ddot")[dots] if dots < 3 else name

    def unknown(self, assignment: Assignment, name: str, known: list[str], what: str) -> None:
        close = get_close_matches(name, known, n=1, cutoff=0.5)
        some = ", ".join(known[:12]) + (", ..." if len(known) > 12 else "")
        help = f"did you mean `{close[0]}`? " if close else ""
        help += f"The {what} are {some}" if known else f"this robot has no {what}"
        self.findings.append(assignment.at_name(f"{name} does not occur in this problem", help))

    def entry(self, key: Key, assignment: Assignment) -> GivenValue | None:
        """The value, exact and in SI units; None (reported) where it has none."""
        written = self.read(assignment)
        if written is None:
            return None
        unit, turns = self.unit(key), key[0] in self.angles
        if turns and not key[1]:
            checked = self.angle(assignment, written, unit)
            unit = "" if written.turned else unit
            if checked is None:
                return None
            return GivenValue(checked, assignment.value, unit, written.decimal)
        if written.turned and not turns:
            what = "no angle" if key[0] in self.robot.parameters else "a length"
            self.findings.append(assignment.at_value(f"{assignment.name} is {what}, and is given an angle"))
            return None
        return self.measured(key, GivenValue(written.tree, assignment.value, unit, written.decimal))

    def read(self, assignment: Assignment) -> _Written | None:
        """The formula of a value, without names; None (reported) where it is none."""
        text = assignment.value
        radians = text.endswith("rad") and not text[:-3].rstrip()[-1:].isalpha()
        text = text[:-3].rstrip() if radians else text
        try:
            reading = read(text)
        except ReadError as error:
            self.findings.append(assignment.at_value(error.message, error.help, error.offset, error.length))
            return None
        if reading.names:
            first = reading.names[0]
            message = f"the value of {assignment.name} contains the name {first.name}"
            help = "a value is a number: 0.4, 2/3, sqrt(2)/2, 30deg"
            self.findings.append(assignment.at_value(message, help, first.offset, first.length))
            return None
        degrees = any(token.kind == "degrees" for token in tokens(text))
        return _Written(reading.tree, degrees or radians, radians, has_decimals(text) or radians)

    def angle(self, assignment: Assignment, written: _Written, unit: str) -> Node | None:
        """An angle; a bare number counts only where its unit is written."""
        known = units.parse(unit) if unit else None
        value = rational_value(written.tree)
        if known is not None and known.degrees and value is not None and not written.radians:
            return _degrees(value)
        try:
            angle_from_tree(written.tree, radians=written.radians or unit == "rad")
        except AlgebraError as error:
            help = error.help
            if value is not None:
                shown = assignment.value
                help = f"did you mean {shown}deg? For radians write {shown}rad or pi/6"
            self.findings.append(assignment.at_value(error.message, help))
            return None
        return written.tree

    def unit(self, key: Key) -> str:
        """The unit of a value: the file's, else SI by its role."""
        name, dots = key
        given = self.problem.units.get(name, "") if not dots else ""
        if given:
            return given
        for q in self.robot.coordinates:
            if q.name == name:
                return of_coordinate(q, dots) if dots or name not in self.angles else ""
        return units.si(self.dimensions[name]) if name in self.dimensions else ""

    def measured(self, key: Key, entry: GivenValue) -> GivenValue:
        """The value in SI units; a unit that is unknown or of another kind draws a warning."""
        name, dots = key
        given = self.problem.units.get(name) if not dots else None
        if given is None:
            return entry
        unit, place = units.parse(given), ("units", name)
        if unit is None:
            message = f"the unit `{given}` of {name} is not known; its value is taken as one in SI units"
            self.warn(place, message, "write m, mm, kg, g, kg m^2, N m, m/s^2")
            return entry
        wanted = self.dimensions.get(name)
        if wanted is not None and wanted != unit.dimension:
            message = f"the unit of {name} is {given}; where it stands it is measured in {units.si(wanted)}"
            self.warn(place, message, "results are in SI units only where the units of the values fit")
        if unit.size == 1:
            return entry
        return GivenValue(_scaled(entry.tree, unit.size), entry.text, entry.unit, entry.decimal)

    def warn(self, place: tuple[str, str], message: str, help: str) -> None:
        finding = self.problem.finding(place, message, help, "unit")
        if finding not in self.warnings:
            self.warnings.append(finding)


def _scaled(tree: Node, size: Fraction) -> Node:
    value = rational_value(tree)
    return Product((number(size), tree)) if value is None else number(value * size)


def _degrees(value: Fraction) -> Node:
    degrees = Degrees(abs(value.numerator), value.denominator)
    return Negative(degrees) if value < 0 else degrees


def _angle_names(robot: Robot) -> frozenset[str]:
    """The names that are angles by themselves."""
    angles = [pair.angle for pair in robot.ring.pairs]
    angles += [angle for joint in robot.joints for angle in (joint.theta, joint.alpha)]
    alone = {name_alone(atom) for angle in angles for atom, _ in angle.terms} - {""}
    turning = {q.name for q in robot.coordinates if q.type is JointType.REVOLUTE}
    return frozenset((alone | turning) - {q.name for q in robot.coordinates if q.name not in turning})
