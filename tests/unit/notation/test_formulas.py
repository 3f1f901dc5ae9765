"""What the printers of whole formulas share, and formulas that are written as they are printed."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from dynsolve.notation.formulas import FormulaPrinter
from dynsolve.notation.markup import LatexPrinter, MathMLPrinter, TypstPrinter, to_latex
from dynsolve.notation.python import PythonPrinter
from dynsolve.notation.template import formula
from dynsolve.notation.text import read
from dynsolve.notation.tree import (
    Cross,
    Derivative,
    Function,
    Letter,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Row,
    Sum,
    Symbol,
    Transpose,
    Words,
)
from dynsolve.notation.unicode import UnicodePrinter, to_unicode
from tests.unit.notation.trees import ONE_OF_EACH

# -- what the printers of whole formulas share, and what a notation of its own needs -----------------


PRINTERS = [LatexPrinter, MathMLPrinter, TypstPrinter, UnicodePrinter]


@pytest.mark.parametrize("printer", PRINTERS)
@pytest.mark.parametrize("node", [node for node, _ in ONE_OF_EACH], ids=lambda node: type(node).__name__)
def test_every_notation_of_formulas_writes_every_node(printer: type[FormulaPrinter], node: Node) -> None:
    assert printer().text(node)


def test_a_node_that_a_notation_has_no_words_for_is_refused() -> None:
    with pytest.raises(TypeError, match="Words cannot be written in Python"):
        PythonPrinter().text(Words("and"))


class _Spoken(FormulaPrinter):
    """Formulas as they are read aloud."""

    notation = "words"
    minus = "minus "
    signs = (" plus ", " minus ")
    dot = "times "
    transposition = "transposed"

    def _base(self, base: str) -> str:
        return base

    def _styled(self, base: str, style: str) -> str:
        return base

    def _dotted(self, base: str, dots: int) -> str:
        return base + " dot" * dots

    def _indices(self, groups: Sequence[str]) -> str:
        return " ".join(groups)

    def _scripted(self, base: str, sub: str, sup: str) -> str:
        return " ".join(filter(None, (base, sub, sup and f"to the {sup}")))

    def _fraction(self, above: str, below: str) -> str:
        return f"{above} over {below}"

    def _root(self, argument: Node) -> str:
        return f"root of {self.text(argument)}"

    def _applied(self, name: str, argument: str, exponent: str = "") -> str:
        return f"{self._scripted(name, '', exponent)} of {argument}"


@pytest.mark.parametrize(
    ("formula", "spoken"),
    [
        (read("m1*g - lc2/2 + sqrt(a)").tree, "m 1 g minus l c2 over 2 plus root of a"),
        (read("2*3*sin(q1)^2").tree, "2 times 3 sin to the 2 of q 1"),
        (Power(Symbol("theta1", 1), Number(2)), "theta dot 1 to the 2"),
        (Product((Transpose(Letter("J")), Function("cos", Symbol("x")))), "J to the transposed cos of x"),
    ],
)  # fmt: skip
def test_a_notation_says_only_how_it_writes(formula: Node, spoken: str) -> None:
    assert _Spoken().text(formula) == spoken


# -- formulas that are written as they are printed are printed as they are written -------------------


PRINTED = {
    "𝐃 = Σ_(i=1)^n (m_i 𝐉_v_iᵀ 𝐉_v_i)": "D = Σᵢ₌₁ⁿ (mᵢ J_viᵀ J_vi)",
    "d_ij = ∂τ_i/∂q̈_j": "dᵢⱼ = ∂τᵢ/∂q̈ⱼ",
    "𝐳_(i-1) × (𝐨_n - 𝐨_(i-1))": "zᵢ₋₁ × (oₙ - oᵢ₋₁)",
    "ℒ = 𝒦 - 𝒫": "ℒ = 𝒦 - 𝒫",
    "d/dt ∂ℒ/∂q̇_k - ∂ℒ/∂q_k = τ_k": "d/dt (∂ℒ/∂q̇ₖ) - ∂ℒ/∂qₖ = τₖ",
    "[𝐳 × (a - b); 𝐳]": "[[z × (a - b)], [z]]",
    "det 𝐉_r = 0": "det J_r = 0",
    "𝐫(𝐪)": "r(q)",
    "½ 𝐪̇ᵀ 𝐃 𝐪̇": "½ q̇ᵀ D q̇",
    "sin²(θ) + cos²(θ) = 1": "sin²(θ) + cos²(θ) = 1",
    "d_(12,3)": "d_{12,3}",
    "τ_static": "τ_static",
    "a, b": "a, b",
    "'the rank' < 3": "the rank < 3",
}


@pytest.mark.parametrize("text", PRINTED)
def test_formulas_are_printed_as_they_are_written(text: str) -> None:
    assert to_unicode(formula(text)) == PRINTED[text]


def test_letters_have_their_styles_and_indices() -> None:
    assert formula("𝓘_2") == Letter("I", Number(2), None, "bold script")
    assert formula("𝐫_c1") == Letter("r", Row((Words("c"), Number(1))), None, "bold")
    assert formula("𝐉_v_i") == Letter("J", Letter("v", Symbol("i")), None, "bold")
    assert formula("q̈") == Symbol("q", 2)
    assert to_latex(formula("τ_f2")) == r"\tau_{\text{f} 2}"


def test_values_are_put_in() -> None:
    tree = formula("{x}ᵀ × m_{k} - {less}", x=Symbol("y"), k=2, less="more")
    left = Cross(Transpose(Symbol("y")), Letter("m", Number(2)))
    assert isinstance(tree, Sum)
    assert tree.terms[0] == left
    assert to_unicode(tree.terms[1]) == "-more"


def test_brackets_and_derivatives_are_what_is_written() -> None:
    assert formula("(a)") == Parenthesized(Symbol("a"))
    assert formula("d/dt 𝐪") == Derivative(Letter("q", style="bold"), Symbol("t"), total=True)


@pytest.mark.parametrize("text", ["", "a +", "(a", "a)", "= b", "q_"])
def test_what_is_no_formula_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match=r"expected|begins"):
        formula(text)
