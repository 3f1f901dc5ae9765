"""The rules of models without a table: of bodies by their positions, and of given D, K, P or L.

They take the place of the rules of frames and joints; from the energies on the rules are
those of every robot.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.derivation import euler_lagrange, mechanism
from dynsolve.derivation.graph import Rule
from dynsolve.derivation.link_frame import inertia_matrix, quadratic_energy
from dynsolve.robot.model import Body, GivenModel, Robot


def motion_rules(robot: Robot, body: Body) -> Iterator[Rule]:
    """r_c, R, J_v and J_ω of a body that is given by its position."""
    b = body.name
    yield Rule(f"rc{b}", (), lambda: body.center)
    yield Rule(f"R{b}", (), partial(mechanism.orientation, robot, body))
    yield Rule(f"Jv{b}", (f"rc{b}",), partial(mechanism.position_jacobian, robot))
    yield Rule(f"Jw{b}", (), partial(mechanism.angular_jacobian, robot, body))


def given_rules(
    robot: Robot, given: GivenModel, stored: Sequence[str] = (), moving: Sequence[str] = ()
) -> Iterator[Rule]:
    """K and P of a model that is given by D and P, by K and P, or by L.

    `stored` and `moving` are the energies of springs and of rotors, where there are any: they are added.
    """
    K, P = _kinetic(robot, given), _potential(robot, given)
    yield Rule("K", tuple(moving), lambda *parts: sum(parts, start=K))
    yield Rule("P", tuple(stored), lambda *parts: sum(parts, start=P))


def _kinetic(robot: Robot, given: GivenModel) -> Expr:
    """K as given, ½ q̇ᵀ D q̇, or the terms of L that hold rates."""
    if given.D is not None:
        return quadratic_energy(robot, given.D)
    if given.L is not None:
        return given.L - robot.ring.without(given.L, 1)
    assert given.K is not None
    return given.K


def _potential(robot: Robot, given: GivenModel) -> Expr:
    """P as given, or minus what is left of L at rest; 0 where nothing is given."""
    if given.L is not None:
        return -robot.ring.without(given.L, 1)
    return robot.ring.zero if given.P is None else given.P


def direct_rules(robot: Robot) -> Iterator[Rule]:
    """K_v and K_ω from each body's part of D, along its own axes, and D without the forces (`D_direct`)."""
    rotors = ("Dm",) if robot.actions.rotors else ()
    if robot.given is not None:
        D = robot.given.D
        if D is not None:
            yield Rule("D_direct", rotors, lambda *parts: sum(parts, start=D))
        else:
            yield Rule("D_direct", ("K",), partial(euler_lagrange.inertia_from_energy, robot))
        return
    for body in robot.bodies:
        b = body.name
        yield Rule(f"Dv{b}", (f"Jv{b}",), partial(_linear_part, body))
        yield Rule(f"Dw{b}", (f"I_body{b}",), partial(_angular_part, robot, body))
        yield Rule(f"Kv{b}", (f"Dv{b}",), partial(quadratic_energy, robot))
        yield Rule(f"Kw{b}", (f"Dw{b}",), partial(quadratic_energy, robot))
    parts = (*(f"D{kind}{body.name}" for body in robot.bodies for kind in "vw"), *rotors)
    yield Rule("D_direct", parts, partial(inertia_matrix, robot))


def _linear_part(body: Body, J: Matrix) -> Matrix:
    """m J_vᵀ J_v, n×n."""
    return (J.T @ J).scale(body.mass)


def _angular_part(robot: Robot, body: Body, tensor: Matrix) -> Matrix:
    """J_ωᵀ I J_ω, n×n, both along the body's own axes."""
    if body.is_point:
        return Matrix.zero(robot.ring, robot.n, robot.n)
    J = mechanism.own_angular_jacobian(robot, body)
    return J.T @ tensor @ J
