"""What acts on a manipulator beside gravity: friction, springs, dampers, motors.

A `Robot` carries its `Actions`, exact values in its ring.  Friction and dampers take energy
away, springs store it, and rotors have kinetic energy of their own.  A robot of which a file
says none of this has `NOTHING_ACTS`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

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
