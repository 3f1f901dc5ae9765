"""Statics: forces from outside, and what holds them."""

from __future__ import annotations

from dynsolve.quantities import letters
from dynsolve.quantities.family import Family, Owner, of_robot
from dynsolve.quantities.stages import Stage
from dynsolve.robot.questions import Questions
from dynsolve.robot.units import ENERGY

LOAD = Family(
    name="load{i}",
    owner=Owner.LOAD,
    stage=Stage.STATICS,
    shape=("n", 1),
    letter=lambda robot, i: letters.of_load(i),
    dimension=ENERGY,
    per=("row",),
    unit="N m",
    is_answer=False,
)


Q = Family(
    name="Q",
    at_state=True,
    called="the generalized forces {} of what acts from outside",
    stage=Stage.STATICS,
    shape=("n", 1),
    letter=of_robot(letters.Q_FORCES),
    dimension=ENERGY,
    per=("row",),
    unit="N m",
    dimension_is_told=False,
    spellings=("Qext", "tauext"),
    terms=("external forces", "external torques"),
)


TAU_STATIC = Family(
    name="tau_static",
    at_state=True,
    called="the forces and torques {} that hold the arm at rest",
    stage=Stage.STATICS,
    shape=("n", 1),
    letter=of_robot(letters.TAU_STATIC),
    dimension=ENERGY,
    per=("row",),
    unit="N m",
    dimension_is_told=False,
    spellings=("taus", "taust", "tau0", "tau"),
    terms=("static torque", "static torques", "statics", "holding torques"),
)


Q_ENTRY = Family(
    name="Q{i}",
    at_state=True,
    called="the entry|entries {} of the generalized forces that act from outside",
    rule="Q",
    owner=Owner.COORDINATE,
    stage=Stage.STATICS,
    letter=lambda robot, i: letters.entry("Q", i),
    part_of="Q",
)


TAU_STATIC_ENTRY = Family(
    name="tau_static{i}",
    at_state=True,
    called="the entry|entries {} of the forces and torques that hold the arm at rest",
    rule="tau_static",
    owner=Owner.COORDINATE,
    stage=Stage.STATICS,
    letter=letters.static_torque,
    spellings=("taus{i}", "tau{i}", "tau{q}", "{force}"),
    part_of="tau_static",
)

FAMILIES: tuple[Family, ...] = tuple(record for record in vars().values() if isinstance(record, Family))
"""The records above, in their order."""


def heading(questions: Questions) -> str:
    """What stands over it: not all that act from outside are asked to be held."""
    is_held = any(name.startswith("tau_static") for name in questions.asked)
    return Stage.STATICS.heading if is_held else "Forces from outside"
