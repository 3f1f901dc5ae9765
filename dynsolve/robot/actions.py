"""What acts on a manipulator beside gravity: friction, springs, dampers, motors.

A `Robot` carries its `Actions`, exact values in its ring.  Friction and dampers take energy
away, springs store it, and rotors have kinetic energy of their own.  A robot of which a file
says none of this has `NOTHING_ACTS`.
"""

from __future__ import annotations

from dataclasses import dataclass

from dynsolve.algebra.expr import Expr


@dataclass(frozen=True, slots=True)
class JointFriction:
    """Friction of coordinate k, counted from 0: f_v q̇_k + f_c sgn(q̇_k)."""

    coordinate: int
    viscous: Expr
    coulomb: Expr


@dataclass(frozen=True, slots=True)
class Damper:
    """A damper between what a linear form x of the coordinates says: the force b ẋ along x."""

    damping: Expr
    of: Expr


@dataclass(frozen=True, slots=True)
class Elastic:
    """A linear spring: ½ k (x - rest)², x a linear form of the coordinates."""

    stiffness: Expr
    of: Expr
    rest: Expr


@dataclass(frozen=True, slots=True)
class Spring:
    """A spring by its energy, a function of the coordinates; `law` is that of a linear one."""

    energy: Expr
    law: Elastic | None = None


@dataclass(frozen=True, slots=True)
class Motor:
    """The rotor of a motor that turns coordinate `turns`, counted from 0, through a gear.

    It spins with `ratio` q̇ about its axis, the axis x, y or z (`axis` 0, 1 or 2) of frame
    `carrier`, and is carried round by that link; a carrier 0 is the ground.  Its mass is a body's.
    """

    turns: int
    inertia: Expr
    ratio: Expr
    carrier: int = 0
    axis: int = 2


@dataclass(frozen=True, slots=True)
class Actions:
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
