"""Numeric values of trees.

Trees share their parts heavily, so they are compiled once into a flat list of
operations, each part of which is computed once; the list is then run at as many
points as wanted.

Caches of bounded size, so that the memory of a long process does not grow without end.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction
from functools import cache
from typing import Any, TypeVar

from msgspec import Struct

from dynsolve.notation.tree import (
    Arguments,
    Degrees,
    Function,
    Matrix,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    children,
)

DOTS = ("", "_dot", "_ddot")


def sign(x: float | Fraction) -> float:
    """sgn x: 1, -1, and 0 at 0."""
    return float(x > 0) - float(x < 0)


FUNCTIONS: Mapping[str, Callable[[Any], Any]] = {
    "sin": math.sin,
    "cos": math.cos,
    "tan": math.tan,
    "sqrt": math.sqrt,
    "acos": math.acos,
    "asin": math.asin,
    "atan": math.atan,
    "atan2": lambda arguments: math.atan2(*arguments),
    "sgn": sign,
}

_Operation = tuple[Callable[[Any], float], Callable[[Any], Any]]
"""(what is done, how its operands are taken from the values so far)"""


def plain_name(symbol: Symbol) -> str:
    """The name of a symbol in plain text: `theta1_dot`."""
    return symbol.name + DOTS[symbol.dots]


class Program(Struct, frozen=True):
    """Trees as a list of operations on one growing list of values.

    `places` are the places of the results in that list: a number for a scalar,
    rows of them for a matrix.
    """

    constants: tuple[float, ...]
    symbols: tuple[str, ...]
    operations: tuple[_Operation, ...]
    places: tuple[Any, ...]

    def run(self, values: Mapping[str, float]) -> list[Any]:
        """The value of each tree: a float, or rows of floats for a matrix.

        Raises KeyError for a symbol without a value, ValueError or
        ZeroDivisionError where a tree has none.
        """
        stack = [*self.constants, *(math.pi if name == "pi" else values[name] for name in self.symbols)]
        append = stack.append
        for operation, operands in self.operations:
            append(operation(operands(stack)))
        return [
            stack[place] if isinstance(place, int) else [[stack[entry] for entry in row] for row in place]
            for place in self.places
        ]


def compile_trees(
    trees: Iterable[Node], functions: Mapping[str, Callable[[Any], Any]] = FUNCTIONS
) -> Program:
    """Compile trees for evaluation; a `Matrix` may only stand on top.

    `functions` are the sine and its like; with those of NumPy the values may be arrays.

    >>> x = Symbol("x")
    >>> program = compile_trees([Sum((x, Number(1, 2))), Matrix(((x, Power(x, Number(3))),))])
    >>> program.run({"x": 2.0})
    [2.5, [[2.0, 8.0]]]
    """
    trees = tuple(trees)
    compiler = _Compiler(functions)
    for tree in trees:
        compiler.collect(tree)
    places = tuple(compiler.place(tree) for tree in trees)
    return Program(tuple(compiler.constants), tuple(compiler.symbols), tuple(compiler.operations), places)


def evaluate(tree: Node, values: Mapping[str, float]) -> Any:
    """The value of one tree at plain names (`theta1`, `theta1_dot`, parameters), angles in radians."""
    return compile_trees([tree]).run(values)[0]


class _Compiler:
    """Constants come first in the list of values, then symbols, then results in order."""

    __slots__ = ("functions", "constants", "symbols", "operations", "leaves", "seen", "offset")

    def __init__(self, functions: Mapping[str, Callable[[Any], Any]]) -> None:
        self.functions = functions
        self.constants: dict[float, int] = {}
        self.symbols: dict[str, int] = {}
        self.operations: list[_Operation] = []
        self.leaves: list[Node] = []
        self.seen: dict[int, int] = {}
        self.offset = 0

    def collect(self, tree: Node) -> None:
        """Give every constant and symbol its place, before any operation."""
        pending, met = [tree], self.seen
        while pending:
            node = pending.pop()
            if id(node) in met:
                continue
            met[id(node)] = -1
            match node:
                case Number(p, q):
                    self.constants.setdefault(p / q, len(self.constants))
                case Degrees(p, q):
                    self.constants.setdefault(math.radians(p / q), len(self.constants))
                case Symbol():
                    self.symbols.setdefault(plain_name(node), len(self.symbols))
                case _:
                    pending.extend(_operands(node))

    def place(self, tree: Node) -> Any:
        if not self.offset:
            self.offset = len(self.constants) + len(self.symbols)
        if isinstance(tree, Matrix):
            return tuple(tuple(self.scalar(entry) for entry in row) for row in tree.rows)
        return self.scalar(tree)

    def scalar(self, node: Node) -> int:
        place = self.seen[id(node)]
        if place < 0:
            place = self.seen[id(node)] = self.compiled(node)
        return place

    def compiled(self, node: Node) -> int:
        match node:
            case Number(p, q):
                return self.constants[p / q]
            case Degrees(p, q):
                return self.constants[math.radians(p / q)]
            case Symbol():
                return len(self.constants) + self.symbols[plain_name(node)]
            case Parenthesized(argument):
                return self.scalar(argument)
        operands = [self.scalar(part) for part in _operands(node)]
        if not operands:
            raise TypeError(f"a tree with {type(node).__name__} has no value")
        operation = (
            self.operation(node) if len(operands) > 1 or not isinstance(node, Sum | Product) else _same
        )
        self.operations.append((operation, operator.itemgetter(*operands)))
        return self.offset + len(self.operations) - 1

    def operation(self, node: Node) -> Callable[[Any], float]:
        match node:
            case Sum():
                return sum
            case Product():
                return math.prod
            case Quotient():
                return lambda pair: pair[0] / pair[1]
            case Negative():
                return operator.neg
            case Function(name):
                return self.functions[name]
            case Arguments():
                return _same
            case Power(_, exponent):
                whole = _whole(exponent)
                return _raised_to(whole) if whole is not None else lambda pair: float(pair[0] ** pair[1])
        raise TypeError(f"a tree with {type(node).__name__} has no value")


def _operands(node: Node) -> tuple[Node, ...]:
    """The parts whose values are needed; a whole exponent is part of the operation."""
    if isinstance(node, Power) and _whole(node.exponent) is not None:
        return (node.base,)
    return children(node)


def _whole(exponent: Node) -> int | None:
    match exponent:
        case Number(p, 1):
            return p
        case Negative(Number(p, 1)):
            return -p
    return None


def _same(value: Any) -> Any:
    return value


@cache
def _raised_to(exponent: int) -> Callable[[float], float]:
    if exponent == 2:
        return lambda x: x * x
    return lambda x: x**exponent


# Caches of bounded size, so that the memory of a long process does not grow without end

_K = TypeVar("_K")
_V = TypeVar("_V")


def recalled(memory: dict[_K, _V], key: _K, make: Callable[[], _V], most: int) -> _V:
    """The value under a key of a cache of at most `most` entries; made and kept if there is none.

    >>> squares: dict[int, int] = {}
    >>> recalled(squares, 3, lambda: 9, most=10), squares
    (9, {3: 9})
    """
    try:
        return memory[key]
    except KeyError:
        return keep(memory, key, make(), most)


def keep(memory: dict[_K, _V], key: _K, value: _V, most: int) -> _V:
    """Put a value into a cache and return it; a full cache is emptied first."""
    if len(memory) >= most:
        memory.clear()
    memory[key] = value
    return value
