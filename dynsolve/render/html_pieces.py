"""Formulas in HTML as pieces of MathML, between which a browser ends lines.

What a browser knows is how wide its window is; what it does not know is which places to prefer.
So a part that is to stay whole where a line holds it is a box with lines of its own, and what is wide
for a phone is put together for that width.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape
from itertools import takewhile

from msgspec.structs import replace

from dynsolve.notation.extent import FLAT
from dynsolve.notation.mathml import MINUS, MathMLPrinter, row
from dynsolve.notation.tree import Node
from dynsolve.render.latex_displays import HEIGHTS, height_around
from dynsolve.render.line_breaking import RELATION_BREAK, SUM_BREAK, Notation, Piece

PHONE = 16.5
"""What fits a phone beside a number, in em."""

LINE = 20.0
"""What fits a phone where the number stands below."""

SCROLLED = 24.0
"""What no phone shows whole, even on a line of its own."""

PAGE = 44.0
"""What fits the widest page."""

_SHORT_SIDE = 3.0
"""The width of a left side that stays with what follows in a sentence."""

_INDENT = 2.0
"""How much less a line of a phone holds in a box of its own."""


def math(text: str, display: bool = False) -> str:
    """Elements as a formula of their own."""
    return f'<math displaystyle="true">{text}</math>' if display else f"<math>{text}</math>"


# -- the notation -----------------------------------------------------------------------------------


def _fence(sign: str, height: float) -> str:
    """A parenthesis of a height in em."""
    if height <= FLAT:
        return f'<mo stretchy="false">{sign}</mo>'
    size = f'minsize="{height:.2f}em" maxsize="{height:.2f}em"'
    form = "prefix" if sign == "(" else "postfix"
    return f'<mo form="{form}" stretchy="true" symmetric="true" {size}>{sign}</mo>'


def _around(text: str) -> float:
    return height_around(text, [_fence("(", height) for height in HEIGHTS])


class PagePrinter(MathMLPrinter):
    """MathML for a page: parentheses are larger than those in them."""

    def parenthesized(self, text: str) -> str:
        """The text in parentheses."""
        whole = super().parenthesized(text)
        height = _around(text)
        if height == FLAT or "stretchy" not in whole.partition(">")[0]:
            return whole
        return row(f"{_fence('(', height)}{text}{_fence(')', height)}")


def html_notation(printer: MathMLPrinter) -> Notation:
    """The signs of a formula in MathML."""

    def closed(height: float, exponent: Node | None) -> str:
        sign = _fence(")", height)
        if exponent is None:
            return sign
        return f"<msup>{row(sign)}{row(printer.text(exponent))}</msup>"  # alone in a row it is stretched

    return Notation(
        text=printer.text,
        plus='<mo form="infix">+</mo>',
        minus='<mo form="infix">\u2212</mo>',
        lead=MINUS,
        times='<mo form="infix">·</mo>',
        relation=lambda sign: f'<mo form="infix">{escape(sign)}</mo>',
        opened=lambda height: _fence("(", height),
        closed=closed,
        around=_around,
        joined="".join,
    )


# -- displayed formulas -----------------------------------------------------------------------------


def laid_out(parts: Sequence[Piece], room: float) -> str:
    """The pieces of a formula, between which a line may end; `room` is what a line of a phone holds.

    A left side of several pieces takes a right side of one with it; another left side stays with what
    no line of a phone holds, and an equation of two members is broken before the terms of the second.
    """
    members = sum(part.depth == RELATION_BREAK for part in parts)
    if members == 2 and len(parts) > 2 and parts[-1].depth == RELATION_BREAK:
        terms = min(part.depth for part in parts[1:-1])
        return _nested([*parts[:-1], replace(parts[-1], depth=terms)])
    if members < 2 or parts[1].depth > RELATION_BREAK:
        return _nested(parts)
    left, right, *rest = parts
    inside = list(takewhile(lambda part: part.depth > RELATION_BREAK, rest))
    terms = min((part.depth for part in inside if _is_term(part)), default=RELATION_BREAK)
    head = right.width + sum(part.width for part in takewhile(lambda part: part.depth > terms, inside))
    width = left.width + right.width
    is_broken = inside and head > room >= width
    is_scrolled = right.width > (room if left.width <= _SHORT_SIDE else SCROLLED)
    if is_scrolled or is_broken or (inside and members > 2 and left.width + head <= room):
        parts = [replace(left, text=left.text + right.text, width=width), *rest]
    return _nested(parts, terms if members == 2 else RELATION_BREAK)


def _is_term(part: Piece) -> bool:
    """Whether a piece is a term of a member, or a factor that is a matrix; a unit is neither."""
    return part.level == 0 and (part.depth == SUM_BREAK or bool(part.sign))


def _nested(parts: Sequence[Piece], depth: int = RELATION_BREAK, room: float = LINE) -> str:
    """Pieces between which a line may end; one with the deeper ones after it is a box with lines of its own.

    So a browser, which looks at no depth, breaks a chain at its equals signs, and a member of it,
    or what is in parentheses, only where no line holds that whole.

    >>> _nested([Piece("a", 1), Piece("=b", 2), Piece("=c", 2), Piece("+d", 2, 1)])
    '<math displaystyle="true">a</math><wbr><math displaystyle="true">=b</math><wbr>\
<span class="whole"><math displaystyle="true">=c</math><wbr><math displaystyle="true">+d</math></span>'
    """
    width = sum(part.width for part in parts)
    groups: list[list[Piece]] = []
    for part in parts:
        if groups and part.depth > depth:
            groups[-1].append(part)
        else:
            groups.append([_multiplied(part, width, room) if groups else part])
    return "<wbr>".join(_grouped(group, room) for group in groups)


def _multiplied(part: Piece, width: float, room: float) -> Piece:
    """A piece of a box so wide; a matrix before which a line may end has a product sign.

    Where that is a line of a phone alone, the sign is seen there alone.
    """
    if not part.sign or width <= room:
        return part
    sign = part.sign if width > PAGE else f'<mrow class="broken">{part.sign}</mrow>'
    return replace(part, text=sign + part.text)


def _grouped(group: Sequence[Piece], room: float) -> str:
    first, *deeper = group
    if not deeper:
        return math(first.text, display=True)
    inside = _nested(group, min(part.depth for part in deeper), room - _INDENT)
    return f'<span class="whole">{inside}</span>'


# -- formulas in sentences --------------------------------------------------------------------------


def in_sentence(parts: Sequence[Piece]) -> Iterator[str]:
    """Formulas between which a line may end; a short left side stays with what follows.

    The space before a sign ends the line before it.

    >>> for text in in_sentence([Piece("<mi>d</mi>", 4), Piece('<mo form="infix">=</mo><mi>m</mi>', 9)]):
    ...     print(text)
    <math><mi>d</mi><mspace width="0.28em"/></math>
    <math><mo form="infix" lspace="0">=</mo><mi>m</mi></math>
    """
    first, *rest = parts
    if rest and first.width <= _SHORT_SIDE and first.width + rest[0].width <= PHONE:
        first, rest = replace(first, text=first.text + rest[0].text), rest[1:]
    texts = [part.text for part in (first, *rest)]
    sign = '<mo form="infix">'
    for k, text in enumerate(texts):
        begun = text.replace(sign, '<mo form="infix" lspace="0">', 1) if k and text.startswith(sign) else text
        is_followed = k + 1 < len(texts) and texts[k + 1].startswith(sign)
        yield math(begun + '<mspace width="0.28em"/>' * is_followed)
