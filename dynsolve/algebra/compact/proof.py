"""Whether a compact form is its polynomial, and the plain form that stands in its place if it is not.

Both are evaluated at one random point over the integers modulo a prime, at which sin² + cos² = 1 and every
inverse inverts.  Two polynomials of degree d that differ agree there with probability d/p, less than 10⁻¹⁶
(Schwartz, Fast probabilistic algorithms for verification of polynomial identities, J. ACM 1980).  Where
a ring has roots, constant angles or other functions, which need not be numbers modulo a prime, both are
evaluated in floating point, at values at which everything in the ring is positive.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from math import pi
from random import Random
from typing import Any

from dynsolve.algebra.angles import angle_node
from dynsolve.algebra.generators import Generator, is_sign
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import evaluate, value_of
from dynsolve.errors import AlgebraError
from dynsolve.notation.build import times, total
from dynsolve.notation.tree import (
    Function,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    names_in,
)
from dynsolve.notation.tree_values import evaluate as value_of_tree

PRIME = 2**61 - 1

FLOATS, ROUNDING = 2, 1e-9
"""How many values forms are compared at in floating point; the difference, to the sum of the terms sizes."""


class Proof:
    """Holds forms of one ring to their values; parts that trees share are evaluated once."""

    def __init__(self, ring: Ring) -> None:
        self.ring = ring
        self._in_floats = any(_is_transcendental(g) for g in ring.generators)
        self._point: tuple[int, ...] = ()
        self._inverses = -1
        self._known: dict[Node, int] = {}

    def holds(self, expr: Expr, form: Node) -> bool:
        """Whether a form is an expression."""
        if not self._in_floats:
            if self._inverses != len(self.ring.inverses):  # an answer may bring one
                self._point, self._inverses = _random_point(self.ring), len(self.ring.inverses)
            try:
                return self._tree(form) == self._poly(expr.poly)
            except AlgebraError:  # a constant angle that the ring knows by its multiples alone
                self._in_floats = True
        return all(self._is_close(expr, form, seed) for seed in range(FLOATS))

    def _is_close(self, expr: Expr, form: Node, seed: int) -> bool:
        """Whether both agree at random values, or have none there, as the root of a negative number."""
        random = Random(seed)  # noqa: S311 - the same values every time are wanted
        names = sorted({*self.ring.names, *self.ring.parameters, *names_in(form)})
        values = {
            f"{name}{dots}": random.uniform(0.3, 0.7) for name in names for dots in ("", "_dot", "_ddot")
        }
        values["pi"] = pi
        sizes = {exponents: abs(factor) for exponents, factor in expr.poly.to_dict().items()}
        try:
            value, size = (
                evaluate(e, values) for e in (expr, Expr(self.ring, self.ring.ctx.from_dict(sizes)))
            )
            return abs(value - float(value_of_tree(form, values))) <= ROUNDING * abs(size)
        except (ValueError, ZeroDivisionError):
            return True

    def _poly(self, poly: Any) -> int:
        return _residue(poly(*self._point) if self._point else poly.leading_coefficient())

    def _tree(self, node: Node) -> int:
        found = self._known.get(node)
        if found is None:
            found = self._known[node] = self._evaluated(node) % PRIME
        return found

    def _evaluated(self, node: Node) -> int:
        match node:
            case Sum(terms):
                return sum(map(self._tree, terms))
            case Product(factors):
                product = 1
                for factor in factors:
                    product = product * self._tree(factor) % PRIME
                return product
            case Negative(argument):
                return -self._tree(argument)
            case Power(base, Number(exponent, 1)):
                return pow(self._tree(base), exponent, PRIME)
            case Quotient(numerator, denominator):
                return self._tree(numerator) * pow(self._tree(denominator), -1, PRIME)
            case Number(p, q):
                return p * pow(q, -1, PRIME)
        return self._poly(value_of(self.ring, node).poly)


def _is_transcendental(g: Generator) -> bool:
    return g.kind in ("root", "constant") or (g.kind == "function" and not is_sign(g.node))


def _residue(value: Any) -> int:
    """A rational number modulo the prime."""
    return int(value.p) * pow(int(value.q), -1, PRIME) % PRIME


def _random_point(ring: Ring) -> tuple[int, ...]:
    """A value for each generator."""
    random = Random(PRIME)  # noqa: S311 - the same point every time is wanted
    point = [-1 if is_sign(g.node) else random.randrange(1, PRIME) for g in ring.generators]
    for pair in ring.pairs:
        half = random.randrange(1, PRIME)  # the tangent of half the angle
        below = pow(1 + half * half, -1, PRIME)
        point[pair.sine], point[pair.cosine] = 2 * half * below % PRIME, (1 - half * half) * below % PRIME
    for index, denominator in ring.inverses.items():
        point[index] = pow(_residue(denominator(*point)), -1, PRIME)
    return tuple(point)


def plain_form(expr: Expr) -> Node:
    """The terms of an expression as they stand in its ring, nothing collected.

    >>> from dynsolve.algebra.angles import Angle
    >>> from dynsolve.algebra.ring_values import build_ring
    >>> from dynsolve.notation.python import to_python
    >>> ring = build_ring([("q1", "revolute")], [Symbol("l")], [Angle.of("q1")])
    >>> to_python(plain_form((ring.symbol("l") * 2 - ring.one) * ring.sin(Angle.of("q1"))))
    '2*sin(q1)*l - sin(q1)'
    """
    ring = expr.ring
    terms = []
    for exponents, factor in expr.poly.to_dict().items():
        parts = [
            (plain_form(Expr(ring, ring.inverses[g.index])), -int(e))
            if g.kind == "inverse"
            else (node_of(g, ring), int(e))
            for g, e in zip(ring.generators, exponents, strict=True)
            if e
        ]
        terms.append(times(Fraction(int(factor.p), int(factor.q)), parts))
    return total(terms)


def nested_form(expr: Expr) -> Node:
    """The terms generator by generator, what has one power of it in brackets: long values, for programs.

    >>> from dynsolve.algebra.ring_values import build_ring
    >>> from dynsolve.notation.python import to_python
    >>> ring = build_ring([("q1", "revolute")], [Symbol("l"), Symbol("m")], [])
    >>> l, m = ring.symbol("l"), ring.symbol("m")
    >>> to_python(nested_form(m * l * 2 + m * m * l + m))
    'l*(m**2 + 2*m) + m'
    """
    ring = expr.ring
    bases = [
        plain_form(Expr(ring, ring.inverses[g.index])) if g.kind == "inverse" else node_of(g, ring)
        for g in ring.generators
    ]
    signs = [-1 if g.kind == "inverse" else 1 for g in ring.generators]

    def form(terms: Mapping[tuple[int, ...], Fraction], k: int) -> Node:
        if k == len(bases):
            (factor,) = terms.values()
            return times(factor, [])
        by_power: dict[int, dict[tuple[int, ...], Fraction]] = {}
        for exponents, factor in terms.items():
            by_power.setdefault(int(exponents[k]), {})[exponents] = factor
        parts = {power: form(some, k + 1) for power, some in by_power.items()}
        return total([times(1, [(bases[k], signs[k] * e), (part, 1)] if e else [(part, 1)])
                      for e, part in parts.items()])  # fmt: skip

    found = {exponents: Fraction(int(f.p), int(f.q)) for exponents, f in expr.poly.to_dict().items()}
    return form(found, 0)


def node_of(g: Generator, ring: Ring) -> Node:
    """What a generator is printed as."""
    match g.kind:
        case "symbol":
            return Symbol(g.name, g.dots)
        case "sin" | "cos":
            return Function(g.kind, angle_node(g.angle, ring.names))
        case "constant":
            return Function("cos", angle_node(g.angle, ring.names))
    assert g.node is not None
    return Function("sqrt", g.node) if g.kind == "root" else g.node
