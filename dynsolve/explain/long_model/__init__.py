"""The steps of a long model: what is alike is said once, and what would fill pages is given in names.

D, the Christoffel symbols and g are in the names of `explain.abbreviations`, the energies,
the momenta and the forces are formulas in d_ij, c_ijk and g_k; velocities and tensors of far
links stay the products they are, which would fill pages written out.

The steps of a derivation are each changed by a function here (the energies and forces) or in

    model          the robot, its names, and d_ij, c_ijk and g_k by name; which results would fill pages
    general        what is said once for all links, bodies and coordinates; the last frame and its check
    inertia_entry  one entry of D worked out in full, body by body
    vectorized     D, the Christoffel symbols, C and g, one of each in full, and one row of τ
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import partial

from msgspec.structs import replace

from dynsolve.derivation.rules import course_rules
from dynsolve.document import Reference
from dynsolve.document.sentences import say
from dynsolve.explain.abbreviations import Abbreviated
from dynsolve.explain.context import Context
from dynsolve.explain.long_model import general, vectorized
from dynsolve.explain.long_model.inertia_entry import worked_entry
from dynsolve.explain.long_model.model import QUADRATIC, LongModel, is_too_long, left_out, with_result
from dynsolve.explain.step import Detail, Step
from dynsolve.explain.terms import ID, driving_row
from dynsolve.notation.build import negated, total
from dynsolve.notation.template import formula
from dynsolve.notation.tree import Letter, Node, Product, Symbol, equation
from dynsolve.quantities import letters
from dynsolve.robot.model import Coordinate

_READ_OFF = ("D_direct", "Cqd", "agreement")
"""The steps that go where D is assembled from the Jacobians: what is read off is in the same letters."""


def of_long_model(steps: Iterable[Step], context: Context, short: Abbreviated) -> Iterator[Step]:
    """The steps of a long model, what is alike said once."""
    steps = tuple(steps)
    direct = next((step for step in steps if step.id == "D_direct"), None)
    model = LongModel(context, short, direct)
    changes, said_once = _changes(model), general.general_steps(context)
    inputs = {rule.name: rule.inputs for rule in course_rules(context.robot)}
    told: set[str] = set()
    for step in steps:
        if direct is not None and step.id in _READ_OFF:
            continue
        once = said_once.get(step.id)
        if once is not None and once.id not in told:
            told.add(once.id)
            yield once
        if step.id in changes:
            step = changes[step.id](step)
        elif is_too_long(step):
            step = left_out(step)
        uses = inputs.get(step.id, ()) if step.uses is None else step.uses
        if once is None:
            of_steps = (said_once[name].id if name in said_once else name for name in uses)
            yield replace(step, uses=tuple(dict.fromkeys(of_steps)))
        else:
            yield replace(step, detail=Detail.FULL)
        if step.id == "D" and (entry := worked_entry(model)):
            yield entry.step()
        if step.id == "C":
            yield vectorized.coriolis_entries(model, step)


def _changes(model: LongModel) -> dict[str, Callable[[Step], Step]]:
    """What is told otherwise, by the ids of the steps."""
    robot = model.context.robot
    single: dict[str, Callable[[LongModel, Step], Step]] = {
        f"H{len(robot.joints)}": general.last_frame,
        "axes": general.axes,
        "J": general.jacobian,
        "P": potential,
        "K": kinetic,
        "L": lagrangian,
        "Cqd": vectorized.rest,
        "D": vectorized.inertia,
        "christoffel": vectorized.christoffel,
        "C": vectorized.coriolis,
        "g": vectorized.gravity,
        "dependence": vectorized.last_entry,
        ID: vectorized.shortest_row,
    }
    of_coordinates: dict[str, Callable[[LongModel, Coordinate, Step], Step]] = {
        "dLdqd": momentum,
        "ddt": momentum_rate,
        "dLdq": coordinate_derivative,
        "tau": force,
    }
    changes: dict[str, Callable[[Step], Step]] = {id: partial(change, model) for id, change in single.items()}
    for q in robot.coordinates:
        for stem, of_one in of_coordinates.items():
            changes[f"{stem}{q.index}"] = partial(of_one, model, q)
    return changes


# -- the energies and forces -----------------------------------------------------------------------


def potential(model: LongModel, step: Step) -> Step:
    """P written out, where that fits; else where its names are defined."""
    if not is_too_long(step):
        return step
    if model.short.P is None:
        return left_out(step)
    note = say("It is written out in abbreviations where $𝐠${g} is derived.", g=Reference(("g",)))
    return replace(step, result=(), notes=(*step.notes, note))


def kinetic(model: LongModel, step: Step) -> Step:
    """K by the entries of D."""
    more = say(
        " It is a quadratic form in the rates; its coefficients are the entries of the symmetric inertia "
        "matrix $𝐃${D}, which the matrix form gives as sums over the bodies.",
        D=Reference(("D",)),
    )
    return with_result(step, equation(letters.K, QUADRATIC, model.formulas.kinetic_energy()), more)


def lagrangian(model: LongModel, step: Step) -> Step:
    """½ q̇ᵀ D q̇ - P"""
    return with_result(step, formula("ℒ = {K} - 𝒫", K=QUADRATIC))


def momentum(model: LongModel, q: Coordinate, step: Step) -> Step:
    """Σ_j d_kj q̇_j"""
    momentum = letters.partial_derivative(letters.L, letters.velocity(q))
    return with_result(step, equation(momentum, model.formulas.momentum(q.index - 1)))


def momentum_rate(model: LongModel, q: Coordinate, step: Step) -> Step:
    """d_kj q̈_j + ḋ_kj q̇_j"""
    k = q.index - 1
    D = model.context.values["D"]
    rates = [
        Product((replace(d, dots=1), Symbol(name, 1)))
        for j, name in enumerate(model.context.robot.ring.names)
        if isinstance(d := model.d(k, j), Letter) and model.varying(D[k, j])
    ]
    left = letters.time_derivative(letters.partial_derivative(letters.L, letters.velocity(q)))
    change = "ḋ_{k}j = Σ_(i=1)^{n} (c_ij{k} + c_i{k}j) q̇_i"
    more = say(
        " In the Christoffel symbols, {change}.",
        change=formula(change, k=Symbol(str(q.index)), n=model.n),
    )
    return with_result(step, equation(left, total([*model.formulas.acceleration_terms(k), *rates])), more)


def coordinate_derivative(model: LongModel, q: Coordinate, step: Step) -> Step:
    """½ q̇ᵀ (∂D/∂q_k) q̇ - g_k"""
    k, by = q.index - 1, Symbol(q.name)
    terms: list[Node] = []
    if k in model.varying(*model.context.values["D"].entries):
        slope = formula("(∂𝐃/∂{q})", q=by)
        terms.append(Product((letters.HALF, letters.transposed_product(letters.QD, slope))))
    terms.append(negated(model.g(k)))
    return with_result(step, equation(letters.partial_derivative(letters.L, by), total(terms)))


def force(model: LongModel, q: Coordinate, step: Step) -> Step:
    """Σ_j d_kj q̈_j + Σ_ij c_ijk q̇_i q̇_j + friction + g_k"""
    result = equation(driving_row(model.context, q), model.formulas.force(q.index - 1))
    return with_result(step, result, (" Collected by the accelerations and the rates.",))
