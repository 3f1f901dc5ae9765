"""The lines from a sum of earlier results to what is printed."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.working.derivatives import are_alike
from dynsolve.explain.working.expansion import brackets, has_rates
from dynsolve.explain.working.identities import identities, said
from dynsolve.explain.working.proved import SILENT, Way, chain
from dynsolve.explain.writing import sum_of
from dynsolve.notation.tree import ZERO, Node, Number, Power, Sum, equation
from dynsolve.notation.walk import walk


def summed(
    context: Context, parts: Sequence[str], result: str, name: Node, *, stand_above: bool = False
) -> Way:
    """The plain sum of scalar quantities, and what it takes to collect it.

    Silent of longer arms, and where the terms are only sorted.  Of terms that `stand_above`, just
    before, the plain sum is shown where a square is opened, an identity used, numbers are added, or
    coefficients come together in a bracket.
    """
    if not context.is_short:
        return SILENT
    forms = [context.form(part) for part in parts]
    before, after = sum_of([form for form in forms if form != ZERO]), context.form(result)
    used = identities(context.robot.ring, before, after)
    opened = _squares_of_sums(before) - _squares_of_sums(after)
    is_sorted = numbers_in(after) <= numbers_in(before) and not _brackets_change(before, after)
    is_seen = are_alike(before, after) or (stand_above and is_sorted)
    if is_seen and not (used or opened):
        return SILENT
    by = _opened(opened) if opened else ("Collected",)
    by += (", with ", *said(used), ":") if used else (":",)
    return chain(context.values[result], [((), before)], lambda tree: equation(name, tree), by)


def _opened(squares: Collection[Node]) -> Prose:
    """Which square of a sum is multiplied out."""
    if len(squares) > 1:
        return ("The squares of sums multiplied out, and collected",)
    return ("The square ", *squares, " multiplied out, and collected")


def numbers_in(node: Node) -> set[Node]:
    """The numbers that stand in a tree."""
    return {part for part in walk(node) if isinstance(part, Number)}


def _brackets_change(before: Node, after: Node) -> bool:
    """Whether brackets of the terms are opened, and coefficients come together in new ones."""
    first, last = brackets(before), brackets(after)
    new = {each for each in last - first if not has_rates(each)}
    return bool(first - last and new)


def _squares_of_sums(node: Node) -> set[Node]:
    """The powers of sums that stand in a tree."""
    return {part for part in walk(node) if isinstance(part, Power) and isinstance(part.base, Sum)}
