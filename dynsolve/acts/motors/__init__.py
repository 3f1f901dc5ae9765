"""Motors, of which the rotors have moments of inertia; see `dynsolve.acts`."""

from __future__ import annotations

from dynsolve.problem.kinds import (
    LINK,
    OF_PROBLEM,
    PARAMETER,
    Coordinate,
    Expression,
    Key,
    Keyed,
    Link,
    Word,
    list_of,
)
from dynsolve.robot.shapes import AXES

MOTOR = Keyed(
    (
        Key(
            "turns",
            Coordinate("a name", {"type": "string"}, new=True),
            "The coordinate that it turns; with a star, a new angle that it turns alone, as in an elastic "
            "joint.",
            "q1",
            required=True,
            remedy="write turns: q1, a coordinate of the table, or turns: thm1*, a new angle",
        ),
        Key(
            "inertia",
            Expression("a moment of inertia", OF_PROBLEM),
            "The moment of inertia of the rotor about its axis.",
            "Im1",
            required=True,
        ),
        Key("ratio", PARAMETER, "The ratio of its gear: it turns so much faster.", "kr1", "1"),
        Key(
            "carrier",
            Link(LINK.called, LINK.json, "which carries a motor that has no `carrier`"),
            "The link that carries the motor round.",
            "1",
            "the ground",
        ),
        Key(
            "axis",
            Word(AXES),
            "The axis of frame `carrier` that it spins about.",
            "z",
            "z",
            called="axis of {of}",
        ),
    )
)

KEY = Key(
    "motors",
    list_of("motor", MOTOR),
    "Rotors of motors: what they turn, their moment of inertia, their gear. Their mass is a body's.",
    "[{turns: theta1, inertia: Im1, ratio: kr1}]",
    "none",
    remedy="a motor is written {turns: q1, inertia: Im1, ratio: kr1, carrier: 1}",
)
