"""What the printers of whole formulas share, and what a notation of its own needs."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from dynsolve.notation.formulas import FormulaPrinter
from dynsolve.notation.markup import LatexPrinter, MathMLPrinter, TypstPrinter
from dynsolve.notation.python import PythonPrinter
from dynsolve.notation.text import read
from dynsolve.notation.tree import Function, Letter, Node, Number, Power, Product, Symbol, Transpose, Words
from dynsolve.notation.unicode import UnicodePrinter
from tests.unit.notation.trees import ONE_OF_EACH

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
