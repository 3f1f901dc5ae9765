"""The terms of each recursion in letters, of one link or of link i.

Spong, Hutchinson, Vidyasagar, section 7.6, in the standard convention; Craig, section 6.5, in the modified.
"""

from __future__ import annotations

from dynsolve.explain.recursions.names import BodyNames, LinkNames
from dynsolve.notation.tree import (
    Cross,
    Negative,
    Node,
    Number,
    Parenthesized,
    Product,
    Sum,
    Transpose,
)

W, A = "omega", "a"


def turned(link: LinkNames, vector: Node) -> Node:
    """(R_i^{i-1})ᵀ vector: what comes from the link before."""
    return Product((Transpose(link.R), vector))


def along(link: LinkNames, rate: Node) -> Node:
    """The rate of a joint along its axis."""
    return Product((link.axis, rate))


def angular_velocity(link: LinkNames, rate: Node | None) -> list[Node]:
    """Rᵀ ω_{i-1} + z θ̇_i; `rate` is θ̇_i of a joint that turns."""
    own = [] if rate is None else [along(link, rate)]
    return [turned(link, link.vector_before(W)), *own]


def angular_acceleration(link: LinkNames, rates: tuple[Node, Node] | None) -> list[Node]:
    """Rᵀ ω̇_{i-1} + z θ̈_i + ω_i × z θ̇_i; `rates` are θ̇_i and θ̈_i of a joint that turns."""
    carried = turned(link, link.vector_before(W, 1))
    if rates is None:
        return [carried]
    first, second = rates
    return [carried, along(link, second), Cross(link.vector(W), Parenthesized(along(link, first)))]


def turning(w: Node, dw: Node, lever: Node) -> list[Node]:
    """ω̇ × r + ω × (ω × r)"""
    return [Cross(dw, lever), Cross(w, Parenthesized(Cross(w, lever)))]


def acceleration(link: LinkNames, lever: Node, rates: tuple[Node, Node] | None) -> list[Node]:
    """The terms of the acceleration a `lever` away from o_{i-1}.

    `rates` are ḋ_i and d̈_i of a joint that slides.  The lever turns with link i in the standard
    convention, with link i-1 in the modified one.
    """
    if link.standard:
        carried = [turned(link, link.vector_before(A)), *turning(link.vector(W), link.vector(W, 1), lever)]
    else:
        around = turning(link.vector_before(W), link.vector_before(W, 1), lever)
        carried = [turned(link, Parenthesized(Sum((link.vector_before(A), *around))))]
    if rates is None:
        return carried
    first, second = rates
    coriolis = Product((Number(2), Cross(link.vector(W), Parenthesized(along(link, first)))))
    return [*carried, coriolis, along(link, second)]


def center_acceleration(body: BodyNames, rates: tuple[Node, Node] | None) -> list[Node]:
    """The same of a mass centre: from o_{i-1} in the standard convention, else from o_i."""
    link = body.link
    if link.standard:
        return acceleration(link, body.lever, rates)
    return [link.vector(A), *turning(link.vector(W), link.vector(W, 1), body.center)]


def inertial_force(body: BodyNames, mass: Node, heavy: bool) -> Node:
    """m (a_c - g_0), where gravity is a force of its own (`heavy`); else m a_c."""
    if heavy:
        return Product((mass, Parenthesized(Sum((body.acceleration, Negative(body.link.gravity))))))
    return Product((mass, body.acceleration))


def passed_on(after: LinkNames, base: str) -> Node:
    """R_{i+1}^i f_{i+1}: what the next link is held with, along the axes of link i."""
    return Product((after.R, after.vector(base)))


def moment_of_next(link: LinkNames, after: LinkNames) -> list[Node]:
    """R n_{i+1} + r × (R f_{i+1}), r from the point of n_i to that of n_{i+1}."""
    lever = link.lever if link.standard else after.lever
    return [passed_on(after, "n"), Cross(lever, Parenthesized(passed_on(after, "f")))]


def moment_of_body(body: BodyNames, inertial: Node, is_point: bool) -> list[Node]:
    """r × F + I ω̇ + ω × (I ω), r from the point of n_i to the mass centre; of a point mass r × F."""
    lever = body.lever if body.link.standard else body.center
    force = Cross(lever, Parenthesized(inertial))
    if is_point:
        return [force]
    w, dw = body.link.vector(W), body.link.vector(W, 1)
    spun = Cross(w, Parenthesized(Product((body.tensor, w))))
    return [force, Product((body.tensor, dw)), spun]
