r"""The heads of tables of Denavit-Hartenberg parameters: which column is θ, which d, a, α.

A head is a symbol ($\alpha_{i-1}$, `theta_i [deg]`), a symbol after its words (`Link length a_i`), or words
alone (`twist`, `Rot x`).
"""

from __future__ import annotations

import re
from collections.abc import Sequence

_LONGEST = 80
_FONT = r"(?:(?:mathbf|boldsymbol|textbf|text|mathrm|bm|mathit)[\s{\\$]*)?"
_SYMBOL = re.compile(
    rf"[\s$\\*{{}}(]*{_FONT}(?:var)?(theta|alpha|θ|ϑ|α|d|a)(?![A-Za-zα-ω])(?![ \t]+[A-Za-z])", re.IGNORECASE
)
_SYMBOL_INSIDE = re.compile(r"(?<![A-Za-z])(theta|alpha|θ|ϑ|α|[da](?=\W{0,3}[\]_}$ᵢ)]|\s*$))(?![A-Za-z])")
_COLUMNS = {"theta": 0, "θ": 0, "ϑ": 0, "d": 1, "a": 2, "alpha": 3, "α": 3}
_WORDS = (
    (re.compile(r"joint angle|rot\w*[\s_({]*z|r[_{]+z", re.IGNORECASE), 0),
    (re.compile(r"offset|trans\w*[\s_({]*z", re.IGNORECASE), 1),
    (re.compile(r"link length|trans\w*[\s_({]*x", re.IGNORECASE), 2),
    (re.compile(r"twist|rot\w*[\s_({]*x|r[_{]+x", re.IGNORECASE), 3),
)


def column_of(head: str) -> int | None:
    r"""The column that a head names: 0 for θ, 1 for d, 2 for a, 3 for α; None of another.

    >>> column_of("theta_i [deg]"), column_of(r"$\alpha_{i-1}$"), column_of("Link"), column_of("Link twist")
    (0, 3, None, 3)
    """
    if len(head) > _LONGEST:
        return None
    symbol = _SYMBOL.match(head) or _SYMBOL_INSIDE.search(head)
    if symbol is not None:
        return _COLUMNS[symbol[1].lower()]
    return next((column for words, column in _WORDS if words.search(head)), None)


def order_of(heads: Sequence[str]) -> tuple[int, ...] | None:
    r"""The places of θ, d, a, α in a head; None of what is no head.

    >>> order_of(["Link", "$a_i$", r"$\alpha_i$", "$d_i$", r"$\theta_i$"])
    (4, 3, 1, 2)
    """
    found: dict[int, int] = {}
    for place, head in enumerate(heads):
        column = column_of(head)
        if column in found:
            return None
        if column is not None:
            found[column] = place
    return tuple(found[column] for column in range(4)) if len(found) == 4 else None
