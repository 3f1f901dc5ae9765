"""A solved mechanism in numbers: frames, finite differences and motions, for what is claimed of it."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cached_property, partial
from itertools import chain, islice, product
from random import Random
from types import CodeType
from typing import Any

import numpy as np

from dynsolve.algebra.ring_values import evaluate
from dynsolve.document import Document
from dynsolve.notation import tree
from dynsolve.notation.tree import Node, walk
from dynsolve.notation.unicode import to_unicode
from dynsolve.quantities.letters import TAU, force
from tests.strangers.oracle import Point, Unknown, Value, state, untrue

NEAR = 1e-6
"""The relative difference up to which numbers are the same: that of finite differences."""

ROUNDED = 1e-3
"""The same of a number that is printed rounded, behind ≈."""

STEP = 1e-4
"""How far apart the states of a difference are."""


@dataclass
class Mechanism:
    """A solved mechanism at any state; parameters are positive, as the reports say."""

    solution: Any
    document: Document
    seed: int
    _points: dict[Any, Point] = field(default_factory=dict)

    @cached_property
    def coordinates(self) -> tuple[str, ...]:
        return tuple(q.name for q in self.solution.robot.coordinates)

    def point(self, at: dict[str, float] | None = None, seed: int = 0) -> Point:
        key = (seed, tuple(sorted((at or {}).items())))
        if key not in self._points:
            unlike = Random(seed)
            given = {name: unlike.uniform(0.3, 2.7) for name in self.solution.problem.values} if seed else {}
            self._points[key] = state(self.solution, self.seed + 1000 * seed, given | (at or {}))
        return self._points[key]

    def points(self, count: int = 3) -> list[Point]:
        """States with parameters that meet what is assumed of them."""
        assumed = [bound.value for bound in self.solution.robot.questions.model.assumed]
        states = (self.point(seed=seed) for seed in range(100))
        met = (p for p in states if all(evaluate(value, p.names) > 0 for value in assumed))
        return list(islice(met, count))

    def value(self, node: Node, point: Point) -> Any:
        """A formula at a state.  Raises Unknown."""
        if isinstance(node, tree.Letter):
            frame = re.fullmatch(r"([xyzo])(\d+)", plain(node))
            if frame and node.style == "bold":
                column = self.frame(int(frame[2]), point)[:3, "xyzo".index(frame[1])]
                return column.reshape(3, 1)
        for part in walk(node):
            is_bold = isinstance(part, tree.Letter) and part.style == "bold"
            if is_bold and part not in point.known and part not in point.letters:
                try:
                    found = self.value(part, point) if part != node else None
                except Unknown:
                    continue
                if found is not None:
                    point.known[part] = Value(found, np.abs(found))
        try:
            return point.value(node).value
        except Unknown:
            if point.is_read:
                raise
            point.is_read = True
            list(untrue(self.document.blocks, point))  # which defines the letters of the steps
            return point.value(node).value

    def result(self, name: str, point: Point) -> Any:
        if name not in point.results:
            raise Unknown
        return point.results[name].value

    def frame(self, i: int, point: Point) -> Any:
        """Frame i, as a 4×4 matrix; frame 0 from a row that starts there."""
        if i:
            return self.result(f"H{i}", point)
        row = next(i for i, joint in enumerate(self.solution.robot.joints, 1) if not joint.parent)
        return self.result(f"H{row}", point) @ np.linalg.inv(self.result(f"A{row}", point))

    def right_angles(self) -> Iterator[dict[str, float]]:
        """Poses of right angles, of the first coordinates."""
        first = self.coordinates[:3]
        for pose in product((0.0, np.pi / 2, np.pi, -np.pi / 2), repeat=len(first)):
            yield dict(zip(first, pose, strict=True))

    def least(self, value: Callable[[Point], float], names: dict[str, float]) -> float:
        """The least value over all poses: from right angles and from anywhere, down in ever smaller steps."""
        random = np.random.default_rng(1)

        def moved(at: dict[str, float], step: float) -> dict[str, float]:
            return at | {q: at[q] + float(random.normal(0, step)) for q in self.coordinates}

        poses = [names | pose for pose in self.right_angles()] + [moved(names, 3) for _ in range(40)]
        least, at = value(self.symbols(poses[0])), poses[0]
        steps = (moved(at, step) for step in np.geomspace(1, 1e-4, 80))  # from the best one till then
        for pose in chain(poses[1:], steps):
            if (here := value(self.symbols(pose))) < least:
                least, at = here, pose
        return least

    def symbols(self, names: dict[str, float]) -> Point:
        """A state of which nothing is known but its symbols."""
        return Point({tree.Symbol(name): Value(number, abs(number)) for name, number in names.items()})

    def changes(self, what: Callable[[Point], Any], names: tuple[str, ...]) -> bool:
        """Whether a value changes where the coordinates with these names do, all else being the same.

        Each by as much of its own: what depends on a difference alone changes, too.
        """
        for seed in range(2):
            here = self.point(seed=seed)
            for factor in (0.37, -1.3):
                moved = {name: here.names[name] + factor / place for place, name in enumerate(names, 1)}
                there = self.point(moved, seed)
                if not near(what(here), what(there)):
                    return True
        return False

    def pose(self, body: str, point: Point) -> Any:
        return np.hstack([self.result(f"rc{body}", point), self.result(f"R{body}", point)])

    def seen_from(self, i: int, place: Any, point: Point) -> Any:
        frame = self.frame(i, point)
        return frame[:3, :3].T @ (place - frame[:3, 3:])

    def mass(self, body: Any, point: Point) -> float:
        return float(self.value(self.solution.forms.of(body.mass), point))

    def of_rotors(self, place: int, joint: int, axis: Any, point: Point) -> float:
        """What the rotors add to a moment of inertia: each turns by its gear and with its carrier."""
        robot, form, total = self.solution.robot, self.solution.forms.of, 0.0
        for rotor in robot.actions.rotors:
            rate = self.value(form(rotor.ratio), point) if rotor.turns == place else 0.0
            carriers = robot.path(rotor.carrier) if rotor.carrier else ()
            if any(each.index == joint for each in carriers):
                rate += self.frame(rotor.carrier, point)[:3, rotor.axis] @ axis
            total += self.value(form(rotor.inertia), point) * rate**2
        return float(total)

    def moved_by(self, coordinate: str) -> list[Any]:
        bodies = self.solution.robot.bodies
        return [body for body in bodies if self.changes(partial(self.pose, body.name), (coordinate,))]

    def holds(self, node: Node, point: Point) -> bool:
        """Whether the equations and inequalities in a formula hold."""
        for relation in (part for part in walk(node) if isinstance(part, tree.Relation)):
            values = [self.value(part, point) for part in relation.parts]
            for a, sign, b in zip(values, relation.signs, values[1:], strict=False):
                held = {
                    "<": a < b,
                    ">": a > b,
                    "≤": a <= b,
                    "≥": a >= b,
                    "≠": not near(a, b),
                    "=": near(a, b),
                }
                held["≈"] = abs(a - b) <= ROUNDED * abs(b)
                if not held.get(sign):
                    return False
        return True

    def slope(self, what: Callable[[Point], Any], point: Point, seed: int, along: dict[str, float]) -> Any:
        """The derivative of a value in a direction of the symbols."""

        def difference(h: float) -> Any:
            ends = [
                point.names | {q: point.names[q] + by * rate for q, rate in along.items()} for by in (h, -h)
            ]
            return (what(self.point(ends[0], seed)) - what(self.point(ends[1], seed))) / (2 * h)

        return (4 * difference(STEP) - difference(2 * STEP)) / 3

    def is_conserved(self, conditions: tuple[Node, ...], what: Callable[[Point], Any]) -> bool:
        """Whether the rate of a value is 0 in motions that meet these conditions on forces."""
        n, letters = len(self.coordinates), {part for node in conditions for part in walk(node)}
        forces = [force(q) for q in self.solution.robot.coordinates]
        passive = self.solution.robot.actions.passive
        rows = [
            k for k in range(n)
            if forces[k] in letters or TAU in letters or k in passive
        ]  # fmt: skip
        for seed in range(2):
            moving = [f"{q}_ddot" for q in self.coordinates]
            rates, pull = self._kept(seed)
            tau = [self.result("tau", self.point(rates | dict(zip(moving, row, strict=True)), seed))[rows, 0]
                   - pull[rows] for row in [np.zeros(n), *np.eye(n)]]  # fmt: skip
            slopes = np.transpose([column - tau[0] for column in tau[1:]]).reshape(len(rows), n)
            some = np.linspace(-1.0, 1.5, n)
            qdd = some - np.linalg.pinv(slopes) @ (slopes @ some + tau[0]) if rows else some
            if rows and not near(slopes @ qdd + tau[0], 0):
                continue  # no motion meets them: something moves that has no mass
            here = self.point(rates, seed)
            along = {q: here.names[f"{q}_dot"] for q in self.coordinates}
            along |= {f"{q}_dot": a for q, a in zip(self.coordinates, qdd, strict=True)}
            if not near(self.slope(what, here, seed, along), 0, float(np.max(np.abs(qdd))) * 10):
                return False
        return True

    def _kept(self, seed: int) -> tuple[dict[str, float], Any]:
        """Rates that the constraints allow, and what they do to the coordinates with some multipliers."""
        point = self.point(seed=seed)
        rates = np.array([point.names[f"{q}_dot"] for q in self.coordinates])
        if not self.solution.robot.questions.constraints:
            return {}, np.zeros(len(rates))
        A = self.result("Ac", point)
        rates = rates - np.linalg.pinv(A) @ (A @ rates)
        named = {f"{q}_dot": float(x) for q, x in zip(self.coordinates, rates, strict=True)}
        return named, A.T @ np.linspace(0.5, 2.0, len(A))

    @property
    def steady(self) -> dict[str, Node]:
        """The rates that motors keep."""
        return dict(self.solution.robot.questions.model.steady)

    def at_rest(self, point: Point) -> Any:
        """The forces of the motors at rest, without friction; what a motor keeps turning goes on."""
        rest = {q + dots: 0.0 for q in self.coordinates for dots in ("_dot", "_ddot")}
        rest |= {f"{q}_dot": float(self.value(rate, point)) for q, rate in self.steady.items()}
        there = self.point(point.names | rest)
        friction = self.result("friction", there) if "friction" in there.results else 0.0
        return (self.result("tau", there) - friction)[:, 0]

    def stiffness(self, point: Point) -> Any:
        """The derivatives of these forces by the coordinates."""
        return np.transpose([self.slope(self.at_rest, point, 0, {q: 1.0}) for q in self.coordinates])

    def is_stable(self, point: Point, kind: str, still: tuple[str, ...] = ()) -> bool:
        """Whether an equilibrium is of this kind, without what stands still or is kept turning."""
        free = [k for k, q in enumerate(self.coordinates) if q not in still and q not in self.steady]
        force, slopes, along = (
            self.at_rest(point),
            self.stiffness(point),
            np.eye(len(self.coordinates))[:, free],
        )
        if self.solution.robot.questions.constraints:
            A = self.result("Ac", point)
            pull = np.linalg.lstsq(A.T[free], force[free], rcond=None)[0]
            held = [
                self.slope(lambda p: self.result("Ac", p).T @ pull, point, 0, {q: 1.0})
                for q in self.coordinates
            ]
            force, slopes = force - A.T @ pull, slopes - np.transpose(held)
            along = along @ np.linalg.svd(A[:, free])[2][len(A) :].T
        curved = np.linalg.eigvalsh(along.T @ slopes @ along)
        right = np.all(curved > NEAR) if kind == "stable" else np.any(curved < -NEAR)
        robot = self.solution.robot
        balanced = robot.actions.passive if robot.questions.model.inputs_given else free
        return bool(right) and near(force[list(balanced)], 0)

    @cached_property
    def _equilibria(self) -> list[list[CodeType]]:
        found = self.solution.to_json()["results"]["equilibria"]
        return [[compile(text.removesuffix(" = 0"), "<equilibria>", "eval") for text in one] for one in found]

    def equilibria(self, told: tuple[Node, ...], seed: int = 0) -> Iterator[tuple[int, Point | None]]:
        """Of each alternative, by its number, a state in which coordinates are what equations say."""
        here = self.posed(told, seed)
        at = [part for part in walk(*told) if isinstance(part, tree.Relation)]
        free = tuple(q for q in self.coordinates if q not in self.steady)
        for number, codes in enumerate(self._equilibria, 1):

            def off(p: Point, codes: list[CodeType] = codes) -> Any:
                known = {"sin": np.sin, "cos": np.cos, "tan": np.tan, "sqrt": np.sqrt, "pi": np.pi}
                zeros = [eval(code, dict(known), dict(p.names)) for code in codes]  # noqa: S307
                zeros += [self.value(one.parts[-1], p) - self.value(one.parts[0], p) for one in at]
                return np.array(zeros, dtype=float)

            point = self.solved(off, free, seed, here) if free and codes else here
            yield number, point if point is not None and near(off(point), 0) else None

    def posed(self, conditions: tuple[Node, ...], seed: int = 0) -> Point:
        """The state in which coordinates are what equations say, q₂ = 90°."""
        here = self.point(seed=seed)
        told = [part for node in conditions for part in walk(node) if isinstance(part, tree.Relation)]
        for one in told:
            *_, name = (q for q in self.coordinates if q in tree.names_in(one.parts[0]))
            off = lambda p, one=one: float(self.value(one.parts[-1], p) - self.value(one.parts[0], p))  # noqa: E731
            ahead = self.point(here.names | {name: here.names[name] + 1}, seed)
            turn = off(here) / (off(here) - off(ahead))  # the left side is a sum of coordinates
            here = self.point(here.names | {name: here.names[name] + turn}, seed)
        return here

    def axis(self, joint: int, point: Point) -> Any:
        """The direction of a joint's axis, and a point on it."""
        robot = self.solution.robot
        parent = robot.joints[joint - 1].parent
        return self.frame(parent if robot.convention.value == "standard" else joint, point)[:3, 2:]

    @property
    def jacobian(self) -> str:
        return "Jr" if "Jr" in self.point().results else "J"

    @property
    def singular(self) -> str:
        """The Jacobian whose rank is looked at: of a wrist all six rows, though the task is the tip."""
        return str(self.solution.values.rules["singular"].inputs[0])

    def momentum(self, of: Node, kind: str, what: str, axis: Node | None, point: Point) -> float:
        """Of the bodies that a coordinate moves, or of all: along an axis, or about it."""
        robot, total = self.solution.robot, 0.0
        (name,) = names_of((of.by,)) if isinstance(of, tree.Derivative) else ("",)
        if axis is None:
            direction, origin = np.eye(3)["xyz".index(what[-1])], np.zeros(3)
        else:
            frame = self.frame(int(plain(axis)[1:]), point)
            direction, origin = frame[:3, 2], frame[:3, 3]
        for body in self.moved_by(name) if "all that" in what else robot.bodies:
            rc, v = (np.ravel(self.result(f"{letter}{body.name}", point)) for letter in ("rc", "v"))
            impulse = self.mass(body, point) * v
            if kind == "angular":
                impulse = np.cross(rc - origin, impulse) + np.ravel(
                    self.result(f"I{body.name}", point) @ self.result(f"w{body.name}", point)
                )
            total += float(direction @ impulse)
        return total

    def where(self, condition: Node, seed: int = 0) -> Point:
        """A state that meets equations in the coordinates, or in parameters alone."""
        told = [part for part in walk(condition) if isinstance(part, tree.Relation)]
        symbols = {part.name for part in walk(condition) if isinstance(part, tree.Symbol)}
        free = tuple(q for q in self.coordinates if q in symbols) or tuple(sorted(symbols))

        def off(p: Point) -> Any:
            return np.array([float(self.value(r.parts[0], p) - self.value(r.parts[-1], p)) for r in told])

        tries = [(free, seed + k) for free in (free, tuple(sorted(symbols))) for k in range(4)]
        found = next(filter(None, (self.solved(off, free, seed) for free, seed in tries)), None)
        if found is None:
            raise Unknown
        return found

    def solved(
        self, off: Callable[[Point], Any], free: tuple[str, ...], seed: int, start: Point | None = None
    ) -> Point | None:
        """A state in which `off` is 0, by Newton's method."""
        here = start or self.point(seed=seed)
        for _ in range(60):
            slopes = np.transpose([self.slope(off, here, seed, {q: 1.0}) for q in free])
            change = np.linalg.lstsq(slopes, off(here), rcond=1e-9)[0]
            here = self.point(
                here.names | {q: here.names[q] - d for q, d in zip(free, change, strict=True)}, seed
            )
            if np.max(np.abs(off(here))) < 1e-11 and np.max(np.abs(change)) < 1e-9:  # also of a double zero
                return here
        return here if np.max(np.abs(off(here))) < 1e-11 else None


def near(a: Any, b: Any, size: float = 0.0) -> bool:
    scale = max(float(np.max(np.abs(a), initial=0)), float(np.max(np.abs(b), initial=0)), size, 1.0)
    return bool(np.max(np.abs(np.subtract(a, b)), initial=0) <= NEAR * scale)


def plain(node: Node) -> str:
    """A formula without fonts and small digits: z0, q̇1."""
    return unicodedata.normalize("NFKC", to_unicode(node)).replace("⋆", "")


def rank(matrix: Any) -> int:
    return int(np.linalg.matrix_rank(matrix, tol=NEAR * max(1.0, float(np.max(np.abs(matrix))))))


def names_of(nodes: tuple[Node, ...]) -> tuple[str, ...]:
    """The coordinates that formulas are."""
    if not all(isinstance(node, tree.Symbol) for node in nodes):
        raise Unknown
    return tuple(node.name for node in nodes if isinstance(node, tree.Symbol))
