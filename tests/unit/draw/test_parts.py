"""What pictures are made of: shapes, places for labels, uniform bodies and their thicknesses."""

from __future__ import annotations

import math
from itertools import combinations
from pathlib import Path
from random import Random

import pytest
from msgspec.structs import replace

from dynsolve.algebra.ring_values import evaluate
from dynsolve.derivation.kinematics import base_transform, dh_matrix, frame
from dynsolve.draw import PictureFormat, draw, paths, picture
from dynsolve.draw.figure import to_pdf, to_png
from dynsolve.draw.labels import CELL, Box, Taken
from dynsolve.draw.mass_centers import DrawnBody, Form, drawn_bodies, sleeves, with_masses
from dynsolve.draw.paths import BLACK, circle, flattened, typeset
from dynsolve.draw.pose_search import LARGEST, best_pose
from dynsolve.draw.scene import Scene
from dynsolve.draw.skeleton import numbers, orientation, skeleton
from dynsolve.draw.solids import BODY, body_solids
from dynsolve.draw.vectors import IDENTITY, applied, distance, dot, into, turned
from dynsolve.notation.printing import Style
from dynsolve.notation.tree import Degrees, Letter, Number, Quotient, Row, Sum, Symbol, Words
from dynsolve.problem import load, read_problem
from dynsolve.problem.model import Problem
from dynsolve.robot.model import JointType
from tests.conftest import LARGE
from tests.support import LIBRARY, TEXTBOOKS
from tests.unit.draw.pictures import drawn, drawn_text, names

# -- what pictures are made of: lengths, the chain of points, shapes, places for labels, conversions -


def problem(text: str):
    return read_problem(text.encode(), "problem.yaml")


@pytest.mark.parametrize("path", [*LIBRARY, *TEXTBOOKS], ids=lambda path: path.stem)
def test_frames_are_where_the_product_of_the_A_puts_them(path: Path) -> None:
    """The chain of legs against the book's matrices, with all given lengths as they are drawn."""
    robot = load(path).robot
    values = numbers(load(path))
    q = [0.3 + 0.4 * k for k in range(robot.n)]
    state = dict(values.values) | {c.name: x for c, x in zip(robot.coordinates, q, strict=True)}
    scaled = [c.name for c in robot.coordinates if c.type.value == "prismatic"]
    state |= {name: state[name] * values.unit for name in scaled}
    frames = [base_transform(robot)]
    pose = skeleton(robot, values, q)
    named = all(
        "Number" not in repr(joint.written[1:3]).replace("Number(p=0, q=1)", "") for joint in robot.joints
    )
    for joint, found in zip(robot.joints, pose.frames[1:], strict=True):
        H = frame(frames[joint.parent], dh_matrix(robot, joint))
        frames.append(H)
        turned_to = [[evaluate(H[i, j], state) for i in range(3)] for j in range(3)]
        for column, axis in zip(turned_to, found.axes, strict=True):
            assert axis == pytest.approx(column, abs=1e-9)
        if named and not robot.base_position.rows[0][0].is_zero:
            continue
        if named:
            place = [evaluate(H[i, 3], state) / values.unit for i in range(3)]
            assert found.origin == pytest.approx(place, abs=1e-9)


def test_given_lengths_keep_their_order_and_none_is_too_short() -> None:
    rows = numbers(problem("dh: [{theta: t1*, d: 400}, {theta: t2*, a: 3}, {theta: t3*, a: 200}]")).rows
    assert rows[1].a == pytest.approx(0.42, abs=0.01)
    assert rows[1].a < rows[2].a < rows[0].d == pytest.approx(1.0)


def test_lengths_with_values_keep_their_proportions() -> None:
    rows = numbers(problem("dh: [{theta: t1*, a: l1}, {theta: t2*, a: l2}]\nvalues: {l1: 0.5, l2: 0.4}")).rows
    assert (rows[0].a, rows[1].a) == pytest.approx((1.0, 0.8))


def test_a_length_that_came_out_as_zero_is_tried_with_other_numbers() -> None:
    assert numbers(problem("dh: [{theta: t1*, a: r - s}]")).rows[0].a != 0.0


def test_a_turn_and_back() -> None:
    R = turned(turned(IDENTITY, 2, 0.7), 0, -1.1)
    assert into(R, applied(R, (1.0, 2.0, 3.0))) == pytest.approx((1.0, 2.0, 3.0))


def test_a_circle_of_curves_is_round() -> None:
    for a, _ in flattened(circle((1.0, 2.0), 5.0)):
        assert math.dist(a, (1.0, 2.0)) == pytest.approx(5.0, abs=5e-3)


def test_areas_and_lines_take_their_place() -> None:
    from dynsolve.draw.paths import Path as Drawn
    from dynsolve.draw.paths import line, polygon

    taken = Taken()
    taken.add([Drawn(polygon([(0.0, 0.0), (60.0, 0.0), (60.0, 60.0), (0.0, 60.0)]), fill="#ffffff")])
    assert taken.inside(Box(20.0, 20.0, 40.0, 40.0)) and not taken.inside(Box(70.0, 0.0, 90.0, 20.0))
    taken.add([Drawn(line((70.0, 10.0), (100.0, 10.0)))])
    assert taken.inside(Box(75.0, 5.0, 80.0, 15.0)) and taken.on_line((70.0, 10.0), (100.0, 10.0)) == 1.0


@pytest.mark.parametrize(
    ("a", "b", "meets"),
    [
        ((-5, 5), (15, 5), True),
        ((-5, 5), (-1, 5), False),
        ((5, -5), (5, 2), True),
        ((-5, 11), (15, 12), False),
    ],
)
def test_a_line_meets_a_box(a: tuple[float, float], b: tuple[float, float], meets: bool) -> None:
    assert Box(0.0, 0.0, 10.0, 10.0).meets(a, b) is meets


def test_formulas_are_set_in_runs() -> None:
    node = Sum((Symbol("theta1", star=True), Quotient(Symbol("lc1"), Number(2)), Degrees(90)))
    runs = typeset(node, Style(star=True)).runs
    assert [run.text for run in runs] == ["θ", "1", "∗", "+", "l", "c", "1", "/2\xa0+\xa090°"]
    assert [run.italic for run in runs[:6]] == [True, False, False, False, True, False]  # the c describes
    assert runs[1].shift > 0 > runs[2].shift and runs[3].gap > 0


def test_vectors_are_bold_as_in_the_text() -> None:
    runs = typeset(Letter("r", Row((Words("c"), Number(1))), style="bold"), Style()).runs
    assert [(run.text, run.bold, run.italic) for run in runs] == [
        ("r", True, False), ("c", False, False), ("1", False, False),
    ]  # fmt: skip
    assert runs[1].shift > 0


@pytest.mark.parametrize("make", [to_pdf, to_png])
def test_conversions_give_the_same_bytes(make) -> None:
    pytest.importorskip("typst")
    svg = draw(load(LIBRARY[0])).decode()
    first = make(svg)
    assert first == make(svg) and first[:4] in (b"%PDF", b"\x89PNG")


def test_a_picture_for_documents_has_svg_and_latex() -> None:
    block = picture(load(next(path for path in LIBRARY if path.stem == "in3140-rp")))
    assert block.svg.startswith("<svg") and r"\begin{picture}" in block.latex
    assert r"$\theta_{1}^{\star}$" in block.latex and "usepackage" not in block.latex


def test_fractions_stand_on_the_line_in_latex() -> None:
    block = picture(load(next(path for path in LIBRARY if path.stem == "box-cylinder-rod-sphere")))
    assert "$l_{2}/2$" in block.latex and r"\frac" not in block.latex


def test_the_latex_has_balanced_groups() -> None:
    tex = draw(load(LIBRARY[0]), PictureFormat.LATEX).decode()
    assert tex.count("{") == tex.count("}") and "%" not in tex.replace("%\n", "")


@pytest.mark.slow
def test_parts_of_a_robot_keep_apart() -> None:
    from dynsolve.draw.pose_search import best_pose
    from dynsolve.draw.skeleton import orientation

    for path in (path for path in LIBRARY if path.stem not in LARGE):
        robot, values = load(path).robot, numbers(load(path))
        pose = best_pose(robot, values, orientation(robot, values))
        centers = [part.center for part in pose.parts.joints]
        gaps = [distance(a, b) * pose.view.size for k, a in enumerate(centers) for b in centers[k + 1 :]]
        assert min(gaps, default=99.0) > 30.0, path.stem


# -- which places on paper are taken -----------------------------------------------------------------


def test_the_cells_in_a_box_are_counted_as_lines_are_added() -> None:
    """Against every cell of the box asked for by itself."""
    random, taken = Random(7), Taken()
    assert taken.inside(Box(-9.0, -9.0, 9.0, 9.0)) == 0
    for _ in range(40):
        a, b, corner = (tuple(random.uniform(-40, 40) for _ in range(2)) for _ in range(3))
        taken.add_line(a, b)
        box = Box(corner[0], corner[1], corner[0] + random.uniform(0, 30), corner[1] + random.uniform(0, 30))
        columns = range(int(box.left // CELL), int(box.right // CELL) + 1)
        rows = range(int(box.top // CELL), int(box.bottom // CELL) + 1)
        middles = [((i + 0.5) * CELL, (j + 0.5) * CELL) for i in columns for j in rows]
        assert taken.inside(box) == sum(taken.inside(Box(*middle, *middle)) for middle in middles)
        assert taken.inside(Box(*a, *a)) == 1


def test_an_area_is_taken_with_its_inside() -> None:
    """A square of 10 by 10 cells."""
    taken = Taken()
    corners = [(0.5, 0.5), (0.5 + 9 * CELL, 0.5), (0.5 + 9 * CELL, 0.5 + 9 * CELL), (0.5, 0.5 + 9 * CELL)]
    taken.add([paths.Path(paths.polygon(corners), fill=paths.GREY)])
    assert taken.inside(Box(-100.0, -100.0, 100.0, 100.0)) == 100


# -- uniform bodies in a picture: their forms, and their sizes where the picture knows them ----------


TELESCOPE = next(path for path in LIBRARY if path.stem == "box-cylinder-rod-sphere")

ARM = """
dh: [{{theta: q1*, a: l1}}]
values: {{l1: 0.5, r: 0.1}}
masses: [{{mass: m1, link: 1, center: midpoint, shape: {shape}}}]
"""


def bodies(problem: Problem, q: float = 0.0) -> tuple[DrawnBody, ...]:
    robot, values = problem.robot, numbers(problem)
    return drawn_bodies(robot, values, with_masses(robot, values, skeleton(robot, values, [q] * robot.n)))


@pytest.mark.parametrize(
    ("shape", "form", "halves"),
    [
        ("{box: {x: l1, y: 0.2, z: b}}", Form.BOX, (0.5, 0.2, None)),
        ("{sphere: {radius: 0.1}}", Form.BALL, (0.2, 0.2, 0.2)),
        ("{sphere: {radius: c}}", Form.BALL, (None, None, None)),
        ("{rod: {length: l1, axis: x}}", Form.ROUND, (0.5, None, None)),
        ("{cylinder: {radius: r, length: l1, axis: x}}", Form.ROUND, (0.5, 0.2, 0.2)),
    ],
)
def test_sides_that_are_known(shape: str, form: Form, halves: tuple[float | None, ...]) -> None:
    """Half of each side over the longest length of the table; a letter without a number has no length."""
    (body,) = bodies(read_problem(ARM.format(shape=shape).encode(), "arm.yaml"))
    assert body.form is form
    assert body.halves == pytest.approx(halves)
    assert min(body.on_paper(100.0)) >= 3.0


def test_every_body_of_the_telescope_is_drawn() -> None:
    """A cylinder upright, a box and a rod along the arm, a sphere at its tip."""
    problem = load(TELESCOPE)
    found = bodies(problem, 0.6)
    assert [body.form for body in found] == [Form.ROUND, Form.BOX, Form.ROUND, Form.BALL]
    assert [body.link for body in found] == [1, 2, 3, 3]
    upright, box, rod, _ = found
    assert abs(dot(upright.axes[upright.main], (0.0, 0.0, 1.0))) == pytest.approx(1.0)
    assert abs(dot(box.axes[2], rod.axes[rod.main])) == pytest.approx(1.0)
    colours = {path.fill for path in drawn(TELESCOPE).paths}
    assert {BODY.top, BODY.side} <= colours


def test_a_slide_stands_at_the_end_of_the_body_that_it_slides_in() -> None:
    problem = load(TELESCOPE)
    (row, reach), *others = sleeves(problem.robot, numbers(problem)).items()
    box = bodies(problem)[1]
    assert (row, others) == (3, [])
    assert reach == pytest.approx(2 * (box.halves[2] or 0.0))


def test_a_guide_stands_at_the_mass_centre_of_the_body_that_it_is_part_of() -> None:
    """Craig, figure 6.7: the first mass is that of the guide, and not on the rod that slides in it."""
    problem = load(next(path for path in LIBRARY if path.stem == "rp-vertical"))
    robot, values = problem.robot, numbers(problem)
    pose = best_pose(robot, values, orientation(robot, values), None)
    guide = pose.parts.joints[1]
    assert guide.type is JointType.PRISMATIC
    assert guide.center == pytest.approx(pose.skeleton.masses[0].center, abs=0.05)


def test_point_masses_have_no_body() -> None:
    assert bodies(read_problem(ARM.format(shape="point").encode(), "arm.yaml")) == ()


def test_a_rod_in_a_thicker_body_is_hidden_there() -> None:
    """Of two bodies about one point along x, what is drawn of the thin one lies beyond the other's ends."""
    text = """
dh: [{theta: q1*, a: l1}]
values: {l1: 1}
masses:
  - {mass: m1, link: 1, center: midpoint, shape: {box: {x: 0.4, y: 0.2, z: 0.2}}}
  - {mass: m2, link: 1, center: midpoint, shape: {rod: {length: 0.8, axis: x}}}
"""
    problem = read_problem(text, "arm.yaml")
    robot, values = problem.robot, numbers(problem)
    pose = best_pose(robot, values, orientation(robot, values))
    _, *rods = body_solids(pose.bodies, replace(pose.parts, joints=()), pose.view, (0.0, 0.0, 1.0))
    assert len(rods) == 2
    size, center = pose.view.size, pose.view.point(pose.bodies[0].center)
    for rod in rods:
        ends = [math.dist(point, center) for piece in flattened(rod.paths[0].commands) for point in piece]
        assert min(ends) > 0.2 * size - 3.0 and max(ends) == pytest.approx(0.4 * size, abs=3.0)


# -- the thickness of uniform bodies in a picture: two arrows that point at each other, with its letter


THICK = """
dh: [{{theta: q1*, a: a1}}]
values: {{a1: 1}}
masses: [{{mass: m1, link: 1, center: midpoint, shape: {shape}}}]
"""


@pytest.mark.parametrize(
    ("shape", "written"),
    [
        ("{box: {x: a1, y: w, z: t}}", {"w"}),
        ("{cylinder: {radius: R, length: a1, axis: x}}", {"2R"}),
        ("{hollow_cylinder: {outer: R, inner: r, length: a1, axis: x}}", {"2R"}),
        ("{disk: {radius: r}}", {"2r"}),
        ("{sphere: {radius: r}}", {"2r"}),
        ("{rod: {length: a1, axis: x}}", set()),
    ],
)
def test_what_is_written(shape: str, written: set[str]) -> None:
    """Across a body, what is seen of it: not the side of a box towards the viewer, and of radii the outer."""
    assert set(names(drawn_text(THICK.format(shape=shape)), "length")) - {"a1", "a₁"} == written


def gaps(picture: Scene) -> list[float]:
    """The distances between the tips of black arrows."""
    found = (path for path in picture.paths if path.fill == BLACK and path.stroke is None)
    tips = [next(flattened(path.commands))[0] for path in found]
    return [math.dist(a, b) for a, b in combinations(tips, 2)]


def test_the_arrows_stand_as_far_apart_as_the_body_is_thick() -> None:
    """A box of a fifth of the longest length, which takes no more than it may on paper."""
    thick, bare = (
        gaps(drawn_text(THICK.format(shape=shape)))
        for shape in ("{box: {x: a1, y: 0.2, z: t}}", "{rod: {length: a1, axis: x}}")
    )
    across = pytest.approx(0.2 * LARGEST, rel=0.01)
    assert across in thick
    assert across not in bare


@pytest.mark.parametrize(("d", "moved"), [("h", 1.5), ("0", 0.75)])
def test_the_world_is_drawn_clear_of_other_frames(d: str, moved: float) -> None:
    """From the ceiling the first link leads down by nearly as much as the base is drawn above the world."""
    base = "base: {rotate: Rx(180deg), move: [0, 0, H]}"
    text = f"{base}\ndh: [{{theta: q1*, d: {d}, alpha: 90deg}}, {{theta: q2*, a: l}}]\n"
    assert numbers(read_problem(text.encode(), "ceiling.yaml")).moved == (0.0, 0.0, moved)
