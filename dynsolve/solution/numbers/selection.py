"""Which results are shown in numbers, stage by stage."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import chain

from dynsolve.notation.tree import Node
from dynsolve.quantities import families as of
from dynsolve.quantities.family import Family, Kind
from dynsolve.quantities.index import Quantity, quantities
from dynsolve.quantities.robot_stages import stages_of
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Robot

Shown = tuple[str, Node]
"""The name of a result, and the letter it is shown by."""

_MAIN = (
    (of.H,), (of.JV,), (of.JW,), (of.P,), (of.K,), (of.L,), (of.FORCE,), (of.D,), (of.C,), (of.CQD,), (of.G,),
)  # fmt: skip
"""What an exercise asks for, of the frames the last one."""

_ALL = (
    (of.A,), (of.H,), (of.JV,), (of.JW,), (of.RC, of.R, of.I), (of.P_BODY,), (of.P,),
    (of.JV_BODY, of.JW_BODY, of.V, of.W, of.KV, of.KW, of.K_BODY), (of.K,), (of.L,),
    (of.DLDQD, of.DDT, of.DLDQ, of.FORCE), (of.D,), (of.C,), (of.CQD,), (of.G,),
)  # fmt: skip
"""What is shown of one body, or of one coordinate, before the next stands together."""


def main_results(robot: Robot) -> dict[Stage, list[Shown]]:
    """The results that an exercise asks for, by stage."""
    last = len(robot.joints)
    shown = (q for q in _members(robot, _MAIN) if q.family is not of.H or q.index == (last,))
    return _by_stage(robot, chain(shown, _asked(robot)))


def all_results(robot: Robot) -> dict[Stage, list[Shown]]:
    """Every result of the derivation, by stage; the tensor and the axes of a point mass say nothing."""
    known = quantities(robot)
    shown = (q for q in _members(robot, _ALL) if q.family not in (of.R, of.I) or known.is_real(q))
    return _by_stage(robot, chain(shown, _asked(robot)))


def _asked(robot: Robot) -> Iterator[Quantity]:
    """What only this exercise asks, as far as it has values."""
    asked = robot.questions.asked
    return (q for q in quantities(robot).values() if q.name in asked and q.family.kind is Kind.VALUE)


def _members(robot: Robot, groups: Sequence[tuple[Family, ...]]) -> Iterator[Quantity]:
    known = quantities(robot)
    for group in groups:
        for of_one in zip(*map(known.of_family, group), strict=True):
            yield from of_one


def _by_stage(robot: Robot, shown: Iterator[Quantity]) -> dict[Stage, list[Shown]]:
    found: dict[Stage, list[Shown]] = {}
    stages = stages_of(robot)
    for quantity in shown:
        stage = quantity.family.stage
        if stage in stages:
            found.setdefault(stage, []).append((quantity.rule, quantity.letter(robot)))
    return {stage: found[stage] for stage in Stage if stage in found}
