"""The student's own names: `symbols: {q1: theta1 - 90deg}` and `let: {h: m2*l1*lc2*sin(q2)}`."""

from __future__ import annotations

from dynsolve.answers.reading.displays import Display
from dynsolve.answers.reading.equation_reader import EquationReader
from dynsolve.answers.reading.grammar.rates import rate
from dynsolve.answers.reading.grids import Abstract, Value
from dynsolve.answers.reading.prepare import prepared
from dynsolve.answers.reading.right_side import RightSide, read_right_side
from dynsolve.answers.reading.vocabulary import Meaning, spellings
from dynsolve.errors import ReadError
from dynsolve.notation.names import split
from dynsolve.notation.tree import Node
from dynsolve.quantities.spelling import key


def own_symbols(reader: EquationReader, display: Display, name: str, is_symbol: bool) -> ReadError | None:
    """Keep one of the student's names; the error where its meaning cannot be read."""
    try:
        shown = prepared(name)[:-1]
        plain = key("".join(t.text for t in shown if t.kind in ("name", "letter", "number")))
        dots = sum(t.dots + (t.text == "dot") + 2 * (t.text == "ddot") for t in shown)
        tokens = prepared(display.text, reader.macros)[:-1]
    except ReadError as error:
        reader.vocabulary.broken[key(name)] = error.message
        return error
    found = read_right_side(reader.vocabulary, tokens)
    if isinstance(found, ReadError):
        reader.vocabulary.broken[plain] = found.message
        return found
    if isinstance(found.value, Abstract):
        return ReadError(found.value.why, 0, 1, "write it in the symbols of the problem")
    if not plain:
        return ReadError("this is no name", 0, 1, "a name is a letter with an index: q1")
    if is_symbol:
        _keep(reader, plain, dots, found)
    else:
        reader.vocabulary.define(plain, Meaning(found.value))
    return None


def _keep(reader: EquationReader, name: str, dots: int, found: RightSide) -> None:
    """A name for a coordinate is one for its derivatives, and for its sine and cosine too."""
    vocabulary = reader.vocabulary
    if dots:
        vocabulary.derive(name, dots, found.value)
        return
    vocabulary.define(name, Meaning(found.value))
    rates: dict[int, Value] = {}
    for order in (1, 2):
        value = rate(found.value, vocabulary, order)
        if value is not None:
            rates[order] = value
    for spelling, order in spellings(name):
        known = spelling in vocabulary.symbols or spelling in vocabulary.defined
        if order in rates and not known:
            vocabulary.define(spelling, Meaning(rates[order]))
    index = "".join(split(name)[1])
    if rates and index.isdigit() and isinstance(found.value, Node):
        vocabulary.turn(index, found.value)
