"""D, the Christoffel symbols, C and g of a long model, in names."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from itertools import chain, pairwise

from dynsolve.derivation.jacobian import joint_frame
from dynsolve.derivation.kinematics import axis
from dynsolve.document import Prose, Reference
from dynsolve.explain.context import Context
from dynsolve.explain.forms import coriolis_matrix
from dynsolve.explain.long_model.inertia_entry import worked_entry
from dynsolve.explain.long_model.model import QUADRATIC, Change, LongModel
from dynsolve.explain.long_model.slopes import christoffel_example, gravity_example
from dynsolve.explain.sanity.conserved import is_carried_along, on_last_entry
from dynsolve.explain.step import Detail, Line, Step
from dynsolve.explain.terms import ID, driving_row, has_friction
from dynsolve.explain.writing import listed
from dynsolve.notation import tree
from dynsolve.notation.build import negated, split_sign
from dynsolve.notation.tree import (
    ZERO,
    Cross,
    Function,
    Letter,
    Negative,
    Node,
    Number,
    Parenthesized,
    Product,
    Relation,
    Row,
    Sum,
    Symbol,
    Transpose,
    equation,
)
from dynsolve.notation.walk import walk
from dynsolve.quantities import letters
from dynsolve.robot.model import Coordinate, JointType


def matrix_changes(model: LongModel) -> dict[str, Change]:
    """The changes by the ids of their steps."""
    return {
        "Cqd": partial(rest, model),
        "D": partial(inertia, model),
        "christoffel": partial(christoffel, model),
        "C": partial(coriolis, model),
        "g": partial(gravity, model),
        "dependence": partial(last_entry, model),
        ID: partial(shortest_row, model),
    }


def rest(model: LongModel, step: Step) -> Step:
    """g, where it is read off from the recursions; C q̇ is that of the Christoffel symbols."""
    Cqd = Product((letters.C, letters.QD))
    why: Prose = (*step.why, " ", Cqd, " is not written out: the Christoffel symbols below give it.")
    return replace(step, why=why, result=(equation(letters.G, model.short.g),), also=())


def inertia(model: LongModel, step: Step) -> Step:
    """D from the energies: the forces above are written in its entries, and give nothing new."""
    result = (equation(letters.D, model.short.D),)
    if model.direct is None:  # the forces come from the recursions, and no energy is there
        return replace(step, result=result)
    given = model.context.robot.given is not None
    in_full = (" The next section works one entry out.",) if worked_entry(model) else ()
    return replace(
        step,
        title=model.direct.title,
        why=(*(() if given else _of_the_bodies()), *_on_what_it_depends(model), *in_full),
        formula=model.direct.formula,
        source=model.direct.source,
        result=result,
        uses=model.short.lists,
    )


def _on_what_it_depends(model: LongModel) -> Prose:
    """The coordinates by which D changes, and that its derivatives by the others are zero."""
    names = [q.name for q in model.context.robot.coordinates]
    still = _still(model)
    moving = [name for k, name in enumerate(names) if k not in still]
    if not moving:
        return (letters.D, " is symmetric and constant.")
    alone = (" alone",) if still else ()
    return (letters.D, " is symmetric, and depends on ", *listed(list(map(Symbol, moving))), *alone, ".")


def _still(model: LongModel) -> list[int]:
    """The coordinates, from 0, on which no entry of D depends."""
    D, ring = model.context.values["D"], model.context.robot.ring
    changing = {k for entry in set(D.entries) for k in range(model.n) if not ring.diff(entry, k).is_zero}
    return [k for k in range(model.n) if k not in changing]


def christoffel(model: LongModel, step: Step) -> Step:
    """The distinct symbols; those that are equal, or each other's opposites, in one chain."""
    groups: dict[frozenset[Node], tuple[Node, list[tuple[int, Letter]]]] = {}
    symbols = model.short.christoffel
    for i, j, k in sorted(symbols, key=lambda ijk: (ijk[2], ijk[0], ijk[1])):
        value, name = symbols[i, j, k], letters.entry("c", i + 1, j + 1, k + 1)
        if value == ZERO:
            continue
        terms = _terms(value)
        opposite = frozenset(map(negated, terms))
        if opposite in groups:
            groups[opposite][1].append((-1, name))
        else:
            groups.setdefault(terms, (value, []))[1].append((1, name))
    rows = tuple(_chain(named, value) for value, named in groups.values())
    if not rows:
        return replace(step, result=())
    zero = any(value == ZERO for value in symbols.values())
    note: Prose = (
        "They are listed with ",
        _ordered("i", "j"),
        "; of these, all others are zero." if zero else ".",
    )
    entry = worked_entry(model)
    example = () if entry is None else christoffel_example(model, entry.row, entry.column)
    written = (*symbols.values(), *(one.meaning for one in model.short.sums))
    return replace(
        step,
        why=_on_symbols(model),
        lines=example,
        concluding=(f"The other symbols in the same way{_identities(written)}:",) if example else (),
        result=rows,
        listed=True,
        notes=(note,),
    )


def _identities(values: Iterable[Node]) -> str:
    """By which identities the symbols are collected."""
    angles = {node.argument for node in walk(*values) if isinstance(node, Function)}
    kinds = {Sum: "sums", Product: "double angles"}
    found = [name for kind, name in kinds.items() if any(type(angle) is kind for angle in angles)]
    return f", with sines and cosines of {' and of '.join(found)}" if found else ""


def _on_symbols(model: LongModel) -> Prose:
    """What halves the symbols, and why many are each other's opposites."""
    c = partial(_with_indices, "c")
    why: Prose = (equation(c("ijk"), c("jik")), ", for ", letters.D, " is symmetric. ")
    opposite = equation(c("ijk"), Negative(c("ikj")))
    why += on_parallel_axes(model.context)
    if is_carried_along(model.context):
        entry, coordinate = _with_indices("d", "jk"), Letter("q", Symbol("i"))
        why += ("Joint i moves the links from ", Symbol("i"), " on like one body, so ", entry)
        why += (" does not depend on ", coordinate, " where ", _ordered("i", "j"), " and ")
        why += (_ordered("i", "k"), "; there ", opposite, ". ")
    return (*why, "Symbols that are equal, or each other's opposites, stand in one equation.")


def coriolis(model: LongModel, step: Step) -> Step:
    """C by its Christoffel symbols: an entry that stands for all, and those that are zero."""
    names = chain.from_iterable(letters.entries("c", model.n))
    named = list(zip(names, chain.from_iterable(_in_symbols(model).rows), strict=True))
    full = [equation(name, entry) for name, entry in named if entry != ZERO]
    zero = [name for name, entry in named if entry == ZERO]
    shown = [*full[:1], *([equation(*zero, ZERO)] if zero else [])]
    why: Prose = (
        "Row k, column j. ",
        Product((letters.C, letters.QD)),
        " has in row k the sum over ",
        *listed([Symbol("i"), Symbol("j")]),
        " of the force k",
        Reference(("forces",), " in "),
        ": ",
    )
    why += ("centrifugal terms (a rate squared) and Coriolis terms (a product of two rates). ",)
    told = "One entry, written out, shows how each is made"
    why += (f"{told}; {_zeros_follow(zero)}." if zero else f"{told}.",) if full else ("There are none.",)
    return replace(step, why=why, result=tuple(shown), entries=())


def _zeros_follow(zero: Sequence[Node]) -> str:
    return "the only one that is zero follows it" if len(zero) == 1 else "those that are zero follow it"


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
    why: Prose = ("The partial derivatives of the potential energy.",)
    example = gravity_example(model)
    after: Prose = ("All entries:",) if example else ("Differentiated:",)
    return replace(step, why=why, lines=(potential, *example), concluding=after, result=result)


def last_entry(model: LongModel, step: Step) -> Step:
    """The last entry of D alone: on what D does not depend was said of the Christoffel symbols."""
    title = "Check: the last entry of the inertia matrix"
    return replace(step, title=title, why=on_last_entry(model.context))


def _with_indices(letter: str, indices: str) -> Letter:
    """c_ijk"""
    return Letter(letter, Row(tuple(map(Symbol, indices))))


def _ordered(first: str, second: str) -> Relation:
    """i ≤ j"""
    return Relation((Symbol(first), Symbol(second)), ("≤",))


def _of_the_bodies() -> Prose:
    """Why D is a sum over the bodies."""
    return (
        "In the kinetic energies the velocities are Jacobians times ",
        letters.QD,
        ", so ",
        equation(letters.K, QUADRATIC),
        " with a sum over the bodies. ",
    )


def _terms(value: Node) -> frozenset[Node]:
    """The terms of a sum, whatever their order."""
    sign, inner = split_sign(value)
    terms = inner.terms if isinstance(inner, Sum) else (inner,)
    return frozenset(terms if sign > 0 else map(negated, terms))


def _chain(named: Sequence[tuple[int, Node]], value: Node) -> Relation:
    """c_121 = -c_112 = ... = value, in the order of the names, of which the first has a plus"""
    return equation(*(name if s > 0 else Negative(name) for s, name in named), value)


# -- why Christoffel symbols of joints with parallel axes are equal --------------------------------

_I, _J, _K = Symbol("i"), Symbol("j"), Symbol("k")


def on_parallel_axes(context: Context) -> Prose:
    """c_2jk = c_3jk where 3 ≤ j, of neighbours that turn about parallel axes.

    ∂²r/∂q_i ∂q_j = z_i × (∂r/∂q_j) of a point that joints i ≤ j move, and ∂(J_ω)_j/∂q_i = z_i × z_j,
    speak of joint i by the direction of its axis alone.
    """
    why: Prose = ()
    for first, second in _parallel(context):
        of_first, of_second = (Letter("c", Row((Number(q.index), _J, _K))) for q in (first, second))
        why += (
            "The axes of joints ",
            *listed([Number(first.index), Number(second.index)]),
            " are parallel, so ",
            equation(of_first, of_second),
            " where ",
            Relation((Number(second.index), _J), ("≤",)),
            ". ",
        )
    return (*_by_points(context), *why) if why else ()


def _by_points(context: Context) -> Prose:
    """c_ijk = Σ m (∂p/∂q_k)ᵀ ∂²p/∂q_i∂q_j over points p; joint i ≤ j turns ∂p/∂q_j about its axis."""
    p = letters.ANY_POINT
    by_j, by_k = (letters.partial_derivative(p, Letter("q", index)) for index in (_J, _K))
    axis_of_i = letters.bold("z", Sum((_I, Negative(Number(1)))) if context.standard else _I)
    slope = letters.partial_derivative(by_j, Letter("q", _I))
    return (
        Letter("d", Row((_J, _K))),
        " is the sum over all points ",
        p,
        " of the bodies of their mass times ",
        Product((Transpose(Parenthesized(by_k)), by_j)),
        ". Put into the formula below, four of six terms cancel: ",
        Letter("c", Row((_I, _J, _K))),
        " is the sum of the masses times ",
        Product((Transpose(Parenthesized(by_k)), slope)),
        ". Where ",
        Relation((_I, _J), ("≤",)),
        ", joint i turns ",
        by_j,
        " about its axis: ",
        equation(slope, Cross(axis_of_i, by_j)),
        ". ",
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
    q, row = min(rows, key=lambda each: _terms_of_one_row(each[1]))
    if _terms_of_one_row(row) > MOST_TERMS:
        return step
    by = ("The shortest row as an example", Reference(("D", "christoffel", "g"), ", "), ":")
    return replace(step, lines=(Line(by, (equation(driving_row(context, q), row),)),))


def _terms_of_one_row(node: Node) -> int:
    return len(node.terms) if isinstance(node, Sum) else 1
