"""Singular configurations as they are printed: the rank there, and at samples.

Where an alternative holds, found by Newton's method from samples, the Jacobian has less than its greatest
rank; at the samples it has that rank.
"""

from __future__ import annotations

from collections.abc import Sequence
from operator import mul

from msgspec import Struct

from dynsolve.derivation.configurations import flat, rank_of, states_of, zero_near
from dynsolve.derivation.reached import CLOSE
from dynsolve.errors import VerificationError
from dynsolve.notation.tree import Node
from dynsolve.notation.tree_values import compile_trees
from dynsolve.questions.held import Held
from dynsolve.questions.singular.forms import SingularForms
from dynsolve.robot.model import Robot


class Singular(Struct, frozen=True):
    """Expressions that are 0 together, the rank there, and the directions that are lost, m×1 each."""

    zeros: Sequence[Node]
    rank: int
    lost: Sequence[Node]


def verify_singular(robot: Robot, jacobian: Node, rank: int, cases: Sequence[Singular]) -> None:
    """Compare the rank of a Jacobian at singular and at other configurations.

    Raises VerificationError where it is not what it should be, or a lost direction is none.
    """
    program = compile_trees([jacobian])
    states = states_of(robot, program)
    for values in states:
        if rank_of(program.run(values)[0]) != rank:
            raise VerificationError("the rank of the Jacobian is not what it should be")
    for case in cases:
        zeros, lost = compile_trees(case.zeros), compile_trees(case.lost)
        found = (zero_near(robot, zeros, values) for values in states)
        ranks: list[int] = []
        for at in (values for values in found if values is not None):
            J = program.run(at)[0]
            ranks.append(rank_of(J))
            columns = list(zip(*J, strict=True))
            if any(abs(sum(map(mul, flat(w), column))) > CLOSE for w in lost.run(at) for column in columns):
                raise VerificationError("a direction that should be lost is not")
        if ranks and max(ranks) != case.rank:  # it is less where an alternative meets itself or another
            raise VerificationError("the rank at a singular configuration is not what it should be")


def verify(held: Held) -> None:
    """Hold the results as they are printed; raises VerificationError where one is wrong."""
    shown = SingularForms(held.robot, held.values)
    found = shown.singular_set if "singular" in held.wanted else None
    if found is not None:
        (jacobian,) = held.values.rules["singular"].inputs
        ranks = [loss.rank for loss in found.losses]
        cases = [Singular(*case) for case in zip(shown.singular, ranks, shown.lost, strict=True)]
        verify_singular(held.robot, held.forms(jacobian), found.rank, cases)
