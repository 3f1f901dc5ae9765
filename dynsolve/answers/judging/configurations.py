"""Verdicts on sets of configurations and of equations, held in numbers at points of a fixed seed.

Of a set of equations, points on each alternative are found by Newton's method: at every point of the key
the student's set must hold, and at every point of the student's there must be what is asked for: of
singular configurations the Jacobian loses rank, of equilibria nothing moves.  An angle counts modulo 2π
where the forces have that period in it.  Branches of the inverse kinematics are held in `branches`.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence, Set
from fractions import Fraction
from functools import cached_property
from math import degrees, pi, radians, remainder
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring_values import evaluate
from dynsolve.algebra.sampling import WIDEST
from dynsolve.answers.judging.branches import RIGHT, BranchKey, SetVerdict, TargetKey
from dynsolve.answers.verdict import ConfigurationAnswer, Part
from dynsolve.derivation.configurations import (
    NO_VALUE,
    is_zero,
    rank_of,
    states_of,
    with_half_turns,
    zero_near,
)
from dynsolve.derivation.graph import Derivation, Skipped
from dynsolve.derivation.reached import CLOSE
from dynsolve.explain.forms import Forms
from dynsolve.notation.printing import PLAIN
from dynsolve.notation.text import ARCS
from dynsolve.notation.tree import Function, Node, Number, Symbol, mapped, names_in, walk
from dynsolve.notation.tree_values import Program, compile_trees
from dynsolve.notation.unicode import to_unicode
from dynsolve.questions.equilibria.check import (
    balanced_forces,
    balanced_points,
    holding,
    in_balance,
    is_balanced,
    starts,
)
from dynsolve.questions.equilibria.forms import EquilibriaForms
from dynsolve.questions.inverse.forms import InverseForms
from dynsolve.questions.singular.forms import SingularForms
from dynsolve.robot.model import JointType, Robot

if TYPE_CHECKING:
    from dynsolve.questions.constraints.check import ConstrainedStates


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

    def verdict(self, given: Sequence[Sequence[Part]]) -> SetVerdict:
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


def equilibria_of(
    robot: Robot,
    forces: Sequence[Node],
    alternatives: Sequence[Sequence[Node]],
    numbers: Mapping[str, float],
    holds: Callable[[Mapping[str, float]], bool] = lambda at: True,
) -> EquationSet:
    """The set where forces are 0, and it `holds`; `numbers` are those that the problem gives."""
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
        "no_equilibrium",
        "equilibria_missing",
        periodic,
        others if others and have_period(others) else (),
    )


def turning_in(robot: Robot) -> tuple[str, ...]:
    """The coordinates that are angles."""
    return tuple(q.name for q in robot.coordinates if q.type is JointType.REVOLUTE)


SETS = ("singular", "equilibria", "balance", "reduced")
"""The sets of equations."""


class ConfigurationKey:
    """The key's sets of one problem, in numbers; `values` are those that the problem gives.

    `exact` are the decimals that stand in its file.
    """

    def __init__(
        self,
        robot: Robot,
        derivation: Derivation,
        values: Mapping[str, Fraction],
        exact: frozenset[Fraction] = frozenset(),
    ) -> None:
        self.robot, self.values, self.exact = robot, derivation, exact
        self.numbers = {name: float(value) for name, value in values.items()}
        self.forms = Forms(robot, derivation)
        self.inverse = InverseForms(robot, derivation)
        self.singular = SingularForms(robot, derivation)
        self.equilibria = EquilibriaForms(robot, derivation)

    def verdict(self, answer: ConfigurationAnswer) -> SetVerdict:
        """Whether a set is that of the key."""
        if not self._known(answer):
            return SetVerdict(False, "foreign_name")
        held = {
            "inverse": lambda given: self._branches.verdict(given),
            "singular": self._singular_verdict,
            "equilibria": lambda given: self._equilibria.verdict(given),
            "balance": self._balance,
            "reduced": self._reduced,
        }
        return held[answer.name](answer.alternatives)

    def vanishing(self, name: str) -> str:
        """What is 0 on a set: the determinant, or the forces; empty for any other set."""
        found = {"singular": "det", "equilibria": balanced_forces(self.robot)}.get(name, "")
        return found if found in self.values.rules else ""

    def is_where_zero(self, answer: ConfigurationAnswer, value: Any) -> bool:
        """Whether a set is where a value is 0: a determinant, or forces, that are not the key's."""
        if not isinstance(value, Expr | Matrix) or not self._known(answer):
            return False
        compactor = Compactor(value.ring)
        zeros = (
            [compactor.form(value)]
            if isinstance(value, Expr)
            else in_balance(self.forms, compactor.matrix(value))
        )
        if not names_in(*zeros) <= self._names:
            return False
        return equilibria_of(self.robot, zeros, [zeros], self.numbers).verdict(answer.alternatives).is_right

    def is_skipped(self, name: str) -> bool:
        """Whether the key has no set of that name, because it would be too long."""
        if name == "inverse" and self.robot.questions.target is not None:
            return self.inverse.target is None
        if isinstance(self.values[name], Skipped):
            return name in SETS
        return name == "reduced" and not self._constrained.all

    @cached_property
    def _branches(self) -> BranchKey | TargetKey:
        if self.inverse.target is not None:
            return TargetKey(self.inverse.target, self.exact, self.robot.questions.all_branches)
        (task,) = self.values.rules["inverse"].inputs
        form = self.forms(task)
        states = [*map(self._limited, self._states(compile_trees([form])))]
        return BranchKey(self.robot, self.values[task], form, self.inverse, states)

    @cached_property
    def _equilibria(self) -> EquationSet:
        balanced = self.forms(balanced_forces(self.robot))
        forces = in_balance(self.forms, balanced)
        alternatives = self.equilibria.equilibria
        if any(self._is_special(one.factor) for one in self.values["equilibria"].special):
            alternatives = (tuple(forces),)
        holds = holding(self.forms, balanced)
        return equilibria_of(self.robot, forces, alternatives, self.numbers, holds)

    def _is_special(self, factor: Expr) -> bool:
        """Whether a factor is 0 for the numbers of the problem, for which the equilibria are others."""
        held = names_in(self.equilibria.comparison(factor, "="))
        return held <= self.numbers.keys() and abs(evaluate(factor, self.numbers)) < CLOSE

    def _balance(self, given: Sequence[Sequence[Part]]) -> SetVerdict:
        """Conditions that all hold: whether gravity is balanced where they do, and they do where it is."""
        theirs = [part.node for one in given for part in one]
        gravity = self.forms("g")
        points = list(balanced_points(self.robot, theirs))
        if not points:
            return SetVerdict(False, "balance_never_holds")
        if not all(is_balanced(self.robot, gravity, at) for at in points):
            return SetVerdict(False, "not_balanced")
        for number, node in enumerate(theirs, 1):
            condition = held_equations([node], (), ())
            if not all(condition.hold(at) for at in balanced_points(self.robot, self.equilibria.balance)):
                return SetVerdict(False, "condition_too_much", number)
        return RIGHT

    def _reduced(self, given: Sequence[Sequence[Part]]) -> SetVerdict:
        """Equations of motion without multipliers: whether each holds, and they are enough."""
        theirs = [part.node for one in given for part in one]
        for number, node in enumerate(theirs, 1):
            if not self._constrained.hold(node):
                return SetVerdict(False, "motion_differs", number)
        enough = bool(theirs) and self._constrained.are_enough(theirs)
        return RIGHT if enough else SetVerdict(False, "motions_missing")

    @cached_property
    def _constrained(self) -> ConstrainedStates:
        from dynsolve.questions.constraints.check import ConstrainedStates, constrained_names

        forms = {name: self.forms(name) for name in constrained_names(self.robot)}
        return ConstrainedStates(self.robot, forms, self.numbers)

    def _known(self, answer: ConfigurationAnswer) -> bool:
        """Whether every name in an answer has a value here."""
        names = self._names
        if answer.name == "reduced":
            names = names | {q.force for q in self.robot.coordinates}
        if answer.name == "inverse":
            names = names | set(self.robot.questions.reached)
        return names_in(*(part.node for one in answer.alternatives for part in one)) <= names

    @cached_property
    def _names(self) -> Set[str]:
        """What stands in sets of every kind."""
        return {"pi", *self.robot.ring.parameters, *(q.name for q in self.robot.coordinates)}

    def _states(self, program: Program) -> list[dict[str, float]]:
        return [{**values, **self.numbers} for values in states_of(self.robot, program)]

    def _limited(self, values: Mapping[str, float]) -> dict[str, float]:
        """The configuration, moved into the limits of the joints in proportion."""
        limited = dict(values)
        for one in self.robot.questions.limits:
            low, high = compile_trees([one.low, one.high]).run(values)
            widest = pi if one.coordinate in turning_in(self.robot) else WIDEST
            limited[one.coordinate] = low + (high - low) * (values[one.coordinate] + widest) / (2 * widest)
        return limited

    @cached_property
    def _singular(self) -> EquationSet:
        (name,) = self.values.rules["singular"].inputs
        form, found = self.forms(name), self.singular.singular_set
        assert found is not None
        jacobian, rank = compile_trees([form]), found.rank
        return EquationSet(
            self.robot,
            [form],
            self.singular.singular,
            lambda q: rank_of(jacobian.run(q)[0]) < rank,
            self._states(jacobian),
            "not_singular",
            "configurations_missing",
            turning_in(self.robot),
        )

    def _singular_verdict(self, given: Sequence[Sequence[Part]]) -> SetVerdict:
        """Whether a set is that of the singular configurations; none is right only where there is none."""
        found = self._singular.verdict(given)
        if found.is_right and self.singular.singular and not given:
            return SetVerdict(False, self._singular.missing, where=ANYWHERE)
        return found
