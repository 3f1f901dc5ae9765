"""A number where a letter belongs: 9.81 for g, in some terms of an answer or in all of them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection
from fractions import Fraction
from math import isqrt
from typing import Any

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.generators import Generator
from dynsolve.algebra.rationals import fraction
from dynsolve.answers.diagnosis.mends import Exchange, put_polynomials
from dynsolve.answers.diagnosis.parts import used

PLAIN = {Fraction(p, q) for p in (-4, -2, -1, 0, 1, 2, 4) for q in (1, 2, 4)}
"""What stands before a term by itself is taken for no letter."""

Exponents = tuple[int, ...]
Found = tuple[Generator, Fraction, Exchange]
"""A letter, the number in its place, and what mends that."""


def number_for_a_letter(mine: Expr, expected: Expr, given: Collection[int]) -> Found | None:
    """The number that stands for a letter in the most terms; `given` may stand as either."""
    absent = _absent(mine, expected)
    letters = (g for g in absent if g.index not in given)
    found = (one for g in letters if (one := _of(g, absent, mine, expected)) is not None)
    return max(found, key=lambda one: len(one[2].have), default=None)


def letters_in_numbers(mine: Expr, expected: Expr) -> list[Generator]:
    """The letters in whose places numbers stand, in all terms that differ; none where any is no such term."""
    absent = _absent(mine, expected)
    right = expected.poly.to_dict()
    terms: dict[Exponents, list[Exponents]] = {}
    for exponents in right:
        terms.setdefault(_without(exponents, absent), []).append(exponents)
    missing = set()
    for bare, value in mine.poly.to_dict().items() if mine.poly else ():
        if bare not in right:
            there = terms.get(bare, [])
            if not there or any(fraction(value / right[e]) in PLAIN for e in there):
                return []
            missing |= {g for g in absent for e in there if e[g.index]}
    return sorted(missing, key=lambda g: g.index)


def has_a_plain_number(expr: Expr) -> bool:
    """Whether a term of it has no number that may stand for a letter."""
    return any(fraction(value) in PLAIN for value in expr.poly.to_dict().values())


def _absent(mine: Expr, expected: Expr) -> list[Generator]:
    """The parameters that are expected and not there."""
    ring, here = mine.ring, set(used(mine))
    found = (ring.generators[i] for i in used(expected) if i not in here)
    return [g for g in found if g.kind == "symbol" and not g.dots and g.name not in (*ring.names, "pi")]


def _of(g: Generator, absent: list[Generator], mine: Expr, expected: Expr) -> Found | None:
    """The number in place of one letter, None where there is none, or it may be that of another term."""
    if not mine.poly:
        return None
    ours, right = mine.poly.to_dict(), expected.poly.to_dict()
    alike = Counter(_without(exponents, absent) for exponents in right)
    ratios = Counter(
        _root(fraction(ours[bare] / value), int(exponents[g.index]))
        for exponents, value in right.items()
        if exponents[g.index] and (bare := _without(exponents, [g])) in ours and bare not in right
        and alike[_without(exponents, absent)] == 1
    )  # fmt: skip
    number = next((one for one, _ in ratios.most_common() if one not in PLAIN), None)
    if number is None:
        return None
    ring = mine.ring
    put = put_polynomials(expected, {g.index: ring.constant(number).poly}).poly.to_dict()
    moved = {_without(exponents, [g]) for exponents in right if exponents[g.index]}
    there = {bare for bare in moved if bare in ours and ours[bare] == put.get(bare)}
    if not there:
        return None
    want = _kept(mine, right, {e for e in right if _without(e, [g]) in there})
    others = {bare for bare, value in ours.items() if bare not in (*right, *there) and _has(value, number)}
    more = _kept(mine, ours, others)
    want = want + more * ring.generator(g.index) * (1 / number)
    return g, number, Exchange(ring.one, _kept(mine, ours, there) + more, want)


def _has(value: Any, number: Fraction) -> bool:
    """Whether a number is a factor of another, which is no usual one itself."""
    return fraction(value) not in PLAIN and fraction(value) / number in PLAIN


def _root(value: Fraction, power: int) -> Fraction:
    """The number with a power, 0 where none is rational."""
    root = value if power == 1 else Fraction(isqrt(abs(value.numerator)), isqrt(value.denominator))
    return root if root**power == value else Fraction(0)


def _without(exponents: Any, letters: list[Generator]) -> Exponents:
    places = {g.index for g in letters}
    return tuple(0 if i in places else int(e) for i, e in enumerate(exponents))


def _kept(mine: Expr, terms: dict[Any, Any], places: Collection[Exponents]) -> Expr:
    return Expr(mine.ring, mine.ring.ctx.from_dict({e: v for e, v in terms.items() if e in places}))
