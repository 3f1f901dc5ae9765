"""The corrected item-total correlation, by the two forms in which Nunnally and Bernstein give it."""

from __future__ import annotations

import random
from math import sqrt
from statistics import correlation, pstdev

import pytest

from dynsolve.grading.cohort import Item, item_rest


def _by_the_corrected_form(marks: list[float], totals: list[float]) -> float:
    """(r_xt s_t - s_x) / sqrt(s_x^2 + s_t^2 - 2 r_xt s_x s_t)."""
    r, s_x, s_t = correlation(marks, totals), pstdev(marks), pstdev(totals)
    return (r * s_t - s_x) / sqrt(s_x**2 + s_t**2 - 2 * r * s_x * s_t)


def test_it_is_what_the_corrected_form_gives() -> None:
    chance = random.Random(1)
    for count in (3, 4, 30):
        marks = [chance.choice((0, 1, 2.5, 4)) for _ in range(count - 1)] + [3.0]
        totals = [mark + chance.random() * 20 for mark in marks]
        assert item_rest(marks, totals) == pytest.approx(_by_the_corrected_form(marks, totals))


@pytest.mark.parametrize(
    ("marks", "totals", "r"),
    [
        ([0, 1, 2], [0, 2, 4], 1.0),
        ([2, 1, 0], [2, 2, 2], -1.0),
        ([0, 2, 1], [1, 4, 4], 0.5),
        ([1, 1, 1], [1, 2, 3], None),  # all have the same marks
        ([1, 2, 3], [2, 3, 4], None),  # all have the same rest
        ([0.1, 0.2, 0.3], [0.4, 0.5, 0.6], None),  # the same rest, but for what floats lose
        ([0, 1], [0, 2], None),  # two students always lie on a line
        ([], [], None),
    ],
)
def test_there_is_no_figure_where_it_means_nothing(
    marks: list[float], totals: list[float], r: float | None
) -> None:
    found = item_rest(marks, totals)
    assert found is None if r is None else found == pytest.approx(r)


def test_who_waits_for_a_human_has_a_mark_and_no_total() -> None:
    item = Item(4)
    assert (item.mean, item.share_correct, item.item_rest) == (None, None, None)
    for marks, total, correct in ((4, 10, True), (0, 2, False), (2, None, False), (4, 9, True)):
        item.add(marks, total, correct)
    assert (item.mean, item.share_correct) == (2.5, 0.5)
    assert item.item_rest == item_rest([4, 0, 4], [10, 2, 9])
