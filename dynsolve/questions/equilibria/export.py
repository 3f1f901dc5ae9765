"""Where equilibria are, how stable, and what balances gravity, in the JSON of a solution."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from dynsolve.algebra.angles import angle_node
from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.ring import Expr
from dynsolve.notation.build import times, total
from dynsolve.notation.python import PythonPrinter
from dynsolve.notation.tree import Node, Symbol
from dynsolve.questions.equilibria.forms import EquilibriaForms
from dynsolve.questions.equilibria.solving import Equilibria, SpecialCase
from dynsolve.questions.equilibria.stability import Point, Stability, by_coordinates, turned
from dynsolve.questions.export import Export, alternatives, existence, inequalities, plain_inequality, skipped


def value(export: Export, name: str) -> Any:
    """Alternatives of equations; of `balance` equations that all hold."""
    if name == "equilibria":
        return alternatives(export, EquilibriaForms(export.robot, export.values), name)
    conditions = EquilibriaForms(export.general_robot, export.general_values).balance
    return skipped(export.general_values, name) or [f"{export.python.text(left)} = 0" for left in conditions]


def beside(export: Export) -> Iterator[tuple[str, Any]]:
    """`equilibria_stability`, where the equilibria are there, or are others; what is none in each."""
    shown, printer = EquilibriaForms(export.robot, export.values), export.python
    found = shown.values["equilibria"] if "equilibria" in export.robot.questions.asked else None
    if not isinstance(found, Equilibria):
        return

    def written(bounds: Sequence[Bound]) -> list[str]:
        return inequalities(shown, printer, bounds)

    def stability(point: Point) -> dict[str, Any]:
        bounds = (*point.inside, *point.conditions)
        needed = [*written(bounds), *(_nonzero(shown, printer, factor) for factor in point.nonzero)]
        if point.stability is Stability.UNSTABLE and needed:  # where a bound is an equality nothing is known
            return {"stability": Stability.UNDECIDED.value, "unstable_if": [" and ".join(needed)]}
        conditions = {"stable_if": needed} if needed and not point.is_open else {}
        if point.falls:
            conditions["unstable_if"] = written([Bound(-bound.value) for bound in point.conditions])
        return {"stability": point.stability.value, **conditions}

    def told(point: Point) -> dict[str, Any]:
        at: dict[str, str] = {}
        for angle, degrees in turned(point.values):
            moving, fixed = by_coordinates(angle, export.robot.ring.names)
            turns = times(degrees / 180, [(Symbol("pi"), 1)])
            at[printer.text(angle_node(moving))] = printer.text(total([angle_node(fixed), turns]))
        return {**at, **stability(point)}

    yield "equilibria_stability", [[told(point) for point in points] for points in found.points]
    yield from existence("equilibria", shown, printer, found.exist)
    if any(found.excluded):
        yield "equilibria_except", [_sets(sets, printer) for sets in shown.excluded]
    if found.special:
        yield "equilibria_special", [_special(one, shown, printer) for one in found.special]
    if found.may_be_others:
        yield "equilibria_general", True


def _nonzero(shown: EquilibriaForms, printer: PythonPrinter, factor: Expr) -> str:
    return plain_inequality(shown.comparison(factor, "≠"), printer)


def _sets(sets: Sequence[Sequence[Node]], printer: PythonPrinter) -> list[list[str]]:
    return [[f"{printer.text(value)} = 0" for value in one] for one in sets]


def _special(one: SpecialCase, shown: EquilibriaForms, printer: PythonPrinter) -> dict[str, Any]:
    """Parameters for which the equilibria are others, and what these are there, as `equilibria` has them."""
    where = {"where": plain_inequality(shown.comparison(one.factor, "="), printer)}
    if one.excluded:
        return {**where, "equilibria_except": _sets(shown.special_exceptions(one), printer)}
    if one.cases is None:
        return where
    equations = _sets(shown.special_cases(one), printer)
    needs = [plain_inequality(relation, printer) for relation in shown.special_needs(one)]
    exist = [*needs, *inequalities(shown, printer, one.exist)]
    return {**where, "equilibria": equations, **({"exist": exist} if exist else {})}
