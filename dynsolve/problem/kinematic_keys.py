"""The keys of a problem file that ask something of the kinematics; see `specification`."""

from __future__ import annotations

from dynsolve.problem.kinds import (
    EXPRESSION,
    FRAME,
    LINK,
    PLACE,
    Key,
    Keyed,
    ListOf,
    MapOf,
    OneOf,
    Shared,
    Word,
)
from dynsolve.quantities.families import FAMILIES

MAX_POINTS = 20
MAX_TASK = 12

IN_LINK = Word(("link",))

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
        Key(
            "in",
            OneOf((IN_LINK, FRAME)),
            "The axes along which vP, JvP and JwP are written: `link`, those of its own frame, or the number "
            "of a frame.",
            "link",
            "those of the world",
            remedy="write in: link, or in: 0, the number of a frame",
        ),
    )
)

WHOLE = Word(("twist", "pose"))
REACHED = Word(("reach",))

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
        OneOf((ListOf(EXPRESSION, "a list of expressions", 1, MAX_TASK), WHOLE)),
        "What the arm is to do, r(q): coordinates of the tip or of a point (tip.x, P.y), and of the joints; "
        "or twist, the six rates of the last frame; or pose, its position and rotation, with these rates. "
        "Default: the coordinates of the tip that move.",
        "[tip.x, tip.y]",
        "the coordinates of the tip that move",
        remedy="write task: [tip.x, tip.y, q1 + q2], task: pose, or task: twist",
        serves=(
            "r",
            "Jr",
            "Jr_dot",
            "det",
            "qd",
            "qdd",
            "singular",
            "inverse",
            "nullspace",
            "rangespace",
            "lost",
        ),
    ),
    Key(
        "state",
        OneOf((MapOf(EXPRESSION, "values by coordinate"), REACHED)),
        "Where Q, tau_static, rates and spaces are asked for: values of coordinates and their rates (q1'); "
        "or reach, the one configuration within `limits` that reaches the numbers of `reach`.",
        "{theta1: 90deg, theta1': 1}",
        "every q",
        remedy="write state: {q1: 90deg, q1': 1}",
        serves=tuple(dict.fromkeys(family.stem for family in FAMILIES if family.at_state)),
    ),
)
"""The keys, in the order of the documentation."""
