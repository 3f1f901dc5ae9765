"""Steps of joint rates for those of the task, of what joints and task can do, of forces held at rest."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import replace

from dynsolve.algebra.linear_systems import is_solvable, rank_parts
from dynsolve.algebra.matrix import AtState, Matrix, determinant, work
from dynsolve.derivation import statics
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.kinematics import frame_names
from dynsolve.derivation.rates import MOST_PRODUCTS, squared, wanted_by_accelerations
from dynsolve.derivation.statics import jacobians
from dynsolve.document import Prose
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.step import NOTED, TOLD, Detail, Group, Part, Step
from dynsolve.explain.writing import column_of, is_small, side_by_side, spong, sum_of
from dynsolve.notation.template import formula
from dynsolve.notation.tree import Node, Number, Parenthesized, Sum, Symbol, Words, equation
from dynsolve.quantities import letters
from dynsolve.robot.questions import TIP, Load

_J = letters.J_TASK


def steps(context: Context) -> Iterator[Step]:
    """q̇, q̈ and what the joints and the task can do, where they are asked for."""
    wanted, asked = context.wanted, context.robot.questions
    if "qd" in wanted:
        assert asked.velocity is not None
        why = say("$𝐫̇ = 𝐉_r 𝐪̇$")
        yield _solution(context, "qd", "The rates of the joints", asked.velocity, formula("𝐫̇"), why)
    if "qdd" in wanted:
        assert asked.acceleration is not None
        right = wanted_by_accelerations(context.robot, asked.acceleration, context.values["Jr_dot"])
        why = say(
            "$𝐫̈ = 𝐉_r 𝐪̈ + 𝐉̇_r 𝐪̇$: what $𝐉̇$ brings without the joints' accelerations is taken off first. "
            "The rest "
        )
        title = "The accelerations of the joints"
        yield _solution(context, "qdd", title, right, formula("𝐫̈ - 𝐉̇_r 𝐪̇"), why)
    known = not asked.state or bool({"qd", "qdd"} & wanted)
    for name in (name for name in _SPACES if name in wanted):
        yield replace(_space(context, name), normal=TOLD & ~Part.WORKING if known else TOLD)
        known = True


def state_prose(context: Context) -> Prose:
    """The state that something is asked for at, as words: At q₁ = 90°, q̇₁ = 1."""
    values = context.robot.questions.state.values
    if not values:
        return ()
    given = side_by_side([equation(Symbol(name, dots), value) for name, dots, value in values])
    return say("At {given}.", given=given)


def _solution(context: Context, name: str, title: str, asked: Matrix, b: Node, why: Prose) -> Step:
    """The x of J x = b with x = q̇ or q̈: where there are many, the least; where there is none, the nearest."""
    at = AtState(context.robot.ring, context.robot.questions.state.by_symbol)
    J, right = at.matrix(context.values["Jr"]), at.matrix(asked)
    rank, (rows, columns) = rank_parts(J).rank, J.shape
    x = letters.QD if name == "qd" else letters.QDD
    weights = context.robot.questions.weights
    if context.robot.questions.weighs_by_inertia:
        weights = at.matrix(context.values["D"])
    notes: tuple[Prose, ...] = ()
    if rank == rows == columns:
        how = say(" has one solution. ")
    elif is_solvable(J, right):
        how = say(
            " has many solutions{rank}: this is the one {least}. ",
            rank="" if rank == rows else f", the rank being {rank}",
            least="of least norm" if weights is None else say("with the least ${x}ᵀ 𝐖 {x}$", x=x),
        )
    else:
        how = say(" has no solution: these come nearest to one, in the sense of least squares. ")
    if rank < columns and is_solvable(J, right):
        text = "Every motion of the joints that the task does not see may be added: ${x}$ with $𝐉_r {x} = 𝟎$."
        notes = (say(text, x=x),)
    if rank == rows == columns:
        inverse = "𝐉_r⁻¹ {b}"
    elif rank == rows:
        inverse = "𝐉_rᵀ (𝐉_r 𝐉_rᵀ)⁻¹ {b}" if weights is None else "𝐖⁻¹ 𝐉_rᵀ (𝐉_r 𝐖⁻¹ 𝐉_rᵀ)⁻¹ {b}"
    else:
        inverse = "(𝐉_rᵀ 𝐉_r)⁻¹ 𝐉_rᵀ {b}" if rank == columns else "𝐉_r^{plus} {b}"
    working = [equation(_J, context.show(J))] if context.robot.questions.state else []
    working.insert(len(working) if name == "qd" else 0, equation(b, context.show(right)))
    if rank < columns and weights is not None:
        working.append(equation(letters.WEIGHTS, context.show(weights)))
    elif rank in (rows, columns) and rank and work(squared(J)) <= MOST_PRODUCTS:
        det = formula("det {of}", of=square_of(_J, J))
        working.append(equation(det, context.show(determinant(squared(J)))))
    inverse_times = formula(inverse, b=Parenthesized(b) if isinstance(b, Sum) else b, plus="+")
    return Step(
        id=name,
        title=title,
        why=(*why, *how, *state_prose(context)),
        formula=equation(x, inverse_times),
        source=spong("4.11"),
        working=tuple(working),
        result=(equation(x, context.form(name)),),
        notes=notes,
        detail=Detail.BRIEF,
    )


def square_of(letter: Node, matrix: Matrix) -> Node:
    """J, or the smaller of (J Jᵀ) and (Jᵀ J) where J is not square: what has a determinant."""
    rows, columns = matrix.shape
    if rows == columns:
        return letter
    return formula("({J} {J}ᵀ)" if rows < columns else "({J}ᵀ {J})", J=letter)


# -- what the joints and the task can do -----------------------------------------------------------

_SPACES = {
    "nullspace": (
        "Motions of the joints that the task does not see",
        "The motions of the joints in which nothing of the task changes.",
        letters.NULLSPACE,
        formula("𝐉_r 𝐪̇ = 𝟎"),
    ),
    "rangespace": (
        "Velocities of the task that are possible",
        "All the velocities that the joints can give: what the columns of the Jacobian span.",
        letters.RANGESPACE,
        formula("𝐫̇ = 𝐉_r 𝐪̇"),
    ),
    "lost": (
        "Motions of the task that are lost",
        "What is orthogonal to all possible velocities. A force along it needs no torque of the joints.",
        letters.LOST,
        formula("𝐉_rᵀ 𝐅 = 𝟎"),
    ),
}
"""What a space is called, what it is, its letter, and the condition of what is in it."""


def _space(context: Context, name: str) -> Step:
    title, what, letter, condition = _SPACES[name]
    too_long = " In symbols its vectors are too long to be read: give the coordinates values under `state`."
    found = Step(
        id=name,
        title=title,
        why=(what, too_long),
        formula=condition,
        source=spong("4.9"),
        detail=Detail.BRIEF,
    )
    if isinstance(context.values[name], Skipped):
        return found
    form, state = context.matrix(name), context.robot.questions.state
    J = AtState(context.robot.ring, state.by_symbol).matrix(context.values["Jr"])
    vectors = [column_of(form, k) for k in range(len(form.rows[0]))]
    spanned = formula("span ({vectors})", vectors=side_by_side(vectors)) if vectors else Words("{0}")
    rank, count = rank_parts(J).rank, len(vectors)
    if name == "lost" and not vectors:
        what = "Nothing but 𝟎 is orthogonal to all possible velocities: no motion is lost."
    return replace(
        found,
        why=(f"{what} ", *state_prose(context)) if state else (what,),
        source=spong("4.10" if name == "lost" else "4.9"),
        working=(equation(_J, context.show(J)),),
        result=(equation(letter, spanned),),
        notes=((f"The rank is {rank}, and the dimension of this space {count}.",),),
    )


# -- forces from outside, held at rest --------------------------------------------------------------

HELD = Group("Q", "The sum, and the torques that hold it")
_FORCES = spong("4.10")


def statics_steps(context: Context) -> Iterator[Step]:
    """Force by force what it does to the joints, the sum, and what holds it at rest."""
    wanted = context.wanted
    for index, load in enumerate(context.robot.questions.loads, 1):
        if f"load{index}" in wanted:
            yield _load(context, index, load)
    if "Q" in wanted:
        yield replace(_total(context), group=HELD)
    if "tau_static" in wanted:
        yield replace(_holding(context), group=HELD)


def _load(context: Context, index: int, load: Load) -> Step:
    """Q_F = J_vᵀ F + J_ωᵀ M, of which one may be absent, from the power Fᵀ v + Mᵀ ω."""
    frames = tuple(context.values[name] for name in frame_names(load.link))
    wrench, of_point = statics.wrench(load, frames[load.link]), jacobians(context.robot, load, frames)
    parts = []
    for letter, velocity, value, jacobian in zip("FM", ("v", "omega"), wrench, of_point, strict=True):
        J = letters.JV if velocity == "v" else letters.JW
        if load.point and load.point != TIP:
            J = letters.j_of_point(velocity, load.point)
        parts.append((letters.bold(letter, Number(index)), letters.bold(velocity), J, value, jacobian))
    if load.moment.is_zero:
        del parts[1]
    elif load.force.is_zero:
        del parts[0]
    Q, working, put_in = letters.of_load(index), list[Node](), list[Node]()
    for F, _, J, value, jacobian in parts:
        if not value.is_zero:
            put_in += [context.show(jacobian), context.show(value)]
            working += [equation(F, put_in[-1]), *([] if load.point else [equation(J, put_in[-2])])]
    if put_in and is_small(*put_in):
        pairs = zip(put_in[::2], put_in[1::2], strict=True)
        working.append(equation(Q, sum_of([formula("{J}ᵀ {F}", J=J, F=F) for J, F in pairs])))
    notes: tuple[Prose, ...] = ()
    if load.by_robot:
        notes = (("The robot exerts it, so what acts on the robot is its opposite.",),)
    if load.axes is not None:
        notes += (("It is given along axes of its link, and turned into the world.",),)
    return Step(
        id=f"load{index}",
        title=f"What force {index} does to the joints",
        why=say(
            "In every motion its power is {power}, and that of its generalized forces ${Q}ᵀ 𝐪̇$: so the "
            "transpose of the Jacobian of {where} gives its effect on the joints.",
            power=sum_of([formula("{F}ᵀ {v}", F=F, v=v) for F, v, *_ in parts]),
            Q=Q,
            where="the tip" if load.point == TIP else load.point or "its point",
        ),
        formula=equation(Q, sum_of([formula("{J}ᵀ {F}", J=J, F=F) for F, _, J, *_ in parts])),
        source=_FORCES,
        working=tuple(working),
        result=(equation(Q, context.form(f"load{index}")),),
        notes=notes,
        normal=NOTED,
    )


def _total(context: Context) -> Step:
    numbers = range(1, len(context.robot.questions.loads) + 1)
    general = statics.total(context.robot, tuple(context.values[f"load{i}"] for i in numbers))
    at, several = state_prose(context), len(numbers) > 1
    return Step(
        id="Q",
        title="The generalized forces from outside",
        why=("The sum over the forces. " if several else "There is only one force. ", *at),
        formula=equation(letters.Q_FORCES, sum_of([*map(letters.of_load, numbers)])),
        source=_FORCES,
        working=(equation(letters.Q_FORCES, context.show(general)),) if at and several else (),
        result=(equation(letters.Q_FORCES, context.form("Q")),),
        detail=Detail.BRIEF,
    )


def _holding(context: Context) -> Step:
    heavy = bool(context.robot.bodies) and not context.robot.gravity.is_zero
    g = context.form("g") if heavy else None
    return Step(
        id="tau_static",
        title="The torques that hold it at rest",
        why=say(
            "At rest{free} only {left} left in the equations of motion. {at}",
            free="" if heavy else ", and without gravity,",
            left="gravity and these forces are" if heavy else "these forces are",
            at=state_prose(context),
        ),
        formula=formula("𝛕_static = 𝐠 - 𝐐" if heavy else "𝛕_static = -𝐐"),
        source=_FORCES,
        working=(equation(letters.G, g),) if g is not None and is_small(g) else (),
        result=(equation(letters.TAU_STATIC, context.form("tau_static")),),
        detail=Detail.BRIEF,
    )
