"""A second reader of problem files, on numbers only, that shares no code with dynsolve.

It reads valid files: what is wrong with a file is for dynsolve to say.  Every
symbol gets a number first, and then all of a robot is numbers: one constant
transformation, one axis and one rate vector a row, one spatial inertia a body.
"""

from __future__ import annotations

import keyword
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import yaml

Array = np.ndarray

GREEK = {
    "α": "alpha",
    "β": "beta",
    "γ": "gamma",
    "δ": "delta",
    "θ": "theta",
    "φ": "phi",
    "ψ": "psi",
    "ω": "omega",
}
KNOWN = {"sin", "cos", "tan", "sqrt", "pi", "deg"}
STAR = re.compile(r"([A-Za-z_]\w*)\*(?=\s*(?:$|[+\-/),]))")
NAME = re.compile(r"(?<![\w.])[A-Za-z_]\w*")
ROTATION = re.compile(r"R([xyz])\(((?:[^()]|\([^()]*\))*)\)")


@dataclass(frozen=True)
class Row:
    """A row of the table: `before`, then the joint about or along z, then `after`."""

    before: Array
    after: Array
    kind: str  # "revolute", "prismatic" or "fixed"
    rates: Array  # the joint's variable is rates · q
    start: int  # the frame that it starts from


@dataclass(frozen=True)
class Mass:
    """A body: mass, mass centre and tensor about it, both in the axes of frame `link`."""

    name: str
    mass: float
    link: int
    center: Array
    tensor: Array


@dataclass(frozen=True)
class Arm:
    """A robot with numbers for all its symbols."""

    coordinates: tuple[str, ...]
    rows: tuple[Row, ...]
    masses: tuple[Mass, ...]
    base: Array
    gravity: Array


def load(problem: Path | str) -> dict[str, Any]:
    """The mapping of a problem file, or of its text."""
    text = problem.read_text(encoding="utf-8") if isinstance(problem, Path) else problem
    for letter, name in GREEK.items():
        text = text.replace(letter, name)
    return yaml.safe_load(text)


def spell(text: Any) -> str:
    """An expression as Python writes it."""
    text = str(text).replace("^", "**").replace("°", "deg")
    text = re.sub(r"(\d+(?:\.\d+)?)\s*deg\b", r"(\1*pi/180)", text)
    return NAME.sub(lambda found: found[0] + "_" * keyword.iskeyword(found[0]), text)


def value(text: Any, values: Mapping[str, float]) -> float:
    """The number that an expression is."""
    names = {"sin": math.sin, "cos": math.cos, "tan": math.tan, "sqrt": math.sqrt, "pi": math.pi, **values}
    return float(eval(spell(text), {"__builtins__": {}}, names))  # noqa: S307


def coordinates_of(problem: Mapping[str, Any]) -> tuple[str, ...]:
    """The starred names, in order of first appearance or as `coordinates` has them."""
    if "coordinates" in problem:
        return tuple(spell(name) for name in problem["coordinates"])
    cells = [str(row.get(key, 0)) for row in problem["dh"] for key in ("theta", "d")]
    return tuple(dict.fromkeys(spell(name) for cell in cells for name in STAR.findall(cell)))


def parameters_of(problem: Mapping[str, Any]) -> set[str]:
    """Every symbol that is no coordinate."""
    texts = [str(problem.get("gravity", "g")), str(problem.get("base", ""))]
    texts += [str(cell) for row in problem["dh"] for key, cell in row.items() if key != "from"]
    texts += [leaf for body in problem.get("masses") or [] for leaf in _leaves(body)]
    names = {name for text in texts for name in NAME.findall(spell(text))}
    return names - KNOWN - set(coordinates_of(problem)) - _WORDS


_WORDS = set("Rx Ry Rz x y z tip origin midpoint center joint base none point rotate move".split())


def _leaves(entry: Any) -> list[str]:
    if isinstance(entry, Mapping):
        return [leaf for key, part in entry.items() if key not in ("name", "link") for leaf in _leaves(part)]
    if isinstance(entry, Sequence) and not isinstance(entry, str):
        return [leaf for part in entry for leaf in _leaves(part)]
    return [str(entry)]


def rotation(axis: str, angle: float) -> Array:
    """The 3×3 rotation about a coordinate axis."""
    c, s = math.cos(angle), math.sin(angle)
    return {
        "x": np.array([[1, 0, 0], [0, c, -s], [0, s, c]]),
        "y": np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]),
        "z": np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]),
    }[axis]


def orientation(entry: Any, values: Mapping[str, float]) -> Array:
    """A product of rotations, or a 3×3 list."""
    if isinstance(entry, list):
        return np.array([[value(cell, values) for cell in row] for row in entry])
    product = np.eye(3)
    for axis, angle in ROTATION.findall(str(entry)):
        product = product @ rotation(axis, value(angle, values))
    return product


def transformation(turn: Array | None = None, move: Sequence[float] = (0, 0, 0)) -> Array:
    """A 4×4 transformation."""
    T = np.eye(4)
    T[:3, :3] = np.eye(3) if turn is None else turn
    T[:3, 3] = move
    return T


def row_of(row: Mapping[str, Any], names: Sequence[str], modified: bool, values: Mapping[str, float]) -> Row:
    """A row of the table, its variable part taken out of θ or d."""
    texts = {key: str(row.get(key, 0)) for key in ("theta", "d", "a", "alpha")}
    starred = [key for key in ("theta", "d") if STAR.search(texts[key])]
    cells = {key: STAR.sub(r"\1", text) for key, text in texts.items()}
    rest = {**values, **dict.fromkeys(names, 0.0)}
    rates = np.zeros(len(names))
    if starred:
        at_rest = value(cells[starred[0]], rest)
        rates = np.array([value(cells[starred[0]], {**rest, name: 1.0}) - at_rest for name in names])
    theta, d, a, alpha = (value(cells[key], rest) for key in ("theta", "d", "a", "alpha"))
    along_z = transformation(rotation("z", theta), (0, 0, d))
    along_x = transformation(rotation("x", alpha), (a, 0, 0))
    kind = {"theta": "revolute", "d": "prismatic", "": "fixed"}["".join(starred)]
    return (
        Row(along_x, along_z, kind, rates, 0)
        if modified
        else Row(np.eye(4), along_z @ along_x, kind, rates, 0)
    )


def at_rest(rows: Sequence[Row]) -> Array:
    """The transformation from frame 0 through the given rows at q = 0."""
    T = np.eye(4)
    for row in rows:
        T = T @ row.before @ row.after
    return T


def read(problem: Mapping[str, Any], values: Mapping[str, float]) -> Arm:
    """The robot of a problem file with `values` for its symbols."""
    names = coordinates_of(problem)
    modified = problem.get("convention", "standard") == "modified"
    rows = tuple(
        replace(row_of(row, names, modified, values), start=int(row.get("from", place)))
        for place, row in enumerate(problem["dh"])
    )
    masses = tuple(
        _mass(body, str(body.get("name", place)), rows, modified, {**values, **dict.fromkeys(names, 0.0)})
        for place, body in enumerate(problem.get("masses") or [], start=1)
    )
    gravity = problem.get("gravity", [0, 0, "-g"])
    if gravity in ("none", None):
        gravity = [0, 0, 0]
    base = problem.get("base") or ""
    parts = base if isinstance(base, Mapping) else {"rotate": base}
    move = [value(cell, values) for cell in parts.get("move", [0, 0, 0])]
    world = transformation(orientation(parts.get("rotate", ""), values), move)
    return Arm(names, rows, masses, world, np.array([value(cell, values) for cell in gravity]))


def _mass(
    body: Mapping[str, Any], name: str, rows: Sequence[Row], modified: bool, values: Mapping[str, float]
) -> Mass:
    link = int(body["link"])
    near, far = _ends(rows, link, modified)
    mass = value(body["mass"], values)
    center = _point(body.get("center", "tip"), near, far, values)
    R = _axes(body.get("axes"), at_rest(_path(rows, link))[:3, :3], values)
    if "inertia" in body:
        tensor = _tensor(body["inertia"], values)
    else:
        along = None if far is None else R.T @ (far - near)
        tensor = _shape(body.get("shape", "point"), mass, along, values)
    about = {"center": center, "origin": np.zeros(3), "joint": near}[body.get("about", "center")]
    offset = R.T @ (center - about)
    tensor = tensor - mass * (offset @ offset * np.eye(3) - np.outer(offset, offset))
    return Mass(name, mass, link, center, R @ tensor @ R.T)


def _path(rows: Sequence[Row], link: int) -> list[Row]:
    """The rows between the base and a frame."""
    return [*_path(rows, rows[link - 1].start), rows[link - 1]] if link else []


def _ends(rows: Sequence[Row], link: int, modified: bool) -> tuple[Array, Array | None]:
    """The near and the far end of a link, in its own frame."""
    if not modified:
        return np.linalg.inv(at_rest([rows[link - 1]]))[:3, 3], np.zeros(3)
    after = [row for row in rows if row.start == link]
    return np.zeros(3), at_rest(after)[:3, 3] if after and after[0].kind != "prismatic" else None


def _point(entry: Any, near: Array, far: Array | None, values: Mapping[str, float]) -> Array:
    if entry == "origin":
        return np.zeros(3)
    if isinstance(entry, list):
        return np.array([value(cell, values) for cell in entry])
    if isinstance(entry, Mapping) and "near" in entry:
        return near + np.array([value(cell, values) for cell in entry["near"]])
    assert far is not None
    part = {"tip": 1.0, "midpoint": 0.5}[entry] if isinstance(entry, str) else value(entry["along"], values)
    return near + part * (far - near)


def _axes(entry: Any, R: Array, values: Mapping[str, float]) -> Array:
    """The body-attached frame's axes in the link's frame; `R` is the link's orientation at q = 0."""
    if entry is None:
        return np.eye(3)
    if entry == "base":
        return R.T
    if isinstance(entry, Mapping):
        return R.T @ orientation(entry["base"], values)
    return orientation(entry, values)


def _tensor(entry: Any, values: Mapping[str, float]) -> Array:
    if isinstance(entry, list):
        return np.array([[value(cell, values) for cell in row] for row in entry])
    part = {key: value(entry.get(key, 0), values) for key in ("xx", "yy", "zz", "xy", "xz", "yz")}
    return np.array([[part["".join(sorted(i + j))] for j in "xyz"] for i in "xyz"])


def _shape(entry: Any, mass: float, along: Array | None, values: Mapping[str, float]) -> Array:
    """The tensor of a uniform body about its mass centre; `along` is the link's direction in its axes."""
    if entry == "point":
        return np.zeros((3, 3))
    ((kind, sizes),) = entry.items()
    size = {key: value(text, values) for key, text in sizes.items() if key != "axis"}
    if kind == "box":
        x, y, z = size["x"], size["y"], size["z"]
        return mass / 12 * np.diag([y * y + z * z, x * x + z * z, x * x + y * y])
    if kind in ("sphere", "shell"):
        return {"sphere": 2 / 5, "shell": 2 / 3}[kind] * mass * size["radius"] ** 2 * np.eye(3)
    slender = kind in ("rod", "cylinder", "hollow_cylinder")
    axis = sizes.get("axis") or (
        "xyz"[int(np.argmax(np.abs(along)))] if slender and along is not None else "z"
    )
    outer, inner = size.get("radius", size.get("outer", 0.0)), size.get("inner", 0.0)
    squares = outer**2 + inner**2
    about_axis, across = mass * squares / 2, mass * (3 * squares + size.get("length", 0.0) ** 2) / 12
    return np.diag([about_axis if name == axis else across for name in "xyz"])
