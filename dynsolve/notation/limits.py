"""How large a formula of a problem file may be."""

from __future__ import annotations

from dynsolve.errors import ReadError
from dynsolve.notation.size import Size, TooLargeError, size
from dynsolve.notation.tree import Node

MAX_LENGTH = 10_000
MAX_NESTING = 50
MAX_DIGITS = 60
MAX_EXPONENT = 20
MAX_DEPTH = 100
MAX_TERMS = 20_000
MAX_DEGREE = 100


_MOST = Size(nodes=4 * MAX_LENGTH, depth=MAX_DEPTH, terms=MAX_TERMS, degree=MAX_DEGREE)
_NAME = "name a part of it with a symbol of its own"
_SAID = {
    "nodes": ("this is too large: it has too many parts", _NAME),
    "depth": ("this is nested too deeply", "write it in fewer levels of / and parentheses"),
    "terms": (f"this is too large: multiplied out it would have over {MAX_TERMS} terms", _NAME),
    "degree": (f"this is too large: multiplied out it would have powers over {MAX_DEGREE}", _NAME),
}


def check_size(tree: Node, length: int = 1) -> None:
    """Raise ReadError for a tree that is too deep, or too large when multiplied out.

    `length` is that of the text it was read from, for the error.
    """
    try:
        size(tree, _MOST)
    except TooLargeError as error:
        message, help = _SAID[error.measure]
        raise ReadError(message, 0, length, help) from None
