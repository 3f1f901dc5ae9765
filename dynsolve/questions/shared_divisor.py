"""What several entries are divided by, under one name: (A)₃₁ = g A (2m₁ + 3m₂)(m₂ B² + 9J₂)/(27Δ)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from fractions import Fraction

from msgspec import Struct

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.fraction import RationalExpr
from dynsolve.algebra.linear_systems import FractionMatrix, content, fraction_of
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_values import with_symbols
from dynsolve.algebra.sampling import Transfer
from dynsolve.explain.forms import ProductForms
from dynsolve.explain.step import Line
from dynsolve.notation.tree import NAMED, Node, Relation, Symbol, equation, mapped
from dynsolve.notation.tree import Matrix as MatrixTree
from dynsolve.quantities import letters

FEWEST_TERMS = 3
"""A divisor of fewer is read as quickly as its name."""

MOST_TERMS = 60
"""Above the line of an entry with more the letter is not looked for: its factors alone would take long."""


class SharedDivisor(Struct, frozen=True):
    """What a letter, Δ, stands for; whether that is det D."""

    value: Expr
    products: ProductForms
    is_determinant: bool
    letter: Node = letters.DIVISOR

    @property
    def meaning(self) -> Relation:
        """Δ = det D = its tree."""
        of = (letters.DET_D,) * self.is_determinant
        return equation(self.letter, *of, self._tree)

    @property
    def named(self) -> Relation:
        """det D = its tree =: Δ"""
        if not self.is_determinant:
            return self.meaning
        return Relation((letters.DET_D, self._tree, self.letter), ("=", NAMED))

    @property
    def _tree(self) -> Node:
        return self.products.compactor.form(self.value)

    @property
    def line(self) -> Line:
        """What introduces the letter."""
        by = () if self.is_determinant else ("Several entries are divided by",)
        return Line(by, (self.named,), is_kept=True)

    def form(self, matrix: Matrix | FractionMatrix) -> MatrixTree:
        """A matrix, with the letter in the entries that are over the divisor."""
        whole = self.products.of(matrix)
        assert isinstance(whole, MatrixTree)
        entries = ([*map(fraction_of, row)] for row in matrix.rows)
        rows = zip(entries, whole.rows, strict=True)
        return MatrixTree(tuple(tuple(map(self._entry, *both)) for both in rows))

    def _entry(self, one: RationalExpr, form: Node) -> Node:
        rest = None if one.divisor is None else one.divisor.quotient(self.value)
        if rest is None:
            return form
        times, left = (Expr(rest.ring, part) for part in divmod(one.numerator.poly, self.value.poly))
        is_inside = not rest.is_number or len(times) + len(left) < len(one.numerator)
        if is_inside and len(one.numerator) <= MOST_TERMS:
            return self._with_letter(times, left, rest)
        if not rest.is_number:
            return form
        ratio = 1 / rest.number
        above = one.numerator * ratio
        number = 1 if self.products.decimal else content([above]).denominator
        return self.products.over(above * number, number, (self.letter, 1))

    def _with_letter(self, times: Expr, left: Expr, rest: Expr) -> Node:
        """(times Δ + left)/(rest Δ), with the letter above, too, where it stands there."""
        ring = with_symbols(self.value.ring, [_NAME])
        put, letter = Transfer(self.value.ring, ring), ring.symbol(_NAME)
        shorter = len(times) + len(left) < len(times * self.value + left)
        above = put(times) * (letter if shorter else put(self.value)) + put(left)
        forms = ProductForms(Compactor(ring), decimal=self.products.decimal)
        shown = forms.of(RationalExpr(above, put(rest) * letter))
        return mapped(shown, lambda node: self.letter if node == Symbol(_NAME) else node)


_NAME = "shared divisor"
"""Of the letter in a ring: no parameter has such a name."""


def shared_divisor(
    products: ProductForms, matrices: Sequence[Matrix | FractionMatrix], size: Expr
) -> SharedDivisor | None:
    """What most entries are over, where that is long: det D, of this size, or what is left of it."""
    divisors = [one.divisor for matrix in matrices for one in map(fraction_of, matrix.entries) if one.divisor]
    alike = [next(other for other in divisors if _ratio(other, one)) for one in divisors]
    value, uses = max(Counter(alike).items(), key=lambda item: item[1], default=(size, 0))
    if uses < 2 or len(value) < FEWEST_TERMS:
        return None
    is_determinant = _ratio(size, value) is not None
    if is_determinant:
        value = size
    elif not products.decimal:
        value = value / content([value])
    return SharedDivisor(value, products, is_determinant)


def _ratio(one: Expr, other: Expr) -> Fraction | None:
    """One over another where that is a number."""
    ratio = one.quotient(other)
    return ratio.number if ratio is not None and ratio.is_number else None
