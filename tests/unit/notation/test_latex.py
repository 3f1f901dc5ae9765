"""LaTeX as the course's document writes it, MathML and Typst."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import pytest
from hypothesis import given

from dynsolve.notation.markup import MathMLPrinter, TypstPrinter, escaped, to_latex, to_mathml, to_typst
from dynsolve.notation.printing import Style
from dynsolve.notation.text import read
from dynsolve.notation.tree import (
    Arguments,
    BigSum,
    Cross,
    Degrees,
    Derivative,
    Function,
    Integral,
    Letter,
    Matrix,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Relation,
    Row,
    Slashed,
    Sum,
    Symbol,
    Transpose,
    Words,
    equation,
)
from tests.unit.notation.trees import trees

# -- laTeX, as the course's document writes it -------------------------------------------------------


COORDINATES = Style(shorthand={"theta1": "1", "theta2": "2", "q10": "10"})

TEXTS = [
    ("theta1", r"\theta_{1}"),
    ("theta1_dot", r"\dot{\theta}_{1}"),
    ("theta1_ddot^2", r"\ddot{\theta}_{1}^{2}"),
    ("Omega", r"\Omega"),
    ("I1zz", "I_{1,zz}"),
    ("lc1", r"l_{\mathrm{c}1}"),
    ("m_load", r"m_{\mathrm{load}}"),
    ("load1_dot", r"\dot{\mathrm{load}}_{1}"),
    ("J_omega1", r"J_{\omega 1}"),
    ("sin(theta1)^2", "s_{1}^{2}"),
    ("cos(theta1 + theta2)", "c_{12}"),
    ("cos(theta1 + q10)", "c_{1,10}"),
    ("sin(2*theta1)", r"\sin(2 \theta_{1})"),
    ("cos(2*theta1)^2", r"\cos^{2}(2 \theta_{1})"),
    ("sin(theta1/2)", r"\sin\left( \frac{\theta_{1}}{2} \right)"),
    ("sqrt(2)", r"\sqrt{2}"),
    ("sqrt(2)^2", r"(\sqrt{2})^{2}"),
    ("1/2*m1", r"\frac{1}{2} m_{1}"),
    ("m1*g*L1/2", r"\frac{m_{1} g L_{1}}{2}"),
    ("(a + b)/2", r"\frac{a + b}{2}"),
    ("a*(b + c)", "a (b + c)"),
    ("a*(b + c/2)", r"a \left( b + \frac{c}{2} \right)"),
    ("(a/b)^2", r"\left( \frac{a}{b} \right)^{2}"),
    ("2*3", r"2 \cdot 3"),
    ("2*(1/2)", r"2 \cdot \frac{1}{2}"),
    ("a*2", r"a \cdot 2"),
    ("a*(-b)", "a (-b)"),
    ("-a - b", "-a - b"),
    ("-(a + b)", "-(a + b)"),
    ("x^-2", "x^{-2}"),
    ("90deg", r"90^{\circ}"),
    ("9.81", r"\frac{981}{100}"),
]


@pytest.mark.parametrize(("text", "printed"), TEXTS, ids=[text for text, _ in TEXTS])
def test_formulas(text, printed):
    assert to_latex(read(text, dots=True).tree, COORDINATES) == printed


i, t = Letter("i"), Symbol("t")
LAGRANGIAN = Letter("L", style="script")
RATE = Derivative(LAGRANGIAN, Symbol("theta1", 1))
TEXTBOOK = [
    (Letter("J", sub=Letter("v", sub=Number(1)), style="bold"), r"\mathbf{J}_{v_{1}}"),
    (Letter("H", sub=Number(2), sup=Number(0), style="bold"), r"\mathbf{H}_{2}^{0}"),
    (Letter("omega", sub=i, style="bold"), r"\boldsymbol{\omega}_{i}"),
    (Letter("q", dots=1, style="bold"), r"\dot{\mathbf{q}}"),
    (Letter("I", sub=Number(1), style="bold script"), r"\boldsymbol{\mathcal{I}}_{1}"),
    (Letter("tr", style="upright"), r"\mathrm{tr}"),
    (Letter("r", sub=Row((Letter("c"), i))), "r_{c i}"),
    (Transpose(Letter("J", sub=i)), "J_{i}^{T}"),
    (Transpose(Letter("R", sub=Number(1), sup=Number(0))), "(R_{1}^{0})^{T}"),
    (Cross(Letter("z"), Parenthesized(Sum((Symbol("a"), Negative(Symbol("b")))))), r"z \times (a - b)"),
    (Slashed(RATE), r"\partial \mathcal{L}/\partial \dot{\theta}_{1}"),
    (Slashed(read("m1*(a + b)/(2*l1)").tree), r"m_{1} (a + b)/(2 l_{1})"),
    (Slashed(read("(a + b)/2").tree), r"(a + b)/2"),
    (RATE, r"\frac{\partial \mathcal{L}}{\partial \dot{\theta}_{1}}"),
    (
        Derivative(RATE, t, total=True),
        r"\frac{d}{dt} \left( \frac{\partial \mathcal{L}}{\partial \dot{\theta}_{1}} \right)",
    ),
    (Derivative(Symbol("x"), t, total=True), r"\frac{dx}{dt}"),
    (
        Integral(Product((Symbol("rho"), Symbol("x"))), Symbol("x"), Number(0), Symbol("l")),
        r"\int_{0}^{l} \rho x \, \mathrm{d} x",
    ),
    (BigSum(Product((Letter("m", i), Symbol("g"))), i, Number(1), Letter("n")), r"\sum_{i=1}^{n} m_{i} g"),
    (
        Matrix(((Number(1), Symbol("a")), (Number(0), Number(1)))),
        r"\begin{bmatrix} 1 & a \\ 0 & 1 \end{bmatrix}",
    ),
    (equation(Symbol("a"), Symbol("b")), "a = b"),
    (Relation((Symbol("a"), Symbol("b")), ("≈",)), r"a \approx b"),
    (Words(r"50% {a}_b \x"), r"\text{50\% \{a\}\_b \textbackslash{}x}"),
    (Degrees(100, 3), r"\left( \frac{100}{3} \right)^{\circ}"),
]


@pytest.mark.parametrize(("tree", "printed"), TEXTBOOK, ids=[printed for _, printed in TEXTBOOK])
def test_formulas_of_the_textbook(tree, printed):
    assert to_latex(tree, COORDINATES) == printed


def test_the_star_with_its_power():
    """As in equation (22) of the course's dynamics overview."""
    tree = Power(Symbol("L2", 1, star=True), Number(2))
    assert to_latex(tree, Style(star=True)) == r"\dot{L}_{2}^{\star 2}"
    assert to_latex(tree.base, Style(star=True)) == r"\dot{L}_{2}^{\star}"
    assert to_latex(tree) == r"\dot{L}_{2}^{2}"


def test_decimals_where_they_are_asked_for():
    assert to_latex(Number(981, 100), Style(decimal=True)) == "9.81"


@given(trees)
def test_any_tree_has_balanced_braces(tree):
    text = to_latex(tree, COORDINATES)
    assert text.count("{") == text.count("}")
    assert text.count("(") == text.count(")")
    assert text.count(r"\left") == text.count(r"\right")


def test_text_is_escaped():
    assert escaped("a&b#~^$") == r"a\&b\#\textasciitilde{}\textasciicircum{}\$"


# -- mathML and Typst: the same tree in two more notations -------------------------------------------


TREES: dict[str, Node] = {
    "sum": read("m1*g - m2*(a - b)^2/2 + sqrt(3)/2").tree,
    "leading minus": read("-a - b").tree,
    "function": read("sin(theta1)^2*cos(2*theta2 + theta3)").tree,
    "fraction": read("(a + b)/(c + d)").tree,
    "matrix": Matrix(((Symbol("a"), Number(1, 2)), (Symbol("theta1", 2), read("-x").tree))),
    "letter": Letter("J", Letter("v", Number(1)), Number(0), "bold", 1),
    "transpose": Transpose(Letter("omega", Number(1), style="bold")),
    "words": Words('if "a" & b < \\c'),
}


@pytest.mark.parametrize("name", TREES)
def test_mathml_is_well_formed_and_every_script_has_its_parts(name: str) -> None:
    root = ET.fromstring(f"<math>{to_mathml(TREES[name])}</math>")  # noqa: S314
    parts = {"msub": 2, "msup": 2, "msubsup": 3, "mfrac": 2, "mover": 2, "munderover": 3}
    for element in root.iter():
        if element.tag in parts:
            assert len(element) == parts[element.tag], ET.tostring(element)


@pytest.mark.parametrize(
    ("node", "mathml"),
    [
        (Symbol("theta1", 1), '<msub><mover accent="true"><mi>θ</mi><mo>˙</mo></mover><mn>1</mn></msub>'),
        (Power(Symbol("l1"), Number(2)), "<msubsup><mi>l</mi><mn>1</mn><mn>2</mn></msubsup>"),
        (Letter("D", style="bold"), '<mi mathvariant="normal" class="v">D</mi>'),
        (Words("<b>"), "<mtext>&lt;b&gt;</mtext>"),
        (
            Slashed(read("l1/2").tree),
            '<mrow><msub><mi>l</mi><mn>1</mn></msub><mo form="infix" lspace="0" rspace="0">/</mo>'
            "<mn>2</mn></mrow>",
        ),
    ],
)
def test_mathml(node: Node, mathml: str) -> None:
    assert to_mathml(node) == mathml


def test_a_minus_between_terms_is_not_the_one_before_a_term() -> None:
    assert to_mathml(read("a - b").tree) == "<mi>a</mi><mo>−</mo><mi>b</mi>"
    assert to_mathml(read("-b").tree).startswith('<mo form="prefix">')


def test_a_minus_behind_words_is_that_of_a_negative() -> None:
    either = Row((Symbol("a"), Words(" or "), Negative(Symbol("b"))))
    assert to_latex(either) == r"a \text{ or } {-b}"
    assert to_typst(either) == 'a" or "class("unary", -) b'


def test_shorthands_and_stars() -> None:
    style = Style(shorthand={"theta1": "1", "theta2": "2"}, stars=frozenset({"d3"}))
    both = read("cos(theta1 + theta2)*d3^2").tree
    assert MathMLPrinter(style).text(both) == (
        "<msub><mi>c</mi><mn>12</mn></msub>"
        "<msubsup><mi>d</mi><mn>3</mn><mrow><mo>⋆</mo><mn>2</mn></mrow></msubsup>"
    )
    assert TypstPrinter(style).text(both) == "c_(12) d_(3)^(star.op 2)"


@pytest.mark.parametrize(
    ("node", "typst"),
    [
        (read("m1*(a + b)/2").tree, r"frac(m_(1) \( a + b \), 2)"),
        (read("m1*(a/2 + b)").tree, "m_(1) (frac(a, 2) + b)"),
        (TREES["matrix"], "mat(a, frac(1, 2); accent(θ, dot.double)_(1), -x)"),
        (Letter("H", Number(2), Number(0), "bold"), "upright(bold(H))_(2)^(0)"),
        (Words('a "b" \\c'), '"a \\"b\\" \\\\c"'),
        (Symbol("I1zz"), r"I_(1 \, z z)"),
        (Function("atan2", Arguments((Symbol("x"), read("-y").tree))), r'op("atan2") \( x\, -y \)'),
    ],
)
def test_typst(node: Node, typst: str) -> None:
    assert to_typst(node) == typst


@pytest.mark.parametrize("name", TREES)
def test_typst_compiles(name: str) -> None:
    typst = pytest.importorskip("typst", reason="the extra pdf is not installed")
    source = f"$ {to_typst(TREES[name])} $".encode()
    assert typst.compile(source, format="pdf", ignore_system_fonts=True)[:5] == b"%PDF-"
