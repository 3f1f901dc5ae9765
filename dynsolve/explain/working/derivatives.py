"""The lines of derivatives: d/dt of a momentum, ∂L/∂q, the slopes of D, Ḋ.

A line is spent where there is something to see: several factors vary, or an identity is used.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import combinations_with_replacement, product
from math import prod

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.ring import Expr
from dynsolve.document import Prose, Reference
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.step import Line
from dynsolve.explain.working.identities import (
    SILENT,
    SORTED,
    Identity,
    Tactic,
    Way,
    are_alike,
    by,
    chain,
    identities,
    opened_squares,
    proved,
    said,
)
from dynsolve.explain.working.squares import products_of_rates, rates_named
from dynsolve.explain.writing import listed, sum_of
from dynsolve.notation.build import times, total
from dynsolve.notation.differentiation import (
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
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    ZERO,
    Entry,
    Negative,
    Node,
    Number,
    Parenthesized,
    Product,
    Sum,
    Symbol,
    equation,
    walk,
)
from dynsolve.quantities import letters
from dynsolve.robot.model import Coordinate


class _Derivative(Struct, frozen=True):
    """A derivative as it is differentiated, multiplied out, and collected, and what leads to that."""

    tree: Node
    expanded: Node
    form: Node
    used: tuple[Identity, ...] = ()
    by_product_rule: bool = False

    @property
    def is_a_look(self) -> bool:
        """Whether it is written down as it is printed."""
        return self.tree == self.form


def _derivative(context: Context, of: Node, rule: Rule, value: Expr, form: Node) -> _Derivative:
    """The derivative of a formula; its form alone where that is a look, or the lines are not proved."""
    decimal = context.robot.has_decimals
    found = differentiated(of, rule, decimal=decimal)
    expanded = multiplied_out(found.tree, brackets(form), decimal=decimal)
    if are_alike(found.tree, form) or proved(value, [("", found.tree), ("", expanded)]) is None:
        return _Derivative(form, form, form)
    used = identities(value.ring, found.tree, form) or ()
    return _Derivative(found.tree, expanded, form, used, found.by_product_rule)


def momentum_rate(context: Context, q: Coordinate) -> Way:
    """From ∂L/∂q̇ to its derivative with respect to time."""
    left = formula("d/dt ∂ℒ/∂{rate}", rate=letters.velocity(q))
    return _way(context, f"dLdqd{q.index}", by_time(context.robot.ring.names), f"ddt{q.index}", left)


def coordinate_derivative(context: Context, q: Coordinate) -> Way:
    """From L to ∂L/∂q."""
    left = formula("∂ℒ/∂{q}", q=Symbol(q.name))
    return _way(context, "L", by_symbol(Symbol(q.name)), f"dLdq{q.index}", left)


def _way(context: Context, name: str, rule: Rule, result: str, left: Node) -> Way:
    if not context.is_short:
        return SILENT
    found = _derivative(context, context.form(name), rule, context.values[result], context.form(result))
    if found.is_a_look:
        return SILENT
    tactics: list[Tactic] = [("Term by term:", found.tree)]
    last = found.expanded
    if last != found.tree and sums_of_rates(last) - sums_of_rates(found.form):
        last = by_rates(last, decimal=context.robot.has_decimals)
        tactics.append((SORTED if isinstance(last, Sum) else "Multiplied out:", last))
    elif last != found.tree:
        tactics.append(("Multiplied out:", last))
    opened = {each for each in brackets(last) if has_rates(each)} - brackets(found.form)
    is_opened = opened and not found.used and _count_of_terms(last) == _count_of_terms(found.form)
    concluding = by("Multiplied out" if is_opened else "Collected", found.used)
    return chain(context, result, left, tactics, concluding)


def cancelling(context: Context, q: Coordinate) -> Prose:
    """Which products of rates stand in d/dt ∂L/∂q̇ and in ∂L/∂q, and no longer in the force."""
    if not context.is_short:
        return ()
    ring = context.robot.ring
    rate, slope = context.values[f"ddt{q.index}"], context.values[f"dLdq{q.index}"]
    both = products_of_rates(ring, rate.poly) & products_of_rates(ring, slope.poly)
    gone = both - products_of_rates(ring, (rate - slope).poly)
    named = rates_named(ring, [product for product in gone if sum(product) == 2], by_name=True)
    return say("The terms with {named} cancel:", named=listed(named)) if named else ()


MOST_AT_A_LOOK = 2
"""The terms of a potential energy whose derivatives are a look, if no product rule is needed."""


def gravity_rows(context: Context) -> tuple[Line, ...]:
    """g_k = ∂P/∂q_k as it is differentiated, and collected, where one of them asks for more than a look."""
    if not context.is_short:
        return ()
    P, g = context.form("P"), [entry for (entry,) in context.matrix("g").rows]
    has_few_terms = _count_of_terms(P) <= MOST_AT_A_LOOK
    rows: list[Node] = []
    used: list[Identity] = []
    for q, value, form in zip(context.robot.coordinates, context.values["g"].entries, g, strict=True):
        found = _derivative(context, P, by_symbol(Symbol(q.name)), value, form)
        if not found.is_a_look and (found.by_product_rule or not has_few_terms):
            used += found.used
            rows.append(equation(letters.entry("g", q.index), found.tree, form))
    if not rows:
        return ()
    zero = [q for q, form in zip(context.robot.coordinates, g, strict=True) if form == ZERO]
    absent = say(
        "; {names} {do} not occur in $𝒫$, so ${none}$",
        names=listed([Symbol(q.name) for q in zero]),
        do="does" if len(zero) == 1 else "do",
        none=equation(*(letters.entry("g", q.index) for q in zero), ZERO),
    )
    words = say(
        "Term by term, and collected{used}{absent}:",
        used=say(" with {used}", used=said(list(dict.fromkeys(used)))) if used else "",
        absent=absent if zero else "",
    )
    return (Line(words, tuple(rows)),)


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
    """The slopes ∂d_ij/∂q_k that are not zero, where one is more than a look, or two meet in a c_ijk."""
    if not context.is_short:
        return SILENT
    ring, D, forms = context.robot.ring, context.values["D"], context.matrix("D").rows
    shown: list[Node] = []
    found: list[_Derivative] = []
    for i, j, q in varying(context):
        value = ring.diff(D[i, j], q.index - 1)
        slope = _derivative(context, forms[i][j], by_symbol(Symbol(q.name)), value, context.show(value))
        named = _slope_in_names(context, i, j, q.index - 1)
        ways = (_slope(i, j, q), slope.tree, slope.expanded, slope.form, *named)
        shown.append(equation(*dict.fromkeys(ways)))
        found.append(slope)
    indices = (
        (i, j, k)
        for i, j in combinations_with_replacement(range(context.robot.n), 2)
        for k in range(context.robot.n)
    )
    meet = any(sum(map(bool, weights(context, *ijk).values())) > 1 for ijk in indices)
    is_work = any(each.by_product_rule or each.used for each in found)
    is_named = context.by_energies and "christoffel" in context.introduced  # no force has them
    if not (meet or is_work or is_named):
        return SILENT
    used = dict.fromkeys(identity for each in found for identity in each.used)
    words = say(
        "The derivatives of $𝐃$ that are not zero, term by term{multiplied}{collected}{used}:",
        multiplied=", multiplied out" if any(each.expanded != each.tree for each in found) else "",
        collected=", and collected" if not all(each.is_a_look for each in found) else "",
        used=say(" with {used}", used=said(list(used))) if used else "",
    )
    return Way((Line(words, tuple(shown), label=SLOPES),), ("Put into the formula:",))


Slope = tuple[tuple[int, int], int]
"""((a, b), c) of ∂d_ab/∂q_c, a ≤ b, from 0."""


def weights(context: Context, i: int, j: int, k: int) -> dict[Slope, int]:
    """How often each slope ∂d_ab/∂q_c that is not zero, a ≤ b, occurs in twice c_ijk; 0 where two cancel."""
    ring, D = context.robot.ring, context.values["D"]
    weights: dict[Slope, int] = {}
    for (row, col), variable, sign in (((k, j), i, 1), ((k, i), j, 1), ((i, j), k, -1)):
        if not ring.diff(D[row, col], variable).is_zero:
            key = ((min(row, col), max(row, col)), variable)
            weights[key] = weights.get(key, 0) + sign
    return weights


def _slope(i: int, j: int, q: Coordinate) -> Node:
    """∂d_ij/∂q"""
    return letters.partial_derivative(letters.entry("d", i + 1, j + 1), Symbol(q.name))


def _slope_in_names(context: Context, i: int, j: int, k: int) -> tuple[Node, ...]:
    """∂d_ij/∂q_k = c_kji + c_kij, of indices from 0, where each of these is a name that is known, not h."""
    if context.names is None or context.names.single is not None:
        return ()
    own = {*context.names.of_symbols} - {*context.introduced.get("christoffel", ())}
    both = [node for node in (context.symbol(k, j, i), context.symbol(k, i, j)) if node != ZERO]
    if not {part for part in walk(*both) if isinstance(part, Symbol)} <= {one.name for one in own}:
        return ()
    return (times(2, [(both[0], 1)]) if both[1:] == both[:1] else total(both),)


def varying(context: Context) -> Iterator[tuple[int, int, Coordinate]]:
    """(i, j, q) with i ≤ j and ∂d_ij/∂q not zero."""
    ring, D = context.robot.ring, context.values["D"]
    for i, j in combinations_with_replacement(range(context.robot.n), 2):
        for q in context.robot.coordinates:
            if not ring.diff(D[i, j], q.index - 1).is_zero:
                yield i, j, q


def inertia_rate(
    context: Context, written: Callable[[int, int], Node] | None = None, used: tuple[str, ...] = ("D",)
) -> tuple[Line, ...]:
    """ḋ_ij = Σ_k ∂d_ij/∂q_k q̇_k, for the entries of D that vary, before N; `written` writes its value."""
    if not context.is_short:
        return ()
    ring, D, n = context.robot.ring, context.values["D"], context.robot.n
    rates: dict[tuple[int, int], list[Node]] = {}
    for i, j, q in varying(context):
        rates.setdefault((i, j), []).append(Product((_slope(i, j, q), letters.velocity(q))))
    if not rates:
        return ()
    written = written or (lambda i, j: context.show(ring.time_derivative(D[i, j])))
    shown = []
    for (i, j), terms in rates.items():  # ḋ_ij, and ḋ_ji where it is another entry
        names = [
            replace(letters.entry("d", r + 1, c + 1), dots=1) for r, c in dict.fromkeys(((i, j), (j, i)))
        ]
        value = () if context.leaves_values_out else (written(i, j),)
        shown.append(equation(*names, sum_of(terms), *value))
    left = [place for place in combinations_with_replacement(range(n), 2) if place not in rates]
    fixed: Prose = ()
    if left:
        one = "; {entry} is constant" if len(left) == 1 else "; the other entries are constant"
        fixed = say(one, entry=letters.entry("d", *(i + 1 for i in left[0])))
    words = say(
        "The rate of $𝐃$ by the chain rule, entry by entry{fixed}; then $𝐍$ with $𝐂${C}:",
        fixed=fixed,
        C=Reference(("C",)),
    )
    return (Line(words, tuple(shown), (SLOPES,) if slopes(context).lines else used),)


# -- the entries of C ------------------------------------------------------------------------------


def coriolis_sums(context: Context) -> tuple[Line, ...]:
    """C_kj = Σ_i c_ijk q̇_i, with the symbols that are not zero, for each entry that is not zero."""
    n, rates = context.robot.n, [letters.velocity(q) for q in context.robot.coordinates]
    if not context.is_short or context.values["C"].is_zero:
        return ()
    shown = []
    for k, j in product(range(n), repeat=2):
        terms = [
            Product((letters.entry("c", i + 1, j + 1, k + 1), rates[i]))
            for i in range(n)
            if not _is_zero(context, i, j, k)
        ]
        if terms:
            shown.append(equation(letters.entry("c", k + 1, j + 1), sum_of(terms)))
    return (Line(("The sums, without what is zero:",), tuple(shown)),)


def coriolis_rows(context: Context) -> tuple[Line, ...]:
    """(C q̇)_k = Σ c_ijk q̇_i q̇_j, row by row, those that are not zero; behind h what it means."""
    n, rates = context.robot.n, [letters.velocity(q) for q in context.robot.coordinates]
    if not context.is_short or context.values["C"].is_zero:
        return ()

    def quadratic(symbol: Node, i: int, j: int) -> Node:
        """c_iik q̇_i², or 2 c_ijk q̇_i q̇_j: once for c_ijk, once for c_jik."""
        powers = [(rates[i], 2)] if i == j else [(rates[i], 1), (rates[j], 1)]
        return times(1 if i == j else 2, [(symbol, 1), *powers])

    whole, names = formula("𝐂 𝐪̇"), context.names
    shown = []
    for k, (read_off,) in enumerate(context.matrix("Cqd").rows):
        pairs = [
            (i, j) for i, j in combinations_with_replacement(range(n), 2) if not _is_zero(context, i, j, k)
        ]
        if not pairs:
            continue
        values = [] if context.leaves_values_out else [context.named(read_off)]
        if names is not None and names.at_symbols:
            terms = {(i, j): quadratic(names.symbol(i, j, k), i, j) for i, j in pairs}
            values = [total(list(terms.values())), *(values if names.single else [])]
            pairs = _in_the_order_of(values[0], terms)
        by_symbols = total([quadratic(letters.entry("c", i + 1, j + 1, k + 1), i, j) for i, j in pairs])
        row = Entry(whole, Number(k + 1)) if n > 1 else whole
        shown.append(equation(row, by_symbols, *values))
    return (Line(say("{rows}$𝐂 𝐪̇$, multiplied out:", rows="The rows of " if n > 1 else ""), tuple(shown)),)


def _in_the_order_of(value: Node, terms: Mapping[tuple[int, int], Node]) -> list[tuple[int, int]]:
    """The places of the terms of a sum as they stand in it, so that both sides of = have one order."""
    shown = value.terms if isinstance(value, Sum) else (value,)
    is_whole = set(shown) == set(terms.values())
    return sorted(terms, key=lambda place: shown.index(terms[place])) if is_whole else list(terms)


def _is_zero(context: Context, i: int, j: int, k: int) -> bool:
    return bool(context.values["christoffel"][min(i, j), max(i, j), k].is_zero)


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
    before = sum_of([form for form in map(context.form, parts) if form != ZERO])
    after = context.form(result)
    used = identities(context.robot.ring, before, after)
    opened = opened_squares(before, after)
    new_brackets = {each for each in brackets(after) - brackets(before) if not has_rates(each)}
    is_bracketed = bool(brackets(before) - brackets(after) and new_brackets)
    is_sorted = numbers_in(after) <= numbers_in(before) and not is_bracketed
    is_seen = are_alike(before, after) or (stand_above and is_sorted)
    if is_seen and not (used or opened):
        return SILENT
    operation: str | Prose = "Collected"
    if opened:
        operation = "The squares of sums multiplied out, and collected"
    if len(opened) == 1:
        operation = say("The square {square} multiplied out, and collected", square=opened[0])
    way = chain(context, result, name, [((), before)], by(operation, used or ()))
    return replace(way, used=used or ())


def numbers_in(node: Node) -> set[Node]:
    """The numbers that stand in a tree."""
    return {part for part in walk(node) if isinstance(part, Number)}
