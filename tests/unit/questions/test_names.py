"""Parameters that are called as the solution calls something else, beside the same under other names."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

import dynsolve
from dynsolve.errors import ProblemError
from tests.support import solve_json

SLIDE = """
gravity: none
dh: [{d: x*}]
masses: [{mass: m, link: 1, center: origin}]
friction: {x: K1}
find: [qdd_forward]
"""
TWO_SLIDES = """
gravity: none
dh: [{d: x1*}, {from: 0, d: x2*}]
masses: [{mass: K3, link: 1, center: origin}, {mass: K2, link: 2, center: origin}]
friction: {x1: K1}
constraints: [x1 - x2]
find: [reduced, lambda]
"""
PENDULUM = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: K1}, {theta: q2*, a: K2}]
masses: [{mass: m, link: 1}, {mass: m, link: 2}]
constraints: [tip.x - c]
find: [tau, lambda]
"""
REACHING = """
gravity: none
dh: [{theta: q1*, a: K1}, {theta: q2*, a: K2}]
find: [inverse]
"""
IN_NUMBERS = REACHING + "values: {K1: 2, K2: 1}\nreach: [1, 2]\n"
POSE = """
gravity: none
dh: [{theta: q1*, alpha: 90deg, d: K1}, {theta: q2*, a: K2}]
task: pose
find: [inverse]
"""

DESCRIBING = ("problem", "coordinates", "steps", "verified")


def put(text: str, names: tuple[str, ...]) -> str:
    """A text with names for K1, K2, ..."""
    return re.sub(r"\bK(\d)\b", lambda match: names[int(match[1]) - 1], text)


def results(problem: str) -> str:
    """What JSON has of the results, and the names of the forces in them."""
    found = solve_json(problem)
    forces = [q["force"] for q in found["coordinates"] if "inverse" not in problem]
    return json.dumps([forces, *(value for key, value in found.items() if key not in DESCRIBING)])


def words(text: str) -> list[str]:
    """The words and signs of a text; the order of terms depends on names."""
    return sorted(re.findall(r"\w+|[^\w\s]", text))


@pytest.mark.parametrize(
    ("problem", "names", "others"),
    [
        (SLIDE, ("f1",), {"f1": "F1"}),
        (SLIDE, ("f_1",), {"f1": "F1"}),
        (TWO_SLIDES, ("f1", "F2", "N1"), {"f1": "Phi1", "f2": "Phi2"}),
        (PENDULUM, ("tau2", "lambda1"), {"tau1": "u1", "tau2": "u2"}),
        (PENDULUM, ("u1", "tau1"), {"tau1": "T1", "tau2": "T2"}),
        (REACHING, ("r2", "rd3"), {"r1": "rd1", "r2": "rd2"}),
        (REACHING, ("r2", "r_d1"), {"r1": "rdd1", "r2": "rdd2"}),
        (IN_NUMBERS, ("r2", "r1"), {"r1": "rd1", "r2": "rd2"}),
        (POSE, ("r11", "z"), {**{axis: f"{axis}d" for axis in "xyz"},
                              **{f"r{i}{j}": f"rd{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)}}),
    ],
)  # fmt: skip
def test_the_results_do_not_depend_on_names(
    problem: str, names: tuple[str, ...], others: dict[str, str]
) -> None:
    expected = re.sub(r"[A-Za-z]\w*", lambda match: others.get(match[0], match[0]), results(problem))
    assert words(results(put(problem, names))) == words(put(expected, names))


@pytest.mark.parametrize("name", ["q1r", "q2r"])
def test_a_reference_is_no_parameter_and_no_coordinate(name: str) -> None:
    text = PENDULUM.replace("K2", "L2").replace("lambda", "Yr").replace("constraints: [tip.x - c]\n", "")
    text = text.replace("q2", "q1r") if name == "q1r" else text.replace("L2", name)
    with pytest.raises(ProblemError, match=f"{name} is the reference in Yr of the coordinate {name[:-1]}"):
        dynsolve.solve(put(text, ("l",)))


BRANCHES = """inverse:
  - {q2: acos(_), q1: atan2(rd2, rd1) - atan2(r2*sin(q2), r1 + r2*cos(q2))}
  - {q2: -acos(_), q1: atan2(rd2, rd1) - atan2(r2*sin(q2), r1 + r2*cos(q2))}
"""
RIGHT = BRANCHES.replace("_", "(rd1^2 + rd2^2 - r1^2 - r2^2)/(2*r1*r2)")


@pytest.mark.parametrize(
    ("problem", "names", "answer", "verdict"),
    [
        (SLIDE, ("f1",), "qdd_forward: [(F1 - f1*x')/m]", "correct"),
        (SLIDE, ("f1",), "qdd_forward: [(u - f1*x')/m]", "correct"),
        (SLIDE, ("f1",), "qdd_forward: [(f1 - f1*x')/m]", "wrong"),
        (TWO_SLIDES, ("f1", "m2", "m1"), "reduced: [m1*x1'' + m2*x2'' + f1*x1' = F1 + F2]", "correct"),
        (TWO_SLIDES, ("f1", "m2", "m1"), "reduced: [m1*x1'' + m2*x2'' + f1*x1' = f1 + F2]", "wrong"),
        (REACHING, ("r1", "r2"), RIGHT, "correct"),
        (REACHING, ("r1", "r2"), RIGHT.replace("rd", "r"), "wrong"),
    ],
)
def test_a_hand_in_means_the_parameter(
    problem: str, names: tuple[str, ...], answer: str, verdict: str, tmp_path: Path
) -> None:
    (tmp_path / "problem.yaml").write_text(put(problem, names), encoding="utf-8")
    (tmp_path / "answer.yaml").write_text(answer, encoding="utf-8")
    report = dynsolve.check(tmp_path / "problem.yaml", tmp_path / "answer.yaml")
    assert verdict in {str(judged.verdict) for judged in report.answers}
