"""J_vᵀ J_v on paper: the products of the columns of J_v, by one operation after the other.

Two rows of J_v that are one row of lengths turned by an angle, (U s + V c) and (U c - V s), add up to
U² + V² by s² + c² = 1 of that angle alone.  What is left is multiplied out, the sines and cosines in
brackets, which become 1 or the cosine of a difference: the same lines as those of a speed's square.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations_with_replacement

from dynsolve.algebra.angles import angle_node
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.kinematics import rotation
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.forms import is_numeric
from dynsolve.explain.matrix_factors import matrix_width
from dynsolve.explain.step import Line
from dynsolve.explain.working import squares
from dynsolve.explain.working.derivatives import are_alike
from dynsolve.explain.working.differentiation import is_trigonometric
from dynsolve.explain.working.identities import (
    Identity,
    equals,
    identities,
    products_cancel,
    pythagoras,
    said,
)
from dynsolve.explain.working.kinetic import MOST_GROUPS, turned_name, turning_line, without_signs
from dynsolve.explain.writing import sum_of
from dynsolve.notation import tree
from dynsolve.notation.build import factors_of, negated, number_in_front, times, total
from dynsolve.notation.tree import (
    ZERO,
    Entry,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Row,
    Sum,
    equation,
)
from dynsolve.notation.walk import walk
from dynsolve.quantities import letters
from dynsolve.robot.model import Body

WIDEST = 60
"""The characters up to which the products stand in a matrix; wider ones are given entry by entry."""


@dataclass(frozen=True, slots=True)
class Products:
    """The lines from m J_vᵀ J_v with its matrices to the result, and the identities of the last operation.

    With a `frame` they begin afresh from J_v, along the axes of that frame.
    """

    lines: tuple[Line, ...]
    used: tuple[Identity, ...]
    frame: int | None = None


@dataclass(frozen=True, slots=True)
class _Entry:
    """An entry of J_vᵀ J_v: as a sum of products, multiplied out, and the identities that are left."""

    place: tuple[int, int]
    products: Node
    multiplied: Node
    used: tuple[Identity, ...]


def of_columns(context: Context, body: Body) -> Products | None:
    """The lines of a body's linear part; None where one identity does all, or where they are not plain.

    Where the base leans, along the axes of the first frame in which they are plain.
    """
    velocity = context.values[f"v{body.name}"]
    if not context.is_short:
        return None
    if not any(map(squares.has_roots, velocity.entries)) or not context.robot.has_table:
        return _along(context, body, velocity)
    for i in range(body.link + 1):
        R = rotation(context.values[f"H{i}"])
        found = _along(context, body, R.T @ velocity)
        if found is not None:
            return Products((*_begun_along(context, body, i), *found.lines), found.used, frame=i)
    return None


def _begun_along(context: Context, body: Body, i: int) -> Iterator[Line]:
    """J_v along the axes of another frame, and the products of its columns there."""
    J, value, written = letters.jv(body), context.values[f"Jv{body.name}"], context.matrix(f"Jv{body.name}")
    yield turning_line(context, i, J, value, written, ("the products of the columns",))
    turned = context.show(rotation(context.values[f"H{i}"]).T @ value)
    mass, name = context.mass(body), Parenthesized(turned_name(context, i, J))
    members = (
        Product((mass, letters.transposed_product(J))),
        Product((mass, letters.transposed_product(name))),
        Product((context.show(body.mass), letters.transposed_product(turned))),
    )
    yield Line(("Their products:",), (equation(*dict.fromkeys(members)),))


def _along(context: Context, body: Body, velocity: Matrix) -> Products | None:
    """The lines by the components of the velocity along some axes."""
    robot = context.robot
    components = [x for x in velocity.entries if not x.is_zero]
    if any(map(squares.has_roots, components)):
        return None
    factor = _fraction(context, components)
    components = [Expr(robot.ring, x.poly / factor.poly) for x in components]
    found = squares.turned(robot.ring, components)
    mixed: Prose = () if found is None else _mixed_products(context, found)
    if found is not None:
        components = squares.exchanged(components, found)
    rows = [[squares.factor_of_rate(x, q.name) for q in robot.coordinates] for x in components]
    entries = [_entry(context, rows, i, j) for i in range(robot.n) for j in range(i, robot.n)]
    shown = [entry for entry in entries if entry is not None]
    used = dict.fromkeys(identity for entry in shown for identity in entry.used)
    if len(shown) < len(entries) or not used or (found is None and len(used) < 2):
        return None
    first: Prose = ()
    if found is not None:
        first = ("With ", *said([pythagoras(angle_node(found.pair.angle, robot.ring.names))]), *mixed)
    return Products(tuple(_lines(context, body, shown, first, factor)), tuple(used))


def _fraction(context: Context, components: Sequence[Expr]) -> Expr:
    """The length that all components share, where a fraction goes with it: ½ l₂; 1 of decimals."""
    ring = context.robot.ring
    length = ring.one if is_numeric(context.robot) else squares.shared(ring, components).length
    (coefficient,) = length.poly.coeffs()
    return length if int(coefficient.q) != 1 else ring.one


def _mixed_products(context: Context, found: squares.Turned) -> Prose:
    """That the terms with s c cancel, if there are any in (U s + V c)(X s + Y c) + (U c - V s)(X c - Y s)."""
    slopes = [
        (squares.factor_of_rate(found.parts[0], q.name), squares.factor_of_rate(found.parts[1], q.name))
        for q in context.robot.coordinates
    ]
    pairs = combinations_with_replacement(slopes, 2)
    if all((u * y + v * x).is_zero for (u, v), (x, y) in pairs):
        return ()
    return products_cancel(context.robot.ring, found.pair)


def _entry(context: Context, rows: Sequence[Sequence[Expr]], i: int, j: int) -> _Entry | None:
    """An entry from row i, column j; None where its squares do not come apart into lengths and angles."""
    ring = context.robot.ring
    pairs = [(row[i], row[j]) for row in rows if not (row[i].is_zero or row[j].is_zero)]
    value = sum((a * b for a, b in pairs), start=ring.zero)
    products = _products(context, pairs, is_square=i == j)
    result = context.show(value)
    used = identities(ring, products, result)
    if used is None or not equals(products, value):
        return None
    if not used or not _has_sums(products):
        shown = _in_brackets(products) if i == j else products
        return _Entry((i, j), shown, shown, used)
    groups = squares.groups(context.forms, sum((a.poly * b.poly for a, b in pairs), start=ring.zero.poly))
    if groups is None or len(groups) > MOST_GROUPS:
        return None
    multiplied = sum_of([group.multiplied for group in groups])
    if are_alike(multiplied, products):
        multiplied = products
    return _Entry((i, j), products, multiplied, identities(ring, multiplied, result) or ())


def _products(context: Context, pairs: Sequence[tuple[Expr, Expr]], is_square: bool) -> Node:
    """Σ a b, or Σ a², each in printing order."""
    collector = context.forms.compactor.collector
    terms: list[Node] = []
    for a, b in pairs:
        first, second = map(context.show, (a, b))
        bare = without_signs(first), without_signs(second)
        found = _single_fraction(collector.product(*collector.decompose(Product(bare)), ()))
        opposite = (first != bare[0]) != (second != bare[1])
        terms.append(negated(found) if opposite and not is_square else found)
    return sum_of(terms) if is_square else total(terms)


def _single_fraction(node: Node) -> Node:
    """l (a + b/2)/2 as ½ l (a + b/2): no fraction in another."""
    has_two = isinstance(node, Quotient) and any(isinstance(part, Quotient) for part in walk(node.numerator))
    return number_in_front(node) if has_two else node


def _in_brackets(squares_shown: Node) -> Node:
    """l² s² + l² c² as l² (s² + c²): the squares of one length stand in one bracket."""
    terms = squares_shown.terms if isinstance(squares_shown, Sum) else (squares_shown,)
    angular: dict[tuple[Node, ...], list[Node]] = {}
    for term in terms:
        factors = factors_of(term)
        lengths = tuple(factor for factor in factors if not is_trigonometric(factor))
        others = [(factor, 1) for factor in factors if is_trigonometric(factor)]
        angular.setdefault(lengths, []).append(times(1, others))
    if len(angular) == len(terms) or any(Number(1) in each for each in angular.values()):
        return squares_shown
    return total([
        times(1, [*((length, 1) for length in lengths), (sum_of(each), 1)])
        for lengths, each in angular.items()
    ])  # fmt: skip


def _has_sums(products: Node) -> bool:
    """Whether a factor, or what is squared, is a sum of sines and cosines."""
    factors = (part for part in walk(products) if isinstance(part, Product | Power))
    return any(isinstance(part, Sum) and is_trigonometric(part) for each in factors for part in walk(each))


def _lines(
    context: Context, body: Body, entries: Sequence[_Entry], first: Prose, factor: Expr
) -> Iterator[Line]:
    """The products of the columns, where an identity leads to them, and these multiplied out.

    `first` is said of that identity; the factor is what is taken out of the columns.
    """
    is_expanded = any(entry.multiplied != entry.products for entry in entries)
    plain = _matrix(context, [(entry.place, entry.products) for entry in entries])
    expanded = _matrix(context, [(entry.place, entry.multiplied) for entry in entries])
    stages = [(first, plain)] * bool(first)
    stages += [(("Multiplied out",) if first else ("The columns multiplied with each other",), expanded)] * (
        is_expanded or not first
    )
    if all(matrix_width(context, matrix) <= WIDEST for _, matrix in stages):
        mass, columns = context.mass(body), letters.transposed_product(letters.jv(body))
        front = factors_of(_in_front(context, [body.mass, factor * factor]))
        for by, matrix in stages:
            whole = Product((*front, matrix))
            yield Line((*by, ":"), (equation(Product((mass, columns)), whole),))
        return
    by = first or ("The columns multiplied with each other",)
    by += (", entry by entry",)
    by += (", then multiplied out",) if first and is_expanded else ()
    are_some_zero = any(entry.products == ZERO for entry in entries)
    by += (f" (the matrix is symmetric{', all other entries are 0' * are_some_zero}):",)
    yield Line(by, tuple(_listed(context, body, entries, factor, with_products=bool(first))))


def _is_product(member: Node) -> bool:
    return isinstance(member, Product)


def _in_front(context: Context, scalars: Sequence[Expr]) -> Node:
    """The product of scalars as it stands before a matrix: ¼ m₂ l₂²."""
    return number_in_front(times(1, [(context.show(x), 1) for x in scalars if x != x.ring.one]))


def _matrix(context: Context, entries: Sequence[tuple[tuple[int, int], Node]]) -> tree.Matrix:
    """The symmetric matrix of some entries."""
    n = context.robot.n
    found = {place: node for (i, j), node in entries for place in ((i, j), (j, i))}
    return tree.Matrix(tuple(tuple(found[i, j] for j in range(n)) for i in range(n)))


def _listed(
    context: Context, body: Body, entries: Sequence[_Entry], factor: Expr, *, with_products: bool
) -> Iterator[Node]:
    """The entries that are not zero from the start, a number as mass and the factor in front of them."""
    scalars = [body.mass] * body.mass.is_number + [factor * factor] * (factor != factor.ring.one)
    columns = letters.transposed_product(letters.jv(body))
    for entry in entries:
        if entry.products == ZERO:
            continue
        i, j = entry.place
        members = [entry.products] * with_products + [entry.multiplied]
        named: Node = columns
        if scalars:
            front = factors_of(_in_front(context, scalars))
            members = [
                Product((*front, *(factors_of(member) if _is_product(member) else (Parenthesized(member),))))
                for member in members
            ]
        if body.mass.is_number:
            named = Product((context.mass(body), columns))
        name = Entry(named, Row((Number(i + 1), Number(j + 1))))
        yield equation(name, *dict.fromkeys(members))
