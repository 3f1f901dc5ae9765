"""What pictures are made of: lengths, the chain of points, shapes, places for labels, conversions."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from dynsolve.algebra.ring_values import evaluate
from dynsolve.derivation.kinematics import base_transform, dh_matrix, frame
from dynsolve.draw import PictureFormat, draw, picture
from dynsolve.draw.figure import to_pdf, to_png
from dynsolve.draw.labels import Box, Taken
from dynsolve.draw.paths import circle, flattened, typeset
from dynsolve.draw.skeleton import numbers, skeleton
from dynsolve.draw.vectors import IDENTITY, applied, distance, into, turned
from dynsolve.notation.printing import Style
from dynsolve.notation.tree import Degrees, Letter, Number, Quotient, Row, Sum, Symbol, Words
from dynsolve.problem import load, read_problem
from tests.support import LIBRARY, TEXTBOOKS


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

    for path in LIBRARY:
        robot, values = load(path).robot, numbers(load(path))
        pose = best_pose(robot, values, orientation(robot, values))
        centers = [part.center for part in pose.parts.joints]
        gaps = [distance(a, b) * pose.view.size for k, a in enumerate(centers) for b in centers[k + 1 :]]
        assert min(gaps, default=99.0) > 30.0, path.stem
