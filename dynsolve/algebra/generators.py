"""The generators of a ring: the variables of its polynomials, what each means, and how they are related.

    s² + c² = 1,   r² = radicand,   u·p = 1

Generators that a relation eliminates stand first in the lexicographic order, so that
each relation is a rewriting rule and the remainder of a division by it: s² becomes
1 - c², r² its radicand, and u·p becomes 1.  A pair (s, c) is there from the start;
roots and inverses are adjoined one by one while the ring is built.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from flint import fmpq_mpoly
from msgspec import Struct

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.ring_plan import RingPlan
from dynsolve.notation.tree import Function, Node


class Generator(Struct, frozen=True):
    """One variable of the polynomial ring.

    kind is one of `sin`, `cos` (with `angle`), `symbol` (with `name`, `dots`),
    `root` (√ of `node`), `inverse` (1 / a polynomial, set when first needed),
    `constant` (cos of a constant `angle` of some degrees) or `function` (`node`, a
    function that is no polynomial: the sign of a rate, or of an argument without an exact meaning here).
    """

    kind: str
    index: int
    name: str = ""
    dots: int = 0
    angle: Angle = Angle()
    node: Node | None = None


class Pair(Struct, frozen=True):
    """The sine and cosine of a basic angle, by the indices of their generators."""

    angle: Angle
    sine: int
    cosine: int


def is_sign(node: Node | None) -> bool:
    """Whether a function is the sign of a rate, sgn q̇: a generator that is 0 at rest."""
    return isinstance(node, Function) and node.name == "sgn"


def dotted(name: str, dots: int) -> str:
    """The plain name of a symbol or of its derivative: `theta1`, `theta1_dot`, `theta1_ddot`."""
    return f"{name}_{'d' * dots}ot" if dots else name


def lay_out(plan: RingPlan) -> tuple[Generator, ...]:
    """The generators of a ring: those that a relation eliminates first, the plain symbols last."""
    laid: list[Generator] = []

    def add(kind: str, **what: Any) -> None:
        laid.append(Generator(kind, len(laid), **what))

    for _ in range(plan.inverses):
        add("inverse")
    for kind in ("sin", "cos"):
        for angle in plan.basic_angles:
            add(kind, angle=angle)
    for node in reversed(plan.roots):
        add("root", node=node)
    if plan.constants.generator_degrees is not None:
        add("constant", angle=Angle((), plan.constants.generator_degrees))
    for dots in (2, 1, 0):
        for name in (*plan.coordinates, *(plan.references if dots else ())):
            add("symbol", name=name, dots=dots)
    for function in plan.functions:
        add("function", node=function)
    for name in plan.symbols:  # last, so that further parameters leave the places of the others as they are
        if name not in plan.coordinates:
            add("symbol", name=name)
    return tuple(laid)


def sine_cosine_pairs(generators: Sequence[Generator]) -> tuple[Pair, ...]:
    """The sines and cosines among the generators, angle by angle."""
    sines = [g for g in generators if g.kind == "sin"]
    cosines = [g for g in generators if g.kind == "cos"]
    return tuple(Pair(s.angle, s.index, c.index) for s, c in zip(sines, cosines, strict=True))


# -- the relations, and the normal form modulo them -------------------------------------------------


class Relations:
    """The rewriting rules of one ring, each with the index of the generator that it eliminates.

    `radicands` are what stands under the roots, `inverses` what the generators of
    inverses invert, by the generator's index.
    """

    def __init__(self, generators: Sequence[fmpq_mpoly], pairs: Sequence[Pair]) -> None:
        self._generators = generators
        self._pairs = [(p.sine, generators[p.sine] ** 2 + generators[p.cosine] ** 2 - 1) for p in pairs]
        self._cosines = [(p.sine, p.cosine) for p in pairs]
        self._roots: list[tuple[int, int, fmpq_mpoly]] = []
        self._inverses: list[tuple[int, fmpq_mpoly]] = []
        self.radicands: dict[int, fmpq_mpoly] = {}
        self.inverses: dict[int, fmpq_mpoly] = {}

    def adjoin_constant(self, index: int, degree: int, minimal: fmpq_mpoly) -> None:
        """Make a generator a zero of its minimal polynomial of some degree."""
        self._roots.append((index, degree, minimal))

    def adjoin_root(self, index: int, radicand: fmpq_mpoly) -> None:
        """Make a generator the square root of a polynomial in generators that stand after it."""
        self.radicands[index] = radicand
        self._roots.insert(0, (index, 2, self._generators[index] ** 2 - radicand))

    def adjoin_inverse(self, index: int, inverted: fmpq_mpoly) -> None:
        """Make a generator 1 / a polynomial."""
        self.inverses[index] = inverted
        self._inverses.append((index, self._generators[index] * inverted - 1))

    def of(self, places: Iterable[int]) -> Iterator[fmpq_mpoly]:
        """The relations of some generators, and of those that occur in these."""
        known = dict((*self._pairs, *((i, poly) for i, _, poly in self._roots), *self._inverses))
        both = {cosine: sine for sine, cosine in self._cosines}
        waiting = [both.get(place, place) for place in places]
        while waiting:
            poly = known.pop(waiting.pop(), None)
            if poly is not None:
                yield poly
                waiting += [both.get(i, i) for i, degree in enumerate(poly.degrees()) if degree > 0]

    def reduce(self, poly: fmpq_mpoly) -> fmpq_mpoly:
        """The normal form of a polynomial."""
        if not self._pairs and not self._roots and not self._inverses:
            return poly
        poly = self.reduce_roots(poly)
        degrees = poly.degrees()
        for index, relation in self._pairs:
            if degrees[index] > 1:
                poly %= relation
        if self._inverses:
            poly = self._without_inverses(poly)
        return poly

    def reduce_roots(self, poly: fmpq_mpoly) -> fmpq_mpoly:
        """A polynomial with √3² = 3, and s² + c² as it stands."""
        for index, degree, relation in self._roots:
            if poly.degrees()[index] >= degree:
                radicand = self.radicands.get(index)
                if radicand is None or radicand.is_constant():
                    poly %= relation
                else:
                    poly = self._lowered(poly, index, radicand)
        return poly

    def _lowered(self, poly: fmpq_mpoly, index: int, radicand: fmpq_mpoly) -> fmpq_mpoly:
        """A polynomial with √p² = p, also where p has generators that stand before the root."""
        parts: dict[int, dict[tuple[int, ...], Any]] = {}
        for exponents, factor in poly.to_dict().items():
            times, left = divmod(int(exponents[index]), 2)
            rest = tuple(left if i == index else int(e) for i, e in enumerate(exponents))
            parts.setdefault(times, {})[rest] = factor
        lowered = (poly.context().from_dict(part) * radicand**times for times, part in parts.items())
        return sum(lowered, start=poly * 0)

    def _without_inverses(self, poly: fmpq_mpoly) -> fmpq_mpoly:
        before = None
        while poly != before:
            before = poly
            degrees = poly.degrees()
            for index, relation in self._inverses:
                if degrees[index]:
                    poly %= relation
            for index, relation in self._pairs:
                if degrees[index] > 1:
                    poly %= relation
        return poly

    def rationalized(self, poly: fmpq_mpoly) -> tuple[Any, Any] | None:
        """(conjugate, norm) where a square root occurs: 1/(a + b√2) = (a - b√2)/(a² - 2b²)."""
        degrees = poly.degrees()
        for index, degree, _ in self._roots:
            if degree == 2 and degrees[index]:
                conjugate = poly.compose(
                    *(-g if i == index else g for i, g in enumerate(self._generators)), ctx=poly.context()
                )
                return conjugate, self.reduce(poly * conjugate)
        return None
