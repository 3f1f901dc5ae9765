"""The determinant of two coupled coordinates, from its formula to the value: d_aa d_bb - d_ab².

The square of an entry that is a sum is long.  Where it is shorter, row and column b are subtracted
from row and column a first: (d_aa - 2 d_ab + d_bb) d_bb - (d_ab - d_bb)² is the same, and what two
entries share is gone.  Of a robot in numbers nothing is gained by it: sums of numbers are numbers.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product

from dynsolve.algebra.compact.monomials import Monomial
from dynsolve.algebra.compact.terms import Rational
from dynsolve.algebra.expr import Expr
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.forms import is_numeric
from dynsolve.explain.step import Line
from dynsolve.explain.working.derivatives import are_alike
from dynsolve.explain.working.differentiation import product_of
from dynsolve.explain.working.identities import Identity, identities, said
from dynsolve.explain.working.kinetic import without_signs
from dynsolve.explain.working.proved import equals
from dynsolve.explain.writing import listed
from dynsolve.notation.build import cost, factors_of, negated, total
from dynsolve.notation.tree import (
    Function,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Sum,
    equation,
)
from dynsolve.quantities import letters

MOST_TERMS = 16
"""Up to this number of terms a determinant is multiplied out."""

LONGEST = 60
"""The operations of the entries up to which they are put in."""


OPERATIONS = ("the entries put in", "multiplied out", "collected")
"""What may be done to a determinant, in this order."""

_PUT_IN, MULTIPLIED_OUT, _COLLECTED = OPERATIONS


@dataclass(frozen=True, slots=True)
class Determinant:
    """The determinant of coupled coordinates: its members, by which operations, the identities of the last.

    `form` is its last member, `differences` what rows and columns leave that are subtracted first;
    of numbers, `cancelled` are the products of coordinates that cancel where all is multiplied out.
    """

    line: Node
    form: Node
    operations: tuple[str, ...] = ()
    used: tuple[Identity, ...] = ()
    differences: Line | None = None
    cancelled: tuple[Node, ...] = ()


def said_of(determinants: Sequence[Determinant]) -> Prose:
    """The entries put in, multiplied out, and collected with s₃² + c₃² = 1: what leads from line to line."""
    done = {operation for each in determinants for operation in each.operations}
    *first, last = [operation for operation in OPERATIONS if operation in done]
    used = list(dict.fromkeys(identity for each in determinants for identity in each.used))
    gone = list(dict.fromkeys(node for each in determinants for node in each.cancelled))
    cancelling: Prose = (" (the terms with ", *listed(gone), " cancel)") if gone else ()
    words: Prose = (f"{', '.join(first)}", *cancelling, f", and {last}") if first else (last, *cancelling)
    return (*words, " with ", *said(used)) if used else words


@dataclass(frozen=True, slots=True)
class _Written:
    """p q - r²: in letters, and with the entries put in."""

    in_letters: Node
    values: tuple[Expr, Expr, Expr]
    differences: Line | None = None

    def put_in(self, context: Context) -> Node:
        p, q, r = map(context.show, self.values)
        if self.values[2].is_zero:
            return Product((p, q))
        return Sum((Product((p, q)), Negative(Power(without_signs(r), Number(2)))))


def determinant_of_two(context: Context, places: tuple[int, int], value: Expr, form: Node) -> Determinant:
    """The lines from d_aa d_bb - d_ab² to its value, in the form that shows its sign."""
    a, b = places
    plain, *others = _ways(context, a, b)
    best = min((plain, *others), key=lambda way: cost(way.put_in(context)))
    before = best.put_in(context)
    members, operations = [plain.in_letters], list[str]()
    if cost(before) > LONGEST or not equals(before, value):
        return Determinant(equation(*members, form), form, (MULTIPLIED_OUT,))
    if best is not plain:
        members.append(best.in_letters)
    operations.append(_PUT_IN)
    if are_alike(before, form):
        line = equation(*members, form)
        return Determinant(line, form, tuple(operations), differences=best.differences)
    lines, last = [before], MULTIPLIED_OUT
    expanded, count, gone = _multiplied_out(context, before)
    if count <= MOST_TERMS and not are_alike(expanded, form) and equals(expanded, value):
        lines.append(expanded)
        operations.append(MULTIPLIED_OUT)
        last, form = _COLLECTED, _in_terms(context, form, expanded)
    used = identities(context.robot.ring, lines[-1], form) or ()
    line = equation(*members, *lines, form)
    cancelled = gone if is_numeric(context.robot) else ()
    return Determinant(line, form, (*operations, last), used, best.differences, cancelled)


def _ways(context: Context, a: int, b: int) -> Iterator[_Written]:
    """d_aa d_bb - d_ab², and the same by the differences of entries, from either end."""
    D = context.values["D"]
    d_ab = letters.entry("d", a + 1, b + 1)

    def square(node: Node) -> Node:
        return Negative(Power(node, Number(2)))

    d_aa, d_bb = (letters.entry("d", k + 1, k + 1) for k in (a, b))
    yield _Written(Sum((Product((d_aa, d_bb)), square(d_ab))), (D[a, a], D[b, b], D[a, b]))
    if is_numeric(context.robot):
        return
    whole = Sum((d_aa, Negative(Product((Number(2), d_ab))), d_bb))
    for k, changed, kept in ((b, a, d_bb), (a, b, d_aa)):
        difference = Sum((d_ab, Negative(kept)))
        written = Sum((Product((Parenthesized(whole), kept)), square(Parenthesized(difference))))
        values = (D[a, a] - D[a, b] * 2 + D[b, b], D[k, k], D[a, b] - D[k, k])
        shown = (equation(whole, context.show(values[0])), equation(difference, context.show(values[2])))
        by = f"Row {k + 1} is subtracted from row {changed + 1}, and then column {k + 1} from column "
        by += f"{changed + 1}, which does not change the determinant. This replaces "
        entries = (letters.entry("d", changed + 1, changed + 1), " and ", d_ab, " by:")
        yield _Written(written, values, Line((by, *entries), shown))


def _in_terms(context: Context, form: Node, before: Node) -> Node:
    """A form as a plain sum, in the order of the line before; as it is where a term would be negative."""
    plain, count, _ = _multiplied_out(context, form)
    if not isinstance(plain, Sum) or count > MOST_TERMS or any(isinstance(t, Negative) for t in plain.terms):
        return form
    known = before.terms if isinstance(before, Sum) else (before,)
    order = {term: place for place, term in enumerate(known)}
    return Sum(
        tuple(sorted(plain.terms, key=lambda term: order.get(_without_squared_sines(term), len(order))))
    )


def _without_squared_sines(term: Node) -> Node:
    """m l² s² as m l², in the place of which it stands where s² + c² = 1 was used."""
    factors = factors_of(term)
    return product_of(1, [(factor, 1) for factor in factors if not _is_squared_sine(factor)])


def _is_squared_sine(node: Node) -> bool:
    return isinstance(node, Power) and node.exponent == Number(2) and _is_sine(node.base)


def _is_sine(node: Node) -> bool:
    return isinstance(node, Function) and node.name == "sin"


def _multiplied_out(context: Context, node: Node) -> tuple[Node, int, tuple[Node, ...]]:
    """The sum of all products of terms, of how many terms it is, and the products that cancel."""
    collector = context.forms.compactor.collector
    found: dict[Monomial, Rational] = {}
    for term in _terms(node):
        factor, monomial = collector.decompose(term)
        found[monomial] = found.get(monomial, 0) + factor
    left = [collector.product(factor, monomial, ()) for monomial, factor in found.items() if factor]
    gone = tuple(collector.product(1, monomial, ()) for monomial, factor in found.items() if not factor)
    return total(left), len(left), gone


def _terms(node: Node) -> Iterator[Node]:
    """The terms of a tree, products and squares of sums as all products of their terms."""
    match node:
        case Sum(terms):
            for term in terms:
                yield from _terms(term)
        case Negative(argument):
            yield from map(negated, _terms(argument))
        case Parenthesized(argument):
            yield from _terms(argument)
        case Power(Sum() | Product() as base, Number(2, 1)):
            yield from _terms(Product((base, base)))
        case Product(factors):
            yield from map(Product, product(*(tuple(_terms(factor)) for factor in factors)))
        case _:
            yield node
