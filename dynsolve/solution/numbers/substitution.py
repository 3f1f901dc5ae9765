"""Exact values put for symbols, in expressions (`Substitution`) and in a whole robot (`robot_with`).

Exact results shown as decimals: the only place where a number is rounded.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from decimal import Decimal
from fractions import Fraction
from functools import cached_property, lru_cache
from typing import Any

from flint import arb, ctx
from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.angles import Angle, angle_from_tree, angle_node
from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.generators import Generator
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.rationals import rational, rational_value
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import build_ring, value_of
from dynsolve.notation.printing import significant
from dynsolve.notation.tree import (
    Degrees,
    Function,
    Letter,
    Node,
    Number,
    Parenthesized,
    Power,
    Quotient,
    Symbol,
    mapped,
    number,
    with_children,
)
from dynsolve.notation.tree_values import sign
from dynsolve.robot.model import Axes, BodyTurn, Joint, Robot
from dynsolve.robot.questions import Limits, ModelQuestions, Target
from dynsolve.robot.shapes import Density

Replacements = Mapping[tuple[str, int], Node]
"""Constant formulas by (name, number of dots): ("theta1", 1) is a velocity."""


def replaced(node: Node, values: Replacements) -> Node:
    """A tree with formulas in place of symbols.

    >>> replaced(Quotient(Symbol("L1"), Number(3)), {("L1", 0): Number(2, 5)}).numerator
    Number(p=2, q=5, decimal=False, rounded=False)
    """
    return mapped(
        node, lambda part: values.get((part.name, part.dots), part) if isinstance(part, Symbol) else part
    )


class Substitution:
    """Carries exact expressions of one ring over into a ring in which symbols have values.

    The map respects sums and products.

    A coordinate that has a value is none in the new ring, so either all of them have
    one or none.  The new ring also holds the formulas `more`.  Raises AlgebraError where
    a value leaves a formula without a meaning: a denominator that becomes 0, the root of a negative number.

    >>> ring = build_ring([], [Symbol("L"), Symbol("m")])
    >>> put = Substitution(ring, {("L", 0): Number(1, 2)})
    >>> put(ring.symbol("L") * ring.symbol("m"))
    Expr(1/2*m)
    """

    def __init__(
        self, source: Ring, values: Replacements, angles: Iterable[Angle] = (), more: Iterable[Node] = ()
    ) -> None:
        self.source, self.values = source, values
        coordinates = [(name, kind) for name, kind in source.coordinates if (name, 0) not in values]
        basic = [self.angle(pair.angle) for pair in source.pairs]
        trees = [*more, *(tree for g in source.generators for tree in self._needs(g))]
        every = [*basic, *(self.angle(angle) for angle in angles)]
        self.ring = build_ring(coordinates, trees, every, basic)

    def angle(self, angle: Angle) -> Angle:
        """An angle with values in it; numbers that are left are radians."""
        known = {name for name, dots in self.values if not dots}
        if not any(name in known for atom, _ in angle.terms for name, _ in atom):
            return angle
        return angle_from_tree(replaced(angle_node(angle), self.values), radians=True)

    def _needs(self, g: Generator) -> Iterator[Node]:
        """The formulas that the new ring must hold so that a generator has a value in it."""
        match g.kind:
            case "symbol" if not g.dots or (g.name, g.dots) in self.values:
                yield replaced(Symbol(g.name, g.dots), self.values)
            case "root":
                yield self._root(g)
            case "inverse" if g.index in self.source.inverses:
                yield Quotient(Number(1), self._denominator(g))
            case "constant":
                yield Function("cos", angle_node(g.angle))
            case "function":
                yield self._function(g)

    def _root(self, g: Generator) -> Node:
        assert g.node is not None
        return Function("sqrt", replaced(g.node, self.values))

    def _function(self, g: Generator) -> Node:
        """The sign of a rate; of one that has a value it is a number."""
        assert isinstance(g.node, Function)
        argument = replaced(g.node.argument, self.values)
        value = rational_value(argument)
        return Function(g.node.name, argument) if value is None else number(Fraction(int(sign(value))))

    def _denominator(self, g: Generator) -> Node:
        tree = Compactor(self.source).form(Expr(self.source, self.source.inverses[g.index]))
        return replaced(tree, self.values)

    @cached_property
    def _images(self) -> tuple[Any, ...]:
        """The image of every generator."""
        return tuple(self._image(g).poly for g in self.source.generators)

    def _image(self, g: Generator) -> Expr:
        match g.kind:
            case "sin":
                return self.ring.sin(self.angle(g.angle))
            case "cos" | "constant":
                return self.ring.cos(self.angle(g.angle))
            case "symbol":
                return value_of(self.ring, replaced(Symbol(g.name, g.dots), self.values))
            case "root":
                return value_of(self.ring, self._root(g))
            case "function":
                return value_of(self.ring, self._function(g))
            case "inverse" if g.index in self.source.inverses:
                return value_of(self.ring, Quotient(Number(1), self._denominator(g)))
        return self.ring.zero  # an inverse that was set aside and never used

    def __call__(self, expr: Expr) -> Expr:
        """The expression with the values in it."""
        if expr.is_number:
            return self.ring.constant(expr.number)
        return Expr(self.ring, self.ring.reduce(expr.poly.compose(*self._images, ctx=self.ring.ctx)))

    def matrix(self, matrix: Matrix) -> Matrix:
        """The matrix with the values in it."""
        return Matrix.of(self.ring, (map(self, row) for row in matrix.rows))


# -- a robot with numbers for some of its parameters: a robot like any other -----------------------


def robot_with(robot: Robot, values: Replacements, more: Iterable[Node] = ()) -> Robot:
    """The robot with these values for its parameters, its ring holding the formulas `more`, too.

    Raises AlgebraError where a formula has no meaning with them.
    """
    angles = [angle for joint in robot.joints for angle in (joint.theta, joint.alpha)]
    put = Substitution(robot.ring, values, angles, more)
    return Robot(
        ring=put.ring,
        convention=robot.convention,
        coordinates=robot.coordinates,
        joints=_with_values(robot.joints, put),
        bodies=_with_values(robot.bodies, put),
        gravity=put.matrix(robot.gravity),
        base_rotation=put.matrix(robot.base_rotation),
        base_position=put.matrix(robot.base_position),
        base_turns=_with_values(robot.base_turns, put, _written),
        parameters=tuple(name for name in robot.parameters if (name, 0) not in values),
        inputs=robot.inputs,
        questions=_with_values(robot.questions, put),
        actions=_with_values(robot.actions, put),
        given=_with_values(robot.given, put),
        has_decimals=robot.has_decimals,
        decimals=robot.decimals,
    )


_KEPT = (Target, Limits, Density)
"""What holds no formula that a value goes into."""

_OF_THE_TABLE = (Joint, Axes, BodyTurn)
"""What holds formulas as the file has written them."""


def _with_values(part: Any, put: Substitution, write: Callable[[Node, Replacements], Node] = replaced) -> Any:
    """A part of a robot, every formula in it with the values; `write` is how a tree gets them."""
    match part:
        case Expr():
            return put(part)
        case Matrix():
            return put.matrix(part)
        case Angle():
            return put.angle(part)
        case Node():
            return write(part, put.values)
        case tuple():
            return tuple(_with_values(each, put, write) for each in part)
        case Struct() if not isinstance(part, _KEPT):
            if isinstance(part, _OF_THE_TABLE):
                write = _written
            fields = {name: getattr(part, name) for name in part.__struct_fields__}
            if isinstance(part, ModelQuestions):
                del fields["parameters"]
            return replace(part, **{name: _with_values(value, put, write) for name, value in fields.items()})
    return part


def _written(node: Node, values: Replacements) -> Node:
    """A cell of the table with values in it; one that is a number is written as one."""
    if isinstance(node, Symbol | Number | Degrees):
        tree = replaced(node, values)
    else:
        bare = {key: Parenthesized(value) if not isinstance(value, Number) else value
                for key, value in values.items()}  # fmt: skip
        tree = replaced(node, bare)
    value: Fraction | None = rational_value(tree)
    return tree if value is None else number(value)


# Exact results shown as decimals: the only place where a number is rounded

DIGITS = 4
"""Significant digits, unless others are asked for."""

_WORKING_DIGITS = 40
_WORKING_BITS = 400


def rounded(node: Node, digits: int) -> Node:
    """A tree with every number in it as a decimal of so many significant digits.

    Exponents, angles and indices stay.
    """
    match node:
        case Number(p, q):
            exact = Fraction(p, q)
            value = significant(exact, digits)
            return Number(value.numerator, value.denominator, decimal=True, rounded=value != exact)
        case Quotient(Number(p, q), Number(r, s)):
            return rounded(Number(p * s, q * r), digits)
        case Power(base, exponent):
            return Power(rounded(base, digits), exponent)
        case Function(name) if name != "sqrt":
            return node
        case Letter():
            return node
    return with_children(node, lambda part: rounded(part, digits))


def without_constants(expr: Expr) -> Expr:
    """The expression with √3, cos 17° and π in it as decimals of 40 digits.

    >>> from dynsolve.algebra.ring_values import build_ring
    >>> from dynsolve.algebra.ring_values import value_of
    >>> ring = build_ring([], [Function("sqrt", Number(2))])
    >>> float(without_constants(value_of(ring, Function("sqrt", Number(2)))).number)
    1.4142135623730951
    """
    constants = _constants(expr.ring)
    used = expr.poly.degrees()
    if not any(used[index] > 0 for index in constants):
        return expr
    collected: dict[tuple[int, ...], Any] = {}
    with ctx.workprec(_WORKING_BITS):
        for exponents, coefficient in expr.poly.to_dict().items():
            value = arb(coefficient)
            for index, number in constants.items():
                if exponents[index]:
                    value *= number ** int(exponents[index])
            rest = tuple(0 if i in constants else int(e) for i, e in enumerate(exponents))
            collected[rest] = collected.get(rest, arb(0)) + value
        numbers = {rest: rational(_fraction(value)) for rest, value in collected.items()}
    poly = expr.ring.ctx.from_dict({rest: number for rest, number in numbers.items() if number})
    return Expr(expr.ring, poly)


def _fraction(value: arb) -> Fraction:
    """The value to 40 digits; rounding that is left of a sum that is 0 counts as 0."""
    if abs(float(value)) < 10.0**-_WORKING_DIGITS:
        return Fraction(0)
    return Fraction(Decimal(value.str(_WORKING_DIGITS, radius=False)))


def _constants(ring: Ring) -> Mapping[int, arb]:
    """The generators that are numbers, with their values."""
    return _found(ring, len(ring.inverses))


@lru_cache(maxsize=8)
def _found(ring: Ring, inverses: int) -> Mapping[int, arb]:
    found: dict[int, arb] = {}
    with ctx.workprec(_WORKING_BITS):
        for g in sorted(ring.generators, key=_order):
            value = _value(ring, g, found)
            if value is not None:
                found[g.index] = value
    return found


def _order(g: Generator) -> tuple[int, int]:
    """Roots are of angles, numbers and roots laid out after them; denominators may hold all of these."""
    return ("root", "inverse").index(g.kind) + 1 if g.kind in ("root", "inverse") else 0, -g.index


def _value(ring: Ring, g: Generator, known: Mapping[int, arb]) -> arb | None:
    match g.kind:
        case "symbol" if g.name == "pi":
            return arb.pi()
        case "root":
            inner = _worth(ring.radicands[g.index], known)
            return None if inner is None else inner.sqrt()
        case "inverse" if g.index in ring.inverses:
            inner = _worth(ring.inverses[g.index], known)
            return None if inner is None else 1 / inner
        case "sin" | "cos" | "constant" if all(atom == () for atom, _ in g.angle.terms):
            angle = arb.pi() * arb(rational(g.angle.degrees / 180))
            for _, radians in g.angle.terms:
                angle += arb(rational(radians))
            return angle.sin() if g.kind == "sin" else angle.cos()
    return None


def _worth(poly: Any, known: Mapping[int, arb]) -> arb | None:
    """The value of a polynomial in known generators, None where another stands in it."""
    total = arb(0)
    for exponents, coefficient in poly.to_dict().items():
        term = arb(coefficient)
        for index, exponent in enumerate(exponents):
            if exponent and index not in known:
                return None
            if exponent:
                term *= known[index] ** int(exponent)
        total += term
    return total


def has_constants(ring: Ring) -> bool:
    """Whether a ring has roots of numbers, cosines of constant angles or π among its generators."""
    return bool(_constants(ring))
