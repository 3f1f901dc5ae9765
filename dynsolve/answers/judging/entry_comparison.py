"""Whether an answer equals what was expected: exactly, with numbers for symbols, or rounded.

The exact comparison decides.  Only where it fails, and the problem file gives
numbers for its symbols or the answer holds decimals, the other two are tried:

- a symbol with a number in the file may stand as either: symbols that the answer
  does not use are replaced by their numbers on both sides;
- a decimal of at least three significant digits that does not stand in the problem
  file stands for all numbers that round to it: the answer is right where one choice
  of these numbers makes it what is expected.  Every other number is exact: 0.5 is ½.

Answers that are spaces: vectors that span the key's, however many and however long they are.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator, Mapping, Sequence
from fractions import Fraction
from math import cos, pi, radians, sqrt
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.fraction import RationalExpr, equal, multiply, simplified, summed
from dynsolve.algebra.linear_systems import rank_parts, same_span
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.rationals import half_unit, rational
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.notation import tree
from dynsolve.notation.tree import Node, Number, walk, with_children

ROUNDED = "rounded"


MOST_DECIMALS = 40
"""An answer with more decimals than this is compared exactly only."""

MOST_SWEEPS = 200
"""So often all decimals of an answer are adjusted, until they make it what is expected."""

_SLACK = 1 + 1e-6
_NEAR = 1e-4

Monomial = tuple[int, ...]
"""The exponents of a term."""


class WrittenEntry(Struct, frozen=True):
    """An answer's scalar: its value, the tree it came from, and how to evaluate a changed tree."""

    value: RationalExpr
    node: Node
    evaluate: Callable[[Node], RationalExpr]


class EntryComparer(Struct, frozen=True):
    """Compares scalars; `values` are the numbers that the problem file gives for symbols.

    `exact` are the decimals that stand in the problem file.
    """

    values: Mapping[str, Fraction]
    exact: frozenset[Fraction] = frozenset()

    def __call__(self, expected: Expr | RationalExpr, written: WrittenEntry) -> str | None:
        """Empty where they are equal, `rounded` where a decimal rounds, None where they differ."""
        if isinstance(expected, RationalExpr):
            return self._with_fraction(expected, written)
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

    def is_made(self, expected: Expr, factors: Sequence[Expr], written: Sequence[WrittenEntry]) -> bool:
        """Whether Σ factorⱼ entryⱼ is what is expected, with the problem's numbers, or rounds to it."""
        put = placed(self.values, expected.ring)

        def valued(value: RationalExpr) -> RationalExpr:
            return simplified(put_numbers(value, put))

        scales, goal = [RationalExpr(factor) for factor in factors], valued(RationalExpr(expected))
        terms = map(multiply, scales, (entry.value for entry in written))
        mine = valued(summed(terms, expected.ring.zero))
        if equal(goal, mine):
            return True
        if goal.divisor is not None or mine.divisor is not None:
            return False
        steps = (
            valued(multiply(scale, RationalExpr(step))).numerator
            for scale, entry in zip(scales, written, strict=True)
            for step in self._steps(entry)
        )
        return _rounds(goal.numerator, mine.numerator, steps)

    def _with_fraction(self, expected: RationalExpr, written: WrittenEntry) -> str | None:
        """The same where a fraction is expected: as it is, or with numbers for all symbols that have one."""
        if equal(expected, written.value):
            return ""
        ring = expected.ring
        put = placed(self.values, ring)
        if not put:
            return None
        number = simplified(put_numbers(expected, put))
        mine = replace(written, value=simplified(put_numbers(written.value, put)))
        if number.divisor is None:
            return replace(self, values={})(number.numerator, mine)
        return "" if equal(number, mine.value) else None

    def _with_numbers(self, expected: Expr, mine: RationalExpr) -> tuple[Expr, RationalExpr]:
        """Both with numbers for those valued symbols that do not occur in the answer."""
        ring = expected.ring
        used = {*mine.numerator.used, *mine.denominator.used}
        put = {i: value for i, value in placed(self.values, ring).items() if i not in used}
        return substituted(expected, put), mine

    def _mixed(self, expected: Expr, mine: RationalExpr) -> bool:
        """Whether they are equal with all numbers put in: a symbol may stand as either, term by term.

        Every term of the answer must be one of the expected with numbers for some of
        its symbols, so that two lengths of one value are not taken for each other.
        """
        ring = expected.ring
        put = placed(self.values, ring)
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
        for changed in moved_decimals(written.node, self.exact):
            value = simplified(written.evaluate(changed))
            if value.divisor is None and written.value.divisor is None:
                yield value.numerator - written.value.numerator


def placed(values: Mapping[str, Fraction], ring: Ring) -> dict[int, Fraction]:
    """Numbers of symbols by the places of these in a ring."""
    return {ring.symbol_indices[n, 0]: v for n, v in values.items() if ring.has_symbol(n)}


def put_numbers(value: RationalExpr, put: Mapping[int, Fraction]) -> RationalExpr:
    """A fraction with numbers for some generators."""
    divisor = value.divisor and substituted(value.divisor, put)
    return RationalExpr(substituted(value.numerator, put), divisor)


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
    """Whether decimals within their intervals make the answer what is expected.

    What is expected must not come out as 0 for it: a term that has to vanish was left out.
    """
    moves = [move for move in map(_floats, steps) if move]
    if not moves:
        return False
    theirs, ours = _floats(expected), _floats(mine)
    off = {key: theirs.get(key, 0.0) - ours.get(key, 0.0) for key in theirs.keys() | ours.keys()}
    for key, difference in off.items():
        allowed = sum(abs(move.get(key, 0.0)) for move in moves)
        right = abs(theirs.get(key, 0.0))
        if abs(difference) > _loosely(allowed) or (right and abs(difference) * _SLACK >= right):
            return False
    return _reached(off, moves)


def _loosely(allowed: float) -> float:
    return allowed * _SLACK + 1e-12


def _reached(off: Mapping[Monomial, float], moves: Sequence[Mapping[Monomial, float]]) -> bool:
    """Whether the moves, each taken between -1 and 1 times, add up to what is off.

    A decimal before a bracket moves several coefficients at once.  The least squares in the box
    are found coordinate by coordinate.
    """
    left = dict(off)
    taken = [0.0] * len(moves)
    for _ in range(MOST_SWEEPS):
        if all(abs(rest) <= _loosely(0) + _NEAR * max(abs(m.get(k, 0.0)) for m in moves)
               for k, rest in left.items()):  # fmt: skip
            return True
        for place, move in enumerate(moves):
            size = sum(value * value for value in move.values())
            best = taken[place] + sum(left.get(key, 0.0) * value for key, value in move.items()) / size
            step = min(max(best, -1.0), 1.0) - taken[place]
            taken[place] += step
            for key, value in move.items():
                left[key] = left.get(key, 0.0) - step * value
    return False


def _floats(expr: Expr) -> dict[Monomial, float]:
    """The coefficients as numbers, with the numeric generators (√3, π, cos 10°) put in."""
    numeric = _numeric(expr.ring)
    result: dict[Monomial, float] = {}
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


def moved_decimals(node: Node, exact: Container[Fraction] = ()) -> Iterator[Node]:
    """The tree once for each decimal that rounds, that one moved by half a unit of its last place."""
    mover = _Mover(exact)
    count = sum(1 for part in walk(node) if isinstance(part, Number) and mover.rounds(part))
    if not 0 < count <= MOST_DECIMALS:
        return
    for place in range(count):
        mover.left = place
        yield mover.tree(node)


class _Mover:
    """Rebuilds a tree with the decimal number `left` of those that round moved."""

    def __init__(self, exact: Container[Fraction]) -> None:
        self.exact = exact
        self.left = 0

    def rounds(self, number: Number) -> bool:
        """Whether a number stands for those that round to it."""
        return half_unit(Fraction(number.p, number.q), self.exact) is not None

    def tree(self, node: Node) -> Node:
        match node:
            case Number():
                return self.number(node)
            case tree.Function():
                return node
        return with_children(node, self.tree)

    def number(self, number: Number) -> Node:
        half = half_unit(Fraction(number.p, number.q), self.exact)
        if half is None:
            return number
        self.left -= 1
        if self.left != -1:
            return number
        moved = Fraction(number.p, number.q) + half
        return Number(moved.numerator, moved.denominator)


# Answers that are spaces

Rows = Sequence[Sequence[RationalExpr]]

MOST_VECTORS = 12
"""More vectors than this are not compared."""


def readings(rows: Rows, height: int) -> tuple[Matrix, ...]:
    """The vectors that were written, side by side: columns or rows, of which only one may have that height.

    A single 0 is the space {0}.
    """
    listed = [list(row) for row in rows]
    if len(listed) == 1 and len(listed[0]) == 1 and height != 1 and listed[0][0].is_zero:
        listed = [[listed[0][0]] for _ in range(height)]
    turned = [list(column) for column in zip(*listed, strict=True)]
    return tuple(
        _side_by_side(vectors)
        for vectors in (turned, listed)
        if vectors and len(vectors[0]) == height and len(vectors) <= MOST_VECTORS
    )


def _side_by_side(vectors: Sequence[Sequence[RationalExpr]]) -> Matrix:
    """The matrix with these columns, each times its denominators."""
    plain = [_without_denominators(vector) for vector in vectors]
    return Matrix.of(vectors[0][0].ring, zip(*plain, strict=True))


def _without_denominators(vector: Sequence[RationalExpr]) -> list[Expr]:
    ring = vector[0].ring
    found = []
    for place, entry in enumerate(vector):
        product = entry.numerator
        for other, factor in enumerate(vector):
            if other != place:
                product = product * factor.denominator
        found.append(product)
    return found if found else [ring.zero]


def spans(key: Matrix, written: Sequence[Matrix], values: Mapping[str, Fraction]) -> bool:
    """Whether any reading spans what the key's columns do, also with numbers for symbols."""
    if any(_same(key, one) for one in written):
        return True
    ring = key.ring
    put = placed(values, ring)
    if not put:
        return False
    numbers = key.map(lambda entry: substituted(entry, put))
    return any(
        _same(numbers, one.map(lambda entry: put_numbers(RationalExpr(entry), put).numerator))
        for one in written
    )


def _same(key: Matrix, written: Matrix) -> bool:
    return key.shape[0] == written.shape[0] and same_span(key, written)


def difference(key: Matrix, written: Sequence[Matrix], height: int) -> str:
    """What is wrong with the vectors, in a sentence."""
    if not written:
        return f"These are no vectors of {height} entries."
    mine, wanted = rank_parts(written[0]).rank, key.shape[1]
    if mine != wanted:
        return f"The space that you wrote has dimension {mine}; this one has dimension {wanted}."
    return "The space has the right dimension, but these vectors are not in it."
