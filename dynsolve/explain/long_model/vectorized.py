"""D, the Christoffel symbols, C and g of a long model, in names."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain, pairwise

from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_values import value_of
from dynsolve.derivation.kinematics import axis, joint_frame
from dynsolve.document import Prose, Reference
from dynsolve.document.books import spong
from dynsolve.document.sentences import say
from dynsolve.explain.abbreviations import Abbreviated, as_shown
from dynsolve.explain.christoffel import SLOPES, in_slopes
from dynsolve.explain.context import Context
from dynsolve.explain.entry_formulas import QUADRATIC, coriolis_matrix, depends_on, in_names_of_entries, pairs
from dynsolve.explain.long_model.inertia_entry import worked_entry
from dynsolve.explain.recurring import Definition, expanded, expanded_once, rewritten
from dynsolve.explain.sanity.conserved import is_carried_along
from dynsolve.explain.step import Detail, Line, Step
from dynsolve.explain.vectorized import checked, coriolis, direct, from_energies, gravity, inertia, rest
from dynsolve.explain.working.derivatives import coriolis_sums
from dynsolve.explain.working.identities import Way, new_angles
from dynsolve.explain.writing import listed
from dynsolve.notation import tree
from dynsolve.notation.build import negated, split_sign, summands, times
from dynsolve.notation.differentiation import by_symbol, differentiated
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    ZERO,
    Derivative,
    Function,
    Negative,
    Node,
    Number,
    Parenthesized,
    Product,
    Relation,
    Slashed,
    Sum,
    Symbol,
    equation,
    names_in,
    walk,
    with_children,
)
from dynsolve.quantities import letters
from dynsolve.robot.model import Coordinate, JointType


def steps(context: Context) -> Iterator[Step]:
    """D assembled directly, since from forces that are written in its entries nothing is read off."""
    if from_energies(context):
        whole, *parts = direct(context)
        yield inertia_step(context, whole)
    else:
        parts = [rest(context)]
        yield inertia(context)
    if entry := worked_entry(context):
        yield entry.step()
    yield from parts
    yield christoffel_step(context)
    yield coriolis(context, _coriolis_told(context))
    yield coriolis_entries(context)
    if from_energies(context):
        yield gravity(context, None if context.values["g"].is_zero else _gravity_told(context))
    yield from checked(context)


def names_of(context: Context) -> Abbreviated:
    """The names of a long model."""
    assert context.names is not None
    return context.names


def inertia_step(context: Context, direct: Step) -> Step:
    """D as `direct` assembles it: the forces are written in its entries, and give nothing new."""
    names = names_of(context)
    of_bodies = say(
        "In the kinetic energies the velocities are Jacobians times $𝐪̇$, so $𝒦 = {form}$ with a sum over "
        "the bodies. ",
        form=QUADRATIC,
    )
    return Step(
        id="D",
        title=direct.title,
        why=say(
            "{bodies}{depends}{in_full}",
            bodies=of_bodies if context.robot.given is None else "",
            depends=_on_what_it_depends(context),
            in_full=" The next section works one entry out." if worked_entry(context) else "",
        ),
        formula=direct.formula,
        source=direct.source,
        result=(equation(letters.D, names.D),),
        uses=names.lists,
        entries=letters.entries("d", context.robot.n),
        detail=Detail.BRIEF,
    )


def _on_what_it_depends(context: Context) -> Prose:
    """The coordinates by which D changes, and that its derivatives by the others are zero."""
    names = context.robot.ring.names
    moving = [Symbol(names[k]) for k in depends_on(context.robot, *context.values["D"].entries)]
    if not moving:
        return say("$𝐃$ is symmetric and constant.")
    alone = " alone" if len(moving) < context.robot.n else ""
    return say("$𝐃$ is symmetric, and depends on {moving}{alone}.", moving=listed(moving), alone=alone)


def christoffel_step(context: Context) -> Step:
    """The distinct symbols; those that are equal, or each other's opposites, in one chain."""
    groups: dict[frozenset[Node], list[Node]] = {}
    names = names_of(context)
    symbols = names.christoffel
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
    entry = worked_entry(context)
    example = () if entry is None else christoffel_example(context, entry.row, entry.column)
    written = (*symbols.values(), *(one.meaning for one in names.sums))
    note = "They are listed with $i ≤ j${zero}."
    return Step(
        id="christoffel",
        title="Christoffel symbols",
        why=_on_symbols(context),
        formula=formula("c_ijk = ½ {slopes}", slopes=SLOPES),
        source=spong("7.3"),
        lines=example,
        concluding=(f"The other symbols in the same way{_identities(written)}:",) if example else (),
        result=tuple(equation(*members) for members in groups.values()),
        listed=True,
        notes=(say(note, zero="; of these, all others are zero" if ZERO in symbols.values() else ""),),
    )


def _identities(values: Iterable[Node]) -> str:
    angles = {node.argument for node in walk(*values) if isinstance(node, Function)}
    kinds = {Sum: "sums", Product: "double angles"}
    found = [name for kind, name in kinds.items() if any(type(angle) is kind for angle in angles)]
    return f", with sines and cosines of {' and of '.join(found)}" if found else ""


def _on_symbols(context: Context) -> Prose:
    """What halves the symbols, and why many are each other's opposites."""
    carried = say(
        "A joint moves all links after it like one body, so $d_jk$ does not depend on $q_i$ where $i ≤ j$ "
        "and $i ≤ k$; there $c_ijk = -c_ikj$. "
    )
    return say(
        "$c_ijk = c_jik$, for $𝐃$ is symmetric. {parallel}{carried}Symbols that are equal, or each other's "
        "opposites, stand in one equation.",
        parallel=on_parallel_axes(context),
        carried=carried if is_carried_along(context) else "",
    )


def _coriolis_told(context: Context) -> tuple[Prose, tuple[Node, ...]]:
    """What is said of C by its Christoffel symbols; an entry that stands for all, and those that are zero."""
    names = chain.from_iterable(letters.entries("c", context.robot.n))
    named = list(zip(names, chain.from_iterable(_in_symbols(context).rows), strict=True))
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
        told=told,
    )
    return why, (*full[:1], *((equation(*zero, ZERO),) if zero else ()))


def coriolis_entries(context: Context) -> Step:
    """All entries of C, which say nothing new."""
    return Step(
        id="C_entries",
        title="The entries of the Coriolis matrix",
        source=spong("7.3"),
        lines=coriolis_sums(context),
        result=(equation(letters.C, _in_symbols(context)),),
        detail=Detail.FULL,
        uses=("C",),
    )


def _in_symbols(context: Context) -> tree.Matrix:
    formulas = in_names_of_entries(context.robot, context.values)
    return coriolis_matrix(formulas.coordinates, formulas.c)


def _gravity_told(context: Context) -> tuple[Prose, Way]:
    """Why, before g the potential energy of which it is the derivatives, and what leads to g."""
    names = names_of(context)
    assert names.P is not None
    by = ("The sum of the potential energies, in the abbreviations:",)
    potential = Line(by, (equation(letters.P, names.P),), ("potentials", *names.lists))
    example = gravity_example(context)
    return (
        ("The partial derivatives of the potential energy.",),
        Way((potential, *example), ("All entries:",) if example else ("Differentiated:",)),
    )


def _terms(value: Node) -> frozenset[Node]:
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
    if robot.is_tree or not robot.has_table or not robot.moves_each_joint_alone or robot.actions.rotors:
        return
    moving = [joint for joint in robot.joints if joint.type]
    for (q, joint), (following, after) in pairwise(zip(robot.coordinates, moving, strict=True)):
        if joint.type is after.type is JointType.REVOLUTE:
            here, there = (axis(context.values[f"H{joint_frame(robot, each)}"]) for each in (joint, after))
            if here == there:
                yield q, following


# -- one Christoffel symbol and one gravity term in full: the derivatives of what stands in names ------

MOST_SLOPES = 3
"""The derivatives of names that an example takes at most, by one coordinate."""


def christoffel_example(context: Context, row: int, column: int) -> tuple[Line, ...]:
    """The symbol in which d_jk, of `row` and `column` from 0, is differentiated by the last that it can be.

    It is c_kkj where that coordinate is k itself, else the symbol of row k.
    """
    varying = depends_on(context.robot, context.values["D"][row, column])
    if not varying:
        return ()
    by = varying[-1]
    i, j, k = (column, column, row) if by == column else (min(row, by), max(row, by), column)
    form = names_of(context).symbol(i, j, k)
    if form == ZERO:
        return ()
    slopes = Sum((_slope(context, k, j, i), _slope(context, k, i, j), Negative(_slope(context, i, j, k))))
    by_entries = in_slopes(context, i, j, k)
    name = letters.entry("c", i + 1, j + 1, k + 1)
    first = equation(name, *dict.fromkeys((Product((letters.HALF, Parenthesized(slopes))), by_entries)))
    once = expanded_once(names_of(context).sums, form)
    names, entries = _entries_differentiated(context, by_entries, once)
    if not names:
        return (Line(("For example:",), (equation(*dict.fromkeys((*first.parts, once, form))),)),)
    put_in = _put_in(by_entries, {each.parts[0]: each.parts[-1] for each in entries})
    shown = {each.parts[0] for each in names}
    others = tuple(
        equation(Slashed(slope), form) for slope, form in slopes_that_are_names(context) if slope not in shown
    )
    again = "Other derivatives of names, found in the same way, that are names again:"
    return (
        Line(("For example:",), (first,)),
        Line(
            ("The names are differentiated as they were defined", *_with_new_angles(context, names), ":"),
            names,
        ),
        Line(("With these:",), entries),
        Line(("Put in:",), (equation(*dict.fromkeys((name, put_in, once, form))),)),
        *([Line((again,), others, in_columns=True)] if others else []),
    )


def _with_new_angles(context: Context, slopes: Sequence[Relation]) -> Prose:
    """The identities by which derivatives of names are names that have sines or cosines of other angles."""
    meanings = {one.name: one.meaning for one in names_of(context).sums}
    found: dict[Relation, None] = {}
    for relation in slopes:
        named = [meanings[node] for node in walk(relation.parts[-1]) if node in meanings]
        found |= dict.fromkeys(new_angles(context.robot.ring, relation.parts, named))
    return (", with ", *listed(list(found))) if found else ()


def _entries_differentiated(
    context: Context, slopes: Node, result: Node
) -> tuple[tuple[Relation, ...], tuple[Relation, ...]]:
    """The derivatives of the names in some entries of D, and of these entries; none where there are too many.

    Which entries, and by which coordinates, is what stands in `slopes`.
    """
    names: dict[Relation, None] = {}
    entries = []
    every = ((*pair, by) for by in range(context.robot.n) for pair in pairs(context.robot.n))
    places = {_slope(context, *place): place for place in every}
    for slope in dict.fromkeys(part for part in walk(slopes) if isinstance(part, Derivative)):
        row, column, by = places[slope]
        form = names_of(context).D.rows[row][column]
        found = NameSlopes(context, by, form, result)
        if len(found.shown) > MOST_SLOPES:
            return (), ()
        names |= dict.fromkeys(found.shown.values())
        entries.append(equation(*dict.fromkeys((slope, found.by_the_chain_rule(form), found.value(form)))))
    return tuple(names), tuple(entries)


def _put_in(node: Node, values: Mapping[Node, Node]) -> Node:
    """½ (Σ ±∂d/∂q) with values for the derivatives."""
    match node:
        case Negative(argument):
            return negated(_put_in(argument, values))
        case Product() | Parenthesized():
            return with_children(node, lambda part: _put_in(part, values))
    return _with_values(node, values)


def _with_values(node: Node, values: Mapping[Node, Node]) -> Node:
    return rewritten(node, lambda leaf: values.get(leaf, leaf))


def _slope(context: Context, row: int, column: int, by: int) -> Node:
    """∂d_ij/∂q_k of indices from 0."""
    entry = letters.entry("d", min(row, column) + 1, max(row, column) + 1)
    return letters.partial_derivative(entry, Symbol(context.robot.coordinates[by].name))


def gravity_example(context: Context) -> tuple[Line, ...]:
    """A gravity term for which a few names in the potential energy must be differentiated."""
    names = names_of(context)
    assert names.P is not None
    for k in reversed(range(context.robot.n)):
        form = names.g.rows[k][0]
        slopes = NameSlopes(context, k, names.P)
        if form == ZERO or not 1 <= len(slopes.shown) <= MOST_SLOPES:
            continue
        members = dict.fromkeys((slopes.of(letters.P), slopes.by_the_chain_rule(names.P), form))
        term = equation(letters.entry("g", k + 1), *members)
        one = len(slopes.shown) == 1
        why = say(
            "For one entry in full, the {names} on {q} {are} differentiated as {they} defined:",
            names="name that depends" if one else "names that depend",
            q=slopes.coordinate,
            are="is" if one else "are",
            they="it was" if one else "they were",
        )
        return Line(why, tuple(slopes.shown.values())), Line(("Put in:",), (term,))
    return ()


# -- the derivatives of the names in a formula by one coordinate -----------------------------------
# A name is differentiated as it was defined, term by term; what comes out is often a name again.

_FACTORS = (1, -1, 2, -2)
"""The multiples of a name that a derivative is looked for among."""


class NameSlopes:
    """The derivatives by one coordinate, `k` from 0, of the names that a formula is made of.

    One that is a name of the formula again, or of the `result` that it leads to, is written as that.
    `shown` has ∂σ/∂q as it is made and what it is, for the names for which it is not zero.
    """

    def __init__(self, context: Context, k: int, formula: Node, result: Node = ZERO) -> None:
        ring = context.robot.ring
        self.coordinate = Symbol(ring.names[k])
        used = _needed_by(context, formula)
        values = _values(context, list(dict.fromkeys((*used, *_needed_by(context, result)))))
        known = _by_value(values)
        self._slopes = {one.name: ring.diff(values[one.name], k) for one in used}
        self._written: dict[Node, Node] = {}
        self.shown: dict[Symbol, Relation] = {}
        for one in used:
            slope = self._slopes[one.name]
            if not slope.is_zero:
                left, chain = self.of(one.name), self.by_the_chain_rule(one.meaning)
                self._written[left] = known.get(slope) or _with_values(chain, self._written)
                self.shown[one.name] = equation(*dict.fromkeys((left, chain, self._written[left])))

    def of(self, node: Node) -> Derivative:
        """∂node/∂q in letters."""
        return letters.partial_derivative(node, self.coordinate)

    def by_the_chain_rule(self, node: Node) -> Node:
        """The derivative of a tree term by term, those of the names in letters."""
        by = by_symbol(self.coordinate)

        def rule(part: Symbol) -> Node:
            if part not in self._slopes:
                return by(part)
            return ZERO if self._slopes[part].is_zero else self.of(part)

        return _of_single_angles(differentiated(node, rule).tree)

    def value(self, node: Node) -> Node:
        """The derivative of a tree term by term, what those of the names are put in."""
        return _with_values(self.by_the_chain_rule(node), self._written)


def _by_value(values: Mapping[Symbol, Expr]) -> dict[Expr, Node]:
    """What is worth a name, or a small multiple of one, written by that."""
    known: dict[Expr, Node] = {}
    for factor in _FACTORS:
        for name, value in values.items():
            known.setdefault(value * factor, times(factor, [(name, 1)]))
    return known


def _needed_by(context: Context, formula: Node) -> list[Definition]:
    """The definitions that a formula needs, in their order."""
    wanted, found = names_in(formula), []
    for definition in reversed(names_of(context).sums):
        if definition.name.name in wanted:
            found.append(definition)
            wanted |= names_in(definition.meaning)
    return found[::-1]


def slopes_that_are_names(context: Context) -> Iterator[tuple[Derivative, Node]]:
    """∂σ/∂q where it is a name again, or twice one, and that: coordinate by coordinate."""
    values = _values(context, names_of(context).sums)
    known = _by_value(values)
    for k, q in enumerate(context.robot.coordinates):
        for name, value in values.items():
            if form := known.get(context.robot.ring.diff(value, k)):
                yield letters.partial_derivative(name, Symbol(q.name)), form


def _values(context: Context, definitions: Sequence[Definition]) -> dict[Symbol, Expr]:
    names = [definition.name for definition in definitions]
    trees = expanded(names_of(context).definitions, names)
    ring = context.robot.ring
    return {name: value_of(ring, node) for name, node in zip(names, trees, strict=True)}


def _of_single_angles(node: Node) -> Node:
    """2 s c for sin(2θ), as the names are written."""

    def single(part: Node) -> Node:
        match part:
            case Function("sin", Product((Number(2, 1), angle))):
                return Product((Number(2), Function("sin", angle), Function("cos", angle)))
        return part

    return rewritten(node, single)
