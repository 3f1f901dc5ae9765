"""Answers on determinants, rates and accelerations: fractions, other solutions, numbers for symbols."""

from __future__ import annotations

import pytest

from dynsolve.answers.judge import check
from dynsolve.answers.reading.files import FileReader
from dynsolve.problem import read_problem
from dynsolve.questions.rates.judge import OF_MANY
from tests.unit.answers.hands import judge, judged, verdicts

ELBOW = """
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
velocity: [vx, vy]
acceleration: [0, 0]
values: {l1: 2}
find: [Jr, Jr_dot, det, qd, qdd]
"""
QD = [
    "(vx*cos(q1+q2) + vy*sin(q1+q2))/(l1*sin(q2))",
    "-(vx*(l1*cos(q1) + l2*cos(q1+q2)) + vy*(l1*sin(q1) + l2*sin(q1+q2)))/(l1*l2*sin(q2))",
]
RANK_1 = """
dh: [{theta: q1*, a: L}, {theta: q2*, d: M, alpha: 90deg}, {theta: q3*, a: N}]
velocity: [sin(q1), -cos(q1), 0]
state: {q2: 90deg, q3: 90deg}
find: [qd]
"""
"""Sapienza Robotics 1, exam 10 June 2022: least norm, and (-1/L, 0, 0) realizes the same velocity."""


@pytest.mark.parametrize(
    ("name", "text", "verdict"),
    [
        ("det", "l1*l2*sin(q2)", "correct"),
        ("det", "2*l2*sin(q2)", "correct"),
        ("det", "l1*l2*(sin(q1+q2)*cos(q1) - cos(q1+q2)*sin(q1))", "correct"),
        ("det", "l1*l2*cos(q2)", "wrong"),
        ("qd", QD, "correct"),
        ("qd", [entry.replace("l1", "2") for entry in QD], "correct"),
        ("qd", [QD[0], QD[0]], "wrong"),
        ("qd", [f"-({entry})" for entry in QD], "wrong"),
        ("qd", ["0", "0"], "wrong"),
    ],
)
def test_verdicts(name: str, text: str | list[str], verdict: str) -> None:
    written = text if isinstance(text, str) else [[entry] for entry in text]
    assert judged(ELBOW, name, written).verdict == verdict


def test_the_sign_of_a_fraction_is_told() -> None:
    found = judged(ELBOW, "qd", [[f"-({entry})"] for entry in QD])
    assert "sign_all" in {one.code for one in found.diagnosis}


@pytest.mark.parametrize(
    ("entry", "says"),
    [
        ("-(vx*(l1*cos(q1) - l2*cos(q1+q2)) + vy*(l1*sin(q1) + l2*sin(q1+q2)))/(l1*l2*sin(q2))",
         "Over l₁ l₂ s₂: The sign of v_x l₂ c₁₂ is wrong."),
        ("-(vx*(l1*cos(q1) + l2*sin(q1+q2)) + vy*(l1*sin(q1) + l2*sin(q1+q2)))/(l1*l2*sin(q2))",
         "where c₁₂ belongs"),
    ],
)  # fmt: skip
def test_a_slip_above_a_denominator_is_told(entry: str, says: str) -> None:
    found = judged(ELBOW, "qd", [[QD[0]], [entry]])
    assert [one.message for one in found.diagnosis if says in one.message]


@pytest.mark.parametrize(("factor", "below"), [("1", "3M + 2m sin²(γ)"), ("1/2", "3M/2 + m sin²(γ)")])
def test_the_denominator_is_that_which_the_answer_has(factor: str, below: str) -> None:
    hub = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, gamma: revolute}
  bodies:
    - {mass: M, at: [x, R, 0], turn: -x/R, about: [0, 0, 1], inertia: {zz: M*R^2/2}}
    - {mass: m, at: [x + l*sin(gamma), R - l*cos(gamma), 0]}
passive: [gamma]
find: [qdd_forward]
"""
    above = "2*f1 + m*g*sin(2*gamma) - 2*m*l*gamma_dot^2*sin(gamma)"
    wrong = f"({factor})*({above})/(({factor})*(3*M + 2*m*sin(gamma)^2))"
    found = judged(hub, "qdd_forward", [[wrong], ["0"]])
    assert [one.message for one in found.diagnosis if one.message.startswith(f"Over {below}: The sign of ")]


def test_only_the_number_with_the_wrong_sign_is_told() -> None:
    """Sapienza Robotics 1, exam 11 September 2019, exercise 1: (16, -0.125, -5.375)."""
    arm = """
dh: [{theta: q1*, d: d1, alpha: 90deg}, {theta: q2*, a: a2}, {theta: q3*, a: a3}]
acceleration: [0, 0, 0]
values: {d1: 5, a2: 4, a3: 3}
state: {q1: 90deg, q2: 45deg, q3: 90deg, q1': 1, q2': 2, q3': -2}
find: [qdd]
"""
    found = judged(arm, "qdd", [["16"], ["0.125"], ["-5.375"]])
    assert [one.message for one in found.diagnosis] == ["The sign of ⅛ is wrong."]


def test_rates_follow_from_a_jacobian_that_is_wrong() -> None:
    J = [["-l1*sin(q1)", "-l2*sin(q1+q2)"], ["l1*cos(q1)", "l2*cos(q1+q2)"]]
    qd = [
        ["(vx*cos(q1+q2) + vy*sin(q1+q2))/(l1*sin(q2))"],
        ["-(vx*cos(q1) + vy*sin(q1))/(l2*sin(q2))"],
    ]
    found = verdicts(judge(ELBOW, {"Jr": J, "det": "l1*l2*sin(q2)", "qd": qd}))
    assert (found["Jr"], found["det"], found["qd"]) == ("wrong", "correct", "follows")


@pytest.mark.parametrize(
    ("entries", "verdict", "noted"),
    [
        (["-L/(L^2+N^2)", "0", "N/(L^2+N^2)"], "correct", False),
        (["-1/L", "0", "0"], "correct", True),
        (["0", "7", "1/N"], "correct", True),
        (["1/L", "0", "0"], "wrong", False),
        (["-1/L", "0", "1/N"], "wrong", False),
    ],
)
def test_every_solution_counts_where_there_are_many(entries: list[str], verdict: str, noted: bool) -> None:
    found = judged(RANK_1, "qd", [[entry] for entry in entries])
    assert (found.verdict, OF_MANY in found.notes) == (verdict, noted)


def test_least_squares_where_there_is_no_solution() -> None:
    text = RANK_1.replace("[sin(q1), -cos(q1), 0]", "[sin(q1), -cos(q1), 5]")
    assert judged(text, "qd", [["-L/(L^2+N^2)"], ["0"], ["N/(L^2+N^2)"]]).verdict == "correct"
    assert judged(text, "qd", [["-1/L"], ["0"], ["0"]]).verdict == "correct"
    assert judged(text, "qd", [["0"], ["0"], ["0"]]).verdict == "wrong"


PRR = """
gravity: none
dh: [{d: q1*, alpha: 90deg}, {theta: q2*, a: l2}, {theta: q3*, a: l3}]
task: [tip.x, tip.z]
velocity: [vx, vz]
state: {q2: 90deg, q3: -90deg}
find: [qd]
"""
TALL = """
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
task: [tip.x, tip.y, q1+q2]
velocity: [v, 0, 0]
state: {q1: 0, q2: 90deg}
find: [qd]
"""


@pytest.mark.parametrize(
    ("problem", "entries", "told"),
    [
        (PRR, ["vz", "-vx/l2", "0"], "ṙ = J_r q̇: in row 2, J_r q̇ is (v_z l₂ - v_x l₃)/l₂ and not v_z."),
        (PRR, ["vz", "0", "0"], "ṙ = J_r q̇: in row 1, J_r q̇ is 0 and not v_x."),
        (TALL, ["0", "-v/l2"], "J_rᵀ (J_r q̇ - ṙ) = 0: in row 1, J_rᵀ (J_r q̇ - ṙ) is -v/l₂ and not 0."),
    ],
)
def test_of_many_solutions_the_equation_is_told_and_no_slip_against_one(
    problem: str, entries: list[str], told: str
) -> None:
    """J_r q̇ = (-l₂ q̇₂, q̇₁ + l₃ (q̇₂ + q̇₃)): of what is no entry of the least solution no term is wrong."""
    found = judged(problem, "qd", [[entry] for entry in entries])
    assert [one.message for one in found.diagnosis] == [f"Your answer does not satisfy {told}"]
    assert not found.entries


def test_of_accelerations_the_rate_of_the_jacobian_stands_in_the_equation() -> None:
    """At q₂ = 90°, q₃ = -90° with q̇₂ = w alone: r̈ = (-l₂ q̈₂ - l₃ w², q̈₁ + l₃ (q̈₂ + q̈₃) - l₂ w²)."""
    moving = PRR.replace("find: [qd]", "find: [qdd]").replace("velocity: [vx, vz]", "acceleration: [ax, 0]")
    moving = moving.replace("q3: -90deg}", "q3: -90deg, q1': 0, q2': w, q3': 0}")
    turn = "(ax + l3*w^2)/l2"
    right = [f"l2*w^2 + l3*{turn}", f"-{turn}", "0"]
    assert judged(moving, "qdd", [[entry] for entry in right]).notes == (OF_MANY,)
    (told,) = judged(moving, "qdd", [[f"l3*{turn}"], [f"-{turn}"], ["0"]]).diagnosis
    assert told.message.endswith("in row 2, J_r q̈ + J̇_r q̇ is -l₂ w² and not 0.")


def test_another_solution_in_rounded_decimals_is_right() -> None:
    """q̇ = (1, -0.333, 0.333) for (1, -1/3, 1/3); 0.33 is no rounded number, as 0.5 is none."""
    numbers = PRR.replace("vx, vz", "1, 1").replace("a: l2", "a: 3").replace("a: l3", "a: 1")
    assert judged(numbers, "qd", [["1"], ["-0.333"], ["0.333"]]).notes == (OF_MANY,)
    assert judged(numbers, "qd", [["1"], ["-0.333"], ["0.335"]]).verdict == "wrong"
    (told,) = judged(numbers, "qd", [["1"], ["-0.33"], ["0.33"]]).diagnosis
    assert told.message.endswith("in row 1, J_r q̇ is 0.99 and not 1.")


def test_another_solution_for_a_jacobian_of_ones_own_follows_from_it() -> None:
    """The sign of l₃ at -90° is wrong; q̇ = (v_z - l₃ v_x/l₂, -v_x/l₂, 0) solves what is written so."""
    J = [
        ["0", "-l2*sin(q2) + l3*sin(q2+q3)", "-l3*sin(q2+q3)"],
        ["1", "l2*cos(q2) - l3*cos(q2+q3)", "l3*cos(q2+q3)"],
    ]
    problem = PRR.replace("find: [qd]", "find: [Jr, qd]")
    own = [["vz - l3*vx/l2"], ["-vx/l2"], ["0"]]
    found = {one.name: one for one in judge(problem, {"Jr": J, "qd": own}).answers}
    assert (found["qd"].verdict, found["qd"].follows_from) == ("follows", ("Jr",))


def test_a_row_that_is_missed_by_rounding_is_not_told() -> None:
    """-3 q̇₂ = 1 holds but for rounding, and q̇₁ + q̇₂ + q̇₃ = 1 is missed."""
    numbers = PRR.replace("vx, vz", "1, 1").replace("a: l2", "a: 3").replace("a: l3", "a: 1")
    found = judged(numbers, "qd", [["1"], ["-0.333"], ["5"]])
    assert [one.message for one in found.diagnosis] == [
        "Your answer does not satisfy ṙ = J_r q̇: in row 2, J_r q̇ is 5.667 and not 1."
    ]


def test_where_one_solution_alone_exists_its_slip_is_told_and_else_the_equation() -> None:
    slip = judged(ELBOW, "qd", [[QD[0]], [QD[1].replace("l2*cos", "-l2*cos")]])
    assert "equation" not in {one.code for one in slip.diagnosis}
    none = judged(ELBOW, "qd", [[f"{QD[0]}*(l1 + l2)^3*sin(q1)^2 + vx^2"], [QD[1]]])
    assert [one.message for one in none.diagnosis][:1] == [
        "Your answer does not satisfy ṙ = J_r q̇: see row 1."
    ]
    assert [entry.verdict for entry in none.entries] == ["wrong", "correct"]


@pytest.mark.parametrize(
    ("written", "name"),
    [
        (r"\det(J) = l_1 l_2 s_2", "det"),
        (r"\det J_r = l_1 l_2 s_2", "det"),
        (r"\left|\mathbf{J}\right| = l_1 l_2 s_2", "det"),
        (r"\dot{q} = \begin{bmatrix} \frac{v_x c_{12} + v_y s_{12}}{l_1 s_2} \\ "
         r"-\frac{v_x (l_1 c_1 + l_2 c_{12}) + v_y (l_1 s_1 + l_2 s_{12})}{l_1 l_2 s_2} \end{bmatrix}", "qd"),
    ],
)  # fmt: skip
def test_notations(written: str, name: str) -> None:
    problem = read_problem(ELBOW, "own.yaml")
    submission = FileReader(problem)(f"$${written}$$\n".encode(), "report.md")
    assert {a.name: a.verdict for a in check(problem, submission).answers if a.given} == {name: "correct"}


def test_of_a_jacobian_that_is_not_square_it_is_that_of_the_product() -> None:
    text = "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\ntask: [tip.x]\nfind: [det]\n"
    problem = read_problem(text, "own.yaml")
    wide = "(l_1 s_1 + l_2 s_{12})^2 + l_2^2 s_{12}^2"
    for side, given in ((r"\det(J_r J_r^T)", 1), (r"\det(J_r)", 0)):
        submission = FileReader(problem)(f"$${side} = {wide}$$\n".encode(), "report.md")
        assert [a.verdict for a in check(problem, submission).answers if a.given] == ["correct"] * given


def test_a_determinant_is_no_name_where_none_is_asked_for() -> None:
    problem = read_problem("dh: [{theta: q1*, a: l1}]\nfind: [Jv]\n", "own.yaml")
    submission = FileReader(problem)(b"$$det(J) = l_1$$\n", "report.md")
    assert not submission.answers and submission.not_recognized
