"""What an exercise asks of a manipulator around its model: points, a task, and which results it wants.

A `Robot` carries its `Questions`, so that the quantities, the derivation and the judging of
answers know them wherever they know the robot.  Formulas that may hold quantities of the
derivation (the coordinates of a point) are kept as trees, in which a `Reference` to row i
of `tip`, or of a point's name, stands for them; they have the same meaning in every ring.

What an exercise asks of the equations of motion beside the course's derivation.

`Questions.model` holds it, so that it goes wherever the robot goes.  Values are exact, in the
robot's ring.
"""

from __future__ import annotations

from enum import StrEnum

from msgspec import Struct

from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.matrix import Matrix
from dynsolve.notation.tree import Node, Reference, walk

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


# What an exercise asks of the equations of motion beside the course's derivation


def reference(name: str) -> str:
    """The name of the reference of a coordinate, of which q̇_r and q̈_r are rates: q1r.

    >>> reference("theta1")
    'theta1r'
    """
    return f"{name}r"


class ModelQuestions(Struct, frozen=True):
    """What is asked of the model.

    `known` are the names of the parameters that do not count as unknown in τ = Y a.  `parameters`
    (p×1) are the entries of a where the exercise gives them, `named` the names that it gives them.
    `inputs_given` says that motors hold their coordinates in equilibria.  `linearize` is one of
    these: (name, 0, value) of the coordinates that are given.  `steady` are the coordinates whose rates
    are constant, with these.  `balanced` (n×1) is the g that parameters are to give, where it is not 0.
    `assumed` are inequalities between parameters, which count as positive besides.
    """

    known: frozenset[str] = frozenset()
    named: tuple[str, ...] = ()
    parameters: Matrix | None = None
    linearize: tuple[tuple[str, int, Node], ...] = ()
    inputs_given: bool = False
    balanced: Matrix | None = None
    steady: tuple[tuple[str, Node], ...] = ()
    assumed: tuple[Bound, ...] = ()

    @property
    def equilibrium(self) -> dict[tuple[str, int], Node]:
        """The values of the equilibrium by (name, number of dots)."""
        return {(name, dots): value for name, dots, value in self.linearize}


NO_MODEL_QUESTIONS = ModelQuestions()
"""Of an exercise that asks nothing of the model."""

TIP = "tip"
"""The origin of the last frame, as a task names it."""


class Method(StrEnum):
    """The way to the forces τ: from the Lagrangian, or link by link by Newton's and Euler's laws."""

    LAGRANGE = "lagrange"
    NEWTON_EULER = "newton-euler"


class NamedPoint(Struct, frozen=True):
    """A point fixed in frame `link`: its `position` there, 3×1; `written` is how the file gave it.

    Its velocity and its Jacobians are written along the axes of frame `axes`, or of the world.
    """

    name: str
    link: int
    position: Matrix
    written: str = ""
    axes: int | None = None


class Task(Struct, frozen=True):
    """What the arm is to do: r(q), m×1, or its twist, the six rates J q̇ of the last frame.

    `entries` are the components of r, none of a twist.  `is_default` says that the file does
    not give them: they are then the coordinates of the tip that move.  `is_pose` says that the
    last frame is also to have a pose, position and rotation; its rates are the twist.  `mark` stands
    behind the letters of the values that are to be reached, where these mean something else without it.
    """

    entries: tuple[Node, ...]
    is_twist: bool = False
    is_default: bool = False
    is_pose: bool = False
    mark: str = ""

    @property
    def rows(self) -> int:
        """m, the number of components."""
        return 6 if self.is_twist else len(self.entries)

    @property
    def reached(self) -> tuple[str, ...]:
        """Names of what is to be reached: r1, r2, ...; of a pose x, y, z, r11 ... r33; none of a twist."""
        if self.is_pose:
            turned = (f"{row}{column}" for row in (1, 2, 3) for column in (1, 2, 3))
            return (*(f"{axis}{self.mark}" for axis in "xyz"), *(f"r{self.mark}{place}" for place in turned))
        return tuple(f"r{self.mark}{k}" for k in range(1, len(self.entries) + 1))


def coordinate_of(point: str, axis: int) -> Reference:
    """x, y or z (axis 0, 1 or 2) of a point, as it stands in a task."""
    return Reference(point, axis + 1, 1)


_AXES = "xyz"


def component_names(questions: Questions) -> tuple[tuple[str, ...], ...]:
    """What else each component of r(q) is called: x, px, xtip of a point, and as what is to be reached is."""
    task = questions.task
    if task is None or task.is_twist:
        return ()
    if not questions.reach:
        return tuple(map(_names_of, task.entries))
    return tuple((*_names_of(entry), name) for entry, name in zip(task.entries, questions.reach, strict=True))


def _names_of(entry: Node) -> tuple[str, ...]:
    if not isinstance(entry, Reference) or entry.row is None:
        return ()
    axis = _AXES[entry.row - 1]
    if entry.quantity != TIP:
        return f"{axis}{entry.quantity}", f"p{entry.quantity}{axis}"
    return axis, f"p{axis}", f"{axis}e", f"{axis}tip", f"tip{axis}"


def points_of(task: Task) -> tuple[str, ...]:
    """The points whose coordinates stand in a task, each once."""
    found = (part.quantity for part in walk(*task.entries) if isinstance(part, Reference))
    return tuple(dict.fromkeys(found))


class Load(Struct, frozen=True):
    """A force and a moment that act on link `link` from outside, at a point.

    `position` is the point in frame `link`, `force` and `moment` (3×1) are in the world, or
    where `axes` (3×3) is given along these axes in frame `link`; `turns` are their rotation as
    the problem writes it, none of a matrix.  `point` is what the point is called, where the
    exercise names it or it is the tip.
    """

    link: int
    position: Matrix
    force: Matrix
    moment: Matrix
    axes: Matrix | None = None
    point: str = ""
    by_robot: bool = False
    turns: tuple[tuple[str, Node], ...] = ()


FOR_EVERY_Q = "Q(q)"
"""The rule of Q in every configuration, as equations of motion have it; `Q` is that of the given state."""


class State(Struct, frozen=True):
    """Values of coordinates and their rates, formulas free of coordinates; others are free."""

    values: tuple[tuple[str, int, Node], ...] = ()

    @property
    def by_symbol(self) -> dict[tuple[str, int], Node]:
        """The values by (name, number of dots)."""
        return {(name, dots): value for name, dots, value in self.values}

    def __bool__(self) -> bool:
        """Whether there is any value."""
        return bool(self.values)


class Limits(Struct, frozen=True):
    """The range of a coordinate, its ends formulas of numbers and of parameters that have one."""

    coordinate: str
    low: Node
    high: Node


class Target(Struct, frozen=True):
    """What r(q) is to be, in numbers: `values` are formulas of numbers and of the parameters.

    `numbers` are the values of parameters, formulas without names.
    """

    values: tuple[Node, ...]
    numbers: tuple[tuple[str, Node], ...] = ()


class Questions(Struct, frozen=True):
    """Everything that a file asks beside the course's derivation.

    `asked` are the names of the answers in `find` and `marks` that no derivation has unless
    they are asked for; with them comes what they are derived from, and nothing else.
    `is_drawn` says that the table was found from a drawing.
    `loads` are the forces from outside; `state` is where rates and torques are asked for,
    `velocity` and `acceleration` (m×1) what the task is to have there.  `reach` are the names of
    the values of r(q) in the inverse kinematics, as the file has them; `all_branches` says that an
    answer must have them all.  `target` is what r(q) is to be where the file gives numbers for it,
    `limits` are the ranges of coordinates.  `state_is_reached` says that the state is the
    one configuration within the limits that reaches the target, `state_is_open` that it is still to be
    found.  `weights` (n×n) are those of the rates where
    many do, `weighs_by_inertia` says that they are D.  `method` is the way to τ.  `model` is what is
    asked of the equations of motion, `constraints` are what every motion keeps at 0,
    `candidates` matrices that are to be judged.
    """

    points: tuple[NamedPoint, ...] = ()
    task: Task | None = None
    asked: frozenset[str] = frozenset()
    is_drawn: bool = False
    loads: tuple[Load, ...] = ()
    state: State = State()
    velocity: Matrix | None = None
    acceleration: Matrix | None = None
    reach: tuple[str, ...] = ()
    all_branches: bool = False
    target: Target | None = None
    limits: tuple[Limits, ...] = ()
    method: Method = Method.LAGRANGE
    constraints: tuple[Constraint, ...] = ()
    state_is_reached: bool = False
    weights: Matrix | None = None
    weighs_by_inertia: bool = False
    model: ModelQuestions = NO_MODEL_QUESTIONS
    candidates: tuple[Candidate, ...] = ()

    @property
    def given(self) -> frozenset[str]:
        """What is given that results may need (`Family.needs`), by its key."""
        there = {
            "velocity": self.velocity is not None,
            "acceleration": self.acceleration is not None,
            "linearize": bool(self.model.linearize),
        }
        return frozenset(name for name, given in there.items() if given)

    @property
    def state_is_open(self) -> bool:
        """Whether the state that reaches the target is not known yet."""
        return self.state_is_reached and not self.state

    @property
    def reached(self) -> tuple[str, ...]:
        """The names of what is to be reached, those of the task unless the file names it."""
        if self.reach or self.task is None:
            return self.reach
        return self.task.reached
