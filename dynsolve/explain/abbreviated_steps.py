"""The steps of a long model, in names: what would fill pages says what it is made of.

D, the Christoffel symbols and g are given with the definitions of
`explain.abbreviations`; the energies, the momenta and the forces by their formulas in
d_ij, c_ijk and g_k; velocities and tensors of far links stay the products they are.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace

from dynsolve.document import Block, Equations, Fold, Heading, Prose, Text
from dynsolve.explain.abbreviations import Abbreviated, Definition
from dynsolve.explain.context import Context
from dynsolve.explain.step import Detail, Step
from dynsolve.notation import tree
from dynsolve.notation.build import cost, negated, split_sign, times, total
from dynsolve.notation.tree import (
    ZERO,
    Letter,
    Negative,
    Node,
    Number,
    Power,
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

LONGEST = 80
"""The operations up to which a result on the way to D, c_ijk and g is written out."""


def in_names(steps: Iterable[Step], context: Context, short: Abbreviated) -> Iterator[Step]:
    """The steps, with names in them and, of a model with named constants, without what fills pages."""
    names = _Names(context, short)
    told: set[str] = set()
    for step in steps:
        change = names.changes.get(step.id)
        if change is not None:
            yield change(step)
        elif step.stage is Stage.VECTORIZED and not short.long:
            yield replace(step, result=tuple(map(names.swapped, step.result)))
        elif short.long and names.is_too_long(step):
            kind = step.id.rstrip("0123456789")
            yield names.left_out(step, first=not told, again=kind in told)
            told.add(kind)
        else:
            yield step


def definition_blocks(short: Abbreviated) -> Iterator[Block]:
    """The section in which the names are defined."""
    if not short.definitions:
        return
    yield Heading("Abbreviations", 2)
    if short.constants:
        yield Fold("Inertial constants", tuple(_constant_blocks(short)), Detail.BRIEF)
    if short.sums:
        yield Fold("Recurring terms", tuple(_recurring_blocks(short)), Detail.BRIEF)


def _constant_blocks(short: Abbreviated) -> Iterator[Block]:
    count = len(short.constants)
    yield Text((
        f"The {count} base parameters: " if count > 1 else "The base parameter: ",
        "the combinations of masses, mass centres, moments of inertia and lengths that D and g are made "
        "of. What the arm does tells no more about its masses than their values.",
    ))  # fmt: skip
    yield Equations(tuple(map(_defined, short.constants)))


def _recurring_blocks(short: Abbreviated) -> Iterator[Block]:
    yield Text(("What stands in several places below, each made of those before it.",))
    yield Equations(tuple(map(_defined, short.sums)))


def _defined(definition: Definition) -> Relation:
    return equation(definition.name, definition.meaning)


class _Names:
    """Formulas in d_ij, c_ijk and g_k; those that are zero are left out."""

    def __init__(self, context: Context, short: Abbreviated) -> None:
        self.context, self.short = context, short
        self.n = context.robot.n
        self.changes: dict[str, Callable[[Step], Step]] = {
            "D": self.inertia,
            "C": self.coriolis,
            "g": self.gravity,
        }
        self.swaps: dict[Node, Node] = {}
        if not short.long:
            forms = context.forms
            self.swaps = {
                **{forms.christoffel(*ijk): symbol for ijk, symbol in short.christoffel.items()},
                forms("D"): short.D,
                forms("C"): short.C,
                forms("g"): short.g,
                forms("Cqd"): tree.column(*map(self.coriolis_force, range(self.n))),
            }
        else:
            self.changes |= {
                "christoffel": self.christoffel,
                "K": self.kinetic,
                "L": self.lagrangian,
                "Cqd": self.coriolis_forces,
            }
            for q in context.robot.coordinates:
                self.changes |= {
                    f"dLdqd{q.index}": self.momentum(q),
                    f"ddt{q.index}": self.momentum_rate(q),
                    f"dLdq{q.index}": self.slope(q),
                    f"tau{q.index}": self.force(q),
                }

    # -- the entries and their names ---------------------------------------------------------------

    def d(self, i: int, j: int, dots: int = 0) -> Letter | None:
        """The name of d_ij, from 0; None where it is zero."""
        if self.short.D.rows[i][j] == ZERO:
            return None
        return replace(letters.entry("d", min(i, j) + 1, max(i, j) + 1), dots=dots)

    def c(self, i: int, j: int, k: int) -> Letter | None:
        i, j = min(i, j), max(i, j)
        if self.short.christoffel[i, j, k] == ZERO:
            return None
        return letters.entry("c", i + 1, j + 1, k + 1)

    def g(self, k: int) -> Letter | None:
        return None if self.short.g.rows[k][0] == ZERO else letters.entry("g", k + 1)

    def rate(self, k: int, dots: int = 1) -> Symbol:
        return Symbol(self.context.robot.coordinates[k].name, dots)

    def rates(self, i: int, j: int) -> tuple[Node, ...]:
        """q̇_i q̇_j"""
        return (Power(self.rate(i), Number(2)),) if i == j else (self.rate(i), self.rate(j))

    def pairs(self) -> list[tuple[int, int]]:
        return [(i, j) for i in range(self.n) for j in range(i, self.n)]

    def accelerated(self, k: int) -> list[Node]:
        """d_kj q̈_j"""
        return [Product((d, self.rate(j, 2))) for j in range(self.n) if (d := self.d(k, j))]

    def coriolis_terms(self, k: int) -> list[Node]:
        """c_ijk q̇_i q̇_j, twice where i and j differ"""
        return [
            Product((*([] if i == j else [Number(2)]), c, *self.rates(i, j)))
            for i, j in self.pairs()
            if (c := self.c(i, j, k))
        ]

    # -- steps -------------------------------------------------------------------------------------

    def is_too_long(self, step: Step) -> bool:
        """Whether a step on the way would fill pages."""
        on_the_way = step.stage in (Stage.INERTIA, Stage.ENERGY)
        return on_the_way and max(map(_size, step.result), default=0) > LONGEST

    def left_out(self, step: Step, first: bool, again: bool) -> Step:
        """The step with its formula as its result; the first says so, those `again` are details."""
        if step.formula is None:
            return step
        note: Prose = (
            "Written out it would be too long to be of use; the formula says what it is. So it is below "
            "where a formula stands alone, and for the bodies after such a one, whose steps are left out. "
            "What comes of them are the entries of D.",
        )
        return replace(
            step,
            result=(),
            notes=(*step.notes, note) if first else step.notes,
            detail=Detail.FULL if again else step.detail,
        )

    def kinetic(self, step: Step) -> Step:
        quadratic = Product((letters.HALF, letters.transposed_product(letters.QD, letters.D)))
        terms = [
            Product((*([letters.HALF] if i == j else []), d, *self.rates(i, j)))
            for i, j in self.pairs()
            if (d := self.d(i, j))
        ]
        return _with(
            step,
            equation(letters.K, quadratic, _total(terms)),
            " Collected by the rates, it is a quadratic form; its coefficients are the entries of D, which "
            "the vectorized form gives.",
        )

    def lagrangian(self, step: Step) -> Step:
        quadratic = Product((letters.HALF, letters.transposed_product(letters.QD, letters.D)))
        return _with(step, equation(letters.L, Sum((quadratic, Negative(letters.P)))))

    def momentum(self, q: Coordinate) -> Callable[[Step], Step]:
        k = q.index - 1
        terms: list[Node] = [Product((d, self.rate(j))) for j in range(self.n) if (d := self.d(k, j))]
        result = equation(letters.slope(letters.L, letters.rate(q)), _total(terms))
        return lambda step: _with(step, result, " The entries of D are given with the vectorized form.")

    def momentum_rate(self, q: Coordinate) -> Callable[[Step], Step]:
        k = q.index - 1
        D, ring = self.context.values["D"], self.context.robot.ring
        moving = [any(not ring.diff(D[k, j], i).is_zero for i in range(self.n)) for j in range(self.n)]
        rates = [
            Product((d, self.rate(j))) for j in range(self.n) if moving[j] and (d := self.d(k, j, dots=1))
        ]
        left = letters.time_rate(letters.slope(letters.L, letters.rate(q)))
        result = equation(left, _total([*self.accelerated(k), *rates]))
        i, j, row = (Symbol(name) for name in ("i", "j", str(q.index)))
        both = tree.Parenthesized(Sum((Letter("c", Row((i, j, row))), Letter("c", Row((i, row, j))))))
        change = equation(
            Letter("d", Row((row, j)), dots=1),
            tree.BigSum(Product((both, Letter("q", i, dots=1))), i, Number(1), Number(self.n)),
        )
        return lambda step: _with(step, result, " In the Christoffel symbols, ", change, ".")

    def slope(self, q: Coordinate) -> Callable[[Step], Step]:
        k = q.index - 1
        by = Symbol(q.name)
        D, ring = self.context.values["D"], self.context.robot.ring
        moves = any(not ring.diff(D[i, j], k).is_zero for i, j in self.pairs())
        terms: list[Node] = []
        if moves:
            middle = tree.Parenthesized(letters.slope(letters.D, by))
            terms.append(Product((letters.HALF, letters.transposed_product(letters.QD, middle))))
        if g := self.g(k):
            terms.append(Negative(g))
        result = equation(letters.slope(letters.L, by), _total(terms))
        return lambda step: _with(step, result)

    def force(self, q: Coordinate) -> Callable[[Step], Step]:
        k = q.index - 1
        g = self.g(k)
        terms = [*self.accelerated(k), *self.coriolis_terms(k), *([g] if g else [])]
        result = equation(letters.force(q), _total(terms))
        return lambda step: _with(
            step, result, " Collected by the accelerations and the rates; the factors follow below."
        )

    def coriolis_forces(self, step: Step) -> Step:
        """Of the forces nothing new is to be read off."""
        return replace(
            step, result=(), why=(*step.why, " In the forces above they are the terms with c and g.")
        )

    def inertia(self, step: Step) -> Step:
        return replace(step, result=(equation(letters.D, self.short.D),))

    def gravity(self, step: Step) -> Step:
        return replace(step, result=(equation(letters.G, self.short.g),))

    def coriolis(self, step: Step) -> Step:
        """C by its Christoffel symbols, where those are long."""
        C = self.short.C
        if self.short.long:
            C = tree.Matrix(tuple(tuple(self.entry(k, j) for j in range(self.n)) for k in range(self.n)))
        return replace(step, result=(equation(letters.C, C),))

    def coriolis_force(self, k: int) -> Node:
        """Row k of C q̇, the rates that have the same factor drawn together."""
        shared: dict[Node, list[Node]] = {}
        for i, j in self.pairs():
            symbol = self.short.christoffel[i, j, k]
            if symbol != ZERO:
                rates = times(1 if i == j else 2, [(rate, 1) for rate in self.rates(i, j)])
                shared.setdefault(symbol, []).append(rates)
        return total([times(1, [(symbol, 1), (total(rates), 1)]) for symbol, rates in shared.items()])

    def swapped(self, node: Node) -> Node:
        """A formula with D, the Christoffel symbols, C, g and C q̇ in names."""
        found = self.swaps.get(node)
        if found is not None:
            return found
        return with_children(node, self.swapped) if isinstance(node, Relation | Sum | Product) else node

    def entry(self, k: int, j: int) -> Node:
        """c_kj = Σ_i c_ijk q̇_i"""
        return _total([Product((c, self.rate(i))) for i in range(self.n) if (c := self.c(i, j, k))])

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


def _size(node: Node) -> int:
    """The operations in a result."""
    value = node.parts[-1] if isinstance(node, Relation) else node
    if isinstance(value, tree.Matrix):
        return sum(_size(entry) for row in value.rows for entry in row)
    try:
        return cost(value)
    except TypeError:  # a formula in letters
        return 0


def _total(terms: Sequence[Node]) -> Node:
    if not terms:
        return ZERO
    return terms[0] if len(terms) == 1 else Sum(tuple(terms))


def _with(step: Step, result: Node, *more: str | Node) -> Step:
    """The step with a result in names, and what there is to say about it."""
    why: Prose = (*step.why, *more)
    return replace(step, result=(result,), why=why)
