"""Names of answers inside a value: each is kept as a reference, or as the matrix of those to its entries."""

from __future__ import annotations

from dynsolve.answers.reading.grammar.forms import Form
from dynsolve.answers.reading.grammar.reader import Reader
from dynsolve.answers.reading.grids import Grid, Value, negative
from dynsolve.answers.reading.vocabulary import Vocabulary
from dynsolve.notation.tree import (
    Negative,
    Reference,
    Symbol,
)
from dynsolve.quantities import families, recursion_families
from dynsolve.quantities.family import Owner
from dynsolve.quantities.index import Quantities
from dynsolve.quantities.model_families import REFERENCE
from dynsolve.quantities.spelling import key

OWN_LETTERS = frozenset({"h", "c"})
"""Letters that name an answer on the left alone: on the right the student's own, but for a last guess."""


def quantity(reader: Reader, form: Form, name: str) -> Value | None:
    """The answer that a name stands for, as placeholders; None where it is none."""
    vocabulary = reader.vocabulary
    names = vocabulary.named(name)
    if name in OWN_LETTERS and not reader.naming and "vectors" not in reader.options:
        return None
    if name == "tau" and "driving" in reader.options and reader.owner in families.HOLD_FORCES:
        names = (vocabulary.driving_force(name) or name,)
    if form.script and name.startswith("I"):
        names = tuple(n for n in names if vocabulary.quantities[n].family is families.I)
    if form.dots:
        if name.startswith("rc") and form.dots == 1:
            names = vocabulary.named("v" + name[2:])
        else:
            names = vocabulary.named(name + "d" * form.dots + "ot")
            if not names:
                return None
    if len(names) > 1 and not reader.naming and _has_rates(reader):
        names = tuple(n for n in names if vocabulary.shape(n) is not None) or names
    if names == ("Y",) and REFERENCE in vocabulary.quantities and _has_references(reader):
        names = (REFERENCE,)
    names, framed = _framed(vocabulary.quantities, form, names)
    if not names:
        return None
    skip_arguments(reader)
    reader.names_used += 1
    reader.candidates = names
    reader.references.setdefault(names[0])
    value = placeholder(vocabulary, names[0])
    scripts = form.scripts
    if framed:
        scripts.powers = scripts.powers[1:]
    return reader.with_scripts(value, scripts, form.start)


def _framed(quantities: Quantities, form: Form, names: tuple[str, ...]) -> tuple[tuple[str, ...], bool]:
    """The quantity in view of the frame that stands as its exponent: H_1^0, H_2^1."""
    powers = form.scripts.powers
    in_link = tuple(n for n in names if quantities[n].family in recursion_families.FAMILIES)
    if in_link and not powers and form.key not in quantities:
        return tuple(dict.fromkeys((*in_link, *names))), False
    if not powers or not names:
        return names, False
    first, frame = quantities[names[0]], powers[0]
    if in_link and frame == quantities[in_link[0]].index[0]:
        return in_link, True
    if first.family in recursion_families.FAMILIES:  # in another frame than the recursions have it in
        return (), True
    if first.family is families.FORCE and frame == first.index[0]:  # Craig's F_i: the inertia force of a link
        return (), True
    if first.family.owner is Owner.ROW and frame.denominator == 1 and frame >= 0:
        i = first.index[0]
        if frame == 0 and (first.family is families.H or i == 1):
            return names, True
        if frame == i - 1:
            return (f"A{i}",), True
        return (f"H{i}",) if frame == 0 else (), True
    if frame == 0:
        if first.family is families.I_BODY:
            return tuple(n for n in names if quantities[n].family is not families.I_BODY) or names, True
        return names, True
    if first.family is families.I_BODY and frame == 1:
        return names[:1], True
    return names, False


def _has_rates(reader: Reader) -> bool:
    r"""Whether velocities stand among the arguments here: V(q, \dot q) is no potential energy."""
    if reader.token.kind != "(" or not only_coordinates(reader, reader.position):
        return False
    for token in reader.tokens[reader.position :]:
        if token.kind == ")":
            return False
        if token.kind == "'" or token.dots or token.text == "dot" or token.text in ("qdot", "dq", "qd"):
            return True
    return False


def _has_references(reader: Reader) -> bool:
    r"""Whether reference rates stand among the arguments here: Y(q, \dot q, \dot q_r, \ddot q_r)."""
    if reader.token.kind != "(" or not only_coordinates(reader, reader.position):
        return False
    end = next(i for i in range(reader.position, len(reader.tokens)) if reader.tokens[i].kind == ")")
    return any(token.text.rstrip("}").endswith("r") for token in reader.tokens[reader.position : end])


def placeholder(vocabulary: Vocabulary, name: str) -> Value:
    """What stands for an answer: a reference to it, or the matrix of those to its entries."""
    shape = vocabulary.shape(name)
    if shape is None or (shape == (1, 1) and vocabulary.are_multipliers([name])):
        return Reference(name)
    rows, columns = shape
    return Grid(
        tuple(tuple(Reference(name, i, j) for j in range(1, columns + 1)) for i in range(1, rows + 1)),
        quantity=name,
    )


def whole_of(vocabulary: Vocabulary, value: Grid) -> tuple[str, ...]:
    """The matrix whose entries are all names: [tau_1; f_2] is tau."""
    quantities = vocabulary.quantities
    written = [str(entry) if isinstance(entry, Reference) else "" for row in value.rows for entry in row]
    whole = quantities.get(quantities.entry_of(written[0])[0]) if written else None
    if whole is None or whole.shape != value.shape or quantities.parts(whole.name) != tuple(written):
        return ()
    return (whole.name,)


def vectors_for_letters(reader: Reader, terms: list[Value]) -> list[Value]:
    """Terms in which a bare letter beside matrices is the vector of that name: the g of D q̈ + C q̇ + g.

    Beside a matrix no scalar can stand, so it is not the acceleration of gravity.
    """
    shape = next((term.shape for term in terms if isinstance(term, Grid)), None)
    return terms if shape is None else [_vector(reader, term, shape) for term in terms]


def _vector(reader: Reader, term: Value, shape: tuple[int, int]) -> Value:
    letter = term.argument if isinstance(term, Negative) else term
    if not isinstance(letter, Symbol):
        return term
    vocabulary = reader.vocabulary
    name = next((n for n in vocabulary.named(key(letter.name)) if vocabulary.shape(n) == shape), "")
    if not name:
        return term
    reader.names_used += 1
    reader.symbols.pop(letter.name, None)
    reader.references.setdefault(name)
    found = placeholder(vocabulary, name)
    return negative(found) if isinstance(term, Negative) else found


def skip_arguments(reader: Reader) -> None:
    """Leave out the arguments of D(q) and C(q, q_dot)."""
    if reader.token.kind == "(" and only_coordinates(reader, reader.position):
        opening = reader.take()
        reader.until(")", opening)


def only_coordinates(reader: Reader, position: int) -> bool:
    """Whether the parenthesis there holds coordinates and commas alone: no factor, nor the 0 of M(q_1, 0)."""
    vocabulary = reader.vocabulary
    found = False
    before = "("
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
                or (name in vocabulary.letters and meaning is None)
                or name in ("t", "qdot", "dq", "qd", "theta", "L", "d", "qr", "r")
            ):
                return False
            found = True
        elif not (
            kind in (",", "_", "number", "{", "}", "^", "*", "'") or token.text in ("dot", "ddot", "star")
        ) or (kind == "number" and before in ("(", ",")):
            return False
        before = kind
    return False
