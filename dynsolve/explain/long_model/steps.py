"""The steps of a derivation, those of a long model told otherwise."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial

from dynsolve.derivation.rules import course_rules
from dynsolve.document import Prose, Reference
from dynsolve.explain.abbreviations import Abbreviated
from dynsolve.explain.context import Context
from dynsolve.explain.forms import pairs
from dynsolve.explain.long_model.general import GeneralStep, frame_changes, general_steps
from dynsolve.explain.long_model.inertia_entry import worked_entry
from dynsolve.explain.long_model.model import QUADRATIC, Change, LongModel, is_too_long, left_out, with_result
from dynsolve.explain.long_model.vectorized import coriolis_entries, matrix_changes
from dynsolve.explain.step import Detail, Step
from dynsolve.explain.terms import driving_row
from dynsolve.notation import tree
from dynsolve.notation.build import negated, total
from dynsolve.notation.tree import Letter, Negative, Node, Number, Product, Row, Sum, Symbol, equation
from dynsolve.quantities import letters
from dynsolve.robot.model import Coordinate


def energy_changes(model: LongModel) -> dict[str, Change]:
    """The changes by the ids of their steps."""
    found: dict[str, Change] = {
        "P": partial(potential, model),
        "K": partial(kinetic, model),
        "L": partial(lagrangian, model),
    }
    for q in model.context.robot.coordinates:
        found |= {
            f"dLdqd{q.index}": partial(momentum, model, q),
            f"ddt{q.index}": partial(momentum_rate, model, q),
            f"dLdq{q.index}": partial(coordinate_derivative, model, q),
            f"tau{q.index}": partial(force, model, q),
        }
    return found


def potential(model: LongModel, step: Step) -> Step:
    """P written out, where that fits; else where its names are defined."""
    if not is_too_long(step):
        return step
    if model.short.P is None:
        return left_out(step)
    note: Prose = ("It is written out in abbreviations where ", letters.G, Reference(("g",)), " is derived.")
    return replace(step, result=(), notes=(*step.notes, note))


def kinetic(model: LongModel, step: Step) -> Step:
    """K by the entries of D."""
    return with_result(
        step,
        equation(letters.K, QUADRATIC, model.formulas.kinetic_energy()),
        " It is a quadratic form in the rates; its coefficients are the entries of the symmetric ",
        "inertia matrix ",
        letters.D,
        Reference(("D",)),
        ", which the matrix form gives as sums over the bodies.",
    )


def lagrangian(model: LongModel, step: Step) -> Step:
    """½ q̇ᵀ D q̇ - P"""
    return with_result(step, equation(letters.L, Sum((QUADRATIC, Negative(letters.P)))))


def momentum(model: LongModel, q: Coordinate, step: Step) -> Step:
    """Σ_j d_kj q̇_j"""
    momentum = letters.partial_derivative(letters.L, letters.velocity(q))
    return with_result(step, equation(momentum, model.formulas.momentum(q.index - 1)))


def momentum_rate(model: LongModel, q: Coordinate, step: Step) -> Step:
    """d_kj q̈_j + ḋ_kj q̇_j"""
    k = q.index - 1
    D, ring = model.context.values["D"], model.context.robot.ring
    moving = [j for j in range(model.n) if any(not ring.diff(D[k, j], i).is_zero for i in range(model.n))]
    rates = [
        Product((replace(d, dots=1), Symbol(ring.names[j], 1)))
        for j in moving
        if isinstance(d := model.d(k, j), Letter)
    ]
    left = letters.time_derivative(letters.partial_derivative(letters.L, letters.velocity(q)))
    result = equation(left, total([*model.formulas.acceleration_terms(k), *rates]))
    i, j, row = (Symbol(name) for name in ("i", "j", str(q.index)))
    both = tree.Parenthesized(Sum((Letter("c", Row((i, j, row))), Letter("c", Row((i, row, j))))))
    change = equation(
        Letter("d", Row((row, j)), dots=1),
        tree.BigSum(Product((both, Letter("q", i, dots=1))), i, Number(1), Number(model.n)),
    )
    return with_result(step, result, " In the Christoffel symbols, ", change, ".")


def coordinate_derivative(model: LongModel, q: Coordinate, step: Step) -> Step:
    """½ q̇ᵀ (∂D/∂q_k) q̇ - g_k"""
    k, by = q.index - 1, Symbol(q.name)
    D, ring = model.context.values["D"], model.context.robot.ring
    terms: list[Node] = []
    if any(not ring.diff(D[i, j], k).is_zero for i, j in pairs(model.n)):
        middle = tree.Parenthesized(letters.partial_derivative(letters.D, by))
        terms.append(Product((letters.HALF, letters.transposed_product(letters.QD, middle))))
    terms.append(negated(model.g(k)))
    return with_result(step, equation(letters.partial_derivative(letters.L, by), total(terms)))


def force(model: LongModel, q: Coordinate, step: Step) -> Step:
    """Σ_j d_kj q̈_j + Σ_ij c_ijk q̇_i q̇_j + friction + g_k"""
    result = equation(driving_row(model.context, q), model.formulas.force(q.index - 1))
    why = " Collected by the accelerations and the rates."
    return with_result(step, result, why)


_DIRECT = "D_direct"
"""The step that assembles D from the Jacobians."""

_READ_OFF = ("Cqd", "agreement")
"""The steps of what is read off from the forces, which are in the same letters, and compared."""


def of_long_model(steps: Iterable[Step], context: Context, short: Abbreviated) -> Iterator[Step]:
    """The steps of a long model, what is alike said once."""
    steps = tuple(steps)
    direct = next((step for step in steps if step.id == _DIRECT), None)
    model = LongModel(context, short, direct)
    changes = frame_changes(model) | energy_changes(model) | matrix_changes(model)
    general = {name: group for group in general_steps(context) for name in group.details}
    inputs = {rule.name: rule.inputs for rule in course_rules(context.robot)}
    told: set[GeneralStep] = set()
    for step in steps:
        if step is direct:  # its formula is that of D itself
            continue
        if direct is not None and step.id in _READ_OFF:  # nothing is read off: there is one way only
            continue
        group = general.get(step.id)
        if group is not None and group not in told:
            told.add(group)
            yield group.step
        change = changes.get(step.id)
        if change is not None:
            step = change(step)
        elif is_too_long(step):
            step = left_out(step)
        uses = inputs.get(step.id, ()) if step.uses is None else step.uses
        if group is not None:
            yield replace(step, detail=Detail.FULL)
        else:
            yield replace(step, uses=tuple(dict.fromkeys(_source(name, general) for name in uses)))
        if step.id == "D" and (entry := worked_entry(model)):
            yield entry.step()
        if step.id == "C":
            yield coriolis_entries(model, step)


def _source(name: str, general: Mapping[str, GeneralStep]) -> str:
    """What a result is to be looked up under: where it is a detail, the step that speaks of all like it."""
    group = general.get(name)
    return name if group is None else group.step.id
