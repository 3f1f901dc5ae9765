"""Results put at exact rational states, so that two forms are compared without a rounding.

An angle is held by its rational cosine and sine; a sum of angles is then exact
too.  Two trigonometric polynomials that agree at a few random such states are,
but for a chance of one in millions, the same.
"""

from __future__ import annotations

import ast
import random
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any


@dataclass(frozen=True)
class Turn:
    """An angle by its cosine and sine."""

    cos: Fraction
    sin: Fraction

    @staticmethod
    def of(t: Fraction) -> Turn:
        """The angle whose half has the tangent t."""
        return Turn((1 - t * t) / (1 + t * t), 2 * t / (1 + t * t))

    def __add__(self, other: Turn) -> Turn:
        return Turn(self.cos * other.cos - self.sin * other.sin, self.sin * other.cos + self.cos * other.sin)

    def __neg__(self) -> Turn:
        return Turn(self.cos, -self.sin)

    def __sub__(self, other: Turn) -> Turn:
        return self + -other

    def __rmul__(self, times: Fraction) -> Turn:
        assert times.denominator == 1 and times > 0
        return self if times == 1 else self + (times - 1) * self


class _Exact(ast.NodeTransformer):
    """Every number becomes a `Fraction`."""

    def visit_Constant(self, node: ast.Constant) -> ast.AST:
        return ast.copy_location(
            ast.Call(ast.Name("Fraction", ast.Load()), [ast.Constant(str(node.value))], []), node
        )


def exact(entries: Any, values: Mapping[str, Any]) -> Any:
    """A string, or nested lists of strings, at an exact state.

    >>> exact("2*sin(q1 + q2)*cos(q1)/3", {"q1": Turn.of(Fraction(1, 2)), "q2": Turn.of(Fraction(1))})
    Fraction(6, 25)
    """
    if not isinstance(entries, str):
        return [exact(entry, values) for entry in entries]
    tree = ast.fix_missing_locations(_Exact().visit(ast.parse(entries, mode="eval")))
    names = {
        "Fraction": Fraction,
        "sin": lambda turn: turn.sin,
        "cos": lambda turn: turn.cos,
        "__builtins__": {},
    }
    return Fraction(eval(compile(tree, "<result>", "eval"), names, dict(values)))  # noqa: S307


def names_in(entries: Any) -> set[str]:
    """Every symbol of a string or of nested lists of strings; a function that is called is none."""
    if not isinstance(entries, str):
        return {name for entry in entries for name in names_in(entry)}
    nodes = list(ast.walk(ast.parse(entries, mode="eval")))
    called = {id(node.func) for node in nodes if isinstance(node, ast.Call)}
    return {node.id for node in nodes if isinstance(node, ast.Name) and id(node) not in called}


def random_state(names: Iterable[str], angles: Iterable[str], seed: int) -> dict[str, Any]:
    """A random exact value for every name."""
    draw = random.Random(seed)
    angles = set(angles)
    values: dict[str, Any] = {}
    for name in sorted(names):
        number = Fraction(draw.randint(1, 10_000), draw.randint(1, 10_000))
        values[name] = Turn.of(number) if name in angles else number
    return values


def times(matrix: list[list[Fraction]], vector: list[Fraction]) -> list[list[Fraction]]:
    """Matrix times column."""
    return [[sum((a * b for a, b in zip(row, vector, strict=True)), Fraction(0))] for row in matrix]


def flat(entries: Any) -> list[Any]:
    """All entries, row by row: a column may be written as a list of rows or of entries."""
    return [entry for part in entries for entry in flat(part)] if isinstance(entries, list) else [entries]
