"""Which names an answer to a problem may hold, and what each of them is.

A name is looked up by its key, its letters and digits alone: `I_{1,zz}`, `I1zz` and
`I_1_zz` are one key.  Three tables: the symbols of the problem (its parameters,
coordinates with their derivatives, and q_i), the quantities of the derivation, and
what the student defined.

Spong's c_ijk = ½ (∂d_kj/∂q_i + ∂d_ki/∂q_j - ∂d_ij/∂q_k) has the row last; Siciliano's c_ijk and the Γ_ijk
of Murray, Li and Sastry and of Lynch and Park have it first.  In every one of them the row is
the index that the term with the minus is derived by.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import pairwise
from typing import Any, TypeVar

from msgspec import Struct, field

from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.reading.grids import Grid, Value
from dynsolve.answers.reading.lexer import GREEK_COMMANDS, Token
from dynsolve.errors import ReadError
from dynsolve.notation.characters import split
from dynsolve.notation.tree import Function, Node, Sum, Symbol
from dynsolve.notation.tree_values import keep
from dynsolve.problem.model import Problem
from dynsolve.quantities.family import Kind
from dynsolve.quantities.index import Quantities, Shape, quantities
from dynsolve.quantities.letters import key, open_index, subscripts
from dynsolve.questions.constraints import MULTIPLIERS
from dynsolve.robot.model import Coordinate, JointType
from dynsolve.robot.questions import reference

# Which index of a Christoffel symbol counts the row, where a report defines its own

USUAL: Mapping[str, int] = {"Gamma": 0}
"""The place of the row in the index of a letter, where it is not the last."""

_MOST_TOKENS = 200


def defined_order(members: Sequence[list[Token]]) -> tuple[str, int] | None:
    """The letter that a chain defines as a Christoffel symbol, and the place of the row in its index."""
    letter, index = _indexed(members[0])
    if len(index) != 3 or len(set(index)) != 3 or not index.isalpha() or len(members[-1]) > _MOST_TOKENS:
        return None
    terms = list(_derivatives(members[-1]))
    minus = [variable for sign, variable in terms if sign == "-"]
    if len(terms) != 3 or len(minus) != 1 or minus[0] not in index:
        return None
    return letter, index.index(minus[0])


def order_of_pair(members: Sequence[list[Token]]) -> dict[str, int]:
    """The place of the row by the letter, where a chain says c_112 = c_121: it is what both begin with.

    Symbols are equal in the two indices that do not count the row.
    """
    found = [_indexed(member) for member in members]
    named = [(letter, index) for letter, index in found if len(index) == 3 and index.isdecimal()]
    for (letter, first), (other, second) in pairwise(named):
        if letter == other and first != second and first[0] == second[0] and first[1:] == second[:0:-1]:
            return {letter: 0}
    return {}


def in_usual_order(name: str, orders: Mapping[str, int]) -> str:
    """The key of a Christoffel symbol with the row last: c112 for a Γ112 whose row is first."""
    letter, index = name[:-3], name[-3:]
    place = orders.get(letter)
    if place is None or not index.isdecimal():
        return name
    return f"c{index[:place]}{index[place + 1 :]}{index[place]}"


def _indexed(member: list[Token]) -> tuple[str, str]:
    """A name and its index; empty for any other side."""
    words = [t.text for t in member if t.kind in ("name", "letter")]
    if len(member) > 8 or not words or len(words) > 2:
        return "", ""
    letter, _, index = "_".join(words).partition("_")
    return letter, index.strip("{}").replace(",", "").replace(" ", "")


def _derivatives(member: list[Token]) -> Iterator[tuple[str, str]]:
    r"""The sign of every `\frac{\partial d_{ij}}{\partial q_k}`, and the index of its variable."""
    sign = "+"
    for position, token in enumerate(member):
        if token.kind in ("+", "-"):
            sign = token.kind
        elif token.text == "partial" and _is_below(member, position):
            variable = next((t for t in member[position + 1 :] if t.kind in ("name", "letter")), token)
            index = variable.text.rstrip("}")[-1:]
            if variable.kind == "letter" or "_" not in variable.text:
                after = [t for t in member[position + 2 : position + 5] if t.kind == "name"]
                index = after[0].text[-1:] if after else index
            yield sign, index


def _is_below(member: list[Token], position: int) -> bool:
    r"""Whether the ∂ there begins what stands below a bar: `}{\partial` or `/ \partial`."""
    before = [t.kind for t in member[max(position - 2, 0) : position]]
    return before == ["}", "{"] or before[-1:] == ["/"]


_VECTORS = ("q", "theta", "Theta")
_RUNNING = re.compile(r"(?:[vwcml]|omega|lin|rot)?[ijkn]{1,3}(?:-?1)?")
DRIVING = re.compile(r"(?:u|U|F|f|T|M|Q|tau)(?:[a-z]{0,3}|[1-9])")
"""Names of a force or torque that drives a mechanism, as students write them."""

ENERGY_LEVELS = frozenset("P0 V0 U0 E0 W0 Ep0 Epot0 C c const konst".split())
"""What students call the potential energy at their zero of height."""

ZERO_LEVELS = ENERGY_LEVELS | frozenset("h0 H0 z0 y0 x0 h H href Href hzero hb P0h zref yref".split())
"""What they call that, or the height itself."""

_SHORTHAND = re.compile(r"([sScC])([0-9]+)")


MOST_REMEMBERED = 500
"""So many values are remembered before they are forgotten."""

_T = TypeVar("_T")


class Meaning(Struct, frozen=True):
    """What a name stands for, and what the student is told about a reading that was not obvious.

    `has_arguments` says that it was defined as `a(q)`.
    """

    value: Value
    note: str = ""
    has_arguments: bool = False


class Vocabulary(Struct):
    """The names of one problem.

    `symbols` are those of the problem by key, `others` further spellings of them;
    `quantities` are what an answer may be given for;
    `derived` are derivatives that were defined on their own, `broken` definitions that
    could not be read, `angles` the student's own by subscript.
    `missed` are names that were looked for before anything defined them;
    `used` are the names of the student's own that were used,
    `own_entries` are the entries of matrices, and the letters of answers, that an equation of their own
    gives, `missed_entries` those that were named before that was known;
    `orders` says for letters of Christoffel symbols which index counts the row.
    `masses` are the masses, the moments of inertia and g; `has_inverse_functions` says that arccos and
    its like are known, `reached` what the values of the task are called where the inverse kinematics is
    asked for, each with the component of r that it is; `passive` are the generalized forces that are 0,
    since no motor drives their coordinates;
    `candidates` are the matrices that are to be judged; `asked` is what has to be answered, with its parts;
    `defined` is what the student defined, `remembered` what was read since, `shared` what was read by all
    hand-ins before they said anything of their own; `from_zero` are the names whose
    indices count from 0; `base_is_world` says that H_1 is A_1; `letters` are those of the coordinates that
    have an index; `inputs` are the generalized forces as symbols, where results hold them; `spelled` is what
    spellings mean in every hand-in.
    """

    coordinates: tuple[Coordinate, ...]
    symbols: dict[str, Symbol]
    others: dict[str, Symbol]
    quantities: Quantities
    masses: frozenset[str]
    has_inverse_functions: bool = False
    passive: tuple[str, ...] = ()
    reached: Mapping[str, str] = field(default_factory=dict)
    candidates: tuple[str, ...] = ()
    asked: frozenset[str] = frozenset()
    defined: dict[str, Meaning] = field(default_factory=dict)
    derived: dict[tuple[str, int], Value] = field(default_factory=dict)
    broken: dict[str, str] = field(default_factory=dict)
    angles: dict[str, Node] = field(default_factory=dict)
    subscripts: dict[str, Coordinate] = field(default_factory=dict)
    base_is_world: bool = True
    missed: set[str] = field(default_factory=set)
    used: set[str] = field(default_factory=set)
    own_entries: set[str] = field(default_factory=set)
    missed_entries: set[str] = field(default_factory=set)
    remembered: dict[Any, Any] = field(default_factory=dict)
    orders: dict[str, int] = field(default_factory=lambda: dict(USUAL))
    from_zero: frozenset[str] = frozenset()
    letters: frozenset[str] = frozenset()
    inputs: tuple[str, ...] = ()
    shared: dict[Any, Any] = field(default_factory=dict)
    spelled: dict[str, Any] = field(default_factory=dict)

    def fresh(self) -> Vocabulary:
        """The names of the problem alone, for another hand-in."""
        return Vocabulary(
            self.coordinates, self.symbols, self.others, self.quantities, self.masses,
            self.has_inverse_functions, self.passive, self.reached, self.candidates,
            self.asked, subscripts=self.subscripts, base_is_world=self.base_is_world,
            from_zero=self.from_zero, letters=self.letters, inputs=self.inputs, shared=self.shared,
            spelled=self.spelled,
        )  # fmt: skip

    @property
    def has_no_other_names(self) -> bool:
        """Whether no name of the problem means anything else in this hand-in."""
        return not (self.defined or self.derived or self.broken or self.angles)

    @property
    def is_untouched(self) -> bool:
        """Whether the names are those of the problem alone, as in every other hand-in."""
        return self.has_no_other_names and not self.from_zero and self.orders == USUAL

    def once(self, written: Any, read: Callable[[], _T]) -> _T:
        """What is read of something, with what is looked for in vain: once for the hand-ins to a problem."""
        if not self.is_untouched:
            return read()
        if written not in self.shared:
            before = self.missed, self.missed_entries
            self.missed, self.missed_entries = set(), set()
            found = read(), self.missed, self.missed_entries
            self.missed, self.missed_entries = before
            if isinstance(found[0], ReadError):  # which would keep all that was read on its way
                self.missed |= found[1]
                self.missed_entries |= found[2]
                return found[0]
            keep(self.shared, written, found, MOST_REMEMBERED)
        known: tuple[_T, set[str], set[str]] = self.shared[written]
        self.missed |= known[1]
        self.missed_entries |= known[2]
        return known[0]

    def define(self, name: str, meaning: Meaning) -> None:
        """Keep what the student says a name is, from here on."""
        self.defined[name] = meaning
        self.remembered.clear()

    def cannot_be_read(self, name: str, why: str) -> None:
        """Keep why a definition gives no value."""
        self.broken[name] = why
        self.remembered.clear()

    def count(self, orders: Mapping[str, int]) -> None:
        """Keep which index of these letters counts the row."""
        if orders:
            self.orders |= orders
            self.remembered.clear()

    def driving_force(self, name: str) -> str:
        """The force that a letter of what drives means: u_2, or the F of the only motor; else empty."""
        if not DRIVING.fullmatch(name) or name in self.symbols or name in self.defined:
            return ""
        known = [q.force for q in self.coordinates]
        indexed = [n for n in self.named(f"tau{name[1:]}") if n in known] if name[1:].isdigit() else []
        driven = [force for force in known if force not in self.passive]
        found = indexed or (driven if len(driven) == 1 else [])
        return found[0] if found else ""

    def symbol(self, name: str) -> Meaning | None:
        """The symbol of the problem, or what the student defined, of that key."""
        if name in self.defined:
            self.used.add(name)
            return self.defined[name]
        if name in self.symbols:
            return Meaning(self.symbols[name])
        if name in self.others:
            return Meaning(self.others[name])
        return self._shorthand(name)

    @property
    def has_references(self) -> bool:
        """Whether reference rates are names of this problem."""
        return any(reference(q.name) in self.others for q in self.coordinates)

    def is_reference(self, name: str) -> bool:
        """Whether a name is the reference of a coordinate, of which there are rates."""
        return name in self.others and name in {reference(q.name) for q in self.coordinates}

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
        self.missed.add(name)  # a report may define it below
        return Meaning(Function("sin" if found[1] in "sS" else "cos", angle))

    def short_angle(self, name: str) -> Function | None:
        """ctheta1, sq2: a function written as its first letter before the angle."""
        if len(name) < 3 or name[0] not in "csCS":
            return None
        angle = self.symbols.get(name[1:]) or self.others.get(name[1:])
        q = self.coordinate(angle) if angle is not None and not angle.dots else None
        if angle is None or q is None or q.type is not JointType.REVOLUTE:
            return None
        return Function("sin" if name[0] in "sS" else "cos", angle)

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
        for form, written in zip(_FORMS, _by_form(tuple(self.symbols.items())), strict=True):
            same = written.get(form(name), [])
            if len(same) == 1 and sorted(key(same[0].name).lower()) == sorted(name.lower()):
                return Meaning(same[0], f"{name} is read as {same[0].name}")
        return None

    def only_coordinate(self, name: str) -> Symbol | None:
        """The one coordinate of a letter, where that is written without its index: theta for theta1."""
        letter = {"th": "theta", "ell": "l"}.get(name.lower(), name.lower())
        same = [q for q in self.coordinates if split(q.name)[0].lower() == letter]
        if not same and len(self.coordinates) == 1 and letter in ("q", "theta", "th", "x"):
            same = list(self.coordinates)
        if not same and letter in ("theta", "phi", "varphi"):
            same = [q for q in self.coordinates if q.type is JointType.REVOLUTE]
        return Symbol(same[0].name) if len(same) == 1 else None

    def has_rates_of(self, name: str) -> bool:
        """Whether rates of a name are the student's own."""
        return f"{name}'" in self.defined or f"{name}''" in self.defined

    def inertia(self, name: str) -> Meaning | None:
        """The one moment of inertia with the index of a bare I_1."""
        base, groups = split(name)
        wanted = base, groups[:1]
        found = [(split(other), symbol) for other, symbol in self.symbols.items()]
        same = [symbol for (letter, indices), symbol in found if (letter, indices[:1]) == wanted]
        return Meaning(same[0], f"{name} is read as {same[0].name}") if len(same) == 1 else None

    def velocities(self, dots: int) -> Grid:
        """The column of the velocities (or the coordinates, or the accelerations)."""
        return Grid(tuple((Symbol(q.name, dots),) for q in self.coordinates), is_rates=dots)

    def is_vector(self, name: str) -> bool:
        """Whether a bare name is the vector of coordinates: q, theta, or the one letter of them all."""
        return name in _VECTORS or (len(self.coordinates) > 1 and self.letters == {name})

    def coordinate(self, node: Value | None) -> Coordinate | None:
        """The coordinate that a symbol is, with any number of dots."""
        if isinstance(node, Symbol):
            return next((q for q in self.coordinates if q.name == node.name), None)
        return None

    def named(self, name: str) -> tuple[str, ...]:
        """The answers that a name may stand for, by its key; several where the notation allows several."""
        return self.quantities.spellings.get(in_usual_order(name, self.orders), ())

    def gives(self, name: str) -> None:
        """Keep that an equation gives this answer, where it is an entry of a matrix."""
        if self.quantities.entry_of(name)[0] and name not in self.own_entries:
            self.own_entries.add(name)
            self.remembered.clear()

    def calls(self, letter: str) -> None:
        """Keep that an equation gives the answer of this one letter: in another case it is no symbol."""
        if len(letter) == 1 and letter not in self.own_entries:
            self.own_entries.add(letter)
            self.remembered.clear()

    def is_own_entry(self, name: str, whole: str) -> bool:
        """Whether a name in a value of `whole` is an entry of it with an equation of its own: c_12 in C."""
        found = self.named(name) if self.shape(whole) is not None and name not in self.symbols else ()
        entries = {entry for entry in found if self.quantities.entry_of(entry)[0] == whole}
        self.missed_entries |= entries - self.own_entries
        return not entries.isdisjoint(self.own_entries)

    def family(self, name: str) -> tuple[str, ...]:
        """The answers of the kind that a name with an unknown index belongs to."""
        if name.endswith("0") and not name[-2:-1].isdigit():  # g_0 is a name of the student's own
            return ()
        return self.quantities.open_spellings.get(open_index(name), ())

    def is_answer(self, name: str) -> bool:
        """Whether this is the name of an answer, as answers are kept."""
        quantity = self.quantities.get(name)
        return quantity is not None and quantity.family.is_answer

    def named_of_kind(self, name: str, *kinds: Kind) -> str | None:
        """The answer of that name that is of one of these kinds; None for any other."""
        found = self.quantities.canonical(name)
        return found if found and self.quantities[found].family.kind in kinds else None

    def are_multipliers(self, names: Iterable[str]) -> bool:
        """Whether no name is that of an answer but λ, or an entry of it."""
        return all(self.quantities[name].family in MULTIPLIERS for name in names)

    def shape(self, name: str) -> Shape:
        """Rows and columns of an answer; None for a scalar, and for what is none."""
        quantity = self.quantities.get(name)
        return quantity.shape if quantity is not None else None


SET_KINDS = (Kind.EQUATIONS, Kind.CONDITIONS, Kind.BRANCHES)
"""Of which kinds an answer is a set of equations, or of branches."""

_HOLD_ANGLES = frozenset({"inverse", "singular", "equilibria"})
"""Answers that give angles, and so may hold arccos and its like."""


_BRACKETED = re.compile(r"\b([A-Za-z]\w*)\[(\d)(?:(?:,[ ]?|\]\[)(\d))?\]")


def counted_from_zero(text: str, n: int) -> frozenset[str]:
    """The names whose bracketed indices count from 0: those with a 0, beside one those that never reach n."""
    if "[0" not in text and "0]" not in text:
        return frozenset()
    indices: dict[str, set[int]] = {}
    for name, *found in _BRACKETED.findall(text):
        indices.setdefault(key(name), set()).update(int(index) for index in found if index)
    if all(0 not in found for found in indices.values()):
        return frozenset()
    return frozenset(name for name, found in indices.items() if 0 in found or max(found) < n)


def is_running(index: str) -> bool:
    """Whether an index runs: K_i, v_{ci}, omega_{i-1}."""
    return bool(_RUNNING.fullmatch(key(index)))


@lru_cache(maxsize=4_096)  # of the problem's symbols it is asked again for every name that is none
def _sorted_key(name: str) -> str:
    base, groups = split(name)
    return base + ",".join(sorted("".join(groups)))


def _sorted_and_low(text: str) -> str:
    return _sorted_key(text.lower())


_FORMS: tuple[Callable[[str], str], ...] = (_sorted_key, str.lower, _sorted_and_low)
"""What two spellings of one parameter share, the nearest first."""


@lru_cache(maxsize=64)
def _by_form(symbols: tuple[tuple[str, Symbol], ...]) -> tuple[dict[str, list[Symbol]], ...]:
    """For each of these forms the symbols that have it."""
    found: tuple[dict[str, list[Symbol]], ...] = tuple({} for _ in _FORMS)
    for form, written in zip(_FORMS, found, strict=True):
        for name, symbol in symbols:
            written.setdefault(form(name), []).append(symbol)
    return found


def vocabulary(problem: Problem) -> Vocabulary:
    """The names of a problem."""
    robot = problem.robot
    coordinates = robot.coordinates
    symbols = {key(name): Symbol(name) for name in robot.parameters}
    symbols |= {key(q.name): Symbol(q.name) for q in coordinates}
    has_arcs = not robot.questions.asked.isdisjoint(_HOLD_ANGLES)
    reached = robot.questions.reached if "inverse" in robot.questions.asked else ()
    symbols |= {key(name): Symbol(name) for name in reached}
    others: dict[str, Symbol] = {"pi": Symbol("pi")}
    spoken = subscripts(coordinates)
    further = [*_of_coordinates(symbols, spoken), *_of_commands(symbols, coordinates)]
    further += _of_references(coordinates) if robot.ring.plan.references else ()
    for name, meant, moves in further:
        for spelling, dots in spellings(name):
            if spelling not in symbols and (moves or not dots):
                others.setdefault(spelling, Symbol(meant, dots))
    masses = frozenset(name for name in robot.parameters if split(name)[0] in ("m", "M", "g", "I", "J"))
    passive = tuple(coordinates[k].force for k in robot.actions.passive)
    return Vocabulary(
        coordinates,
        symbols,
        others,
        quantities(robot),
        masses,
        has_arcs,
        passive,
        {name: f"r{k}" for k, name in enumerate(reached, 1)},
        tuple(candidate.name for candidate in robot.questions.candidates),
        frozenset(part for name in problem.marks or problem.find for part in quantities(robot).within(name)),
        subscripts=spoken,
        base_is_world=robot.base_position.is_zero
        and (robot.base_rotation - Matrix.identity(robot.ring, 3)).is_zero,
        letters=frozenset(_letter(q.name) for q in coordinates) - symbols.keys(),
        inputs=robot.inputs,
    )


def _letter(name: str) -> str:
    base, _ = split(name)
    return GREEK_COMMANDS.get(base, base)


def _of_coordinates(
    symbols: dict[str, Symbol], subscripts: dict[str, Coordinate]
) -> Iterator[tuple[str, str, bool]]:
    """The coordinates by their other names: (name, coordinate, that it moves)."""
    for rank in range(4):
        for index, q in subscripts.items():
            letter = "theta" if q.type is JointType.REVOLUTE else "d"
            short = "th" if letter == "theta" else letter
            name = (q.name, f"q{q.index}", f"{letter}{index}", f"{short}{index}")[rank]
            if not rank or name not in symbols:
                yield name, q.name, True


def _of_commands(
    symbols: dict[str, Symbol], coordinates: tuple[Coordinate, ...]
) -> Iterator[tuple[str, str, bool]]:
    r"""What commands make of names that are spelled as these: `\ell_1` of ell1, `\varphi` of varphi."""
    moving = {q.name for q in coordinates}
    for command, letter in GREEK_COMMANDS.items():
        for symbol in symbols.values():
            if command != letter and symbol.name.startswith(command):
                yield letter + symbol.name[len(command) :], symbol.name, symbol.name in moving


def _of_references(coordinates: tuple[Coordinate, ...]) -> Iterator[tuple[str, str, bool]]:
    """The reference rates: q1r_dot, qr1_dot, and q_1r under dots."""
    for q in coordinates:
        base, _ = split(q.name)
        index = key(q.name)[len(base) :]
        for name in (reference(q.name), f"{base}r{index}", f"q{q.index}r", f"qr{q.index}"):
            yield name, reference(q.name), True


def spellings(name: str) -> list[tuple[str, int]]:
    """Every way to write a coordinate and its derivatives in one word, with the number of dots."""
    plain = key(name)
    base, _ = split(name)
    index = plain[len(base) :]
    found = [(plain, 0)]
    for dots, marks in _RATES.items():
        for mark in marks:
            found += [(plain + mark, dots), (base + mark + index, dots), (mark + plain, dots)]
    for dots, marks in _MARKS.items():
        found += [(plain + mark, dots) for mark in marks]
        found += [(base + mark + index, dots) for mark in marks if index and mark not in ("t", "tt")]
    return [*found, ("d2" + plain, 2)]


_RATES = {1: ("dot", "d"), 2: ("ddot", "dd", "dotdot")}
"""What marks a derivative before, within or behind a name."""
_MARKS = {
    1: ("Dot", "p", "prime", "t", "der"),
    2: ("DDot", "Ddot", "DotDot", "pp", "primeprime", "dprime", "doubleprime", "tt"),
}
"""What marks one within or behind a name, as students of many languages write it."""
