"""Verdicts on matrices as a report says them."""

from __future__ import annotations

import pytest

from dynsolve.answers.reading.asides import spoken_verdicts
from dynsolve.answers.reading.sources import Source
from tests.unit.answers.reading.submissions import report

SAID = [
    ("definite: Ma no, Mb yes", "Ma no, Mb yes"),
    ("- Ma: no\n- Mb: yes\n", "Ma no, Mb yes"),
    ("$M_a$: no, its determinant is negative\n\n$M_b(q)$: Yes.", "Ma no, Mb yes"),
    ("| $M_a$ | no |\n|---|---|\n| $M_b$ | yes |", "Ma no, Mb yes"),
    (
        "\\item $\\mathbf{M}_a$ cannot be an inertia matrix\n\\item $M_{b}$ is positive definite",
        "Ma no, Mb yes",
    ),
    ("M_a is not an inertia matrix, M_b is one only if a1 > 0: M_b: if a1 > 0", "Ma no, Mb if"),
    ("M_a is symmetric, M_b as well", ""),
    ("definite: yes", ""),
]


@pytest.mark.parametrize(("text", "expected"), SAID)
def test_what_is_said_behind_a_name(text: str, expected: str) -> None:
    found, rest = spoken_verdicts(("Ma", "Mb"), Source(text, "report.md"), text)
    assert ", ".join(f"{name} {word}" for one in found for name, word in one.words) == expected
    assert len(rest) == len(text)
    assert bool(found) == (rest != text)


def test_of_one_matrix_the_head_is_enough() -> None:
    found = report("**definite:** yes\n\n$$C = 0$$", stem="pr-factorizations")
    assert [one.words for one in found.verdicts] == [(("", "yes"),)]
    assert [answer.name for answer in found.answers] == ["C"]


def test_the_name_of_a_set_is_the_left_side_of_no_formula() -> None:
    assert report(r"$$\text{definite} = a_1$$", stem="pr-factorizations").answers == ()
