"""Inverse kinematics of a full pose, position and rotation, part by part (Spong, 3.3.2-3.3.4; Pieper 1968).

A point on the axes of several joints is not moved by these.  Fixed in the hand, like the centre
of a spherical wrist, it is known from the pose, and the joints before the wrist are found from
it alone (kinematic decoupling).  Fixed in the base, like that of a shoulder, it is known from
the hand.  What is solved is taken off the pose at both ends,

    (Z_1 C_1 ... Z_k C_k)⁻¹ H (C_m Z_{m+1} ... Z_n)⁻¹ = Z_{k+1} C_{k+1} ... Z_m,

and the joints between are looked for in the same way: a wrist by its rotation, three parallel
axes as a planar arm.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations_with_replacement

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.transfer import Transfer
from dynsolve.derivation.inverse.chain import Chain, chain_of, inverse
from dynsolve.derivation.inverse.equations import Equation, OfPoint, OfTurn, System, lineage
from dynsolve.derivation.inverse.names import Names
from dynsolve.derivation.inverse.relations import length
from dynsolve.derivation.inverse.search import search
from dynsolve.derivation.inverse.solving import FixedPoint, Part, Relation, Solving, Turn
from dynsolve.derivation.inverse.subproblems import Solved
from dynsolve.derivation.inverse.unknowns import Unknowns, search_ring
from dynsolve.robot.model import Robot

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
    taken = {*robot.ring.names, *robot.ring.parameters, *values}
    names = Names.beside(taken)
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
    told = sorted((*_of_points(start, names), *fixed), key=length)
    identities = tuple(_orthonormal(H))
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


def _of_points(block: _Block, names: Names) -> Iterator[Relation]:
    """The coordinates of points, in the hand and in the base, that no joint changes."""
    whole = block.point(names, 0, len(block.chain.screws), from_hand=False)
    for point in (*([whole] if whole else []), *_points(block, names)):
        meant = {point.known.ring.symbol(d.name): d.value for d in point.definitions}
        for known, made in zip(point.known.entries, point.made.entries, strict=True):
            if not made.ring.depends_on_coordinates(made):
                yield Relation(meant.get(known, known), made)


@dataclass(frozen=True, slots=True)
class _Block:
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
