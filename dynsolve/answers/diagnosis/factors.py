"""The factors that are mistaken for one another: pairs (written, wanted), and division by their difference.

An answer in which rest · written stands where rest · wanted belongs is off by
rest · (wanted - written): this difference divides what it is off by, and the quotient is the
rest of the term.  Sines are only up to the first power in normal form, so that a divisor is
made free of them first, by its conjugates: (c - s)(c + s) = 2c² - 1.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import cached_property
from itertools import combinations, permutations

from msgspec import Struct

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.generators import Generator
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.errors import AlgebraError

MOST_SYMBOLS = 16
"""Of more symbols in a difference none is looked for in the place of another."""

MOST_ANGLES = 14
"""So many angles are held against each other."""

Pair = tuple[Expr, Expr]
"""Two factors, each of which may stand where the other belongs."""

Found = tuple[Pair, str, Expr]
"""Two factors, what it is called when one stands for the other, and the rest of the term."""


class Divisor(Struct, frozen=True):
    """The difference of two factors, made free of sines: `norm` is it times its conjugates."""

    conjugates: Expr
    norm: Expr

    def quotient(self, off: Expr) -> Expr | None:
        """off / the difference, None where it does not divide."""
        return (off * self.conjugates).quotient(self.norm)


class FactorPairs:
    """The pairs of factors of one ring that people mistake for one another."""

    def __init__(self, ring: Ring) -> None:
        self.ring = ring
        self._divisors: dict[int, Divisor] = {}

    # -- symbols -----------------------------------------------------------------------------------

    def of_symbols(self, off: Expr) -> Iterator[Found]:
        """Pairs of symbols whose difference divides what an answer is off by, with the quotient."""
        generators = [self.ring.generators[i] for i in off.used]
        symbols = [g for g in generators if g.kind in ("symbol", "function") and g.name != "pi"]
        if len(symbols) > MOST_SYMBOLS:
            return
        for a, b in self._symbol_pairs(symbols):
            quotient = off.quotient(a - b)
            if quotient is not None:
                yield (a, b), "", quotient

    def _symbol_pairs(self, symbols: list[Generator]) -> Iterator[Pair]:
        one = self.ring.one
        for g in symbols:
            x = self.ring.generator(g.index)
            yield x, one
            yield x * x, one
        for g, h in combinations(symbols, 2):
            if (g.dots == h.dots) != (g.name == h.name):
                x, y = self.ring.generator(g.index), self.ring.generator(h.index)
                yield x, y
                yield x * x, y * y
        yield from self._renumbered(symbols)

    def _renumbered(self, symbols: list[Generator]) -> Iterator[Pair]:
        """Two symbols with one index for those with another: m₃ l_c3 for m₄ l_c4."""
        by_letters: dict[str, dict[str, Expr]] = {}
        for g in symbols:
            letters = "".join(c for c in g.name if not c.isdigit())
            number = "".join(c for c in g.name if c.isdigit())
            if not g.dots and number:
                by_letters.setdefault(letters, {})[number] = self.ring.generator(g.index)
        for first, second in permutations(by_letters.values(), 2):
            for here, there in combinations(sorted(first.keys() & second.keys()), 2):
                for power in (1, 2):
                    yield first[here] * second[here] ** power, first[there] * second[there] ** power

    # -- sines and cosines -------------------------------------------------------------------------

    def of_functions(self, off: Expr) -> Iterator[Found]:
        """Pairs of sines and cosines whose difference divides what an answer is off by, with the quotient."""
        here = self._angles_in(off)
        at_a_point: dict[frozenset[int], Expr] = {}
        for place, (pair, code, angles) in enumerate(self._function_pairs if here else ()):
            if not angles <= here:
                continue
            divisor = self._divisor(place)
            if angles not in at_a_point:
                at_a_point[angles] = self._at_a_point(off, angles)
            if divisor.quotient(at_a_point[angles]) is not None:
                quotient = divisor.quotient(off)
                if quotient is not None:
                    yield pair, code, quotient

    def of_strange_functions(self, off: Expr) -> Iterator[Found]:
        """Functions whose argument is no angle, for which a sine or cosine belongs."""
        for g in (self.ring.generators[i] for i in off.used):
            if g.kind == "function":
                written = self.ring.generator(g.index)
                rest = Expr(self.ring, -off.poly.derivative(g.index))
                for wanted in self._functions:
                    if off == rest * (wanted - written):
                        yield (wanted, written), "", rest

    def _angles_in(self, *values: Expr) -> frozenset[int]:
        """The basic angles whose sine or cosine occurs."""
        here = {i for value in values for i in value.used}
        return frozenset(k for k, pair in enumerate(self.ring.pairs) if {pair.sine, pair.cosine} & here)

    def _at_a_point(self, off: Expr, angles: frozenset[int]) -> Expr:
        """What an answer is off by with numbers for all but some angles: if it divides, so does this."""
        images = {}
        for g in self.ring.generators:
            if g.kind == "symbol":
                images[g.index] = self.ring.constant(7 * g.index + 3).poly
        for k, pair in enumerate(self.ring.pairs):
            if k not in angles:
                t = Fraction(k + 2, k + 5)
                images[pair.sine] = self.ring.constant(2 * t / (1 + t * t)).poly
                images[pair.cosine] = self.ring.constant((1 - t * t) / (1 + t * t)).poly
        return off.ring.put(off, images)

    def _divisor(self, place: int) -> Divisor:
        """The difference of a pair of functions, made free of sines; each is made once."""
        if place not in self._divisors:
            (a, b), _, angles = self._function_pairs[place]
            norm, conjugates = a - b, self.ring.one
            for pair in (self.ring.pairs[k] for k in angles):
                if pair.sine in norm.used:
                    turned = norm.ring.put(norm, {pair.sine: -self.ring.generator(pair.sine).poly})
                    conjugates, norm = conjugates * turned, norm * turned
            self._divisors[place] = Divisor(conjugates, norm)
        return self._divisors[place]

    @cached_property
    def _function_pairs(self) -> tuple[tuple[Pair, str, frozenset[int]], ...]:
        """The pairs of sines and cosines, their names, and the basic angles that they hold."""
        pairs = (((a, b), code) for (a, b), code in self._make_pairs() if a != b)
        return tuple((pair, code, self._angles_in(*pair)) for pair, code in pairs)

    def _make_pairs(self) -> Iterator[tuple[Pair, str]]:
        """The pairs with what it is called when the first stands for the second, or the second for it."""
        one, zero, angles = self.ring.one, self.ring.zero, self._angles()
        functions = [(angle, self.ring.sin(angle), self.ring.cos(angle)) for angle in angles]
        for _, s, c in functions:
            yield from (((f, one), "") for f in (s, s * s, c, c * c))
            yield from ((pair, "sin_for_cos") for pair in ((s, c), (s, zero - c), (s * s, c * c)))
        for (first, s, c), (second, t, d) in combinations(functions, 2):
            code = "angle_product" if _is_product(first) or _is_product(second) else "angle"
            pairs = (s, t), (s, zero - t), (c, d), (c, zero - d), (s * s, t * t), (c * c, d * d)
            yield from ((pair, code) for pair in pairs)
        for double in filter(None, (self._held(angle * 2) for angle in angles)):
            yield (self.ring.cos(double), one), "double_angle"

    @property
    def _functions(self) -> Iterator[Expr]:
        for angle in self._angles():
            yield from (self.ring.sin(angle), self.ring.cos(angle))

    def _angles(self) -> list[Angle]:
        """The angles of joints, and sums of them, that stand in formulas of this robot."""
        basic = [pair.angle for pair in self.ring.pairs if pair.angle.terms]
        found = list(basic)
        found += [Angle.of(name) for name in self.ring.names]
        found += [a - b for a, b in combinations(basic, 2)] + [a + b for a, b in combinations(basic, 2)]
        found += [angle * 2 for angle in (*basic, *map(Angle.of, self.ring.names))]
        kept: list[Angle] = []
        for angle in found:
            if self._held(angle) is not None and angle not in kept and -angle not in kept:
                kept.append(angle)
        return kept[:MOST_ANGLES]

    def _held(self, angle: Angle) -> Angle | None:
        """The angle, None where the ring does not hold its sine and cosine."""
        try:
            self.ring.sin(angle)
        except AlgebraError:
            return None
        return angle


def _is_product(angle: Angle) -> bool:
    return any(len(atom) > 1 for atom, _ in angle.terms)
