"""What an answer brings that the problem's ring does not hold: names, angles, roots, denominators."""

from __future__ import annotations

from collections.abc import Container, Iterable
from dataclasses import dataclass
from fractions import Fraction
from hashlib import sha256

from dynsolve.algebra.angles import Angle, angle_from_tree, names_of
from dynsolve.algebra.ring import Ring
from dynsolve.algebra.ring_plan import rational_value
from dynsolve.errors import AlgebraError
from dynsolve.notation import tree
from dynsolve.notation.bounded import keep
from dynsolve.notation.tree import Degrees, Function, Node, Number, Symbol
from dynsolve.notation.walk import children


@dataclass(frozen=True, slots=True)
class Needs:
    """What one tree brings beside the symbols of the problem."""

    symbols: tuple[str, ...] = ()
    angles: tuple[Angle, ...] = ()
    radicands: tuple[Fraction, ...] = ()
    roots: tuple[Node, ...] = ()
    denominators: int = 0
    opaque: tuple[tuple[str, Node], ...] = ()

    def __bool__(self) -> bool:
        """Whether the tree brings anything."""
        return bool(
            self.symbols or self.angles or self.radicands or self.roots or self.denominators or self.opaque
        )


def opaque(node: Node) -> str:
    """The name of the generator that stands for a function of an argument nobody expects."""
    return f"({sha256(repr(node).encode()).hexdigest()})"


def is_opaque(name: str) -> bool:
    """Whether a symbol stands for such a function."""
    return name.startswith("(")


MOST_PLAIN = 4096
"""So many functions are remembered that bring nothing."""


class Known:
    """What a ring holds already: `holds` says of an angle whether its sine and cosine are there.

    Functions that bring nothing are remembered, for all hand-ins to one problem hold the
    same few; `terms` are those that were evaluated in the ring as it is.
    """

    def __init__(self, ring: Ring, terms: Container[Node] = ()) -> None:
        self.ring = ring
        self.terms = terms
        self._plain: dict[Function, None] = {}

    def brings_nothing(self, node: Function) -> bool:
        """Whether this function was met before and is there as it is."""
        return node in self._plain

    def remember(self, node: Function) -> None:
        """Note that a function brings nothing."""
        keep(self._plain, node, None, MOST_PLAIN)

    def holds(self, angle: Angle) -> bool:
        """Whether the ring has the sine and cosine of an angle as they are."""
        try:
            _, degrees = self.ring.plan.multiples(angle)
        except AlgebraError:
            return False
        return degrees % 90 == 0


class _Collector:
    """Walks a tree and notes what a ring must hold for it."""

    def __init__(self, known: Known) -> None:
        self.known = known.ring
        self.there = known
        self.symbols: dict[str, None] = {}
        self.angles: dict[Angle, None] = {}
        self.radicands: dict[Fraction, None] = {}
        self.roots: dict[Node, None] = {}
        self.denominators = 0
        self.opaque: dict[str, Node] = {}
        self.seen: set[Function] = set()

    def walk(self, node: Node) -> None:
        waiting = [node]
        while waiting:
            here = waiting.pop()
            match here:
                case tree.Sum(parts):
                    waiting.extend(parts)
                case tree.Product(parts):
                    if here not in self.there.terms:
                        waiting.extend(parts)
                case Symbol(name, dots):
                    if not self.known.has_symbol(name, dots):
                        self.symbols.setdefault(dotted(name, dots))
                case Number():
                    pass
                case Degrees():
                    self.symbols.setdefault("pi")
                case Function():
                    waiting.extend(self.function(here))
                case tree.Quotient():
                    waiting += [here.numerator, here.denominator]
                    self.denominators += rational_value(here.denominator) is None
                case tree.Power(base, exponent):
                    self.denominators += isinstance(exponent, tree.Negative)
                    waiting.append(base)
                case _:
                    waiting.extend(children(here))

    def function(self, node: Function) -> list[Node]:
        """Note a function; the nodes inside it that are still to be walked."""
        if node in self.seen or self.there.brings_nothing(node):
            return []
        self.seen.add(node)
        if node.name == "sqrt":
            return self.root(node)
        angle = expected_angle(node, self.known.names)
        if angle is None:
            return self.unexpected(node)
        new = [name for name in names_of(angle) if not self.known.has_symbol(name)]
        if not new and self.there.holds(angle):
            self.there.remember(node)
            return []
        self.angles.setdefault(angle)
        self.symbols.update(dict.fromkeys(new))
        return []

    def unexpected(self, node: Function) -> list[Node]:
        name = opaque(node)
        self.symbols.setdefault(name)
        self.opaque[name] = node
        return []

    def root(self, node: Function) -> list[Node]:
        value = rational_value(node.argument)
        if value is not None:
            if value >= 0:
                self.radicands.setdefault(value)
            return []
        if not plain_radicand(node.argument, self.known.names):
            return self.unexpected(node)
        self.roots.setdefault(node.argument)
        return [node.argument]

    def needs(self) -> Needs:
        return Needs(
            tuple(self.symbols),
            tuple(self.angles),
            tuple(self.radicands),
            tuple(self.roots),
            self.denominators,
            tuple(self.opaque.items()),
        )


def dotted(name: str, dots: int) -> str:
    """The plain name of a derivative."""
    return name + ("_" + "d" * dots + "ot" if dots else "")


def expected_angle(node: Function, coordinates: Iterable[str]) -> Angle | None:
    """The argument of a function as an angle, None where it is none (a velocity, a bare number, a cosine)."""
    try:
        angle = angle_from_tree(node.argument)
    except AlgebraError:
        return None
    moving = set(coordinates)
    for atom, _ in angle.terms:
        if len(atom) != 1 and any(e < 0 for name, e in atom if name in moving):
            return None
        if any(abs(e) > 8 for _, e in atom):
            return None
    if len(angle.terms) > 12 or any(r.denominator > 24 for _, r in angle.terms):
        return None
    return angle


def plain_radicand(node: Node, coordinates: Iterable[str]) -> bool:
    """Whether what stands under a root is free of coordinates and functions."""
    names = set(coordinates)
    waiting = [node]
    while waiting:
        here = waiting.pop()
        match here:
            case Symbol(name, dots) if dots or name in names:
                return False
            case Function(name) if name != "sqrt":
                return False
            case Function("sqrt", argument) if rational_value(argument) is None:
                return False
            case tree.Matrix() | tree.Quotient():
                return False
            case tree.Power(_, tree.Negative()):
                return False
        waiting.extend(children(here))
    return True


def needs_of(node: Node, known: Known) -> Needs:
    """What a ring must hold for a tree, beside what is known."""
    collector = _Collector(known)
    collector.walk(node)
    return collector.needs()
