"""`reach` and `limits` with numbers -> the robot's `Target`: every name in them has its number.

The numbers of parameters are those of `values`, exact as they are written and in the unit in
which they are written, as those of `reach` are.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from operator import mul

from dynsolve.algebra.angles import angle_from_tree
from dynsolve.errors import AlgebraError
from dynsolve.notation.text import read
from dynsolve.notation.tokens import ARCS
from dynsolve.notation.tree import Function, Node
from dynsolve.notation.tree_values import evaluate
from dynsolve.notation.walk import names_in, walk
from dynsolve.problem.cells import Cell, read_angle
from dynsolve.problem.reach import ParsedLimits, ParsedReach
from dynsolve.problem.source import Faults
from dynsolve.robot.questions import Limits, Target

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
            elif _is_angle(cell.tree):
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


def _is_angle(node: Node) -> bool:
    """Whether a formula is a number of degrees, and not 0."""
    try:
        angle = angle_from_tree(node)
    except AlgebraError:
        return False
    return bool(angle.degrees) and angle.is_constant
