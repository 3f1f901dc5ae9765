"""A robot in a pose, and the cost of the pose.

A pose is good where nothing hides anything: origins lie apart on paper, links do
not cross, axes are not seen end on, and the arm stays above the ground.

The annotations around a robot: axes of frames, mass centres, gravity.

Each function gives paths, and the labels that belong to them.

Springs at joints: a spiral about the axis of one that turns, a zigzag beside one that slides.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import combinations, compress, pairwise

from msgspec import Struct, field

from dynsolve.algebra.ring import Expr
from dynsolve.draw import paths
from dynsolve.draw.labels import Box, Taken, Wanted, written
from dynsolve.draw.mass_centers import DrawnBody, symbols_of
from dynsolve.draw.parts import RADIUS, TUBE, JointBody, Parts
from dynsolve.draw.paths import Path, typeset
from dynsolve.draw.skeleton import Leg, Orientation, RobotNumbers, Skeleton, finite
from dynsolve.draw.vectors import (
    IDENTITY,
    NEAR,
    Point,
    Vector,
    View,
    add,
    along,
    cross,
    distance,
    dot,
    from_to,
    length,
    moved,
    point_to_segment,
    scale,
    scaled,
    segment_distance,
    subtract,
    toward,
    unit,
)
from dynsolve.notation.printing import Style
from dynsolve.notation.tree import Negative, Node, Number, Row, Symbol, Words
from dynsolve.quantities import letters
from dynsolve.robot.model import Act, JointType, Robot, Rotor

AXIS = 44.0
"""How long the axes of frames are drawn."""

ARC = 28.0
"""The radius of the arc of an angle in space, which its joint's body is not to hide."""

MANY = 4
"""A robot with more rows than that has more to write beside it than there is room for."""


class Pose(Struct, frozen=True):
    """A robot in its pose, seen from where it shows best, with the uniform bodies on its links."""

    skeleton: Skeleton
    parts: Parts
    view: View
    bodies: tuple[DrawnBody, ...] = ()


_SQUARE_TO_PAPER = 1.0
"""The cost of a link that stands upright or level in a plane, a special case that may mislead."""

Choice = tuple[float, ...]
"""Values of the coordinates, then azimuth and elevation where the view is free."""


def cost_of(pose: Pose, orientation: Orientation) -> float:
    """How far a pose is from good, 0 at best."""
    view, size = pose.view, pose.view.space(AXIS)
    hand = _hand(pose)
    path = [view.point(point) for point in (*pose.skeleton.path, *hand)]
    ways = [*pose.skeleton.links, *((pose.skeleton.path[-1], point) for point in hand)]
    links = [_on_paper(way, view) for way in ways]
    centers = [view.point(part.center) for part in pose.parts.joints]
    tips = [view.point(along(origin, axis, size)) for origin, axis in _axes_to_see(pose)]
    on_links = sum(_shortfall(point_to_segment(tip, *link), 13.0) for tip in tips for link in links)
    return (
        30.0 * max(0.0, 120.0 / view.size - 1.0)
        + 40.0 * _crowding(path, 60.0)
        + 25.0 * _crowding(centers, 48.0)
        + 14.0 * _crowding(tips, 30.0)
        + 30.0 * _crossings(ways, view)
        + 10.0 * on_links
        + _foreshortening(pose)
        + 10.0 * sum(_parallel_looking(*pair, view) for pair in _axes_to_tell_apart(pose, orientation))
        + _lowness(pose.skeleton, orientation)
    )


def _hand(pose: Pose) -> tuple[Vector, ...]:
    """The last joint, where that stands beyond all points of the chain."""
    links, joints = pose.skeleton.links, pose.parts.joints
    if not (links and joints):
        return ()
    last = joints[-1].center
    is_on_link = any(distance(a, last) + distance(last, b) < distance(a, b) + NEAR for a, b in links)
    return () if is_on_link else (last,)


def _shortfall(value: float, wanted: float) -> float:
    """0 where there is enough, up to 1 where there is nothing."""
    return max(0.0, 1.0 - value / wanted) ** 2


def _crowding(points: Sequence[Point], wanted: float) -> float:
    return sum(_shortfall(math.dist(a, b), wanted) for a, b in combinations(points, 2))


def _axes_to_see(pose: Pose) -> Iterator[tuple[Vector, Vector]]:
    """The x and z axes with their origins, but for those that a flat view shows end on."""
    for frame in pose.skeleton.frames:
        for axis in (frame.x, frame.z):
            if not (pose.view.flat and abs(dot(axis, pose.view.toward)) > 0.9):
                yield frame.origin, axis


def _crossings(links: Sequence[tuple[Vector, Vector]], view: View) -> float:
    """How near links come to each other that do not meet, and how small the angles are of those that do."""
    total = 0.0
    for first, second in combinations(links, 2):
        corners = [
            (view.point(a), view.point(b), view.point(c))
            for a, b in (first, first[::-1])
            for d, c in (second, second[::-1])
            if distance(b, d) < NEAR
        ]
        if corners:
            total += 0.6 * max(_fold(*corner) for corner in corners)
        else:
            total += _shortfall(segment_distance(_on_paper(first, view), _on_paper(second, view)), 36.0)
    return total


def _on_paper(link: tuple[Vector, Vector], view: View) -> tuple[Point, Point]:
    return view.point(link[0]), view.point(link[1])


def _fold(a: Point, b: Point, c: Point) -> float:
    """1 where a link from b lies straight on another one, 0 where it is far from that."""
    u, v = from_to(b, a), from_to(b, c)
    sizes = math.hypot(*u) * math.hypot(*v)
    if sizes < NEAR:
        return 1.0
    return max(0.0, (u[0] * v[0] + u[1] * v[1]) / sizes - 0.4)


def _foreshortening(pose: Pose) -> float:
    view = pose.view
    total = 0.0
    for _, axis in _axes_to_see(pose):
        total += 6.0 * _shortfall(math.hypot(*view.direction(axis)), 0.6)
    for a, b in pose.skeleton.links:
        seen = math.dist(view.point(a), view.point(b)) / (distance(a, b) * view.size)
        total += 8.0 * _shortfall(seen, 0.7)
    return total


def _axes_to_tell_apart(pose: Pose, orientation: Orientation) -> Iterator[tuple[Vector, Vector]]:
    """In space the upright and the axes of the first joint and of slides; slides in turn."""
    if pose.view.flat:
        return
    slides = [leg for leg in pose.skeleton.legs if leg.type is JointType.PRISMATIC]
    yield from ((orientation.up, leg.axis) for leg in dict.fromkeys([*pose.skeleton.legs[:1], *slides]))
    yield from ((first.axis, second.axis) for first, second in pairwise(slides))


def _parallel_looking(first: Vector, second: Vector, view: View) -> float:
    """1 where directions that are not parallel look so on paper, 0 from two fifths of their angle."""
    across, seen = cross(first, second), [view.direction(each) for each in (first, second)]
    angle = math.atan2(length(across), abs(dot(first, second)))
    if angle < NEAR or min(math.hypot(*each) for each in seen) < NEAR:
        return 0.0
    (a, b), (c, d) = seen
    return _shortfall(math.atan2(abs(a * d - b * c), abs(a * c + b * d)), 0.4 * angle)


def _lowness(body: Skeleton, orientation: Orientation) -> float:
    """The cost of reaching below the base."""
    start = body.frames[0].origin
    heights = [dot(subtract(point, start), orientation.up) for point in body.path]
    return 12.0 * sum(max(0.0, -0.05 - height) for height in heights)


def taste(robot: Robot, pose: Pose, choice: Choice) -> float:
    """Small preferences: angles that can be seen, moderate values, the arm leading to the right."""
    total = 0.0
    for q, value in zip(robot.coordinates, choice, strict=False):
        if q.type is JointType.PRISMATIC:
            total += 1.5 * abs(value - 0.9) + 20.0 * max(0.0, 0.4 - value)  # a length is seen positive
        else:
            total += 0.3 * abs(value) + 1.5 * max(0.0, 0.3 - value)  # 90° more than 30° is seen to be obtuse
    if pose.view.flat:
        for leg in pose.skeleton.legs:
            if leg.type is JointType.REVOLUTE:
                total += 12.0 * _shortfall(leg.turn, 0.7) + 1.2 * abs(leg.turn - 0.8)
        total += sum(_SQUARE_TO_PAPER for link in pose.skeleton.links if _is_square(pose, *link))
    else:
        total += 0.5 * abs(choice[-2] - math.radians(35))
        if len(pose.skeleton.legs) <= MANY:
            total += sum(_hidden_angle(leg, pose.view) for leg in pose.skeleton.legs)
    first, last = pose.skeleton.frames[0].origin, pose.skeleton.frames[-1].origin
    reach = pose.view.direction(subtract(last, first))[0]
    return total + 1.5 * max(0.0, 1.0 - reach)


def _is_square(pose: Pose, a: Vector, b: Vector) -> bool:
    """Whether a link that a joint may turn stands upright or level on paper, as few poses have it."""
    across, up = pose.view.direction(subtract(b, a))
    return min(abs(across), abs(up)) < NEAR and distance(a, b) > NEAR


def _hidden_angle(leg: Leg, view: View) -> float:
    """The cost of an angle in space that is small, or very large, or behind its joint."""
    if leg.type is not JointType.REVOLUTE:
        return 0.0
    angle = leg.turn
    side = cross(leg.turned_about, leg.before)
    behind = sum(
        max(0.0, -dot(leg.before, view.toward) * math.cos(t) - dot(side, view.toward) * math.sin(t))
        for t in (0.0, angle / 2, angle)
    )
    behind += max(0.0, -dot(leg.after, view.toward)) if leg.offset else 0.0
    flat = _shortfall(abs(dot(leg.axis, view.toward)), 0.6)  # an arc that is seen from its edge
    return (
        12.0 * _shortfall(angle, 0.7)
        + 0.8 * abs(angle - 1.1)
        + 1.5 * max(0.0, angle - 2.8)
        + 2.0 * behind
        + 12.0 * flat
    )


# The annotations around a robot: axes of frames, mass centres, gravity

_END_ON = 0.06
"""The foreshortening below which an axis is drawn as a point or a cross in a circle."""

_ALONG = 0.99
"""The cosine from which gravity acts along an axis."""

_STEEP = 0.9
"""The cosine from which gravity is drawn as normal to the plane of the paper."""

_PAST_ARC = 12.0
"""How far the tip of an axis is on paper from the arc of an angle, which is not to cut its head."""

_SAME = 5.0
MARK = 6.0
"""The radius of the mark of a mass centre."""

AROUND = 11.0
"""Its radius around an axis that is seen end on."""


class Notes(Struct, dict=True):
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


class Axis(Struct, frozen=True):
    """An axis of a frame where it is drawn: its name, the frame's origin, its direction."""

    name: Node
    origin: Vector
    direction: Vector


def axes_of_frames(pose: Pose, gravity: Vector | None) -> list[Axis]:
    """The x and z axes of every frame; of frame 0 the y axis too where gravity acts along it."""
    found = []
    for i, frame in enumerate(pose.skeleton.frames):
        shown = [("x", frame.x), ("z", frame.z)]
        if i == 0 and gravity and abs(dot(gravity, frame.axes[1])) > _ALONG:
            shown.append(("y", frame.axes[1]))
        found += [Axis(letters.bold(letter, Number(i)), frame.origin, axis) for letter, axis in shown]
    return found


def frames(pose: Pose, axes: Sequence[Axis], notes: Notes) -> None:
    """The axes of frames; those that fall on one another share a label.

    Opposite axes that are seen end on share the point of the one towards the viewer: of the other
    the label has minus.
    """
    view = pose.view
    groups: list[tuple[Point, Point, list[Axis]]] = []
    for axis in axes:
        origin = view.point(axis.origin)
        reach = reach_of_axis(view.direction(axis.direction), pose)
        tip = axis_arrow(origin, axis.direction, view, reach, notes)
        known = next(
            (g for g in groups if math.dist(g[1], tip) < _SAME and math.dist(g[0], origin) < _SAME), None
        )
        if known:
            known[2].append(axis)
        else:
            groups.append((origin, tip, [axis]))
    for origin, tip, group in groups:
        is_ahead = [is_toward(axis.direction, view) for axis in group]
        names = [axis.name for axis in group]
        if tip == origin and any(is_ahead):
            names = list(compress(names, is_ahead))
            names += [Negative(axis.name) for axis in group if not is_toward(axis.direction, view)]
        listed = [names[0], *(part for name in names[1:] for part in (Words(", "), name))]
        node = names[0] if len(names) == 1 else Row(tuple(listed))
        radius = MARK if tip == origin else 0.0
        notes.label(node, [tip], from_to(origin, tip), paths.FRAME, "axis", radius)


def axis_arrow(origin: Point, axis: Vector, view: View, reach: float, notes: Notes) -> Point:
    """Draw an axis, and give its tip."""
    x, y = view.direction(axis)
    if _is_end_on(axis, view):
        notes.taken.add([Path(paths.circle(origin, MARK))])  # drawn last, by `axes_end_on`
        return origin
    tip = moved(origin, (x, y), reach)
    back = moved(tip, (x / math.hypot(x, y), y / math.hypot(x, y)), -6.0)
    arrow = paths.arrow(origin, back, tip, (x, y), paths.FRAME, 1.6, halo=4.2)
    notes.draw(*arrow)
    notes.tips.append(arrow[-1])
    notes.heads.add([arrow[-1]])
    return tip


def world_axes(
    at: Point, index: Node, view: View, reach: float, notes: Notes, *, end_on: bool = True
) -> None:
    """The axes of the world at a place on paper; without `end_on` not one seen end on, over the others."""
    for letter, axis in sorted(zip("xyz", IDENTITY, strict=True), key=lambda one: _is_end_on(one[1], view)):
        is_seen = not _is_end_on(axis, view)
        if is_seen or end_on:
            tip = axis_arrow(at, axis, view, reach, notes)
            radius = 0.0 if is_seen else MARK
            notes.label(letters.bold(letter, index), [tip], from_to(at, tip), paths.FRAME, "axis", radius)
        if end_on and not is_seen:
            seen_end_on(at, is_toward(axis, view), notes)


def axes_end_on(pose: Pose, axes: Sequence[Axis], notes: Notes) -> None:
    """The axes that are seen end on, over the masses at their origins and over opposite ones."""
    for axis in sorted(axes, key=lambda axis: is_toward(axis.direction, pose.view)):
        if _is_end_on(axis.direction, pose.view):
            seen_end_on(pose.view.point(axis.origin), is_toward(axis.direction, pose.view), notes)


def reach_of_axis(direction: Point, pose: Pose) -> float:
    """How long an axis is drawn that has this direction on paper: beyond an arc, with its whole head."""
    has_arcs = len(pose.skeleton.legs) <= MANY
    return max(AXIS, ARC + _PAST_ARC / max(_END_ON, math.hypot(*direction))) if has_arcs else AXIS


def _is_end_on(axis: Vector, view: View) -> bool:
    return math.hypot(*view.direction(axis)) < _END_ON


def is_toward(direction: Vector, view: View) -> bool:
    """Whether a direction points to the viewer's side of the paper."""
    return dot(direction, view.toward) > 0


def seen_end_on(
    center: Point, toward: bool, notes: Notes, colour: str = paths.FRAME, radius: float = MARK
) -> None:
    """An arrow seen end on: a point for its tip where it points `toward` the viewer, else its feathers."""
    notes.draw(Path(paths.circle(center, radius), colour, 1.4, paths.WHITE))
    if toward:
        notes.draw(Path(paths.circle(center, radius / 3), None, fill=colour))
        return
    notes.draw(*_cross(center, 0.7 * radius, colour))


def _cross(center: Point, size: float, colour: str) -> Iterator[Path]:
    """The feathers of an arrow that points away from the viewer."""
    for way in ((1.0, 1.0), (1.0, -1.0)):
        yield Path(paths.line(moved(center, way, -size), moved(center, way, size)), colour, 1.4)


# -- mass centres and gravity ----------------------------------------------------------------------


def masses(pose: Pose, axes: Sequence[Axis], notes: Notes) -> None:
    """Mass centres: the quartered disk of mechanics, a ball for a point mass."""
    for mass in pose.skeleton.masses:
        center = pose.view.point(mass.center)
        if not _is_on_link(center, pose):
            origin = pose.view.point(pose.skeleton.frames[mass.link].origin)
            notes.draw(Path(paths.line(origin, center), paths.BLACK, 0.9, dashed=True))
        radius = AROUND if _is_under_axis(center, pose.view, axes) else MARK
        if mass.is_point:
            notes.draw(Path(paths.circle(center, radius), paths.WHITE, 1.2, paths.BLACK))
        else:
            notes.draw(*_quartered(center, radius))
        name = letters.bold("r", Row((Words("c"), letters.index_of(mass.name))))
        notes.label(name, [center], (0.0, 0.0), paths.BLACK, "mass", radius)


def has_masses_off_links(pose: Pose) -> bool:
    """Whether a dashed line leads to some mass centre."""
    return not all(_is_on_link(pose.view.point(mass.center), pose) for mass in pose.skeleton.masses)


def _is_under_axis(center: Point, view: View, axes: Sequence[Axis]) -> bool:
    """Whether an axis that is seen end on stands where a mass centre is."""
    return any(
        math.dist(center, view.point(axis.origin)) < MARK and _is_end_on(axis.direction, view)
        for axis in axes
    )


def _is_on_link(center: Point, pose: Pose) -> bool:
    """Whether a mass centre is seen on a link."""
    ways = [*((leg.foot, leg.head, leg.end) for leg in pose.skeleton.legs), *pose.parts.links]
    lines = ((pose.view.point(a), pose.view.point(b)) for way in ways for a, b in pairwise(way))
    return any(point_to_segment(center, a, b) < 2 * TUBE for a, b in lines)


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


def gravity(robot: Robot, place: Point, pull: Vector, view: View, notes: Notes) -> None:
    """The arrow of gravity with its letter; a point or a cross in a circle where it is seen end on."""
    ring, entries = robot.ring, robot.gravity.entries
    squared = sum((entry * entry for entry in entries), start=ring.zero)
    names = (name for name in symbols_of(robot, entries) if ring.symbol(name) ** 2 == squared)
    node = Symbol(next(names, "g"))
    direction = toward((0.0, 0.0), view.direction(pull))
    if view.flat and abs(dot(pull, view.toward)) > _STEEP:
        seen_end_on(place, is_toward(pull, view), notes, paths.BLACK, 8.0)
        beside = moved(place, (1.0, 0.0), 8.0)
    else:
        back, tip = moved(place, direction, 38.0), moved(place, direction, 46.0)
        notes.draw(*paths.arrow(place, back, tip, direction, paths.BLACK, 2.0, size=11.0))
        beside = moved(place, direction, 22.0)
    notes.label(node, [beside], (1.0, 0.0), paths.BLACK, "gravity")


# Springs at joints

SPRINGS = "A spiral or a zigzag at a joint is a spring."
OTHER_SPRINGS = "Springs on other than one joint, or given by their energy, are not drawn."
DAMPERS = "A cup with a piston is a damper."
OTHER_DAMPERS = "Dampers on other than one joint are not drawn."
MOTORS = "A dark box at a joint is a motor, with its coordinate or its moment of inertia if that is a letter."
OTHER_MOTORS = "Motors that are not on the link before the joint that they drive are not drawn."

_INNER, _OUTER, _TURNS = RADIUS + 1.0, RADIUS + 13.0, 1.75
_STEPS = 72
_SHAFT, _CASE, _CORNERS = 7.0, 9.0, ((1, 1), (1, -1), (-1, -1), (-1, 1))
"""Of a motor: the length of its shaft, half its side, and its corners."""

_BESIDE, _HALF, _ENDS, _TOOTH, _LONGEST = 22.0, 6.0, 10.0, 6.0, 96.0
"""Of a zigzag: how far beside its joint it runs, half its width, its ends, half its period, all its teeth."""


_CUP, _CUP_HALF = 16.0, 6.0
"""Of a damper: the length of its cup, and half its width."""

_DAMPED, _DAMPED_REACH = 15.0, 44.0
"""Of a damper at a joint that turns: how far from the joint its arc runs, and how long that is."""


def joint_springs(robot: Robot, numbers: RobotNumbers, pose: Pose) -> list[tuple[JointBody, Expr]]:
    """The joints along whose variable alone a spring acts, with its stiffness."""
    return _at_joints(robot.actions.stored, robot, numbers, pose)


def joint_dampers(robot: Robot, numbers: RobotNumbers, pose: Pose) -> list[tuple[JointBody, Expr]]:
    """The joints along whose variable alone a damper acts, with its damping."""
    return _at_joints(robot.actions.resisting, robot, numbers, pose)


def _at_joints(
    acts: Sequence[Act], robot: Robot, numbers: RobotNumbers, pose: Pose
) -> list[tuple[JointBody, Expr]]:
    found, moving = [], {k for joint in robot.joints for k, _ in joint.rates}
    for of, size in (act.along for act in acts if act.along):
        rates = {k: rate for k, rate in _rates(robot, of, numbers).items() if k in moving}
        rows = [joint.index for joint in robot.joints if _is_along(dict(joint.rates), rates)]
        found += [(part, size) for part in pose.parts.joints if [part.row] == rows]
    return found


def _is_along(joint: Mapping[int, Fraction], rates: Mapping[int, float]) -> bool:
    """Whether a form grows with the coordinates, from 0, as the variable of a joint does."""
    ratios = {k: rates[k] / float(rate) for k, rate in joint.items() if k in rates}
    if joint.keys() != rates.keys():
        return False
    return max(ratios.values()) - min(ratios.values()) < NEAR


def _rates(robot: Robot, of: Expr, numbers: RobotNumbers) -> dict[int, float]:
    """How much the form that a spring is given by grows with each coordinate on which it depends."""
    values = numbers.values
    start = finite(of, values)
    rates = {k: finite(of, {**values, q.name: 1.0}) - start for k, q in enumerate(robot.coordinates)}
    return {k: rate for k, rate in rates.items() if abs(rate) > NEAR}


def _rows(robot: Robot, coordinates: Collection[int]) -> list[int]:
    """The rows of the table that coordinates move."""
    return [joint.index for joint in robot.joints if any(k in coordinates for k, _ in joint.rates)]


def springs(robot: Robot, numbers: RobotNumbers, pose: Pose, notes: Notes) -> None:
    """Every such spring with its stiffness, and every such damper with its damping."""
    at_joints = joint_springs(robot, numbers, pose)
    for part, stiffness in at_joints:
        name = written(robot)(stiffness)
        if part.type is JointType.REVOLUTE:
            draw_spring(spiral(part.center, part.axis, pose.view), name, notes)
        else:
            draw_spring(zigzag(*_ends(pose, part), _BESIDE), name, notes)
    for part, damping in joint_dampers(robot, numbers, pose):
        if part.type is JointType.REVOLUTE:
            inner = _OUTER - 4.0 if any(part == other for other, _ in at_joints) else RADIUS
            draw_turned_damper(part.center, part.axis, pose.view, inner, written(robot)(damping), notes)
        else:
            draw_damper(*_ends(pose, part), -_BESIDE, written(robot)(damping), notes)


def _ends(pose: Pose, part: JointBody) -> tuple[Point, Point]:
    leg = pose.skeleton.legs[part.row - 1]
    return pose.view.point(leg.foot), pose.view.point(leg.head)


def drawn_motors(robot: Robot, numbers: RobotNumbers, pose: Pose) -> list[tuple[JointBody, Rotor]]:
    """The motors that stand at a joint.

    One with a coordinate of its own, from 0, stands at the joint that its spring acts on, without a spring at
    the joint after the link that carries it; one that is geared to a joint there if that link is before it.
    """
    found = []
    for rotor in robot.actions.rotors:
        if _rows(robot, {rotor.turns}):
            joints = (j for j in robot.joints if j.parent == rotor.carrier)
            rows = [j.index for j in joints if [k for k, _ in j.rates] == [rotor.turns]]
        else:
            forms = (_rates(robot, act.along[0], numbers) for act in robot.actions.stored if act.along)
            sprung = [row for rates in forms if rotor.turns in rates for row in _rows(robot, [*rates])]
            rows = [*sprung, rotor.carrier + 1]
        found += [(part, rotor) for part in pose.parts.joints if part.row in rows[:1]]
    return found


def motors(robot: Robot, numbers: RobotNumbers, pose: Pose, notes: Notes) -> None:
    """A box for every such motor, its shaft towards the joint, with its coordinate or its inertia."""
    sprung = [part for part, _ in joint_springs(robot, numbers, pose) if part.type is JointType.REVOLUTE]
    for part, rotor in drawn_motors(robot, numbers, pose):
        center = pose.view.point(part.center)
        ways = [(math.cos(math.pi * k / 8), math.sin(math.pi * k / 8)) for k in range(16)]

        edge = _OUTER - 4.0 if part in sprung else RADIUS
        reach = edge + _SHAFT + _CASE

        def crowded(way: Point, center: Point = center, reach: float = reach) -> int:
            return notes.taken.inside(Box.around(moved(center, way, reach), *(4 * _CASE,) * 2))

        way = min(ways, key=crowded)
        at, (x, y) = moved(center, way, reach), scaled(way, _CASE)
        corners = [(at[0] + s * x - t * y, at[1] + s * y + t * x) for s, t in _CORNERS]
        shaft = paths.line(moved(center, way, edge), moved(at, way, -_CASE))
        notes.draw(Path(shaft, paths.BLACK, 3.0), Path(paths.polygon(corners), fill=paths.DARK_SIDE))
        if not _rows(robot, {rotor.turns}):
            name = Symbol(robot.coordinates[rotor.turns].name, star=True)
            notes.label(name, [at], way, paths.VARIABLE, "variable", 1.2 * _CASE)
        elif not rotor.inertia.is_number:
            notes.label(written(robot)(rotor.inertia), [at], way, paths.BLACK, "motor", 1.2 * _CASE)


def draw_spring(points: Iterator[Point], name: Node, notes: Notes, *, behind: bool = False) -> None:
    """A spring along its points, and its stiffness."""
    line = list(points)
    path = paths.line(*line)
    notes.draw(Path(path, paths.WHITE, 3.0), Path(path, paths.BLACK, 1.2), behind=behind)
    notes.label(name, line[:: len(line) // 6], (0.0, 0.0), paths.BLACK, "spring")


def spiral(center: Vector, axis: Vector, view: View, inner: float = _INNER) -> Iterator[Point]:
    """Round an axis, outwards."""
    across = cross(axis, view.toward)
    first = view.right if math.hypot(*view.direction(across)) < NEAR else across
    second = cross(axis, first)
    for k in range(_STEPS + 1):
        t = math.pi + 2 * math.pi * _TURNS * k / _STEPS
        radius = view.space(inner + (_OUTER - _INNER) * k / _STEPS)
        direction = add(scale(first, math.cos(t)), scale(second, math.sin(t)))
        yield view.point(along(center, direction, radius))


def zigzag(a: Point, b: Point, beside: float) -> Iterator[Point]:
    """From a point to another, that far beside the line between them."""
    reach, way = math.dist(a, b) or 1.0, toward(a, b)
    across = -way[1], way[0]
    ends = max(min(_ENDS, reach / 4), (reach - _LONGEST) / 2)
    teeth = max(2, round((reach - 2 * ends) / _TOOTH))
    start = moved(a, across, beside)
    yield from (a, start, moved(start, way, ends))
    for k in range(teeth):
        corner = moved(start, way, ends + (reach - 2 * ends) * (k + 0.5) / teeth)
        yield moved(corner, across, _HALF if k % 2 else -_HALF)
    yield from (moved(start, way, reach - ends), moved(start, way, reach), b)


def draw_damper(a: Point, b: Point, beside: float, name: Node, notes: Notes) -> None:
    """A damper beside the line from a point to another, held by both ends."""
    way = toward(a, b)
    across = -way[1], way[0]

    def at(along: float, aside: float) -> Point:
        return moved(moved(a, way, along), across, beside + aside)

    _dashpot(at, math.dist(a, b) or 1.0, (a, b), name, notes)


def draw_turned_damper(
    center: Vector, axis: Vector, view: View, inner: float, name: Node, notes: Notes
) -> None:
    """A damper on an arc round an axis, where most room is, held by both ends at the radius `inner`."""
    across = cross(axis, view.toward)
    first = view.right if math.hypot(*view.direction(across)) < NEAR else unit(across)
    second, middle = cross(axis, first), inner + _DAMPED
    turn = _DAMPED_REACH / middle

    def place(radius: float, turned: float) -> Point:
        direction = add(scale(first, math.cos(turned)), scale(second, math.sin(turned)))
        return view.point(along(center, direction, view.space(radius)))

    def crowded(start: float) -> int:
        turns = [start + turn * k / 6 for k in range(7)]
        rings = ([place(middle + k * _CUP_HALF, each) for each in turns] for k in (-1, 0, 1, 2))
        room = Box.around(place(middle + 2.5 * _CUP_HALF, start + turn / 2), *(4 * _CUP_HALF,) * 2)
        return sum(
            notes.taken.cells_on(*pair) for ring in rings for pair in pairwise(ring)
        ) + notes.taken.inside(room)

    start = min((math.pi * k / 8 for k in range(16)), key=crowded)

    def at(along: float, aside: float) -> Point:
        return place(middle + aside, start + along / middle)

    _dashpot(at, _DAMPED_REACH, (at(0.0, -_DAMPED), at(_DAMPED_REACH, -_DAMPED)), name, notes)


def _dashpot(
    at: Callable[[float, float], Point], reach: float, ends: tuple[Point, Point], name: Node, notes: Notes
) -> None:
    """A cup that opens to the second end, the piston in it, and the damping: `at` is along and aside."""
    middle = reach / 2
    back, front = middle - _CUP / 2, middle + _CUP / 2

    def way(start: float, end: float, aside: float = 0.0) -> list[Point]:
        return [at(start + (end - start) * k / 6, aside) for k in range(7)]

    lines = (
        paths.line(ends[0], *way(0.0, back)),
        paths.line(*way(front, back, _CUP_HALF), *way(back, front, -_CUP_HALF)),
        paths.line(at(middle, _CUP_HALF - 2), at(middle, 2 - _CUP_HALF)),
        paths.line(*way(middle, reach), ends[1]),
    )
    notes.draw(*(Path(line, paths.BLACK, 1.4) for line in lines), behind=True)
    notes.label(name, [at(middle, _CUP_HALF), at(middle, -_CUP_HALF)], (0.0, 0.0), paths.BLACK, "damper")
