"""The symbols, angles, roots and denominators that a ring needs for given formulas."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields
from fractions import Fraction
from typing import Self

from dynsolve.algebra.angles import Angle, angle_from_tree, names_of
from dynsolve.algebra.rationals import rational_value
from dynsolve.errors import AlgebraError
from dynsolve.notation.tree import Degrees, Function, Negative, Node, Power, Quotient, Symbol
from dynsolve.notation.walk import children


@dataclass(frozen=True, slots=True)
class Contents:
    """What occurs in some formulas, each once, in order of first appearance.

    `angles` are those whose sine or cosine occurs, `radicands` the numbers under a root,
    `roots` the formulas under one (an inner root before the outer), `denominators` those
    that are no numbers, `functions` those whose argument is no angle and no radicand: each
    is a generator of its own.
    """

    symbols: tuple[str, ...] = ()
    angles: tuple[Angle, ...] = ()
    radicands: tuple[Fraction, ...] = ()
    roots: tuple[Node, ...] = ()
    denominators: tuple[Node, ...] = ()
    functions: tuple[Function, ...] = ()

    def __bool__(self) -> bool:
        """Whether there is anything in it."""
        return any(getattr(self, f.name) for f in fields(self))

    def joined(self, other: Self) -> Self:
        """The union of two contents."""
        pairs = ((f.name, getattr(self, f.name), getattr(other, f.name)) for f in fields(self))
        return type(self)(**{name: tuple(dict.fromkeys((*a, *b))) for name, a, b in pairs})


class ContentsCollector:
    """Walks trees and notes what they hold; a subclass may leave out what is known, or take more."""

    def __init__(self) -> None:
        self.symbols: dict[str, None] = {}
        self.angles: dict[Angle, None] = {}
        self.radicands: dict[Fraction, None] = {}
        self.roots: dict[Node, None] = {}
        self.denominators: dict[Node, None] = {}
        self.functions: dict[Function, None] = {}

    def collect(self, trees: Iterable[Node]) -> None:
        """Note the contents of trees.  Raises AlgebraError for a formula that no ring can hold."""
        waiting = [*trees][::-1]
        while waiting:
            waiting.extend(reversed(self.note(waiting.pop())))

    @property
    def contents(self) -> Contents:
        """The contents noted so far."""
        return Contents(
            tuple(self.symbols),
            tuple(self.angles),
            tuple(self.radicands),
            tuple(self.roots),
            tuple(self.denominators),
            tuple(self.functions),
        )

    def note(self, node: Node) -> Sequence[Node]:
        """Note one node, and return the parts that are still to be walked."""
        match node:
            case Symbol(name, dots):
                self.symbol(name, dots)
                return ()
            case Degrees():
                self.symbols.setdefault("pi")
                return ()
            case Quotient(numerator, denominator):
                if rational_value(denominator) is None:
                    self.denominators.setdefault(denominator)
                return numerator, denominator
            case Power(base, exponent):
                if isinstance(exponent, Negative) and rational_value(base) is None:
                    self.denominators.setdefault(base)
                return (base,)
            case Function("sqrt", argument):
                self.root(node, argument)
                return ()
            case Function():
                return self.function(node)
        return children(node)

    def symbol(self, name: str, dots: int) -> None:
        """Note a symbol; the derivatives of coordinates come with them."""
        if not dots:
            self.symbols.setdefault(name)

    def function(self, node: Function) -> Sequence[Node]:
        """Note a function of an angle, and return the parts that are still to be walked."""
        if node.name == "sgn":
            self.functions.setdefault(node)
            return ()
        self.angle(angle_from_tree(node.argument))
        if node.name == "tan":
            self.denominators.setdefault(Function("cos", node.argument))
        return ()

    def angle(self, angle: Angle) -> None:
        """Note an angle with the names in it."""
        self.angles.setdefault(angle)
        for name in names_of(angle):
            self.symbols.setdefault(name)

    def root(self, node: Function, argument: Node) -> None:
        """Note a root, after those inside it."""
        value = rational_value(argument)
        if value is None:
            self.collect([argument])
            self.roots.setdefault(argument)
        elif value < 0:
            raise AlgebraError("the root of a negative number", "lengths and masses are real")
        else:
            self.radicands.setdefault(value)
