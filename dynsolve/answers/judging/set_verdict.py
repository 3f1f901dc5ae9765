"""What is found of a set of configurations."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class SetVerdict:
    """Whether a set is right, else the `code` of what is said of alternative `number`, and `where`.

    `notes` are what is said of one that is right.
    """

    is_right: bool
    code: str = ""
    number: int = 0
    notes: tuple[str, ...] = ()
    where: str = ""


RIGHT = SetVerdict(True)

INCOMPLETE = "incomplete"
"""The note of an answer that has some of the branches, all right."""
