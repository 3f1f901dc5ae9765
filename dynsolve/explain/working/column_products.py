"""J_vᵀ J_v on paper: the products of the columns of J_v, by one operation after the other.

Two rows of J_v that are one row of lengths turned by an angle, (U s + V c) and (U c - V s), add up to
U² + V² by s² + c² = 1 of that angle alone.  What is left is multiplied out, the sines and cosines in
brackets, which become 1 or the cosine of a difference: the same lines as those of a speed's square.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations_with_replacement

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.angles import angle_node
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.document import Prose
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.matrix_factors import factored, matrix_width
from dynsolve.explain.step import Line
from dynsolve.explain.working import squares
from dynsolve.explain.working.identities import (
    Identity,
    Way,
    are_alike,
    are_in_basic_angles,
    identities,
    products_cancel,
    proved,
    pythagoras,
    said,
)
from dynsolve.explain.working.squares import along_axes, turn_of_frame, turned_name, turning_line
from dynsolve.explain.writing import sum_of
from dynsolve.notation import tree
from dynsolve.notation.build import factors_of, number_in_front, times, total
from dynsolve.notation.differentiation import is_trigonometric
from dynsolve.notation.tree import (
    ZERO,
    Entry,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Row,
    Sum,
    equation,
    walk,
)
from dynsolve.quantities import letters
from dynsolve.robot.model import Body

WIDEST = 60
"""The characters up to which the products stand in a matrix; wider ones are given entry by entry."""


class _Entry(Struct, frozen=True):
    """An entry of J_vᵀ J_v: as a sum of products, multiplied out, and the identities that are left."""

    place: tuple[int, int]
    products: Node
    multiplied: Node
    used: tuple[Identity, ...]


def of_columns(context: Context, body: Body) -> Way | None:
    """The lines of a body's linear part; None where one identity does all, or where they are not plain.

    Where the base leans, along the axes of the first frame in which they are plain.
    """
    velocity = context.values[f"v{body.name}"]
    if not context.is_short:
        return None
    if not any(map(squares.has_roots, velocity.entries)) or not context.robot.has_table:
        return _along(context, body, velocity)
    for i, along in along_axes(context, body):
        found = _along(context, body, along)
        if found is not None and i is not None:
            return replace(found, lines=(*_begun_along(context, body, i), *found.lines), frame=i)
    return None


def _begun_along(context: Context, body: Body, i: int) -> Iterator[Line]:
    """J_v along the axes of another frame, and the products of its columns there."""
    J, value, written = letters.jv(body), context.values[f"Jv{body.name}"], context.matrix(f"Jv{body.name}")
    yield turning_line(context, i, J, value, written, "the products of the columns")
    turned = context.show(turn_of_frame(context, i)[0].T @ value)
    mass, name = context.forms.mass(body), Parenthesized(turned_name(context, i, J))
    products = ((mass, J), (mass, name), (context.show(body.mass), turned))
    members = dict.fromkeys(Product((m, letters.transposed_product(columns))) for m, columns in products)
    yield Line(("Their products:",), (equation(*(factored(context, member) for member in members)),))


def _along(context: Context, body: Body, velocity: Matrix) -> Way | None:
    """The lines by the components of the velocity along some axes."""
    robot, ring = context.robot, context.robot.ring
    components = [x for x in velocity.entries if not x.is_zero]
    if any(map(squares.has_roots, components)) or not are_in_basic_angles(context, components):
        return None
    length = squares.shared(robot, components).length
    ((_, coefficient),) = length.poly.to_dict().items()
    factor = length if int(coefficient.q) != 1 else ring.one  # only where a fraction goes with it: ½ l₂
    components = [Expr(ring, x.poly / factor.poly) for x in components]
    found, first = squares.turned_pair(ring, components), Prose()
    if found is not None:
        components = squares.exchanged(components, found)
        known = said([pythagoras(angle_node(found.pair.angle, ring.names))])
        first = say("With {known}{mixed}", known=known, mixed=_mixed_products(context, found))
    rows = [[squares.factor_of_rate(x, q.name) for q in robot.coordinates] for x in components]
    places = combinations_with_replacement(range(robot.n), 2)
    entries = [_entry(context, rows, i, j) for i, j in places]
    shown = [entry for entry in entries if entry is not None]
    used = dict.fromkeys(identity for entry in shown for identity in entry.used)
    if len(shown) < len(entries) or not used or (found is None and len(used) < 2):
        return None
    return Way(tuple(_lines(context, body, shown, first, factor)), used=tuple(used))


def _mixed_products(context: Context, found: squares.Turned) -> Prose:
    """That the terms with s c cancel, if there are any in (U s + V c)(X s + Y c) + (U c - V s)(X c - Y s)."""
    slopes = [
        [squares.factor_of_rate(part, q.name) for part in found.parts] for q in context.robot.coordinates
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
    products, result = squares.products(context, pairs, is_square=i == j), context.show(value)
    used = identities(ring, products, result)
    if used is None:
        return None
    multiplied = products
    if used and _has_sums(products):
        found = squares.groups(context.forms, sum((a.poly * b.poly for a, b in pairs), start=ring.zero.poly))
        if found is None:
            return None
        multiplied = sum_of([group.multiplied for group in found])
        if are_alike(multiplied, products):
            multiplied = products
    elif i == j:
        products = multiplied = _in_brackets(products)
    if proved(value, [("", products), ("", multiplied)]) is None:
        return None
    return _Entry((i, j), products, multiplied, identities(ring, multiplied, result) or ())


def _in_brackets(squares_shown: Node) -> Node:
    """l² s² + l² c² as l² (s² + c²): the squares of one length stand in one bracket."""
    terms = squares_shown.terms if isinstance(squares_shown, Sum) else (squares_shown,)
    angular: dict[tuple[Node, ...], list[Node]] = {}
    for term in terms:
        lengths = tuple(factor for factor in factors_of(term) if not is_trigonometric(factor))
        others = [(factor, 1) for factor in factors_of(term) if is_trigonometric(factor)]
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
    plain = {entry.place: entry.products for entry in entries}
    expanded = {entry.place: entry.multiplied for entry in entries}
    operation = "Multiplied out" if first else "The columns multiplied with each other"
    stages: list[tuple[str | Prose, dict[tuple[int, int], Node]]] = [(first, plain)] if first else []
    if expanded != plain or not first:
        stages.append((operation, expanded))
    n, columns = context.robot.n, letters.transposed_product(letters.jv(body))
    matrices = [
        tree.Matrix(tuple(tuple(found[min(i, j), max(i, j)] for j in range(n)) for i in range(n)))
        for _, found in stages
    ]
    whole = Product((context.forms.mass(body), columns))
    if all(matrix_width(context, matrix) <= WIDEST for matrix in matrices):
        front = factors_of(_in_front(context, [body.mass, factor * factor]))
        for (by, _), matrix in zip(stages, matrices, strict=True):
            yield Line(say("{by}:", by=by), (equation(whole, Product((*front, matrix))),))
        return
    by = say(
        "{first}, entry by entry{then} (the matrix is symmetric{zero}):",
        first=first or operation,
        then=", then multiplied out" if first and expanded != plain else "",
        zero=", all other entries are 0" if ZERO in plain.values() else "",
    )
    scalars = [body.mass] * body.mass.is_number + [factor * factor] * (factor != factor.ring.one)
    front = factors_of(_in_front(context, scalars)) if scalars else ()
    named = whole if body.mass.is_number else columns
    shown = []
    for i, j in (place for place, products in plain.items() if products != ZERO):
        members = [found[i, j] for _, found in stages]
        if scalars:
            members = [_times(front, member) for member in members]
        shown.append(equation(Entry(named, Row((Number(i + 1), Number(j + 1)))), *dict.fromkeys(members)))
    yield Line(by, tuple(shown))


def _times(front: tuple[Node, ...], member: Node) -> Node:
    return Product(
        (*front, *(factors_of(member) if isinstance(member, Product) else (Parenthesized(member),)))
    )


def _in_front(context: Context, scalars: Sequence[Expr]) -> Node:
    """The product of scalars as it stands before a matrix: ¼ m₂ l₂²."""
    return number_in_front(times(1, [(context.show(x), 1) for x in scalars if x != x.ring.one]))
