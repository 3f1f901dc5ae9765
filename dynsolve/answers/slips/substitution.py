"""Slips that run through one whole expression: one symbol, angle or function for another."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.expr import Expr, Generator
from dynsolve.answers.graph import Graph
from dynsolve.answers.needs import is_opaque
from dynsolve.answers.slips.table import slip
from dynsolve.answers.slips.words import Words
from dynsolve.answers.verdict import Diagnosis

MOST_TERMS = 400


def substitutions(graph: Graph, words: Words, mine: Expr, expected: Expr) -> Iterator[Diagnosis]:
    """The substitutions that turn what was expected into the answer."""
    if max(len(mine), len(expected)) > MOST_TERMS or mine.is_zero or expected.is_zero:
        return
    yield from _gravity(graph, mine, expected)
    yield from _angles(graph, words, mine, expected)
    yield from _symbols(graph, words, mine, expected)


def _put(expr: Expr, images: dict[int, Any]) -> Expr:
    ring = expr.ring
    point = [images.get(i, g) for i, g in enumerate(ring.ctx.gens())]
    return Expr(ring, ring.reduce(expr.poly.compose(*point, ctx=ring.ctx)))


def _used(expr: Expr) -> list[int]:
    return [i for i, degree in enumerate(expr.poly.degrees()) if degree > 0]


def _gravity(graph: Graph, mine: Expr, expected: Expr) -> Iterator[Diagnosis]:
    ring = graph.field.ring
    strength = {i for entry in graph.robot.gravity.entries if entry.poly for i in _used(entry)}
    symbols = [i for i in strength if ring.generators[i].kind == "symbol"]
    for index in symbols:
        without = _put(expected, {index: ring.zero.poly})
        if without != expected and mine == _put(expected, {index: -ring.generator(index).poly}):
            yield slip("gravity_sign")
        elif without != expected and mine == without:
            yield slip("gravity_missing")


def _angles(graph: Graph, words: Words, mine: Expr, expected: Expr) -> Iterator[Diagnosis]:
    """An angle for another throughout, or sine and cosine of one exchanged."""
    ring = graph.field.ring
    used = set(_used(expected))
    angles = [*(pair.angle for pair in ring.pairs), *(Angle.of(n) for n in ring.names)]
    for pair in ring.pairs:
        if not used & {pair.sine, pair.cosine}:
            continue
        s, c = ring.generator(pair.sine), ring.generator(pair.cosine)
        if _put(expected, {pair.sine: c.poly, pair.cosine: s.poly}) == mine:
            yield _function(words, expected, s, c)
        for angle in dict.fromkeys(angles):
            if angle == pair.angle:
                continue
            try:
                images = {pair.sine: ring.sin(angle).poly, pair.cosine: ring.cos(angle).poly}
            except Exception:  # noqa: BLE001, S112  an angle that the ring does not hold
                continue
            if _put(expected, images) == mine:
                product = any(len(atom) > 1 for atom, _ in angle.terms)
                function = "cos" if pair.cosine in used else "sin"
                right = c if function == "cos" else s
                written = ring.cos(angle) if function == "cos" else ring.sin(angle)
                yield slip(
                    "angle_product" if product else "angle",
                    yours=words.of(mine), part=words.of(written), other=words.of(right),
                )  # fmt: skip


def _function(words: Words, expected: Expr, s: Expr, c: Expr) -> Diagnosis:
    degrees = expected.poly.degrees()
    sine = degrees[_used(s)[0]] > 0
    written, right = (c, s) if sine else (s, c)
    return slip("sin_for_cos", yours="your answer", part=words.of(written), other=words.of(right))


def _symbols(graph: Graph, words: Words, mine: Expr, expected: Expr) -> Iterator[Diagnosis]:
    """One parameter for another throughout, or two exchanged."""
    ring = graph.field.ring
    parameters = [
        g for g in ring.generators
        if g.kind == "symbol" and not g.dots and g.name not in ring.names and g.name != "pi"
    ]  # fmt: skip
    have, wanted = set(_used(mine)), set(_used(expected))
    changed = (mine - expected).poly.monoms()
    for name in [g for g in parameters if g.index in wanted]:
        yield from _symbol(words, name, parameters, (mine, expected), (have, wanted), changed)


def _symbol(
    words: Words,
    a: Generator,
    parameters: Sequence[Generator],
    values: tuple[Expr, Expr],
    used: tuple[set[int], set[int]],
    changed: Sequence[Sequence[int]],
) -> Iterator[Diagnosis]:
    """Another parameter for `a`, or the two exchanged: every term that differs must hold one of them."""
    (mine, expected), (have, wanted) = values, used
    ring = mine.ring
    for b in parameters:
        if b is a or not all(m[a.index] or m[b.index] for m in changed):
            continue
        x, y = ring.generator(a.index), ring.generator(b.index)
        if a.index not in have and b.index in have and _put(expected, {a.index: y.poly}) == mine:
            if is_opaque(b.name):
                yield slip("odd_argument", yours=words.of(mine))
            elif words.is_unknown(b):
                yield slip("unknown_symbol", part=words.generator(b))
            else:
                yield slip("symbol", yours=words.of(mine), part=words.generator(b), other=words.generator(a))
        both = {a.index: y.poly, b.index: x.poly}
        if a.index < b.index and {a.index, b.index} <= have & wanted and _put(expected, both) == mine:
            yield slip("symbols_swapped", part=words.generator(a), other=words.generator(b))
