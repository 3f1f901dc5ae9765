"""The books that a report names: which, the titles of their sections, and the sections of another edition."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from dynsolve.explain.writing import BOOKS, SIGN, SPONG, Book

_MOVED = {"3.3": "5", "3.3.1": "5.1", "3.3.2": "5.2"}
"""Inverse kinematics, a section of the first edition, is a chapter of the second."""


def in_second_edition(number: str) -> str:
    """Where the second edition of the course's book has a section of the first.

    Its chapter 5 is inverse kinematics and its chapter 6 dynamics, with the sections of chapter 7 before.

    >>> in_second_edition("7.2.3"), in_second_edition("3.3.2"), in_second_edition("4.6.3")
    ('6.2.3', '5.2', '4.6.3')
    """
    chapter, _, rest = number.partition(".")
    return _MOVED.get(number) or (f"6.{rest}" if chapter == "7" else number)


_REFERENCE = re.compile(
    f"({'|'.join(re.escape(book.name) for book in BOOKS if book.name)})? ?{SIGN}([0-9.]*[0-9])"
)


def of_second_edition(text: str) -> str:
    """Words in which the course's book and its sections are those of its second edition.

    >>> of_second_edition("§7.2.3 writes a plus; Siciliano et al. §7.1.2 does not")
    '§6.2.3 writes a plus; Siciliano et al. §7.1.2 does not'
    """

    def renumbered(match: re.Match[str]) -> str:
        return match[0] if match[1] else match[0].replace(match[2], in_second_edition(match[2]))

    return _REFERENCE.sub(renumbered, text).replace("1st edition, Wiley, 2006", "2nd edition, Wiley, 2020")


def titled(sources: Iterable[str]) -> Iterator[str]:
    """The sections of the course's book that references name, with their titles.

    >>> list(titled(["§7.1", "Craig §3.5", "from §7.3", "§7.1"]))
    ['§7.1 The Euler-Lagrange Equations', '§7.3 Equations of Motion']
    """
    told = {match[2] for source in sources for match in _REFERENCE.finditer(source) if not match[1]}
    return (f"{SIGN}{number} {title}" for number, title in SPONG.sections.items() if number in told)


def cited(sources: Iterable[str]) -> Iterator[Book]:
    """The books that references name, in the order of the table."""
    named = [book.name for book in BOOKS if book.name]
    told = [source for source in sources if SIGN in source]
    own = any(not any(name in source for name in named) for source in told)  # the course's has no name
    return (book for book in BOOKS if (any(book.name in source for source in told) if book.name else own))
