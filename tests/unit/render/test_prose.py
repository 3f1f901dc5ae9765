"""Words in every notation: what is seen, and nothing that is obeyed."""

from __future__ import annotations

import pytest

from dynsolve.notation.markup import LatexPrinter
from dynsolve.notation.tree import Node
from dynsolve.notation.unicode import to_unicode
from dynsolve.render.latex import latex_text
from dynsolve.render.markdown import escaped
from dynsolve.render.prose import visible, with_formulas


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
