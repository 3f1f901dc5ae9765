"""Singular configurations and branches of the inverse, in forms of the student's own."""

from __future__ import annotations

import pytest

from dynsolve.answers.verdict import JudgedAnswer
from tests.unit.answers.hands import checker

TWO_LINKS = """
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
reach: [px, py]
find: [singular, inverse]
"""
ELBOW = """
dh: [{theta: q1*, d: L1, alpha: 90deg}, {theta: q2*, a: L2}, {theta: q3*, a: L3}]
find: [singular, inverse]
"""
PLANAR_RPRP = """
gravity: none
dh: [{theta: q1* + 90deg, alpha: 90deg}, {d: q2*, alpha: -90deg}, {theta: q3*, alpha: 90deg}, {d: q4*}]
task: [tip.x, tip.y, q1 + q3]
find: [singular]
"""


def judged(problem: str, name: str, value: str) -> JudgedAnswer:
    check = checker(problem)
    report = check(check.reader(f"answers:\n  {name}: {value}\n", "answer.yaml"))
    return next(answer for answer in report.answers if answer.name == name)


C2 = "(px^2 + py^2 - l1^2 - l2^2)/(2*l1*l2)"
Q1 = "atan2(py, px) - atan2(l2*sin(q2), l1 + l2*cos(q2))"
LATEX_C2 = r"\frac{p_x^2 + p_y^2 - l_1^2 - l_2^2}{2 l_1 l_2}"
LATEX_Q1 = r"\operatorname{atan2}(p_y, p_x) - \operatorname{atan2}(l_2 \sin q_2, l_1 + l_2 \cos q_2)"

# (the branches, the verdict, the note or the code of the slip)
BRANCHES = [
    (f"[{{q1: '{Q1}', q2: 'acos({C2})'}}, {{q1: '{Q1}', q2: '-acos({C2})'}}]", "correct", ""),
    (f"[{{q1: {Q1}, q2: ±acos({C2})}}]", "correct", ""),
    (f"{{q1: {Q1}, q2: acos({C2})}}", "correct", "incomplete"),
    (f"[{{q2: '±atan2(sqrt(1 - ({C2})^2), {C2})', q1: 'atan2(py*(l1 + l2*cos(q2)) - px*l2*sin(q2), "
     "px*(l1 + l2*cos(q2)) + py*l2*sin(q2))'}]", "correct", ""),
    (f"[{{q1: '{Q1}', q2: '±\\arccos({C2})'}}]", "correct", ""),
    (f"[{{q1: {Q1}, q2: '±cos^{{-1}}({C2})'}}]", "correct", ""),
    (f"[[{Q1}, acos({C2})], [{Q1}, -acos({C2})]]", "correct", ""),
    (f"q2 = ±acos({C2}), q1 = {Q1}", "correct", ""),
    (f"[q2 = acos({C2}) and q1 = {Q1}, q2 = -acos({C2}) and q1 = {Q1}]", "correct", ""),
    (rf"[{{q_2: \pm\arccos{LATEX_C2}, q_1: {LATEX_Q1}}}]", "correct", ""),
    (rf"[{{q_2: \arccos\left({LATEX_C2}\right), q_1: {LATEX_Q1}}}, "
     rf"{{q_2: -\arccos{LATEX_C2}, q_1: {LATEX_Q1}}}]", "correct", ""),
    (f"[{{q1: 'atan2(px, py) - atan2(l1 + l2*cos(q2), l2*sin(q2))', q2: '±acos({C2})'}}]",
     "wrong", "atan2_order"),
    (f"[{{q1: 'atan2(py, px) + atan2(l2*sin(q2), l1 + l2*cos(q2))', q2: '±acos({C2})'}}]",
     "wrong", "branch_misses"),
    (f"[{{q1: '∓atan2(py, px)', q2: '±acos({C2})'}}]", "wrong", "branch_misses"),
    (f"[{{q2: 'acos({C2})'}}]", "wrong", "branch_lacks_coordinate"),
    (f"['q2 = acos({C2})', 'q2 = -acos({C2})', 'q1 = {Q1}']", "correct", ""),
    (f"['q2 = acos({C2})', 'q2 = -acos({C2})', 'q1 = {Q1} + 1']", "wrong", "branch_misses"),
    ("[{q1: q1, q2: q2}]", "wrong", "branch_never_exists"),
    (f"[{{q1: '{Q1}', q2: 'acos(2 + ({C2})^2)'}}]", "wrong", "branch_never_exists"),
]  # fmt: skip


# A spherical wrist: its angles are the Euler angles ZYZ (Spong, Hutchinson, Vidyasagar, section 2.5.1).
WRIST = """
gravity: none
dh: [{theta: phi*, alpha: -90deg}, {theta: theta*, alpha: 90deg}, {theta: psi*}]
task: pose
find: [inverse]
branches: all
"""
PSI = "atan2(-r11*sin(phi) + r21*cos(phi), -r12*sin(phi) + r22*cos(phi))"

# (the branches, the verdict, the note or the code of the slip)
OF_A_WRIST = [
    ("[{theta: 'atan2(±sqrt(1 - r33^2), r33)', phi: 'atan2(±r23, ±r13)', psi: 'atan2(±r32, ∓r31)'}]",
     "correct", ""),
    (f"[{{phi: 'atan2(r23, r13)', theta: acos(r33), psi: '{PSI}'}}, "
     f"{{phi: 'atan2(-r23, -r13)', theta: -acos(r33), psi: '{PSI}'}}]", "correct", ""),
    ("[{theta: 'acos(r33)', phi: 'atan2(r23, r13)', psi: 'atan2(r32, -r31)'}]", "wrong", "branches_missing"),
    ("[{theta: 'atan2(±sqrt(1 - r33^2), r33)', phi: 'atan2(±r23, ±r13)', psi: 'atan2(±r32, ±r31)'}]",
     "wrong", "branch_misses"),
    ("[{theta: '±acos(r33)', phi: 'atan2(r23, r13)', psi: 'atan2(r32, -r31)'}]", "wrong", "branch_misses"),
]  # fmt: skip


@pytest.mark.parametrize(("value", "verdict", "said"), OF_A_WRIST)
def test_branches_of_a_pose(value: str, verdict: str, said: str) -> None:
    answer = judged(WRIST, "inverse", value)
    assert answer.verdict == verdict, (answer.fault, answer.diagnosis)
    assert said in (*answer.notes, *(slip.code for slip in answer.diagnosis), "")


@pytest.mark.parametrize(("value", "verdict", "said"), BRANCHES)
def test_branches(value: str, verdict: str, said: str) -> None:
    answer = judged(TWO_LINKS, "inverse", value)
    assert answer.verdict == verdict, (answer.fault, answer.diagnosis)
    codes = [one.code for one in answer.diagnosis] if verdict == "wrong" else list(answer.notes)
    assert codes == ([said] if said else [])


def test_every_branch_where_all_are_asked_for() -> None:
    one = f"[{{q1: '{Q1}', q2: 'acos({C2})'}}]"
    answer = judged(TWO_LINKS + "branches: all\n", "inverse", one)
    assert (answer.verdict, answer.diagnosis[0].code) == ("wrong", "branches_missing")


# (the problem, the alternatives, the verdict, the code of the slip)
SETS = [
    (TWO_LINKS, "[sin(q2) = 0]", "correct", ""),
    (TWO_LINKS, "sin(q2) = 0", "correct", ""),
    (TWO_LINKS, "[l1*l2*s2 = 0]", "correct", ""),
    (TWO_LINKS, "[q2 = 0, q2 = pi]", "correct", ""),
    (TWO_LINKS, "[q2 = 0 or q2 = 180deg]", "correct", ""),
    (TWO_LINKS, "[q2 = k*pi]", "correct", ""),
    (TWO_LINKS, "[q2 = 0 or 180deg]", "correct", ""),
    (TWO_LINKS, "{q2: [0, pi]}", "correct", ""),
    (TWO_LINKS, "{q1: 0}", "wrong", "not_singular"),
    (TWO_LINKS, "[q2 = 0]", "wrong", "configurations_missing"),
    (TWO_LINKS, "[cos(q2) = 0]", "wrong", "not_singular"),
    (TWO_LINKS, "[sin(q2) = 0, sin(q1) = 0]", "wrong", "not_singular"),
    (TWO_LINKS, "[sin(q2) = 0, cos(q2) = 2]", "wrong", "condition_never_holds"),
    (ELBOW, "[sin(q3) = 0, L2*cos(q2) + L3*cos(q2 + q3) = 0]", "correct", ""),
    (ELBOW, "[s3 = 0, 'L2*c2 = -L3*c23']", "correct", ""),
    (ELBOW, "[sin(q3) = 0]", "wrong", "configurations_missing"),
    (PLANAR_RPRP, '["q2 = 0 and sin(q3) = 0"]', "correct", ""),
    (PLANAR_RPRP, "[[q2 = 0, sin(q3) = 0]]", "correct", ""),
    (PLANAR_RPRP, "[q2 = 0, sin(q3) = 0]", "wrong", "not_singular"),
]

SPHERICAL = """
gravity: none
dh: [{theta: q1*, d: h, alpha: 90deg}, {theta: q2* + 90deg, alpha: 90deg}, {d: q3*}]
find: [singular]
"""
THREE_LINKS = """
gravity: none
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: q3*, a: l3}]
task: [tip.x, tip.y]
find: [singular]
"""
STRETCHED = [f"q2 = {second} and q3 = {third}" for second in ("0", "pi") for third in ("0", "pi")]
SETS += [
    (ELBOW, "[sin(q3) = 0, q2 = atan2(L2 + L3*c3, L3*s3), q2 = atan2(-L2 - L3*c3, -L3*s3)]", "correct", ""),
    (ELBOW, "[sin(q3) = 0, q3 = acos(-L2*c2/L3) - q2, q3 = -acos(-L2*c2/L3) - q2]", "correct", ""),
    (ELBOW, "[sin(q3) = 0, q2 = atan((L2 + L3*c3)/(L3*s3))]", "wrong", "configurations_missing"),
    (ELBOW, "[sin(q3) = 0, q2 = atan2(L2 + L3*c3, L3*s3)]", "wrong", "configurations_missing"),
    (ELBOW, "[sin(q3) = 0, q3 = acos(-L2*c2/L3) - q2]", "wrong", "configurations_missing"),
    (SPHERICAL, "[q3 = 0, q2 = ±pi/2]", "correct", ""),
    (SPHERICAL, "[q3 = 0, q2 = pi/2]", "wrong", "configurations_missing"),
    (THREE_LINKS, f"[{', '.join(STRETCHED)}]", "correct", ""),
    *(
        (THREE_LINKS, f"[{', '.join(one for one in STRETCHED if one != left)}]", "wrong",
         "configurations_missing") for left in STRETCHED
    ),
]  # fmt: skip

# The same sets as students write them on a page.
WRITTEN = [
    (TWO_LINKS, "q2 = 0 or pi"),
    (TWO_LINKS, "θ₂ = 0 or π"),
    (TWO_LINKS, r"q_2 = 0, \pi"),
    (TWO_LINKS, "q2 = 0; q2 = pi"),
    (TWO_LINKS, "q2 == 0 or q2 == pi"),
    (TWO_LINKS, "q2 = 0 and q2 = pi"),
    (TWO_LINKS, "q2 ∈ {0, π}"),
    (TWO_LINKS, r"q_2 \in \{0, \pi\}"),
    (TWO_LINKS, "q2 in {0, pi}"),
    (TWO_LINKS, "{q2: 0 or pi}"),
    (TWO_LINKS, "q2 = 0 (mod pi)"),
    (TWO_LINKS, r"q_2 = k\pi, k \in \mathbb{Z}"),
    (TWO_LINKS, "q2 = k pi for k integer"),
    (TWO_LINKS, r"q_2 = k\pi,\; k = 0, 1, \dots"),
    (TWO_LINKS, r"$\sin q_2 = 0$"),
    (TWO_LINKS, r"\sin q_2 = 0 \Rightarrow q_2 = 0, \pi"),
    (TWO_LINKS, r"q_2 = 0^\circ \;\text{or}\; 180^\circ"),
    (TWO_LINKS, r"\det J = l_1 l_2 \sin q_2 = 0"),
    (TWO_LINKS, "|J| = l1*l2*sin(q2) = 0"),
    (ELBOW, "s3 = 0 or L2*c2 + L3*c23 = 0"),
    (ELBOW, r"s_3 (L_2 c_2 + L_3 c_{23}) = 0"),
    (ELBOW, r"\sin\theta_3 = 0 \text{ or } L_2\cos\theta_2 + L_3\cos(\theta_2+\theta_3) = 0"),
    (ELBOW, r"[\sin q_3 = 0, L_2 \cos q_2 + L_3 \cos(q_2+q_3) = 0]"),
    (PLANAR_RPRP, r"q_2 = 0 \wedge q_3 = k\pi"),
    (PLANAR_RPRP, "(q2 = 0 and q3 = 0) or (q2 = 0 and q3 = pi)"),
    (PLANAR_RPRP, "q2 = 0 and (q3 = 0 or q3 = pi)"),
    (PLANAR_RPRP, "q2 = sin(q3) = 0"),
    (PLANAR_RPRP, "q2 = 0 and cos(q3) = ±1"),
    (PLANAR_RPRP, "{q2: 0, q3: [0, pi]}"),
]


@pytest.mark.parametrize(("problem", "value"), WRITTEN)
def test_sets_as_they_are_written(problem: str, value: str) -> None:
    answer = judged(problem, "singular", value)
    assert answer.verdict == "correct", (answer.fault, answer.diagnosis)


@pytest.mark.parametrize(("problem", "value", "verdict", "code"), SETS)
def test_sets(problem: str, value: str, verdict: str, code: str) -> None:
    answer = judged(problem, "singular", value)
    assert answer.verdict == verdict, (answer.fault, answer.diagnosis)
    assert [one.code for one in answer.diagnosis] == ([code] if code else [])


@pytest.mark.parametrize(
    "value",
    [
        "[sin(q2 = 0]",
        "[0, pi]",
        "q1 = 0, sin(q2) = 0",
        "{x7: 0}",
        "[x7 = 0]",
        "[a = b = c]",
        "[0 or q2 = = 1]",
    ],
)
def test_what_cannot_be_read_says_why(value: str) -> None:
    answer = judged(TWO_LINKS, "singular", value)
    assert answer.verdict == "unreadable"
    assert answer.fault
