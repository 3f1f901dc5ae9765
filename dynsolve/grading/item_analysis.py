"""How an answer did in a cohort: its mean, who had it right, and how well it tells strong from weak students.

The last is the corrected item-total correlation: Pearson's r of the marks x of the answer with
what the same students earned for everything else, t - x, where t is all that they earned,

    r_x(t-x) = (r_xt s_t - s_x) / sqrt(s_x^2 + s_t^2 - 2 r_xt s_x s_t),

with the standard deviations s.  It is near 1 where those who have the answer are those who have the
rest, near 0 where it has nothing to do with the rest, and below 0 where something is wrong with the
answer or its key.  (Nunnally and Bernstein, Psychometric Theory, 3rd edition, 1994, chapter 8.)
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from statistics import correlation, fmean

FEWEST = 3
"""Two students always lie on a line."""


@dataclass
class Item:
    """The marks of one answer, of those whose hand-in does not wait; `totals` are theirs for everything.

    Of whom another hand-in waits for a human there is no total yet: None.
    """

    of: float
    marks: list[float] = field(default_factory=list)
    totals: list[float | None] = field(default_factory=list)
    correct: int = 0

    def add(self, marks: float, total: float | None, correct: bool) -> None:
        """Count one student."""
        self.marks.append(marks)
        self.totals.append(total)
        self.correct += correct

    @property
    def mean(self) -> float | None:
        """The mean of the marks."""
        return fmean(self.marks) if self.marks else None

    @property
    def share_correct(self) -> float | None:
        """The share of the students who had it right."""
        return self.correct / len(self.marks) if self.marks else None

    @property
    def item_rest(self) -> float | None:
        """The corrected item-total correlation of those who have a total."""
        both = [(x, t) for x, t in zip(self.marks, self.totals, strict=True) if t is not None]
        return item_rest([x for x, _ in both], [t for _, t in both])


def item_rest(marks: Sequence[float], totals: Sequence[float]) -> float | None:
    """The correlation of marks with the rest of the totals.

    None for fewer than three students, and where all have the same marks or the same rest.

    >>> item_rest([0, 2, 1], [1, 4, 4]), item_rest([1, 1, 1], [1, 2, 3]), item_rest([0, 1], [0, 2])
    (0.5, None, None)
    """
    rest = [t - x for x, t in zip(marks, totals, strict=True)]
    if len(marks) < FEWEST or _is_flat(marks) or _is_flat(rest):
        return None
    return correlation(marks, rest)


def _is_flat(values: Sequence[float]) -> bool:
    """Whether all are the same, but for what is lost where decimals are taken from each other."""
    return max(values) - min(values) < 1e-9
