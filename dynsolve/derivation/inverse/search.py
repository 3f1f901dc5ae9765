"""Which unknown is solved for next, and from which equations."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import chain

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.transfer import Transfer
from dynsolve.derivation.inverse.equations import (
    Equation,
    Given,
    System,
    arranged,
    squared_sums,
    turned_systems,
    turns,
)
from dynsolve.derivation.inverse.solving import Part, Solving
from dynsolve.derivation.inverse.subproblems import Remainder, Solved, TwoLines, recognized
from dynsolve.derivation.inverse.unknowns import Unknowns, search_ring

MOST_SYSTEMS = 40
"""So many systems are kept; those that come later are turned more often."""

MOST_TERMS = 400
"""Equations with more terms are not looked at."""


def solve_task(task: Matrix, values: Sequence[str]) -> Solving | None:
    """How r(q) = values is solved for q; None where the known forms do not lead to an end.

    `task` is r(q), m×1; coordinates that do not occur in it are free.
    """
    sums = dict(_angle_sums(task, values))
    given = {remainder.coordinate: remainder.value for remainder in sums.values()}
    ring = search_ring(task.ring, values, given)
    carry = Transfer(task.ring, ring, _angles(sums.values()))
    r = tuple(carry(entry) for entry in task.entries)
    names = [name for name in ring.names if name not in given]
    unknowns = Unknowns(ring, tuple(names), tuple(values))
    occurring = {name for k, e in enumerate(r) if k not in sums for name in unknowns.within(e)}
    free = tuple(name for name in names if name not in occurring)
    for name in free:
        unknowns = unknowns.without(name)
    rest = tuple(
        Equation(ring.symbol(value), entry, Given(k))
        for k, (entry, value) in enumerate(zip(r, values, strict=True))
        if k not in sums
    )
    steps = search([rest], unknowns)
    if {step.coordinate for step in steps} != set(unknowns.names):
        return None
    last = [_in_ring(remainder, carry) for remainder in sums.values()]
    angles = frozenset(given.values())
    return Solving(ring, task, tuple(values), angles, (Part((*steps, *last)),), free)


def _in_ring(remainder: Remainder, carry: Transfer) -> Remainder:
    return Remainder(
        remainder.coordinate, remainder.rate, remainder.value, remainder.others, carry(remainder.rest)
    )


def search(given: Sequence[System], unknowns: Unknowns) -> tuple[Solved, ...]:
    """The steps from some systems to the unknowns, each the simplest there is, as far as they lead."""
    systems = list(given)
    sums: list[Equation] = []
    steps: list[Solved] = []
    while unknowns.names:
        systems = _grown([tuple(arranged(e, unknowns) for e in s) for s in systems], unknowns)
        added = [tuple(_sums(system)) for system in systems]
        best = min(_solvable(systems, added, sums, unknowns), key=_effort, default=None)
        if best is None:
            break
        steps.append(best)
        unknowns = unknowns.without(best.coordinate)
        # what is known from now on may make them longer: they are kept as they are
        sums = [e for e in (*sums, *chain.from_iterable(added)) if len(unknowns.within(e.expr)) == 1]
    return tuple(steps)


def _effort(solved: Solved) -> tuple[int, bool, int]:
    """What a step costs its reader; a turned equation counts as two terms more.

    An angle that is always given comes before one that is free somewhere.
    """
    may_be_free = isinstance(solved, TwoLines) and solved.may_be_free
    return solved.rank, may_be_free, solved.size + 2 * sum(turns(e.origin) for e in solved.equations)


def _grown(systems: list[System], unknowns: Unknowns) -> list[System]:
    """The systems with all that are got by turning them."""
    known = {_mark(system) for system in systems}
    for system in systems:  # grows while it is read
        for turned in turned_systems(system, unknowns):
            mark = _mark(turned)
            if mark not in known and len(systems) < MOST_SYSTEMS:
                known.add(mark)
                systems.append(turned)
    return systems


def _mark(system: System) -> frozenset[str]:
    return frozenset(str(equation.expr.poly) for equation in system)


def _sums(system: System) -> Iterator[Equation]:
    return (e for e in squared_sums(system) if len(e.left) + len(e.right) <= MOST_TERMS)


def _solvable(
    systems: Sequence[System], sums: Sequence[System], earlier: Sequence[Equation], unknowns: Unknowns
) -> Iterator[Solved]:
    """What the equations of some systems, with their sums of squares, and earlier such sums give."""
    for equation in earlier:
        yield from recognized([equation], unknowns)
    for system, squared in zip(systems, sums, strict=True):
        yield from recognized([*system, *squared], unknowns)
    if len(systems) > 1:
        yield from recognized(tuple({e.expr: e for e in chain.from_iterable(systems)}.values()), unknowns)


# -- sums of angles in the task --------------------------------------------------------------------


def _angle_sums(task: Matrix, values: Sequence[str]) -> Iterator[tuple[int, Remainder]]:
    """The components of the task that are sums of angles, by their index: each gives its last coordinate."""
    taken: set[str] = set()
    for k, (entry, value) in enumerate(zip(task.entries, values, strict=True)):
        found = _angle_sum(entry)
        if found is None:
            continue
        rates, rest = found
        name = next((name for name in reversed(rates) if name not in taken), None)
        if name is not None:
            taken.add(name)
            others = tuple((other, rate) for other, rate in rates.items() if other != name)
            yield k, Remainder(name, rates[name], value, others, rest)


def _angle_sum(entry: Expr) -> tuple[dict[str, Fraction], Expr] | None:
    """(the rate of each angle, the rest) of Σ rate·q + rest, the rest without coordinates."""
    ring = entry.ring
    rates: dict[str, Fraction] = {}
    rest = entry
    for name, kind in ring.coordinates:
        if kind != "revolute":
            continue
        rate = ring.coefficient(entry, name)
        if rate.is_zero:
            continue
        if not rate.is_number:
            return None
        rates[name] = rate.number
        rest = rest - ring.symbol(name) * rate
    if not rates or ring.depends_on_coordinates(rest):
        return None
    return rates, rest


def _angles(sums: Iterable[Remainder]) -> dict[str, Angle]:
    """What each given coordinate is in the arguments of sines and cosines."""
    found: dict[str, Angle] = {}
    for remainder in sums:
        angle = Angle.of(remainder.value)
        for name, rate in remainder.others:
            angle = angle - Angle.of(name, rate)
        found[remainder.coordinate] = angle * (1 / remainder.rate)
    return found
