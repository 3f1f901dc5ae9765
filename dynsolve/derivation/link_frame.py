"""K_v, K_ω and D from Jacobians expressed in each link's own frame: the fast way.

In the base frame a column of the Jacobian grows with every joint before it, and shrinks
again in vᵀv; in the link's own frame it never grows.  Both give the same K exactly (a
test holds that), so these rules take the place of the textbook's.

Inertia tensors: the body-attached frame, the parallel-axis theorem, the base frame.

Spong, Hutchinson, Vidyasagar, section 7.2: I_base = R I Rᵀ, where I is about the
mass centre with axes fixed to the body and R turns the body's axes into the base's.

Velocities and energies of each body.

Spong, Hutchinson, Vidyasagar, section 7.2: v = J_v q̇, ω = J_ω q̇,
K = ½ m vᵀv + ½ ωᵀ I ω and P = -m gᵀ r_c.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import partial

from msgspec import Struct

from dynsolve.algebra.matrix import Matrix, cross, hstack
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.derivation.graph import Rule
from dynsolve.derivation.kinematics import dh_matrix, origin, rotation
from dynsolve.robot.model import AxesKind, Body, Convention, Joint, Robot

# Velocities and energies of each body

HALF = Fraction(1, 2)


def velocities(robot: Robot) -> Matrix:
    """q̇, n×1."""
    return Matrix.column(robot.ring, [robot.ring.symbol(q.name, 1) for q in robot.coordinates])


def accelerations(robot: Robot) -> Matrix:
    """q̈, n×1."""
    return Matrix.column(robot.ring, [robot.ring.symbol(q.name, 2) for q in robot.coordinates])


def velocity(robot: Robot, jacobian: Matrix) -> Matrix:
    """v = J_v q̇ or ω = J_ω q̇, 3×1."""
    return jacobian @ velocities(robot)


def potential_energy(robot: Robot, mass: Expr, center: Matrix) -> Expr:
    """P = -m gᵀ r_c: the height of the mass centre against gravity, from the base origin."""
    return -mass * robot.ring.dot(robot.gravity.entries, center.entries)


def linear_energy(mass: Expr, v: Matrix) -> Expr:
    """K_v = ½ m vᵀ v"""
    return mass * mass.ring.dot(v.entries, v.entries) * HALF


def rotational_energy(w: Matrix, inertia: Matrix) -> Expr:
    """K_ω = ½ ωᵀ I ω, ω and I in one frame."""
    return w.ring.dot(w.entries, (inertia @ w).entries) * HALF


def kinetic_energy(linear: Expr, rotational: Expr) -> Expr:
    """K_i = K_v + K_ω of one body."""
    return linear + rotational


def total(ring: Ring, parts: tuple[Expr, ...]) -> Expr:
    """The sum over the bodies."""
    return sum(parts, start=ring.zero)


# Inertia tensors: the body-attached frame, the parallel-axis theorem, the base frame


def body_rotation(robot: Robot, body: Body, H: Matrix) -> Matrix:
    """R_b, 3×3: the body-attached axes seen from the base; H is that of the body's link."""
    axes = body.axes
    match axes.kind:
        case AxesKind.LINK:
            return rotation(H) @ axes.rotation
        case AxesKind.REST:
            return rotation(H) @ rotation(H).map(robot.ring.at_rest).T @ robot.base_rotation @ axes.rotation
        case AxesKind.BASE:
            return robot.base_rotation @ axes.rotation


def axes_in_link(robot: Robot, body: Body, H: Matrix) -> Matrix:
    """Rᵀ R_b, 3×3, at q = 0: the body's axes seen from its link, which they turn with."""
    if body.axes.kind is AxesKind.LINK:
        return body.axes.rotation
    return (rotation(H).T @ body_rotation(robot, body, H)).map(robot.ring.at_rest)


def turns_with_link(robot: Robot, body: Body, H: Matrix) -> bool:
    """Whether a given R_b is fixed in the link, as the frame of a rigid body is."""
    if body.axes.kind is not AxesKind.BASE:
        return True
    relative = rotation(H).T @ body_rotation(robot, body, H)
    return not any(map(robot.ring.depends_on_coordinates, relative.entries))


def steiner(mass: Expr, offset: Matrix) -> Matrix:
    """m (|r|² 1 - r rᵀ), 3×3: what the parallel-axis theorem adds for an axis a distance r away."""
    ring = mass.ring
    square = ring.dot(offset.entries, offset.entries)
    return (Matrix.identity(ring, 3).scale(square) - offset @ offset.T).scale(mass)


def central_inertia(robot: Robot, body: Body, H: Matrix) -> Matrix:
    """I about the mass centre, 3×3, in the body-attached frame; H is that of the body's link.

    A tensor given about another point is moved by the parallel-axis theorem; a point mass has none.
    """
    ring = body.mass.ring
    if body.inertia is None:
        return Matrix.zero(ring, 3, 3)
    if body.about_point is None:
        return body.inertia
    offset = axes_in_link(robot, body, H).T @ (body.center - body.about_point)
    return body.inertia - steiner(body.mass, offset)


def base_inertia(R: Matrix, inertia: Matrix) -> Matrix:
    """I_base = R I Rᵀ, 3×3."""
    return R @ inertia @ R.T


def link_frame_rules(robot: Robot) -> Iterator[Rule]:
    """K_v and K_ω of each body from its part of D, and D as the sum of these parts (`D_direct`)."""
    if not robot.bodies:
        return
    yield Rule("link_jacobians", (), lambda: tuple(link_jacobians(robot)))
    for body in robot.bodies:
        b = body.name
        angular_inputs = ("link_jacobians", f"I_body{b}", f"H{body.link}")
        yield Rule(f"Dv{b}", ("link_jacobians",), partial(linear_part, body))
        yield Rule(f"Dw{b}", angular_inputs, partial(angular_part, robot, body))
        yield Rule(f"Kv{b}", (f"Dv{b}",), partial(quadratic_energy, robot))
        yield Rule(f"Kw{b}", (f"Dw{b}",), partial(quadratic_energy, robot))
    parts = [f"D{kind}{body.name}" for body in robot.bodies for kind in "vw"]
    parts += ["Dm"] if robot.actions.rotors else []
    yield Rule("D_direct", tuple(parts), partial(inertia_matrix, robot))


class LinkJacobian(Struct, frozen=True):
    """J_v of the frame's origin and J_ω, 3×n each, along the frame's own axes."""

    linear: Matrix
    angular: Matrix

    def at(self, local: Matrix) -> Matrix:
        """J_v, 3×n, of a point fixed in the frame: J_v + J_ω × r."""
        ring = local.ring
        n = self.linear.shape[1]
        columns = [self.linear.column_at(k) + cross(self.angular.column_at(k), local) for k in range(n)]
        return hstack(ring, columns, 3)


def link_jacobians(robot: Robot) -> Iterator[LinkJacobian]:
    """The Jacobians of frames 1, 2, ..., each from that of the frame where its row starts."""
    found = [LinkJacobian(Matrix.zero(robot.ring, 3, robot.n), Matrix.zero(robot.ring, 3, robot.n))]
    for joint in robot.joints:
        found.append(_next(robot, joint, found[joint.parent]))
    yield from found[1:]


def _next(robot: Robot, joint: Joint, before: LinkJacobian) -> LinkJacobian:
    """ω and v pass from frame to frame as in the recursion of velocities (Craig, section 5.6)."""
    A = dh_matrix(robot, joint)
    back, position = rotation(A).T, origin(A)
    spin, slide = _rates(robot, joint)
    if robot.convention is Convention.STANDARD:
        z = back.column_at(2)
        angular = back @ before.angular + z @ spin
        carried = LinkJacobian(back @ before.linear + z @ slide, angular)
        return LinkJacobian(carried.at(back @ position), angular)
    z = Matrix.identity(robot.ring, 3).column_at(2)
    carried_linear = before.at(position)
    return LinkJacobian(back @ carried_linear + z @ slide, back @ before.angular + z @ spin)


def _rates(robot: Robot, joint: Joint) -> tuple[Matrix, Matrix]:
    """The joint's turning and sliding rates as rows, 1×n, in the coordinates."""
    rates: list[Fraction] = [Fraction(0)] * robot.n
    for k, rate in joint.rates:
        rates[k] = rate
    row = Matrix.of(robot.ring, [map(robot.ring.constant, rates)])
    none = Matrix.zero(robot.ring, 1, robot.n)
    return (row, none) if joint.variable == "theta" else (none, row)


def linear_part(body: Body, jacobians: tuple[LinkJacobian, ...]) -> Matrix:
    """m J_vᵀ J_v, n×n: what the motion of the body's mass centre adds to D."""
    J = jacobians[body.link - 1].at(body.center)
    return (J.T @ J).scale(body.mass)


def angular_part(
    robot: Robot, body: Body, jacobians: tuple[LinkJacobian, ...], tensor: Matrix, H: Matrix
) -> Matrix:
    """J_ωᵀ I J_ω, n×n, with I along the link's axes: what the body's rotation adds to D."""
    if body.is_point:
        return Matrix.zero(robot.ring, robot.n, robot.n)
    J = jacobians[body.link - 1].angular
    relative = axes_in_link(robot, body, H)
    return J.T @ (relative @ tensor @ relative.T @ J)


def quadratic_energy(robot: Robot, part: Matrix) -> Expr:
    """½ q̇ᵀ D q̇, of D or a part of it."""
    rates = velocities(robot)
    return (rates.T @ part @ rates)[0, 0] / 2


def inertia_matrix(robot: Robot, *parts: Matrix) -> Matrix:
    """D = Σ m J_vᵀ J_v + J_ωᵀ I J_ω over the bodies, n×n."""
    return sum(parts, start=Matrix.zero(robot.ring, robot.n, robot.n))
