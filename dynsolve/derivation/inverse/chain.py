"""The arm as a chain of motions about and along the joint axes, with constant steps between them.

    H = C_0 Z_1 C_1 Z_2 ... Z_n C_n,    Z_i = Rot(z, θ_i) Trans(z, d_i)

Z_i moves along the axis of joint i, the z axis of the frame before and of the frame behind it; C_i
is the same for every q.  In the standard convention C_i is the second half of A_i, in the modified
one C_{i-1} the first.  What does not notice some of the joints is read off from this: a point on
the axes of several joints that turn, which they do not move.
"""

from __future__ import annotations

from dataclasses import dataclass

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Ring
from dynsolve.algebra.transfer import Transfer
from dynsolve.derivation.kinematics import base_transform
from dynsolve.robot.model import Convention, Joint, JointType, Robot


@dataclass(frozen=True, slots=True)
class Screw:
    """Z_i, 4×4, with its coordinate; `slide` is d_i, `number` i from 1."""

    coordinate: str
    number: int
    is_revolute: bool
    motion: Matrix
    slide: Expr


@dataclass(frozen=True, slots=True)
class Chain:
    """Z_1 ... Z_n and C_1 ... C_{n-1}: `between[k]` stands behind screw k, both counted from 0."""

    screws: tuple[Screw, ...]
    between: tuple[Matrix, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """The coordinates."""
        return tuple(screw.coordinate for screw in self.screws)

    def part(self, start: int, stop: int) -> Chain:
        """Screws start..stop-1."""
        return Chain(self.screws[start:stop], self.between[start : max(start, stop - 1)])

    @property
    def product(self) -> Matrix:
        """Z_1 C_1 ... Z_n, 4×4."""
        return self.before(len(self.screws))

    @property
    def parallel(self) -> tuple[int, ...]:
        """The numbers of the longest run of three or more joints that turn about parallel axes."""
        runs: list[tuple[int, ...]] = [()]
        for k, screw in enumerate(self.screws):
            is_parallel = k > 0 and not any(self.between[k - 1][i, 2].poly for i in (0, 1))
            goes_on = runs[-1] and is_parallel and screw.is_revolute
            runs.append((*(runs[-1] if goes_on else ()), *((screw.number,) if screw.is_revolute else ())))
        longest = max(runs, key=len)
        return longest if len(longest) > 2 else ()

    def before(self, start: int) -> Matrix:
        """Z_1 C_1 ... C_start, 4×4: from the first frame to that before screw `start` (from 0)."""
        found = Matrix.identity(self.screws[0].motion.ring, 4)
        for screw, step in zip(self.screws[:start], (*self.between, None), strict=False):
            found = found @ screw.motion
            found = found if step is None else found @ step
        return found

    def behind(self, stop: int) -> Matrix:
        """C_stop Z_stop+1 ... Z_n, 4×4: from the frame behind screw stop - 1 to the last one."""
        found = Matrix.identity(self.screws[0].motion.ring, 4)
        for step, screw in zip(self.between[stop - 1 :], self.screws[stop:], strict=False):
            found = found @ step @ screw.motion
        return found

    @property
    def is_oblique(self) -> bool:
        """Whether a step between two axes turns by anything but right angles."""
        return any(
            not entry.is_zero and not (entry * entry - entry.ring.one).is_zero
            for step in self.between
            for entry in step.block(0, 3, 0, 3).entries
        )

    def point(self, start: int, stop: int) -> tuple[Matrix, Matrix] | None:
        """A point that screws start..stop-1 do not move: on all their axes; None where there is none.

        Without any screw it is the origin.

        It is given twice, as (x, y, z, 1): in the frame before the first of them, and behind the last.
        """
        screws = self.screws[start:stop]
        if not screws:
            origin = _on_axis(self.screws[0].motion.ring.zero)
            return origin, origin
        if not all(screw.is_revolute for screw in screws):
            return None
        behind = self._crossing(start, stop)
        if behind is None:
            return None
        before = behind + screws[0].slide
        for step, screw in zip(self.between[start : stop - 1], screws[1:], strict=True):
            x, y, z, _ = (inverse(step) @ _on_axis(behind)).entries
            if not (x.is_zero and y.is_zero):
                return None
            behind = z - screw.slide
        return _on_axis(before), _on_axis(behind)

    def _crossing(self, start: int, stop: int) -> Expr | None:
        """How far along the axis of screw `start`, in the frame behind it, the next axis crosses it."""
        ring = self.screws[start].motion.ring
        if stop - start == 1:
            return ring.zero
        back = inverse(self.between[start])
        slope = next((k for k in range(2) if not back[k, 2].is_zero), None)
        if slope is None or back[slope, 3].is_zero:
            return ring.zero
        return -(back[slope, 3] * ring.inverse(back[slope, 2])) if back[slope, 2].is_number else None


def chain_of(robot: Robot, ring: Ring) -> tuple[Matrix, Chain, Matrix] | None:
    """C_0, the chain and C_n in a ring; None where a joint does not move by one coordinate of its own."""
    carry = Transfer(robot.ring, ring)
    steps: list[Matrix] = [base_transform(robot).map(carry)]
    screws: list[Screw] = []
    for joint in robot.joints:
        screw, link = screw_matrix(robot, joint).map(carry), link_matrix(robot, joint).map(carry)
        is_standard = robot.convention is Convention.STANDARD
        if not is_standard:
            steps[-1] = steps[-1] @ link
        if joint.variable is None:
            steps[-1] = steps[-1] @ screw
        else:
            if len(joint.rates) != 1:
                return None
            name = robot.coordinates[joint.rates[0][0]].name
            is_revolute = joint.type is JointType.REVOLUTE
            screws.append(Screw(name, len(screws) + 1, is_revolute, screw, carry(joint.d)))
            steps.append(Matrix.identity(ring, 4))
        if is_standard:
            steps[-1] = steps[-1] @ link
    names = [screw.coordinate for screw in screws]
    if not screws or len(set(names)) < len(names):
        return None
    return steps[0], Chain(tuple(screws), tuple(steps[1:-1])), steps[-1]


def screw_matrix(robot: Robot, joint: Joint) -> Matrix:
    """Rot(z, θ) Trans(z, d), 4×4."""
    ring = robot.ring
    c, s, zero, one = ring.cos(joint.theta), ring.sin(joint.theta), ring.zero, ring.one
    return Matrix.of(
        ring, [[c, -s, zero, zero], [s, c, zero, zero], [zero, zero, one, joint.d], [zero, zero, zero, one]]
    )


def link_matrix(robot: Robot, joint: Joint) -> Matrix:
    """Trans(x, a) Rot(x, α), 4×4; the two commute."""
    ring = robot.ring
    c, s, zero, one = ring.cos(joint.alpha), ring.sin(joint.alpha), ring.zero, ring.one
    return Matrix.of(
        ring, [[one, zero, zero, joint.a], [zero, c, -s, zero], [zero, s, c, zero], [zero, zero, zero, one]]
    )


def inverse(H: Matrix) -> Matrix:
    """(Rᵀ, -Rᵀ o), 4×4, of a homogeneous transformation."""
    turned = H.block(0, 3, 0, 3).T
    moved = -(turned @ H.block(0, 3, 3, 4))
    rows = [[*row, p] for row, p in zip(turned.rows, moved.entries, strict=True)]
    return Matrix.of(H.ring, [*rows, H.rows[3]])


def _on_axis(height: Expr) -> Matrix:
    """(0, 0, height, 1): a point of the z axis, 4×1."""
    ring = height.ring
    return Matrix.column(ring, (ring.zero, ring.zero, height, ring.one))
