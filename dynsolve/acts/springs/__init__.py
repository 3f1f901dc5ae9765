"""Springs: linear ones, and by their energies; see `dynsolve.acts`."""

from __future__ import annotations

from dynsolve.problem.kinds import EXPRESSION, OF_PROBLEM, PARAMETER, Expression, Key, Keyed, list_of

SPRING = Keyed(
    (
        Key(
            "stiffness",
            Expression("a stiffness", OF_PROBLEM),
            "k of a linear spring, of the energy ½ k (x - rest)².",
            "k",
        ),
        Key("of", EXPRESSION, "x, linear in the coordinates.", "q2 - q1"),
        Key("rest", PARAMETER, "Where the spring is relaxed.", "delta", "0"),
        Key(
            "energy",
            EXPRESSION,
            "In place of these the energy itself, a function of the coordinates.",
            "k*(1 - cos(q1))",
        ),
    ),
    least=1,
)

KEY = Key(
    "springs",
    list_of("spring", SPRING),
    "Springs, ½ k (x - rest)² with x linear in the coordinates, or by their energy.",
    "[{stiffness: k, of: L2, rest: L0}]",
    "none",
    remedy="a spring is written {stiffness: k, of: q2 - q1, rest: delta} or {energy: k*(1 - cos(q1))}",
)
