"""Coordinates that a student counts the other way, or from elsewhere: `symbols: {t2: pi/2 - theta2}`.

What belongs to such a coordinate turns with it: its torque, rows of D, columns of a Jacobian.
An answer is in the student's own coordinates, unless it plainly uses the problem's: the
coordinate's own name stands in it.  It is right in these or in those, never in either,
so that no wrong sign is accepted.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from dynsolve.answers.submission import Answer
from dynsolve.notation.tree import Negative, Node, Number, Product, Quotient, Sum, Symbol
from dynsolve.notation.walk import children, walk


def with_own_coordinates(
    answers: Sequence[Answer], meanings: Sequence[Node], coordinates: Sequence[str]
) -> Iterator[Answer]:
    """The answers, each with the coordinates that are counted the other way in it.

    `meanings` are what the student's own names for coordinates stand for.
    """
    senses: dict[str, set[int]] = {}
    for meaning in meanings:
        names = {part.name for part in walk(meaning) if isinstance(part, Symbol)} & set(coordinates)
        if len(names) == 1:  # θ₂ - θ₁ is another coordinate, no other sense of one
            senses.setdefault(name := names.pop(), set()).add(_sense(meaning, name))
    turned = {name: found for name, found in senses.items() if -1 in found}
    for answer in answers:
        here = tuple(name for name, found in turned.items() if _is_turned(answer.node, name, 1 in found))
        yield replace(answer, turned=here) if here else answer


def _is_turned(node: Node | None, name: str, has_both: bool) -> bool:
    """Whether an answer is written in the turned coordinate.

    It is not where the coordinate stands in it without a minus, which the name of the turned one never
    leaves; where it does not stand in it at all, the student has no other name for it.
    """
    signs = set(_signs(node, name)) if node is not None else set()
    return signs == {-1} or (not signs and not has_both)


def _signs(node: Node, name: str, sign: int = 1) -> Iterator[int]:
    """-1 for a coordinate, or its rate, with a minus before it, 1 for one without."""
    if isinstance(node, Symbol) and node.name == name:
        yield sign
    for child in children(node):
        yield from _signs(child, name, -1 if isinstance(node, Negative) else 1)


def _sense(meaning: Node, name: str) -> int:
    """1 or -1 for ± a coordinate plus a constant, 0 for what is none of that coordinate."""
    match meaning:
        case Symbol(found, 0):
            return int(found == name)
        case Negative(argument):
            return -_sense(argument, name)
        case Sum(terms):
            used = [sense for term in terms if (sense := _sense(term, name))]
            return used[0] if len(used) == 1 else 0
        case Product((Negative(Number(1, 1)), factor)):
            return -_sense(factor, name)
        case Quotient(numerator, Number(1, 1)):
            return _sense(numerator, name)
    return 0
