"""Visiting and rebuilding formula trees, for every other module that works on trees.

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
Number(p=6, q=1, decimal=False)
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import fields
from itertools import chain
from operator import attrgetter, is_
from typing import Any, TypeVar

from dynsolve.notation.tree import Arguments, Function, Node, Symbol

_N = TypeVar("_N", bound=Node)
Change = Callable[[Node], Node]


def children(node: Node) -> tuple[Node, ...]:
    """The parts of a node, in the order of its fields; those of a matrix row by row.

    >>> from dynsolve.notation.tree import Number, Power, Symbol
    >>> children(Power(Symbol("m"), Number(2)))
    (Symbol(name='m', dots=0, star=False), Number(p=2, q=1, decimal=False))
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
    """The tree with formulas in place of the symbols of these names."""
    return mapped(node, lambda part: formulas.get(part.name, part) if isinstance(part, Symbol) else part)


def _change_perhaps(part: Node | None, change: Change) -> Node | None:
    return None if part is None else change(part)


def _change_all(parts: tuple[Node, ...], change: Change) -> tuple[Node, ...]:
    changed = tuple(map(change, parts))
    return parts if all(map(is_, parts, changed)) else changed


def _change_rows(rows: tuple[tuple[Node, ...], ...], change: Change) -> tuple[tuple[Node, ...], ...]:
    changed = tuple(_change_all(row, change) for row in rows)
    return rows if all(map(is_, rows, changed)) else changed


_KINDS: dict[Any, tuple[Callable[[Any], tuple[Node, ...]], Callable[[Any, Change], Any]]] = {
    "Node": (lambda part: (part,), lambda part, change: change(part)),
    "Node | None": (lambda part: () if part is None else (part,), _change_perhaps),
    "tuple[Node, ...]": (lambda parts: parts, _change_all),
    "tuple[tuple[Node, ...], ...]": (lambda rows: tuple(chain.from_iterable(rows)), _change_rows),
}
"""Annotation -> (how the parts are taken from such a field, how they are changed)."""


class _Readers(dict[type[Node], Callable[[Any], tuple[Node, ...]]]):
    """For each class of nodes the function that gives a node's parts; made at the first use."""

    def __missing__(self, kind: type[Node]) -> Callable[[Any], tuple[Node, ...]]:
        self[kind] = reader = self._made(kind)
        return reader

    def _made(self, kind: type[Node]) -> Callable[[Any], tuple[Node, ...]]:
        named = [(f.name, f.type) for f in fields(kind) if f.type in _KINDS]
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
            (attrgetter(f.name), _KINDS[f.type][1] if f.type in _KINDS else None) for f in fields(kind)
        )
        return found


_READERS = _Readers()
_FIELDS = _Fields()
