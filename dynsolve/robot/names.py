"""Names that are given beside those of a problem, so that none of these means two things.

What a derivation puts into the ring besides what stands in the file (generalized forces, values that are
to be reached, multipliers) has its usual name where that is free, and else another one.  Names that are
written alike, tau1 and tau_1, are one.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from collections.abc import Set as AbstractSet
from functools import lru_cache
from itertools import chain, count, islice

from dynsolve.robot.model import Coordinate, Robot

FORCES: dict[str, tuple[str, ...]] = {"tau": ("u", "T", "upsilon"), "f": ("F", "N", "Phi")}
"""The letters of generalized forces -> those that stand in for them, the first that is free."""


_SPARE = ("delta", "epsilon", "kappa", "xi", "chi", "zeta", "nu", "beta", "gamma")
"""Letters for what has none left: with a mark behind it, a Greek letter would be a word."""


def spelled(name: str) -> str:
    """The letters and digits of a name, by which it is known.

    >>> spelled("lambda_1")
    'lambda1'
    """
    return name.replace("_", "")


def names_taken(robot: Robot) -> frozenset[str]:
    """What already means something in a problem: its parameters, its coordinates, and what it is to reach."""
    return _spelled(("pi", *robot.parameters, *robot.ring.names, *robot.questions.reached))


@lru_cache(maxsize=64)
def _spelled(names: tuple[str, ...]) -> frozenset[str]:
    return frozenset(map(spelled, names))


def free(offers: Iterable[Sequence[str]], taken: AbstractSet[str]) -> tuple[str, ...]:
    """The first of several groups of names that has none that is taken.

    >>> free((["r1", "r2"], ["rd1", "rd2"]), {"r2"})
    ('rd1', 'rd2')
    """
    return next(tuple(names) for names in offers if taken.isdisjoint(map(spelled, names)))


def marks() -> Iterator[str]:
    """What stands behind a letter to make another of it; of these there is no end."""
    yield ""
    yield from ("d" * k for k in count(1))


def other_letters(letter: str, others: Iterable[str] = ()) -> Iterator[str]:
    """A letter, those that may stand in for it, and no end of others made of it."""
    return chain((letter,), others, _SPARE, (f"{letter}{mark}" for mark in islice(marks(), 1, None)))


def free_letter(letters: Iterable[str], indices: Iterable[str], taken: AbstractSet[str]) -> str:
    """The first letter that with none of the indices is a name that is taken."""
    indices = tuple(indices)
    return next(letter for letter in letters if taken.isdisjoint(f"{letter}{index}" for index in indices))


def inputs(coordinates: Sequence[Coordinate], taken: AbstractSet[str]) -> tuple[str, ...]:
    """The names of the generalized forces where results hold them: tau1 of an angle, f1 of a length."""
    indices = [str(q.index) for q in coordinates]
    letters = {
        letter: free_letter(other_letters(letter, others), indices, taken)
        for letter, others in FORCES.items()
    }
    return tuple(f"{letters[q.force_letter]}{q.index}" for q in coordinates)
