"""The relations of a ring, and the normal form modulo them.

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

from dynsolve.algebra.generators import Pair


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
        degrees = poly.degrees()
        for index, relation in self._pairs:
            if degrees[index] > 1:
                poly %= relation
        poly = self.reduce_roots(poly)
        if self._inverses:
            poly = self._without_inverses(poly)
        return poly

    def reduce_roots(self, poly: fmpq_mpoly) -> fmpq_mpoly:
        """A polynomial with √3² = 3, and s² + c² as it stands."""
        for index, degree, relation in self._roots:
            if poly.degrees()[index] >= degree:
                poly %= relation
        return poly

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
