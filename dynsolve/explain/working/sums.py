"""The identities by which a sum of earlier results becomes what is printed."""

from __future__ import annotations

from collections.abc import Sequence

from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.working.identities import identities, said
from dynsolve.explain.working.proved import MOST_JOINTS
from dynsolve.explain.writing import sum_of


def sum_named(context: Context, parts: Sequence[str], result: str) -> Prose:
    """The sentence before the sum of quantities; nothing of longer arms, or where none is used."""
    if context.robot.n > MOST_JOINTS:
        return ()
    before = sum_of([context.form(part) for part in parts])
    used = identities(context.robot.ring, before, context.form(result))
    return ("Collected, with ", *said(used), ":") if used else ()
