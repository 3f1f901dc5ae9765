"""What an answer brings that the problem's ring does not hold: names, angles, roots, denominators.

A function of an argument that nobody expects, sin(θ̇₁) or sin(90), is a generator of its
own, so that the answer has a value and can be diagnosed.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Sequence
from math import radians

from dynsolve.algebra.angles import Angle, Contents, ContentsCollector, angle_from_tree, names_of
from dynsolve.algebra.expr import dotted
from dynsolve.algebra.rationals import rational_value
from dynsolve.algebra.ring import Ring
from dynsolve.answers.judging.entry_comparison import half_unit
from dynsolve.errors import AlgebraError
from dynsolve.notation import tree
from dynsolve.notation.tree import Function, Node, Product, Symbol, walk
from dynsolve.notation.tree_values import keep

MOST_KNOWN = 4096
"""So many functions are remembered that bring nothing."""


class Known:
    """What a ring holds already: `holds` says of an angle whether its sine and cosine are there.

    Functions that bring nothing are remembered, for all hand-ins to one problem hold the
    same few; `terms` are those that were evaluated in the ring as it is.
    """

    def __init__(self, ring: Ring, terms: Container[Node] = ()) -> None:
        self.ring = ring
        self.terms = terms
        self._functions: dict[Function, None] = {}

    def brings_nothing(self, node: Function) -> bool:
        """Whether this function was met before and is there as it is."""
        return node in self._functions

    def remember(self, node: Function) -> None:
        """Note that a function brings nothing."""
        keep(self._functions, node, None, MOST_KNOWN)

    def holds(self, angle: Angle) -> bool:
        """Whether the ring has the sine and cosine of an angle as they are."""
        try:
            _, degrees = self.ring.plan.multiples(angle)
        except AlgebraError:
            return False
        return degrees % 90 == 0


class ExtensionCollector(ContentsCollector):
    """Notes what trees hold beside what is known; what has no exact value becomes a generator of its own."""

    def __init__(self, known: Known) -> None:
        super().__init__()
        self._known = known
        self._ring = known.ring
        self._seen: set[Function] = set()

    def note(self, node: Node) -> Sequence[Node]:
        """Note what a node brings; a product that was evaluated before brings nothing."""
        if isinstance(node, Product) and node in self._known.terms:
            return ()
        return super().note(node)

    def symbol(self, name: str, dots: int) -> None:
        """Note a symbol that the ring does not have; derivatives of it are symbols of their own."""
        if not self._ring.has_symbol(name, dots):
            self.symbols.setdefault(dotted(name, dots))

    def function(self, node: Function) -> Sequence[Node]:
        """Note a function, unless it was met before."""
        node = unsigned(node)[1]
        if node in self._seen or self._known.brings_nothing(node):
            return ()
        self._seen.add(node)
        angle = expected_angle(node, self._ring.names)
        if angle is None:
            self.functions.setdefault(node)
            return ()
        new = [name for name in names_of(angle) if not self._ring.has_symbol(name)]
        if not new and self._known.holds(angle):
            self._known.remember(node)
            return ()
        self.angles.setdefault(angle)
        self.symbols.update(dict.fromkeys(new))
        return ()

    def root(self, node: Function, argument: Node) -> None:
        """Note a root; that of a negative number is refused where it is evaluated."""
        value = rational_value(argument)
        if value is not None and value < 0:
            return
        if value is None and not plain_radicand(argument, self._ring.names):
            self.functions.setdefault(node)
        else:
            super().root(node, argument)


def extension_of(node: Node, known: Known) -> Contents:
    """What a ring must hold for a tree, beside what is known."""
    collector = ExtensionCollector(known)
    collector.collect([node])
    return collector.contents


LARGEST_EXPONENT = 8
MOST_TERMS = 12
LARGEST_DIVISOR = 24

_STEP = radians(15)
_DOUBLE = 1e-14
"""So far a number of double precision may be off."""


def expected_angle(node: Function, coordinates: Iterable[str]) -> Angle | None:
    """The argument of a function as an angle, None where it is none (a velocity, a bare number, a cosine)."""
    if node.name == "sgn":
        return None
    try:
        angle = _in_degrees(angle_from_tree(node.argument, radians=True))
    except AlgebraError:
        return None
    if angle is None:
        return None
    moving = set(coordinates)
    for atom, _ in angle.terms:
        if len(atom) != 1 and any(e < 0 for name, e in atom if name in moving):
            return None
        if any(abs(e) > LARGEST_EXPONENT for _, e in atom):
            return None
    if len(angle.terms) > MOST_TERMS or any(rate.denominator > LARGEST_DIVISOR for _, rate in angle.terms):
        return None
    return angle


def _in_degrees(angle: Angle) -> Angle | None:
    """The angle with degrees for a decimal in radians, which rounds a multiple of 15°: 1.5708."""
    rates = dict(angle.terms)
    bare = rates.pop((), None)
    if bare is None:
        return angle
    half, steps = half_unit(bare), round(float(bare) / _STEP)
    if half is None or not steps or abs(float(bare) - steps * _STEP) > 2 * float(half) + _DOUBLE:
        return None
    return Angle(tuple(rates.items()), angle.degrees + 15 * steps)


def unsigned(node: Function) -> tuple[int, Function]:
    """(±1, sgn x) of the sign of ±x, or of x times a positive number; others as they are.

    >>> x = Symbol("q1", 1)
    >>> unsigned(Function("sgn", tree.Negative(x))) == (-1, Function("sgn", x))
    True
    """
    sign, inner = 1, node.argument
    while node.name == "sgn":
        match inner:
            case tree.Negative(argument):
                sign, inner = -sign, argument
            case tree.Parenthesized(argument):
                inner = argument
            case Product(factors) if len(factors) == 2 and (number := rational_value(factors[0])):
                sign, inner = (sign if number > 0 else -sign), factors[1]
            case _:
                return sign, Function("sgn", inner)
    return 1, node


def plain_radicand(node: Node, coordinates: Iterable[str]) -> bool:
    """Whether what stands under a root is free of coordinates, functions and denominators."""
    names = set(coordinates)
    for part in walk(node):
        match part:
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
    return True
