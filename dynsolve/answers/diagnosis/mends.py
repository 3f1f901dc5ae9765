"""What mends an answer: every slip that is told carries its mend, and is told only where that mends it.

    Exchange   in one place one factor stands where another belongs
    Renaming   in some terms a symbol, or an angle, stands for another throughout
    Redoing    a step was done otherwise; done right, it gives what is expected

`mends` is the one place where this is decided, exactly: with all mends put into the student's own
value, what comes out is what is expected.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from dynsolve.algebra.expr import Expr
from dynsolve.answers.diagnosis.parts import stands_in


class Mend(Protocol):
    """How a slip is undone."""

    def fits(self, mine: Expr) -> bool:
        """Whether what is to be mended stands in the answer."""

    def applied(self, mine: Expr) -> Expr:
        """The answer without the slip."""


@dataclass(frozen=True, slots=True)
class Exchange:
    """rest · `written` stands where rest · `wanted` belongs.

    A term that is missing has 0 written, one too many 0 wanted; a factor that was left out has 1
    written.
    """

    rest: Expr
    written: Expr
    wanted: Expr

    @property
    def have(self) -> Expr:
        """The term as it was written."""
        return self.rest * self.written

    @property
    def want(self) -> Expr:
        """The term as it should be."""
        return self.rest * self.wanted

    def fits(self, mine: Expr) -> bool:
        """Whether the term that was written stands in the answer."""
        return stands_in(self.have, mine)

    def applied(self, mine: Expr) -> Expr:
        """The answer with the right factor in this place."""
        return mine - self.have + self.want


@dataclass(frozen=True, slots=True)
class Renaming:
    """In `have`, some terms of the answer, what stands for some generators is put right."""

    have: Expr
    images: Mapping[int, Any]

    def fits(self, mine: Expr) -> bool:
        """Whether these terms stand in the answer."""
        return stands_in(self.have, mine)

    def applied(self, mine: Expr) -> Expr:
        """The answer with the right generators in these terms."""
        return mine - self.have + put_polynomials(self.have, self.images)


@dataclass(frozen=True, slots=True)
class Redoing:
    """The step gives `wrong` with the slip and `right` without it."""

    wrong: Expr
    right: Expr

    def fits(self, mine: Expr) -> bool:
        """Whether the slip gives just what was written; 0 shows no step at all."""
        return mine == self.wrong and not mine.is_zero

    def applied(self, mine: Expr) -> Expr:
        """What the right step gives, which may be a fraction."""
        return self.right if mine == self.wrong else mine - self.wrong + self.right


def mends(all_of: Iterable[Mend], mine: Expr, expected: Expr) -> bool:
    """Whether mends, put into an answer, give exactly what is expected."""
    mended = mine
    for one in all_of:
        if not one.fits(mine):
            return False
        mended = one.applied(mended)
    return mended == expected


def put_polynomials(expr: Expr, images: Mapping[int, Any]) -> Expr:
    """The expression with polynomials for some generators."""
    ring = expr.ring
    if not expr.poly:
        return expr
    point = [images.get(i, g) for i, g in enumerate(ring.ctx.gens())]
    return Expr(ring, ring.reduce(expr.poly.compose(*point, ctx=ring.ctx)))
