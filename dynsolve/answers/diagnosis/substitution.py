"""Slips that run through one whole expression: one symbol, angle or function for another."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import permutations
from typing import Any

from flint import fmpq

from dynsolve.algebra.generators import Generator
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.answers.diagnosis.mends import Exchange, Mend, Redoing, Renaming
from dynsolve.answers.diagnosis.slips import slip
from dynsolve.answers.diagnosis.wrong_entry import TermWriter
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.verdict import Diagnosis
from dynsolve.notation.tree import Node, walk

MOST_TERMS = 400


Found = tuple[Diagnosis, Mend]


class _Pair:
    """What differs of an answer and of what was expected; `becomes` tells what leads to the answer.

    `right` are the generators in what does not differ.

    Most substitutions do not, which a look at one point tells: sines and cosines are rational
    points of a circle there, so that what is equal in the ring is equal at the point.
    """

    def __init__(self, mine: Expr, expected: Expr, whole: bool = False) -> None:
        pair = (mine, expected) if whole else (_differing(mine, expected), _differing(expected, mine))
        self.mine, self.expected = pair
        self.right = {*(mine - self.mine).used}
        self.ring = mine.ring
        kinds = {self.ring.generators[i].kind for i in (*self.mine.used, *self.expected.used)}
        self.point = _point(self.ring) if kinds <= {"symbol", "sin", "cos"} else []
        self.value = self.mine.poly(*self.point) if self.point else None

    def becomes(self, images: dict[int, Any]) -> bool:
        """Whether the answer is what was expected with polynomials for some generators."""
        if self.point:
            moved = [images[i](*self.point) if i in images else x for i, x in enumerate(self.point)]
            if self.expected.poly(*moved) != self.value:
                return False
        return self.expected.ring.put(self.expected, images) == self.mine

    def back(self, images: dict[int, Any]) -> Renaming:
        """The mend that puts polynomials for generators of the answer."""
        return Renaming(self.mine, images)


def _differing(a: Expr, b: Expr) -> Expr:
    there = b.poly.to_dict() if b.poly else {}
    kept = {e: v for e, v in a.poly.to_dict().items() if there.get(e) != v} if a.poly else {}
    return Expr(a.ring, a.ring.ctx.from_dict(kept))


def _point(ring: Ring) -> list[fmpq]:
    """A rational point on every circle sin² + cos² = 1."""
    point = [fmpq(7 * i + 3) for i in range(len(ring.generators))]
    for k, pair in enumerate(ring.pairs):
        t = fmpq(k + 2, k + 5)
        point[pair.sine], point[pair.cosine] = 2 * t / (1 + t * t), (1 - t * t) / (1 + t * t)
    return point


def substitutions(graph: AnswerGraph, words: TermWriter, mine: Expr, expected: Expr) -> Iterator[Found]:
    """The substitutions that turn what was expected into the answer, each with its mend."""
    if max(len(mine), len(expected)) > MOST_TERMS or expected.is_zero:
        return
    pair = _Pair(mine, expected)
    yield from _gravity(graph, pair)
    if mine.is_zero:
        return
    yield from _angles(words, pair)
    yield from _symbols(words, pair)


def _gravity(graph: AnswerGraph, values: _Pair) -> Iterator[Found]:
    ring, expected = values.ring, values.expected
    """The sign of gravity in all terms that have it, or none of them."""
    strength = {i for entry in graph.robot.gravity.entries for i in entry.used}
    for index in sorted(i for i in strength if ring.generators[i].kind == "symbol"):
        if index not in set(expected.used) or index in values.right:
            continue
        turned = {index: -ring.generator(index).poly}
        if values.becomes(turned):
            yield slip("gravity_sign"), values.back(turned)
        elif values.becomes({index: ring.zero.poly}):
            yield slip("gravity_missing"), Exchange(expected - values.mine, ring.zero, ring.one)


def _angles(words: TermWriter, values: _Pair) -> Iterator[Found]:
    """An angle for another throughout, or sine and cosine of one exchanged."""
    ring, here = values.ring, {*values.expected.used}
    for pair in ring.pairs:
        if not here & {pair.sine, pair.cosine}:
            continue
        s, c = ring.generator(pair.sine), ring.generator(pair.cosine)
        turned = {pair.sine: c.poly, pair.cosine: s.poly}
        if values.becomes(turned):
            written, right = (c, s) if pair.sine in here else (s, c)
            yield from _told(words, values, ("sin_for_cos", written, right), turned)
        for other in ring.pairs:
            t, d = ring.generator(other.sine), ring.generator(other.cosine)
            if other is not pair and values.becomes({pair.sine: t.poly, pair.cosine: d.poly}):
                product = any(len(atom) > 1 for atom, _ in other.angle.terms)
                written, right = (d, c) if pair.cosine in here else (t, s)
                back = {other.sine: s.poly, other.cosine: c.poly}
                yield from _told(
                    words, values, ("angle_product" if product else "angle", written, right), back
                )


def _told(
    words: TermWriter, values: _Pair, what: tuple[str, Expr, Expr], back: dict[int, Any]
) -> Iterator[Found]:
    code, written, right = what
    if _is_seen(words, values, written, right):
        text = slip(code, yours=words.of(values.mine), part=words.of(written), other=words.of(right))
        yield text, values.back(back)


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


def _symbols(words: TermWriter, values: _Pair) -> Iterator[Found]:
    """One parameter for another throughout, or two exchanged."""
    mine, expected, parameters = values.mine, values.expected, _parameters(values.ring)
    have, wanted = {*mine.used}, {*expected.used}
    changed = (mine - expected).poly.monoms()
    for a, b in permutations(parameters, 2):
        if a.index in wanted and b.index in have and all(m[a.index] or m[b.index] for m in changed):
            yield from _symbol(words, a, b, values)


def throughout(words: TermWriter, mine: Expr, expected: Expr) -> Iterator[Found]:
    """One parameter for another everywhere, also where the other stands rightly."""
    if max(len(mine), len(expected)) > MOST_TERMS:
        return
    values, have, wanted = _Pair(mine, expected, whole=True), {*mine.used}, {*expected.used}
    for a, b in permutations(_parameters(values.ring), 2):
        is_gone = a.index in wanted - have and b.index in have & wanted
        if is_gone and values.becomes({a.index: values.ring.generator(b.index).poly}):
            told = slip("symbol_throughout", part=words.generator(b), other=words.generator(a))
            yield told, Redoing(mine, expected)


def _parameters(ring: Ring) -> list[Generator]:
    return [
        g for g in ring.generators
        if g.kind in ("symbol", "function") and not g.dots and g.name not in ring.names and g.name != "pi"
    ]  # fmt: skip


def _symbol(words: TermWriter, a: Generator, b: Generator, values: _Pair) -> Iterator[Found]:
    """Another parameter b for `a`, or the two exchanged."""
    ring, mine = values.ring, values.mine
    x, y = ring.generator(a.index), ring.generator(b.index)
    if values.becomes({a.index: y.poly}):
        yours = words.of(mine)
        if words.is_unknown(b):
            is_function = b.kind == "function"
            unknown = slip("unknown_symbol", part=words.generator(b))
            told = slip("odd_argument", yours=yours) if is_function else unknown
        else:
            told = slip("symbol", yours=yours, part=words.generator(b), other=words.generator(a))
        yield told, values.back({b.index: x.poly})
    both = {a.index: y.poly, b.index: x.poly}
    if a.index < b.index and values.becomes(both):
        yield slip("symbols_swapped", part=words.generator(a), other=words.generator(b)), values.back(both)
