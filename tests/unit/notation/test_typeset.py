"""MathML and Typst: the same tree in two more notations."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import pytest

from dynsolve.notation.markup import MathMLPrinter, TypstPrinter, to_latex, to_mathml, to_typst
from dynsolve.notation.printing import Style
from dynsolve.notation.text import read
from dynsolve.notation.tree import (
    Arguments,
    Function,
    Letter,
    Matrix,
    Negative,
    Node,
    Number,
    Power,
    Row,
    Slashed,
    Symbol,
    Transpose,
    Words,
)

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
