"""Every robot's picture: whole, readable, and the same every time."""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from itertools import combinations
from pathlib import Path

import pytest
from msgspec.structs import replace

from dynsolve.draw.figure import font_size, to_svg
from dynsolve.draw.labels import Taken, bounds
from dynsolve.draw.parts import HALF_HEIGHT
from dynsolve.draw.paths import BLACK, FRAME, GREY, SIZE, VARIABLE, WHITE, flattened, line
from dynsolve.draw.paths import Path as Drawn
from dynsolve.draw.pose_search import best_pose
from dynsolve.draw.poses import AROUND
from dynsolve.draw.scene import OFF_LINKS, SHAPES, Scene, scene
from dynsolve.draw.skeleton import numbers, orientation
from dynsolve.draw.solids import BODY, solids
from dynsolve.draw.vectors import Point, distance, dot, segment_distance
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem import load, read_problem
from dynsolve.robot.model import JointType
from tests.support import LIBRARY, TEXTBOOKS
from tests.unit.draw.pictures import drawn, drawn_text, names, overlapping, struck_through, touched

ALL = [*LIBRARY, *TEXTBOOKS]

ODD = {
    "one revolute joint": "dh: [{theta: q1*}]",
    "one prismatic joint": "dh: [{d: q1*}]",
    "no lengths at all": "dh: [{theta: q1*}, {theta: q2*}, {theta: q3*}]",
    "no gravity": "gravity: none\ndh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]",
    "gravity across the plane": "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]",
    "a turned base": "base: Rx(90deg)\ndh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {d: q3*}]",
    "on a wall": "base: Ry(90deg)\ndh: [{theta: q1*, d: L1, alpha: 90deg}, {theta: q2*, a: l2}, {a: 0.3}]",
    "fixed rows first": "dh: [{a: b0, d: h0}, {theta: q1*, a: l1}, {theta: q2*, a: l2}]",
    "three slides": "dh: [{d: d1*, alpha: -90deg}, {d: d2*, theta: -90deg, alpha: -90deg}, {d: d3*}]",
    "hanging": "base: Rx(180deg)\ndh: [{theta: t1*, d: L1, alpha: 90deg}, {theta: t2*, a: l2}]",
    "roots and quotients": "dh: [{theta: t1* + beta, d: s/r, alpha: gamma}, {theta: t2*, a: sqrt(r - s)}]",
    "very different lengths": "dh: [{theta: t1*, d: 400, alpha: 90deg}, {theta: t2*, a: 3}]",
    "negative lengths": "dh: [{theta: t1*, d: -d1, alpha: 90deg}, {theta: t2*, a: -a2}]",
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("path", ALL, ids=lambda path: path.stem)
def test_no_label_lies_on_another(path: Path) -> None:
    assert overlapping(drawn(path)) == []


@pytest.mark.slow
@pytest.mark.parametrize("path", ALL, ids=lambda path: path.stem)
def test_no_line_runs_through_a_label(path: Path) -> None:
    assert struck_through(drawn(path)) == []


@pytest.mark.slow
@pytest.mark.parametrize("path", ALL, ids=lambda path: path.stem)
def test_no_line_touches_a_label(path: Path) -> None:
    assert touched(drawn(path), room=0.5) == []


def test_a_line_that_touches_a_label_is_found() -> None:
    picture = drawn(LIBRARY[0])
    box = picture.labels[0].box
    beside = line((box.right + 1.0, box.top), (box.right + 1.0, box.bottom))
    assert len(touched(replace(picture, paths=(*picture.paths, Drawn(beside))), room=0.5)) == 1


@pytest.mark.parametrize("unit", [0.2, 0.35, 0.41, 0.5, 0.55, 0.6])
def test_letters_of_latex_are_as_large_as_their_places(unit: float) -> None:
    """At every size of a picture, so that what is clear of lines in SVG is clear of them on paper."""
    points = font_size(unit)
    assert points <= max(SIZE * unit * 72.27 / 72, 5)
    assert points > 0.8 * SIZE * unit


def arcs(picture: Scene) -> list[Drawn]:
    """The arrows of angles without their heads; the line to a label is thinner."""
    red = (path for path in picture.paths if path.stroke == VARIABLE and not path.fill)
    return [path for path in red if path.width > 1.0]


@pytest.mark.parametrize("name", ["planar-2r", "planar-2r-remote", "numeric-2r"])
def test_arrows_of_angles_turn_as_the_axes_say(name: str) -> None:
    """z out of the page: each arrow goes on counterclockwise from its x axis, by less than half a turn."""
    path = next(path for path in LIBRARY if path.stem == name)
    problem = load(path)
    values = numbers(problem)
    pose = best_pose(problem.robot, values, orientation(problem.robot, values))
    for leg in pose.skeleton.legs:
        assert dot(leg.axis, pose.view.toward) == pytest.approx(1.0)
        assert 0.0 < leg.angle % (2 * math.pi) < math.pi
    arrows = arcs(drawn(path))
    for arrow in arrows:
        points = [a for a, _ in flattened(arrow.commands)]
        turn = sum(
            (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])
            for a, b, c in zip(points, points[1:], points[2:], strict=False)
        )
        assert turn < 0.0, "y grows downwards on a screen"
    assert len(arrows) == 2


@pytest.mark.parametrize("path", ALL, ids=lambda path: path.stem)
def test_every_robot_is_drawn_with_its_letters(path: Path) -> None:
    root = ET.fromstring(to_svg(drawn(path)))  # noqa: S314 - our own
    assert len(root.findall("{http://www.w3.org/2000/svg}text")) > 8


@pytest.mark.parametrize("path", ALL, ids=lambda path: path.stem)
def test_everything_is_inside_the_picture(path: Path) -> None:
    picture = drawn(path)
    frame = picture.frame
    for label in picture.labels:
        box = label.box
        assert frame.left < box.left and box.right < frame.right, label
        assert frame.top < box.top and box.bottom < frame.bottom, label
    for x, y in (point for p in picture.paths for piece in flattened(p.commands) for point in piece):
        assert frame.left < x < frame.right and frame.top < y < frame.bottom


@pytest.mark.parametrize("path", ALL, ids=lambda path: path.stem)
def test_axes_joints_and_masses_are_named(path: Path) -> None:
    robot, picture = load(path).robot, drawn(path)
    subscripts = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
    axes = [f"{letter}{i}".translate(subscripts) for letter in "xz" for i in range(len(robot.joints) + 1)]
    x, y, z = (not entry.is_zero for entry in (robot.base_rotation.T @ robot.gravity).entries)
    along_y = ["y₀"] if y and not (x or z) else []
    assert sorted(names(picture, "axis")) == sorted([*axes, *along_y])
    assert names(picture, "mass") == [f"r_c{body.name}" for body in robot.bodies]
    moving = {k for joint in robot.joints for k, _ in joint.rates}
    assert sum("⋆" in name for name in names(picture, "variable")) == (
        sum(joint.type is not None for joint in robot.joints)
        + sum(rotor.turns not in moving for rotor in robot.actions.rotors)
    )
    letter = "g₀" if "g0" in robot.parameters else "g"
    assert names(picture, "gravity") == ([] if robot.gravity.is_zero else [letter])


@pytest.mark.parametrize("text", ODD.values(), ids=ODD.keys())
def test_odd_robots_are_drawn(text: str) -> None:
    picture = drawn_text(text)
    assert overlapping(picture) == []
    assert "nan" not in to_svg(picture) and "inf" not in to_svg(picture)


@pytest.mark.parametrize("name", ["in3140-rp", "planar-2r", "puma560"])
def test_a_picture_is_the_same_every_time(name: str) -> None:
    path = next(path for path in LIBRARY if path.stem == name)
    assert to_svg(scene(load(path))) == to_svg(drawn(path))


def test_a_planar_arm_is_drawn_flat() -> None:
    """Seen from straight in front, z axes are points and x axes have their full length."""
    problem = load(next(path for path in LIBRARY if path.stem == "planar-2r"))
    world = orientation(problem.robot, numbers(problem))
    assert world.normal == pytest.approx((0.0, 0.0, 1.0)) and world.up == pytest.approx((0.0, 1.0, 0.0))


@pytest.mark.parametrize("name", ["in3140-rp", "elbow-3r", "scara-rrpr", "crustcrawler-2r"])
def test_an_arm_that_leaves_its_plane_is_drawn_in_space(name: str) -> None:
    problem = load(next(path for path in LIBRARY if path.stem == name))
    assert orientation(problem.robot, numbers(problem)).normal is None


def test_a_part_of_a_symbol_is_labelled_as_that_part() -> None:
    """[0, 0, l2/2] puts the centre half of l2 away, and the picture says so."""
    shown = names(drawn(next(path for path in LIBRARY if path.stem == "box-cylinder-rod-sphere")))
    assert "l₂/2" in shown and "l₂" not in shown


def test_a_length_is_labelled_as_the_text_has_it() -> None:
    """Half of l beside a decimal that the file has."""
    text = "dh: [{theta: q1*, d: 0.35, a: l/2}]\nmasses: [{mass: m, link: 1}]\nfriction: {q1: 0.5}\n"
    assert sorted(names(drawn_text(text), "length")) == ["0.35", "l/2"]


def test_a_mass_centre_that_is_given_by_a_number_has_its_distance() -> None:
    """`near: [0.15, 0, 0]`; what is half-way, or at the end, needs none."""
    shown = names(drawn(next(path for path in LIBRARY if path.stem == "numeric-2r")), "length")
    assert sorted(shown) == ["0.15", "0.4", "0.5"]


@pytest.mark.parametrize(
    ("center", "said"),
    [("[-0.1, 0, 0]", "0.1"), ("{near: [0, 0.1, 0]}", "0.1"), ("[0.1, 0.2, 0]", ""), ("[-a1/2, 0, 0]", "")],
)
def test_a_number_along_one_axis_is_a_distance(center: str, said: str) -> None:
    """With a number of a1 too: its letter is what the file says of the centre."""
    text = (
        f"dh: [{{theta: q1*, a: a1}}]\nmasses: [{{mass: m1, link: 1, center: {center}}}]\nvalues: {{a1: 0.5}}"
    )
    assert [name for name in names(drawn_text(text), "length") if name != "a₁"] == ([said] if said else [])


@pytest.mark.parametrize(
    ("gravity", "letter"),
    [("0, -g0", "g₀"), ("0, -9.81", "g"), ("0, -2*G", "g"), ("G*sin(b), -G*cos(b)", "G")],
)
def test_the_arrow_of_gravity_has_the_letter_of_the_file(gravity: str, letter: str) -> None:
    arm = f"gravity: [{gravity}, 0]\ndh: [{{theta: q1*, a: l}}]\nmasses: [{{mass: m, link: 1}}]\n"
    assert names(drawn_text(arm), "gravity") == [letter]


def test_a_part_of_the_way_is_measured_from_where_it_begins() -> None:
    arm = "dh: [{theta: q1*, a: 0.5}]\nmasses: [{mass: 5, link: 1, center: {along: 2/5}}]\n"
    assert "0.2" in names(drawn_text(f"gravity: [0, -g, 0]\n{arm}"), "length")


def test_a_letter_of_a_mass_centre_beside_another_has_its_length() -> None:
    arm = "dh: [{theta: q* + 90deg, a: w, alpha: 90deg}, {d: rho*}]\n"
    masses = "masses: [{mass: m1, link: 1, center: [-w/2, 0, 0]}, {mass: m2, link: 2, center: [0, u, -v]}]\n"
    assert "v" in names(drawn_text(f"gravity: [0, -g, 0]\n{arm}{masses}"), "length")


@pytest.mark.parametrize("name", ["box-cylinder-rod-sphere", "puma560", "stanford-6"])
def test_lines_of_labels_do_not_cross(name: str) -> None:
    leads = [label.lead for label in drawn(next(p for p in LIBRARY if p.stem == name)).labels if label.lead]
    assert all(segment_distance(a, b) > 0.0 for k, a in enumerate(leads) for b in leads[k + 1 :])


def test_lines_of_labels_keep_off_those_of_lengths() -> None:
    """The mass centre of link 2 and z₂ stand where its length is measured."""
    picture = drawn(next(path for path in LIBRARY if path.stem == "spherical-rrp"))
    leads = [label.lead for label in picture.labels if label.lead]
    own = [line(*lead) for lead in leads]
    thin = [p for p in picture.paths if (p.stroke, p.width) == (GREY, 0.7) and p.commands not in own]
    lengths = [*_shafts(picture), *(piece for p in thin for piece in flattened(p.commands))]
    assert leads
    assert thin
    assert min(segment_distance(a, b) for a in leads for b in lengths) > 1.0


def test_a_line_leads_from_a_label_that_is_not_beside_what_it_names() -> None:
    picture = drawn(next(path for path in LIBRARY if path.stem == "spherical-rrp"))
    x0 = next(label for label in picture.labels if names(replace(picture, labels=(label,))) == ["x₀"])
    assert x0.lead


def test_mass_centres_of_a_branch_are_half_way_along_its_own_link() -> None:
    """Link 4 of the five-bar linkage starts from frame 1."""
    problem = load(next(path for path in LIBRARY if path.stem == "five-bar"))
    values = numbers(problem)
    pose = best_pose(problem.robot, values, orientation(problem.robot, values)).skeleton
    start, end, center = pose.frames[1].origin, pose.frames[4].origin, pose.masses[3].center
    assert distance(start, center) == pytest.approx(distance(center, end))


def test_no_star_leaves_the_marks_out() -> None:
    problem = load(next(path for path in LIBRARY if path.stem == "in3140-rp"))
    shown = names(scene(problem, star=False))
    assert "θ₁" in shown and "L₂" in shown and "L₁" in shown


def test_joint_types_have_their_names_in_the_description() -> None:
    picture = drawn(next(path for path in LIBRARY if path.stem == "in3140-rp"))
    assert "revolute joint 1 (theta1), prismatic joint 2 (L2)" in picture.description
    assert JointType.PRISMATIC.value in picture.description


def test_titles_are_text_in_the_svg() -> None:
    title = r"<script>alert(1)</script> & %_ \input{x} ]]> “”\u202e"
    picture = drawn_text(f"title: '{title}'\ndh: [{{theta: q1*, a: l1}}]")
    root = ET.fromstring(to_svg(picture))  # noqa: S314 - our own
    found = root.find("{http://www.w3.org/2000/svg}title")
    assert found is not None and found.text is not None and "<script>alert(1)</script> & %_" in found.text
    assert not root.findall(".//{http://www.w3.org/2000/svg}script")


def test_labels_are_text_with_indices() -> None:
    svg = to_svg(drawn(next(path for path in LIBRARY if path.stem == "in3140-rp")))
    labels = re.findall(r"<text [^>]*>(.*?)</text>", svg)
    plain = {re.sub("<[^>]*>", "", label) for label in labels}
    assert {"θ1∗", "L2∗", "L1", "rc1", "rc2", "z0", "x2", "g"} <= plain
    assert '<tspan font-style="italic">θ</tspan><tspan font-size="11.9" dy="4.08">1</tspan>' in svg


@pytest.mark.parametrize("name", ["in3140-rp", "elbow-3r", "crustcrawler-2r"])
def test_a_joint_stands_at_the_base_end_of_its_link(name: str) -> None:
    """Not where the mass centre of the link is that it turns."""
    problem = load(next(path for path in LIBRARY if path.stem == name))
    values = numbers(problem)
    pose = best_pose(problem.robot, values, orientation(problem.robot, values))
    part, leg = pose.parts.joints[0], pose.skeleton.legs[0]
    assert distance(part.center, leg.foot) < 0.35 * distance(leg.head, leg.foot)
    assert distance(part.center, pose.skeleton.masses[0].center) * pose.view.size > HALF_HEIGHT


@pytest.mark.parametrize("name", ["in3140-rp", "crustcrawler-2r"])
def test_a_turn_is_positive_in_the_pose_that_is_drawn(name: str) -> None:
    """90° more than a positive angle is drawn as an obtuse one."""
    problem = load(next(path for path in LIBRARY if path.stem == name))
    values = numbers(problem)
    leg = best_pose(problem.robot, values, orientation(problem.robot, values)).skeleton.legs[0]
    assert leg.angle - values.rows[0].theta > 0.0


def test_angles_about_one_point_have_arcs_of_their_own() -> None:
    """Two links of the five-bar linkage turn about the same point."""
    picture = drawn(next(path for path in LIBRARY if path.stem == "five-bar"))
    starts = [path.commands[0][1][0] for path in arcs(picture)]
    assert len(set(starts)) == len(starts) == 4


@pytest.mark.parametrize("name", ["numeric-2r", "cartesian-pp"])
def test_an_axis_that_is_seen_end_on_shows_its_sense_on_a_mass_centre(name: str) -> None:
    """Its point is the last thing drawn there."""
    path = next(path for path in LIBRARY if path.stem == name)
    problem = load(path)
    values = numbers(problem)
    pose = best_pose(problem.robot, values, orientation(problem.robot, values))
    at = pose.view.point(pose.skeleton.masses[-1].center)
    there = [p for p in drawn(path).paths if p.fill and _is_around(p, at)]
    assert there[-1].fill == FRAME


def _is_around(path: Drawn, at: Point) -> bool:
    box = bounds([path])
    return math.dist(box.center, at) < 0.5


def test_what_is_blank_takes_the_page_s_background() -> None:
    """The style of a page of HTML finds the background and the room around lines by these classes."""
    svg = to_svg(drawn(next(path for path in LIBRARY if path.stem == "planar-2r")))
    assert svg.count('class="paper"') == 1
    assert svg.count('class="halo"') == svg.count('stroke="#ffffff"') > 0


def test_a_plate_stands_across_a_tilted_axis() -> None:
    """The base leans by 30°, and so does the ground that it stands on; gravity does not."""
    text = "base: Rx(30deg)\ndh: [{theta: q1*, d: d1, alpha: 90deg}, {theta: q2*, a: l2}]\n"
    problem = read_problem(text, "tilted.yaml")
    values = numbers(problem)
    world = orientation(problem.robot, values)
    pose = best_pose(problem.robot, values, world)
    assert dot(pose.parts.ground_normal, pose.skeleton.frames[0].z) == pytest.approx(1.0)
    assert dot(pose.parts.ground_normal, world.up) == pytest.approx(math.cos(math.pi / 6))
    assert dot(pose.parts.ground_side, pose.skeleton.frames[0].x) == pytest.approx(1.0)


@pytest.mark.parametrize(("name", "said"), [("puma560-first3", True), ("planar-2r", False)])
def test_the_caption_says_what_dashed_lines_to_mass_centres_are(name: str, said: bool) -> None:
    caption = drawn(next(path for path in LIBRARY if path.stem == name)).caption
    assert (OFF_LINKS in caption) is said


@pytest.mark.parametrize(("density", "is_tan"), [("rho", True), ("rho*x/l", False)])
def test_a_body_of_uniform_density_is_drawn_as_its_shape(density: str, is_tan: bool) -> None:
    shape = f"{{box: {{x: l, y: b, z: b, axis: x, density: {density}}}}}"
    picture = drawn_text(f"dh: [{{theta: q*, a: l}}]\nmasses: [{{link: 1, shape: {shape}}}]")
    assert any(path.fill == BODY.top for path in picture.paths) is is_tan
    assert (SHAPES in picture.caption) is is_tan


@pytest.mark.parametrize("kind", ["sphere", "shell", "disk"])
def test_a_round_body_is_seen_around_the_mark_of_its_mass_centre(kind: str) -> None:
    body = f"{{link: 1, mass: m, center: tip, shape: {{{kind}: {{radius: r}}}}}}"
    picture = drawn_text(f"dh: [{{theta: q*, a: l}}]\nmasses: [{body}]")
    box = bounds(path for path in picture.paths if path.fill == BODY.top)
    assert box.right - box.left > 2 * AROUND + 6


@pytest.mark.parametrize("name", ["puma560", "puma560-first3", "five-bar", "planar-2r", "elbow-3r"])
def test_lengths_are_drawn_clear_of_links_and_joints(name: str) -> None:
    """The line beside d₃ of the PUMA would end on link 2, were it straight beside it."""
    path = next(path for path in LIBRARY if path.stem == name)
    problem = load(path)
    values = numbers(problem)
    world = orientation(problem.robot, values)
    pose = best_pose(problem.robot, values, world)
    body = Taken()
    body.add(solids(pose.parts, pose.view, world.up, pose.bodies))
    shafts = _shafts(drawn(path))
    assert shafts
    assert all(body.cells_on(*shaft) == 0 for shaft in shafts)


@pytest.mark.parametrize("name", ["planar-2r-motors", "numeric-2r", "planar-2r"])
def test_a_length_beside_another_leaves_room_for_its_label(name: str) -> None:
    picture = drawn(next(path for path in LIBRARY if path.stem == name))
    beside = [pair for pair in combinations(_shafts(picture), 2) if _are_parallel(*pair)]
    room = min(segment_distance(a, b) for a, b in beside)
    assert room > max(label.line.height for label in picture.labels if label.kind == "length")


def _are_parallel(first: tuple[Point, Point], second: tuple[Point, Point]) -> bool:
    (x, y), (u, v) = ((b[0] - a[0], b[1] - a[1]) for a, b in (first, second))
    return abs(x * v - y * u) < 0.01 * math.hypot(x, y) * math.hypot(u, v)


def _shafts(picture: Scene, colours: Sequence[str] = (BLACK,)) -> list[tuple[Point, Point]]:
    """The lines of the lengths that do not vary, and of those that do in the colour of these."""
    pieces = (
        flattened(p.commands)
        for p in picture.paths
        if p.stroke in colours and (p.width, p.fill, p.dashed) == (1.0, None, False)
    )
    return [piece for (piece,) in pieces]


@pytest.mark.parametrize("name", ["in3140-rp", "rp-parameters", "planar-2r"])
def test_lengths_are_straight_beside_what_they_measure(name: str) -> None:
    """The thin lines to their ends are at right angles to them, where links leave any room for that."""
    picture = drawn(next(path for path in LIBRARY if path.stem == name))
    shafts = _shafts(picture, (BLACK, VARIABLE))
    thin = [path for path in picture.paths if (path.stroke, path.width) == (GREY, 0.7) and not path.dashed]
    ends = [(a, b) for path in thin for (_, (a,)), (_, (b,)) in [path.commands]]
    assert len(ends) >= 2 * len(shafts)
    for p, q in shafts:
        near = [(a, b) for a, b in ends if min(math.dist(b, p), math.dist(b, q)) < 12.0]
        assert len(near) >= 2
        for a, b in near:
            across = (b[0] - a[0]) * (q[0] - p[0]) + (b[1] - a[1]) * (q[1] - p[1])
            assert abs(across) < 1e-6 * math.dist(a, b) * math.dist(p, q)


def test_what_is_slid_back_is_measured_as_minus_its_coordinate() -> None:
    arm = "gravity: [0, -g, 0]\ndh: [{alpha: 90deg}, {d: p*, alpha: -90deg}, {theta: q*, a: l}]\n"
    held = (
        "masses: [{mass: M, link: 2, center: origin}, {mass: m, link: 3}]\nconstraints: [tip.y - 2*l - h]\n"
    )
    assert "-p⋆" in names(drawn_text(f"{arm}{held}find: [reduced]"))
    assert "p⋆" in names(drawn_text(f"{arm}find: [J]"))


def test_a_length_is_positive_as_it_is_drawn() -> None:
    """The hand lies below the plane of the second axis: d₂ = t - h leads back by h - t."""
    arm = (
        "axes:\n  - {turn: B, about: [0, 0, 1], through: [0, 0, 0]}\n"
        "  - {turn: W, about: [0, 0, -1], through: [p, 0, 0]}\n"
        "tip: {at: [p, 0, h - t], z: [0, 0, -1], x: [1, 0, 0]}\nzero: drawn\n"
        "values: {p: 2, h: 1, t: 0.5}\nfind: [DH]\n"
    )
    assert "h - t" in names(drawn_text(arm), "length")


def marks(picture: Scene, colour: str) -> list[bool]:
    """The arrows of a colour that are seen end on: whether the last mark at a place is a point."""
    last = dict[Point, Drawn]()
    rings = set[Point]()
    for path in picture.paths:
        x, y = bounds([path]).center
        last[round(x, 1), round(y, 1)] = path
        if (path.stroke, path.fill, path.width) == (colour, WHITE, 1.4):
            rings.add((round(x, 1), round(y, 1)))
    return [last[ring].fill == colour for ring in rings]


UPRIGHT = "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]"
LEVEL = "dh: [{d: d1*, alpha: 90deg}, {theta: q2*, a: l2}]"
"""In the plane of x₀ and z₀: y₀ points away from the viewer."""
TURNED = "convention: modified\ndh: [{theta: q1*, alpha: 90deg}, {theta: q2*, a: l1}, {a: l2}]"


@pytest.mark.parametrize(
    ("pull", "rest", "is_toward"),
    [
        ("[0, 0, -g]", UPRIGHT, False),
        ("[0, 0, g]", UPRIGHT, True),
        ("[0, -g, 0]", LEVEL, True),
        ("[0, g, 0]", LEVEL, False),
        ("[0, -g, 0]", TURNED, True),
        ("[0, g, 0]", TURNED, False),
    ],
)
def test_gravity_normal_to_the_paper_shows_its_sense(pull: str, rest: str, is_toward: bool) -> None:
    assert marks(drawn_text(f"gravity: {pull}\n{rest}"), BLACK) == [is_toward]


@pytest.mark.parametrize(
    ("text", "label", "senses"),
    [
        (f"gravity: [0, -g, 0]\n{TURNED}", "z₁, -y₀", {True}),
        (f"gravity: [0, -g, 0]\n{LEVEL}", "y₀", {True, False}),
        (
            "convention: modified\ngravity: [0, -g, 0]\n"
            "dh: [{theta: q1*, alpha: 180deg}, {theta: q2*, a: l1}, {a: l2}]",
            "z₀, -z₁",
            {True, False},
        ),
    ],
)
def test_opposite_axes_have_no_mark_with_one_sign(text: str, label: str, senses: set[bool]) -> None:
    """An axis that points away has its own mark, or a minus beside the mark of one that does not."""
    picture = drawn_text(text)
    assert set(marks(picture, FRAME)) == senses
    assert label in [to_unicode(each.node, picture.style) for each in picture.labels]


def test_an_axis_of_the_world_that_is_seen_end_on_is_whole() -> None:
    """No other axis from the same place is drawn over its mark."""
    text = (
        "gravity: [0, 0, -g]\naxes: [{turn: a, about: [0, -1, 0], through: [0, 0, H]}]\n"
        "tip: [L, 0, H]\nfind: [DH]\n"
    )
    assert sorted(marks(drawn_text(text), FRAME)) == [False, True, True]
    picture = drawn_text(text)
    rings = [k for k, path in enumerate(picture.paths) if (path.stroke, path.fill) == (FRAME, WHITE)]
    for k in rings:
        middle = bounds([picture.paths[k]]).center
        over = (path for path in picture.paths[k:] if path.stroke == WHITE)
        assert not any(math.dist(a, middle) < 1.0 for path in over for a, _ in flattened(path.commands))
