"""≈ where a number is printed rounded.

A number that ends within the digits that are shown is written whole, and = stands before it.  Any other is
rounded where it is printed, and ≈ stands between the members of an equation of which one is rounded.
"""

from __future__ import annotations

from msgspec.structs import replace

from dynsolve.notation.printing import Style
from dynsolve.notation.tree import Node, Number, Relation, Row, Words, has_part, with_children


def marked(node: Node, style: Style) -> Node:
    """A formula with ≈ for = where a number on either side is rounded.

    >>> from dynsolve.notation.tree import Symbol, equation
    >>> from dynsolve.notation.unicode import to_unicode
    >>> style = Style(decimal=True, digits=6)
    >>> to_unicode(marked(equation(Symbol("I"), Number(5, 96)), style), style)
    'I ≈ 0.0520833'
    >>> to_unicode(marked(equation(Symbol("I"), Number(5, 32)), style), style)
    'I = 0.15625'
    """
    if not isinstance(node, Relation):
        return with_children(node, lambda part: marked(part, style)) if isinstance(node, Row) else node
    rounded = [is_rounded(part, style) for part in node.parts]
    signs = (
        "≈" if sign == "=" and (rounded[k] or rounded[k + 1]) else sign for k, sign in enumerate(node.signs)
    )
    return replace(node, signs=tuple(signs))


def marked_among_words(node: Node, style: Style) -> Node:
    """The same of a formula among words, where ≈ stands before a rounded number that no equation has.

    >>> from dynsolve.notation.unicode import to_unicode
    >>> style = Style(decimal=True, digits=6)
    >>> to_unicode(marked_among_words(Number(1, 3), style), style)
    '≈ 0.333333'
    """
    in_equation = has_part(node, lambda part: isinstance(part, Relation))
    if in_equation or not is_rounded(node, style):
        return marked(node, style)
    return Row((Words("≈ "), node))


def is_rounded(node: Node, style: Style) -> bool:
    """Whether a number in a formula is printed rounded."""
    return has_part(node, lambda part: isinstance(part, Number) and style.rounds(part))
