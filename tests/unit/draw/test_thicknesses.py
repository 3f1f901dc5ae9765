"""The thickness of uniform bodies in a picture: two arrows that point at each other, with its letter."""

from __future__ import annotations

import math
from itertools import combinations

import pytest

from dynsolve.draw.paths import BLACK, flattened
from dynsolve.draw.pose_search import LARGEST
from dynsolve.draw.scene import Scene
from tests.unit.draw.pictures import drawn_text, names

ARM = """
dh: [{{theta: q1*, a: a1}}]
values: {{a1: 1}}
masses: [{{mass: m1, link: 1, center: midpoint, shape: {shape}}}]
"""


@pytest.mark.parametrize(
    ("shape", "written"),
    [
        ("{box: {x: a1, y: w, z: t}}", {"w"}),
        ("{cylinder: {radius: R, length: a1, axis: x}}", {"2R"}),
        ("{hollow_cylinder: {outer: R, inner: r, length: a1, axis: x}}", {"2R"}),
        ("{disk: {radius: r}}", {"2r"}),
        ("{sphere: {radius: r}}", {"2r"}),
        ("{rod: {length: a1, axis: x}}", set()),
    ],
)
def test_what_is_written(shape: str, written: set[str]) -> None:
    """Across a body, what is seen of it: not the side of a box towards the viewer, and of radii the outer."""
    assert set(names(drawn_text(ARM.format(shape=shape)), "length")) - {"a1", "a₁"} == written


def gaps(picture: Scene) -> list[float]:
    """The distances between the tips of black arrows."""
    found = (path for path in picture.paths if path.fill == BLACK and path.stroke is None)
    tips = [next(flattened(path.commands))[0] for path in found]
    return [math.dist(a, b) for a, b in combinations(tips, 2)]


def test_the_arrows_stand_as_far_apart_as_the_body_is_thick() -> None:
    """A box of a fifth of the longest length, which takes no more than it may on paper."""
    thick, bare = (
        gaps(drawn_text(ARM.format(shape=shape)))
        for shape in ("{box: {x: a1, y: 0.2, z: t}}", "{rod: {length: a1, axis: x}}")
    )
    across = pytest.approx(0.2 * LARGEST, rel=0.01)
    assert across in thick
    assert across not in bare
