"""Figures of a course."""

from __future__ import annotations

import random
from math import sqrt
from pathlib import Path
from statistics import correlation, pstdev

import pytest

import dynsolve
from dynsolve.grading.cohort import Item, item_rest, queue
from dynsolve.grading.record import Record
from dynsolve.problem.reader import find

# -- what waits for a human: what a human has something to say to ------------------------------------


HALF_K2 = """answers:
  K1: I1zz*theta1'^2/2
  K2: m2*(L2'^2 + L2^2*theta1'^2)/4
  tau1: 0
"""
BODY_LOST = """answers:
  K: I1zz*theta1'^2/2
  dLdqd1: I1zz*theta1'
  tau1: I1zz*theta1''
"""


def test_a_whole_waits_in_its_parts_and_a_loss_where_it_costs_marks(tmp_path: Path) -> None:
    """K is wrong in its part K2, whose slip is told; dLdqd1 and tau1 lost a body, tau1 alone has marks."""
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "parts.yaml").write_text(HALF_K2)
    (tmp_path / "in" / "lost.yaml").write_text(BODY_LOST)
    (tmp_path / "set").mkdir()
    (tmp_path / "set" / "in3140-rp.yaml").write_text(find("in3140-rp").read_text())
    (tmp_path / "set" / "set.yaml").write_text("marks: {in3140-rp: {K: 4, tau1: 2}}\n")
    dynsolve.grade(tmp_path / "set", tmp_path / "in", tmp_path / "out", jobs=1)
    record = Record(tmp_path / "out")
    waits = queue(record, ("in3140-rp",))
    record.close()
    assert [(w.student, w.what, w.why) for w in waits] == [
        ("lost", "tau1", "follows, but body 2 is lost on the way")
    ]


# -- the corrected item-total correlation, by the two forms in which Nunnally and Bernstein give it --


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
