"""Random robots, as the text of problem files: what Hypothesis draws from.

Every robot drawn is valid.  With `physical`, its moments of inertia about the
mass centres are positive, so that D is positive semidefinite whatever is drawn.
"""

from __future__ import annotations

from dataclasses import dataclass

from hypothesis import strategies as st

ODD = ["17deg", "30deg", "45deg", "60deg", "beta"]
"""Constant angles that are no multiple of 90 degrees; a robot gets at most two of them."""


@dataclass(frozen=True)
class DrawnRow:
    """A row of the table, with what the bodies on it must know."""

    text: str
    kind: str  # "revolute", "prismatic" or "fixed"


@st.composite
def robots(draw: st.DrawFn, max_joints: int = 4, physical: bool = False) -> str:
    """A problem file of 1 to `max_joints` moving rows, of either convention."""
    modified = draw(st.booleans())
    odd = draw(st.lists(st.sampled_from(ODD), max_size=2, unique=True))
    rows = draw(_tables(odd, max_joints))
    links = draw(st.lists(st.integers(1, len(rows)), min_size=1, max_size=3))
    bodies = [
        draw(_bodies(place, link, rows, modified, odd, physical))
        for place, link in enumerate(sorted(links), start=1)
    ]
    lines = ["title: random"]
    lines += ["convention: modified"] if modified else draw(st.sampled_from([[], ["convention: standard"]]))
    lines += draw(_settings(odd))
    lines += ["dh:", *(f"  - {row.text}" for row in rows), "masses:", *(f"  - {body}" for body in bodies)]
    return "\n".join(lines) + "\n"


@st.composite
def _settings(draw: st.DrawFn, odd: list[str]) -> list[str]:
    gravity = draw(st.sampled_from(["", "[0, 0, -g]", "[0, -g, 0]", "[g/2, 0, -9.81]", "none"]))
    turns = ["", "Rx(90deg)", "Rz(90deg) Rx(90deg)", *(f"Ry({angle})" for angle in odd)]
    base = draw(st.sampled_from(turns))
    if base and draw(st.booleans()):
        base = f"{{rotate: {base}, move: [0, h0/2, h0]}}"
    return [f"gravity: {gravity}"] * bool(gravity) + [f"base: {base}"] * bool(base)


@st.composite
def _tables(draw: st.DrawFn, odd: list[str], max_joints: int) -> list[DrawnRow]:
    kind = st.sampled_from(["revolute", "revolute", "prismatic", "fixed"])
    count = draw(st.integers(1, max_joints))
    kinds = draw(st.lists(kind, min_size=count, max_size=count).filter(lambda kinds: set(kinds) != {"fixed"}))
    letters = draw(st.sampled_from([("q", "q"), ("theta", "d"), ("θ", "L")]))
    angles = st.sampled_from(["0", "0", "90deg", "-90deg", "180deg", *odd])
    coordinates: dict[str, list[str]] = {"revolute": [], "prismatic": []}
    rows = []
    for i, kind in enumerate(kinds, start=1):
        cells = {
            "theta": draw(angles),
            "d": draw(_lengths(f"h{i}")),
            "a": draw(_lengths(f"a{i}")),
            "alpha": draw(angles),
        }
        if kind != "fixed":
            column, letter = ("theta", letters[0]) if kind == "revolute" else ("d", letters[1])
            variable = draw(_variables(f"{letter}{i}", coordinates[kind]))
            constant = cells[column]
            cells[column] = variable if constant == "0" else f"{variable} + {constant}".replace("+ -", "- ")
        rows.append(DrawnRow("{" + ", ".join(f"{key}: {text}" for key, text in cells.items()) + "}", kind))
    return rows


def _lengths(symbol: str) -> st.SearchStrategy[str]:
    return st.sampled_from(["0", "0", symbol, f"-{symbol}", f"{symbol}/2", "0.35", "2/3"])


@st.composite
def _variables(draw: st.DrawFn, name: str, before: list[str]) -> str:
    """A joint variable: mostly the row's own coordinate, sometimes with one of an earlier row of its kind."""
    forms = ["{own}*"] * 5 + ["-{own}*"]
    if before:
        forms += ["{own}* - {other}*", "{own}* + {other}*", "{own}* - {other}*/2"]
    text = draw(st.sampled_from(forms)).format(own=name, other=draw(st.sampled_from(before or [name])))
    before.append(name)
    return text


@st.composite
def _bodies(
    draw: st.DrawFn,
    place: int,
    link: int,
    rows: list[DrawnRow],
    modified: bool,
    odd: list[str],
    physical: bool,
) -> str:
    fixed_near = modified or rows[link - 1].kind != "prismatic"
    has_tip = not modified or (link < len(rows) and rows[link].kind != "prismatic")
    mass = draw(st.sampled_from([f"m{place}", f"m{place}", "1.5", f"2*m{place}"]))
    parts = [f"mass: {mass}", f"link: {link}"]
    centers = [
        "origin",
        f"[x{place}, 0, 0]",
        f"[x{place}, y{place}, z{place}]",
        "[0.1, -1/5, 0]",
        "[0, 0.1, 0]",
    ]
    if has_tip:
        centers.append("tip")
    if fixed_near:
        centers.append(f"{{near: [lc{place}, 0, 0]}}")
    if fixed_near and has_tip:
        centers += ["midpoint", "{along: 1/3}", f"{{along: k{place}}}"]
    parts.append(f"center: {draw(st.sampled_from(centers))}")
    extent = draw(_extents(place))
    if extent:
        parts += [extent, draw(_orientations(odd))]
        if (
            "inertia" in extent and not physical
        ):  # a tensor about another point may be anything at the mass centre
            abouts = ["", "", "about: center", "about: origin"] + ["about: joint"] * fixed_near
            parts.append(draw(st.sampled_from(abouts)))
    return "{" + ", ".join(part for part in parts if part) + "}"


def _extents(place: int) -> st.SearchStrategy[str]:
    """A tensor or a shape; empty for a point."""
    I, axis = f"I{place}", st.sampled_from("xyz")  # noqa: E741
    tensors = st.sampled_from([
        f"inertia: {{zz: {I}}}",
        f"inertia: {{xx: {I}xx, yy: {I}yy, zz: {I}zz}}",
        "inertia: {xx: 0.9, yy: 1.2, zz: 0.7, xy: -0.1, xz: 0.05, yz: 0.2}",
        f"inertia: [[3*{I}, -{I}/4, 0], [-{I}/4, 2*{I}, {I}/5], [0, {I}/5, 3*{I}]]",
    ])  # fmt: skip
    shapes = st.one_of(
        st.just(f"box: {{x: b{place}, y: 0.2, z: 2*b{place}}}"),
        axis.map(lambda axis: f"cylinder: {{radius: r{place}, length: 0.6, axis: {axis}}}"),
        axis.map(lambda axis: f"hollow_cylinder: {{outer: 0.3, inner: 0.1, length: r{place}, axis: {axis}}}"),
        axis.map(lambda axis: f"rod: {{length: r{place}, axis: {axis}}}"),
        axis.map(lambda axis: f"disk: {{radius: r{place}, axis: {axis}}}"),
        st.sampled_from([f"sphere: {{radius: r{place}}}", f"shell: {{radius: r{place}}}"]),
    ).map(lambda shape: f"shape: {{{shape}}}")
    return st.one_of(st.just(""), tensors, shapes)


def _orientations(odd: list[str]) -> st.SearchStrategy[str]:
    turns = ["", "", "axes: base", "axes: Rx(90deg)", "axes: [[0, 1, 0], [0, 0, -1], [-1, 0, 0]]"]
    return st.sampled_from(turns + [f"axes: Rz(90deg) Rx({angle})" for angle in odd])
