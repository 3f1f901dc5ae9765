"""The equations of motion, linear in the parameters: τ = Y a."""

from __future__ import annotations

from dynsolve.quantities import letters
from dynsolve.quantities.family import Family, of_robot
from dynsolve.quantities.stages import Stage

A = Family(
    name="a",
    called="the dynamic parameters",
    stage=Stage.PARAMETERS,
    shape=("any", 1),
    letter=of_robot(letters.PARAMETERS),
    spellings=("pi", "avec"),
    terms=("parameters", "dynamic parameters", "base parameters"),
)


Y = Family(
    name="Y",
    called="the regressor",
    stage=Stage.PARAMETERS,
    shape=("n", "any"),
    letter=of_robot(letters.REGRESSOR),
    spellings=("W",),
    terms=("regressor", "regressor matrix"),
)


A_INERTIA = Family(
    name="aM",
    called="the parameters {} of the inertia terms",
    stage=Stage.PARAMETERS,
    shape=("any", 1),
    letter=of_robot(letters.of_part("a", "M")),
)


Y_INERTIA = Family(
    name="YM",
    called="the regressor {} of the inertia terms",
    stage=Stage.PARAMETERS,
    shape=("n", "any"),
    letter=of_robot(letters.of_part("Y", "M")),
)


A_GRAVITY = Family(
    name="ag",
    called="the parameters {} of the gravity terms",
    stage=Stage.PARAMETERS,
    shape=("any", 1),
    letter=of_robot(letters.of_part("a", "g")),
)


Y_GRAVITY = Family(
    name="Yg",
    called="the regressor {} of the gravity terms",
    stage=Stage.PARAMETERS,
    shape=("n", "any"),
    letter=of_robot(letters.of_part("Y", "g")),
)


Y_REFERENCE = Family(
    name="Yr",
    called="the regressor {} with reference rates and accelerations",
    stage=Stage.PARAMETERS,
    shape=("n", "any"),
    letter=of_robot(letters.of_part("Y", "r")),
    needs="references",
)


PARAMETERS = {Y.name: A.name, Y_INERTIA.name: A_INERTIA.name, Y_GRAVITY.name: A_GRAVITY.name}
"""The parameters that each regressor belongs to, by name."""


REFERENCE = Y_REFERENCE.name
"""The regressor with reference rates, which belongs to the parameters of all forces."""


REGRESSORS = {a: Y for Y, a in PARAMETERS.items()}
"""The regressor that each column of parameters belongs to, by name."""

FAMILIES: tuple[Family, ...] = tuple(record for record in vars().values() if isinstance(record, Family))
"""The records above, in their order."""
