"""An answer that is to be explained, and an explanation of it, which is told only where it holds."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from fractions import Fraction

from dynsolve.algebra.expr import Expr
from dynsolve.answers.diagnosis.mends import Mend, mends
from dynsolve.answers.diagnosis.wrong_entry import WrongEntry
from dynsolve.answers.verdict import Diagnosis


@dataclass(frozen=True)
class Case:
    """An answer that is wrong, as an element of the ring, and the value that it is compared with."""

    wrong: WrongEntry
    mine: Expr
    expected: Expr


@dataclass(frozen=True)
class Explanation:
    """What is told of an answer, and what mends it; `told` makes the words."""

    mends: tuple[Mend, ...]
    told: Callable[[], Iterable[Diagnosis]]

    def holds(self, case: Case) -> bool:
        """Whether it is true: with the slips mended the answer is what is expected, exactly."""
        return mends(self.mends, case.mine, case.expected)


def in_common(a: Expr, b: Expr) -> int:
    """How many terms two values share."""
    if not a.poly or not b.poly:
        return 0
    return len(a.poly.to_dict().items() & b.poly.to_dict().items())


def likeness(a: Expr, b: Expr) -> Fraction:
    """The share of the terms of two values that they have in common."""
    same = in_common(a, b)
    return Fraction(same, max(len(a) + len(b) - same, 1))
