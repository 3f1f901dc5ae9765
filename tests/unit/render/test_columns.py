"""Which equations stand in columns."""

from __future__ import annotations

import pytest

from dynsolve.document import Document, Equations
from dynsolve.notation.text import read
from dynsolve.notation.tree import Symbol, equation
from dynsolve.render.latex import render

LONG = "m1*l1^2 + m2*l2^2 + m3*l3^2 + I1 + I2 + I3"


@pytest.mark.parametrize(
    ("count", "right", "allowed", "columns"),
    [
        (8, "a + b", False, True),
        (5, "a + b", False, False),
        (8, LONG, False, False),
        (8, LONG, True, False),
        (20, LONG, True, True),
    ],
)
def test_equations_in_columns(count: int, right: str, allowed: bool, columns: bool) -> None:
    nodes = tuple(equation(Symbol(f"c{k}"), read(right).tree) for k in range(count))
    source = render(Document((Equations(nodes, in_columns=allowed),)))
    _, body = source.split(r"\begin{document}")
    assert body.count(r"\equationcell") == (count if columns else 0)
