"""The stability of equilibria as data, beside the equilibria themselves."""

from __future__ import annotations

from dynsolve.derivation.equilibria import Equilibria, Values

QUARTERS = {(0, 1): "0", (1, 0): "pi/2", (0, -1): "pi", (-1, 0): "-pi/2"}
"""Quarter turns by their sine and cosine."""


def stability(found: Equilibria) -> list[list[dict[str, str]]]:
    """For each alternative its points: the angles that are fixed, and `stability` there."""
    return [
        [{**angles(point.values), "stability": point.stability.value} for point in points]
        for points in found.points
    ]


def angles(values: Values) -> dict[str, str]:
    """Quarter turns by the names of the coordinates."""
    return {pair.angle.terms[0][0][0][0]: QUARTERS[sine, cosine] for pair, sine, cosine in values}
