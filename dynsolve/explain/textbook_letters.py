"""What the letters of the textbook mean, and their units: the lines of every list of notation.

To explain a further letter, add its line to a table, of a question or of what acts to `LETTERS` of its
chapter; a test finds the letters of reports that have none.
A line of a table is

    signs | meaning | unit            𝐃, d_ij | inertia matrix | kg m^2
    sign: words; sign: words | ...    𝐃: inertia matrix; d_ij: its entries | | kg m^2

where each sign has words of its own, and the meaning follows these.  Names in braces are values, such as the
letters of `quantities.letters`; a plain letter without an index is a parameter's.  A line with a value that a
robot does not have is left out.  A star marks what goes beyond the derivation of the course.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.explain.signs import CONSTANTS_OF_SOLUTIONS, MOTIONS, Kind, kind_of
from dynsolve.explain.writing import machine, side_by_side
from dynsolve.notation.extent import Ruler
from dynsolve.notation.printing import PLAIN, Style
from dynsolve.notation.template import formula
from dynsolve.notation.tree import Function, Letter, Node, Row, Sum, Symbol, Words
from dynsolve.notation.unicode import UnicodePrinter
from dynsolve.quantities import letters
from dynsolve.quantities.owners import asked_stages
from dynsolve.quantities.stages import ASKED_FOR, Stage
from dynsolve.robot.actions import part
from dynsolve.robot.model import Convention, JointType, Robot
from dynsolve.robot.names import names_taken

WIDEST = 8.0
"""Signs of one meaning that are wider together, in em, are the first, the second and the last."""


class Line(Struct, frozen=True):
    """A line of the list: signs, their meaning and unit; the kinds of signs that it explains.

    Where each sign has words of its own, these are `each`, and `meaning` is what follows them.
    """

    signs: tuple[Node, ...]
    meaning: str | Node
    unit: str = ""
    kinds: frozenset[Kind] = frozenset()
    each: tuple[str, ...] = ()

    @property
    def sign(self) -> Node:
        """The signs, side by side."""
        shown = self.signs
        if len(shown) == 1:
            return shown[0]
        together = side_by_side(shown)
        if isinstance(shown[0], Function):  # sines, each with its cosine
            of_sums = [
                sign for sign in shown if isinstance(sign, Function) and isinstance(sign.argument, Sum)
            ]
            pairs = (*shown[:2], Words("…"), *(of_sums or shown)[-2:])
            return together if len(shown) <= 4 else side_by_side(pairs)
        if len(shown) > 3 and not self.each and Ruler().width(together) > WIDEST:
            counts = isinstance(shown[-1], Letter) and isinstance(shown[-2], Symbol)  # m_i, after m_1 to m_6
            return side_by_side((*shown[:2], Words("…"), *(shown[-2:] if counts else shown[-1:])))
        return together

    @property
    def words(self) -> str | Node:
        """What the signs mean."""
        return f"{', '.join(self.each)}{self.meaning}" if self.each else self.meaning

    def of(self, kinds: Collection[Kind | None], style: Style) -> Line:
        """The line with its signs of these kinds alone."""
        kept = [k for k, sign in enumerate(self.signs) if kind_of(sign, style) in kinds]
        if not kept:  # it explains names that are written otherwise
            return self
        each = tuple(self.each[k] for k in kept) if self.each else ()
        return replace(self, signs=tuple(self.signs[k] for k in kept), each=each)


SHAPES = {
    "m": "mass",
    "l": "length",
    "r": "radius",
    "ro": "outer radius",
    "ri": "inner radius",
    "l_x": "side along x",
    "l_y": "side along y",
    "l_z": "side along z",
}
"""The letters of the formulas of uniform shapes."""

ENTRIES_IN_PRODUCTS = (letters.D, letters.D_POINTS, letters.C, letters.bold("N"), formula("c_ijk"))
"""What a rate multiplies for each of its indices: the unit of an entry depends on all of them."""

TEXTBOOK = """
{columns} | columns of the Denavit-Hartenberg table | rad, m, m, rad
* {motions} | rotation about, translation along an axis: 4×4 matrix
* {R_z} | rotation by an angle about an axis: 3×3 matrix
{identity} | any two quantities, in an identity
u_i | entry i of any vector
𝐀_i | matrix of row i: frame i seen from frame i-1
𝐇_i^{above}: frame i; 𝐑_i^{above}: orientation of frame i | , seen from {ground}
𝐱_i: x-axis; 𝐲_i: y-axis; 𝐳_i: z-axis | of frame i
𝐱_w, 𝐲_w, 𝐳_w | axes of the world w
𝐨_i | origin of frame i | m
𝐩 | any point of a body | m
{ZERO} | zero vector or matrix
𝐪: column of the coordinates; q_i: coordinate i | | {coordinate}
𝐉: Jacobian of the last frame; {JV}: its linear part; {JW}: its angular part; 𝐉_i: its column i | | {jacobian}
𝐯: velocity; 𝛚: angular velocity | of the last frame | m/s, rad/s
{reached} | values of the task that are to be reached
* {of_points} | coordinates of a point, given where they stand | m
* {of_turns} | entries of a rotation, given where they stand
* {U} | rotation that is left for some joints
* x_('tip'), y_('tip'), z_('tip') | coordinates of the origin of the last frame | m
* {of_P} | coordinates of a named point | m
* 𝐫 | task
* 𝐝 | from the point of a given tensor to its mass centre | m
* {J_TASK} | Jacobian of the task; with + its pseudoinverse
* 𝐖 | weights of the joint rates
* {N_SPACE} | null space of a matrix
* {R_SPACE} | range space of a matrix
* 𝐩_i: position of a point; 𝐩_i^i: the same in its link's frame | | m
* 𝐰, 𝐰_i | direction that is lost where the arm is singular
* {constants} | constants of a solution, given where they stand
* {PSI} | angle that is sought | rad
* 𝐅_i | force from outside | N
* {F} | force that belongs to the task
* 𝐌_i, M_i | moment from outside, its size | N m
* 𝐐: generalized forces of what acts from outside; Q_i: their entries | | {force}
* 𝐡: what the constraints keep at 0; {A_C}: constraint matrix; 𝛌: multipliers
* {Z} | rates that the constraints leave free
* {DIVISOR}, {DIVISOR_THERE} | what the entries of a result are divided by, given where it stands
* Δ_k | leading minor k of a matrix: the determinant of its first k rows
* {TAU_STATIC} | forces and torques that hold the arm at rest | {force}
m_i | mass of body i | kg
𝐫_ci | mass centre of body i | m
𝐫_ci^{frame} | mass centre of body i, {its} | m
{lever} | mass centre of body i from the near end of its link, in the link's frame | m
* {tensors} | inertia tensor of body i about its mass centre, along the body's axes{raised} | kg m^2
𝓘_i | inertia tensor of body i, along the axes of {ground} | kg m^2
𝐑_i | axes of body i, seen from {ground}
* 𝐑_(i,j) | turn j of body i
* {principal} | principal moments of body i, a uniform shape | kg m^2
* x | place along a body, from its near end | m
* {RHO} | density of a body at the place x
* x_ci | place of the mass centre along body i | m
* {about_near} | moment of inertia across body i about its near end | kg m^2
* {about_c} | moment of inertia across body i about its mass centre | kg m^2
* {about_axis} | moment of inertia of body i about its axis | kg m^2
* 𝐄 | identity matrix
g | acceleration of gravity | m/s^2
𝐠_0 | acceleration of gravity, a vector that points down | m/s^2
η_i | height of the mass centre of body i | m
"""
"""The lines before the dynamics: what is seen, asked for, and given of the bodies."""

DYNAMICS = """
𝐉_v_i: linear part; 𝐉_ω_i: angular part | of the Jacobian of {moving} | {jacobian}
* {of_point} | of a point: the same along the axes of frame k
{body_v}: velocity of the mass centre; 𝛚_i: angular velocity | of body i{or_point} | m/s, rad/s
{point_v} | velocity of a point | m/s
K_i: kinetic energy; K_v_i: its part of translation; K_ω_i: its part of rotation; \
P_i: potential energy | of body i | J
𝒦: kinetic energy; 𝒫: potential energy; ℒ: Lagrangian | of the {machine} | J
{forces} | generalized force i{what_force} | {force}
𝛕 | column of the generalized forces | {force}
* 𝒦_('given'), 𝒫_('given') | energies that the problem gives | J
* {PS} | potential energy of the springs | J
* {KM} | kinetic energy of the rotors | J
* I_m_i: moment of inertia; k_r_i: ratio of the gear | of the rotor of motor i
* 𝛚_('link'), {w_link} | angular velocity of the link that carries a motor
* {DM} | what the rotors add to the inertia matrix
* 𝐧_mi | moment that the rotor of motor i takes from its link | N m
* {DISSIPATION} | Rayleigh's dissipation function | W
(letters of kinds)
* {FRICTION}: column of the friction; τ_fk: its entries
𝐃: inertia matrix; d_ij: its entries | | {inertia}
{D_POINTS} | inertia matrix of the masses alone, as points | {inertia}
c_ijk | Christoffel symbol: always with three indices | {inertia}
𝐂: matrix of the Coriolis and centrifugal terms; c_kj: its entries | | {rate}
𝐠: column of the {held} terms; g_k: its entries | | {force}
* {references} | reference of the coordinates, of which there are rates
(letters of questions)
𝐍: skew-symmetric matrix; n_ij: its entries | | {rate}
"""
"""The lines of the energies, the forces and the equations of motion."""

_ALSO: dict[Node, Kind] = {letters.J_TASK: ("J", "bold", "r^"), letters.Q_FORCES: ("Q", "bold", "F#")}
"""The kinds that a sign explains beside its own."""

Value = str | Node | tuple[Node, ...] | None


def textbook(robot: Robot, style: Style, *, beside: bool = False) -> Iterator[Line]:
    """The lines of the textbook's letters, in the order of the derivation; or those `beside` the course."""
    values = {**_OF_ANY_ROBOT, **_asked(robot), **_of_robot(robot), **_of_forces(robot, style)}
    asked = asked_stages(robot.questions)
    of_kinds = _letters(part(kind, "explain") for kind in robot.actions.by_kind)
    of_questions = _letters(stage.part("explain") for stage in ASKED_FOR if stage in asked)
    dynamics = DYNAMICS.replace("(letters of kinds)", of_kinds)
    for row in (TEXTBOOK + dynamics.replace("(letters of questions)", of_questions)).split("\n"):
        if (
            row.startswith("* ") >= beside
            and row
            and all(values[name] is not None for name in re.findall(r"\{(\w+)\}", row))
        ):
            yield _line(row.removeprefix("* "), values)


def _letters(chapters: Iterable[Any]) -> str:
    """The lines of the letters that these chapters have of their own, `LETTERS`."""
    return "\n".join(getattr(chapter, "LETTERS", "") for chapter in chapters)


def _line(row: str, values: Mapping[str, Value]) -> Line:
    left, meaning, unit = (cell.strip() for cell in f"{row}||".split("|")[:3])
    told = [part.split(": ") for part in left.split("; ")] if ": " in left else []
    signs = values.get(left.strip("{}"))
    if not isinstance(signs, tuple):
        nodes = {name: value for name, value in values.items() if isinstance(value, Node)}
        signs = tuple(formula(sign, **nodes) for sign, _ in told or ((sign, "") for sign in left.split(", ")))
    kinds = {kind for sign in signs if (kind := kind_of(sign, PLAIN))}
    kinds |= {_ALSO[sign] for sign in signs if sign in _ALSO}
    rest = f" {meaning}" if told and meaning[:1].isalpha() else meaning
    return Line(
        signs,
        rest.format_map(values),
        unit.format_map(values),
        frozenset(kinds),
        tuple(words.format_map(values) for _, words in told),
    )


def _names(names: Iterable[str]) -> tuple[Node, ...] | None:
    """Names as signs; None where there are none."""
    return tuple(map(Symbol, names)) or None


def _about(place: str) -> tuple[Node, ...]:
    """The moments of inertia of a body with a density, about its near end, its mass centre or its axis."""
    axes = ((), *((Words(2 * axis), Words(",")) for axis in "xyz"))
    return tuple(Letter("I", Row((Symbol("i"), Words(","), *axis, Words(place)))) for axis in axes)


_LEVER = formula("𝐫_(i-1,{center})^i", center=Row((Words("c"), Symbol("i"))))

_OF_ANY_ROBOT: dict[str, Value] = {
    **{name: value for name, value in vars(letters).items() if isinstance(value, Node)},
    "motions": tuple(Letter(name, style="upright") for name in MOTIONS),
    "R_z": Letter("R", Row((Words("z"), Words(","), Row((Symbol("theta"),)))), style="bold"),
    "ZERO": letters.bold("0"),
    "N_SPACE": Letter("N", style="script"),
    "constants": tuple(map(Letter, CONSTANTS_OF_SOLUTIONS)),
    "principal": tuple(Letter("I", Row((Symbol("i"), Words(2 * axis)))) for axis in "xyz"),
    "RHO": Letter("rho"),
    "identity": letters.IN_IDENTITIES,
    **{f"about_{place}": _about(place) for place in ("near", "c", "axis")},
    "LEVER": _LEVER,
    "w_link": letters.bold("omega", Row((Words("link"), Symbol("i")))),
    "regressors": (letters.REGRESSOR, *(letters.of_part("Y", part) for part in "Mgr")),
    "parameters": (letters.PARAMETERS, *(letters.of_part("a", part) for part in "Mg")),
}
"""The signs that no text gives, by their names in the tables."""


def _asked(robot: Robot) -> dict[str, Value]:
    """What an exercise asks for beside the dynamics: a task, its inverse, points, constraints."""
    asked = robot.questions
    reached = [name for name in asked.reached if name not in robot.parameters]
    is_linear = not asked.asked.isdisjoint(("linear_A", "linear_B"))
    found: dict[str, Value] = {
        "reached": _names(reached),
        **dict.fromkeys(("of_points", "of_turns", "U")),
        "of_P": tuple(formula(f"{axis}_(P)") for axis in "xyz") if asked.points else None,
        # else a dissipation function has this letter
        "R_SPACE": letters.DISSIPATION if "rangespace" in asked.asked else None,
        "Z": letters.bold("Z") if asked.constraints else None,
        "F": None if is_linear else letters.bold("F"),
        "F_RATES": letters.bold("F") if is_linear else None,
    }
    if asked.task is not None and asked.task.is_pose:
        names = Stage.INVERSE.part("names").Names.beside(names_taken(robot))
        found |= {"of_points": _names(names.of_points), "of_turns": _names(names.of_turns)}
        found["U"] = tuple(letters.bold(letter.upper()) for letter in names.turns or ("u",))
    return found


def _of_robot(robot: Robot) -> dict[str, Value]:
    """The signs and words that depend on the robot and its bodies."""
    ring, points, bodies = robot.ring, robot.questions.points, robot.bodies
    by_links = all(body.name in ("", str(body.link)) or not body.name.isdigit() for body in bodies)
    is_standard = robot.convention is Convention.STANDARD
    raised = dict.fromkeys(letters.tensor(robot, body).sup for body in bodies) or (None,)
    what = [*(["the mass centre of body i"] if bodies else []), *(["a point"] if points else [])]
    has_axes = any(point.axes is not None for point in points)
    carried = Stage.NEWTON_EULER in asked_stages(robot.questions)
    return {
        "ground": "the world w" if letters.has_base(robot) else "frame 0" if robot.has_table else "the world",
        "above": letters.H(robot, 0).sup,
        "columns": letters.columns(robot, Symbol("i")),
        "frame": Symbol("i" if by_links else "j"),
        "its": "in its link's frame" if by_links else "in the frame of its link j",
        "lever": None if carried else _LEVER,  # the recursions tell it with their other levers
        "tensors": tuple(letters.bold("I", Symbol("i"), sup) for sup in raised),
        "raised": " (b)" * any(raised),
        "turning": letters.BEFORE if is_standard else Symbol("i"),
        "moving": " or ".join(what),
        "of_point": (*map(formula, ("𝐉_v_i^k", "𝐉_ω_i^k", "𝐯_i^k")),) if has_axes else None,
        "body_v": formula("𝐯_i") if bodies else None,
        "or_point": " or of a point" if points else "",
        "point_v": None if bodies else formula("𝐯_i"),
        "machine": machine(robot),
        "held": " and ".join(robot.held),
        "references": (letters.bold("q", Symbol("r")), *map(Symbol, ring.plan.references)),
    }


def _of_forces(robot: Robot, style: Style) -> dict[str, Value]:
    """The units of what has an entry for each coordinate; τ_i of any, and f_i where it is a length."""
    has_turning, has_sliding = (
        any(q.type is kind for q in robot.coordinates) for kind in (JointType.REVOLUTE, JointType.PRISMATIC)
    )

    def unit(turning: str, sliding: str, both: str = "") -> str:
        if has_turning and has_sliding:
            return both or f"{turning} or {sliding}"
        return turning if has_turning else sliding

    torque, force = formula("τ_i"), formula("f_i")
    turning, sliding = "where coordinate i is an angle", "where it is a length"
    if robot.has_table:
        turning, sliding = "at a revolute joint", "at a prismatic one"
    written = UnicodePrinter(style).text(force)
    return {
        "coordinate": unit("rad", "m"),
        "jacobian": "m or 1" if has_turning else "1",
        "force": unit("N m", "N"),
        "inertia": unit("kg m^2", "kg", "kg m^2, kg m or kg"),
        "rate": unit("kg m^2/s", "kg/s", "kg m^2/s, kg m/s or kg/s"),
        "forces": (torque, force) if has_sliding else (torque,),
        "what_force": unit(", a torque", ", a force", f": a torque {turning}, a force ({written}) {sliding}"),
    }
