"""Formulas of names alone that count as answers: τ = D q̈ + C q̇ + g beside a D, a C and a g of one's own.

A formula like this says how a quantity is found, and is a definition.  Where the quantity is
asked for, and nothing else in the file gives it, it is what the student's own answers make of it.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from dataclasses import replace

from dynsolve.answers.submission import Answer, Submission
from dynsolve.quantities import families
from dynsolve.quantities.index import Quantities

_JACOBIANS = frozenset({"J", "Jv", "Jr"})
"""What a hand-in calls J is any of these, by its shape."""


def general_formulas(submission: Submission, asked: Collection[str], named: Quantities) -> Iterator[Answer]:
    """The formulas of names alone that answer what is asked and not given, from what is given.

    They come behind all that they are put together from, which does not follow from them.
    """
    given = {answer.name for answer in submission.answers}
    behind = 1 + max((answer.occurrence[0] for answer in submission.answers), default=0)
    for place, answer in enumerate(submission.general):
        if answer.name not in asked or is_given(named, answer.name, given):
            continue
        if (
            answer.node is not None
            and answer.references
            and all(is_given(named, name, given) for name in needed(named, answer.name, answer.references))
        ):
            yield replace(answer, occurrence=(behind + place, 0))


def needed(named: Quantities, name: str, references: Iterable[str]) -> list[str]:
    """What a formula of an answer needs: what stands in it, but for forces that are its inputs."""
    forces = (families.TAU, families.FORCE) if name in families.HOLD_FORCES else ()
    return [other for other in references if named[other].family not in forces]


def is_given(named: Quantities, name: str, given: Collection[str]) -> bool:
    """Whether a quantity is written, by itself or by an entry or a part of it."""
    return (
        name in given
        or (name in _JACOBIANS and not _JACOBIANS.isdisjoint(given))
        or any(named.entry_of(other)[0] == name for other in given)
        or any(part in given for part in named.parts(name))
    )
