"""What differs, where no slip explains it: said of the terms, with nothing read into them."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.algebra.expr import Expr
from dynsolve.answers.diagnosis.numbers import letters_in_numbers
from dynsolve.answers.diagnosis.parts import monomial_expr, parts
from dynsolve.answers.diagnosis.slips import slip
from dynsolve.answers.diagnosis.term_writer import TermWriter
from dynsolve.answers.verdict import Diagnosis

MOST_NAMED = 4
"""So many terms are named."""


def what_differs(words: TermWriter, called: str, mine: Expr, expected: Expr) -> Iterator[Diagnosis]:
    """How many terms are missing, which are none of those expected, and which have another factor.

    What is missing is not shown, so that an answer 0 does not reveal the solution.
    """
    if mine.is_zero:
        yield slip("zero", yours=called)
        return
    letters = letters_in_numbers(mine, expected)
    if letters:
        yield slip("numbers_for_letters", other=_listed([words.generator(g) for g in letters]))
        return
    ours, theirs = parts(mine), parts(expected)
    missing = len(theirs.keys() - ours.keys())
    extra = [term for monomial, term in ours.items() if monomial not in theirs]
    changed = [m for m, term in ours.items() if m in theirs and theirs[m] != term]
    if not extra and not changed:
        yield slip("terms_missing", yours=f"{missing} terms are" if missing > 1 else "A term is")
        return
    said = []
    if missing:
        said.append(f"{missing} {'is' if missing == 1 else 'are'} missing.")
    if changed:
        terms = [words.of(monomial_expr(mine.ring, monomial)) for monomial in changed]
        said.append(f"Another factor belongs to {_listed(terms)}.")
    if extra:
        said.append(f"Not among the right terms: {_listed([words.of(term) for term in extra])}.")
    yield slip("terms_differ", yours=" ".join(said))


def _listed(terms: list[str]) -> str:
    more = len(terms) - MOST_NAMED
    return ", ".join(terms[:MOST_NAMED]) + (f", and {more} more" if more > 0 else "")
