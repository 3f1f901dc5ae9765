"""The Newton-Euler recursions, in the links' frames; `recursions` has them in values, `terms` in letters."""

from __future__ import annotations

from dynsolve.quantities import letters
from dynsolve.quantities.family import Family, Owner, of_body
from dynsolve.quantities.stages import Stage
from dynsolve.robot.units import ACCELERATION, ENERGY, FORCE, PER_SECOND, Dimension, times


def _of_link(
    stem: str, called: str, base: str, dimension: Dimension, dots: int = 0, *spellings: str, unit: str = ""
) -> Family:
    return Family(
        name=f"{stem}{{i}}",
        called=called,
        owner=Owner.ROW,
        stage=Stage.NEWTON_EULER,
        shape=(3, 1),
        letter=lambda robot, i: letters.in_link(base, i, dots),
        dimension=dimension,
        unit=unit,
        spellings=spellings,
    )


WL = _of_link(
    "wl",
    "the angular velocity|velocities {} of the link|links",
    "omega",
    PER_SECOND,
    0,
    "omega{i}",
    "w{i}",
    unit="rad/s",
)
"""ω_i of frame i."""


WDL = _of_link(
    "wdl",
    "the angular acceleration|accelerations {} of the link|links",
    "omega",
    times(PER_SECOND, PER_SECOND),
    1,
    "omegadot{i}",
    "omega{i}dot",
    "alpha{i}",
    unit="rad/s^2",
)
"""ω̇_i of frame i."""


AL = _of_link(
    "al",
    "the acceleration|accelerations {} of the origin|origins of the frame|frames",
    "a",
    ACCELERATION,
    0,
    "a{i}",
    "ae{i}",
    "vdot{i}",
    "v{i}dot",
)
"""The acceleration of the origin of frame i; in the modified convention with that of the base."""


ACL = Family(
    name="acl{b}",
    called="the acceleration|accelerations {} of the mass centre|centres",
    owner=Owner.BODY,
    stage=Stage.NEWTON_EULER,
    shape=(3, 1),
    letter=of_body(lambda body: letters.center_in_link("a", body)),
    dimension=ACCELERATION,
    spellings=("ac{b}", "vcdot{b}", "vdotc{b}", "vc{b}dot", "vC{b}dot", "vCdot{b}"),
)
"""The acceleration of a body's mass centre; in the modified convention with that of the base."""


FL = _of_link("fl", "the force|forces {} of the recursion", "f", FORCE, 0, "f{i}")
"""The force that the link before exerts on link i."""


NL = _of_link("nl", "the moment|moments {} of the recursion", "n", ENERGY, 0, "n{i}", "mu{i}", unit="N m")
"""The moment that the link before exerts on link i, about o_{i-1}, in the modified convention about o_i."""

FAMILIES: tuple[Family, ...] = tuple(record for record in vars().values() if isinstance(record, Family))
"""The records above, in their order."""
