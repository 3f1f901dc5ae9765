"""Steps of joint rates for those of the task, of what joints and task can do, of forces held at rest."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import replace

from dynsolve.algebra.factors import is_never_zero
from dynsolve.algebra.linear_systems import dependent_where, is_solvable, rank_parts
from dynsolve.algebra.matrix import AtState, Matrix, determinant, minors, work
from dynsolve.derivation.graph import Skipped
from dynsolve.document import Prose
from dynsolve.document.sentences import Value, say
from dynsolve.explain.context import Context
from dynsolve.explain.forms import Forms
from dynsolve.explain.given import of_task
from dynsolve.explain.step import TOLD, Detail, Part, Step
from dynsolve.explain.writing import column_of, is_small, listed, side_by_side, spong
from dynsolve.notation.template import formula
from dynsolve.notation.tree import ONE, ZERO, Node, Parenthesized, Power, Sum, Symbol, Words, equation
from dynsolve.quantities import letters
from dynsolve.quantities.index import quantities
from dynsolve.questions.rates.derive import MOST_PRODUCTS, lost_motions, squared, wanted_by_accelerations
from dynsolve.questions.set_forms import SetForms
from dynsolve.robot.model import Robot

_J = letters.J_TASK

_MIXED: Prose = (
    "The norm adds squares of lengths to squares of angles, so that it depends on the unit of length. ",
)


def given(forms: Forms) -> Iterator[Prose]:
    """What the task is to do, and the weights."""
    questions = forms.robot.questions
    for dots, value in ((1, questions.velocity), (2, questions.acceleration)):
        if value is not None:
            wanted = equation(
                letters.bold("r", dots=dots), of_task(forms, map(forms.of, value.entries), dots)
            )
            yield (f"The task is to have the {'velocity' if dots == 1 else 'acceleration'} ", wanted, ".")
    if questions.weights is not None:
        yield ("The weights are ", equation(letters.WEIGHTS, forms.of(questions.weights)), ".")
    elif questions.weighs_by_inertia:
        yield ("The weights are the inertia matrix ", letters.D, ".")


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
            "The rest"
        )
        title = "The accelerations of the joints"
        yield _solution(context, "qdd", title, right, formula("𝐫̈ - 𝐉̇_r 𝐪̇"), why)
    known = not asked.state or bool({"qd", "qdd"} & wanted)
    for name in (name for name in _SPACES if name in wanted):
        yield replace(_space(context, name), normal=TOLD & ~Part.WORKING if known else TOLD)
        known = True


def state_prose(context: Context, with_rates: bool = True) -> Prose:
    """The state that something is asked for at, as words: The state is q₁ = 90°, q̇₁ = 1."""
    values = [one for one in context.robot.questions.state.values if with_rates or not one[1]]
    if not values:
        return ()
    given = side_by_side([equation(Symbol(name, dots), value) for name, dots, value in values])
    return say("The state is {given}.", given=given)


def _state_once(context: Context, name: str) -> Prose:
    """The state, told with the first of the results that are asked for there; its rates with q̈."""
    first = next(one for one in ("qd", "qdd", *_SPACES) if one in context.wanted)
    if name == first:
        return state_prose(context, with_rates=name == "qdd")
    rates = [one for one in context.robot.questions.state.values if one[1]] if name == "qdd" else []
    given = side_by_side([equation(Symbol(name, dots), value) for name, dots, value in rates])
    return say("In the state {given}.", given=given) if rates else ()


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
    in_product = Parenthesized(b) if isinstance(b, Sum) else b
    least = "of least norm" if weights is None else say("with the least ${x}ᵀ 𝐖 {x}$", x=x)
    deficient = f", the rank being {rank}" if rank < min(rows, columns) else ""
    if rank == columns and is_solvable(J, right):
        how = say(" has one solution. ")
    elif is_solvable(J, right):
        how = say(" has many solutions{rank}: this is the one {least}. ", rank=deficient, least=least)
    elif rank == columns:
        text = " has {none}: these come nearest to one, in the sense of least squares. "
        how = say(text, none=_none(context, J, right))
    else:
        how = say(
            " has {none}{rank}; many come nearest to one, in the sense of least squares, those with "
            "{normal}: this is the one {least}. ",
            none=_none(context, J, right),
            rank=deficient,
            normal=formula("𝐉_rᵀ 𝐉_r {x} = 𝐉_rᵀ {b}", x=x, b=in_product),
            least=least,
        )
    if rank < columns and is_solvable(J, right):
        text = "Every motion of the joints that the task does not see may be added: ${x}$ with $𝐉_r {x} = 𝟎$."
        notes = (say(text, x=x),)
    pseudo = formula("𝐉_r^{plus}", plus="+")
    if weights is not None:
        pseudo = Power(Parenthesized(formula("𝐉_r 𝐖⁻¹ 𝐉_rᵀ")), Words("+"))
    if rank == rows == columns:
        inverse = "𝐉_r⁻¹ {b}"
    elif rank == rows:
        inverse = "𝐉_rᵀ (𝐉_r 𝐉_rᵀ)⁻¹ {b}" if weights is None else "𝐖⁻¹ 𝐉_rᵀ (𝐉_r 𝐖⁻¹ 𝐉_rᵀ)⁻¹ {b}"
    elif rank == columns:
        inverse = "(𝐉_rᵀ 𝐉_r)⁻¹ 𝐉_rᵀ {b}"
    else:
        inverse = "{pseudo} {b}" if weights is None else "𝐖⁻¹ 𝐉_rᵀ {pseudo} {b}"
        how += say("The pseudoinverse {pseudo} gives it. ", pseudo=pseudo)
    working = [equation(_J, context.show(J))] if context.robot.questions.state else []
    working.insert(len(working) if name == "qd" else 0, equation(b, context.show(right)))
    if rank < columns and weights is not None:
        working.append(equation(letters.WEIGHTS, context.show(weights)))
    elif rank in (rows, columns) and rank and work(squared(J)) <= MOST_PRODUCTS:
        det = formula("det {of}", of=square_of(_J, J))
        working.append(equation(det, context.show(determinant(squared(J)))))
    inverse_times = formula(inverse, b=in_product, pseudo=pseudo)
    if rank < min(rows, columns):
        sides = context.show(J.T @ J), context.show(J.T @ right)
        if not is_solvable(J, right) and is_small(*sides):
            working.append(equation(formula("𝐉_rᵀ 𝐉_r"), sides[0]))
            working.append(equation(formula("𝐉_rᵀ {b}", b=in_product), sides[1]))
    if rank < columns and weights is None and len({q.type for q in context.robot.coordinates}) > 1:
        how += _MIXED
    how += _where_rank(J, rank)
    return Step(
        id=name,
        title=title,
        why=(*why, *how, *_state_once(context, name)),
        formula=equation(x, inverse_times),
        source=spong("4.11"),
        working=tuple(working),
        result=(equation(x, context.form(name)),),
        entries=tuple((Symbol(q.name, 1 if name == "qd" else 2),) for q in context.robot.coordinates),
        notes=notes,
        detail=Detail.BRIEF,
    )


def _none(context: Context, J: Matrix, right: Matrix) -> Prose:
    """That J x = b has no solution, or where alone it has one: where Fᵀ b = 0 for all F with Jᵀ F = 0."""
    lost, asked = lost_motions(J), context.robot.questions
    if isinstance(lost, Skipped):
        return ("no solution in general",)
    values = [entry for one in (asked.velocity, asked.acceleration) if one for entry in one.entries]
    given = {index for value in values for index in value.used}
    given -= {index for entry in J.entries for index in entry.used}
    forms = SetForms(context.robot, context.values)
    found = [forms.vanishing(one, given) for one in (lost.T @ right).entries if not one.is_zero]
    these = list(dict.fromkeys(found))
    if ONE in these:
        return ("no solution",)
    if not is_small(*these):
        return ("no solution in general",)
    return say("a solution only where {these}", these=listed([equation(one, ZERO) for one in these]))


def _where_rank(J: Matrix, rank: int) -> Prose:
    """Where all is so that its rank decides, unless that is seen to be the same in every configuration."""
    is_short = work(squared(J)) <= MOST_PRODUCTS
    is_full = rank == min(J.shape)
    if rank == 0 or (is_short and is_full and is_never_zero(determinant(squared(J)))):
        return ()
    if is_short and any(map(is_never_zero, minors(J, rank))):
        return ()
    return say("All this holds where the rank of $𝐉_r$ is {rank}. ", rank=rank)


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
        spong("4.11"),
    ),
    "rangespace": (
        "Velocities of the task that are possible",
        "All the velocities that the joints can give: what the columns of the Jacobian span.",
        letters.RANGESPACE,
        formula("𝐫̇ = 𝐉_r 𝐪̇"),
        spong("4.9"),
    ),
    "lost": (
        "Motions of the task that are lost",
        "What is orthogonal to all possible velocities. A force $𝐅$ along it needs no drive of the joints.",
        letters.LOST,
        formula("𝐉_rᵀ 𝐅 = 𝟎"),
        spong("4.10"),
    ),
}
"""What a space is called, what it is, its letter, the condition of what is in it, and where that stands."""


def _space(context: Context, name: str) -> Step:
    title, what, letter, condition, source = _SPACES[name]
    too_long = " In symbols its vectors are too long to be read: give the coordinates values under `state`."
    found = Step(
        id=name,
        title=title,
        why=(*say(what), too_long),
        formula=condition,
        source=source,
        detail=Detail.BRIEF,
    )
    if isinstance(context.values[name], Skipped):
        return found
    form, state = context.matrix(name), context.robot.questions.state
    J = AtState(context.robot.ring, state.by_symbol).matrix(context.values["Jr"])
    vectors = [column_of(form, k) for k in range(len(form.rows[0]))]
    spanned = formula("span ({vectors})", vectors=side_by_side(vectors)) if vectors else Words("{0}")
    rank, count = rank_parts(J).rank, len(vectors)
    dependent: Prose = ()
    if vectors and name != "rangespace":
        dependent = _dependent(context, J.T if name == "lost" else J, context.values[name])
    if name == "lost" and not vectors:
        what = "Nothing but $𝟎$ is orthogonal to all possible velocities: no motion is lost."
    return replace(
        found,
        why=(*say(what), " ", *_where_rank(J, rank), *_state_once(context, name)),
        working=(equation(_J, context.show(J)),),
        result=(equation(letter, spanned),),
        notes=((f"The rank is {rank}, and the dimension of this space {count}.", *dependent),),
    )


def _dependent(context: Context, matrix: Matrix, vectors: Matrix) -> Prose:
    """Where a factor makes the vectors of a null space dependent, or the only one 0."""
    value = dependent_where(matrix, vectors)
    if value is None:
        return ()
    where = SetForms(context.robot, context.values).vanishing(value)
    if where == ONE:
        return ()
    are = "these vectors are dependent" if vectors.shape[1] > 1 else "this vector is 0"
    return say(f" Where {{zero}}, {are}.", zero=equation(where, ZERO))


# -- forces from outside, held at rest --------------------------------------------------------------


# -- hints -----------------------------------------------------------------------------------------

AT_HAND = "You have the Jacobian of the task:"

PITFALLS = """
    Where the Jacobian is singular it has no inverse: look at its rank at this state first.
    accelerates? The acceleration of the task is not $𝐉_r 𝐪̈$ alone: what the joints' rates bring is
        taken off before anything is solved.
"""


def inputs(context: Context) -> list[tuple[Node, str]]:
    """The results that it starts from, by letter and name."""
    given = (one for one in quantities(context.robot).values() if one.name in ("Jr", "Jr_dot"))
    found = (one for one in given if one.name in context.wanted)
    return [(quantity.letter(context.robot), quantity.name) for quantity in found]


def facts(robot: Robot) -> dict[str, Value]:
    """What its pitfalls are about."""
    return {"accelerates": robot.questions.acceleration is not None}
