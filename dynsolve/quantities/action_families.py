"""The families of what acts beside gravity: stored energy, rotors, friction; see `quantities.families`."""

from __future__ import annotations

from dynsolve.quantities import letters
from dynsolve.quantities.family import Family, Owner, of_robot
from dynsolve.quantities.stages import Stage
from dynsolve.robot.units import ENERGY

PS = Family(
    name="Ps",
    called="the potential energy of the springs",
    stage=Stage.ENERGY,
    letter=of_robot(letters.PS),
    json="Ps",
    dimension=ENERGY,
    unit="J",
    spellings=("Us", "Vs", "Pel", "Pspring", "Uel", "Uspring", "Pe", "Ue"),
    brought_by="Ps",
    part_of="P",
)

KM = Family(
    name="Km",
    called="the kinetic energy of the rotors",
    stage=Stage.ENERGY,
    letter=of_robot(letters.KM),
    json="Km",
    dimension=ENERGY,
    unit="J",
    spellings=("Tm", "Kmotor", "Kmot", "Krotor", "Tmotor"),
    brought_by="Km",
    part_of="K",
)

FRICTION = Family(
    name="friction",
    called="the friction",
    stage=Stage.TORQUE,
    shape=("n", 1),
    letter=of_robot(letters.FRICTION),
    json="friction",
    dimension=ENERGY,
    per=("row",),
    unit="N m",
    spellings=("tauf", "tauF", "taufric", "taufriction", "F", "Ff", "fric", "Fqd", "Fvqd"),
    brought_by="friction",
    terms=("friction force", "friction torque", "damping", "dissipation"),
)

FRICTION_ENTRY = Family(
    name="friction{i}",
    called="the entry|entries {} of the friction",
    owner=Owner.COORDINATE,
    rule="friction",
    stage=Stage.TORQUE,
    letter=lambda robot, i: letters.friction(i),
    dimension=ENERGY,
    per=("owner",),
    unit="N m",
    spellings=("tauf{i}", "tauF{i}", "Ff{i}", "fric{i}"),
    brought_by="friction",
    part_of="friction",
)

# -- read by no answer: how the derivation adds them up --------------------------------------------

DM = Family(name="Dm", stage=Stage.VECTORIZED, shape=("n", "n"), is_answer=False, brought_by="Km")
"""What the rotors add to D."""

OF_ENERGY: tuple[Family, ...] = (PS, KM)
OF_TORQUE: tuple[Family, ...] = (FRICTION, FRICTION_ENTRY)
OF_THE_MODEL: tuple[Family, ...] = (DM,)
"""The records above, by their place in the derivation."""
