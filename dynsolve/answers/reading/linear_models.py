r"""Linear models as they are written out: `\dot x = [...] x + [...] u` gives A and B.

What the state is called does not matter: the matrix that begins each term is taken.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from dynsolve.answers.reading.answer_list import Member
from dynsolve.answers.reading.displays import OPENS
from dynsolve.answers.reading.grids import Grid
from dynsolve.answers.reading.motion_equations import signed_terms
from dynsolve.answers.reading.right_side import RightSide, read_right_side
from dynsolve.answers.reading.tokens.lexer import Token
from dynsolve.answers.reading.vocabulary import Vocabulary

_NAMES = ("linear_A", "linear_B")


def linear_parts(vocabulary: Vocabulary, members: Sequence[list[Token]]) -> Iterator[tuple[str, Member]]:
    """A and B with their names, of the chain ẋ = A x + B u; nothing of every other chain."""
    if len(members) != 2 or _NAMES[0] not in vocabulary.quantities or _block(members[0]) == members[0]:
        return
    terms = signed_terms(members[1])
    blocks = [_block(tokens) for tokens, _ in terms]
    if len(terms) > 2 or any(negative for _, negative in terms):
        return
    if any(not block or len(block) == len(tokens) for block, (tokens, _) in zip(blocks, terms, strict=True)):
        return
    made = [Member(1, block, read_right_side(vocabulary, block)) for block in blocks]
    n = 2 * len(vocabulary.coordinates)
    shapes = [
        member.found.value.shape
        for member in made
        if isinstance(member.found, RightSide) and isinstance(member.found.value, Grid)
    ]
    if shapes[:1] == [(n, n)] and len(shapes) == len(made) and all(rows == n for rows, _ in shapes):
        yield from zip(_NAMES, made, strict=False)


def _block(tokens: Sequence[Token]) -> list[Token]:
    """The matrix that tokens begin with; empty where they begin with none."""
    if not tokens or tokens[0].kind != "begin":
        return []
    level = 0
    for position, token in enumerate(tokens, 1):
        level += OPENS.get(token.kind, 0)
        if level == 0:
            return list(tokens[:position])
    return []
