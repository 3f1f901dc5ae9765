"""Steps that say once for all links, bodies or coordinates what a short model says one by one.

Of a long model nobody reads the Jacobian of each mass centre or the momentum of each
coordinate: the general formula stands for all of them, and the single steps are
details.  What the model is made of, the matrices of the rows, the last frame, the
tensors that are given, is shown in any case.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial

from msgspec.structs import replace

from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.kinematics import rotation
from dynsolve.derivation.rules import course_rules
from dynsolve.document.books import spong
from dynsolve.document.sentences import say
from dynsolve.explain.actions import gravity_given
from dynsolve.explain.christoffel import SLOPES
from dynsolve.explain.context import Context
from dynsolve.explain.entry_formulas import is_too_long
from dynsolve.explain.inertia import has_link_axes, is_moved
from dynsolve.explain.jacobian import ZERO
from dynsolve.explain.last_frame import halves
from dynsolve.explain.long_model.inertia_entry import brief_step, kinetic_step
from dynsolve.explain.matrix_factors import matrix_width
from dynsolve.explain.step import Detail, Line, Step
from dynsolve.explain.writing import side_by_side
from dynsolve.notation import tree
from dynsolve.notation.template import formula
from dynsolve.notation.tree import Node, Number, Product, Transpose, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Body, JointType
from dynsolve.robot.questions import Method


def said_once(context: Context) -> Callable[[Iterable[Step], Stage], Iterator[Step]]:
    """What makes of the steps of a stage those in which what is alike is said once."""
    return partial(_told_once, context, _general_steps(context))


def _told_once(
    context: Context, once: Mapping[str, Step], steps: Iterable[Step], stage: Stage
) -> Iterator[Step]:
    """The steps of a stage, before the first of those that are alike what is said once for them.

    These are its details, and what uses one of them uses that.
    """
    inputs = {rule.name: rule.inputs for rule in course_rules(context.robot)}
    told: set[str] = set()
    for step in steps:
        general = once.get(step.id)
        if stage in (Stage.INERTIA, Stage.ENERGY) and step.id != "K" and is_too_long(step.result):
            step = _left_out(step)
        if general is None:
            uses = inputs.get(step.id, ()) if step.uses is None else step.uses
            of_steps = (once[name].id if name in once else name for name in uses)
            yield replace(step, uses=tuple(dict.fromkeys(of_steps)))
            continue
        if general.id not in told:
            told.add(general.id)
            yield general
        yield replace(step, detail=Detail.FULL)


def _left_out(step: Step) -> Step:
    if step.formula is None:
        return step
    note = ("Written out it would be too long to be useful; the formula defines it.",)
    return replace(step, result=(), notes=(*step.notes, note))


def _general_steps(context: Context) -> dict[str, Step]:
    """What is said once, by the ids of the steps in whose place it stands: they become its details."""
    robot = context.robot
    bodies = [body.name for body in robot.bodies]
    solid = [body for body in robot.bodies if has_link_axes(body) and not is_moved(body)]
    coordinates = [q.index for q in robot.coordinates]
    rows = [joint.index for joint in robot.joints]
    found: dict[str, Step] = {}

    def say_once(step: Step, stems: str, names: Sequence[str | int]) -> None:
        found.update({f"{stem}{name}": step for stem in stems.split() for name in names})

    matrices = _rows(context)
    say_once(matrices, "A", rows)
    say_once(matrices, "H", rows[:-1])
    if robot.moves_each_joint_alone:
        say_once(_columns(context), "J", coordinates)
    if bodies and robot.has_table:
        say_once(_mass_centers(context), "rc", bodies)
        if solid:
            say_once(_tensors(context, solid), "I_body R I", [body.name for body in solid])
        say_once(kinetic_step(context), "Jv v Kv Kw K", bodies)
    if bodies:
        say_once(_potential(context), "P", bodies)
    if robot.has_dynamics and robot.questions.method is Method.LAGRANGE:
        say_once(_forces(context), "dLdqd ddt dLdq tau", coordinates)
    return found


# -- kinematics and the Jacobian -------------------------------------------------------------------


def _rows(context: Context) -> Step:
    joints = context.robot.joints
    return brief_step(
        id="rows",
        stage=Stage.KINEMATICS,
        title="The rows of the table",
        why=("The matrix with the entries of each row.",),
        result=tuple(equation(letters.A(joint.index), context.form(f"A{joint.index}")) for joint in joints),
        together=True,
    )


def _columns(context: Context) -> Step:
    """J_i = [z × (o_n - o); z] of a revolute joint, [z; 0] of a prismatic one."""
    joints = context.robot.joints
    kinds = {joint.type for joint in joints}
    axis = letters.BEFORE if context.standard else letters.COUNT
    columns = []
    if JointType.REVOLUTE in kinds:
        turning = "𝐉_i = [𝐳_{axis} × (𝐨_{last} - 𝐨_{axis}); 𝐳_{axis}]"
        columns.append(formula(turning, axis=axis, last=len(joints)))
    if JointType.PRISMATIC in kinds:
        columns.append(formula("𝐉_i = [𝐳_{axis}; {zero}]", axis=axis, zero=ZERO))
    words = " The first is that of a revolute joint, the second that of a prismatic one."
    return brief_step(
        id="columns",
        stage=Stage.JACOBIAN,
        title="The columns of the Jacobian",
        why=say(
            "The velocity and the angular velocity of {end} at unit rate of joint i.{both}",
            end=context.end,
            both=words if len(columns) > 1 else "",
        ),
        formula=side_by_side(columns),
        source=spong("4.6.3"),
        uses=("axes",),
    )


# -- the bodies ------------------------------------------------------------------------------------


def _mass_centers(context: Context) -> Step:
    given = (
        equation(letters.bold("r", letters.rc(body).sub, Number(body.link)), context.show(body.center))
        for body in context.robot.bodies
    )
    return brief_step(
        id="rc",
        stage=Stage.INERTIA,
        title="Mass centres",
        why=("Each is given in the frame of its link and transformed to the base.",),
        formula=formula("𝐫_ci = 𝐑_i^{ground} 𝐫_ci^i + 𝐨_i", ground=_ground(context)),
        source=spong("2.6"),
        result=tuple(given),
        together=True,
    )


def _ground(context: Context) -> Node:
    """0, or w of a base that is turned in the world."""
    ground = letters.R(context.robot, 1).sup
    assert ground is not None
    return ground


def _tensors(context: Context, bodies: Sequence[Body]) -> Step:
    """I_i, along the axes of the link; they turn with it.  What the sign of products of inertia is."""
    tensors = [
        (letters.tensor(context.robot, body), body.inertia) for body in bodies if body.inertia is not None
    ]
    minus = (
        " An entry off the diagonal is minus the integral of the product of two coordinates over the mass."
    )
    has_products = any(not tensor[i, j].is_zero for _, tensor in tensors for i in range(3) for j in range(i))
    return brief_step(
        id="tensors",
        stage=Stage.INERTIA,
        title="Inertia tensors",
        why=say(
            "Each is given about the mass centre, along the axes of its link's frame; in {ground} "
            "coordinates it turns with the link.{minus}",
            ground=context.ground,
            minus=minus if has_products else "",
        ),
        formula=formula("𝐑_i = 𝐑_i^{ground}, 𝓘_i = 𝐑_i 𝐈_i 𝐑_iᵀ", ground=_ground(context)),
        source=spong("7.2.1"),
        result=tuple(equation(name, context.show(tensor)) for name, tensor in tensors),
        together=True,
    )


# -- the energies and the forces -------------------------------------------------------------------


def _potential(context: Context) -> Step:
    rows = tuple(_heights(context))
    return brief_step(
        id="potentials",
        stage=Stage.ENERGY,
        title="Potential energy of each body",
        why=say(
            "It is minus the mass times $𝐠_0ᵀ 𝐫_ci$; $𝐠_0$ points down ({book} writes a plus, for which the "
            "vector must point up).",
            book=spong("7.2.3"),
        ),
        formula=formula("P_i = -m_i 𝐠_0ᵀ 𝐫_ci"),
        source=spong("7.2.3"),
        further=(gravity_given(context),),
        lines=rows,
        concluding=("So, each weight times the height of its mass centre:",) if rows else (),
        result=tuple(
            equation(letters.of_body("P", body), context.form(f"P{body.name}"))
            for body in context.robot.bodies
        ),
        listed=True,
    )


def _forces(context: Context) -> Step:
    """τ_k from ∂L/∂q̇_k, d/dt of it and ∂L/∂q_k, the products of rates collected; and friction."""
    n, friction = context.robot.n, " + τ_fk" if context.robot.actions.resisting else ""
    accelerated = "Σ_(j=1)^{n} d_kj q̈_j"
    squares = "Σ_(i=1)^{n} Σ_(j=1)^{n} {factor} q̇_i q̇_j"
    slopes = formula(squares, n=n, factor=formula("∂d_ij/∂q_k"))
    return brief_step(
        id="forces",
        stage=Stage.TORQUE,
        title="The generalized forces",
        why=say("The same for every coordinate $q_k$."),
        source=spong("7.3"),
        formula=formula(f"τ_k = d/dt ∂ℒ/∂q̇_k - ∂ℒ/∂q_k{friction}"),
        working=(
            formula("∂ℒ/∂q̇_k = Σ_(j=1)^{n} d_kj q̇_j", n=n),
            formula(f"d/dt ∂ℒ/∂q̇_k = {accelerated} + Σ_(j=1)^{{n}} ḋ_kj q̇_j", n=n),
            formula("∂ℒ/∂q_k = ½ {slopes} - ∂𝒫/∂q_k", slopes=slopes),
        ),
        lines=(
            Line(
                say(
                    "The chain rule gives the rates of $d_kj$. Each product of two rates then occurs twice "
                    "in the sum, with $i$ and $j$ exchanged, so each derivative may be replaced by half the "
                    "sum of the two:"
                ),
                (
                    formula(
                        f"Σ_(j=1)^{{n}} ḋ_kj q̇_j = {squares} = ½ {squares.replace('factor', 'both')}",
                        n=n,
                        factor=formula("∂d_kj/∂q_i"),
                        both=formula("(∂d_kj/∂q_i + ∂d_ki/∂q_j)"),
                    ),
                ),
            ),
            Line(
                say("In the Christoffel symbols and the entries of $𝐠$"),
                (formula("c_ijk = ½ {slopes}, g_k = ∂𝒫/∂q_k", slopes=SLOPES),),
            ),
        ),
        concluding=("the forces are",),
        result=(formula(f"τ_k = {accelerated} + {squares}{friction} + g_k", n=n, factor=formula("c_ijk")),),
        uses=("L",),
    )


# -- the rows of rotations that give the heights of the mass centres of far links, where each fits a line

WIDEST = 80
"""The characters of a row up to which the rows are shown; wider ones would be a page of entries."""


def _heights(context: Context) -> Iterator[Line]:
    """z₀ᵀ R of the links between the two frames that are shown, where gravity is along z₀."""
    robot = context.robot
    g = robot.gravity.entries
    along_z = g[0].is_zero and g[1].is_zero and not g[2].is_zero
    if robot.is_tree or not robot.has_table or letters.has_base(robot) or not along_z:
        return
    inner, outer = halves(robot)
    shown = (1, inner[-1].index, outer[-1].index)  # the first row is its own frame
    rows: dict[int, tree.Matrix] = {}
    for body in robot.bodies:
        row = rotation(context.values[f"H{body.link}"]).rows[2]
        turns = any(not robot.ring.diff(entry, k).is_zero for entry in row for k in range(robot.n))
        if body.link not in shown and turns and not body.center.is_zero:
            form = context.show(Matrix.of(robot.ring, [row]))
            assert isinstance(form, tree.Matrix)
            rows[body.link] = form
    if rows and all(matrix_width(context, row) <= WIDEST for row in rows.values()):
        named = (
            equation(Product((Transpose(letters.z(0)), letters.R(robot, link))), row)
            for link, row in rows.items()
        )
        yield Line(
            ("The third rows of the rotations that give heights, where they were not shown:",), tuple(named)
        )
