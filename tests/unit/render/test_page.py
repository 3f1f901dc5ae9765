"""Pages in every format: their ends, references, and formulas in prose."""

from __future__ import annotations

import pytest

from dynsolve.document import Block, Document, Equations, Fold, Formula, Heading, Note, Reference, Table, Text
from dynsolve.explain.step import Detail
from dynsolve.notation.markup import LatexPrinter
from dynsolve.notation.printing import PLAIN
from dynsolve.notation.text import read
from dynsolve.notation.tree import Letter, Matrix, Node, Number, Symbol, equation
from dynsolve.notation.unicode import to_unicode
from dynsolve.render import html, markdown, terminal
from dynsolve.render.latex import latex_text
from dynsolve.render.line_breaking import numbered
from dynsolve.render.markdown import escaped
from dynsolve.render.page import before_closing, closing, introduces, runs_of_equations
from dynsolve.render.prose import visible, with_formulas
from dynsolve.render.typst import to_typst_document
from dynsolve.solution.documents import solution_document
from tests.support import document, solved

# -- which blocks stay on one page, and what closes a document ---------------------------------------


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


# -- numbers of equations: formulas and lists of equations are counted together ----------------------


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
    page = solution_document(solved("stanford-6"), Detail.FULL, stages=["vectorized"])
    for name in ("constants", "recurring", "christoffel"):
        assert name in numbered(page)
    assert "With (1) and (2):" in markdown.render(page)


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
    page = document("in3140-rp")
    number, text = numbered(page), markdown.render(page)
    for one, other in (("D", "D_sum"), ("Cqd", "Cqd-rows"), ("Cqd-2", "g")):
        assert f" in ({number[one]}) and ({number[other]})" in text
    assert f"With the matrices of the arm, ({number['D']}) and ({number['C']}) and $" in text
    assert f"Row by row, ({number['tau1']}) and ({number['tau2']}):" in text


def test_the_summary_of_a_long_model_refers_to_its_matrices() -> None:
    page = document("stanford-6")
    number, text = numbered(page), markdown.render(page)
    for id, before in (("D", "$"), ("christoffel", "symbols"), ("g", "$")):
        assert f"{before} ({number[id]})" in text.split("Summary")[-1]
    assert f"from the Christoffel symbols ({number['christoffel']}), $" in text  # no entry of C


def test_in_brief_the_summary_of_a_long_model_speaks_of_no_symbols_for_there_are_none() -> None:
    said = markdown.render(document("stanford-6", Detail.BRIEF)).split("Summary")[-1]
    assert (
        "Christoffel" not in said and r"$\mathbf{C}$ follows from $\mathbf{D}$ as it is told there." in said
    )


# -- words in every notation: what is seen, and nothing that is obeyed -------------------------------


def shown(text: str) -> list[str]:
    printer = LatexPrinter()
    return [f"${printer.text(p)}$" if isinstance(p, Node) else p for p in with_formulas(text)]


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("Row 1 of the table: A₁", ["Row 1 of the table: ", r"$\mathbf{A}_{1}$"]),
        ("turn by θ about", ["turn by ", r"$\theta$", " about"]),
        ("D, C q̇, g: equal", ["D, C ", r"$\dot{\mathbf{q}}$", ", g: equal"]),
        ("Ḋ - 2C", [r"$\dot{\mathbf{D}}$", " - 2C"]),
        ("H₂⁰", [r"$\mathbf{H}_{2}^{0}$"]),
        ("from frame i-1 to frame i", ["from frame ", "$i - 1$", " to frame ", "$i$"]),
        ("joint 1 is in row n.", ["joint 1 is in row ", "$n$", "."]),
        ("Joint i moves", ["Joint ", "$i$", " moves"]),
        ("axis zᵢ₋₁", ["axis ", "$z_{i - 1}$"]),
        ("column index, link joint", ["column index, link joint"]),
        ("its axes x and z", ["its axes ", "$x$", " and ", "$z$"]),
        ("the x-axis (y).", ["the ", "$x$", "-axis (y)."]),
        ("z: z is a letter of the derivation", ["z: z is a letter of the derivation"]),
        ("x.yaml, xs, x=1", ["x.yaml, xs, x=1"]),
        (
            "inertia in kg m², gravity in m/s²",
            ["inertia in kg ", r"$\mathrm{m}^{2}$", ", gravity in m/", r"$\mathrm{s}^{2}$"],
        ),
        ("with m² and s²", ["with ", "$m^{2}$", " and ", "$s^{2}$"]),
        ("Überarm naïve I a", ["Überarm naïve I a"]),
    ],
)
def test_mathematics_among_words(text: str, parts: list[str]) -> None:
    assert shown(text) == parts


@pytest.mark.parametrize(
    ("text", "seen"),
    [("a\u202eb", "ab"), ("a\u200fb", "ab"), ("a\tb\x07", "a b "), ("o\u0308", "ö"), ("a\ue000", "a\ufffd")],
)
def test_what_cannot_be_seen_is_left_out(text: str, seen: str) -> None:
    assert visible(text) == seen


@pytest.mark.parametrize(
    ("text", "latex"),
    [
        (r"\input{x}", r"\textbackslash{}input\{x\}"),
        ("50% & #1_2 $x$ ~^", r"50\% \& \#1\_2 \$x\$ \textasciitilde{}\textasciicircum{}"),
        ("<script>", r"\textless{}script\textgreater{}"),
        ("a---b", "a-{}-{}-b"),
        ("é ñ Č ø", r"\'{e} \~{n} \v{C} \o{}"),
        ("θ ≤ 90°", r"$\theta$ $\leq$ 90$^\circ$"),
        ("中", "{[}U+4E2D{]}"),
    ],
)
def test_any_text_as_latex(text: str, latex: str) -> None:
    assert latex_text(text) == latex


@pytest.mark.parametrize(
    ("text", "markdown"),
    [
        ("*a* _b_ `c`", r"\*a\* \_b\_ \`c\`"),
        ("[x](javascript:y)", r"\[x\](javascript:y)"),
        ("$1 | $2", "&#36;1 &#124; &#36;2"),
        ("# not a heading", r"\# not a heading"),
    ],
)
def test_any_text_as_markdown(text: str, markdown: str) -> None:
    assert escaped(text) == markdown


@pytest.mark.parametrize(
    ("words", "formulas"),
    [
        ("has cos(2θ₁) where 1 belongs", ["cos(2θ₁)"]),
        ("it is 2L₂L̇₂, not 2L̇₂²", ["2L₂ L̇₂", "2L̇₂²"]),
        ("0 and 2m₂L₂θ̇₁ in a 2D plot of 3 kg", ["2m₂ L₂ θ̇₁"]),
        ("along its axes x, y and z; Spong writes c", ["x", "y", "z", "c"]),
    ],
)
def test_products_and_named_letters_in_words_are_formulas(words: str, formulas: list[str]) -> None:
    assert [to_unicode(part) for part in with_formulas(words) if not isinstance(part, str)] == formulas


def test_lines_with_fractions_are_kept_apart_in_a_pdf() -> None:
    """The denominator of one would touch the numerator of the next."""
    lines = [equation(Symbol(name), read("q/3").tree) for name in "abc"]
    text = to_typst_document(Document((Equations((SHORT.node, *lines)),)))
    assert text.count("pad(y: 0.0em") == text.count("pad(y: 0.15em") == 2


def test_a_last_formula_with_a_matrix_may_begin_a_page_in_a_pdf() -> None:
    """Kept with the formula before it, it left a third of the page before empty."""
    tall = Formula(equation(Letter("A"), Matrix(((Number(1),),) * 4)), label="A")
    step = Fold("", (Text(("So.",)), RESULT, tall))
    shown = to_typst_document(Document((step, *[MATRIX] * 9))).splitlines()
    first, last, *_ = (line for line in shown if line.startswith("#formula"))
    assert "eq-h" in first and "sticky: true" not in first
    assert "eq-A" in last


def test_a_page_may_end_between_two_rows_of_matrices() -> None:
    assert runs_of_equations([True, False, False], tall=[False, True, True]) == (2, 1)
    assert runs_of_equations([True, False, False]) == (3,)
    assert runs_of_equations([True] * 4, tall=[True] * 4) == (1, 1, 1, 1), "equations so high stand alone"
