"""What acts on a manipulator beside gravity: friction, springs, dampers, motors.

A `Robot` carries its `Actions`, exact values in its ring.  Friction and dampers take energy
away, springs store it, and rotors have kinetic energy of their own.  A robot of which a file
says none of this has `NOTHING_ACTS`.

Constraints on the motion of a manipulator: A_c(q) q̇ = 0.

Matrices of which an exercise asks whether they can be inertia matrices.

Models without a Denavit-Hartenberg table: bodies by their positions, or energies that are given.

Of a mechanism by positions a body's mass centre is a function of the coordinates, and its
orientation a product of turns.  Otherwise the file gives the inertia matrix, the energies or
the Lagrangian themselves, and no body is known.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.matrix import Matrix
from dynsolve.notation.tree import Node

# What acts on a manipulator beside gravity: friction, springs, dampers, motors


class JointFriction(Struct, frozen=True):
    """Friction of coordinate k, counted from 0: f_v q̇_k + f_c sgn(q̇_k)."""

    coordinate: int
    viscous: Expr
    coulomb: Expr


class Damper(Struct, frozen=True):
    """A damper between what a linear form x of the coordinates says: the force b ẋ along x."""

    damping: Expr
    of: Expr


class Elastic(Struct, frozen=True):
    """A linear spring: ½ k (x - rest)², x a linear form of the coordinates."""

    stiffness: Expr
    of: Expr
    rest: Expr


class Spring(Struct, frozen=True):
    """A spring by its energy, a function of the coordinates; `law` is that of a linear one."""

    energy: Expr
    law: Elastic | None = None


class Motor(Struct, frozen=True):
    """The rotor of a motor that turns coordinate `turns`, counted from 0, through a gear.

    It spins with `ratio` q̇ about its axis, the axis x, y or z (`axis` 0, 1 or 2) of frame
    `carrier`, and is carried round by that link; a carrier 0 is the ground.  Its mass is a body's.
    """

    turns: int
    inertia: Expr
    ratio: Expr
    carrier: int = 0
    axis: int = 2


class Actions(Struct, frozen=True):
    """Everything that acts; `passive` are the coordinates, from 0, that no motor drives."""

    friction: tuple[JointFriction, ...] = ()
    dampers: tuple[Damper, ...] = ()
    springs: tuple[Spring, ...] = ()
    motors: tuple[Motor, ...] = ()
    passive: tuple[int, ...] = ()

    @property
    def kinds(self) -> frozenset[str]:
        """What there is of it: `friction` (dampers too), `springs`, `motors`."""
        found = {"friction": self.friction or self.dampers, "springs": self.springs, "motors": self.motors}
        return frozenset(kind for kind, there in found.items() if there)

    def __bool__(self) -> bool:
        """Whether there is anything."""
        return bool(self.kinds or self.passive)


NOTHING_ACTS = Actions()


def values_of(actions: Actions) -> Iterator[Expr]:
    """Every value in them."""
    for friction in actions.friction:
        yield from (friction.viscous, friction.coulomb)
    for damper in actions.dampers:
        yield from (damper.damping, damper.of)
    for spring in actions.springs:
        yield spring.energy
        if spring.law is not None:
            yield from (spring.law.stiffness, spring.law.of, spring.law.rest)
    for motor in actions.motors:
        yield from (motor.inertia, motor.ratio)


def with_values(actions: Actions, changed: Callable[[Expr], Expr]) -> Actions:
    """The same with every value changed, into those of another ring for example."""

    def law(found: Elastic | None) -> Elastic | None:
        return found and Elastic(changed(found.stiffness), changed(found.of), changed(found.rest))

    return replace(
        actions,
        friction=tuple(
            replace(f, viscous=changed(f.viscous), coulomb=changed(f.coulomb)) for f in actions.friction
        ),
        dampers=tuple(Damper(changed(d.damping), changed(d.of)) for d in actions.dampers),
        springs=tuple(Spring(changed(s.energy), law(s.law)) for s in actions.springs),
        motors=tuple(replace(m, inertia=changed(m.inertia), ratio=changed(m.ratio)) for m in actions.motors),
    )


# Constraints on the motion of a manipulator: A_c(q) q̇ = 0


class Constraint(Struct, frozen=True):
    """One equation that every motion keeps.

    `entry` is what is 0: h(q), holonomic, in which coordinates of points may stand as they do in a
    task; or, `in_rates`, a sum of rates with factors that depend on the coordinates.
    """

    entry: Node
    in_rates: bool = False


# Matrices of which an exercise asks whether they can be inertia matrices


class Candidate(Struct, frozen=True):
    """A matrix, n×n, and what is assumed of its parameters.

    `is_relative` says that the coordinates are those of a chain, each counted from the link before,
    so that an inertia matrix is the same wherever the first one stands.
    """

    name: str
    matrix: Matrix
    assumed: tuple[Bound, ...] = ()
    is_relative: bool = False


# Models without a Denavit-Hartenberg table


class BodyTurn(Struct, frozen=True):
    """A turn of a body about an axis that the turns before it carry along.

    `axis` (3×1) is a unit vector in the axes so far turned.  The angle is linear in the
    coordinates: `rates` (1×n) are its derivatives, free of coordinates, and `rotation` (3×3)
    turns by it.  `angle` is the angle as the file writes it.
    """

    axis: Matrix
    rates: Matrix
    rotation: Matrix
    angle: Node


class GivenModel(Struct, frozen=True):
    """What a file gives in the place of bodies: D and P, K and P, or L; what it does not give is None.

    D is n×n, the others are scalars.
    """

    D: Matrix | None = None
    K: Expr | None = None
    P: Expr | None = None
    L: Expr | None = None
