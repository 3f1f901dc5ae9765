"""What is said of a set of configurations is true at the point that is told."""

from __future__ import annotations

import random
import re
from math import cos, isclose, radians, sin

import pytest

from dynsolve.answers.judge import Checker
from dynsolve.problem import read_problem

ARM = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
task: [tip.x, tip.y]
find: [singular, equilibria]
"""
TRUE = {
    "singular": lambda q1, q2: isclose(sin(q2), 0, abs_tol=1e-9),
    "equilibria": lambda q1, q2: isclose(cos(q1), 0, abs_tol=1e-9) and isclose(sin(q2), 0, abs_tol=1e-9),
}
CHECKER = Checker(read_problem(ARM, "own.yaml"))


def holds(one: dict[str, int], at: dict[str, int]) -> bool:
    return all((at.get(name, 999) - angle) % 360 == 0 for name, angle in one.items())


@pytest.mark.parametrize("name", TRUE)
@pytest.mark.parametrize("seed", range(8))
def test_a_set_is_told_by_a_configuration_that_shows_it(name: str, seed: int) -> None:
    draw = random.Random(f"{name} {seed}")
    angles = {"q1": [90, 270, 90, 0], "q2": [0, 180, 0, 180, 90]}
    given = [
        {q: draw.choice(angles[q]) for q in (draw.choice([["q2"], ["q1", "q2"], ["q1", "q2"]]))}
        for _ in range(draw.randint(1, 3))
    ]
    written = ", ".join('"' + " and ".join(f"{q} = {a}deg" for q, a in one.items()) + '"' for one in given)
    report = CHECKER(CHECKER.reader(f"answers:\n  {name}: [{written}]\n", "a.yaml"))
    (found,) = (a for a in report.answers if a.name == name)
    if found.verdict == "correct":
        return
    (told,) = found.diagnosis
    values = re.findall(r"(q[₁₂]) = (\d+)°", told.message)
    at = {q.replace("₁", "1").replace("₂", "2"): int(a) for q, a in values}
    is_one = TRUE[name](*(radians(at.get(q, 33)) for q in ("q1", "q2")))
    number = re.search(r"alternative (\d)", told.message)
    if number:
        assert told.code in ("not_singular", "no_equilibrium")
        assert holds(given[int(number[1]) - 1], at) and not is_one
    else:
        assert told.code in ("configurations_missing", "equilibria_missing")
        assert is_one and not any(holds(one, at) for one in given)
