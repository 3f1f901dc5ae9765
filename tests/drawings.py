"""Random drawings of arms, as the text of problem files: what Hypothesis draws from.

Axes lie along the world's axes or across from y at angles of their own, so that every angle
between two of them is a number of degrees; their points are made of letters, so that they
come skew, parallel, intersecting and coincident.
"""

from __future__ import annotations

from hypothesis import strategies as st

_DIRECTIONS = ["[1, 0, 0]", "[0, 1, 0]", "[0, 0, 1]", "[-1, 0, 0]", "[0, -1, 0]", "[0, 0, -1]"]
_TILTED = ["[cos(30deg), 0, sin(30deg)]", "[1, 0, 1]", "[sin(60deg), 0, -cos(60deg)]"]
_LENGTHS = ["0", "0", "0", "A", "B", "-C", "A + D"]


@st.composite
def drawings(draw: st.DrawFn, max_joints: int = 4) -> str:
    """A problem file with 1 to `max_joints` joint axes, of either convention."""
    directions = st.sampled_from(_DIRECTIONS + draw(st.sampled_from([[], _TILTED])))
    count = draw(st.integers(1, max_joints))
    lines = [draw(_axes(i, directions)) for i in range(1, count + 1)]
    hand = draw(_points())
    z = draw(st.sampled_from(["", "", draw(directions)]))
    tip = f"{{at: {hand}, z: {z}}}" if z else hand
    convention, zero = (
        draw(st.sampled_from(["standard", "modified"])),
        draw(st.sampled_from(["table", "drawn"])),
    )
    return f"convention: {convention}\nzero: {zero}\naxes:\n" + "\n".join(lines) + f"\ntip: {tip}\n"


@st.composite
def _axes(draw: st.DrawFn, i: int, directions: st.SearchStrategy[str]) -> str:
    direction, point = draw(directions), draw(_points())
    if draw(st.sampled_from([True, True, False])):
        return f"  - {{turn: q{i}, about: {direction}, through: {point}}}"
    through = f", through: {point}" if draw(st.booleans()) else ""
    return f"  - {{slide: q{i}, along: {direction}{through}}}"


@st.composite
def _points(draw: st.DrawFn) -> str:
    length = st.sampled_from(_LENGTHS)
    return f"[{draw(length)}, {draw(length)}, {draw(length)}]"
