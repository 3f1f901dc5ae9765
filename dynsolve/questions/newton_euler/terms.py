"""The letters of a link, and the terms of each recursion in them, of one link or of link i.

Outwards ω, ω̇ and the accelerations; inwards the moments: a list of trees each, in the order in which
they are added.  Spong, Hutchinson, Vidyasagar, section 7.6; Craig, section 6.5.
"""

from __future__ import annotations

from msgspec import Struct

from dynsolve.explain.context import Context
from dynsolve.notation.template import formula
from dynsolve.notation.tree import Node, Number, Row, Symbol, Words
from dynsolve.quantities import letters
from dynsolve.robot.model import Body, Convention, Robot


class Names(Struct, frozen=True):
    """The letters of a link by its index and that of the frame before it, and of one of its bodies.

    In the `standard` convention the joint lies on the axis of the frame before.
    """

    i: Node
    before: Node
    standard: bool
    body: Node = letters.COUNT

    @staticmethod
    def of(robot: Robot, link: int, body: Body | None = None) -> Names:
        """Those of one link."""
        before, standard = robot.joints[link - 1].parent, robot.convention is Convention.STANDARD
        index = letters.COUNT if body is None else letters.index_of(body.name)
        return Names(Number(link), Number(before), standard, index)

    @staticmethod
    def general(context: Context) -> Names:
        """Those of link i; in a tree its row starts from frame p."""
        before = PARENT if context.robot.is_tree else letters.BEFORE
        return Names(letters.COUNT, before, context.standard)

    def __call__(self, text: str, **values: Node) -> Node:
        """A formula of the link, in which

        - R is R_i^{i-1}, z the joint's axis along the axes of frame i, and r leads from o_{i-1} to o_i, along
          the axes of frame i, in the modified convention of frame i-1;
        - rc leads to the mass centre from o_{i-1}, in the modified convention from o_i; ac and I are its
          acceleration and the tensor about it;
        - w, dw and a are ω_i^i, ω̇_i^i and a_i^i; w0, dw0 and a0 those of the link before; g is g_0^i.
        """
        i, before, k = self.i, self.before, self.body
        own = {
            "R": letters.bold("R", i, before),
            "z": letters.bold("z", before if self.standard else i, i),
            "r": letters.bold("r", Row((before, Words(","), i)), i if self.standard else before),
            "rc": letters.bold(
                "r", Row((*((before, Words(",")) if self.standard else ()), Words("c"), k)), i
            ),
            "ac": letters.bold("a", Row((Words("c"), k)), i),
            "I": letters.bold("I", Row((Words("c"), k)), i),
            "g": letters.bold("g", Number(0), i),
        }
        for name, base, dots in (("w", "omega", 0), ("dw", "omega", 1), ("a", "a", 0)):
            own[name] = letters.bold(base, i, i, dots)
            own[f"{name}0"] = letters.bold(base, before, before, dots)
        return formula(text, i=i, **{**own, **values})


def outside_names(link: Names, number: Node) -> tuple[Node, Node, Node]:
    """The point of a force from outside, from the point of n_i; the force, and its moment; in frame i."""
    place = Row((Words("F"), number))
    return (
        letters.bold("r", place, link.i),
        letters.bold("F", number, link.i),
        letters.bold("M", number, link.i),
    )


PARENT, CHILD = Symbol("p"), Symbol("k")
"""The frame from which the row of link i starts, and a link that follows it, in a tree."""

Rates = tuple[Node, Node] | None
"""The first and second rate of a joint's variable; None of a joint that does not move so."""


def angular_velocity(link: Names, spin: Rates) -> list[Node]:
    """Rᵀ ω_{i-1} + z θ̇_i"""
    return [link("{R}ᵀ {w0}"), *([link("{z} {rate}", rate=spin[0])] if spin else [])]


def angular_acceleration(link: Names, spin: Rates) -> list[Node]:
    """Rᵀ ω̇_{i-1} + z θ̈_i + ω_i × z θ̇_i"""
    own = [link("{z} {rate}", rate=spin[1]), link("{w} × ({z} {rate})", rate=spin[0])] if spin else []
    return [link("{R}ᵀ {dw0}"), *own]


def _turning(link: Names, lever: Node) -> list[Node]:
    """ω̇ × r + ω × (ω × r)"""
    return [link("{dw} × {lever}", lever=lever), link("{w} × ({w} × {lever})", lever=lever)]


def acceleration(link: Names, slide: Rates, lever: str = "{r}") -> list[Node]:
    """The terms of the acceleration a lever away from o_{i-1}; `slide` are ḋ_i and d̈_i.

    The lever turns with link i in the standard convention, with link i-1 in the modified one.
    """
    if link.standard:
        carried = [link("{R}ᵀ {a0}"), *_turning(link, link(lever))]
    else:
        carried = [link("{R}ᵀ ({a0} + {dw0} × {r} + {w0} × ({w0} × {r}))")]
    if slide is None:
        return carried
    coriolis = formula("2 {product}", product=link("{w} × ({z} {rate})", rate=slide[0]))
    return [*carried, coriolis, link("{z} {rate}", rate=slide[1])]


def center_acceleration(link: Names, slide: Rates) -> list[Node]:
    """The same of a mass centre: from o_{i-1} in the standard convention, else from o_i."""
    if link.standard:
        return acceleration(link, slide, "{rc}")
    return [link("{a}"), *_turning(link, link("{rc}"))]


def inertial_force(link: Names, mass: Node, is_heavy: bool) -> Node:
    """m (a_c - g_0), where gravity is a force of its own; else m a_c."""
    return link("{m} ({ac} - {g})" if is_heavy else "{m} {ac}", m=mass)


def moment_of_next(link: Names, after: Names) -> list[Node]:
    """R n_{i+1} + r × (R f_{i+1}), r from the point of n_i to that of n_{i+1}."""
    lever = (link if link.standard else after)("{r}")
    return [after("{R} 𝐧_{i}^{i}"), after("{lever} × ({R} 𝐟_{i}^{i})", lever=lever)]


def moment_of_body(link: Names, inertial: Node, is_point: bool) -> list[Node]:
    """r × F + I ω̇ + ω × (I ω), r from the point of n_i to the mass centre; of a point mass r × F."""
    turned = [] if is_point else [link("{I} {dw}"), link("{w} × ({I} {w})")]
    return [link("{rc} × ({F})", F=inertial), *turned]
