"""The families of the Euler-Lagrange equations: the derivatives of L, and the generalized forces.

The families of the energies: those of the bodies, what they add up to, and the Lagrangian.

The families of the vectorized form: D, the Christoffel symbols, C, g, and their entries.
"""

from __future__ import annotations

from dynsolve.notation.tree import Node, Product, Symbol
from dynsolve.quantities import letters
from dynsolve.quantities.families.bodies import ANGULAR, LINEAR
from dynsolve.quantities.family import Family, Owner, of_body, of_coordinate, of_robot
from dynsolve.quantities.letters import each
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Coordinate
from dynsolve.robot.units import ENERGY, INERTIA, MOMENTUM


def _momentum(q: Coordinate) -> Node:
    return letters.partial_derivative(letters.L, letters.velocity(q))


DLDQD = Family(
    name="dLdqd{i}",
    called="the derivative|derivatives {} of the Lagrangian",
    owner=Owner.COORDINATE,
    stage=Stage.TORQUE,
    capped_in=Stage.LAGRANGIAN,
    letter=of_coordinate(_momentum),
    json="dL_dqdot",
    dimension=MOMENTUM,
    per=("owner",),
    spellings=("dLdqdot{i}", "dLd{name}dot"),
)

DDT = Family(
    name="ddt{i}",
    called="the derivative|derivatives {} with respect to time",
    owner=Owner.COORDINATE,
    stage=Stage.TORQUE,
    capped_in=Stage.LAGRANGIAN,
    letter=of_coordinate(lambda q: letters.time_derivative(_momentum(q))),
    json="ddt",
    dimension=ENERGY,
    per=("owner",),
    unit="N m",
    spellings=("ddtdLdqd{i}",),
)

DLDQ = Family(
    name="dLdq{i}",
    called="the derivative|derivatives {} of the Lagrangian",
    owner=Owner.COORDINATE,
    stage=Stage.TORQUE,
    capped_in=Stage.LAGRANGIAN,
    letter=of_coordinate(lambda q: letters.partial_derivative(letters.L, Symbol(q.name))),
    json="dL_dq",
    dimension=ENERGY,
    per=("owner",),
    unit="N m",
    spellings=("dLd{name}",),
)

FORCE = Family(
    name="{force}",
    called="the generalized force|forces {}",
    rule="tau{i}",
    owner=Owner.COORDINATE,
    stage=Stage.TORQUE,
    letter=of_coordinate(letters.force),
    json="force",
    dimension=ENERGY,
    per=("owner",),
    unit="N m",
    spellings=(*each("tau f F Q", "{i}"), *each("tau f F", "{q}")),
    fallback_spellings=("tau{s}", "f{s}"),
    aliases=("tau{i}", "f{i}"),
    part_of="tau",
)

TAU = Family(
    name="tau",
    called="the generalized forces",
    stage=Stage.TORQUE,
    shape=("n", 1),
    letter=of_robot(letters.TAU),
    json="tau",
    dimension=ENERGY,
    per=("row",),
    unit="N m",
    spellings=("tauvec",),
    terms=("torque", "joint torque", "force", "generalized force", "equations of motion", "eom", "dynamics"),
)

FAMILIES: tuple[Family, ...] = (DLDQD, DDT, DLDQ, FORCE, TAU)
"""The records above, in their order."""


# The families of the energies: those of the bodies, what they add up to, and the Lagrangian

_KINETIC = "K Ek T E"
"""What stands before the name of a velocity in that of the energy that belongs to it."""

_POTENTIAL, _IN_ALL = "E W U V P", "tot total ges gesamt"

P_BODY = Family(
    name="P{b}",
    called="the potential energy|energies {} of the body|bodies",
    owner=Owner.BODY,
    stage=Stage.ENERGY,
    letter=of_body(lambda body: letters.of_body("P", body)),
    json="P",
    dimension=ENERGY,
    unit="J",
    spellings=(*each("U Ep PE V Wp", "{b}"), *each(_POTENTIAL, "pot", "{b}"), *each("E W", "{b}", "pot p")),
    part_of="P",
)

KV = Family(
    name="Kv{b}",
    called="the kinetic energy|energies {} of translation",
    owner=Owner.BODY,
    stage=Stage.ENERGY,
    letter=of_body(lambda body: letters.energy_part("v", body)),
    json="Kv",
    dimension=ENERGY,
    unit="J",
    spellings=(*each(_KINETIC, LINEAR), *each("K T E", "{b}", "v"), *each("Klin Ktrans Kt KT KL Kl", "{b}")),
    part_of="K{b}",
)

KW = Family(
    name="Kw{b}",
    called="the kinetic energy|energies {} of rotation",
    owner=Owner.BODY,
    stage=Stage.ENERGY,
    letter=of_body(lambda body: letters.energy_part("omega", body)),
    json="Kw",
    dimension=ENERGY,
    unit="J",
    spellings=(*each(_KINETIC, ANGULAR), *each("K T E", "{b}", "omega w"), *each("Krot Kr KR", "{b}")),
    part_of="K{b}",
    needs_rotation=True,
)

K_BODY = Family(
    name="K{b}",
    called="the kinetic energy|energies {} of the body|bodies",
    owner=Owner.BODY,
    stage=Stage.ENERGY,
    letter=of_body(lambda body: letters.of_body("K", body)),
    json="K",
    dimension=ENERGY,
    unit="J",
    spellings=(*each("T Ek KE Wk", "{b}"), *each("E W T K", "kin", "{b}"), *each("E W", "{b}", "kin k")),
    part_of="K",
)

P = Family(
    name="P",
    called="the potential energy",
    stage=Stage.ENERGY,
    letter=of_robot(letters.P),
    json="P",
    dimension=ENERGY,
    unit="J",
    spellings=(
        *("U", "Ep", "PE", "V", "Wp", "EP", "Etp", "Epottot", "Epotges", "Wpotges"),
        *each(_POTENTIAL, "pot potential potentiell potensiell"),
        *each("P U V", _IN_ALL),
    ),
    terms=("potential", "potential energy", "potential energies"),
)

K = Family(
    name="K",
    called="the kinetic energy",
    stage=Stage.ENERGY,
    letter=of_robot(letters.K),
    json="K",
    dimension=ENERGY,
    unit="J",
    spellings=(
        *("T", "Ek", "KE", "Wk", "EK", "Ekintot", "Ekinges", "Wkinges"),
        *each("E W K T", "kin kinetic kinetisch kinetisk"),
        *each("K T", _IN_ALL),
    ),
    terms=("kinetic", "kinetic energy", "kinetic energies"),
)

L = Family(
    name="L",
    called="the Lagrangian",
    stage=Stage.LAGRANGIAN,
    letter=of_robot(letters.L),
    json="L",
    dimension=ENERGY,
    unit="J",
    spellings=("Lagrangian",),
    terms=("lagrange", "lagrangian", "lagrange function"),
)

OF_BODIES: tuple[Family, ...] = (P_BODY, KV, KW, K_BODY)
OF_ROBOT: tuple[Family, ...] = (P, K, L)
"""The records above; what springs and rotors add stands between them in the derivation."""


# The families of the vectorized form: D, the Christoffel symbols, C, g, and their entries

D = Family(
    name="D",
    called="the inertia matrix",
    stage=Stage.VECTORIZED,
    shape=("n", "n"),
    letter=of_robot(letters.D),
    json="D",
    dimension=INERTIA,
    per=("row", "column"),
    spellings=("M", "B", "Dq", "Mq"),
    aliases=("M", "B"),
    terms=("inertia matrix", "mass matrix", "inertia"),
)

D_ENTRY = Family(
    name="d{i}{j}",
    called="the entry|entries {} of the inertia matrix",
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
    called="the Christoffel symbol|symbols {}",
    rule="christoffel",
    owner=Owner.TRIPLE,
    stage=Stage.VECTORIZED,
    letter=lambda robot, i, j, k: letters.entry("c", i, j, k),
    spellings=each("C Gamma", "{i}{j}{k}"),
    aliases=("C{i}{j}{k}",),
    part_of="christoffel",
    terms=("christoffel", "christoffel symbols"),
)

C = Family(
    name="C",
    called="the matrix of Coriolis and centrifugal terms",
    stage=Stage.VECTORIZED,
    shape=("n", "n"),
    letter=of_robot(letters.C),
    json="C",
    dimension=MOMENTUM,
    per=("row", "column"),
    dimension_is_told=False,
    spellings=("S",),
    terms=("coriolis", "coriolis matrix", "centrifugal", "coriolis and centrifugal"),
)

C_ENTRY = Family(
    name="C{i}{j}",
    called="the entry|entries {} of the matrix of Coriolis and centrifugal terms",
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
    called="the gravity terms",
    stage=Stage.VECTORIZED,
    shape=("n", 1),
    letter=of_robot(letters.G),
    json="g",
    dimension=ENERGY,
    per=("row",),
    unit="N m",
    spellings=("G", "phi", "gvec"),
    aliases=("G",),
    terms=("gravity", "gravity vector", "gravitational", "gravity terms", "gravity torques"),
)

G_ENTRY = Family(
    name="g{i}",
    called="the entry|entries {} of the gravity terms",
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
    called="the vector {} of Coriolis and centrifugal terms",
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

VECTORIZED_FAMILIES: tuple[Family, ...] = (
    D, D_ENTRY, CHRISTOFFEL, C_SYMBOL, C, C_ENTRY, G, G_ENTRY, CQD, G_DIRECT, D_DIRECT,
)  # fmt: skip
"""The records above, in their order."""
