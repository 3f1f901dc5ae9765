"""What is said of a singular configuration is true at all of it: of its rank, and of the lost directions."""

from __future__ import annotations

import pytest

import dynsolve
from dynsolve.document import Prose
from dynsolve.notation.unicode import to_unicode

RRP = """
dh: [{theta: q1*, d: L1, alpha: 90deg}, {theta: q2* + 90deg, alpha: 90deg}, {d: q3*}]
find: [singular]
"""
STRETCHED = """
gravity: none
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
find: [singular]
"""
FOLDED = """
dh: [{theta: q1*, alpha: 90deg}, {theta: q2*, a: a2, alpha: 90deg}, {theta: q3*, a: a3}]
find: [singular]
"""


@pytest.mark.parametrize(
    ("problem", "case", "rank_holds", "are_independent"),
    [
        (RRP, 0, True, True),  # q3 = 0: (s1, -c1, 0) and one orthogonal to it, never 0
        (RRP, 1, False, True),  # c2 = 0: where q3 = 0 besides, the rank is 1
        (FOLDED, 0, False, True),  # a2 + a3 c3 = 0: where a2 = a3 it is folded, and the rank is 1
        (STRETCHED, 0, True, True),  # s2 = 0: one direction, along the arm
    ],
)
def test_what_does_not_hold_everywhere_is_told(
    problem: str, case: int, rank_holds: bool, are_independent: bool
) -> None:
    (step,) = (s for s in dynsolve.solve(problem).explain(["singular"]) if s.id == f"singular_{case + 1}")
    told = "".join(part if isinstance(part, str) else "·" for part in step.why)
    assert ("the rank is in general" in told) is not rank_holds
    assert ("In general" in told) is not are_independent


def test_that_free_coordinates_are_free_is_said_where_there_are_any() -> None:
    pendulum = (
        "gravity: [0, -g, 0]\ndh: [{theta: q1*, a: l}]\nmasses: [{mass: m, link: 1}]\nfind: [equilibria]\n"
    )
    sliding = pendulum.replace("}]\nmasses", "}, {d: d2*}]\nmasses").replace(
        "link: 1", "link: 2, center: origin"
    )
    for problem, are_free in ((pendulum, False), (sliding, True)):
        (step,) = (s for s in dynsolve.solve(problem).explain(["equilibria"]) if s.id == "equilibria")
        assert (
            any("arbitrary" in part for note in step.notes for part in note if isinstance(part, str))
            is are_free
        )


def _words(prose: Prose) -> str:
    return "".join(part if isinstance(part, str) else to_unicode(part) for part in prose)


def _told(problem: str, case: int) -> str:
    """Why a step of a singular case says what it says, formulas as text."""
    (step,) = (s for s in dynsolve.solve(problem).explain(["singular"]) if s.id == f"singular_{case}")
    return _words(step.why)


FLAT = STRETCHED.replace("find:", "task: [tip.x, tip.y, tip.z]\nfind:")
UPRIGHT = """
gravity: none
dh: [{theta: q1*, alpha: 90deg, a: a1}, {theta: q2*, a: l1}]
task: [tip.x, tip.y, tip.z]
find: [singular]
"""


def test_a_force_is_named_where_all_that_is_asked_are_places_of_points() -> None:
    assert "A force along it needs no torque" in _told(FLAT, 1)
    slide = (
        "dh: [{theta: q1*}, {d: d2*, alpha: 90deg}, {theta: q3*, a: l3}]\ngravity: none\nfind: [singular]\n"
    )
    assert "A force and a moment along it need no" in _told(FLAT.replace("tip.y, tip.z", "q1 + q2"), 1)
    assert "What acts along it needs no" in _told(FLAT.replace("tip.y, tip.z", "tip.x*tip.y"), 1)
    assert "torque or force of the joints" in _told(slide + "task: [tip.x, tip.y, tip.z]\n", 1)


def test_an_arm_of_full_rank_says_that_its_minors_are_never_0_at_once() -> None:
    upright = UPRIGHT.replace("a: a1", "d: l0").replace("[tip.x, tip.y, tip.z]", "twist")
    steps = dynsolve.solve(upright).explain(["singular"])
    told = [_words(step.why) for step in steps if step.id == "singular"]
    assert told == ["The rank of J_r is 2 in every configuration, as the minors are never all 0 at once."]
    minors = next(
        step for step in dynsolve.solve(upright).explain(["singular"]) if step.id == "singular_minors"
    )
    assert len({to_unicode(one).partition("=")[2].lstrip(" -") for one in minors.result}) == len(
        minors.result
    )


def test_a_direction_is_written_in_whole_numbers() -> None:
    """At q₂ = 0 the tip moves across the arm: 3 and 2 are the heights that q₁ and q₂ turn it by."""
    arm = """
dh: [{theta: q1*, a: 3}, {theta: q2*, a: 2}]
task: [tip.y, q1]
state: {q1: 0, q2: 90deg}
find: [lost, nullspace]
"""
    found = dynsolve.solve(arm.replace("q2: 90deg", "q2: 0")).to_json()["results"]
    assert found["lost"] == [] and found["nullspace"] == []
    wide = arm.replace("[tip.y, q1]", "[tip.y]").replace("q2: 90deg", "q2: 0")
    assert dynsolve.solve(wide).to_json()["results"]["nullspace"] == [["2", "-5"]]


@pytest.mark.parametrize("offset", ["30deg", "45deg", "60deg"])
def test_a_direction_has_no_number_that_all_components_share(offset: str) -> None:
    arm = f"gravity: none\ndh: [{{theta: q1* + {offset}, a: b}}, {{theta: q2*, a: c}}]\nfind: [singular]\n"
    (step,) = (step for step in dynsolve.solve(arm).steps if step.id == "singular_1")
    degrees = offset.removesuffix("deg")
    assert to_unicode(step.result[0]) == f"w = [[cos(q₁ + {degrees}°)], [sin(q₁ + {degrees}°)]]"


def test_a_minor_is_called_by_its_columns() -> None:
    """By hand: columns 2 and 3 of a slide along x and a turn of the end, l₃ sin q₃ apart."""
    text = """
dh: [{theta: q1*, a: l1, alpha: -90deg}, {d: q2*, alpha: 90deg}, {theta: q3*, a: l3}]
task: [tip.x, tip.y]
find: [singular]
"""
    (step,) = (step for step in dynsolve.solve(text).steps if step.id == "singular_minors")
    names = [to_unicode(one).partition(" = ")[0] for one in step.result]
    assert names == ["minor (columns 1, 2)", "minor (columns 1, 3)", "minor (columns 2, 3)"]


def test_what_is_lost_anyhow_may_vanish_in_a_singular_configuration() -> None:
    """Three joints about one axis, two of them with lengths behind: the direction across is 0 at a pose."""
    arm = """
gravity: none
dh:
  - {theta: theta1*}
  - {theta: theta2*}
  - {theta: theta3* - theta2*, a: L, alpha: 45deg}
  - {theta: theta4* + 90deg, a: L, alpha: 45deg}
  - {theta: theta5* + 45deg, alpha: 90deg}
find: [singular]
"""
    assert dynsolve.solve(arm).to_json()["results"]["singular"]


def test_a_direction_loses_factors_that_are_the_same_where_a_cosine_is_1_or_minus_1() -> None:
    """At s2 = 0, where c2² = 1, s1 c2 c3 + c1 s3 is c2 (s1 c3 + c1 c2 s3)."""
    wrist = """
dh: [{theta: q1*, alpha: 90deg}, {theta: q2*, alpha: -90deg}, {theta: q3*, a: l, alpha: 90deg}]
task: pose
find: [singular]
"""
    (step,) = (step for step in dynsolve.solve(wrist).steps if step.id == "singular_1")
    assert "w₂ = [[0], [0], [sin(q₁) cos(q₂)], [-l cos(q₃)], [0], [0]]" in map(to_unicode, step.result)


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        ("[{theta: a*, alpha: -90deg}, {d: b*, alpha: 90deg}, {theta: c*, a: L}]\ntask: [tip.x, tip.y, a+c]",
         ""),
        ("[{theta: q1*, a: a}, {theta: q2*, a: b}]\ntask: [tip.x, tip.y]",
         "A product is 0 where one of its factors is. Constant lengths are not 0, so one case is left."),
        ("[{theta: q1*, alpha: 90deg}, {theta: q2*, alpha: 90deg}, {d: q3*}]\ntask: [tip.x, tip.y, tip.z]",
         "A product is 0 where one of its factors is; each of these cases is enough."),
    ],
)  # fmt: skip
def test_products_and_lengths_are_spoken_of_where_there_are_any(rows: str, said: str) -> None:
    solution = dynsolve.solve(f"gravity: none\ndh: {rows}\nfind: [singular]\n")
    (step,) = (step for step in solution.steps if step.id == "singular")
    assert "".join(map(str, step.why)) == said
