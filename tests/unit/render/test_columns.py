"""Which equations stand in columns."""

from __future__ import annotations

import pytest

from dynsolve.document import Document, Equations
from dynsolve.notation.text import read
from dynsolve.notation.tree import Letter, Number, Symbol, equation
from dynsolve.render.latex import render
from dynsolve.render.typesetting import Line, in_columns

LONG = "m1*l1^2 + m2*l2^2 + m3*l3^2 + I1 + I2 + I3"


@pytest.mark.parametrize(
    ("count", "right", "allowed", "columns"),
    [
        (8, "a + b", False, True),
        (3, "a + b", False, True),
        (2, "a + b", False, False),
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


def test_what_leads_from_line_to_line_is_in_one_column() -> None:
    """P = m g h, h = l s, P = m g l s for one body after the other."""
    lefts = [Letter(name, Number(i)) for i in range(1, 4) for name in ("P", "eta", "P")]
    for own, cells in ((lefts, 0), ([Letter("P", Number(i)) for i in range(9)], 9)):
        source = render(Document((Equations(tuple(equation(left, Number(1)) for left in own)),)))
        assert source.partition(r"\begin{document}")[2].count(r"\equationcell") == cells


@pytest.mark.parametrize(
    ("widths", "room", "indent"),
    [
        ((8,), 10, 0.1),
        ((8, 6), 10, 0.1),
        ((3, 3, 3), 15, 1 / 15),
        ((10,), 10, 0.0),
        ((12,), 10, 0.0),
    ],
)
def test_the_row_that_reaches_furthest_stands_in_the_middle(
    widths: tuple[float, ...], room: float, indent: float
) -> None:
    columns = in_columns([[Line("", "a", width=width)] for width in widths], room)
    assert columns.indent == pytest.approx(indent)
    for row in columns.rows:
        shares = sum(columns.share(row, place) for place in range(len(row)))
        assert columns.indent + shares <= 1 + 1e-12
