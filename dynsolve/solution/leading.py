"""The steps that lead to what is asked: a section on which nothing asked depends is left to `full`."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence

from dynsolve.derivation.rules import course_rules
from dynsolve.explain.step import Detail, Step
from dynsolve.explain.terms import ID
from dynsolve.notation.tree import Node, walk
from dynsolve.quantities import letters
from dynsolve.quantities.index import quantities
from dynsolve.quantities.stages import Stage
from dynsolve.robot.questions import Method
from dynsolve.solution.dynamics import Dynamics

_MODEL = {"D", "C", "g"}
"""With these the equations of motion are told in matrices; the forces of long models are told by them."""

_WHOLE_WITH = {
    Stage.JACOBIAN: {"K"},
    Stage.INERTIA: {"K"},
    Stage.ENERGY: {"K", "P"},
    Stage.VECTORIZED: _MODEL,
}
"""Stages that are told as a whole where all of this is wanted; else only the steps that lead on are."""


_OF_ENERGIES = {"D": ("K",)}
"""What is derived from the energies where the forces are not asked for."""


def needs_forces(solution: Dynamics, steps: Sequence[Step]) -> bool:
    """Whether something that is asked for is derived from the forces, though 𝐃 is read off from 𝒦."""
    robot, asked, named = solution.robot, _asked(solution), _named(steps)
    is_course = robot.questions.method is Method.LAGRANGE and robot.given is None
    if not is_course or asked.isdisjoint(named):
        return True
    forces = {"L", "tau", *(f"tau{q.index}" for q in robot.coordinates)}
    return not forces.isdisjoint(_closure(asked, named, {**_inputs(solution), **_OF_ENERGIES}, _OF_ENERGIES))


def _named(steps: Sequence[Step]) -> dict[str, Step]:
    """The steps by their ids and all that they give."""
    return {name: step for step in steps for name in (step.id, *step.also)}


def _asked(solution: Dynamics) -> set[str]:
    """The rules of what is asked for; with the whole model the friction that stands in it."""
    asked = {_rule(solution, name) for name in solution.problem.find}
    return asked.union(solution.robot.actions.resistance) if asked >= _MODEL else asked


def _inputs(solution: Dynamics) -> dict[str, Sequence[str]]:
    """What each quantity is computed from by its rule."""
    return {
        rule.name: rule.inputs for rule in (*solution.values.rules.values(), *course_rules(solution.robot))
    }


def leading(solution: Dynamics, steps: Sequence[Step]) -> tuple[Step, ...]:
    """Those of a solution's steps that are asked for, or that such steps are derived from."""
    asked = _asked(solution)
    if "tau" in asked:
        forces = {f"tau{q.index}" for q in solution.robot.coordinates}
        told = walk(*(node for step in steps if step.id in forces for node in step.result))
        asked |= forces if _entries_of_D(solution).isdisjoint(told) else forces | _MODEL
        weighs = "g" not in solution.values.rules or not solution.values["g"].is_zero
        if asked >= _MODEL - {"g"} and not weighs:  # they are the whole model
            asked |= _MODEL
    named, inputs = _named(steps), _inputs(solution)
    if asked.isdisjoint(named):
        return tuple(steps)
    has_rates = "Cqd" in solution.values.rules and not solution.values["Cqd"].is_zero
    wanted, kept = set[str](), tuple[Step, ...]()
    while True:
        ids = {*asked, *(step.id for step in kept)}
        found = set(_closure(ids, named, inputs, has_rates=has_rates))
        if found == wanted:
            return tuple(step for step in kept if step.id != ID or asked >= _MODEL)
        wanted = found
        kept = tuple(_kept(steps, wanted, named.keys() | inputs.keys()))


def _entries_of_D(solution: Dynamics) -> set[Node]:
    """What the forces of long models are written in."""
    places = range(1, solution.robot.n + 1)
    return {letters.entry("d", i, j) for i in places for j in places}


def _rule(solution: Dynamics, name: str) -> str:
    """The rule that computes an answer; of what has none, the answer itself."""
    found = quantities(solution.robot).get(name)
    return name if found is None or not found.rule else found.rule


def _closure(
    names: Iterable[str],
    named: Mapping[str, Step],
    inputs: Mapping[str, Sequence[str]],
    by_rule: Collection[str] = (),
    *,
    has_rates: bool = False,
) -> Iterator[str]:
    """Names and all that they are derived from, by their steps or, without steps, by their rules.

    Those of `by_rule` are derived by their rules alone.
    """
    seen, waiting = set[str](), list(names)
    while waiting:
        name = waiting.pop().partition("#")[0]
        if name not in seen:
            seen.add(name)
            yield name
            step = None if name in by_rule else named.get(name)
            uses = inputs.get(name, ()) if step is None or step.uses is None else step.uses
            waiting += (*uses, *(() if step is None else (step.id, *step.also)))
            if name == "Cqd" and step is not None and step.detail is Detail.FULL and has_rates:
                waiting.append("C")  # which tells it where the rows of 𝐂 𝐪̇ are not shown


def _kept(steps: Sequence[Step], wanted: set[str], known: Iterable[str]) -> Iterator[Step]:
    """The steps of the questions and of the kinematics; of other stages those that something needs."""
    known = set(known)
    stages = {step.stage for step in steps if step.id in wanted}
    for step in steps:
        parts = _WHOLE_WITH.get(step.stage, set()) & known
        is_whole = step.stage in stages and parts <= wanted
        if step.stage is Stage.KINEMATICS or step.stage.asked_for or is_whole or step.id in wanted:
            yield step
