"""The tip that a table from a drawing gives, held against products of exponentials of the drawn axes.

Where the tip is at q follows from the file alone: it stands where it is drawn, moved by each joint
about or along its axis as drawn, the last joint first (Lynch, Park, section 4.1).  A slide's letter
in the drawing is its value, so that the pose is drawn with it.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
import yaml

from tests.support import ROOT, solve_json

Array = npt.NDArray[np.float64]

DRAWN = [*sorted((ROOT / "problems").glob("*-drawn.yaml")),
         *(path for path in sorted((ROOT / "tests" / "golden" / "kinematics").glob("*.yaml"))
           if "\naxes:" in path.read_text(encoding="utf-8"))]  # fmt: skip
POINTS = 1000
NAME = re.compile(r"[A-Za-z_]\w*")
DEGREES = re.compile(r"(\d+)deg")
KNOWN = {"__builtins__": {}, "sin": np.sin, "cos": np.cos, "sqrt": np.sqrt, "pi": np.pi}


def value(text: Any, values: dict[str, Array]) -> Array:
    """An expression of the file, or of the JSON, at every point."""
    text = DEGREES.sub(r"(\1*pi/180)", str(text)).replace("^", "**")
    return np.broadcast_to(eval(text, dict(KNOWN), values), (POINTS,))  # noqa: S307 - files of our own


def vectors(entries: list[Any], values: dict[str, Array]) -> Array:
    """A vector of the file, 3×k."""
    return np.array([value(entry, values) for entry in entries])


def turned(v: Array, axis: Array, angle: Array) -> Array:
    """v turned about a direction, by Rodrigues' formula."""
    u = axis / np.linalg.norm(axis, axis=0)
    along = (u * v).sum(axis=0) * u
    return along + np.cos(angle) * (v - along) + np.sin(angle) * np.cross(u, v, axis=0)


def tip(data: dict[str, Any], values: dict[str, Array]) -> Array:
    """Where the hand is, 3×k."""
    drawn = data["tip"]["at"] if isinstance(data["tip"], dict) else data["tip"]
    letters = set(NAME.findall(str([drawn, *(axis.get("through", "") for axis in data["axes"])])))
    point = vectors(drawn, values)
    for axis in reversed(data["axes"]):
        if "turn" in axis:
            through = vectors(axis["through"], values)
            about = vectors(axis["about"], values)
            point = through + turned(point - through, about, values[axis["turn"]])
        elif axis["slide"] not in letters:
            along = vectors(axis["along"], values)
            point = point + values[axis["slide"]] * along / np.linalg.norm(along, axis=0)
    return point


@pytest.mark.parametrize("path", DRAWN, ids=lambda path: path.stem)
def test_the_table_moves_the_tip_as_the_drawn_axes_do(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    data = yaml.safe_load(text)
    assert data["zero"] == "drawn"
    kept = "\n".join(line for line in text.splitlines() if not line.startswith(("find:", "task:")))
    r = solve_json(f"{kept}\ntask: [tip.x, tip.y, tip.z]\nfind: [r]\n")["results"]["r"]
    draw = np.random.default_rng(7)
    coordinates = [axis.get("turn", axis.get("slide")) for axis in data["axes"]]
    names = sorted({*NAME.findall(f"{r} {data['axes']} {data['tip']}")} - {*KNOWN})
    values = {
        n: draw.uniform(-3, 3, POINTS) if n in coordinates else draw.uniform(0.5, 2, POINTS) for n in names
    }
    values |= {name: draw.uniform(-3, 3, POINTS) for name in coordinates}
    ours = np.array([value(entry, values) for entry in r])
    assert np.abs(ours - tip(data, values)).max() < 1e-12
