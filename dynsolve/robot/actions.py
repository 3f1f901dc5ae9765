"""What acts on a manipulator beside gravity: the list of its kinds, and what every room asks of one.

A `Robot` carries its `Actions`, exact values in its ring.  What acts is one of three terms: it stores
energy (P_s), has kinetic energy of its own (K_m), or resists without a potential (friction).  Rooms know
these terms; of which kinds they are is in the folders of `dynsolve.acts`.  A robot of which a file says
none of this has `NOTHING_ACTS`.

Constraints on the motion of a manipulator: A_c(q) q̇ = 0.

Matrices of which an exercise asks whether they can be inertia matrices.

Models without a Denavit-Hartenberg table: bodies by their positions, or energies that are given.

Of a mechanism by positions a body's mass centre is a function of the coordinates, and its
orientation a product of turns.  Otherwise the file gives the inertia matrix, the energies or
the Lagrangian themselves, and no body is known.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from importlib import import_module
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple, Self

from msgspec import Struct
from msgspec.structs import asdict, astuple, replace

from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.notation.tree import Function, Node
from dynsolve.robot.units import Dimension

if TYPE_CHECKING:
    from dynsolve.robot.model import Robot

Values = Mapping[str, float]
"""Numbers of parameters, coordinates and rates by their names."""

# What acts on a manipulator beside gravity, of whatever kind

KINDS = ("friction", "springs", "dampers", "motors")
"""The one list of the kinds: each is a key of the problem file, and a folder of `dynsolve.acts`."""


def part(kind: str, file: str = "") -> Any:
    """A file of the folder `acts/<kind>`, or the folder itself, imported when it is asked for.

    This is how rooms below `acts` reach a kind, by its path: none of them names one.

    >>> part("springs").KEY.name
    'springs'
    """
    return import_module(".".join(filter(None, ("dynsolve.acts", kind, file))))


def keys_of_kinds() -> Iterator[Any]:
    """The key of every kind."""
    return (part(kind).KEY for kind in KINDS)


class Parameter(NamedTuple):
    """A value that an act has: what it is, for one and for several, and what it is measured in.

    `unit` is what is said of the dimension: a stiffness is in N m/rad, and not in N m.  `is_whole` says that
    the words are those of a symbol that is the value, else of every symbol in it.
    """

    value: Expr
    words: str = ""
    dimension: Dimension | None = None
    unit: str = ""
    is_whole: bool = True


class Act(Struct, frozen=True):
    """One thing that acts: a record of its kind (`acts/<kind>/act.py`), its fields exact values.

    It is one of three terms of the equations of motion, by its class: `Stored`, `Rotor`, `Resisting`.
    """

    term: ClassVar[str]
    """The result of which it is a part; `Family.brought_by` has its name."""

    @property
    def kind(self) -> str:
        """The name of its kind, which is that of its folder."""
        return type(self).__module__.split(".")[-2]

    def parameters(self, robot: Robot) -> Iterator[Parameter]:
        """What its values are."""
        raise NotImplementedError

    def mistaken(self, robot: Robot) -> Iterator[tuple[str, Any]]:
        """(slip, the energy or the force) as it is got wrong; the slips are in `answers.diagnosis.slips`."""
        yield from ()

    @property
    def along(self) -> tuple[Expr, Expr] | None:
        """(x, k) where it acts along a linear form x of the coordinates with a coefficient k, as drawn."""
        return None

    def functions(self, robot: Robot) -> tuple[Function, ...]:
        """Functions of the rates in its force, which jump: they stand in none of its values."""
        return ()

    @property
    def values(self) -> Iterator[Expr]:
        """Its exact values."""
        return (value for value in astuple(self) if isinstance(value, Expr))

    def with_values(self, changed: Callable[[Expr], Expr]) -> Self:
        """The same with every value changed, into those of another ring for example."""
        fields = asdict(self)
        return replace(self, **{name: changed(v) for name, v in fields.items() if isinstance(v, Expr)})


class Stored(Act, frozen=True):
    """What stores energy, a part of P_s."""

    term: ClassVar[str] = "Ps"

    @property
    def energy(self) -> Expr:
        """The potential energy, a function of the coordinates."""
        raise NotImplementedError

    def energy_at(self, values: Values) -> float:
        """The same in numbers, for the independent check, by no formula of `energy`."""
        raise NotImplementedError


class Resisting(Act, frozen=True):
    """What has no potential and stands beside g, a part of the friction."""

    term: ClassVar[str] = "friction"

    def force(self, robot: Robot) -> Matrix:
        """The generalized force, n×1."""
        raise NotImplementedError

    def force_at(self, robot: Robot, values: Values) -> Sequence[float]:
        """The same in numbers, n of them, for the independent check, by no formula of `force`."""
        raise NotImplementedError


class Rotor(Act, frozen=True):
    """What spins beside the bodies and has a part in K_m: it turns coordinate `turns`, counted from 0.

    It spins with `ratio` q̇ about its axis, the axis x, y or z (`axis` 0, 1 or 2) of frame
    `carrier`, and is carried round by that link; a carrier 0 is the ground.  Its mass is a body's.
    """

    turns: int
    inertia: Expr
    ratio: Expr
    carrier: int = 0
    axis: int = 2
    term: ClassVar[str] = "Km"


class Actions(Struct, frozen=True):
    """Everything that acts; `passive` are the coordinates, from 0, that no motor drives."""

    acts: tuple[Act, ...] = ()
    passive: tuple[int, ...] = ()

    @property
    def stored(self) -> tuple[Stored, ...]:
        """What stores energy."""
        return tuple(act for act in self.acts if isinstance(act, Stored))

    @property
    def rotors(self) -> tuple[Rotor, ...]:
        """What spins."""
        return tuple(act for act in self.acts if isinstance(act, Rotor))

    @property
    def resisting(self) -> tuple[Resisting, ...]:
        """What stands beside g and has no potential."""
        return tuple(act for act in self.acts if isinstance(act, Resisting))

    @property
    def resistance(self) -> tuple[str, ...]:
        """The name of what resists, where anything does: it stands in the equations beside D, C q̇ and g."""
        return ("friction",) if self.resisting else ()

    @property
    def terms(self) -> frozenset[str]:
        """The results of which there are parts."""
        return frozenset(act.term for act in self.acts)

    @property
    def by_kind(self) -> dict[str, list[Act]]:
        """Those of each kind that there is, in the order of the kinds."""
        found: dict[str, list[Act]] = {}
        for act in self.acts:
            found.setdefault(act.kind, []).append(act)
        return found

    def __bool__(self) -> bool:
        """Whether there is anything."""
        return bool(self.acts or self.passive)


NOTHING_ACTS = Actions()


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
