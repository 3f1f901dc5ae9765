"""Pictures for the tests: drawn once, and what lies on what in them."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from msgspec.structs import replace

from dynsolve.draw.labels import Box, Label, Taken
from dynsolve.draw.paths import WHITE, flattened, line
from dynsolve.draw.scene import Scene, scene
from dynsolve.draw.solids import BODY
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem import load, read_problem


@cache
def drawn(path: Path) -> Scene:
    return scene(load(path))


def drawn_text(text: str) -> Scene:
    return scene(read_problem(text.encode(), "problem.yaml"))


def names(picture: Scene, kind: str = "") -> list[str]:
    """What the labels of a kind say, or all; axes that share a label apart."""
    labels = [label for label in picture.labels if kind in ("", label.kind)]
    return [name for label in labels for name in to_unicode(label.node, picture.style).split(", ")]


def overlapping(picture: Scene) -> list[tuple[str, str]]:
    """Labels that lie on one another."""
    labels = picture.labels
    return [
        (to_unicode(a.node), to_unicode(b.node))
        for k, a in enumerate(labels)
        for b in labels[k + 1 :]
        if a.box.overlaps(b.box)
    ]


def struck_through(picture: Scene) -> list[str]:
    """Labels that have something drawn under or over their letters, but for their own line.

    A letter may stand in the tan area of a body, off its lines.
    """
    return [to_unicode(label.node) for label in picture.labels if _hits(picture, label) > 1]


def _hits(picture: Scene, label: Label) -> int:
    own = line(*label.lead) if label.lead else None
    taken = Taken()
    drawn = (p for p in picture.paths if p.commands != own and (p.fill or p.stroke != WHITE))
    taken.add(replace(p, fill=None) if p.fill == BODY.top else p for p in drawn)
    box = label.box
    return taken.inside(Box(box.left + 1, box.top + 2, box.right - 1, box.bottom - 2))


def touched(picture: Scene, room: float) -> list[str]:
    """Labels to whose letters a line comes nearer than `room`, but for their own line."""
    found = []
    for label in picture.labels:
        own = line(*label.lead) if label.lead else None
        box = label.box
        for path in picture.paths:
            if path.commands == own or not path.stroke or path.stroke == WHITE:
                continue
            near = room + path.width / 2
            letters = Box(box.left, box.top + _BLANK, box.right, box.bottom - _BLANK).grown(near)
            if any(letters.meets(*piece) for piece in flattened(path.commands)):
                found.append(to_unicode(label.node))
                break
    return found


_BLANK = 2.0
"""What a label's box has above and below its letters."""
