"""One row or one column of a matrix, as programs name it: `D(1,:) = [...]`, and the entries as written."""

from __future__ import annotations

from dataclasses import dataclass

from dynsolve.answers.reading.displays import OPENS
from dynsolve.answers.reading.grids import Grid
from dynsolve.answers.reading.left_side import NamedAnswers, read_left_side
from dynsolve.answers.reading.tokens.lexer import Token
from dynsolve.answers.reading.vocabulary import Vocabulary
from dynsolve.notation.tree import Node

_ALL = frozenset({":", "*", "cdot"})
_CLOSING = {"(": ")", "{": "}"}


@dataclass(frozen=True, slots=True)
class MatrixPart:
    """The entries of one row or column, by the names of their answers."""

    entries: tuple[str, ...]


def part_of(vocabulary: Vocabulary, member: list[Token]) -> MatrixPart | None:
    """The row or the column that a left side names, None for every other side."""
    if not 6 <= len(member) <= 10 or member[-2].kind not in (*_ALL, "number"):
        return None
    opening = len(member) - 5
    index = member[opening + 1 : -1]
    if _CLOSING.get(member[opening].kind) != member[-1].kind or index[1].kind != ",":
        return None
    name = member[:opening]
    name = name[:-1] if name[-1].kind == "_" else name
    side = read_left_side(vocabulary, name)
    if not isinstance(side, NamedAnswers) or len({t.kind in _ALL for t in (index[0], index[2])}) == 1:
        return None
    axis = 0 if index[2].kind in _ALL else 1
    number = index[2 * axis].text
    parts = vocabulary.quantities.parts(side.candidates[0])
    places = {part: vocabulary.quantities.entry_of(part)[1] for part in parts}
    found = [part for part, place in places.items() if len(place) == 2 and str(place[axis] + 1) == number]
    return MatrixPart(tuple(found)) if found else None


def written_entries(tokens: list[Token]) -> list[list[list[Token]]]:
    """The tokens of each entry of a matrix that is written out, row by row; none of anything else."""
    if len(tokens) > 4 and tokens[0].kind in ("[", "(") and tokens[1].kind == "begin":
        tokens = tokens[1:-1]
    if len(tokens) < 3 or (tokens[0].kind, tokens[-1].kind) not in (("begin", "close"), ("[", "]")):
        return []
    inside = tokens[1:-1]
    if tokens[0].kind == "begin":
        return [_cut(row, "&") for row in _cut(inside, "\\\\")]
    if inside[0].kind == "[":
        return [_cut(row[1:-1], ",") for row in _cut(inside, ",")]
    return [_cut(row, ",") for row in _cut(inside, ";")]


def _cut(tokens: list[Token], kind: str) -> list[list[Token]]:
    """The pieces between signs of a kind that stand in no bracket; an empty one only in a row of cells."""
    pieces: list[list[Token]] = [[]]
    level = 0
    for token in tokens:
        level += OPENS.get(token.kind, 0)
        if token.kind == kind and level == 0:
            pieces.append([])
        else:
            pieces[-1].append(token)
    return [piece for piece in pieces if piece or kind == "&"]


def entries_of(part: MatrixPart, value: object) -> list[tuple[str, Node]]:
    """The entries of a row or a column with their names; none where the value is of another length."""
    if not isinstance(value, Grid) or 1 not in value.shape:
        return []
    nodes = [node for row in value.rows for node in row]
    return list(zip(part.entries, nodes, strict=True)) if len(nodes) == len(part.entries) else []
