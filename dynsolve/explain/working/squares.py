"""The lines from ½ m vᵀ v to the kinetic energy of translation: how squares become the square of the speed.

1. Two components that are one vector, turned by an angle, are exchanged for that vector:
   (U s + V c)² + (U c - V s)² = U² + V².
2. What is left is multiplied out and sorted by lengths and rates, the sines and cosines in
   brackets: l₁ l_c2 (s₁ s₁₂ + c₁ c₁₂) q̇₁ (q̇₁ + q̇₂).  A square that shares no product of
   rates with others stays as it is.
3. The brackets become 1, or the cosine of a difference.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import combinations, combinations_with_replacement
from math import gcd, lcm
from typing import Any, NamedTuple

from flint import fmpq_mpoly
from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.angles import angle_node
from dynsolve.algebra.generators import Generator, Pair
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.rationals import fraction
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.derivation.kinematics import rotation
from dynsolve.document import Prose
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.forms import Forms
from dynsolve.explain.step import Line
from dynsolve.explain.working.identities import (
    COLLECTED,
    IN_TURN,
    NUMBERS,
    SILENT,
    SORTED,
    Tactic,
    Way,
    Words,
    are_alike,
    are_in_basic_angles,
    by,
    chain,
    collected,
    identities,
    opened_squares,
    product_line,
    said,
    squares_of_sums,
    with_more,
)
from dynsolve.explain.writing import block_of, listed, sum_of
from dynsolve.notation import tree
from dynsolve.notation.build import (
    cost,
    factors_of,
    negated,
    number_in_front,
    split_sign,
    summands,
    times,
    total,
)
from dynsolve.notation.differentiation import brackets, has_rates, is_trigonometric
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    ONE,
    ZERO,
    Function,
    Letter,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    Transpose,
    walk,
)
from dynsolve.quantities import letters
from dynsolve.robot.model import Body, Robot


def written_velocity(context: Context, body: Body) -> tree.Matrix:
    """v of a mass centre, as U s + V c where two components are a vector turned by an angle."""
    return _written(context, context.values[f"v{body.name}"], context.matrix(f"v{body.name}"))


def squared(context: Context, body: Body) -> Node:
    """½ m vᵀ v with the entries of v put in; what these share stands before the squares, squared.

    A sum of squares that is in the energy, too, stands in that order: ½ m (ẋ² + ẏ²), whatever axis is first.
    """
    factor, value = _with_factor(context, body)
    form = context.show(value)
    assert isinstance(form, tree.Matrix)
    entries = [entry for (entry,) in _written(context, value, form).rows if entry != ZERO]
    added = sum_of([_square(entry) for entry in entries])
    orders = {frozenset(summands(one)): one for one in brackets(context.form(f"Kv{body.name}"))}
    return _energy(context, body, orders.get(frozenset(summands(added)), added), factor)


def _with_factor(context: Context, body: Body) -> tuple[Shared, Matrix]:
    """What the entries of v share, and what it is multiplied by."""
    ring, value = context.robot.ring, context.values[f"v{body.name}"]
    factor = shared(context.robot, value.entries)
    whole = factor.length * factor.rate
    return factor, value.map(lambda entry: Expr(ring, entry.poly / whole.poly))


def _energy(context: Context, body: Body, added: Node, factor: Shared | None = None) -> Node:
    """½ m a² q̇² (...), a and q̇ being what is taken out of the"""
    mass, parts = context.show(body.mass), (factor.length, factor.rate) if factor else ()
    taken = [(context.show(part), 2) for part in parts if part != context.robot.ring.one]
    if not taken:
        return Product((letters.HALF, mass, added))
    front = number_in_front(times(Fraction(1, 2), [(mass, 1), *taken]))
    return front if added == ONE else Product((*factors_of(front), added))


def _written(context: Context, value: Matrix, form: tree.Matrix) -> tree.Matrix:
    """A velocity as U s + V c where two components are a vector turned by an angle.

    Other forms stay where they hold that sine and that cosine once, and so show U and V too.
    """
    ring, places = context.robot.ring, [k for k, x in enumerate(value.entries) if not x.is_zero]
    found = turned_pair(ring, [value[k, 0] for k in places])
    if found is None or not context.is_short or any(part.is_zero for part in found.parts):
        return form
    angle = angle_node(found.pair.angle, ring.names)
    angular = [ring.generator(k) for k in (found.pair.sine, found.pair.cosine)]
    rows = list(form.rows)
    for is_second, place in enumerate(found.places):
        k = places[place]
        if sum(part in (Function("sin", angle), Function("cos", angle)) for part in walk(rows[k][0])) > 2:
            beside = _coefficients(value[k, 0], found.pair)
            assert beside is not None
            terms = [_product(context, *pair) for pair in zip(angular, beside, strict=True)]
            rows[k] = (total([*reversed(terms)] if is_second else terms),)
    return tree.Matrix(tuple(rows))


def _product(context: Context, angular: Expr, factor: Expr) -> Node:
    """A sine or cosine times its factor, which stays in one bracket."""
    shown = context.show(angular * factor)
    return times(1, [(context.show(x), 1) for x in (angular, factor)]) if isinstance(shown, Sum) else shown


def linear(context: Context, body: Body, squares_shown: bool) -> Way:
    """From the sum of the squares of v to K_v, along the axes of the first frame in which they come apart.

    Those along the base's axes are of use where they are shown before.  Where the squares come apart in no
    frame, they are multiplied out where they are shortest.
    """
    velocity = context.values[f"v{body.name}"]
    if velocity.is_zero or body.mass.is_zero:
        return SILENT
    if not context.is_short:
        return Way(concluding=_collected_at_once(context, body)) if squares_shown else SILENT
    factor, rest = _with_factor(context, body)
    if squares_shown and (at_once := _as_shown(context, body)):
        return _chain(context, body, [], at_once, factor)
    if squares_shown and (way := _from_components(context, body, rest, factor)):
        return way
    each = list(along_axes(context, body))
    for i, along in each:
        if (way := _from_components(context, body, along)) is not None:
            return _begun_along(context, body, i, way)
    i, along = min(each, key=lambda pair: _lengths_along(context, velocity, pair[1]))
    return _begun_along(context, body, i, _squared(context, body, along))


def _lengths_along(context: Context, velocity: Matrix, along: Matrix) -> tuple[int, int]:
    """The operations, and the minus signs, of the lines in which squares along axes are multiplied out."""
    components = [x for x in along.entries if not x.is_zero]
    turned = components if along != velocity else []
    shown = [*map(context.show, turned), *(whole for _, whole, _ in _by_rates(context, components))]
    minuses = (part for one in shown for part in walk(one) if isinstance(part, Negative))
    return sum(map(cost, shown)), len(list(minuses))


def _as_shown(context: Context, body: Body) -> Prose:
    """How squares become K_v in one line as they are shown; nothing where that takes more.

    Those of products by one identity, or where numbers add up, ¼ + ¾; those of sums multiplied out, where
    the angles in them are none of the ring, along whose axes they are longer.
    """
    before, value = squared(context, body), context.values[f"v{body.name}"].entries
    bases = [each.base for each in walk(before) if isinstance(each, Power)]
    sums = (part for base in bases for part in walk(base) if isinstance(part, Sum))
    if squares_of_sums(before) or any(map(is_trigonometric, sums)):
        return () if are_in_basic_angles(context, value) else _collected_at_once(context, body)
    after = context.form(f"Kv{body.name}")
    used = identities(context.robot.ring, before, after)
    if used is None or len(used) > 1 or not (used or any(map(has_roots, value))):
        return ()
    return say("By {used}:", used=said(used)) if used else collected(context.robot.ring, before, after)


def _collected_at_once(context: Context, body: Body) -> Prose:
    """How the squares of v become K_v in one step; nothing where they are the same."""
    before, after = squared(context, body), context.form(f"Kv{body.name}")
    used = identities(context.robot.ring, before, after)
    if used is None or IN_TURN in used or are_alike(before, after):
        return ()
    return with_more(by("Multiplied out", used), ", and collected:")


def _begun_along(context: Context, body: Body, i: int | None, way: Way) -> Way:
    """The lines from v along the axes of another frame, and before them v brought there."""
    v, value = letters.of_body("v", body, "bold"), context.values[f"v{body.name}"]
    if i is None or turn_of_frame(context, i)[0].T @ value == value:
        return way
    kept, written = say("the length of {v}", v=v), written_velocity(context, body)
    line = turning_line(context, i, v, value, written, kept)
    return replace(way, lines=(line, *way.lines), frame=i)


def along_axes(context: Context, body: Body) -> Iterator[tuple[int | None, Matrix]]:
    """The velocity of a body along the axes of each frame up to its link; as it is where there are none."""
    velocity = context.values[f"v{body.name}"]
    if not context.robot.has_table:
        yield None, velocity
        return
    for i in range(body.link + 1):
        yield i, rotation(context.values[f"H{i}"]).T @ velocity


def _squared(context: Context, body: Body, velocity: Matrix) -> Way:
    """The squares of some components, and these by the products of the rates, which become the result."""
    ring, components = context.robot.ring, [x for x in velocity.entries if not x.is_zero]
    form = context.form(f"Kv{body.name}")
    found = list(_by_rates(context, components))
    last = total([whole for _, whole, _ in found])
    has_many = isinstance(last, Sum)
    tactics: list[Tactic] = [(SORTED, last)] if has_many else []
    if not has_many or velocity != context.values[f"v{body.name}"]:
        tactics.insert(0, ("The squares of its entries:", _sum_of_squares(context, components)))
    last = tactics[-1][1]
    used = [identities(ring, bracket, context.show(value)) or () for bracket, _, value in found]
    words = collected(ring, _energy(context, body, last), form)
    if any(used):
        each = dict.fromkeys(identity for some in used for identity in some)
        opened = "Multiplied out, with" if opened_squares(last, form) else "With"
        words = say(f"{opened} {{used}}{', and collected' * has_many}:", used=said(list(each)))
    squares = sum((x.poly * x.poly for x in components), ring.zero.poly)
    shown = {*walk(last)}
    cancelled = [one for one in _cancelled(context, components, squares) if shown.issuperset(factors_of(one))]
    if cancelled and words:
        words = (*with_more(words, ""), *say(" (the terms with {found} cancel):", found=listed(cancelled)))
    return _chain(context, body, tactics, words)


def _by_rates(context: Context, components: Sequence[Expr]) -> Iterator[tuple[Node, Node, Expr]]:
    """Σ (a_k q̇_k)² as Σ a_k² q̇_k² and 2 Σ a_j a_k q̇_j q̇_k, the factors a as they stand.

    What stands beside each product of rates, with these, and its value.
    """
    decimal = context.robot.has_decimals
    for first, second in combinations_with_replacement(context.robot.coordinates, 2):
        slopes = [[factor_of_rate(x, q.name) for q in (first, second)] for x in components]
        pairs = [(a, b) for a, b in slopes if not (a.is_zero or b.is_zero)]
        value = sum((a * b for a, b in pairs), start=context.robot.ring.zero)
        if first == second:
            bracket = sum_of([_square(context.show(a)) for a, _ in pairs])
            whole = times(1, [(bracket, 1), (letters.velocity(first), 2)], decimal=decimal)
        else:
            bracket = products(context, pairs, is_square=False)
            both = [(letters.velocity(q), 1) for q in (first, second)]
            whole = times(2, [(bracket, 1), *both], decimal=decimal)
        yield bracket, whole, value


def products(context: Context, pairs: Sequence[tuple[Expr, Expr]], is_square: bool) -> Node:
    """Σ a b, or Σ a², each in printing order."""
    collector = context.forms.compactor.collector
    terms: list[Node] = []
    for pair in pairs:
        shown = [context.show(x) for x in pair]
        bare = [without_signs(x) for x in shown]
        found = collector.product(*collector.decompose(Product(tuple(bare))), ())
        if isinstance(found, Quotient) and any(isinstance(part, Quotient) for part in walk(found.numerator)):
            found = number_in_front(found)  # l (a + b/2)/2 as ½ l (a + b/2): no fraction in another
        opposite = (shown[0] != bare[0]) != (shown[1] != bare[1])
        terms.append(negated(found) if opposite and not is_square else found)
    return sum_of(terms) if is_square else total(terms)


def _from_components(
    context: Context, body: Body, velocity: Matrix, factor: Shared | None = None
) -> Way | None:
    """The lines from the squares of some components on; None where these do not come apart plainly.

    With a `factor` that the components share the squares are shown already.
    """
    ring, form = context.robot.ring, context.form(f"Kv{body.name}")
    components = [x for x in velocity.entries if not x.is_zero]
    tactics: list[Tactic] = []
    if factor is None and velocity != context.values[f"v{body.name}"]:
        tactics.append(("The squares of its entries:", _sum_of_squares(context, components)))
    turned = False  # where one pair of squares is exchanged the next is too, plain as it may be
    while (found := turned_pair(ring, components)) is not None and (turned or not _is_plain(found)):
        components, turned = exchanged(components, found), True
        tactics.append((_turn(context, found), _sum_of_squares(context, components)))
    if any(has_roots(x) for x in components):
        return None
    if any(len(x) > 1 for x in components):
        multiplied = _multiplied(context, components, form)
        if multiplied is None:
            return None
        tactics += multiplied
        before = tactics[-1][1] if tactics else _sum_of_squares(context, components)
        last_words: Prose | Words = collected(ring, _energy(context, body, before, factor), form)
        if multiplied and last_words == COLLECTED:
            words, _ = tactics.pop()
            assert isinstance(words, Words)
            last_words = Words(*(with_more(each, ", and collected:") for each in (words.by, words.joined)))
        return _chain(context, body, tactics, last_words, factor)
    concluding: str | Prose | Words = ()
    if tactics:
        words, last = tactics[-1]
        energy = _energy(context, body, last, factor)
        is_bracketed = len(brackets(form)) > len(brackets(energy))  # d₃² of two squares
        if is_bracketed or identities(ring, energy, form):
            concluding = collected(ring, energy, form)
        else:
            concluding = words
            tactics.pop()
    return _chain(context, body, tactics, concluding, factor)


def _chain(
    context: Context,
    body: Body,
    tactics: Sequence[Tactic],
    concluding: str | Prose | Words,
    factor: Shared | None = None,
) -> Way:
    front = factors_of(context.form(f"Kv{body.name}"))[:2]
    is_kept = front == (letters.HALF, context.show(body.mass))
    if concluding and concluding != NUMBERS and body.mass.is_number and not is_kept:
        said_before = concluding.by if isinstance(concluding, Words) else say("{words}", words=concluding)
        concluding = with_more(said_before, "; the numbers multiplied:")
    lines = [(words, _energy(context, body, added, factor)) for words, added in tactics]
    return chain(context, f"Kv{body.name}", letters.energy_part("v", body), lines, concluding)


def _is_plain(found: Turned) -> bool:
    """Whether a turned vector is of two products without angles: (V c - U s)² is soon multiplied out."""
    angular = [g.index for g in found.parts[0].ring.generators if g.kind in ("sin", "cos")]
    return all(len(part) == 1 and not any(part.poly.degrees()[i] for i in angular) for part in found.parts)


def _turn(context: Context, found: Turned) -> Prose:
    """The identity by which a turned vector has the square of the vector, and what goes in for U and V.

    They are any two quantities, so that they mean the same wherever the identity is used.
    """
    angle = angle_node(found.pair.angle, context.robot.ring.names)
    if any(part.is_zero for part in found.parts):
        return say("By $sin² {A} + cos² {A} = 1$:", A=angle)
    shown = [context.show(part) for part in found.parts]
    first, second = map(without_signs, shown)
    left = "({U} sin {A} + {V} cos {A})² + ({U} cos {A} - {V} sin {A})²"
    if (first == shown[0]) != (second == shown[1]):  # one of them without its minus
        left = "({V} cos {A} - {U} sin {A})² + ({U} cos {A} + {V} sin {A})²"
    text = "By $" + left + " = {U}² + {V}²$ with {first} and {second} for {U} and {V}:"
    U, V = letters.IN_IDENTITIES
    return say(text, A=angle, first=first, second=second, U=U, V=V)


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


def _multiplied(context: Context, components: Sequence[Expr], form: Node) -> list[Tactic] | None:
    """The squares multiplied out, and the brackets worked out; at once where sums of lengths stay in these.

    None where a bracket holds rates too, or there are many, and where the squares are written otherwise than
    in the ring, in which they are multiplied out here: s₃² c₁² is none of what (a s₃)² has.
    """
    ring = context.robot.ring
    alone, together = _separate(ring, components)
    if not together:
        return []
    poly = sum((x.poly * x.poly for x in together), start=ring.zero.poly)
    found = groups(context.forms, poly)
    if found is None:
        return None
    first = [_sum_of_squares(context, alone)] if alone else []
    multiplied, reduced = (sum_of([*first, *forms]) for forms in zip(*found, strict=True))
    if identities(ring, _sum_of_squares(context, components), multiplied):
        return None
    used = identities(ring, multiplied, reduced)
    if not used:
        return []
    which: Prose = ("The squares",)
    if alone == list(components[: len(alone)]) and alone:  # of one alone, none would be
        which = say("The last{count} squares", count={2: " two", 3: " three"}.get(len(together), ""))
    elif alone:
        which = say("All but {kept}", kept=listed([_square(context.show(x)) for x in alone]))
    cancelled = list(_cancelled(context, together, poly))
    with_these = say("the terms with {found} cancel", found=listed(cancelled)) if cancelled else ()
    by = say(
        "{which} multiplied out{cancelled}:",
        which=which,
        cancelled=say("; {these}", these=with_these) if cancelled else "",
    )
    at_once = say(
        "Multiplied out{cancelled}, with {used}:",
        cancelled=say(" ({these})", these=with_these) if cancelled else "",
        used=said(used),
    )
    kept = brackets(_sum_of_squares(context, together)) & brackets(form)
    if any(not (has_rates(each) or is_trigonometric(each)) for each in kept):
        return [(Words(at_once, at_once), reduced)]
    return [(by, multiplied), (Words(say("By {used}:", used=said(used)), at_once), reduced)]


def _cancelled(context: Context, components: Sequence[Expr], total: fmpq_mpoly) -> Iterator[Node]:
    """The products of two rates, or else of a sine and its cosine, that the sum of the squares loses."""
    ring = context.robot.ring
    squares = [x.poly * x.poly for x in components]
    gone = {one for square in squares for one in products_of_rates(ring, square)}
    yield from (found := rates_named(ring, gone - products_of_rates(ring, total)))
    if found:
        return
    left = {tuple(map(int, e)) for e in total.to_dict()}
    lost = {tuple(map(int, e)) for square in squares for e in square.to_dict()} - left
    for pair in ring.pairs:
        if any(e[pair.sine] and e[pair.cosine] for e in lost) and not any(
            e[pair.sine] and e[pair.cosine] for e in left
        ):
            yield formula("sin {A} cos {A}", A=angle_node(pair.angle, ring.names))


# -- the components of a velocity ------------------------------------------------------------------


class Turned(Struct, frozen=True):
    """Two components, by their places, that are (a, b) turned by the angle of a pair."""

    pair: Pair
    places: tuple[int, int]
    parts: tuple[Expr, Expr]


def turned_pair(ring: Ring, components: Sequence[Expr]) -> Turned | None:
    """The first two components that are a vector turned by a basic angle: a s + b c and ±(a c - b s)."""
    for pair in ring.pairs:
        linear = [(k, found) for k, x in enumerate(components) if (found := _coefficients(x, pair))]
        for (i, (a, b)), (j, (x, y)) in combinations(linear, 2):
            if (x == b and y == -a) or (x == -b and y == a):
                return Turned(pair, (i, j), (a, b))
    return None


def _coefficients(x: Expr, pair: Pair) -> tuple[Expr, Expr] | None:
    """(a, b) of a s + b c, the coefficients free of both; None for anything else, and for 0."""
    poly = x.poly
    a, b = poly.derivative(pair.sine), poly.derivative(pair.cosine)
    if not (a or b) or any(p.degrees()[g] > 0 for p in (a, b) for g in (pair.sine, pair.cosine)):
        return None
    s, c = x.ring.generator(pair.sine).poly, x.ring.generator(pair.cosine).poly
    return (Expr(x.ring, a), Expr(x.ring, b)) if poly == a * s + b * c else None


def exchanged(components: Sequence[Expr], found: Turned) -> list[Expr]:
    """The components with a turned vector in place of two of them."""
    rest = [x for k, x in enumerate(components) if k not in found.places]
    return [x for x in found.parts if not x.is_zero] + rest


class Shared(Struct, frozen=True):
    """What all components of a velocity share: ½ l₂ and q̇₁ of l₂ s₁ q̇₁/2 and l₂ c₁ q̇₁/2; 1 for nothing."""

    length: Expr
    rate: Expr


def shared(robot: Robot, components: Sequence[Expr]) -> Shared:
    """The powers of lengths, with the number before them, and of rates that all components share.

    Of decimals they share nothing.
    """
    ring = robot.ring
    if robot.has_decimals:
        return Shared(ring.one, ring.one)
    terms = [term for x in components for term in x.poly.to_dict().items()]

    def common(generators: Iterable[Generator]) -> Expr:
        product = ring.one
        for g in generators:
            power = min((int(exponents[g.index]) for exponents, _ in terms), default=0)
            product = product * ring.generator(g.index) ** power
        return product

    symbols = [g for g in ring.generators if g.kind == "symbol"]
    length = common(g for g in symbols if g.name in ring.parameters)
    if length != ring.one:
        numbers = [fraction(number) for _, number in terms]
        above, below = gcd(*(n.numerator for n in numbers)), lcm(*(n.denominator for n in numbers))
        length = length * Fraction(above, below)
    return Shared(length, common(g for g in symbols if g.dots == 1))


def factor_of_rate(x: Expr, coordinate: str) -> Expr:
    """The factor of q̇ in a component of a velocity."""
    return Expr(x.ring, x.poly.derivative(x.ring.symbol_indices[(coordinate, 1)]))


def _separate(ring: Ring, components: Sequence[Expr]) -> tuple[list[Expr], list[Expr]]:
    """(components whose squares share no product of rates with the others, all others)"""
    rates = [products_of_rates(ring, x.poly * x.poly) for x in components]
    alone: list[Expr] = []
    together: list[Expr] = []
    for k, x in enumerate(components):
        others = {rate for j, held in enumerate(rates) if j != k for rate in held}
        (together if rates[k] & others else alone).append(x)
    return alone, together


def products_of_rates(ring: Ring, poly: fmpq_mpoly) -> set[tuple[int, ...]]:
    """The products of rates that occur, as exponents."""
    places = [ring.symbol_indices[(name, 1)] for name in ring.names]
    return {tuple(e[i] for i in places) for e in poly.to_dict()}


def rates_named(ring: Ring, products: Iterable[tuple[int, ...]], *, by_name: bool = False) -> list[Node]:
    """The products of rates of these exponents as formulas, the rates as the coordinates or by names."""
    found: list[Node] = []
    for one in sorted(products, reverse=True):
        powers = [(name, power) for name, power in zip(ring.names, one, strict=True) if power]
        in_order = sorted(powers) if by_name else powers
        found.append(times(1, [(Symbol(name, 1), power) for name, power in in_order]))
    return found


def has_roots(x: Expr) -> bool:
    """Whether a square root or the cosine of a constant angle stands in an expression."""
    degrees = x.poly.degrees()
    return any(g.kind in ("root", "constant") and degrees[g.index] > 0 for g in x.ring.generators)


MOST_GROUPS = 8
"""Up to this number of groups of terms squares are multiplied out term by term."""


class Group(NamedTuple):
    """Terms with the same lengths and angles: as they stand, and with the brackets worked out."""

    multiplied: Node
    reduced: Node


def groups(forms: Forms, poly: fmpq_mpoly) -> list[Group] | None:
    """A polynomial before s² + c² = 1 is used, by lengths and by the angles of its sines and cosines.

    None where sines and cosines do not come apart from rates, or there are many groups.
    """
    ring = forms.robot.ring
    trig = [(pair.sine, pair.cosine) for pair in ring.pairs]
    angular = {g for both in trig for g in both}
    rates = {ring.symbol_indices[(name, 1)] for name in ring.names}
    split: dict[tuple[tuple[int, ...], tuple[int, ...]], dict[tuple[int, ...], Any]] = {}
    for e, factor in poly.to_dict().items():
        angles = tuple(int(e[s] + e[c]) for s, c in trig)
        lengths = tuple(int(x) for i, x in enumerate(e) if i not in angular and i not in rates)
        split.setdefault((angles, lengths), {})[e] = factor
    if len(split) > MOST_GROUPS:
        return None
    in_order = sorted(split, key=lambda key: (sum(map(bool, key[0])) > 1, [-a for a in key[0]]))
    made = [_group(forms, ring.ctx.from_dict(split[key]), angular, rates) for key in in_order]
    return None if None in made else [group for group in made if group is not None]


def _group(forms: Forms, poly: fmpq_mpoly, angular: set[int], rates: set[int]) -> Group | None:
    """The product of the factors: lengths, what is in brackets, rates; None for a bracket with rates."""
    ring, decimal = forms.robot.ring, forms.robot.has_decimals
    content, factors = poly.factor()
    lengths = Expr(ring, ring.one.poly)
    bracketed: list[tuple[fmpq_mpoly, int]] = []
    velocities: list[tuple[fmpq_mpoly, int]] = []
    for factor, exponent in factors:
        held = {i for i, degree in enumerate(factor.degrees()) if degree > 0}
        if held & angular and held & rates:
            return None
        if held & angular:
            bracketed.append((factor, int(exponent)))
        elif held & rates:
            velocities.append((factor, int(exponent)))
        else:
            lengths = lengths * Expr(ring, factor) ** int(exponent)
    order = [ring.symbol_indices[(name, 1)] for name in ring.names]
    velocities.sort(key=lambda one: (len(one[0]), [one[0].degrees()[i] <= 0 for i in order]))
    rest = [(forms.of(Expr(ring, factor)), exponent) for factor, exponent in velocities]

    def written(bracket: Callable[[fmpq_mpoly], Node]) -> Node:
        inner = [(bracket(factor), exponent) for factor, exponent in bracketed]
        return times(fraction(content), [(forms.of(lengths), 1), *inner, *rest], decimal=decimal)

    return Group(
        written(lambda factor: _terms(ring, factor)),
        written(lambda factor: forms.of(Expr(ring, ring.reduce(factor)))),
    )


def factored(forms: Forms, poly: fmpq_mpoly) -> Node:
    """A polynomial before s² + c² = 1 is used, as what that leaves alone times what it changes."""
    ring = forms.robot.ring
    content, factors = poly.factor()
    kept, changed = ring.one, list[tuple[Node, int]]()
    for factor, exponent in factors:
        if ring.reduce(factor) == factor:
            kept = kept * Expr(ring, factor) ** int(exponent)
        else:
            changed.append((_terms(ring, factor), int(exponent)))
    front = fraction(content)
    if len(kept) > 1:  # a sum keeps the fractions of its terms
        kept, front = kept * ring.constant(front), Fraction(1)
    return times(front, [(forms.of(kept), 1), *changed], decimal=forms.robot.has_decimals)


def _terms(ring: Ring, poly: fmpq_mpoly) -> Node:
    terms: list[Node] = []
    for powers, number in poly.to_dict().items():
        found = [(ring.generators[i], int(e)) for i, e in enumerate(powers) if e]
        found.sort(key=lambda power: power[0].kind != "root")  # √3 s c
        terms.append(times(fraction(number), [(_generator(ring, g), e) for g, e in found]))
    return total(terms)


def _generator(ring: Ring, g: Generator) -> Node:
    if g.kind in ("sin", "cos"):
        return Function(g.kind, angle_node(g.angle, ring.names))
    if g.node is None:
        return Symbol(g.name, g.dots)
    return Function("sqrt", g.node) if g.kind == "root" else g.node


# -- a velocity, or the columns of a Jacobian, brought to the axes of frame i by (R_i^w)ᵀ ----------
# A rotation leaves lengths and products of vectors unchanged: where the entries are long in the world, their
# squares and products are worked out along the axes of a frame in which they come apart.


def turned_name(context: Context, i: int, letter: Letter) -> Product:
    """(R_i^w)ᵀ v, in letters."""
    return Product((Transpose(letters.R(context.robot, i)), letter))


def turning_line(
    context: Context, i: int, letter: Letter, value: Matrix, written: tree.Matrix, kept: str | Prose
) -> Line:
    """(R_i^w)ᵀ v with both matrices, and what it is; `kept` says what the rotation leaves unchanged."""
    by = say("A rotation leaves {kept} unchanged; along the axes of frame {i}", kept=kept, i=i)
    name, turn = turned_name(context, i, letter), turn_of_frame(context, i)
    return product_line(context, by, [name], turn, (value, written), tells_what_cancels=False)


def turn_of_frame(context: Context, i: int) -> tuple[Matrix, tree.Matrix]:
    """R_i^w, and its form."""
    return rotation(context.values[f"H{i}"]), block_of(context.matrix(f"H{i}"), 3, 0, 3)
