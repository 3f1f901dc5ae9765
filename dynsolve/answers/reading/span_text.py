r"""Spaces as people write them: `span{[1, 0]}`, `\alpha [1, 0]^T`, `none`, `R^2`.

What only says that vectors span a space is left out, so that the vectors remain; a space without a
vector is 0, and a whole space the unit vectors.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from dynsolve.answers.reading.placed_text import PlacedText, placed

_SPAN = re.compile(
    r"\s*(?:\\(?:mathrm|operatorname\*?|text|textrm|mathop|mathcal)\s*\{\s*span\s*\}|\\?span(?![a-z]))\s*",
    re.I,
)
_FACTOR = re.compile(r"\s*(\\?[A-Za-z]+|[αβγλμ])\s*\\?[*,;]?\s*(?=\\begin|\\left|\[|\()")
_NOTHING = re.compile(
    r"(?:none|nothing|empty|no(?: \w+)? (?:direction|motion|vector)s?|∅|\\(?:empty|var)?(?:nothing|set)|"
    r"[\[{(]?\s*[\]})]|\\?\{\s*(?:\\(?:mathbf|vec|bm)\s*\{?)?\s*0\s*\}?\s*\\?\})\.?",
    re.I,
)
_WHOLE = re.compile(r"\\?(?:mathbb\s*\{?\s*R\s*\}?|[Rℝ])\s*(?:\^\s*\{?\s*([1-6])\s*\}?|([¹²³⁴⁵⁶])|([1-6]))")
_FOR_ALL = re.compile(
    r"\s*[,;]\s*(?:\\\S\s*)?(?:\\?forall|∀|for all)?\s*\S{1,8}\s*(?:\\in\b|∈|\bin\b)[^\[\]]*\Z"
)
_OPENING = re.compile(r"\s*(?:\\left\s*)?(\\?\{|\[|\()\s*")
_CLOSING = re.compile(r"\s*(?:\\right\s*)?(\\?\}|\]|\))\s*\Z")
_RAISED = "¹²³⁴⁵⁶"


_JACOBIAN = (
    r"(?:\\(?:left|big|Big))?\(?\s*\{?\\?(?:mathbf|bm|boldsymbol)?\{?J\}?\s*(?:_\{?[a-z]+\}?)?(?:\([^()]*\))?"
)
_TURNED_OVER = r"\s*\^\s*\{?\s*(?:T|\\top|\\intercal|\\mathrm\{T\}|\\mathsf\{T\})\s*\}?"
_NULL = r"\s*\\?(?:mathcal|mathrm|operatorname|text)?\s*\{?\s*(?:N|[Kk]er(?:nel)?|[Nn]ull(?:space)?)\s*\}?\s*"
_RANGE = r"\s*\\?(?:mathcal|mathrm|operatorname|text)?\s*\{?\s*(?:R|[Rr]ange|[Ii]m(?:age)?)\s*\}?\s*"
_SPACES = {
    "lost": re.compile(rf"{_NULL}{_JACOBIAN}{_TURNED_OVER}.*|\s*\\?(?:text|mathrm)?\{{?\s*lost\b.*"),
    "nullspace": re.compile(rf"{_NULL}(?:{_JACOBIAN}.*)?"),
    "rangespace": re.compile(rf"{_RANGE}(?:{_JACOBIAN}.*)?"),
}


def space_named(text: str) -> str:
    r"""The answer that a text is the name of; empty for any other.

    >>> [space_named(text) for text in (r"\mathcal{N}(J_r)", r"\ker J^T", "R(J)", "N_1")]
    ['nullspace', 'lost', 'rangespace', '']
    """
    return next((name for name, pattern in _SPACES.items() if pattern.fullmatch(text.strip())), "")


def span_text(value: PlacedText, is_name: Callable[[str], bool]) -> PlacedText:
    """The text of the vectors alone; `is_name` says whether a word has a meaning in the problem."""
    text = value.text.strip().strip("$").strip()
    if _NOTHING.fullmatch(text):
        return placed([("0", value.origin(0))])
    if (whole := _WHOLE.fullmatch(text)) is not None:
        size = int(whole[1] or whole[3] or _RAISED.index(whole[2]) + 1)
        rows = ", ".join(str([int(i == j) for j in range(size)]) for i in range(size))
        return placed([(f"[{rows}]", value.origin(0))])
    if (numbers := _FOR_ALL.search(value.text)) is not None:
        value = value.part(0, numbers.start())
    if (span := _SPAN.match(value.text)) is not None:
        return _between(value, span.end())
    factor = _FACTOR.match(value.text)
    if (
        factor is not None
        and factor[1].lower() not in ("\\begin", "\\left")
        and not is_name(factor[1].strip("\\"))
    ):
        return value.part(factor.end(), len(value.text))
    return value


def _between(value: PlacedText, start: int) -> PlacedText:
    """What stands between the brackets behind `span`, as a list."""
    rest = value.part(start, len(value.text))
    opening, closing = _OPENING.match(rest.text), _CLOSING.search(rest.text)
    if opening is None or closing is None or closing.start() < opening.end():
        return rest
    inner = rest.part(opening.end(), closing.start())
    pieces = [(inner.text[a:b], inner.origin(a)) for a, b in _stretches(inner)]
    return placed([("[", rest.origin(opening.start(1))), *pieces, ("]", rest.origin(closing.start(1)))])


def _stretches(value: PlacedText) -> list[tuple[int, int]]:
    ends = [*value.starts[1:], len(value.text)]
    return [(a, b) for a, b in zip(value.starts, ends, strict=True) if a < b]
