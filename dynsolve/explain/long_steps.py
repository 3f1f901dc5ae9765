"""The steps of a long model: what is alike is said once, and what would fill pages is given in names.

D, the Christoffel symbols and g are in the names of `explain.abbreviations`, the energies,
the momenta and the forces are formulas in d_ij, c_ijk and g_k; velocities and tensors of far
links stay the products they are, which would fill pages written out.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cached_property, partial
from itertools import chain

from dynsolve.derivation.rules import course_rules
from dynsolve.document import Prose
from dynsolve.explain.abbreviations import Abbreviated
from dynsolve.explain.closing import driving_row
from dynsolve.explain.context import Context
from dynsolve.explain.entry_formulas import EntryFormulas, Factor, coriolis_matrix, pairs
from dynsolve.explain.general_steps import GeneralStep, general_steps
from dynsolve.explain.sanity.dependence import is_carried_along
from dynsolve.explain.step import Detail, Line, Step
from dynsolve.explain.working.identities import Identity, said
from dynsolve.explain.working.products import used_in_product
from dynsolve.explain.writing import listed
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
    Words,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Coordinate

_DIRECT = "D_direct"
"""The step that assembles D from the Jacobians."""

_READ_OFF = ("Cqd", "agreement")
"""The steps of what is read off from the forces, which are in the same letters, and compared."""

LONGEST = 80
"""The operations up to which a result on the way to D, c_ijk and g is written out."""

_QUADRATIC = Product((letters.HALF, letters.transposed_product(letters.QD, letters.D)))


def of_long_model(steps: Iterable[Step], context: Context, short: Abbreviated) -> Iterator[Step]:
    """The steps of a long model, what is alike said once."""
    steps = tuple(steps)
    direct = next((step for step in steps if step.id == _DIRECT), None)
    model = LongModel(context, short, direct)
    changes = model.changes()
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
        elif _is_too_long(step):
            step = _left_out(step)
        uses = inputs.get(step.id, ()) if step.uses is None else step.uses
        if group is not None:
            yield replace(step, detail=Detail.FULL)
        else:
            yield replace(step, uses=tuple(dict.fromkeys(_source(name, general) for name in uses)))
        if step.id == "C":
            yield model.coriolis_entries(step)


def _identities_outwards(context: Context) -> list[Identity]:
    """The identities by which the products of the frames become what is printed, each once."""
    used: dict[Identity, None] = {}
    for joint in context.robot.path(len(context.robot.joints)):
        before, A, H = (
            context.values[name] for name in (f"H{joint.parent}", f"A{joint.index}", f"H{joint.index}")
        )
        used |= dict.fromkeys(used_in_product(context, before, A, H))
    return list(used)


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


class LongModel:
    """How the steps of a long model change: a method for each kind of step."""

    def __init__(self, context: Context, short: Abbreviated, direct: Step | None) -> None:
        self.context, self.short, self.direct = context, short, direct
        self.n, names = context.robot.n, context.robot.ring.names
        self.formulas = EntryFormulas(names, self._d, self._c, self._g, _with_number_in_front)

    def changes(self) -> dict[str, Callable[[Step], Step]]:
        """The changes by the ids of their steps."""
        changes: dict[str, Callable[[Step], Step]] = {
            f"H{len(self.context.robot.joints)}": self.last_frame,
            "axes": self.axes,
            "P": self.potential,
            "K": self.kinetic,
            "L": self.lagrangian,
            "Cqd": self.rest,
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
        used = _identities_outwards(self.context)
        return replace(step, working=(), concluding=("With ", *said(used), ":") if used else ())

    def axes(self, step: Step) -> Step:
        """The frames on the way, which are not shown, by their products."""
        robot = self.context.robot
        if robot.is_tree or letters.has_base(robot):
            return step
        i = Symbol("i")
        frame = replace(letters.H(robot, 1), sub=i)
        product = Product((letters.A(1), Words("…"), Letter("A", i, style="bold")))
        return replace(step, why=(*step.why, " Frame i is ", equation(frame, product), "."))

    def kinetic(self, step: Step) -> Step:
        """K by the entries of D."""
        return _with(
            step,
            equation(letters.K, _QUADRATIC, self.formulas.kinetic_energy()),
            " It is a quadratic form in the rates; its coefficients are the entries of ",
            letters.D,
            ", which the vectorized form gives as sums over the bodies.",
        )

    def lagrangian(self, step: Step) -> Step:
        """½ q̇ᵀ D q̇ - P"""
        return _with(step, equation(letters.L, Sum((_QUADRATIC, Negative(letters.P)))))

    def momentum(self, q: Coordinate, step: Step) -> Step:
        """Σ_j d_kj q̇_j"""
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
        """½ q̇ᵀ (∂D/∂q_k) q̇ - g_k"""
        k, by = q.index - 1, Symbol(q.name)
        D, ring = self.context.values["D"], self.context.robot.ring
        terms: list[Node] = []
        if any(not ring.diff(D[i, j], k).is_zero for i, j in pairs(self.n)):
            middle = tree.Parenthesized(letters.partial_derivative(letters.D, by))
            terms.append(Product((letters.HALF, letters.transposed_product(letters.QD, middle))))
        terms.append(negated(self._g(k)))
        return _with(step, equation(letters.partial_derivative(letters.L, by), total(terms)))

    def force(self, q: Coordinate, step: Step) -> Step:
        """Σ_j d_kj q̈_j + Σ_ij c_ijk q̇_i q̇_j + g_k"""
        result = equation(driving_row(self.context, q), self.formulas.force(q.index - 1))
        why = " Collected by the accelerations and the rates."
        return _with(step, result, why)

    def rest(self, step: Step) -> Step:
        """g, where it is read off from the recursions; C q̇ is that of the Christoffel symbols."""
        Cqd = Product((letters.C, letters.QD))
        why: Prose = (*step.why, " ", Cqd, " is not written out: the Christoffel symbols below give it.")
        return replace(step, why=why, result=(equation(letters.G, self.short.g),), also=())

    def inertia(self, step: Step) -> Step:
        """D from the energies: the forces above are written in its entries, and give nothing new."""
        result = (equation(letters.D, self.short.D),)
        if self.direct is None:  # the forces come from the recursions, and no energy is there
            return replace(step, result=result)
        given = self.context.robot.given is not None
        return replace(
            step,
            title=self.direct.title,
            why=self._on_what_it_depends() if given else (*_of_the_bodies(), *self._on_what_it_depends()),
            formula=self.direct.formula,
            source=self.direct.source,
            result=result,
            uses=self.short.lists,
        )

    def _on_what_it_depends(self) -> Prose:
        """The coordinates by which D changes, and that its derivatives by the others are zero."""
        names = [q.name for q in self.context.robot.coordinates]
        moving = [name for k, name in enumerate(names) if k not in self._cyclic]
        if not moving:
            return (letters.D, " is symmetric and constant.")
        alone = (" alone",) if self._cyclic else ()
        return (letters.D, " is symmetric, and depends on ", *listed(list(map(Symbol, moving))), *alone, ".")

    @cached_property
    def _cyclic(self) -> list[int]:
        """The coordinates, from 0, on which no entry of D depends."""
        D, ring = self.context.values["D"], self.context.robot.ring
        changing = {k for entry in set(D.entries) for k in range(self.n) if not ring.diff(entry, k).is_zero}
        return [k for k in range(self.n) if k not in changing]

    def potential(self, step: Step) -> Step:
        """P written out, where that fits; else where its names are defined."""
        if not _is_too_long(step):
            return step
        if self.short.P is None:
            return _left_out(step)
        note: Prose = ("It is written out in the abbreviations below, where ", letters.G, " is derived.")
        return replace(step, result=(), notes=(*step.notes, note))

    def gravity(self, step: Step) -> Step:
        """g, before it the potential energy of which it is the derivatives."""
        result = (equation(letters.G, self.short.g),)
        if self.short.P is None or self.direct is None or self.context.values["g"].is_zero:
            return replace(step, result=result)
        potential = Line(("In the abbreviations:",), (equation(letters.P, self.short.P),))
        why: Prose = ("The partial derivatives of the potential energy.",)
        return replace(step, why=why, lines=(potential,), concluding=("Differentiated:",), result=result)

    def coriolis(self, step: Step) -> Step:
        """C by its Christoffel symbols: an entry that stands for all, and those that are zero."""
        names = chain.from_iterable(letters.entries("c", self.n, self.n))
        named = list(zip(names, chain.from_iterable(self._C.rows), strict=True))
        full = [equation(name, entry) for name, entry in named if entry != ZERO]
        zero = [name for name, entry in named if entry == ZERO]
        shown = [*full[:1], *([equation(*zero, ZERO)] if zero else [])]
        why: Prose = (
            "Row k, column j. ",
            Product((letters.C, letters.QD)),
            " holds the terms with rates: ",
        )
        why += ("centrifugal terms (a rate squared) and Coriolis terms (a product of two rates). ",)
        told = "One entry, written out, shows how each is made"
        why += (
            (f"{told}; those that are zero follow it." if zero else f"{told}.",)
            if full
            else ("There are none.",)
        )
        return replace(step, why=why, result=tuple(shown), entries=())

    def coriolis_entries(self, step: Step) -> Step:
        """All entries of C, which say nothing new."""
        return replace(
            step,
            id="C_entries",
            title="The entries of the Coriolis matrix",
            why=(),
            formula=None,
            result=(equation(letters.C, self._C),),
            notes=(),
            detail=Detail.FULL,
            uses=("C",),
        )

    @cached_property
    def _C(self) -> tree.Matrix:
        """C in the names of the symbols."""
        return coriolis_matrix(self.formulas.coordinates, self._c)

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
        if not rows:
            return replace(step, result=())
        zero = any(value == ZERO for value in symbols.values())
        note: Prose = ("They are listed with i ≤ j", "; of these, all others are zero." if zero else ".")
        return replace(step, why=self._on_symbols(), result=rows, listed=True, notes=(note,))

    def _on_symbols(self) -> Prose:
        """What halves the symbols, and why many are each other's opposites."""
        c = partial(_with_indices, "c")
        why: Prose = (equation(c("ijk"), c("jik")), ", for ", letters.D, " is symmetric. ")
        opposite = equation(c("ijk"), Negative(c("ikj")))
        if is_carried_along(self.context):
            entry, coordinate = _with_indices("d", "jk"), Letter("q", Symbol("i"))
            why += ("Joint i moves the links from i on like one body, so ", entry, " does not depend on ")
            why += (coordinate, " where i ≤ j and i ≤ k; there ", opposite, ". ")
        return (*why, "Symbols that are equal, or each other's opposites, stand in one line.")


def _with_indices(letter: str, indices: str) -> Letter:
    """c_ijk"""
    return Letter(letter, Row(tuple(map(Symbol, indices))))


def _of_the_bodies() -> Prose:
    """Why D is a sum over the bodies."""
    return (
        "In the kinetic energies the velocities are Jacobians times ",
        letters.QD,
        ", so ",
        equation(letters.K, _QUADRATIC),
        " with a sum over the bodies. ",
    )


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
    """c_121 = -c_112 = ... = value, in the order of the names, of which the first has a plus"""
    return equation(*(name if s > 0 else Negative(name) for s, name in named), value)


def _with(step: Step, result: Node, *more: str | Node) -> Step:
    """The step with a result in names, and what there is to say about it."""
    why: Prose = (*step.why, *more)
    return replace(step, result=(result,), why=why)
