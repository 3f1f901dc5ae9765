"""What an exercise asks of the equations of motion beside the course's derivation.

`Questions.model` holds it, so that it goes wherever the robot goes.  Values are exact, in the
robot's ring.
"""

from __future__ import annotations

from dataclasses import dataclass

from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.matrix import Matrix
from dynsolve.notation.tree import Node


def reference(name: str) -> str:
    """The name of the reference of a coordinate, of which q̇_r and q̈_r are rates: q1r.

    >>> reference("theta1")
    'theta1r'
    """
    return f"{name}r"


@dataclass(frozen=True, slots=True)
class ModelQuestions:
    """What is asked of the model.

    `known` are the names of the parameters that do not count as unknown in τ = Y a.  `parameters`
    (p×1) are the entries of a where the exercise gives them, `named` the names that it gives them.
    `inputs_given` says that motors hold their coordinates in equilibria.  `linearize` is one of
    these: (name, 0, value) of the coordinates that are given.  `steady` are the coordinates whose rates
    are constant, with these.  `balanced` (n×1) is the g that parameters are to give, where it is not 0.
    `assumed` are inequalities between parameters, which count as positive besides.
    """

    known: frozenset[str] = frozenset()
    named: tuple[str, ...] = ()
    parameters: Matrix | None = None
    linearize: tuple[tuple[str, int, Node], ...] = ()
    inputs_given: bool = False
    balanced: Matrix | None = None
    steady: tuple[tuple[str, Node], ...] = ()
    assumed: tuple[Bound, ...] = ()

    @property
    def equilibrium(self) -> dict[tuple[str, int], Node]:
        """The values of the equilibrium by (name, number of dots)."""
        return {(name, dots): value for name, dots, value in self.linearize}


NO_MODEL_QUESTIONS = ModelQuestions()
"""Of an exercise that asks nothing of the model."""
