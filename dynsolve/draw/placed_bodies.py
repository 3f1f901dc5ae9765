"""The picture of bodies that are given by their positions: how each is reached, and what moves it.

Nothing is drawn that is not computed for these very positions: a rod is a piece whose length
does not change, the arrow of an angle is the way of its direction from 0 to the value in the picture.

A spring or a damper that acts on the distance of two points is drawn between them, one that acts on an
angle at that angle.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import combinations

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.ring import Expr
from dynsolve.derivation.mechanism import orientation
from dynsolve.draw import paths
from dynsolve.draw.closings import NOT_HELD
from dynsolve.draw.labels import Box, Label, Taken, place, written
from dynsolve.draw.lengths import tilt
from dynsolve.draw.paths import Path, typeset
from dynsolve.draw.placed_pose import Kind, Piece, Place, PlacedPose, Turning, placed_pose
from dynsolve.draw.poses import (
    DAMPERS,
    Notes,
    draw_damper,
    draw_spring,
    draw_turned_damper,
    spiral,
    world_axes,
    zigzag,
)
from dynsolve.draw.scene import PLAIN, Scene, framed, gravity_arrow, leads
from dynsolve.draw.skeleton import finite
from dynsolve.draw.solids import BODY, block, half_axes
from dynsolve.draw.vectors import (
    NEAR,
    ORIGIN,
    Point,
    Rotation,
    Vector,
    View,
    add,
    along,
    any_normal,
    cross,
    dot,
    from_to,
    length,
    moved,
    scale,
    scaled,
    subtract,
    toward,
    unit,
)
from dynsolve.notation.printing import Style
from dynsolve.notation.tree import Node, Number, Symbol
from dynsolve.problem.model import Problem
from dynsolve.questions.constraints.derive import constraint_functions, holonomic
from dynsolve.robot.model import Body, JointType

CAPTION = "The bodies at some values of the coordinates; not to scale. Blue arrows are the axes of the world."
RODS = "A thick line joins points whose distance does not change."
LINES = "A thin grey line is the way along which something slides."
BOXES = "A box is a body that turns, or one that only slides."
DISKS = "A disk is a body that turns as a length changes."
WEDGES = "A triangle is a body that carries the slope on which another moves."
ROLLING = "Where a disk touches a black line, it does not slide on it."
BALLS = "A ball is a point mass."
ZERO = "An angle is 0 at its dashed line."

_ARCS, _CHORD = (40.0, 60.0, 85.0, 115.0), 22.0
"""The radius of an arc is the first with which its ends are as far apart as this."""
_AXIS, _HALF, _BALL = 46.0, 12.0, 6.0
_BEYOND = 34.0
_OFFSETS = (26.0, 52.0, 78.0, 104.0, 130.0)
_STEPS = 24
_LEAST, _MOST, _PAST = 0.1, 0.99, 2.0
"""Between which cosines directions are those of a slope and its base; how far a slope reaches, in radii."""

_ROOMY = 30.0
"""The radius of a disk on paper that has room for its letter."""


def placed_scene(problem: Problem, star: bool = True) -> Scene:
    """The picture of a model by positions."""
    pose = placed_pose(problem)
    stars = frozenset(problem.robot.ring.names) if star else frozenset()
    notes = Notes(replace(PLAIN, stars=stars), Taken())
    bodies = sorted(pose.robot.bodies, key=lambda body: pose.view.depth(_center(body, pose)))
    lines = [_way(piece, pose) for piece in pose.pieces if piece.kind is not Kind.ROD]
    rods = [_way(piece, pose) for piece in pose.pieces if piece.kind is Kind.ROD]
    slopes = {wedge.carrier: wedge for wedge in wedges(pose)}
    lines += [
        Path(paths.line(pose.view.point(_center(body, pose)), wedge.corners[0]), paths.GREY, 1.0)
        for body, wedge in slopes.items()
    ]
    under = [Path(paths.polygon(wedge.corners), fill=BODY.top) for wedge in slopes.values()]
    carried = [wedge.carried for wedge in slopes.values()]
    disks = [path for body in bodies if pose.rolls(body) for path in _body(body, pose, body in carried)]
    others = [
        path for body in bodies if not (pose.rolls(body) or body in slopes) for path in _body(body, pose)
    ]
    solid = (*under, *disks, *rods, *others)
    seen = (*lines, *solid)
    notes.taken.add([*lines, *(replace(wedge, fill=None) for wedge in under), *disks, *rods, *others])
    notes.solid.add([*under, *disks, *others])
    world_axes(pose.view.point(ORIGIN), Number(0), pose.view, _AXIS, notes, end_on=False)
    notes.solid.add(notes.paths)
    turning = list(pose.turning(_STEPS))
    for turned in turning:
        _angle(turned, pose, notes)
    for body in pose.robot.bodies:
        _name(body, pose, slopes.get(body), notes)
    said = _springs(pose, turning, notes)
    kept = constraint_functions(pose.robot, {}).entries if holonomic(pose.robot) else ()
    said += [NOT_HELD] * any(abs(finite(h, pose.values)) > NEAR for h in kept)
    for piece in sorted(pose.pieces, key=lambda piece: _size(piece, pose)):
        _length(piece, pose, notes)
    if pose.gravity is not None:
        tilt(pose.robot, pose.gravity, pose.view, notes)
        gravity_arrow(pose.robot, pose.gravity, pose.view, seen, notes)
    labels = (*place(notes.wanted, notes.taken, notes.lengths), *_radii(pose, notes.style))
    drawn = (*lines, *notes.behind, *solid, *notes.paths, *leads(labels))
    return Scene(
        problem.title or "Bodies",
        " ".join([_caption(pose, labels), *said]),
        _description(problem),
        drawn,
        labels,
        framed(drawn, labels),
        notes.style,
    )


def _caption(pose: PlacedPose, labels: Sequence[Label]) -> str:
    """What stands under the picture, with what its lines are that are not always there."""
    carriers = [wedge.carrier for wedge in wedges(pose)]
    boxes = [body for body in pose.robot.bodies if body not in carriers]
    balls = [body for body in pose.robot.bodies if _axes(body, pose) is None]
    said = (
        (RODS, any(piece.kind is Kind.ROD for piece in pose.pieces)),
        (LINES, any(piece.kind is Kind.SLIDE for piece in pose.pieces)),
        (BOXES, any(_axes(body, pose) and not pose.rolls(body) for body in boxes)),
        (DISKS, any(pose.rolls(body) for body in pose.robot.bodies)),
        (WEDGES, bool(carriers)),
        (ROLLING, any(pose.touches(body) for body in pose.robot.bodies)),
        (BALLS, bool(balls) and all(body.is_point for body in balls)),
        (ZERO, any(label.kind == "variable" for label in labels)),
    )
    return " ".join([CAPTION, *(sentence for sentence, holds in said if holds)])


def _description(problem: Problem) -> str:
    robot = problem.robot
    kinds = [
        f"{q.name} ({'an angle' if q.type is JointType.REVOLUTE else 'a length'})" for q in robot.coordinates
    ]
    bodies = "one body" if len(robot.bodies) == 1 else f"{len(robot.bodies)} bodies"
    return f"The coordinates {', '.join(kinds)} and {bodies}; not to scale."


# -- ways ------------------------------------------------------------------------------------------


def _size(piece: Piece, pose: PlacedPose) -> float:
    return math.dist(pose.point(piece.start), pose.point(piece.end))


def _way(piece: Piece, pose: PlacedPose) -> Path:
    """A rod, the line along which something slides, or what is neither."""
    a, b = pose.point(piece.start), pose.point(piece.end)
    if piece.kind is Kind.ROD:
        return Path(paths.line(a, b), paths.BLACK, 3.0)
    if piece.kind is Kind.SLIDE:
        beyond = _BEYOND / (math.dist(a, b) or 1.0)
        return Path(paths.line(_between(a, b, -beyond), _between(a, b, 1 + beyond)), paths.GREY, 1.2)
    return Path(paths.line(a, b), paths.GREY, 1.0, dashed=True)


def _between(a: Point, b: Point, part: float) -> Point:
    return moved(a, from_to(a, b), part)


def _length(piece: Piece, pose: PlacedPose, notes: Notes) -> None:
    """The name of a length: beside its rod, or on an arrow beside its line."""
    if piece.length is None:
        return
    name = written(pose.robot)(piece.length)
    a, b = pose.point(piece.start), pose.point(piece.end)
    reach = math.dist(a, b)
    if reach < NEAR:
        return
    way = toward(a, b)
    across = -way[1], way[0]
    shared = [p for p in pose.pieces if (p.start, p.direction) == (piece.start, piece.direction)]
    if piece.kind is Kind.ROD and len(shared) == 1:
        notes.label(
            name, [_between(a, b, part) for part in (0.5, 0.6, 0.4, 0.7)], across, paths.BLACK, "length"
        )
        return
    colour = paths.VARIABLE if piece.kind is Kind.SLIDE else paths.BLACK

    def cost(offset: float) -> float:
        start, end = moved(a, across, offset), moved(b, across, offset)
        return (
            40 * (notes.taken.on_line(start, end) + notes.solid.on_line(start, end))
            + 10 * notes.lengths.on_line(start, end)
            + abs(offset) / 20
        )

    offset = min((side * away for away in _OFFSETS for side in (1.0, -1.0)), key=cost)
    start, end = moved(a, across, offset), moved(b, across, offset)
    near, beyond = math.copysign(4.0, offset), offset + math.copysign(5.0, offset)
    for p in (a, b):
        notes.draw(Path(paths.line(moved(p, across, near), moved(p, across, beyond)), paths.GREY, 0.8))
    line, head = paths.arrow(start, moved(end, way, -6.0), end, way, colour, 1.2)
    notes.draw(line, head)
    if piece.kind is not Kind.SLIDE:
        notes.draw(Path(paths.head(start, scaled(way, -1.0)), None, fill=colour))
    notes.lengths.add([line])
    anchors = [_between(start, end, part) for part in (0.5, 0.6, 0.4, 0.7, 0.3)]
    notes.label(name, anchors, scaled(across, offset), colour, "length")


# -- bodies ----------------------------------------------------------------------------------------


def _center(body: Body, pose: PlacedPose) -> Vector:
    return pose.vector(body.center.entries)


def _body(body: Body, pose: PlacedPose, is_carried: bool = False) -> Sequence[Path]:
    """A disk that turns as it slides, a box that turns or slides along a line, or a ball.

    A disk that `is_carried` touches the slope of a wedge, and needs no line of its own.
    """
    center, view = _center(body, pose), pose.view
    at = view.point(center)
    axes = _axes(body, pose)
    if axes is None:
        return (Path(paths.circle(at, _BALL), paths.WHITE, 1.2, paths.BLACK),)
    rolls = pose.rolls(body)
    if rolls is not None:
        return tuple(_disk(center, axes, *rolls, view, touches=pose.touches(body) and not is_carried))
    return block(center, axes, (_HALF,) * 3, view, view.up, BODY).paths


def _disk(
    center: Vector, axes: Rotation, spin: Vector, speed: Vector, view: View, *, touches: bool
) -> Iterator[Path]:
    """A disk with a spoke, and the line on which it rolls, where it `touches` one."""
    at, radius = view.point(center), _radius(spin, speed)
    if touches:
        ground = add(center, scale(cross(spin, speed), 1.0 / dot(spin, spin)))
        reach = [-2.5 * radius, 2.5 * radius]
        back = -dot(ground, unit(speed))
        if length(along(ground, unit(speed), back)) < NEAR:  # the line goes through the origin, a pivot there
            reach = [min(back, *reach), max(back, *reach)]
        yield Path(paths.line(*(view.point(along(ground, unit(speed), x)) for x in reach)), paths.BLACK, 2.0)
    rim = paths.ellipse(at, *half_axes(unit(spin), view, radius * view.size))
    yield Path(rim, fill=BODY.top)
    yield Path(paths.line(at, view.point(along(center, _spoke(axes, spin), radius))), paths.BLACK, 1.4)


def _spoke(axes: Rotation, spin: Vector) -> Vector:
    return min(axes, key=lambda axis: abs(dot(axis, spin)))


def _radii(pose: PlacedPose, style: Style) -> Iterator[Label]:
    """The letter of a disk's radius beside its spoke, where there is room in the disk."""
    for body in pose.robot.bodies:
        axes, rolls, name = _axes(body, pose), pose.rolls(body), pose.radius(body)
        if axes is None or rolls is None or name is None or _radius(*rolls) * pose.view.size < _ROOMY:
            continue
        center = _center(body, pose)
        a, b = (pose.view.point(along(center, _spoke(axes, rolls[0]), t * _radius(*rolls))) for t in (0, 1))
        x, y = toward(a, b)
        line = typeset(Symbol(name), style)
        at = moved(_between(a, b, 0.55), (-y, x), 0.5 * (abs(y) * line.width + abs(x) * line.height) + 2.0)
        yield Label(Symbol(name), line, Box.around(at, line.width, line.height), paths.BLACK, "length")


class Wedge(Struct, frozen=True):
    """A body that carries a slope, the body that moves on it, and the corners, the upper end first."""

    carrier: Body
    carried: Body
    corners: tuple[Point, Point, Point]


def wedges(pose: PlacedPose) -> Iterator[Wedge]:
    """Each body that slides along a line, and from whose place another slides along a slope to that line."""
    view, bodies = pose.view, pose.robot.bodies
    for body, way in zip(bodies, pose.ways, strict=True):
        carriers = [
            (other, others[-1])
            for other, others in zip(bodies, pose.ways, strict=True)
            if others and way and others[-1].end == way[-1].start and not other.turns and _axes(other, pose)
        ]
        if not (view.flat and carriers and way[-1].kind is Kind.SLIDE) or way[-1].turns:
            continue
        carrier, slide = carriers[0]
        slope, level = unit(pose.vector(way[-1].direction)), unit(pose.vector(slide.direction))
        if not _LEAST < abs(dot(slope, level)) < _MOST:
            continue
        rolls = pose.rolls(body)
        if rolls is not None and pose.touches(body):
            to_line = scale(cross(*rolls), 1.0 / dot(rolls[0], rolls[0]))
        elif not body.turns:
            across = cross(view.toward, slope)
            to_line = scale(across, math.copysign(view.space(_HALF), -dot(across, view.up)))
        else:
            continue
        start, at = pose.vector(way[-1].start), add(_center(body, pose), to_line)
        upper = along(add(start, to_line), slope, -dot(to_line, level) / dot(slope, level))
        onward = math.copysign(_PAST * length(to_line), dot(subtract(at, upper), slope))
        lower = along(at, slope, onward)
        corner = along(lower, level, -dot(subtract(lower, upper), level))
        first, second, third = (view.point(each) for each in (upper, lower, corner))
        yield Wedge(carrier, body, (first, second, third))


def _radius(spin: Vector, speed: Vector) -> float:
    """How far from the centre the point at rest is, if the centre moves."""
    return (length(speed) or 1.0) / length(spin)


def _axes(body: Body, pose: PlacedPose) -> Rotation | None:
    """The axes of a body's box; None of a ball."""
    if body.turns:
        return pose.axes(orientation(pose.robot, body))
    way = pose.ways[pose.robot.bodies.index(body)]
    if {piece.kind for piece in way} - {Kind.FIXED} != {Kind.SLIDE} or any(piece.turns for piece in way):
        return None
    first = unit(pose.vector(way[-1].direction))
    second = pose.view.toward if pose.view.flat else any_normal(first)
    return first, second, cross(first, second)


def _name(body: Body, pose: PlacedPose, wedge: Wedge | None, notes: Notes) -> None:
    """The mass of a body, or what moment of inertia it has instead; the radius of a disk."""
    at = pose.view.point(_center(body, pose))
    form = written(pose.robot)
    node: Node
    if not body.mass.is_zero:
        node = form(body.mass)
    else:
        moments = [] if body.inertia is None else [x for x in body.inertia.entries if not x.is_zero]
        node = form(moments[0]) if len(moments) == 1 else Symbol(f"body {body.name}")
    rolls = pose.rolls(body)
    radius = _BALL if _axes(body, pose) is None else _HALF
    radius = radius if rolls is None else pose.view.size * _radius(*rolls)
    if wedge is not None:
        (ax, ay), (bx, by), (cx, cy) = wedge.corners
        at, radius = ((ax + bx + cx) / 3, (ay + by + cy) / 3), 0.0
    notes.label(node, [at], (0.0, 0.0), paths.BLACK, "mass", radius)


# -- the world and angles --------------------------------------------------------------------------


def _angle(turned: Turning, pose: PlacedPose, notes: Notes) -> None:
    """The arrow of an angle, from the line where it is 0."""
    view, at = pose.view, pose.view.point(turned.vertex)
    colour = paths.VARIABLE if turned.name in pose.robot.ring.names else paths.BLACK
    for radius in _ARCS:
        way = [view.point(along(turned.vertex, each, view.space(radius))) for each in turned.directions]
        if math.dist(way[0], way[-1]) > _CHORD:
            break
    zero = _between(at, way[0], 1.4)
    notes.draw(Path(paths.line(at, zero), paths.GREY, 1.0, dashed=True), behind=True)
    if turned.is_axis:
        notes.draw(Path(paths.line(at, _between(at, way[-1], 1.4)), paths.BLACK, 1.6))
    tip, before = way[-1], way[-4]
    notes.draw(
        Path(paths.line(*way[:-3]), colour, 1.4),
        Path(paths.head(tip, from_to(before, tip), 8.0), None, fill=colour),
    )
    anchors = [way[k] for k in (_STEPS // 2, _STEPS // 3, 2 * _STEPS // 3)]
    notes.label(Symbol(turned.name), anchors, from_to(at, anchors[0]), colour, "variable")


# -- springs and dampers -----------------------------------------------------------------------------

SPRINGS = "A zigzag or a spiral is a spring."
OTHER_SPRINGS = (
    "Springs on other than an angle or the distance of two points, or given by their energy, are not drawn."
)
OTHER_DAMPERS = "Dampers on other than an angle or the distance of two points are not drawn."

_BESIDE = (0.0, 20.0, -20.0, 40.0, -40.0)


def _springs(pose: PlacedPose, turning: Sequence[Turning], notes: Notes) -> list[str]:
    """Every spring with its stiffness and every damper with its damping; what is to be said of them."""
    actions, form = pose.robot.actions, written(pose.robot)
    said = []
    for spring in actions.stored:
        along = spring.along
        drawn = along is not None and _draw(along[0], form(along[1]), pose, turning, notes)
        said.append(SPRINGS if drawn else OTHER_SPRINGS)
    for of, damping in (act.along for act in actions.resisting if act.along):
        ends, about = _ends(of, pose), _turned_by(of, pose, turning)
        if ends is not None:
            draw_damper(*_apart(*ends, pose, notes), form(damping), notes)
        elif about is not None:
            draw_turned_damper(*about, pose.view, 1.8 * _HALF, form(damping), notes)
        said.append(DAMPERS if ends or about else OTHER_DAMPERS)
    return list(dict.fromkeys(said))


def _draw(of: Expr, name: Node, pose: PlacedPose, turning: Sequence[Turning], notes: Notes) -> bool:
    """Draw a spring where what it is stretched by is seen; whether there is such a place."""
    ends = _ends(of, pose)
    if ends is not None:
        draw_spring(zigzag(*_apart(*ends, pose, notes)), name, notes, behind=True)
        return True
    about = _turned_by(of, pose, turning)
    if about is not None:
        draw_spring(spiral(*about, pose.view, 1.5 * _HALF), name, notes)
    return about is not None


def _turned_by(of: Expr, pose: PlacedPose, turning: Sequence[Turning]) -> tuple[Vector, Vector] | None:
    """The vertex of an angle and the axis about which it turns."""
    ring = pose.robot.ring
    for turned in turning:
        axis = cross(turned.directions[0], turned.directions[-1])
        is_it = ring.has_symbol(turned.name) and (of * of - ring.symbol(turned.name) ** 2).is_zero
        if is_it and length(axis) > NEAR:
            return turned.vertex, unit(axis)
    return None


def _ends(of: Expr, pose: PlacedPose) -> tuple[Place, Place] | None:
    """Two points whose distance is `of`, of the origin, the centres and the ends of pieces."""
    ring = pose.robot.ring
    centers = [pieces[-1].end for pieces in pose.ways if pieces]
    places = [*centers, (ring.zero,) * 3, *(piece.end for piece in pose.pieces)]
    for a, b in combinations(dict.fromkeys(places), 2):
        apart = (a[0] - b[0], a[1] - b[1], a[2] - b[2])
        if ring.dot(apart, apart) == of * of:
            return a, b
    return None


def _apart(first: Place, second: Place, pose: PlacedPose, notes: Notes) -> tuple[Point, Point, float]:
    """The ends on paper, in their line at the edge of a body, and how far beside it there is room."""
    ends = pose.point(first), pose.point(second)
    way = toward(*ends)
    centers = {pieces[-1].end for pieces in pose.ways if pieces}
    a = moved(ends[0], way, _HALF if first in centers else 0.0)
    b = moved(ends[1], way, -_HALF if second in centers else 0.0)

    def crowded(beside: float) -> float:
        p, q = (moved(moved(end, way, off), (-way[1], way[0]), beside) for end, off in ((a, 5.0), (b, -5.0)))
        return notes.solid.on_line(p, q) + abs(beside) / 1000

    beside = min(_BESIDE, key=crowded)
    notes.solid.add([Path(paths.line(*zigzag(a, b, beside)))])
    return (*ends, beside) if beside else (a, b, beside)
