"""The inverse kinematics of random arms, held against Denavit-Hartenberg kinematics in NumPy alone.

Arms of one to four joints in both conventions, their offsets letters, numbers or both, with tasks of
every kind: the moving coordinates of the tip, some of them, angles, components that no joint changes,
more components than joints.  Nothing but the text of the problem and the JSON of the solution goes in.

    what a branch says where its conditions hold    gives r back, or is not real
    every configuration                             stands on a branch, unless the arm is redundant
    configurations at given numbers                 reach them; Newton's method finds no other
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from random import Random
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import dynsolve

Vector = npt.NDArray[np.float64]

SEEDS = range(300, 318)
STATES = 12
CLOSE = 1e-6

TWISTS = ("0", "0", "0", "90deg", "-90deg", "90deg", "45deg", "180deg", "17deg")
TURNED = ("", "", "", "", " + 90deg", " - 90deg", " + 30deg", " + 17deg")
NUMBERS = ("1", "2", "1/2", "0.3", "sqrt(2)")
ANGLES = ("45deg", "pi/2", "-60deg", "17deg", "0", "180deg")
LENGTHS = ("1", "-1/2", "0.7", "sqrt(3)/2", "0", "30")


def degrees(value: float) -> float:
    """`deg` behind a number."""
    return math.radians(value)


NAMES: dict[str, Any] = {
    "__builtins__": {},
    "pi": math.pi,
    **{name: getattr(math, name) for name in ("sin", "cos", "tan", "sqrt", "asin", "acos", "atan", "atan2")},
}


def number(text: str, values: Mapping[str, float] | None = None) -> float:
    """What a printed formula, or one of a problem file, is in floating point."""
    plain = re.sub(r"([\d.]+)deg", r"(\1*pi/180)", text)
    return float(eval(compile(plain, "<formula>", "eval"), dict(NAMES), dict(values or {})))  # noqa: S307


@dataclass(frozen=True)
class Joint:
    """A row of the table, its cells as texts."""

    name: str
    turns: bool
    offset: str
    d: str
    a: str
    alpha: str

    @property
    def row(self) -> str:
        theta = f"{self.name}*{self.offset}" if self.turns else self.offset.replace(" ", "") or "0"
        d = self.d if self.turns else f"{self.name}*"
        return f"{{theta: {theta}, d: {d}, a: {self.a}, alpha: {self.alpha}}}"

    def matrix(self, q: float, values: Mapping[str, float], *, modified: bool) -> Vector:
        """The motion of the row."""
        offset = number("0" + self.offset.replace(" ", "")) if self.offset else 0.0
        theta, d = (q + offset, number(self.d, values)) if self.turns else (offset, q)
        a, alpha = number(self.a, values), number(self.alpha)
        c, s = math.cos(theta), math.sin(theta)
        about_z = np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, d], [0, 0, 0, 1]])
        c, s = math.cos(alpha), math.sin(alpha)
        about_x = np.array([[1, 0, 0, a], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1]])
        return about_x @ about_z if modified else about_z @ about_x


@dataclass(frozen=True)
class Arm:
    """An arm with its task, and what the file gives for it."""

    joints: tuple[Joint, ...]
    modified: bool
    task: tuple[str, ...]
    letters: tuple[str, ...]
    values: Mapping[str, str] = field(default_factory=dict)
    reach: tuple[str, ...] = ()

    @property
    def text(self) -> str:
        lines = ["title: Random arm", "gravity: none"]
        lines += ["convention: modified"] if self.modified else []
        lines += ["dh:", *(f"  - {joint.row}" for joint in self.joints)]
        lines += [f"task: [{', '.join(self.task)}]"] if self.task else []
        lines += [f"reach: [{', '.join(self.reach)}]"] if self.reach else []
        if self.values:
            lines.append(f"values: {{{', '.join(f'{k}: {v}' for k, v in self.values.items())}}}")
        return "\n".join([*lines, "find: [inverse]", ""])

    @property
    def names(self) -> list[str]:
        return [joint.name for joint in self.joints]

    def tip(self, q: Vector, values: Mapping[str, float]) -> Vector:
        """The origin of the last frame."""
        H = np.eye(4)
        for joint, at in zip(self.joints, q, strict=True):
            H = H @ joint.matrix(float(at), values, modified=self.modified)
        return H[:3, 3]

    @property
    def components(self) -> tuple[str, ...]:
        """The task, by default the coordinates of the tip that move."""
        if self.task:
            return self.task
        draw = np.random.default_rng(1)
        values = {name: draw.uniform(0.5, 1.5) for name in self.letters}
        tips = np.array([self.tip(draw.uniform(-3, 3, len(self.joints)), values) for _ in range(6)])
        return tuple(
            f"tip.{axis}" for axis, moves in zip("xyz", np.ptp(tips, axis=0) > 1e-9, strict=True) if moves
        )

    @property
    def angles(self) -> list[bool]:
        """Which components are sums of joint angles."""
        turning = {joint.name for joint in self.joints if joint.turns}
        return [bool(turning & set(re.findall(r"q\d", one))) for one in self.components]

    def r(self, q: Vector, values: Mapping[str, float]) -> Vector:
        tip = self.tip(q, values)
        at = {**values, **dict(zip(self.names, map(float, q), strict=True))}
        at |= {f"tip_{axis}": float(x) for axis, x in zip("xyz", tip, strict=True)}
        return np.array([number(one.replace("tip.", "tip_"), at) for one in self.components])

    def gap(self, mine: Vector, theirs: Vector) -> float:
        """How far values of the task are apart, angles the shortest way round."""
        off = np.where(self.angles, wrapped(mine - theirs), mine - theirs)
        return float(np.abs(off).max())

    def jacobian(self, q: Vector, values: Mapping[str, float]) -> Vector:
        steps = 1e-6 * np.eye(len(q))
        return np.array([(self.r(q + h, values) - self.r(q - h, values)) / 2e-6 for h in steps]).T

    def is_same(self, q: Vector, other: Vector) -> bool:
        turning = [joint.turns for joint in self.joints]
        return bool(np.abs(np.where(turning, wrapped(q - other), q - other)).max() < 1e-5)

    def newton(
        self, target: Vector, values: Mapping[str, float], draw: np.random.Generator
    ) -> Iterator[Vector]:
        """Configurations that stand alone and reach a target."""
        for _ in range(6):
            q = draw.uniform(-3, 3, len(self.joints))
            for _ in range(40):
                off = target - self.r(q, values)
                off = np.where(self.angles, wrapped(off), off)
                J = self.jacobian(q, values)
                if np.abs(off).max() < 1e-10:
                    sizes = np.linalg.svd(J, compute_uv=False)
                    if len(sizes) == len(q) and sizes[-1] > 1e-3:
                        yield q
                    break
                step = np.linalg.lstsq(J, off, rcond=1e-10)[0]
                q = q + step * min(1.0, 1.0 / max(np.abs(step).max(), 1e-12))


def wrapped(angle: Vector) -> Vector:
    """Modulo 2π, from -π to π."""
    return (angle + math.pi) % (2 * math.pi) - math.pi


# -- random arms -----------------------------------------------------------------------------------


def random_arm(seed: int) -> Arm:
    """An arm, the same for a seed."""
    random = Random(seed)
    count = random.choice((1, 2, 2, 2, 3, 3, 3, 4))
    style = random.choice(("letters", "letters", "numbers", "both"))
    letters: list[str] = []

    def length(letter: str) -> str:
        if random.random() < 0.45:
            return "0"
        if style == "numbers" or (style == "both" and random.random() < 0.5):
            return random.choice(NUMBERS)
        letters.append(letter)
        return letter

    joints = tuple(
        Joint(f"q{i}", random.random() < 0.65, random.choice(TURNED), length(f"d{i}"),
              length(f"l{i}"), random.choice(TWISTS))
        for i in range(1, count + 1)
    )  # fmt: skip
    letters = [name for name in letters if any(name in (j.a, j.d if j.turns else "") for j in joints)]
    arm = Arm(joints, random.random() < 0.3, (), tuple(letters))
    arm = Arm(joints, arm.modified, _task(random, arm), tuple(letters))
    if not arm.components:
        return random_arm(seed + 100_000)
    values = {name: random.choice(NUMBERS) for name in letters} if random.random() < 0.5 else {}
    reach = _reach(random, arm, values)
    if reach and random.random() < 0.2 and not reach[0].startswith("p"):  # by name, the numbers under values
        values |= {f"p{k}": text for k, text in enumerate(reach, 1)}
        reach = tuple(f"p{k}" for k in range(1, len(reach) + 1))
    return Arm(joints, arm.modified, arm.task, arm.letters, values, reach)


def _task(random: Random, arm: Arm) -> tuple[str, ...]:
    turning = [joint.name for joint in arm.joints if joint.turns]
    some = [" + ".join(turning), " + ".join(turning[:2]), random.choice(turning or [""])]
    some += [f"{turning[0]} - 2*{turning[1]}"] if len(turning) > 1 else []
    angle = random.choice(some)
    if turning and random.random() < 0.1:
        angle += random.choice((" + 90deg", " - 30deg"))
    more = [angle] if turning and random.random() < 0.5 else []
    more += [turning[0]] if more and random.random() < 0.15 else []
    match random.randrange(6):
        case 0 | 1:
            return ()
        case 2:
            return ("tip.x", "tip.y", *more)
        case 3:
            return ("tip.x", "tip.y", "tip.z", *more)
        case 4:
            return (*random.sample(("tip.x", "tip.y", "tip.z"), 2), *more)
        case _:
            return (*(arm.components or ("tip.z",)), *more)


def _reach(random: Random, arm: Arm, values: Mapping[str, str]) -> tuple[str, ...]:
    """Names, numbers that may be out of reach, or numbers that are reached; nothing for the default."""
    kind = random.randrange(5)
    known = len(values) == len(arm.letters)
    if kind == 0:
        return ()
    if kind == 1 or not known:
        return tuple(f"p{k}" for k in range(1, len(arm.components) + 1))
    if kind == 2:
        return tuple(random.choice(ANGLES if turns else LENGTHS) for turns in arm.angles)
    places = [
        (0.0, math.pi / 2, -math.pi / 2, math.pi) if joint.turns else (1.0, 2.0, -0.5) for joint in arm.joints
    ]
    q = np.array([random.choice(some) for some in places])
    at = {name: number(text) for name, text in values.items()}
    r = arm.r(q, at)
    if any(not turns and abs(8 * x - round(8 * x)) > 1e-9 for x, turns in zip(r, arm.angles, strict=True)):
        return ()
    return tuple(f"{round(math.degrees(x))}deg" if turns else f"{x:.12g}" if abs(x) > 1e-12 else "0"
                 for x, turns in zip(r, arm.angles, strict=True))  # fmt: skip


# -- what is held ----------------------------------------------------------------------------------


def on_branch(branch: Mapping[str, Any], given: Mapping[str, float]) -> dict[str, float] | None:
    """The values of a branch, in an order in which they can be found; None where none is real."""
    values, waiting = dict(given), {name: text for name, text in branch.items() if name != "when"}
    while waiting:
        ready = [
            n for n, f in waiting.items() if not set(re.findall(r"[a-z]\w*", f)) & (waiting.keys() - {n})
        ]
        assert ready, f"circular: {branch}"
        try:
            values[ready[0]] = number(waiting.pop(ready[0]), values)
        except (ValueError, ZeroDivisionError):
            return None
    return values


def conditions(branch: Mapping[str, Any], values: Mapping[str, float]) -> Vector:
    """What is 0 where the conditions of a branch hold."""
    sides = (one.split(" = ") for one in branch.get("when", ()))
    return np.array([number(left, values) - number(right, values) for left, right in sides])


class Held:
    """One arm and its solution."""

    def __init__(self, arm: Arm) -> None:
        self.arm = arm
        self.solution = dynsolve.solve(arm.text).beside().to_json()
        self.results = self.solution["results"]
        symbols = [one for one in arm.reach if re.fullmatch(r"p\d", one)]
        self.gives_numbers = bool(arm.reach) and (not symbols or "p1" in arm.values)
        self.reach = symbols or [f"r{k}" for k in range(1, len(arm.components) + 1)]
        self.draw = np.random.default_rng(5)

    def parameters(self) -> dict[str, float]:
        return {name: float(self.draw.uniform(0.4, 1.6)) for name in self.arm.letters}

    def is_free(self, name: str) -> bool:
        """Whether a coordinate may be anything."""
        return isinstance(self.results["inverse"], list) and all(
            name not in one for one in self.results["inverse"]
        )

    def q_of(self, values: Mapping[str, float], free: float = 0.4) -> Vector:
        return np.array([values.get(name, free) for name in self.arm.names])

    def check(self) -> str:
        """Hold everything; what kind of answer there is."""
        given = self.results["inverse"]
        valued = self.solution.get("values", {}).get("results", {}).get("inverse")
        if isinstance(given, dict):
            assert given["skipped"]
            if self.gives_numbers:
                self.hold_target(valued)
            return "skipped: " + given["skipped"]
        names = set(re.findall(r"[a-zA-Z_]\w*", str(given)))
        known = {*NAMES, *self.arm.names, *self.arm.letters, *self.reach, "when"}
        assert names <= known, names - known
        assert not re.search(r"\d\.\d", str(given)) or "." in self.arm.text, "a float in the general branches"
        for _ in range(3):
            self.hold(given, self.parameters())
        if self.gives_numbers:
            self.hold_target(valued)
        elif self.arm.values and not isinstance(valued, dict):
            values = {name: number(text) for name, text in self.arm.values.items()}
            self.hold(valued, values)
            assert not set(re.findall(r"[a-zA-Z_]\w*", str(valued))) & set(self.arm.letters), (
                "letters in values"
            )
        return "numbers" if self.gives_numbers else "branches"

    def hold(self, branches: list[dict[str, Any]], parameters: Mapping[str, float]) -> None:
        arm = self.arm
        for _ in range(STATES):
            q = self.draw.uniform(-math.pi, math.pi, len(arm.joints))
            r = arm.r(q, parameters)
            given = {**parameters, **dict(zip(self.reach, map(float, r), strict=True))}
            given |= {name: float(x) for name, x in zip(arm.names, q, strict=True) if self.is_free(name)}
            is_found = False
            for branch in branches:
                values = on_branch(branch, given)
                if values is None or any(abs(conditions(branch, values)) > CLOSE):
                    continue
                mine = self.q_of(values)
                assert arm.gap(arm.r(mine, parameters), r) < CLOSE, f"misses: {branch}"
                is_found |= arm.is_same(mine, q)
            if np.linalg.matrix_rank(arm.jacobian(q, parameters), 1e-5) == len(arm.joints):
                assert is_found, f"missing: {q}"
            self.hold_elsewhere(branches, parameters, r + self.draw.uniform(-0.3, 0.3, len(r)))

    def hold_elsewhere(
        self, branches: list[dict[str, Any]], parameters: Mapping[str, float], r: Vector
    ) -> None:
        """Values of the task that no configuration was taken for, brought to where the conditions hold."""
        for branch in branches:
            at = self.conditioned(branch, parameters, r)
            if at is None:
                continue
            values, r_there = at
            mine = self.q_of(values)
            assert self.arm.gap(self.arm.r(mine, parameters), r_there) < 1e-5, (
                f"misses off the image: {branch}"
            )

    def conditioned(
        self, branch: Mapping[str, Any], parameters: Mapping[str, float], r: Vector
    ) -> tuple[dict[str, float], Vector] | None:
        """Values near r at which the conditions hold, by Newton's method; None where it leads nowhere."""

        def at(r: Vector) -> tuple[dict[str, float], Vector] | None:
            given = {**parameters, **dict(zip(self.reach, map(float, r), strict=True))}
            values = on_branch(
                branch, {**{name: 0.4 for name in self.arm.names if self.is_free(name)}, **given}
            )
            return None if values is None else (values, conditions(branch, values))

        for _ in range(30):
            here = at(r)
            if here is None:
                return None
            values, off = here
            if not off.size or np.abs(off).max() < 1e-10:
                return values, r
            columns = []
            for step in 1e-6 * np.eye(len(r)):
                there = at(r + step)
                if there is None:
                    return None
                columns.append((there[1] - off) / 1e-6)
            r = r - np.linalg.lstsq(np.array(columns).T, off, rcond=1e-8)[0]
        return None

    def hold_target(self, found: list[dict[str, Any]]) -> None:
        arm = self.arm
        decimals, why = self.results["inverse_decimals"], self.results["inverse_why"]
        assert len(found) == len(decimals)
        assert why
        values = {name: number(text) for name, text in arm.values.items()}
        target = np.array([number(arm.values.get(text, text)) for text in arm.reach])
        is_exact = "Newton" not in why
        for one, plain in zip(found, decimals, strict=True):
            if is_exact:
                assert not re.search(r"\d\.\d", str(one)), f"a float in {one}"
            for free in (0.0, 0.9):
                q = on_branch(one, {**values, **{n: free for n in arm.names if n not in one}})
                assert q is not None, one
                assert arm.gap(arm.r(self.q_of(q), values), target) < CLOSE, f"misses {target}: {one}"
            q = on_branch(one, {**values, **{n: 0.0 for n in arm.names if n not in one}})
            assert q is not None
            assert all(
                abs(wrapped(np.array(q[n] - x))) < 1e-7 or abs(q[n] - x) < 1e-7 for n, x in plain.items()
            )
        places = [{**dict.fromkeys(arm.names, 0.0), **one} for one in decimals]
        frees = [any(n not in one for n in arm.names) for one in decimals]
        for q in arm.newton(target, values, self.draw):
            assert any(frees) or any(arm.is_same(q, self.q_of(p)) for p in places), f"missing at numbers: {q}"


@pytest.mark.parametrize("seed", SEEDS)
def test_random_arms(seed: int) -> None:
    Held(random_arm(seed)).check()
