"""The families of the energies: those of the bodies, what they add up to, and the Lagrangian."""

from __future__ import annotations

from dynsolve.quantities import letters
from dynsolve.quantities.families.bodies import ANGULAR, LINEAR
from dynsolve.quantities.family import Family, Owner, of_body, of_robot
from dynsolve.quantities.spelling import each
from dynsolve.quantities.stages import Stage
from dynsolve.robot.units import ENERGY

_KINETIC = "K Ek T E"
"""What stands before the name of a velocity in that of the energy that belongs to it."""

_POTENTIAL, _IN_ALL = "E W U V P", "tot total ges gesamt"

P_BODY = Family(
    name="P{b}",
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
)

K = Family(
    name="K",
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
)

L = Family(
    name="L",
    stage=Stage.LAGRANGIAN,
    letter=of_robot(letters.L),
    json="L",
    dimension=ENERGY,
    unit="J",
    spellings=("Lagrangian",),
)

OF_BODIES: tuple[Family, ...] = (P_BODY, KV, KW, K_BODY)
OF_ROBOT: tuple[Family, ...] = (P, K, L)
"""The records above; what springs and rotors add stands between them in the derivation."""
