"""What a file asks around the model -> the robot's `Questions`, with exact values.

`reach` and `limits` with numbers -> the robot's `Target`: every name in them has its number.

The numbers of parameters are those of `values`, exact as they are written and in the unit in
which they are written, as those of `reach` are.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from operator import mul

from msgspec.structs import replace

from dynsolve.algebra.angles import angle_from_tree, names_of
from dynsolve.algebra.matrix import Matrix, determinant
from dynsolve.errors import AlgebraError
from dynsolve.notation.text import ARCS, read
from dynsolve.notation.tree import Function, Node, names_in, walk
from dynsolve.notation.tree_values import evaluate
from dynsolve.problem.actions import ParsedLoad, ParsedWeights
from dynsolve.problem.cells import Cell, read_angle
from dynsolve.problem.questions import (
    ParsedLimits,
    ParsedPoint,
    ParsedQuestions,
    ParsedRates,
    ParsedReach,
    ParsedTask,
    check_reach,
)
from dynsolve.problem.values import CellValues, PlaceBuilder
from dynsolve.problem.yaml_nodes import Faults
from dynsolve.quantities.letters import has_base
from dynsolve.quantities.owners import asked_stages
from dynsolve.quantities.stages import Stage
from dynsolve.robot.geometry import last_origin
from dynsolve.robot.model import JointType, Robot
from dynsolve.robot.questions import (
    TIP,
    Limits,
    Load,
    NamedPoint,
    Questions,
    State,
    Target,
    Task,
    coordinate_of,
)

# `reach` and `limits` with numbers -> the robot's `Target`

ORTHONORMAL = 1e-8
"""How far from orthonormal a rotation may be."""

_NAMED = "give it one under `values`"


class TargetBuilder:
    """Makes the target of a file.

    `written` are its `values`, `parameters` the names in its table and bodies.
    """

    def __init__(self, faults: Faults, written: Mapping[str, str], parameters: Sequence[str]) -> None:
        self.faults = faults
        self.parameters = frozenset(parameters)
        self.numbers: dict[str, Node] = {name: read(text).tree for name, text in written.items()}

    def names(self, reach: ParsedReach) -> tuple[str, ...]:
        """The names of the values, where `reach` names them all, perhaps with numbers under `values`.

        Names without a number beside numbers are a fault.
        """
        found, unknown = reach.names(self.parameters), reach.names(self._known)
        if unknown and len(unknown) < len(reach.cells):
            first = next(cell for cell in reach.cells if cell.tree in map(_symbol, unknown))
            self.faults.error(
                first.span,
                f"reach names {first.text}, and gives other values as numbers",
                "name all values of the task, or give a number for each",
            )
        return found if len(found) == len(reach.cells) else ()

    def target(self, reach: ParsedReach, angles: Sequence[bool]) -> Target | None:
        """What r(q) is to be in numbers, None where `reach` names its values, or is not given.

        `angles` says which components of the task are angles; none of a pose.
        """
        if not reach.cells or reach.names(self._known):
            return None
        for number, cell in enumerate(reach.cells):
            if number < len(angles) and angles[number]:
                if not _has_arcs(cell.tree):
                    read_angle(self.faults, cell)
            elif _targets_is_angle(cell.tree):
                help = "write a number: an angle is asked for where the task has a sum of joint angles"
                self.faults.error(cell.span, f"{cell.what} is a length, not an angle", help)
        self._check(reach.cells)
        named = {_symbol(name): self.numbers.get(name) for name in reach.names(self.parameters)}
        values = tuple(named.get(cell.tree) or cell.tree for cell in reach.cells)
        return Target(values, tuple(self.numbers.items()))

    def check_rotation(self, reach: ParsedReach) -> None:
        """The last nine values of a pose are the rows of a rotation: orthonormal, right-handed."""
        cells = reach.cells[3:]
        if not all(name.name in self.numbers for cell in cells for name in cell.names):
            return  # that was reported
        entries = [self._number(cell) for cell in cells]
        off = _off_rotation([entries[k : k + 3] for k in range(0, 9, 3)])
        if off > ORTHONORMAL:
            self.faults.error(
                reach.span,
                f"these rows are no rotation: R Rᵀ differs from the identity, or det R from 1, by {off:.2g}",
                "write its entries exactly, row by row: sqrt(3)/2, cos(30deg)",
            )

    @property
    def _known(self) -> frozenset[str]:
        return self.parameters | self.numbers.keys()

    def limits(self, limits: Sequence[ParsedLimits]) -> tuple[Limits, ...]:
        """The ranges of coordinates; one that ends before it begins is reported."""
        return tuple(self._limits(limits))

    def _limits(self, limits: Sequence[ParsedLimits]) -> Iterator[Limits]:
        for one in limits:
            if not self._check((one.low, one.high)):
                continue
            low, high = self._number(one.low), self._number(one.high)
            if low > high:
                message = f"the range of {one.coordinate} ends before it begins"
                self.faults.error(one.span, message, "write the lower end first")
            yield Limits(one.coordinate, one.low.tree, one.high.tree)

    def _check(self, cells: Sequence[Cell]) -> bool:
        """Whether every name has a number; one that has none is reported."""
        sound = True
        for cell in cells:
            for name in cell.names:
                if name.name not in self.numbers:
                    sound = False
                    self.faults.error(cell.span_of(name), f"{name.name} has no number", _NAMED)
        return sound

    def _number(self, cell: Cell) -> float:
        values = {
            name: float(evaluate(node, {})) for name, node in self.numbers.items() if not names_in(node)
        }
        return float(evaluate(cell.tree, values))


def _off_rotation(R: Sequence[Sequence[float]]) -> float:
    """How far R Rᵀ is from the identity, or det R from 1."""
    (a, b, c), (d, e, f), (g, h, i) = R
    determinant = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    products = (float(sum(map(mul, R[k], R[m]))) - (k == m) for k in range(3) for m in range(3))
    return max(map(abs, (*products, determinant - 1)))


def _symbol(name: str) -> Node:
    return read(name).tree


def _has_arcs(node: Node) -> bool:
    """Whether an angle of a known sine, cosine or direction stands in a formula."""
    return any(isinstance(part, Function) and part.name in ARCS for part in walk(node))


def _targets_is_angle(node: Node) -> bool:
    """Whether a formula is a number of degrees, and not 0."""
    try:
        angle = angle_from_tree(node)
    except AlgebraError:
        return False
    return bool(angle.degrees) and angle.is_constant


def named_point(places: PlaceBuilder, parsed: ParsedPoint) -> NamedPoint | None:
    """The point of an entry of `points:`; None where a fault of it was reported."""
    if parsed.place is None:
        return None
    position = places.position(parsed.place, parsed.link, "at", parsed.written)
    if position is None or parsed.link is None:
        return None
    return NamedPoint(parsed.name, parsed.link, position, parsed.written, parsed.axes)


def load(places: PlaceBuilder, parsed: ParsedLoad, points: Sequence[NamedPoint], last: int) -> Load | None:
    """The force of an entry of `forces:`; None where a fault of it was reported."""
    values, ring = places.values, places.values.ring
    zero = Matrix.zero(ring, 3, 1)
    if parsed.place is None or parsed.link is None:
        return None
    position = places.position(parsed.place, parsed.link, "at", parsed.written)
    force = values.column(parsed.force) if parsed.force else zero
    moment = values.column(parsed.moment) if parsed.moment else zero
    axes = Matrix.identity(ring, 3) if parsed.in_link else None
    if parsed.rotation is not None:
        axes = values.rotation(parsed.rotation, "the axes of a force")
    if position is None or force is None or moment is None:
        return None
    place = parsed.link, position
    called = [p.name for p in points if (p.link, p.position) == place and p.axes is None]
    if parsed.link == last and position.is_zero:
        called.append(TIP)
    point = called[0] if called else ""
    return Load(parsed.link, position, force, moment, axes, point, parsed.by_robot)


def with_questions(
    values: CellValues,
    robot: Robot,
    parsed: ParsedQuestions,
    points: Sequence[NamedPoint],
    loads: Sequence[Load],
    asked: frozenset[str],
    is_drawn: bool,
    written: Mapping[str, str],
) -> Robot:
    """The robot with what its file asks of it; with a task of its own where one is needed and none given."""
    state = parsed.state.values if parsed.state else {}
    questions = Questions(
        points=tuple(_axes_named(robot, point) for point in points),
        task=_task(parsed.task),
        asked=asked | {*(["Q"] if loads else [])},
        loads=tuple(loads),
        state=State(tuple((name, dots, value) for (name, dots), value in state.items())),
        is_drawn=is_drawn,
        all_branches=parsed.all_branches,
        weights=_weights(values, parsed.weights),
        weighs_by_inertia=parsed.weights is not None and parsed.weights.is_inertia,
        state_is_reached=parsed.reached_state is not None,
    )
    robot = replace(robot, questions=questions)
    for stage, given in parsed.of.items():
        robot = stage.part("file").build(values, robot, given)
    questions = robot.questions
    asks_of_tip = parsed.rates or parsed.reached_state or Stage.TASK in asked_stages(questions)
    if questions.task is None and asks_of_tip:
        questions = replace(questions, task=default_task(robot))
    if questions.task is not None and questions.task.reached:
        check_reach(values.faults, parsed.reach, len(questions.task.reached))
        questions = _with_target(values, robot, questions, parsed, written)
        _check_names(values, robot, questions, parsed)
    if parsed.reached_state is not None and questions.target is None:
        help = "write reach: [...] with a number for each component of the task, or give the state itself"
        values.faults.error(parsed.reached_state, "state: reach needs the numbers of a target", help)
    if questions.task is not None:
        rows = questions.task.rows
        questions = replace(
            questions,
            velocity=_rates(values, parsed.velocity, rows),
            acceleration=_rates(values, parsed.acceleration, rows),
        )
    return replace(robot, questions=questions)


def _axes_named(robot: Robot, point: NamedPoint) -> NamedPoint:
    """The point, whose axes are the world's where frame 0 is the world."""
    return replace(point, axes=None) if point.axes == 0 and not has_base(robot) else point


def _with_target(
    values: CellValues,
    robot: Robot,
    questions: Questions,
    parsed: ParsedQuestions,
    written: Mapping[str, str],
) -> Questions:
    """The questions with the names, or the numbers, of the values of the task."""
    assert questions.task is not None
    builder = TargetBuilder(values.faults, written, robot.parameters)
    kinds = {q.name: q.type for q in robot.coordinates}
    angles = [_is_angle(entry, kinds) for entry in questions.task.entries]
    target = builder.target(parsed.reach, angles)
    if target is not None and questions.task.is_pose:
        builder.check_rotation(parsed.reach)
    return replace(
        questions,
        reach=builder.names(parsed.reach),
        target=target,
        limits=builder.limits(parsed.limits),
    )


def _check_names(values: CellValues, robot: Robot, questions: Questions, parsed: ParsedQuestions) -> None:
    """The names of a pose, x, y, z and r11 to r33, are no other things where the file does not name it."""
    taken = {*robot.parameters, *(q.name for q in robot.coordinates)}
    found = [name for name in questions.reached if name in taken]
    if found and parsed.task is not None and parsed.task.is_pose and not parsed.reach.cells:
        message = f"{found[0]} means something else already, and is also the name of a value of the pose"
        help = "name its twelve values under `reach`: the position, then the rotation row by row"
        values.faults.error(parsed.task.span, message, help)


def _is_angle(entry: Node, kinds: Mapping[str, JointType]) -> bool:
    """Whether a component of the task is a sum of joint angles."""
    try:
        angle = angle_from_tree(entry)
    except AlgebraError:
        return False
    return any(kinds.get(name) is JointType.REVOLUTE for name in names_of(angle))


def _weights(values: CellValues, parsed: ParsedWeights | None) -> Matrix | None:
    """W, n×n; None where there is none, where it is D, or where it was reported to be no such matrix."""
    if parsed is None or parsed.is_inertia:
        return None
    columns = [values.column(row) for row in parsed.rows]
    if None in columns:
        return None
    W = Matrix.of(values.ring, [column.entries for column in columns if column])
    help = "weights are symmetric and positive, so that q̇ᵀ W q̇ is a cost"
    if W.T != W:
        values.faults.error(parsed.span, "the matrix of the weights is not symmetric", help)
    for size in range(1, len(W.rows) + 1):
        minor = determinant(Matrix.of(values.ring, [row[:size] for row in W.rows[:size]]))
        if minor.is_zero or (minor.is_number and minor.number < 0):
            values.faults.error(parsed.span, "the matrix of the weights is not positive definite", help)
            return None
    return W


def _rates(values: CellValues, parsed: ParsedRates | None, rows: int) -> Matrix | None:
    """The velocity or acceleration of the task, m×1; one of another length is reported."""
    if parsed is None:
        return None
    if len(parsed.cells) != rows:
        has = f"the task has {rows} component{'s' * (rows != 1)}"
        values.faults.error(
            parsed.span, f"{parsed.key} has {len(parsed.cells)} components; {has}", "write one for each"
        )
        return None
    return values.column(parsed.cells)


def _task(parsed: ParsedTask | None) -> Task | None:
    if parsed is None:
        return None
    return Task(tuple(cell.tree for cell in parsed.cells), is_twist=parsed.is_twist, is_pose=parsed.is_pose)


def default_task(robot: Robot) -> Task:
    """The coordinates of the tip that move, or all where it never does."""
    tip = last_origin(robot)
    moving = [axis for axis in range(3) if robot.ring.depends_on_coordinates(tip[axis, 0])]
    return Task(tuple(coordinate_of(TIP, axis) for axis in moving or range(3)), is_default=True)
