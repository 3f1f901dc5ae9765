"""One hand-in compared with the key: its answers by quantity, and which entries of each are right.

    answers -> values in one ring -> by quantity -> each compared with the key

A quantity may be given in several equations, and an equation may be a chain
`K = a = b = c`: the last member of the last equation counts.  Where a notation leaves
open which quantity is meant (I_1), it is the one that the value equals.  The zero of
height is the student's own.

P may differ from the key by h0 Σ m_i |g|, with one height h0 for all bodies, free of
coordinates, masses and g, of dimension length.  What is looked for is the potential
φ = |g| h0 that a unit of mass has at the key's zero of height.

Equations of motion in which the forces of the constraint stand, as names λ: D q̈ + ... - A_cᵀ λ = τ.

Without λ they are the key's.  What stands beside λ is A_cᵀ: that of the student's own matrix, or, where
the equations of all coordinates are given, that of any that keeps the same constraint; with one
sign for all of them, for in which direction λ counts is free.

Murray, Li, Sastry, A Mathematical Introduction to Robotic Manipulation, section 6.1.2 (1994).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.fraction import RationalExpr, as_expr, equal
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.answers.judging.answer_ring import AnswerRing
from dynsolve.answers.judging.answer_values import AnswerValue, AnswerValues, multiplier_names
from dynsolve.answers.judging.entry_comparison import EntryComparer
from dynsolve.answers.judging.equivalences import as_matrix
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.judging.key_comparison import (
    KeyComparer,
    KeyComparison,
    Obstacle,
    with_own_constraint,
    with_own_multipliers,
)
from dynsolve.answers.judging.own_accelerations import with_own_accelerations
from dynsolve.answers.judging.state_order import with_own_order
from dynsolve.answers.verdict import Answer
from dynsolve.notation import tree
from dynsolve.notation.tree import Node, Number, Symbol, names_in, walk, with_children
from dynsolve.quantities import families
from dynsolve.questions.constraints.judge import WITHOUT_MULTIPLIERS, OwnConstraint
from dynsolve.questions.parameters import PARAMETERS, REFERENCE, REGRESSORS
from dynsolve.questions.parameters.judge import own_parameters
from dynsolve.robot.dimensions import Dimensions
from dynsolve.robot.units import LENGTH

# Equations of motion in which the forces of the constraint stand, as names λ

Rows = tuple[tuple[RationalExpr, ...], ...]


class _Equations(Struct, frozen=True):
    """One answer without λ, and what stands beside the multipliers in the equation of each coordinate."""

    compared: KeyComparison
    beside: Mapping[int, tuple[Expr, ...]]


def with_moved_multipliers(
    own: OwnConstraint, comparisons: Mapping[str, KeyComparison], compare: KeyComparer
) -> tuple[dict[str, KeyComparison], int]:
    """The comparisons, those of equations with λ in them made without it, and the side of A_cᵀ λ.

    That is 1 for the key's, D q̈ + C q̇ + g = τ + A_cᵀ λ, -1 for the other, and 0 where none tells.
    """
    found = dict(comparisons)
    names = [name for name in multiplier_names(own.robot) if own.ring.has_symbol(name)]
    if not names:
        return found, 0
    read = {
        name: equations
        for name, one in comparisons.items()
        if compare.graph.quantities[name].family in (families.TAU, families.FORCE)
        and (equations := _without(compare, name, one)) is not None
    }
    beside = {k: row for equations in read.values() for k, row in equations.beside.items()}
    right, side = _that_are_right(own, beside)
    for name, equations in read.items():
        if not any(not factor.is_zero for row in equations.beside.values() for factor in row):
            continue
        if equations.beside.keys() <= right:
            other = WITHOUT_MULTIPLIERS if equations.compared.correct else ""
            found[name] = replace(equations.compared, other=other)
        elif equations.compared.correct:
            found[name] = replace(equations.compared, obstacles=(Obstacle("constraint_forces"),))
    return found, side


def _without(compare: KeyComparer, name: str, compared: KeyComparison) -> _Equations | None:
    """An answer without λ; None where it has another form than a sum with λ times something."""
    value = compared.answer_value
    if value.rows is None or compared.obstacles or any(len(row) > 1 or row[0].divisor for row in value.rows):
        return None
    quantity = compare.graph.quantities[name]
    first = quantity.index[0] - 1 if quantity.family is families.FORCE else 0
    names = multiplier_names(compare.robot)
    beside: dict[int, tuple[Expr, ...]] = {}
    rests: list[Expr] = []
    for k, row in enumerate(value.rows, first):
        rest, factors = _parted(row[0].numerator, names)
        if any(_parted(factor, names)[0] != factor for factor in factors):
            return None
        beside[k] = factors
        rests.append(rest)
    nodes = tuple(tuple(_put_zero(node, names) for node in row) for row in value.nodes)
    rows = tuple((RationalExpr(rest),) for rest in rests)
    return _Equations(compare(name, AnswerValue(value.answer, rows, nodes)), beside)


def _parted(expr: Expr, names: Sequence[str]) -> tuple[Expr, tuple[Expr, ...]]:
    """An expression without the multipliers, and its derivatives by them."""
    ring, rest, factors = expr.ring, expr, []
    for name in names:
        factor = ring.coefficient(expr, name) if ring.has_symbol(name) else ring.zero
        factors.append(factor)
        rest = rest - factor * ring.symbol(name) if not factor.is_zero else rest
    return rest, tuple(factors)


def _put_zero(node: Node, names: Sequence[str]) -> Node:
    if isinstance(node, Symbol) and node.name in names:
        return Number(0)
    return with_children(node, lambda part: _put_zero(part, names))


def _that_are_right(own: OwnConstraint, beside: Mapping[int, tuple[Expr, ...]]) -> tuple[set[int], int]:
    """The coordinates in whose equations the forces of the constraint are right, and the side of these.

    Where the equations of all coordinates keep the constraint by another matrix it is the student's own.
    """
    told = {k: factors for k, factors in beside.items() if not all(f.is_zero for f in factors)}
    found = {
        side: {k for k, factors in beside.items() if _is_column(own.rows, k, factors, -side)}
        for side in (1, -1)
    }
    side = max(found, key=lambda side: len(found[side]))
    if len(beside) == own.robot.n and len(found[side]) < len(beside):
        rows = zip(*(beside[k] for k in sorted(beside)), strict=True)
        matrix = tuple(tuple(RationalExpr(-factor) for factor in row) for row in rows)
        if own.keeps(matrix):
            own.rows = matrix
            return set(beside), 1
    return found[side], side if found[side] & told.keys() else 0


def _is_column(rows: Rows, k: int, factors: Sequence[Expr], sign: int) -> bool:
    """Whether factors are a column of A_c, with a sign."""
    return all(equal(row[k], RationalExpr(factor * sign)) for row, factor in zip(rows, factors, strict=True))


def _side(general: Answer) -> int:
    """On which side A_cᵀ λ stands in τ = D q̈ + C q̇ + g ± A_cᵀ λ; 0 of every other formula."""
    if general.name != "tau" or general.node is None:
        return 0
    for part in walk(general.node):
        for term in part.terms if isinstance(part, tree.Sum) else ():
            of_constraint = {one.quantity for one in walk(term) if isinstance(one, tree.Reference)}
            if "lambda" in of_constraint and of_constraint <= {"lambda", "Ac"}:
                return 1 if isinstance(term, tree.Negative) else -1
    return 0


# The zero of height, which is the student's to choose


def potential_at_zero_height(
    answer_ring: AnswerRing, values: Mapping[str, Expr], dimensions: Dimensions
) -> Expr | None:
    """φ as most of P_i and P have it, or as L has it where there is no P; None for the key's own zero.

    `values` are the student's values of P_i, P and L.
    """
    energies = {name: value for name, value in values.items() if name != "L"}
    levels = list(_levels(answer_ring, energies or values, dimensions))
    if not levels:
        return None
    counts = Counter(level for level in levels)
    most = max(counts.values())
    common = [level for level in counts if counts[level] == most]
    best = next((level for level in common if level.is_zero), common[0])
    return None if best.is_zero else best


def _levels(answer_ring: AnswerRing, values: Mapping[str, Expr], dimensions: Dimensions) -> Iterable[Expr]:
    robot = answer_ring.robot
    total = answer_ring.ring.zero
    for body in robot.bodies:
        total = total + body.mass
    masses = {"P": total, "L": -total, **{f"P{body.name}": body.mass for body in robot.bodies}}
    for name, value in values.items():
        difference = value - answer_ring.key(name)
        if difference.is_zero:
            yield difference
            continue
        mass = masses[name]
        level = None if mass.is_zero else difference.quotient(mass)
        if level is not None and is_zero_height(answer_ring, level, dimensions):
            yield level


def is_zero_height(answer_ring: AnswerRing, level: Expr, dimensions: Dimensions) -> bool:
    """Whether a potential is |g| times a height that may be chosen."""
    ring, robot = answer_ring.ring, answer_ring.robot
    if ring.depends_on_coordinates(level):
        return False
    strength = None
    for entry in robot.gravity.entries:
        if not entry.is_zero:
            strength = entry.poly if strength is None else strength.gcd(entry.poly)
    if strength is None:
        return False
    gravity = Expr(ring, strength)
    height = level.quotient(gravity)
    if height is None:
        return False
    taken = {i for body in robot.bodies for i in body.mass.used}.union(gravity.used)
    return taken.isdisjoint(height.used) and dimensions.fits(height, LENGTH)


IN_NUMBERS = "it repeats the answer with numbers, which the problem does not give"

LARGEST = 4
"""The largest numerator and denominator of the numbers that the formulas of mechanics have."""

Chain = list[AnswerValue]
"""The members of one equation."""


class ComparedHandIn:
    """The answers of one hand-in, compared with the key.

    `key` is the problem's graph, `compare_entry` compares scalars, by the numbers of the problem file
    too.  `answer_ring` is the problem's ring, extended by what the answers need; `chains` has the
    equations of each quantity, `comparisons` the comparison of the answer that counts; `definitions`
    has the equations that need what is given nowhere, which are none of the answers.  `general` are
    formulas of names alone, as D q̈ + C q̇ + g + A_cᵀ λ = τ, which says on which side λ stands.
    """

    def __init__(
        self,
        key: AnswerGraph,
        compare_entry: EntryComparer,
        answers: Sequence[Answer],
        general: Sequence[Answer] = (),
    ) -> None:
        values = AnswerValues(key, answers)
        self.answer_ring = values.answer_ring
        self.compare_entry = compare_entry
        at_keys_height = KeyComparer(values.graph, self.compare_entry, values.changed)
        found = self._without_repetitions(values.all)
        self.chains = _by_quantity([v for v in found if not v.is_definition], at_keys_height)
        self.definitions = _by_quantity([v for v in found if v.is_definition], at_keys_height)
        energies = dict(self._energies())
        potential = potential_at_zero_height(self.answer_ring, energies, self.answer_ring.dimensions)
        parameters = self._own_parameters()
        is_the_keys = potential is None and not parameters
        self.graph = values.graph if is_the_keys else AnswerGraph(self.answer_ring, potential, parameters)
        self.compare = KeyComparer(self.graph, self.compare_entry, values.changed)
        compared = {name: self.compare(name, last(chains)) for name, chains in self.chains.items()}
        compared = with_own_order(self.graph.robot, compared, self.compare)
        compared = with_own_accelerations(compared, self.compare)
        self.comparisons = (
            self._on_constraint(compared, general) if self.graph.robot.questions.constraints else compared
        )
        self.assembled_coriolis = self._assembled_coriolis()

    def _without_repetitions(self, values: Sequence[AnswerValue]) -> list[AnswerValue]:
        """The values, those set aside that repeat an answer with numbers which the problem does not give."""
        parameters = set(self.answer_ring.robot.parameters)
        in_numbers = [value for value in values if _has_measured_number(value, parameters)]
        if not in_numbers:
            return list(values)
        given = self.compare_entry.values.keys()
        unknown = {v.answer.name for v in values if not names_in(*_nodes(v)) & parameters <= given}
        return [
            replace(value, is_definition=True, fault=IN_NUMBERS)
            if value in in_numbers and value.answer.name in unknown
            else value
            for value in values
        ]

    def _on_constraint(
        self, compared: Mapping[str, KeyComparison], general: Sequence[Answer]
    ) -> dict[str, KeyComparison]:
        """The comparisons where the student may choose the matrix of the constraint, and where λ stands."""
        own = OwnConstraint(self.graph.robot, self.graph.key)
        moved, side = with_moved_multipliers(own, with_own_constraint(own, compared), self.compare)
        sides = [side] if side else [side for side in map(_side, general) if side] or [1, -1]
        return with_own_multipliers(own, moved, self.compare, sides)

    def _own_parameters(self) -> Mapping[str, Matrix]:
        asked = PARAMETERS.keys() | REGRESSORS.keys() | {REFERENCE}
        if not self.chains.keys() & asked:
            return {}
        values = {name: last(self.chains[name]) for name in self.chains.keys() & asked}
        written = {name: matrix for name, value in values.items() if (matrix := as_matrix(value, name))}
        ring = self.answer_ring
        return own_parameters(ring.robot, ring.rules, ring.key, written)

    def _energies(self) -> Iterator[tuple[str, Expr]]:
        """The student's P_i, P and L, where they are expressions of the ring."""
        bodies = self.answer_ring.robot.bodies
        names = {"P", "L"} | {f"P{body.name}" for body in bodies}
        for name in names & self.chains.keys() if bodies else ():
            value = last(self.chains[name])
            if value.rows is not None and len(value.entries) == 1:
                expr = as_expr(value.entries[0])
                if expr is not None:
                    yield name, expr

    def _assembled_coriolis(self) -> KeyComparison | None:
        """C put together from its entries, where all of them were given and C was not.

        Many matrices C give the same C q̇: the entries are right or wrong a row at a time.
        """
        n = self.answer_ring.robot.n
        if "C" in self.comparisons or not n:
            return None
        rows: list[Chain] = []
        for i in range(n):
            row = [self.comparisons.get(f"C{i + 1}{j + 1}") for j in range(n)]
            found = [
                entry.answer_value
                for entry in row
                if entry is not None and entry.answer_value.rows is not None
            ]
            if len(found) < n or any(len(value.entries) != 1 for value in found):
                return None
            rows.append(found)
        node = tree.Matrix(tuple(tuple(value.nodes[0][0] for value in row) for row in rows))
        answer = replace(rows[0][0].answer, name="C", node=node)
        values = tuple(tuple(value.entries[0] for value in row) for row in rows)
        return self.compare("C", AnswerValue(answer, values, node.rows))


def _nodes(value: AnswerValue) -> Iterator[Node]:
    return (node for row in value.nodes for node in row)


def _has_measured_number(value: AnswerValue, parameters: Container[str]) -> bool:
    """Whether a value without parameters has a number that no formula has of itself, as 9.81 and 3.5."""
    found = False
    for part in walk(*_nodes(value)):
        if isinstance(part, Symbol) and part.name in parameters:
            return False
        found = found or (isinstance(part, Number) and (abs(part.p) > LARGEST or part.q > LARGEST))
    return found


def last(chains: Sequence[Chain]) -> AnswerValue:
    """The answer that counts of those given for one quantity: the last member of the last equation."""
    return chains[-1][-1]


def _by_quantity(values: Sequence[AnswerValue], compare: KeyComparer) -> dict[str, list[Chain]]:
    found: dict[str, list[Chain]] = {}
    for value in values:
        chains = found.setdefault(_quantity(value, compare), [])
        if chains and chains[-1][0].answer.occurrence[0] == value.answer.occurrence[0]:
            chains[-1].append(value)
        else:
            chains.append([value])
    return found


def _quantity(value: AnswerValue, compare: KeyComparer) -> str:
    """The name of the quantity that is meant: of several that the notation allows, the one it equals."""
    answer = value.answer
    for name in (answer.name, *answer.alternatives) if answer.alternatives and value.rows else ():
        if compare(name, value).correct:
            return name
    rules = compare.answer_ring.rules
    known = (name for name in (answer.name, *answer.alternatives) if compare.target(name).node in rules)
    return compare.graph.answer(next(known, answer.name))
