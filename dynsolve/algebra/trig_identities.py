"""Which identities of sine and cosine lead from one tree to an equal one, found and proved.

Every angle that stands in the trees has a sine and a cosine of its own here, so that an identity holds only
where it is used: s² + c² is not 1, and sin(q₁ + q₂) has nothing to do with sin q₁.

1. A sine or cosine of an angle that is new in the second tree is that of a sum or a difference of two angles
   of the first; where the trees still differ, s² + c² = 1 of the angles that the difference holds is used.
2. Where this does not make the trees equal, the difference is a sum of products of candidates, the addition
   theorems between angles of both among them: a system of linear equations.  Of those that have a solution
   one is taken from which no candidate can be left out.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from itertools import islice
from math import prod
from operator import sub
from typing import NamedTuple

from flint import Ordering, fmpq, fmpq_mat, fmpq_mpoly, fmpq_mpoly_ctx
from msgspec import Struct

from dynsolve.algebra.angles import Angle, angle_from_tree
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import value_of
from dynsolve.errors import AlgebraError
from dynsolve.notation.tree import (
    Function,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Sum,
    walk_once,
)


class Addition(Struct, frozen=True):
    """The sine or cosine (`name`) of an angle that is the sum (`sign` 1) or difference of two others.

    It is `opened` where it stands in the first tree and is multiplied out.
    """

    name: str
    whole: Angle
    first: Angle
    second: Angle
    sign: int
    opened: bool = False


class Used(NamedTuple):
    """The angles whose s² + c² = 1 is used, and the addition theorems, if they are found."""

    squared: tuple[Angle, ...] = ()
    additions: tuple[Addition, ...] = ()
    is_found: bool = True


_NOT_FOUND = Used(is_found=False)


def angles_in(*nodes: Node) -> dict[Angle, set[str]]:
    """The angles whose sines and cosines occur, and which of both."""
    found: dict[Angle, set[str]] = {}
    for part in dict.fromkeys(part for part in walk_once(*nodes) if isinstance(part, Function)):
        if part.name in ("sin", "cos"):
            found.setdefault(angle_from_tree(part.argument), set()).add(part.name)
    return found


def used_between(ring: Ring, before: Node, after: Node) -> Used | None:
    """The identities that lead from one tree to an equal one; None if they are not equal.

    >>> from dynsolve.algebra.ring_values import build_ring
    >>> from dynsolve.notation.text import read
    >>> both = Angle.of("q1") + Angle.of("q2")
    >>> ring = build_ring([("q1", "revolute"), ("q2", "revolute")], [], [Angle.of("q1"), both])
    >>> before, after = (read(text).tree for text in (
    ...     "sin(q2) + sin(q1 + q2)*cos(q2) - cos(q1 + q2)*sin(q2)", "sin(q2) + sin(q1)"
    ... ))
    >>> [each.name for each in used_between(ring, before, after).additions]
    ['sin']
    >>> used_between(ring, before, before.terms[0]) is None
    True
    """
    try:
        additions = tuple(new_additions(before, after))
        independent = _Independent(ring, before, after)
        if used := independent.used(additions):
            return used
        is_equal = value_of(ring, before) == value_of(ring, after)
        return independent.searched(additions) if is_equal else None
    except AlgebraError:
        return None


def new_additions(before: Node, after: Node) -> Iterator[Addition]:
    """The addition theorems by which new angles come about: each is A + B or A - B of old ones."""
    old = list(angles_in(before))
    for angle, names in angles_in(after).items():
        if angle in old or -angle in old:
            continue
        for a, b, sign in islice(_splits(angle, old), 1):
            yield from (Addition(name, angle, a, b, sign) for name in sorted(names))


def _splits(whole: Angle, parts: Sequence[Angle]) -> Iterator[tuple[Angle, Angle, int]]:
    """(a, b, sign) for which an angle is a + a, a - b or a + b of others."""
    yield from ((a, a, 1) for a in parts if a + a == whole)
    for sign in (-1, 1):
        yield from ((a, b, sign) for a in parts for b in parts if a != b and a + b * sign == whole)


MOST_COLUMNS = 600
"""The products of candidates up to which a system is solved."""

ROUNDS = 2
"""How often the terms that products of candidates bring are looked at, too: s₁² (s₂² + c₂²) + c₁²."""


class _Independent:
    """Two trees as polynomials in which every angle has a sine and a cosine of its own."""

    def __init__(self, ring: Ring, before: Node, after: Node) -> None:
        self.ring, self.trees = ring, (before, after)
        self.angles = [tuple(angles_in(tree)) for tree in self.trees]
        places = {pair.angle: (pair.cosine, pair.sine) for pair in ring.pairs}
        size = len(ring.generators)
        for angle in dict.fromkeys(angle for each in self.angles for angle in each):
            if angle not in places and -angle not in places:
                places[angle] = (size, size + 1)
                size += 2
        self.places = places
        self.leaves: dict[Node, fmpq_mpoly] = {}
        self.ctx = ring.ctx if size == len(ring.generators) else fmpq_mpoly_ctx.get(("x", size), Ordering.lex)
        self.trigonometric = {place for both in places.values() for place in both}

    # -- the values --------------------------------------------------------------------------------

    def _value(self, node: Node, put: dict[tuple[str, Angle], fmpq_mpoly]) -> fmpq_mpoly:
        """The polynomial of a tree, products multiplied out and nothing else done; some sines are `put`."""
        of = partial(self._value, put=put)
        match node:
            case Sum(terms):
                return sum(map(of, terms), start=self.ctx.constant(0))
            case Product(factors):
                return prod(map(of, factors), start=self.ctx.constant(1))
            case Negative(argument):
                return -of(argument)
            case Parenthesized(argument):
                return of(argument)
            case Power(base, Number(p, 1)):
                return of(base) ** p
            case Quotient(numerator, denominator):
                return of(numerator) * self._own(self.ring.inverse(value_of(self.ring, denominator)))
            case Function("sin" | "cos" as name, argument):
                angle = angle_from_tree(argument)
                return put[name, angle] if (name, angle) in put else self._of_angle(angle)[name == "sin"]
        if node not in self.leaves:
            self.leaves[node] = self._own(value_of(self.ring, node))
        return self.leaves[node]

    def _own(self, value: Expr) -> fmpq_mpoly:
        return value.poly if self.ctx is self.ring.ctx else value.poly.project_to_context(self.ctx)

    def _of_angle(self, angle: Angle) -> tuple[fmpq_mpoly, fmpq_mpoly]:
        """(cos, sin) of an angle."""
        if angle in self.places:
            cosine, sine = (self.ctx.gen(place) for place in self.places[angle])
            return cosine, sine
        cosine, sine = (self.ctx.gen(place) for place in self.places[-angle])
        return cosine, -sine

    def _added(self, each: Addition) -> fmpq_mpoly:
        """sin a cos b + cos a sin b, and the like."""
        (c1, s1), (c2, s2) = self._of_angle(each.first), self._of_angle(each.second)
        return s1 * c2 + each.sign * c1 * s2 if each.name == "sin" else c1 * c2 - each.sign * s1 * s2

    def _squares(self, angle: Angle) -> fmpq_mpoly:
        c, s = self._of_angle(angle)
        return s * s + c * c - 1

    def _normal(self, poly: fmpq_mpoly) -> fmpq_mpoly:
        """A polynomial with √3² = 3 and u·p = 1, its sines and cosines as they stand."""
        parts: dict[tuple[int, ...], dict[tuple[int, ...], fmpq]] = {}
        own = len(self.ring.generators)
        for exponents, number in poly.to_dict().items():
            powers = tuple(map(int, exponents))
            angular = tuple(e if place in self.trigonometric else 0 for place, e in enumerate(powers))
            rest = tuple(e - a for e, a in zip(powers[:own], angular, strict=False))
            parts.setdefault(angular, {})[rest] = number
        total = self.ctx.constant(0)
        for angular, part in parts.items():
            factor = Expr(self.ring, self.ring.reduce(self.ring.ctx.from_dict(part)))
            total += self._own(factor) * self.ctx.from_dict({angular: 1})
        return total

    # -- what leads from one to the other ----------------------------------------------------------

    def used(self, additions: tuple[Addition, ...]) -> Used | None:
        """The addition theorems of new angles with the squares that are needed, if these do."""
        put = {(each.name, each.whole): self._added(each) for each in additions}
        before, after = (self._value(tree, put) for tree in self.trees)
        difference = self._normal(before - after)
        squared = self._squared(difference)
        return None if self._modulo(difference, squared) else Used(tuple(squared), additions)

    def _squared(self, difference: fmpq_mpoly) -> list[Angle]:
        """The angles whose s² + c² = 1 makes a difference 0, or as small as it becomes."""
        degrees = difference.degrees()
        needed = [a for a, places in self.places.items() if any(degrees[place] > 1 for place in places)]
        for angle in tuple(needed):
            others = [one for one in needed if one is not angle]
            if not self._modulo(difference, others):
                needed = others
        return needed

    def _modulo(self, poly: fmpq_mpoly, angles: Iterable[Angle]) -> fmpq_mpoly:
        """What is left of a polynomial where s² + c² = 1 for some angles."""
        for angle in angles:
            poly = divmod(poly, self._squares(angle))[1]
        return poly

    def searched(self, additions: tuple[Addition, ...]) -> Used:
        """The candidates of which none can be left out."""
        before, after = (self._value(tree, {}) for tree in self.trees)
        difference = self._normal(before - after)
        angles = dict.fromkeys(angle for each in self.angles for angle in each)
        candidates: list[Angle | Addition] = [*angles, *self._candidates(additions)]
        columns = self._columns(difference, candidates)
        if len(columns) > MOST_COLUMNS or not _is_spanned(difference, [poly for _, poly in columns]):
            return _NOT_FOUND
        for one in reversed(candidates):
            left = [(each, poly) for each, poly in columns if each != one]
            columns = left if _is_spanned(difference, [poly for _, poly in left]) else columns
        used = dict.fromkeys(each for each, _ in columns)
        found = [one for one in candidates if one in used]
        return Used(
            tuple(one for one in found if isinstance(one, Angle)),
            tuple(one for one in found if isinstance(one, Addition)),
        )

    def _candidates(self, additions: tuple[Addition, ...]) -> Iterator[Addition]:
        """The addition theorems from angles of the first tree to those of both, and back from the second."""
        before, after = self.angles
        contracted = [(whole, *split) for whole in after for split in _splits(whole, before)]
        opened = [(whole, *split) for whole in before for split in _splits(whole, after)]
        cancelled = [(whole, *split) for whole in before for split in _splits(whole, before)]
        back = [each for each in opened if each not in contracted]
        here = [each for each in cancelled if each not in (*contracted, *opened)]
        found = [Addition(name, *each) for each in (*contracted, *here) for name in ("sin", "cos")]
        yield from dict.fromkeys((*additions, *found))
        yield from (Addition(name, *each, opened=True) for each in back for name in ("sin", "cos"))

    def _relation(self, candidate: Angle | Addition) -> fmpq_mpoly:
        """What is 0 by a candidate."""
        if isinstance(candidate, Angle):
            return self._squares(candidate)
        return self._added(candidate) - self._of_angle(candidate.whole)[candidate.name == "sin"]

    def _columns(
        self, difference: fmpq_mpoly, candidates: Iterable[Angle | Addition]
    ) -> list[tuple[Angle | Addition, fmpq_mpoly]]:
        """The products of candidates with which the difference has at least two terms in common."""
        relations = [(each, self._relation(each)) for each in candidates]
        known = set(difference.to_dict())
        found: dict[tuple[Angle | Addition, tuple[int, ...]], fmpq_mpoly] = {}
        for _ in range(ROUNDS):
            for each, relation in relations:
                common: dict[tuple[int, ...], int] = {}
                for term in relation.monoms():
                    multiples: Iterable[tuple[int, ...]] = known
                    for place, power in enumerate(term):
                        if power:
                            multiples = [one for one in multiples if one[place] >= power]
                    for one in multiples:
                        cofactor = tuple(map(sub, one, term))
                        common[cofactor] = common.get(cofactor, 0) + 1
                for cofactor, count in common.items():
                    if count > 1 and (each, cofactor) not in found:
                        found[each, cofactor] = self._normal(relation * self.ctx.from_dict({cofactor: 1}))
            if len(found) > MOST_COLUMNS:
                break
            known |= {term for poly in found.values() for term in poly.to_dict()}
        return [(each, poly) for (each, _), poly in found.items()]


def _is_spanned(target: fmpq_mpoly, columns: Sequence[fmpq_mpoly]) -> bool:
    """Whether a polynomial is a sum of multiples of others: no equation of them reads 0 = 1."""
    coefficients = [poly.to_dict() for poly in (*columns, target)]
    terms = dict.fromkeys(term for each in coefficients for term in each)
    echelon, rank = fmpq_mat([[each.get(term, 0) for each in coefficients] for term in terms]).rref()
    return any(echelon[rank - 1, column] for column in range(len(columns)))
