"""Whether an answer equals what was expected: exactly, with numbers for symbols, or rounded.

The exact comparison decides.  Only where it fails, and the problem file gives
numbers for its symbols or the answer holds decimals, the other two are tried:

- a symbol with a number in the file may stand as either: symbols that the answer
  does not use are replaced by their numbers on both sides;
- every decimal of the answer stands for all numbers that round to it, and the
  expected coefficients must lie in what that allows; but twice as much as is
  right (0.1 for 0.05) is a lost ½ and no rounding.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import cos, pi, radians, sqrt
from typing import Any

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction import RationalExpr, equal, simplified
from dynsolve.algebra.rationals import rational
from dynsolve.notation import tree
from dynsolve.notation.tree import Node, Number
from dynsolve.notation.walk import walk, with_children

ROUNDED = "rounded"

MOST_DECIMALS = 40
"""An answer with more decimals than this is compared exactly only."""

_SLACK = 1 + 1e-6


@dataclass(frozen=True, slots=True)
class WrittenEntry:
    """An answer's scalar: its value, the tree it came from, and how to evaluate a changed tree."""

    value: RationalExpr
    node: Node
    evaluate: Callable[[Node], RationalExpr]


@dataclass(frozen=True, slots=True)
class EntryComparer:
    """Compares scalars; `values` are the numbers that the problem file gives for symbols."""

    values: Mapping[str, Fraction]

    def __call__(self, expected: Expr, written: WrittenEntry) -> str | None:
        """Empty where they are equal, `rounded` where a decimal rounds, None where they differ."""
        if equal(RationalExpr(expected), written.value):
            return ""
        mine = written.value
        if self.values:
            if self._mixed(expected, mine):
                return ""
            expected, mine = self._with_numbers(expected, mine)
            if equal(RationalExpr(expected), mine):
                return ""
        if mine.divisor is None and _rounds(expected, mine.numerator, self._steps(written)):
            return ROUNDED
        return None

    def _with_numbers(self, expected: Expr, mine: RationalExpr) -> tuple[Expr, RationalExpr]:
        """Both with numbers for those valued symbols that do not occur in the answer."""
        ring = expected.ring
        used = _used(mine.numerator) | (_used(mine.divisor) if mine.divisor else set())
        put = {
            ring.symbol_indices[(name, 0)]: value
            for name, value in self.values.items()
            if ring.has_symbol(name) and ring.symbol_indices[(name, 0)] not in used
        }
        return substituted(expected, put), mine

    def _mixed(self, expected: Expr, mine: RationalExpr) -> bool:
        """Whether they are equal with all numbers put in: a symbol may stand as either, term by term.

        Every term of the answer must be one of the expected with numbers for some of
        its symbols, so that two lengths of one value are not taken for each other.
        """
        ring = expected.ring
        put = {ring.symbol_indices[(n, 0)]: v for n, v in self.values.items() if ring.has_symbol(n)}
        if mine.divisor is not None or substituted(expected, put) != substituted(mine.numerator, put):
            return False
        theirs = [[int(e) for e in exponents] for exponents in expected.poly.monoms()]
        return all(
            any(
                all(a == b or (a < b and i in put) for i, (a, b) in enumerate(zip(ours, one, strict=True)))
                for one in theirs
            )
            for ours in ([int(e) for e in exponents] for exponents in mine.numerator.poly.monoms())
        )

    def _steps(self, written: WrittenEntry) -> Iterator[Expr]:
        """How far the answer moves when one of its decimals moves by half a unit of its last place."""
        for changed in moved_decimals(written.node):
            value = simplified(written.evaluate(changed))
            if value.divisor is None and written.value.divisor is None:
                yield value.numerator - written.value.numerator


def _used(expr: Expr) -> set[int]:
    if not expr.poly:
        return set()
    return {i for i, degree in enumerate(expr.poly.degrees()) if degree > 0}


def substituted(expr: Expr, put: Mapping[int, Fraction]) -> Expr:
    """The expression with numbers for some generators."""
    ring = expr.ring
    if not expr.poly or not put:
        return expr
    point = [ring.ctx.constant(rational(put[i])) if i in put else g for i, g in enumerate(ring.ctx.gens())]
    inverses = {
        i: f for i, f in ring.inverses.items() if any(f.degrees()[k] > 0 for k in put)
    }  # 1/p with numbers in p: a number where p has no other symbol
    for index, factor in inverses.items():
        value = factor.compose(*point, ctx=ring.ctx)
        if value.is_constant() and value:
            point[index] = ring.ctx.constant(1 / value.leading_coefficient())
    return Expr(ring, ring.reduce(expr.poly.compose(*point, ctx=ring.ctx)))


def _rounds(expected: Expr, mine: Expr, steps: Iterator[Expr]) -> bool:
    allowed: dict[tuple[int, ...], float] = {}
    for step in steps:
        for key, value in _floats(step).items():
            allowed[key] = allowed.get(key, 0.0) + abs(value)
    if not allowed:
        return False
    theirs, ours = _floats(expected), _floats(mine)
    for key in theirs.keys() | ours.keys():
        right = theirs.get(key, 0.0)
        off = abs(right - ours.get(key, 0.0))
        if off > allowed.get(key, 0.0) * _SLACK + 1e-12 or (right and off * _SLACK >= abs(right)):
            return False
    return True


def _floats(expr: Expr) -> dict[tuple[int, ...], float]:
    """The coefficients as numbers, with the numeric generators (√3, π, cos 10°) put in."""
    numeric = _numeric(expr.ring)
    result: dict[tuple[int, ...], float] = {}
    for exponents, value in expr.poly.to_dict().items():
        number = int(value.p) / int(value.q)
        key = tuple(0 if i in numeric else int(e) for i, e in enumerate(exponents))
        for i, known in numeric.items():
            if exponents[i]:
                number *= known ** int(exponents[i])
        result[key] = result.get(key, 0.0) + number
    return result


def _numeric(ring: Any) -> dict[int, float]:
    found: dict[int, float] = {}
    for g in ring.generators:
        if g.kind == "symbol" and g.name == "pi":
            found[g.index] = pi
        elif g.kind == "root" and isinstance(g.node, Number):
            found[g.index] = sqrt(g.node.p / g.node.q)
        elif g.kind in ("sin", "cos", "constant") and g.angle.is_constant:
            degrees = float(g.angle.degrees) - (90 if g.kind == "sin" else 0)
            found[g.index] = cos(radians(degrees))
    return found


def moved_decimals(node: Node) -> Iterator[Node]:
    """The tree once for each of its decimals, that one moved by half a unit of its last place."""
    count = sum(1 for _ in _decimals(node))
    if not 0 < count <= MOST_DECIMALS:
        return
    for place in range(count):
        yield _Mover(place).tree(node)


def _decimals(node: Node) -> Iterator[Number]:
    return (part for part in walk(node) if isinstance(part, Number) and _places(part))


def _places(value: Number) -> int:
    """How many decimals a number was written with, at least; 0 for one that was no decimal."""
    q, places = value.q, 0
    if q == 1:
        return 0
    while q % 10 == 0:
        q, places = q // 10, places + 1
    twos = fives = 0
    while q % 2 == 0:
        q, twos = q // 2, twos + 1
    while q % 5 == 0:
        q, fives = q // 5, fives + 1
    return places + max(twos, fives) if q == 1 else 0


class _Mover:
    """Rebuilds a tree with its decimal number `place` moved."""

    def __init__(self, place: int) -> None:
        self.left = place

    def tree(self, node: Node) -> Node:
        match node:
            case Number():
                return self.number(node)
            case tree.Function():
                return node
        return with_children(node, self.tree)

    def number(self, node: Number) -> Node:
        places = _places(node)
        if not places:
            return node
        self.left -= 1
        if self.left != -1:
            return node
        moved = Fraction(node.p, node.q) + Fraction(1, 2 * 10**places)
        return Number(moved.numerator, moved.denominator)
