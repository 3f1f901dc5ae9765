"""What is said of a singular configuration is true at all of it: of its rank, and of the lost directions."""

from __future__ import annotations

import pytest

import dynsolve

RRP = """
dh: [{theta: q1*, d: L1, alpha: 90deg}, {theta: q2* + 90deg, alpha: 90deg}, {d: q3*}]
find: [singular]
"""
STRETCHED = """
gravity: none
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
find: [singular]
"""


@pytest.mark.parametrize(
    ("problem", "case", "rank_holds", "are_independent"),
    [
        (RRP, 0, True, False),  # q3 = 0: (s1, -c1, 0) and (s2, 0, -c1 c2) are parallel where c1 = 0
        (RRP, 1, False, True),  # c2 = 0: where q3 = 0 besides, the rank is 1
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
        assert any(" may have any value." in note for note in step.notes) is are_free
