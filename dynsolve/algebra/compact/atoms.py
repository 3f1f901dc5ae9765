"""Atoms: the factors of a printed product, and their order.

An atom is whatever is printed as one factor: a mass, a length, cos θ₂, a velocity, a sum
(a₃ + x₃) that recurs as a whole.  Monomials name atoms by number; the table knows the
tree of each and its place in a product.

The atoms of a ring's generators, and of the sines and cosines of angles: how each is printed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from enum import IntEnum
from fractions import Fraction
from itertools import combinations, product

from dynsolve.algebra.angles import Angle, angle_node
from dynsolve.algebra.compact.proof import node_of
from dynsolve.algebra.compact.terms import (
    MASSES,
    RATES,
    SYMBOLS,
    Exponents,
    Monomial,
    Numbered,
    Parts,
    Polynomial,
    Rational,
    Terms,
    Value,
    add_term,
    divide,
    multiply,
)
from dynsolve.algebra.compact.trig_forms import AngleGroup, TrigMonomial
from dynsolve.algebra.fourier import TrigFunction
from dynsolve.algebra.generators import Generator, is_sign
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.notation.tree import Function, Node, Number, children


class Rank(IntEnum):
    """The order in products and sums: √2 m a d (a + b) sin θ (c₁ + c₂) θ̇ (θ̇₁ + θ̇₂)."""

    ROOT = 0  # of a number
    LEADING = 1  # a mass or a moment of inertia
    PARAMETER = 2  # a length, g
    COORDINATE = 3  # d₃ by itself
    SUM = 4  # of those above
    TRIG = 5  # a sine or cosine
    TRIG_SUM = 6  # a sum with sines and cosines in it
    RATE = 7  # a velocity or an acceleration
    RATE_SUM = 8  # a sum with those in it


AtomPlace = tuple[Rank, tuple[int, ...]]
"""Where an atom stands in a product: by its rank, then among those of that rank."""


class AtomTable:
    """The table of atoms: the meaning of the numbers in a monomial, and the order of printing."""

    def __init__(self) -> None:
        self.nodes: list[Node] = []
        self.ranks: list[AtomPlace] = []
        self._numbers: dict[Node, int] = {}

    def number(self, node: Node, rank: Rank | None = None, order: tuple[int, ...] = ()) -> int:
        """The atom of a node, the same for equal nodes; a sum ranks by what it is made of.

        `order` is its place among atoms of one rank, where that is not the order of their numbers.
        """
        found = self._numbers.get(node)
        if found is None:
            rank = self._rank(node) if rank is None else rank
            found = self._numbers[node] = len(self.nodes)
            self.nodes.append(node)
            self.ranks.append((rank, (*order, found)))
        return found

    def _rank(self, node: Node) -> Rank:
        highest = self._highest(node)
        return {Rank.TRIG: Rank.TRIG_SUM, Rank.RATE: Rank.RATE_SUM}.get(highest, max(highest, Rank.SUM))

    def _highest(self, node: Node) -> Rank:
        """The highest rank that occurs in a tree, without what stands inside functions."""
        found = self._numbers.get(node)
        if found is not None:
            return self.ranks[found][0]
        parts = () if isinstance(node, Function) else children(node)
        return max(map(self._highest, parts), default=Rank.ROOT)


# The atoms of a ring's generators, and of the sines and cosines of angles

_OTHER = {"sin": "cos", "cos": "sin"}

_ROOTS = {30: 3, 45: 2, 60: 3}
"""The root in the sines and cosines of these degrees, which are halves of it; the others are ½."""


TrigPart = tuple[Monomial, Terms]
"""A product of sines and cosines, and what stands beside it."""


def _is_negative(sum_of_two: tuple[TrigPart, TrigPart, TrigPart]) -> bool:
    *_, (_, terms) = sum_of_two
    return next(iter(terms.values())) < 0


class _Products(dict[int, int]):
    """For the number of each part of a monomial that of its product with a factor."""

    def __init__(self, numbers: Numbered[Value], times: Callable[[Value], Value]) -> None:
        self._numbers, self._times = numbers, times

    def __missing__(self, number: int) -> int:
        found = self[number] = self._numbers.number(self._times(self._numbers.values[number]))
        return found


def _raised(powers: Exponents, place: int, exponent: int) -> Exponents:
    return (*powers[:place], powers[place] + exponent, *powers[place + 1 :])


class RingAtoms:
    """The atoms of one ring, numbered in printing order.

    `leading` are the names of masses and inertias, `groups` the ring's
    angles; `form` writes the denominator that an inverse stands for.  `monomials` numbers those of
    masses, of other symbols and of rates that occur.  A
    product of sines and cosines is looked up by its number: PUMA 560 would take a fifth longer without.
    """

    def __init__(
        self,
        ring: Ring,
        leading: Iterable[str],
        groups: Sequence[AngleGroup],
        form: Callable[[Expr], Node],
    ) -> None:
        self.ring = ring
        self.table = AtomTable()
        self.monomials = Numbered[Monomial](())
        self._groups = groups
        self._form = form
        self._order = {name: i for i, name in enumerate(leading)}
        self._symbols: dict[int, tuple[int, int]] = {}
        self._number_symbols()
        of_generators = list(self._of_generators())
        self.parts = [part for part, _ in of_generators]
        self._places = dict(zip(ring.ctx.names(), of_generators, strict=False))
        self._factors: dict[str, tuple[int, _Products]] = {}
        self._trig: dict[tuple[int, int], tuple[int, Monomial]] = {}
        self._basic: dict[tuple[int, Exponents], tuple[int, Monomial]] = {}
        self._functions: dict[int, tuple[str, Angle]] = {}
        self._of_functions: dict[tuple[str, Angle], int] = {}
        self._adds_angles = any(
            g.kind in ("constant", "sin") and self._is_constant(g.angle) for g in ring.generators
        )
        written = ring.plan.constants.written
        self._by_roots = [
            (degrees, self.table.number(Function("sqrt", Number(root)), Rank.ROOT))
            for degrees, root in _ROOTS.items()
            if degrees in written
        ]
        self.roots_of_sums = {(root, 1) for degrees, root in self._by_roots if degrees == 45}

    def _of_generators(self) -> Iterator[tuple[int, int]]:
        """(the part in which each generator stands, its place there; of a symbol its index)"""
        angles = {i: (g, k) for g, group in enumerate(self._groups) for k, i in enumerate(group.places)}
        return (angles.get(g.index, (self._part(g), g.index)) for g in self.ring.generators)

    def _part(self, g: Generator) -> int:
        """The place of the part of a monomial in which a generator stands that is no sine or cosine."""
        if (g.kind == "symbol" and g.dots) or is_sign(g.node):
            return RATES
        return MASSES if g.name in self._order else SYMBOLS

    # -- symbols and roots -------------------------------------------------------------------------

    def _number_symbols(self) -> None:
        """Masses first, then g, other parameters, coordinates, accelerations, velocities."""
        printed = [g for g in self.ring.generators if g.kind in ("symbol", "root", "function")]
        for g in sorted(printed, key=self._place):
            self._symbols[g.index] = self.table.number(node_of(g, self.ring), self._rank(g)), 1

    def _place(self, g: Generator) -> tuple[object, ...]:
        order = self._order.get(g.name, 0)
        return self._rank(g), order, g.dots != 2, g.name != "g", g.kind != "symbol", g.index

    def _rank(self, g: Generator) -> Rank:
        if isinstance(g.node, Number):
            return Rank.ROOT
        part = self._part(g)
        if part == SYMBOLS:
            return Rank.COORDINATE if g.name in self.ring.names else Rank.PARAMETER
        return Rank.LEADING if part == MASSES else Rank.RATE

    def _symbol(self, index: int) -> tuple[int, int]:
        """(atom, ±1) of a generator; an inverse is what it inverts, to the power -1."""
        found = self._symbols.get(index)
        if found is None:
            inverted = self._form(Expr(self.ring, self.ring.inverses[index]))
            found = self._symbols[index] = self.table.number(inverted), -1
        return found

    # -- terms -------------------------------------------------------------------------------------

    def terms(self, text: str) -> Terms:
        """The terms of a polynomial as FLINT writes it; its own lists have an object for each exponent."""
        terms: Terms = {}
        for term in text.replace(" - ", " + -").split(" + "):
            sign, product = (-1, term[1:]) if term[0] == "-" else (1, term)
            number: Rational = sign
            parts = [0] * (len(self._groups) + 3)
            for written in product.split("*"):
                if written[0].isdigit():
                    p, _, q = written.partition("/")
                    number = sign * (Fraction(int(p), int(q)) if q else int(p))
                else:
                    part, products = self._factors.get(written) or self._new_factor(written)
                    parts[part] = products[parts[part]]
            terms[tuple(parts)] = number
        return terms

    def _new_factor(self, written: str) -> tuple[int, _Products]:
        """(the part of a monomial in which a factor stands, what it makes of it)"""
        name, _, exponent = written.partition("^")
        part, place = self._places[name]
        e = int(exponent or 1)
        if part >= 0:
            products = _Products(self._groups[part].powers, lambda powers: _raised(powers, place, e))
        else:
            atom, sign = self._symbol(place)
            products = _Products(self.monomials, lambda mono: multiply(mono, ((atom, sign * e),)))
        found = self._factors[written] = part, products
        return found

    def kind_of_rates(self, number: int) -> tuple[int, int]:
        """(how many accelerations, how many velocities) a monomial has."""
        dots = [(getattr(self.table.nodes[atom], "dots", 1), e) for atom, e in self.monomials.values[number]]
        accelerations = sum(e for order, e in dots if order == 2)
        return accelerations, sum(e for _, e in dots) - accelerations

    def is_square(self, parts: Parts) -> bool:
        """Whether all but the masses are squared; `parts` may lack those before the last ones."""
        groups = parts[:MASSES]
        trig = (group.powers.values[number] for group, number in zip(self._groups, groups, strict=False))
        if any(e % 2 for powers in trig for e in powers):
            return False
        return not any(e % 2 for number in parts[SYMBOLS:] for _, e in self.monomials.values[number])

    # -- sines and cosines -------------------------------------------------------------------------

    def trig(self, group: int, number: int) -> tuple[int, Monomial]:
        """(±1, the monomial in atoms) of sines and cosines in the angles of a group, by its number there."""
        found = self._trig.get((group, number))
        if found is None:
            mono = self._groups[group].monomials.values[number]
            found = self._trig[group, number] = self._trig_monomial(mono, group)
        return found

    def _trig_monomial(self, mono: TrigMonomial, group: int) -> tuple[int, Monomial]:
        sign, parts = 1, []
        for function, e in mono:
            turned, atom = self._trig_atom(group, function)
            sign *= turned**e
            parts.append((atom, e))
        return sign, tuple(sorted(parts))

    def basic_trig_monomial(self, exponents: Exponents, group: int) -> tuple[int, Monomial]:
        """The same of exponents of sines and cosines, in turn, of a group's basic angles."""
        found = self._basic.get((group, exponents))
        if found is None:
            found = self._basic[group, exponents] = self._basic_monomial(exponents, group)
        return found

    def _basic_monomial(self, exponents: Exponents, group: int) -> tuple[int, Monomial]:
        count = len(exponents) // 2
        mono = [
            ((("sin", "cos")[place % 2], tuple(int(j == place // 2) for j in range(count))), e)
            for place, e in enumerate(exponents)
            if e
        ]
        return self._trig_monomial(tuple(mono), group)

    def _trig_atom(self, group: int, function: TrigFunction) -> tuple[int, int]:
        """(±1, atom) of a sine or cosine: -sin(θ₁ - θ₂) is printed as sin(θ₂ - θ₁)."""
        name, multiples = function
        if name == "sqrt":
            return 1, self.table.number(Function(name, Number(multiples[0])), Rank.ROOT)
        last = max(k for k, m in enumerate(multiples) if m)
        order = (group, last, sum(map(abs, multiples)))
        return self._angle_atom(name, self._groups[group].angle(multiples), order)

    def _angle_atom(self, name: str, angle: Angle, order: tuple[int, ...]) -> tuple[int, int]:
        """(±1, atom) of the sine or cosine of an angle, without quarter turns: cos(q₂ - 90°) is sin q₂."""
        sign = 1
        while angle.terms and angle.degrees and angle.degrees % 90 == 0:
            sign = -sign if name == "cos" else sign  # cos(x + 90°) = -sin x, sin(x + 90°) = cos x
            name, angle = _OTHER[name], Angle(angle.terms, (angle.degrees - 90) % 360)
        if self._reads_better_negated(angle):
            angle, sign = -angle, (-sign if name == "sin" else sign)
        node = Function(name, angle_node(angle, self.ring.names))
        atom = self.table.number(node, Rank.TRIG, (*order, name != "sin"))
        self._functions[atom] = name, angle
        self._of_functions[name, angle] = atom
        return sign, atom

    # -- angles that are added up ------------------------------------------------------------------

    def with_angles_added(self, poly: Polynomial) -> Polynomial:
        """sin θ cos β + cos θ sin β as sin(θ + β), where one of the angles is constant."""
        found = self._sum_of_angles(poly) if self._adds_angles else None
        while found:
            terms, factor, mono = found
            poly = {m: f for m, f in poly.items() if m not in terms}
            add_term(poly, mono, factor)
            found = self._sum_of_angles(poly)
        return poly

    def _sum_of_angles(self, poly: Polynomial) -> tuple[tuple[Monomial, Monomial], Rational, Monomial] | None:
        """(two terms, factor and monomial of what they are together)"""
        for mono, factor in poly.items():
            trig = [atom for atom, e in mono if e == 1 and atom in self._functions]
            for a, b in combinations(trig, 2):
                (first, alpha), (second, beta) = self._functions[a], self._functions[b]
                turned = [
                    self._of_functions.get((_OTHER[name], angle))
                    for name, angle in (self._functions[a], self._functions[b])
                ]
                if None in turned or not (self._is_constant(alpha) or self._is_constant(beta)):
                    continue
                rest = tuple(part for part in mono if part[0] not in (a, b))
                other = multiply(rest, tuple(sorted((atom, 1) for atom in turned if atom is not None)))
                if abs(poly.get(other, 0)) != abs(factor) or alpha == beta:
                    continue
                ratio = 1 if poly[other] == factor else -1
                name, angle = (
                    ("sin", alpha + beta * ratio) if first != second else ("cos", alpha - beta * ratio)
                )
                order = max(self.table.ranks[atom][1][:3] for atom in (a, b))
                sign, atom = self._angle_atom(name, angle, order)
                if first != name:
                    sign *= ratio
                return (mono, other), factor * sign, multiply(rest, ((atom, 1),))
        return None

    def with_roots_added(self, parts: Sequence[TrigPart]) -> Sequence[TrigPart]:
        """(√3 sin θ + cos θ)/2 as sin(θ + 30°), where 30° was written."""
        while found := min(self._sums_by_roots(parts), key=_is_negative, default=None):
            first, second, whole = found
            parts = [whole if part == first else part for part in parts if part != second]
        return parts

    def _sums_by_roots(self, parts: Sequence[TrigPart]) -> Iterator[tuple[TrigPart, TrigPart, TrigPart]]:
        """Two parts, and what they are together: cos θ - sin θ is √2 cos(θ + 45°), and -√2 sin(θ - 45°)."""
        beside = dict(parts)
        for (mono, part), (degrees, root) in product(parts, self._by_roots):
            half = self._divided(part, root)
            for a in (atom for atom, e in mono if half and e == 1 and atom in self._functions):
                name, angle = self._functions[a]
                rest = divide(mono, ((a, 1),))
                turned = self._of_functions.get((_OTHER[name], angle))
                if turned is None or not angle.terms:  # cos(17° + 30°) is no number of the ring
                    continue
                other = multiply(rest, ((turned, 1),))
                both = beside.get(other, {}) if degrees != 45 else self._divided(beside.get(other, {}), root)
                ratio = next((r for r in (1, -1) if both == {e: r * f for e, f in half.items()}), 0)
                if not ratio:
                    continue
                size = half
                if degrees > 45:  # the root is in the sine
                    name, size = _OTHER[name], both
                angle += Angle((), Fraction(degrees * (ratio if name == "sin" else -ratio)))
                sign, atom = self._angle_atom(name, angle, self.table.ranks[a][1][:3])
                whole = multiply(rest, ((atom, 1),)), {e: 2 * sign * f for e, f in size.items()}
                if whole[0] not in beside:
                    yield (mono, part), (other, beside[other]), whole

    def _divided(self, terms: Terms, root: int) -> Terms:
        """The terms without a root that all have; nothing where one has it not."""
        values = self.monomials.values
        if any((root, 1) not in values[e[SYMBOLS]] for e in terms):
            return {}
        without = {number: divide(values[number], ((root, 1),)) for number in {e[SYMBOLS] for e in terms}}
        return {
            (*e[:SYMBOLS], self.monomials.number(without[e[SYMBOLS]]), e[RATES]): f for e, f in terms.items()
        }

    def _is_constant(self, angle: Angle) -> bool:
        """Whether no coordinate stands in an angle."""
        return not any(name in self.ring.names for atom, _ in angle.terms for name, _ in atom)

    def _reads_better_negated(self, angle: Angle) -> bool:
        """Few minus signs, and of as many the last coordinate positive: q₁ + q₂ - q₄, and q₂ - q₁."""
        rates = dict(angle.terms)
        moving = [rates[((name, 1),)] for name in self.ring.names if ((name, 1),) in rates]
        moving = moving or [rate for _, rate in angle.terms]
        negative = sum(rate < 0 for rate in moving)
        return 2 * negative > len(moving) or (2 * negative == len(moving) and bool(moving) and moving[-1] < 0)
