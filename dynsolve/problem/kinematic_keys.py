"""The keys of a problem file that ask something of the kinematics; see `specification`."""

from __future__ import annotations

from dynsolve.problem.kinds import Key, Keyed, ListOf, MapOf, OneOf, Shared, Word
from dynsolve.problem.value_kinds import EXPRESSION, LINK, PLACE

MAX_POINTS = 20
MAX_TASK = 12

POINT = Keyed(
    (
        Key(
            "link",
            LINK,
            "The row of the table that it moves with.",
            "2",
            required=True,
            remedy="link: 1, the row of the table that the point moves with",
        ),
        Key(
            "at",
            PLACE,
            "Where it is, as `center` of a body says it.",
            "{near: [lc2, 0, 0]}",
            "tip",
            remedy="write tip, origin, midpoint, {along: 1/2}, {near: [l, 0, 0]} or [x, y, z]",
        ),
    )
)

TWIST = Word(("twist",))

KINEMATIC_KEYS = (
    Key(
        "points",
        MapOf(Shared("point", POINT, "a point"), "points by name"),
        "Named points of links, for `task` and for answers: pP, vP, JvP, JwP of a point P.",
        "{P: {link: 2, at: tip}}",
        remedy="write points: {P: {link: 2, at: {near: [lc2, 0, 0]}}}",
    ),
    Key(
        "task",
        OneOf((ListOf(EXPRESSION, "a list of expressions", 1, MAX_TASK), TWIST)),
        "What the arm is to do, r(q): coordinates of the tip or of a point (tip.x, P.y), and of the joints; "
        "or twist, the six rates of the last frame. Default: the coordinates of the tip that move.",
        "[tip.x, tip.y]",
        "the coordinates of the tip that move",
        remedy="write task: [tip.x, tip.y, q1 + q2], or task: twist",
    ),
)
"""The keys, in the order of the documentation."""
