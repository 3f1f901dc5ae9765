"""Where equilibria are, and how stable, as data beside the equilibria themselves."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from dynsolve.algebra.inequality import Bound
from dynsolve.derivation.equilibria import Equilibria, SpecialCase
from dynsolve.derivation.stability import Point, Values
from dynsolve.explain.inverse_formulas import ConfigurationForms
from dynsolve.notation.python import PythonPrinter
from dynsolve.solution.verdict_export import plain_inequality

QUARTERS = {(0, 1): "0", (1, 0): "pi/2", (0, -1): "pi", (-1, 0): "-pi/2"}
"""Quarter turns by their sine and cosine."""


def beside_equilibria(shown: ConfigurationForms, printer: PythonPrinter) -> Iterator[tuple[str, Any]]:
    """`equilibria_stability`, and for which parameters the equilibria are there, or are others."""
    found: Equilibria = shown.values["equilibria"]

    def written(bounds: Sequence[Bound]) -> list[str]:
        return inequalities(shown, printer, bounds)

    def told(point: Point) -> dict[str, Any]:
        conditions = {"stable_if": written(point.conditions)} if point.conditions else {}
        if point.falls:
            conditions["unstable_if"] = written([Bound(-bound.value) for bound in point.conditions])
        return {**angles(point.values), "stability": point.stability.value, **conditions}

    yield "equilibria_stability", [[told(point) for point in points] for points in found.points]
    yield from existence("equilibria", shown, printer, found.exist)
    if found.special:
        yield "equilibria_special", [_special(one, shown, printer) for one in found.special]
    if found.may_be_others:
        yield "equilibria_general", True


def _special(one: SpecialCase, shown: ConfigurationForms, printer: PythonPrinter) -> dict[str, Any]:
    """Parameters for which the equilibria are others, and what these are there, as `equilibria` has them."""
    forces = shown.special_forces(one)
    equations = [] if forces is None else [[f"{printer.text(force)} = 0" for force in forces]]
    return {
        "where": plain_inequality(shown.comparison(one.factor, "="), printer),
        "equilibria": equations,
    }


def existence(
    name: str, shown: ConfigurationForms, printer: PythonPrinter, exist: Sequence[Sequence[Bound]]
) -> Iterator[tuple[str, list[list[str]]]]:
    """Beside a set of alternatives the inequalities under which each is there, if any is not always."""
    if any(exist):
        yield f"{name}_exist", [inequalities(shown, printer, bounds) for bounds in exist]


def inequalities(shown: ConfigurationForms, printer: PythonPrinter, bounds: Sequence[Bound]) -> list[str]:
    """Inequalities as text."""
    return [plain_inequality(shown.inequality(bound), printer) for bound in bounds]


def angles(values: Values) -> dict[str, str]:
    """Quarter turns by the names of the coordinates."""
    return {pair.angle.terms[0][0][0][0]: QUARTERS[sine, cosine] for pair, sine, cosine in values}
