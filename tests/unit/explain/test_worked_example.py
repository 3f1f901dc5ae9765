"""What a worked example tells beside the chain of the course: every answer, each once, true of this robot."""

from __future__ import annotations

import pytest

import dynsolve
from dynsolve.explain.step import Detail
from dynsolve.notation.unicode import to_unicode
from dynsolve.render.files import Format
from dynsolve.solution.reports import report
from tests.support import ROOT, solved

FINGERS = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {from: 1, theta: q2*, a: l2}, {from: 1, theta: q3*, a: l3}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}, {mass: m3, link: 3}]
"""
"""Two fingers on one link: the last frame does not see q2."""
GOLDEN = ROOT / "tests" / "golden"


def normal(problem: str) -> str:
    """The worked example, in one line."""
    path = GOLDEN / problem
    solution = solved(path if path.exists() else problem)
    return " ".join(report(solution, Format.TEXT, detail=Detail.NORMAL).decode().split())


@pytest.mark.parametrize(
    ("problem", "told"),
    [
        ("crane", "At q₂ = 0: stable, but for q₁"),
        ("asked/goldstein-2-18-hoop.yaml", "stable where"),
        ("planar-2r-reach", "This equation has solutions where -1 ≤"),
        ("planar-2r-reach", "q₂ is beyond the limits."),
        ("planar-3r-redundant", "The state is q₁ = 0, q₂ = 0, q₃ = 0. 𝐪̇ = 𝐉_r⁺ 𝐫̇"),
        ("rp-parameters", "Fewer than 3 entries are not enough"),
        ("planar-2r-motors", "The rotor that drives q₂ rides on link 1"),
    ],
)
def test_what_answers_a_question_or_is_needed_for_a_line_is_shown(problem: str, told: str) -> None:
    assert told in normal(problem)


@pytest.mark.parametrize(
    "problem", ["cart-pole", "knife-edge", "rp-parameters", "in3140-rp", "pr-factorizations"]
)
def test_the_outcome_of_a_check_is_a_sentence_of_its_own(problem: str) -> None:
    outcomes = [step.outcome for step in solved(problem).explain() if step.outcome]
    assert outcomes
    for outcome in outcomes:
        told = "".join(part if isinstance(part, str) else "·" for part in outcome).strip()
        assert told.endswith(".") and not told.startswith("So ") and ",," not in told


def test_a_momentum_along_one_axis_is_not_the_whole() -> None:
    free = """
gravity: none
model:
  coordinates: {x: prismatic, y: prismatic, phi: revolute}
  bodies: [{mass: m, at: [x, y, 0], turn: phi, about: [0, 0, 1], inertia: {zz: J}}]
"""
    (step,) = (step for step in solved(free).explain() if step.id == "conserved")
    said = "".join(part for part in step.concluding if isinstance(part, str))
    assert said.count("(the total linear momentum along x)") == 1
    assert "(the total linear momentum along y)" in said


@pytest.mark.parametrize("problem", ["planar-rrp-task", "inf3480-rrp-drawn", "spatial-3r-acceleration"])
def test_what_is_alike_is_said_once(problem: str) -> None:
    text = normal(problem)
    for sentence in (
        "Every velocity that the joints can give",
        "𝐰ᵀ𝐉_r = 𝟎",
        "and 𝐱₁ is perpendicular to both",
    ):
        assert text.count(sentence) <= 1


TWO_THAT_MEET = """
gravity: none
axes:
  - {turn: q1, about: [0, 0, 1], through: [0, 0, 0]}
  - {turn: q2, about: [%s, 0, 0], through: [0, 0, h]}
tip: {at: [0, l, h]%s}
"""


@pytest.mark.parametrize(
    ("about", "hand", "chosen"),
    [
        ("1", "", "with a positive α"),
        ("-1", "", "with a positive α"),
        ("1", ", z: [0, 1, 0], x: [0, 0, 1]", "nearer to the x of the hand"),
    ],
)
def test_the_direction_of_a_normal_has_the_reason_that_chose_it(about: str, hand: str, chosen: str) -> None:
    text = " ".join(report(solved(TWO_THAT_MEET % (about, hand)), Format.TEXT).decode().split())
    assert f"Of its two directions the one {chosen} is taken." in text
    assert "nearer to 𝐱₀" not in text


def test_a_coordinate_of_another_branch_has_a_column_of_zeros() -> None:
    steps = {step.id: step for step in dynsolve.solve(FINGERS).explain(["jacobian"])}
    whole = steps["J"].formula
    assert whole is not None
    rows = whole.parts[-1].rows  # type: ignore[attr-defined]
    assert [len(row) for row in rows] == [3, 3]
    assert "".join(part for part in steps["J2"].why if isinstance(part, str)) == (
        " does not move the origin of frame 3: its column is zero."
    )
    assert "the frame that its row starts from" in "".join(p for p in steps["axes"].why if isinstance(p, str))


@pytest.mark.parametrize(
    ("problem", "told"),
    [
        ("crane", "At q₂ = 0: stable, but for q₁"),
        ("articulated-6r", "⎣z - r₃₃ d₆⎦ q₁ = atan2(y_c, x_c) q₁ = atan2(-y_c, -x_c)"),
        ("planar-2r-reach", "The inverse kinematics: q₁ q₂ Limits"),
    ],
)
def test_the_results_alone_answer_the_question(problem: str, told: str) -> None:
    text = " ".join(report(solved(problem), Format.TEXT, detail=Detail.RESULTS).decode().split())
    assert told in text


@pytest.mark.parametrize(("mass", "shown"), [("m1", "m₁"), ("M", "M"), ("2", "m₁")])
def test_a_sum_of_one_has_the_names_of_the_problem(mass: str, shown: str) -> None:
    """And no letters of the book that read as they do, or that nothing else calls so."""
    arm = f"""
gravity: [0, -g, 0]
dh: [{{theta: theta*, a: L}}]
masses: [{{mass: {mass}, link: 1, center: midpoint}}]
task: [tip.x, theta]
find: [tau, C, D, Jr_dot]
"""
    steps = {step.id: step for step in solved(arm).steps}
    assert f"({shown} J_v1" in to_unicode(steps["D_direct"].formula)
    for name in ("C", "Jr_dot"):
        text = to_unicode(steps[name].task or steps[name].formula)
        assert "θ̇" in text and "q̇₁" not in text and "q₁" not in text
