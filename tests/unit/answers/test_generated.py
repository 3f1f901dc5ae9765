"""Hand-ins whose truth is known: a slip is made in one answer and carried through all that come after it."""

from __future__ import annotations

import random
from functools import lru_cache

import pytest

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.answers.diagnosis.mends import parts
from dynsolve.answers.diagnosis.own_steps import ChangedDerivation
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.verdict import Answer, Place, Submission
from dynsolve.explain.forms import Forms
from tests.unit.answers.hands import checker, key, problem

STEMS = ["in3140-rp", "planar-2r", "spherical-rrp", "rp-vertical", "elbow-3r", "planar-2r-remote"]
START = ("rc", "v", "Kv", "Kw", "K", "P", "L", "dLdqd", "ddt", "dLdq", "tau")


def graph(stem: str) -> AnswerGraph:
    return checker(stem).graph


@lru_cache
def nodes(stem: str) -> tuple[str, ...]:
    """What a complete hand-in holds, C as its vector."""
    skipped = ("H0", "christoffel", "g_direct", "C")
    return tuple(n for n in graph(stem).answer_ring.rules if n not in skipped and not n.startswith("R"))


def spoilt(value: Expr | Matrix, draw: random.Random) -> Expr | Matrix | None:
    """The value with one term changed: its sign, a factor, or gone."""
    entries = list(value.entries) if isinstance(value, Matrix) else [value]
    places = [i for i, e in enumerate(entries) if not e.is_zero]
    if not places:
        return None
    place = draw.choice(places)
    part = draw.choice(list(parts(entries[place]).values()))
    entries[place] = entries[place] - part * draw.choice([2, 1, -1, 3])
    if not isinstance(value, Matrix):
        return entries[0]
    width = value.shape[1]
    return Matrix.of(value.ring, (entries[i : i + width] for i in range(0, len(entries), width)))


@lru_cache
def forms(stem: str) -> Forms:
    return Forms(problem(stem).robot, key(stem))


@pytest.mark.parametrize("seed", range(60))
def test_a_slip_is_found_and_what_comes_after_it_follows(seed: int) -> None:
    draw = random.Random(seed)
    stem = draw.choice(STEMS)
    g = graph(stem)
    start = draw.choice([n for n in nodes(stem) if n.rstrip("0123456789") in START])
    wrong = spoilt(g.key(start), draw)
    if wrong is None:
        return
    carried = ChangedDerivation(g, {start: wrong})
    handed = [n for n in nodes(stem) if n == start or draw.random() < 0.7]
    answers = tuple(
        Answer(g.answer(n), "", forms(stem).of(carried(n)), Place(i + 1, 1), "", occurrence=(i, 0))
        for i, n in enumerate(handed)
    )
    report = checker(stem)(Submission("", "", "", answers))
    found = {g.node(a.name): a for a in report.answers if a.given}
    constant = start == "P" or (start[0] == "P" and start[1:].isdigit())
    for n in handed:
        same = _same(carried(n), g.key(n))
        if n == start:
            if not constant:
                assert (found[n].verdict, n) == ("wrong", n)
                assert found[n].diagnosis, n
        elif same:
            assert (str(found[n].verdict), n) == ("correct", n)
        elif not constant:
            assert (str(found[n].verdict), n) == ("follows", n)
            assert found[n].follows_from


def _same(a: Expr | Matrix, b: Expr | Matrix) -> bool:
    if isinstance(a, Matrix) and isinstance(b, Matrix):
        return a.entries == b.entries
    return bool(a == b)


@pytest.mark.parametrize("stem", STEMS)
def test_the_key_is_correct_in_every_name(stem: str) -> None:
    g = graph(stem)
    answers = tuple(
        Answer(g.answer(n), "", forms(stem).of(g.key(n)), Place(i + 1, 1), "", occurrence=(i, 0))
        for i, n in enumerate(nodes(stem))
    )
    report = checker(stem)(Submission("", "", "", answers))
    assert [a.name for a in report.answers if a.given and (a.verdict != "correct" or a.notes)] == []


@pytest.mark.parametrize("seed", range(60))
def test_two_slips_are_two_and_all_else_follows(seed: int) -> None:
    draw = random.Random(1000 + seed)
    stem = draw.choice(STEMS[:4])
    g = graph(stem)
    heads = [n for n in nodes(stem) if n.rstrip("0123456789") in START and n[0] != "P"]
    first, second = sorted(draw.sample(heads, 2), key=g.quantities.position)
    wrong = spoilt(g.key(first), draw)
    if wrong is None:
        return
    worse = spoilt(ChangedDerivation(g, {first: wrong})(second), draw)
    if worse is None or _same(worse, g.key(second)):
        return
    carried = ChangedDerivation(g, {first: wrong, second: worse})
    answers = tuple(
        Answer(g.answer(n), "", forms(stem).of(carried(n)), Place(i + 1, 1), "", occurrence=(i, 0))
        for i, n in enumerate(nodes(stem))
    )
    report = checker(stem)(Submission("", "", "", answers))
    for found in report.answers:
        if not found.given:
            continue
        n = g.node(found.name)
        if n in (first, second):
            assert (found.verdict, n) == ("wrong", n)
        elif _same(carried(n), g.key(n)):
            assert (found.verdict, n) == ("correct", n)
        else:
            assert (found.verdict, n) == ("follows", n)
