"""Numbers of equations: formulas and lists of equations are counted together."""

from __future__ import annotations

from dynsolve.document import Document, Equations, Fold, Formula
from dynsolve.notation.tree import Symbol, equation
from dynsolve.render import markdown
from dynsolve.render.references import numbered
from dynsolve.solution.documents import solution_document
from tests.support import solved

ONE = equation(Symbol("a"), Symbol("b"))
LIST = Document((
    Formula(ONE, label="first"),
    Fold("A list", (Equations((ONE, ONE), label="list"),)),
    Equations((ONE,)),
    Formula(ONE, label="last"),
))  # fmt: skip


def test_a_list_of_equations_has_one_number() -> None:
    assert numbered(LIST) == {"first": 1, "list": 2, "last": 3}
    assert [markdown.render(LIST).count(rf"\tag{{{n}}}") for n in (1, 2, 3, 4)] == [1, 1, 1, 0]


def test_the_lists_of_a_long_model_are_referred_to() -> None:
    text = markdown.render(solution_document(solved("stanford-6"), stages=["vectorized"]))
    for name in ("constants", "recurring", "christoffel"):
        assert name in numbered(solution_document(solved("stanford-6"), stages=["vectorized"]))
    assert "With (1) and (2):" in text
