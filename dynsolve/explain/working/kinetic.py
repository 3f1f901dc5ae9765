"""The lines from ½ m vᵀ v to the kinetic energy of translation."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations_with_replacement

from flint import fmpq_mpoly

from dynsolve.algebra.angles import angle_node
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.kinematics import rotation
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.forms import is_numeric
from dynsolve.explain.step import Line
from dynsolve.explain.working import squares
from dynsolve.explain.working.differentiation import brackets, sums_of_rates
from dynsolve.explain.working.identities import (
    SILENT,
    Identity,
    Way,
    chain,
    identities,
    said,
    used_in_product,
)
from dynsolve.explain.writing import block_of, is_small, listed, sum_of
from dynsolve.notation import tree
from dynsolve.notation.build import factors_of, negated, number_in_front, split_sign, times, total
from dynsolve.notation.tree import (
    ONE,
    Function,
    Letter,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Sum,
    Symbol,
    Transpose,
    equation,
)
from dynsolve.notation.unicode import to_unicode
from dynsolve.notation.walk import walk
from dynsolve.quantities import letters
from dynsolve.robot.model import Body

MOST_GROUPS = 8
"""Up to this number of groups of terms squares are multiplied out term by term."""


def collected(before: Node, after: Node) -> Prose:
    """What is done to a line that needs no identity: its sums of rates are multiplied out, if they go."""
    opened = sums_of_rates(before) - sums_of_rates(after)
    return ("The sums of rates multiplied out, and collected:",) if opened else ("Collected:",)


def written_velocity(context: Context, body: Body) -> tree.Matrix:
    """v of a mass centre, as U s + V c where two components are a vector turned by an angle."""
    return _written(context, context.values[f"v{body.name}"], context.matrix(f"v{body.name}"))


def squared(context: Context, body: Body) -> Node:
    """½ m vᵀ v with the entries of v put in; what these share stands before the squares, squared."""
    factor, value = _with_factor(context, body)
    form = context.show(value)
    assert isinstance(form, tree.Matrix)
    entries = [row[0] for row in _written(context, value, form).rows if row[0] != Number(0)]
    return _energy(context, body, factor, sum_of([_square(x) for x in entries]))


def _with_factor(context: Context, body: Body) -> tuple[squares.Shared, Matrix]:
    """What the entries of v share, and what it is multiplied by; of decimals they share nothing."""
    ring, value = context.robot.ring, context.values[f"v{body.name}"]
    if is_numeric(context.robot):
        return squares.Shared(ring.one, ring.one), value
    factor = squares.shared(ring, value.entries)
    return factor, value.map(lambda entry: Expr(ring, entry.poly / factor.whole.poly))


def _energy(context: Context, body: Body, factor: squares.Shared | None, added: Node) -> Node:
    """½ m a² q̇² (...), a and q̇ being what is taken out of the squares."""
    mass, one = context.show(body.mass), context.robot.ring.one
    if factor is None or factor.whole == one:
        return Product((letters.HALF, mass, added))
    taken = [(context.show(part), 2) for part in (factor.length, factor.rate) if part != one]
    front = number_in_front(times(Fraction(1, 2), [(mass, 1), *taken]))
    if added == ONE:  # nothing is left in the squares
        return front
    return Product((*factors_of(front), added))


def _written(context: Context, value: Matrix, form: tree.Matrix) -> tree.Matrix:
    """A velocity as U s + V c where two components are a vector turned by an angle.

    Other forms stay where they hold that sine and that cosine once, and so show U and V too.
    """
    places = [k for k, x in enumerate(value.entries) if not x.is_zero]
    found = squares.turned(context.robot.ring, [value[k, 0] for k in places])
    if found is None or not context.is_short or any(part.is_zero for part in found.parts):
        return form
    angle = angle_node(found.pair.angle, context.robot.ring.names)
    s, c = Function("sin", angle), Function("cos", angle)
    by_angle = [context.robot.ring.generator(k) for k in (found.pair.sine, found.pair.cosine)]
    rows = list(form.rows)
    for is_second, place in enumerate(found.places):
        k = places[place]
        if sum(part in (s, c) for part in walk(rows[k][0])) > 2:
            factors = squares.parts(value[k, 0], found.pair)
            assert factors is not None
            terms = [_beside(context, each, factor) for each, factor in zip(by_angle, factors, strict=True)]
            rows[k] = (Sum(tuple(reversed(terms) if is_second else terms)),)
    return tree.Matrix(tuple(rows))


def _beside(context: Context, angular: Expr, factor: Expr) -> Node:
    """A sine or cosine times its factor, which stays in one bracket."""
    shown = context.show(angular * factor)
    if not isinstance(shown, Sum):
        return shown
    return times(1, [(context.show(angular), 1), (context.show(factor), 1)])


def linear(context: Context, body: Body, squares_shown: bool) -> Way:
    """From the sum of the squares of v to K_v, along the axes of the first frame in which they come apart.

    Those along the base's axes are of use where they are shown before.
    """
    written_velocity = context.values[f"v{body.name}"]
    if not context.is_short or written_velocity.is_zero or body.mass.is_zero:
        return SILENT
    factor, shown = _with_factor(context, body)
    found = _from_components(context, body, shown, factor) if squares_shown else None
    if found is not None:
        return found
    if not context.robot.has_table:
        return _from_components(context, body, written_velocity) or _squared(context, body, written_velocity)
    for i in range(body.link + 1):
        turned = rotation(context.values[f"H{i}"]).T @ written_velocity
        way = _from_components(context, body, turned)
        if way is not None:
            return _begun_along(context, body, i, way)
    return _begun_along(context, body, body.link, _squared(context, body, turned))


def _squared(context: Context, body: Body, written_velocity: Matrix) -> Way:
    """The squares of some components, and these by the products of the rates, which become the result."""
    components = [x for x in written_velocity.entries if not x.is_zero]
    lines: list[tuple[Prose, Node]] = [
        (("The squares of its entries:",), _sum_of_squares(context, components))
    ]
    brackets = list(_by_rates(context, components))
    used: dict[Identity, None] = {}
    for bracket in brackets:
        used |= dict.fromkeys(identities(context.robot.ring, bracket.tree, context.show(bracket.value)) or ())
    by_name = sorted(used, key=lambda identity: bool(identity.name))
    sorted_out = total([bracket.product for bracket in brackets])
    if sorted_out != lines[0][1]:
        lines.append((("Multiplied out, and sorted by the products of the rates:",), sorted_out))
    named: Prose = ("With ", *said(by_name), ", and collected:")
    if not used:
        named = collected(lines[-1][1], context.form(f"Kv{body.name}"))
    return _chain(context, body, lines, named)


@dataclass(frozen=True, slots=True)
class _Bracket:
    """What stands beside a product of rates in the square of a speed, with its value."""

    tree: Node
    value: Expr
    product: Node


def _by_rates(context: Context, components: Sequence[Expr]) -> Iterator[_Bracket]:
    """Σ (a_k q̇_k)² as Σ a_k² q̇_k² and 2 Σ a_j a_k q̇_j q̇_k, the factors a as they stand."""
    coordinates = context.robot.coordinates
    slopes = [[squares.factor_of_rate(x, q.name) for q in coordinates] for x in components]
    for j, k in combinations_with_replacement(range(len(coordinates)), 2):
        pairs = [(a[j], a[k]) for a in slopes if not (a[j].is_zero or a[k].is_zero)]
        if not pairs:
            continue
        first, second = (letters.velocity(coordinates[i]) for i in (j, k))
        value = sum((a * b for a, b in pairs), start=context.robot.ring.zero)
        if j == k:
            tree = sum_of([_square(context.show(a)) for a, _ in pairs])
            yield _Bracket(tree, value, times(1, [(tree, 1), (first, 2)]))
        else:
            tree = total([times(1, [(context.show(a), 1), (context.show(b), 1)]) for a, b in pairs])
            yield _Bracket(tree, value, times(2, [(tree, 1), (first, 1), (second, 1)]))


def _begun_along(context: Context, body: Body, i: int, way: Way) -> Way:
    """The lines from v along the axes of another frame, with v brought there before them."""
    v, value = letters.of_body("v", body, "bold"), context.values[f"v{body.name}"]
    line = turning_line(context, i, v, value, written_velocity(context, body), ("the length of ", v))
    return Way((line, *way.lines), way.concluding, frame=i)


def _from_components(
    context: Context, body: Body, written_velocity: Matrix, factor: squares.Shared | None = None
) -> Way | None:
    """The lines from the squares of some components on; None where these do not come apart plainly.

    With a `factor` that the components share the squares are shown already.
    """
    ring = context.robot.ring
    components = [x for x in written_velocity.entries if not x.is_zero]
    lines: list[tuple[Prose, Node]] = []
    if factor is None and written_velocity != context.values[f"v{body.name}"]:
        lines.append((("The squares of its entries:",), _sum_of_squares(context, components)))
    turned = False  # where one pair of squares is exchanged the next is too, plain as it may be
    while (found := squares.turned(ring, components)) is not None and (turned or not _is_plain(found)):
        components, turned = squares.exchanged(components, found), True
        lines.append((_turn(context, found), _sum_of_squares(context, components)))
    if any(squares.has_roots(x) for x in components):
        return None
    concluding: Prose = ()
    if all(len(x) == 1 for x in components):
        form = context.form(f"Kv{body.name}")
        shown = _energy(context, body, factor, lines[-1][1]) if lines else form
        takes_out = len(brackets(form)) > len(brackets(shown))  # d₃² of two squares
        concluding = ("Collected:",) if takes_out else lines.pop()[0] if lines else ()
    else:
        multiplied = _multiplied(context, components)
        if multiplied is None:
            return None
        lines += multiplied
        before = lines[-1][1] if lines else _sum_of_squares(context, components)
        concluding = collected(before, context.form(f"Kv{body.name}"))
        last = _energy(context, body, factor, lines[-1][1]) if lines else None
        if last is not None and to_unicode(last) == to_unicode(context.form(f"Kv{body.name}")):
            concluding = lines.pop()[0]
    return _chain(context, body, lines, concluding, factor)


def _chain(
    context: Context,
    body: Body,
    lines: list[tuple[Prose, Node]],
    concluding: Prose,
    factor: squares.Shared | None = None,
) -> Way:
    """The lines, each of them squares, as energies."""
    name = letters.energy_part("v", body)
    if concluding and body.mass.is_number:
        concluding = (*concluding[:-1], f"{str(concluding[-1]).removesuffix(':')}; the numbers multiplied:")
    return chain(
        context.values[f"Kv{body.name}"],
        [(by, _energy(context, body, factor, tree)) for by, tree in lines],
        lambda tree: equation(name, tree),
        concluding,
    )


def _is_plain(found: squares.Turned) -> bool:
    """Whether a turned vector is of two products without angles: (V c - U s)² is soon multiplied out."""
    angular = [g.index for g in found.parts[0].ring.generators if g.kind in ("sin", "cos")]
    return all(len(part) == 1 and not any(part.poly.degrees()[i] for i in angular) for part in found.parts)


def _turn(context: Context, found: squares.Turned) -> Prose:
    """The identity by which a turned vector has the square of the vector, and what goes in for U and V.

    They are any two quantities, so that they mean the same wherever the identity is used.
    """
    angle = angle_node(found.pair.angle, context.robot.ring.names)
    s, c = Function("sin", angle), Function("cos", angle)
    if any(part.is_zero for part in found.parts):
        return "By ", equation(Sum((Power(s, Number(2)), Power(c, Number(2)))), Number(1)), ":"
    U, V = Symbol("U"), Symbol("V")
    shown = [context.show(part) for part in found.parts]
    first, second = map(without_signs, shown)
    Us, Uc, Vs, Vc = (Product(pair) for pair in ((U, s), (U, c), (V, s), (V, c)))
    both = Sum((Us, Vc)), Sum((Uc, Negative(Vs)))
    if (first == shown[0]) != (second == shown[1]):  # one of them without its minus
        both = Sum((Vc, Negative(Us))), Sum((Uc, Vs))
    left = Sum(tuple(Power(Parenthesized(x), Number(2)) for x in both))
    identity = equation(left, Sum((Power(U, Number(2)), Power(V, Number(2)))))
    return "By ", identity, " with ", first, " and ", second, " for ", U, " and ", V, ":"


def _sum_of_squares(context: Context, components: Sequence[Expr]) -> Node:
    """(...)² + (...)², without the signs inside that do not count."""
    return sum_of([_square(context.show(x)) for x in components])


def _square(entry: Node) -> Node:
    """The square of an entry as it stands, without a sign that does not count."""
    base = without_signs(entry)
    return base if base == ONE else Power(base, Number(2))


def without_signs(node: Node) -> Node:
    """A base of a square with a plus in front where it has none but minus signs."""
    inner = split_sign(node)[1]
    if isinstance(inner, Sum) and all(isinstance(term, Negative) for term in inner.terms):
        return total([negated(term) for term in inner.terms])
    return inner


def _multiplied(context: Context, components: Sequence[Expr]) -> list[tuple[Prose, Node]] | None:
    """The squares multiplied out, and the brackets worked out.

    None where a bracket holds rates too, or there are many.
    """
    ring = context.robot.ring
    alone, together = squares.separate(ring, components)
    if not together:
        return []
    poly = sum((x.poly * x.poly for x in together), start=ring.zero.poly)
    found = squares.groups(context.forms, poly)
    if found is None:
        return None
    if len(found) > MOST_GROUPS:
        return None
    first = [_sum_of_squares(context, alone)] if alone else []
    multiplied = sum_of([*first, *(group.multiplied for group in found)])
    reduced = sum_of([*first, *(group.reduced for group in found)])
    which = _which(len(together), alone == list(components[: len(alone)])) if alone else "The"
    by: Prose = (f"{which} squares multiplied out, and sorted", *_cancelled(context, together, poly), ":")
    lines: list[tuple[Prose, Node]] = [(by, multiplied)]
    used = identities(ring, multiplied, reduced)
    if used:
        lines.append((("By ", *said(used), ":"), reduced))
    return lines


def _cancelled(context: Context, components: Sequence[Expr], total: fmpq_mpoly) -> Prose:
    """Which products of two rates stand in single squares, and no longer in their sum."""
    ring = context.robot.ring
    left = squares.products_of_rates(ring, total)
    gone = {one for x in components for one in squares.products_of_rates(ring, x.poly * x.poly)} - left
    found = [
        Product(tuple(Symbol(name, 1) for name, power in zip(ring.names, one, strict=True) if power))
        for one in sorted(gone, reverse=True)
    ]
    return ("; the terms with ", *listed(found), " cancel") if found else ()


def _which(count: int, come_last: bool) -> str:
    """Which of the squares are multiplied out, where it is not all of them; of one alone, none would be."""
    return f"The {'last' if come_last else 'other'} {({2: 'two', 3: 'three'}).get(count, '')}".rstrip()


# -- a velocity, or the columns of a Jacobian, brought to the axes of frame i by (R_i^w)ᵀ ----------
# A rotation leaves lengths and products of vectors unchanged: where the entries are long in the world, their
# squares and products are worked out along the axes of a frame in which they come apart.


def turned_name(context: Context, i: int, letter: Letter) -> Product:
    """(R_i^w)ᵀ v, in letters."""
    return Product((Transpose(letters.R(context.robot, i)), letter))


def turning_line(
    context: Context, i: int, letter: Letter, value: Matrix, written: tree.Matrix, kept: Prose
) -> Line:
    """(R_i^w)ᵀ v with both matrices, and what it is; `kept` says what the rotation leaves unchanged."""
    R = rotation(context.values[f"H{i}"])
    turned = R.T @ value
    block = block_of(context.matrix(f"H{i}"), 3, 0, 3)
    members: list[Node] = [turned_name(context, i, letter)]
    if is_small(block, written):
        members.append(Product((Transpose(block), written)))
    used = used_in_product(context, R.T, value, turned)
    by: Prose = ("A rotation leaves ", *kept, f" unchanged; along the axes of frame {i}")
    by += (", with ", *said(used), ":") if used else (":",)
    return Line(by, (equation(*members, context.show(turned)),))
