"""Inverse kinematics in formulas that are right in every quadrant, or in some only.

What is right an oracle says: the formulas in floating point, put into the forward kinematics of the
arm by hand, at configurations all around with lengths in every order (independently derived, 2026-11).
"""

from __future__ import annotations

import math
import random
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import cos, pi, sin, sqrt

import pytest

from tests.unit.answers.judging.test_configurations import judged

KNOWN = {name: getattr(math, name) for name in ("sin", "cos", "sqrt", "acos", "asin", "atan", "atan2", "pi")}
KNOWN["sgn"] = lambda x: (x > 0) - (x < 0)

Branch = dict[str, str]


@dataclass(frozen=True)
class Arm:
    """A table, which of q1, q2, ... turn (r) and slide (p), its lengths, and r(q) by hand."""

    table: str
    joints: str
    lengths: tuple[str, ...]
    reach: Callable[..., dict[str, float]]
    task: str = ""

    @property
    def problem(self) -> str:
        names = ", ".join(self.reach(*[1.0] * (len(self.joints) + len(self.lengths))))
        return f"gravity: none\ndh: [{self.table}]\nreach: [{names}]\n{self.task}find: [inverse]\n"


def at(x: float, y: float, z: float) -> dict[str, float]:
    return {"x": x, "y": y, "z": z}


def two_links(q1: float, q2: float, l1: float, l2: float) -> dict[str, float]:
    return {"x": l1 * cos(q1) + l2 * cos(q1 + q2), "y": l1 * sin(q1) + l2 * sin(q1 + q2)}


def three_links(q1: float, q2: float, q3: float, l1: float, l2: float, l3: float) -> dict[str, float]:
    phi, wrist = q1 + q2 + q3, two_links(q1, q2, l1, l2)
    return {"x": wrist["x"] + l3 * cos(phi), "y": wrist["y"] + l3 * sin(phi), "phi": phi}


def elbow(q1: float, q2: float, q3: float, h: float, l2: float, l3: float) -> dict[str, float]:
    plane = two_links(q2, q3, l2, l3)
    return at(plane["x"] * cos(q1), plane["x"] * sin(q1), h + plane["y"])


def offset(q1: float, q2: float, q3: float, d2: float) -> dict[str, float]:
    out = q3 * sin(q2)
    return at(out * cos(q1) - d2 * sin(q1), out * sin(q1) + d2 * cos(q1), q3 * cos(q2))


ARMS = {
    "2R": Arm("{theta: q1*, a: l1}, {theta: q2*, a: l2}", "rr", ("l1", "l2"), two_links),
    "RP": Arm("{theta: q1* + 90deg, alpha: 90deg}, {d: q2*}", "rp", (),
              lambda q1, q2: {"x": q2 * cos(q1), "y": q2 * sin(q1)}, "task: [tip.x, tip.y]\n"),
    "cylindrical": Arm("{theta: q1*, d: h}, {d: q2*, alpha: -90deg}, {d: q3*}", "rpp", ("h",),
                       lambda q1, q2, q3, h: at(-q3 * sin(q1), q3 * cos(q1), h + q2)),
    "spherical": Arm("{theta: q1*, d: h, alpha: 90deg}, {theta: q2* + 90deg, alpha: 90deg}, {d: q3*}", "rrp",
                     ("h",), lambda q1, q2, q3, h: at(q3 * cos(q1) * cos(q2), q3 * sin(q1) * cos(q2),
                                                      h + q3 * sin(q2))),
    "offset": Arm("{theta: q1*, alpha: -90deg}, {theta: q2*, d: d2, alpha: 90deg}, {d: q3*}", "rrp", ("d2",),
                  offset),
    "3R": Arm("{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: q3*, a: l3}", "rrr", ("l1", "l2", "l3"),
              three_links, "task: [tip.x, tip.y, q1 + q2 + q3]\n"),
    "elbow": Arm("{theta: q1*, d: h, alpha: 90deg}, {theta: q2*, a: l2}, {theta: q3*, a: l3}", "rrr",
                 ("h", "l2", "l3"), elbow),
    "PPR": Arm("{d: q1*, alpha: -90deg}, {d: q2*, a: l1, alpha: 60deg}, {theta: q3*, a: l2}", "ppr",
               ("l1", "l2"), lambda q1, q2, q3, l1, l2: at(l1 + l2 * cos(q3), q2 + sqrt(3) / 2 * l2 * sin(q3),
                                                           q1 - l2 * sin(q3) / 2)),
}  # fmt: skip


def missed(arm: Arm, branch: Branch) -> list[bool]:
    """Of each configuration where the branch has a value, whether it misses what is to be reached."""
    fresh, found = random.Random(1), []
    codes = {name: compile(text, name, "eval") for name, text in in_order(branch)}
    names = [f"q{k}" for k in range(1, len(arm.joints) + 1)]
    for _ in range(400):
        lengths = {name: math.exp(fresh.uniform(-1.2, 1.2)) for name in arm.lengths}
        q = [fresh.uniform(-pi, pi) if kind == "r" else fresh.uniform(-2, 2) for kind in arm.joints]
        wanted = arm.reach(*q, *lengths.values())
        values = {**lengths, **wanted}
        try:
            for name, code in codes.items():
                values[name] = eval(code, KNOWN, values)  # noqa: S307 - formulas of our own
        except (ValueError, ZeroDivisionError):
            continue
        reached = arm.reach(*(values[name] for name in names), *lengths.values())
        turns = reached.get("phi", 0.0) - wanted.get("phi", 0.0)
        off = [abs(reached[name] - wanted[name]) for name in wanted.keys() - {"phi"}]
        found.append(max(*off, 1 - cos(turns)) > 1e-6)
    return found


def in_order(branch: Branch) -> Iterator[tuple[str, str]]:
    """The formulas, those first that later ones hold."""
    left = dict(branch)
    while left:
        for name, text in list(left.items()):
            if not any(re.search(rf"\b{other}\b", text) for other in left):
                yield name, left.pop(name)


R = "sqrt(x**2 + y**2)"
C2 = "(x**2 + y**2 - l1**2 - l2**2)/(2*l1*l2)"
T2 = "atan2(l2*sin(q2), l1 + l2*cos(q2))"
X, Y = "(x - l3*cos(phi))", "(y - l3*sin(phi))"
CW = f"({X}**2 + {Y}**2 - l1**2 - l2**2)/(2*l1*l2)"
CE = "(x**2 + y**2 + (z - h)**2 - l2**2 - l3**2)/(2*l2*l3)"
T3 = "atan2(l3*sin(q3), l2 + l3*cos(q3))"
OUT = "sqrt(x**2 + y**2 - d2**2)"
CP = "(x - l1)/l2"


def two(q1: str, q2: str = f"acos({C2})") -> Branch:
    return {"q1": q1, "q2": q2}


def polar(q1: str, q2: str = R) -> Branch:
    return {"q1": q1, "q2": q2}


def on_column(q1: str, q3: str = R, q2: str = "z - h") -> Branch:
    return {"q1": q1, "q2": q2, "q3": q3}


def ball(q1: str, q2: str, q3: str = "sqrt(x**2 + y**2 + (z - h)**2)") -> Branch:
    return {"q1": q1, "q2": q2, "q3": q3}


def beside(q1: str, q2: str, q3: str = "sqrt(x**2 + y**2 + z**2 - d2**2)") -> Branch:
    return {"q1": q1, "q2": q2, "q3": q3}


def wrist(q1: str, q2: str = f"acos({CW})", q3: str = "phi - q1 - q2") -> Branch:
    return {"q1": q1, "q2": q2, "q3": q3}


def arm_of_3(q2: str, q1: str = "atan2(y, x)", q3: str = f"acos({CE})") -> Branch:
    return {"q1": q1, "q2": q2, "q3": q3}


def tilted(q3: str) -> Branch:
    return {"q1": "z + l2*sin(q3)/2", "q2": "y - sqrt(3)/2*l2*sin(q3)", "q3": q3}


RIGHT = [
    ("2R", two(f"atan2(y, x) - {T2}"), two(f"atan2(y, x) - {T2}", f"-acos({C2})")),
    ("2R", two(f"atan2(y, x) - {T2}", f"atan2(sqrt(1 - ({C2})**2), {C2})")),
    ("2R", two("atan2(y*(l1 + l2*cos(q2)) - x*l2*sin(q2), x*(l1 + l2*cos(q2)) + y*l2*sin(q2))")),
    ("2R", two(f"atan2(y, x) - {T2}",
               "2*atan(sqrt(((l1 + l2)**2 - x**2 - y**2)/(x**2 + y**2 - (l1 - l2)**2)))")),
    ("2R", two(f"2*atan(y/(x + {R})) - {T2}")),
    ("2R", two(f"atan(y/x) + pi*(1 - sgn(x))/2 - {T2}")),
    ("2R", two(f"atan2(y, x) - acos((x**2 + y**2 + l1**2 - l2**2)/(2*l1*{R}))",
               "pi - acos((l1**2 + l2**2 - x**2 - y**2)/(2*l1*l2))")),
    ("RP", polar("atan2(y, x)"), polar("atan2(-y, -x)", f"-{R}")),
    ("RP", polar("atan(y/x)", "x/cos(q1)")),
    ("RP", polar("atan(y/x)", f"sgn(x)*{R}")),
    ("RP", polar("pi/2 - atan(x/y)", "y/sin(q1)")),
    ("cylindrical", on_column("atan2(-x, y)")),
    ("cylindrical", on_column("atan2(y, x) - pi/2")),
    ("cylindrical", on_column("-atan(x/y)", "y/cos(q1)")),
    ("spherical", ball("atan2(y, x)", f"atan2(z - h, {R})"), ball("atan2(-y, -x)", f"atan2(z - h, -{R})")),
    ("spherical", ball("atan2(y, x)", f"atan((z - h)/{R})")),
    ("spherical", ball("atan2(y, x)", "asin((z - h)/q3)")),
    ("spherical", ball("atan(y/x)", "atan2(z - h, x*cos(q1) + y*sin(q1))")),
    ("offset", beside(f"atan2(y, x) - atan2(d2, {OUT})", f"atan2({OUT}, z)")),
    ("offset", beside(f"atan2(y, x) - asin(d2/{R})", "acos(z/q3)")),
    ("offset", beside(f"atan2(y, x) - atan(d2/{OUT})", f"atan({OUT}/z)", "z/cos(q2)")),
    ("3R", wrist(f"atan2({Y}, {X}) - {T2}"), wrist(f"atan2({Y}, {X}) - {T2}", f"-acos({CW})")),
    ("3R", wrist(f"2*atan({Y}/({X} + sqrt({X}**2 + {Y}**2))) - {T2}")),
    ("elbow", arm_of_3(f"atan2(z - h, {R}) - {T3}")),
    ("elbow", arm_of_3(f"atan((z - h)/{R}) - {T3}")),
    ("elbow", arm_of_3(f"atan2(z - h, sgn(x)*{R}) - {T3}", "atan(y/x)")),
    ("PPR", tilted(f"acos({CP})"), tilted(f"-acos({CP})")),
    ("PPR", tilted(f"pi/2 - asin({CP})")),
]  # fmt: skip

# (the arm, the branch, the code of the slip)
WRONG = [
    ("2R", two(f"atan(y/x) - {T2}"), "quadrant_lost"),
    ("2R", two("atan2(y, x) - atan(l2*sin(q2)/(l1 + l2*cos(q2)))"), "quadrant_lost"),
    ("2R", two(f"atan2(y, x) - asin(l2*sin(q2)/{R})"), "quadrant_lost"),
    ("2R", two(f"asin(y/{R}) - {T2}"), "quadrant_lost"),
    ("2R", two(f"acos(x/{R}) - {T2}"), "quadrant_lost"),
    ("2R", two("atan((y*(l1 + l2*cos(q2)) - x*l2*sin(q2))/(x*(l1 + l2*cos(q2)) + y*l2*sin(q2)))"),
     "quadrant_lost"),
    ("2R", two(f"atan2(y, x) - {T2}", f"asin(sqrt(1 - ({C2})**2))"), "quadrant_lost"),
    ("2R", two(f"atan2(y, x) - {T2}", f"atan(sqrt(1 - ({C2})**2)/({C2}))"), "quadrant_lost"),
    ("2R", two(f"atan2(y, x) - {T2} + pi"), "branch_misses"),
    ("2R", two(f"atan2(y, x) + {T2}"), "branch_misses"),
    ("2R", two("atan2(x, y) - atan2(l1 + l2*cos(q2), l2*sin(q2))"), "atan2_order"),
    ("RP", polar("atan(y/x)"), "quadrant_lost"),
    ("RP", polar(f"asin(y/{R})", "x/cos(q1)"), "quadrant_lost"),
    ("RP", polar("pi/2 - atan(x/y)"), "quadrant_lost"),
    ("RP", polar("atan2(x, y)"), "atan2_order"),
    ("RP", polar("atan2(-y, -x)"), "branch_misses"),
    ("cylindrical", on_column("-atan(x/y)"), "quadrant_lost"),
    ("cylindrical", on_column(f"acos(y/{R})"), "quadrant_lost"),
    ("cylindrical", on_column("atan2(-x, y)", R, "z + h"), "branch_misses"),
    ("spherical", ball("atan(y/x)", f"atan((z - h)/{R})"), "quadrant_lost"),
    ("spherical", ball("atan2(y, x)", f"acos({R}/q3)"), "quadrant_lost"),
    ("spherical", ball("atan2(y, x)", f"atan2(z + h, {R})", "sqrt(x**2 + y**2 + (z + h)**2)"),
     "branch_misses"),
    ("offset", beside(f"atan2(y, x) - atan2(d2, {OUT})", f"atan({OUT}/z)"), "quadrant_lost"),
    ("offset", beside(f"atan2(y, x) - atan2(d2, {OUT})", f"asin({OUT}/q3)"), "quadrant_lost"),
    ("offset", beside(f"atan2(y, x) + atan2(d2, {OUT})", f"atan2({OUT}, z)"), "branch_misses"),
    ("3R", wrist(f"atan({Y}/{X}) - {T2}"), "quadrant_lost"),
    ("3R", wrist(f"atan2({Y}, {X}) - atan(l2*sin(q2)/(l1 + l2*cos(q2)))"), "quadrant_lost"),
    ("3R", wrist(f"atan2({Y}, {X}) - {T2}", f"asin(sqrt(1 - ({CW})**2))"), "quadrant_lost"),
    ("3R", wrist(f"atan2({Y}, {X}) - {T2}", f"acos({CW})", "phi - q1 + q2"), "branch_misses"),
    ("elbow", arm_of_3(f"atan2(z - h, {R}) - atan(l3*sin(q3)/(l2 + l3*cos(q3)))"), "quadrant_lost"),
    ("elbow", arm_of_3(f"atan2(z - h, {R}) - {T3}", "atan2(y, x)", f"asin(sqrt(1 - ({CE})**2))"),
     "quadrant_lost"),
    ("elbow", arm_of_3(f"atan2(z - h, {R}) - {T3}", "atan(y/x)"), "quadrant_lost"),
    ("elbow", arm_of_3(f"atan2(z + h, {R}) - {T3}"), "branch_misses"),
    ("PPR", tilted(f"asin(sqrt(1 - ({CP})**2))"), "quadrant_lost"),
    ("PPR", tilted(f"atan(sqrt(1 - ({CP})**2)/({CP}))"), "quadrant_lost"),
]  # fmt: skip


def written(*branches: Branch) -> str:
    items = (
        "{" + ", ".join(f"{name}: '{text}'" for name, text in branch.items()) + "}" for branch in branches
    )
    return f"[{', '.join(items)}]"


@pytest.mark.parametrize(("name", "branches"), [(name, branches) for name, *branches in RIGHT])
def test_what_is_right_in_every_quadrant(name: str, branches: list[Branch]) -> None:
    assert not any(any(missed(ARMS[name], branch)) for branch in branches)
    answer = judged(ARMS[name].problem, "inverse", written(*branches))
    assert (answer.verdict, answer.diagnosis) == ("correct", ())


@pytest.mark.parametrize(("name", "branch", "code"), WRONG)
def test_what_is_wrong_in_a_quadrant(name: str, branch: Branch, code: str) -> None:
    assert set(missed(ARMS[name], branch)) == ({True, False} if code == "quadrant_lost" else {True})
    answer = judged(ARMS[name].problem, "inverse", written(branch))
    assert (answer.verdict, [slip.code for slip in answer.diagnosis]) == ("wrong", [code])


@pytest.mark.parametrize(
    "value",
    [
        r"[{q_1: \arctan\frac{y}{x}, q_2: \sqrt{x^2 + y^2}}]",
        r"[{q_1: \tan^{-1}(y/x), q_2: \sqrt{x^2 + y^2}}]",
        "q1 = arctan(y/x), q2 = sqrt(x^2 + y^2)",
        "[[atan(y/x), sqrt(x^2 + y^2)]]",
        "[{q1: atan(y/x), q2: ±sqrt(x^2 + y^2)}]",
        "[{q1: ±acos(x/sqrt(x^2 + y^2)), q2: sqrt(x^2 + y^2)}]",
    ],
)
def test_a_lost_quadrant_in_every_notation(value: str) -> None:
    answer = judged(ARMS["RP"].problem, "inverse", value)
    assert [slip.code for slip in answer.diagnosis] == ["quadrant_lost"]


INNER = written(two("atan2(y, x) - atan(l2*sin(q2)/(l1 + l2*cos(q2)))"))
PLAIN = written(polar("atan(y/x)"))


@pytest.mark.parametrize(
    ("name", "more", "value", "verdict"),
    [
        ("2R", "values: {l1: 0.5, l2: 0.4}\n", INNER, "correct"),
        ("2R", "values: {l1: 0.4, l2: 0.5}\n", INNER, "wrong"),
        ("RP", "limits: {q1: [-80deg, 80deg], q2: [0, 1]}\n", PLAIN, "correct"),
        ("RP", "limits: {q1: [-80deg, 80deg]}\n", PLAIN, "wrong"),
        ("RP", "limits: {q1: [-170deg, 170deg], q2: [0, 1]}\n", PLAIN, "wrong"),
        ("RP", "limits: {q1: [0, 180deg], q2: [0, 1]}\n", written(polar(f"acos(x/{R})")), "correct"),
        ("RP", "limits: {q1: [-90deg, 90deg], q2: [0, 1]}\n", written(polar(f"acos(x/{R})")), "wrong"),
    ],
)
def test_what_values_and_limits_make_right(name: str, more: str, value: str, verdict: str) -> None:
    assert judged(ARMS[name].problem + more, "inverse", value).verdict == verdict


POLAR_WITH_ANGLE = """gravity: none
dh: [{theta: q1* + 90deg, alpha: 90deg}, {d: q2*}]
task: [tip.x, tip.y, q1]
reach: [x, y, phi]
find: [inverse]
"""
"""A task of more components than joints move: of the two roots for q2 one is right at each."""


@pytest.mark.parametrize(
    ("branches", "verdict", "said"),
    [
        ([polar("phi"), polar("phi", f"-{R}")], "correct", ()),
        ([polar("phi")], "correct", ("incomplete",)),
        ([polar("phi", "x*cos(phi) + y*sin(phi)")], "correct", ()),
        ([polar("phi", "x/cos(q1)")], "correct", ()),
        ([polar("phi", "x*cos(phi)")], "wrong", ("branch_misses",)),
        ([polar("phi", f"2*{R}")], "wrong", ("branch_misses",)),
        ([polar("-phi"), polar("phi", f"-{R}")], "wrong", ("branch_misses",)),
        ([polar("phi", "x/cos(acos(x/sqrt(x**2 + y**2)))")], "correct", ("incomplete",)),
        ([polar("atan(y/x)", "x/cos(q1)")], "wrong", ("quadrant_lost",)),
    ],
)
def test_a_branch_with_a_condition_is_right_where_that_holds(
    branches: list[Branch], verdict: str, said: tuple[str, ...]
) -> None:
    answer = judged(POLAR_WITH_ANGLE, "inverse", written(*branches))
    slips = [slip.code for slip in answer.diagnosis]
    assert (answer.verdict, (*answer.notes, *slips)) == (verdict, said)
