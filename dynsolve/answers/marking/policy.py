"""How verdicts become marks: the shares, the caps and the rounding that a course decides on."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import lru_cache
from typing import Any


@dataclass(frozen=True, slots=True)
class Policy:
    """`follow` is the share that what follows earns, `late` the share that a late hand-in keeps.

    `later` are the shares of the second day and those after it, where a course takes off by the
    day; the last holds for ever.
    `caps` are the most marks that the answers of a stage earn together, `rounding` is the
    step that the marks of an answer are rounded to (halves up), `hints` how much a student
    is told: 1 where, 2 what kind of slip, 3 how.
    """

    follow: Fraction = Fraction(1)
    caps: Mapping[str, Fraction] = field(default_factory=dict)
    rounding: Fraction = Fraction(1, 100)
    late: Fraction = Fraction(1)
    hints: int = 3
    later: tuple[Fraction, ...] = ()

    def kept(self, days: int) -> Fraction:
        """The share that a hand-in keeps which is so many days late, begun ones counted.

        >>> policy = Policy(late=Fraction(9, 10), later=(Fraction(4, 5),))
        >>> [str(policy.kept(days)) for days in (0, 1, 2, 7)]
        ['1', '9/10', '4/5', '4/5']
        """
        shares = (Fraction(1), self.late, *self.later)
        return shares[min(days, len(shares) - 1)]

    @property
    def penalizes_lateness(self) -> bool:
        """Whether a late hand-in loses marks."""
        return any(share != 1 for share in (self.late, *self.later))


def rounded(marks: Fraction, step: Fraction) -> Fraction:
    """The nearest multiple of `step`, halves up.

    >>> rounded(Fraction(5, 4), Fraction(1, 2)), rounded(Fraction(1, 3), Fraction(1, 100))
    (Fraction(3, 2), Fraction(33, 100))
    """
    return (marks / step + Fraction(1, 2)).__floor__() * step if step else marks


@lru_cache(maxsize=4096)
def points(*texts: str) -> Fraction:
    """Marks as the record keeps them, added up; a cohort has few different ones.

    >>> points("5/2", "1")
    Fraction(7, 2)
    """
    return sum(map(Fraction, texts), Fraction(0))


@lru_cache(maxsize=4096)
def shown(marks: Fraction) -> str:
    """Marks as people write them: exact, as a decimal where there is a short one.

    >>> shown(Fraction(5, 2)), shown(Fraction(4)), shown(Fraction(1, 3)), shown(Fraction(-1, 20))
    ('2.5', '4', '1/3', '-0.05')
    """
    places = next((n for n in range(7) if (marks * 10**n).denominator == 1), None)
    if places is None:
        return str(marks)
    digits = str(abs(int(marks * 10**places))).rjust(places + 1, "0")
    sign = "-" if marks < 0 else ""
    return sign + (f"{digits[:-places]}.{digits[-places:]}" if places else digits)


def to_data(policy: Policy) -> dict[str, Any]:
    """The policy as JSON carries it to a worker."""
    return {
        "follow": str(policy.follow),
        "caps": {stage: str(cap) for stage, cap in sorted(policy.caps.items())},
        "rounding": str(policy.rounding),
        "late": [str(share) for share in (policy.late, *policy.later)],
        "hints": policy.hints,
    }


def from_data(data: Mapping[str, Any]) -> Policy:
    """The policy that `to_data` wrote.

    >>> from_data(to_data(Policy(late=Fraction(4, 5)))).late
    Fraction(4, 5)
    """
    caps = {stage: Fraction(cap) for stage, cap in data["caps"].items()}
    late, *later = map(Fraction, data["late"])
    return Policy(
        Fraction(data["follow"]), caps, Fraction(data["rounding"]), late, data["hints"], tuple(later)
    )
