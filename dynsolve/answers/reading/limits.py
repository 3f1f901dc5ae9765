"""How much is read: a hand-in over one of these bounds is `unreadable`, and says which."""

from __future__ import annotations

from dynsolve.errors import ReadError
from dynsolve.notation.limits import MAX_DEPTH
from dynsolve.notation.size import Size, TooLargeError, size
from dynsolve.notation.tree import Node

MAX_BYTES = 20_000_000
"""Of a file: notebooks and web pages carry their pictures with them."""

MAX_LENGTH = 60_000
"""Characters of one equation."""

MAX_TOKENS = 40_000
"""Tokens of one equation, its macros written out."""

MAX_NESTING = 60
"""Levels of parentheses, fractions, signs and powers."""

MAX_IDENTIFIER = 200
"""Characters of one name."""

MAX_EQUATIONS = 1_000
"""Equations of one file."""

MAX_ANSWERS = 2_000
"""Values of one file."""

MAX_MEMBERS = 50
"""Members of one chain a = b = c."""

MAX_ENTRIES = 1_000
"""Entries of one matrix."""

MAX_INVERSE = 3
"""Rows of a matrix whose inverse is written as a power."""

MAX_NODES = 60_000
"""Nodes of one value, its abbreviations written out."""

MAX_TERMS = 200_000
"""Terms of one value, multiplied out; an upper bound known from the tree alone."""

MAX_DEGREE = 200
"""The degree of one value."""

MAX_EXPONENT = 20
MAX_MACROS = 500
MAX_MACRO_LENGTH = 2_000
MAX_DEFINITIONS = 300

_MOST = Size(nodes=MAX_NODES, depth=MAX_DEPTH, terms=MAX_TERMS, degree=MAX_DEGREE)
_SAID = {
    "nodes": f"this is too large: over {MAX_NODES} signs when its abbreviations are written out",
    "depth": f"this is nested over {MAX_DEPTH} levels deep",
    "terms": f"this is too large: multiplied out it would have over {MAX_TERMS} terms",
    "degree": f"this is too large: it holds powers over {MAX_DEGREE}",
}


def check_size(node: Node) -> None:
    """Raise ReadError for a value over the bounds on its size."""
    try:
        size(node, _MOST)
    except TooLargeError as error:
        raise ReadError(_SAID[error.measure], help="write it shorter, or as a sum of its terms") from None
