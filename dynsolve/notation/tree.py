"""The notation tree: a formula as it is written, neither more nor less.

A tree says what stands on paper, in that order: nothing in it is ever evaluated,
re-ordered or simplified.  Readers make trees from text, `algebra.compact` makes
them from exact values, printers turn them into Unicode, LaTeX or Python text.

The first part is what an expression is made of; the second part (from `Letter`
on) occurs only in the formulas that explain a step.

To add a node, add its class here, frozen, and a method for it to each printer that writes it.  A
field that holds parts is annotated `Node`, `Node | None`, `tuple[Node, ...]` or
`tuple[tuple[Node, ...], ...]`: from that `walk` knows how to visit and rebuild it.

Visiting and rebuilding formula trees, for every other module that works on trees.

The parts of a node are known from the annotations of its fields (see `notation.tree`), so a
new node needs nothing here.  `children` and `walk` look at a tree; `with_children` and
`mapped` make a changed one, in which everything that does not change is the same object.
A rewriter that must treat some nodes in a way of its own matches those and leaves the others
to `with_children`:

>>> from dynsolve.notation.tree import Number, Power, Product, Symbol
>>> def doubled(node):
...     match node:
...         case Number(p, q):
...             return Number(2 * p, q)
...         case Power(base, exponent):  # exponents stay
...             return Power(doubled(base), exponent)
...     return with_children(node, doubled)
>>> doubled(Product((Number(3), Power(Symbol("l"), Number(2))))).factors[0]
Number(p=6, q=1, decimal=False, rounded=False)
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from fractions import Fraction
from itertools import chain
from operator import attrgetter, is_
from typing import Any, TypeVar

from msgspec import Struct


class Node(Struct, frozen=True, cache_hash=True):
    """A formula or a part of one; trees share parts, so each part is hashed once."""

    def __str__(self) -> str:
        """Nothing: a formula among words stands there as itself, and a printer of the page's writes it."""
        raise TypeError(f"{type(self).__name__} has no text of its own: a printer writes it")


class Number(Node, frozen=True):
    """An exact rational p/q; negative numbers are written `Negative(Number(...))`.

    `decimal` asks for a decimal point, whatever the style of the formula; `rounded` says that the number
    stands for another one, which it is nearest to.
    """

    p: int
    q: int = 1
    decimal: bool = False
    rounded: bool = False


class Degrees(Node, frozen=True):
    """An angle in degrees, p/q°."""

    p: int
    q: int = 1


class Symbol(Node, frozen=True):
    """A named quantity; `dots` time derivatives of it; `star` marks a joint variable."""

    name: str
    dots: int = 0
    star: bool = False


class Reference(Node, frozen=True):
    """A quantity of the derivation that stands in a formula by its name, K1, or an entry of it (from 1).

    >>> str(Reference("K1")), str(Reference("I1", 1, 3))
    ('K1', 'I1[1,3]')
    """

    quantity: str
    row: int | None = None
    column: int | None = None

    def __str__(self) -> str:
        return self.quantity if self.row is None else f"{self.quantity}[{self.row},{self.column}]"


class Sum(Node, frozen=True):
    """t₁ + t₂ + ...; a `Negative` term is printed with a minus."""

    terms: tuple[Node, ...]


class Product(Node, frozen=True):
    """f₁ f₂ ..."""

    factors: tuple[Node, ...]


class Quotient(Node, frozen=True):
    """numerator / denominator"""

    numerator: Node
    denominator: Node


class Power(Node, frozen=True):
    """base^exponent"""

    base: Node
    exponent: Node


class Negative(Node, frozen=True):
    """-argument"""

    argument: Node


class Function(Node, frozen=True):
    """sin, cos, tan, sqrt, sgn, acos, asin, atan of an argument; atan2 of `Arguments` (y, x)."""

    name: str
    argument: Node


class Arguments(Node, frozen=True):
    """Several arguments of a function."""

    parts: tuple[Node, ...]


class Matrix(Node, frozen=True):
    """Rows of entries, all rows of one length."""

    rows: tuple[tuple[Node, ...], ...]

    @property
    def is_zero(self) -> bool:
        """Whether every entry is the number 0."""
        return all(entry == ZERO for row in self.rows for entry in row)


class Letter(Node, frozen=True):
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


class Entry(Node, frozen=True):
    """The entry of a matrix that has indices itself: (𝓘_2)_{11}."""

    of: Node
    index: Node


class Row(Node, frozen=True):
    """Nodes side by side with nothing between them: a subscript `v_1 i`, a list with commas."""

    parts: tuple[Node, ...]


class Words(Node, frozen=True):
    """Upright words inside a formula."""

    text: str


class Transpose(Node, frozen=True):
    """argumentᵀ"""

    argument: Node


class Cross(Node, frozen=True):
    """left × right"""

    left: Node
    right: Node


class Derivative(Node, frozen=True):
    """∂of/∂by, or d of/d by where `total`; `of` None gives the bare operator."""

    of: Node | None
    by: Node
    total: bool = False


class BigSum(Node, frozen=True):
    """Σ_{index=lower}^{upper} body"""

    body: Node
    index: Node
    lower: Node
    upper: Node


class Integral(Node, frozen=True):
    """∫_lower^upper body d(variable)"""

    body: Node
    variable: Node
    lower: Node
    upper: Node


class Parenthesized(Node, frozen=True):
    """(argument), where the parentheses are wanted though no rule of precedence asks for them."""

    argument: Node


class Slashed(Node, frozen=True):
    """A `Quotient` or a `Derivative` with a stroke, a/b, as it stands in a line of words."""

    fraction: Node


class Relation(Node, frozen=True):
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


# Visiting and rebuilding formula trees, for every other module that works on trees

_N = TypeVar("_N", bound=Node)
Change = Callable[[Node], Node]


def children(node: Node) -> tuple[Node, ...]:
    """The parts of a node, in the order of its fields; those of a matrix row by row.

    >>> from dynsolve.notation.tree import Number, Power, Symbol
    >>> children(Power(Symbol("m"), Number(2)))
    (Symbol(name='m', dots=0, star=False), Number(p=2, q=1, decimal=False, rounded=False))
    """
    return _READERS[type(node)](node)


def walk(*nodes: Node) -> Iterator[Node]:
    """Trees and everything in them: a node before its parts, parts from left to right.

    >>> from dynsolve.notation.tree import Negative, Symbol, Sum
    >>> [type(node).__name__ for node in walk(Sum((Negative(Symbol("a")), Symbol("b"))))]
    ['Sum', 'Negative', 'Symbol', 'Symbol']
    """
    pending = list(reversed(nodes))
    while pending:
        node = pending.pop()
        yield node
        pending += _READERS[type(node)](node)[::-1]


def walk_once(*nodes: Node) -> Iterator[Node]:
    """The same, in which a tree that several parts share is met once."""
    pending, met = list(reversed(nodes)), set[int]()
    while pending:
        node = pending.pop()
        if id(node) not in met:
            yield node
            met.add(id(node))
            pending += _READERS[type(node)](node)[::-1]


def has_part(node: Node, test: Callable[[Node], bool]) -> bool:
    """Whether a test holds for a formula or a part of it."""
    return any(map(test, walk_once(node)))


def names_in(*nodes: Node) -> set[str]:
    """The names of all symbols in trees."""
    return {part.name for part in walk(*nodes) if isinstance(part, Symbol)}


def with_atan2_exchanged(node: Node) -> Node:
    """The tree with atan2(x, y) for atan2(y, x)."""
    return mapped(node, _exchanged)


def _exchanged(part: Node) -> Node:
    if isinstance(part, Function) and part.name == "atan2" and isinstance(part.argument, Arguments):
        return Function("atan2", Arguments(part.argument.parts[::-1]))
    return part


def with_children(node: _N, change: Change) -> _N:
    """The node with each of its parts changed; the node itself where no part changes."""
    values = []
    changed = False
    for get, change_part in _FIELDS[type(node)]:
        value = get(node)
        if change_part is not None:
            new = change_part(value, change)
            changed = changed or new is not value
            value = new
        values.append(value)
    return type(node)(*values) if changed else node


def mapped(node: Node, function: Change) -> Node:
    """The tree rebuilt from its leaves upwards: `function` of every node, its parts being changed already.

    What does not change stays the same object, and a part that stands in several places is
    changed once.

    >>> from dynsolve.notation.tree import Number, Sum, Symbol
    >>> tree = Sum((Symbol("a"), Number(1)))
    >>> mapped(tree, lambda node: Symbol("b") if node == Symbol("a") else node).terms[0].name
    'b'
    >>> mapped(tree, lambda node: node) is tree
    True
    """
    done: dict[int, Node] = {}

    def change(part: Node) -> Node:
        found = done.get(id(part))
        if found is None:
            found = done[id(part)] = function(with_children(part, change))
        return found

    return change(node)


# -- the parts of a class of nodes, from its annotations -----------------------------------------------


def with_formulas(node: Node, formulas: Mapping[str, Node]) -> Node:
    """The tree with formulas in place of the symbols of these names.

    >>> with_formulas(Negative(Symbol("a")), {"a": Negative(Symbol("z"))}).name
    'z'
    """

    def put(part: Node) -> Node:
        match part:
            case Symbol(name):
                return formulas.get(name, part)
            case Negative(Negative(value)):
                return value
        return part

    return mapped(node, put)


def _change_all(parts: tuple[Node, ...], change: Change) -> tuple[Node, ...]:
    changed = tuple(map(change, parts))
    return parts if all(map(is_, parts, changed)) else changed


def _change_rows(rows: tuple[tuple[Node, ...], ...], change: Change) -> tuple[tuple[Node, ...], ...]:
    changed = tuple(_change_all(row, change) for row in rows)
    return rows if all(map(is_, rows, changed)) else changed


_KINDS: dict[Any, tuple[Callable[[Any], tuple[Node, ...]], Callable[[Any, Change], Any]]] = {
    "Node": (lambda part: (part,), lambda part, change: change(part)),
    "Node | None": (
        lambda part: () if part is None else (part,),
        lambda part, change: None if part is None else change(part),
    ),
    "tuple[Node, ...]": (lambda parts: parts, _change_all),
    "tuple[tuple[Node, ...], ...]": (lambda rows: tuple(chain.from_iterable(rows)), _change_rows),
}
"""Annotation -> (how the parts are taken from such a field, how they are changed)."""


def _annotated(kind: type[Node]) -> Iterator[tuple[str, str]]:
    """The fields of a class of nodes, with their annotations as they are written."""
    written = {
        name: type_
        for base in reversed(kind.__mro__)
        for name, type_ in vars(base).get("__annotations__", {}).items()
    }
    for name in kind.__struct_fields__:
        yield name, written[name]


class _Readers(dict[type[Node], Callable[[Any], tuple[Node, ...]]]):
    """For each class of nodes the function that gives a node's parts; made at the first use."""

    def __missing__(self, kind: type[Node]) -> Callable[[Any], tuple[Node, ...]]:
        self[kind] = reader = self._made(kind)
        return reader

    def _made(self, kind: type[Node]) -> Callable[[Any], tuple[Node, ...]]:
        named = [(name, type_) for name, type_ in _annotated(kind) if type_ in _KINDS]
        if not named:
            return lambda node: ()
        if len(named) == 1:
            get, parts = attrgetter(named[0][0]), _KINDS[named[0][1]][0]
            return lambda node: parts(get(node))
        if all(type_ == "Node" for _, type_ in named):
            return attrgetter(*(name for name, _ in named))  # gives a tuple, and is the fastest way to it
        readers = [(attrgetter(name), _KINDS[type_][0]) for name, type_ in named]
        return lambda node: tuple(chain.from_iterable(parts(get(node)) for get, parts in readers))


_Field = tuple[Callable[[Any], Any], Callable[[Any, Change], Any] | None]


class _Fields(dict[type[Node], tuple[_Field, ...]]):
    """For each field of a class the function that reads it, and the one that changes the parts in it."""

    def __missing__(self, kind: type[Node]) -> tuple[_Field, ...]:
        self[kind] = found = tuple(
            (attrgetter(name), _KINDS[type_][1] if type_ in _KINDS else None)
            for name, type_ in _annotated(kind)
        )
        return found


_READERS = _Readers()
_FIELDS = _Fields()
