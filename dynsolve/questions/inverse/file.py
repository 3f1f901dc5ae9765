"""`reach`, `branches` and `limits` of a problem file: what r(q) is to be, and the ranges of the joints.

With numbers they become the robot's `Target`: every name in them has its number.  The numbers of parameters
are those of `values`, exact as they are written and in the unit in which they are written, as those of
`reach` are.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from operator import mul

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.angles import angle_from_tree, names_of
from dynsolve.errors import AlgebraError
from dynsolve.notation.text import ARCS
from dynsolve.notation.text import read as read_formula
from dynsolve.notation.tree import Function, Node, Symbol, names_in, walk
from dynsolve.notation.tree_values import evaluate
from dynsolve.problem.cells import Cell, forbid, read_angle, read_cell
from dynsolve.problem.kinds import Fields, describe, items, word
from dynsolve.problem.kinematic_keys import MAX_TASK
from dynsolve.problem.state import Around, Given
from dynsolve.problem.table import by_coordinate
from dynsolve.problem.values import CellValues
from dynsolve.problem.yaml_nodes import (
    Faults,
    FaultyNode,
    ListNode,
    MappingNode,
    ScalarNode,
    Span,
    YamlNode,
    too_many,
)
from dynsolve.questions.inverse.keys import ALL, BRANCHES, LIMITS, REACH
from dynsolve.robot.model import JointType, Robot
from dynsolve.robot.questions import Limits, Target


class ParsedReach(Struct, frozen=True):
    """The values of r(q), names or expressions, and where they stand."""

    cells: tuple[Cell, ...] = ()
    span: Span = (0, 0)

    def names(self, parameters: Collection[str]) -> tuple[str, ...]:
        """The names that are new here, one for each value that is nothing but such a name."""
        found = (cell.tree.name for cell in self.cells if isinstance(cell.tree, Symbol))
        return tuple(name for name in found if name != "pi" and name not in parameters)


NO_REACH = ParsedReach()
"""What a file without the key has."""


class ParsedLimits(Struct, frozen=True):
    """The range of one coordinate, and where it stands."""

    coordinate: str
    low: Cell
    high: Cell
    span: Span


class GivenTarget(Given, frozen=True):
    """What is to be reached, in which branches, and the ranges of the coordinates."""

    reach: ParsedReach = NO_REACH
    all_branches: bool = False
    limits: tuple[ParsedLimits, ...] = ()


def read(faults: Faults, fields: Fields, around: Around) -> GivenTarget:
    """The keys of a file; what is wrong is reported."""
    reach = _read_reach(faults, fields.get("reach"), around.coordinates)
    limits = tuple(_read_limits(faults, fields.get("limits"), around.coordinates))
    return GivenTarget(
        targeted=(*reach.cells, *(end for one in limits for end in (one.low, one.high))),
        reach=reach,
        all_branches=word(faults, fields.get("branches"), ALL.choices, "branches", BRANCHES.help) is not None,
        limits=limits,
    )


def _read_reach(faults: Faults, node: YamlNode | None, coordinates: Collection[str]) -> ParsedReach:
    """The values under `reach`; what is wrong with one is reported."""
    help = REACH.help
    listed = list(_rejoined(faults, items(faults, node, "reach", help)))
    if node is None or isinstance(node, FaultyNode):
        return NO_REACH
    if len(listed) > MAX_TASK:
        faults.error(node.span, f"{len(listed)} values; at most {MAX_TASK} are read", "leave some out")
        return NO_REACH
    cells = tuple(
        read_cell(faults, item, f"value {i} of reach", arcs=True) for i, item in enumerate(listed, 1)
    )
    known = tuple(cell for cell in cells if cell)
    names: set[str] = set()
    for cell in known:
        if not isinstance(cell.tree, Symbol):
            forbid(faults, [cell], coordinates, "a value holds numbers and parameters")
        elif cell.tree.name in coordinates or cell.tree.name in names:
            message = f"{cell.tree.name} means something else already"
            faults.error(cell.span, message, "give the value another name")
        else:
            names.add(cell.tree.name)
    return ParsedReach(known, node.span) if len(known) == len(cells) else NO_REACH


def _rejoined(faults: Faults, listed: Sequence[YamlNode]) -> Iterator[YamlNode]:
    """The items, those that a comma inside parentheses has cut made one again: atan2(4, 3)."""
    waiting = list(listed)
    while waiting:
        node = waiting.pop(0)
        while isinstance(node, ScalarNode) and waiting and node.text.count("(") > node.text.count(")"):
            end = waiting.pop(0).span[1]
            node = replace(node, text=faults.source.text[node.start : end])
        yield node


def _read_limits(faults: Faults, node: YamlNode | None, kinds: Mapping[str, str]) -> Iterator[ParsedLimits]:
    """The ranges under `limits`; what is wrong with one is reported."""
    help = LIMITS.help
    if node is None or isinstance(node, FaultyNode):
        return
    if not isinstance(node, MappingNode):
        faults.error(node.span, "limits is a mapping from coordinates to ranges", help)
        return
    for name, value in by_coordinate(faults, node, kinds, help):
        if not isinstance(value, ListNode) or len(value.items) != 2:
            if not isinstance(value, FaultyNode):
                message = f"the range of {name} is a list [low, high], not {describe(value)}"
                if isinstance(value, ListNode):
                    message = f"the range of {name} has {len(value.items)} ends, not 2"
                remedy = too_many(value, help) if isinstance(value, ListNode) else help
                faults.error(value.span, message, remedy)
        else:
            low, high = (_end(faults, item, name, kinds) for item in value.items)
            if low and high:
                yield ParsedLimits(name, low, high, value.span)


def _end(faults: Faults, node: YamlNode, name: str, kinds: Mapping[str, str]) -> Cell | None:
    cell = read_cell(faults, node, f"the range of {name}")
    forbid(faults, [cell], kinds, "a range holds numbers and parameters")
    if cell and kinds[name] == "revolute" and read_angle(faults, cell) is None:
        return None
    return cell


def build(values: CellValues, robot: Robot, given: GivenTarget) -> Robot:
    """The robot with the names, or the numbers, of the values of its task."""
    questions = replace(robot.questions, all_branches=given.all_branches)
    task = questions.task
    if task is None or not task.reached:
        return replace(robot, questions=questions)
    _check_reach(values.faults, given.reach, len(task.reached))
    builder = TargetBuilder(values.faults, values.written, robot.parameters)
    kinds = {q.name: q.type for q in robot.coordinates}
    target = builder.target(given.reach, [_is_angle(entry, kinds) for entry in task.entries])
    if target is not None and task.is_pose:
        builder.check_rotation(given.reach)
    questions = replace(
        questions,
        reach=builder.names(given.reach),
        target=target,
        limits=builder.limits(given.limits),
    )
    return replace(robot, questions=questions)


def _check_reach(faults: Faults, reach: ParsedReach, rows: int) -> None:
    """There is a value for each component of the task."""
    if reach.cells and len(reach.cells) != rows:
        faults.error(
            reach.span,
            f"reach has {len(reach.cells)} value{'s' * (len(reach.cells) > 1)}; the task has {rows}",
            "give one value for each component of the task, in their order",
        )


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
        self.numbers: dict[str, Node] = {name: read_formula(text).tree for name, text in written.items()}

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
    return read_formula(name).tree


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


def _is_angle(entry: Node, kinds: Mapping[str, JointType]) -> bool:
    """Whether a component of the task is a sum of joint angles."""
    try:
        angle = angle_from_tree(entry)
    except AlgebraError:
        return False
    return any(kinds.get(name) is JointType.REVOLUTE for name in names_of(angle))
