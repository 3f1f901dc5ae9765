"""The lines of derivatives: d/dt of a momentum, ∂L/∂q, the slopes of D, Ḋ.

A line is spent where there is something to see: several factors vary, or an identity is used.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import prod

from dynsolve.algebra.expr import Expr
from dynsolve.document import Prose, Reference
from dynsolve.explain.context import Context
from dynsolve.explain.forms import is_numeric
from dynsolve.explain.step import Line
from dynsolve.explain.working.differentiation import (
    Rule,
    brackets,
    by_rates,
    by_symbol,
    by_time,
    differentiated,
    has_rates,
    multiplied_out,
    sums_of_rates,
)
from dynsolve.explain.working.identities import SILENT, Identity, Tactic, Way, chain, equals, identities, said
from dynsolve.explain.writing import listed, sum_of
from dynsolve.notation.build import times, total
from dynsolve.notation.tree import (
    ZERO,
    Entry,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Sum,
    Symbol,
    equation,
)
from dynsolve.notation.walk import mapped, walk
from dynsolve.quantities import letters
from dynsolve.robot.model import Coordinate, Robot


def momentum_rate(context: Context, q: Coordinate) -> Way:
    """From ∂L/∂q̇ to its derivative with respect to time."""
    left = letters.time_derivative(letters.partial_derivative(letters.L, letters.velocity(q)))
    rule = by_time(context.robot.ring.names)
    return _way(context, f"dLdqd{q.index}", rule, f"ddt{q.index}", left, "Term by term:")


def coordinate_derivative(context: Context, q: Coordinate) -> Way:
    """From L to ∂L/∂q."""
    left = letters.partial_derivative(letters.L, Symbol(q.name))
    return _way(context, "L", by_symbol(Symbol(q.name)), f"dLdq{q.index}", left, "Term by term:")


def _way(context: Context, name: str, rule: Rule, result: str, left: Node, by: str) -> Way:
    if not context.is_short:
        return SILENT
    value, form = context.values[result], context.form(result)
    found = differentiated(context.form(name), rule, decimal=is_numeric(context.robot))
    used = identities(value.ring, found.tree, form)
    if are_alike(found.tree, form):
        return SILENT
    lines: list[Tactic] = [((by,), found.tree)]
    expanded = multiplied_out(found.tree, decimal=is_numeric(context.robot))
    if expanded != found.tree:
        lines.append(_expanded(context, expanded, form))
    last = _collected(used) if used else _opened_or_collected(lines[-1][1], form)
    return chain(context, result, left, lines, last)


def _opened_or_collected(before: Node, after: Node) -> Prose:
    """What leads to the result: brackets that hold rates multiplied out, or more than that."""
    opened = {each for each in brackets(before) if has_rates(each)} - brackets(after)
    if opened and _count_of_terms(before) == _count_of_terms(after):
        return ("Multiplied out:",)
    return _collected(())


def _expanded(context: Context, expanded: Node, form: Node) -> tuple[Prose, Node]:
    """A derivative multiplied out; by the products of rates too, where the result is sorted by these."""
    if not sums_of_rates(expanded) - sums_of_rates(form):
        return ("Multiplied out:",), expanded
    return ("Multiplied out, and sorted by the products of the rates:",), by_rates(
        expanded, decimal=is_numeric(context.robot)
    )


def cancelling(context: Context, q: Coordinate) -> Prose:
    """Which products of rates stand in d/dt ∂L/∂q̇ and in ∂L/∂q, and no longer in the force."""
    if not context.is_short:
        return ()
    ring = context.robot.ring
    rate, slope = context.values[f"ddt{q.index}"], context.values[f"dLdq{q.index}"]
    gone = (_rates(rate) & _rates(slope)) - _rates(rate - slope)
    products = [
        product
        for j, first in enumerate(ring.names)
        for k, second in enumerate(ring.names[j:], j)
        if (product := frozenset({(first, 1), (second, 1)} if j < k else {(first, 2)})) in gone
    ]
    if not products:
        return ()
    named = [times(1, [(Symbol(name, 1), power) for name, power in sorted(each)]) for each in products]
    return ("The terms with ", *listed(named), " cancel:")


def _rates(x: Expr) -> set[frozenset[tuple[str, int]]]:
    """The products of rates that occur in an expression: each rate with its power."""
    places = [(name, x.ring.symbol_indices[(name, 1)]) for name in x.ring.names]
    return {frozenset((name, int(e[i])) for name, i in places if e[i]) for e in x.poly.to_dict()}


def are_alike(left: Node, right: Node) -> bool:
    """Whether two trees are the same but for the order of terms and factors."""
    return mapped(left, _ordered) == mapped(right, _ordered)


def _ordered(node: Node) -> Node:
    match node:
        case Sum(terms):
            flat = [part for term in terms for part in (term.terms if isinstance(term, Sum) else (term,))]
            return Sum(tuple(sorted(flat, key=repr)))
        case Product(factors):
            return Product(tuple(sorted(factors, key=repr)))
    return node


def _collected(used: Sequence[Identity]) -> Prose:
    return ("Collected, with ", *said(used), ":") if used else ("Collected:",)


MOST_AT_A_LOOK = 2
"""The terms of a potential energy whose derivatives are a look, if no product rule is needed."""


def gravity_rows(context: Context) -> tuple[Line, ...]:
    """g_k = ∂P/∂q_k as it is differentiated, and collected, where one of them asks for more than a look."""
    if not context.is_short:
        return ()
    P, g, decimal = context.form("P"), context.matrix("g"), is_numeric(context.robot)
    has_few_terms = _count_of_terms(P) <= MOST_AT_A_LOOK
    rows: list[Node] = []
    used: dict[Identity, None] = {}
    for q, (form,) in zip(context.robot.coordinates, g.rows, strict=True):
        value = context.values["g"][q.index - 1, 0]
        slope = differentiated(P, by_symbol(Symbol(q.name)), decimal=decimal)
        if are_alike(slope.tree, form) or (has_few_terms and not slope.by_product_rule):
            continue
        found = identities(value.ring, slope.tree, form)
        if found is None or not equals(slope.tree, value):
            return ()
        used |= dict.fromkeys(found)
        rows.append(equation(letters.entry("g", q.index), slope.tree, form))
    if not rows:
        return ()
    by: Prose = ("Term by term, and collected", *((" with ", *said(list(used))) if used else ()))
    zero = [q for q, (form,) in zip(context.robot.coordinates, g.rows, strict=True) if form == ZERO]
    if zero:
        do = "does" if len(zero) == 1 else "do"
        by += ("; ", *listed([Symbol(q.name) for q in zero]), f" {do} not occur in ", letters.P, ", so ")
        by += (equation(*(letters.entry("g", q.index) for q in zero), ZERO),)
    return (Line((*by, ":"), tuple(rows)),)


def _count_of_terms(node: Node) -> int:
    """How many terms a formula has with its brackets opened."""
    match node:
        case Sum(terms):
            return sum(map(_count_of_terms, terms))
        case Product(factors):
            return prod(map(_count_of_terms, factors))
        case Negative(argument) | Parenthesized(argument):
            return _count_of_terms(argument)
    return 1


# -- the derivatives of D --------------------------------------------------------------------------


SLOPES = "slopes-of-D"
"""The label of the derivatives of D, where they have lines of their own."""


def slopes(context: Context) -> Way:
    """The slopes ∂d_ij/∂q_k that are not zero, where one of them asks for more than a look."""
    if not context.is_short:
        return SILENT
    found = [_differentiated(context, *place) for place in varying(context)]
    if not any(each.asks_for_more for each in found):
        return SILENT
    used = list(dict.fromkeys(identity for each in found for identity in each.used))
    by: Prose = ("The derivatives of ", letters.D, " that are not zero, term by term")
    by += (", multiplied out",) if any(each.is_multiplied_out for each in found) else ()
    by += (", and collected",) if any(len(each.members) > 2 for each in found) else ()
    by += (" with ", *said(used), ":") if used else (":",)
    shown = tuple(equation(*each.members) for each in found)
    return Way((Line(by, shown, label=SLOPES),), ("Put into the formula:",))


@dataclass(frozen=True, slots=True)
class _Slope:
    """∂d_ij/∂q_k: its name, as it is differentiated, multiplied out, and collected; a line each."""

    members: tuple[Node, ...]
    used: tuple[Identity, ...] = ()
    asks_for_more: bool = False
    is_multiplied_out: bool = False


def _differentiated(context: Context, i: int, j: int, q: Coordinate) -> _Slope:
    """The lines of a derivative of an entry of D; its value alone where that is a look."""
    value = context.robot.ring.diff(context.values["D"][i, j], q.index - 1)
    form, decimal = context.show(value), is_numeric(context.robot)
    found = differentiated(context.matrix("D").rows[i][j], by_symbol(Symbol(q.name)), decimal=decimal)
    used = identities(value.ring, found.tree, form) or ()
    if are_alike(found.tree, form) or not equals(found.tree, value):
        return _Slope((_slope(i, j, q), form))
    expanded = multiplied_out(found.tree, decimal=decimal)
    members = dict.fromkeys((_slope(i, j, q), found.tree, expanded, form))
    more = found.by_product_rule or bool(used)
    return _Slope(tuple(members), used, more, expanded != found.tree)


def _slope(i: int, j: int, q: Coordinate) -> Node:
    """∂d_ij/∂q"""
    return letters.partial_derivative(letters.entry("d", i + 1, j + 1), Symbol(q.name))


def varying(context: Context) -> Iterator[tuple[int, int, Coordinate]]:
    """(i, j, q) with i ≤ j and ∂d_ij/∂q not zero."""
    ring, D = context.robot.ring, context.values["D"]
    for i in range(context.robot.n):
        for j in range(i, context.robot.n):
            for q in context.robot.coordinates:
                if not ring.diff(D[i, j], q.index - 1).is_zero:
                    yield i, j, q


def inertia_rate(
    context: Context, written: Callable[[int, int], Node] | None = None, used: tuple[str, ...] = ("D",)
) -> tuple[Line, ...]:
    """ḋ_ij = Σ_k ∂d_ij/∂q_k q̇_k, for the entries of D that vary, before N; `written` writes its value."""
    if not context.is_short:
        return ()
    ring, D = context.robot.ring, context.values["D"]
    rates: dict[tuple[int, int], list[Node]] = {}
    for i, j, q in varying(context):
        rates.setdefault((i, j), []).append(Product((_slope(i, j, q), letters.velocity(q))))
    if not rates:
        return ()
    written = written or (lambda i, j: context.show(ring.time_derivative(D[i, j])))
    shown = [equation(*_rate_names(i, j), sum_of(terms), written(i, j)) for (i, j), terms in rates.items()]
    by: Prose = (
        "The rate of ",
        letters.D,
        " by the chain rule, entry by entry",
        *_kept(context, set(rates)),
        "; then ",
        letters.bold("N"),
        " with ",
        letters.C,
        Reference(("C",)),
        ":",
    )
    told = (SLOPES,) if slopes(context).lines else used
    return (Line(by, tuple(shown), told),)


def _kept(context: Context, varying: set[tuple[int, int]]) -> Prose:
    """Which entries of D have no rate: the one that is left, or the others."""
    n = context.robot.n
    left = [(i, j) for i in range(n) for j in range(i, n) if (i, j) not in varying]
    if len(left) > 1:
        return ("; the other entries are constant",)
    return tuple(part for i, j in left for part in ("; ", letters.entry("d", i + 1, j + 1), " is constant"))


def _rate_names(i: int, j: int) -> tuple[Node, ...]:
    """ḋ_ij, and ḋ_ji where it is another entry."""
    both = dict.fromkeys(((i, j), (j, i)))
    return tuple(replace(letters.entry("d", r + 1, c + 1), dots=1) for r, c in both)


# -- the entries of C ------------------------------------------------------------------------------


def coriolis_sums(context: Context) -> tuple[Line, ...]:
    """C_kj = Σ_i c_ijk q̇_i, with the symbols that are not zero, for each entry that is not zero."""
    n, robot = context.robot.n, context.robot
    if not context.is_short or context.values["C"].is_zero:
        return ()
    shown = []
    for k in range(n):
        for j in range(n):
            moving = [i for i in range(n) if not _symbol(context, i, j, k).is_zero]
            terms = [
                Product((letters.entry("c", i + 1, j + 1, k + 1), letters.velocity(robot.coordinates[i])))
                for i in moving
            ]
            if terms:
                shown.append(equation(letters.entry("c", k + 1, j + 1), sum_of(terms)))
    return (Line(("The sums, without what is zero:",), tuple(shown)),)


def coriolis_rows(
    context: Context, named: Callable[[int, int, int], Node] | None = None, *, written_out: bool = False
) -> tuple[Line, ...]:
    """(C q̇)_k = Σ c_ijk q̇_i q̇_j, row by row, those that are not zero.

    `named` has other names for c_ijk; behind these what they mean is `written_out`.
    """
    n, robot = context.robot.n, context.robot
    if not context.is_short or context.values["C"].is_zero:
        return ()
    rows = context.matrix("Cqd").rows
    product = Product((letters.C, letters.QD))
    shown = []
    for k in range(n):
        pairs = [(i, j) for i in range(n) for j in range(i, n) if not _symbol(context, i, j, k).is_zero]
        if pairs:
            whole = Entry(product, Number(k + 1)) if n > 1 else product
            value = rows[k][0]
            if named is not None:
                terms = {(i, j): _quadratic(robot, named(i, j, k), i, j) for i, j in pairs}
                value = total(list(terms.values()))
                pairs = _in_the_order_of(value, terms)
            by_symbols = total(
                [_quadratic(robot, letters.entry("c", i + 1, j + 1, k + 1), i, j) for i, j in pairs]
            )
            shown.append(equation(whole, by_symbols, value, *([rows[k][0]] if written_out else [])))
    by = f"{'The rows of ' if n > 1 else ''}"
    return (Line((by, product, ", multiplied out:"), tuple(shown)),)


def _in_the_order_of(value: Node, terms: Mapping[tuple[int, int], Node]) -> list[tuple[int, int]]:
    """The places of the terms of a sum as they stand in it, so that both sides of = have one order."""
    shown = value.terms if isinstance(value, Sum) else (value,)
    is_whole = set(shown) == set(terms.values())
    return sorted(terms, key=lambda place: shown.index(terms[place])) if is_whole else list(terms)


def _quadratic(robot: Robot, symbol: Node, i: int, j: int) -> Node:
    """c_iik q̇_i², or 2 c_ijk q̇_i q̇_j: once for c_ijk, once for c_jik."""
    first, second = (letters.velocity(robot.coordinates[place]) for place in (i, j))
    rates = [(first, 2)] if i == j else [(first, 1), (second, 1)]
    return times(1 if i == j else 2, [(symbol, 1), *rates])


def _symbol(context: Context, i: int, j: int, k: int) -> Expr:
    """c_ijk, the same as c_jik."""
    found: Expr = context.values["christoffel"][min(i, j), max(i, j), k]
    return found


# -- the lines from a sum of earlier results to what is printed ------------------------------------


def summed(
    context: Context, parts: Sequence[str], result: str, name: Node, *, stand_above: bool = False
) -> Way:
    """The plain sum of scalar quantities, and what it takes to collect it.

    Silent of longer arms, and where the terms are only sorted.  Of terms that `stand_above`, just
    before, the plain sum is shown where a square is opened, an identity used, numbers are added, or
    coefficients come together in a bracket.
    """
    if not context.is_short:
        return SILENT
    forms = [context.form(part) for part in parts]
    before, after = sum_of([form for form in forms if form != ZERO]), context.form(result)
    used = identities(context.robot.ring, before, after)
    opened = _squares_of_sums(before) - _squares_of_sums(after)
    is_sorted = numbers_in(after) <= numbers_in(before) and not _brackets_change(before, after)
    is_seen = are_alike(before, after) or (stand_above and is_sorted)
    if is_seen and not (used or opened):
        return SILENT
    by = _opened(opened) if opened else ("Collected",)
    by += (", with ", *said(used), ":") if used else (":",)
    return chain(context, result, name, [((), before)], by)


def _opened(squares: Collection[Node]) -> Prose:
    """Which square of a sum is multiplied out."""
    if len(squares) > 1:
        return ("The squares of sums multiplied out, and collected",)
    return ("The square ", *squares, " multiplied out, and collected")


def numbers_in(node: Node) -> set[Node]:
    """The numbers that stand in a tree."""
    return {part for part in walk(node) if isinstance(part, Number)}


def _brackets_change(before: Node, after: Node) -> bool:
    """Whether brackets of the terms are opened, and coefficients come together in new ones."""
    first, last = brackets(before), brackets(after)
    new = {each for each in last - first if not has_rates(each)}
    return bool(first - last and new)


def _squares_of_sums(node: Node) -> set[Node]:
    """The powers of sums that stand in a tree."""
    return {part for part in walk(node) if isinstance(part, Power) and isinstance(part.base, Sum)}
