"""D, the Christoffel symbols, C and g of a long model, in names."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import chain, pairwise

from dynsolve.derivation.jacobian import joint_frame
from dynsolve.derivation.kinematics import axis
from dynsolve.document import Prose, Reference
from dynsolve.document.sentences import say
from dynsolve.explain.abbreviations import as_shown
from dynsolve.explain.context import Context
from dynsolve.explain.forms import coriolis_matrix
from dynsolve.explain.long_model.inertia_entry import worked_entry
from dynsolve.explain.long_model.model import QUADRATIC, LongModel, with_result
from dynsolve.explain.long_model.slopes import christoffel_example, gravity_example
from dynsolve.explain.sanity.conserved import is_carried_along, on_last_entry
from dynsolve.explain.step import Detail, Line, Step
from dynsolve.explain.terms import driving_row, has_friction
from dynsolve.explain.writing import listed
from dynsolve.notation import tree
from dynsolve.notation.build import negated, split_sign, summands
from dynsolve.notation.template import formula
from dynsolve.notation.tree import ZERO, Function, Negative, Node, Number, Product, Sum, Symbol, equation
from dynsolve.notation.walk import walk
from dynsolve.quantities import letters
from dynsolve.robot.model import Coordinate, JointType


def rest(model: LongModel, step: Step) -> Step:
    """g, where it is read off from the recursions; C q̇ is that of the Christoffel symbols."""
    more = say(" $𝐂 𝐪̇$ is not written out: the Christoffel symbols below give it.")
    return replace(with_result(step, equation(letters.G, model.short.g), more), also=())


def inertia(model: LongModel, step: Step) -> Step:
    """D from the energies: the forces above are written in its entries, and give nothing new."""
    result = (equation(letters.D, model.short.D),)
    if model.direct is None:  # the forces come from the recursions, and no energy is there
        return replace(step, result=result)
    of_bodies = say(
        "In the kinetic energies the velocities are Jacobians times $𝐪̇$, so $𝒦 = {form}$ with a sum over "
        "the bodies. ",
        form=QUADRATIC,
    )
    return replace(
        step,
        title=model.direct.title,
        why=say(
            "{bodies}{depends}{in_full}",
            bodies=of_bodies if model.context.robot.given is None else "",
            depends=_on_what_it_depends(model),
            in_full=" The next section works one entry out." if worked_entry(model) else "",
        ),
        formula=model.direct.formula,
        source=model.direct.source,
        result=result,
        uses=model.short.lists,
    )


def _on_what_it_depends(model: LongModel) -> Prose:
    """The coordinates by which D changes, and that its derivatives by the others are zero."""
    names = model.context.robot.ring.names
    moving = [Symbol(names[k]) for k in model.varying(*model.context.values["D"].entries)]
    if not moving:
        return say("$𝐃$ is symmetric and constant.")
    alone = " alone" if len(moving) < model.n else ""
    return say("$𝐃$ is symmetric, and depends on {moving}{alone}.", moving=listed(moving), alone=alone)


def christoffel(model: LongModel, step: Step) -> Step:
    """The distinct symbols; those that are equal, or each other's opposites, in one chain."""
    groups: dict[frozenset[Node], list[Node]] = {}
    symbols = model.short.christoffel
    for i, j, k in as_shown(symbols):
        value, name = symbols[i, j, k], letters.entry("c", i + 1, j + 1, k + 1)
        if value == ZERO:
            continue
        terms = _terms(value)
        opposite = frozenset(map(negated, terms))
        if opposite in groups:
            groups[opposite].insert(-1, Negative(name))
        else:
            groups.setdefault(terms, [value]).insert(-1, name)
    if not groups:
        return replace(step, result=())
    entry = worked_entry(model)
    example = () if entry is None else christoffel_example(model, entry.row, entry.column)
    written = (*symbols.values(), *(one.meaning for one in model.short.sums))
    note = "They are listed with $i ≤ j${zero}."
    return replace(
        step,
        why=_on_symbols(model),
        lines=example,
        concluding=(f"The other symbols in the same way{_identities(written)}:",) if example else (),
        result=tuple(equation(*members) for members in groups.values()),
        listed=True,
        notes=(say(note, zero="; of these, all others are zero" if ZERO in symbols.values() else ""),),
    )


def _identities(values: Iterable[Node]) -> str:
    """By which identities the symbols are collected."""
    angles = {node.argument for node in walk(*values) if isinstance(node, Function)}
    kinds = {Sum: "sums", Product: "double angles"}
    found = [name for kind, name in kinds.items() if any(type(angle) is kind for angle in angles)]
    return f", with sines and cosines of {' and of '.join(found)}" if found else ""


def _on_symbols(model: LongModel) -> Prose:
    """What halves the symbols, and why many are each other's opposites."""
    carried = say(
        "Joint i moves the links from $i$ on like one body, so $d_jk$ does not depend on $q_i$ where $i ≤ j$ "
        "and $i ≤ k$; there $c_ijk = -c_ikj$. "
    )
    return say(
        "$c_ijk = c_jik$, for $𝐃$ is symmetric. {parallel}{carried}Symbols that are equal, or each other's "
        "opposites, stand in one equation.",
        parallel=on_parallel_axes(model.context),
        carried=carried if is_carried_along(model.context) else "",
    )


def coriolis(model: LongModel, step: Step) -> Step:
    """C by its Christoffel symbols: an entry that stands for all, and those that are zero."""
    names = chain.from_iterable(letters.entries("c", model.n))
    named = list(zip(names, chain.from_iterable(_in_symbols(model).rows), strict=True))
    full = [equation(name, entry) for name, entry in named if entry != ZERO]
    zero = [name for name, entry in named if entry == ZERO]
    told = "One entry, written out, shows how each is made"
    if zero:
        told += (
            "; the only one that is zero follows it" if len(zero) == 1 else "; those that are zero follow it"
        )
    why = say(
        "Row k, column j. $𝐂 𝐪̇$ has in row k the sum over $i$ and $j$ of the force k{forces}: centrifugal "
        "terms (a rate squared) and Coriolis terms (a product of two rates). {told}.",
        forces=Reference(("forces",), " in "),
        told=told if full else "There are none",
    )
    shown = (*full[:1], *((equation(*zero, ZERO),) if zero else ()))
    return replace(step, why=why, result=shown, entries=())


def coriolis_entries(model: LongModel, step: Step) -> Step:
    """All entries of C, which say nothing new."""
    return replace(
        step,
        id="C_entries",
        title="The entries of the Coriolis matrix",
        why=(),
        formula=None,
        result=(equation(letters.C, _in_symbols(model)),),
        notes=(),
        detail=Detail.FULL,
        uses=("C",),
    )


def _in_symbols(model: LongModel) -> tree.Matrix:
    """C in the names of the symbols."""
    return coriolis_matrix(model.formulas.coordinates, model.c)


def gravity(model: LongModel, step: Step) -> Step:
    """g, before it the potential energy of which it is the derivatives."""
    result = (equation(letters.G, model.short.g),)
    if model.short.P is None or model.direct is None or model.context.values["g"].is_zero:
        return replace(step, result=result)
    by = ("The sum of the potential energies, in the abbreviations:",)
    potential = Line(by, (equation(letters.P, model.short.P),), ("potentials", *model.short.lists))
    example = gravity_example(model)
    return replace(
        step,
        why=("The partial derivatives of the potential energy.",),
        lines=(potential, *example),
        concluding=("All entries:",) if example else ("Differentiated:",),
        result=result,
    )


def last_entry(model: LongModel, step: Step) -> Step:
    """The last entry of D alone: on what D does not depend was said of the Christoffel symbols."""
    title = "Check: the last entry of the inertia matrix"
    return replace(step, title=title, why=on_last_entry(model.context))


def _terms(value: Node) -> frozenset[Node]:
    """The terms of a sum, whatever their order."""
    sign, inner = split_sign(value)
    return frozenset(summands(inner) if sign > 0 else map(negated, summands(inner)))


# -- why Christoffel symbols of joints with parallel axes are equal --------------------------------


def on_parallel_axes(context: Context) -> Prose:
    """c_2jk = c_3jk where 3 ≤ j, of neighbours that turn about parallel axes.

    c_ijk = Σ m (∂p/∂q_k)ᵀ ∂²p/∂q_i∂q_j over points p.  ∂²p/∂q_i ∂q_j = z_i × (∂p/∂q_j) of a point that
    joints i ≤ j move speaks of joint i by the direction of its axis alone.
    """
    of_joints: Prose = ()
    for first, second in _parallel(context):
        of_joints += say(
            "The axes of joints {a} and {b} are parallel, so $c_{a}jk = c_{b}jk$ where ${b} ≤ j$. ",
            a=Number(first.index),
            b=Number(second.index),
        )
    if not of_joints:
        return ()
    return say(
        "$d_jk$ is the sum over all points $𝐩$ of the bodies of their mass times $(∂𝐩/∂q_k)ᵀ ∂𝐩/∂q_j$. Put "
        "into the formula below, four of six terms cancel: $c_ijk$ is the sum of the masses times "
        "$(∂𝐩/∂q_k)ᵀ {slope}$. Where $i ≤ j$, joint i turns $∂𝐩/∂q_j$ about its axis: ${slope} = 𝐳_{axis} × "
        "∂𝐩/∂q_j$. {joints}",
        slope=letters.partial_derivative(formula("∂𝐩/∂q_j"), formula("q_i")),
        axis=letters.BEFORE if context.standard else letters.COUNT,
        joints=of_joints,
    )


def _parallel(context: Context) -> Iterator[tuple[Coordinate, Coordinate]]:
    """Neighbouring joints that turn about the same direction, in the same sense."""
    robot = context.robot
    if robot.is_tree or not robot.has_table or not robot.moves_each_joint_alone or robot.actions.motors:
        return
    moving = [joint for joint in robot.joints if joint.type]
    for (q, joint), (following, after) in pairwise(zip(robot.coordinates, moving, strict=True)):
        if joint.type is after.type is JointType.REVOLUTE:
            here, there = (axis(context.values[f"H{joint_frame(robot, each)}"]) for each in (joint, after))
            if here == there:
                yield q, following


# -- one row of τ in full, at the end of a long model ----------------------------------------------

MOST_TERMS = 30
"""The terms up to which a row of τ is shown."""


def shortest_row(model: LongModel, step: Step) -> Step:
    """The closing step with the row of τ of the fewest terms, of equally short ones the last."""
    context = model.context
    if has_friction(context):
        return step
    rows = [(q, model.formulas.force(q.index - 1)) for q in reversed(context.robot.coordinates)]
    q, row = min(rows, key=lambda each: len(summands(each[1])))
    if len(summands(row)) > MOST_TERMS:
        return step
    by = ("The shortest row as an example", Reference(("D", "christoffel", "g"), ", "), ":")
    return replace(step, lines=(Line(by, (equation(driving_row(context, q), row),)),))
