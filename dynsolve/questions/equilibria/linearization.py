"""The equations of motion near an equilibrium, linear: ẋ = A x + B u.

With x = (q - q_e, q̇) and the inputs u counted from the forces g(q_e) that hold the equilibrium,

    A = [ 0, 1; -D⁻¹ ∂g/∂q, -D⁻¹ F ],   B = [ 0; D⁻¹ S ]   at q = q_e, q̇ = 0:

C q̇ is of second order, F holds the viscous friction, and S a column for each coordinate that a
motor drives.

Slotine, Li, Applied Nonlinear Control, section 3.3 (1991).

Steady motions: some coordinates move at constant rates, the others are in balance.

With q̇ = q̇_s constant, and nothing in the others' equations that changes with the coordinates that
move, what is left of the equations of motion is C(q, q̇_s) q̇_s + g = 0 in the rows of the others.
These forces are the derivatives of the energy

    V = P - K(q, q̇_s),

whose minimum is stable, as that of P is at rest: with a motor that keeps the rates V, and what is
kinetic energy of the others, is conserved.  Terms of first order in the rates of the others do no
work (gyroscopic forces), and may hold what V alone would let fall.

Goldstein, Poole, Safko, Classical Mechanics, 3rd ed., sections 2.7 and 8.3; Lanczos, The Variational
Principles of Mechanics, 4th ed., section V.8.
"""

from __future__ import annotations

from itertools import combinations

from dynsolve.algebra.linear_systems import FractionMatrix, fraction_of, inverse_times, tidy
from dynsolve.algebra.matrix import AtState, Matrix, work
from dynsolve.algebra.ring import Expr
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.link_frame import velocities
from dynsolve.notation.tree import Node, Number, Symbol
from dynsolve.notation.unicode import to_unicode
from dynsolve.questions.equilibria.solving import Equilibria, equilibria, wanted_rows
from dynsolve.robot.model import Robot

MOST_PRODUCTS = 200_000
"""An inertia matrix whose determinant may come to more products of terms is not inverted."""

TOO_LARGE = "the inverse of the inertia matrix is too large to be read"
SINGULAR = "the inertia matrix has no inverse"
NO_EQUILIBRIUM = "the given state is no equilibrium"
CONSTRAINED = "the constraints leave fewer coordinates free than the state has"

Linear = Matrix | FractionMatrix | Skipped


def at_equilibrium(robot: Robot) -> AtState:
    """Puts the equilibrium into expressions; rates are 0 there."""
    return AtState(robot.ring, robot.questions.model.equilibrium)


def driven(robot: Robot) -> list[int]:
    """The coordinates that a motor drives, from 0: the inputs."""
    return [k for k in range(robot.n) if k not in robot.actions.passive]


def unbalanced(robot: Robot, gravity: Matrix) -> str:
    """The name of a passive coordinate that gravity and springs move there; empty where none does."""
    at = at_equilibrium(robot)
    for k in robot.actions.passive:
        if not at(gravity[k, 0]).is_zero:
            return robot.coordinates[k].name
    return ""


def curvature(robot: Robot, gravity: Matrix) -> Matrix:
    """∂g/∂q, n×n: the second derivatives of the potential energy."""
    ring = robot.ring
    return Matrix.of(ring, ([ring.diff(g, k) for k in range(robot.n)] for g in gravity.entries))


def stiffness(robot: Robot, gravity: Matrix) -> Matrix:
    """∂g/∂q at the equilibrium, n×n."""
    return at_equilibrium(robot).matrix(curvature(robot, gravity))


def damping(robot: Robot, friction: Matrix | None) -> Matrix:
    """F = ∂(friction)/∂q̇ at the equilibrium, n×n: of the viscous friction, for sgn jumps there."""
    ring, at = robot.ring, at_equilibrium(robot)
    if friction is None:
        return Matrix.zero(ring, robot.n, robot.n)
    return Matrix.of(ring, ([at(ring.diff_velocity(f, k)) for k in range(robot.n)] for f in friction.entries))


def still_forces(robot: Robot, gravity: Matrix, outside: Matrix | None) -> Matrix:
    """g - Q, n×1: what motors hold at rest."""
    return gravity if outside is None else gravity - outside


def state_matrix(robot: Robot, D: Matrix, gravity: Matrix, *acting: Matrix) -> Linear:
    """A, 2n×2n; `acting` are Q and the friction, those that there are."""
    outside = acting[0] if robot.questions.loads else None
    friction = acting[-1] if robot.actions.resisting else None
    gravity = still_forces(robot, gravity, outside)
    if robot.questions.constraints:
        return Skipped(CONSTRAINED)
    name = unbalanced(robot, gravity)
    if name:
        by = f"{robot.held_by} move{'' if 'spring' in robot.held else 's'}"
        by = "the given forces move" if robot.questions.loads else by
        moved = to_unicode(Symbol(name))
        return Skipped(f"{NO_EQUILIBRIUM}: {by} {moved}, which no motor holds")
    below = Matrix(
        robot.ring,
        tuple(
            (*k, *f)
            for k, f in zip((-stiffness(robot, gravity)).rows, (-damping(robot, friction)).rows, strict=True)
        ),
    )
    zero, one = Matrix.zero(robot.ring, robot.n, robot.n), Matrix.identity(robot.ring, robot.n)
    return _below(
        robot, D, Matrix(robot.ring, tuple((*z, *e) for z, e in zip(zero.rows, one.rows, strict=True))), below
    )


def input_matrix(robot: Robot, D: Matrix, A: Linear) -> Linear:
    """B, 2n×m, a column for each coordinate that a motor drives; nothing where A is of no motion."""
    if isinstance(A, Skipped) and A.why.startswith((CONSTRAINED, NO_EQUILIBRIUM)):
        return A
    inputs = driven(robot)
    selected = Matrix.of(
        robot.ring,
        ([robot.ring.one if i == k else robot.ring.zero for k in inputs] for i in range(robot.n)),
    )
    if not inputs:
        return Skipped("no coordinate has a motor")
    return _below(robot, D, Matrix.zero(robot.ring, robot.n, len(inputs)), selected)


def _below(robot: Robot, D: Matrix, upper: Matrix, right: Matrix) -> Linear:
    """[upper; D⁻¹ right] with D at the equilibrium."""
    inertia = at_equilibrium(robot).matrix(D)
    if work(inertia) > MOST_PRODUCTS:
        return Skipped(TOO_LARGE)
    lower = inverse_times(inertia, right)
    if lower is None:
        return Skipped(SINGULAR)
    return tidy(robot.ring, [map(fraction_of, row) for row in (*upper.rows, *lower.rows)])


# Steady motions: some coordinates move at constant rates, the others are in balance


def steady_rates(robot: Robot) -> dict[tuple[str, int], Node]:
    """The rate of each coordinate by (name, 1); 0 of those that are in balance."""
    rates = dict(robot.questions.model.steady)
    return {(q.name, 1): rates.get(q.name, Number(0)) for q in robot.coordinates}


def steady_forces(robot: Robot, C: Matrix, gravity: Matrix) -> Matrix:
    """C q̇ + g in the motion, n×1, without friction."""
    return AtState(robot.ring, steady_rates(robot)).matrix(C @ velocities(robot) + gravity)


def steady_energy(robot: Robot, P: Expr, K: Expr) -> Expr:
    """V = P - K(q, q̇_s)"""
    return AtState(robot.ring, steady_rates(robot))(P - K)


def steady_equilibria(
    robot: Robot, D: Matrix, C: Matrix, gravity: Matrix, *constraints: Matrix
) -> Equilibria | Skipped:
    """Where the others are in balance, held by constraints, A_c and h, if there are any."""
    forces = steady_forces(robot, C, gravity)
    changing = (*D.entries, *(forces[row, 0] for row in wanted_rows(robot)))
    held = tuple(entry for one in constraints for entry in one.entries)
    for name, _ in robot.questions.model.steady:
        k, moving = robot.ring.names.index(name), to_unicode(Symbol(name))
        if any(not robot.ring.diff(entry, k).is_zero for entry in changing):
            return Skipped(f"the equations of the others change as {moving} moves: it is not cyclic")
        stands = constraints and any(not row[k].is_zero for row in constraints[0].rows)
        if stands or any(not robot.ring.diff(entry, k).is_zero for entry in held):
            return Skipped(f"the constraints change as {moving} moves: it stands in them")
    braked = _braked(robot)
    if braked:
        return Skipped(f"friction acts on {braked} in this motion, and no motor holds it")
    return equilibria(robot, forces, D, *constraints, may_be_held=may_be_held(robot, D))


def may_be_held(robot: Robot, D: Matrix) -> bool:
    """Whether more than the energy holds: gyroscopic forces, or rates that no motor keeps."""
    rates = dict(robot.questions.model.steady)
    moving = [k for k, q in enumerate(robot.coordinates) if q.name in rates]
    if set(moving) & set(robot.actions.passive):
        return True
    momentum = AtState(robot.ring, steady_rates(robot)).matrix(D @ velocities(robot))
    others = [k for k in range(robot.n) if k not in moving]
    return any(not _curl(robot, momentum, *pair).is_zero for pair in combinations(others, 2))


def _curl(robot: Robot, momentum: Matrix, i: int, j: int) -> Expr:
    """∂p_i/∂q_j - ∂p_j/∂q_i, the factor of the gyroscopic force between two coordinates."""
    return robot.ring.diff(momentum[i, 0], j) - robot.ring.diff(momentum[j, 0], i)


def _braked(robot: Robot) -> str:
    """The name of a coordinate that friction acts on in the motion, and no motor holds; else nothing."""
    at = AtState(robot.ring, steady_rates(robot))
    for force in (act.force(robot) for act in robot.actions.resisting):
        for k in wanted_rows(robot):
            if not at(force[k, 0]).is_zero:
                return to_unicode(Symbol(robot.coordinates[k].name))
    return ""
