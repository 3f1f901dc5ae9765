"""The letters of the recursions: every vector of link i along the axes of frame i, as ω_i^i and r_{ci}^i."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from dynsolve.algebra.matrix import Matrix, cross
from dynsolve.derivation import recursions
from dynsolve.derivation.kinematics import origin, rotation
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.jacobian_columns import ZERO
from dynsolve.explain.step import Line, Step
from dynsolve.explain.writing import craig, is_small, spong, sum_of
from dynsolve.notation.tree import (
    Cross,
    Letter,
    Negative,
    Node,
    Number,
    Parenthesized,
    Product,
    Row,
    Sum,
    Symbol,
    Transpose,
    Words,
    equation,
    number,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Body, Convention, Joint, JointType, Robot


@dataclass(frozen=True, slots=True)
class LinkNames:
    """The letters of a link, by its index and that of the frame before it.

    In the `standard` convention the joint lies on the axis of the frame before.
    """

    i: Node
    before: Node
    standard: bool

    @staticmethod
    def of(robot: Robot, link: int) -> LinkNames:
        """Those of one link."""
        before = robot.joints[link - 1].parent
        return LinkNames(Number(link), Number(before), robot.convention is Convention.STANDARD)

    @staticmethod
    def general(standard: bool) -> LinkNames:
        """Those of link i."""
        return LinkNames(Symbol("i"), letters.BEFORE, standard)

    @property
    def R(self) -> Letter:
        """R_i^{i-1}: frame i seen from frame i-1."""
        return letters.bold("R", self.i, self.before)

    @property
    def axis(self) -> Letter:
        """The axis of joint i along the axes of frame i: z_{i-1}^i, in the modified convention z_i^i."""
        return letters.bold("z", self.before if self.standard else self.i, self.i)

    @property
    def lever(self) -> Letter:
        """From o_{i-1} to o_i: along the axes of frame i, in the modified convention of frame i-1."""
        return letters.bold(
            "r", Row((self.before, Words(","), self.i)), self.i if self.standard else self.before
        )

    @property
    def gravity(self) -> Letter:
        """g_0^i"""
        return letters.bold("g", Number(0), self.i)

    def vector(self, base: str, dots: int = 0) -> Letter:
        """A vector of the link along its own axes: ω_i^i, f_i^i."""
        return letters.bold(base, self.i, self.i, dots)

    def vector_before(self, base: str, dots: int = 0) -> Letter:
        """The same of the link before: ω_{i-1}^{i-1}."""
        return letters.bold(base, self.before, self.before, dots)


@dataclass(frozen=True, slots=True)
class BodyNames:
    """The letters of a body by its index, in the frame of its link."""

    index: Node
    link: LinkNames

    @staticmethod
    def of(robot: Robot, body: Body) -> BodyNames:
        """Those of one body."""
        return BodyNames(letters.index_of(body.name), LinkNames.of(robot, body.link))

    def _at_center(self, base: str) -> Letter:
        return letters.bold(base, Row((Words("c"), self.index)), self.link.i)

    @property
    def center(self) -> Letter:
        """r_{ci}^i, from o_i to the mass centre."""
        return self._at_center("r")

    @property
    def lever(self) -> Letter:
        """r_{i-1,ci}^i, from o_{i-1} to the mass centre."""
        between = Row((self.link.before, Words(","), Words("c"), self.index))
        return letters.bold("r", between, self.link.i)

    @property
    def tensor(self) -> Letter:
        """I_{ci}^i"""
        return self._at_center("I")

    @property
    def acceleration(self) -> Letter:
        """a_{ci}^i"""
        return self._at_center("a")


# -- the terms of each recursion in letters, of one link or of link i ------------------------------
# Spong, Hutchinson, Vidyasagar, section 7.6, in the standard convention; Craig, section 6.5, in the modified.

W, A = "omega", "a"


def turned(link: LinkNames, vector: Node) -> Node:
    """(R_i^{i-1})ᵀ vector: what comes from the link before."""
    return Product((Transpose(link.R), vector))


def along(link: LinkNames, rate: Node) -> Node:
    """The rate of a joint along its axis."""
    return Product((link.axis, rate))


def angular_velocity(link: LinkNames, rate: Node | None) -> list[Node]:
    """Rᵀ ω_{i-1} + z θ̇_i; `rate` is θ̇_i of a joint that turns."""
    own = [] if rate is None else [along(link, rate)]
    return [turned(link, link.vector_before(W)), *own]


def angular_acceleration(link: LinkNames, rates: tuple[Node, Node] | None) -> list[Node]:
    """Rᵀ ω̇_{i-1} + z θ̈_i + ω_i × z θ̇_i; `rates` are θ̇_i and θ̈_i of a joint that turns."""
    carried = turned(link, link.vector_before(W, 1))
    if rates is None:
        return [carried]
    first, second = rates
    return [carried, along(link, second), Cross(link.vector(W), Parenthesized(along(link, first)))]


def turning(w: Node, dw: Node, lever: Node) -> list[Node]:
    """ω̇ × r + ω × (ω × r)"""
    return [Cross(dw, lever), Cross(w, Parenthesized(Cross(w, lever)))]


def acceleration(link: LinkNames, lever: Node, rates: tuple[Node, Node] | None) -> list[Node]:
    """The terms of the acceleration a `lever` away from o_{i-1}.

    `rates` are ḋ_i and d̈_i of a joint that slides.  The lever turns with link i in the standard
    convention, with link i-1 in the modified one.
    """
    if link.standard:
        carried = [turned(link, link.vector_before(A)), *turning(link.vector(W), link.vector(W, 1), lever)]
    else:
        around = turning(link.vector_before(W), link.vector_before(W, 1), lever)
        carried = [turned(link, Parenthesized(Sum((link.vector_before(A), *around))))]
    if rates is None:
        return carried
    first, second = rates
    coriolis = Product((Number(2), Cross(link.vector(W), Parenthesized(along(link, first)))))
    return [*carried, coriolis, along(link, second)]


def center_acceleration(body: BodyNames, rates: tuple[Node, Node] | None) -> list[Node]:
    """The same of a mass centre: from o_{i-1} in the standard convention, else from o_i."""
    link = body.link
    if link.standard:
        return acceleration(link, body.lever, rates)
    return [link.vector(A), *turning(link.vector(W), link.vector(W, 1), body.center)]


def inertial_force(body: BodyNames, mass: Node, heavy: bool) -> Node:
    """m (a_c - g_0), where gravity is a force of its own (`heavy`); else m a_c."""
    if heavy:
        return Product((mass, Parenthesized(Sum((body.acceleration, Negative(body.link.gravity))))))
    return Product((mass, body.acceleration))


def passed_on(after: LinkNames, base: str) -> Node:
    """R_{i+1}^i f_{i+1}: what the next link is held with, along the axes of link i."""
    return Product((after.R, after.vector(base)))


def moment_of_next(link: LinkNames, after: LinkNames) -> list[Node]:
    """R n_{i+1} + r × (R f_{i+1}), r from the point of n_i to that of n_{i+1}."""
    lever = link.lever if link.standard else after.lever
    return [passed_on(after, "n"), Cross(lever, Parenthesized(passed_on(after, "f")))]


def moment_of_body(body: BodyNames, inertial: Node, is_point: bool) -> list[Node]:
    """r × F + I ω̇ + ω × (I ω), r from the point of n_i to the mass centre; of a point mass r × F."""
    lever = body.lever if body.link.standard else body.center
    force = Cross(lever, Parenthesized(inertial))
    if is_point:
        return [force]
    w, dw = body.link.vector(W), body.link.vector(W, 1)
    spun = Cross(w, Parenthesized(Product((body.tensor, w))))
    return [force, Product((body.tensor, dw)), spun]


# -- the lines that give the parts of a sum before it is added up ----------------------------------

Part = tuple[Node, Matrix]
"""A term of a formula, and its value."""


def lines_of(context: Context, parts: Sequence[Part]) -> tuple[Line, ...]:
    """The parts that are not zero, each with its value; none where there is one or none."""
    shown = [(name, value) for name, value in parts if not value.is_zero]
    if len(shown) < 2:
        return ()
    formulas = tuple(equation(name, context.show(value)) for name, value in shown)
    zero = "; the others are zero" if len(shown) < len(parts) else ""
    return (Line((f"Its parts{zero}:",), formulas),)


def concluding(lines: Sequence[Line]) -> Prose:
    """What leads from the parts to the result."""
    return ("Added:",) if lines else ()


# -- the step of what is known of each link, along the axes of its own frame -----------------------


def source_of(context: Context) -> str:
    """The section of the book whose convention the table is in."""
    return spong("7.6") if context.standard else craig("6.5")


def links_step(context: Context) -> Step:
    """R, the levers, the axes, gravity, and the tensors of all links."""
    general = LinkNames.general(context.standard)
    base: Prose = (" In place of gravity the base accelerates upwards, which weighs on every link alike.",)
    if context.standard:
        to_base = letters.bold("R", Symbol("i"), Number(0))
        turned = Product((Transpose(to_base), letters.GRAVITY))
        base = (" Gravity is turned into each frame too: ", equation(general.gravity, turned), ".")
    return Step(
        id="links",
        stage=Stage.NEWTON_EULER,
        title="The links, each in its own frame",
        why=(
            "Every vector of link i is written along the axes of its own frame i, in which the mass centre "
            "and the tensor are constant. A vector passes from frame i-1 to frame i by the transpose of ",
            general.R,
            ", the rotation in ",
            letters.bold("A", Symbol("i")),
            ".",
            *base,
        ),
        source=source_of(context),
        result=tuple(known for joint in context.robot.joints for known in _known(context, joint)),
        listed=True,
        uses=tuple(f"A{joint.index}" for joint in context.robot.joints),
    )


def _known(context: Context, joint: Joint) -> Iterator[Node]:
    """The rotation, the lever, the joint's axis, gravity, and the bodies of a link."""
    robot, link = context.robot, LinkNames.of(context.robot, joint.index)
    A: Matrix = context.values[f"A{joint.index}"]
    yield equation(link.R, context.show(rotation(A)))
    yield equation(link.lever, context.show(recursions.lever(A) if context.standard else origin(A)))
    if joint.type:
        yield equation(link.axis, context.show(recursions.joint_axis(robot, A)))
    if context.standard and not robot.gravity.is_zero:
        H: Matrix = context.values[f"H{joint.index}"]
        yield equation(link.gravity, context.show(rotation(H).T @ robot.gravity))
    for body in robot.bodies_on(joint.index):
        names = BodyNames.of(context.robot, body)
        if context.standard:
            yield equation(names.lever, context.show(recursions.lever(A) + body.center))
        else:
            yield equation(names.center, context.show(body.center))
        if not body.is_point:
            yield equation(names.tensor, context.show(tensor_value(context, body)))


def tensor_value(context: Context, body: Body) -> Matrix:
    """The tensor about the mass centre along the axes of the link's frame, 3×3."""
    H, own = context.values[f"H{body.link}"], context.values[f"I_body{body.name}"]
    return recursions.tensor_in_link(context.robot, body, H, own)


# -- the steps outwards: ω, ω̇ and the acceleration of each frame, from those of the frame before --

STAGE = Stage.NEWTON_EULER


def outwards(context: Context, joint: Joint) -> Iterator[Step]:
    """The steps of one link, of what is asked for and what that is derived from."""
    wanted, i = context.wanted, joint.index
    for name, step in (("wl", _angular_velocity), ("wdl", _angular_acceleration), ("al", _acceleration)):
        if f"{name}{i}" in wanted:
            yield step(context, joint)
    for body in context.robot.bodies_on(i):
        if f"acl{body.name}" in wanted:
            yield _center_acceleration(context, body)


def _rates(context: Context, joint: Joint, kind: JointType) -> tuple[Node, Node] | None:
    """The first and second rate of the joint's variable, q̇_1 + q̇_2; None where it is of another kind."""
    if joint.type is not kind:
        return None
    return _rate(context, joint, 1), _rate(context, joint, 2)


def _rate(context: Context, joint: Joint, dots: int) -> Node:
    names = [q.name for q in context.robot.coordinates]
    terms: list[Node] = []
    for k, rate in joint.rates:
        term: Node = Symbol(names[k], dots)
        if abs(rate) != 1:
            term = Product((number(abs(rate)), term))
        terms.append(Negative(term) if rate < 0 else term)
    return (
        terms[0] if len(terms) == 1 and not isinstance(terms[0], Negative) else Parenthesized(sum_of(terms))
    )


# -- how a link turns ------------------------------------------------------------------------------


def _angular_velocity(context: Context, joint: Joint) -> Step:
    i, link = joint.index, LinkNames.of(context.robot, joint.index)
    rates = _rates(context, joint, JointType.REVOLUTE)
    terms = angular_velocity(link, rates and rates[0])
    return Step(
        id=f"wl{i}",
        stage=STAGE,
        title=f"Link {i}, outwards: angular velocity",
        why=(_turning_why(joint),),
        formula=equation(link.vector("omega"), sum_of(terms)),
        source=source_of(context),
        working=_with_matrices(context, joint, link),
        result=(equation(link.vector("omega"), context.form(f"wl{i}")),),
    )


def _turning_why(joint: Joint) -> str:
    i = joint.index
    if joint.type is JointType.REVOLUTE:
        if not joint.parent:
            return "The base does not turn; the link turns about its joint."
        return f"Link {i} turns with link {joint.parent}, and about its own joint."
    still = f"link {joint.parent}" if joint.parent else "the base, which does not turn"
    how = "Its joint slides: the link turns with" if joint.type else "The link is fixed to"
    return f"{how} {still}."


def _with_matrices(context: Context, joint: Joint, link: LinkNames) -> tuple[Node, ...]:
    """The formula of ω with this robot's matrices, where there is anything to work out."""
    if not joint.parent:
        return ()
    A: Matrix = context.values[f"A{joint.index}"]
    before = context.form(f"wl{joint.parent}")
    terms: list[Node] = [Product((Transpose(context.show(rotation(A))), before))]
    rates = _rates(context, joint, JointType.REVOLUTE)
    if rates is not None:
        terms.append(Product((context.show(recursions.joint_axis(context.robot, A)), rates[0])))
    return (equation(link.vector("omega"), sum_of(terms)),) if is_small(*terms) else ()


def _angular_acceleration(context: Context, joint: Joint) -> Step:
    i, link, values = joint.index, LinkNames.of(context.robot, joint.index), context.values
    rates = _rates(context, joint, JointType.REVOLUTE)
    terms = angular_acceleration(link, rates)
    why = "The joint adds nothing; that of the link before is turned into the frame."
    A: Matrix = values[f"A{i}"]
    before = recursions.base_motion(context.robot).dw
    if joint.parent:
        before = values[f"wdl{joint.parent}"]
    parts = [rotation(A).T @ before]
    if rates is not None:
        first, second = (recursions.joint_rate(context.robot, joint, A, dots) for dots in (1, 2))
        parts += [second, cross(values[f"wl{i}"], first)]
        why = "The joint's own acceleration, and the turning of its axis with the link."
    lines = lines_of(context, list(zip(terms, parts, strict=True)))
    return Step(
        id=f"wdl{i}",
        stage=STAGE,
        title=f"Link {i}, outwards: angular acceleration",
        why=(why,),
        formula=equation(link.vector("omega", 1), sum_of(terms)),
        source=source_of(context),
        lines=lines,
        concluding=concluding(lines),
        result=(equation(link.vector("omega", 1), context.form(f"wdl{i}")),),
    )


# -- how its points accelerate ---------------------------------------------------------------------


def _acceleration(context: Context, joint: Joint) -> Step:
    i, link = joint.index, LinkNames.of(context.robot, joint.index)
    terms = acceleration(link, link.lever, _rates(context, joint, JointType.PRISMATIC))
    lines = lines_of(context, list(zip(terms, _carried(context, joint, None), strict=True)))
    return Step(
        id=f"al{i}",
        stage=STAGE,
        title=f"Link {i}, outwards: acceleration of its origin",
        why=(_carried_why(joint), *_base_why(context, joint)),
        formula=equation(link.vector("a"), sum_of(terms)),
        source=source_of(context),
        lines=lines,
        concluding=concluding(lines),
        result=(equation(link.vector("a"), context.form(f"al{i}")),),
    )


def _carried_why(joint: Joint) -> str:
    made = "What the origin before has, and what the turning adds over the way from there"
    if joint.type is JointType.PRISMATIC:
        return f"{made}; since the joint slides, also the Coriolis acceleration and its own."
    return f"{made}."


def _base_why(context: Context, joint: Joint) -> Prose:
    if joint.parent:
        return ()
    if context.standard:
        return (" The base is at rest.",)
    given = equation(
        LinkNames.of(context.robot, joint.index).vector_before("a"),
        context.show(recursions.lift(context.robot)),
    )
    return (" The base accelerates by ", given, ", which stands for gravity.")


def _carried(context: Context, joint: Joint, beyond: Matrix | None) -> tuple[Matrix, ...]:
    """The values of the terms of an acceleration."""
    i, values = joint.index, context.values
    before = recursions.base_motion(context.robot)
    if joint.parent:
        before = recursions.Motion(*(values[f"{stem}{joint.parent}"] for stem in ("wl", "wdl", "al")))
    step = recursions.Step(joint, values[f"A{i}"], before)
    return recursions.acceleration_parts(context.robot, step, values[f"wl{i}"], values[f"wdl{i}"], beyond)


def _center_acceleration(context: Context, body: Body) -> Step:
    joint, names = context.robot.joints[body.link - 1], BodyNames.of(context.robot, body)
    terms = center_acceleration(names, _rates(context, joint, JointType.PRISMATIC))
    if context.standard:
        why = "As for an origin, with the way from the origin before to the mass centre."
        values = _carried(context, joint, body.center)
    else:
        why = "From the origin of the frame to the mass centre, which is fixed in the link."
        at_origin, w, dw = (context.values[f"{stem}{body.link}"] for stem in ("al", "wl", "wdl"))
        values = (at_origin, *recursions.turning_parts(w, dw, body.center))
    lines = lines_of(context, list(zip(terms, values, strict=True)))
    return Step(
        id=f"acl{body.name}",
        stage=STAGE,
        title=f"Body {body.name}, outwards: acceleration of its mass centre",
        why=(why,),
        formula=equation(names.acceleration, sum_of(terms)),
        source=source_of(context),
        lines=lines,
        concluding=concluding(lines),
        result=(equation(names.acceleration, context.form(f"acl{body.name}")),),
    )


# -- the steps inwards: what each link is held with by the link before, a force and a moment -------


def inwards(context: Context, joint: Joint) -> Iterator[Step]:
    """The steps of one link, of what is asked for and what that is derived from."""
    for name, step in (("fl", _force), ("nl", _moment)):
        if f"{name}{joint.index}" in context.wanted:
            yield step(context, joint)


def is_heavy(context: Context) -> bool:
    """Whether gravity stands in the forces; in the modified convention it stands in the accelerations."""
    return context.standard and not context.robot.gravity.is_zero


def _nothing_follows(context: Context, i: int) -> Prose:
    return () if context.robot.links_after(i) else (" No link follows, so nothing is passed on.",)


def _inertial(context: Context, body: Body) -> Node:
    return inertial_force(BodyNames.of(context.robot, body), context.mass(body), is_heavy(context))


def _inertial_value(context: Context, body: Body) -> Matrix:
    H, acceleration = context.values[f"H{body.link}"], context.values[f"acl{body.name}"]
    return recursions.inertial_force(context.robot, body, H, acceleration)


# -- the force -------------------------------------------------------------------------------------


def _force(context: Context, joint: Joint) -> Step:
    i, bodies = joint.index, context.robot.bodies_on(joint.index)
    parts = list(_forces(context, i, bodies))
    lines = lines_of(context, parts)
    name = letters.in_link("f", i)
    return Step(
        id=f"fl{i}",
        stage=STAGE,
        title=f"Link {i}, inwards: the force in its joint",
        why=(_newton(context, bodies), *_nothing_follows(context, i)),
        formula=equation(name, sum_of([part for part, _ in parts]) if parts else ZERO),
        source=source_of(context),
        lines=lines,
        concluding=concluding(lines),
        result=(equation(name, context.form(f"fl{i}")),),
    )


def _forces(context: Context, i: int, bodies: Sequence[Body]) -> Iterator[Part]:
    """The terms of f_i, each with its value."""
    for j in context.robot.links_after(i):
        R = rotation(context.values[f"A{j}"])
        yield passed_on(LinkNames.of(context.robot, j), "f"), R @ context.values[f"fl{j}"]
    for body in bodies:
        yield _inertial(context, body), _inertial_value(context, body)


def _newton(context: Context, bodies: Sequence[Body]) -> str:
    if not bodies:
        return "The link has no mass: it passes on the force that the next link needs."
    own = " beside its weight" if is_heavy(context) else ""
    next_link = ", and what the next link needs" if context.robot.links_after(bodies[0].link) else ""
    return f"Newton's law: what the mass needs{own}{next_link}."


# -- the moment ------------------------------------------------------------------------------------


def _moment(context: Context, joint: Joint) -> Step:
    i = joint.index
    parts = list(_moments(context, joint))
    lines = lines_of(context, parts)
    name = letters.in_link("n", i)
    return Step(
        id=f"nl{i}",
        stage=STAGE,
        title=f"Link {i}, inwards: the moment in its joint",
        why=(
            "Euler's law about the mass centre, and the moments of the forces about ",
            letters.o(i - 1 if context.standard else i),
            ".",
            *_nothing_follows(context, i),
        ),
        formula=equation(name, sum_of([part for part, _ in parts]) if parts else ZERO),
        source=source_of(context),
        lines=lines,
        concluding=concluding(lines),
        result=(equation(name, context.form(f"nl{i}")),),
    )


def _moments(context: Context, joint: Joint) -> Iterator[Part]:
    """The terms of n_i, each with its value."""
    robot, values, i = context.robot, context.values, joint.index
    link = LinkNames.of(context.robot, i)
    for j in robot.links_after(i):
        A: Matrix = values[f"A{j}"]
        reach = recursions.lever(values[f"A{i}"]) if context.standard else origin(A)
        force = cross(reach, rotation(A) @ values[f"fl{j}"])
        named = moment_of_next(link, LinkNames.of(context.robot, j))
        yield from zip(named, (rotation(A) @ values[f"nl{j}"], force), strict=True)
    for body in robot.bodies_on(i):
        yield from _of_body(context, joint, body)
    if robot.actions.motors:
        from dynsolve.explain.actions import rotor_moments

        yield from rotor_moments(context, i)


def _of_body(context: Context, joint: Joint, body: Body) -> Iterator[Part]:
    values, i = context.values, joint.index
    start = recursions.start_of_moments(context.robot, values[f"A{i}"])
    found = [cross(start + body.center, _inertial_value(context, body))]
    if not body.is_point:
        tensor, w, dw = tensor_value(context, body), values[f"wl{i}"], values[f"wdl{i}"]
        found += [tensor @ dw, cross(w, tensor @ w)]
    names = BodyNames.of(context.robot, body)
    yield from zip(moment_of_body(names, _inertial(context, body), body.is_point), found, strict=True)
