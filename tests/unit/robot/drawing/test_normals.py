"""Two axes that follow each other: how they lie, what is chosen, and the row that comes of it."""

from __future__ import annotations

import pytest

from dynsolve.notation.printing import Style
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem import Problem, read_problem

STARRED = Style(star=True)


def read(text: str) -> Problem:
    return read_problem(text, "drawn.yaml")


def table(text: str) -> list[str]:
    """The rows of a file's table, a text each: θ d a α."""
    rows = [joint.written for joint in read(text).robot.joints]
    return [" ".join(to_unicode(cell, STARRED).replace(" ", "") for cell in row) for row in rows]


def drawn(axes: str, tip: str, more: str = "zero: drawn") -> str:
    return f"axes:\n{axes}tip: {tip}\n{more}\n"


def then(about: str, through: str) -> str:
    """A vertical axis at the origin, and another."""
    first = "  - {turn: q1, about: [0, 0, 1], through: [0, 0, 0]}\n"
    return f"{first}  - {{turn: q2, about: {about}, through: {through}}}\n"


RELATIONS = {
    "a skew pair": ("[0, 1, 0]", "[B, 0, A]", "skew", "q₁⋆ A B -90°"),
    "a skew pair seen from behind": (
        "[0, 1, 0]",
        "[-B, 0, A]",
        "skew",
        "q₁⋆+180° A B 90°",
    ),
    "an intersecting pair": (
        "[0, cos(30deg), sin(30deg)]",
        "[0, 0, A]",
        "intersecting",
        "q₁⋆ A 0 -60°",
    ),
    "a symbolic angle": (
        "[0, sin(beta), cos(beta)]",
        "[0, 0, A]",
        "intersecting",
        "q₁⋆ A 0 -β",
    ),
    "a direction of any length": (
        "[0, -2, 2]",
        "[0, 0, A]",
        "intersecting",
        "q₁⋆ A 0 45°",
    ),
    "a parallel pair": ("[0, 0, 1]", "[0, B, A]", "parallel", "q₁⋆+90° 0 B 0"),
    "an opposite pair": ("[0, 0, -1]", "[B, 0, A]", "parallel", "q₁⋆ 0 B 180°"),
    "a pair on one line": ("[0, 0, 1]", "[0, 0, A]", "coincident", "q₁⋆ 0 0 0"),
    "letters that could be equal": (
        "[0, 1, 0]",
        "[B - C, 0, 0]",
        "skew",
        "q₁⋆ 0 B-C -90°",
    ),
}


@pytest.mark.parametrize(("about", "through", "relation", "row"), RELATIONS.values(), ids=RELATIONS)
def test_two_axes_lie_in_one_of_four_ways(about: str, through: str, relation: str, row: str) -> None:
    text = drawn(then(about, through), f"{{at: {through}, z: {about}}}")
    normals = read(text).normals
    assert normals is not None and normals.all[1].relation.value == relation
    assert table(text)[0] == row


def test_a_length_may_be_the_root_of_letters() -> None:
    axes = then("[0, 0, 1]", "[B, C, 0]")
    assert table(drawn(axes, "[B, C, A]", "zero: table")) == ["q₁⋆ 0 √(B²+C²) 0", "q₂⋆ A 0 0"]


def test_a_length_may_be_the_root_of_numbers() -> None:
    axes = then("[0, 0, 1]", "[2, 1, 0]")
    assert table(drawn(axes, "[2, 1, A]", "zero: table")) == ["q₁⋆ 0 √5 0", "q₂⋆ A 0 0"]


def test_frame_0_is_moved_and_turned_where_the_first_axis_is_not_the_worlds() -> None:
    robot = read(drawn("  - {turn: q1, about: [0, -1, 0], through: [B, 0, h]}\n", "[B + l, 0, h]")).robot
    ring = robot.ring
    assert robot.base_position.entries == (ring.symbol("B"), ring.zero, ring.symbol("h"))
    assert [entry.number for entry in robot.base_rotation.entries] == [1, 0, 0, 0, 0, -1, 0, 1, 0]


def test_the_hands_own_axes_may_take_a_row_more() -> None:
    hand = "{at: [l1 + l2, 0, 0], z: [1, 0, 0], x: [0, 0, 1]}"
    assert table(drawn(then("[0, 0, 1]", "[l1, 0, 0]"), hand)) == [
        "q₁⋆ 0 l₁ 0",
        "q₂⋆+90° 0 0 90°",
        "90° l₂ 0 0",
    ]
