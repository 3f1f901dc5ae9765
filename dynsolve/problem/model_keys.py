"""The keys of a problem file that ask something of the equations of motion; see `specification`."""

from __future__ import annotations

from dynsolve.problem.kinds import Key, Keyed, ListOf, MapOf, OneOf, Word
from dynsolve.problem.value_kinds import EXPRESSION, NAME

KNOWN = "known"
"""The key of `parameters` that names parameters which do not count as unknown."""

MAX_PARAMETERS = 60

INPUTS = Word(("given",))
BALANCE = Keyed(
    (Key("g", ListOf(EXPRESSION, "a list of expressions"), "The wanted g.", "[0, 0]", required=True),)
)

MODEL_KEYS = (
    Key(
        "parameters",
        MapOf(
            OneOf((ListOf(NAME, "a list of names"), EXPRESSION)),
            "expressions by name, and the list `known`",
        ),
        "For Y and a: `known`, the parameters that do not count as unknown (all others do); the entries of "
        "a, where they are given: {a1: I1 + m2*l1^2}.",
        "{known: [L1, g]}",
        "all are unknown",
        remedy="write parameters: {known: [l1, g]}, or the entries of a: {a1: I1 + m2*l1^2, a2: m2*l1}",
    ),
    Key(
        "inputs",
        INPUTS,
        "Whether motors hold their coordinates in equilibria, and only what is passive must be in balance.",
        "given",
        "no motor holds anything",
        remedy="write inputs: given",
    ),
    Key(
        "balance",
        BALANCE,
        "The g(q) that the parameters are to give in `balance`, an expression for each coordinate.",
        "{g: [0, 0]}",
        "0",
        remedy="write balance: {g: [0, k*cos(q2)]}, an expression for each coordinate",
    ),
    Key(
        "linearize",
        MapOf(EXPRESSION, "values by coordinate"),
        "The equilibrium of linear_A and linear_B, where motors hold what they can.",
        "{theta1: 0, L2: 0}",
        remedy="write linearize: {q1: 0, q2: 90deg}, the coordinates of the equilibrium",
    ),
    Key(
        "steady",
        MapOf(EXPRESSION, "rates by coordinate"),
        "Coordinates whose rates are constant: `equilibria` are then those of the others in this motion.",
        "{theta1: W}",
        "nothing moves",
        remedy="write steady: {q1: W}, a coordinate with its constant rate",
    ),
)
"""The keys, in the order of the documentation."""
