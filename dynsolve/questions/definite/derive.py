"""Whether a matrix can be an inertia matrix: symmetric, of the coordinates as D is, positive definite.

An inertia matrix is made of sines and cosines of angles, and is at most quadratic in lengths;
of a chain with relative coordinates the first one does not occur.  It is positive definite for
every q exactly if its leading minors are positive for every q (Sylvester), with the rows and
columns in any order, of which some decide more than others.  Each minor is taken to its smallest
value over one coordinate after the other, which leaves inequalities between parameters: those that
do not follow from what is assumed are the conditions.

Spong, Hutchinson, Vidyasagar, section 7.5; De Luca, Robotics 2, midterm of 29 April 2019.

The smallest value of a function of coordinates, as inequalities between parameters.

f > 0 for every q exactly if f > 0 where one coordinate makes it smallest, whatever the others are:
so one coordinate after the other is taken out.

    A + B u,  u a sine or cosine     smallest at u = 1 or u = -1
    A + B u²                         at u = 0 or u = ±1
    A + B u + C u²                   at u = ±1; where its vertex lies between these, A - B²/(4C), so 4AC > B²
    A + B u² + C u⁴                  the same of u² between 0 and 1
    A + B cos θ + C sin θ            A - √(B² + C²), so A > 0 and A² > B² + C²; A > |B| where C = 0
    A + B cos² θ + C sin θ cos θ     the same of 2θ
    A + B d + C d²,  d a length      A - B²/(4C), so C > 0 and 4AC > B²; also A > 0 where B = C = 0
    A + B d² + C d⁴                  C ≥ 0, and A > 0 at d = 0; where B < 0, 4AC > B²
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from enum import Enum
from functools import cache
from itertools import islice, permutations
from random import Random

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.generators import Pair
from dynsolve.algebra.inequality import Bound, follows, independent, opposite, simplified
from dynsolve.algebra.linear_systems import part
from dynsolve.algebra.matrix import Matrix, determinant, work
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_values import evaluate
from dynsolve.derivation.graph import Rule, Skipped
from dynsolve.robot.model import JointType, Robot
from dynsolve.robot.questions import Candidate

# The smallest value of a function of coordinates, as inequalities between parameters

MOST = 64
"""More inequalities than this are not worked with."""


class Extreme(Struct, frozen=True):
    """An inequality that must hold, and where the function has that value.

    `where` is (generator, value) of sines, cosines and lengths, as far as the place is known.  What is not
    `needed` is enough with the others, and may fail where others are equalities.  `within` is where the
    vertex of a parabola counts: only there the inequality must hold.
    """

    bound: Bound
    where: tuple[tuple[int, int], ...] = ()
    needed: bool = True
    within: tuple[Bound, ...] = ()

    def at(self, generator: int, value: int, bound: Bound) -> Extreme:
        """The same at a value of a further generator."""
        return replace(self, bound=bound, where=(*self.where, (generator, value)))

    def fails(self, assumed: Sequence[Bound]) -> bool:
        """Whether with this inequality all that is looked for fails, too."""
        value = self.bound.value
        return not self.within and follows(opposite(self.bound) if self.needed else Bound(-value), assumed)


def smallest(f: Expr, assumed: Sequence[Bound]) -> list[Extreme] | None:
    """Inequalities between parameters with which f > 0 for every q; None where none are found."""
    found = [Extreme(Bound(f))]
    ring = f.ring
    while found:
        step = _next(_moving(found), found)
        if step is None:
            return found if not any(ring.depends_on_coordinates(e.bound.value) for e in found) else None
        reduced = [_without(step, extreme, assumed) for extreme in found]
        if any(part is None for part in reduced):
            return None
        found = list(dict.fromkeys(extreme for part in reduced if part for extreme in part))
        if len(found) > MOST:
            return None
    return found


def _moving(found: Sequence[Extreme]) -> Iterator[Pair | int]:
    """The coordinates that may be taken out: angles by their sines and cosines, lengths by their place."""
    ring = found[0].bound.value.ring
    yield from (pair for pair in ring.pairs if ring.depends_on_coordinates(ring.cos(pair.angle)))
    yield from (ring.symbol_indices[(name, 0)] for name in ring.names)


def _next(moving: Iterator[Pair | int], found: Sequence[Extreme]) -> Pair | int | None:
    """The first of them that occurs."""
    degrees = [extreme.bound.value.poly.degrees() for extreme in found]
    for one in moving:
        places = (one,) if isinstance(one, int) else (one.sine, one.cosine)
        if any(d[i] > 0 for d in degrees for i in places):
            return one
    return None


def _without(step: Pair | int, extreme: Extreme, assumed: Sequence[Bound]) -> list[Extreme] | None:
    if isinstance(step, int):
        return _without_length(step, extreme, assumed)
    return _without_angle(step, extreme, assumed)


def _coefficients(value: Expr, *generators: int) -> dict[tuple[int, ...], Expr]:
    """The coefficients of a polynomial in some generators, by their exponents."""
    parts: dict[tuple[int, ...], dict[tuple[int, ...], object]] = {}
    for exponents, factor in value.poly.to_dict().items():
        key = tuple(int(exponents[i]) for i in generators)
        rest = tuple(0 if i in generators else int(e) for i, e in enumerate(exponents))
        parts.setdefault(key, {})[rest] = factor
    ring = value.ring
    return {key: Expr(ring, ring.ctx.from_dict(terms)) for key, terms in parts.items()}


# -- angles ----------------------------------------------------------------------------------------


def _without_angle(pair: Pair, extreme: Extreme, assumed: Sequence[Bound]) -> list[Extreme] | None:
    value, ring = extreme.bound.value, extreme.bound.value.ring
    found = _coefficients(value, pair.sine, pair.cosine)
    zero = ring.zero
    keys = set(found)
    if keys <= {(0, 0)}:
        return [extreme]
    if keys <= {(0, 0), (0, 2), (0, 4)}:
        by_square = [found.get((0, 2 * k), zero) for k in range(3)]
        return _in_one(extreme, pair.cosine, (0, 1), by_square, assumed)
    if keys <= {(0, 0), (0, 1), (0, 2)}:
        return _in_one(extreme, pair.cosine, (1, -1), [found.get((0, k), zero) for k in range(3)], assumed)
    if keys <= {(0, 0), (1, 0), (0, 2)}:  # c² = 1 - s²
        squares = found.get((0, 2), zero)
        by_sine = [found.get((0, 0), zero) + squares, found.get((1, 0), zero), -squares]
        return _in_one(extreme, pair.sine, (1, -1), by_sine, assumed)
    A, B, C = (found.get(key, zero) for key in ((0, 0), (0, 1), (1, 0)))
    if keys <= {(0, 0), (0, 2), (1, 1)}:  # in cos 2θ and sin 2θ
        B, C = found.get((0, 2), zero) / 2, found.get((1, 1), zero) / 2
        A = A + B
    elif not keys <= {(0, 0), (0, 1), (1, 0)}:
        return None
    strict = extreme.bound.is_strict
    if B.is_zero or C.is_zero:
        return [replace(extreme, bound=Bound(A + most, strict)) for most in (B + C, -B - C)]
    if not strict:
        return None
    return [replace(extreme, bound=Bound(A)), replace(extreme, bound=Bound(A * A - B * B - C * C))]


def _in_one(
    extreme: Extreme, u: int, ends: tuple[int, int], coefficients: Sequence[Expr], assumed: Sequence[Bound]
) -> list[Extreme] | None:
    """A + B x + C x² between the ends of x, which is u or u²."""
    A, B, C = coefficients
    strict, least = extreme.bound.is_strict, min(ends)
    at_ends = [extreme.at(u, end, Bound(A + B * end + C * end**2, strict)) for end in ends]
    inside = [Bound(C * 2 + B), Bound(-B - C * (2 * least))]
    if any(follows(opposite(one), assumed) for one in (Bound(C), *inside)):
        return at_ends
    over_roots = A * C * 4 - B * B
    if follows(Bound(over_roots), assumed) and follows(Bound(A), assumed):
        return []
    at_vertex = _at_vertex(replace(extreme, bound=Bound(over_roots, strict)), inside, assumed)
    if at_vertex is None:
        return None
    return [*at_ends, at_vertex] if at_vertex.within or not at_vertex.needed else [at_vertex]


def _at_vertex(extreme: Extreme, inside: Sequence[Bound], assumed: Sequence[Bound]) -> Extreme | None:
    """What must hold where a vertex lies inside; if that depends on coordinates, what is enough, or None."""
    depends = extreme.bound.value.ring.depends_on_coordinates
    within = independent(inside, assumed)
    if not any(depends(one.value) for one in within):
        return None if within and depends(extreme.bound.value) else replace(extreme, within=within)
    if depends(extreme.bound.value) or follows(Bound(-extreme.bound.value), assumed):
        return None
    return replace(extreme, needed=False)


# -- lengths ---------------------------------------------------------------------------------------


def _without_length(d: int, extreme: Extreme, assumed: Sequence[Bound]) -> list[Extreme] | None:
    """A + B d + C d² + ... over all lengths."""
    value, ring = extreme.bound.value, extreme.bound.value.ring
    found = {key[0]: part for key, part in _coefficients(value, d).items()}
    strict = extreme.bound.is_strict
    A, B, C = (found.get(k, ring.zero) for k in range(3))
    if all(power % 2 == 0 for power in found):
        if any(power > 4 for power in found):
            return None
        return _in_squares(extreme, d, (A, C, found.get(4, ring.zero)), assumed)
    if max(found) == 1:
        return [replace(extreme, bound=Bound(-B * B, False)), extreme.at(d, 0, Bound(A, strict))]
    if max(found) > 2 or not strict:
        return None
    needed = extreme.needed and follows(Bound(C), assumed)
    bounds = (Bound(C), Bound(A * C * 4 - B * B))
    return [replace(extreme, bound=bound, needed=needed) for bound in bounds]


def _in_squares(
    extreme: Extreme, d: int, coefficients: Sequence[Expr], assumed: Sequence[Bound]
) -> list[Extreme] | None:
    """A + B x + C x² over all x ≥ 0, the square of a length."""
    A, B, C = coefficients
    at_0 = extreme.at(d, 0, Bound(A, extreme.bound.is_strict))
    linear, leading = (replace(extreme, bound=Bound(one, False)) for one in (B, C))
    if follows(linear.bound, assumed) or follows(Bound(-C, False), assumed):  # C may be 0, and no more
        return [at_0, leading, linear]
    over_roots = A * C * 4 - B * B
    if follows(Bound(-B, False), assumed) and follows(Bound(C), assumed):
        return [at_0, replace(extreme, bound=Bound(over_roots, extreme.bound.is_strict))]
    bound = Bound(over_roots, extreme.bound.is_strict)
    at_vertex = _at_vertex(replace(extreme, bound=bound), [Bound(-B)], assumed)
    return None if at_vertex is None else [at_0, leading, at_vertex]


MOST_WORK = 20_000
"""The products of terms that a determinant may come to."""

TRIES = 4000
"""So many values of the parameters are tried for a case in which the conditions hold, and one where not."""

MOST_ORDERS = 24
"""In so many orders the rows and columns of a matrix are taken."""


class Answer(Enum):
    """Whether it can be one: for all parameters that are assumed, for some of them, or for none."""

    YES = "yes"
    IF = "if"
    NO = "no"


class Refusal(Enum):
    """Why it can be none."""

    ASYMMETRIC = "it is not symmetric"
    NOT_PERIODIC = "an angle stands outside of sines and cosines"
    LENGTH_IN_SINE = "a length stands in a sine or cosine"
    DEGREE = "a length stands in a higher power than the second"
    BASE = "it depends on the coordinate of the base"
    INDEFINITE = "it is not positive definite"


Alternatives = tuple[Bound, ...]
"""Inequalities of which one must hold."""


class Definiteness(Struct, frozen=True):
    """What is found of a matrix.

    `minors` are its leading ones; `conditions` what the parameters must satisfy beyond what is
    assumed, one inequality of each, or if not `is_exact` what is enough; `order` (from 0) that of the rows
    and columns in them.  Of a matrix that can be none `refusal` says why, `place` the entry (from 0),
    `extreme` where which minor (its `size`) is not positive, or if not `is_whole` what it is over those
    before it; or `excluding` are conditions that exclude each other.  `moves_with_base` is a remark.
    """

    name: str
    answer: Answer
    minors: tuple[Expr, ...] = ()
    conditions: tuple[Alternatives, ...] = ()
    refusal: Refusal | None = None
    place: tuple[int, int] = (0, 0)
    coordinate: str = ""
    extreme: Extreme | None = None
    size: int = 0
    is_whole: bool = True
    order: tuple[int, ...] = ()
    moves_with_base: bool = False
    is_exact: bool = True
    excluding: tuple[Bound, ...] = ()


def rules(robot: Robot) -> Iterator[Rule]:
    """What is found of each matrix that is to be judged."""
    candidates = robot.questions.candidates
    yield Rule("definite", (), lambda: tuple(definiteness(robot, candidate) for candidate in candidates))


def definiteness(robot: Robot, candidate: Candidate) -> Definiteness | Skipped:
    """Whether a matrix can be an inertia matrix, for every q and the parameters that are assumed.

    That of the first order of its rows that decides, else of the one that leaves the simplest conditions.
    """
    matrix = candidate.matrix
    refused = next(_refusals(robot, candidate), None)
    if refused is not None:
        return refused
    if work(matrix) > MOST_WORK:
        return Skipped(f"the leading minors of {candidate.name} are too long")
    moves = any(not matrix.ring.diff(entry, 0).is_zero for entry in matrix.entries)
    least = cache(lambda value, known: _open(value, candidate.assumed, known))
    left: list[_Left] = []
    skipped: list[Skipped] = []
    for order in _orders(matrix):
        one = _in_order(candidate, order, least)
        if isinstance(one, Skipped):
            skipped.append(one)
        elif isinstance(one, _Left):
            left.append(one)
        else:
            return replace(one, moves_with_base=moves)
    answers = [_with_conditions(candidate, one) for one in sorted(left, key=_length)] or skipped
    found = next((one for one in answers if not isinstance(one, Skipped)), answers[0])
    return found if isinstance(found, Skipped) else replace(found, moves_with_base=moves)


def _orders(matrix: Matrix) -> Iterable[tuple[int, ...]]:
    """The order of the rows as they are written, then others, with short entries of the diagonal first."""
    written = range(matrix.shape[0])
    others = permutations(sorted(written, key=lambda k: len(matrix[k, k])))
    return dict.fromkeys([tuple(written), *islice(others, MOST_ORDERS)])


class _Left(Struct, frozen=True):
    """What the minors of one order leave open."""

    found: Definiteness
    extremes: tuple[Extreme, ...]


def _length(left: _Left) -> tuple[int, int, int]:
    """How much is left open; what is no more than enough, or needed in some cases alone, comes last."""
    sizes = [len(one.bound.value) for one in left.extremes]
    doubts = sum(2 * (not one.needed) + bool(one.within) for one in left.extremes)
    return doubts, len(sizes), sum(sizes)


_Least = tuple[tuple[Extreme, ...], Extreme | None] | None


def _open(value: Expr, assumed: Sequence[Bound], known: Sequence[Bound]) -> _Least:
    """What value > 0 needs beyond what is assumed, and what of it fails; None where that is not found.

    What is `known` is needed by minors before it.
    """
    extremes = smallest(value, (*assumed, *known))
    if extremes is None:
        return None
    left = tuple(one for one in extremes if not follows(one.bound, (*assumed, *one.within)))
    return left, next((one for one in left if one.fails(assumed)), None)


def _in_order(
    candidate: Candidate, order: tuple[int, ...], least: Callable[[Expr, tuple[Bound, ...]], _Least]
) -> Definiteness | _Left | Skipped:
    """What the leading minors say, the rows and columns taken in an order."""
    matrix, name = candidate.matrix, candidate.name
    minors = tuple(determinant(part(matrix, order[:k], order[:k])) for k in range(1, len(order) + 1))
    found = Definiteness(name, Answer.YES, minors, order=order)
    left: list[Extreme] = []
    for size, minor in enumerate(minors, 1):
        value = _over(minor, minors[: size - 1])
        smallest_value = least(value, tuple(one.bound for one in left if one.needed and not one.within))
        if smallest_value is None:
            return Skipped(f"the smallest value of the {size}×{size} minor of {name} is not found")
        extremes, failing = smallest_value
        if failing is not None:
            refused = replace(found, answer=Answer.NO, refusal=Refusal.INDEFINITE)
            return replace(refused, extreme=failing, size=size, is_whole=value == minor)
        left += extremes
    return _Left(found, tuple(left)) if left else found


def _with_conditions(candidate: Candidate, left: _Left) -> Definiteness | Skipped:
    """The conditions on the parameters, where these hold for some and fail for others."""
    matrix, name, assumed = candidate.matrix, candidate.name, candidate.assumed
    needed: list[Bound] = []
    chosen: list[Alternatives] = []
    is_exact = True
    for extreme in sorted(left.extremes, key=lambda one: bool(one.within)):
        for bounds in _alternatives(extreme, [*assumed, *needed]):
            if len(bounds) > 1:
                chosen.append(bounds)
                continue
            if is_exact and extreme.needed and follows(opposite(bounds[0]), [*assumed, *needed]):
                excluding = _excluding(needed, extreme.bound, assumed)
                refused = replace(left.found, answer=Answer.NO, refusal=Refusal.INDEFINITE)
                return replace(refused, excluding=excluding)
            needed += bounds
            is_exact &= extreme.needed
    conditions = (*((one,) for one in independent(needed, assumed)), *dict.fromkeys(chosen))
    if not conditions:
        return left.found
    given = [(one,) for one in assumed]
    some = _are_possible(matrix, (*given, *conditions))
    if not some or not any(_are_possible(matrix, (*given, *failing(one))) for one in conditions):
        which = "all the parameters that are assumed" if some else "some parameters"
        return Skipped(f"whether {name} is positive definite for {which} is not found")
    return replace(left.found, answer=Answer.IF, conditions=conditions, is_exact=is_exact)


def failing(bounds: Alternatives) -> tuple[Alternatives, ...]:
    """What holds where none of some inequalities does."""
    return tuple((opposite(one),) for one in bounds)


def _alternatives(extreme: Extreme, known: Sequence[Bound]) -> Iterator[Alternatives]:
    """What an inequality needs, part by part: where a vertex counts, that part or that it lies outside."""
    inside = [*known, *extreme.within]
    outside = [simplified(opposite(one), known) for one in extreme.within]
    for bound in _apart(simplified(extreme.bound, inside)):
        if follows(bound, inside):
            continue
        if all(follows(bound, [*known, one]) for one in outside):
            yield (bound,)
        else:
            yield (*([] if follows(opposite(bound), inside) else [bound]), *outside)


def _apart(bound: Bound) -> Iterator[Bound]:
    """m l² > 0 as m > 0 and l² > 0."""
    content, factors = bound.value.poly.factor()
    if not bound.is_strict:
        yield bound
        return
    ring = bound.value.ring
    single = ring.one if content > 0 else -ring.one
    for factor, times in factors:
        if int(times) % 2:
            single = single * Expr(ring, factor)
    if single != ring.one:
        yield Bound(single)
    yield from (Bound(Expr(ring, factor) ** 2) for factor, times in factors if int(times) % 2 == 0)


def _excluding(needed: Sequence[Bound], bound: Bound, assumed: Sequence[Bound]) -> tuple[Bound, ...]:
    """A bound, and those of others that it excludes together with what is assumed."""
    kept = list(needed)
    for one in needed:
        rest = [other for other in kept if other is not one]
        if follows(opposite(bound), [*assumed, *rest]):
            kept = rest
    return (*kept, bound)


def _over(minor: Expr, before: Sequence[Expr]) -> Expr:
    """A minor without the factors that are minors before it: these are positive where it matters."""
    for factor in reversed(before):
        while not factor.is_number and (rest := minor.quotient(factor)) is not None and not rest.is_zero:
            minor = rest
    return minor


def _are_possible(matrix: Matrix, conditions: Sequence[Alternatives]) -> bool:
    """Whether there are parameters that satisfy all conditions: tried at random, the same every time."""
    ring, random = matrix.ring, Random(TRIES)  # noqa: S311 - the same values every time are wanted
    for _ in range(TRIES):
        values = {
            name: random.choice((0.0, random.uniform(-3, 3), random.uniform(0, 3), random.uniform(-30, 30)))
            for name in ring.parameters
        }
        if hold(conditions, values, 1e-9, -1e-9):
            return True
    return False


def hold(conditions: Sequence[Alternatives], values: Mapping[str, float], above: float, least: float) -> bool:
    """Whether numbers satisfy all conditions: what is strict from `above` on, what is not from `least` on."""
    return all(
        any(evaluate(b.value, values) >= (above if b.is_strict else least) for b in bounds)
        for bounds in conditions
    )


# -- what no inertia matrix has --------------------------------------------------------------------


def _refusals(robot: Robot, candidate: Candidate) -> Iterator[Definiteness]:
    """Why it can be none, but for its definiteness."""
    matrix, n = candidate.matrix, candidate.matrix.shape[0]
    refused = Definiteness(candidate.name, Answer.NO)
    for i in range(n):
        for j in range(i):
            if matrix[i, j] != matrix[j, i]:
                yield replace(refused, refusal=Refusal.ASYMMETRIC, place=(i, j))
    for q in robot.coordinates:
        for i in range(n):
            for j in range(i + 1):
                refusal = _of_entry(matrix[i, j], q.name, q.type)
                if refusal is not None:
                    yield replace(refused, refusal=refusal, place=(i, j), coordinate=q.name)
    if candidate.is_relative:
        for i in range(n):
            for j in range(i + 1):
                if not matrix.ring.diff(matrix[i, j], 0).is_zero:
                    base = robot.coordinates[0].name
                    yield replace(refused, refusal=Refusal.BASE, place=(i, j), coordinate=base)


def _of_entry(entry: Expr, name: str, kind: JointType) -> Refusal | None:
    """What is wrong with how an entry depends on a coordinate."""
    ring, degrees = entry.ring, entry.poly.degrees()
    degree = degrees[ring.symbol_indices[(name, 0)]]
    if kind is JointType.REVOLUTE:
        return Refusal.NOT_PERIODIC if degree > 0 else None
    turning = [pair for pair in ring.pairs if any(name == n for atom, _ in pair.angle.terms for n, _ in atom)]
    if any(degrees[pair.sine] > 0 or degrees[pair.cosine] > 0 for pair in turning):
        return Refusal.LENGTH_IN_SINE
    return Refusal.DEGREE if degree > 2 else None
