"""The annotations around a robot: axes of frames, mass centres, gravity.

Each function gives paths, and the labels that belong to them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from dynsolve.draw import paths
from dynsolve.draw.labels import Wanted
from dynsolve.draw.occupied import Taken
from dynsolve.draw.parts import TUBE
from dynsolve.draw.paths import Path
from dynsolve.draw.pose import ARC, AXIS, MANY, Pose
from dynsolve.draw.typography import typeset
from dynsolve.draw.vectors import (
    Point,
    Vector,
    dot,
    moved,
    point_to_segment,
)
from dynsolve.notation.printing import Style
from dynsolve.notation.tree import Node, Number, Row, Symbol, Words
from dynsolve.quantities import letters

_END_ON = 0.06
"""The foreshortening below which an axis is drawn as a point or a cross in a circle."""

_ALONG = 0.99
"""The cosine from which gravity acts along an axis."""

_PAST_ARC = 12.0
"""How far the tip of an axis is on paper from the arc of an angle, which is not to cut its head."""

_SAME = 5.0
MARK = 6.0
"""The radius of the mark of a mass centre."""

_AROUND = 11.0
"""Its radius around an axis that is seen end on."""


@dataclass
class Notes:
    """Paths and labels as they are collected; `taken` is what is drawn so far, `solid` the robot's body.

    `behind` are the paths that the body of the robot is drawn over, `lengths` the lines of lengths,
    `tips` the heads of the axes' arrows, and `heads` where they are.
    """

    style: Style
    taken: Taken
    paths: list[Path] = field(default_factory=list)
    behind: list[Path] = field(default_factory=list)
    wanted: list[Wanted] = field(default_factory=list)
    solid: Taken = field(default_factory=Taken)
    lengths: Taken = field(default_factory=Taken)
    heads: Taken = field(default_factory=Taken)
    tips: list[Path] = field(default_factory=list)

    def draw(self, *paths: Path, behind: bool = False) -> None:
        """Add paths."""
        (self.behind if behind else self.paths).extend(paths)
        self.taken.add(paths)

    def label(
        self,
        node: Node,
        anchors: Sequence[Point],
        toward: Point,
        colour: str,
        kind: str,
        radius: float = 0.0,
    ) -> None:
        """Ask for a label."""
        line = typeset(node, self.style)
        self.wanted.append(Wanted(node, line, tuple(anchors), toward, colour, kind, radius))


# -- frames ----------------------------------------------------------------------------------------


def frames(pose: Pose, gravity: Vector | None, notes: Notes) -> None:
    """The z and x axes of every frame; axes that fall on one another share a label.

    Of frame 0 the y axis too where gravity acts along it.
    """
    view = pose.view
    groups: list[tuple[Point, Point, list[Node]]] = []
    for i, frame in enumerate(pose.skeleton.frames):
        origin = view.point(frame.origin)
        axes = [("x", frame.x), ("z", frame.z)]
        if i == 0 and gravity and abs(dot(gravity, frame.axes[1])) > _ALONG:
            axes.append(("y", frame.axes[1]))
        for letter, axis in axes:
            name = letters.bold(letter, Number(i))
            tip = axis_arrow(origin, axis, pose, notes)
            known = next(
                (g for g in groups if math.dist(g[1], tip) < _SAME and math.dist(g[0], origin) < _SAME), None
            )
            if known:
                known[2].append(name)
            else:
                groups.append((origin, tip, [name]))
    for origin, tip, names in groups:
        toward = (tip[0] - origin[0], tip[1] - origin[1])
        radius = MARK if tip == origin else 0.0
        notes.label(_listed(names), [tip], toward, paths.FRAME, "axis", radius)


def _listed(names: Sequence[Node]) -> Node:
    parts: list[Node] = [names[0]]
    for name in names[1:]:
        parts += [Words(", "), name]
    return parts[0] if len(parts) == 1 else Row(tuple(parts))


def axis_arrow(origin: Point, axis: Vector, pose: Pose, notes: Notes) -> Point:
    """Draw an axis, and give its tip."""
    view = pose.view
    x, y = view.direction(axis)
    if _is_end_on(axis, pose):
        notes.taken.add([Path(paths.circle(origin, MARK))])  # drawn last, by `axes_end_on`
        return origin
    reach = reach_of_axis((x, y), pose)
    tip = (origin[0] + x * reach, origin[1] + y * reach)
    back = (tip[0] - x / math.hypot(x, y) * 6.0, tip[1] - y / math.hypot(x, y) * 6.0)
    head = Path(paths.head(tip, (x, y)), None, fill=paths.FRAME)
    notes.draw(
        Path(paths.line(origin, back), paths.WHITE, 4.2),
        Path(paths.line(origin, back), paths.FRAME, 1.6),
        head,
    )
    notes.tips.append(head)
    notes.heads.add([head])
    return tip


def axes_end_on(pose: Pose, notes: Notes) -> None:
    """The axes that are seen end on, over the masses at their origins."""
    for frame in pose.skeleton.frames:
        for axis in (frame.x, frame.z):
            if _is_end_on(axis, pose):
                axis_end_on(pose.view.point(frame.origin), dot(axis, pose.view.toward) > 0, notes)


def reach_of_axis(direction: Point, pose: Pose) -> float:
    """How long an axis is drawn that has this direction on paper: beyond an arc, with its whole head."""
    has_arcs = len(pose.skeleton.legs) <= MANY
    return max(AXIS, ARC + _PAST_ARC / math.hypot(*direction)) if has_arcs else AXIS


def _is_end_on(axis: Vector, pose: Pose) -> bool:
    return math.hypot(*pose.view.direction(axis)) < _END_ON


def axis_end_on(origin: Point, toward: bool, notes: Notes) -> None:
    """An axis seen end on: a point for the tip of the arrow, a cross for its feathers."""
    radius = MARK
    notes.draw(Path(paths.circle(origin, radius), paths.FRAME, 1.4, paths.WHITE))
    if toward:
        notes.draw(Path(paths.circle(origin, 2.0), None, fill=paths.FRAME))
        return
    (x, y), s = origin, 0.7 * radius
    for a, b in (((x - s, y - s), (x + s, y + s)), ((x - s, y + s), (x + s, y - s))):
        notes.draw(Path(paths.line(a, b), paths.FRAME, 1.4))


# -- mass centres and gravity ----------------------------------------------------------------------


def masses(pose: Pose, notes: Notes) -> None:
    """Mass centres: the quartered disk of mechanics, a ball for a point mass."""
    for mass in pose.skeleton.masses:
        center = pose.view.point(mass.center)
        if not _is_on_link(center, pose):
            origin = pose.view.point(pose.skeleton.frames[mass.link].origin)
            notes.draw(Path(paths.line(origin, center), paths.BLACK, 0.9, dashed=True))
        radius = _AROUND if _is_under_axis(center, pose) else MARK
        notes.draw(*(_ball(center, radius) if mass.is_point else _quartered(center, radius)))
        name = letters.bold("r", Row((Words("c"), letters.index_of(mass.name))))
        notes.label(name, [center], (0.0, 0.0), paths.BLACK, "mass", radius)


def has_masses_off_links(pose: Pose) -> bool:
    """Whether a dashed line leads to some mass centre."""
    return not all(_is_on_link(pose.view.point(mass.center), pose) for mass in pose.skeleton.masses)


def _is_under_axis(center: Point, pose: Pose) -> bool:
    """Whether an axis that is seen end on stands where a mass centre is."""
    return any(
        math.dist(center, pose.view.point(frame.origin)) < MARK
        and any(_is_end_on(axis, pose) for axis in (frame.x, frame.z))
        for frame in pose.skeleton.frames
    )


def _is_on_link(center: Point, pose: Pose) -> bool:
    """Whether a mass centre is seen on a link."""
    ways = [*((leg.foot, leg.head, leg.end) for leg in pose.skeleton.legs), *pose.parts.links]
    lines = ((pose.view.point(a), pose.view.point(b)) for way in ways for a, b in pairwise(way))
    return any(point_to_segment(center, a, b) < 2 * TUBE for a, b in lines)


def _ball(center: Point, radius: float) -> tuple[Path, ...]:
    return (Path(paths.circle(center, radius), paths.WHITE, 1.2, paths.BLACK),)


def _quartered(center: Point, radius: float) -> tuple[Path, ...]:
    quarters = tuple(
        Path(
            (
                ("M", (center,)),
                *paths.arc(center, (radius, 0.0), (0.0, radius), start, start + math.pi / 2, move=False),
                ("Z", ()),
            ),
            None,
            fill=paths.BLACK,
        )
        for start in (0.0, math.pi)
    )
    return (Path(paths.circle(center, radius), paths.BLACK, 1.2, paths.WHITE), *quarters)


def gravity(place: Point, direction: Point | None, notes: Notes) -> None:
    """The arrow of gravity; a cross in a circle where it points away from the viewer."""
    node = Symbol("g")
    if direction is None:
        notes.draw(Path(paths.circle(place, 8.0), paths.BLACK, 1.4))
        (x, y), s = place, 5.6
        for a, b in (((x - s, y - s), (x + s, y + s)), ((x - s, y + s), (x + s, y - s))):
            notes.draw(Path(paths.line(a, b), paths.BLACK, 1.4))
        notes.label(node, [(x + 8.0, y)], (1.0, 0.0), paths.BLACK, "gravity")
        return
    x, y = direction
    tip = moved(place, (x, y), 46.0)
    notes.draw(
        Path(paths.line(place, moved(place, (x, y), 38.0)), paths.BLACK, 2.0),
        Path(paths.head(tip, (x, y), 11.0), None, fill=paths.BLACK),
    )
    notes.label(node, [moved(place, (x, y), 22.0)], (1.0, 0.0), paths.BLACK, "gravity")
