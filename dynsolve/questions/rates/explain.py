"""Steps of joint rates for those of the task, of what joints and task can do, of forces held at rest."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from msgspec.structs import replace

from dynsolve.algebra.linear_systems import is_solvable, rank_parts
from dynsolve.algebra.matrix import AtState, Matrix, determinant, work
from dynsolve.algebra.ring import Expr
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.reached import angle_rows
from dynsolve.document import Prose
from dynsolve.document.books import spong
from dynsolve.document.sentences import Value, opened, paragraph, say
from dynsolve.explain.context import Context
from dynsolve.explain.forms import Forms
from dynsolve.explain.given import of_task
from dynsolve.explain.step import TOLD, Detail, Part, Step
from dynsolve.explain.writing import and_joined, column_of, is_small, listed, side_by_side
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    ONE,
    ZERO,
    Node,
    Parenthesized,
    Power,
    Reference,
    Sum,
    Symbol,
    Words,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.index import quantities
from dynsolve.questions.rates.derive import MOST_PRODUCTS, lost_motions, squared, wanted_by_accelerations
from dynsolve.questions.rates.holding import of_rates, of_space
from dynsolve.questions.set_forms import SetForms
from dynsolve.robot.model import Robot

_J = letters.J_TASK

_MIXED: Prose = (
    "The norm adds squares of lengths to squares of angles, so that it depends on the unit of length. ",
)

_MIXED_ERRORS: Prose = (
    "The squares of errors in lengths and in angles are added, so that another unit of length may give "
    "another answer. ",
)


def given(forms: Forms) -> Iterator[Prose]:
    """What the task is to do, and the weights."""
    questions = forms.robot.questions
    asked = {
        called: equation(letters.bold("r", dots=dots), of_task(forms, map(forms.of, value.entries), dots))
        for dots, called, value in (
            (1, "velocity", questions.velocity),
            (2, "acceleration", questions.acceleration),
        )
        if value is not None
    }
    if asked:
        wanted = listed([(f"the {called} ", value) for called, value in asked.items()])
        yield ("The task is to have ", *wanted, ".")
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
        yield _System(context, "qd", asked.velocity, formula("𝐫̇")).step("The rates of the joints", why)
    if "qdd" in wanted:
        assert asked.acceleration is not None
        right = wanted_by_accelerations(context.robot, asked.acceleration, context.values["Jr_dot"])
        why = say(
            "$𝐫̈ = 𝐉_r 𝐪̈ + 𝐉̇_r 𝐪̇$: what $𝐉̇$ brings without the joints' accelerations is taken off first. "
            "The rest"
        )
        title = "The accelerations of the joints"
        yield _System(context, "qdd", right, formula("𝐫̈ - 𝐉̇_r 𝐪̇")).step(title, why)
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


class _System:
    """J x = b at the state, x = q̇ or q̈: where it has many solutions, the least; where none, the nearest."""

    def __init__(self, context: Context, name: str, asked: Matrix, b: Node) -> None:
        at = AtState(context.robot.ring, context.robot.questions.state.by_symbol)
        questions = context.robot.questions
        self.context, self.name, self.b = context, name, b
        self.x = letters.QD if name == "qd" else letters.QDD
        self.in_product = Parenthesized(b) if isinstance(b, Sum) else b
        self.J, self.right = at.matrix(context.values["Jr"]), at.matrix(asked)
        self.rank, (self.rows, self.columns) = rank_parts(self.J).rank, self.J.shape
        self.solvable = is_solvable(self.J, self.right)
        self.weights = at.matrix(context.values["D"]) if questions.weighs_by_inertia else questions.weights

    def step(self, title: str, why: Prose) -> Step:
        """The step that solves it."""
        context = self.context
        return Step(
            id=self.name,
            title=title,
            why=(*why, *self._how(), *_state_once(context, self.name)),
            holds=self._holds(),
            formula=equation(self.x, self._solution()),
            source=spong("4.11"),
            working=tuple(self._working()),
            result=(equation(self.x, context.form(self.name)),),
            entries=tuple(
                (Symbol(q.name, 1 if self.name == "qd" else 2),) for q in context.robot.coordinates
            ),
            notes=(say(_UNSEEN, x=self.x),) if self.solvable and self.rank < self.columns else (),
            detail=Detail.BRIEF,
        )

    def _holds(self) -> Prose:
        """Which of many solutions is meant, or that there is none; where it holds."""
        meant: Prose = ()
        if not self.solvable or self.rank < self.columns:
            meant = say("${b} = 𝐉_r {x}$ {meant}", b=self.b, x=self.x, meant=self._meant())
        where = of_rates(SetForms(self.context.robot, self.context.values)).prose
        return paragraph((meant, where))

    def _meant(self) -> Prose:
        """How many solutions it has, and which one is meant."""
        rank, columns = self.rank, self.columns
        least: Value = "of least norm"
        if self.weights is not None:
            least = say("with the least ${x}ᵀ 𝐖 {x}$", x=self.x)
        if self.solvable:
            text = "has one solution." if rank == columns else "has many solutions{rank}: {one}."
        else:
            text = "has {none}: these come nearest to one, in the sense of least squares."
            if rank < columns:
                text = _MANY_NEAREST
        return say(
            text,
            rank=f", the rank being {rank}" if rank < min(self.J.shape) else "",
            one=say("this is the one {least}", least=least),
            none=() if self.solvable else _none(self.context, self.J, self.right),
            normal=formula("𝐉_rᵀ 𝐉_r {x} = 𝐉_rᵀ {b}", x=self.x, b=self.in_product),
            x=self.x,
        )

    def _how(self) -> Prose:
        """Which solution is meant, what gives it, and where it holds."""
        rank, columns = self.rank, self.columns
        how = say(" {meant} ", meant=self._meant())
        if rank < columns and self.context.robot.questions.weighs_by_inertia:
            how += say("The weights are the inertia matrix, which is derived below. ")
        if rank < columns and rank < self.rows:
            how += say("The pseudoinverse {pseudo} gives it. ", pseudo=self._pseudoinverse)
        if (
            rank < columns
            and self.weights is None
            and len({q.type for q in self.context.robot.coordinates}) > 1
        ):
            how += _MIXED
        if not self.solvable and len(loads_along(self.context, "Jr", self.J.T.rows)) > 1:
            how += _MIXED_ERRORS
        where = of_rates(SetForms(self.context.robot, self.context.values)).prose
        return (*how, *where, " ") if where else how

    @property
    def _pseudoinverse(self) -> Node:
        if self.weights is None:
            return formula("𝐉_r^{plus}", plus="+")
        return Power(Parenthesized(formula("𝐉_r 𝐖⁻¹ 𝐉_rᵀ")), Words("+"))

    def _solution(self) -> Node:
        """x, by the inverse that J has."""
        if self.rank == self.rows == self.columns:
            inverse = "𝐉_r⁻¹ {b}"
        elif self.rank == self.rows:
            inverse = "𝐉_rᵀ (𝐉_r 𝐉_rᵀ)⁻¹ {b}" if self.weights is None else "𝐖⁻¹ 𝐉_rᵀ (𝐉_r 𝐖⁻¹ 𝐉_rᵀ)⁻¹ {b}"
        elif self.rank == self.columns:
            inverse = "(𝐉_rᵀ 𝐉_r)⁻¹ 𝐉_rᵀ {b}"
        else:
            inverse = "{pseudo} {b}" if self.weights is None else "𝐖⁻¹ 𝐉_rᵀ {pseudo} {b}"
        return formula(inverse, b=self.in_product, pseudo=self._pseudoinverse)

    def _working(self) -> Iterator[Node]:
        """J and b, the weights, and what is inverted or, where nothing is, solved."""
        show, J = self.context.show, self.J
        given = [equation(self.b, show(self.right))]
        if self.context.robot.questions.state:
            given.insert(0 if self.name == "qd" else 1, equation(_J, show(J)))
        yield from given
        if self.rank < self.columns and self.weights is not None:
            of = (letters.D,) * self.context.robot.questions.weighs_by_inertia
            yield equation(letters.WEIGHTS, *of, show(self.weights))
        elif self.rank in J.shape and self.rank and work(squared(J)) <= MOST_PRODUCTS:
            yield equation(letters.determinant(_J, *J.shape), show(determinant(squared(J))))
        if self.rank < min(J.shape) and not self.solvable:
            square, right = show(J.T @ J), show(J.T @ self.right)
            if is_small(square, right):
                yield equation(formula("𝐉_rᵀ 𝐉_r"), square)
                yield equation(formula("𝐉_rᵀ {b}", b=self.in_product), right)


_UNSEEN = "Every motion of the joints that the task does not see may be added: ${x}$ with $𝐉_r {x} = 𝟎$."
_MANY_NEAREST = (
    "has {none}{rank}. All ${x}$ with {normal} come nearest to one, in the sense of least squares; {one}."
)


def _none(context: Context, J: Matrix, right: Matrix) -> Prose:
    """That J x = b has no solution, or where alone it has one: where Fᵀ b = 0 for all F with Jᵀ F = 0."""
    lost, asked = lost_motions(J), context.robot.questions
    if isinstance(lost, Skipped):
        return ("no solution in general",)
    values = [entry for one in (asked.velocity, asked.acceleration) if one for entry in one.entries]
    at = AtState(J.ring, asked.state.by_symbol)
    rates = [at(J.ring.symbol(name, dots)) for name, dots, _ in asked.state.values if dots]
    given = {index for value in (*values, *rates) for index in value.used}
    given -= {index for entry in J.entries for index in entry.used}
    forms = SetForms(context.robot, context.values)
    found = [forms.vanishing(one, given) for one in (lost.T @ right).entries if not one.is_zero]
    these = list(dict.fromkeys(found))
    if ONE in these:
        return ("no solution",)
    if not is_small(*these):
        return ("no solution in general",)
    return say("a solution only where {these}", these=listed([equation(one, ZERO) for one in these]))


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
        "What is orthogonal to all possible velocities. {Loads} along it, $𝐅$, {need} no drive of the "
        "joints.",
        letters.LOST,
        formula("𝐉_rᵀ 𝐅 = 𝟎"),
        spong("4.10"),
    ),
}
"""What a space is called, what it is, its letter, the condition of what is in it, and where that stands."""


def loads_along(context: Context, jacobian: str, vectors: Iterable[Sequence[Expr]]) -> list[str]:
    """What acts along vectors of the task, or of J: forces on points, moments where there are angles."""
    task = context.robot.questions.task
    if jacobian == "J" or task is None or task.is_twist:
        kinds = ["a force"] * 3 + ["a moment"] * 3
    else:
        angles = angle_rows(context.values["r"])
        kinds = [_load(entry, is_angle) for entry, is_angle in zip(task.entries, angles, strict=True)]
    used = {kind for v in vectors for kind, entry in zip(kinds, v, strict=True) if not entry.is_zero}
    return [_ANY_LOAD] if not used or _ANY_LOAD in used else sorted(used)


_ANY_LOAD = "what acts"


def _load(entry: Node, is_angle: bool) -> str:
    """What acts along a component of a task."""
    if isinstance(entry, Reference) and entry.row is not None:
        return "a force"
    return "a moment" if is_angle else _ANY_LOAD


def _space(context: Context, name: str) -> Step:
    title, text, letter, condition, source = _SPACES[name]
    value = context.values[name]
    is_found = not isinstance(value, Skipped)
    loads: list[str] = []
    if name == "lost":
        loads = loads_along(context, "Jr", value.T.rows if is_found else ())
    what = say(text, Loads=opened(and_joined(loads)), need="needs" if len(loads) == 1 else "need")
    too_long = " In symbols its vectors are too long to be read: give the coordinates values under `state`."
    found = Step(
        id=name,
        title=title,
        why=(*what, too_long),
        formula=condition,
        source=source,
        detail=Detail.BRIEF,
    )
    if not is_found:
        return found
    form, state = context.matrix(name), context.robot.questions.state
    J = AtState(context.robot.ring, state.by_symbol).matrix(context.values["Jr"])
    vectors = [column_of(form, k) for k in range(len(form.rows[0]))]
    spanned = formula("span ({vectors})", vectors=side_by_side(vectors)) if vectors else Words("{0}")
    rank, count = rank_parts(J).rank, len(vectors)
    holds = of_space(SetForms(context.robot, context.values), name).prose
    if name == "lost" and not vectors:
        what = say("Nothing but $𝟎$ is orthogonal to all possible velocities: no motion is lost.")
    return replace(
        found,
        why=paragraph((what, holds, _state_once(context, name))),
        working=(equation(_J, context.show(J)),),
        result=(equation(letter, spanned),),
        holds=holds,
        notes=((f"The rank is {rank}, and the dimension of this space {count}.",),),
    )


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
