"""Equilibria, the balance of gravity, and the linearized equations of motion.

solving        where forces are 0
stability      how stable that is
numeric        all the zeros of an equation in numbers
multipliers    what constraints hold, and how the energy is curved along what they leave free
balance        conditions on the parameters for gravity to move nothing
linearization  the motion near an equilibrium; equilibria of steady motion
linear_check   that motion, by differences on numbers
forms          all of these as formulas
near           what `explain` says of the motion near equilibria
"""

from __future__ import annotations

from dynsolve.quantities import letters
from dynsolve.quantities.family import Family, Kind, of_robot
from dynsolve.quantities.stages import Stage
from dynsolve.robot.questions import Questions

EQUILIBRIA = Family(
    name="equilibria",
    called="the equilibria",
    stage=Stage.EQUILIBRIA,
    kind=Kind.EQUATIONS,
    spellings=("equilibrium",),
    terms=("equilibrium", "equilibrium points", "rest positions"),
)


BALANCE = Family(
    name="balance",
    called="the conditions for balance",
    stage=Stage.EQUILIBRIA,
    kind=Kind.CONDITIONS,
    spellings=("balanced", "balancing"),
)


LINEAR_A = Family(
    name="linear_A",
    called="the state matrix {} near the equilibrium",
    stage=Stage.EQUILIBRIA,
    shape=("any", "any"),
    letter=of_robot(letters.LINEAR_A),
    spellings=("A", "Alin"),
    needs="linearize",
    terms=("linearization", "linearisation", "state matrix", "linearize"),
)


LINEAR_B = Family(
    name="linear_B",
    called="the input matrix {} near the equilibrium",
    stage=Stage.EQUILIBRIA,
    shape=("any", "any"),
    letter=of_robot(letters.LINEAR_B),
    spellings=("B", "Blin"),
    needs="linearize",
    terms=("input matrix",),
)

FAMILIES: tuple[Family, ...] = tuple(record for record in vars().values() if isinstance(record, Family))
"""The records above, in their order."""


_PARTS = {
    "equilibria": "equilibria",
    "balance": "balance",
    "linear_A": "linearization",
    "linear_B": "linearization",
}
"""What is found, by what is asked for."""


def heading(questions: Questions) -> str:
    """What stands over it: what is asked of it."""
    asked = dict.fromkeys(part for name, part in _PARTS.items() if name in questions.asked)
    return " and ".join(asked).capitalize() or Stage.EQUILIBRIA.heading
