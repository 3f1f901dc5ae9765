"""Which blocks stay on one page, and what closes a document."""

from __future__ import annotations

from dynsolve.document import Block, Formula, Heading, Note, Table, Text
from dynsolve.notation.text import read
from dynsolve.notation.tree import Letter, Matrix, Number, Symbol, equation
from dynsolve.render.page import before_closing, closing, introduces

MATRIX = Formula(equation(Letter("A"), Matrix(((Number(1),), (Number(0),)))))
SHORT = Formula(equation(Symbol("h1"), read("l1").tree))
RESULT = Formula(SHORT.node, label="h")
LAW = Formula(SHORT.node, source="§7.3")
TABLE = Table(("a",), (("b",),))


def test_what_stays_with_the_block_after_it() -> None:
    cases: list[tuple[Block, Block, bool]] = [
        (SHORT, RESULT, True),
        (SHORT, SHORT, False),
        (LAW, SHORT, True),
        (LAW, Text(("Of this arm:",)), False),
        (SHORT, MATRIX, False),
        (MATRIX, SHORT, False),
        (RESULT, SHORT, False),
        (RESULT, Note(("It holds.",)), True),
        (TABLE, Note(("It holds.",)), True),
        (Text(("A table.",)), TABLE, True),
        (Text(("A word and another. " * 30,)), TABLE, False),
        (Text(("A word and another. " * 30,)), MATRIX, True),
    ]
    assert [introduces(block, after) for block, after, _ in cases] == [stays for *_, stays in cases]


def test_what_closes_a_document_begins_with_its_heading() -> None:
    blocks = [Heading("Model"), RESULT, Heading("Summary", closing=True), MATRIX, Heading("Verification")]
    assert before_closing(blocks) == (blocks[:2], blocks[2:])
    assert before_closing(blocks[:2]) == (blocks[:2], [])


def test_matrices_are_not_drawn_onto_a_last_page_that_has_rows_enough() -> None:
    words: list[Block] = [Text((f"Row {k}.",)) for k in range(6)]
    assert closing([MATRIX, *words], lambda block: 1) == tuple(words)
    assert closing([MATRIX, *words[:4]], lambda block: 1) == (MATRIX, *words[:4])
    assert closing([SHORT, *words], lambda block: 1) == (SHORT, *words)
