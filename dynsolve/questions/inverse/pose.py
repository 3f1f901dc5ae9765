"""Inverse kinematics of a full pose, position and rotation, part by part (Spong, 3.3.2-3.3.4; Pieper 1968).

A point on the axes of several joints is not moved by these.  Fixed in the hand, like the centre
of a spherical wrist, it is known from the pose, and the joints before the wrist are found from
it alone (kinematic decoupling).  Fixed in the base, like that of a shoulder, it is known from
the hand.  What is solved is taken off the pose at both ends,

    (Z_1 C_1 ... Z_k C_k)⁻¹ H (C_m Z_{m+1} ... Z_n)⁻¹ = Z_{k+1} C_{k+1} ... Z_m,

and the joints between are looked for in the same way: a wrist by its rotation, three parallel
axes as a planar arm.

The arm as a chain of motions about and along the joint axes, with constant steps between them.

    H = C_0 Z_1 C_1 Z_2 ... Z_n C_n,    Z_i = Rot(z, θ_i) Trans(z, d_i)

Z_i moves along the axis of joint i, the z axis of the frame before and of the frame behind it; C_i
is the same for every q.  In the standard convention C_i is the second half of A_i, in the modified
one C_{i-1} the first.  What does not notice some of the joints is read off from this: a point on
the axes of several joints that turn, which they do not move.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import combinations_with_replacement

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.sampling import Transfer
from dynsolve.derivation.kinematics import base_transform
from dynsolve.derivation.search_ring import search_ring
from dynsolve.questions.inverse.equations import Equation, OfPoint, OfTurn, System, Unknowns, lineage
from dynsolve.questions.inverse.names import Names
from dynsolve.questions.inverse.search import search
from dynsolve.questions.inverse.solving import FixedPoint, Part, Relation, Solving, Turn, length
from dynsolve.questions.inverse.subproblems import Solved
from dynsolve.robot.model import Convention, Joint, JointType, Robot
from dynsolve.robot.names import names_taken

# The arm as a chain of motions about and along the joint axes, with constant steps between them


class Screw(Struct, frozen=True):
    """Z_i, 4×4, with its coordinate; `slide` is d_i, `number` i from 1."""

    coordinate: str
    number: int
    is_revolute: bool
    motion: Matrix
    slide: Expr


class Chain(Struct, frozen=True):
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


MOST_JOINTS = 6
"""With more, a pose leaves coordinates free."""

MOST_TERMS = 400
"""Poses and points whose entries have more terms together are not searched for equations."""


def solve_pose(robot: Robot, pose: Matrix, values: Sequence[str]) -> Solving | None:
    """How H(q) = H is solved for q; None where the known forms do not lead to an end.

    `pose` are the position and the rows of the rotation of H(q), 12×1, `values` the names of
    what they are to be.
    """
    if robot.n > MOST_JOINTS:
        return None
    names = Names.beside(names_taken(robot))
    ring = search_ring(robot.ring, (*values, *names.of_points, *names.of_turns), {})
    found = chain_of(robot, ring)
    if found is None:
        return None
    first, chain, last = found
    x, y, z, *entries = map(ring.symbol, values)
    rows = [[*entries[3 * k : 3 * k + 3], p] for k, p in enumerate((x, y, z))]
    H = Matrix.of(ring, [*rows, last.rows[3]])
    start = _Block(chain, inverse(first) @ H @ inverse(last))
    unknowns = Unknowns(ring, tuple(ring.names), tuple(values))
    parts = _parts(start, unknowns, names)
    if parts is None:
        return None
    made = pose.map(Transfer(pose.ring, ring)).entries
    whole = [Relation(ring.symbol(name), entry) for name, entry in zip(values, made, strict=True)]
    fixed = [one for one in whole if not ring.depends_on_coordinates(one.right)]
    identities = tuple(_orthonormal(H))
    known = (*identities, *_orthonormal(H.T))
    points = (replace(one, left=_of_a_rotation(one.left, known)) for one in _of_points(start, names))
    told = sorted((*points, *fixed), key=length)
    return Solving(
        ring,
        pose,
        tuple(values),
        frozenset(),
        tuple(_needed(parts)),
        (),
        tuple(whole),
        tuple(told),
        identities,
    )


def _orthonormal(H: Matrix) -> Iterator[Relation]:
    """What holds between the entries of every rotation: its rows are of length 1, at right angles."""
    ring = H.ring
    for i, j in combinations_with_replacement(H.rows[:3], 2):
        yield Relation(ring.dot(i[:3], j[:3]), ring.one if i is j else ring.zero)


def _of_a_rotation(value: Expr, known: Iterable[Relation]) -> Expr:
    """An expression without products of the rows or columns of a rotation, which are 0 or 1."""
    for one in known:
        (first, *_), ring = one.left.poly.monoms(), value.ring
        factor = value
        for k in (k for k, exponent in enumerate(first) for _ in range(int(exponent))):
            factor = Expr(ring, factor.poly.derivative(k))
        shorter = value - factor * Fraction(1, max(map(int, first))) * (one.left - one.right)
        value = min(value, shorter, key=len)
    return value


def _of_points(block: _Block, names: Names) -> Iterator[Relation]:
    """The coordinates of points, in the hand and in the base, that no joint changes."""
    whole = block.point(names, 0, len(block.chain.screws), from_hand=False)
    for point in (*([whole] if whole else []), *_points(block, names)):
        meant = {point.known.ring.symbol(d.name): d.value for d in point.definitions}
        for known, made in zip(point.known.entries, point.made.entries, strict=True):
            if not made.ring.depends_on_coordinates(made):
                yield Relation(meant.get(known, known), made)


class _Block(Struct, frozen=True):
    """The joints that are left, and the pose H (4×4, in what is known) that they make."""

    chain: Chain
    H: Matrix
    turn: Turn | None = None

    def point(self, names: Names, start: int, stop: int, *, from_hand: bool) -> FixedPoint | None:
        """The point that screws start..stop-1, at an end of the chain, do not move."""
        found = self.chain.point(start, stop)
        if found is None:
            return None
        before, behind = found
        if from_hand:
            value, made = inverse(self.H) @ before, inverse(self.chain.behind(stop)) @ behind
        else:
            value, made = self.H @ behind, self.chain.before(start) @ before
        known, definitions = names.point(value.block(0, 3, 0, 1))
        first = self.chain.screws[0].number
        return FixedPoint(
            first + start, first + stop - 1, known, made.block(0, 3, 0, 1), definitions, from_hand
        )

    def without(self, solved: Sequence[Solved], names: Names) -> _Block | None:
        """What is left when the solved joints at both ends are taken off; None where nothing is."""
        done = {step.coordinate for step in solved}
        left = [k for k, name in enumerate(self.chain.names) if name not in done]
        if not left:
            return None
        start, stop = left[0], left[-1] + 1
        chain = self.chain.part(start, stop)
        H = inverse(self.chain.before(start)) @ self.H @ inverse(self.chain.behind(stop))
        known, definitions = names.turn(H)
        is_wrist = stop - start == 3 and chain.point(0, 3) is not None
        first, last = chain.screws[0].number, chain.screws[-1].number
        return _Block(
            chain, known, Turn(first, last, chain.names, known, chain.product, is_wrist, definitions)
        )


def _parts(block: _Block, unknowns: Unknowns, names: Names) -> list[Part] | None:
    """The parts of a solution for the joints of a block; None where some are not found."""
    for part in _ways(block, unknowns, names):
        found = {step.coordinate for step in part.solved}
        rest = block.without(part.solved, names)
        if rest is None:
            return [part]
        left = unknowns
        for name in found:
            left = left.without(name)
        others = _parts(rest, left, names.later)
        if others is not None:
            return [part, *others]
    return None


def _needed(parts: Sequence[Part]) -> list[Part]:
    """The parts with those names of a rotation alone that stand in a step, or in a name that does."""
    used: set[str] = set()
    kept: list[Part] = []
    for part in reversed(parts):
        for equation in lineage(e for step in part.solved for e in step.equations):
            used |= _symbols(equation.left)
        for definition in part.point.definitions if part.point else ():
            used |= _symbols(definition.value)
        turn = part.turn
        if turn is not None:
            turn = replace(turn, definitions=tuple(d for d in turn.definitions if d.name in used))
            for definition in turn.definitions:
                used |= _symbols(definition.value)
        kept.insert(0, replace(part, turn=turn))
    return kept


def _symbols(expr: Expr) -> set[str]:
    """The names of the symbols that occur."""
    degrees = expr.poly.degrees()
    return {name for (name, _), index in expr.ring.symbol_indices.items() if degrees[index] > 0}


def _ways(block: _Block, unknowns: Unknowns, names: Names) -> Iterator[Part]:
    """The steps that can be taken next: from a point or a rotation alone where that is enough, or both."""
    points = sorted(_points(block, names), key=lambda point: point.first - point.last)
    for point in points:
        if _terms(point.made) > MOST_TERMS:
            continue
        solved = search(list(_of_point(block, point)), unknowns)
        if {step.coordinate for step in solved} == set(_moving(block, point)):
            yield Part(solved, block.turn, point)
    if _terms(block.chain.product) > MOST_TERMS:
        return
    turned = tuple(_of_turn(block))
    solved = search(turned, unknowns)
    if {step.coordinate for step in solved} == set(block.chain.names):
        yield Part(solved, block.turn)
    for point in points:
        solved = search([*_of_point(block, point), *turned], unknowns)
        if solved:
            yield Part(solved, block.turn, point, block.chain.parallel)


def _terms(made: Matrix) -> int:
    """How many terms its entries have together."""
    return sum(map(len, made.entries))


def _points(block: _Block, names: Names) -> Iterator[FixedPoint]:
    """The points that the most joints do not move: at the end of the hand, and at that of the base."""
    size = len(block.chain.screws)
    for from_hand in (False, True):
        for count in range(size - 1, from_hand - 1, -1):
            ends = (0, count) if from_hand else (size - count, size)
            found = block.point(names, *ends, from_hand=from_hand)
            if found is not None:
                yield found
                break


def _moving(block: _Block, point: FixedPoint) -> Iterator[str]:
    """The coordinates that move a point."""
    for screw in block.chain.screws:
        if not point.first <= screw.number <= point.last:
            yield screw.coordinate


def _of_point(block: _Block, point: FixedPoint) -> Iterator[System]:
    """The coordinates of a point, from the pose and from the joints that move it.

    Where axes are at angles that are not right, it is also seen from the frames on the way to it:
    turning its components about one axis does not lead to the next.
    """
    rows = zip(point.known.entries, point.made.entries, strict=True)
    yield tuple(Equation(known, made, OfPoint(k)) for k, (known, made) in enumerate(rows))
    if point.from_hand or not block.chain.is_oblique:
        return
    first = block.chain.screws[0].number
    for passed in range(1, point.first - first):
        back = inverse(block.chain.before(passed))
        seen = (back @ _with_one(values) for values in (point.known, point.made))
        rows = zip(*(values.entries[:3] for values in seen), strict=True)
        yield tuple(Equation(known, made, OfPoint(k, first + passed)) for k, (known, made) in enumerate(rows))


def _with_one(point: Matrix) -> Matrix:
    """(x, y, z, 1) of a point."""
    return Matrix(point.ring, (*point.rows, (point.ring.one,)))


def _of_turn(block: _Block) -> Iterator[System]:
    """The columns and the rows of the rotation, from the pose and from the joints."""
    made = block.chain.product
    entries = [[Equation(block.H[i, j], made[i, j], OfTurn(i, j)) for j in range(3)] for i in range(3)]
    for system in (*zip(*entries, strict=True), *entries):
        yield tuple(system)
