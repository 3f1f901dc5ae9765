"""What a name means: a symbol of the problem, the student's own, an answer, or a letter of the derivation."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from dynsolve.answers.reading.forms import Form
from dynsolve.answers.reading.grids import Abstract, Grid, Value
from dynsolve.answers.reading.vocabulary import Meaning, Vocabulary, is_running, key
from dynsolve.errors import ReadError
from dynsolve.notation.tree import (
    ZERO,
    Degrees,
    Function,
    Negative,
    Node,
    Number,
    Product,
    Quotient,
    Reference,
    Sum,
    Symbol,
)
from dynsolve.robot.model import JointType

if TYPE_CHECKING:
    from dynsolve.answers.reading.reader import Reader

_FREE = frozenset("h0 H0 z0 y0 h href hzero hb P0h zref".split())
# Letters that name an answer on the left alone: on the right they are the student's own.
_OWN = frozenset({"h", "c"})

_POTENTIAL = re.compile(r"P.*|L")
_LETTERS = re.compile(r"(?:z|o|R|r|p|x|y|e|n|a|u|s)(?:[0-9a-z]*|[xyz]theta[0-9]*|[xyz],?[qt].*)")
_OWNER_BODY = re.compile(r"[0-9]+$")
_MOMENT = re.compile(r"[IJ][xyz]{1,2}")
_HEIGHT = re.compile(r"h[1-9a-z][0-9]*")


class UnknownName(ReadError):
    """A name that means nothing here; `family` are the answers of the kind it would be one of."""

    def __init__(self, form: Form, help: str, family: tuple[str, ...] = ()) -> None:
        super().__init__(
            f"unknown symbol `{form.text[:60]}`", form.start, max(form.end - form.start, 1), help
        )
        self.form, self.family = form, family


def value_of(reader: Reader, form: Form) -> Value:
    """The value of a name with its scripts; raises UnknownName for one that has none."""
    vocabulary = reader.vocabulary
    name = form.key + _called_index(reader, form)
    if reader.naming or form.script:
        found = _quantity(reader, form, name)
        if found is not None:
            return found
    meaning = vocabulary.defined.get(name + "'" * form.dots) if form.dots else None
    if meaning is not None:
        form.dots = 0
    else:
        meaning = vocabulary.symbol(name)
    if meaning is None and (name, form.dots) in vocabulary.derived:
        meaning, form.dots = Meaning(vocabulary.derived[name, form.dots]), 0
    if meaning is None and form.angle and form.base in ("c", "s", "C", "S"):
        meaning = Meaning(_short(reader, form))
    if meaning is None:
        meaning = _meaning(reader, form, name)
    if meaning is None:
        other = None if reader.naming else _quantity(reader, form, name)
        if other is None:
            other = _letter(reader, form, name)
        if other is not None:
            return other
        raise _unknown(reader, form, name)
    if meaning.note:
        reader.notes.setdefault(meaning.note)
    return _scripted(reader, form, meaning)


def _called_index(reader: Reader, form: Form) -> str:
    """The index of q(2), as MATLAB writes an entry of the vector q; nothing for every other name."""
    if reader.token.kind != "(" or reader.peek(1).kind != "number" or reader.peek(2).kind != ")":
        return ""
    index = reader.peek(1).text
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
    if form.base in ("q", "theta") and len(form.index) > 1 and (angle := vocabulary.angle_of(form.index)):
        return Meaning(angle, f"{form.text} is read as a sum of coordinates")
    if "inertia" in reader.options and (meaning := vocabulary.inertia(name)):
        return meaning
    if name in vocabulary.quantities and len(name) > 1:
        return None
    if vocabulary.is_vector(name) or is_running(form.index or _index(form.base)):
        return None
    body = _OWNER_BODY.search(reader.owner)
    if body and _MOMENT.fullmatch(name) and (meaning := vocabulary.similar(name + body.group())):
        return meaning
    return vocabulary.similar(name)


def _scripted(reader: Reader, form: Form, meaning: Meaning) -> Value:
    """The meaning of a name with its dots, its mark and its powers."""
    value, scripts = meaning.value, form.scripts
    dots = form.dots + (scripts.primes if isinstance(value, Node) else 0)
    if dots:
        dotted = vocabulary_rate(reader, form, dots) or rate(value, reader.vocabulary, dots)
        if dotted is None and reader.naming:
            raise _unknown(reader, form, form.key)
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


def vocabulary_rate(reader: Reader, form: Form, dots: int) -> Value | None:
    """A derivative that the student defined on its own."""
    return reader.vocabulary.derived.get((form.key, dots))


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
    kinds = []
    for ahead in range(5):
        token = reader.peek(ahead)
        kinds.append(token.text if token.kind == "name" else token.kind)
    for pattern in (["(", "t", ")"], ["[", "t", "]"], ["{", "(", "t", ")", "}"]):
        if kinds[: len(pattern)] == pattern:
            for _ in pattern:
                reader.take()
            return


def _short(reader: Reader, form: Form) -> Function:
    """C_{theta_1}, s_{q_1 + q_2}, c_{1-2}: the sine or cosine of the angle in the index."""
    angle: Value | None = _digits_angle(reader.vocabulary, form)
    if angle is None:
        angle = reader.inner(form.angle, naming=False)
    if not isinstance(angle, Node):
        raise ReadError(
            "this index is no angle",
            form.start,
            form.end - form.start,
            "write c_1, c_{12} or \\cos(\\theta_1)",
        )
    return Function("sin" if form.base in "sS" else "cos", angle)


def _digits_angle(vocabulary: Vocabulary, form: Form) -> Node | None:
    """The angle of an index such as 1+2 or 2-1."""
    if not all(t.kind in ("number", "+", "-") for t in form.angle):
        return None
    terms: list[Node] = []
    sign = "+"
    for token in form.angle:
        if token.kind != "number":
            sign = token.kind
            continue
        part = vocabulary.angle_of(token.text)
        if part is None:
            return None
        terms.append(Negative(part) if sign == "-" else part)
    if not terms:
        return None
    return terms[0] if len(terms) == 1 else Sum(tuple(terms))


def is_short_function(reader: Reader) -> bool:
    r"""Whether a bare c or s here is a cosine or a sine: `c\theta_1`, `s(q_1 + q_2)`."""
    token, after = reader.token, reader.peek()
    if token.kind != "name" or token.text not in ("c", "s", "C", "S") or token.dots:
        return False
    if reader.vocabulary.symbol(token.text) is not None or reader.naming:
        return False
    if after.kind == "(":
        if reader.peek(2).kind == "number" and reader.peek(3).kind == ")":
            return False
        return token.text in "cs" or not _only_coordinates(reader, reader.position + 1)
    if after.kind == "letter":
        return after.text in ("theta", "phi", "alpha", "beta", "psi", "gamma")
    if after.kind != "name" or after.dots:
        return False
    meaning = reader.vocabulary.symbol(key(after.text))
    q = reader.vocabulary.coordinate(meaning.value) if meaning and isinstance(meaning.value, Symbol) else None
    return q is not None and q.type is JointType.REVOLUTE


# Quantities


def _quantity(reader: Reader, form: Form, name: str) -> Value | None:
    """The answer that a name stands for, as placeholders; None where it is none."""
    vocabulary = reader.vocabulary
    names = vocabulary.quantities.get(name, ())
    if name in _OWN and not reader.naming:
        return None
    if form.script and name.startswith("I"):
        names = tuple(n for n in names if n.startswith("I") and not n.startswith("I_body"))
    if form.dots:
        if name.startswith("rc") and form.dots == 1:
            names = vocabulary.quantities.get("v" + name[2:], ())
        else:
            return None
    names, framed = _framed(form, names)
    if not names:
        return None
    _skip_arguments(reader)
    reader.names_used += 1
    reader.candidates = names
    reader.references.setdefault(names[0])
    value = placeholder(vocabulary, names[0])
    scripts = form.scripts
    if framed:
        scripts.powers = scripts.powers[1:]
    return reader.with_scripts(value, scripts, form.start)


def _framed(form: Form, names: tuple[str, ...]) -> tuple[tuple[str, ...], bool]:
    """The quantity in view of the frame that stands as its exponent: H_1^0, H_2^1."""
    powers = form.scripts.powers
    if not powers or not names:
        return names, False
    first, frame = names[0], powers[0]
    if first[0] in "HA" and first[1:].isdigit() and frame.denominator == 1 and frame >= 0:
        i = int(first[1:])
        if frame == 0 and (first[0] == "H" or i == 1):
            return names, True
        if frame == i - 1:
            return (f"A{i}",), True
        return (f"H{i}",) if frame == 0 else (), True
    if frame == 0:
        if first.startswith("I_body"):
            return tuple(n for n in names if not n.startswith("I_body")) or names, True
        return names, True
    if first.startswith("I") and frame == 1 and "I_body" in first:
        return names[:1], True
    return names, False


def placeholder(vocabulary: Vocabulary, name: str) -> Value:
    """What stands for an answer: a reference to it, or the matrix of those to its entries."""
    shape = vocabulary.shapes.get(name)
    if shape is None:
        return Reference(name)
    rows, columns = shape
    return Grid(
        tuple(tuple(Reference(name, i, j) for j in range(1, columns + 1)) for i in range(1, rows + 1)),
        quantity=name,
    )


def _skip_arguments(reader: Reader) -> None:
    """Leave out the arguments of D(q) and C(q, q_dot)."""
    if reader.token.kind == "(" and _only_coordinates(reader, reader.position):
        opening = reader.take()
        reader.until(")", opening)


def _only_coordinates(reader: Reader, position: int) -> bool:
    """Whether the parenthesis there holds coordinates and commas alone: no factor."""
    vocabulary = reader.vocabulary
    found = False
    for token in reader.tokens[position + 1 : position + 60]:
        kind = token.kind
        if kind == ")":
            return found
        if kind in ("name", "letter"):
            name = key(token.text)
            meaning = vocabulary.symbol(name)
            is_coordinate = (
                isinstance(meaning.value, Symbol) and vocabulary.coordinate(meaning.value)
                if meaning
                else None
            )
            if not (
                is_coordinate
                or vocabulary.is_vector(name)
                or name in ("t", "qdot", "dq", "qd", "theta", "L", "d")
            ):
                return False
            found = True
        elif not (
            kind in (",", "_", "number", "{", "}", "^", "*", "'") or token.text in ("dot", "ddot", "star")
        ):
            return False
    return False


# Letters of the derivation


def _letter(reader: Reader, form: Form, name: str) -> Value | None:
    """The vector of coordinates, a running index, z_0, o_2, R_1, a zero level of height."""
    vocabulary = reader.vocabulary
    if vocabulary.is_vector(name) and form.dots <= 2:
        _skip_arguments(reader)
        reader.names_used += 1
        value: Value = vocabulary.velocities(form.dots + form.scripts.primes)
        form.scripts.primes = 0
        return reader.with_scripts(value, form.scripts, form.start)
    spelled = {"qdot": 1, "dq": 1, "qd": 1, "qddot": 2, "ddq": 2, "qdd": 2}.get(name)
    if spelled and not form.dots:
        reader.names_used += 1
        return reader.with_scripts(vocabulary.velocities(spelled), form.scripts, form.start)
    index = form.index or _index(form.base)
    if index and is_running(index):
        reader.names_used += 1
        return Abstract(f"{form.text} has a running index")
    if name in _FREE and _POTENTIAL.fullmatch(reader.owner):
        reader.free.setdefault(name)
        return reader.with_scripts(Symbol(name), form.scripts, form.start)
    if (
        form.base[:1].isalpha()
        and _LETTERS.fullmatch(name)
        and not reader.naming
        and len(form.base.split("_")[0]) <= 2
    ):
        reader.names_used += 1
        return Abstract(f"{form.text} is a letter of the derivation")
    if _HEIGHT.fullmatch(name) and _POTENTIAL.fullmatch(reader.owner):
        reader.names_used += 1
        return Abstract(f"{form.text} is a height")
    if (
        name in ("Jv", "Jw", "Kv", "Kw", "Jomega", "Komega", "I", "omega", "v", "A", "H", "R")
        and not reader.naming
    ):
        reader.names_used += 1
        return Abstract(f"{form.text} has no index")
    return None


def _index(base: str) -> str:
    """The index of a name that is written in one piece: P_i."""
    return base.partition("_")[2]


def _unknown(reader: Reader, form: Form, name: str) -> UnknownName:
    """The error about a name, which says what names there are."""
    from difflib import get_close_matches

    vocabulary = reader.vocabulary
    family = vocabulary.family(name)
    known = [symbol.name for symbol in vocabulary.symbols.values()]
    reason = vocabulary.broken.get(name)
    if reason:
        help = f"its definition could not be read: {reason}"
    elif close := get_close_matches(name, known, 1, 0.6):
        help = f"did you mean {close[0]}? The problem's symbols are {', '.join(known[:30])}"
    else:
        help = f"the problem's symbols are {', '.join(known[:30])}"
    return UnknownName(form, help, family)


# Derivatives with respect to time


def rate(value: Value, vocabulary: Vocabulary, dots: int) -> Value | None:
    """The time derivative of what is linear in coordinates; None for everything else."""
    if isinstance(value, Abstract):
        return value
    if isinstance(value, Grid):
        if value.is_rates >= 0 and value.is_rates + dots <= 2:
            return vocabulary.velocities(value.is_rates + dots)
        return None
    found: Node | None = value
    for _ in range(dots):
        found = _rate(found, vocabulary) if found is not None else None
    return found


def _rate(node: Node, vocabulary: Vocabulary) -> Node | None:
    match node:
        case Number() | Degrees():
            return ZERO
        case Symbol(name, dots):
            if vocabulary.coordinate(node) is None:
                return None
            return Symbol(name, dots + 1) if dots < 2 else None
        case Negative(argument):
            inner = _rate(argument, vocabulary)
            return None if inner is None else Negative(inner)
        case Sum(terms):
            rates = [_rate_of_term(term, vocabulary) for term in terms]
            kept = [r for r in rates if r is not None and r != ZERO]
            if any(r is None for r in rates) or not kept:
                return None
            return kept[0] if len(kept) == 1 else Sum(tuple(kept))
    return None


def _rate_of_term(node: Node, vocabulary: Vocabulary) -> Node | None:
    """That of a term of a sum: a constant has none."""
    if _is_constant(node, vocabulary):
        return ZERO
    return _rate(node, vocabulary)


def _is_constant(node: Node, vocabulary: Vocabulary) -> bool:
    match node:
        case Number() | Degrees():
            return True
        case Symbol():
            return vocabulary.coordinate(node) is None
        case Negative(argument):
            return _is_constant(argument, vocabulary)
        case Product(parts) | Sum(parts):
            return all(_is_constant(part, vocabulary) for part in parts[:20]) and len(parts) <= 20
        case Quotient(p, q):
            return _is_constant(p, vocabulary) and _is_constant(q, vocabulary)
    return False
