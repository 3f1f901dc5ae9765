"""The keys of a problem file that say something of equilibria; see `problem.specification`."""

from __future__ import annotations

from dynsolve.problem.kinds import EXPRESSION, Key, Keyed, ListOf, MapOf, Word

INPUTS = Word(("given",))
BALANCE = Keyed(
    (Key("g", ListOf(EXPRESSION, "a list of expressions"), "The wanted g.", "[0, 0]", required=True),)
)

INPUTS_KEY = Key(
    "inputs",
    INPUTS,
    "Whether motors hold their coordinates in equilibria, and only what is passive must be in balance.",
    "given",
    "no motor holds anything",
    remedy="write inputs: given",
)
BALANCE_KEY = Key(
    "balance",
    BALANCE,
    "The g(q) that the parameters are to give in `balance`, an expression for each coordinate.",
    "{g: [0, 0]}",
    "0",
    remedy="write balance: {g: [0, k*cos(q2)]}, an expression for each coordinate",
)
LINEARIZE = Key(
    "linearize",
    MapOf(EXPRESSION, "values by coordinate"),
    "The equilibrium of linear_A and linear_B, where motors hold what they can.",
    "{theta1: 0, L2: 0}",
    remedy="write linearize: {q1: 0, q2: 90deg}, the coordinates of the equilibrium",
)
STEADY = Key(
    "steady",
    MapOf(EXPRESSION, "rates by coordinate"),
    "Coordinates whose rates are constant: `equilibria` are then those of the others in this motion.",
    "{theta1: W}",
    "nothing moves",
    remedy="write steady: {q1: W}, a coordinate with its constant rate",
)

KEYS = (INPUTS_KEY, BALANCE_KEY, LINEARIZE, STEADY)
