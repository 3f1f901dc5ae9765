"""Which names an answer to a problem may hold, and what each of them is.

A name is looked up by its key, its letters and digits alone: `I_{1,zz}`, `I1zz` and
`I_1_zz` are one key.  Three tables: the symbols of the problem (its parameters,
coordinates with their derivatives, and q_i), the quantities of the derivation, and
what the student defined.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from itertools import product

from dynsolve.answers.reading.grids import Grid, Value
from dynsolve.notation.names import split
from dynsolve.notation.tree import Function, Node, Sum, Symbol
from dynsolve.problem.model import Problem
from dynsolve.robot.model import Coordinate, JointType

Shape = tuple[int, int] | None
"""Rows and columns of a quantity; None for a scalar."""

_STRIP = re.compile(r"[_{}, ]")
_VECTORS = ("q", "theta", "Theta")
_RUNNING = re.compile(r"(?:[vwcml]|omega|lin|rot)?[ijkn]{1,3}(?:-?1)?")
_SHORTHAND = re.compile(r"([sScC])([0-9]+)")


def key(name: str) -> str:
    """The letters and digits of a name.

    >>> key("I_{1,zz}"), key("theta_1")
    ('I1zz', 'theta1')
    """
    return name if name.isalnum() else _STRIP.sub("", name)


@dataclass(frozen=True, slots=True)
class Meaning:
    """What a name stands for, and what the student is told about a reading that was not obvious."""

    value: Value
    note: str = ""


@dataclass(slots=True)
class Vocabulary:
    """The names of one problem.

    `symbols` are those of the problem by key, `others` further spellings of them;
    `quantities` are canonical names by key, several where the notation allows several;
    `derived` are derivatives that were defined on their own, `broken` definitions that
    could not be read, `angles` the student's own by subscript.
    `shapes` are those of every canonical name; `masses` are the masses, the moments of inertia and g;
    `defined` is what the student defined.
    """

    coordinates: tuple[Coordinate, ...]
    symbols: dict[str, Symbol]
    others: dict[str, Symbol]
    quantities: dict[str, tuple[str, ...]]
    shapes: dict[str, Shape]
    families: dict[str, tuple[str, ...]]
    bodies: tuple[str, ...]
    masses: frozenset[str]
    defined: dict[str, Meaning] = field(default_factory=dict)
    derived: dict[tuple[str, int], Value] = field(default_factory=dict)
    broken: dict[str, str] = field(default_factory=dict)
    angles: dict[str, Node] = field(default_factory=dict)
    subscripts: dict[str, Coordinate] = field(default_factory=dict)

    def fresh(self) -> Vocabulary:
        """The names of the problem alone, for another hand-in."""
        return Vocabulary(
            self.coordinates, self.symbols, self.others, self.quantities, self.shapes, self.families,
            self.bodies, self.masses, subscripts=self.subscripts,
        )  # fmt: skip

    def define(self, name: str, meaning: Meaning) -> None:
        """Keep what the student says a name is, from here on."""
        self.defined[name] = meaning

    def derive(self, name: str, dots: int, value: Value) -> None:
        """Keep what the student says a derivative is."""
        self.derived[(name, dots)] = value

    def turn(self, index: str, angle: Node) -> None:
        """Keep the student's own angle with a subscript."""
        self.angles[index] = angle

    def symbol(self, name: str) -> Meaning | None:
        """The symbol of the problem, or what the student defined, of that key."""
        if name in self.defined:
            return self.defined[name]
        if name in self.symbols:
            return Meaning(self.symbols[name])
        if name in self.others:
            return Meaning(self.others[name])
        return self._shorthand(name)

    def bare_symbol(self, text: str) -> Symbol | None:
        """The symbol of the problem that a name without scripts always is, None for other names."""
        name = key(text)
        if name in self.defined or text[0] == "d":  # dq_1 may begin a derivative
            return None
        return self.symbols.get(name) or self.others.get(name)

    def _shorthand(self, name: str) -> Meaning | None:
        """s12 and c1: the sine and the cosine of the coordinates with these subscripts."""
        found = _SHORTHAND.fullmatch(name)
        angle = self.angle_of(found[2]) if found else None
        if found is None or angle is None:
            return None
        return Meaning(Function("sin" if found[1] in "sS" else "cos", angle))

    def short_angle(self, name: str) -> Function | None:
        """ctheta1, sq2: a function written as its first letter before the angle."""
        if name[:1] in ("c", "s", "C", "S") and len(name) > 2:
            angle = self.symbols.get(name[1:]) or self.others.get(name[1:])
            q = self.coordinate(angle) if angle and not angle.dots else None
            if q is not None and q.type is JointType.REVOLUTE and angle is not None:
                return Function("sin" if name[0] in "sS" else "cos", angle)
        return None

    def angle_of(self, digits: str) -> Node | None:
        """The sum of the coordinates with these subscripts: `12` is theta1 + theta2."""
        if not digits or (len(digits) > len(self.coordinates) and digits not in self.subscripts):
            return None
        if digits in self.subscripts:
            return self._angle(digits)
        names = list(digits)
        if len(set(names)) < len(names) or any(name not in self.subscripts for name in names):
            return None
        parts = [self._angle(name) for name in names]
        return Sum(tuple(part for part in parts if part)) if all(parts) else None

    def _angle(self, index: str) -> Node | None:
        """The revolute coordinate with a subscript; the student's own where there is one."""
        if index in self.angles:
            return self.angles[index]
        q = self.subscripts[index]
        return Symbol(q.name) if q.type is JointType.REVOLUTE else None

    def similar(self, name: str) -> Meaning | None:
        """A parameter that is written in another way: I_{zz1} for I_{1,zz}, l_1 for L_1."""
        for form in (_sorted_key, lambda text: text.lower(), lambda text: _sorted_key(text.lower())):
            same = [symbol for other, symbol in self.symbols.items() if form(other) == form(name)]
            if len(same) == 1:
                return Meaning(same[0], f"{name} is read as {same[0].name}")
        return None

    def inertia(self, name: str) -> Meaning | None:
        """The one moment of inertia with the index of a bare I_1."""
        base, groups = split(name)
        same = [
            symbol
            for other, symbol in self.symbols.items()
            if split(other)[0] == base and groups[:1] == split(other)[1][:1]
        ]
        return Meaning(same[0], f"{name} is read as {same[0].name}") if len(same) == 1 else None

    def velocities(self, dots: int) -> Grid:
        """The column of the velocities (or the coordinates, or the accelerations)."""
        return Grid(tuple((Symbol(q.name, dots),) for q in self.coordinates), is_rates=dots)

    def is_vector(self, name: str) -> bool:
        """Whether a bare name is the vector of coordinates."""
        return name in _VECTORS

    def coordinate(self, node: Node) -> Coordinate | None:
        """The coordinate that a symbol is, with any number of dots."""
        if isinstance(node, Symbol):
            return next((q for q in self.coordinates if q.name == node.name), None)
        return None

    def family(self, name: str) -> tuple[str, ...]:
        """The quantities of the kind that a name with an unknown index belongs to."""
        return self.families.get(_family(name), ())


def is_running(index: str) -> bool:
    """Whether an index runs: K_i, v_{ci}, omega_{i-1}."""
    return bool(_RUNNING.fullmatch(key(index)))


def _family(name: str) -> str:
    """What names with another index have in common: `P3` is P#, `d13` is d##."""
    stem = name.rstrip("0123456789")
    return stem + "#" * (len(name) - len(stem)) if stem != name else ""


def _sorted_key(name: str) -> str:
    base, groups = split(name)
    return base + ",".join(sorted("".join(groups)))


def vocabulary(problem: Problem) -> Vocabulary:
    """The names of a problem."""
    robot = problem.robot
    coordinates = robot.coordinates
    symbols = {key(name): Symbol(name) for name in robot.parameters}
    symbols |= {key(q.name): Symbol(q.name) for q in coordinates}
    others: dict[str, Symbol] = {"pi": Symbol("pi")}
    subscripts = _subscripts(coordinates)
    _add_derivatives(others, symbols, subscripts)
    bodies = tuple(body.name for body in robot.bodies)
    quantities, shapes, families = _quantities(robot.n, len(robot.joints), coordinates, bodies, subscripts)
    masses = frozenset(name for name in robot.parameters if split(name)[0] in ("m", "M", "g", "I", "J"))
    return Vocabulary(
        coordinates, symbols, others, quantities, shapes, families, bodies, masses, subscripts=subscripts
    )


def _subscripts(coordinates: tuple[Coordinate, ...]) -> dict[str, Coordinate]:
    """Coordinates by the subscript of their name; by their place where names have none, or share one."""
    found: dict[str, Coordinate] = {}
    for q in coordinates:
        index = "".join(split(q.name)[1])
        if not index.isdigit() or index in found:
            return {str(q.index): q for q in coordinates}
        found[index] = q
    return found


def _add_derivatives(
    others: dict[str, Symbol],
    symbols: dict[str, Symbol],
    subscripts: dict[str, Coordinate],
) -> None:
    """Every spelling of the coordinates and their derivatives that is no symbol of the problem."""
    for rank in range(4):
        for index, q in subscripts.items():
            letter = "theta" if q.type is JointType.REVOLUTE else "d"
            short = "th" if letter == "theta" else letter
            name = (q.name, f"q{q.index}", f"{letter}{index}", f"{short}{index}")[rank]
            if rank and name in symbols:
                continue
            for spelling, dots in spellings(name):
                if spelling not in symbols:
                    others.setdefault(spelling, Symbol(q.name, dots))


def spellings(name: str) -> list[tuple[str, int]]:
    """Every way to write a coordinate and its derivatives in one word, with the number of dots."""
    plain = key(name)
    base, _ = split(name)
    index = plain[len(base) :]
    found = [(plain, 0)]
    for dots, marks in ((1, ("dot", "d")), (2, ("ddot", "dd", "dotdot"))):
        for mark in marks:
            found += [(plain + mark, dots), (base + mark + index, dots), (mark + plain, dots)]
    return [*found, ("d2" + plain, 2)]


def _quantities(
    n: int,
    rows: int,
    coordinates: tuple[Coordinate, ...],
    bodies: tuple[str, ...],
    subscripts: dict[str, Coordinate],
) -> tuple[dict[str, tuple[str, ...]], dict[str, Shape], dict[str, tuple[str, ...]]]:
    table = _Quantities(n)
    frame: Shape = (4, 4)
    for i in range(1, rows + 1):
        table.add(f"A{i}", frame, "A", (f"A{i}",))
        table.add(f"H{i}", frame, "H", (f"H{i}", f"T{i}", f"H0{i}", f"T0{i}"))
    table.add("Jv", (3, n), "", ("Jv", "JP", "Jp"))
    table.add("Jw", (3, n), "", ("Jw", "Jomega", "JO", "JOmega"))
    table.add("J", (6, n), "", ("J",))
    for b in bodies:
        _add_body(table, b, n)
    table.add("P", None, "", ("P", "U", "Ep", "PE", "Epot", "Ptot", "Ptotal", "V", "Etp", "Utot"))
    table.add("K", None, "", ("K", "T", "Ek", "KE", "Ekin", "Ktot", "Ktotal", "Ttot"))
    table.add("L", None, "", ("L", "Lagrangian"))
    _add_torques(table, coordinates, subscripts)
    vector: Shape = (n, 1)
    table.add("tau", vector, "", ("tau", "tauvec"))
    table.add("D", (n, n), "", ("D", "M", "B", "Dq", "Mq"))
    table.add("C", (n, n), "", ("C",))
    table.add("g", vector, "", ("g", "G", "phi", "gvec"))
    table.add("Cqd", vector, "", ("Cqd", "c", "V", "Cqdot", "h", "C"))
    digits = [str(digit) for digit in range(1, n + 1)]
    for row, column in product(digits, digits):
        ij = row + column
        table.add(f"d{ij}", None, "d", tuple(letter + ij for letter in "dDmMbB"))
        table.add(f"C{ij}", None, "C", (f"C{ij}", f"c{ij}"))
        for k in digits:
            table.add(f"c{ij}{k}", None, "c", (f"c{ij}{k}", f"C{ij}{k}", f"Gamma{ij}{k}"))
    return table.names, table.shapes, table.families


class _Quantities:
    def __init__(self, n: int) -> None:
        self.names: dict[str, tuple[str, ...]] = {}
        self.shapes: dict[str, Shape] = {}
        self.families: dict[str, tuple[str, ...]] = {}

    def add(self, canonical: str, shape: Shape, family: str, spellings: tuple[str, ...]) -> None:
        self.shapes[canonical] = shape
        for spelling in (canonical, *spellings):
            spelling = key(spelling)
            known = self.names.get(spelling, ())
            if canonical not in known:
                self.names[spelling] = (*known, canonical)
            if family and (stem := _family(spelling)):
                members = self.families.get(stem, ())
                if canonical not in members:
                    self.families[stem] = (*members, canonical)


def _add_body(table: _Quantities, b: str, n: int) -> None:
    column: Shape = (3, 1)
    table.add(f"rc{b}", column, "rc", (f"rc{b}", f"pc{b}", f"oc{b}", f"rm{b}"))
    for canonical, marks in (("v", ("v",)), ("w", ("omega", "w"))):
        points = ("", "c", "m") if canonical == "v" else ("", "c")
        for mark in marks:
            spellings = tuple(f"{mark}{point}{b}" for point in points)
            table.add(f"{canonical}{b}", column, canonical, spellings)
            table.add(f"J{canonical}{b}", (3, n), f"J{canonical}", tuple(f"J{s}" for s in spellings))
            kinetic = tuple(f"{K}{s}" for s in spellings for K in ("K", "Ek", "T", "E"))
            table.add(f"K{canonical}{b}", None, f"K{canonical}", (*kinetic, f"K{b}{mark}"))
    words = ("Klin", "Ktrans", "Kt", "KT", "KL", "Kl"), ("Krot", "Kr", "KR")
    for canonical, kinds in zip(("Kv", "Kw"), words, strict=True):
        table.add(f"{canonical}{b}", None, canonical, tuple(f"{kind}{b}" for kind in kinds))
    table.add(f"I_body{b}", (3, 3), "I", (f"Ibody{b}", f"Ib{b}", f"I{b}", f"Ic{b}", f"I{b}b", f"I{b}body"))
    table.add(f"I{b}", (3, 3), "I", (f"I{b}", f"I0{b}", f"Ibase{b}", f"I{b}base"))
    table.add(f"P{b}", None, "P", (f"P{b}", f"U{b}", f"Ep{b}", f"PE{b}", f"Epot{b}", f"V{b}"))
    table.add(f"K{b}", None, "K", (f"K{b}", f"T{b}", f"Ek{b}", f"KE{b}", f"Ekin{b}"))


def _add_torques(
    table: _Quantities, coordinates: tuple[Coordinate, ...], subscripts: dict[str, Coordinate]
) -> None:
    spoken = {q.name: index for index, q in subscripts.items()}
    for q in coordinates:
        i = q.index
        letter = "theta" if q.type is JointType.REVOLUTE else "d"
        names = dict.fromkeys((key(q.name), f"q{i}", f"{letter}{spoken[q.name]}"))
        force = [
            f"tau{i}",
            f"f{i}",
            f"F{i}",
            f"Q{i}",
            *(mark + n for n in names for mark in ("tau", "f", "F")),
        ]
        table.add(q.force, None, "tau", tuple(force))
        name = key(q.name)
        table.add(f"dLdqd{i}", None, "dLdqd", (f"dLdqd{i}", f"dLdqdot{i}", f"dLd{name}dot"))
        table.add(f"ddt{i}", None, "ddt", (f"ddt{i}", f"ddtdLdqd{i}"))
        table.add(f"dLdq{i}", None, "dLdq", (f"dLdq{i}", f"dLd{name}"))
        table.add(f"g{i}", None, "g", (f"g{i}", f"G{i}", f"phi{i}", f"Phi{i}"))
        if spoken[q.name] != str(i) and f"tau{spoken[q.name]}" not in table.names:
            table.add(q.force, None, "tau", (f"tau{spoken[q.name]}", f"f{spoken[q.name]}"))
