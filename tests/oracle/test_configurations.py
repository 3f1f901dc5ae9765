"""Inverse kinematics and singular sets held against numerical methods that know nothing of formulas.

The branches of r(q) = r must be the configurations that Newton's method finds from many random
starts, each of them and no other.  A configuration of a grid must be in the singular set where
the singular values of the numerical Jacobian say that it loses rank, and nowhere else.
Both take nothing but r(q) and the sets from the JSON.
"""

from __future__ import annotations

import itertools
import json
import math
from collections.abc import Mapping
from functools import cache
from types import CodeType

import numpy as np
import numpy.typing as npt
import pytest

from tests.support import FUNCTIONS, solve_json

Vector = npt.NDArray[np.float64]

KNOWN = FUNCTIONS | {name: getattr(math, name) for name in ("asin", "acos", "atan2", "pi")}

NUMPY = {"sin": np.sin, "cos": np.cos, "sqrt": np.sqrt, "pi": math.pi, "asin": np.arcsin, "acos": np.arccos,
         "atan2": np.arctan2}  # fmt: skip
"""The same functions of many values at once, nan where there is none."""

POINTS, STARTS, STEPS = 2, 12, 25
MANY = 1000

# the lengths of the arms are 1 on the grid, so that it also meets conditions like l1 + l2 cos q2 = 0
ANGLES = tuple(k * math.pi / 3 for k in range(6))
LENGTHS = (-1.0, 0.0, 0.5)

ARMS = {
    "planar 2R": "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]",
    "planar 3R with direction": """
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: q3*, a: l3}]
task: [tip.x, tip.y, q1 + q2 + q3]""",
    "elbow": "dh: [{theta: q1*, d: L1, alpha: 90deg}, {theta: q2*, a: L2}, {theta: q3*, a: L3}]",
    "elbow with offset": """
dh: [{theta: q1*, d: L1, alpha: 90deg}, {theta: q2*, d: e, a: L2}, {theta: q3*, a: L3}]""",
    "spherical RRP": "dh: [{theta: q1*, d: L1, alpha: -90deg}, {theta: q2*, alpha: 90deg}, {d: d3*}]",
    "spherical RRP with offset": """
dh: [{theta: q1*, d: L1, alpha: -90deg}, {theta: q2*, d: e, alpha: 90deg}, {d: d3*}]""",
    "cylindrical RPP": "dh: [{theta: q1*, d: L1}, {d: d2*, alpha: -90deg}, {d: d3*}]",
    "polar RP": "dh: [{theta: q1* + 90deg, alpha: 90deg}, {d: d2*}]",
    "PPR": "dh: [{d: d1*, alpha: -90deg}, {d: d2*, a: l1, alpha: 60deg}, {theta: q3*, a: l2}]",
    "PRP": "dh: [{d: d1*}, {theta: q2*, a: l, alpha: 90deg}, {d: d3*}]",
    "SCARA": """
dh: [{theta: q1*, a: a1}, {theta: q2*, a: a2, alpha: 180deg}, {d: d3*}, {theta: q4*, d: d4}]
task: [tip.x, tip.y, tip.z, q1 + q2 - q4]""",
    "Cartesian": """
dh: [{d: d1*, alpha: -90deg}, {theta: -90deg, d: d2*, alpha: -90deg}, {d: d3*}]""",
    "2R in modified convention": """
convention: modified
dh: [{theta: q1*}, {a: l1, theta: q2*}, {a: l2}]""",
}


class Arm:
    """r(q), the branches and the singular set of one arm, as the JSON has them."""

    def __init__(self, text: str) -> None:
        solution = solve_json(f"gravity: none\n{text}\nfind: [r, inverse, singular]\n")
        results = solution["results"]
        self.names = [q["name"] for q in solution["coordinates"]]
        self.turning = np.array([q["type"] == "revolute" for q in solution["coordinates"]])
        self.entries = [code(entry) for entry in results["r"]]
        self.branches = [{n: code(f) for n, f in branch.items()} for branch in results["inverse"]]
        self.singular = [[code(e.removesuffix(" = 0")) for e in one] for one in results["singular"]]
        self.parameters = sorted({n for e in self.entries for n in e.co_names} - {*KNOWN, *self.names})

    def r(self, q: Vector, lengths: Mapping[str, float]) -> Vector:
        """The task at q."""
        values = {**lengths, **dict(zip(self.names, q, strict=True))}
        return np.array([value(entry, values) for entry in self.entries])

    def jacobian(self, q: Vector, lengths: Mapping[str, float]) -> Vector:
        """∂r/∂q by central differences."""
        step = 1e-5 * np.eye(len(q))
        return np.array([(self.r(q + h, lengths) - self.r(q - h, lengths)) / 2e-5 for h in step]).T

    @property
    def angles(self) -> list[bool]:
        """Which components of the task are sums of joint angles: those without a sine or cosine that turn."""
        turning = {name for name, turns in zip(self.names, self.turning, strict=True) if turns}
        return [bool(turning & {*e.co_names}) and not {"sin", "cos"} & {*e.co_names} for e in self.entries]

    def gap(self, q: Vector, r: Vector, lengths: Mapping[str, float]) -> float:
        """How far r(q) is from r, angles the shortest way round."""
        off = self.r(q, lengths) - r
        return float(np.abs(np.where(self.angles, (off + math.pi) % (2 * math.pi) - math.pi, off)).max())

    def configuration(self, formulas: Mapping[str, CodeType], given: Mapping[str, float]) -> Vector:
        """The values of one branch, each formula after those whose coordinates stand in it."""
        values, waiting = dict(given), dict(formulas)
        while waiting:
            name = next(n for n, f in waiting.items() if not set(f.co_names) & waiting.keys())
            values[name] = value(waiting.pop(name), values)
        return np.array([values[name] for name in self.names])

    def solutions(self, r: Vector, lengths: Mapping[str, float]) -> list[Vector]:
        """The configurations of the branches at r."""
        found = []
        for branch in self.branches:
            given = {**lengths, **{f"r{k}": float(entry) for k, entry in enumerate(r, 1)}}
            try:
                found.append(self.configuration(branch, given))
            except ValueError:  # beyond reach
                continue
        return found

    def newton(self, r: Vector, lengths: Mapping[str, float], draw: np.random.Generator) -> list[Vector]:
        """The configurations that Newton's method finds from random starts, each once."""
        found: list[Vector] = []
        for _ in range(STARTS):
            q = draw.uniform(-3, 3, len(self.names))
            for _ in range(STEPS):
                gap = r - self.r(q, lengths)
                if np.abs(gap).max() < 1e-11:
                    if not any(self.is_same(q, other) for other in found):
                        found.append(q)
                    break
                step = np.linalg.lstsq(self.jacobian(q, lengths), gap, rcond=1e-9)[0]
                q = q + step * min(1.0, 1.0 / np.abs(step).max())
        return found

    def is_same(self, q: Vector, other: Vector) -> bool:
        """Whether two configurations are the same, angles modulo 2π."""
        gap = np.where(self.turning, (q - other + math.pi) % (2 * math.pi) - math.pi, q - other)
        return bool(np.abs(gap).max() < 1e-6)


def code(text: str) -> CodeType:
    return compile(text, "<result>", "eval")


def value(formula: CodeType, values: Mapping[str, float]) -> float:
    return float(eval(formula, dict(KNOWN), dict(values)))  # noqa: S307 - results of our own


@cache
def arm(name: str) -> Arm:
    return Arm(ARMS[name])


@pytest.mark.parametrize("name", ARMS)
def test_the_branches_are_what_newton_finds(name: str) -> None:
    draw = np.random.default_rng(3)
    this = arm(name)
    for _ in range(POINTS):
        lengths = {p: draw.uniform(0.4, 1.2) for p in this.parameters}
        r = this.r(draw.uniform(-2, 2, len(this.names)), lengths)
        branches = this.solutions(r, lengths)
        assert all(np.allclose(this.r(q, lengths), r, atol=1e-8) for q in branches)
        for q in this.newton(r, lengths, draw):
            assert any(this.is_same(q, other) for other in branches)


@pytest.mark.parametrize("name", ARMS)
def test_the_branches_reach_a_thousand_points_and_miss_none(name: str) -> None:
    """At random configurations: each branch that is real gives r(q) back, one is the configuration itself."""
    draw = np.random.default_rng(12)
    this = arm(name)
    many = {p: draw.uniform(0.4, 1.2, MANY) for p in this.parameters}
    many |= {q: draw.uniform(-3, 3, MANY) for q in this.names}
    wanted = [at_once(entry, many) for entry in this.entries]
    is_found = np.zeros(MANY, dtype=bool)
    for branch in this.branches:
        values = {p: many[p] for p in this.parameters} | {f"r{k}": r for k, r in enumerate(wanted, 1)}
        waiting = dict(branch)
        with np.errstate(invalid="ignore"):
            while waiting:
                q = next(n for n, f in waiting.items() if not set(f.co_names) & waiting.keys())
                values[q] = at_once(waiting.pop(q), values)
        is_real = np.isfinite([values[q] for q in this.names]).all(axis=0)
        for entry, r, turns in zip(this.entries, wanted, this.angles, strict=True):
            assert np.abs(shortest(at_once(entry, values) - r, turns)[is_real]).max() < 1e-6
        gaps = [
            shortest(values[q] - many[q], turns) for q, turns in zip(this.names, this.turning, strict=True)
        ]
        is_found |= is_real & (np.abs(gaps).max(axis=0) < 1e-5)
    assert is_found.all()


def at_once(formula: CodeType, values: Mapping[str, Vector]) -> Vector:
    """A formula at many values."""
    return np.broadcast_to(eval(formula, dict(NUMPY), dict(values)), MANY)  # noqa: S307 - results of our own


def shortest(gap: Vector, turns: bool) -> Vector:
    """Differences, those of angles the shortest way round."""
    return (gap + math.pi) % (2 * math.pi) - math.pi if turns else gap


@pytest.mark.parametrize("name", ARMS)
def test_what_reaches_numbers_is_what_newton_finds(name: str) -> None:
    """The same with numbers in the file: what is listed is exact, and the same in decimals."""
    draw = np.random.default_rng(8)
    this = arm(name)
    lengths = {p: round(draw.uniform(0.4, 1.2), 2) for p in this.parameters}
    r = this.r(draw.uniform(-2, 2, len(this.names)), lengths)
    texts = [
        f"{math.degrees(x):.0f}deg" if turns else f"{x:.3f}" for x, turns in zip(r, this.angles, strict=True)
    ]
    r = np.array([math.radians(float(t[:-3])) if t.endswith("deg") else float(t) for t in texts])
    numbers = f"values: {json.dumps(lengths)}\nreach: [{', '.join(texts)}]\n"
    solution = solve_json(f"gravity: none\n{ARMS[name]}\n{numbers}find: [inverse]\n")
    listed = [np.array([q[n] for n in this.names]) for q in solution["results"]["inverse_decimals"]]
    at_numbers = solution["values"]["results"]["inverse"]
    exact = [this.configuration({n: code(f) for n, f in q.items()}, lengths) for q in at_numbers]
    assert len(listed) == len(exact) > 0
    for q, same in zip(listed, exact, strict=True):
        assert this.is_same(q, same) and this.gap(q, r, lengths) < 1e-9
    for q in this.newton(r, lengths, draw):
        assert any(this.is_same(q, other) for other in listed)


@pytest.mark.parametrize("name", ARMS)
def test_the_singular_set_is_where_the_numerical_rank_is_less(name: str) -> None:
    this = arm(name)
    lengths = dict.fromkeys(this.parameters, 1.0)
    generic = np.random.default_rng(3).uniform(0.3, 1.1, len(this.names))
    full = np.linalg.matrix_rank(this.jacobian(generic, lengths), 1e-6)
    sides = [ANGLES if turns else LENGTHS for turns in this.turning]
    seen = set()
    for q in map(np.array, itertools.product(*sides)):
        values = {**lengths, **dict(zip(this.names, q, strict=True))}
        is_told = any(all(abs(value(e, values)) < 1e-9 for e in one) for one in this.singular)
        assert is_told == (np.linalg.matrix_rank(this.jacobian(q, lengths), 1e-6) < full), q
        seen.add(is_told)
    assert seen == ({True, False} if this.singular else {False})
