"""Every key of a problem file, said once.

A `Key` has a name, a kind of value, one sentence on what it means, an example and a
default.  From these records come

- the keys, the words and the limits that the reader knows, and what it advises
  (`table.py`, `bodies.py`, `base.py`, `exercise.py`),
- the JSON Schema (`schema.py`),
- the commented file that `dynsolve new` writes (`documentation.py`),
- the tables of keys in `problems/README.md` (`documentation.py`).

To add a key, write its record here (or in a file of keys, as `kinematic_keys`), read it with `Fields.get` in
the module it belongs to, and give what was read a place in `Problem` or `Robot`.  The keys of a question are
in its own folder, in `keys`.
"""

from __future__ import annotations

from dynsolve.problem.kinds import (
    COORDINATE,
    EXPRESSION,
    FRAME,
    LINK,
    MATRIX,
    NAME,
    NUMBER,
    PLACE,
    ROTATION,
    TEXT,
    VECTOR,
    Expression,
    Key,
    Keyed,
    Link,
    ListOf,
    MapOf,
    OneOf,
    Plain,
    Shared,
    Word,
)
from dynsolve.problem.kinematic_keys import KINEMATIC_KEYS
from dynsolve.problem.model_keys import COORDINATES, DEFINITE_KEYS, model, placed_body
from dynsolve.quantities.stages import ASKED_FOR
from dynsolve.robot.actions import keys_of_kinds
from dynsolve.robot.model import Convention
from dynsolve.robot.shapes import AXES, KINDS

# -- a row of the table ----------------------------------------------------------------------------

ROW = Keyed(
    (
        Key(
            "theta",
            EXPRESSION,
            "θ, the turn about z. A star marks the variable of a revolute joint: theta1*.",
            "theta1* + 90deg",
            "0",
        ),
        Key(
            "d",
            EXPRESSION,
            "d, the way along z. A star marks the variable of a prismatic joint: d2*.",
            "L2*",
            "0",
        ),
        Key("a", EXPRESSION, "a, the way along x. Constant.", "l1", "0"),
        Key("alpha", EXPRESSION, "α, the turn about x. Constant.", "90deg", "0"),
        Key(
            "from",
            FRAME,
            "The row whose frame it starts from, 0 for the base: a tree.",
            "1",
            "the row before",
        ),
    )
)

# -- a drawing in the table's place -----------------------------------------------------------------

DRAWN_AXIS = Keyed(
    (
        Key("turn", NAME, "The coordinate of a revolute joint.", "theta1"),
        Key("slide", NAME, "The coordinate of a prismatic joint.", "d3"),
        Key(
            "about",
            VECTOR,
            "The direction that it turns about.",
            "[0, 0, 1]",
            called="the direction of {of}",
        ),
        Key(
            "along",
            VECTOR,
            "The direction that it slides along.",
            "[cos(30deg), 0, sin(30deg)]",
            called="the direction of {of}",
        ),
        Key(
            "through",
            VECTOR,
            "A point of the axis; a sliding axis may be without.",
            "[0, 0, L1]",
            called="the point of {of}",
        ),
    )
)
HAND = Keyed(
    (
        Key("at", VECTOR, "Where the hand is.", "[a2 + d3, 0, L1]", required=True),
        Key("z", VECTOR, "The direction of its z.", "[1, 0, 0]"),
        Key("x", VECTOR, "The direction of its x.", "[0, 0, 1]"),
    )
)
ZERO = Word(("table", "drawn"))
STRICT = Word(("true", "false"))
EDITION = Word(("1", "2"))
DRAWING = ("axes", "tip", "zero")
"""The keys that stand for `dh` and `base`."""

# -- a body ----------------------------------------------------------------------------------------

AXIS = Word(AXES)
ABOUT = Word(("center", "origin", "joint"))
TENSOR = Keyed(tuple(Key(name, EXPRESSION) for name in ("xx", "yy", "zz", "xy", "xz", "yz")), least=1)
FROM_BASE = Keyed((Key("base", ROTATION, example="Rz(theta1)", required=True),))
POINT = Word(("point",))
NO_VALUE = Word(("none",))


def dimensions(shape: str) -> Keyed:
    """The dimensions of a shape."""
    kind = KINDS[shape]
    keys = [Key(name, EXPRESSION, example="...", required=True) for name in kind.keys]
    meaning = "The axis in the body-attached frame" + (", that x runs along" * (not kind.has_axis)) + "."
    if kind.slices:
        keys.append(Key("axis", AXIS, meaning, "x"))
        per = f"The mass per {kind.slices.per}"
        varies = kind.slices.extent and ", a constant or a polynomial in x along the axis, from the near end"
        example = "rho0*(1 + x/l)" if varies else "rho0"
        keys.append(Key("density", EXPRESSION, f"{per}{varies or ', a constant'}.", example))
    return Keyed(tuple(keys))


def _shape(name: str) -> Key:
    record = dimensions(name)
    example = ", ".join(f"{key.name}: {key.example}" for key in record.keys)
    return Key(name, record, example=f"{{{example}}}", required=True)


SHAPE = Shared(
    "shape",
    OneOf((POINT, *(Keyed((_shape(name),)) for name in KINDS if KINDS[name].dimensions))),
    "`point`, or a shape with its dimensions",
    "A uniform body, or one with a density: {rod: {length: l1, axis: x}}.",
)

IN_LINK = "it is constant in the link: joint variables stand in the table"

BODY = Keyed(
    (
        Key(
            "mass",
            Expression("a mass", IN_LINK),
            "A symbol, a number or an expression; it follows where a shape has a density.",
            "m1",
            "must be given, or a `density`",
            remedy="mass: m{index}, or a density to its shape: {{rod: {{length: l1, density: rho0}}}}",
            called="the mass of {of}",
        ),
        Key(
            "name",
            Plain("a name", {"type": ["string", "integer"]}),
            "Its index in symbols (K_1): one letter at most, not v or w, then digits.",
            "p",
            "its place in the list",
            remedy="a name is at most one letter, not v or w, and then digits: 2, p, m2",
        ),
        Key(
            "link",
            Link(LINK.called, LINK.json, "whose bodies do not move"),
            "The row of the table that it moves with.",
            "1",
            required=True,
            remedy="link: 1, the row of the table that the body moves with",
        ),
        Key(
            "center",
            PLACE,
            "The mass centre. Default tip, for a point and for mass 0.",
            "midpoint",
            "`tip`, for a point and for mass 0",
            remedy="write tip, origin, midpoint, {along: 1/2}, {near: [lc1, 0, 0]} or [x, y, z]",
        ),
        Key(
            "shape",
            SHAPE,
            example="{rod: {length: l1}}",
            default="`point`",
            remedy="write point, or a shape with its dimensions: {rod: {length: l1}}",
        ),
        Key(
            "inertia",
            OneOf((TENSOR, MATRIX)),
            "The tensor in the body-attached frame. Wins over a shape.",
            "{zz: I1}",
            "that of the shape",
            remedy="write {zz: I1}, {xx: ..., yy: ..., zz: ...} or a symmetric 3×3 list",
        ),
        Key(
            "about", ABOUT, "The point that the inertia is about.", "joint", "center", called="about of {of}"
        ),
        Key(
            "axes",
            OneOf((Word(("base",)), ROTATION, FROM_BASE)),
            "The body-attached axes. Default: those of the link's frame.",
            "Rx(30deg)",
            "those of frame i",
        ),
    )
)

# -- the whole file --------------------------------------------------------------------------------

MAX_ROWS = 30
MAX_BODIES = 100
OF_A_TABLE = (
    "dh", "axes", "tip", "zero", "also", "strict", "base", "masses", "coordinates", "convention",
    "points", "task", "reach", "branches", "forces", "velocity", "acceleration",
    "limits", "weights",
)  # fmt: skip
"""The keys that have no meaning beside `model`."""

PLACED_BODY = placed_body(OneOf((TENSOR, MATRIX)))
MODEL = model(PLACED_BODY, MAX_BODIES)
CONVENTION = Word(tuple(convention.value for convention in Convention))
LISTED_ROW = ListOf(EXPRESSION, "`[θ, d, a, α]`", 4, 4)
ROWS = ListOf(OneOf((Shared("row", ROW, "a row"), LISTED_ROW)), "a list of rows", 1, MAX_ROWS)
AXES_LIST = ListOf(
    Shared("axis", DRAWN_AXIS, "an axis"),
    "a list of joint axes",
    1,
    MAX_ROWS,
    told="an entry a joint; ",
    empty="there are no joint axes",
    at_key=True,
)
BODIES = ListOf(Shared("body", BODY, "a body"), "a list of bodies", 0, MAX_BODIES, "a list of bodies; ")
PASSIVE = Key(
    "passive",
    ListOf(COORDINATE, "a list of names"),
    "Coordinates without a motor: their generalized force is 0.",
    "[L2]",
    "none",
    remedy="write passive: [q2], the coordinates that no motor drives",
)
ACTION_KEYS = (*keys_of_kinds(), PASSIVE)
BASE = Keyed((Key("rotate", ROTATION, example="Rz(90deg)"), Key("move", VECTOR, example="[0, 0, h]")))

VARIED = Plain("alternatives", {"type": ["array", "object", "string", "number"]})
PROBLEM = Keyed(
    (
        Key(
            "title",
            TEXT,
            "The name of the robot or of the exercise.",
            "RP manipulator",
            "the name of the file",
            active=True,
        ),
        Key(
            "source",
            TEXT,
            "Where it comes from; shown in the solution.",
            "my course, exercise 1",
            active=True,
        ),
        Key(
            "edition",
            EDITION,
            "Of which edition of Spong, Hutchinson, Vidyasagar the sections (§) are: 1 (2006) or 2 (2020).",
            "2",
            "1",
            remedy="write edition: 1 or edition: 2",
        ),
        Key(
            "convention",
            CONVENTION,
            "standard (Spong): A_i = Rot_z(θ) Trans_z(d) Trans_x(a) Rot_x(α). "
            "modified (Craig): A_i = Rot_x(α) Trans_x(a) Rot_z(θ) Trans_z(d).",
            "standard",
            "standard",
            active=True,
            more="In a modified table a and alpha of row i are a_{i-1}, alpha_{i-1}.",
            remedy="`standard` is that of Spong, `modified` that of Craig",
        ),
        Key(
            "gravity",
            OneOf((VECTOR, NO_VALUE)),
            "The acceleration of gravity in base coordinates, or none. Default [0, 0, -g].",
            "[0, 0, -g]",
            "`[0, 0, -g]`",
            active=True,
            more="An arm in a vertical x-y plane: [0, -g, 0].",
            remedy="write gravity: [0, 0, -g], the acceleration of gravity, or none",
        ),
        Key(
            "base",
            OneOf((ROTATION, BASE)),
            "Frame 0 in the world: a rotation, or {rotate: ..., move: [0, 0, h]}.",
            "Rz(90deg) Rx(90deg)",
            "the world",
        ),
        Key(
            "dh",
            ROWS,
            "The Denavit-Hartenberg table, one row per frame, missing columns are 0; or rows [θ, d, a, α].",
            "\n- {theta: theta1* + 90deg, d: L1,  a: 0, alpha: 90deg}"
            "\n- {theta: 0,               d: L2*, a: 0, alpha: 0}",
            "must be given, or `axes`, or `model`",
            active=True,
            more="The star marks the joint variable: in theta the joint is revolute, in d prismatic; "
            "a row without a star is a fixed frame. Angles: 90deg, pi/2, beta.",
            remedy="a row is written {theta: theta1*, d: 0, a: l1, alpha: 0}",
        ),
        Key(
            "axes",
            AXES_LIST,
            "In place of dh: the joint axes as a drawing shows them, from the base to the hand, in world "
            "coordinates.",
            "\n- {turn: theta1, about: [0, 0, 1], through: [0, 0, 0]}"
            "\n- {turn: theta2, about: [0, -1, 0], through: [0, 0, L1]}"
            "\n- {slide: d3, along: [1, 0, 0]}",
            "none",
            more="In points the letter of a slide is its value in that pose, 0 if it occurs nowhere.",
            remedy="an axis is written {turn: theta1, about: [0, 0, 1], through: [0, 0, 0]} or "
            "{slide: d3, along: [1, 0, 0]}",
        ),
        Key(
            "tip",
            OneOf((VECTOR, HAND)),
            "The hand in the pose that is drawn: its place, or {at: [...], z: [...], x: [...]}.",
            "[a2 + d3, 0, L1]",
            "must be given with `axes`",
            remedy="tip: [x, y, z], the place of the hand in world coordinates",
        ),
        Key(
            "zero",
            ZERO,
            "Where turning joints of a drawing are 0: as drawn, or where the table has them (no offsets).",
            "drawn",
            "table",
        ),
        Key(
            "also",
            ListOf(ListOf(LISTED_ROW, "", 1, MAX_ROWS), "a list of tables"),
            "Further tables, rows of [θ, d, a, α], that count as an answer DH as they stand.",
            "[[[theta1*, L1, 0, 90deg], [0, L2*, 0, 0]]]",
            "none",
            remedy="write also: [[[theta1*, L1, 0, 90deg], ...], ...], a list of tables",
        ),
        Key(
            "strict",
            STRICT,
            "Whether an answer DH must count every coordinate in the sense and from where the file does.",
            "false",
            "false",
            remedy="write strict: true or strict: false",
        ),
        Key(
            "coordinates",
            OneOf((ListOf(NAME, "a list of names"), COORDINATES)),
            "Another order of the generalized coordinates than that of the table; or with their types.",
            "[L2, theta1]",
            "order of first appearance",
        ),
        Key(
            "model",
            MODEL,
            "In place of dh and masses: bodies by their positions, or D and P, K and P, or L.",
            "\n  coordinates: {x: prismatic, theta: revolute}"
            "\n  bodies:"
            "\n    - {mass: M, at: [x, 0, 0]}"
            "\n    - {mass: m, at: [x + l*sin(theta), -l*cos(theta), 0]}",
            "none",
            remedy="write model: {coordinates: {x: prismatic}, bodies: [{mass: m, at: [x, 0, 0]}]}",
        ),
        Key(
            "masses",
            BODIES,
            "Every body that has mass; a link without one is massless.",
            "\n- {mass: m1, link: 1, center: midpoint, inertia: {zz: I1zz}, axes: {base: Rz(theta1)}}"
            "\n- {mass: m2, link: 2, shape: point, center: tip}",
            "none",
            active=True,
            remedy="a body is written {mass: m1, link: 1, center: midpoint, inertia: {zz: I1}}",
        ),
        *DEFINITE_KEYS,
        *ACTION_KEYS,
        *KINEMATIC_KEYS,
        *(key for stage in ASKED_FOR for key in getattr(stage.part("keys"), "KEYS", ())),
        Key(
            "values",
            MapOf(NUMBER, "numbers by symbol"),
            "Numbers for numeric results and the proportions of the picture: {L1: 0.4, g: 9.81}.",
            "{L1: 0.4, m1: 2, m2: 1, I1zz: 0.05, g: 9.81}",
            remedy="write values: {l1: 0.4, m1: 2, g: 9.81}",
        ),
        Key(
            "units",
            MapOf(Plain("a unit", {"type": "string"}), "units by symbol"),
            "Units of symbols: {L1: m}.",
            "{L1: m, m1: kg, m2: kg, I1zz: kg m^2}",
            remedy="write units: {l1: m, m1: kg}",
        ),
        Key(
            "marks",
            MapOf(OneOf((Plain("a number", {"type": "number", "minimum": 0}), NAME)), "points by answer"),
            "Points for grading, by the name of the answer: {P: 2, K: 4, tau: 6}.",
            "{P: 2, K: 4, tau: 6}",
        ),
        Key(
            "remarks",
            MapOf(OneOf((TEXT, ListOf(TEXT, "a list of lines", 1))), "words by answer"),
            "Words on results, shown as notes at their steps: {Kv2: The squares add up.}.",
            "{Kv2: The squares add up.}",
        ),
        Key(
            "text",
            OneOf((TEXT, MapOf(TEXT, "words by `before`, `given` or answer"))),
            "Words of an exercise sheet: before what is given, or {before: ..., given: ..., D: ...}, in the "
            "place of what it says itself. Formulas stand between dollar signs: $m1*g$.",
            "{before: The arm is at rest at first., D: Show that $D$ is constant.}",
        ),
        Key(
            "vary",
            MapOf(VARIED, "alternatives by part of the file"),
            "What may differ from student to student: parts of the file with alternatives, or ranges of "
            "numbers; `letters`; and how far `within` the median the work may be (0.1).",
            "{values.L1: [0.3, 0.4], dh.1.alpha: [90deg, -90deg], letters: {L1: [L1, a1]}}",
        ),
        Key(
            "find",
            OneOf((NAME, ListOf(NAME, "a list of answers"))),
            "What the exercise asks for. Default [tau, D, C, g].",
            "[tau, D, C, g]",
            "`[tau, D, C, g]`",
            active=True,
        ),
    ),
    one_of=("dh", "axes", "model", "candidates"),
)
"""The keys of a problem file, in the order of the documentation."""
