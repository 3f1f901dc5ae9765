"""Keeping a name of the student's own, with all that follows from it: rates, sine and cosine."""

from __future__ import annotations

from dynsolve.answers.reading.grammar.rates import rate
from dynsolve.answers.reading.grids import Value
from dynsolve.answers.reading.vocabulary import Meaning, Vocabulary, spellings
from dynsolve.notation.names import split
from dynsolve.notation.tree import Node, Symbol


def keep_symbol(vocabulary: Vocabulary, name: str, dots: int, value: Value, in_passing: bool = False) -> None:
    """A name for a coordinate is one for its derivatives, and for its sine and cosine too.

    One that a report defines `in_passing`, in the problem's coordinates, leaves s_2 the sine of theirs.
    """
    if dots:
        vocabulary.derive(name, dots, value)
        return
    aliases = {spelling for spelling, _ in spellings(name) if spelling in vocabulary.others}
    vocabulary.define(name, Meaning(value))
    rates: dict[int, Value] = {}
    for order in (1, 2):
        found = rate(value, vocabulary, order)
        if found is not None:
            rates[order] = found
    for spelling, order in spellings(name):
        known = spelling in vocabulary.symbols or spelling in vocabulary.defined
        if order in rates and (not known or spelling in aliases):
            vocabulary.define(spelling, Meaning(rates[order]))
    index = "".join(split(name)[1])
    if rates and not in_passing and index.isdigit() and isinstance(value, Node):
        vocabulary.turn(index, value)


def gives_new_meaning(vocabulary: Vocabulary, name: str, value: Value) -> bool:
    r"""Whether `\theta_2 = q_1 + q_2` gives another meaning to what would be read as a coordinate."""
    if vocabulary.is_vector(name) and name not in vocabulary.symbols:  # θ is q₂ alone, and no column
        return isinstance(value, Node) and rate(value, vocabulary, 1) is not None
    usual = vocabulary.others.get(name)
    if usual is None or usual.dots or vocabulary.coordinate(usual) is None or value == usual:
        return False
    return (
        isinstance(value, Node) and not isinstance(value, Symbol) and rate(value, vocabulary, 1) is not None
    )
