"""The model of a manipulator: joints in a Denavit-Hartenberg table, and bodies that have mass.

A mechanism by positions has bodies and no joints, a given model neither; see `actions`.

Everything here is exact, frozen and whole.  Lengths, masses and inertias are
elements of one ring (`robot.ring`); angles are linear forms in the coordinates.
A `Robot` knows no file and no printing.
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum
from fractions import Fraction

from msgspec import Struct, field

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.notation.tree import Node
from dynsolve.robot.actions import NOTHING_ACTS, Actions, BodyTurn, GivenModel
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
        """The generalized force: a torque τ_i for an angle, a force f_i for a length."""
        return f"{'tau' if self.type is JointType.REVOLUTE else 'f'}{self.index}"


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
    density: Density | None = None
    turns: tuple[BodyTurn, ...] = ()

    @property
    def is_point(self) -> bool:
        """Whether the body has no inertia about its own mass centre."""
        return self.inertia is None


class Robot(Struct, frozen=True):
    """A manipulator.

    `base_rotation` (3×3, the product of `base_turns`) and `base_position` (3×1) place frame 0 in the world;
    `gravity` (3×1, world) is the acceleration of gravity, pointing down.  `inputs` are the names
    of generalized forces that results hold.  `questions` are
    what the exercise asks around this model, `actions` what acts beside gravity.  Without joints the
    bodies are given by their positions, or `given` stands in their place.
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

    @property
    def has_table(self) -> bool:
        """Whether it is an arm with a table, and so with frames and a Jacobian of its end."""
        return bool(self.joints)

    @property
    def has_dynamics(self) -> bool:
        """Whether it has mass: bodies, or a model that is given."""
        return bool(self.bodies) or self.given is not None

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
        return all(joint.rates == ((i, Fraction(1)),) for i, joint in enumerate(moving))

    def joints_of(self, q: Coordinate) -> tuple[tuple[Joint, Fraction], ...]:
        """The joints that a coordinate moves, each with the rate of its variable."""
        return tuple((joint, rate) for joint in self.joints for k, rate in joint.rates if k == q.index - 1)

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
