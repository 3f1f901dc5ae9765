"""The exact value of what a student wrote: trees -> fractions over the answers' ring.

It differs from that of a problem's formulas (`algebra.ring_values`) in four things: a
denominator may hold joint variables; a function may have any argument; a name may stand
for another answer; and the work that one answer may cost is counted.

What an answer brings that the problem's ring does not hold: names, angles, roots, denominators.

A function of an argument that nobody expects, sin(θ̇₁) or sin(90), is a generator of its
own, so that the answer has a value and can be diagnosed.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Sequence
from math import radians
from typing import ClassVar, NamedTuple

from flint.utils.flint_exceptions import FlintError
from msgspec import Struct, field

from dynsolve.algebra.angles import Angle, Contents, ContentsCollector, angle_from_tree, names_of
from dynsolve.algebra.fraction import RationalExpr
from dynsolve.algebra.generators import dotted, is_sign
from dynsolve.algebra.rationals import half_unit, rational_value
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import Evaluator, Unreduced
from dynsolve.errors import AlgebraError
from dynsolve.notation import tree
from dynsolve.notation.tree import Function, Node, Product, Reference, Sum, Symbol, walk
from dynsolve.notation.tree_values import keep

# What an answer brings

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
        """Note what a node brings; a product or a sum that was evaluated before brings nothing."""
        if isinstance(node, Product | Sum) and node in self._known.terms:
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


# The value of a tree

MOST_WORK = 400_000
"""The products of terms that one answer may cost."""

MOST_PRODUCTS = 240_000
"""The products of terms that one multiplication may cost."""

MOST_TURNS = 24
"""The largest sum of multiples of the basic angles in one angle."""

MOST_KNOWN = 4096
"""So many functions and terms are remembered."""

SHORT_SUM = 4
"""Sums of more terms seldom stand in two answers."""


Lookup = Callable[[Reference], RationalExpr]
"""The value of an answer that occurs inside another."""

FunctionValue = RationalExpr | tuple[int, int]
"""A value, or (generator, ±1) where it is one."""


class KnownValues(Struct):
    """What functions of angles and terms of sums were found to be in one ring, whoever wrote them.

    All hand-ins to one problem hold much the same terms.
    """

    functions: dict[Function, FunctionValue] = field(default_factory=dict)
    terms: dict[Node, Unreduced | Summed] = field(default_factory=dict)


class Summed(NamedTuple):
    """The value of a sum, and what it cost."""

    value: RationalExpr
    work: int


def _nothing(reference: Reference) -> RationalExpr:
    raise AlgebraError(f"{reference} stands for no answer")


class AnswerEvaluator(Evaluator):
    """Values of answers in one ring; `work` is what the current answer has cost.

    `known` are the values that are known already, for several hand-ins in one ring.
    """

    largest_power: ClassVar[int] = 20
    largest_exponent: ClassVar[int] = 100
    most_terms: ClassVar[int] = 30_000

    def __init__(self, ring: Ring, lookup: Lookup = _nothing, known: KnownValues | None = None) -> None:
        super().__init__(ring)
        self._lookup = lookup
        self._known = KnownValues() if known is None else known
        self._sign_generators = [ring.generator(g.index) for g in ring.generators if is_sign(g.node)]
        self._references = 0
        self._roots: dict[Function, RationalExpr] = {}

    def value(self, node: Node) -> RationalExpr:
        """The value of a tree; that of a short sum is remembered as a term is."""
        if type(node) is not Sum or len(node.terms) > SHORT_SUM:
            return super().value(node)
        found = self._known.terms.get(node)
        if isinstance(found, Summed):
            self.work += found.work
            return found.value
        references, work = self._references, self.work
        value = super().value(node)
        if self._references == references:
            keep(self._known.terms, node, Summed(value, self.work - work), MOST_KNOWN)
        return value

    def term(self, node: Node) -> Unreduced | RationalExpr:
        """A term of a sum; it is remembered where nothing of the student's own stands in it."""
        found: Unreduced | Summed | RationalExpr | None = self._known.terms.get(node)
        if isinstance(found, Unreduced):
            self.work += found.work
            return found
        references = self._references
        found = super().term(node)
        if isinstance(found, Unreduced) and self._references == references:
            keep(self._known.terms, node, found, MOST_KNOWN)
        return found

    def times(self, a: Expr, b: Expr) -> Expr:
        """a · b, with its work counted."""
        cost = len(a) * len(b)
        self.work += cost
        if self.work > MOST_WORK or cost > MOST_PRODUCTS:
            raise AlgebraError(
                "multiplied out this is too large", "name a part of it with a symbol of its own"
            )
        product = a * b
        if len(product) > self.most_terms:
            raise AlgebraError("multiplied out this has too many terms")
        if product.poly and _bits(product) > self.most_bits:
            raise AlgebraError("a number is too large")
        return product

    def inverse(self, value: RationalExpr) -> RationalExpr:
        """1 / value, a fraction where the value is no number."""
        if value.is_zero:
            raise AlgebraError("the denominator is zero", "check what stands below the fraction line")
        if value.divisor is None and value.numerator.is_number:
            return RationalExpr(self.ring.one / value.numerator.number)
        signs, rest = self._without_signs(value.numerator)
        if rest.is_number:
            return RationalExpr(value.denominator * signs / rest.number)
        return RationalExpr(value.denominator * signs, rest)

    def _without_signs(self, expr: Expr) -> tuple[Expr, Expr]:
        """The signs sgn q̇ that are factors of an expression, and what is left: 1 / sgn q̇ = sgn q̇."""
        found = self.ring.one
        for sign in self._sign_generators:
            quotient, rest = divmod(expr.poly, sign.poly)
            if not rest:
                found, expr = found * sign, Expr(self.ring, quotient)
        return found, expr

    def reference(self, node: Reference) -> RationalExpr:
        """The value of another answer."""
        self._references += 1
        return self._lookup(node)

    # -- functions ---------------------------------------------------------------------------------

    def function(self, node: Function) -> FunctionValue:
        """The value of a sine, cosine or tangent, which no answer of the hand-in can change."""
        found = self._known.functions.get(node)
        if found is None:
            work = self.work
            found = keep(self._known.functions, node, self._function_value(node), MOST_KNOWN)
            self.work = work  # what is remembered costs nothing, nor must the first who writes it pay
        return found

    def _function_value(self, node: Function) -> FunctionValue:
        angle = expected_angle(node, self.ring.names)
        if angle is None:
            sign, bare = unsigned(node)
            value = self.ring.function(bare) * sign
        elif node.name == "tan":
            cosine = RationalExpr(self._turned("cos", angle))
            return self.product(RationalExpr(self._turned("sin", angle)), self.inverse(cosine))
        elif node.name in ("sin", "cos"):
            value = self._turned(node.name, angle)
        else:
            raise AlgebraError(f"{node.name} is not a function that occurs here")
        return _generator(value) or RationalExpr(value)

    def _turned(self, name: str, angle: Angle) -> Expr:
        counts = self.ring.multiples(angle.linear) if angle.terms else ()
        if sum(map(abs, counts)) > MOST_TURNS:
            raise AlgebraError(f"an angle is more than {MOST_TURNS} times those of the problem")
        return self.ring.cos(angle) if name == "cos" else self.ring.sin(angle)

    def root(self, node: Function) -> RationalExpr:
        """The value of a square root."""
        found = self._roots.get(node)
        if found is None:
            found = self._roots[node] = RationalExpr(self._root_value(node))
        return found

    def _root_value(self, node: Function) -> Expr:
        value = rational_value(node.argument)
        if value is not None:
            if value < 0:
                raise AlgebraError("the root of a negative number", "lengths and masses are real")
            return self.ring.root(node, self.ring.constant(value)) if value else self.ring.zero
        if not plain_radicand(node.argument, self.ring.names):
            return self.ring.function(node)
        inner = self.value(node.argument)
        exact = _exact_root(inner.numerator) if inner.divisor is None else None
        return self.ring.root(node.argument, inner.numerator) if exact is None else exact


def _generator(value: Expr) -> tuple[int, int] | None:
    """(generator, ±1) where a value is one."""
    if len(value) != 1:
        return None
    exponents, coefficient = next(iter(value.poly.to_dict().items()))
    used = [i for i, e in enumerate(exponents) if e]
    if len(used) != 1 or exponents[used[0]] != 1 or abs(coefficient) != 1:
        return None
    return used[0], 1 if coefficient > 0 else -1


def _bits(expr: Expr) -> int:
    lead = expr.poly.leading_coefficient()
    return int(lead.p).bit_length() + int(lead.q).bit_length()


def _exact_root(expr: Expr) -> Expr | None:
    """√p where p is the square of a polynomial, the one with a positive leading coefficient."""
    try:
        root = expr.poly.sqrt()
    except (FlintError, ValueError):  # it is none
        return None
    if root and root.leading_coefficient() < 0:
        root = -root
    return Expr(expr.ring, root)
