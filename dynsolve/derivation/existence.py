"""For which parameters expressions can be 0 together: how far sums of sines and cosines reach.

What fixes an angle at quarter turns is put into the others.  A sum of swings A cos φ + B sin φ, whose
angles φ are independent, takes every value between -Σ √(A² + B²) and Σ √(A² + B²).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from functools import partial
from itertools import combinations, permutations, product
from operator import mul
from typing import Any

from dynsolve.algebra.angles import Angle, name_alone, names_of
from dynsolve.algebra.fourier import Multiples, fourier_form, positive
from dynsolve.algebra.generators import Pair
from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.linear_systems import part, rank_parts
from dynsolve.algebra.matrix import Matrix, determinant
from dynsolve.algebra.rationals import rational
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import with_symbols
from dynsolve.algebra.sampling import Transfer
from dynsolve.algebra.spaces import nullspace
from dynsolve.derivation.elimination import ParameterSigns, rank, turn_of

DEGREES = {(0, 1): 0, (1, 0): 90, (0, -1): 180, (-1, 0): 270}
"""The quarter turns in degrees, by their sine and cosine."""

MOST_TURNING = 3
"""With more angles their quarter turns are not looked at."""

MOST_BRANCHES = 16
"""With more combinations of quarter turns nothing is said."""

Pose = dict[str, Fraction]
"""Angles in degrees."""

Swings = dict[Multiples, tuple[Expr, Expr]]
"""{n: (A, B)} of Σ A cos(n·q) + B sin(n·q)."""


def conditions(values: Sequence[Expr], signs: ParameterSigns) -> tuple[Bound, ...] | None:
    """What the parameters must satisfy for these to be 0 somewhere; None where they never are.

    Each is looked at apart, but for what fixes an angle at quarter turns; nothing is said where the choice
    of these leaves several conditions of which one is enough.  The discriminant of a
    quadratic in a length is not negative.
    """
    known = [swings for value in values if (swings := _swings(value)) is not None]
    found = [bounds for _, bounds in _choices(known, signs)]
    quadratics = filter(None, map(quadratic_of, values))
    lengths = not_negative([discriminant(*parts) for _, *parts in quadratics], signs)
    return (*_weakest(found, signs), *lengths) if found and lengths is not None else None


def quadratic_of(zero: Expr) -> tuple[int, Expr, Expr, Expr] | None:
    """(generator d, a, b, c) of a d² + b d + c with a length d, the others of parameters alone; else None."""
    ring, degrees = zero.ring, zero.poly.degrees()
    for name, kind in ring.coordinates:
        index = ring.symbol_indices[name, 0]
        if kind == "prismatic" and degrees[index] == 2:
            d, k = ring.generator(index), ring.names.index(name)
            slope = ring.diff(zero, k)
            a = ring.diff(slope, k) / 2
            b = slope - 2 * a * d
            c = zero - a * d * d - b * d
            if not any(map(ring.depends_on_coordinates, (a, b, c))):
                return index, a, b, c
    return None


def discriminant(a: Expr, b: Expr, c: Expr) -> Expr:
    """What is not negative where a d² + b d + c is 0 somewhere."""
    return b * b - 4 * a * c


def square_of(zero: Expr) -> tuple[int, Expr, Expr] | None:
    """(generator d, m, n) of m d² + n with a length d, and m and n of parameters alone; None of any other."""
    found = quadratic_of(zero)
    return (found[0], found[1], found[3]) if found and found[2].is_zero else None


def is_seen(values: Sequence[Expr], signs: ParameterSigns) -> bool:
    """Whether `conditions` are enough for these to be 0 together.

    Those in which the same coordinates stand are looked at together, without what has a coordinate of its own
    and is 0 somewhere whatever the others are.  They are 0 where no angle stands in two
    of their swings, where they are so at quarter turns without lengths, whatever the parameters, or where one
    stands alone and is positive somewhere and negative elsewhere, or a quadratic in a length,
    or where one swings along a line on which the other is 0, or both are a polygon that closes.
    """
    return all(
        _swing_apart(group, signs)
        or any(True for _ in zeros_at_quarters(group))
        or _swings_along(group, signs)
        or _is_closing(group, signs)
        or (len(group) == 1 and (quadratic_of(group[0]) is not None or _changes_sign(group[0], signs)))
        for group in map(partial(_without_solved, signs=signs), _apart(values))
    )


def _is_closing(values: Sequence[Expr], signs: ParameterSigns) -> bool:
    if len(values) != 2:
        return False
    x, y = map(_swings, values)
    return x is not None and y is not None and bool(_closing(x, y, [], signs))


def _without_solved(values: Sequence[Expr], signs: ParameterSigns) -> list[Expr]:
    """The values without those that a coordinate of their own makes 0, one after the other."""
    for value in values:
        others = [other for other in values if other is not value]
        own = {*coordinates_in(value)}.difference(*map(coordinates_in, others))
        degrees = {name: int(value.poly.degrees()[value.ring.symbol_indices[name, 0]]) for name in own}
        leading = (_leading(value, name, degree) for name, degree in degrees.items() if degree % 2)
        if _is_turned_to_0(value, own) or any(_is_never_zero(one, others, signs) for one in leading):
            return _without_solved(others, signs)
    return list(values)


def _is_turned_to_0(value: Expr, own: Iterable[str]) -> bool:
    """Whether a value is a single swing whose angle one of these coordinates turns."""
    swings = _swings(value)
    moving = [n for n in swings or () if any(n)]
    if swings is None or len(moving) != 1 or not _constant(swings, value.ring).is_zero:
        return False
    pairs = zip(moving[0], _turning(value.ring), strict=True)
    return not {*own}.isdisjoint(name for times, pair in pairs if times for name in names_of(pair.angle))


def _is_never_zero(value: Expr, zeros: Sequence[Expr], signs: ParameterSigns) -> bool:
    """Whether a value is not 0 where others are that fix its angles, or their tangents."""
    tangents = [turn for turn in map(turn_of, zeros) if turn is not None and turn.rest.is_zero]
    pairs = [one.pair for one in tangents if signs.is_positive((one.sine * one.cosine) ** 2)]
    if {*signs.open_factors(value)}.issubset(
        value.ring.generator(place) for pair in pairs for place in (pair.sine, pair.cosine)
    ):
        return True
    names = {*coordinates_in(value)}
    fixing = [
        zero
        for zero in zeros
        if len(coordinates_in(zero)) == 1
        and names.issuperset(coordinates_in(zero))
        and (swings := _swings(zero))
        and _quarters(swings)
    ]
    at = [here for _, (here, *left) in at_quarters([value, *fixing]) if all(map(_is_zero, left))]
    known = all(signs.is_positive(here) or signs.is_positive(-here) for here in at)
    return bool(at) and known and names.issubset(name for zero in fixing for name in coordinates_in(zero))


def _apart(values: Iterable[Expr]) -> list[list[Expr]]:
    """The values in groups that share no coordinate."""
    found: list[tuple[set[str], list[Expr]]] = []
    for value in values:
        names, group = set(coordinates_in(value)), [value]
        for one in [one for one in found if one[0] & names]:
            found.remove(one)
            names |= one[0]
            group = [*one[1], *group]
        found.append((names, group))
    return [group for _, group in found]


def coordinates_in(value: Expr) -> list[str]:
    """The coordinates that stand in a value, or in its angles."""
    ring, outside = value.ring, coordinates_outside(value)
    degrees = value.poly.degrees()
    turning = {
        name
        for pair in _turning(ring)
        if degrees[pair.sine] > 0 or degrees[pair.cosine] > 0
        for name in names_of(pair.angle)
    }
    return [name for name in ring.names if name in turning or name in outside]


def coordinates_outside(value: Expr) -> list[str]:
    """The coordinates that stand in a value outside of sines and cosines."""
    degrees = value.poly.degrees()
    return [name for name in value.ring.names if degrees[value.ring.symbol_indices[name, 0]] > 0]


def _swing_apart(values: Sequence[Expr], signs: ParameterSigns) -> bool:
    """Whether no angle stands in two of the swings, of each of which the size is known.

    Quarter turns that some of the values fix are put into the others.
    """
    found = [_swings(value) for value in values]
    known = [swings for swings in found if swings is not None]
    enough = conditions(values, signs) or ()
    return len(known) == len(values) and any(
        _are_apart(left, signs) and {*bounds}.issubset(enough) for left, bounds in _choices(known, signs)
    )


def _swings_along(values: Sequence[Expr], signs: ParameterSigns) -> bool:
    """Whether one of two values is 0 on a line, along which the other swings about 0: q₂ = n q₁."""
    for line, value in permutations(values) if len(values) == 2 else ():
        ring, names, swings = value.ring, coordinates_in(line), _swings(value)
        factors = [ring.coefficient(line, name) for name in names]
        rest = line - sum(map(mul, factors, map(ring.symbol, names)), start=ring.zero)
        if swings is None or len(names) != 2 or any(map(ring.depends_on_coordinates, (*factors, rest))):
            continue
        along = dict(zip(names, (factors[1], -factors[0]), strict=True))
        rates = [
            sum(
                (along[name] * (times * rate)
                 for times, pair in zip(multiples, _turning(ring), strict=True)
                 for atom, rate in pair.angle.terms if (name := name_alone(atom)) in along),
                start=ring.zero,
            )
            for multiples in swings
        ]  # fmt: skip
        if rates and all(signs.is_positive(rate) or signs.is_positive(-rate) for rate in rates):
            return True
    return False


def _are_free(angles: Sequence[Multiples]) -> bool:
    """Whether no angle is given by the others."""
    return not angles or rank([[float(i) for i in n] for n in angles], 0.1) == len(angles)


def _are_apart(known: Sequence[Swings], signs: ParameterSigns) -> bool:
    if not _are_free([n for swings in known for n in swings if any(n)]):
        return False
    moving = [[both for n, both in swings.items() if any(n)] for swings in known]
    return all(len(parts) == 1 or all(_size(both, signs) is not None for both in parts) for parts in moving)


def _choices(
    known: Sequence[Swings], signs: ParameterSigns
) -> Iterator[tuple[list[Swings], tuple[Bound, ...]]]:
    """At each choice of the quarter turns that some fix, the others, and what they need to be 0 somewhere."""
    left = [swings for swings in known if not _quarters(swings)]
    turns = [[(n, *at) for n in swings if any(n) for at in _quarters(swings)] for swings in known]
    turns = [one for one in turns if one]
    for fixed in product(*turns) if 2 ** len(turns) <= MOST_BRANCHES else [()]:
        there = [_at(swings, fixed) for swings in left]
        held = [n for n, _, _ in fixed]
        closing = {
            (i, k): sides
            for i, k in combinations(range(len(there)), 2)
            if (sides := _closing(there[i], there[k], held, signs))
        }
        alone = [there[k] for k in range(len(there)) if not any(k in both for both in closing)]
        bounds = [_reach(swings, held, signs) for swings in alone]
        bounds += [not_negative(sides, signs) for sides in closing.values()]
        if None not in bounds:
            yield there, tuple(dict.fromkeys(bound for one in bounds for bound in one or ()))


def _is_zero(value: Expr) -> bool:
    return value.is_zero


def has_least_energy(forces: Sequence[Expr], signs: ParameterSigns) -> bool:
    """Whether an energy whose derivatives by all coordinates these are is least somewhere.

    It is ½ uᵀ K u and less, which is linear in u at most, periodic in other angles: with a K that is positive
    definite, of all lengths and of what stands outside of sines and cosines, it grows beyond all bounds; but
    along whole numbers of turns, of which neither K nor what is linear has any part.
    """
    ring = forces[0].ring
    places, known = range(len(ring.names)), [_swings(force, linear=True) for force in forces]
    atoms = [(atom, rate) for pair in _turning(ring) for atom, rate in pair.angle.terms]
    if None in known or any(name_alone(atom) not in ring.names for atom, _ in atoms):
        return False
    means = [_constant(swings or {}, ring) for swings in known]
    K = [[ring.diff(mean, k) for k in places] for mean in means]
    kinds = dict(ring.coordinates)
    outside = {name for force in forces for name in coordinates_outside(force)}
    growing = [
        k
        for k, name in enumerate(ring.names)
        if kinds[name] == "prismatic" or name in outside or not means[k].is_zero
    ]
    stiff = Matrix.of(ring, ([K[i][j] for j in growing] for i in growing))
    firsts = [tuple(range(size)) for size in range(1, rank_parts(stiff).rank + 1)]
    turns = nullspace(stiff).T.rows if len(firsts) < len(growing) else ()
    is_still = all(
        ring.dot(turn, [means[k] for k in growing]).is_zero
        and all(
            x.is_zero or (x.is_number and kinds[ring.names[k]] == "revolute")
            for x, k in zip(turn, growing, strict=True)
        )
        for turn in turns
    )
    return is_still and all(signs.is_positive(determinant(part(stiff, first, first))) for first in firsts)


def rests(values: Sequence[Expr]) -> Iterator[Pose]:
    """The quarter turns at which k φ - m g l sin φ is 0, or sin φ + sin ψ; none of what has lengths."""
    kinds = dict(values[0].ring.coordinates) if values else {}
    turning = (
        g for g in _apart(values) if all(kinds[name] == "revolute" for v in g for name in coordinates_in(v))
    )
    each = [poses for group in turning if (poses := [*zeros_at_quarters(group)])]
    for chosen in product(*each) if each else ():
        yield {name: degrees for pose in chosen for name, degrees in pose.items()}


def zeros_at_quarters(values: Sequence[Expr]) -> Iterator[Pose]:
    """The quarter turns at which all values are 0, where their lengths are."""
    ring = values[0].ring
    if not ring.has_symbol("pi"):  # half a turn of a spring
        values = [*map(Transfer(ring, with_symbols(ring, ["pi"])), values)]
    yield from (pose for pose, at in at_quarters(values) if all(map(_is_zero, at)))


def at_quarters(values: Sequence[Expr]) -> Iterator[tuple[Pose, list[Expr]]]:
    """The values at all quarter turns of their angles, where their lengths are 0."""
    ring = values[0].ring
    names = dict.fromkeys(name for value in values for name in coordinates_in(value))
    turning = [name for name, kind in ring.coordinates if name in names and kind == "revolute"]
    if len(turning) > MOST_TURNING:
        return
    angles = _angles(ring)
    for quarters in product((0, 1, 2, -1), repeat=len(turning)):
        pose = {
            name: (90 * k - offset) / rate
            for name, k in zip(turning, quarters, strict=True)
            for rate, offset in [angles.get(name, (Fraction(1), Fraction(0)))]
        }
        bare = {ring.symbol_indices[name, 0]: radians(ring, pose.get(name, 0)) for name in names}
        images = {index: image.poly for index, image in bare.items() if image is not None}
        at = [ring.put(ring.at_pose(value, pose), images) for value in values]
        if not any(map(ring.depends_on_coordinates, at)):
            yield pose, at


def _angles(ring: Ring) -> dict[str, tuple[Fraction, Fraction]]:
    """The rate r and the degrees of the angle r q + 30° of each coordinate, those of sums last."""
    found: dict[str, tuple[Fraction, Fraction]] = {}
    for pair in sorted(_turning(ring), key=lambda pair: len(pair.angle.terms)):
        rates = {name_alone(atom): rate for atom, rate in pair.angle.terms if name_alone(atom) in ring.names}
        ahead = sum(rates[name] * found[name][1] / found[name][0] for name in rates if name in found)
        for name in [name for name in rates if name not in found][:1]:
            found[name] = rates[name], pair.angle.degrees - ahead
    return found


def radians(ring: Ring, degrees: Fraction | int) -> Expr | None:
    """So many degrees as a part of π; None where the ring does not have that."""
    if not degrees:
        return ring.zero
    return ring.symbol("pi") * Fraction(degrees, 180) if ring.has_symbol("pi") else None


def _changes_sign(value: Expr, signs: ParameterSigns) -> bool:
    """Whether a value is positive somewhere and negative elsewhere: at quarter turns, or far out."""
    seen = {sign for _, (at,) in at_quarters([value]) for sign in (1, -1) if signs.is_positive(at * sign)}
    ring, degrees = value.ring, value.poly.degrees()
    for name in coordinates_in(value):
        degree = int(degrees[ring.symbol_indices[name, 0]])
        ways = (1, -1) if degree % 2 else (1,)
        for _, (far,) in at_quarters([_leading(value, name, degree)]) if degree > 0 else ():
            seen |= {way * sign for sign in (1, -1) if signs.is_positive(far * sign) for way in ways}
    return len(seen) == 2


def _leading(value: Expr, name: str, degree: int) -> Expr:
    """The coefficient of a coordinate to its highest power."""
    ring, index = value.ring, value.ring.symbol_indices[name, 0]
    return Expr(ring, ring.ctx.from_dict({
        (*exponents[:index], 0, *exponents[index + 1 :]): number
        for exponents, number in value.poly.to_dict().items()
        if int(exponents[index]) == degree
    }))  # fmt: skip


def without_ends(
    bounds: Iterable[Bound], nonzero: Iterable[Expr], signs: ParameterSigns
) -> tuple[Bound, ...]:
    """Inequalities that are strict where both sides are equal only if one of `nonzero` is 0."""
    never = {sign * value for value in nonzero for sign in (1, -1)}
    return tuple(
        Bound(bound.value, bound.is_strict or never.issuperset(signs.open_factors(bound.value)))
        for bound in bounds
    )


def _weakest(found: Sequence[tuple[Bound, ...]], signs: ParameterSigns) -> tuple[Bound, ...]:
    """Those of several conditions, of which one is enough, that follow from each of them."""
    for one in found:
        if all(
            bound in other
            or signs.implies(bound, other)
            or any(_is_of_squares(bound, own, signs) for own in other)
            for other in found
            for bound in one
        ):
            return one
    return ()


def _is_of_squares(bound: Bound, other: Bound, signs: ParameterSigns) -> bool:
    """Whether x ≥ y follows as x² - y² ≥ 0 does, with sums of positive terms x and y: W² (a + b) ≥ g."""
    value = bound.value
    positive = Expr(
        value.ring, value.ring.ctx.from_dict({e: abs(n) for e, n in value.poly.to_dict().items()})
    )
    return signs.is_positive(positive) and signs.is_positive(value * positive - other.value)


def fourier_parts(expr: Expr, pairs: Iterable[tuple[int, int]]) -> Swings:
    """An expression as a sum of swings of some angles, and what holds none, that of the multiples 0.

    `pairs` are the generators of their sines and cosines.
    """
    ring = expr.ring
    places = [place for pair in pairs for place in pair]
    grouped: dict[tuple[int, ...], dict[tuple[int, ...], Fraction]] = {}
    for exponents, factor in expr.poly.to_dict().items():
        powers = tuple(int(exponents[i]) for i in places)
        rest = tuple(0 if i in places else int(e) for i, e in enumerate(exponents))
        grouped.setdefault(rest, {})[powers] = Fraction(int(factor.p), int(factor.q))
    sums: dict[Multiples, tuple[dict[Any, Any], dict[Any, Any]]] = {}
    for rest, polynomial in grouped.items():
        for multiples, values in fourier_form(polynomial).items():
            for terms, value in zip(sums.setdefault(multiples, ({}, {})), values, strict=True):
                if value:
                    terms[rest] = rational(value)
    return {n: (Expr(ring, ring.ctx.from_dict(a)), Expr(ring, ring.ctx.from_dict(b)))
            for n, (a, b) in sums.items()}  # fmt: skip


def quarter_turn(value: Expr) -> tuple[Angle, list[tuple[int, int]]] | None:
    """The angle, and its sines and cosines, at whose quarter turns alone a value is 0; None of any other."""
    swings = _swings(value)
    if swings is None or not (turns := _quarters(swings)):
        return None
    (multiples,) = (n for n in swings if any(n))
    return _angle_of(multiples, value.ring), turns


def _turning(ring: Ring) -> list[Pair]:
    return [pair for pair in ring.pairs if ring.depends_on_coordinates(ring.generator(pair.sine))]


def _swings(value: Expr, *, linear: bool = False) -> Swings | None:
    """A value as swings about what is constant; None where coordinates stand elsewhere in it.

    In what is `linear` they may stand in front of swings, none in another's factor.
    """
    ring = value.ring
    swings = fourier_parts(value, [(pair.sine, pair.cosine) for pair in _turning(ring)])
    parts = [part for both in swings.values() for part in both]
    if linear:
        parts = [ring.diff(part, k) for part in parts for k in range(len(ring.names))]
    return None if any(map(ring.depends_on_coordinates, parts)) else swings


def only_ends(value: Expr, signs: ParameterSigns) -> tuple[Expr, ...]:
    """1 - cos φ and 1 - cos ψ, which are 0 where 2 - cos φ - cos ψ is; none of what is 0 elsewhere, too."""
    ring, swings = value.ring, _swings(value) or {}
    sizes = {n: _size(both, signs) for n, both in swings.items() if any(n)}
    known = {n: size for n, size in sizes.items() if size is not None}
    constant, most = _constant(swings, ring), sum(known.values(), start=ring.zero)
    sign = next((sign for sign in (1, -1) if (most - constant * sign).is_zero), 0)
    if not known or len(known) < len(sizes):
        return ()
    return tuple(
        swings[n][0] * ring.cos(angle) + swings[n][1] * ring.sin(angle) + size * sign
        for n, size in known.items()
        if sign
        for angle in [_angle_of(n, ring)]
    )


def _angle_of(multiples: Multiples, ring: Ring) -> Angle:
    terms = (pair.angle * times for pair, times in zip(_turning(ring), multiples, strict=True))
    return sum(terms, start=Angle.zero())


def _quarters(swings: Swings) -> list[tuple[int, int]]:
    """The quarter turns at which a single swing with a constant is 0; none where it is 0 elsewhere, too."""
    moving = [n for n in swings if any(n)]
    if len(moving) != 1:
        return []
    cosine, sine = swings[moving[0]]
    constant = _constant(swings, cosine.ring)
    found = [(s, c) for s, c in DEGREES if (cosine * c + sine * s + constant).is_zero]
    is_double = (cosine**2 + sine**2 - constant**2).is_zero
    return found if len(found) == 2 - is_double else []


def _constant(swings: Swings, ring: Ring) -> Expr:
    return next((value for n, (value, _) in swings.items() if not any(n)), ring.zero)


def _at(swings: Swings, fixed: Sequence[tuple[Multiples, int, int]]) -> Swings:
    """Swings where the angles n·q are at quarter turns: φ ± n·q turns as φ does, by that much ahead."""
    for turned, sine, cosine in fixed:
        found: Swings = {}
        for n, (a, b) in swings.items():
            times, rest = _less(n, turned)
            for _ in range(abs(times)):
                s = sine if times > 0 else -sine
                a, b = a * cosine + b * s, b * cosine - a * s
            sign, rest = positive(rest)
            old = found.get(rest, (a.ring.zero, a.ring.zero))
            found[rest] = (old[0] + a, old[1] + b * sign)
        swings = {n: both for n, both in found.items() if not all(part.is_zero for part in both)}
    return swings


def _less(n: Multiples, other: Multiples) -> tuple[int, Multiples]:
    """(k, n - k·other) without the last angle of `other`, where that is possible; else (0, n)."""
    place = max(i for i, times in enumerate(other) if times)
    times, left = divmod(n[place], other[place])
    if left or not times:
        return 0, n
    return times, tuple(a - times * b for a, b in zip(n, other, strict=True))


def _reach(swings: Swings, held: Sequence[Multiples], signs: ParameterSigns) -> tuple[Bound, ...] | None:
    """What the parameters must satisfy for a sum of swings to be 0, with some angles `held`; None: never."""
    moving = [n for n in swings if any(n)]
    ring = next((both[0].ring for both in swings.values()), None)
    if ring is None or not _are_free([*moving, *held]):
        return ()
    constant, sizes = _constant(swings, ring), [_size(swings[n], signs) for n in moving]
    known = [size for size in sizes if size is not None]
    if len(known) == len(sizes):
        most = sum(known, start=ring.zero)
        return not_negative([most - constant, most + constant], signs)
    if len(moving) > 1:
        return ()
    if constant.is_zero:
        return ()
    ((cosine, sine),) = (swings[n] for n in moving)
    return not_negative([cosine**2 + sine**2 - constant**2], signs)


def _closing(x: Swings, y: Swings, held: Sequence[Multiples], signs: ParameterSigns) -> list[Expr]:
    """What is not negative if x = y = 0 is a polygon that closes, of sides L (cos φ, sin φ) and a fixed one.

    No side is longer than the others together.  None of any other, and of lengths that are not known.
    """
    moving = [n for n in x if any(n)]
    turned = [{n: (-sign * b, sign * a) for n, (a, b) in x.items() if any(n)} for sign in (1, -1)]
    if len(moving) < 2 or {n: both for n, both in y.items() if any(n)} not in turned:
        return []
    ring = x[moving[0]][0].ring
    sizes = [size for n in moving if (size := _size(x[n], signs)) is not None]
    if len(sizes) < len(moving) or not _are_free([*moving, *held]):
        return []
    fixed = _constant(x, ring), _constant(y, ring)
    last = ring.zero if all(map(_is_zero, fixed)) else _size(fixed, signs)
    if last is None:
        square = fixed[0] ** 2 + fixed[1] ** 2
        pairs = [(a, b) for a, b in combinations(sizes, 2) if len(sizes) == 2]
        return [part for a, b in pairs for part in ((a + b) ** 2 - square, square - (a - b) ** 2)]
    most = sum(sizes, start=last)
    return [most - 2 * size for size in (*sizes, last) if not size.is_zero]


def _size(swing: tuple[Expr, Expr], signs: ParameterSigns) -> Expr | None:
    """√(A² + B²) where one of them is 0, and the sign of the other is known."""
    parts = [part for part in swing if not part.is_zero]
    sizes = [part * sign for part in parts for sign in (1, -1) if signs.is_positive(part * sign)]
    return sizes[0] if len(parts) == len(sizes) == 1 else None


def not_negative(values: Sequence[Expr], signs: ParameterSigns) -> tuple[Bound, ...] | None:
    """That values are not negative, without what is known; None where one is negative."""
    open_parts = [signs.open_part(value) for value in values]
    if any(signs.is_positive(-part) for part in open_parts):
        return None
    return tuple(
        Bound(part, False) for part in open_parts if not (part.is_number or _swings_above(part, signs))
    )


def _swings_above(value: Expr, signs: ParameterSigns) -> bool:
    """Whether sines and cosines of given angles are too small to make a value negative, as 1 - cos α."""
    ring = value.ring
    swings = fourier_parts(value, [(pair.sine, pair.cosine) for pair in ring.pairs])
    sizes = [_size(both, signs) for n, both in swings.items() if any(n)]
    known = [size for size in sizes if size is not None]
    least = _constant(swings, ring) - sum(known, start=ring.zero)
    return len(known) == len(sizes) > 0 and (least.is_zero or signs.is_positive(least))
