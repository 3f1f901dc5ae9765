"""Steps of the determinant of a Jacobian, and of joint rates and accelerations for those of the task."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from dynsolve.algebra.at_state import AtState
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.minors import determinant, work
from dynsolve.algebra.pseudoinverse import is_solvable, rank_parts
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.rates import MOST_PRODUCTS, squared, wanted_by_accelerations, whole_or_task
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.statics import state_prose
from dynsolve.explain.step import TOLD, Detail, Part, Step
from dynsolve.explain.writing import is_small, side_by_side, spong
from dynsolve.notation.tree import (
    Letter,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Row,
    Sum,
    Transpose,
    Words,
    equation,
)
from dynsolve.notation.tree import Matrix as Tree
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage

_R_DOT, _R_DDOT = letters.rate(letters.TASK), letters.bold("r", dots=2)
_J, _JT, _W = letters.J_TASK, Transpose(letters.J_TASK), letters.WEIGHTS


def steps(context: Context) -> Iterator[Step]:
    """q̇, q̈ and what the joints and the task can do, where they are asked for."""
    wanted = context.wanted
    if "qd" in wanted:
        yield _rates(context)
    if "qdd" in wanted:
        yield _accelerations(context)
    known = not context.robot.questions.state or bool({"qd", "qdd"} & wanted)
    for name in (name for name in _SPACES if name in wanted):
        yield replace(_space(context, name), normal=TOLD & ~Part.WORKING if known else TOLD)
        known = True


# -- the determinant -------------------------------------------------------------------------------


def determinant_step(context: Context) -> Step:
    """det J_r, or that of J_r J_rᵀ or J_rᵀ J_r where J_r is not square."""
    name = whole_or_task(context.robot)
    J: Letter = letters.J if name == "J" else letters.J_TASK
    matrix: Matrix = context.values[name]
    rows, columns = matrix.shape
    square = squared(matrix)
    if rows == columns:
        of: Node = J
        why: Prose = ("Where it is 0 the Jacobian has no inverse: some motion of the task is lost there.",)
    else:
        of = Parenthesized(Product((J, Transpose(J)) if rows < columns else (Transpose(J), J)))
        what = "rows" if rows < columns else "columns"
        why = (
            J, f" is {rows}×{columns} and has no determinant. The determinant of its product with its "
            f"transpose is the sum of the squares of its minors: it is 0 where the {what} are dependent.",
        )  # fmt: skip
    shown = context.show(square)
    letter = Row((Words("det "), of))
    return Step(
        id="det",
        stage=Stage.TASK,
        title="The determinant of the Jacobian",
        why=why,
        formula=equation(letter, Row((Words("det "), shown))) if is_small(shown) else None,
        source=spong("4.9"),
        result=(equation(letter, context.form("det")),),
        detail=Detail.BRIEF,
        task=letter,
    )


# -- rates and accelerations -----------------------------------------------------------------------


def _rates(context: Context) -> Step:
    robot = context.robot
    at = AtState(robot.ring, robot.questions.state.by_symbol)
    velocity = robot.questions.velocity
    assert velocity is not None
    J, right = at.matrix(context.values["Jr"]), at.matrix(velocity)
    return Step(
        id="qd",
        stage=Stage.RATES,
        title="The rates of the joints",
        why=(
            equation(_R_DOT, Product((_J, letters.QD))),
            *_solved_by(context, J, right, letters.QD),
            *state_prose(context),
        ),
        formula=equation(letters.QD, _inverse_times(context, J, right, _R_DOT)),
        source=spong("4.11"),
        working=tuple(_working(context, J, right, _R_DOT)),
        result=(equation(letters.QD, context.form("qd")),),
        notes=tuple(_notes(J, right, letters.QD)),
        detail=Detail.BRIEF,
    )


def _accelerations(context: Context) -> Step:
    robot = context.robot
    at = AtState(robot.ring, robot.questions.state.by_symbol)
    acceleration = robot.questions.acceleration
    assert acceleration is not None
    J = at.matrix(context.values["Jr"])
    right = at.matrix(wanted_by_accelerations(robot, acceleration, context.values["Jr_dot"]))
    turned = Product((letters.rate(_J), letters.QD))
    wanted = Sum((_R_DDOT, Negative(turned)))
    why = (
        equation(_R_DDOT, Sum((Product((_J, letters.QDD)), turned))),
        ": what ",
        letters.bold("J", dots=1),
        " brings without the joints' accelerations is taken off first. The rest ",
        *_solved_by(context, J, right, letters.QDD), *state_prose(context),
    )  # fmt: skip
    return Step(
        id="qdd",
        stage=Stage.RATES,
        title="The accelerations of the joints",
        why=why,
        formula=equation(letters.QDD, _inverse_times(context, J, right, Parenthesized(wanted))),
        source=spong("4.11"),
        working=(equation(wanted, context.show(right)), *_working(context, J, right, None)),
        result=(equation(letters.QDD, context.form("qdd")),),
        notes=tuple(_notes(J, right, letters.QDD)),
        detail=Detail.BRIEF,
    )


def _weights(context: Context) -> Matrix | None:
    """W at the state, None where all weights are 1."""
    asked = context.robot.questions
    if not asked.weighs_by_inertia:
        return asked.weights
    return AtState(context.robot.ring, asked.state.by_symbol).matrix(context.values["D"])


def _solved_by(context: Context, J: Matrix, right: Matrix, solved: Node) -> Prose:
    """How the system is solved, in words that end a sentence."""
    rank, (rows, columns) = rank_parts(J).rank, J.shape
    if rank == rows == columns:
        return (" has one solution. ",)
    if not is_solvable(J, right):
        return (" has no solution: these come nearest to one, in the sense of least squares. ",)
    which = "" if rank == rows else f", the rank being {rank}"
    least: Prose = ("of least norm",)
    if _weights(context) is not None:
        least = ("with the least ", Product((Transpose(solved), _W, solved)))
    return (f" has many solutions{which}: this is the one ", *least, ". ")


def _inverse_times(context: Context, J: Matrix, right: Matrix, vector: Node) -> Node:
    """J⁻¹ b, Jᵀ (J Jᵀ)⁻¹ b, W⁻¹ Jᵀ (J W⁻¹ Jᵀ)⁻¹ b, (Jᵀ J)⁻¹ Jᵀ b or J⁺ b."""
    rank, (rows, columns) = rank_parts(J).rank, J.shape
    minus = Negative(Number(1))
    if rank == rows == columns:
        return Product((Power(_J, minus), vector))
    if rank == rows and _weights(context) is not None:
        lifted = (Power(_W, minus), _JT)
        return Product((*lifted, Power(Parenthesized(Product((_J, *lifted))), minus), vector))
    if rank == rows:
        return Product((_JT, Power(Parenthesized(Product((_J, _JT))), minus), vector))
    if rank == columns:
        return Product((Power(Parenthesized(Product((_JT, _J))), minus), _JT, vector))
    return Product((Letter("J", _J.sub, Words("+"), "bold"), vector))


def _working(context: Context, J: Matrix, right: Matrix, vector: Node | None) -> Iterator[Node]:
    """The Jacobian and what is asked of it at the state, and the determinant that is divided by."""
    if context.robot.questions.state:
        yield equation(_J, context.show(J))
    if vector is not None:
        yield equation(vector, context.show(right))
    rank, (rows, columns) = rank_parts(J).rank, J.shape
    W = _weights(context) if rank < columns else None
    if W is not None:
        yield equation(_W, context.show(W))
        return
    if rank in (rows, columns) and rank:
        square = squared(J)
        if work(square) > MOST_PRODUCTS:
            return
        of = _J if rows == columns else Parenthesized(Product((_J, _JT) if rows < columns else (_JT, _J)))
        yield equation(Row((Words("det "), of)), context.show(determinant(square)))


def _notes(J: Matrix, right: Matrix, solved: Node) -> Iterator[Prose]:
    rank = rank_parts(J).rank
    if rank < J.shape[1] and is_solvable(J, right):
        yield (
            "Every motion of the joints that the task does not see may be added: ",
            solved, " with ", equation(Product((_J, solved)), letters.bold("0")), ".",
        )  # fmt: skip


# -- what the joints and the task can do -----------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Space:
    """What a space is called, what it is, and its letter."""

    title: str
    why: str
    letter: Node
    condition: Node


_F = letters.bold("F")
_SPACES = {
    "nullspace": _Space(
        "Motions of the joints that the task does not see",
        "The motions of the joints in which nothing of the task changes.",
        letters.NULLSPACE,
        equation(Product((_J, letters.QD)), letters.bold("0")),
    ),
    "rangespace": _Space(
        "Velocities of the task that are possible",
        "All the velocities that the joints can give: what the columns of the Jacobian span.",
        letters.RANGESPACE,
        equation(_R_DOT, Product((_J, letters.QD))),
    ),
    "lost": _Space(
        "Motions of the task that are lost",
        "What is orthogonal to all possible velocities. A force along it needs no torque of the joints.",
        letters.LOST,
        equation(Product((_JT, _F)), letters.bold("0")),
    ),
}


def _space(context: Context, name: str) -> Step:
    if isinstance(context.values[name], Skipped):
        return _space_left_out(name)
    space, form = _SPACES[name], context.matrix(name)
    at = AtState(context.robot.ring, context.robot.questions.state.by_symbol)
    J = at.matrix(context.values["Jr"])
    vectors = [Tree(tuple((row[k],) for row in form.rows)) for k in range(len(form.rows[0]))]
    spanned = Row((Words("span "), Parenthesized(side_by_side(vectors)))) if vectors else Words("{0}")
    rank, count = rank_parts(J).rank, len(vectors)
    dimension = f"The rank is {rank}, and the dimension of this space {count}."
    return Step(
        id=name,
        stage=Stage.RATES,
        title=space.title,
        why=(space.why, *((" ", *at_state) if (at_state := state_prose(context)) else ())),
        formula=space.condition,
        source=spong("4.9") if name != "lost" else spong("4.10"),
        working=(equation(_J, context.show(J)),),
        result=(equation(space.letter, spanned),),
        notes=((dimension,),),
        detail=Detail.BRIEF,
    )


def _space_left_out(name: str) -> Step:
    """A space whose vectors are too long to be written."""
    space = _SPACES[name]
    return Step(
        id=name,
        stage=Stage.RATES,
        title=space.title,
        why=(space.why, " In symbols its vectors are too long to be read: give the coordinates values under ",
             "`state`."),
        formula=space.condition,
        source=spong("4.9"),
        detail=Detail.BRIEF,
    )  # fmt: skip
