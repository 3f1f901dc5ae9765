"""The keys of `model`: a mechanism by positions, or given energies; see `specification`.

The keys about inertia matrices that are to be judged; see `specification`.
"""

from __future__ import annotations

from dynsolve.problem.kinds import (
    EXPRESSION,
    NAME,
    VECTOR,
    Expression,
    Key,
    Keyed,
    ListOf,
    MapOf,
    OneOf,
    Shared,
    ValueKind,
    Word,
    vector,
)

MAX_COORDINATES = 12
MAX_TURNS = 6

FIXED = "it is constant: coordinates stand in `at` and `turn`"

TYPES = Word(("revolute", "prismatic"))
COORDINATES = MapOf(TYPES, "types by name")
"""Coordinates with their types, in their order."""

TURN = Keyed(
    (
        Key(
            "by",
            EXPRESSION,
            "The angle, linear in the coordinates.",
            "phi",
            required=True,
            remedy="by: phi",
            own=True,
        ),
        Key(
            "about",
            vector(constant=FIXED),
            "Its axis, in the axes so far turned.",
            "[0, 0, 1]",
            "`[0, 0, 1]`",
            called="the axis of {last}",
        ),
    )
)
TURNS = OneOf((EXPRESSION, ListOf(Shared("turn", TURN, "a turn"), "a list of turns", 1, MAX_TURNS)))


def placed_body(tensor: ValueKind) -> Keyed:
    """The keys of a body that is given by its position; `tensor` is the kind of an inertia tensor."""
    return Keyed(
        (
            Key(
                "mass",
                Expression(constant=FIXED),
                "A symbol, a number or an expression.",
                "m",
                required=True,
                remedy="mass: m",
                called="the mass of {of}",
            ),
            Key("name", NAME, "Its index in symbols (K_1).", "p", "its place in the list"),
            Key(
                "at",
                VECTOR,
                "The mass centre in world coordinates, a function of the coordinates.",
                "[x + l*sin(theta), -l*cos(theta), 0]",
                required=True,
                remedy="at: [x, y, z], the mass centre as a function of the coordinates",
                called="the position of {of}",
            ),
            Key(
                "turn",
                TURNS,
                "The angle that it turns by, linear in the coordinates (theta - x/R); or a list of turns, "
                "each {by: phi, about: [0, 0, 1]}, about axes that those before it carry along.",
                "theta",
                "none",
                remedy="write turn: theta, or turn: [{by: phi, about: [0, 0, 1]}, ...]",
            ),
            Key(
                "about",
                vector(constant=FIXED),
                "The axis of `turn`, a unit vector.",
                "[0, 0, 1]",
                "`[0, 0, 1]`",
                called="the axis of {last}",
            ),
            Key(
                "inertia",
                tensor,
                "The tensor about the mass centre, along the axes that turn with the body.",
                "{zz: I}",
                "a point",
                remedy="write {zz: I}, {xx: ..., yy: ..., zz: ...} or a symmetric 3×3 list",
            ),
        )
    )


def model(body: Keyed, most_bodies: int) -> Keyed:
    """The keys of `model`."""
    rows = ListOf(ListOf(EXPRESSION, "", 1, MAX_COORDINATES), "rows of the matrix", 1, MAX_COORDINATES)
    return Keyed(
        (
            Key(
                "coordinates",
                COORDINATES,
                "The generalized coordinates, each `revolute` (an angle) or `prismatic` (a length).",
                "{x: prismatic, theta: revolute}",
                required=True,
                remedy="coordinates: {x: prismatic, theta: revolute}",
            ),
            Key(
                "bodies",
                ListOf(
                    Shared("placed_body", body, "a body"),
                    "a list of bodies",
                    1,
                    most_bodies,
                    empty="the model has no bodies",
                ),
                "The bodies by their positions; in their place D and P, K and P, or L.",
                "\n  - {mass: M, at: [x, 0, 0]}\n  - {mass: m, at: [x + l*sin(theta), -l*cos(theta), 0]}",
                remedy="a body is written {mass: m, at: [x, y, z]}",
            ),
            Key("D", rows, "The inertia matrix, n×n.", "[[a1, a2*cos(q2)], [a2*cos(q2), a3]]"),
            Key("K", EXPRESSION, "The kinetic energy, quadratic in the rates (x' or x_dot).", "m*x'^2/2"),
            Key("P", EXPRESSION, "The potential energy, with D or K.", "m*g*l*cos(theta)", "0"),
            Key("L", EXPRESSION, "The Lagrangian.", "m*x'^2/2 - k*x^2/2"),
        )
    )


# The keys about inertia matrices that are to be judged; see `specification`

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
