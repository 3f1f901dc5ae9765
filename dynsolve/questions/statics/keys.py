"""The key of a problem file that says which forces act from outside; see `problem.specification`."""

from __future__ import annotations

from dynsolve.problem.kinds import LINK, PLACE, ROTATION, VECTOR, Key, Keyed, ListOf, OneOf, Shared, Word
from dynsolve.problem.kinematic_keys import IN_LINK

MAX_FORCES = 20
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
FORCES = Key(
    "forces",
    ListOf(Shared("force", FORCE, "a force"), "a list of forces", 0, MAX_FORCES),
    "Forces and moments that act on links from outside.",
    "[{link: 2, at: tip, force: [Fx, Fy, 0], moment: [0, 0, Mz]}]",
    "none",
    remedy="a force is written {link: 2, at: tip, force: [Fx, Fy, 0], moment: [0, 0, Mz]}",
)

KEYS = (FORCES,)
