"""The list of notation of a report: every sign that occurs in it, with its meaning and its unit.

The names of the problem come first, by what they are (`explain.roles`), then the shorthands of sines and
cosines, then the letters of the textbook (`explain.textbook_letters`).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.angles import Angle
from dynsolve.document import Block, Inline, Prose, Table
from dynsolve.document.sentences import say
from dynsolve.explain.abbreviations import Abbreviated
from dynsolve.explain.parameter_meanings import Acting, Role, in_order, meanings, shape_letters, told_together
from dynsolve.explain.signs import TRANSPOSED, Kind, formulas_in, kind_of, kinds_in, shorthands, units_of
from dynsolve.explain.textbook_letters import ENTRIES_IN_PRODUCTS, SHAPES, Line, textbook
from dynsolve.explain.writing import agreeing, listed, side_by_side
from dynsolve.notation.characters import GREEK
from dynsolve.notation.printing import PLAIN, Style, lower_indices
from dynsolve.notation.tree import Function, Letter, Node, Relation, Row, Sum, Symbol, Words, equation
from dynsolve.quantities import letters
from dynsolve.quantities.owners import stages_of
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Convention, JointType, Robot
from dynsolve.robot.shapes import MASS
from dynsolve.robot.units import node as unit_node

COUNTING = ("i", "j", "k", "n", "t")
"""The names that every textbook counts with, and time: told in a sentence."""

# -- the names of the problem ----------------------------------------------------------------------


def problem_names(robot: Robot, *, frames: bool = True) -> Iterator[Line]:
    """The coordinates, and the parameters by what they are; without `frames` by no frame."""
    own = (motor for motor in robot.actions.rotors if robot.is_of_motor(robot.coordinates[motor.turns]))
    geared = any(motor.ratio != robot.ring.one for motor in own)
    of_motor = "angle|angles of a|the motor|motors" + " behind its|their gear|gears" * geared
    for is_of_motor, kind, what, unit in (
        (False, JointType.REVOLUTE, "angle|angles", "rad"),
        (False, JointType.PRISMATIC, "displacement|displacements", "m"),
        (True, JointType.REVOLUTE, of_motor, "rad"),
    ):
        of_kind = [q for q in robot.coordinates if q.type is kind and robot.is_of_motor(q) is is_of_motor]
        if all(any(joint.rates == ((q.index - 1, Fraction(1)),) for joint in robot.joints) for q in of_kind):
            what = f"joint {what}"
        elif not is_of_motor and all(Angle.of(q.name) in _of_links(robot) for q in of_kind):
            what = f"{what} of a|the link|links against 𝐱₀"
        if of_kind:
            meaning = agreeing(f"{what}: generalized coordinate|coordinates", len(of_kind))
            yield _named([q.name for q in of_kind], meaning, unit)
    if robot.given is None and robot.questions.candidates:
        yield _named([one.name for one in robot.questions.candidates], "matrices that are to be judged", "")
    known, has_bodies = meanings(robot), bool(robot.bodies)
    for role in in_order(robot):
        if role is Role.GRAVITY and not robot.has_dynamics:
            continue
        units = dict.fromkeys(unit for own, unit, _ in known.values() if own == role)
        for unit in units:
            alike = [(name, told) for name, (own, its, told) in known.items() if (own, its) == (role, unit)]
            by_place = frames or isinstance(role, Acting)
            of_place = [(name, told) for name, told in alike if by_place and told.words]
            for names, words in told_together(of_place):
                yield _named(names, words, unit)
            by_share: dict[str, list[str]] = {}
            is_in_figure = role is Role.LENGTH and not frames
            for name, told in alike:
                if not (by_place and told.words):
                    by_share.setdefault("" if is_in_figure else told.share, []).append(name)
            for share, names in by_share.items():
                is_told = unit == "m" or has_bodies  # a₁ (kg) of a given 𝐃 need be no mass
                meaning = share + role.of(len(names), unit if is_told else "")
                if is_in_figure:
                    meaning = agreeing("length|lengths in the figure", len(names))
                yield _named(names, meaning, unit)


def _of_links(robot: Robot) -> list[Angle]:
    """The angles of the links against x_0: of those whose axes are parallel to z_0."""
    standard = robot.convention is Convention.STANDARD
    paths = [robot.path(joint.index) for joint in robot.joints]
    return [
        sum((joint.theta for joint in path), start=Angle.zero())
        for path in paths
        if all(joint.alpha == Angle.zero() for joint in (path[:-1] if standard else path))
    ]


def _named(names: Sequence[str], meaning: str, unit: str) -> Line:
    kinds = frozenset(("", "name", name) for name in names)
    return Line(tuple(map(Symbol, names)), meaning, unit, kinds)


def _shorthands(robot: Robot, style: Style) -> Iterator[Line]:
    """s_1 and c_1, each by its meaning: of the coordinates, whatever a row of the table adds to them."""
    if shown := tuple(shorthands(robot, style)):
        kinds = frozenset(kind for node in shown if (kind := kind_of(node, style)))
        yield Line(shown, "sines and cosines of the coordinates", "", kinds)


def shorthands_in(blocks: Iterable[Block], robot: Robot, style: Style) -> list[Line]:
    """The line of the shorthands that occur in a document, if any do."""
    occurring = kinds_in(formulas_in(blocks), style)
    return [
        _told(line.of(found, style), style)
        for line in _shorthands(robot, style)
        if (found := line.kinds & occurring)
    ]


def _written_out(node: Function) -> Node:
    """A sine or cosine that no style abbreviates: sin θ_1, sin(θ_1 + θ_2)."""
    if isinstance(node.argument, Sum):
        return Row((Words(f"{node.name}("), node.argument, Words(")")))
    return Row((Words(f"{node.name} "), node.argument))


# -- the lines of a report -------------------------------------------------------------------------


class Notation(Struct, frozen=True):
    """What is said of the signs of a report: sentences about all of them, and a line for each."""

    remarks: Prose
    lines: tuple[Line, ...]

    @property
    def table(self) -> Table:
        """The lines as a table."""
        rows = tuple(
            (line.sign, line.words, unit_node(line.unit) if line.unit else "") for line in self.lines
        )
        return Table(("Symbol", "Meaning", "Unit"), rows)


def in_a_sentence(lines: Iterable[Line]) -> Prose:
    """Notation: ℛ Rayleigh's dissipation function (W); 𝛕_f column of the friction."""
    told: Prose = ()
    for line in lines:
        unit: Prose = (" (", unit_node(line.unit), ")") if line.unit else ()
        told += ("; ", line.sign, f" {line.words}", *unit)
    return ("Notation: ", *told[1:], ".")


def letters_beside(
    robot: Robot, style: Style, shown: Sequence[Block], stated: Iterable[Block]
) -> tuple[Line, ...]:
    """The textbook's letters in blocks that go beyond the course, and that no equation there defines."""
    occurring = kinds_in(formulas_in(shown), style)
    told = set(_defined(formulas_in(shown), style)) | kinds_in(formulas_in(stated), style)
    own = {("", "name", name) for name in (*robot.parameters, *(q.name for q in robot.coordinates))}
    lines = [(line, (line.kinds & occurring) - told - own) for line in textbook(robot, style, beside=True)]
    found = [
        line.of(kinds if not line.each else kinds | {kind_of(line.signs[0], style)}, style)
        for line, kinds in lines
        if kinds  # with the first sign, as the words of others go on from its: their entries
    ]
    return _merged(found)


def _defined(nodes: Iterable[Node], style: Style) -> Iterator[Kind]:
    for node in nodes:
        for part in node.parts if isinstance(node, Row) else (node,):
            if isinstance(part, Relation):
                yield from (kind for left in part.parts[:-1] if (kind := kind_of(left, style)))


def notation(
    robot: Robot, style: Style, blocks: Iterable[Block], short: Abbreviated | None = None
) -> Notation:
    """The notation of blocks: the lines for the signs that occur there, the problem's own first."""
    occurring = kinds_in(formulas_in(blocks), style)
    own = {("", "name", name) for name in (*robot.parameters, *(q.name for q in robot.coordinates))}
    general = [replace(line, kinds=line.kinds - own) for line in textbook(robot, style)]
    lines = [
        *problem_names(robot),
        *_shorthands(robot, style),
        *_of_abbreviations(robot, short),
        *general,
        *_of_shapes(robot, occurring - own),
    ]
    unknown = occurring.difference(*(line.kinds for line in lines))
    names = sorted(name for _, kind, name in unknown if kind == "name" and name not in COUNTING)
    if names and Stage.FRAMES in stages_of(robot):  # on these the table does not depend
        lines.append(_named(names, "lengths in the drawing alone", "m"))
    shown = _merged(
        _told(line.of(line.kinds & occurring, style), style) for line in lines if line.kinds & occurring
    )
    return Notation(tuple(_remarks(robot, occurring, own)), shown)


def _merged(lines: Iterable[Line]) -> tuple[Line, ...]:
    """The lines, those of one meaning in one: the masses m_1 and m_2 of the problem, and m_i of a formula."""
    found: dict[object, Line] = {}
    for line in lines:
        key = line.words, line.unit
        first = found.get(key, replace(line, signs=(), kinds=frozenset()))
        found[key] = replace(first, signs=(*first.signs, *line.signs), kinds=first.kinds | line.kinds)
    return tuple(found.values())


def _told(line: Line, style: Style) -> Line:
    """The line with what there is to say of the choice of its signs."""
    sines = [sign for sign in line.signs if isinstance(sign, Function)]
    if sines:  # the first sine and cosine, and the first of a sum, or else the next
        of_sums = [node for node in sines if isinstance(node.argument, Sum)]
        examples = dict.fromkeys([*sines[:2], *(of_sums or sines[2:])[:2]])
        told: list[Node] = [equation(node, _written_out(node)) for node in examples]
        told += [Words("and so on")] if len(examples) < len(sines) else []
        return replace(line, meaning=side_by_side(told))
    of_spong = [
        one
        for one in line.signs
        if isinstance(one, Letter) and (one.base, lower_indices(one)) in letters.SPONGS
    ]
    changed = [sign for sign in of_spong if style.base(sign) != sign.base]
    if changed:
        spong = GREEK.get(changed[0].base, changed[0].base)
        what = f"{spong} for the entries" if len(line.signs) > 1 else spong
        return replace(line, meaning=f"{line.meaning}; Spong writes {what}")
    return line


def _of_abbreviations(robot: Robot, short: Abbreviated | None) -> Iterator[Line]:
    """The names of constants and recurring terms: in a long model all of a kind in one line."""
    if short is None:
        return
    if short.at_symbols:
        for unit, names in units_of(robot, short.sums).items():
            it = "abbreviation|abbreviations, defined where it|they first occurs|occur"
            yield _named(names, agreeing(it, len(names)), unit)
        return
    of = {name: unit for unit, names in units_of(robot, short.definitions).items() for name in names}
    for definitions, what in ((short.constants, "inertial constants"), (short.sums, "recurring terms")):
        names = [one.name.name for one in definitions]
        if names:
            units = " or ".join(sorted({of[name] for name in names} - {""}))
            yield _named(names, f"{what}, see Abbreviations", units)


def _of_shapes(robot: Robot, occurring: set[Kind]) -> Iterator[Line]:
    """The letters of the formulas of this robot's uniform shapes, which those formulas alone have."""
    signs = {letter: sign.name for letter, sign in shape_letters(robot).items()}
    used = [letter for letter in SHAPES if ("", "name", signs.get(letter, "")) in occurring]
    for unit in ("kg", "m"):
        own = [letter for letter in used if (letter == MASS) == (unit == "kg")]
        if own:
            meaning = f"{', '.join(SHAPES[letter] for letter in own)} of a uniform shape"
            yield _named([signs[letter] for letter in own], meaning, unit)


def _remarks(robot: Robot, occurring: set[Kind], own: set[Kind]) -> Iterator[Inline]:
    """What is said of all signs: what counts, the time, units of entries, bold letters."""
    names = [name for name in COUNTING if ("", "name", name) in occurring - own]
    if any("#" in shape for _, kind, shape in occurring - own if kind != "name"):
        yield from say("$i$, $j$ and $k$ count rows, frames, bodies and coordinates. ")
    if "n" in names:
        yield from say("$n$ is the number of coordinates. ")
    if "t" in names:
        yield from say("A dot is the derivative with respect to the time $t$. ")
    if TRANSPOSED in occurring - own:
        yield "A superscript T denotes the transpose. "
    entries = [sign for sign in ENTRIES_IN_PRODUCTS if kind_of(sign, PLAIN) in occurring]
    if entries and len({q.type for q in robot.coordinates}) > 1:
        units, are = ("The unit", "is") if len(entries) == 1 else ("The units", "are")
        yield from (f"{units} of ", *listed(entries), f" {are} listed for angles: ")
        yield "divide by the metre for each index that belongs to a length. "
    if any(kind == "bold" for _, kind, _ in occurring):
        yield "Bold letters are vectors and matrices."
    if robot.convention is Convention.MODIFIED and kind_of(letters.D, PLAIN) in occurring:
        yield from say(" Craig writes M, V and G for $𝐃$, $𝐂 𝐪̇$ and $𝐠$.")
