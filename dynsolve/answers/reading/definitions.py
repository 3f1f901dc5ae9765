"""The student's own names: `symbols: {q1: theta1 - 90deg}` and `let: {h: m2*l1*lc2*sin(q2)}`."""

from __future__ import annotations

from dynsolve.answers.reading.displays import Display
from dynsolve.answers.reading.equation_reader import EquationReader
from dynsolve.answers.reading.grids import Abstract
from dynsolve.answers.reading.own_names import keep_symbol
from dynsolve.answers.reading.right_side import read_right_side
from dynsolve.answers.reading.tokens.prepare import prepared
from dynsolve.answers.reading.vocabulary import Meaning
from dynsolve.errors import ReadError
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
        if not dots and isinstance(found.value, Node):
            reader.coordinates.append(found.value)
        keep_symbol(reader.vocabulary, plain, dots, found.value)
    else:
        reader.vocabulary.define(plain, Meaning(found.value))
    return None
