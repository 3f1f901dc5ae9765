"""What exercises ask of the equations of motion as rules: parameters, linearization, q̈, inertia of the task.

A robot has the rules of those stages of which something is asked; the formulas are in
`regressor`, `linearization` and `forward_dynamics`.

The rules of models without a table: of bodies by their positions, and of given D, K, P or L.

They take the place of the rules of frames and joints; from the energies on the rules are
those of every robot.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation import balance, euler_lagrange, linearization, mechanism, regressor
from dynsolve.derivation.graph import Rule, Skipped
from dynsolve.derivation.link_frame import accelerations, inertia_matrix, quadratic_energy
from dynsolve.quantities.owners import asked_stages
from dynsolve.quantities.stages import Stage
from dynsolve.robot.actions import GivenModel
from dynsolve.robot.model import Body, Robot

if TYPE_CHECKING:
    from dynsolve.derivation.equilibria import Equilibria


def model_rules(robot: Robot) -> Iterator[Rule]:
    """The rules of what is asked of the equations of motion; none of a robot of which nothing is."""
    stages = asked_stages(robot.questions)
    if Stage.PARAMETERS in stages:
        yield from _parameters(robot)
    if Stage.EQUILIBRIA in stages:
        yield from _equilibria(robot)
    if Stage.FORWARD_DYNAMICS in stages:
        yield _forward(robot)
    if Stage.TASK_INERTIA in stages and robot.has_table:
        yield Rule("Lambda", ("Jr", "D"), linearization.task_inertia)


def _parameters(robot: Robot) -> Iterator[Rule]:
    minimal, columns = partial(regressor.minimal_parameters, robot), partial(regressor.regressor, robot)
    given = robot.questions.model.parameters
    yield Rule("a", ("tau",), minimal) if given is None else Rule("a", (), lambda: given)
    yield Rule("Y", ("tau", "a"), columns)

    def inertial(D: Matrix) -> Matrix:
        return D @ accelerations(robot)

    yield Rule("aM", ("D",), lambda D: minimal(inertial(D)))
    yield Rule("YM", ("D", "aM"), lambda D, a: columns(inertial(D), a))
    if robot.ring.plan.references:
        forces = partial(regressor.reference_forces, robot)
        yield Rule("Yr", ("D", "C", "g", "a"), lambda D, C, g, a: columns(forces(D, C, g), a))
    yield Rule("ag", ("g",), minimal)
    yield Rule("Yg", ("g", "ag"), columns)


def _equilibria(robot: Robot) -> Iterator[Rule]:
    yield Rule("balance", ("g",), partial(balance.balance, robot))
    if robot.questions.model.steady:
        yield Rule("equilibria", ("D", "C", "g"), partial(_in_steady_motion, robot))
    else:
        yield Rule("equilibria", ("g",), partial(_where_in_balance, robot))
    if robot.questions.model.linearize:
        friction = ("friction",) if "friction" in robot.actions.kinds else ()
        yield Rule("linear_A", ("D", "g", *friction), partial(linearization.state_matrix, robot))
        yield Rule("linear_B", ("D",), partial(linearization.input_matrix, robot))


def _forward(robot: Robot) -> Rule:
    """The rule of the accelerations; what works them out is imported when they are asked for."""
    from dynsolve.derivation.forward_dynamics import accelerations, acting_names

    return Rule("qdd_forward", ("D", *acting_names(robot)), partial(accelerations, robot))


def _where_in_balance(robot: Robot, gravity: Matrix) -> Equilibria | Skipped:
    """The equilibria; what finds them is imported when they are asked for."""
    from dynsolve.derivation.equilibria import equilibria

    return equilibria(robot, gravity)


def _in_steady_motion(robot: Robot, D: Matrix, C: Matrix, gravity: Matrix) -> Equilibria | Skipped:
    """Those of coordinates whose others move at constant rates."""
    from dynsolve.derivation.linearization import steady_equilibria

    return steady_equilibria(robot, D, C, gravity)


# The rules of models without a table


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
    rotors = ("Dm",) if robot.actions.motors else ()
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
