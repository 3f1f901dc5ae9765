"""A set of one problem with marks, and hand-ins to it, for the commands of grading."""

from __future__ import annotations

import csv
import io
from pathlib import Path

from tests.support import ROOT

RIGHT = "problem: in3140-rp\nanswers:\n  K: (I1zz*theta1'^2)/2 + m2*(L2'^2 + L2^2*theta1'^2)/2\n  g: [0, 0]\n"
WRONG = RIGHT.replace("L2^2*theta1'^2)", "L2*theta1'^2)")


def set_in(place: Path) -> Path:
    """The folder of the set, made in a place."""
    folder = place / "set"
    folder.mkdir()
    (folder / "in3140-rp.yaml").write_text((ROOT / "problems" / "in3140-rp.yaml").read_text())
    (folder / "set.yaml").write_text("title: Assignment 2\nmarks: {in3140-rp: {K: 4, g: 2}}\n")
    return folder


def table(path: Path) -> list[dict[str, str]]:
    """The rows of a CSV file, by the names of its columns."""
    return list(csv.DictReader(io.StringIO(path.read_text())))
