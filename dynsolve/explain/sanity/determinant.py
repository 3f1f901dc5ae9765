"""The determinant of two coupled coordinates, from its formula to the value: d_aa d_bb - d_ab².

The square of an entry that is a sum is long.  Where it is shorter, row and column b are subtracted
from row and column a first: (d_aa - 2 d_ab + d_bb) d_bb - (d_ab - d_bb)² is the same, and what two
entries share is gone.  Of a robot in numbers nothing is gained by it: sums of numbers are numbers.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from itertools import combinations, product

from flint import fmpq_mpoly

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.compact.monomials import Monomial
from dynsolve.algebra.compact.terms import Rational
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.generators import Generator, Pair
from dynsolve.algebra.inequality import Bound
from dynsolve.document import Prose
from dynsolve.errors import AlgebraError
from dynsolve.explain.context import Context
from dynsolve.explain.forms import is_numeric
from dynsolve.explain.inverse_formulas import ConfigurationForms
from dynsolve.explain.sanity.poses import Pose, at, degrees, written_pose
from dynsolve.explain.step import Line, Step
from dynsolve.explain.working.derivatives import are_alike
from dynsolve.explain.working.differentiation import product_of
from dynsolve.explain.working.identities import Identity, equals, identities, said
from dynsolve.explain.working.kinetic import without_signs
from dynsolve.explain.writing import listed, spong
from dynsolve.notation.build import cost, factors_of, negated, total
from dynsolve.notation.tree import (
    ZERO,
    Function,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Relation,
    Row,
    Sum,
    Symbol,
    Words,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Robot

Names = frozenset[str]
"""The parameters that are positive."""


def masses_and_moments(robot: Robot) -> Names:
    """The masses and the moments of inertia of a problem; products of inertia may be negative."""
    tensors = [body.inertia for body in robot.bodies if body.inertia is not None]
    places = [(i, j) for i in range(3) for j in range(3)]
    products = {name for t in tensors for i, j in places if i != j for name in _names(t[i, j])}
    moments = {name for t in tensors for i, j in places if i == j for name in _names(t[i, j])}
    masses = {name for body in robot.bodies for name in _names(body.mass)}
    rotors = {name for motor in robot.actions.motors for name in _names(motor.inertia)}
    return frozenset((masses | moments | rotors) - products)


def with_lengths(robot: Robot) -> Names:
    """Every parameter but the products of inertia: lengths and the size of gravity too."""
    tensors = [body.inertia for body in robot.bodies if body.inertia is not None]
    products = {name for t in tensors for i in range(3) for j in range(i) for name in _names(t[i, j])}
    return frozenset(robot.ring.parameters) - products


def _names(expr: Expr) -> set[str]:
    """The parameters that occur in an expression."""
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
        case Sum(parts):
            return is_nonnegative(node, positive) and any(is_positive(p, positive, constant) for p in parts)
        case Product(parts):
            return all(is_positive(part, positive, constant) for part in parts)
        case Quotient(numerator, denominator):
            return is_positive(numerator, positive, constant) and is_positive(denominator, positive, constant)
        case Parenthesized(argument) | Function("sqrt", argument):
            return is_positive(argument, positive, constant)
    return isinstance(node, Symbol) and is_nonnegative(node, positive)


def sign_of(context: Context, value: Expr) -> int:
    """The sign of a value in every pose, lengths positive: 1 or -1; 0 where none is seen."""
    positive, constant = with_lengths(context.robot), frozenset(context.robot.ring.parameters)
    return next((sign for sign in (1, -1) if is_positive(context.show(value * sign), positive, constant)), 0)


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


# -- how g = 0 is solved where a row has two factors: each is 0 in a case of its own, and leaves one angle

_WITH_KNOWN_TANGENT = (30, 45, 60, -30, -45, -60)
"""The angles in degrees, between -90 and 90, that have a tangent without cosines of further angles."""


@dataclass(frozen=True, slots=True)
class Cases:
    """Where g = 0 of two angles: the lines that lead there, and all poses up to full turns."""

    lines: tuple[Line, ...]
    poses: tuple[Pose, ...]


def cases(context: Context, names: Sequence[str]) -> Cases | None:
    """The cases of the first row, from the last on, that has two factors; None where there is none."""
    g = context.values["g"]
    rows = [k for k in reversed(range(context.robot.n)) if not g[k, 0].is_zero]
    found = next(((k, factors) for k in rows if (factors := _factors(context, g[k, 0]))), None)
    if found is None or len(names) != 2 or len(rows) != 2:
        return None
    row, factors = found
    other = next(k for k in rows if k != row)
    by_factor = [_branch(context, factor, other, names) for factor in factors]
    if any(each is None for each in by_factor):
        return None
    either = [equation(_shown(context, factor), ZERO) for factor in factors]
    value = equation(letters.entry("g", row + 1), context.show(g[row, 0]), ZERO)
    lines = [Line((), (Row((value, Words(", so "), either[0], Words(" or "), either[1])),))]
    poses: dict[tuple[int, ...], Pose] = {}
    for zero, branch in zip(either, by_factor, strict=True):
        assert branch is not None
        lines.append(Line(("Where ", zero, ":"), branch.formulas))
        poses |= {tuple(pose[name] for name in names): pose for pose in branch.poses}
    return Cases(tuple(lines), tuple({name: pose[name] for name in names} for pose in poses.values()))


@dataclass(frozen=True, slots=True)
class _Branch:
    formulas: tuple[Node, ...]
    poses: tuple[Pose, ...]


def _factors(context: Context, row: Expr) -> tuple[Generator, Generator] | None:
    """The sines or cosines of two angles whose product, times what surely has a sign, is a row of g."""
    ring, used = row.ring, row.poly.degrees()
    turning = [g for g in ring.generators if g.kind in ("sin", "cos") and used[g.index] > 0]
    if len(turning) != 2 or turning[0].angle == turning[1].angle:
        return None
    first, second = turning
    beside = Expr(ring, row.poly.derivative(first.index).derivative(second.index))
    product = beside * ring.generator(first.index) * ring.generator(second.index)
    is_whole = product == row and sign_of(context, beside) and all(_name(g.angle) for g in turning)
    return (first, second) if is_whole else None


def _branch(context: Context, factor: Generator, row: int, names: Sequence[str]) -> _Branch | None:
    """What a row says of the other angle where a factor is 0; None where it does not say it."""
    name = _name(factor.angle)
    left = next(each for each in names if each != name)
    formulas: list[Node] = []
    poses: list[Pose] = []
    for angle in (0, 180) if factor.kind == "sin" else (90, -90):
        here = {name: angle}
        value = at(context.robot.ring, context.values["g"][row, 0], here)
        found = solved(context, value, left)
        if found is None:
            return None
        said, angles = found
        both = Row((degrees(angles[0]), Words(" or "), degrees(angles[1])))
        zero = equation(letters.entry("g", row + 1), context.show(value), ZERO)
        where = (*written_pose(here), Words(": "), zero, Words(", so "), said, Words(", "))
        formulas.append(Row((*where, equation(Symbol(left), both))))
        poses += [{**here, left: other} for other in angles]
    return _Branch(tuple(formulas), tuple(poses))


def solved(context: Context, value: Expr, name: str) -> tuple[Node, tuple[int, int]] | None:
    """The angle where a s + b c is 0: what follows for s, c or its tangent, and the two angles."""
    ring, q = context.robot.ring, Symbol(name)
    pair = next((pair for pair in ring.pairs if _name(pair.angle) == name), None)
    if pair is None:
        return None
    for index, zeros in ((pair.sine, (0, 180)), (pair.cosine, (90, -90))):
        beside = Expr(ring, value.poly.derivative(index))
        if value == beside * ring.generator(index) and sign_of(context, beside):
            return equation(context.show(ring.generator(index)), ZERO), zeros
    if not (_is_linear(value, pair) and sign_of(context, Expr(ring, value.poly.derivative(pair.sine)))):
        return None
    for angle, tangent in _tangents(context):
        if at(ring, value, {name: angle}).is_zero:
            opposite = angle - 180 if angle > 0 else angle + 180
            return equation(Function("tan", q), tangent), (angle, opposite)
    return None


def _tangents(context: Context) -> Iterator[tuple[int, Node]]:
    """The angles with a known tangent in the ring of a robot, and what it is."""
    ring = context.robot.ring
    for angle in _WITH_KNOWN_TANGENT:
        try:
            s, c = ring.sin(Angle((), Fraction(angle))), ring.cos(Angle((), Fraction(angle)))
        except AlgebraError:
            continue
        yield angle, context.show(s * ring.inverse(c))


def _is_linear(value: Expr, pair: Pair) -> bool:
    """Whether a value is a s + b c with constant a and b."""
    ring = value.ring
    parts = [Expr(ring, value.poly.derivative(index)) for index in (pair.sine, pair.cosine)]
    total = parts[0] * ring.generator(pair.sine) + parts[1] * ring.generator(pair.cosine)
    return value == total and not any(map(ring.depends_on_coordinates, parts))


def _name(angle: Angle) -> str:
    """The coordinate that an angle is; "" where it is a sum, a multiple or a constant more."""
    if angle.degrees or len(angle.terms) != 1:
        return ""
    ((atom, rate),) = angle.terms
    return atom[0][0] if rate == 1 and len(atom) == 1 else ""


def _shown(context: Context, factor: Generator) -> Node:
    return context.show(context.robot.ring.generator(factor.index))


# -- the relation between parameters that makes D diagonal: a factor of all entries beside the diagonal


def decoupled_step(context: Context) -> Step | None:
    """What makes D diagonal in every configuration; None where no relation between parameters does."""
    n, D = context.robot.n, context.values["D"]
    coupling = [D[i, j] for i, j in combinations(range(n), 2) if not D[i, j].is_zero]
    if not coupling:
        return None
    factor = _of_parameters(coupling)
    if factor is None:
        return None
    shown = ConfigurationForms(context.robot, context.values).inequality(Bound(factor))
    told: Prose = ("Where ", Relation(shown.parts, ("=",)), ", ", letters.D, " is diagonal in every ")
    told += ("configuration: no coordinate is coupled with another by its acceleration.",)
    ring = context.robot.ring
    if not any(ring.depends_on_coordinates(D[i, i]) for i in range(n)):
        told += (" ", letters.D, " is then constant, and ", equation(letters.C, letters.bold("0")), ".")
    return Step(
        id="decoupled",
        stage=Stage.VECTORIZED,
        title="What decouples the coordinates",
        why=told,
        source=spong("7.4"),
        outcome=told,
        is_task=False,
    )


def _of_parameters(values: Iterable[Expr]) -> Expr | None:
    """A sum of parameters alone, of both signs, that divides all values: it may be 0 for positive ones."""
    values = list(values)
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
    both = (one for one, _ in found if len({sign > 0 for sign in one.to_dict().values()}) == 2)
    factor = next(both, None)
    return None if factor is None else Expr(ring, factor)
