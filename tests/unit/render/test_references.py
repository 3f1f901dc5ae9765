"""Numbers of equations: formulas and lists of equations are counted together."""

from __future__ import annotations

from dynsolve.document import Document, Equations, Fold, Formula, Reference, Text
from dynsolve.explain.step import Detail
from dynsolve.notation.printing import PLAIN
from dynsolve.notation.tree import Symbol, equation
from dynsolve.render import html, markdown, terminal
from dynsolve.render.line_breaking import numbered
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
    document = solution_document(solved("stanford-6"), Detail.FULL, stages=["vectorized"])
    for name in ("constants", "recurring", "christoffel"):
        assert name in numbered(document)
    assert "With (1) and (2):" in markdown.render(document)


REFERRED = Document((
    Fold("In brief", (Formula(ONE, label="first"),)),
    Fold("In full", (Formula(ONE, label="second"),)),
    Fold("In brief", (Formula(ONE, label="third"),)),
    Text(("It is the same", Reference(("third", "first", "nowhere"), " in "), ".")),
))  # fmt: skip


def test_results_are_referred_to_among_words() -> None:
    assert "It is the same in (1) and (3)." in markdown.render(REFERRED)
    assert "It is the same." in [
        line.text for line in terminal.render(REFERRED)
    ]  # where formulas have no numbers


def test_each_of_several_documents_on_a_page_refers_to_its_own_numbers() -> None:
    fewer = Document((REFERRED.blocks[0], *REFERRED.blocks[2:]))
    page = html.render_choice({"brief": fewer, "full": REFERRED}, PLAIN, "full")
    assert '<a href="#brief-eq-third">(2)</a>' in page and '<a href="#full-eq-third">(3)</a>' in page


def test_both_ways_and_the_summary_say_which_equations_they_speak_of() -> None:
    document = solution_document(solved("in3140-rp"), Detail.FULL)
    number, text = numbered(document), markdown.render(document)
    for one, other in (("D", "D_sum"), ("Cqd", "Cqd-rows"), ("Cqd-2", "g")):
        assert f" in ({number[one]}) and ({number[other]})" in text
    assert f"With the matrices of this robot, ({number['D']}), ({number['C']}) and ({number['g']}):" in text
    assert f"Row by row, ({number['tau1']}) and ({number['tau2']}):" in text


def test_the_summary_of_a_long_model_refers_to_its_matrices() -> None:
    document = solution_document(solved("stanford-6"), Detail.FULL)
    number, text = numbered(document), markdown.render(document)
    for id, before in (("D", "$"), ("christoffel", "symbols"), ("g", "$")):
        assert f"{before} ({number[id]})" in text.split("Summary")[-1]
    assert f"from the Christoffel symbols ({number['christoffel']}), $" in text  # no entry of C


def test_in_brief_the_summary_of_a_long_model_speaks_of_no_symbols_for_there_are_none() -> None:
    said = markdown.render(solution_document(solved("stanford-6"), Detail.BRIEF)).split("Summary")[-1]
    assert (
        "Christoffel" not in said and r"$\mathbf{C}$ follows from $\mathbf{D}$ as it is told there." in said
    )
