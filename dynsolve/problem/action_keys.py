"""The keys of a problem file that say what acts on the robot beside gravity; see `specification`."""

from __future__ import annotations

from dynsolve.problem.kinds import Key, Keyed, ListOf, MapOf, OneOf, Shared, Word
from dynsolve.problem.value_kinds import EXPRESSION, LINK, NAME
from dynsolve.robot.shapes import AXES

MOST_ACTIONS = 20
"""The most springs, dampers and motors that are read, of each."""

FRICTION = Keyed(
    (
        Key("viscous", EXPRESSION, "f_v of viscous friction: f_v q̇.", "fv1", "0"),
        Key("coulomb", EXPRESSION, "f_c of Coulomb friction: f_c sgn(q̇).", "fc1", "0"),
    ),
    least=1,
)

SPRING = Keyed(
    (
        Key("stiffness", EXPRESSION, "k of a linear spring, of the energy ½ k (x - rest)².", "k"),
        Key("of", EXPRESSION, "x, linear in the coordinates.", "q2 - q1"),
        Key("rest", EXPRESSION, "Where the spring is relaxed.", "delta", "0"),
        Key(
            "energy",
            EXPRESSION,
            "In place of these the energy itself, a function of the coordinates.",
            "k*(1 - cos(q1))",
        ),
    ),
    least=1,
)

DAMPER = Keyed(
    (
        Key("damping", EXPRESSION, "b of the force b ẋ.", "b", required=True),
        Key("of", EXPRESSION, "x, linear in the coordinates.", "q2 - q1", required=True),
    )
)

ROTOR_AXIS = Word(AXES)

MOTOR = Keyed(
    (
        Key(
            "turns",
            NAME,
            "The coordinate that it turns; with a star, a new angle that it turns alone, as in an elastic "
            "joint.",
            "q1",
            required=True,
            remedy="write turns: q1, a coordinate of the table, or turns: thm1*, a new angle",
        ),
        Key(
            "inertia", EXPRESSION, "The moment of inertia of the rotor about its axis.", "Im1", required=True
        ),
        Key("ratio", EXPRESSION, "The ratio of its gear: it turns so much faster.", "kr1", "1"),
        Key("carrier", LINK, "The link that carries the motor round.", "1", "the ground"),
        Key("axis", ROTOR_AXIS, "The axis of frame `carrier` that it spins about.", "z", "z"),
    )
)

ACTION_KEYS = (
    Key(
        "friction",
        MapOf(
            OneOf((EXPRESSION, Shared("friction", FRICTION, "`{viscous, coulomb}`"))),
            "friction by coordinate",
        ),
        "Friction of the joints, f_v q̇ + f_c sgn(q̇); a bare value is f_v.",
        "{theta1: {viscous: fv1, coulomb: fc1}, L2: fv2}",
        "none",
        remedy="write friction: {q1: fv1}, or friction: {q1: {viscous: fv1, coulomb: fc1}}",
    ),
    Key(
        "springs",
        ListOf(Shared("spring", SPRING, "a spring"), "a list of springs", 0, MOST_ACTIONS),
        "Springs, ½ k (x - rest)² with x linear in the coordinates, or by their energy.",
        "[{stiffness: k, of: L2, rest: L0}]",
        "none",
        remedy="a spring is written {stiffness: k, of: q2 - q1, rest: delta} or {energy: k*(1 - cos(q1))}",
    ),
    Key(
        "dampers",
        ListOf(Shared("damper", DAMPER, "a damper"), "a list of dampers", 0, MOST_ACTIONS),
        "Dampers, the force b ẋ with x linear in the coordinates.",
        "[{damping: b, of: L2}]",
        "none",
        remedy="a damper is written {damping: b, of: q2 - q1}",
    ),
    Key(
        "motors",
        ListOf(Shared("motor", MOTOR, "a motor"), "a list of motors", 0, MOST_ACTIONS),
        "Rotors of motors: what they turn, their moment of inertia, their gear. Their mass is a body's.",
        "[{turns: theta1, inertia: Im1, ratio: kr1}]",
        "none",
        remedy="a motor is written {turns: q1, inertia: Im1, ratio: kr1, carrier: 1}",
    ),
    Key(
        "passive",
        ListOf(NAME, "a list of names"),
        "Coordinates without a motor: their generalized force is 0.",
        "[L2]",
        "none",
        remedy="write passive: [q2], the coordinates that no motor drives",
    ),
)
"""The keys, in the order of the documentation."""
