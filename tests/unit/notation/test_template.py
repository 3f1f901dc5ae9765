"""Formulas that are written as they are printed are printed as they are written."""

from __future__ import annotations

import pytest

from dynsolve.notation.markup import to_latex
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    Cross,
    Derivative,
    Letter,
    Number,
    Parenthesized,
    Row,
    Sum,
    Symbol,
    Transpose,
    Words,
)
from dynsolve.notation.unicode import to_unicode

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
