"""Which identities of sine and cosine lead from one line to the next.

Found, not guessed: a sine or cosine of an angle that is new in the second line is the sum or the
difference of two angles of the first; and where the two lines still differ as polynomials in
sines and cosines, s² + c² = 1 of the angles that the difference holds has been used.  A line that
does not equal the one before it has no identities at all: `identities` gives None.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from flint import fmpq_mpoly

from dynsolve.algebra.angles import Angle, angle_from_tree, angle_node
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.generators import Pair
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.rationals import rational
from dynsolve.algebra.ring import Ring
from dynsolve.algebra.ring_values import value_of
from dynsolve.document import Prose
from dynsolve.errors import AlgebraError
from dynsolve.explain.context import Context
from dynsolve.explain.step import Line
from dynsolve.explain.writing import listed, sum_of
from dynsolve.notation.tree import (
    Function,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Relation,
    Sum,
    Symbol,
    equation,
)
from dynsolve.notation.walk import mapped, walk


@dataclass(frozen=True, slots=True)
class Identity:
    """An identity in this robot's angles: c₁ c₁₂ + s₁ s₁₂ = c₂; s² + c² = 1 has no `name`."""

    name: str
    relation: Relation


def said(used: Sequence[Identity]) -> Prose:
    """s₁² + c₁² = 1 and the cosine of a difference, c₁ c₁₂ + s₁ s₁₂ = c₂"""
    return listed([(f"{each.name}, ", each.relation) if each.name else each.relation for each in used])


def identities(ring: Ring, before: Node, after: Node) -> tuple[Identity, ...] | None:
    """The identities that are used on the way from one tree to an equal one; None if they are not equal.

    >>> from dynsolve.algebra.build import build_ring
    >>> from dynsolve.notation.unicode import to_unicode
    >>> from dynsolve.notation.tree import Symbol
    >>> q1, q2 = Symbol("q1"), Symbol("q2")
    >>> both = Angle.of("q1") + Angle.of("q2")
    >>> ring = build_ring([("q1", "revolute"), ("q2", "revolute")], [], [Angle.of("q1"), both])
    >>> s, c = Function("sin", q1), Function("cos", q1)
    >>> squares = Sum((Power(s, Number(2)), Power(c, Number(2))))
    >>> [to_unicode(found.relation) for found in identities(ring, squares, Number(1))]
    ['sin²(q₁) + cos²(q₁) = 1']
    >>> identities(ring, squares, Number(2)) is None
    True
    """
    unreduced = Unreduced(ring)
    try:
        additions = tuple(_additions(ring, before, after))
        sums = {each.relation.parts[-1]: each.relation.parts[0] for each in additions}
        without_sums = mapped(after, lambda node: sums.get(node, node))
        difference = unreduced(before) - unreduced(without_sums)
    except AlgebraError:
        return None
    if ring.reduce(difference):
        return None
    angles = _squared(ring, before, without_sums, difference)
    return (*(pythagoras(angle_node(angle, ring.names)) for angle in angles), *additions)


def _squared(ring: Ring, before: Node, after: Node, difference: fmpq_mpoly) -> list[Angle]:
    """The angles of which s² + c² = 1 is used on the way to an equal line."""
    basic = _of_basic_angles(ring, difference)
    return _as_they_stand(ring, before, after) or basic if basic else []


def _of_basic_angles(ring: Ring, difference: fmpq_mpoly) -> list[Angle]:
    """The basic angles of which a sine or cosine is squared in a difference that s² + c² = 1 makes 0."""
    degrees = difference.degrees()
    return [pair.angle for pair in ring.pairs if degrees[pair.sine] > 1 or degrees[pair.cosine] > 1]


def _as_they_stand(ring: Ring, before: Node, after: Node) -> list[Angle]:
    """The angles whose s² + c² = 1 alone leads from one line to the other: θ₃, and not θ₂ and θ₂ + θ₃.

    One of the ring is put for each angle; none where these are too few, or nothing is exchanged.
    """
    angles = list(dict.fromkeys(angle for tree in (before, after) for angle in _angles(tree) if angle.terms))
    if len(angles) > len(ring.pairs) or {pair.angle for pair in ring.pairs}.issuperset(angles):
        return []
    stand_in = dict(zip(angles, ring.pairs, strict=False))

    def exchanged(node: Node) -> Node:
        if isinstance(node, Function) and node.name in ("sin", "cos"):
            pair = stand_in.get(angle_from_tree(node.argument))
            return node if pair is None else Function(node.name, angle_node(pair.angle, ring.names))
        return node

    unreduced = Unreduced(ring)
    difference = unreduced(mapped(before, exchanged)) - unreduced(mapped(after, exchanged))
    if ring.reduce(difference):
        return []
    squared = set(_of_basic_angles(ring, difference))
    return [angle for angle, pair in stand_in.items() if pair.angle in squared]


_FULL = {"sin": "sine", "cos": "cosine"}


def doubled_angles(*nodes: Node) -> Iterator[Relation]:
    """What cos(2θ) and sin(2θ) stand for, where they do in trees: c² - s² = cos(2θ), 2 s c = sin(2θ)."""
    for part in walk(*nodes):
        match part:
            case Function("cos", Product((Number(2, 1), angle))):
                c, s = (Power(Function(name, angle), Number(2)) for name in ("cos", "sin"))
                yield equation(Sum((c, Negative(s))), part)
            case Function("sin", Product((Number(2, 1), angle))):
                yield equation(Product((Number(2), Function("sin", angle), Function("cos", angle))), part)


def pythagoras(angle: Node) -> Identity:
    """sin² + cos² = 1 of an angle."""
    squares = tuple(Power(Function(name, angle), Number(2)) for name in ("sin", "cos"))
    return Identity("", equation(Sum(squares), Number(1)))


def _angles(node: Node) -> dict[Angle, set[str]]:
    """The angles whose sines and cosines occur, and which of both."""
    found: dict[Angle, set[str]] = {}
    for part in walk(node):
        if isinstance(part, Function) and part.name in ("sin", "cos"):
            found.setdefault(angle_from_tree(part.argument), set()).add(part.name)
    return found


def _additions(ring: Ring, before: Node, after: Node) -> Iterator[Identity]:
    """The addition theorems by which new angles come about."""
    old = list(_angles(before))
    for angle, names in _angles(after).items():
        if angle in old or -angle in old:
            continue
        parts = _parts(angle, old)
        for name in sorted(names) if parts else ():
            assert parts is not None
            yield _addition(ring, name, angle, *parts)


def _parts(angle: Angle, old: list[Angle]) -> tuple[Angle, Angle, int] | None:
    """(A, B, ±1) with angle = A ± B, both of them in `old`."""
    for sign in (-1, 1):
        for a in old:
            for b in old:
                if a + b * sign == angle:
                    return a, b, sign
    return None


def _addition(ring: Ring, name: str, angle: Angle, a: Angle, b: Angle, sign: int) -> Identity:
    """cos A cos B ∓ sin A sin B = cos(A ± B), sin A cos B ± cos A sin B = sin(A ± B), of these angles."""

    def of(function: str, which: Angle) -> Node:
        return Function(function, angle_node(which, ring.names))

    other = {"sin": "cos", "cos": "sin"}[name]
    if name == "cos" and len(b.terms) < len(a.terms):
        a, b = b, a  # c₁ c₁₂ + s₁ s₁₂, as it stands in a line
    first = Product((of(name, a), of("cos", b)))
    second = Product((of(other, a), of("sin", b)))
    plus = (sign > 0) == (name == "sin")
    words = "twice an angle" if a == b else "a sum" if sign > 0 else "a difference"
    left: Node = Sum((first, second if plus else Negative(second)))
    if a == b:
        squares = Sum((Power(of("cos", a), Number(2)), Negative(Power(of("sin", a), Number(2)))))
        left = squares if name == "cos" else Product((Number(2), of("sin", a), of("cos", a)))
    return Identity(f"the {_FULL[name]} of {words}", equation(left, of(name, angle)))


# -- the identities by which the entries of a product of matrices become what is printed, and what cancels


def used_in_product(context: Context, left: Matrix, right: Matrix, result: Matrix) -> list[Identity]:
    """Those that lead from Σ_k left_ik right_kj to the entries of the result, each once."""
    used: dict[Identity, None] = {}
    for row, entries in zip(left.rows, result.rows, strict=True):
        for column, entry in zip(right.T.rows, entries, strict=True):
            pairs = [(a, b) for a, b in zip(row, column, strict=True) if not (a.is_zero or b.is_zero)]
            products = [Product((context.show(a), context.show(b))) for a, b in pairs]
            if len(products) > 1:
                found = identities(context.robot.ring, sum_of(products), context.show(entry))
                used |= dict.fromkeys(found or ())
    return list(used)


def cancelled_in_product(context: Context, left: Matrix, right: Matrix) -> Prose:
    """That the terms with s₁ c₁ cancel, where a product of matrices loses all of them without an identity."""
    ring = context.robot.ring
    left_over: set[tuple[int, ...]] = set()
    gone: set[tuple[int, ...]] = set()
    for row in left.rows:
        for column in right.T.rows:
            products = [a.poly * b.poly for a, b in zip(row, column, strict=True)]
            kept = set(sum(products, start=ring.zero.poly).to_dict())
            left_over |= kept
            gone |= {term for each in products for term in each.to_dict()} - kept
    for pair in ring.pairs:
        if _have_both(gone, pair) and not _have_both(left_over, pair):
            return products_cancel(ring, pair)
    return ()


def _have_both(terms: Iterable[tuple[int, ...]], pair: Pair) -> bool:
    """Whether the sine and the cosine of an angle stand in one of the terms, given by their exponents."""
    return any(term[pair.sine] and term[pair.cosine] for term in terms)


def products_cancel(ring: Ring, pair: Pair) -> Prose:
    """(the terms with s₁ c₁ cancel)"""
    angle = angle_node(pair.angle, ring.names)
    return (" (the terms with ", Product((Function("sin", angle), Function("cos", angle))), " cancel)")


def product_named(context: Context, left: Matrix, right: Matrix, result: Matrix) -> Prose:
    """The sentence before the result of a product; nothing of longer arms, or where none is used."""
    if not context.is_short:
        return ()
    used = used_in_product(context, left, right, result)
    return ("With ", *said(used), ":") if used else ()


# -- the value of a tree as a polynomial before any relation is used: s² + c² is not yet 1 ---------
# Two trees of the same exact value have the same unreduced value where only products were
# multiplied out and terms collected on the way from one to the other.  Where the unreduced values
# differ, an identity of sine and cosine was used; `identities` finds which.


class Unreduced:
    """Polynomials of scalar trees in one ring, products multiplied out and nothing else done.

    Raises AlgebraError for a tree without a value in the ring.
    """

    def __init__(self, ring: Ring) -> None:
        self.ring = ring
        self._turned: dict[Node, tuple[fmpq_mpoly, fmpq_mpoly]] = {}

    def __call__(self, node: Node) -> fmpq_mpoly:
        """The polynomial of a tree."""
        ring = self.ring
        match node:
            case Sum(terms):
                return sum(map(self, terms), start=ring.zero.poly)
            case Product(factors):
                product = ring.one.poly
                for factor in factors:
                    product = product * self(factor)
                return product
            case Negative(argument):
                return -self(argument)
            case Parenthesized(argument):
                return self(argument)
            case Power(base, Number(p, 1)):
                return self(base) ** p
            case Quotient(numerator, Number(p, q)):
                return self(numerator) * rational(Fraction(q, p))
            case Quotient(numerator, denominator):
                return self(numerator) * ring.inverse(value_of(ring, denominator)).poly
            case Symbol(name, dots):
                return ring.symbol(name, dots).poly
            case Function("sin" | "cos" as name, argument):
                return self._cosine_and_sine(argument)[name == "sin"]
        return value_of(ring, node).poly

    def _cosine_and_sine(self, argument: Node) -> tuple[fmpq_mpoly, fmpq_mpoly]:
        found = self._turned.get(argument)
        if found is None:
            found = self._turned[argument] = turned(self.ring, angle_from_tree(argument))
        return found


def turned(ring: Ring, angle: Angle) -> tuple[fmpq_mpoly, fmpq_mpoly]:
    """(cos, sin) of an angle by the addition theorems alone: cos 2θ = c² - s²."""
    if angle.degrees:
        return ring.cos(angle).poly, ring.sin(angle).poly
    c, s = ring.one.poly, ring.zero.poly
    for pair, times in zip(ring.pairs, ring.multiples(angle), strict=True):
        c1, s1 = ring.generator(pair.cosine).poly, ring.generator(pair.sine).poly
        for _ in range(abs(times)):
            turn = s1 if times > 0 else -s1
            c, s = c * c1 - s * turn, s * c1 + c * turn
    return c, s


# -- a chain of lines, each of which is proved equal to the value it claims before it is shown -----
# `chain` is the only way by which the stages get their lines: what it cannot prove in the ring is
# not said.


@dataclass(frozen=True, slots=True)
class Way:
    """The lines to a result, and what is said of the last operation.

    With a `frame` they begin afresh from the formula, along the axes of that frame.
    """

    lines: tuple[Line, ...] = ()
    concluding: Prose = ()
    frame: int | None = None


SILENT = Way()


def equals(tree: Node, value: Expr) -> bool:
    """Whether a scalar tree has an exact value, and this one."""
    try:
        return value_of(value.ring, tree) == value
    except AlgebraError:
        return False


def chain(
    value: Expr, lines: Iterable[tuple[Prose, Node]], written: Callable[[Node], Node], concluding: Prose
) -> Way:
    """The lines as they are written, if each of them is the value; else nothing."""
    lines = tuple(lines)
    if not all(equals(tree, value) for _, tree in lines):
        return SILENT
    return Way(tuple(Line(by, (written(tree),)) for by, tree in lines), concluding)
