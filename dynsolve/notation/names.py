"""Names: how an identifier is spelled, and how it is set on paper.

θ1 -> theta1 -> θ with the index 1        I1zz -> I with the indices 1 and zz
"""

from __future__ import annotations

import keyword
import re
from functools import lru_cache

from dynsolve.errors import ReadError
from dynsolve.notation.characters import GREEK, SPELLED, SUBSCRIPT_DIGITS, character_error

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_GROUP = re.compile(r"[A-Za-z]*[0-9]+|[A-Za-z]+")
_LETTERS = re.compile(r"[A-Za-z]+")
_INERTIA = re.compile(r"[IJ](?=[xyz]{2})")
_WORD_LENGTH = 4
_ASCII = SPELLED | {digit: str(value) for value, digit in enumerate(SUBSCRIPT_DIGITS)}
_LONGEST_FIRST = tuple(sorted(GREEK, key=len, reverse=True))


def normalize(name: str) -> str:
    """The one ASCII spelling of a name: Greek letters spelled out, `lambda_` back to `lambda`.

    Raises ReadError for what is no name, a letter that only looks like a Latin one above all.

    >>> normalize("θ1"), normalize("theta1"), normalize("I₁zz"), normalize("lambda_")
    ('theta1', 'theta1', 'I1zz', 'lambda')
    """
    if not name.isascii():
        name = "".join(_letter(character, offset) for offset, character in enumerate(name))
    if not _NAME.fullmatch(name):
        raise _no_name(name)
    if name.endswith("_") and keyword.iskeyword(name[:-1]):
        return name[:-1]
    return name


def _letter(character: str, offset: int) -> str:
    if character.isascii():
        return character
    if (spelled := _ASCII.get(character)) is None:
        raise character_error(character, offset)
    return spelled


def _no_name(name: str) -> ReadError:
    help = "a name is a letter and then letters, digits and _: m1, lc2, theta1"
    if not name:
        return ReadError("a name is expected here", 0, 1, help)
    start = _NAME.match(name)
    offset = start.end() if start else 0
    if name[offset] in "0123456789_":
        return ReadError(f"a name cannot begin with `{name[offset]}`", offset, 1, help)
    error = character_error(name[offset], offset)
    return ReadError(error.message, offset, 1, error.help or help)


@lru_cache(maxsize=4096)
def split(name: str) -> tuple[str, tuple[str, ...]]:
    """The base of a name and its groups of indices, as they are set on paper.

    The base is a letter, a spelled-out Greek letter, or a word of four letters or
    more.  A new group of indices begins at an underscore and at a letter after a digit.

    >>> split("I1zz"), split("lc1"), split("theta1"), split("load")
    (('I', ('1', 'zz')), ('l', ('c1',)), ('theta', ('1',)), ('load', ()))
    """
    base = _base(name)
    pieces = name[len(base) :].split("_")
    return base, tuple(group for piece in pieces for group in _GROUP.findall(piece))


_RUN = re.compile(r"[A-Za-z]+|[^A-Za-z]+")
_ITALIC = frozenset("ijknrvxyz")
"""What is italic in an index, as elsewhere: what counts, the axes, and quantities (v in J_v, r in J_r)."""


def runs(index: str) -> list[str]:
    """The runs of letters and of others in a group of indices.

    >>> runs("c1")
    ['c', '1']
    """
    return _RUN.findall(index)


def describes(run: str) -> bool:
    """Whether a run of an index only describes, as the c of l_c1, so that it is set upright.

    >>> [run for run in ("c", "zz", "i", "max", "omega", "1") if describes(run)]
    ['c', 'max']
    """
    return run.isalpha() and run not in GREEK and not _ITALIC.issuperset(run)


def _base(name: str) -> str:
    for greek in _LONGEST_FIRST:
        if name.startswith(greek) and _indices_may_follow(greek, name[len(greek) :]):
            return greek
    if _INERTIA.match(name):
        return name[0]
    letters = _LETTERS.match(name)
    if letters and len(letters.group()) >= _WORD_LENGTH:
        return letters.group()
    return name[:1]


def _indices_may_follow(greek: str, rest: str) -> bool:
    """Whether `rest` reads as indices: `mus` is μ_s, but `pin` and `nuance` hold no Greek letter."""
    letters = _LETTERS.match(rest)
    if not letters:
        return True
    if greek in ("pi", "Pi", "xi", "Xi"):
        return False
    return len(greek) >= _WORD_LENGTH or len(letters.group()) <= 2
