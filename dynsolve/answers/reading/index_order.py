r"""Which index of a Christoffel symbol counts the row, where a report defines its own.

Spong's c_ijk = ½ (∂d_kj/∂q_i + ∂d_ki/∂q_j - ∂d_ij/∂q_k) has the row last; Siciliano's c_ijk and the Γ_ijk
of Murray, Li and Sastry and of Lynch and Park have it first.  In every one of them the row is
the index that the term with the minus is derived by.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise

from dynsolve.answers.reading.tokens.lexer import Token

USUAL: Mapping[str, int] = {"Gamma": 0}
"""The place of the row in the index of a letter, where it is not the last."""

_MOST_TOKENS = 200


def defined_order(members: Sequence[list[Token]]) -> tuple[str, int] | None:
    """The letter that a chain defines as a Christoffel symbol, and the place of the row in its index."""
    letter, index = _indexed(members[0])
    if len(index) != 3 or len(set(index)) != 3 or not index.isalpha() or len(members[-1]) > _MOST_TOKENS:
        return None
    terms = list(_derivatives(members[-1]))
    minus = [variable for sign, variable in terms if sign == "-"]
    if len(terms) != 3 or len(minus) != 1 or minus[0] not in index:
        return None
    return letter, index.index(minus[0])


def order_of_pair(members: Sequence[list[Token]]) -> dict[str, int]:
    """The place of the row by the letter, where a chain says c_112 = c_121: it is what both begin with.

    Symbols are equal in the two indices that do not count the row.
    """
    found = [_indexed(member) for member in members]
    named = [(letter, index) for letter, index in found if len(index) == 3 and index.isdecimal()]
    for (letter, first), (other, second) in pairwise(named):
        if letter == other and first != second and first[0] == second[0] and first[1:] == second[:0:-1]:
            return {letter: 0}
    return {}


def in_usual_order(name: str, orders: Mapping[str, int]) -> str:
    """The key of a Christoffel symbol with the row last: c112 for a Γ112 whose row is first."""
    letter, index = name[:-3], name[-3:]
    place = orders.get(letter)
    if place is None or not index.isdecimal():
        return name
    return f"c{index[:place]}{index[place + 1 :]}{index[place]}"


def _indexed(member: list[Token]) -> tuple[str, str]:
    """A name and its index; empty for any other side."""
    words = [t.text for t in member if t.kind in ("name", "letter")]
    if len(member) > 8 or not words or len(words) > 2:
        return "", ""
    letter, _, index = "_".join(words).partition("_")
    return letter, index.strip("{}").replace(",", "").replace(" ", "")


def _derivatives(member: list[Token]) -> Iterator[tuple[str, str]]:
    r"""The sign of every `\frac{\partial d_{ij}}{\partial q_k}`, and the index of its variable."""
    sign = "+"
    for position, token in enumerate(member):
        if token.kind in ("+", "-"):
            sign = token.kind
        elif token.text == "partial" and _is_below(member, position):
            variable = next((t for t in member[position + 1 :] if t.kind in ("name", "letter")), token)
            index = variable.text.rstrip("}")[-1:]
            if variable.kind == "letter" or "_" not in variable.text:
                after = [t for t in member[position + 2 : position + 5] if t.kind == "name"]
                index = after[0].text[-1:] if after else index
            yield sign, index


def _is_below(member: list[Token], position: int) -> bool:
    r"""Whether the ∂ there begins what stands below a bar: `}{\partial` or `/ \partial`."""
    before = [t.kind for t in member[max(position - 2, 0) : position]]
    return before == ["}", "{"] or before[-1:] == ["/"]
