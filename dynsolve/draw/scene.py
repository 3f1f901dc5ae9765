"""A robot's picture, whole: its body, what is written around it, and the room it takes.

How thick the uniform bodies are: two arrows that point at a body from both sides, with what lies between.

A radius is shown by the diameter, 2r.  The length of a body along its link is written beside the robot, with
those of the table and of the mass centres.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction

from msgspec import Struct
from msgspec.structs import astuple

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.derivation.rules import derive
from dynsolve.draw import paths, poses
from dynsolve.draw.closings import NOT_HELD, Closings, closings, in_walls
from dynsolve.draw.drawn_points import as_drawn, given_lengths, ways_beside
from dynsolve.draw.forces import FORCES, MOMENTS, TURNING, drawn_forces, forces, is_turning
from dynsolve.draw.joint_angles import has_rings, is_right, joint_angles, names_of_angles, offsets, parallels
from dynsolve.draw.labels import Box, Label, Taken, bounds, place, written
from dynsolve.draw.lengths import (
    ASIDE,
    SAME,
    TWISTS,
    WORLD,
    Length,
    angle_between,
    dimensions,
    has_world,
    is_aside,
    moves,
    row_lengths,
    tilt,
    twists,
    world_frame,
)
from dynsolve.draw.mass_centers import DrawnBody, Form
from dynsolve.draw.paths import Path
from dynsolve.draw.pose_search import best_pose, dressed, held_pose
from dynsolve.draw.poses import (
    DAMPERS,
    OTHER_DAMPERS,
    OTHER_SPRINGS,
    SPRINGS,
    Notes,
    Pose,
    joint_dampers,
    joint_springs,
    springs,
)
from dynsolve.draw.skeleton import Orientation, RobotNumbers, numbers, orientation
from dynsolve.draw.solids import BODY, ground, solids
from dynsolve.draw.vectors import (
    IDENTITY,
    NEAR,
    Point,
    Vector,
    View,
    along,
    cross,
    dot,
    length,
    moved,
    scaled,
    toward,
    unit,
)
from dynsolve.notation.characters import SUBSCRIPT_DIGITS
from dynsolve.notation.printing import Style
from dynsolve.notation.tree import Node, Number, Product, Quotient, Symbol, Words
from dynsolve.problem.model import Problem
from dynsolve.questions.constraints.derive import holonomic
from dynsolve.robot.model import JointType, Robot

# How thick the uniform bodies are

_TAIL, _HEAD = 15.0, 7.0
"""How long each of the arrows is, and its head."""

_LABEL = 26.0
"""The side of the square beyond an arrow in which its label is to have room."""

_PLACES = (-0.5, 0.5, -0.3, 0.3, -0.7, 0.7, -0.1, 0.1, -0.9, 0.9)
"""Where along a body its arrows may stand, as parts of half its length: off its ends and its middle first."""

_TURNS = tuple(math.pi * k / 8 for k in range(8))
"""The ways through a ball in which its diameter may be shown."""

_FACING = 0.5
"""A side that is foreshortened more is not shown."""


def thicknesses(robot: Robot, pose: Pose, notes: Notes) -> None:
    """The sides of every body across its length, each letter once."""
    shown: set[Node] = set()
    write = written(robot)
    for body in pose.bodies:
        for axis, side in body.sides:
            name, ways = write(side), list(_ways(body, axis, pose.view))
            if ways and name not in shown:
                shown.add(name)
                p, q = min(ways, key=lambda way: _crowded(way[0], way[1], notes))
                _arrows(p, q, name, notes)


def _ways(body: DrawnBody, axis: int, view: View) -> Iterator[tuple[Point, Point]]:
    """The pairs of points on paper between which a side may be shown; none of one along the body."""
    halves = body.on_paper(view.size)
    is_box = body.form is Form.BOX
    lengthwise = max(range(3), key=lambda k: halves[k]) if is_box else body.main
    across = body.axes[axis] if is_box else cross(body.axes[body.main], view.toward)
    if body.form is Form.BALL or (axis != lengthwise and length(across) < NEAR):
        center = view.point(body.center)
        for turn in _TURNS:
            way = math.cos(turn), math.sin(turn)
            yield moved(center, way, -halves[axis]), moved(center, way, halves[axis])
    elif axis != lengthwise and math.hypot(*view.direction(unit(across))) > _FACING:
        half = scaled(view.direction(unit(across)), halves[axis])
        third = 3 - axis - lengthwise
        toward = dot(body.axes[third], view.toward)
        front = view.space(math.copysign(halves[third], toward)) if is_box else 0.0
        face = along(body.center, body.axes[third], front)
        for part in _PLACES:
            at = view.point(along(face, body.axes[lengthwise], view.space(part * halves[lengthwise])))
            yield moved(at, half, -1.0), moved(at, half, 1.0)


def _crowded(p: Point, q: Point, notes: Notes) -> tuple[int, int]:
    """How much is in the way of the arrows, and of a label at the freer one; and of one at the other."""
    out = toward(q, p)
    tips = (p, out), (q, scaled(out, -1.0))
    tails = sum(notes.taken.cells_on(moved(tip, way, 4.0), moved(tip, way, _TAIL)) for tip, way in tips)
    rooms = (Box.around(moved(tip, way, _TAIL + _LABEL / 2), _LABEL, _LABEL) for tip, way in tips)
    taken = sorted(map(notes.taken.inside, rooms))
    return 4 * tails + taken[0], taken[1]


def _arrows(p: Point, q: Point, name: Node, notes: Notes) -> None:
    out = toward(q, p)
    ends = []
    for tip, way in ((p, out), (q, scaled(out, -1.0))):
        ends.append(moved(tip, way, _TAIL))
        back, inward = moved(tip, way, _HEAD - 2.0), scaled(way, -1.0)
        notes.draw(*paths.arrow(ends[-1], back, tip, inward, paths.BLACK, 1.0, halo=3.4, size=_HEAD))
    notes.label(name, ends, (0.0, 0.0), paths.BLACK, "length")


_ASIDE = 36.0
"""How long the axes of the world are where they stand aside."""

_GRAVITY_ROOM, _WORLD_ROOM = Box(-26.0, -18.0, 36.0, 64.0), Box(-60.0, -60.0, 60.0, 60.0)
"""The room around the beginning of the arrow of gravity, and around the axes of the world."""

MARGIN = 14.0

CAPTION = "The manipulator with its frames; not to scale. 𝐱ᵢ and 𝐳ᵢ begin at the origin 𝐨ᵢ, and 𝐲ᵢ = 𝐳ᵢ × 𝐱ᵢ."
WITHOUT_FRAMES = "The manipulator; not to scale."
PARALLELS = "Dashed grey lines at a joint are parallel to the directions between which its angle is measured."
"""Said where one of them is parallel to no x axis, since degrees are added to its angle."""

OFFSETS = "What the table adds to an angle is drawn beyond its arrow, in grey."
CORNERS = "A square corner is 90°."
RINGS = "A red arrow around an axis shows the positive sense of the angle."
IN_SI = "The number at a spring or a damper is its constant in SI units."
IN_METRES = "Lengths are in m."
SHAPES = "Uniform bodies of a given shape are tan, the rest of the arm is blue-grey."
POINTS = "A black ball is a point mass."
OFF_LINKS = "A black dashed line leads from an origin to a mass centre that lies off its link."

_BOLD = {"x": "𝐱", "y": "𝐲", "z": "𝐳"}
_SUBSCRIPTS = str.maketrans("0123456789", SUBSCRIPT_DIGITS)
_STAR = Style(star=True, decimal=True)
PLAIN = Style(decimal=True)


class Scene(Struct, frozen=True):
    """Paths from back to front, labels on top of them, and the box that holds everything.

    `caption` stands under it in a report, `description` is for those who cannot see it; it is shown at
    `scale` of its usual size.
    """

    title: str
    caption: str
    description: str
    paths: tuple[Path, ...]
    labels: tuple[Label, ...]
    frame: Box
    style: Style
    scale: float = 1.0


def scene(problem: Problem, star: bool = True, frames: bool = True) -> Scene:
    """The picture of a problem's robot, drawn from its table at a pose where it shows best.

    Without `frames` nothing tells where these are: the angles are shown by their senses alone.
    """
    robot = problem.robot
    values = numbers(problem)
    world = orientation(robot, values, problem.normals is not None)
    kept = allowed_pose(robot, values, world)
    pose = kept or best_pose(robot, values, world, as_drawn(problem, values))
    held = (
        closings(robot, values, pose, world) if kept else Closings(said=(NOT_HELD,) * bool(holonomic(robot)))
    )
    under = (*held.under, *ground(pose.parts, pose.view))
    body = (*solids(pose.parts, pose.view, world.up, pose.bodies), *held.body)
    notes = poses.Notes(_STAR if star else PLAIN, Taken())
    notes.taken.add([*under, *body])
    notes.solid.add(body)
    axes = poses.axes_of_frames(pose, world.gravity if frames else None)
    if frames:
        poses.frames(pose, axes, notes)
    if has_world(robot, values):
        under = (*world_frame(robot, values, pose, notes), *under)
    joint_angles(pose, names_of_angles(robot), notes)
    for twist in twists(robot, pose, frames):
        angle_between(*twist, pose.view, notes)
    springs(robot, values, pose, notes)
    poses.motors(robot, values, pose, notes)
    forces(robot, values, pose, notes)
    poses.masses(pose, axes, notes)
    poses.axes_end_on(pose, axes, notes)
    for name, at in held.names:
        notes.label(name, [pose.view.point(at)], (0.0, 0.0), paths.BLACK, "point", poses.MARK)
    thicknesses(robot, pose, notes)
    lengths = [*row_lengths(robot, pose), *moves(robot, values), *held.lengths]
    given = given_lengths(problem, values, pose, [each.node for each in lengths])
    notes.draw(*ways_beside(given, pose), behind=True)
    if given and not frames:  # what the table has in the place of the letters is sought
        lengths = [each for each in lengths if each.varies or isinstance(each.node, Symbol)]
    lengths += given
    dimensions([*lengths, *_center_lengths(robot, pose)], pose, notes)
    if is_aside(robot, values, problem.normals is not None):
        beside = _free_place([*under, *body], notes, _WORLD_ROOM)
        poses.world_axes(beside, Words("w"), pose.view, _ASIDE, notes)
    if world.gravity is not None:
        tilt(robot, world.gravity, pose.view, notes)
        gravity_arrow(robot, world.gravity, pose.view, [*under, *body], notes)
    labels = place(notes.wanted, notes.taken, notes.lengths)
    drawn = (*under, *notes.behind, *body, *notes.paths, *leads(labels))
    return Scene(
        problem.title or "Manipulator",
        " ".join((_caption(problem, values, pose, labels, body, frames), *held.said)),
        _description(problem),
        drawn,
        labels,
        framed(drawn, labels),
        notes.style,
    )


def allowed_pose(robot: Robot, values: RobotNumbers, world: Orientation) -> Pose | None:
    """A pose that the constraints allow; None without constraints on poses, or where none is found."""
    if not holonomic(robot):
        return None
    walls = in_walls(robot, values, world)
    found = held_pose(robot, values, world, derive(robot)["hc"].entries, walls)
    return found and dressed(robot, values, found[0])


def _caption(
    problem: Problem,
    values: RobotNumbers,
    pose: Pose,
    labels: Sequence[Label],
    body: Iterable[Path],
    frames: bool,
) -> str:
    """What stands under the picture, with what its lines are that are not always there."""
    robot, is_drawn = problem.robot, problem.normals is not None
    aside = is_aside(robot, values, is_drawn)
    dashed, at_joints = parallels(robot, pose), joint_springs(robot, values, pose)
    dampers, motors = joint_dampers(robot, values, pose), poses.drawn_motors(robot, values, pose)
    turned_about = _BOLD[robot.base_turns[0][0]] if robot.base_turns else ""
    same_axis = f"{turned_about}₀, about which the base is turned, is that of the world, too."
    said = (
        (WORLD, has_world(robot, values) or aside),
        (ASIDE, aside and frames),
        (SAME, frames and is_drawn and values.base == IDENTITY and not has_world(robot, values)),
        (same_axis, has_world(robot, values) and len(robot.base_turns) == 1),
        (_parallel(dashed), bool(dashed)),
        (OFFSETS, bool(offsets(pose))),
        (CORNERS, any(map(is_right, offsets(pose)))),
        (TWISTS, bool(twists(robot, pose, frames))),
        (RINGS, has_rings(pose)),
        (SHAPES, any(path.fill in astuple(BODY) for path in body)),
        (POINTS, any(mass.is_point for mass in pose.skeleton.masses)),
        (OFF_LINKS, poses.has_masses_off_links(pose)),
        (SPRINGS, bool(at_joints)),
        (OTHER_SPRINGS, len(at_joints) < len(robot.actions.stored)),
        (poses.MOTORS, bool(motors)),
        (poses.OTHER_MOTORS, len(motors) < len(robot.actions.rotors)),
        (DAMPERS, bool(dampers)),
        (OTHER_DAMPERS, len(dampers) < sum(act.along is not None for act in robot.actions.resisting)),
        (FORCES, any(drawn_forces(robot, values, pose))),
        (MOMENTS, any(not load.moment.is_zero for load in robot.questions.loads)),
        (TURNING, any(map(is_turning, robot.questions.loads))),
        (IN_SI, any(label.kind in ("spring", "damper") and _is_number(label) for label in labels)),
        (IN_METRES, any(label.kind == "length" and _is_number(label) for label in labels)),
    )
    opening = CAPTION if frames else WITHOUT_FRAMES
    return " ".join([opening, *(sentence for sentence, holds in said if holds)])


def _is_number(label: Label) -> bool:
    return not set("".join(run.text for run in label.line.runs)) - set("0123456789./√")


def _parallel(found: Sequence[tuple[str, int] | None]) -> str:
    """To which axes the dashed lines are parallel.

    >>> _parallel([("x", 1)])
    'The dashed grey line is parallel to 𝐱₁.'
    >>> _parallel([("z", 1), ("x", 1), ("x", 4)])
    'The dashed grey lines are parallel to 𝐳₁, 𝐱₁ and 𝐱₄.'
    """
    known = dict.fromkeys(axis for axis in found if axis is not None)
    if not known or None in found:
        return PARALLELS
    axes = [f"{_BOLD[letter]}{str(frame).translate(_SUBSCRIPTS)}" for letter, frame in known]
    named = " and ".join([", ".join(axes[:-1]), axes[-1]] if len(axes) > 1 else axes)
    return f"The dashed grey {'line is' if len(found) == 1 else 'lines are'} parallel to {named}."


def _center_lengths(robot: Robot, pose: Pose) -> list[Length]:
    """The distances that lead to mass centres, each a number, one symbol, or a simple part of one."""
    found, write = [], Compactor(robot.ring).form
    for step in (step for mass in pose.skeleton.masses for step in mass.steps):
        rate = Fraction(step.rate).limit_denominator(12)
        if step.number is not None or abs(rate - step.rate) < NEAR:
            node = _part(Symbol(step.symbol), rate) if step.number is None else write(step.number)
            found.append(Length(step.start, step.end, node, optional=True))
    return found


def _part(symbol: Symbol, rate: Fraction) -> Node:
    """rate·symbol as it is written: l_2, l_2/2, 2l_2/3."""
    times = symbol if rate.numerator == 1 else Product((Number(rate.numerator), symbol))
    return times if rate.denominator == 1 else Quotient(times, Number(rate.denominator))


def gravity_arrow(
    robot: Robot, gravity: Vector, view: View, body: Iterable[Path], notes: poses.Notes
) -> None:
    """The arrow of gravity, at the side where there is most room."""
    poses.gravity(robot, _free_place(body, notes, _GRAVITY_ROOM), gravity, view, notes)


def _free_place(body: Iterable[Path], notes: poses.Notes, room: Box) -> Point:
    """Where the most of a `room` around a place is free, at the sides of what is drawn; else beside it."""
    box = bounds([*body, *notes.paths])
    places = [
        (x, y)
        for y in (box.top + 14.0, box.top + 60.0, (box.top + box.bottom) / 2)
        for x in (box.right - 12.0, box.left + 12.0)
    ]

    def crowded(at: Point) -> int:
        x, y = at
        return notes.taken.inside(Box(x + room.left, y + room.top, x + room.right, y + room.bottom))

    best = min(places, key=crowded)
    return (box.right + 40.0, box.top + 30.0) if crowded(best) else best


def leads(labels: Iterable[Label]) -> Iterable[Path]:
    """Thin lines from labels that stand far away to what they name, in the colour of both."""
    return [Path(paths.line(*label.lead), label.colour, 0.7) for label in labels if label.lead]


def framed(paths: Iterable[Path], labels: Iterable[Label]) -> Box:
    """The box around everything, with a margin."""
    box = bounds(paths)
    boxes = [box, *(label.box for label in labels)]
    return Box(
        round(min(b.left for b in boxes) - MARGIN, 0),
        round(min(b.top for b in boxes) - MARGIN, 0),
        round(max(b.right for b in boxes) + MARGIN, 0),
        round(max(b.bottom for b in boxes) + MARGIN, 0),
    )


def _description(problem: Problem) -> str:
    robot = problem.robot
    kinds = [
        f"{'revolute' if q.type is JointType.REVOLUTE else 'prismatic'} joint {q.index} ({q.name})"
        for q in robot.coordinates
    ]
    return (
        f"The manipulator with {', '.join(kinds)}; frames 0 to {len(robot.joints)} with their x and z axes"
        f" ({robot.convention.value} Denavit-Hartenberg); not to scale."
    )
