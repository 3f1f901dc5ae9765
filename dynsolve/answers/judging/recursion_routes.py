"""The way to a force from what the recursions give: the component along the joint's axis."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.answers.judging.answer_ring import AnswerRing
from dynsolve.answers.judging.route import Route
from dynsolve.derivation.recursion_rules import torque_rule
from dynsolve.quantities import families
from dynsolve.quantities.index import Quantity


def recursion_routes(answer_ring: AnswerRing, quantity: Quantity) -> Iterator[Route]:
    """The route to a force by the recursions, where an exercise asks for these."""
    if quantity.family is families.FORCE and "nl1" in answer_ring.rules:
        rule = torque_rule(answer_ring.robot, answer_ring.robot.coordinates[quantity.index[0] - 1])
        yield Route(rule.inputs, rule.compute)
