"""The keys of `model`: a mechanism by positions, or given energies; see `specification`."""

from __future__ import annotations

from dynsolve.problem.kinds import Key, Keyed, ListOf, MapOf, OneOf, Shared, ValueKind, Word
from dynsolve.problem.value_kinds import EXPRESSION, NAME, VECTOR

MAX_COORDINATES = 12
MAX_TURNS = 6

TYPES = Word(("revolute", "prismatic"))
COORDINATES = MapOf(TYPES, "types by name")
"""Coordinates with their types, in their order."""

TURN = Keyed(
    (
        Key(
            "by", EXPRESSION, "The angle, linear in the coordinates.", "phi", required=True, remedy="by: phi"
        ),
        Key("about", VECTOR, "Its axis, in the axes so far turned.", "[0, 0, 1]", "`[0, 0, 1]`"),
    )
)
TURNS = OneOf((EXPRESSION, ListOf(Shared("turn", TURN, "a turn"), "a list of turns", 1, MAX_TURNS)))


def placed_body(tensor: ValueKind) -> Keyed:
    """The keys of a body that is given by its position; `tensor` is the kind of an inertia tensor."""
    return Keyed(
        (
            Key(
                "mass",
                EXPRESSION,
                "A symbol, a number or an expression.",
                "m",
                required=True,
                remedy="mass: m",
            ),
            Key("name", NAME, "Its index in symbols (K_1).", "p", "its place in the list"),
            Key(
                "at",
                VECTOR,
                "The mass centre in world coordinates, a function of the coordinates.",
                "[x + l*sin(theta), -l*cos(theta), 0]",
                required=True,
                remedy="at: [x, y, z], the mass centre as a function of the coordinates",
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
            Key("about", VECTOR, "The axis of `turn`, a unit vector.", "[0, 0, 1]", "`[0, 0, 1]`"),
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
                ListOf(Shared("placed_body", body, "a body"), "a list of bodies", 1, most_bodies),
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
