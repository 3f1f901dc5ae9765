"""The families of what an exercise asks of the equations of motion: Y and a, A and B, q̈, Λ.

A robot has those of a stage of which something is asked (`quantities.stages`).  To add one,
see `quantities.families`; its rule stands in `dynsolve.derivation.model_rules`.
"""

from __future__ import annotations

from dynsolve.quantities import letters
from dynsolve.quantities.family import Family, Kind, of_robot
from dynsolve.quantities.stages import Stage

# -- linear in the parameters ----------------------------------------------------------------------

A = Family(
    name="a",
    stage=Stage.PARAMETERS,
    shape=("any", 1),
    letter=of_robot(letters.PARAMETERS),
    spellings=("pi", "avec"),
)

Y = Family(
    name="Y",
    stage=Stage.PARAMETERS,
    shape=("n", "any"),
    letter=of_robot(letters.REGRESSOR),
    spellings=("W",),
)

A_INERTIA = Family(
    name="aM", stage=Stage.PARAMETERS, shape=("any", 1), letter=of_robot(letters.of_part("a", "M"))
)

Y_INERTIA = Family(
    name="YM", stage=Stage.PARAMETERS, shape=("n", "any"), letter=of_robot(letters.of_part("Y", "M"))
)

A_GRAVITY = Family(
    name="ag", stage=Stage.PARAMETERS, shape=("any", 1), letter=of_robot(letters.of_part("a", "g"))
)

Y_GRAVITY = Family(
    name="Yg", stage=Stage.PARAMETERS, shape=("n", "any"), letter=of_robot(letters.of_part("Y", "g"))
)

Y_REFERENCE = Family(
    name="Yr", stage=Stage.PARAMETERS, shape=("n", "any"), letter=of_robot(letters.of_part("Y", "r"))
)

# -- near an equilibrium ---------------------------------------------------------------------------

EQUILIBRIA = Family(
    name="equilibria", stage=Stage.EQUILIBRIA, kind=Kind.EQUATIONS, spellings=("equilibrium",)
)

BALANCE = Family(
    name="balance", stage=Stage.EQUILIBRIA, kind=Kind.CONDITIONS, spellings=("balanced", "balancing")
)

LINEAR_A = Family(
    name="linear_A",
    stage=Stage.EQUILIBRIA,
    shape=("any", "any"),
    letter=of_robot(letters.LINEAR_A),
    spellings=("A", "Alin"),
)

LINEAR_B = Family(
    name="linear_B",
    stage=Stage.EQUILIBRIA,
    shape=("any", "any"),
    letter=of_robot(letters.LINEAR_B),
    spellings=("B", "Blin"),
)

# -- from the forces -------------------------------------------------------------------------------

QDD_FORWARD = Family(
    name="qdd_forward",
    stage=Stage.FORWARD_DYNAMICS,
    shape=("n", 1),
    letter=of_robot(letters.QDD),
    spellings=("forwarddynamics", "qddforward", "qdd", "qddot", "ddq"),
)

# -- at the task -----------------------------------------------------------------------------------

LAMBDA = Family(
    name="Lambda",
    stage=Stage.TASK_INERTIA,
    shape=("m", "m"),
    letter=of_robot(letters.TASK_INERTIA),
    spellings=("Mr", "Dr", "Mp"),
)

PARAMETERS = {Y.name: A.name, Y_INERTIA.name: A_INERTIA.name, Y_GRAVITY.name: A_GRAVITY.name}
"""The parameters that each regressor belongs to, by name."""

REFERENCE = Y_REFERENCE.name
"""The regressor with reference rates, which belongs to the parameters of all forces."""

REGRESSORS = {a: Y for Y, a in PARAMETERS.items()}
"""The regressor that each column of parameters belongs to, by name."""

FAMILIES: tuple[Family, ...] = tuple(record for record in vars().values() if isinstance(record, Family))
"""The records above, in their order."""
