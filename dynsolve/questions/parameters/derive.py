"""The equations of motion, linear in the parameters: τ = Y(q, q̇, q̈) a.

The parameters (masses, centres, moments of inertia, ...) occur in τ in certain combinations
only.  The coefficients of all products of coordinates, rates, accelerations, sines and cosines
in τ span a space over the fractions in what is known; a basis of it is an a of minimal length,
and Y holds the coordinates in that basis.  Its dimension is the rank of τ over states and
parameters, so that no shorter a exists.

Spong, Hutchinson, Vidyasagar, section 7.5.3 (2006).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from itertools import combinations as choices

from dynsolve.algebra.angles import names_of
from dynsolve.algebra.compact.terms import Exponents
from dynsolve.algebra.fraction import RationalExpr, add, cancelled, multiply
from dynsolve.algebra.generators import Generator
from dynsolve.algebra.linear_systems import FractionMatrix, tidy
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.parameter_span import (
    Generators,
    ParameterSpan,
    Vector,
    expression,
    length,
    primitive,
    shortened,
)
from dynsolve.algebra.rationals import fraction
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.derivation.graph import Rule, Skipped
from dynsolve.derivation.link_frame import accelerations
from dynsolve.errors import AlgebraError
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import reference

Split = Sequence[Sequence[tuple[Expr, Vector]]]
"""Each force as a sum of (what moves) · (a vector of parameters)."""

MOST_COEFFICIENTS = 4000
"""With more different coefficients no parameters are looked for."""

TOO_MANY = "the forces have too many different coefficients"
MOST_NAMES = 20
"""Of more parameters it is not tried which have to be known."""

NOT_LINEAR = "the forces are not linear in the given parameters"


def generators(ring: Ring, known: frozenset[str]) -> Generators:
    """Which generators move, and which are unknown parameters: all but those of the known names."""
    moving = {g.index for g in ring.generators if _moves(ring, g)}
    unknown = {
        g.index for g in ring.generators if g.index not in moving and not _names(ring, g) <= known | {"pi"}
    }
    return Generators(frozenset(moving), frozenset(unknown))


def known_names(robot: Robot) -> frozenset[str]:
    """The parameters that do not count as unknown: those of the file, and β of a joint's angle q + β."""
    ring = robot.ring
    moving = [_names(ring, g) for g in ring.generators if g.kind in ("sin", "cos") and _moves(ring, g)]
    return robot.questions.model.known.union(*moving) & frozenset(ring.parameters)


def _moves(ring: Ring, g: Generator) -> bool:
    return bool(g.dots) or g.kind == "function" or ring.depends_on_coordinates(ring.generator(g.index))


def _names(ring: Ring, g: Generator) -> frozenset[str]:
    """The parameters that a generator is made of."""
    match g.kind:
        case "symbol":
            return frozenset({g.name})
        case "sin" | "cos":
            return frozenset(names_of(g.angle))
        case "root" | "inverse":
            of = ring.radicands.get(g.index) if g.kind == "root" else ring.inverses.get(g.index)
            degrees = of.degrees() if of is not None else ()
            used = (ring.generators[i] for i, degree in enumerate(degrees) if degree > 0)
            return frozenset().union(*(_names(ring, other) for other in used))
    return frozenset()


def minimal_parameters(robot: Robot, forces: Matrix) -> Matrix | Skipped:
    """a, p×1, of minimal length with forces = Y a; the entries are as short as they are found.

    An unknown that motions tell by itself is an entry: of rods of known lengths, each mass.  They stand in
    the order in which they come into the equations: those that accelerate the first coordinate first.
    """
    split = _split(robot, forces)
    found = coefficients(vector for row in split for _, vector in row)
    if len(found) > MOST_COEFFICIENTS:
        return Skipped(TOO_MANY)
    span, chosen = _basis(robot.ring, found)
    unknown = {key: None for vector in found for key in vector}
    alone = [one for key in unknown if span.has(one := {key: robot.ring.one})]
    if not all(one in chosen for one in alone):
        _, chosen = _basis(robot.ring, [*alone, *found])
    columns = _columns(robot.ring, split, chosen)
    assert columns is not None
    order = sorted(
        range(len(chosen)), key=lambda k: _place(robot.ring, [row[k].numerator for row in columns])
    )
    return Matrix.column(robot.ring, [expression(robot.ring, chosen[k]) for k in order])


def _basis(ring: Ring, vectors: Iterable[Vector]) -> tuple[ParameterSpan, list[Vector]]:
    """What some vectors span, and a basis of it, each shortened by those before it."""
    span, chosen = ParameterSpan(ring), list[Vector]()
    for vector in vectors:
        if not span.has(vector):
            chosen.append(shortened(vector, chosen))
            span.add(chosen[-1])
    return span, chosen


def reference_forces(robot: Robot, D: Matrix, C: Matrix, gravity: Matrix) -> Matrix:
    """D q̈_r + C q̇_r + g, n×1: linear in the reference rates, as adaptive control needs it."""
    ring = robot.ring
    rates, accelerations = (
        Matrix.column(ring, [ring.symbol(reference(q.name), dots) for q in robot.coordinates])
        for dots in (1, 2)
    )
    return D @ accelerations + C @ rates + gravity


def combinations(
    robot: Robot, forces: Matrix, parameters: Matrix
) -> list[tuple[Expr, tuple[RationalExpr, ...]]]:
    """Each coefficient of what moves, the shortest first, with its factors y in coefficient = Σ y_k a_k.

    None of forces that are no combinations of these parameters.
    """
    kinds = generators(robot.ring, known_names(robot))
    span = ParameterSpan(robot.ring)
    for entry in parameters.entries:
        span.add(kinds.vector(entry) or {})
    found = []
    for vector in coefficients(vector for row in _split(robot, forces) for _, vector in row):
        factors = span.coordinates(vector)
        if factors is None:
            return []
        found.append((expression(robot.ring, vector), factors))
    return found


def missing(robot: Robot, forces: Matrix, parameters: Matrix) -> Expr | None:
    """A coefficient of the forces that is no combination of these parameters; None where all are.

    Raises AlgebraError where a parameter moves.
    """
    kinds = generators(robot.ring, known_names(robot))
    span = ParameterSpan(robot.ring)
    for entry in parameters.entries:
        vector = kinds.vector(entry)
        if vector is None:
            raise AlgebraError("what moves stands in a parameter", "it belongs into the regressor")
        span.add(vector)
    for vector in coefficients(vector for row in _split(robot, forces) for _, vector in row):
        if not span.has(vector):
            return expression(robot.ring, vector)
    return None


def parameters_for(robot: Robot, forces: Matrix, columns: Matrix) -> Matrix | None:
    """An a with forces = Y a for a given Y, n×p; None where there is none.

    With each product of unknown parameters stands in the forces a column of what moves; where
    all of these are combinations of the columns of Y, their factors add up to a.
    """
    ring = robot.ring
    kinds = generators(ring, known_names(robot))
    span, used = ParameterSpan(ring), list[int]()
    for k in range(columns.shape[1]):
        by_product = _by_product(kinds, columns.column_at(k))
        if set(by_product) - {(0,) * len(ring.generators)}:
            return None
        if any(map(span.add, by_product.values())):
            used.append(k)
    found = [ring.zero] * columns.shape[1]
    for product, vector in _by_product(kinds, forces).items():
        factors = span.coordinates(vector)
        if factors is None or any(factor.divisor is not None for factor in factors):
            return None
        for k, factor in zip(used, factors, strict=True):
            found[k] += expression(ring, {product: factor.numerator})
    return Matrix.column(ring, found)


def _by_product(kinds: Generators, column: Matrix) -> dict[Exponents, Vector]:
    """What stands with each product of unknown parameters, as a vector over (row, what moves)."""
    found: dict[Exponents, Vector] = {}
    for row, entry in enumerate(column.entries):
        for motion, vector in kinds.split(entry):
            for product, factor in vector.items():
                into = found.setdefault(product, {})
                for exponents, number in motion.poly.to_dict().items():
                    key = (row, *map(int, exponents))
                    part = factor * fraction(number)
                    into[key] = into[key] + part if key in into else part
    return {
        product: {key: part for key, part in vector.items() if not part.is_zero}
        for product, vector in found.items()
    }


def _split(robot: Robot, forces: Matrix) -> Split:
    kinds = generators(robot.ring, known_names(robot))
    return [kinds.split(entry) for entry in forces.entries]


def coefficients(vectors: Iterable[Vector]) -> list[Vector]:
    """Different vectors without what is known in all of their terms, the shortest first."""
    distinct: dict[frozenset[object], Vector] = {}
    for vector in vectors:
        plain = primitive(vector)
        distinct.setdefault(frozenset((key, str(value.poly)) for key, value in plain.items()), plain)
    return sorted(distinct.values(), key=lambda v: (length(v), sum(map(sum, v)), sorted(v, reverse=True)))


def regressor(
    robot: Robot, forces: Matrix, parameters: Matrix | Skipped
) -> Matrix | FractionMatrix | Skipped:
    """Y, n×p, with forces = Y a for the parameters a, p×1.

    Beside entries of a that are combinations of those before them stands 0.
    """
    if isinstance(parameters, Skipped):
        return parameters
    known = known_names(robot)
    columns = _regressor(robot.ring, known, forces, parameters)
    if columns is not None:
        return tidy(robot.ring, [map(cancelled, row) for row in columns])
    names = sorted(set(robot.ring.parameters) - known) if len(robot.ring.parameters) <= MOST_NAMES else []
    for size in (1, 2):
        for more in choices(names, size):
            if _regressor(robot.ring, known.union(more), forces, parameters) is not None:
                are = f"{' and '.join(more)} {'were' if size > 1 else 'was'}"
                return Skipped(f"{NOT_LINEAR}; they would be if {are} `known`")
    return Skipped(NOT_LINEAR)


def _regressor(
    ring: Ring, known: frozenset[str], forces: Matrix, parameters: Matrix
) -> list[list[RationalExpr]] | None:
    """Y where some parameters are known; None where the forces are no combinations of the others."""
    kinds = generators(ring, known)
    vectors = [vector for entry in parameters.entries if (vector := kinds.vector(entry)) is not None]
    if len(vectors) < len(parameters.entries):
        return None
    return _columns(ring, [kinds.split(entry) for entry in forces.entries], vectors)


def _columns(ring: Ring, split: Split, vectors: Sequence[Vector]) -> list[list[RationalExpr]] | None:
    """Y, row by row; None where the forces are no combinations of these parameters."""
    span = ParameterSpan(ring)
    used = [k for k, vector in enumerate(vectors) if span.add(vector)]
    rows: list[list[RationalExpr]] = []
    for force in split:
        rows.append([RationalExpr(ring.zero)] * len(vectors))
        for motion, vector in force:
            found = span.coordinates(vector)
            if found is None:
                return None
            for k, factor in zip(used, found, strict=True):
                if not factor.is_zero:
                    rows[-1][k] = add(rows[-1][k], multiply(RationalExpr(motion), factor))
    return rows


def _place(ring: Ring, column: Sequence[Expr]) -> tuple[int, int, int]:
    """(0 with an acceleration, 1 with the configuration alone, else 2; the row; how long it is there)"""
    row, entry = next((i, e) for i, e in enumerate(column) if not e.is_zero)
    dotted = [max((g.dots for g, e in zip(ring.generators, degrees, strict=True) if e), default=0)
              for degrees in entry.poly.monoms()]  # fmt: skip
    return (0 if 2 in dotted else 1 if 1 not in dotted else 2), row, len(entry)


def rules(robot: Robot) -> Iterator[Rule]:
    """The rules of Y and a: of τ, of D q̈, with reference rates, and of gravity; none without masses."""
    if not robot.has_dynamics:
        return
    minimal, columns = partial(minimal_parameters, robot), partial(regressor, robot)
    given = robot.questions.model.parameters
    yield Rule("a", ("tau",), minimal) if given is None else Rule("a", (), lambda: given)
    yield Rule("Y", ("tau", "a"), columns)

    def inertial(D: Matrix) -> Matrix:
        return D @ accelerations(robot)

    yield Rule("aM", ("D",), lambda D: minimal(inertial(D)))
    yield Rule("YM", ("D", "aM"), lambda D, a: columns(inertial(D), a))
    if robot.ring.plan.references:
        forces = partial(reference_forces, robot)
        yield Rule("Yr", ("D", "C", "g", "a"), lambda D, C, g, a: columns(forces(D, C, g), a))
    yield Rule("ag", ("g",), minimal)
    yield Rule("Yg", ("g", "ag"), columns)
