"""The families of the vectorized form: D, the Christoffel symbols, C, g, and their entries."""

from __future__ import annotations

from dynsolve.notation.tree import Product
from dynsolve.quantities import letters
from dynsolve.quantities.family import Family, Owner, of_robot
from dynsolve.quantities.spelling import each
from dynsolve.quantities.stages import Stage
from dynsolve.robot.units import ENERGY, INERTIA, MOMENTUM

D = Family(
    name="D",
    stage=Stage.VECTORIZED,
    shape=("n", "n"),
    letter=of_robot(letters.D),
    json="D",
    dimension=INERTIA,
    per=("row", "column"),
    spellings=("M", "B", "Dq", "Mq"),
    aliases=("M", "B"),
)

D_ENTRY = Family(
    name="d{i}{j}",
    rule="D",
    owner=Owner.PAIR,
    stage=Stage.VECTORIZED,
    letter=lambda robot, i, j: letters.entry("d", i, j),
    spellings=each("D m M b B", "{i}{j}"),
    aliases=each("D m M b B", "{i}{j}"),
    part_of="D",
    is_symmetric_entry=True,
)

CHRISTOFFEL = Family(name="christoffel", stage=Stage.VECTORIZED, is_answer=False)

C_SYMBOL = Family(
    name="c{i}{j}{k}",
    rule="christoffel",
    owner=Owner.TRIPLE,
    stage=Stage.VECTORIZED,
    letter=lambda robot, i, j, k: letters.entry("c", i, j, k),
    spellings=each("C Gamma", "{i}{j}{k}"),
    aliases=("C{i}{j}{k}",),
    part_of="christoffel",
)

C = Family(
    name="C",
    stage=Stage.VECTORIZED,
    shape=("n", "n"),
    letter=of_robot(letters.C),
    json="C",
    dimension=MOMENTUM,
    per=("row", "column"),
    dimension_is_told=False,
    spellings=("S",),
)

C_ENTRY = Family(
    name="C{i}{j}",
    rule="C",
    owner=Owner.PAIR,
    stage=Stage.VECTORIZED,
    letter=lambda robot, i, j: letters.entry("c", i, j),
    spellings=("c{i}{j}",),
    aliases=("c{i}{j}",),
    part_of="C",
)

G = Family(
    name="g",
    stage=Stage.VECTORIZED,
    shape=("n", 1),
    letter=of_robot(letters.G),
    json="g",
    dimension=ENERGY,
    per=("row",),
    unit="N m",
    spellings=("G", "phi", "gvec"),
    aliases=("G",),
)

G_ENTRY = Family(
    name="g{i}",
    rule="g",
    owner=Owner.COORDINATE,
    stage=Stage.VECTORIZED,
    letter=lambda robot, i: letters.entry("g", i),
    spellings=("G{i}", "phi{i}", "Phi{i}"),
    aliases=("phi{i}", "G{i}"),
    part_of="g",
)

CQD = Family(
    name="Cqd",
    stage=Stage.VECTORIZED,
    shape=("n", 1),
    letter=of_robot(Product((letters.C, letters.QD))),
    dimension=ENERGY,
    per=("row",),
    unit="N m",
    spellings=("c", "V", "Cqdot", "h", "C", "n", "N"),
    aliases=("c", "V"),
)

# -- the same, assembled directly ------------------------------------------------------------------

G_DIRECT = Family(
    name="g_direct",
    stage=Stage.VECTORIZED,
    shape=("n", 1),
    dimension=ENERGY,
    per=("row",),
    unit="N m",
    is_answer=False,
)

D_DIRECT = Family(
    name="D_direct",
    stage=Stage.VECTORIZED,
    shape=("n", "n"),
    dimension=INERTIA,
    per=("row", "column"),
    is_answer=False,
)

FAMILIES: tuple[Family, ...] = (
    D, D_ENTRY, CHRISTOFFEL, C_SYMBOL, C, C_ENTRY, G, G_ENTRY, CQD, G_DIRECT, D_DIRECT,
)  # fmt: skip
"""The records above, in their order."""
