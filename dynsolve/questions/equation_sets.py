"""Sets of equations, held in numbers at points of a fixed seed.

Points on each alternative are found by Newton's method: at every point of the key the student's set must
hold, and at every point of the student's there must be what is asked for: of singular configurations the
Jacobian loses rank, of equilibria nothing moves.  An angle counts modulo 2π where the forces have that
period in it.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from itertools import islice
from math import degrees, pi, radians, remainder

from msgspec import Struct

from dynsolve.algebra.sampling import ENOUGH
from dynsolve.derivation.arm_values import assumed_states
from dynsolve.derivation.configurations import NO_VALUE, is_zero, with_half_turns, zero_near
from dynsolve.derivation.reached import CLOSE
from dynsolve.notation.printing import PLAIN
from dynsolve.notation.text import ARCS
from dynsolve.notation.tree import Function, Node, Number, Symbol, mapped, names_in, walk
from dynsolve.notation.tree_values import Program, compile_trees
from dynsolve.notation.unicode import to_unicode
from dynsolve.questions.judging import RIGHT, Alternatives, Fault, SetVerdict, by_code
from dynsolve.robot.model import JointType, Robot

NEVER_HOLDS = by_code(
    Fault("condition_never_holds", "a case",
          "No configuration was found at which alternative {number} holds.",
          "Its equations must hold together."),
)  # fmt: skip

# A configuration in round numbers, as an example of what is said of a set of configurations

ANYWHERE = "At some configurations"

_STEP = 15
"""Angles are told in multiples of so many degrees, lengths in whole numbers."""


def example_point(
    robot: Robot,
    formulas: Iterable[Node],
    points: Iterable[Mapping[str, float]],
    holds: Callable[[Mapping[str, float]], bool],
    fails: Callable[[Mapping[str, float]], bool],
) -> str:
    """`At q₁ = 0°, q₂ = 90°`: the first point at which, in round numbers, one still holds, the other not.

    It has the coordinates that stand in some formulas; where there is no such point, it is not told.
    """
    names = names_in(*formulas)
    told = [q for q in robot.coordinates if q.name in names]
    for point in points:
        at, words = dict(point), []
        for q in told:
            value = point[q.name]
            if q.type is JointType.REVOLUTE:
                rounded = round(degrees(value) / _STEP) * _STEP % 360
                at[q.name] = radians(rounded)
            else:
                rounded = round(value)
                at[q.name] = float(rounded)
            words.append(
                f"{to_unicode(Symbol(q.name), PLAIN)} = {rounded}{'°' * (q.type is JointType.REVOLUTE)}"
            )
        if words and holds(at) and not fails(at):
            return f"At {', '.join(words)}"
    return ANYWHERE


# Sets of equations, in numbers


class HeldEquations(Struct, frozen=True):
    """What is 0 together; `are_angles` tells of each whether it counts modulo 2π, as q₂ - π does."""

    program: Program
    are_angles: tuple[bool, ...]

    def hold(self, q: Mapping[str, float]) -> bool:
        """Whether all are 0 at a configuration."""
        try:
            values = self.program.run(q)
        except NO_VALUE:
            return False
        pairs = zip(values, self.are_angles, strict=True)
        return all(abs(remainder(value, 2 * pi) if is_angle else value) < CLOSE for value, is_angle in pairs)


def held_equations(
    nodes: Iterable[Node], coordinates: Collection[str], periodic: Collection[str]
) -> HeldEquations:
    """The equations node = 0, where the angles `periodic` among the coordinates count modulo 2π."""
    nodes = tuple(nodes)
    are_angles = []
    for node in nodes:
        within = names_in(node).intersection(coordinates)
        outside = mapped(node, _without_angle)
        turned = any(isinstance(part, Function) and within & names_in(part) for part in walk(outside))
        are_angles.append(bool(within) and within <= set(periodic) and not turned)
    return HeldEquations(compile_trees(nodes), tuple(are_angles))


def _without_angle(part: Node) -> Node:
    """0 for an angle that a function gives, which like a coordinate counts modulo 2π."""
    return Number(0) if isinstance(part, Function) and part.name in ARCS else part


_TURNS = 3
"""So many whole turns either way are looked at."""


class EquationSet(Struct, frozen=True):
    """A set of equations as the key has it: its alternatives, and whether a configuration `belongs` to it.

    `formulas` are those that it is about; points are looked for from the configurations `begun`.  The
    angles `periodic` count modulo 2π each, those `together` where all of them turn; `wrong` and `missing`
    are the codes of what is said of an alternative with too much, and of one that is not there.
    """

    robot: Robot
    formulas: Sequence[Node]
    alternatives: Sequence[Sequence[Node]]
    belongs: Callable[[Mapping[str, float]], bool]
    begun: Sequence[dict[str, float]]
    wrong: str
    missing: str
    periodic: Collection[str] = ()
    together: Collection[str] = ()

    def verdict(self, given: Alternatives) -> SetVerdict:
        """Whether a set is that of the key."""
        names = [q.name for q in self.robot.coordinates]
        alternatives = [tuple(part.node for part in one) for one in given]
        theirs = [held_equations(one, names, self.periodic) for one in alternatives]
        formulas = [*self.formulas, *(node for one in alternatives for node in one)]
        for number, (nodes, held) in enumerate(zip(alternatives, theirs, strict=True), 1):
            points = list(self._points(nodes))
            if not points:
                return SetVerdict(False, "condition_never_holds", number)
            if not all(map(self.belongs, points)):
                where = example_point(self.robot, formulas, points, held.hold, self.belongs)
                return SetVerdict(False, self.wrong, number, where=where)

        def is_met(q: Mapping[str, float]) -> bool:
            return any(one.hold(turned) for turned in self._turned(q) for one in theirs)

        found = (q for one in self.alternatives for q in self._points(one))
        missed = [q for q in found if self.belongs(q) and not is_met(q)]
        if not missed:
            return RIGHT
        where = example_point(self.robot, formulas, missed if given else [], self.belongs, is_met)
        return SetVerdict(False, self.missing, where=where)

    def _points(self, conditions: Sequence[Node]) -> Iterator[dict[str, float]]:
        """Configurations at which everything is 0; any at all where there is no condition."""
        program = compile_trees(list(conditions))
        found = (zero_near(self.robot, program, start) if conditions else start for start in self.begun)
        return with_half_turns(self.robot, program, (q for q in found if q is not None))

    def _turned(self, q: Mapping[str, float]) -> Iterator[Mapping[str, float]]:
        """The configuration, and those that are the same by whole turns of angles that turn together."""
        yield q
        for turns in range(-_TURNS, _TURNS + 1) if self.together else ():
            yield {**q} | {name: q[name] + 2 * pi * turns for name in self.together}


def vanishing_set(
    robot: Robot,
    forces: Sequence[Node],
    alternatives: Sequence[Sequence[Node]],
    numbers: Mapping[str, float],
    holds: Callable[[Mapping[str, float]], bool] = lambda at: True,
    wrong: str = "",
    missing: str = "",
) -> EquationSet:
    """The set where forces are 0, and it `holds`; `numbers` are those that the problem gives.

    `wrong` and `missing` are codes as in an `EquationSet`.
    """
    program, begun = compile_trees(forces), list(starts(robot, numbers))
    turning = turning_in(robot)

    def have_period(names: Sequence[str]) -> bool:
        """Whether the forces are the same after a turn of these angles."""
        turned = {**begun[0], **{name: begun[0][name] + 2 * pi for name in names}}
        pairs = zip(program.run(begun[0]), program.run(turned), strict=True)
        return all(abs(a - b) < CLOSE for a, b in pairs)

    periodic = [name for name in turning if have_period([name])]
    others = [name for name in turning if name not in periodic]
    return EquationSet(
        robot,
        forces,
        alternatives,
        lambda at: is_zero(program, at) and holds(at),
        begun,
        wrong,
        missing,
        periodic,
        others if others and have_period(others) else (),
    )


def turning_in(robot: Robot) -> tuple[str, ...]:
    """The coordinates that are angles."""
    return tuple(q.name for q in robot.coordinates if q.type is JointType.REVOLUTE)


# Where points are looked for from


def starts(robot: Robot, numbers: Mapping[str, float] | None = None) -> Iterator[dict[str, float]]:
    """Configurations in all quadrants, with parameters as is assumed of them."""
    for found in islice(assumed_states(robot), ENOUGH):
        values = {**found, **(numbers or {})}
        yield values | moving(robot, values)


def moving(robot: Robot, values: Mapping[str, float]) -> dict[str, float]:
    """Rates and accelerations: 0, but for the rates that are held constant."""
    still = {name: 0.0 for q in robot.coordinates for name in (q.velocity, q.acceleration)}
    steady = robot.questions.model.steady
    rates = {q.name: q.velocity for q in robot.coordinates}
    held = compile_trees([value for _, value in steady]).run(values)
    return still | {rates[name]: float(value) for (name, _), value in zip(steady, held, strict=True)}
