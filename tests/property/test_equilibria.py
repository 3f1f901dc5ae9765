"""Equilibria of random potential energies, held against differences of these in numbers.

Parameters are small whole numbers, so that special ones (a² = b c) are often among them: there the
equilibria must be those that are told for them.  What is told of the stability must be what the
eigenvalues of the second derivatives say, on either side of every condition.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from random import Random
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from tests.support import solve_json

Array = npt.NDArray[np.float64]

ENERGIES = {
    "PP": "a*x*y, b*x^2/2, c*y^2/2, -d*x, a*x, -e*y, -b*x^4, d*y^4, (a - b)*x*y, x^2, -a*y^2/2, c*x^3/3",
    "RP": "a*cos(x), -b*cos(x), a*y*sin(x), c*y^2/2, -d*y, (a - b)*y*cos(x), -y^2, d*cos(x)^2, e*x^2/2",
    "RR": "a*cos(x), -b*cos(x), c*cos(y), -d*cos(x + y), a*cos(x - y), b*sin(x)*sin(y), (a - b)*cos(y), "
    "-e*cos(x + pi/6), c*x^2/2",
    "PPP": "x^2, y^2, z^2, -a*x*y, -b*y*z, -a*x*z, c*x^2/2, d*z^2/2, -e*y, (a - c)*x*z, b*y^2",
    "RRP": "a*cos(x), -b*cos(y), c*z^2/2, -d*z*cos(x), e*z, (a - b)*cos(x), a*cos(x - y), -c*z*y",
}
"""Terms, by the kinds of the coordinates x, y and z."""

KNOWN = {"sin": np.sin, "cos": np.cos, "pi": math.pi}
QUARTERS = [k * math.pi / 2 for k in (-1, 0, 1, 2)] + [k * math.pi / 2 - math.pi / 6 for k in (-1, 0, 1, 2)]
STEP = 1e-4
CLOSE = 1e-7
ROUGH = 1e-3
"""How near an equation must be to 0 at a point that may be a double zero."""


@dataclass(frozen=True)
class Mechanism:
    """Coordinates of unit masses, and terms of their potential energy."""

    kinds: str
    terms: tuple[str, ...]

    @cached_property
    def names(self) -> str:
        return "xyz"[: len(self.kinds)]

    @cached_property
    def text(self) -> str:
        """The problem file."""
        kinds = {"R": "revolute", "P": "prismatic"}
        of = ", ".join(f"{name}: {kinds[kind]}" for name, kind in zip(self.names, self.kinds, strict=True))
        D = [[int(i == j) for j in self.names] for i in self.names]
        energy = " + ".join(self.terms)
        return f"gravity: none\nmodel: {{coordinates: {{{of}}}, D: {D}, P: '{energy}'}}\nfind: [equilibria]\n"

    @cached_property
    def energy(self) -> Any:
        return compile(" + ".join(self.terms).replace("^", "**"), "energy", "eval")

    def slopes(self, q: Array, values: Mapping[str, float]) -> Array:
        """The derivatives of the energy."""
        return self._differences(lambda at: self._at(at, values), q)

    def second(self, q: Array, values: Mapping[str, float]) -> Array:
        """Its second derivatives."""
        found = self._differences(lambda at: self.slopes(at, values), q)
        return (found + found.T) / 2

    def _at(self, q: Array, values: Mapping[str, float]) -> Any:
        return eval(self.energy, KNOWN | dict(values) | dict(zip(self.names, q, strict=True)))  # noqa: S307

    @staticmethod
    def _differences(value: Any, q: Array) -> Array:
        """By steps both ways, to the fourth order."""
        units = STEP * 10 * np.eye(len(q))
        near, far = ([value(q + k * u) - value(q - k * u) for u in units] for k in (1, 2))
        return (8 * np.array(near) - np.array(far)) / (120 * STEP)


@dataclass(frozen=True)
class Told:
    """What is told of a mechanism."""

    of: Mechanism
    results: Mapping[str, Any]

    def alternatives(self, values: Mapping[str, float]) -> list[list[str]] | None:
        """The equilibria for these parameters; None where these are special, and no more is told."""
        for case in self.results.get("equilibria_special", []):
            if self._is_zero(case["where"], values):
                needs = (text for text in case.get("exist", ()) if " = " in text)
                return list(case["equilibria"]) if all(self._is_zero(one, values) for one in needs) else []
        return None if "equilibria_general" in self.results else list(self.results["equilibria"])

    def is_special(self, values: Mapping[str, float]) -> bool:
        return any(
            self._is_zero(case["where"], values) for case in self.results.get("equilibria_special", [])
        )

    def residuals(self, one: Sequence[str], values: Mapping[str, float]) -> Any:
        """The left sides of equations less their right sides."""
        codes = [compile(f"({text.replace('=', ')-(')})", "equation", "eval") for text in one]

        def at(q: Array) -> Array:
            known = KNOWN | dict(values) | dict(zip(self.of.names, q, strict=True))
            return np.array([float(eval(code, known)) for code in codes])  # noqa: S307

        return at

    def _is_zero(self, where: str, values: Mapping[str, float]) -> bool:
        return abs(self.residuals([where], values)(np.zeros(len(self.of.names)))[0]) < 1e-12

    def points(self, values: Mapping[str, float]) -> Iterator[tuple[Mapping[str, Any], list[str]]]:
        """Each point whose stability is told, with the equations of its case."""
        for one, points in zip(self.results["equilibria"], self.results["equilibria_stability"], strict=True):
            for point in points:
                turns = [f"{angle} = {at}" for angle, at in point.items() if not isinstance(at, list)]
                turns.remove(f"stability = {point['stability']}")
                yield point, [*one, *turns]

    def names(self, at: Array, values: Mapping[str, float]) -> bool:
        """Whether this is a point that is told, or of equations none of which has an angle and its sine."""
        for point, equations in self.points(values):
            turns = [angle for angle in point if angle not in ("stability", "stable_if", "unstable_if")]
            is_there = np.max(np.abs(np.sin(self.residuals(equations, values)(at) / 2)), initial=0) < CLOSE
            open_names = (name for name in self.of.names if any(is_mixed(one, name) for one in equations))
            if is_there and all(any(name in angle for angle in turns) for name in open_names):
                return True
        return False


def is_mixed(equation: str, name: str) -> bool:
    """Whether an angle stands in an equation in a sine or a cosine, and elsewhere."""
    plain = re.sub(r"(sin|cos)\([^)]*\)", "", equation)
    return name in plain and any(name in found for found in re.findall(r"(?:sin|cos)\([^)]*\)", equation))


def zero(function: Any, start: Array) -> Array | None:
    """A zero by Newton's method."""
    q = start.copy()
    for _ in range(80):
        value = function(q)
        if not np.all(np.isfinite(value)) or np.max(np.abs(q)) > 1e4:
            return None
        if np.max(np.abs(value), initial=0) < CLOSE / 100:
            return q
        slopes = np.array(
            [(function(q + STEP * u) - function(q - STEP * u)) / (2 * STEP) for u in np.eye(len(q))]
        ).T
        q = q - np.linalg.lstsq(slopes, value, rcond=1e-9)[0]
    return None


def mechanisms(count: int, seed: int) -> Iterator[Mechanism]:
    draw = Random(seed)
    for _ in range(count):
        kinds = draw.choice(list(ENERGIES))
        yield Mechanism(kinds, tuple(draw.sample(ENERGIES[kinds].split(", "), draw.randint(2, 6))))


SPRINGS = [
    Mechanism("RR", ("a*sin(x)", "b*sin(x + y)", "c*(x + y)^2/2")),
    Mechanism("RR", ("a*sin(x)", "b*sin(x + y)", "c*(x + y - pi/2)^2/2")),
    Mechanism("RR", ("-a*cos(x)", "-b*cos(y)", "c*(x - y)^2/2")),
    Mechanism("RR", ("-c*cos(x - y)",)),
    Mechanism("RP", ("a*cos(x)", "c*x^2/2", "-d*y", "b*y^2/2")),
    Mechanism("R", ("cos(x)", "x^2")),
    Mechanism("P", ("a*x^3/3", "b*x^2/2", "c*x")),
    Mechanism("PP", ("a*x^4/4", "-b*x^3/3", "c*x^2/2", "d*x*y", "e*y^2")),
    Mechanism("RR", ("a*cos(x)", "-b*cos(x + y + pi/6)", "c*(y + pi/6)^2/2")),
    Mechanism("RRR", ("-a*sin(x + y)", "b*cos(x + y)*cos(z)", "-c*cos(z)")),
]
"""Springs at an angle, which therefore stands by itself, too, and between two."""


def drawn(draw: Random) -> dict[str, float]:
    """Parameters, of which some are often equal."""
    return {name: float(draw.choice((1, 1, 2, 4))) for name in "abcde"}


@pytest.mark.parametrize(
    "mechanism", [*mechanisms(12, 1), *SPRINGS], ids=lambda one: one.text.split("P: ")[1].split("}")[0]
)
def test_against_differences(mechanism: Mechanism) -> None:
    results = solve_json(mechanism.text)["results"]
    if "skipped" in results["equilibria"]:
        pytest.skip("too long")
    told, draw = Told(mechanism, results), Random(2)
    for _ in range(12):
        values = drawn(draw)
        starts = [np.array([draw.uniform(-3, 3) for _ in mechanism.names]) for _ in range(6)]
        alternatives = told.alternatives(values)
        if alternatives is not None:
            holds_the_equilibria(told, alternatives, values, starts)
        if not told.is_special(values):
            holds_the_stability(told, values, starts)
    for angles in product(QUARTERS, repeat=mechanism.kinds.count("R")):
        names_the_pose(told, angles)


def names_the_pose(told: Told, angles: tuple[float, ...]) -> None:
    """Angles at which there is an equilibrium for all parameters are told."""
    draw = Random(3)
    for _ in range(3):
        values = drawn(draw)
        at = resting(told, angles, values)
        if at is None or told.is_special(values):
            return
    assert told.names(at, values), angles


def resting(told: Told, angles: tuple[float, ...], values: Mapping[str, float]) -> Array | None:
    """The equilibrium at some angles, if there is one."""
    turning = np.array(angles)
    if len(angles) == len(told.of.names):
        return turning if np.max(np.abs(told.of.slopes(turning, values))) < CLOSE else None
    lengths = np.zeros(len(told.of.names) - len(angles))
    found = zero(lambda y: told.of.slopes(np.append(turning, y), values), lengths)
    return None if found is None else np.append(turning, found)


def holds_the_equilibria(
    told: Told, alternatives: Sequence[Sequence[str]], values: Mapping[str, float], starts: Sequence[Array]
) -> None:
    """Nothing moves where an alternative holds, and one holds where nothing moves."""
    functions = [told.residuals(one, values) for one in alternatives]
    for start in starts:
        for function in functions:
            at = zero(function, start)
            assert at is None or np.max(np.abs(told.of.slopes(at, values))) < 1e-5, (values, at)
        at = zero(lambda q: told.of.slopes(q, values), start)
        if at is not None:
            misses = [np.max(np.abs(function(at)), initial=0) for function in functions]
            assert min(misses, default=1) < ROUGH, (values, at)


def holds_the_stability(told: Told, values: Mapping[str, float], starts: Sequence[Array]) -> None:
    """The least eigenvalue has the sign that is told."""
    for point, equations in told.points(values):
        function = told.residuals(equations, values)
        if point.keys() >= {*told.of.names}:
            at = np.array([eval(point[name], KNOWN) for name in told.of.names])  # noqa: S307
            assert np.max(np.abs(function(at))) < CLOSE, (point, equations)
        for at in (zero(function, start) for start in starts):
            if at is None or np.max(np.abs(function(at)), initial=0) > CLOSE:
                continue
            verdict = point["stability"]
            known = {**values, **dict(zip(told.of.names, at, strict=True))}
            if all(is_true(text, known) for text in point.get("stable_if", ["0 > 1"])):
                verdict = "stable"
            elif any(is_true(text, known) for text in point.get("unstable_if", [])):
                verdict = "unstable"
            second = told.of.second(at, values)
            moving = np.max(np.abs(second), axis=0) > 1e-5
            least = np.min(np.linalg.eigvalsh(second[np.ix_(moving, moving)]), initial=np.inf)
            if verdict == "stable":
                assert least > -1e-6, (values, at)
            elif verdict == "unstable":
                assert least < 1e-6, (values, at)


def is_true(text: str, values: Mapping[str, float]) -> bool:
    return bool(eval(text, KNOWN | dict(values)))  # noqa: S307
