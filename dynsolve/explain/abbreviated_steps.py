"""The steps of a derivation in the names of `explain.abbreviations`.

Of a long model D, the Christoffel symbols and g are given in these names, the energies,
the momenta and the forces by their formulas in d_ij, c_ijk and g_k; velocities and
tensors of far links stay the products they are, which would fill pages written out.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import partial

from dynsolve.derivation.rules import course_rules
from dynsolve.document import Inline, Prose
from dynsolve.explain.abbreviations import Abbreviated
from dynsolve.explain.closing import driving_row
from dynsolve.explain.context import Context
from dynsolve.explain.entry_formulas import (
    EntryFormulas,
    Factor,
    collected_coriolis_force,
    coriolis_matrix,
    pairs,
)
from dynsolve.explain.general_steps import GeneralStep, general_steps
from dynsolve.explain.step import Detail, Step
from dynsolve.explain.symbol_names import steps_with_symbols_named
from dynsolve.notation import tree
from dynsolve.notation.build import cost, negated, split_sign, times, total
from dynsolve.notation.tree import (
    ZERO,
    Letter,
    Negative,
    Node,
    Number,
    Product,
    Relation,
    Row,
    Sum,
    Symbol,
    equation,
)
from dynsolve.notation.walk import with_children
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Coordinate

_DIRECT = "D_direct"
"""The step that assembles D from the Jacobians."""

LONGEST = 80
"""The operations up to which a result on the way to D, c_ijk and g is written out."""

_CHRISTOFFEL = Letter("c", Row(tuple(map(Symbol, "ijk"))))
_GRAVITY_TERM = Letter("g", Symbol("k"))

_QUADRATIC = Product((letters.HALF, letters.transposed_product(letters.QD, letters.D)))


def in_names(steps: Iterable[Step], context: Context, short: Abbreviated) -> Iterator[Step]:
    """The steps, with names in them and, of a long model, without what fills pages."""
    if short.at_symbols:
        return steps_with_symbols_named(steps, context, short)
    return _of_long_model(steps, context, short) if short.long else _of_short_model(steps, context, short)


# -- a short model: D, the Christoffel symbols, C and g with names in them -------------------------


def _of_short_model(steps: Iterable[Step], context: Context, short: Abbreviated) -> Iterator[Step]:
    forms, names = context.forms, context.robot.ring.names
    named: dict[Node, Node] = {
        **{forms.christoffel(*ijk): symbol for ijk, symbol in short.christoffel.items()},
        forms("D"): short.D,
        forms("C"): short.C,
        forms("g"): short.g,
        forms("Cqd"): tree.column(
            *(collected_coriolis_force(names, short.symbol, k) for k in range(context.robot.n))
        ),
    }
    for step in steps:
        if step.stage is Stage.VECTORIZED:
            step = replace(step, result=tuple(_exchanged(node, named) for node in step.result))
        in_letters = _IN_LETTERS.get(step.id)
        yield step if in_letters is None else in_letters(step)


def _rates_in_letters(step: Step) -> Step:
    """The step of Ḋ, its entries by the derivatives of D alone."""
    lines = (replace(line, formulas=tuple(map(_without_value, line.formulas))) for line in step.lines)
    return replace(step, lines=tuple(lines))


def _terms_in_letters(step: Step) -> Step:
    """The table of the terms of the forces, each by its name alone."""
    assert step.table is not None

    def cell(part: Inline) -> Inline:
        return _without_value(part) if isinstance(part, Node) else part

    rows = tuple(tuple(map(cell, row)) for row in step.table.rows)
    return replace(step, table=replace(step.table, rows=rows))


_IN_LETTERS: Mapping[str, Callable[[Step], Step]] = {"skew": _rates_in_letters, "terms": _terms_in_letters}
"""The steps whose values would not be in names, by their ids."""


def _without_value(node: Node) -> Node:
    """A chain of equations without its last member, which is the value written out."""
    if not isinstance(node, Relation):
        return node
    return node.parts[0] if len(node.parts) == 2 else equation(*node.parts[:-1])


def _exchanged(node: Node, named: Mapping[Node, Node]) -> Node:
    """A formula with parts exchanged for the same in names."""
    found = named.get(node)
    if found is not None:
        return found
    inside = isinstance(node, Relation | Sum | Product)
    return with_children(node, lambda part: _exchanged(part, named)) if inside else node


# -- a long model ----------------------------------------------------------------------------------


def _of_long_model(steps: Iterable[Step], context: Context, short: Abbreviated) -> Iterator[Step]:
    steps = tuple(steps)
    direct = next((step for step in steps if step.id == _DIRECT), None)
    changes = _LongModel(context, short, direct).changes()
    general = {name: group for group in general_steps(context) for name in group.details}
    inputs = {rule.name: rule.inputs for rule in course_rules(context.robot)}
    told: set[GeneralStep] = set()
    for step in steps:
        if step is direct:  # its formula is that of D itself
            continue
        group = general.get(step.id)
        if group is not None and group not in told:
            told.add(group)
            yield group.step
        change = changes.get(step.id)
        if change is not None:
            step = change(step)
        elif _is_too_long(step):
            step = _left_out(step)
        uses = inputs.get(step.id, ()) if step.uses is None else step.uses
        if group is not None:
            yield replace(step, detail=Detail.FULL)
        else:
            yield replace(step, uses=tuple(dict.fromkeys(_source(name, general) for name in uses)))


def _source(name: str, general: Mapping[str, GeneralStep]) -> str:
    """What a result is to be looked up under: where it is a detail, the step that speaks of all like it."""
    group = general.get(name)
    return name if group is None else group.step.id


def _is_too_long(step: Step) -> bool:
    """Whether a step on the way would fill pages."""
    on_the_way = step.stage is Stage.INERTIA or step.stage is Stage.ENERGY
    return on_the_way and max(map(_size, step.result), default=0) > LONGEST


def _size(node: Node) -> int:
    """The operations in a result."""
    value = node.parts[-1] if isinstance(node, Relation) else node
    if isinstance(value, tree.Matrix):
        return sum(_size(entry) for row in value.rows for entry in row)
    try:
        return cost(value)
    except TypeError:  # a formula in letters
        return 0


def _left_out(step: Step) -> Step:
    """The step with its formula as its result."""
    if step.formula is None:
        return step
    note: Prose = ("Written out it would be too long to be useful; the formula defines it.",)
    return replace(step, result=(), notes=(*step.notes, note))


class _LongModel:
    """How the steps of a long model change: a method for each kind of step."""

    def __init__(self, context: Context, short: Abbreviated, direct: Step | None) -> None:
        self.context, self.short, self.direct = context, short, direct
        self.n, names = context.robot.n, context.robot.ring.names
        self.formulas = EntryFormulas(names, self._d, self._c, self._g, _with_number_in_front)

    def changes(self) -> dict[str, Callable[[Step], Step]]:
        """The changes by the ids of their steps."""
        changes: dict[str, Callable[[Step], Step]] = {
            f"H{len(self.context.robot.joints)}": self.last_frame,
            "K": self.kinetic,
            "L": self.lagrangian,
            "Cqd": self.coriolis_forces,
            "D": self.inertia,
            "christoffel": self.christoffel,
            "C": self.coriolis,
            "g": self.gravity,
        }
        for q in self.context.robot.coordinates:
            changes |= {
                f"dLdqd{q.index}": partial(self.momentum, q),
                f"ddt{q.index}": partial(self.momentum_rate, q),
                f"dLdq{q.index}": partial(self.coordinate_derivative, q),
                f"tau{q.index}": partial(self.force, q),
            }
        return changes

    def _d(self, i: int, j: int) -> Node:
        """The name of d_ij."""
        return ZERO if self.short.D.rows[i][j] == ZERO else letters.entry("d", min(i, j) + 1, max(i, j) + 1)

    def _c(self, i: int, j: int, k: int) -> Node:
        """The name of c_ijk, the same for c_jik."""
        i, j = min(i, j), max(i, j)
        return ZERO if self.short.symbol(i, j, k) == ZERO else letters.entry("c", i + 1, j + 1, k + 1)

    def _g(self, k: int) -> Node:
        """The name of g_k."""
        return ZERO if self.short.g.rows[k][0] == ZERO else letters.entry("g", k + 1)

    def last_frame(self, step: Step) -> Step:
        """The last frame by the matrices of the rows, without the frames on the way to it."""
        return replace(step, working=())

    def kinetic(self, step: Step) -> Step:
        return _with(
            step,
            equation(letters.K, _QUADRATIC, self.formulas.kinetic_energy()),
            " It is a quadratic form in the rates; its coefficients are the entries of ",
            letters.D,
            ", which the vectorized form gives as sums over the bodies.",
        )

    def lagrangian(self, step: Step) -> Step:
        return _with(step, equation(letters.L, Sum((_QUADRATIC, Negative(letters.P)))))

    def momentum(self, q: Coordinate, step: Step) -> Step:
        momentum = letters.partial_derivative(letters.L, letters.velocity(q))
        return _with(step, equation(momentum, self.formulas.momentum(q.index - 1)))

    def momentum_rate(self, q: Coordinate, step: Step) -> Step:
        """d_kj q̈_j + ḋ_kj q̇_j"""
        k = q.index - 1
        D, ring = self.context.values["D"], self.context.robot.ring
        moving = [j for j in range(self.n) if any(not ring.diff(D[k, j], i).is_zero for i in range(self.n))]
        rates = [
            Product((replace(d, dots=1), Symbol(ring.names[j], 1)))
            for j in moving
            if isinstance(d := self._d(k, j), Letter)
        ]
        left = letters.time_derivative(letters.partial_derivative(letters.L, letters.velocity(q)))
        result = equation(left, total([*self.formulas.acceleration_terms(k), *rates]))
        i, j, row = (Symbol(name) for name in ("i", "j", str(q.index)))
        both = tree.Parenthesized(Sum((Letter("c", Row((i, j, row))), Letter("c", Row((i, row, j))))))
        change = equation(
            Letter("d", Row((row, j)), dots=1),
            tree.BigSum(Product((both, Letter("q", i, dots=1))), i, Number(1), Number(self.n)),
        )
        return _with(step, result, " In the Christoffel symbols, ", change, ".")

    def coordinate_derivative(self, q: Coordinate, step: Step) -> Step:
        k, by = q.index - 1, Symbol(q.name)
        D, ring = self.context.values["D"], self.context.robot.ring
        terms: list[Node] = []
        if any(not ring.diff(D[i, j], k).is_zero for i, j in pairs(self.n)):
            middle = tree.Parenthesized(letters.partial_derivative(letters.D, by))
            terms.append(Product((letters.HALF, letters.transposed_product(letters.QD, middle))))
        terms.append(negated(self._g(k)))
        return _with(step, equation(letters.partial_derivative(letters.L, by), total(terms)))

    def force(self, q: Coordinate, step: Step) -> Step:
        result = equation(driving_row(self.context, q), self.formulas.force(q.index - 1))
        why = " Collected by the accelerations and the rates."
        return _with(step, result, why)

    def coriolis_forces(self, step: Step) -> Step:
        """C q̇ is part of the forces above, and is not written again."""
        why: Prose = (" In the forces above they are the terms with ", _CHRISTOFFEL)
        why += (" and ", _GRAVITY_TERM, ".")
        return replace(step, result=(), why=(*step.why, *why))

    def inertia(self, step: Step) -> Step:
        """D from the Jacobians: the forces above are written in its entries, and give nothing new."""
        if self.direct is None:  # the forces come from the recursions, and no Jacobian is there
            return replace(step, result=(equation(letters.D, self.short.D),))
        return replace(
            step,
            title="The inertia matrix, assembled from the Jacobians",
            why=(
                "The forces above are written in the entries of ",
                letters.D,
                ". They follow from the kinetic energy: ",
                equation(letters.K, _QUADRATIC),
                " makes ",
                letters.D,
                " a sum over them, here multiplied out. It is symmetric, and depends on the "
                "coordinates, but on no rate.",
            ),
            formula=self.direct.formula,
            source=self.direct.source,
            working=self.direct.working,
            result=(equation(letters.D, self.short.D),),
            uses=self.direct.uses,
        )

    def gravity(self, step: Step) -> Step:
        return replace(step, result=(equation(letters.G, self.short.g),))

    def coriolis(self, step: Step) -> Step:
        """C by its Christoffel symbols."""
        C = coriolis_matrix(self.formulas.coordinates, self._c)
        return replace(step, result=(equation(letters.C, C),))

    def christoffel(self, step: Step) -> Step:
        """The distinct symbols; those that are equal, or each other's opposites, in one chain."""
        groups: dict[frozenset[Node], tuple[Node, list[tuple[int, Letter]]]] = {}
        symbols = self.short.christoffel
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
        return replace(step, result=rows, listed=True)


def _with_number_in_front(coefficient: Fraction | int, factors: Iterable[Factor]) -> Node:
    """coefficient · Π node^exponent with names for factors: ½ d_11 q̇_1², not d_11 q̇_1² / 2."""
    product = times(1, factors)
    if coefficient == 1 or product == ZERO:
        return product
    inner = product.factors if isinstance(product, Product) else (product,)
    return Product((Number(coefficient.numerator, coefficient.denominator), *inner))


def _terms(value: Node) -> frozenset[Node]:
    """The terms of a sum, whatever their order."""
    sign, inner = split_sign(value)
    terms = inner.terms if isinstance(inner, Sum) else (inner,)
    return frozenset(terms if sign > 0 else map(negated, terms))


def _chain(named: Sequence[tuple[int, Node]], value: Node) -> Relation:
    """c_112 = -c_121 = ... = value, the first name with a plus, and the value too if that is possible"""
    sign, bare = split_sign(value)
    if any(s == sign for s, _ in named):
        named, value = [(s * sign, name) for s, name in named], bare
    signed = sorted(named, key=lambda pair: -pair[0])
    return equation(*(name if s > 0 else Negative(name) for s, name in signed), value)


def _with(step: Step, result: Node, *more: str | Node) -> Step:
    """The step with a result in names, and what there is to say about it."""
    why: Prose = (*step.why, *more)
    return replace(step, result=(result,), why=why)
