"""Steps of bodies that are given by their positions: r_c, R by turns, J_v by differentiation, J_ω.

They stand in the place of those that start from frames; see `inertia` and `energy`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from msgspec.structs import asdict, replace

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.matrix import Matrix
from dynsolve.document import Prose, Reference
from dynsolve.document.books import spong
from dynsolve.document.sentences import opened, say
from dynsolve.explain.actions import acting_steps
from dynsolve.explain.context import Context
from dynsolve.explain.entry_formulas import QUADRATIC, is_too_long
from dynsolve.explain.matrix_factors import factored
from dynsolve.explain.named_steps import Ending, ending
from dynsolve.explain.step import Detail, Step
from dynsolve.explain.working.identities import SILENT, Way
from dynsolve.explain.working.rotational import turning_axis
from dynsolve.explain.writing import flat, is_small, listed, name_of, sum_of
from dynsolve.notation import tree
from dynsolve.notation.build import times, total
from dynsolve.notation.template import formula
from dynsolve.notation.tree import Derivative, Letter, Node, Product, Words, column, equation
from dynsolve.quantities import letters
from dynsolve.robot.model import Body, BodyTurn, GivenModel


def center_step(context: Context, body: Body) -> Step:
    """r_c, which the problem gives."""
    moves = any(map(context.robot.ring.depends_on_coordinates, body.center.entries))
    center = factored(context, context.form(f"rc{body.name}"))
    how = " as a function of the coordinates." if moves else ": it does not move."
    return Step(
        id=f"rc{body.name}",
        title=f"Mass centre of {name_of(body)}",
        why=(f"The position is given{how}",),
        result=(equation(letters.rc(body), letters.bold("0") if body.center.is_zero else center),),
        said=f"given position{how}",
        uses=(),
        detail=Detail.BRIEF,
    )


# -- orientation -----------------------------------------------------------------------------------


def orientation_step(context: Context, body: Body) -> Step:
    """R, the product of the body's turns."""
    R, factors = letters.of_body("R", body, "bold"), _factors(body)
    several = len(factors) > 1
    shown = zip(factors, body.turns, strict=True)
    return Step(
        id=f"R{body.name}",
        title=f"Orientation of {name_of(body)}",
        why=turned(body),
        formula=equation(R, Product(factors)) if several else None,
        source=spong("2.5.3"),
        working=tuple(equation(name, context.show(turn.rotation)) for name, turn in shown) if several else (),
        result=(equation(R, context.form(f"R{body.name}")),),
        uses=(),
        detail=Detail.FULL
        if turning_axis(context, body) is not None and f"R{body.name}" not in context.wanted
        else Detail.NORMAL,
    )


def turned(body: Body) -> Prose:
    """By which angles a body turns, about which axes."""
    name = opened(name_of(body))
    if not body.turns:
        return (f"{name} does not turn.",)
    turns: Prose = ()
    for turn in body.turns:
        then = ", then by " if turns else ""
        turns += say("{then}{angle} about {axis}", then=then, angle=turn.angle, axis=_axis(turn))
    words = "{name} turns by {turns}."
    if len(body.turns) > 1:
        words += " Each axis is carried along by the turns before it, so that its matrix stands on the right."
    return say(words, name=name, turns=turns)


def _axis(turn: BodyTurn) -> Prose:
    """An axis in words: z for [0, 0, 1], else along (0, -1, 0)."""
    for k, name in enumerate("xyz"):
        if turn.axis == Matrix.identity(turn.axis.ring, 3).column_at(k):
            return (f"the axis {name}",)
    return ("the axis along ", flat(map(Compactor(turn.axis.ring).form, turn.axis.entries)))


def _factors(body: Body) -> tuple[Node, ...]:
    """R_{1,1}, R_{1,2}: the matrices of the turns of a body."""
    index, places = letters.index_of(body.name), range(1, len(body.turns) + 1)
    return tuple(formula("𝐑_({body},{place})", body=index, place=place) for place in places)


# -- how they move ---------------------------------------------------------------------------------


def jacobians_step(context: Context, body: Body) -> Step:
    """J_v = ∂r_c/∂q, and the sum of the axes of the turns, each times the rates of its angle."""
    b, jv, is_point = body.name, letters.jv(body), body.is_point and not body.turns
    results = [equation(jv, factored(context, context.form(f"Jv{b}")))]
    if not is_point:
        results.append(equation(letters.jw(body), factored(context, context.form(f"Jw{b}"))))
    return Step(
        id=f"Jv{b}",
        title=f"Jacobian of {name_of(body)}" if is_point else f"Jacobians of {name_of(body)}",
        why=say(
            "Differentiate the position: column k is its partial derivative with respect to the k-th "
            "coordinate.{angular}",
            angular="" if is_point else _ANGULAR[min(len(body.turns), 2)],
        ),
        formula=equation(jv, letters.partial_derivative(letters.rc(body), letters.Q)),
        source=spong("7.2.2"),
        working=(_sum_of_axes(context, body),) if len(body.turns) > 1 else (),
        result=tuple(results),
        also=() if is_point else (f"Jw{b}",),
        uses=(f"rc{b}",),
    )


_ANGULAR = (
    " The body does not turn.",
    " The angular velocity is the rate of the angle along its axis, which does not move.",
    " The angular velocity is the sum over the turns: the rate of each angle along its axis, as the turns "
    "before it have carried that.",
)
"""The angular velocity of no turn, of one, and of several."""


def _sum_of_axes(context: Context, body: Body) -> Node:
    """ω = a₁ φ̇₁ + R₁ a₂ φ̇₂ + ..."""
    terms: list[Node] = []
    for place, turn in enumerate(body.turns):
        rates = zip(turn.rates.entries, context.robot.coordinates, strict=True)
        moved = [(context.show(rate), letters.velocity(q)) for rate, q in rates if not rate.is_zero]
        rate = total([times(1, [(factor, 1), (velocity, 1)]) for factor, velocity in moved])
        terms.append(Product((*_factors(body)[:place], context.show(turn.axis), rate)))
    return equation(letters.of_body("omega", body, "bold"), total(terms))


# -- steps of a model that is given by D and P, by K and P, or by L: its energies, and the D that it has
# They stand in the place of the energies of bodies, and of the D that is assembled from Jacobians.


def total_energy(context: Context, name: str, way: Way = SILENT) -> tuple[Ending, Prose, tuple[Prose, ...]]:
    """K or P: how its step ends, and of a long model what else is said of it, and a note."""
    letter = Letter(name, style="script")
    if name == "K":
        more = say(
            " It is a quadratic form in the rates; its coefficients are the entries of the symmetric inertia "
            "matrix $𝐃${D}, which the matrix form gives as sums over the bodies.",
            D=Reference(("D",)),
        )
        if context.is_in_letters:
            return ending(context, "K", {"K": (letter, QUADRATIC)}, way), more, ()
        return ending(context, "K", {"K": (letter,)}, way), (), ()
    result = (equation(letter, context.form(name)),)
    if context.is_in_letters and is_too_long(result):
        note = say("It is written out in abbreviations where $𝐠${g} is derived.", g=Reference(("g",)))
        return Ending(way.lines, way.concluding, ()), (), (note,)
    return Ending(way.lines, way.concluding, result), (), ()


def energy_steps(context: Context, given: GivenModel) -> Iterator[Step]:
    """P, then K, each with what springs and rotors add to what is given."""
    springs, rotors = acting_steps(context)
    yield from springs
    yield _with_added(_potential(context, given), letters.P, [letters.PS] * len(springs))
    yield from rotors
    yield _with_added(_kinetic(context, given), letters.K, [letters.KM] * len(rotors))


def _with_added(step: Step, energy: Letter, added: Sequence[Letter]) -> Step:
    """The step of an energy to which that of springs or of rotors is added."""
    if not added:
        return step
    given = Letter(energy.base, Words("given"), None, energy.style)
    formula = equation(energy, sum_of([given, *added]))
    why = (*step.why, *say(" What is not in it is added: {added}.", added=listed(added)))
    return replace(step, why=why, formula=formula, working=(), uses=None)


def _potential(context: Context, given: GivenModel) -> Step:
    if given.L is not None:
        why = "What is left of ℒ where nothing moves, with the opposite sign."
    else:
        why = "The problem gives none." if given.P is None else "Given by the problem."
    return _energy(context, "P", "Potential energy", why)


def _energy(context: Context, name: str, title: str, why: str) -> Step:
    end, more, notes = total_energy(context, name)
    return Step(
        id=name,
        title=title,
        why=(why, *more),
        source=spong("7.1"),
        **asdict(end),
        notes=notes,
        detail=Detail.BRIEF,
    )


def _kinetic(context: Context, given: GivenModel) -> Step:
    """The given one, or K = ½ q̇ᵀ D q̇ with the D that is given."""
    if given.D is None:
        what = "Given by the problem" if given.L is None else "The terms of ℒ with rates"
        them = "the rates" if given.L is None else "them"
        return _energy(context, "K", "Kinetic energy", f"{what}: a quadratic form in {them}.")
    D = context.show(given.D)
    rates = tuple(letters.velocity(q) for q in context.robot.coordinates)
    shown = Product((letters.HALF, tree.Matrix((rates,)), D, column(*rates)))
    given_by = say("The problem gives $𝐃$, and the kinetic energy is its quadratic form in the rates.")
    end, more, _ = total_energy(context, "K")
    return Step(
        id="K",
        title="Kinetic energy",
        why=(*given_by, *more),
        formula=equation(letters.K, QUADRATIC),
        source=spong("7.3"),
        working=(equation(letters.K, shown),) if is_small(D) else (),
        **asdict(end),
        detail=Detail.BRIEF,
        uses=(),
    )


def inertia_step(context: Context, given: GivenModel) -> Step:
    """The D that is given, or that of K, beside the one read off from the forces."""
    same = context.values["D"] == context.values["D_direct"]
    is_same = " It is the $𝐃$ read off above, entry by entry."
    ends = say(is_same if same else " It is not the $𝐃$ read off above.")
    step = Step(
        id="D_direct",
        title="The inertia matrix, as the problem gives it",
        why=("Without the Lagrangian.", *ends),
        source=spong("7.3"),
        result=(equation(letters.D, context.result("D") if same else context.form("D_direct")),),
        uses=(),
        is_task=False,
    )
    if given.D is not None:
        return step
    return replace(
        step,
        title="The inertia matrix, from the kinetic energy",
        why=say(
            "Without the Lagrangian: {K}, so that $d_ij$ is the second derivative of the kinetic energy by "
            "two rates.{ends}",
            K=equation(letters.K, QUADRATIC),
            ends=ends,
        ),
        formula=equation(formula("d_ij"), Derivative(formula("∂{K}/∂q̇_j", K=letters.K), formula("q̇_i"))),
        result=(),
        uses=None,
        is_task=True,
        hint=("Another way to D, without the Lagrangian: differentiate the kinetic energy twice.",),
    )
