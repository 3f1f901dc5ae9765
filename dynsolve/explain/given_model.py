"""Steps of a model that is given by D and P, by K and P, or by L: its energies, and the D that it has.

They stand in the place of the energies of bodies, and of the D that is assembled from Jacobians.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from dynsolve.document import Prose
from dynsolve.explain.acting import acting_steps
from dynsolve.explain.context import Context
from dynsolve.explain.step import Detail, Step
from dynsolve.explain.writing import is_small, listed, spong, sum_of
from dynsolve.notation.tree import (
    Derivative,
    Letter,
    Matrix,
    Node,
    Product,
    Row,
    Symbol,
    Words,
    column,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.mechanism import GivenModel

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
