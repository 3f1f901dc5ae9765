"""Steps of the Newton-Euler recursions: outwards the motions, link by link, inwards the forces.

Every vector of link i is written along the axes of frame i, as ω_i^i and r_{ci}^i.  Where the recursions are
the way to the forces, these follow as components of what the joints hold; of robots of more than three
coordinates the recursions are then told once for all links.  Spong, Hutchinson, Vidyasagar, section 7.6,
in the standard convention; Craig, section 6.5, in the modified.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction

from msgspec.structs import asdict, replace

from dynsolve.algebra.matrix import Matrix, cross
from dynsolve.derivation import actions
from dynsolve.derivation.kinematics import origin, rotation
from dynsolve.document import Prose
from dynsolve.document.books import spong
from dynsolve.document.sentences import say
from dynsolve.explain.actions import friction_steps, stored_steps
from dynsolve.explain.context import MOST_JOINTS, Context
from dynsolve.explain.named_steps import ending
from dynsolve.explain.step import Detail, Group, Line, Step
from dynsolve.explain.terms import driving_row
from dynsolve.explain.torque import how_collected
from dynsolve.explain.writing import is_small, listed, side_by_side, sum_of, turns
from dynsolve.notation.template import formula
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
from dynsolve.questions.newton_euler import recursions
from dynsolve.questions.newton_euler.terms import (
    CHILD,
    Names,
    Rates,
    acceleration,
    angular_acceleration,
    angular_velocity,
    center_acceleration,
    inertial_force,
    moment_of_body,
    moment_of_next,
    outside_names,
)
from dynsolve.robot import units
from dynsolve.robot.model import Body, Coordinate, Joint, JointType
from dynsolve.robot.questions import FOR_EVERY_Q, Method

LETTERS = """
* 𝐳_{turning}^i | axis of joint i, in frame i
* 𝐫_(i-1,i)^i: origin of frame i; {LEVER}: mass centre of body i | , from the origin of frame i-1 | m
* 𝐠_0^i | acceleration of gravity, in frame i | m/s^2
* 𝛚_i^i: angular velocity; 𝛚̇_i^i: angular acceleration | of link i, in frame i
* 𝐚_i^i: origin of frame i; 𝐚_ci^i: mass centre of body i | : its acceleration, in frame i | m/s^2
* 𝐈_ci^i | inertia tensor of body i about its mass centre, in frame i | kg m^2
* 𝐟_i^i: force; 𝐧_i^i: moment | with which link i-1 holds link i, in frame i
* 𝐅_j^i: force; 𝐌_j^i: moment | number j from outside on link i, in frame i
* 𝐫_Fj^i | point of force j from outside | m
"""
"""The lines of its letters in the list of notation."""


def steps(context: Context) -> Iterator[Step]:
    """What is known of each link; outwards ω, ω̇ and the accelerations; inwards f, n and the forces τ."""
    robot = context.robot
    by_method = robot.questions.method is Method.NEWTON_EULER
    yield _links(context)
    if by_method and robot.n > MOST_JOINTS:
        yield from general_steps(context)
    for joint in robot.joints:
        group = Group(f"outwards{joint.index}", f"Link {joint.index}, outwards")
        yield from (replace(step, group=group) for step in _outwards(context, joint))
    for joint in reversed(robot.joints):
        group = Group(f"inwards{joint.index}", f"Link {joint.index}, inwards")
        yield from (replace(step, group=group) for step in _inwards(context, joint))
    if by_method:
        yield from (*stored_steps(context), *friction_steps(context))
        for q in robot.coordinates:
            yield replace(_torque(context, q), group=Group("tau", "The generalized forces"))
        yield _lagrange(context)
    else:
        yield from _ends(context)


# -- the steps: what is known of each link, then a sum of terms each, its parts before it is added up


def _sum(context: Context, key: str, title: str, why: Prose, name: Node, parts: Sequence[Part]) -> Step:
    """A quantity as the sum of its terms; their values where several are not zero."""
    shown = [
        equation(term, context.show(value))
        for term, value in parts
        if value is not None and not value.is_zero
    ]
    zero = "; the others are zero" if len(shown) < len(parts) else ""
    lines = (Line((f"Its parts{zero}:",), tuple(shown)),) if len(shown) > 1 else ()
    return Step(
        id=key,
        title=title,
        why=why,
        formula=equation(name, sum_of([term for term, _ in parts])) if parts else None,
        source=context.by_convention("7.6", "6.5"),
        lines=lines,
        concluding=("Added:",) if lines else (),
        result=(equation(name, context.form(key)),),
    )


Part = tuple[Node, Matrix | None]
"""A term of a formula, and its value where that is shown."""


def _links(context: Context) -> Step:
    """R, the levers, the axes, gravity, and the tensors of all links."""
    general = Names.general(context)
    base: Prose = ()
    if not context.standard and not context.robot.gravity.is_zero:
        base = say(" In place of gravity the base accelerates upwards, which weighs on every link alike.")
    elif _is_heavy(context):
        turned = equation(general("{g}"), Product((Transpose(_from_ground(context)), letters.GRAVITY)))
        base = say(" Gravity is turned into each frame too: {turned}.", turned=turned)
    return Step(
        id="links",
        title="The links, each in its own frame",
        why=say(
            "Every vector of link i is written along the axes of its own frame i, in which the mass centre "
            "and the tensor are constant. A vector passes from frame {before} to frame i by the transpose of "
            "{R}, the rotation in $𝐀_i$.{base}",
            before=say("p, from which row i starts,") if context.robot.is_tree else "i-1",
            R=general("{R}"),
            base=base,
        ),
        source=context.by_convention("7.6", "6.5"),
        result=tuple(known for joint in context.robot.joints for known in _known(context, joint)),
        listed=True,
        uses=tuple(f"A{joint.index}" for joint in context.robot.joints),
    )


def _from_ground(context: Context) -> Letter:
    """R_i^0, or R_i^w where the base is turned or moved in the world."""
    return letters.bold("R", letters.COUNT, Words("w") if letters.has_base(context.robot) else Number(0))


def _known(context: Context, joint: Joint) -> Iterator[Node]:
    """The rotation, the lever, the joint's axis, gravity, and the bodies of a link."""
    robot, link = context.robot, Names.of(context.robot, joint.index)
    A: Matrix = context.values[f"A{joint.index}"]
    yield equation(link("{R}"), context.show(rotation(A)))
    yield equation(link("{r}"), context.show(recursions.lever(A) if context.standard else origin(A)))
    if joint.type:
        yield equation(link("{z}"), context.show(recursions.joint_axis(robot, A)))
    if _is_heavy(context):
        H: Matrix = context.values[f"H{joint.index}"]
        yield equation(link("{g}"), context.show(rotation(H).T @ robot.gravity))
    for body in robot.bodies_on(joint.index):
        names = Names.of(robot, joint.index, body)
        center = recursions.start_of_moments(robot, A) + body.center
        yield equation(names("{rc}"), context.show(center))
        if not body.is_point:
            yield equation(names("{I}"), context.show(_tensor(context, body)))
    start = recursions.start_of_moments(robot, A)
    for place, at, force, moment in _from_outside(context, joint.index):
        for name, value in zip(outside_names(link, Number(place)), (start + at, force, moment), strict=True):
            if not value.is_zero:
                yield equation(name, context.show(value))


def _from_outside(context: Context, link: int) -> list[tuple[int, Matrix, Matrix, Matrix]]:
    """The forces from outside on a link: number, point, force and moment along its axes."""
    return recursions.from_outside(context.robot, link, context.values[f"H{link}"])


def _is_heavy(context: Context) -> bool:
    """Whether gravity stands in the forces; in the modified convention it stands in the accelerations."""
    return context.standard and not context.robot.gravity.is_zero


def _tensor(context: Context, body: Body) -> Matrix:
    """The tensor about the mass centre along the axes of the link's frame, 3×3."""
    H, own = context.values[f"H{body.link}"], context.values[f"I_body{body.name}"]
    return recursions.tensor_in_link(context.robot, body, H, own)


# -- outwards: ω, ω̇ and the acceleration of each frame, from those of the frame before -------------


def _outwards(context: Context, joint: Joint) -> Iterator[Step]:
    """The steps of one link, of what is asked for and what that is derived from."""
    i = joint.index
    for name, step in (("wl", _turning_step), ("wdl", _spinning_step), ("al", _origin_step)):
        if f"{name}{i}" in context.wanted:
            yield step(context, joint)
    for body in context.robot.bodies_on(i):
        if f"acl{body.name}" in context.wanted:
            yield _center_step(context, joint, body)


def _rates(context: Context, joint: Joint, kind: JointType) -> Rates:
    """The first and second rate of the joint's variable, q̇_1 + q̇_2; None where it is of another kind."""
    if joint.type is not kind:
        return None
    first, second = (
        [_rated(rate, Symbol(context.robot.coordinates[k].name, dots)) for k, rate in joint.rates]
        for dots in (1, 2)
    )
    is_plain = len(first) == 1 and not isinstance(first[0], Negative)
    if is_plain:
        return first[0], second[0]
    return Parenthesized(sum_of(first)), Parenthesized(sum_of(second))


def _rated(rate: Fraction, term: Node) -> Node:
    """A term times a rate, the sign in front."""
    if abs(rate) != 1:
        term = Product((number(abs(rate)), term))
    return Negative(term) if rate < 0 else term


def _turning_step(context: Context, joint: Joint) -> Step:
    """ω_i, with this robot's matrices where there is anything to work out."""
    i, link = joint.index, Names.of(context.robot, joint.index)
    spin = _rates(context, joint, JointType.REVOLUTE)
    parts = [(term, None) for term in angular_velocity(link, spin)]
    why = say("{why}", why=_turning_why(joint))
    step = _sum(context, f"wl{i}", f"Link {i}, outwards: angular velocity", why, link("{w}"), parts)
    if not joint.parent:
        return step
    A: Matrix = context.values[f"A{i}"]
    terms = [formula("{R}ᵀ {w}", R=context.show(rotation(A)), w=context.form(f"wl{joint.parent}"))]
    if spin:
        terms.append(Product((context.show(recursions.joint_axis(context.robot, A)), spin[0])))
    working = (equation(link("{w}"), sum_of(terms)),) if is_small(*terms) else ()
    return replace(step, working=working)


def _turning_why(joint: Joint) -> str:
    i = joint.index
    if joint.type is JointType.REVOLUTE:
        if not joint.parent:
            return "The base does not turn; the link turns about its joint."
        return f"Link {i} turns with link {joint.parent}, and about its own joint."
    still = f"link {joint.parent}" if joint.parent else "the base, which does not turn"
    how = "Its joint slides: the link turns with" if joint.type else "The link is fixed to"
    return f"{how} {still}."


def _spinning_step(context: Context, joint: Joint) -> Step:
    """ω̇_i"""
    robot, i, link = context.robot, joint.index, Names.of(context.robot, joint.index)
    spin = _rates(context, joint, JointType.REVOLUTE)
    why = "That of the link before, turned into the frame."
    A: Matrix = context.values[f"A{i}"]
    values = [rotation(A).T @ _motion_before(context, joint).dw]
    if spin:
        first, second = (recursions.joint_rate(robot, joint, A, dots) for dots in (1, 2))
        values += [second, cross(context.values[f"wl{i}"], first)]
        why = "The joint's own acceleration, and the turning of its axis with the link."
    title, terms = f"Link {i}, outwards: angular acceleration", angular_acceleration(link, spin)
    return _sum(context, f"wdl{i}", title, (why,), link("{dw}"), list(zip(terms, values, strict=True)))


def _motion_before(context: Context, joint: Joint) -> recursions.Motion:
    """How the frame before moves."""
    if not joint.parent:
        return recursions.base_motion(context.robot)
    return recursions.Motion(*(context.values[f"{stem}{joint.parent}"] for stem in ("wl", "wdl", "al")))


def _origin_step(context: Context, joint: Joint) -> Step:
    """The acceleration of o_i."""
    i, link = joint.index, Names.of(context.robot, joint.index)
    terms = acceleration(link, _rates(context, joint, JointType.PRISMATIC))
    base: Prose = ()
    if not joint.parent and (context.standard or context.robot.gravity.is_zero):
        base = (" The base is at rest.",)
    elif not joint.parent:
        robot = context.robot
        upwards: Node = Negative(letters.GRAVITY)
        if letters.has_base(robot):
            upwards = Negative(Product((Transpose(letters.R(robot, 0)), letters.GRAVITY)))
        values = recursions.lift(robot).entries
        row: Node = Transpose(Parenthesized(side_by_side([context.show(entry) for entry in values])))
        if all(entry.is_number for entry in values):
            row = Row((row, Words(" "), units.node("m/s^2")))
        lift = equation(link("{a0}"), upwards, row)
        base = say(" The base accelerates by {lift}, which stands for gravity.", lift=lift)
    why = say(
        "What the origin before has, and what the turning adds over the way from there{slide}.{base}",
        slide="; since the joint slides, also the Coriolis acceleration and its own"
        if joint.type is JointType.PRISMATIC
        else "",
        base=base,
    )
    parts = list(zip(terms, _carried(context, joint, None), strict=True))
    return _sum(context, f"al{i}", f"Link {i}, outwards: acceleration of its origin", why, link("{a}"), parts)


def _carried(context: Context, joint: Joint, beyond: Matrix | None) -> tuple[Matrix, ...]:
    """The values of the terms of an acceleration."""
    i, values = joint.index, context.values
    step = recursions.Step(joint, values[f"A{i}"], _motion_before(context, joint))
    return recursions.acceleration_parts(context.robot, step, values[f"wl{i}"], values[f"wdl{i}"], beyond)


def _center_step(context: Context, joint: Joint, body: Body) -> Step:
    """The acceleration of a mass centre."""
    link = Names.of(context.robot, joint.index, body)
    terms = center_acceleration(link, _rates(context, joint, JointType.PRISMATIC))
    if context.standard:
        why = "As for an origin, with the way from the origin before to the mass centre."
        values = _carried(context, joint, body.center)
    else:
        why = "From the origin of the frame to the mass centre, which is fixed in the link."
        at_origin, w, dw = (context.values[f"{stem}{body.link}"] for stem in ("al", "wl", "wdl"))
        values = (at_origin, *recursions.turning_parts(w, dw, body.center))
    title = f"Body {body.name}, outwards: acceleration of its mass centre"
    parts = list(zip(terms, values, strict=True))
    return _sum(context, f"acl{body.name}", title, (why,), link("{ac}"), parts)


# -- inwards: what each link is held with by the link before, a force and a moment -----------------


def _inwards(context: Context, joint: Joint) -> Iterator[Step]:
    """The steps of one link, of what is asked for and what that is derived from."""
    i, wanted = joint.index, context.wanted
    if f"fl{i}" in wanted:
        title = f"Link {i}, inwards: the force that it needs"
        yield _sum(
            context,
            f"fl{i}",
            title,
            say(_force_why(context, i)),
            letters.in_link("f", i),
            list(_forces(context, i)),
        )
    if f"nl{i}" in wanted:
        title = f"Link {i}, inwards: the moment that it needs"
        has_tensor = any(not body.is_point for body in context.robot.bodies_on(i))
        why = say(
            "Euler's law about the mass centre, and the moments of the forces about {o}."
            if has_tensor
            else "The moments about {o}.",
            o=letters.o(joint.parent if context.standard else i),
        )
        rotors = [name for name, _ in _rotor_moments(context, i)]
        if rotors:
            takes = "a rotor takes" if len(rotors) == 1 else "rotors take"
            why = say(
                "{why} {rotors}: what {takes} from the link.", why=why, rotors=listed(rotors), takes=takes
            )
        yield _sum(context, f"nl{i}", title, why, letters.in_link("n", i), list(_moments(context, i)))


def _force_why(context: Context, i: int) -> str:
    """Newton's law for the mass of a link; what the links after it need."""
    follows = context.robot.links_after(i)
    after = "the next link needs" if len(follows) == 1 else "the links after it need"
    outside = ", less the force from outside" * bool(_from_outside(context, i))
    if not context.robot.bodies_on(i):
        passed = f": it passes on what {after}" if follows else ""
        return f"The link has no mass{passed}{outside}."
    own = " beside its weight" if _is_heavy(context) else ""
    rest = f", and what {after}." if follows else ". No link follows, so nothing is passed on."
    return f"Newton's law: what the mass needs{own}{outside}{rest}"


def _inertial(context: Context, body: Body) -> tuple[Node, Matrix]:
    """m (a_c - g_0) of a body."""
    H, acceleration = context.values[f"H{body.link}"], context.values[f"acl{body.name}"]
    name = inertial_force(
        Names.of(context.robot, body.link, body), context.forms.mass(body), _is_heavy(context)
    )
    return name, recursions.inertial_force(context.robot, body, H, acceleration)


def _forces(context: Context, i: int) -> Iterator[Part]:
    """The terms of f_i, each with its value."""
    robot, values = context.robot, context.values
    for j in robot.links_after(i):
        yield Names.of(robot, j)("{R} 𝐟_{i}^{i}"), rotation(values[f"A{j}"]) @ values[f"fl{j}"]
    for body in robot.bodies_on(i):
        yield _inertial(context, body)
    for place, _, force, _ in _from_outside(context, i):
        yield Negative(outside_names(Names.of(robot, i), Number(place))[1]), -force


def _moments(context: Context, i: int) -> Iterator[Part]:
    """The terms of n_i, each with its value."""
    robot, values = context.robot, context.values
    start = recursions.start_of_moments(robot, values[f"A{i}"])
    for j in robot.links_after(i):
        A: Matrix = values[f"A{j}"]
        reach = start if context.standard else origin(A)
        found = [rotation(A) @ values[f"nl{j}"], cross(reach, rotation(A) @ values[f"fl{j}"])]
        yield from zip(moment_of_next(Names.of(robot, i), Names.of(robot, j)), found, strict=True)
    for body in robot.bodies_on(i):
        name, inertial = _inertial(context, body)
        found = [cross(start + body.center, inertial)]
        if not body.is_point:
            tensor, w, dw = _tensor(context, body), values[f"wl{i}"], values[f"wdl{i}"]
            found += [tensor @ dw, cross(w, tensor @ w)]
        yield from zip(moment_of_body(Names.of(robot, i, body), name, body.is_point), found, strict=True)
    yield from _rotor_moments(context, i)
    for place, at, force, moment in _from_outside(context, i):
        lever, named, couple = outside_names(Names.of(robot, i), Number(place))
        if not force.is_zero:
            yield Negative(Cross(lever, named)), -cross(start + at, force)
        if not moment.is_zero:
            yield Negative(couple), -moment


def _rotor_moments(context: Context, link: int) -> Iterator[tuple[Node, Matrix]]:
    """What each rotor that rides on a link takes from it, a moment, with its value."""
    for place, motor in enumerate(context.robot.actions.rotors, 1):
        if motor.carrier == link:
            w, dw = context.values[f"wl{link}"], context.values[f"wdl{link}"]
            name = letters.bold("n", Row((Words("m"), Number(place))))
            yield name, actions.rotor_moment(context.robot, motor, w, dw)


# -- the forces of the motors ----------------------------------------------------------------------


def _ends(context: Context) -> Iterator[Step]:
    """The forces that are asked for as the recursions give them, where what the joints hold is told."""
    told = [
        q
        for q in context.robot.coordinates
        if not {"tau", q.force}.isdisjoint(context.find)
        and all(
            f"{'nl' if joint.type is JointType.REVOLUTE else 'fl'}{joint.index}" in context.wanted
            for joint, _ in context.robot.joints_of(q)
        )
    ]
    if told:
        yield Step(
            id="tau_held",
            title="The generalized forces",
            why=(
                "Along the axis of a joint the force, where it slides, or the moment, where it turns, is "
                "what drives it. The result is that of the Euler-Lagrange equations.",
            ),
            source=context.by_convention("7.6", "6.5"),
            result=tuple(_driven(context, q) for q in told),
            listed=True,
            uses=tuple(f"tau{q.index}" for q in told),
            is_task=False,
        )


def _along_axes(context: Context, q: Coordinate) -> list[Node]:
    """nᵀ z or fᵀ z of each joint that a coordinate moves."""
    terms: list[Node] = []
    for joint, rate in context.robot.joints_of(q):
        held = letters.in_link("n" if joint.type is JointType.REVOLUTE else "f", joint.index)
        axis = Names.of(context.robot, joint.index)("{z}")
        terms.append(_rated(rate, Product((Transpose(held), axis))))
    return terms


def _driven(context: Context, q: Coordinate) -> Node:
    """τ_k = nᵀ z, without what acts from outside: f and n are less by it."""
    row = driving_row(context.robot, q)
    outside = letters.entry("Q", q.index)
    driving = [term for term in (row.terms if isinstance(row, Sum) else (row,)) if term != outside]
    _, added = _beside_held(context, q)
    return equation(
        sum_of(driving), sum_of([*_along_axes(context, q), *(one for one in added if one != outside)])
    )


def _torque(context: Context, q: Coordinate) -> Step:
    terms, joints = _along_axes(context, q), context.robot.joints_of(q)
    is_passive = q.index - 1 in context.robot.actions.passive
    kind, what = ("torque", "moment") if turns(q) else ("force", "force")
    beside, added = _beside_held(context, q)
    end = ending(context, f"tau{q.index}", {f"tau{q.index}": (driving_row(context.robot, q),)})
    return Step(
        id=f"tau{q.index}",
        title=f"Coordinate {q.index}: the {kind}",
        why=say(
            "{drives}{beside}{collected}",
            drives=_what_drives(context, q, what),
            beside=beside,
            collected=how_collected(context),
        ),
        said="" if beside or len(joints) > 1 or is_passive else f"the {kind} of a joint",
        formula=equation(driving_row(context.robot, q), sum_of([*terms, *added])),
        source=context.by_convention("7.6", "6.5"),
        **asdict(end),
        detail=Detail.BRIEF,
    )


def _beside_held(context: Context, q: Coordinate) -> tuple[Prose, list[Node]]:
    """What is said of rotors, springs and friction of a coordinate, and their terms of its force.

    Beside what the joint holds stand k_r I (k_r q̈ + zᵀω̇) of each rotor that it turns, ∂P_s/∂q and friction.
    """
    robot, k = context.robot, q.index - 1
    why = ""
    terms: list[Node] = []
    for motor in robot.actions.rotors:
        if motor.turns == k:
            why += " It also drives the rotor, through its gear."
            dw = context.values[f"wdl{motor.carrier}"] if motor.carrier else None
            terms.append(context.show(actions.rotor_drive(robot, motor, dw) * motor.ratio))
    if robot.actions.stored and not robot.ring.diff(context.values["Ps"], k).is_zero:
        why += " Springs are held."
        terms.append(letters.partial_derivative(letters.PS, Symbol(q.name)))
    if context.has_friction(k):
        why += " Friction is overcome."
        terms.append(letters.friction(q.index))
    if robot.questions.loads and not context.values[FOR_EVERY_Q][k, 0].is_zero:
        why += " What acts from outside is added on both sides."
        terms.append(letters.entry("Q", q.index))
    return (why,) if why else (), terms


def _what_drives(context: Context, q: Coordinate, what: str) -> Prose:
    """What of the force or moment of its joint is the force of a coordinate."""
    questions = context.robot.questions
    if q.index - 1 in context.robot.actions.passive:
        zero = equation(letters.force(q), Number(0))
        return say("No motor drives {q}: {zero}.", q=Symbol(q.name), zero=zero)
    if len(context.robot.joints_of(q)) > 1:
        return (Symbol(q.name), f" moves several joints: of each the {what} along its axis counts.")
    rest = "" if questions.constraints else "; the bearings hold the rest"
    return (f"Along the axis of the joint the {what} is what drives it{rest}.",)


def _lagrange(context: Context) -> Step:
    forces = listed([letters.force(q) for q in context.robot.coordinates])
    why = say("The Euler-Lagrange equations of the same robot give the same {forces}.", forces=forces)
    return Step(
        id="lagrange",
        title="The same by the Lagrangian",
        why=why,
        outcome=why,
        detail=Detail.FULL,
        source=spong("7.6"),
        uses=tuple(f"tau{q.index}" for q in context.robot.coordinates),
        is_task=False,
    )


# -- the recursions said once for all links, of arms of which nobody reads them link by link -------


def general_steps(context: Context) -> Iterator[Step]:
    """Outwards for each kind of row, then inwards, link i standing for all."""
    link, is_tree = Names.general(context), context.robot.is_tree
    for kind, name, over in (
        (JointType.REVOLUTE, "revolute", "a revolute joint"),
        (JointType.PRISMATIC, "prismatic", "a prismatic joint"),
        (None, "fixed", "a row without a joint"),
    ):
        if any(joint.type is kind for joint in context.robot.joints):
            variable = "theta" if kind is JointType.REVOLUTE else "d"
            rates = Letter(variable, letters.COUNT, dots=1), Letter(variable, letters.COUNT, dots=2)
            spin = rates if kind is JointType.REVOLUTE else None
            slide = rates if kind is JointType.PRISMATIC else None
            yield _general(
                context,
                f"outwards_{name}",
                f"Outwards over {over}",
                "From the first link on, the motion of each follows from that of the one before.",
                {
                    "{w}": angular_velocity(link, spin),
                    "{dw}": angular_acceleration(link, spin),
                    "{a}": acceleration(link, slide),
                    "{ac}": center_acceleration(link, slide),
                },
            )
    after = Names(CHILD if is_tree else letters.AFTER, letters.COUNT, context.standard)
    inertial = inertial_force(link, formula("m_i"), _is_heavy(context))
    is_loaded = bool(context.robot.questions.loads)
    lever, outside, couple = outside_names(link, Symbol("j"))
    yield _general(
        context,
        "inwards",
        "Inwards: the forces and moments that the links need",
        "From the last link to the first: Newton's law and Euler's for each."
        + " Each link k that follows link i has the terms with k." * is_tree
        + " Each force j from outside on link i has the terms with j." * is_loaded,
        {
            "𝐟_{i}^{i}": [after("{R} 𝐟_{i}^{i}"), inertial, *[Negative(outside)] * is_loaded],
            "𝐧_{i}^{i}": [
                *moment_of_next(link, after),
                *moment_of_body(link, inertial, is_point=False),
                *[Negative(Cross(lever, outside)), Negative(couple)] * is_loaded,
            ],
        },
    )


def _general(context: Context, key: str, title: str, why: str, sums: dict[str, list[Node]]) -> Step:
    """Recursions of link i, each the sum of its terms."""
    link = Names.general(context)
    return Step(
        id=key,
        title=title,
        why=(why,),
        said=why,
        source=context.by_convention("7.6", "6.5"),
        result=tuple(equation(link(name), sum_of(terms)) for name, terms in sums.items()),
        listed=True,
        uses=("links",),
    )


# -- hints -----------------------------------------------------------------------------------------

AT_HAND = "You have the matrices of the rows of the table:"

PITFALLS = """
    Every vector has its components along the axes of its own link: what comes from another link is
        turned first, outwards by the transpose of the rotation, inwards by the rotation.
    standard? The axis of a joint is that of the frame before, turned into its own: it is the third row of
        the rotation, and not (0, 0, 1).
    standard? The moment is about the origin before the link: the lever of the mass centre starts there.
    sliding? A joint that slides on a turning link adds twice ω × the velocity, besides its own
        acceleration.
"""


def inputs(context: Context) -> list[tuple[Node, str]]:
    """The results that it starts from, by letter and name."""
    return [(letters.A(joint.index), f"A{joint.index}") for joint in context.robot.joints]
