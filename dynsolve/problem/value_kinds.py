"""Kinds of values that several keys of a problem file have."""

from __future__ import annotations

from dynsolve.problem.kinds import Key, Keyed, ListOf, OneOf, Plain, Shared, Word

TEXT = Plain("a line of text", {"type": ["string", "number"]})
NUMBER = Plain("a number", {"type": ["string", "number"]})
NAME = Plain("a name", {"type": "string"})
EXPRESSION = Shared(
    "expression",
    Plain("an expression", {"type": ["string", "number"]}),
    "an expression",
    "A number, a name or a formula: m1*lc1^2, 9.81, sqrt(3)/2, 90deg.",
)
VECTOR = Shared("vector", ListOf(EXPRESSION, "", 3, 3), "`[x, y, z]`")
MATRIX = Shared("matrix", ListOf(VECTOR, "", 3, 3), "a 3×3 list")
ROTATION = Shared(
    "rotation",
    OneOf((Plain("`Rz(90deg) Rx(30deg)`", {"type": "string", "pattern": "^R[xyz] ?\\("}), MATRIX)),
    "a rotation",
    "A product of rotations, left to right: Rz(90deg) Rx(30deg); or a 3×3 list.",
)

# -- a point of a link -----------------------------------------------------------------------------

CENTERS = Word(("tip", "origin", "midpoint"))
ALONG = Keyed((Key("along", EXPRESSION, example="1/2", required=True),))
NEAR = Keyed((Key("near", VECTOR, example="[lc1, 0, 0]", required=True),))
DRAWN = Keyed((Key("drawn", VECTOR, example="[l1, 0, h]", required=True),))
MEASURED = Keyed((*ALONG.keys, *NEAR.keys, *DRAWN.keys))
PLACE = OneOf((CENTERS, ALONG, NEAR, DRAWN, VECTOR))
LINK = Plain("a whole number", {"type": "integer", "minimum": 1})
FRAME = Plain("a whole number", {"type": "integer", "minimum": 0})
