"""The key of a problem file that says which parameters are known; see `problem.specification`."""

from __future__ import annotations

from dynsolve.problem.kinds import EXPRESSION, NAME, Key, ListOf, MapOf, OneOf

KNOWN = "known"
"""The key of `parameters` that names parameters which do not count as unknown."""

MAX_PARAMETERS = 60

KEYS = (
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
)
