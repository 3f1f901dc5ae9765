"""The keys of a problem file that ask something of the kinematics; see `specification`."""

from __future__ import annotations

from dynsolve.problem.kinds import (
    EXPRESSION,
    FRAME,
    LINK,
    PLACE,
    ROTATION,
    VECTOR,
    Key,
    Keyed,
    ListOf,
    MapOf,
    OneOf,
    Shared,
    Word,
)

MAX_POINTS = 20
MAX_FORCES = 20
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
ALL = Word(("all",))
REACHED = Word(("reach",))
BY_INERTIA = Word(("D",))
BY = Word(("world", "robot"))

FORCE = Keyed(
    (
        Key(
            "link",
            LINK,
            "The row of the table with whose frame the link moves.",
            "2",
            required=True,
            remedy="link: 1, the row of the table of the link that the force acts on",
        ),
        Key(
            "at",
            PLACE,
            "Where it acts, as `center` of a body says it.",
            "tip",
            "tip",
            remedy="write tip, origin, midpoint, {along: 1/2}, {near: [l, 0, 0]} or [x, y, z]",
        ),
        Key("force", VECTOR, "The force.", "[Fx, Fy, 0]", "none", remedy="write force: [Fx, Fy, 0]"),
        Key("moment", VECTOR, "The moment.", "[0, 0, Mz]", "none", remedy="write moment: [0, 0, Mz]"),
        Key(
            "in",
            OneOf((IN_LINK, ROTATION)),
            "The axes of both: `link`, those of frame i, or a rotation relative to them.",
            "link",
            "those of the world",
        ),
        Key(
            "by",
            BY,
            "Who exerts it; what the `robot` exerts acts on it with the opposite sign.",
            "robot",
            "world",
        ),
    )
)

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
    ),
    Key(
        "reach",
        ListOf(EXPRESSION, "a list of names, or of numbers", 1, MAX_TASK),
        "What the values of r(q) are called in the inverse kinematics, or what they are: numbers, and "
        "expressions of parameters that have a number in `values`; of a pose the position, and the rows of "
        "the rotation behind it.",
        "[px, py]",
        "r1, r2, ...; of a pose x, y, z, r11, ..., r33",
        remedy="write reach: [px, py], a name or a number for each component of the task",
    ),
    Key(
        "branches",
        ALL,
        "Whether every branch of the inverse kinematics is asked for; else some are enough.",
        "all",
    ),
    Key(
        "limits",
        MapOf(ListOf(EXPRESSION, "`[low, high]`", 2, 2), "ranges by coordinate"),
        "Ranges of the coordinates: they mark the branches of the inverse kinematics, and remove none.",
        "{theta1: [-90deg, 90deg]}",
        "none",
        remedy="write limits: {theta1: [-90deg, 90deg], d2: [0, 1/2]}",
    ),
    Key(
        "forces",
        ListOf(Shared("force", FORCE, "a force"), "a list of forces", 0, MAX_FORCES),
        "Forces and moments that act on links from outside.",
        "[{link: 2, at: tip, force: [Fx, Fy, 0], moment: [0, 0, Mz]}]",
        "none",
        remedy="a force is written {link: 2, at: tip, force: [Fx, Fy, 0], moment: [0, 0, Mz]}",
    ),
    Key(
        "state",
        OneOf((MapOf(EXPRESSION, "values by coordinate"), REACHED)),
        "Where Q, tau_static, rates and spaces are asked for: values of coordinates and their rates (q1'); "
        "or reach, the one configuration within `limits` that reaches the numbers of `reach`.",
        "{theta1: 90deg, theta1': 1}",
        "every q",
        remedy="write state: {q1: 90deg, q1': 1}",
    ),
    Key(
        "velocity",
        ListOf(EXPRESSION, "a list of expressions", 1, MAX_TASK),
        "The velocity of the task, for which the rates qd are asked.",
        "[vx, vy]",
        remedy="write velocity: [vx, vy], an expression for each component of the task",
    ),
    Key(
        "acceleration",
        ListOf(EXPRESSION, "a list of expressions", 1, MAX_TASK),
        "The acceleration of the task, for which the accelerations qdd are asked.",
        "[0, 0]",
        remedy="write acceleration: [0, 0], an expression for each component of the task",
    ),
    Key(
        "weights",
        OneOf(
            (
                MapOf(EXPRESSION, "weights by coordinate"),
                ListOf(ListOf(EXPRESSION, "a row", 1), "a matrix W", 1),
                BY_INERTIA,
            )
        ),
        "Where many rates qd or accelerations qdd do, those with the least q̇ᵀ W q̇ are meant: W is diagonal, "
        "a matrix, or the inertia matrix D.",
        "{theta1: 2, L2: 1}",
        "1 for each coordinate",
        remedy="write weights: {q1: 2, q2: w}, a matrix [[2, 0], [0, w]], or D",
    ),
)
"""The keys, in the order of the documentation."""
