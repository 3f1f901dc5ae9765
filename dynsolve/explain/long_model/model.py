"""What the steps of a long model are made from: the robot, its names, and formulas in them."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property

from dynsolve.document import Inline, Prose
from dynsolve.explain.abbreviations import Abbreviated
from dynsolve.explain.context import Context
from dynsolve.explain.entry_formulas import EntryFormulas, Factor
from dynsolve.explain.step import Step
from dynsolve.notation.build import times
from dynsolve.notation.tree import ZERO, Node, Number, Product
from dynsolve.quantities import letters

QUADRATIC = Product((letters.HALF, letters.transposed_product(letters.QD, letters.D)))
"""½ q̇ᵀ D q̇"""

Change = Callable[[Step], Step]
"""How a step is told otherwise."""


@dataclass(frozen=True)
class LongModel:
    """A model in names; `direct` is the step that assembles D from the Jacobians, if there is one."""

    context: Context
    short: Abbreviated
    direct: Step | None

    @property
    def n(self) -> int:
        """The number of coordinates."""
        return self.context.robot.n

    @cached_property
    def formulas(self) -> EntryFormulas:
        """The formulas in d_ij, c_ijk and g_k."""
        names = self.context.robot.ring.names
        return EntryFormulas(names, self.d, self.c, self.g, self.friction, _with_number_in_front)

    def d(self, i: int, j: int) -> Node:
        """The name of d_ij."""
        return ZERO if self.short.D.rows[i][j] == ZERO else letters.entry("d", min(i, j) + 1, max(i, j) + 1)

    def c(self, i: int, j: int, k: int) -> Node:
        """The name of c_ijk, the same for c_jik."""
        i, j = min(i, j), max(i, j)
        return ZERO if self.short.symbol(i, j, k) == ZERO else letters.entry("c", i + 1, j + 1, k + 1)

    def g(self, k: int) -> Node:
        """The name of g_k."""
        return ZERO if self.short.g.rows[k][0] == ZERO else letters.entry("g", k + 1)

    def friction(self, k: int) -> Node:
        """The name of the friction of a coordinate."""
        return letters.friction(k + 1) if self.context.has_friction(k) else ZERO


def _with_number_in_front(coefficient: Fraction | int, factors: Iterable[Factor]) -> Node:
    """coefficient · Π node^exponent with names for factors: ½ d_11 q̇_1², not d_11 q̇_1² / 2."""
    product = times(1, factors)
    if coefficient == 1 or product == ZERO:
        return product
    inner = product.factors if isinstance(product, Product) else (product,)
    return Product((Number(coefficient.numerator, coefficient.denominator), *inner))


def with_result(step: Step, result: Node, *more: Inline) -> Step:
    """The step with a result in names, and what there is to say about it."""
    why: Prose = (*step.why, *more)
    return replace(step, result=(result,), why=why)
