"""The determinant of two coupled coordinates, from its formula to the value: d_aa d_bb - d_ab².

The square of an entry that is a sum is long.  Where it is shorter, row and column b are subtracted
from row and column a first: (d_aa - 2 d_ab + d_bb) d_bb - (d_ab - d_bb)² is the same, and what two
entries share is gone.  Of a robot in numbers nothing is gained by it: sums of numbers are numbers.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from functools import reduce
from itertools import combinations, product

from flint import fmpq_mpoly
from msgspec import Struct

from dynsolve.algebra.compact.terms import Monomial, Rational
from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.ring import Expr
from dynsolve.derivation.elimination import ParameterSigns
from dynsolve.document import Prose
from dynsolve.document.books import spong
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.inequalities import Inequalities
from dynsolve.explain.step import Line, Step
from dynsolve.explain.working.identities import Identity, are_alike, equals, identities, said
from dynsolve.explain.working.squares import without_signs
from dynsolve.explain.writing import listed
from dynsolve.notation.build import cost, factors_of, negated, total
from dynsolve.notation.differentiation import product_of
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    Function,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Robot

Names = frozenset[str]
"""The parameters that are positive."""


def masses_and_moments(robot: Robot) -> Names:
    """The masses and the moments of inertia of a problem; products of inertia may be negative.

    Of given energies it is not known which parameters are masses: all that may be.
    """
    if not robot.bodies:
        return with_lengths(robot)
    inertias = [*(body.mass for body in robot.bodies), *(motor.inertia for motor in robot.actions.rotors)]
    names = {name for inertia in inertias for name in _names(inertia)}
    return frozenset((names | _of_tensors(robot, moments=True)) - _of_tensors(robot, moments=False))


def with_lengths(robot: Robot) -> Names:
    """Every parameter but the products of inertia: lengths and the size of gravity too."""
    return frozenset(robot.ring.parameters) - _of_tensors(robot, moments=False)


def _of_tensors(robot: Robot, *, moments: bool) -> set[str]:
    """The parameters in the moments of inertia, or in the products of inertia."""
    tensors = [body.inertia for body in robot.bodies if body.inertia is not None]
    places = [(i, j) for i in range(3) for j in range(3) if (i == j) == moments]
    return {name for tensor in tensors for place in places for name in _names(tensor[place])}


def _names(expr: Expr) -> set[str]:
    degrees = expr.poly.degrees()
    return {g.name for g in expr.ring.generators if g.name in expr.ring.parameters and degrees[g.index] > 0}


def is_nonnegative(node: Node, positive: Names) -> bool:
    """Whether no part of a formula can make it negative."""
    match node:
        case Number():
            return True
        case Symbol(name, 0):
            return name in positive
        case Function("sqrt", _):
            return True
        case Parenthesized(argument):
            return is_nonnegative(argument, positive)
        case Power(base, Number(p, 1)):
            return p % 2 == 0 or is_nonnegative(base, positive)
        case Sum(parts) | Product(parts):
            return all(is_nonnegative(part, positive) for part in parts)
        case Quotient(numerator, denominator):
            return is_nonnegative(numerator, positive) and is_nonnegative(denominator, positive)
    return False


def is_positive(node: Node, positive: Names, constant: Names) -> bool:
    """Whether a formula is positive in every pose; `constant` are the parameters, none of which is 0.

    >>> l, m, q = map(Symbol, "lmq")
    >>> square = Product((m, Power(l, Number(2))))
    >>> names = frozenset("m"), frozenset("lm")
    >>> is_positive(square, *names), is_positive(Product((square, Function("sin", q))), *names)
    (True, False)
    """
    match node:
        case Number(p, _):
            return p > 0
        case Power(base, _):
            nonzero = isinstance(base, Symbol) and base.name in constant and not base.dots
            return is_nonnegative(node, positive) and (nonzero or is_positive(base, positive, constant))
        case Sum():
            return is_nonnegative(node, positive) and bool(sure_terms(node, positive, constant))
        case Product(parts):
            return all(is_positive(part, positive, constant) for part in parts)
        case Quotient(numerator, denominator):
            return is_positive(numerator, positive, constant) and is_positive(denominator, positive, constant)
        case Parenthesized(argument) | Function("sqrt", argument):
            return is_positive(argument, positive, constant)
    return isinstance(node, Symbol) and is_nonnegative(node, positive)


def sure_terms(node: Sum, positive: Names, constant: Names) -> list[Node]:
    """The terms that are positive in every pose; without any, two that are not 0 at once: A s² + B c².

    >>> A, B, s, c = *map(Symbol, "AB"), *(Power(Function(f, Symbol("q")), Number(2)) for f in ("sin", "cos"))
    >>> len(sure_terms(Sum((Product((A, s)), Product((B, c)))), frozenset("AB"), frozenset("AB")))
    2
    """
    sure = [term for term in node.terms if is_positive(term, positive, constant)]
    turning: dict[tuple[str, Node], Node] = {}
    for term in () if sure else node.terms:
        match factors_of(term):
            case (*rest, Power(Function("sin" | "cos" as name, angle), Number(2, 1))) if all(
                is_positive(factor, positive, constant) for factor in rest
            ):
                turning[name, angle] = term
    both = ([turning.get((name, angle)) for name in ("sin", "cos")] for _, angle in turning)
    return sure or next(([one, other] for one, other in both if one and other), [])


def sign_of(context: Context, value: Expr) -> int:
    """The sign of a value in every pose, lengths positive: 1 or -1; 0 where none is seen."""
    positive, constant = with_lengths(context.robot), frozenset(context.robot.ring.parameters)
    return next((sign for sign in (1, -1) if is_positive(context.show(value * sign), positive, constant)), 0)


MOST_TERMS = 16
"""Up to this number of terms a determinant is multiplied out."""

LONGEST = 60
"""The operations of the entries up to which they are put in."""


OPERATIONS: tuple[str, ...] = ("the entries put in", "multiplied out", "collected")
"""What may be done to a determinant, in this order."""

_PUT_IN, MULTIPLIED_OUT, _ = OPERATIONS


class Determinant(Struct, frozen=True):
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
    return say(
        "{first}{cancelling}{last}{used}" if first else "{last}{cancelling}{used}",
        first=", ".join(first),
        cancelling=say(" (the terms with {gone} cancel)", gone=listed(gone)) if gone else "",
        last=f", and {last}" if first else last,
        used=say(" with {identities}", identities=said(used)) if used else "",
    )


class _Written(Struct, frozen=True):
    """p q - r²: in letters, and with the entries put in."""

    in_letters: Node
    values: tuple[Expr, Expr, Expr]
    differences: Line | None = None

    def put_in(self, context: Context) -> Node:
        p, q, r = map(context.show, self.values)
        text = "{p} {q}" if self.values[2].is_zero else "{p} {q} - {r}²"
        return formula(text, p=p, q=q, r=without_signs(r))


def determinant_of_two(context: Context, places: tuple[int, int], value: Expr, form: Node) -> Determinant:
    """The lines from d_aa d_bb - d_ab² to its value, in the form that shows its sign."""
    plain, *others = _ways(context, *places)
    best = min((plain, *others), key=lambda way: cost(way.put_in(context)))
    before = best.put_in(context)
    members = [plain.in_letters]
    if cost(before) > LONGEST or not equals(before, value):
        return Determinant(equation(*members, form), form, (MULTIPLIED_OUT,))
    if best is not plain:
        members.append(best.in_letters)
    if are_alike(before, form):
        return Determinant(equation(*members, form), form, (_PUT_IN,), differences=best.differences)
    lines, operations = [before], OPERATIONS[:2]
    expanded, count, gone = _multiplied_out(context, before)
    if count <= MOST_TERMS and not are_alike(expanded, form) and equals(expanded, value):
        lines.append(expanded)
        operations, form = OPERATIONS, _in_terms(context, form, expanded)
    used = identities(context.robot.ring, lines[-1], form) or ()
    line = equation(*members, *lines, form)
    cancelled = gone if context.robot.has_decimals else ()
    return Determinant(line, form, operations, used, best.differences, cancelled)


def _ways(context: Context, a: int, b: int) -> Iterator[_Written]:
    """d_aa d_bb - d_ab², and the same by the differences of entries, from either end."""
    D = context.values["D"]
    d_aa, d_ab, d_bb = (letters.entry("d", i + 1, j + 1) for i, j in ((a, a), (a, b), (b, b)))
    in_letters = formula("{aa} {bb} - {ab}²", aa=d_aa, ab=d_ab, bb=d_bb)
    yield _Written(in_letters, (D[a, a], D[b, b], D[a, b]))
    if context.robot.has_decimals:
        return
    whole = formula("{aa} - 2 {ab} + {bb}", aa=d_aa, ab=d_ab, bb=d_bb)
    for k, changed, kept, replaced in ((b, a, d_bb, d_aa), (a, b, d_aa, d_bb)):
        difference = formula("{ab} - {kept}", ab=d_ab, kept=kept)
        written = formula("({whole}) {kept} - ({difference})²", whole=whole, kept=kept, difference=difference)
        values = (D[a, a] - D[a, b] * 2 + D[b, b], D[k, k], D[a, b] - D[k, k])
        shown = (equation(whole, context.show(values[0])), equation(difference, context.show(values[2])))
        by = say(
            "Row {k} is subtracted from row {changed}, and then column {k} from column {changed}, which does "
            "not change the determinant. This replaces {entry} and {beside} by:",
            k=k + 1,
            changed=changed + 1,
            entry=replaced,
            beside=d_ab,
        )
        yield _Written(written, values, Line(by, shown))


def _in_terms(context: Context, form: Node, before: Node) -> Node:
    """A form as a plain sum, in the order of the line before; as it is where a term could be negative."""
    plain, count, _ = _multiplied_out(context, form)
    if not isinstance(plain, Sum) or count > MOST_TERMS:
        return form
    if not is_nonnegative(plain, with_lengths(context.robot)):
        return form
    known = before.terms if isinstance(before, Sum) else (before,)
    order = {term: place for place, term in enumerate(known)}
    return Sum(
        tuple(sorted(plain.terms, key=lambda term: order.get(_without_squared_sines(term), len(order))))
    )


def _without_squared_sines(term: Node) -> Node:
    """m l² s² as m l², in the place of which it stands where s² + c² = 1 was used."""

    def is_squared_sine(node: Node) -> bool:
        match node:
            case Power(Function("sin"), Number(2, 1)):
                return True
        return False

    return product_of(1, [(factor, 1) for factor in factors_of(term) if not is_squared_sine(factor)])


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


# -- the relation between parameters that makes D diagonal: a factor of all entries beside the diagonal


def decoupled_step(context: Context) -> Step | None:
    """What makes D diagonal in every configuration; None where no relation between parameters does."""
    n, D = context.robot.n, context.values["D"]
    coupling = [D[i, j] for i, j in combinations(range(n), 2) if not D[i, j].is_zero]
    factor = _of_parameters(coupling) if coupling else None
    if factor is None or ParameterSigns(context.robot.questions.model.assumed).open_part(factor).is_number:
        return None
    sides = Inequalities(context.robot).inequality(Bound(factor)).parts
    ring = context.robot.ring
    diagonal = [D[i, i] for i in range(n)]
    is_told = any(map(ring.depends_on_coordinates, coupling)) and not any(
        map(ring.depends_on_coordinates, diagonal)
    )
    told = say(
        "Where {relation}, $𝐃$ is diagonal in every configuration{constant}: no coordinate is coupled with "
        "another by its acceleration.",
        relation=equation(*sides),
        constant=say(", and the same in all, so that $𝐂 = 𝟎$") if is_told else "",
    )
    return Step(
        id="decoupled",
        stage=Stage.VECTORIZED,
        title="What decouples the coordinates",
        why=told,
        source=spong("7.4"),
        outcome=told,
        is_task=False,
    )


def _of_parameters(values: Sequence[Expr]) -> Expr | None:
    """A sum of parameters alone, of both signs, that divides all values: it may be 0 for positive ones."""
    ring = values[0].ring
    own = [
        g.index for g in ring.generators if g.kind == "symbol" and not g.dots and g.name in ring.parameters
    ]
    parts: dict[tuple[int, ...], fmpq_mpoly] = defaultdict(lambda: ring.zero.poly)
    for number, value in enumerate(values):
        for exponents, size in value.poly.to_dict().items():
            alone = tuple(e if k in own else 0 for k, e in enumerate(exponents))
            rest = tuple(0 if k in own else e for k, e in enumerate(exponents))
            parts[(number, *rest)] += ring.ctx.from_dict({alone: size})
    common = reduce(lambda one, other: one.gcd(other), parts.values())
    _, found = common.factor()
    both = (Expr(ring, one) for one, _ in found if len({sign > 0 for sign in one.to_dict().values()}) == 2)
    return next(both, None)
