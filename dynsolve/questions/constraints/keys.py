"""The key of a problem file that constrains the motion; see `problem.specification`."""

from __future__ import annotations

from dynsolve.problem.kinds import EXPRESSION, Key, Keyed, ListOf, OneOf

MAX_CONSTRAINTS = 20

RATES = Keyed(
    (
        Key(
            "rates",
            EXPRESSION,
            "What is 0, linear in the rates.",
            "x'*sin(phi) - y'*cos(phi)",
            required=True,
            remedy="write {rates: x'*sin(phi) - y'*cos(phi)}",
        ),
    )
)

KEYS = (
    Key(
        "constraints",
        ListOf(OneOf((EXPRESSION, RATES)), "a list of constraints", 1, MAX_CONSTRAINTS),
        "What the motion keeps at 0: h(q), in which tip.x and P.y are coordinates of points, or "
        "{rates: ...}, linear in the rates.",
        "[tip.x - k]",
        "none",
        remedy="write constraints: [tip.x - k], or [{rates: x'*sin(phi) - y'*cos(phi)}]",
    ),
)
