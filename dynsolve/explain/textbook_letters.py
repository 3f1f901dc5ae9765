"""What the letters of the textbook mean, and their units: the lines of every list of notation.

To explain a further letter, add its line; a test finds the letters of reports that have none.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from dynsolve.explain.signs import CONSTANTS_OF_SOLUTIONS, MOTIONS, Kind, kind_of
from dynsolve.explain.writing import machine, side_by_side
from dynsolve.notation.extent import Ruler
from dynsolve.notation.printing import PLAIN, Style
from dynsolve.notation.tree import Function, Letter, Node, Number, Row, Sum, Symbol, Words
from dynsolve.notation.unicode import UnicodePrinter
from dynsolve.quantities import letters
from dynsolve.quantities.robot_stages import asked_stages
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Convention, JointType, Robot

WIDEST = 8.0
"""Signs of one meaning that are wider together, in em, are the first, the second and the last."""


@dataclass(frozen=True, slots=True)
class Line:
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
            of_sums = [sign for sign in shown if isinstance(sign, Function) and _is_of_sum(sign)]
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

    def of(self, kinds: Collection[Kind], style: Style) -> Line:
        """The line with its signs of these kinds alone."""
        kept = [k for k, sign in enumerate(self.signs) if kind_of(sign, style) in kinds]
        if not kept:  # it explains names that are written otherwise
            return self
        each = tuple(self.each[k] for k in kept) if self.each else ()
        return replace(self, signs=tuple(self.signs[k] for k in kept), each=each)


_I, _J, _K = Symbol("i"), Symbol("j"), Symbol("k")
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


ENTRIES_IN_PRODUCTS = (
    *(letters.D, letters.D_POINTS, letters.C, letters.bold("N")),
    Letter("c", Row((_I, _J, _K))),
)
"""What a rate multiplies for each of its indices: the unit of an entry depends on all of them."""


def textbook(robot: Robot, style: Style) -> Iterator[Line]:
    """The lines of the textbook's letters, in the order of the derivation."""
    ground = "the world w" if letters.has_base(robot) else "frame 0" if robot.has_table else "the world"
    yield from _kinematics(robot, ground)
    yield from _questions(robot)
    yield from _bodies(robot, ground)
    if Stage.NEWTON_EULER in asked_stages(robot.questions):
        yield from _recursions(robot)
    yield from _dynamics(robot, style)


def _is_of_sum(sign: Function) -> bool:
    return isinstance(sign.argument, Sum)


def _line(sign: Node | Sequence[Node], meaning: str, unit: str = "", *kinds: Kind) -> Line:
    """A line; `kinds` are those that it explains beside the kinds of its signs."""
    signs = (sign,) if isinstance(sign, Node) else tuple(sign)
    return Line(signs, meaning, unit, frozenset((*_kinds(signs), *kinds)))


def _each(told: Sequence[tuple[Node, str]], rest: str = "", unit: str = "") -> Line:
    """A line of signs with words of their own, and what follows these."""
    signs = tuple(sign for sign, _ in told)
    return Line(signs, rest, unit, frozenset(_kinds(signs)), tuple(words for _, words in told))


def _kinds(signs: Iterable[Node]) -> Iterator[Kind]:
    return (kind for sign in signs if (kind := kind_of(sign, PLAIN)))


def _kinematics(robot: Robot, ground: str) -> Iterator[Line]:
    above = letters.H(robot, 0).sup
    columns = letters.columns(robot, _I)
    yield _line(columns, "columns of the Denavit-Hartenberg table", "rad, m, m, rad")
    yield _line(
        [Letter(name, style="upright") for name in MOTIONS],
        "rotation about, translation along an axis: 4×4 matrix",
    )
    about_z = Letter("R", Row((Words("z"), Words(","), Row((Symbol("theta"),)))), style="bold")
    yield _line(about_z, "rotation by an angle about an axis: 3×3 matrix")
    yield _line([Symbol("U"), Symbol("V")], "any two quantities, in an identity")
    yield _line(letters.any_vector(robot, _I), "entry i of any vector")
    yield _line(_numbered("A"), "matrix of row i: frame i seen from frame i-1")
    frame, turned = Letter("H", _I, above, "bold"), Letter("R", _I, above, "bold")
    yield _each([(frame, "frame i"), (turned, "orientation of frame i")], f", seen from {ground}")
    yield _each([(_numbered(axis), f"{axis}-axis") for axis in "xyz"], " of frame i")
    yield _line([letters.bold(axis, Words("w")) for axis in "xyz"], "axes of the world w")
    yield _line(_numbered("o"), "origin of frame i", "m")
    yield _line(letters.ANY_POINT, "any point of a body", "m")
    yield _line(letters.bold("0"), "zero vector or matrix")
    coordinates = [(letters.Q, "column of the coordinates"), (Letter("q", _I), "coordinate i")]
    yield _each(coordinates, "", of_entries(robot, "rad", "m"))
    jacobians = [
        (letters.J, "Jacobian of the last frame"), (letters.JV, "its linear part"),
        (letters.JW, "its angular part"), (_numbered("J"), "its column i"),
    ]  # fmt: skip
    yield _each(jacobians, "", of_jacobian(robot))
    velocities = [(letters.bold("v"), "velocity"), (letters.bold("omega"), "angular velocity")]
    yield _each(velocities, " of the last frame", "m/s, rad/s")


def _questions(robot: Robot) -> Iterator[Line]:
    """What an exercise asks for beside the dynamics: a task, its inverse, forces from outside."""
    reached = tuple(name for name in robot.questions.reached if name not in robot.parameters)
    if reached:
        kinds = (("", "name", name) for name in reached)
        yield _line(tuple(map(Symbol, reached)), "values of the task that are to be reached", "", *kinds)
    if robot.questions.task is not None and robot.questions.task.is_pose:
        yield from _pose(robot)
    tip = [Letter(axis, Words("tip")) for axis in "xyz"]
    yield _line(tip, "coordinates of the origin of the last frame", "m")
    if robot.questions.points:
        yield _line([_entry(axis, Symbol("P")) for axis in "xyz"], "coordinates of a named point", "m")
    yield _line(letters.TASK, "task")
    yield _line(letters.bold("d"), "from the point of a given tensor to its mass centre", "m")
    yield _line(letters.J_TASK, "Jacobian of the task; with + its pseudoinverse", "", ("J", "bold", "r^"))
    yield _line(letters.WEIGHTS, "weights of the joint rates")
    yield _line(Letter("N", style="script"), "null space of a matrix")
    if "rangespace" in robot.questions.asked:  # else a dissipation function has this letter
        yield _line(Letter("R", style="script"), "range space of a matrix")
    at = [
        (_numbered("p"), "position of a point"),
        (Letter("p", _I, _I, "bold"), "the same in its link's frame"),
    ]
    yield _each(at, "", "m")
    yield _line([letters.bold("w"), _numbered("w")], "direction that is lost where the arm is singular")
    yield _line(
        [Letter(name) for name in CONSTANTS_OF_SOLUTIONS], "constants of a solution, given where they stand"
    )
    yield _line(Symbol("psi"), "angle that is sought", "rad", ("", "name", "psi"))
    yield _line(_numbered("F"), "force from outside", "N")
    yield _line([_numbered("M"), _body("M")], "moment from outside, its size", "N m")
    of_forces = [letters.Q_FORCES, Letter("Q", _I)]
    forces = of_entries(robot, "N m", "N")
    yield _line(of_forces, "generalized forces of these, their entries", forces, ("Q", "bold", "F#"))
    held = [(letters.H_C, "what the constraints keep at 0"), (letters.A_C, "constraint matrix"),
            (letters.LAMBDA, "multipliers")]  # fmt: skip
    yield _each(held)
    free = [(letters.bold("Z"), "rates that the constraints leave free"), (letters.bold("nu"), "their sizes")]
    if robot.questions.constraints:
        yield _each(free)
    yield _line(Letter("Delta", _K), "leading minor k of a matrix: the determinant of its first k rows")
    yield _line(letters.TAU_STATIC, "forces and torques that hold the arm at rest", forces)


def _pose(robot: Robot) -> Iterator[Line]:
    """The names that are given on the way to a pose."""
    from dynsolve.derivation.inverse.names import Names

    names = Names.beside({*robot.ring.names, *robot.ring.parameters, *robot.questions.reached})
    for told, meaning, unit in (
        (names.of_points, "coordinates of a point, given where they stand", "m"),
        (names.of_turns, "entries of a rotation, given where they stand", ""),
    ):
        yield _line(tuple(map(Symbol, told)), meaning, unit, *(("", "name", name) for name in told))
    yield _line(letters.bold("U"), "rotation that is left for some joints")


def _bodies(robot: Robot, ground: str) -> Iterator[Line]:
    center = Row((Words("c"), _I))
    yield _line(_body("m"), "mass of body i", "kg")
    yield _line(Letter("r", center, None, "bold"), "mass centre of body i", "m")
    by_links = all(body.name in ("", str(body.link)) or not body.name.isdigit() for body in robot.bodies)
    frame, its = (_I, "in its link's frame") if by_links else (_J, "in the frame of its link j")
    yield _line(Letter("r", center, frame, "bold"), f"mass centre of body i, {its}", "m")
    if Stage.NEWTON_EULER not in asked_stages(
        robot.questions
    ):  # the recursions tell it with their other levers
        lever = letters.bold("r", Row((letters.BEFORE, Words(","), center)), _I)
        yield _line(lever, "mass centre of body i from the near end of its link, in the link's frame", "m")
    own = _own_tensors(robot)
    raised = " (b)" * any(isinstance(letter, Letter) and letter.sup is not None for letter in own)
    yield _line(
        own, f"inertia tensor of body i about its mass centre, along the body's axes{raised}", "kg m^2"
    )
    yield _line(letters.base_tensor(_I), f"inertia tensor of body i, along the axes of {ground}", "kg m^2")
    yield _line(_numbered("R"), f"axes of body i, seen from {ground}")
    yield _line(Letter("R", Row((_I, Words(","), _J)), None, "bold"), "turn j of body i")
    moments = [Letter("I", Row((_I, Words(axes)))) for axes in ("xx", "yy", "zz")]
    yield _line(moments, "principal moments of body i, a uniform shape", "kg m^2")
    yield from _by_integration()
    yield _line(letters.bold("E"), "identity matrix")
    yield _line(Symbol("g"), "acceleration of gravity", "m/s^2")
    yield _line(letters.GRAVITY, "acceleration of gravity, a vector that points down", "m/s^2")
    yield _line(letters.height(_I), "height of the mass centre of body i", "m")


def _by_integration() -> Iterator[Line]:
    """What a body with a density is integrated in."""
    yield _line(Symbol("x"), "place along a body, from its near end", "m")
    yield _line(Letter("rho"), "density of a body at the place x")
    yield _line(Letter("x", Row((Words("c"), _I))), "place of the mass centre along body i", "m")
    places = (
        ("near", "across body i about its near end"),
        ("c", "across body i about its mass centre"),
        ("axis", "of body i about its axis"),
    )
    for place, told in places:
        signs = [
            Letter("I", Row((_I, Words(","), *axes, Words(place))))
            for axes in ((), *((Words(2 * axis), Words(",")) for axis in "xyz"))
        ]
        yield _line(signs, f"moment of inertia {told}", "kg m^2")


def _own_tensors(robot: Robot) -> list[Node]:
    """I_i, and I_i^b where the problem calls something else I_1."""
    tensors = (letters.tensor(robot, body) for body in robot.bodies)
    raised = dict.fromkeys(tensor.sup for tensor in tensors)
    return [Letter("I", _I, sup, "bold") for sup in raised] or [_numbered("I")]


def _recursions(robot: Robot) -> Iterator[Line]:
    """What the Newton-Euler recursions carry from link to link."""
    before, own = letters.BEFORE, Row((Words("c"), _I))
    first = before if robot.convention is Convention.STANDARD else _I
    yield _line(letters.bold("z", first, _I), "axis of joint i, in frame i")
    levers = [
        (letters.bold("r", Row((before, Words(","), _I)), _I), "origin of frame i"),
        (letters.bold("r", Row((before, Words(","), own)), _I), "mass centre of body i"),
    ]
    yield _each(levers, ", from the origin of frame i-1", "m")
    yield _line(letters.bold("g", Number(0), _I), "acceleration of gravity, in frame i", "m/s^2")
    turning = [
        (letters.bold("omega", _I, _I), "angular velocity"),
        (letters.bold("omega", _I, _I, 1), "angular acceleration"),
    ]
    yield _each(turning, " of link i, in frame i")
    points = [
        (letters.bold("a", _I, _I), "origin of frame i"),
        (letters.bold("a", own, _I), "mass centre of body i"),
    ]
    yield _each(points, ": its acceleration, in frame i", "m/s^2")
    yield _line(
        letters.bold("I", own, _I), "inertia tensor of body i about its mass centre, in frame i", "kg m^2"
    )
    held = [(letters.bold("f", _I, _I), "force"), (letters.bold("n", _I, _I), "moment")]
    yield _each(held, " with which link i-1 holds link i, in frame i")


def _dynamics(robot: Robot, style: Style) -> Iterator[Line]:
    yield from _motions(robot)
    energies = [
        (_body("K"), "kinetic energy"), (_sub("K", "v"), "its part of translation"),
        (_sub("K", "omega"), "its part of rotation"), (_body("P"), "potential energy"),
    ]  # fmt: skip
    yield _each(energies, " of body i", "J")
    totals = [(letters.K, "kinetic energy"), (letters.P, "potential energy"), (letters.L, "Lagrangian")]
    yield _each(totals, f" of the {machine(robot)}", "J")
    yield from _forces(robot, style)
    yield from _actions()
    inertia, rate = (
        of_entries(robot, "kg m^2", "kg", "kg m^2"),
        of_entries(robot, "kg m^2/s", "kg/s", "kg m^2/s"),
    )
    yield _each([(letters.D, "inertia matrix"), (_entry("d", _I, _J), "its entries")], "", inertia)
    yield _line(letters.D_POINTS, "inertia matrix of the masses alone, as points", inertia)
    yield _line(_entry("c", _I, _J, _K), "Christoffel symbol: always with three indices", inertia)
    coriolis = letters.C, "matrix of the Coriolis and centrifugal terms"
    yield _each([coriolis, (_entry("c", _K, _J), "its entries")], "", rate)
    gravity = letters.G, "column of the gravity terms"
    yield _each([gravity, (_entry("g", _K), "its entries")], "", of_entries(robot, "N m", "N"))
    yield from _linear(robot)
    skew = letters.bold("N"), "skew-symmetric matrix"
    yield _each([skew, (_entry("n", _I, _J), "its entries")], "", rate)


def _motions(robot: Robot) -> Iterator[Line]:
    """How mass centres and named points move; these have the same letters, with their names as indices."""
    points = robot.questions.points
    what = [
        *(["the mass centre of body i"] if robot.bodies else []),
        *(["a point"] if points else []),
    ]
    of = f" of the Jacobian of {' or '.join(what)}"
    parts = [(_sub("J", "v"), "linear part"), (_sub("J", "omega"), "angular part")]
    yield _each(parts, of, of_jacobian(robot))
    if any(point.axes is not None for point in points):
        turned = [_sub("J", "v", _K), _sub("J", "omega", _K), letters.bold("v", _I, _K)]
        yield _line(turned, "of a point: the same along the axes of frame k")
    if robot.bodies:
        moving = [(_numbered("v"), "velocity of the mass centre"), (_numbered("omega"), "angular velocity")]
        yield _each(moving, f" of body i{' or of a point' if points else ''}", "m/s, rad/s")
    else:
        yield _line(_numbered("v"), "velocity of a point", "m/s")


def _forces(robot: Robot, style: Style) -> Iterator[Line]:
    """τ_i of any coordinate, and f_i, which stands in its place where the coordinate is a length."""
    kinds = {q.type for q in robot.coordinates}
    torque, force = _body("tau"), _body("f")
    turning, sliding = (
        ("at a revolute joint", "at a prismatic one")
        if robot.has_table
        else ("where coordinate i is an angle", "where it is a length")
    )
    written = UnicodePrinter(style).text(force)
    if kinds == {JointType.REVOLUTE}:
        yield _line(torque, "generalized force i, a torque", "N m")
    elif kinds == {JointType.PRISMATIC}:
        yield _line([torque, force], "generalized force i, a force", "N")
    else:
        meaning = f"generalized force i: a torque {turning}, a force ({written}) {sliding}"
        yield _line([torque, force], meaning, "N m or N")
    yield _line(letters.TAU, "column of the generalized forces", of_entries(robot, "N m", "N"))


def of_entries(robot: Robot, turning: str, sliding: str, both: str = "") -> str:
    """The unit of the entries of a matrix: that of angles or of lengths, or of `both`."""
    kinds = {q.type for q in robot.coordinates}
    if len(kinds) > 1:
        return both or f"{turning} or {sliding}"
    return turning if JointType.REVOLUTE in kinds else sliding


def of_jacobian(robot: Robot) -> str:
    """The units of a Jacobian's entries: of velocities by rates."""
    return "m or 1" if any(q.type is JointType.REVOLUTE for q in robot.coordinates) else "1"


def _actions() -> Iterator[Line]:
    """What acts beside gravity."""
    given = [Letter(energy.base, Words("given"), None, "script") for energy in (letters.K, letters.P)]
    yield _line(given, "energies that the problem gives", "J")
    yield _line(letters.PS, "potential energy of the springs", "J")
    yield _line(letters.KM, "kinetic energy of the rotors", "J")
    motor = [(_sub("I", "m"), "moment of inertia"), (_sub("k", "r"), "ratio of the gear")]
    yield _each(motor, " of the rotor of motor i")
    spin = letters.bold("omega", Words("link")), letters.bold("omega", Row((Words("link"), _I)))
    yield _line(spin, "angular velocity of the link that carries a motor")
    yield _line(letters.DM, "what the rotors add to the inertia matrix")
    rotor = letters.bold("n", Row((Words("m"), _I)))
    yield _line(rotor, "moment that the rotor of motor i takes from its link", "N m")
    yield _line(letters.DISSIPATION, "Rayleigh's dissipation function", "W")
    coulomb = Letter("f", Row((Words("c"), _K)))
    yield _line(coulomb, "coefficient of Coulomb friction of coordinate k")
    entry = Letter("tau", Row((Words("f"), _K)))
    yield _each([(letters.FRICTION, "column of the friction"), (entry, "its entries")])


def _linear(robot: Robot) -> Iterator[Line]:
    """The letters of the equations of motion, linear in the parameters."""
    parts = [(part, (letters.of_part("Y", part), letters.of_part("a", part))) for part in ("M", "g")]
    signs = [letters.REGRESSOR, *(Y for _, (Y, _) in parts), letters.of_part("Y", "r")]
    yield _line(
        [letters.bold("q", Symbol("r")), *map(Symbol, robot.ring.plan.references)],
        "reference of the coordinates, of which there are rates",
    )
    yield _line(signs, "regressor: the factor of the parameters in the forces, in a part of them")
    near = [(letters.LINEAR_A, "matrix of the state"), (letters.LINEAR_B, "matrix of the inputs")]
    yield _each(near, " of the motion near the equilibrium")
    yield _line(letters.bold("q", Words("e")), "the equilibrium")
    yield _line(letters.STEADY_ENERGY, "potential energy less the kinetic energy of a steady motion", "J")
    yield _each(
        [
            (letters.bold("F"), "factors of the rates in the friction"),
            (letters.bold("S"), "selects the inputs"),
        ]
    )
    yield _line(letters.TASK_INERTIA, "inertia matrix of the task")
    yield _line([letters.PARAMETERS, *(a for _, (_, a) in parts)], "column of the parameters in these")


def _numbered(base: str) -> Letter:
    """z_i, bold"""
    return Letter(base, _I, None, "bold")


def _body(base: str) -> Letter:
    return Letter(base, _I)


def _entry(base: str, *indices: Node) -> Letter:
    return Letter(base, Row(indices) if len(indices) > 1 else indices[0])


def _sub(base: str, part: str, sup: Node | None = None) -> Letter:
    """J_{v_i}, K_{v_i}; J_{v_i}^k"""
    return Letter(base, Letter(part, _I), sup, "bold" if base == "J" else "italic")
