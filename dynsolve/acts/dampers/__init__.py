"""Dampers; see `dynsolve.acts`."""

from __future__ import annotations

from dynsolve.problem.kinds import EXPRESSION, VISCOUS, Key, Keyed, list_of

DAMPER = Keyed(
    (
        Key("damping", VISCOUS, "b of the force b ẋ.", "b", required=True),
        Key("of", EXPRESSION, "x, linear in the coordinates.", "q2 - q1", required=True),
    )
)

KEY = Key(
    "dampers",
    list_of("damper", DAMPER),
    "Dampers, the force b ẋ with x linear in the coordinates.",
    "[{damping: b, of: L2}]",
    "none",
    remedy="a damper is written {damping: b, of: q2 - q1}",
)
