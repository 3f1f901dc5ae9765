"""The compact form of exact expressions; see the text of this package for its steps.

A polynomial is collected by velocities and accelerations, each coefficient by masses
or by sines and cosines, an angle group at a time from the base outwards, and what is
left by parameters.  Where two orders of collecting compete (velocities outside or
inside, masses outside or inside), the result with fewer operations is taken.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import partial
from itertools import accumulate, chain
from operator import mul

from dynsolve.algebra.compact.atoms import Rank, RingAtoms
from dynsolve.algebra.compact.collect import SMALLEST_PRODUCT, Collector
from dynsolve.algebra.compact.proof import Proof, plain_form
from dynsolve.algebra.compact.spelling import Speller
from dynsolve.algebra.compact.terms import (
    MASSES,
    RATES,
    SYMBOLS,
    Monomial,
    Parts,
    Polynomial,
    Product,
    Rational,
    Terms,
    add_term,
    common,
    divide,
    exact,
    homogeneous,
    multiply,
    primitive,
    split_at,
    square_in,
    whole_content,
)
from dynsolve.algebra.compact.trig_forms import AngleGroup, angle_groups
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import has_value, value_of
from dynsolve.errors import attempted, warn_left_out
from dynsolve.notation import tree
from dynsolve.notation.build import split_sign, summands, times, total
from dynsolve.notation.tree import ZERO, Node, names_in, walk

MUCH_CHEAPER = 0.75
"""Energies, momenta, torques stay collected by velocities unless another order costs less than this part."""

LONG = 60
"""From this number of operations on a momentum, an entry of C or a row of D q̈ takes the cheaper order."""

SMALLEST_SQUARE = 3
"""The terms of (a c₂ + b c₂₃)², multiplied out."""

MOST_SIZES = 24
"""So many numbers before a square are tried: in a file of many numbers none is seen to be meant."""

HIGHEST_POWER = 8
"""Up to this power sums that were typed are found again."""

MOST_OF_PRODUCT = 20
"""Up to this number of terms products of sums are looked for: of PUMA 560 none has more than ten."""

LARGE = 60
"""From this number of terms on one way of collecting is tried and not two."""


class Compactor:
    """Writes exact expressions of one ring as a person would.

    `leading` names the masses and moments of inertia in the order in which a sum
    mentions them; `parallel` are groups of coordinates that turn about parallel axes;
    `decimal` says that numbers are decimals, which are not drawn out of sums, unless that leaves those
    that were `typed`;
    `spelled` are sums as they are written wherever they are a factor, of rates up to their sign;
    `radii` are distances from axes, the squares of which are looked for beside masses;
    `angles_outside` that masses are never collected outside sines and cosines; from `large` terms
    on one way of collecting is tried and not two.

    >>> from dynsolve.algebra.angles import Angle
    >>> from dynsolve.algebra.ring_values import build_ring
    >>> from dynsolve.notation.python import to_python
    >>> from dynsolve.notation.tree import Symbol
    >>> ring = build_ring([("q1", "revolute")], [Symbol("l")], [Angle.of("q1")])
    >>> s, c, l = ring.sin(Angle.of("q1")), ring.cos(Angle.of("q1")), ring.symbol("l")
    >>> to_python(Compactor(ring).form(l * c * c - l * s * s))
    'l*cos(2*q1)'
    """

    def __init__(
        self,
        ring: Ring,
        leading: Iterable[str] = (),
        parallel: Iterable[Iterable[str]] = (),
        *,
        decimal: bool = False,
        typed: Collection[Rational] = (),
        spelled: Collection[tree.Sum] = (),
        radii: Sequence[Expr] = (),
        angles_outside: bool = False,
        large: int = LARGE,
    ) -> None:
        self.ring = ring
        self._radii = radii
        self._of_radii: list[tuple[Rational, Monomial, Terms]] = []
        self._groups = angle_groups(ring, parallel)
        self._atoms = RingAtoms(ring, leading, self._groups, self.form)
        self.collector = Collector(self._atoms.table, decimal=decimal, typed=typed, spelled=spelled)
        self._proof = Proof(ring)
        spelled = [one for one in spelled if has_value(ring, one)]  # not those of another matrix
        self._of_rates = [one for one in spelled if any(getattr(part, "dots", 0) for part in walk(one))]
        self._spelled = [one for one in spelled if one not in self._of_rates]
        self.in_one_spelling = Speller(self._spelled)
        self._apart = [i for i, part in enumerate(self._atoms.parts) if part in (MASSES, RATES)]
        self._moving = [g.index for g in ring.generators if g.kind in ("sin", "cos") or g.name in ring.names]
        self._given = list(self._moving_sums(frozenset(leading)))
        self._angles_outside = angles_outside
        self._large = large
        # The entries of D and C come again in the steps and in τ; a 7R arm would take a sixth longer without.
        self._forms: dict[str, Node] = {}
        self._made: dict[tuple[str, frozenset[tuple[Parts, Rational]]], Node] = {}

    # -- the entrance ------------------------------------------------------------------------------

    def form(self, expr: Expr) -> Node:
        """The compact tree of an expression; its plain form where that is not equal to its value."""
        if expr.is_zero:
            return ZERO
        own = self.ring.generators
        if expr.ring is not self.ring and expr.ring.generators[: len(own)] != own:
            raise ValueError("in another ring the same generators stand for something else")
        key = str(expr.poly)
        found = self._forms.get(key)
        if found is None:
            plain = partial(plain_form, expr)
            found = attempted(partial(self._collected, expr), plain, "a compact form")
            if not self._proof.holds(expr, found):
                warn_left_out("a compact form", "it is not equal to its value")
                found = plain()
            self._forms[key] = found
        return found

    def _collected(self, expr: Expr) -> Node:
        if self._radii:
            radii, self._radii = self._radii, ()  # their own forms are made without them
            self._of_radii = list(self._products_of_radii(radii))
        moving, still = list[Node](), list[Node]()
        for drawn, power in self._given:
            expr, beside = self._drawn(expr, drawn, power)
            if not beside.is_zero:
                number, mono = self.collector.decompose(self._coefficient(self._terms(beside)))
                factors = [(self._atoms.table.nodes[atom], e) for atom, e in mono]
                found = times(number, [*factors, drawn], decimal=self.collector.decimal)
                (moving if drawn[0] in self._of_rates else still).append(found)
        rest = self._by_rates({} if expr.is_zero else self._terms(expr), moving)
        return self.in_one_spelling(total([rest, *still]))

    def _terms(self, expr: Expr) -> Terms:
        return self._atoms.terms(str(expr.poly))

    def matrix(self, matrix: Matrix) -> tree.Matrix:
        """The compact trees of a matrix's entries."""
        return tree.Matrix(tuple(tuple(map(self.form, row)) for row in matrix.rows))

    def _once(self, make: Callable[[Terms], Node], terms: Terms) -> Node:
        """What is made of terms, once: the pieces of expressions come again in others."""
        key = make.__name__, frozenset(terms.items())
        found = self._made.get(key)
        if found is None:
            found = self._made[key] = make(terms)
        return found

    # -- deflections -------------------------------------------------------------------------------

    def _moving_sums(self, leading: Collection[str]) -> Iterator[tuple[tuple[Node, int], Expr]]:
        """The powers of spelled sums in which a coordinate stands, the highest first, each with its value."""
        for one in self._spelled:
            names = names_in(one)
            if not names.isdisjoint(self.ring.names) and names.isdisjoint(leading):
                powers = list(accumulate([value_of(self.ring, one)] * HIGHEST_POWER, mul))
                yield from reversed([((one, e), power) for e, power in enumerate(powers, start=1)])
        for one in self._of_rates:
            yield (one, 1), value_of(self.ring, one)

    def _drawn(self, expr: Expr, drawn: tuple[Node, int], power: Expr) -> tuple[Expr, Expr]:
        """(the rest, what the power of a sum has beside it): k a, where k a (a x - b y) has all its terms."""
        beside = self.ring.zero
        if len(power) > len(expr):
            return expr, beside
        terms = power.poly.to_dict()
        first = min(terms, key=lambda exponents: sum(exponents[i] for i in self._moving))
        needed = [(i, e) for i, e in enumerate(first) if e]
        for exponents, f in expr.poly.to_dict().items():
            if any(exponents[i] < e for i, e in needed):
                continue
            quotient = [e - own for e, own in zip(exponents, first, strict=True)]
            if any(quotient[i] for i in self._apart):
                continue
            size = Expr(self.ring, self.ring.ctx.from_dict({tuple(quotient): f / terms[first]}))
            product = size * power
            is_alone = drawn[1] == 1 and size.is_number and abs(size.number) == 1
            if not is_alone and len(expr - product) == len(expr) - len(product):
                expr -= product
                beside += size
        return expr, beside

    # -- velocities and accelerations --------------------------------------------------------------

    def _by_rates(self, terms: Terms, drawn: Sequence[Node]) -> Node:
        """The terms with accelerations, those with velocities and all others, each collected separately.

        What was `drawn` out with velocities stands after these.
        """
        if not any(e[RATES] for e in terms):
            return total([*drawn, self._coefficient(terms)] if terms else drawn)
        kinds: dict[tuple[int, int], Terms] = {}
        of_rates = {number: self._atoms.kind_of_rates(number) for number in {e[RATES] for e in terms}}
        for e, f in terms.items():
            kinds.setdefault(of_rates[e[RATES]], {})[e] = f
        found = {kind: self._one_kind(part, kind) for kind, part in sorted(kinds.items(), reverse=True)}
        still = found.pop((0, 0), ZERO)
        return total([*found.values(), *drawn, still])

    def _one_kind(self, terms: Terms, kind: tuple[int, int]) -> Node:
        """Velocities outside; or angles outside and velocities inside, where that is much cheaper."""
        if kind == (0, 2) and not self.collector.decimal and self._is_energy(terms):
            half = Fraction(1, 2)  # an energy: its ½ in front
            terms = {e: exact(f, half) for e, f in terms.items()}
            return times(half, [(self._outside_or_inside(terms, kind), 1)])
        return self._outside_or_inside(terms, kind)

    def _is_energy(self, terms: Terms) -> bool:
        """Whether a square has a factor ½, m (l q̇)²/2: in a force only what is no square has one."""
        return any(f.denominator % 2 == 0 and self._atoms.is_square(e) for e, f in terms.items())

    def _outside_or_inside(self, terms: Terms, kind: tuple[int, int]) -> Node:
        split = split_at(terms, RATES)
        parts = self._grouped(self._monomials(split), self._coefficient)
        if kind == (1, 0) and len(terms) <= self._large:
            row = self.collector.side_by_side(parts)
            if self.collector.cost(row) <= LONG:
                return row
        outside = self.collector.sum_of(parts)
        if len(split) == 1:
            return outside
        squares = self._squares_of_sums(split) if kind == (0, 2) else None
        if squares is not None:
            squared = self.collector.apart(self._grouped(squares.items(), self._coefficient))
            if self.collector.cost(squared) < self.collector.cost(self.collector.apart(parts)):
                return squared
        if len(terms) <= self._large:
            inside = self._by_angles(terms)
            cost = self.collector.cost
            has_masses = any(e[MASSES] for e in terms)
            shortest = kind == (0, 1) and (not has_masses or cost(outside) > LONG)
            if cost(inside) < cost(outside) * (1 if shortest else MUCH_CHEAPER):
                return inside
        return self.collector.apart(parts)

    def _squares_of_sums(self, split: Mapping[int, Terms]) -> dict[Monomial, Terms] | None:
        """a q̇₁² + 2b q̇₁ q̇₂ + b q̇₂² as b (q̇₁ + q̇₂)² + (a - b) q̇₁², where that has fewer terms; else None."""
        parts = dict(self._monomials(split))
        squares = [mono for mono in parts if len(mono) == 1]
        found: dict[Monomial, Terms] = {}
        for mono in reversed(squares):
            square, ((last, _),) = parts.get(mono, {}), mono
            beside = {other: part for other, part in parts.items() if other != mono and last in dict(other)}
            key, size = primitive(square) if square else (None, 1)
            made = {other: primitive(part) for other, part in beside.items()}
            if not beside or any(own != key for own, _ in made.values()):
                continue
            rates: dict[int, Rational] = {last: 1}
            for other, (_, f) in made.items():
                ((rate, _),) = divide(other, ((last, 1),))
                rates[rate] = exact(f, 2 * size)
            rest = {other: dict(part) for other, part in parts.items()}
            for x, f in rates.items():
                for y, g in rates.items():
                    for e, h in square.items():
                        add_term(rest.setdefault(multiply(((x, 1),), ((y, 1),)), {}), e, -f * g * h)
            rest = {other: part for other, part in rest.items() if part}
            if sum(map(len, rest.values())) + len(square) < sum(map(len, parts.values())):
                node = self.collector.form({((x, 1),): f for x, f in rates.items()})
                found[((self._atoms.table.number(node), 2),)], parts = square, rest
        return found | parts if found else None

    def _merged(self, split: Mapping[int, Terms], form: Callable[[Terms], Node]) -> Node:
        """Σ part · monomial, where monomials whose parts differ by a rational factor are summed first."""
        return self.collector.sum_of(self._grouped(self._monomials(split), form))

    def _monomials(self, split: Mapping[int, Terms]) -> Iterator[tuple[Monomial, Terms]]:
        return ((self._atoms.monomials.values[number], part) for number, part in split.items())

    def _grouped(
        self, parts: Iterable[tuple[Monomial, Terms]], form: Callable[[Terms], Node]
    ) -> list[tuple[Rational, Monomial, Node]]:
        """(factor, monomial, form of a part); a part that is a number goes into the coefficient."""
        numbers: list[tuple[Rational, Monomial, Node]] = []
        shared: dict[object, tuple[Terms, Rational, Polynomial]] = {}
        for mono, part in parts:
            if len(part) == 1:
                ((others, number),) = part.items()
                if not any(others):
                    numbers.append((number, mono, tree.ONE))
                    continue
            key, scale = primitive(part)
            _, own, factors = shared.setdefault(key, (part, scale, {}))
            factors[mono] = exact(scale, own)
        sums = (self._one_product(part, factors, form) for part, _, factors in shared.values())
        return [*numbers, *sums]

    def _one_product(
        self, part: Terms, factors: Polynomial, form: Callable[[Terms], Node]
    ) -> tuple[Rational, Monomial, Node]:
        """(factor, monomial, form) of part · Σ factors, with no decimal in front of two sums.

        1.3 g and 3 g are g (1.3 s₁ + 3 s₁₂), and 0.5 (0.4 a + 0.6 b)(2q̇₁ q̇₂ + q̇₂²) has 0.2 a + 0.3 b.
        """
        node = form(part)
        if not self.collector.decimal:
            return *self.collector.whole(factors, split_sign(node)[0]), node
        alike, _ = self.collector.decompose(node)
        if alike != 1:
            factors = {mono: exact(f * alike, 1) for mono, f in factors.items()}
            part = {e: exact(f, alike) for e, f in part.items()}
        number, mono = self.collector.whole(factors, 1)
        if abs(number) != 1 and len(part) > 1:
            part, number = {e: exact(f * number, 1) for e, f in part.items()}, 1
        return number, mono, form(part)

    # -- coefficients: no velocities ---------------------------------------------------------------

    def _coefficient(self, terms: Terms) -> Node:
        """The cheaper of two: angles outside and masses inside, or masses outside."""
        if self._angles_outside:
            return self._by_angles(terms)
        if len(terms) <= self._large or self.collector.decimal:
            return self._once(self._in_cheaper_order, terms)
        scale = whole_content(terms.values())
        if next(reversed(terms.values())) < 0:
            scale = -scale
        whole = {e: exact(f, scale) for e, f in terms.items()}
        return times(scale, [(self._once(self._in_cheaper_order, whole), 1)])

    def _in_cheaper_order(self, terms: Terms) -> Node:
        shared, rest = self._without_common(terms)
        size, rest = self._usual(rest)
        found = self._by_angles(rest)
        if len(terms) <= self._large and any(e[MASSES] for e in terms):
            found = min(self._by_masses(rest), found, key=self._cost_without_sign)
        elif (squared := self._by_radii(rest)) is not None:
            found = min(squared, found, key=self.collector.cost)
        if size != 1:
            found = self.collector.sum_of([(size, (), found)])
        found = min(self._typed_square(rest) or found, found, key=self.collector.cost)
        return self.collector.sum_of([(*shared, found)])

    def _cost_without_sign(self, node: Node) -> int:
        """The operations of a tree but for a minus before it: a sum and its negative have one form."""
        return self.collector.cost(split_sign(node)[1])

    def _typed_square(self, terms: Terms) -> Node | None:
        """0.5 (0.2 + 0.3 c₂)², where numbers were typed that make a square of the terms; else None."""
        typed = {*self.collector.typed, 1} if self.collector.typed else set()
        if not SMALLEST_SQUARE <= len(terms) <= LARGE or any(e[MASSES] or e[RATES] for e in terms):
            return None
        squares = [f for e, f in terms.items() if f > 0 and self._atoms.is_square(e)]
        sizes = {exact(f, root * root) for f in squares for root in typed}
        for size in sorted(sizes) if len(sizes) <= MOST_SIZES else ():
            whole = {e: exact(f, size) for e, f in terms.items()}
            for completed in (False, True):
                square = self._with_square(whole, completed=completed)
                if isinstance(square, tree.Power) and isinstance(square.base, tree.Sum):
                    numbers = {abs(self.collector.decompose(term)[0]) for term in square.base.terms}
                    if numbers <= typed:
                        return self.collector.product(size, (), (square,))
        return None

    def _usual(self, terms: Terms) -> tuple[Rational, Terms]:
        """(size, terms / size): a polynomial and twice it are spelled alike.

        The size is the largest factor of a square of lengths, where that is the same beside each mass; where
        there is no square, that of most terms; so too of moments beside a mass, 2(m l²/4 + I₁ - I₂).
        None is taken that would make finer fractions than halves of what they are, nor of squares alone,
        m (h² + 3r²) c/12.
        """
        if self.collector.decimal or len(terms) > LARGE:
            return 1, terms
        sizes: dict[Parts, Rational] = {e: f if f > 0 else -f for e, f in terms.items()}
        squares = {e: f for e, f in sizes.items() if e[SYMBOLS] and self._atoms.is_square(e[SYMBOLS:])}
        if len(squares) == len(terms):
            return 1, terms
        of_masses: dict[int, Rational] = {e[MASSES]: 0 for e in terms}
        for e, f in squares.items():
            of_masses[e[MASSES]] = max(f, of_masses[e[MASSES]])
        counts = Counter(sizes.values())
        size = max(counts, key=lambda f: (counts[f], f))
        if len(set(of_masses.values())) > 1:
            has_fraction = whole_content(terms.values()).denominator > 1
            if not has_fraction or size.numerator == 1 or 2 * counts[size] <= len(terms):
                return 1, terms
        elif squares:
            size = max(squares.values())
        rest = {e: exact(f, size) for e, f in terms.items()}
        finer = whole_content(rest.values()).denominator > 2 * whole_content(terms.values()).denominator
        return (1, terms) if finer else (size, rest)

    def _without_common(self, terms: Terms) -> tuple[tuple[Rational, Monomial], Terms]:
        """(the parameters and numbers that all terms share, the rest): l² + l a c keeps its l.

        What they share of a length is drawn out too beside a square: b² (l² + l a c) is b² l (l + a c).
        """
        factor = self.collector.content(terms.values())
        denominators = {f.denominator for f in terms.values()}
        if factor.denominator != 1 and len(denominators) > 1 and len({e[MASSES] for e in terms}) > 1:
            factor = 1  # m₁ r²/2 + m₂ l²/12
        values = self._atoms.monomials.values
        shared: Monomial = ()
        left: dict[int, int] = {}
        for place in (MASSES, SYMBOLS):
            found = {e[place] for e in terms}
            drawn = self._shared([values[number] for number in found])
            left |= {number: self._atoms.monomials.number(divide(values[number], drawn)) for number in found}
            shared += drawn
        if self.collector.has_root(shared):
            factor = whole_content(terms.values())
        if factor == 1 and not shared:
            return (1, ()), terms
        rest = {
            (*e[:MASSES], left[e[MASSES]], left[e[SYMBOLS]], 0): exact(f, factor) for e, f in terms.items()
        }
        return (factor, shared), rest

    def _shared(self, monos: Sequence[Monomial]) -> Monomial:
        """The powers that all have; beside a square of a length the lengths that all have in some power."""
        same = set.intersection(*map(set, monos)) - self._atoms.roots_of_sums
        ranks = self._atoms.table.ranks
        if any(ranks[atom][0] is Rank.PARAMETER and e != 1 for atom, e in same):
            same |= {power for power in common(monos) if ranks[power[0]][0] is Rank.PARAMETER}
        return tuple(sorted(same))

    def _by_masses(self, terms: Terms) -> Node:
        """Σ mass · factor; masses with equal factors are summed first."""
        return self._merged(split_at(terms, MASSES), partial(self._once, self._beside_mass))

    def _beside_mass(self, terms: Terms) -> Node:
        """The factor of a mass: with a square where that is no longer, completed where it is shorter."""
        size, terms = self._usual(terms)
        cost, best = self.collector.cost, self._by_angles(terms)
        squared = self._with_square(terms)
        if squared is not None and cost(squared) <= cost(best):
            best = squared
        completed = self._with_square(terms, completed=True)
        inside, product = self._squares_inside(terms), self._product_of_sums(terms)
        for other in (completed, inside, product, self._by_radii(terms)):
            if other is not None and cost(other) < cost(best):
                best = other
        return best if size == 1 else self.collector.product(size, (), (best,))

    def _squares_inside(self, terms: Terms) -> Node | None:
        """(e - l s₃)² + c₂² (a + l c₃)²: squares beside what stands there of the first of several groups."""
        g, terms = self._from_next_group(terms)
        if not any(any(e[1:MASSES]) for e in terms):
            return None
        split = split_at(terms, -len(next(iter(terms))))
        if all(len(part) < SMALLEST_SQUARE for part in split.values()):
            return None
        parts = []
        for number, part in split.items():
            sign, trig = self._atoms.basic_trig_monomial(self._groups[g].powers.values[number], g)
            parts.append((sign, trig, self._once(self._beside_mass, part)))
        return self.collector.sum_of(parts)

    def _products_of_radii(self, radii: Iterable[Expr]) -> Iterator[tuple[Rational, Monomial, Terms]]:
        """(number, monomial, terms) of the squares of radii, and of their products with their slopes."""
        for radius in radii:
            if sum(split_sign(term)[0] for term in summands(self.form(radius))) < 0:
                radius = -radius
            slopes = [self.ring.diff(radius, k) for k in range(len(self.ring.names))]
            for other in dict.fromkeys((radius, *slopes)):
                if len(product := radius * other) >= SMALLEST_SQUARE:
                    factors = tree.Product((self.form(radius), self.form(other)))
                    yield *self.collector.decompose(factors), self._terms(product)

    def _by_radii(self, terms: Terms) -> Node | None:
        """(√3 q₂/2 + a + l c₃)² + l² s₄²: the product of a radius that leaves the shortest rest, and that."""
        if not (self._of_radii and SMALLEST_SQUARE <= len(terms) <= LARGE):
            return None
        width, found = len(next(iter(terms))), list[Node]()
        for number, mono, product in self._of_radii:
            own = {e[-width:]: f for e, f in product.items()}
            if any(any(e[:-width]) for e in product) or not terms.keys() >= own.keys():
                continue  # of (a + b c)² + (b s)² and a² + b² + 2a b c the second is taken
            ((k, _),) = Counter(exact(terms[e], f) for e, f in own.items()).most_common(1)
            rest = dict(terms)
            for e, f in own.items():
                add_term(rest, e, -k * f)
            if len(rest) + 1 < len(terms):
                left = self._once(self._beside_mass, rest) if rest else ZERO
                found.append(self.collector.sum_of([(k * number, mono, tree.ONE), (1, (), left)]))
        return min(found, key=self.collector.cost, default=None)

    def _with_square(self, terms: Terms, *, completed: bool = False) -> Node | None:
        """(Σ root)² + the rest, where sines and cosines of one angle group make a square."""
        g, terms = self._from_next_group(terms)
        if g == len(self._groups) or len(terms) < SMALLEST_SQUARE or any(any(e[1:MASSES]) for e in terms):
            return None
        powers, monomials = self._groups[g].powers, self._atoms.monomials
        written = {(powers.values[e[0]], monomials.values[e[SYMBOLS]]): f for e, f in terms.items()}
        found = square_in(written, completed=completed)
        if found is None:
            return None
        root: Polynomial = {}
        for factor, (trig, symbols) in found.roots:
            sign, mono = self._atoms.basic_trig_monomial(trig, g)
            root[multiply(mono, symbols)] = sign * factor
        base = self.collector.form(root)
        signs = sum(split_sign(term)[0] for term in summands(base))
        if signs < 0 or (not signs and self.collector.starts_negative(root)):
            base = self.collector.form({mono: -factor for mono, factor in root.items()})
        number, mono = self.collector.decompose(tree.Power(base, tree.Number(2)))
        others = (0,) * (len(self._groups) - g - 1)
        rest: Terms = {
            (powers.number(trig), *others, 0, monomials.number(symbols), 0): f
            for (trig, symbols), f in found.rest.items()
        }
        return self.collector.sum_of(
            [(number, mono, tree.ONE), (1, (), self._by_angles(rest) if rest else ZERO)]
        )

    def _product_of_sums(self, terms: Terms) -> Node | None:
        """(a₂ s₂ + a₃ s₂₃)(e + a₂ c₂ + a₃ c₂₃), where sines and cosines of basic angles make a product."""
        groups = self._groups[len(self._groups) - len(next(iter(terms))) - MASSES :]
        if (
            len(terms) < SMALLEST_PRODUCT
            or len(terms) > MOST_OF_PRODUCT
            or any(e[MASSES] or e[RATES] for e in terms)
        ):
            return None
        pairs = [group for group in groups if len(group.places) > 1]  # the constant ones are the last
        if any(any(e[len(pairs) : MASSES]) for e in terms):
            return None  # a constant angle, of which the cosine alone is known
        written: dict[Product, Rational] = {}
        for e, f in terms.items():
            trig = chain.from_iterable(group.powers.values[n] for group, n in zip(pairs, e, strict=False))
            written[tuple(trig), self._atoms.monomials.values[e[SYMBOLS]]] = f
        for one in (written, homogeneous(written)):
            product = self.collector.product_of_sums(self._in_atoms(one, pairs)) if one else None
            if product is not None:
                return product
        return None

    def _in_atoms(self, written: Mapping[Product, Rational], groups: Sequence[AngleGroup]) -> Polynomial:
        """A polynomial in sines and cosines of the basic angles of some groups, in atoms."""
        poly: Polynomial = {}
        for (trig, mono), f in written.items():
            start = 0
            for group in groups:
                own = trig[start : start + len(group.places)]
                start += len(own)
                sign, atoms = self._atoms.basic_trig_monomial(own, self._groups.index(group))
                mono, f = multiply(mono, atoms), sign * f
            poly[mono] = f
        return poly

    # -- angle groups from the base outwards -------------------------------------------------------

    def _from_next_group(self, terms: Terms) -> tuple[int, Terms]:
        """(the first angle group that occurs, or their number; the terms without those before it)"""
        left = len(next(iter(terms))) + MASSES
        absent = next((g for g in range(left) if any(e[g] for e in terms)), left)
        if absent:
            terms = {e[absent:]: f for e, f in terms.items()}
        return len(self._groups) - left + absent, terms

    def _by_angles(self, terms: Terms) -> Node:
        """Σ b · X_b over the monomials b of one angle group, the X_b by the next group and so on."""
        g, terms = self._from_next_group(terms)
        return self._once(self._without_angles if g == len(self._groups) else self._by_group, terms)

    def _by_group(self, terms: Terms) -> Node:
        """The same, where the first angle group occurs: its polynomials in the forms that are chosen."""
        g = len(self._groups) - len(next(iter(terms))) - MASSES
        polynomials: dict[Parts, dict[int, Rational]] = {}
        for e, f in terms.items():
            polynomials.setdefault(e[1:], {})[e[0]] = f
        collected: dict[int, Terms] = {}
        for rest, form, factor in self._groups[g].choose(polynomials):
            for number, f in form:
                collected.setdefault(number, {})[rest] = f * factor
        parts = []
        for number, part in collected.items():
            sign, trig = self._atoms.trig(g, number)
            parts.append((trig, part if sign > 0 else {e: -f for e, f in part.items()}))
        poly = self.collector.added(self._grouped(self._atoms.with_roots_added(parts), self._by_angles))
        return self.collector.form(self._atoms.with_angles_added(poly))

    def _without_angles(self, terms: Terms) -> Node:
        """The terms without angles: parameters, and velocities if these were not split off before."""
        if any(e[RATES] for e in terms):
            return self._merged(split_at(terms, RATES), self._without_angles)
        values = self._atoms.monomials.values
        poly = {multiply(values[e[MASSES]], values[e[SYMBOLS]]): f for e, f in terms.items()}
        return self.collector.factored(poly)
