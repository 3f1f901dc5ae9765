"""The model of a manipulator: joints in a Denavit-Hartenberg table, and bodies that have mass.

A mechanism by positions has bodies and no joints: a body's mass centre is a function of the coordinates, its
orientation a product of turns.  Of a given model, the inertia matrix, the energies or the Lagrangian, no body
is known either.

What acts beside gravity is one of three terms: it stores energy (P_s), has kinetic energy of its own (K_m),
or resists without a potential (friction).  Rooms know these terms; of which kinds they are is in the folders
of `dynsolve.acts`.

Everything here is exact, frozen and whole.  Lengths, masses and inertias are
elements of one ring (`robot.ring`); angles are linear forms in the coordinates.
A `Robot` knows no file and no printing.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from enum import Enum
from fractions import Fraction
from typing import Any, ClassVar, Self

from msgspec import Struct, field
from msgspec.structs import asdict, astuple, replace

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.notation.tree import Function, Node, Sum
from dynsolve.robot.actions import Parameter, Values
from dynsolve.robot.questions import Questions
from dynsolve.robot.shapes import Density, Shape
from dynsolve.robot.units import LENGTH, NONE, Dimension


class Convention(Enum):
    """How the four Denavit-Hartenberg parameters make a transformation.

    STANDARD: A_i = Rot_z(θ) Trans_z(d) Trans_x(a) Rot_x(α)   (Spong)
    MODIFIED: A_i = Rot_x(α) Trans_x(a) Rot_z(θ) Trans_z(d)   (Craig)
    """

    STANDARD = "standard"
    MODIFIED = "modified"


class JointType(Enum):
    """The type of a coordinate: an angle or a length."""

    REVOLUTE = "revolute"
    PRISMATIC = "prismatic"


class Coordinate(Struct, frozen=True):
    """A generalized coordinate q_i; `index` counts from 1."""

    name: str
    type: JointType
    index: int

    @property
    def velocity(self) -> str:
        """The name of its velocity in plain text."""
        return f"{self.name}_dot"

    @property
    def acceleration(self) -> str:
        """The name of its acceleration in plain text."""
        return f"{self.name}_ddot"

    @property
    def dimension(self) -> Dimension:
        """A number of an angle, or a length."""
        return LENGTH if self.type is JointType.PRISMATIC else NONE

    @property
    def force(self) -> str:
        """The answer that is its generalized force: a torque τ_i for an angle, a force f_i for a length."""
        return f"{self.force_letter}{self.index}"

    @property
    def force_letter(self) -> str:
        """The letter of its generalized force."""
        return "tau" if self.type is JointType.REVOLUTE else "f"


class Joint(Struct, frozen=True):
    """One row of the table: the step from frame i-1 to frame i; `index` i counts from 1.

    `branch` is the frame that it starts from, where that is not the one before: a tree.  `variable` is
    "theta" or "d" where that column holds the joint variable, None for a fixed frame.  The joint
    variable is Σ rate·q_k plus a constant: `rates` holds (index of the coordinate from 0, rate).
    `written` are the four columns θ, d, a, α as they stand in the table.
    """

    index: int
    theta: Angle
    d: Expr
    a: Expr
    alpha: Angle
    variable: str | None
    rates: tuple[tuple[int, Fraction], ...]
    written: tuple[Node, Node, Node, Node]
    branch: int | None = None

    @property
    def parent(self) -> int:
        """The frame that the row starts from."""
        return self.index - 1 if self.branch is None else self.branch

    @property
    def type(self) -> JointType | None:
        """Revolute, prismatic, or None for a fixed frame."""
        return {"theta": JointType.REVOLUTE, "d": JointType.PRISMATIC, None: None}[self.variable]


def path_to(joints: Sequence[Joint], link: int) -> tuple[Joint, ...]:
    """The joints between the base and a frame, the first one first."""
    found: list[Joint] = []
    while link:
        joint = joints[link - 1]
        found.append(joint)
        link = joint.parent
    return tuple(reversed(found))


class AxesKind(Enum):
    """The frame relative to which a body-attached frame is given.

    LINK: R_b = R_i · rotation; turns with frame i.
    REST: parallel to frame 0 at q = 0, and turns with the link.
    BASE: R_b is `rotation` itself, given from frame 0, a function of q.
    """

    LINK = "link"
    REST = "rest"
    BASE = "base"


AxisTurns = tuple[tuple[str, Node], ...]
"""The factors of a rotation as the problem writes them: (x, y or z, angle); none of a matrix."""


class Axes(Struct, frozen=True):
    """The orientation of a body-attached frame; `rotation` is 3×3, the product of `turns`."""

    kind: AxesKind
    rotation: Matrix
    written: str = ""
    turns: AxisTurns = ()


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


class DrawnPoint(Struct, frozen=True):
    """A point of a drawing, as trees: where it is in the world, and in its pose a link's axes and the way.

    The way is that from the origin of the link's frame, in the world.
    """

    at: tuple[Node, ...]
    axes: tuple[tuple[Node, ...], ...]
    away: tuple[Node, ...]


class Body(Struct, frozen=True):
    """A body that has mass, rigidly fixed to frame `link`.

    `center` is the mass centre in frame `link` (3×1).  `inertia` is the tensor in
    the body-attached frame (3×3, kg m²), about `about_point` (3×1 in frame `link`)
    or, where that is None, about the mass centre.  A point mass has inertia None.
    `density` is that of a shape whose mass and tensor follow from it, perhaps its centre.
    `center_written` and `about` say how the file gave them (`tip`, `midpoint`,
    `origin`, ...), for the explanation.  A body of a mechanism by positions has link 0, a
    centre in the world that is a function of the coordinates, and `turns`.
    """

    name: str
    mass: Expr
    link: int
    center: Matrix
    axes: Axes
    inertia: Matrix | None = None
    shape: Shape | None = None
    about: str = "center"
    about_point: Matrix | None = None
    center_written: str = ""
    drawn: DrawnPoint | None = None
    density: Density | None = None
    turns: tuple[BodyTurn, ...] = ()

    @property
    def is_point(self) -> bool:
        """Whether the body has no inertia about its own mass centre."""
        return self.inertia is None

    @property
    def uniform_shape(self) -> Shape | None:
        """The shape of a uniform body, be its mass given or its density."""
        if self.density is None:
            return self.shape
        return None if self.density.varies else self.density.shape


class GivenModel(Struct, frozen=True):
    """What a file gives in the place of bodies: D and P, K and P, or L; what it does not give is None.

    D is n×n, the others are scalars, of which `typed` has the formulas as they are in the file.
    """

    D: Matrix | None = None
    K: Expr | None = None
    P: Expr | None = None
    L: Expr | None = None
    typed: tuple[tuple[str, Node], ...] = ()


# What acts beside gravity, of whatever kind


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

    @property
    def differences(self) -> tuple[tuple[Expr, Expr], ...]:
        """(a, b) of each difference a - b that is written like that wherever it is a factor."""
        return ()

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


# The whole


class Robot(Struct, frozen=True):
    """A manipulator.

    `base_rotation` (3×3, the product of `base_turns`) and `base_position` (3×1) place frame 0 in the world;
    `gravity` (3×1, world) is the acceleration of gravity, pointing down.  `inputs` are the names
    of the generalized forces, one a coordinate, where results hold them.  `questions` are
    what the exercise asks around this model, `actions` what acts beside gravity.  Without joints the
    bodies are given by their positions, or `given` stands in their place.  `has_decimals` says that numbers
    were written as 0.3, and not as 3/10; where masses are letters, a half of a letter is none: 0.5 l.
    `decimals` are the numbers with decimals as they were written, `typed_sums` the sums.
    """

    ring: Ring
    convention: Convention
    coordinates: tuple[Coordinate, ...]
    joints: tuple[Joint, ...]
    bodies: tuple[Body, ...]
    gravity: Matrix
    base_rotation: Matrix
    base_position: Matrix
    parameters: tuple[str, ...] = field(default=())
    inputs: tuple[str, ...] = field(default=())
    questions: Questions = field(default=Questions())
    actions: Actions = NOTHING_ACTS
    given: GivenModel | None = None
    base_turns: AxisTurns = ()
    has_decimals: bool = False
    decimals: frozenset[Fraction] = frozenset()
    typed_sums: tuple[Sum, ...] = ()

    @property
    def has_table(self) -> bool:
        """Whether it is an arm with a table, and so with frames and a Jacobian of its end."""
        return bool(self.joints)

    @property
    def is_numeric(self) -> bool:
        """Whether the masses are numbers."""
        return any(body.mass.is_number and not body.mass.is_zero for body in self.bodies)

    @property
    def has_dynamics(self) -> bool:
        """Whether it has mass: bodies, or a model that is given."""
        return bool(self.bodies) or self.given is not None

    @property
    def held(self) -> tuple[str, ...]:
        """What g is made of: terms of gravity, of springs; of a model that is given its potential energy."""
        if self.given is not None:
            return ("potential",)
        has_springs = bool(self.actions.stored)
        is_heavy = not (has_springs and self.gravity.is_zero)
        return (*["gravity"] * is_heavy, *["spring"] * has_springs)

    @property
    def held_by(self) -> str:
        """What acts without rates: "gravity and springs", of a model that is given "the potential energy"."""
        nouns = {"spring": "springs", "potential": "the potential energy"}
        return " and ".join(nouns.get(each, each) for each in self.held)

    @property
    def rolls(self) -> bool:
        """Whether a body without links turns with a length, or moves with an angle, as what rolls does."""
        angles = [q.type is JointType.REVOLUTE for q in self.coordinates]
        turning = [q.name for q, is_angle in zip(self.coordinates, angles, strict=True) if is_angle]
        places = [self.ring.symbol_indices[name, 0] for name in turning]
        for body in self.bodies if not self.has_table else ():
            rates = [pair for turn in body.turns for pair in zip(turn.rates.entries, angles, strict=True)]
            if any(not (rate.is_zero or (is_angle and rate.is_number)) for rate, is_angle in rates):
                return True
            if any(entry.poly.degrees()[place] > 0 for entry in body.center.entries for place in places):
                return True
        return False

    @property
    def n(self) -> int:
        """The number of degrees of freedom."""
        return len(self.coordinates)

    def bodies_on(self, link: int) -> tuple[Body, ...]:
        """The bodies that are fixed to a frame."""
        return tuple(body for body in self.bodies if body.link == link)

    def links_after(self, link: int) -> tuple[int, ...]:
        """The frames that start at a frame."""
        return tuple(joint.index for joint in self.joints if joint.parent == link)

    def path(self, link: int) -> tuple[Joint, ...]:
        """The joints between the base and a frame, the first one first."""
        return path_to(self.joints, link)

    @property
    def is_tree(self) -> bool:
        """Whether some row starts from another frame than the one before."""
        return any(joint.parent != joint.index - 1 for joint in self.joints)

    @property
    def moves_each_joint_alone(self) -> bool:
        """Whether each coordinate is the variable of one joint, in their order."""
        moving = [joint for joint in self.joints if joint.type]
        return [joint.rates for joint in moving] == [((i, Fraction(1)),) for i in range(self.n)]

    def joints_of(self, q: Coordinate) -> tuple[tuple[Joint, Fraction], ...]:
        """The joints that a coordinate moves, each with the rate of its variable."""
        return tuple((joint, rate) for joint in self.joints for k, rate in joint.rates if k == q.index - 1)

    def number_of(self, joint: Joint) -> int:
        """Which of the joints one is, from 1, as a book counts them: fixed rows are none."""
        return sum(1 for before in self.joints[: joint.index] if before.type)

    def is_of_motor(self, q: Coordinate) -> bool:
        """Whether a coordinate is the angle of a rotor alone: in the table no joint has it."""
        return self.has_table and not self.joints_of(q)

    @property
    def ends_in_a_joint(self) -> bool:
        """Whether the last frame lies in the last joint, and the table does not reach the end of the arm.

        In the modified convention frame i lies on the axis of joint i, at the near end of link i.
        """
        modified = self.convention is Convention.MODIFIED
        return modified and bool(self.joints) and self.joints[-1].type is JointType.REVOLUTE
