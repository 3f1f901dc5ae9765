"""Verdicts on equilibria: sets of equations, held in numbers against gravity and springs.

At every point of the key's set the student's must hold, and at every point of the student's
nothing may move.  An angle counts modulo 2π where the forces have that period in it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from math import pi

from dynsolve.answers.judging.example_point import example_point
from dynsolve.answers.judging.held_equations import held_equations
from dynsolve.answers.judging.set_verdict import RIGHT, SetVerdict
from dynsolve.answers.submission import Part
from dynsolve.derivation.configuration_check import is_zero, with_half_turns, zero_near
from dynsolve.derivation.equilibrium_check import starts
from dynsolve.derivation.reached import CLOSE
from dynsolve.notation.tree import Node
from dynsolve.notation.tree_values import compile_trees
from dynsolve.robot.model import JointType, Robot

_TURNS = 3
"""So many whole turns either way are looked at."""


class EquilibriumKey:
    """Equilibria: the forces that must be 0, the alternatives, and the numbers that the problem gives."""

    def __init__(
        self,
        robot: Robot,
        forces: Sequence[Node],
        alternatives: Sequence[Sequence[Node]],
        numbers: Mapping[str, float],
    ) -> None:
        self.robot, self.alternatives, self.numbers = robot, alternatives, numbers
        self.forces, self._forces = forces, compile_trees(forces)

    def verdict(self, given: Sequence[Sequence[Part]]) -> SetVerdict:
        """Whether a set is that of the key."""
        names = [q.name for q in self.robot.coordinates]
        theirs = [held_equations((part.node for part in one), names, self._periodic) for one in given]
        formulas = [*self.forces, *(part.node for one in given for part in one)]
        for number, one in enumerate(given, 1):
            points = list(self._points(tuple(part.node for part in one)))
            if not points:
                return SetVerdict(False, "condition_never_holds", number)
            if not all(map(self._is_balanced, points)):
                holds = theirs[number - 1].hold
                where = example_point(self.robot, formulas, points, holds, self._is_balanced)
                return SetVerdict(False, "no_equilibrium", number, where=where)

        def is_met(q: Mapping[str, float]) -> bool:
            return any(one.hold(turned) for turned in self._turned(q) for one in theirs)

        all_points = [q for conditions in self.alternatives for q in self._points(tuple(conditions))]
        missed = [q for q in all_points if not is_met(q)]
        if not missed:
            return RIGHT
        shown = missed if given else []
        where = example_point(self.robot, formulas, shown, self._is_balanced, is_met)
        return SetVerdict(False, "equilibria_missing", where=where)

    def _is_balanced(self, q: Mapping[str, float]) -> bool:
        return is_zero(self._forces, q)

    def _points(self, conditions: tuple[Node, ...]) -> Iterator[dict[str, float]]:
        """Configurations at which everything is 0; any at all where there is no condition."""
        program = compile_trees(list(conditions))
        begun = starts(self.robot, self.numbers)
        found = (zero_near(self.robot, program, start) if conditions else start for start in begun)
        return with_half_turns(self.robot, program, (q for q in found if q is not None))

    def _turned(self, q: Mapping[str, float]) -> Iterator[Mapping[str, float]]:
        """The configuration, and those that are the same by whole turns of angles that turn together."""
        yield q
        for turns in range(-_TURNS, _TURNS + 1) if self._together else ():
            yield {**q} | {name: q[name] + 2 * pi * turns for name in self._together}

    @property
    def _turning(self) -> tuple[str, ...]:
        return tuple(q.name for q in self.robot.coordinates if q.type is JointType.REVOLUTE)

    @cached_property
    def _periodic(self) -> frozenset[str]:
        """The angles in which the forces have the period 2π."""
        return frozenset(name for name in self._turning if self._have_period([name]))

    @cached_property
    def _together(self) -> tuple[str, ...]:
        """The other angles, where the forces have that period in all together, as with springs between."""
        others = tuple(name for name in self._turning if name not in self._periodic)
        return others if others and self._have_period(others) else ()

    def _have_period(self, names: Sequence[str]) -> bool:
        """Whether the forces are the same after a turn of these angles."""
        at = next(starts(self.robot, self.numbers))
        turned = {**at, **{name: at[name] + 2 * pi for name in names}}
        pairs = zip(self._forces.run(at), self._forces.run(turned), strict=True)
        return all(abs(a - b) < CLOSE for a, b in pairs)
