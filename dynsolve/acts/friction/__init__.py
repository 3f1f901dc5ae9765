"""Friction of the joints; see `dynsolve.acts`."""

from __future__ import annotations

from dynsolve.problem.kinds import OF_PROBLEM, VISCOUS, Expression, Key, Keyed, MapOf, OneOf, Shared

FRICTION = Keyed(
    (
        Key("viscous", VISCOUS, "f_v of viscous friction: f_v q̇.", "fv1", "0"),
        Key(
            "coulomb",
            Expression("a coefficient of Coulomb friction", OF_PROBLEM),
            "f_c of Coulomb friction: f_c sgn(q̇).",
            "fc1",
            "0",
        ),
    ),
    least=1,
)

KEY = Key(
    "friction",
    MapOf(
        OneOf((VISCOUS, Shared("friction", FRICTION, "`{viscous, coulomb}`"))),
        "friction by coordinate",
    ),
    "Friction of the joints, f_v q̇ + f_c sgn(q̇); a bare value is f_v.",
    "{theta1: {viscous: fv1, coulomb: fc1}, L2: fv2}",
    "none",
    remedy="write friction: {q1: fv1}, or friction: {q1: {viscous: fv1, coulomb: fc1}}",
)
