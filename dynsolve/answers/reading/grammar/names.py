"""What a name means: a symbol of the problem, the student's own, an answer, or a letter of the derivation.

Letters of the derivation that have no value for this robot: running indices, z_0, R_1, a zero level.
"""

from __future__ import annotations

import re
from difflib import get_close_matches
from functools import lru_cache

from dynsolve.answers.reading.grammar.reader import Reader, by_time, derivative, rate
from dynsolve.answers.reading.grammar.references import (
    only_coordinates,
    placeholder,
    quantity,
    short_function,
    skip_arguments,
)
from dynsolve.answers.reading.grammar.scripts import MARKS, PSEUDO_INVERSE, Form, Scripts
from dynsolve.answers.reading.grids import Abstract, Grid, Value, grid
from dynsolve.answers.reading.vocabulary import ZERO_LEVELS, Meaning, is_running
from dynsolve.errors import ReadError
from dynsolve.notation.tree import Node, Number, Symbol
from dynsolve.quantities import families
from dynsolve.quantities.families import holds_forces
from dynsolve.quantities.letters import key
from dynsolve.robot.questions import reference

# Letters of the derivation that have no value for this robot

_ANGLES = ("theta", "phi", "varphi", "th")
_RATE_OF_ANGLE = re.compile(r"(?P<d>d{1,2})?(?P<name>theta|phi|varphi|th)(?P<dots>dot|ddot|dotdot)?")
_POTENTIAL = re.compile(r"P.*|L")
_LETTERS = re.compile(r"(?:z|o|R|r|p|x|y|e|n|a|u|s)(?:[0-9a-z]*|[xyz]theta[0-9]*|[xyz],?[qt].*)")
_UNIT_VECTORS = "ijk"
_HEIGHT = re.compile(r"h[1-9a-z][0-9]*")
_SPELLED_RATES = {"qdot": 1, "dq": 1, "qd": 1, "qddot": 2, "ddq": 2, "qdd": 2}
_NEED_AN_INDEX = frozenset("Jv Jw Kv Kw Jomega Komega I omega v A H R".split())


def only_coordinate(reader: Reader, form: Form, name: str, text: str = "") -> Value | None:
    r"""The coordinate that `\dot\theta` is where there is only one θ: in a scalar, without a transpose.

    `text` is what of it is said to be read so, where that is not all: th of dth.
    """
    is_one = len(reader.vocabulary.coordinates) == 1 and reader.vocabulary.is_vector(name)
    is_marked = form.dots or form.scripts.mark or name in _ANGLES or is_one
    if reader.naming or form.scripts.transposed or not is_marked:
        return None
    is_matrix = reader.vocabulary.shape(reader.owner) not in (None, (1, 1))
    if is_matrix or any(t.text in ("T", "top") for t in reader.tokens):
        return None
    symbol = None if reader.vocabulary.has_rates_of(name) else reader.vocabulary.only_coordinate(name)
    if name == "q" and reader.references:  # beside D and C it is the vector
        return None
    if symbol is None or (reader.token.kind == "(" and only_coordinates(reader, reader.position)):
        return None
    value = rate(symbol, reader.vocabulary, form.dots + form.scripts.primes)
    if value is None:
        return None
    form.scripts.primes = 0
    reader.symbols.setdefault(symbol.name)
    reader.notes.setdefault(f"{text or form.text} is read as {symbol.name}")
    skip_arguments(reader)
    return reader.with_scripts(value, form.scripts, form.start)


def _only_rate(reader: Reader, form: Form, name: str) -> Value | None:
    """The rate of the only angle in letters: dth, thdot, th_ddot."""
    found = _RATE_OF_ANGLE.fullmatch(name)
    order = len(found["d"] or "") + (found["dots"] or "").count("d") if found else 0
    if found is None or not 0 < order + form.dots < 3 or (found["d"] and found["dots"]):
        return None
    form.dots += order
    value = only_coordinate(reader, form, found["name"], found["name"])
    form.dots -= order
    return value


def zero_level(reader: Reader, form: Form, name: str) -> Value | None:
    """h₀, from which a student counts heights, or the potential energy P₀ that is there."""
    if name not in ZERO_LEVELS or form.dots or not _POTENTIAL.fullmatch(reader.owner):
        return None
    reader.free.setdefault(name)
    return reader.with_scripts(Symbol(name), form.scripts, form.start)


def letter(reader: Reader, form: Form, name: str) -> Value | None:
    """The vector of coordinates, a running index, z_0, o_2, R_1, a zero level: the first that it can be."""
    values = (read(reader, form, name) for read in _READINGS)
    return next((value for value in values if value is not None), None)


def _held_forces(reader: Reader, form: Form, name: str) -> Value | None:
    """τ of the joints, in an answer that says which forces hold the arm."""
    if reader.naming or not holds_forces(reader.owner):
        return None
    forces = reader.vocabulary.driving_force(name) or ("tau" if name == "u" else "")
    if not forces:
        return None
    reader.references.setdefault(forces)
    return reader.with_scripts(placeholder(reader.vocabulary, forces), form.scripts, form.start)


def _unit_vector(reader: Reader, form: Form, name: str) -> Value | None:
    """i, j or k, in an answer that is a vector."""
    if name not in _UNIT_VECTORS or form.dots or reader.vocabulary.shape(reader.owner) != (3, 1):
        return None
    vector = grid([[Number(int(place == _UNIT_VECTORS.index(name)))] for place in range(3)])
    return reader.with_scripts(vector, form.scripts, form.start)


def _coordinates(reader: Reader, form: Form, name: str) -> Value | None:
    """q, q̇ or q̈ as a column."""
    if not reader.vocabulary.is_vector(name) or form.dots > 2:
        return None
    skip_arguments(reader)
    reader.names_used += 1
    value = reader.vocabulary.velocities(form.dots + form.scripts.primes)
    form.scripts.primes = 0
    return reader.with_scripts(value, form.scripts, form.start)


def _references(reader: Reader, form: Form, name: str) -> Value | None:
    """q_r as a column, where the problem has references."""
    vocabulary = reader.vocabulary
    if name != "qr" or not vocabulary.has_references:
        return None
    reader.names_used += 1
    rates = tuple((Symbol(reference(q.name), form.dots),) for q in vocabulary.coordinates)
    return reader.with_scripts(Grid(rates, is_rates=form.dots), form.scripts, form.start)


def _spelled_rates(reader: Reader, form: Form, name: str) -> Value | None:
    """q̇ or q̈ in letters: dq, qddot."""
    order = _SPELLED_RATES.get(name)
    if order is None or form.dots:
        return None
    only = reader.vocabulary.only_coordinate("q")
    if len(reader.vocabulary.coordinates) == 1 and only and not reader.references:
        reader.symbols.setdefault(only.name)
        return reader.with_scripts(Symbol(only.name, order), form.scripts, form.start)
    reader.names_used += 1
    return reader.with_scripts(reader.vocabulary.velocities(order), form.scripts, form.start)


def _without_value(reader: Reader, form: Form, name: str) -> Value | None:
    """What has no value for this robot: J⁺, m_i of any i, z₀, a height h₂, J_v of no body in particular."""
    index, missed, why = form.index or form.base_index, "", ""
    is_value, is_short = not reader.naming, form.base[:1].isalpha() and len(form.base.split("_")[0]) <= 2
    if is_value and name.endswith((PSEUDO_INVERSE, *MARKS)):
        missed, why = name, "is a name for another matrix"
    elif index and is_running(index):
        why = "has a running index"
    elif is_value and is_short and _LETTERS.fullmatch(name):
        reader.letters.append(form)
        missed, why = name + "'" * form.dots, "is a letter of the derivation"
    elif _HEIGHT.fullmatch(name) and _POTENTIAL.fullmatch(reader.owner):
        why = "is a height"
    elif is_value and name in _NEED_AN_INDEX:
        missed, why = name, "has no index"
    if missed:  # the student may give it a value
        reader.vocabulary.missed.add(missed)
    reader.names_used += bool(why)
    return Abstract(f"{form.text} {why}") if why else None


_READINGS = (
    only_coordinate, _only_rate, _held_forces, _unit_vector, _coordinates, _references, _spelled_rates,
    _without_value,
)  # fmt: skip
"""What a letter may be, in the order in which it is tried."""

_BEFORE_TERM = frozenset({"+", "-", "(", "[", "begin", "&", "\\\\", ",", ";"})
_BEHIND_ENTRY = frozenset({"&", "\\\\", "close", ",", ";", "]"})
_OWNER_BODY = re.compile(r"[0-9]+$")
SEVERAL = re.compile(r"(?:q|theta|phi)([0-9]{2,})")
_MOMENT = re.compile(r"[IJ][xyz]{1,2}")


class UnknownName(ReadError):
    """A name that means nothing here; `family` are the answers of the kind it would be one of."""

    def __init__(self, form: Form, help: str, family: tuple[str, ...] = ()) -> None:
        message, length = f"unknown symbol `{form.text[:60]}`", max(form.end - form.start, 1)
        super().__init__(message, form.start, length, help)
        self.form, self.family = form, family


def value_of(reader: Reader, form: Form) -> Value:
    """The value of a name with its scripts; raises UnknownName for one that has none."""
    vocabulary = reader.vocabulary
    name = form.key + _called_index(reader, form)
    if form.scripts.mark and not form.index and (lone := only_coordinate(reader, form, name)) is not None:
        return lone
    whole = "C" if _multiplies_rate(reader, form) else reader.owner
    is_entry = name not in vocabulary.defined and vocabulary.is_own_entry(name, whole)
    is_matrix = is_entry or _is_function_of_q(reader, name)
    is_matrix = is_matrix or stands_between_rates(reader, form.start, reader.position)
    if reader.naming or form.script or is_matrix:
        found = quantity(reader, form, name)
        if found is not None:
            return found
    marked = form.marked_key if form.key == name else name
    unsquared = marked.removesuffix("^2")
    own = next((one for one in (marked, unsquared) if one != name and one in vocabulary.defined), "")
    if own:
        meaning: Meaning | None = vocabulary.defined[own]
        powers = form.scripts.powers if own == unsquared else []
        form.dots, form.scripts = 0, Scripts(powers=powers, transposed=form.scripts.transposed)
    else:
        vocabulary.missed |= {marked, unsquared} - {name}
        meaning = vocabulary.symbol(name)
    if meaning is None and (name, form.dots) in vocabulary.derived:
        meaning, form.dots = Meaning(vocabulary.derived[name, form.dots]), 0
    if meaning is None and form.angle and form.base in ("c", "s", "C", "S"):
        vocabulary.missed.add(name)
        meaning = Meaning(short_function(reader, form))
    if meaning is None:
        meaning = _meaning(reader, form, name)
    if meaning is None:
        vocabulary.missed.add(name)
        other = None if reader.naming else zero_level(reader, form, name) or quantity(reader, form, name)
        if other is None:
            other = letter(reader, form, name)
        if other is not None:
            return other
        raise unknown(reader, form, name)
    if meaning.note:
        reader.notes.setdefault(meaning.note)
    if meaning.has_arguments:
        skip_arguments(reader)
    return _scripted(reader, form, meaning)


def _multiplies_rate(reader: Reader, form: Form) -> bool:
    """Whether a name in a torque stands alone before a velocity, or as the entry of a matrix: c_12 q̇₂."""
    quantity = reader.vocabulary.quantities.get(reader.owner)
    is_torque = quantity is not None and quantity.family in (families.TAU, families.FORCE)
    if not is_torque or form.key[:1] not in ("c", "C"):
        return False
    before = next((t for t in reversed(reader.tokens[: reader.position]) if t.end <= form.start), None)
    after = reader.peek() if reader.token.kind in ("*", "cdot") else reader.token
    meaning = reader.vocabulary.symbol(key(after.text)) if after.kind == "name" else None
    meant = meaning.value if meaning is not None else None
    is_rate = after.text == "dot" or after.dots == 1 or (isinstance(meant, Symbol) and meant.dots == 1)
    return (before is None or before.kind in _BEFORE_TERM) and (is_rate or after.kind in _BEHIND_ENTRY)


def _is_function_of_q(reader: Reader, name: str) -> bool:
    """Whether a letter is called with the coordinates, and so is no parameter: g(q), M(q_1, q_2)."""
    if reader.token.kind != "(":
        return False
    vocabulary, argument = reader.vocabulary, reader.peek(1).text
    is_letter = argument in vocabulary.letters and reader.peek(2).kind != "_"
    is_vector = (is_letter or vocabulary.is_vector(argument)) and vocabulary.symbol(argument) is None
    behind = reader.peek(4 if reader.peek(2).kind == "_" else 2)
    if not is_vector and behind.kind != ",":  # g(q_1, q_2)
        return False
    return bool(vocabulary.named(name)) and only_coordinates(reader, reader.position)


def stands_between_rates(reader: Reader, start: int, behind: int) -> bool:
    """Whether the letter at `start`, and before the token `behind`, is the matrix of q̇ᵀ M q̇, and no mass."""
    if reader.tokens[behind].text != "dot":
        return False
    beside = [t for t in reader.tokens[max(behind - 9, 0) : behind] if t.end <= start]
    before = [t.text for t in beside if t.kind not in "{}"]
    after = [t.text for t in reader.tokens[behind + 1 : behind + 4] if t.kind not in "{}"]
    is_row = before[-1:] in (["T"], ["top"], ["intercal"]) and reader.vocabulary.is_vector(before[-3:][0])
    return is_row and reader.vocabulary.is_vector(after[0]) and "_" not in after[:2]


def _called_index(reader: Reader, form: Form) -> str:
    """The index of q(2), as MATLAB writes an entry of q, and of D(1,2); nothing for other names."""
    if reader.token.kind != "(" or reader.peek(1).kind != "number":
        return ""
    if reader.naming and reader.peek(2).kind == ",":
        indices = [reader.peek(ahead) for ahead in range(1, 5)]
        entry = indices[0].text + indices[2].text
        if [t.kind for t in indices] != ["number", ",", "number", ")"]:
            return ""
        if not reader.vocabulary.named(form.key + entry):
            return ""
        reader.until(")", reader.take())
        return entry
    if reader.peek(2).kind != ")":
        return ""
    index = reader.peek(1).text
    if reader.naming and not form.index and reader.vocabulary.named(form.key + index):
        reader.until(")", reader.take())
        return index
    meaning = reader.vocabulary.symbol(form.key + index) if len(index) < 3 else None
    if form.index or meaning is None or reader.vocabulary.symbol(form.key) is not None:
        return ""
    if not isinstance(meaning.value, Symbol) or reader.vocabulary.coordinate(meaning.value) is None:
        return ""
    for _ in range(3):
        reader.take()
    reader.beside(form)
    return index


def _meaning(reader: Reader, form: Form, name: str) -> Meaning | None:
    """Other ways to write a symbol: s of an angle, the one inertia of that index, another case."""
    vocabulary = reader.vocabulary
    short = vocabulary.short_angle(name)
    if short is not None:
        return Meaning(short)
    if (several := SEVERAL.fullmatch(name)) and (angle := vocabulary.angle_of(several[1])):
        vocabulary.missed.add(name)
        return Meaning(angle, f"{form.text} is read as a sum of coordinates")
    if "inertia" in reader.options and (meaning := vocabulary.inertia(name)):
        return meaning
    is_answer = bool(vocabulary.named(name))
    if is_answer and (len(name) > 1 or name in vocabulary.own_entries):
        return None
    if vocabulary.is_vector(name) or is_running(form.index or form.base_index):
        return None
    body = _OWNER_BODY.search(reader.owner)
    if body and _MOMENT.fullmatch(name) and (meaning := vocabulary.similar(name + body.group())):
        return meaning
    meaning = vocabulary.similar(name)
    if meaning is not None and isinstance(meaning.value, Symbol) and key(meaning.value.name) != name:
        if reader.naming and key(meaning.value.name).lower() == name.lower():
            return None  # what a report defines is another name though it differs by its case alone
        vocabulary.missed.add(name)
        vocabulary.missed_entries |= {name} if is_answer else set()
    return meaning


def _scripted(reader: Reader, form: Form, meaning: Meaning) -> Value:
    """The meaning of a name with its dots, its mark and its powers."""
    value, scripts = meaning.value, form.scripts
    dots = form.dots + (scripts.primes if isinstance(value, Node) else 0)
    if dots:
        dotted = reader.vocabulary.derived.get((form.key, dots)) or rate(value, reader.vocabulary, dots)
        if dotted is None and reader.naming:
            raise unknown(reader, form, form.key)
        if dotted is None and form.key in reader.vocabulary.defined and isinstance(value, Node) and dots == 1:
            dotted = derivative(value, by_time(reader.vocabulary))
        if dotted is None and form.key in reader.vocabulary.defined:
            reader.names_used += 1
            return Abstract(f"the derivative of {form.text} is not written out")
        if dotted is None:
            message = f"{form.text} has no derivative here"
            help = "velocities and accelerations are those of the coordinates"
            raise ReadError(message, form.start, max(form.end - form.start, 1), help)
        value = dotted
        scripts.primes = 0
    _note_use(reader, value)
    if isinstance(value, Symbol) and reader.vocabulary.coordinate(value):
        skip_time(reader)
        if reader.token.kind in ("'", "''", "^", "raised", "."):
            value_scripts = reader.scripted(value)
            if value_scripts is not value:
                scripts = form.scripts
                value = value_scripts
    if form.repaired:
        reader.notes.setdefault("a power under a dot is read as the power of the derivative")
    return reader.with_scripts(value, scripts, form.start)


def _note_use(reader: Reader, value: Value) -> None:
    if isinstance(value, Symbol):
        reader.symbols.setdefault(value.name)
    elif isinstance(value, Grid) and value.is_rates >= 0:
        reader.names_used += 1
    else:
        reader.symbols.setdefault("")


def skip_time(reader: Reader) -> None:
    """Leave out the `(t)` of q1(t)."""
    if reader.token.kind not in ("(", "[", "{"):
        return
    ahead = [reader.peek(place) for place in range(5)]
    signs = [token.text if token.kind == "name" else token.kind for token in ahead]
    pattern = next((one for one in ("(t)", "[t]", "{(t)}") if signs[: len(one)] == list(one)), "")
    for _ in pattern:
        reader.take()


@lru_cache(maxsize=4096)
def _closest(name: str, known: tuple[str, ...]) -> str:
    """The known name that was most likely meant; a hand-in has a name of its own many times."""
    return next(iter(get_close_matches(name, known, 1, 0.6)), "")


def unknown(reader: Reader, form: Form, name: str) -> UnknownName:
    """The error about a name, which says what names there are."""
    vocabulary = reader.vocabulary
    if not reader.naming:
        vocabulary.missed.add(name + "'" * form.dots)
    family = vocabulary.family(name)
    known = [symbol.name for symbol in vocabulary.symbols.values()]
    reason = vocabulary.broken.get(name)
    if reason:
        help = f"its definition could not be read: {reason}"
    elif close := _closest(name, tuple(known)):
        help = f"did you mean {close}? The problem's symbols are {', '.join(known[:30])}"
    else:
        help = f"the problem's symbols are {', '.join(known[:30])}"
    return UnknownName(form, help, family)
