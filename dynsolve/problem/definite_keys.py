"""The keys about inertia matrices that are to be judged; see `specification`."""

from __future__ import annotations

from dynsolve.problem.kinds import Key, ListOf, MapOf, OneOf, Word
from dynsolve.problem.mechanism_keys import MAX_COORDINATES
from dynsolve.problem.value_kinds import EXPRESSION, NAME

MAX_CANDIDATES = 20
MAX_ASSUMED = 20
CHAIN = Word(("relative",))

_MATRIX = ListOf(ListOf(EXPRESSION, "", 1, MAX_COORDINATES), "rows of a matrix", 1, MAX_COORDINATES)
_INEQUALITIES = ListOf(NAME, "a list of inequalities", 0, MAX_ASSUMED)

CANDIDATES = Key(
    "candidates",
    MapOf(_MATRIX, "matrices by name"),
    "In place of a robot: matrices of which `definite` asks whether they can be inertia matrices.",
    "{Ma: [[a1, a2*cos(q2)], [a2*cos(q2), a3]]}",
    "none",
    remedy="write candidates: {Ma: [[a1, a2*cos(q2)], [a2*cos(q2), a3]], Mb: ...}",
)
ASSUME = Key(
    "assume",
    OneOf((_INEQUALITIES, MapOf(_INEQUALITIES, "inequalities by the name of a candidate"))),
    "Inequalities between parameters that hold, for `definite` and `equilibria`; of candidates also by name.",
    "[a1 > 0, a1*a3 > a2^2]",
    "none",
    remedy="write assume: [a1 > a2, a2 > 0], or of candidates {Ma: [a1 > a2], Mb: [...]}",
)
CHAIN_KEY = Key(
    "chain",
    CHAIN,
    "Whether the coordinates of the candidates are relative, so that the first one may not occur.",
    "relative",
    remedy="write chain: relative",
)
DEFINITE_KEYS = (CANDIDATES, ASSUME, CHAIN_KEY)
