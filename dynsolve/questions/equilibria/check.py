"""Equilibria and their stability, compared with numbers.

At points of each case, found by Newton's method, gravity and springs must move nothing; every
zero that the same method finds of the forces themselves must lie in one of the cases; and at
the points whose stability is told, differences of the forces decide whether the energy rises
in every direction.  Where rates are held constant the forces are τ, with these rates and without
accelerations.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import combinations, islice, product
from math import radians
from random import Random

from msgspec import Struct

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.linear_systems import FractionMatrix, fraction_of
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring_values import evaluate
from dynsolve.algebra.sampling import samples
from dynsolve.derivation.configurations import NO_VALUE, is_zero
from dynsolve.derivation.elimination import free_directions, is_positive_definite, rank, solved
from dynsolve.derivation.reached import CLOSE
from dynsolve.derivation.singular.zeros import Condition
from dynsolve.errors import VerificationError
from dynsolve.explain.forms import Forms
from dynsolve.notation.tree import Matrix as MatrixTree
from dynsolve.notation.tree import Negative, Node, Product, Sum
from dynsolve.notation.tree_values import Program, compile_trees
from dynsolve.questions.equation_sets import moving, starts
from dynsolve.questions.equilibria.balance import STATES, never_zero, table_lengths
from dynsolve.questions.equilibria.forms import EquilibriaForms
from dynsolve.questions.equilibria.linear_check import linear_names, verify_linear
from dynsolve.questions.equilibria.multipliers import Along
from dynsolve.questions.equilibria.solving import Equilibria, multipliers, wanted_rows
from dynsolve.questions.equilibria.stability import Point, Stability, turned
from dynsolve.questions.held import Held
from dynsolve.robot.model import Robot

_STEP = 1e-5
_WIDE = 0.1
_CURVE_STEPS = 10
_NEARBY = 40
_NEAR = 1e-6
_NEWTON_STEPS = 60
_TINY = 1e-12
_NEAR_ZERO = 1e-4
"""So near is a zero of higher order found, of which Newton's method sees the square; so are differences."""


class Case(Struct, frozen=True):
    """Expressions that are 0 together, the points among them whose stability is told, and sets left out."""

    zeros: tuple[Node, ...]
    points: tuple[Point, ...]
    excluded: tuple[tuple[Node, ...], ...] = ()


def balanced_forces(robot: Robot) -> str:
    """The name of the forces that are 0 in an equilibrium: g, or τ where rates are held constant."""
    return "tau" if robot.questions.model.steady else "g"


def in_balance(forms: Forms, forces: Node) -> list[Node]:
    """What must be 0: the forces of what no motor holds; with constraints what these leave of them."""
    robot, wanted = forms.robot, wanted_rows(forms.robot)
    assert isinstance(forces, MatrixTree)
    row = tuple(forces.rows[k][0] for k in wanted)
    if not robot.questions.constraints:
        return list(row)
    A, h = forms("Ac"), forms("hc")
    order = multipliers(robot, *(forms.values[name] for name in ("g", "Ac", "hc"))).rank + 1
    assert isinstance(A, MatrixTree) and isinstance(h, MatrixTree)
    columns = [tuple(line[k] for k in wanted) for line in A.rows]
    dependent = [
        _determinant([[line[k] for k in across] for line in (*chosen, row)])
        for chosen in combinations(columns, order - 1)
        for across in combinations(range(len(wanted)), order)
    ]
    return [*dependent, *(line[0] for line in h.rows)]


def holding(forms: Forms, forces: Node) -> Callable[[Mapping[str, float]], bool]:
    """Whether there are multipliers where `in_balance` is 0: gᵀ leaves the rank of A_c as it is."""
    robot, wanted = forms.robot, wanted_rows(forms.robot)
    if not robot.questions.constraints:
        return lambda at: True
    program = compile_trees([forms("Ac"), forces])

    def holds(at: Mapping[str, float]) -> bool:
        A, g = program.run(at)
        rows = [[line[k] for k in wanted] for line in A]
        row = [g[k][0] for k in wanted]
        return rank(rows, _NEAR_ZERO, scale=1.0) == rank([*rows, row], _NEAR_ZERO, scale=1.0)

    return holds


def _determinant(rows: Sequence[Sequence[Node]]) -> Node:
    """Along the first row."""
    first, *others = rows
    if not others:
        return first[0]
    terms = []
    for k, entry in enumerate(first):
        term = Product((entry, _determinant([[*line[:k], *line[k + 1 :]] for line in others])))
        terms.append(Negative(term) if k % 2 else term)
    return Sum(tuple(terms))


def zero_near(robot: Robot, zeros: Program, start: Mapping[str, float]) -> dict[str, float] | None:
    """A configuration near `start` at which everything is 0, by Newton's method; None where none is found.

    Each step is the shortest that solves the linear equations, which may be fewer than the
    coordinates, or repeat each other: Jᵀ (J Jᵀ + ε)⁻¹ f.
    """
    return zero_along([q.name for q in robot.coordinates], zeros, start)


def zero_along(names: Sequence[str], zeros: Program, start: Mapping[str, float]) -> dict[str, float] | None:
    """The same where only these names are changed."""
    at = dict(start)
    names = [name for name in names if name in zeros.symbols]
    try:
        for _ in range(_NEWTON_STEPS):
            f = zeros.run(at)
            if max(map(abs, f)) < CLOSE**2:
                return at
            moved = [zeros.run({**at, name: at[name] + _STEP}) for name in names]
            J = [[(m[k] - value) / _STEP for m in moved] for k, value in enumerate(f)]
            squares = [
                [
                    sum(a * b for a, b in zip(row, other, strict=True)) + _TINY * (i == j)
                    for j, other in enumerate(J)
                ]
                for i, row in enumerate(J)
            ]
            along = solved(squares, f)
            for k, name in enumerate(names):
                at[name] -= sum(x * row[k] for x, row in zip(along, J, strict=True))
    except NO_VALUE:
        return None
    return None


def verify_equilibria(
    robot: Robot,
    balanced: Node,
    zeros: Sequence[Node],
    cases: Sequence[Case],
    holds: Callable[[Mapping[str, float]], bool] = lambda at: True,
    constraints: Node | None = None,
    unknown: Sequence[Sequence[Node]] = (),
) -> None:
    """Compare the cases with the forces, which are those of `balanced_forces`; `holds` is that of `holding`.

    `constraints` is A_c where an energy decides on the stability of what constraints hold; of the sets that
    are `unknown` nothing is told.  Raises
    VerificationError where an equilibrium is none, one is missing, or its stability is another.
    """
    programs = [compile_trees(list(case.zeros)) for case in cases]
    _verify_sets(robot, starts(robot), zeros, cases, holds, unknown)
    whole = compile_trees([balanced])
    if isinstance(constraints, MatrixTree) and isinstance(balanced, MatrixTree):
        columns = wanted_rows(robot)
        rows = tuple(tuple(row[k] for k in columns) for row in constraints.rows)
        whole = compile_trees([MatrixTree(tuple(balanced.rows[k] for k in columns)), MatrixTree(rows)])
    allowed = compile_trees(
        list(zeros[-len(constraints.rows) :] if isinstance(constraints, MatrixTree) else ())
    )
    for program, case in zip(programs, cases, strict=True):
        for point in case.points:
            _verify_stability(robot, whole, program, allowed, point)


def _verify_sets(
    robot: Robot,
    begun: Iterable[dict[str, float]],
    zeros: Sequence[Node],
    cases: Sequence[Case],
    holds: Callable[[Mapping[str, float]], bool],
    unknown: Sequence[Sequence[Node]],
) -> None:
    """Compare the cases with the forces, from the configurations `begun`."""
    forces = compile_trees(list(zeros))
    programs = [compile_trees(list(case.zeros)) for case in cases]
    untold = [compile_trees(list(one)) for one in unknown]
    left_out = [[compile_trees(list(one)) for one in case.excluded] for case in cases]
    for start in begun:
        for program, without, case in zip(programs, left_out, cases, strict=True):
            at = zero_near(robot, program, start) if case.zeros else start
            if at is not None and not (
                _lies_in(robot, forces, at)
                and (holds(at) or any(_lies_in(robot, one, at) for one in without))
            ):
                raise VerificationError("something moves in an equilibrium; this is a fault of dynsolve")
            none = (zero_near(robot, one, start) for one in without)
            others = [one for one in programs if one is not program]
            if any(at is not None and holds(at) and not _lies_in_any(robot, others, at) for at in none):
                raise VerificationError("an equilibrium is left out; this is a fault of dynsolve")
        found = zero_near(robot, forces, start)
        is_one = found is not None and holds(found)
        if found is not None and is_one and not _lies_in_any(robot, [*programs, *untold], found):
            raise VerificationError("an equilibrium is missing; this is a fault of dynsolve")


def verify_special(
    robot: Robot,
    shown: EquilibriaForms,
    found: Equilibria,
    zeros: Sequence[Node],
    holds: Callable[[Mapping[str, float]], bool],
) -> None:
    """Compare what is told for special parameters with the forces there, but what is singular."""
    assumed = [bound.value for bound in robot.questions.model.assumed]
    for special in found.special:
        if special.cases is None or special.needs or found.singular:
            continue
        factor = compile_trees([shown.condition(Condition(special.factor))])
        there = (zero_along(list(robot.parameters), factor, start) for start in starts(robot))
        begun = [
            at | moving(robot, at)
            for at in there
            if at is not None
            and all(at[name] > _NEAR for name in robot.parameters)
            and all(evaluate(value, at) > 0 for value in assumed)
        ]
        cases = [Case(zeros_there, ()) for zeros_there in shown.special_cases(special)]
        _verify_sets(robot, begun, zeros, cases, holds, ())


def verify_excluded(
    robot: Robot,
    found: Equilibria,
    sets: Iterable[Sequence[Node]],
    zeros: Sequence[Node],
    holds: Callable[[Mapping[str, float]], bool],
    others: Sequence[Program] = (),
) -> None:
    """Look for what is held in the sets that are left out, where two parameters are equal.

    But for what lies in other cases.  Raises VerificationError where there is something, and it is not told
    that there may be.
    """
    assumed = [bound.value for bound in robot.questions.model.assumed]
    told = [case.factor for case in found.special if not case.is_known]
    pairs = [*combinations(robot.parameters, 2)] if not found.may_be_others else []
    for one in sets:
        left_out, held = compile_trees(list(one)), compile_trees([*one, *zeros])
        for (name, other), start in product(pairs, starts(robot)):
            near = zero_near(robot, left_out, {**start, name: start[other]})
            at = near and zero_near(robot, held, near)
            if at is None or any(evaluate(value, at) <= 0 for value in assumed):
                continue
            is_told = any(abs(evaluate(factor, at)) < _NEAR_ZERO for factor in told)
            if holds(at) and not is_told and not _lies_in_any(robot, others, at):
                raise VerificationError("special parameters are forgotten; this is a fault of dynsolve")


def _lies_in(robot: Robot, case: Program, found: Mapping[str, float]) -> bool:
    """Whether a configuration is one of a case; a zero of higher order is found with fewer digits."""
    if is_zero(case, found):
        return True
    near = zero_near(robot, case, found)
    return near is not None and all(abs(near[q.name] - found[q.name]) < _NEAR_ZERO for q in robot.coordinates)


def _lies_in_any(robot: Robot, cases: Iterable[Program], found: Mapping[str, float]) -> bool:
    return any(_lies_in(robot, case, found) for case in cases)


def _is_minimum(point: Point, at: Mapping[str, float]) -> bool | None:
    """Whether a minimum of the energy is told for these parameters; None where nothing is."""
    if any(abs(evaluate(factor, at)) < _NEAR for factor in point.nonzero):
        return None
    if not point.conditions:
        if point.stability is Stability.UNSTABLE:
            return False
        return True if point.nonzero or point.stability is Stability.STABLE else None
    least = min(evaluate(bound.value, at) for bound in point.conditions)
    return None if abs(least) < _TINY or (least > 0 and point.is_open) else least > 0


def _verify_stability(robot: Robot, forces: Program, zeros: Program, allowed: Program, point: Point) -> None:
    """`allowed` are the constraints, which are 0."""
    wanted = [(angle, radians(degrees)) for angle, degrees in turned(point.values)]
    for start in starts(robot):
        for angle, size in wanted:
            _turn(robot, start, angle, size)
        at = zero_near(robot, zeros, start)
        if at is None or any(abs(angle.radians(at) - size) > _NEAR for angle, size in wanted):
            continue
        if point.along is not None:
            _verify_along(robot, forces, point.along, at)
        told = _is_minimum(point, at)
        rises = _rises_around(robot, forces, allowed, at) if point.is_crossing else None
        if told is not None and (_rises(robot, forces, at, point) if rises is None else rises) is not told:
            raise VerificationError("the stability told is another; this is a fault of dynsolve")


def _turn(robot: Robot, state: dict[str, float], angle: Angle, size: float) -> None:
    """Change a coordinate of a state, in which the angle is linear, so that this has a size."""
    name = next(q.name for q in robot.coordinates if any((q.name, 1) in atom for atom, _ in angle.terms))
    at_0, at_1 = (angle.radians({**state, name: value}) for value in (0.0, 1.0))
    state[name] = (size - at_0) / (at_1 - at_0)


def _rises(robot: Robot, forces: Program, at: Mapping[str, float], point: Point) -> bool:
    """Whether the energy rises but along what is neutral."""
    if robot.questions.constraints:
        return _rises_on_curve(robot, forces, at) if point.higher else _rises_along(robot, forces, at)
    steady = dict(robot.questions.model.steady)
    rest = [q for q in robot.coordinates if q.index - 1 not in point.neutral and q.name not in steady]
    rows = []
    flat = {one.coordinate for one in point.higher}
    for q in rest:
        if q.index - 1 in flat:
            ahead, behind = (forces.run({**at, q.name: at[q.name] + step})[0] for step in (_WIDE, -_WIDE))
            rises = ahead[q.index - 1][0] > 0 > behind[q.index - 1][0]
            rows.append([(1.0 if rises else -1.0) * (k is q) for k in rest])
            continue
        ahead, behind = (forces.run({**at, q.name: at[q.name] + step})[0] for step in (_STEP, -_STEP))
        rows.append([(ahead[k.index - 1][0] - behind[k.index - 1][0]) / (2 * _STEP) for k in rest])
    return is_positive_definite(rows)


def _verify_along(robot: Robot, program: Program, along: Along, at: Mapping[str, float]) -> None:
    """Raises VerificationError where Z, λ or the second derivatives along Z are others."""
    if abs(evaluate(along.size, at)) < _NEAR:
        return
    g, A = program.run(at)
    Z, held, second = (_numbers(one, at) for one in (along.free, along.multipliers, along.second))
    columns = list(zip(*Z, strict=True))
    gaps = [sum(a * z for a, z in zip(row, column, strict=True)) for row in A for column in columns]
    pulls = (sum(x * row[k] for (x,), row in zip(held, A, strict=True)) for k in range(len(g)))
    gaps += [force[0] - pull for force, pull in zip(g, pulls, strict=True)]
    theirs = _between(columns, _slopes(robot, program, at))
    gaps += [a - b for mine, row in zip(second, theirs, strict=True) for a, b in zip(mine, row, strict=True)]
    if not max(map(abs, gaps)) < _NEAR_ZERO * max(1.0, *(abs(x) for row in theirs for x in row)):
        raise VerificationError("what is curved along the constraint differs; this is a fault of dynsolve")


def _numbers(matrix: Matrix | FractionMatrix, at: Mapping[str, float]) -> list[list[float]]:
    fractions = [[fraction_of(entry) for entry in row] for row in matrix.rows]
    return [[evaluate(x.numerator, at) / evaluate(x.denominator, at) for x in row] for row in fractions]


def _between(vectors: Sequence[Sequence[float]], slopes: Sequence[Sequence[float]]) -> list[list[float]]:
    """Vᵀ S V, of vectors as columns."""
    return [
        [
            sum(a * s * b for a, row in zip(u, slopes, strict=True) for b, s in zip(v, row, strict=True))
            for v in vectors
        ]
        for u in vectors
    ]


def _rises_along(robot: Robot, program: Program, at: Mapping[str, float]) -> bool:
    """Whether the energy rises along what constraints leave free."""
    return is_positive_definite(_between(free_directions(program.run(at)[1]), _slopes(robot, program, at)))


def _rises_on_curve(robot: Robot, program: Program, at: Mapping[str, float]) -> bool:
    """Whether the energy rises to both sides along the curve that is left free (Runge and Kutta)."""
    names = [robot.coordinates[k].name for k in wanted_rows(robot)]

    def moved(q: Mapping[str, float], direction: Sequence[float], step: float) -> dict[str, float]:
        return {**q, **{name: q[name] + step * x for name, x in zip(names, direction, strict=True)}}

    def pull(step: float) -> float:
        q, (ahead,) = at, free_directions(program.run(at)[1])

        def along(q: Mapping[str, float]) -> list[float]:
            (found,) = free_directions(program.run(q)[1])
            turned = sum(x * y for x, y in zip(found, ahead, strict=True)) < 0
            return [-x if turned else x for x in found]

        for _ in range(_CURVE_STEPS):
            first = along(q)
            second = along(moved(q, first, step / 2))
            third = along(moved(q, second, step / 2))
            last = along(moved(q, third, step))
            four = zip(first, second, third, last, strict=True)
            q = moved(q, [(a + 2 * b + 2 * c + d) / 6 for a, b, c, d in four], step)
            ahead = along(q)
        return float(sum(x * force[0] for x, force in zip(ahead, program.run(q)[0], strict=True)))

    return pull(_WIDE / _CURVE_STEPS) > 0 > pull(-_WIDE / _CURVE_STEPS)


def _rises_around(robot: Robot, program: Program, allowed: Program, at: Mapping[str, float]) -> bool | None:
    """Whether the energy rises to all that is allowed near by; None where nothing is found there."""
    random = Random(1)  # noqa: S311 - the same every time is wanted
    names, rises = [robot.coordinates[k].name for k in wanted_rows(robot)], list[bool]()
    for _ in range(_NEARBY):
        beside = {**at, **{name: at[name] + random.uniform(-_WIDE, _WIDE) for name in names}}
        near = zero_near(robot, allowed, beside)
        if near is None or not _WIDE / 4 < max(abs(near[name] - at[name]) for name in names) < 2 * _WIDE:
            continue
        steps = {name: near[name] - at[name] for name in names}
        work = 0.0
        for part, weight in ((0.0, 1.0), (0.5, 4.0), (1.0, 1.0)):  # Simpson's rule
            g = program.run({**near, **{name: at[name] + part * steps[name] for name in names}})[0]
            work += weight / 6 * sum(force[0] * steps[name] for force, name in zip(g, names, strict=True))
        rises.append(work > 0)
    return all(rises) if rises else None


def _slopes(robot: Robot, program: Program, at: Mapping[str, float]) -> list[list[float]]:
    """The derivatives of g - A_cᵀ λ, by differences, with the λ of the equilibrium."""
    g, A = program.run(at)
    squares = [[sum(a * b for a, b in zip(row, other, strict=True)) for other in A] for row in A]
    pulls = solved(squares, [sum(a * force[0] for a, force in zip(row, g, strict=True)) for row in A])

    def left(q: Mapping[str, float]) -> list[float]:
        forces, rows = program.run(q)
        held = (sum(x * row[k] for x, row in zip(pulls, rows, strict=True)) for k in range(len(forces)))
        return [force[0] - x for force, x in zip(forces, held, strict=True)]

    slopes = []
    for name in (robot.coordinates[k].name for k in wanted_rows(robot)):
        ahead, behind = (left({**at, name: at[name] + step}) for step in (_STEP, -_STEP))
        slopes.append([(a - b) / (2 * _STEP) for a, b in zip(ahead, behind, strict=True)])
    return slopes


def verify(held: Held) -> None:
    """Hold the results as they are printed; raises VerificationError where one is wrong."""
    robot, values, forms = held.robot, held.values, held.forms
    held.hold(verify_linear, linear_names(held.wanted))
    shown = EquilibriaForms(robot, values)
    if "balance" in held.wanted:
        verify_balance(robot, forms("g"), shown.balance)
    if "equilibria" in held.wanted:
        told = zip(shown.equilibria, values["equilibria"].points, shown.excluded, strict=True)
        balanced = forms(balanced_forces(robot))
        zeros, holds = in_balance(forms, balanced), holding(forms, balanced)
        A = forms("Ac") if robot.questions.constraints else None
        unknown = [[*map(shown.condition, case)] for case, _ in values["equilibria"].singular]
        verify_equilibria(robot, balanced, zeros, [Case(*case) for case in told], holds, A, unknown)
        verify_special(robot, shown, values["equilibria"], zeros, holds)
        programs = [compile_trees(list(case)) for case in shown.equilibria]
        for k, sets in enumerate(shown.excluded):
            others = [*programs[:k], *programs[k + 1 :]]
            verify_excluded(robot, values["equilibria"], sets, zeros, holds, others)


def balanced_points(robot: Robot, conditions: Sequence[Node]) -> Iterator[dict[str, float]]:
    """Values of all parameters at which all conditions are 0, each with a configuration.

    What is never 0, as a mass, is changed where nothing else makes them 0, and stays positive.
    """
    program, kept = compile_trees(list(conditions)), never_zero(robot)
    free = sorted(set(robot.parameters) - kept)
    places = [name for name in free if name not in table_lengths(robot)]
    moved = (places, free, sorted(robot.parameters))
    for start in islice(samples(robot.ring), STATES):
        found = (zero_along(names, program, start) for names in moved) if conditions else (start,)
        yield from islice((at for at in found if at is not None and all(at[x] > CLOSE for x in kept)), 1)


def is_balanced(robot: Robot, gravity: Node, at: Mapping[str, float]) -> bool:
    """Whether gravity is what is asked for."""
    wanted = robot.questions.model.balanced
    found = compile_trees([gravity]).run(at)[0]
    given = [0.0] * robot.n if wanted is None else [evaluate(e, at) for e in wanted.entries]
    return all(abs(row[0] - other) < CLOSE for row, other in zip(found, given, strict=True))


def verify_balance(robot: Robot, gravity: Node, conditions: Sequence[Node]) -> None:
    """Raises VerificationError where the conditions hold and gravity is not what is asked for."""
    if not all(is_balanced(robot, gravity, at) for at in balanced_points(robot, conditions)):
        raise VerificationError("gravity is not balanced where it should be; this is a fault of dynsolve")
