"""The notation tree: a formula as it is written, neither more nor less.

A tree says what stands on paper, in that order: nothing in it is ever evaluated,
re-ordered or simplified.  Readers make trees from text, `algebra.compact` makes
them from exact values, printers turn them into Unicode, LaTeX or Python text.

The first part is what an expression is made of; the second part (from `Letter`
on) occurs only in the formulas that explain a step.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction


class Node:
    """A formula or a part of one."""

    __slots__ = ()


@dataclass(frozen=True, slots=True)
class Number(Node):
    """An exact rational p/q; negative numbers are written `Negative(Number(...))`."""

    p: int
    q: int = 1


@dataclass(frozen=True, slots=True)
class Degrees(Node):
    """An angle in degrees, p/q°."""

    p: int
    q: int = 1


@dataclass(frozen=True, slots=True)
class Symbol(Node):
    """A named quantity; `dots` time derivatives of it; `star` marks a joint variable."""

    name: str
    dots: int = 0
    star: bool = False


@dataclass(frozen=True, slots=True)
class Sum(Node):
    """t₁ + t₂ + ...; a `Negative` term is printed with a minus."""

    terms: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class Product(Node):
    """f₁ f₂ ..."""

    factors: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class Quotient(Node):
    """numerator / denominator"""

    numerator: Node
    denominator: Node


@dataclass(frozen=True, slots=True)
class Power(Node):
    """base^exponent"""

    base: Node
    exponent: Node


@dataclass(frozen=True, slots=True)
class Negative(Node):
    """-argument"""

    argument: Node


@dataclass(frozen=True, slots=True)
class Function(Node):
    """sin, cos, tan or sqrt of an argument."""

    name: str
    argument: Node


@dataclass(frozen=True, slots=True)
class Matrix(Node):
    """Rows of entries, all rows of one length."""

    rows: tuple[tuple[Node, ...], ...]


@dataclass(frozen=True, slots=True)
class Letter(Node):
    """A symbol of the textbook with its indices: **J**_{v_1}, H_2^0, 𝓘_1.

    `base` is one letter, a Greek name or a short word; `style` is `italic`,
    `bold` (vectors and matrices), `script` or `upright`; `sub` and `sup` are
    nodes; `dots` is the number of dots over it.
    """

    base: str
    sub: Node | None = None
    sup: Node | None = None
    style: str = "italic"
    dots: int = 0


@dataclass(frozen=True, slots=True)
class Row(Node):
    """Nodes side by side with nothing between them: a subscript `v_1 i`, a list with commas."""

    parts: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class Words(Node):
    """Upright words inside a formula."""

    text: str


@dataclass(frozen=True, slots=True)
class Transpose(Node):
    """argumentᵀ"""

    argument: Node


@dataclass(frozen=True, slots=True)
class Cross(Node):
    """left × right"""

    left: Node
    right: Node


@dataclass(frozen=True, slots=True)
class Derivative(Node):
    """∂of/∂by, or d of/d by where `total`; `of` None gives the bare operator."""

    of: Node | None
    by: Node
    total: bool = False


@dataclass(frozen=True, slots=True)
class BigSum(Node):
    """Σ_{index=lower}^{upper} body"""

    body: Node
    index: Node
    lower: Node
    upper: Node


@dataclass(frozen=True, slots=True)
class Parenthesized(Node):
    """(argument), where the parentheses are wanted though no rule of precedence asks for them."""

    argument: Node


@dataclass(frozen=True, slots=True)
class Relation(Node):
    """part₁ sign₁ part₂ sign₂ ...: an equation or a chain of them."""

    parts: tuple[Node, ...]
    signs: tuple[str, ...] = ("=",)


ZERO = Number(0)
ONE = Number(1)


def number(value: int | Fraction) -> Node:
    """The tree of a rational number, its sign outside."""
    value = Fraction(value)
    node = Number(abs(value.numerator), value.denominator)
    return Negative(node) if value < 0 else node


def equation(*parts: Node) -> Relation:
    """part₁ = part₂ = ..."""
    return Relation(parts, ("=",) * (len(parts) - 1))


def column(*entries: Node) -> Matrix:
    """A column vector."""
    return Matrix(tuple((entry,) for entry in entries))
