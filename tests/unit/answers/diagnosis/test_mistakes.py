"""One mistake in a right formula: it is seen, told once, and what is told mends it."""

from __future__ import annotations

import random
from collections import Counter
from functools import lru_cache

import pytest

from dynsolve.answers.verdict import Answer, JudgedAnswer, Place, Submission
from dynsolve.notation import tree
from dynsolve.notation.tree import Node, Number
from tests.unit.answers.diagnosis.mistakes import mended, mistakes, near, value
from tests.unit.answers.hands import checker, problem
from tests.unit.answers.test_generated import forms, graph

STEMS = ["in3140-rp", "planar-2r", "rp-vertical", "elbow-3r", "spherical-rrp", "cylindrical-rpp",
         "cartesian-pp", "planar-2r-remote", "box-cylinder-rod-sphere", "crustcrawler-2r"]  # fmt: skip
QUANTITIES = ["P2", "K2", "K", "L", "dLdqd1", "ddt2", "dLdq2", "tau1",
              "v2", "Jv", "D", "g", "Cqd"]  # fmt: skip
SEEDS = (1, 2)

NAMES_A_STEP = {
    "product_rule", "chain_rule", "slope_sign", "slope_missing", "body_missing", "rotation_missing",
    "translation_missing", "gravity_missing", "frame_origin", "parallel_axis_missing", "parallel_axis_twice",
    "lagrangian_sum", "not_rotated", "rotation_transposed", "frame_before", "spin_frame", "joint_columns",
    "prismatic_turns", "order", "convention", "offset", "twist_sign", "transposed", "rows_swapped",
    "christoffel_half", "christoffel_without_rates", "symbols_swapped",
}  # fmt: skip
"""What claims no formula."""

ONLY_SAYS_WHAT_DIFFERS = {
    "terms_differ",
    "terms_missing",
    "trig_part",
    "unknown_symbol",
    "constant_term",
    "number_for_letter",
}


@lru_cache(maxsize=512)
def read(stem: str, text: str) -> Node:
    """A formula of a message, as a student would write it."""
    answers = checker(stem).reader(f"answers:\n  K: {text}\n", "message.yaml").answers
    node = answers[0].node
    assert node is not None, text
    return node


def judged(stem: str, name: str, written: Node) -> JudgedAnswer:
    answer = Answer(graph(stem).answer(name), "", written, Place(1, 1), "", occurrence=(1, 0))
    return next(a for a in checker(stem)(Submission("", "", "", (answer,))).answers if a.given)


def with_mistake(stem: str, name: str, draw: random.Random) -> tuple[Node, Node, Node] | None:
    """(the answer with a mistake in one entry, this entry, what it should be)"""
    right = forms(stem)(name)
    rows = [list(row) for row in right.rows] if isinstance(right, tree.Matrix) else [[right]]
    places = [(i, j) for i, row in enumerate(rows) for j, entry in enumerate(row) if entry != Number(0)]
    if not places:
        return None
    i, j = draw.choice(places)
    entry = rows[i][j]
    robot = problem(stem).robot
    found = list(mistakes(entry, [*robot.ring.parameters, *robot.ring.names]))
    if not found:
        return None
    kind = draw.choice(sorted({kind for kind, _ in found}))
    rows[i][j] = wrong = draw.choice([node for k, node in found if k == kind])
    if name == "D":
        rows[j][i] = wrong
    written = tree.Matrix(tuple(map(tuple, rows))) if isinstance(right, tree.Matrix) else wrong
    return written, wrong, entry


@pytest.mark.parametrize("stem", STEMS)
def test_one_mistake_is_told_once_and_as_it_is(stem: str) -> None:
    told: Counter[str] = Counter()
    for name in (n for n in QUANTITIES if n in graph(stem).answer_ring.rules):
        draw = random.Random(f"{stem} {name} 4")
        made = with_mistake(stem, name, draw)
        if made is None:
            continue
        written, wrong, right = made
        found = judged(stem, name, written)
        if all(near(value(wrong, seed), value(right, seed)) for seed in SEEDS):
            assert found.verdict == "correct"
            continue
        if found.verdict == "correct":
            assert name in ("P2", "P"), name  # another zero of height
            continue
        slips = [d for d in found.diagnosis if d.code not in ("dimensions", "constant_term")]
        assert len(slips) <= 2, (name, [d.message for d in slips])
        told[str(len(slips))] += 1
        for seed in SEEDS:
            _is_true(stem, seed, wrong, right, [(d.code, d.message) for d in slips])
    assert told["1"] >= 0.9 * told.total() > 5


def _is_true(stem: str, seed: int, wrong: Node, right: Node, slips: list[tuple[str, str]]) -> None:
    """All that is told, put into the answer, gives what is right."""
    mine, wanted = value(wrong, seed), value(right, seed)
    if any(code in NAMES_A_STEP | ONLY_SAYS_WHAT_DIFFERS for code, _ in slips):
        return
    after = [mine]
    for _, message in slips:
        claims = mended(message, mine, seed, lambda text: read(stem, text))
        assert claims is not None, message
        after = [one + claim - mine for one in after for claim in claims]
    assert not slips or any(near(one, wanted) for one in after), slips


@pytest.mark.parametrize("stem", STEMS)
def test_the_right_formula_is_right(stem: str) -> None:
    for name in (n for n in QUANTITIES if n in graph(stem).answer_ring.rules):
        found = judged(stem, name, forms(stem)(name))
        assert (found.verdict, found.diagnosis) == ("correct", ())
