"""The notation tree: a formula as it is written, neither more nor less.

A tree says what stands on paper, in that order: nothing in it is ever evaluated,
re-ordered or simplified.  Readers make trees from text, `algebra.compact` makes
them from exact values, printers turn them into Unicode, LaTeX or Python text.

The first part is what an expression is made of; the second part (from `Letter`
on) occurs only in the formulas that explain a step.

To add a node, add its class here and a method for it to each printer that writes it.  A
field that holds parts is annotated `Node`, `Node | None`, `tuple[Node, ...]` or
`tuple[tuple[Node, ...], ...]`: from that `notation.walk` knows how to visit and rebuild it.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any, ClassVar, TypeVar, dataclass_transform


class Node:
    """A formula or a part of one; trees share parts, so each part is hashed once."""

    __slots__ = ("_hash",)
    __dataclass_fields__: ClassVar[dict[str, Any]]
    _hash: int

    def __hash__(self) -> int:
        try:
            return self._hash
        except AttributeError:
            found = hash((type(self), *(getattr(self, name) for name in self.__dataclass_fields__)))
            object.__setattr__(self, "_hash", found)
            return found

    def __str__(self) -> str:
        """Nothing: a formula among words stands there as itself, and a printer of the page's writes it."""
        raise TypeError(f"{type(self).__name__} has no text of its own: a printer writes it")


_T = TypeVar("_T")


@dataclass_transform(frozen_default=True)
def node_class(cls: type[_T]) -> type[_T]:
    """Make a class of nodes: a frozen dataclass that keeps the hash of `Node`."""
    cls.__hash__ = Node.__hash__  # type: ignore[assignment]
    return dataclass(frozen=True, slots=True)(cls)


@node_class
class Number(Node):
    """An exact rational p/q; negative numbers are written `Negative(Number(...))`.

    `decimal` asks for a decimal point, whatever the style of the formula.
    """

    p: int
    q: int = 1
    decimal: bool = False


@node_class
class Degrees(Node):
    """An angle in degrees, p/q°."""

    p: int
    q: int = 1


@node_class
class Symbol(Node):
    """A named quantity; `dots` time derivatives of it; `star` marks a joint variable."""

    name: str
    dots: int = 0
    star: bool = False


@node_class
class Reference(Node):
    """A quantity of the derivation that stands in a formula by its name, K1, or an entry of it (from 1).

    >>> str(Reference("K1")), str(Reference("I1", 1, 3))
    ('K1', 'I1[1,3]')
    """

    quantity: str
    row: int | None = None
    column: int | None = None

    def __str__(self) -> str:
        return self.quantity if self.row is None else f"{self.quantity}[{self.row},{self.column}]"


@node_class
class Sum(Node):
    """t₁ + t₂ + ...; a `Negative` term is printed with a minus."""

    terms: tuple[Node, ...]


@node_class
class Product(Node):
    """f₁ f₂ ..."""

    factors: tuple[Node, ...]


@node_class
class Quotient(Node):
    """numerator / denominator"""

    numerator: Node
    denominator: Node


@node_class
class Power(Node):
    """base^exponent"""

    base: Node
    exponent: Node


@node_class
class Negative(Node):
    """-argument"""

    argument: Node


@node_class
class Function(Node):
    """sin, cos, tan, sqrt, sgn, acos, asin, atan of an argument; atan2 of `Arguments` (y, x)."""

    name: str
    argument: Node


@node_class
class Arguments(Node):
    """Several arguments of a function."""

    parts: tuple[Node, ...]


@node_class
class Matrix(Node):
    """Rows of entries, all rows of one length."""

    rows: tuple[tuple[Node, ...], ...]


@node_class
class Letter(Node):
    """A symbol of the textbook with its indices: **J**_{v_1}, H_2^0, 𝓘_1.

    `base` is one letter, a Greek name or a short word; `style` is `italic`,
    `bold` (vectors and matrices), `script`, `bold script` (the tensor 𝓘, a matrix) or
    `upright`; `sub` and `sup` are nodes; `dots` is the number of dots over it.
    """

    base: str
    sub: Node | None = None
    sup: Node | None = None
    style: str = "italic"
    dots: int = 0


@node_class
class Entry(Node):
    """The entry of a matrix that has indices itself: (𝓘_2)_{11}."""

    of: Node
    index: Node


@node_class
class Row(Node):
    """Nodes side by side with nothing between them: a subscript `v_1 i`, a list with commas."""

    parts: tuple[Node, ...]


@node_class
class Words(Node):
    """Upright words inside a formula."""

    text: str


@node_class
class Transpose(Node):
    """argumentᵀ"""

    argument: Node


@node_class
class Cross(Node):
    """left × right"""

    left: Node
    right: Node


@node_class
class Derivative(Node):
    """∂of/∂by, or d of/d by where `total`; `of` None gives the bare operator."""

    of: Node | None
    by: Node
    total: bool = False


@node_class
class BigSum(Node):
    """Σ_{index=lower}^{upper} body"""

    body: Node
    index: Node
    lower: Node
    upper: Node


@node_class
class Integral(Node):
    """∫_lower^upper body d(variable)"""

    body: Node
    variable: Node
    lower: Node
    upper: Node


@node_class
class Parenthesized(Node):
    """(argument), where the parentheses are wanted though no rule of precedence asks for them."""

    argument: Node


@node_class
class Slashed(Node):
    """A `Quotient` or a `Derivative` with a stroke, a/b, as it stands in a line of words."""

    fraction: Node


@node_class
class Relation(Node):
    """part₁ sign₁ part₂ sign₂ ...: an equation or a chain of them."""

    parts: tuple[Node, ...]
    signs: tuple[str, ...] = ("=",)


NAMED = "=:"
"""The sign between what gets a name and the name."""

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
