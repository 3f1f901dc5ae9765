"""Names for the Christoffel symbols of an arm whose C would fill half a page: σ₁, σ₂, ...

What recurs in the energies already is named there (`inertia_names`), and the symbols are written by that.

Symbols are equal, or opposite, again and again: c_112 = -c_121.  A textbook names such a value
once, as h of the planar elbow in Spong, Hutchinson, Vidyasagar, section 7.4; C, Ḋ and
N = Ḋ - 2C are short sums of names and rates.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from math import gcd

from dynsolve.algebra.expr import Expr
from dynsolve.document import Inline
from dynsolve.explain.abbreviations import RECURRING, Abbreviated, Index, free_names
from dynsolve.explain.agreement import compared_rows
from dynsolve.explain.closing import rows_in_names
from dynsolve.explain.context import Context
from dynsolve.explain.entry_formulas import coriolis_matrix
from dynsolve.explain.forms import Forms
from dynsolve.explain.inertia_names import InertiaNames, name_inertias
from dynsolve.explain.recurring import Definition
from dynsolve.explain.short_arms import is_short
from dynsolve.explain.step import Line, Step
from dynsolve.explain.terms import Kind, Term, name_of_term, rates_of, terms_of
from dynsolve.explain.working.derivatives import inertia_rate
from dynsolve.notation import tree
from dynsolve.notation.build import cost, negated, split_sign, times, total
from dynsolve.notation.printing import flat_factors
from dynsolve.notation.tree import ZERO, Matrix, Negative, Node, Relation, Sum, equation
from dynsolve.notation.walk import with_children
from dynsolve.quantities import letters

LONG = 50
"""The operations of C from which on its symbols get names: it would not fit the page as a matrix."""

NAMES = "symbol-names"
"""The label of the names' definitions."""

SHORTEST = 4
"""The operations from which on a symbol is worth a name."""


def name_symbols(forms: Forms) -> Abbreviated | None:
    """The model with names for its Christoffel symbols, and for long sums of masses and lengths in it.

    None where it is short without, or the arm longer.
    """
    robot, C = forms.robot, forms("C")
    if not is_short(robot, forms.values) or not isinstance(C, Matrix):
        return None
    free = free_names(RECURRING, {*robot.ring.parameters, *robot.ring.names})
    inertias = name_inertias(forms, free)
    is_long = sum(cost(inertias.put(entry)) for row in C.rows for entry in row) >= LONG
    definitions, symbols = _named(forms, inertias, free) if is_long else ((), _written(forms, inertias))
    if not (inertias.definitions or definitions):
        return None
    D, g = inertias.put(forms("D")), inertias.put(forms("g"))
    assert isinstance(D, Matrix) and isinstance(g, Matrix)
    C = coriolis_matrix(robot.ring.names, lambda i, j, k: symbols[min(i, j), max(i, j), k])
    sums = (*inertias.definitions, *definitions)
    return Abbreviated((), sums, D, C, g, symbols, at_symbols=True, inertias=inertias)


def _written(forms: Forms, inertias: InertiaNames) -> dict[Index, Node]:
    """The symbols without names of their own."""
    return {ijk: inertias.put(forms.christoffel(*ijk)) for ijk in forms.values["christoffel"]}


def _named(
    forms: Forms, inertias: InertiaNames, free: Iterator[tree.Symbol]
) -> tuple[tuple[Definition, ...], dict[Index, Node]]:
    """The definitions, in the order in which the symbols are shown, and every symbol by them."""
    values: Mapping[Index, Expr] = forms.values["christoffel"]
    order = sorted(values, key=lambda ijk: (ijk[2], ijk[0], ijk[1]))
    namer = _Namer(lambda value: inertias.put(forms.of(value)), [values[key] for key in order], free)
    symbols = {key: namer.written(values[key]) for key in order}
    return tuple(namer.definitions), {key: symbols[key] for key in values}


class _Namer:
    """Gives a name to each symbol worth one; what has another one as factor or part is written by that."""

    def __init__(
        self, form: Callable[[Expr], Node], values: Sequence[Expr], names: Iterator[tree.Symbol]
    ) -> None:
        self.forms: dict[Expr, Node] = {}
        for value in values:
            if value not in self.forms and -value not in self.forms:
                self.forms[value] = form(value)
        self.definitions: list[Definition] = []
        self._names = names
        self._done: dict[Expr, Node] = {}

    def written(self, value: Expr) -> Node:
        """A symbol by its name, by that of another one, or as it is."""
        if value not in self.forms:
            return total([negated(self.written(-value))])
        found = self._done.get(value)
        if found is None:
            form = self.forms[value]
            found = form if cost(form) < SHORTEST else self._multiple(value) or self._named(self._sum(form))
            self._done[value] = found
        return found

    def _named(self, form: Node) -> Node:
        minus = _starts_with_minus(form)
        name = next(self._names)
        self.definitions.append(Definition(name, total([negated(form)]) if minus else form))
        return Negative(name) if minus else name

    def _multiple(self, value: Expr) -> Node | None:
        """The symbol as a product in which another one, worth a name, is a factor."""
        sign, inner = split_sign(self.forms[value])
        factors = Counter(_factors(inner))
        for other, form in self.forms.items():
            other_sign, part = split_sign(form)
            own = Counter(_factors(part))
            if cost(part) >= SHORTEST and own < factors:
                rest = [(factor, 1) for factor in (factors - own).elements()]
                return times(sign * other_sign, [(self.written(other), 1), *rest])
        return None

    def _sum(self, form: Node) -> Node:
        """A sum in which all terms of another symbol's stand, with the name of that in their place."""
        terms = _summands(form)
        for other, part in self.forms.items():
            for sign in (1, -1):
                own = _summands(part) if sign > 0 else tuple(map(negated, _summands(part)))
                if 1 < len(own) < len(terms) and set(own) <= set(terms):
                    rest = [term for term in terms if term not in own]
                    return total([*rest, times(sign, [(self.written(other), 1)])])
        return form


def _summands(node: Node) -> tuple[Node, ...]:
    return node.terms if isinstance(node, Sum) else (node,)


def _factors(node: Node) -> tuple[Node, ...]:
    return flat_factors(node) if isinstance(node, tree.Product) else (node,)


def _starts_with_minus(node: Node) -> bool:
    """Whether a form starts with a minus: of a sum, that every term has one."""
    return isinstance(node.terms[0] if isinstance(node, Sum) else node, Negative)


# -- the steps in these names ----------------------------------------------------------------------


def steps_with_symbols_named(steps: Iterable[Step], context: Context, short: Abbreviated) -> Iterator[Step]:
    """The steps in names: those of inertias from the kinetic energy on, those of symbols where these are."""
    changes: dict[str, Callable[[Step], Step]] = {
        "christoffel": lambda step: _christoffel(step, context, short),
        "C": lambda step: _by_names(_result_exchanged(step, {context.form("C"): short.C})),
        "model": lambda step: _model(step, context, short),
        "agreement": lambda step: _by_names(replace(step, lines=compared_rows(context, short.symbol))),
        "skew": lambda step: _skew(step, context, short),
        "terms": lambda step: _terms(step, context, short),
    }
    changed = (changes.get(step.id, _unchanged)(step) for step in steps)
    return changed if short.inertias is None else short.inertias.in_steps(changed)


def _unchanged(step: Step) -> Step:
    return step


def _by_names(step: Step) -> Step:
    """The step with the equation of the names among what it uses."""
    return replace(step, names=(NAMES,))


def _christoffel(step: Step, context: Context, short: Abbreviated) -> Step:
    """The symbols by their names, which are defined first."""
    named = {context.forms.christoffel(*ijk): symbol for ijk, symbol in short.christoffel.items()}
    step = _result_exchanged(step, named)
    own = _own_names(short)
    if not own:
        return step
    line = Line(
        ("What comes up several times below is named once:",),
        tuple(equation(definition.name, definition.meaning) for definition in own),
        label=NAMES,
    )
    return replace(step, lines=(*step.lines, line), concluding=("Put into the formula:",))


def _own_names(short: Abbreviated) -> tuple[Definition, ...]:
    """The names of symbols, after those of inertias."""
    early = () if short.inertias is None else short.inertias.definitions
    return short.sums[len(early) :]


def _result_exchanged(step: Step, named: Mapping[Node, Node]) -> Step:
    """The step with parts of its results exchanged."""

    def exchanged(node: Node) -> Node:
        found = named.get(node)
        if found is not None:
            return found
        inside = isinstance(node, Relation | Sum | tree.Product)
        return with_children(node, exchanged) if inside else node

    return replace(step, result=tuple(map(exchanged, step.result)))


def _model(step: Step, context: Context, short: Abbreviated) -> Step:
    """The model; its rows in the names of symbols, d_ij and g_k, where forces were derived before these."""
    step = _result_exchanged(step, {context.form("C"): short.C})
    return replace(step, lines=(rows_in_names(context, short.symbol),)) if _own_names(short) else step


def _skew(step: Step, context: Context, short: Abbreviated) -> Step:
    """Ḋ and N by the symbols: ∂d_kj/∂q_i = c_ijk + c_ikj, so that n_kj = Σ_i (c_ikj - c_ijk) q̇_i."""
    n, c = context.robot.n, short.symbol

    def entry(signs: tuple[int, int], k: int, j: int) -> Node:
        first, second = signs
        return _collected(
            term
            for i, q in enumerate(context.robot.coordinates)
            for term in ((first, c(i, j, k), letters.velocity(q)), (second, c(i, k, j), letters.velocity(q)))
        )

    rows = tuple(tuple(entry((-1, 1), k, j) for j in range(n)) for k in range(n))
    lines = inertia_rate(context, lambda i, j: entry((1, 1), i, j), (NAMES, "christoffel"))
    return replace(step, lines=lines, result=(equation(letters.bold("N"), Matrix(rows)), *step.result[-1:]))


def _collected(terms: Iterable[tuple[int, Node, Node]]) -> Node:
    """Σ factor · symbol · rate, the rates of each symbol in one sum."""
    rates: dict[Node, dict[Node, int]] = {}
    for factor, symbol, rate in terms:
        sign, name = split_sign(symbol)
        if name != ZERO:
            own = rates.setdefault(name, {})
            own[rate] = own.get(rate, 0) + sign * factor
    return total([_product(name, own) for name, own in rates.items()])


def _product(name: Node, rates: Mapping[Node, int]) -> Node:
    """name · Σ factor · rate, with what the factors share in front."""
    shared = gcd(*rates.values())
    if not shared:
        return ZERO
    if all(factor <= 0 for factor in rates.values()):
        shared = -shared
    inner = total([times(factor // shared, [(rate, 1)]) for rate, factor in rates.items()])
    return times(shared, [(name, 1), (inner, 1)])


def _terms(step: Step, context: Context, short: Abbreviated) -> Step:
    """The table of the terms of the forces, centrifugal and Coriolis terms by the names."""
    assert step.table is not None
    by_rates = (Kind.CENTRIFUGAL, Kind.CORIOLIS)
    named: dict[Node, Node] = {}
    for k in range(context.robot.n):
        for term in terms_of(context, k):
            if term.kind in by_rates:
                name = name_of_term(context, term)
                named[name] = equation(name, _by_name(context, short, term, k))

    def cell(part: Inline) -> Inline:
        left = part.parts[0] if isinstance(part, Relation) else part
        return named.get(left, part) if isinstance(left, Node) else part

    rows = tuple(tuple(map(cell, row)) for row in step.table.rows)
    return replace(step, table=replace(step.table, rows=rows))


def _by_name(context: Context, short: Abbreviated, term: Term, k: int) -> Node:
    """The value of a term of force k, its symbol by its name."""
    (i, _), (j, _) = term.rates
    return times(term.count, [(short.symbol(i, j, k), 1), *rates_of(context, term)])
