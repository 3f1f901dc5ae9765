"""Steps of bodies that are given by their positions: r_c, R by turns, J_v by differentiation, J_ω.

They stand in the place of those that start from frames; see `inertia` and `energy`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from dynsolve.document import Prose
from dynsolve.explain.actions import acting_steps
from dynsolve.explain.context import Context
from dynsolve.explain.step import Detail, Step
from dynsolve.explain.writing import is_small, listed, name_of, spong, sum_of
from dynsolve.notation.build import times, total
from dynsolve.notation.tree import (
    Derivative,
    Letter,
    Matrix,
    Node,
    Number,
    Product,
    Row,
    Symbol,
    Words,
    column,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.mechanism import BodyTurn, GivenModel
from dynsolve.robot.model import Body


def center_step(context: Context, body: Body) -> Step:
    """r_c, which the problem gives."""
    moves = any(map(context.robot.ring.depends_on_coordinates, body.center.entries))
    why = f"The position of {name_of(body)} is given"
    why += " as a function of the coordinates." if moves else ": it does not move."
    return Step(
        id=f"rc{body.name}",
        stage=Stage.INERTIA,
        title=f"Mass centre of {name_of(body)}",
        why=(why,),
        result=(equation(letters.rc(body), context.form(f"rc{body.name}")),),
        said="given position" if moves else "",
        uses=(),
        detail=Detail.BRIEF,
    )


# -- orientation -----------------------------------------------------------------------------------


def orientation_step(context: Context, body: Body) -> Step:
    """R, the product of the body's turns."""
    R = letters.of_body("R", body, "bold")
    return Step(
        id=f"R{body.name}",
        stage=Stage.INERTIA,
        title=f"Orientation of {name_of(body)}",
        why=turned(body),
        formula=equation(R, Product(_factors(body))) if len(body.turns) > 1 else None,
        source=spong("2.5.3"),
        working=tuple(
            equation(name, context.show(turn.rotation))
            for name, turn in zip(_factors(body), body.turns, strict=True)
            if len(body.turns) > 1
        ),
        result=(equation(R, context.form(f"R{body.name}")),),
        uses=(),
    )


def turned(body: Body) -> Prose:
    """By which angles a body turns, about which axes."""
    if not body.turns:
        return (f"{name_of(body).capitalize()} does not turn.",)
    if len(body.turns) == 1:
        (turn,) = body.turns
        return (f"{name_of(body).capitalize()} turns by ", turn.angle, " about ", *_axis(turn), ".")
    parts: Prose = (f"{name_of(body).capitalize()} turns by ",)
    for place, turn in enumerate(body.turns):
        parts += (turn.angle, " about ", *_axis(turn))
        parts += (", then by " if place < len(body.turns) - 1 else ". ",)
    return (
        *parts,
        "Each axis is carried along by the turns before it, so that its matrix stands on the right.",
    )


def _axis(turn: BodyTurn) -> Prose:
    """An axis in words: z for [0, 0, 1]."""
    ring = turn.axis.ring
    for name, k in (("x", 0), ("y", 1), ("z", 2)):
        others = [entry for i, entry in enumerate(turn.axis.entries) if i != k]
        if turn.axis[k, 0] == ring.one and all(entry.is_zero for entry in others):
            return (f"the axis {name}",)
    return ("the axis given",)


def _factors(body: Body) -> tuple[Node, ...]:
    """R_{1,1}, R_{1,2}: the matrices of the turns of a body."""
    index = letters.index_of(body.name)
    return tuple(
        Letter("R", Row((index, Words(","), Number(place))), None, "bold")
        for place in range(1, len(body.turns) + 1)
    )


# -- how they move ---------------------------------------------------------------------------------


def jacobians_step(context: Context, body: Body) -> Step:
    """J_v = ∂r_c/∂q, and the sum of the axes of the turns, each times the rates of its angle."""
    b = body.name
    jv, jw = letters.jv(body), letters.jw(body)
    why: Prose = (
        "Differentiate the position: column k is its partial derivative with respect to the k-th coordinate.",
    )
    results: list[Node] = [equation(jv, context.form(f"Jv{b}"))]
    working: tuple[Node, ...] = ()
    also: tuple[str, ...] = ()
    if body.turns or not body.is_point:
        also = (f"Jw{b}",)
        results.append(equation(jw, context.form(f"Jw{b}")))
        why += (" ", *_angular(body))
    if len(body.turns) > 1:
        working = (_sum_of_axes(context, body),)
    return Step(
        id=f"Jv{b}",
        stage=Stage.ENERGY,
        title=f"Jacobians of {name_of(body)}" if also else f"Jacobian of {name_of(body)}",
        why=why,
        formula=equation(jv, letters.partial_derivative(letters.rc(body), letters.Q)),
        source=spong("7.2.2"),
        working=working,
        result=tuple(results),
        also=also,
        uses=(f"rc{b}",),
    )


def _angular(body: Body) -> Prose:
    """The sentence about the angular velocity."""
    if not body.turns:
        return ("The body does not turn.",)
    if len(body.turns) == 1:
        return ("The angular velocity is the rate of the angle along its axis, which does not move.",)
    return (
        "The angular velocity is the sum over the turns: the rate of each angle along its axis, as the "
        "turns before it have carried that.",
    )


def _sum_of_axes(context: Context, body: Body) -> Node:
    """ω = a₁ φ̇₁ + R₁ a₂ φ̇₂ + ..."""
    robot = context.robot
    terms: list[Node] = []
    for place, turn in enumerate(body.turns):
        before = _factors(body)[:place]
        rates = zip(turn.rates.entries, robot.coordinates, strict=True)
        rate = total([times(1, [(context.show(r), 1), (letters.velocity(q), 1)])
                      for r, q in rates if not r.is_zero])  # fmt: skip
        terms.append(Product((*before, context.show(turn.axis), rate)))
    return equation(letters.of_body("omega", body, "bold"), total(terms))


# -- steps of a model that is given by D and P, by K and P, or by L: its energies, and the D that it has
# They stand in the place of the energies of bodies, and of the D that is assembled from Jacobians.

_QUADRATIC = Product((letters.HALF, letters.transposed_product(letters.QD, letters.D)))


def energy_steps(context: Context, given: GivenModel) -> Iterator[Step]:
    """P, then K, each with what springs and rotors add to what is given."""
    springs, rotors = acting_steps(context)
    yield from springs
    yield _with_added(_potential(context, given), letters.P, [letters.PS] * len(springs))
    yield from rotors
    kinetic = _of_inertia(context, given) if given.D is not None else _kinetic(context, given)
    yield _with_added(kinetic, letters.K, [letters.KM] * len(rotors))


def _with_added(step: Step, energy: Letter, added: Sequence[Letter]) -> Step:
    """The step of an energy to which that of springs or of rotors is added."""
    if not added:
        return step
    given = Letter(energy.base, Words("given"), None, energy.style)
    formula = equation(energy, sum_of([given, *added]))
    why = (*step.why, " What is not in it is added: ", *listed(added), ".")
    return replace(step, why=why, formula=formula, working=(), uses=None)


def _potential(context: Context, given: GivenModel) -> Step:
    if given.L is not None:
        why: Prose = ("What is left of ℒ where nothing moves, with the opposite sign.",)
    elif given.P is not None:
        why = ("Given by the problem.",)
    else:
        why = ("The problem gives none.",)
    return Step(
        id="P",
        stage=Stage.ENERGY,
        title="Potential energy",
        why=why,
        source=spong("7.1"),
        result=(equation(letters.P, context.form("P")),),
        detail=Detail.BRIEF,
    )


def _kinetic(context: Context, given: GivenModel) -> Step:
    why = "Given by the problem: a quadratic form in the rates."
    if given.L is not None:
        why = "The terms of ℒ with rates: a quadratic form in them."
    return Step(
        id="K",
        stage=Stage.ENERGY,
        title="Kinetic energy",
        why=(why,),
        source=spong("7.1"),
        result=(equation(letters.K, context.form("K")),),
        detail=Detail.BRIEF,
    )


def _of_inertia(context: Context, given: GivenModel) -> Step:
    """K = ½ q̇ᵀ D q̇ with the D that is given."""
    assert given.D is not None
    D = context.show(given.D)
    rates = tuple(letters.velocity(q) for q in context.robot.coordinates)
    working: tuple[Node, ...] = ()
    if is_small(D):
        working = (equation(letters.K, Product((letters.HALF, Matrix((rates,)), D, column(*rates)))),)
    return Step(
        id="K",
        stage=Stage.ENERGY,
        title="Kinetic energy",
        why=(
            "The problem gives ",
            letters.D,
            ", and the kinetic energy is its quadratic form in the rates.",
        ),
        formula=equation(letters.K, _QUADRATIC),
        source=spong("7.3"),
        working=working,
        result=(equation(letters.K, context.form("K")),),
        uses=(),
        detail=Detail.BRIEF,
    )


def inertia_step(context: Context, given: GivenModel) -> Step:
    """The D that is given, or that of K, beside the one read off from the forces."""
    same = context.values["D"] == context.values["D_direct"]
    ends: Prose = (" It is" if same else " It is not", " the ", letters.D, " read off above")
    ends += (", entry by entry.",) if same else (".",)
    if given.D is not None:
        return Step(
            id="D_direct",
            stage=Stage.VECTORIZED,
            title="The inertia matrix, as the problem gives it",
            why=("Without the Lagrangian.", *ends),
            source=spong("7.3"),
            result=(equation(letters.D, context.form("D_direct")),),
            uses=(),
            is_task=False,
        )
    i, j = Symbol("i"), Symbol("j")
    rates = (Letter("q", i, dots=1), Letter("q", j, dots=1))
    second = Derivative(Derivative(letters.K, rates[1]), rates[0])
    return Step(
        id="D_direct",
        stage=Stage.VECTORIZED,
        title="The inertia matrix, from the kinetic energy",
        why=(
            "Without the Lagrangian: ",
            equation(letters.K, _QUADRATIC),
            ", so that ",
            Letter("d", Row((i, j))),
            " is the second derivative of the kinetic energy by two rates.",
            *ends,
        ),
        formula=equation(Letter("d", Row((i, j))), second),
        source=spong("7.3"),
        hint=("Another way to D, without the Lagrangian: differentiate the kinetic energy twice.",),
    )
