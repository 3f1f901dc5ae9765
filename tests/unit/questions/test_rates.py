"""Determinants and rates: by hand, and against elimination on numbers."""

from __future__ import annotations

import numpy as np
import pytest
from sympy import simplify, sympify

import dynsolve
from dynsolve.answers.judge import check
from dynsolve.answers.reading.files import FileReader
from dynsolve.derivation.rules import derive
from dynsolve.errors import VerificationError
from dynsolve.explain.forms import Forms
from dynsolve.explain.step import Detail
from dynsolve.notation.tree import Matrix, Negative, Node
from dynsolve.problem import read_problem
from dynsolve.questions.rates.check import rate_names, verify_rates
from dynsolve.render.files import Format
from dynsolve.solution.reports import report

ELBOW = "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\n"
THREE = "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: q3*, a: l3}]\n"
ROBOTS = {
    "square": ELBOW + "velocity: [vx, vy]\nacceleration: [ax, 0]\n",
    "redundant": THREE + "velocity: [vx, q1*vy]\nacceleration: [0, 0]\n",
    "weighted": THREE + "velocity: [vx, vy]\nacceleration: [0, 0]\nweights: {q1: w1, q3: 3}\n",
    "weighted by a matrix, singular": THREE + "velocity: [vx, vy]\nacceleration: [ax, ay]\n"
    "weights: [[2, 1, 0], [1, 3, 0], [0, 0, w]]\nstate: {q2: 0, q3: 0}\n",
    "weighted by inertia": "gravity: none\n" + THREE + "masses: [{mass: m1, link: 1}, {mass: m2, link: 2}, "
    "{mass: m3, link: 3}]\nvelocity: [vx, vy]\nacceleration: [0, 0]\nweights: D\n"
    "state: {q2: 90deg, q3: 0}\n",
    "too few joints": "dh: [{theta: q1*, a: l1}]\nvelocity: [vx, vy]\nacceleration: [ax, 0]\n",
    "singular": ELBOW + "velocity: [vx, vy]\nacceleration: [ax, 0]\nstate: {q2: 0}\n",
    "twist": "dh: [{theta: q1*, alpha: 90deg}, {d: d2*}]\ntask: twist\nvelocity: [0, 0, v, 0, 0, w]\n",
}


def forms(text: str) -> tuple[object, dict[str, Node]]:
    asked = [name for key, name in (("velocity", "qd"), ("acceleration", "qdd")) if key in text]
    spaces = "nullspace, rangespace, lost"
    robot = read_problem(f"{text}find: [det, {spaces}, {', '.join(asked)}]").robot
    values = derive(robot)
    made = Forms(robot, values)
    return robot, {n: made(n) for n in rate_names(robot, values.leading_to(robot.questions.asked))}


@pytest.mark.parametrize("text", ROBOTS.values(), ids=ROBOTS)
def test_what_is_derived_agrees(text: str) -> None:
    robot, results = forms(text)
    verify_rates(robot, results)
    for name in results.keys() & {"det", "qd", "qdd"}:
        with pytest.raises(VerificationError, match="differs from elimination"):
            verify_rates(robot, {**results, name: negative(results[name])})


def negative(node: Node) -> Node:
    if isinstance(node, Matrix):
        return Matrix(tuple(tuple(map(Negative, row)) for row in node.rows))
    return Negative(node)


@pytest.mark.parametrize("name", ["nullspace", "rangespace", "lost"])
def test_a_space_with_a_wrong_vector_is_found(name: str) -> None:
    robot, results = forms(ROBOTS["singular"])
    (first, *rest) = results[name].rows
    wrong = Matrix(((Negative(first[0]), *first[1:]), *rest))
    with pytest.raises(VerificationError, match="differs from elimination"):
        verify_rates(robot, {**results, name: wrong})


@pytest.mark.parametrize(
    ("text", "det"),
    [
        (ELBOW, "l1*l2*sin(q2)"),
        (THREE + "task: [tip.x, tip.y, q1 + q2 + q3]\n", "l1*l2*sin(q2)"),
        (ELBOW + "task: [tip.x]\n", "(l1*sin(q1) + l2*sin(q1 + q2))**2 + l2**2*sin(q1 + q2)**2"),
        (THREE, "l1**2*(l2*sin(q2) + l3*sin(q2 + q3))**2 + l3**2*(l1*sin(q2 + q3) + l2*sin(q3))**2"
         " + l2**2*l3**2*sin(q3)**2"),
        (THREE.replace("l2", "l1").replace("l3", "l1"),
         "l1**4*((sin(q2) + sin(q2 + q3))**2 + (sin(q2 + q3) + sin(q3))**2 + sin(q3)**2)"),
        ("dh: [{theta: q1*, a: l1}]\n", "l1**2"),
        ("dh: [{theta: q1*, d: d1, alpha: 90deg}, {theta: q2*, alpha: 90deg}, {d: d3*}]\n",
         "d3**2*sin(q2)"),
    ],
)  # fmt: skip
def test_determinants_are_written_in_factors(text: str, det: str) -> None:
    found = dynsolve.solve(text + "find: [det]\n").to_json()["results"]["det"]
    assert simplify(sympify(found) - sympify(det)) == 0
    assert len(found) <= 1.3 * len(det)


def test_of_six_joints_without_a_task_it_is_that_of_all_of_j() -> None:
    wrist = "{theta: q4*, alpha: -90deg}, {theta: q5*, alpha: 90deg}, {theta: q6*, d: d6}"
    gantry = f"dh: [{{d: d1*, alpha: 90deg}}, {{d: d2*, theta: 90deg, alpha: 90deg}}, {{d: d3*}}, {wrist}]\n"
    assert dynsolve.solve(gantry + "find: [det]\n").to_json()["results"]["det"].strip("-") == "sin(q5)"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (ROBOTS["square"], "has one solution"),
        (ROBOTS["redundant"], "of least norm"),
        (ROBOTS["too few joints"], "least squares"),
        (ROBOTS["singular"], "least squares"),
    ],
)
def test_the_step_says_how_it_is_solved(text: str, words: str) -> None:
    steps = {step.id: step for step in dynsolve.solve(text + "find: [qd]\n").steps}
    assert words in "".join(part for part in steps["qd"].why if isinstance(part, str))


SLIDING = """
dh: [{d: q1*, theta: 90deg, alpha: 90deg}, {theta: q2*, a: 1}, {theta: q3*, a: 1}]
task: [tip.x, tip.y, tip.z]
state: {q1: 0, q2: 90deg, q3: 0, q3': 2}
velocity: [0.1, 0, 0]
find: [qd]
"""


def test_that_errors_in_lengths_and_angles_are_added_is_said_where_they_are() -> None:
    arm = "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\nvelocity: [v, 0, w]\nfind: [qd]\n"
    for task, is_said in (("tip.x, tip.y, q1 + q2", True), ("tip.x, tip.y, tip.x + tip.y", False)):
        shown = report(dynsolve.solve(f"{arm}task: [{task}]\n"), Format.TEXT).decode()
        assert "least squares" in shown and ("another unit of length" in shown) is is_said


def test_of_many_that_come_nearest_it_is_said_which_and_how() -> None:
    """In one plane, stretched: the rank is 2 of 3."""
    shown = " ".join(report(dynsolve.solve(SLIDING), Format.TEXT).decode().split())
    assert "no solution, the rank being 2. All" in shown
    assert "this is the one of least norm. The pseudoinverse 𝐉_r⁺ gives it. The norm adds squares" in shown
    assert "The state is q₁ = 0, q₂ = 90°, q₃ = 0." in shown and "At q₁ = 0, q₂ = 90°, q₃ = 0:" in shown


@pytest.mark.parametrize(
    ("state", "velocity", "words"),
    [
        ("", "[v, w]", "one solution. All this holds where s₂ ≠ 0."),
        (
            "state: {q1: 0, q2: gamma}\n",
            "[v, 0]",
            "has one solution. All this holds where sin(γ) ≠ 0.",
        ),
        ("state: {q1: 0, q2: 90deg}\n", "[v, w]", "has one solution. The state is"),
        ("state: {q1: 0, q2: 0}\n", "[v, w]", "has a solution only where v = 0, the rank being 1. All"),
        (
            "state: {q2: 180deg}\n",
            "[v, w]",
            "has a solution only where w s₁ + v c₁ = 0, the rank being 1. All",
        ),
        ("state: {q1: 0, q2: 0}\n", "[l, w]", "has no solution, the rank being 1. All"),
        (
            "state: {q1: 0, q2: 0}\n",
            "[v - u, w]",
            "has a solution only where v - u = 0, the rank",
        ),
    ],
)
def test_it_is_said_for_which_configurations_and_velocities(state: str, velocity: str, words: str) -> None:
    arm = "gravity: none\ndh: [{theta: q1*, a: l}, {theta: q2*, a: l}]\ntask: [tip.x, tip.y]\n"
    text = f"{arm}{state}velocity: {velocity}\nfind: [qd, nullspace, lost]\n"
    shown = " ".join(report(dynsolve.solve(text), Format.TEXT).decode().split())
    assert words in shown
    assert ("no motion is lost. All this holds" in shown) == ("All this" in words)


def test_the_rank_is_full_where_no_factor_that_all_minors_share_is_0() -> None:
    arm = "gravity: none\ndh: [{theta: q1*, a: a}, {theta: q2* - 90deg, alpha: -90deg}, {d: d3*}]\n"
    shown = report(dynsolve.solve(f"{arm}state: {{q2: 90deg}}\nfind: [nullspace]\n"), Format.TEXT).decode()
    assert "All this holds where d₃ ≠ 0." in " ".join(shown.split())
    everywhere = report(dynsolve.solve(f"{THREE}find: [nullspace]\n"), Format.TEXT).decode()
    assert "All this holds where s₂ ≠ 0 or s₃ ≠ 0." in " ".join(everywhere.split())


def test_a_state_that_is_reached_is_in_degrees() -> None:
    arm = "gravity: none\ndh: [{theta: q1*, a: 1}, {theta: q2*, a: 1}]\n"
    target = "reach: [1, 1]\nlimits: {q2: [0, 180deg]}\nstate: reach\nvelocity: [1, 0]\nfind: [qd]\n"
    assert "The state is q₁ = 0, q₂ = 90°." in report(dynsolve.solve(arm + target), Format.TEXT).decode()


@pytest.mark.parametrize(
    ("arm", "told", "conditions"),
    [
        ("square", "All this holds where s₂ ≠ 0.", 1),
        ("redundant", "this is the one of least norm. All this holds where s₂ ≠ 0 or s₃ ≠ 0.", 2),
        ("weighted", "has many solutions: this is the one with the least 𝐪̇ᵀ 𝐖 𝐪̇. All this", 2),
        ("too few joints", "these come nearest to one, in the sense of least squares.", 0),
    ],
)
def test_the_summary_says_under_what_results_hold(arm: str, told: str, conditions: int) -> None:
    """Once for those of the same condition."""
    solution = dynsolve.solve(ROBOTS[arm] + "find: [qd, nullspace, lost]\n")
    shown = report(solution, Format.TEXT, detail=Detail.RESULTS).decode()
    summary = " ".join(shown.partition("Summary")[2].split())
    assert told in summary and summary.count("All this holds") == conditions


def test_accelerations_at_a_rate_that_may_be_0_are_not_said_to_have_none() -> None:
    text = ELBOW + "acceleration: [0, 0]\nstate: {q1: 0, q2: 0, q1': w, q2': 0}\nfind: [qdd]\n"
    shown = " ".join(report(dynsolve.solve(text), Format.TEXT).decode().split())
    assert "The rest has a solution only where w = 0, the rank being 1" in shown


def test_where_lengths_of_columns_are_never_0_the_rank_is_no_condition() -> None:
    """Folded: l2² s1² + l2² c1² is l2², and (l1 - l2)² + l2² no sum of positive terms."""
    text = ELBOW + "state: {q2: 180deg}\nfind: [nullspace, rangespace, lost]\n"
    assert "All this holds" not in report(dynsolve.solve(text), Format.TEXT).decode()


def test_equations_that_repeat_each_other_may_have_one_solution() -> None:
    arm = "dh: [{theta: q1*, a: 1}]\ntask: [tip.x, tip.y]\nstate: {q1: 0}\nvelocity: [0, v]\nfind: [qd]\n"
    (step,) = (step for step in dynsolve.solve(arm).steps if step.id == "qd")
    assert "has one solution" in "".join(part for part in step.why if isinstance(part, str))


LONG = "dh:\n" + "".join(
    f"  - {{theta: q{i}*, d: d{i}, a: a{i}, alpha: {'-' * (i % 2)}90deg}}\n" for i in range(1, 7)
)
"""Six joints with every length; its J Jᵀ for the position alone has entries of hundreds of terms."""


def test_what_nobody_could_read_is_left_out_and_said_to_be() -> None:
    text = LONG + "task: [tip.x, tip.y, tip.z]\nvelocity: [vx, 0, 0]\nfind: [Jr, det, qd]\n"
    solution = dynsolve.solve(text)
    results = solution.to_json()["results"]
    assert results["det"] == results["qd"] == {"skipped": "multiplied out it is too large to be read"}
    assert [w.message.split()[0] for w in solution.warnings] == ["det", "qd"]
    problem = read_problem(text, "own.yaml")
    submission = FileReader(problem)(b"answers:\n  det: a1*a2\n", "answers.yaml")
    assert [a.verdict for a in check(problem, submission).answers if a.given] == ["unreadable"]


def test_spaces_whose_vectors_are_too_long_are_left_out() -> None:
    solution = dynsolve.solve(LONG + "task: twist\nfind: [nullspace, lost]\n")
    results = solution.to_json()["results"]
    why = "multiplied out it is too large to be read; it is found at a `state` in numbers"
    assert results["nullspace"] == results["lost"] == {"skipped": why}
    assert [step.id for step in solution.steps if step.stage == "rates"] == ["nullspace", "lost"]


def test_at_a_state_it_is_not_too_large() -> None:
    state = "state: {q1: 0, q2: 90deg, q3: 0, q4: 90deg, q5: 0, q6: 0}\n"
    text = LONG + "task: [tip.x, tip.y, tip.z]\nvelocity: [v, 0, 0]\n" + state + "find: [qd]\n"
    assert len(dynsolve.solve(text).to_json()["results"]["qd"]) == 6


TWO_SLIDES = """
gravity: none
dh: [{d: d1*}, {d: d2*}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
velocity: [v]
find: [qd]
"""
# (the weights, the rates of two slides on one line): by hand, from d1' + d2' = v
WEIGHTED = [
    ("", ["v/2", "v/2"]),
    ("weights: {d2: 4}", ["4*v/5", "v/5"]),
    ("weights: {d1: a, d2: b}", ["b*v/(a + b)", "a*v/(a + b)"]),
    ("weights: [[2, 1], [1, 2]]", ["v/2", "v/2"]),
    ("weights: D", ["0", "v"]),  # the energy m1 d1'^2/2 + m2 v^2/2 is least where d1 rests
]


@pytest.mark.parametrize(("weights", "rates"), WEIGHTED)
def test_the_least_of_a_weighted_sum_of_squares(weights: str, rates: list[str]) -> None:
    found = dynsolve.solve(TWO_SLIDES + weights).to_json()["results"]["qd"]
    assert [simplify(sympify(f"{a} - ({b})")) for a, b in zip(found, rates, strict=True)] == [0, 0]


def test_rates_of_other_weights_are_right_with_a_note() -> None:
    problem = read_problem(TWO_SLIDES + "weights: {d2: 4}", "own.yaml")
    for value, notes in (("[4*v/5, v/5]", 0), ("[v/2, v/2]", 1)):
        (answer,) = check(problem, FileReader(problem)(f"answers:\n  qd: {value}\n", "answer.yaml")).answers
        assert (answer.verdict, len(answer.notes)) == ("correct", notes)


def test_the_space_of_a_long_arm_is_found_at_a_state() -> None:
    """A Franka arm with its forearm upright: joints 1 and 3 have one axis (q2 = 0)."""
    arm = """
gravity: none
dh:
  - {theta: q1*, d: 0.333, alpha: -90deg}
  - {theta: q2*, alpha: 90deg}
  - {theta: q3*, d: 0.316, a: 0.0825, alpha: 90deg}
  - {theta: q4*, a: -0.0825, alpha: -90deg}
  - {theta: q5*, d: 0.384, alpha: 90deg}
  - {theta: q6*, a: 0.088, alpha: 90deg}
  - {theta: q7*, d: 0.107}
task: twist
state: {q1: 0, q2: 0, q3: 0, q4: -90deg, q5: 0, q6: 90deg, q7: 0}
find: [nullspace]
"""
    assert dynsolve.solve(arm).to_json()["results"]["nullspace"] == [["1", "0", "-1", "0", "0", "0", "0"]]


def test_the_formula_of_weighted_rates_holds_where_the_rank_is_less() -> None:
    """q̇ = W⁻¹ Jᵀ (J W⁻¹ Jᵀ)⁺ ṙ, with the pseudoinverse of NumPy."""
    slope = (
        "gravity: none\ndh: [{d: x*, alpha: 90deg}, {theta: q* + 90deg, alpha: 90deg}, {d: 1 + s*}]\n"
        "base: Ry(90deg)\npoints: {P: {link: 3, at: origin}}\ntask: [P.x, P.y]\nvelocity: [v, 0]\n"
        "state: {x: 0, q: 30deg, s: 0}\nweights: {x: 2}\nfind: [Jr, qd]\n"
    )
    solution = dynsolve.solve(slope)
    assert "W}^{-1} \\mathbf{J}_{r}^{T} (\\mathbf{J}_{r} \\mathbf{W}^{-1}" in solution.to_latex()
    results = solution.to_json()["results"]
    J = np.array([[1, np.sqrt(3) / 2, 1 / 2], [0, 0, 0]])
    W = np.diag([1 / 2, 1, 1])
    ours = [float(sympify(rate).subs("v", 1)) for rate in results["qd"]]
    assert ours == pytest.approx(W @ J.T @ np.linalg.pinv(J @ W @ J.T) @ [1, 0])


def test_no_root_of_a_number_is_a_factor_below() -> None:
    elbow = """
gravity: none
dh: [{theta: q1*, d: h, alpha: 90deg}, {theta: q2*, a: l2}, {theta: q3*, a: l3}]
velocity: [0, v, 0]
state: {q2: 45deg, q3: 90deg}
find: [qd]
"""
    found = dynsolve.solve(elbow).to_json()["results"]["qd"]
    assert found[:2] == ["sqrt(2)*v*cos(q1)/(l2 - l3)", "-sqrt(2)*v*sin(q1)/(2*l2)"]


@pytest.mark.parametrize(("second", "is_said"), [("0", False), ("90deg", False), ("q", True)])
def test_a_rank_that_is_the_same_in_every_pose_is_no_condition(second: str, is_said: bool) -> None:
    """The planar 3R with its second joint held: stretched it always lacks one direction, bent none."""
    rows = "{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: q3*, a: l3}"
    state = "" if second == "q" else f"state: {{q2: {second}}}\n"
    arm = f"gravity: none\ndh: [{rows}]\ntask: [tip.x, tip.y, q1 + q2 + q3]\n{state}"
    told = dynsolve.solve(f"{arm}find: [nullspace]\n").to_markdown()
    assert ("All this holds where" in told) == is_said
