"""Slips that run through one whole expression: one symbol, angle or function for another."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any

from flint import fmpq

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.generators import Generator
from dynsolve.algebra.rationals import fraction
from dynsolve.algebra.ring import Ring
from dynsolve.answers.diagnosis.slips import slip
from dynsolve.answers.diagnosis.term_writer import TermWriter
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.verdict import Diagnosis
from dynsolve.notation.tree import Node
from dynsolve.notation.walk import walk

MOST_TERMS = 400


class _Pair:
    """An answer and what was expected; `becomes` tells whether a substitution leads to the answer.

    Most do not, which a look at one point tells: sines and cosines are rational points
    of a circle there, so that what is equal in the ring is equal at the point.
    """

    def __init__(self, mine: Expr, expected: Expr) -> None:
        self.mine, self.expected = mine, expected
        self.ring = mine.ring
        used = {*_used(mine), *_used(expected)}
        kinds = {self.ring.generators[i].kind for i in used}
        self.point = _point(self.ring) if kinds <= {"symbol", "sin", "cos"} else []
        self.value = mine.poly(*self.point) if self.point else None

    def becomes(self, images: dict[int, Any]) -> bool:
        """Whether the answer is what was expected with polynomials for some generators."""
        if self.point:
            moved = [images[i](*self.point) if i in images else x for i, x in enumerate(self.point)]
            if self.expected.poly(*moved) != self.value:
                return False
        return put_polynomials(self.expected, images) == self.mine


def _point(ring: Ring) -> list[fmpq]:
    """A rational point on every circle sin² + cos² = 1."""
    point = [fmpq(7 * i + 3) for i in range(len(ring.generators))]
    for k, pair in enumerate(ring.pairs):
        t = fmpq(k + 2, k + 5)
        point[pair.sine], point[pair.cosine] = 2 * t / (1 + t * t), (1 - t * t) / (1 + t * t)
    return point


def substitutions(graph: AnswerGraph, words: TermWriter, mine: Expr, expected: Expr) -> Iterator[Diagnosis]:
    """The substitutions that turn what was expected into the answer."""
    if max(len(mine), len(expected)) > MOST_TERMS or mine.is_zero or expected.is_zero:
        return
    pair = _Pair(mine, expected)
    yield from _gravity(graph, pair)
    yield from _angles(graph, words, pair)
    yield from _symbols(graph, words, pair)


def put_polynomials(expr: Expr, images: dict[int, Any]) -> Expr:
    """The expression with polynomials for some generators."""
    ring = expr.ring
    point = [images.get(i, g) for i, g in enumerate(ring.ctx.gens())]
    return Expr(ring, ring.reduce(expr.poly.compose(*point, ctx=ring.ctx)))


def _used(expr: Expr) -> list[int]:
    return [i for i, degree in enumerate(expr.poly.degrees()) if degree > 0]


def _gravity(graph: AnswerGraph, values: _Pair) -> Iterator[Diagnosis]:
    ring, expected = values.ring, values.expected
    strength = {i for entry in graph.robot.gravity.entries if entry.poly for i in _used(entry)}
    symbols = [i for i in strength if ring.generators[i].kind == "symbol"]
    for index in symbols:
        if put_polynomials(expected, {index: ring.zero.poly}) == expected:
            continue
        if values.becomes({index: -ring.generator(index).poly}):
            yield slip("gravity_sign")
        elif values.becomes({index: ring.zero.poly}):
            yield slip("gravity_missing")


def _angles(graph: AnswerGraph, words: TermWriter, values: _Pair) -> Iterator[Diagnosis]:
    """An angle for another throughout, or sine and cosine of one exchanged."""
    ring, mine, expected = values.ring, values.mine, values.expected
    used = set(_used(expected))
    angles = [*(pair.angle for pair in ring.pairs), *(Angle.of(n) for n in ring.names)]
    for pair in ring.pairs:
        if not used & {pair.sine, pair.cosine}:
            continue
        s, c = ring.generator(pair.sine), ring.generator(pair.cosine)
        if values.becomes({pair.sine: c.poly, pair.cosine: s.poly}):
            yield from _function(words, values, s, c)
        for angle in dict.fromkeys(angles):
            if angle == pair.angle:
                continue
            try:
                images = {pair.sine: ring.sin(angle).poly, pair.cosine: ring.cos(angle).poly}
            except Exception:  # noqa: BLE001, S112  an angle that the ring does not hold
                continue
            if values.becomes(images):
                product = any(len(atom) > 1 for atom, _ in angle.terms)
                function = "cos" if pair.cosine in used else "sin"
                right = c if function == "cos" else s
                written = ring.cos(angle) if function == "cos" else ring.sin(angle)
                if not _is_seen(words, values, written, right):
                    continue
                yield slip(
                    "angle_product" if product else "angle",
                    yours=words.of(mine), part=words.of(written), other=words.of(right),
                )  # fmt: skip


def _function(words: TermWriter, values: _Pair, s: Expr, c: Expr) -> Iterator[Diagnosis]:
    degrees = values.expected.poly.degrees()
    sine = degrees[_used(s)[0]] > 0
    written, right = (c, s) if sine else (s, c)
    if _is_seen(words, values, written, right):
        yield slip("sin_for_cos", yours="your answer", part=words.of(written), other=words.of(right))


def _is_seen(words: TermWriter, values: _Pair, written: Expr, right: Expr) -> bool:
    """Whether the one function stands in the answer and the other in what was expected.

    The ring may hold cos θ₂ in sines and cosines of θ₁ and θ₁ + θ₂; that these become
    something else is no slip that anybody makes.
    """
    return _holds(words.form(values.mine), words.form(written)) and _holds(
        words.form(values.expected), words.form(right)
    )


def _holds(node: Node, part: Node) -> bool:
    return part in walk(node)


def _symbols(graph: AnswerGraph, words: TermWriter, values: _Pair) -> Iterator[Diagnosis]:
    """One parameter for another throughout, or two exchanged."""
    ring, mine, expected = values.ring, values.mine, values.expected
    parameters = [
        g for g in ring.generators
        if g.kind in ("symbol", "function") and not g.dots and g.name not in ring.names and g.name != "pi"
    ]  # fmt: skip
    have, wanted = set(_used(mine)), set(_used(expected))
    changed = (mine - expected).poly.monoms()
    for g in parameters:
        number = _number_for(g, mine, expected) if g.index in wanted - have else None
        if number is not None and values.becomes({g.index: ring.constant(number).poly}):
            text = words.of(ring.constant(number))
            yield slip("symbol", yours=words.of(mine), part=text, other=words.generator(g))
    for name in [g for g in parameters if g.index in wanted]:
        yield from _symbol(words, name, parameters, values, (have, wanted), changed)


def _number_for(g: Generator, mine: Expr, expected: Expr) -> Fraction | None:
    """The number that may stand for a symbol of first degree: told by the first term that holds it."""
    ours = mine.poly.to_dict()
    for exponents, value in expected.poly.to_dict().items():
        if exponents[g.index] == 1:
            bare = (*exponents[: g.index], 0, *exponents[g.index + 1 :])
            number = fraction(ours[bare] / value) if bare in ours else None
            return None if number in (None, 1, -1) else number
    return None


def _symbol(
    words: TermWriter,
    a: Generator,
    parameters: Sequence[Generator],
    values: _Pair,
    used: tuple[set[int], set[int]],
    changed: Sequence[Sequence[int]],
) -> Iterator[Diagnosis]:
    """Another parameter for `a`, or the two exchanged: every term that differs must hold one of them."""
    ring, mine = values.ring, values.mine
    have, wanted = used
    for b in parameters:
        if b is a or not all(m[a.index] or m[b.index] for m in changed):
            continue
        x, y = ring.generator(a.index), ring.generator(b.index)
        if a.index not in have and b.index in have and values.becomes({a.index: y.poly}):
            if b.kind == "function":
                yield slip("odd_argument", yours=words.of(mine))
            elif words.is_unknown(b):
                yield slip("unknown_symbol", part=words.generator(b))
            else:
                yield slip("symbol", yours=words.of(mine), part=words.generator(b), other=words.generator(a))
        both = {a.index: y.poly, b.index: x.poly}
        if a.index < b.index and {a.index, b.index} <= have & wanted and values.becomes(both):
            yield slip("symbols_swapped", part=words.generator(a), other=words.generator(b))
