"""What every stage of an explanation looks at: the robot, its exact values, their compact forms."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import islice

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.agreement import Agreement
from dynsolve.derivation.graph import Derivation
from dynsolve.document import Inline, Prose
from dynsolve.explain.forms import Forms
from dynsolve.notation import tree
from dynsolve.notation.tree import Node, Row, Symbol, Words
from dynsolve.notation.walk import walk
from dynsolve.quantities import letters
from dynsolve.robot.model import Body, Convention, Coordinate, Joint, JointType, Robot

LARGEST_WORKING = 260
"""Matrices whose entries have more parts than this are not put into a formula; it stays in letters."""


@dataclass(frozen=True, slots=True)
class Course:
    """A robot with its derivation, exact and as trees, and whether the two ways to D, C, g agree."""

    robot: Robot
    values: Derivation
    forms: Forms
    agreement: Agreement | None = None

    @property
    def standard(self) -> bool:
        """Whether the table is in the standard convention."""
        return self.robot.convention is Convention.STANDARD

    def form(self, name: str) -> Node:
        """The tree of a quantity."""
        return self.forms(name)

    def matrix(self, name: str) -> tree.Matrix:
        """The tree of a quantity that is a matrix."""
        node = self.forms(name)
        assert isinstance(node, tree.Matrix)
        return node

    def show(self, value: Expr | Matrix) -> Node:
        """The tree of any exact value."""
        return self.forms.of(value)

    def mass(self, body: Body) -> Node:
        """The mass of a body in a formula: the problem's symbol, else m_i unless that is another thing."""
        shown = self.show(body.mass)
        if isinstance(shown, Symbol) or letters.is_taken(self.robot, "m", body):
            return shown
        return letters.of_body("m", body)

    @property
    def ground(self) -> str:
        """What everything is seen from: frame 0, or the world in which the problem turns it."""
        return "world" if letters.has_base(self.robot) else "base"


def shv(section: str) -> str:
    """A reference to Spong, Hutchinson, Vidyasagar, Robot Modeling and Control, Wiley, 2006."""
    return f"Spong et al. {section}"


def craig(section: str) -> str:
    """A reference to Craig, Introduction to Robotics, 3rd edition, 2005."""
    return f"Craig {section}"


def turns(q: Coordinate) -> bool:
    """Whether a coordinate is an angle."""
    return q.type is JointType.REVOLUTE


def plain_joint(robot: Robot, k: int) -> Joint | None:
    """The one joint that coordinate k (from 0) moves, at its own rate; None for several, or scaled."""
    moved = [(joint, rate) for joint in robot.joints for i, rate in joint.rates if i == k]
    if len(moved) == 1 and moved[0][1] == 1:
        return moved[0][0]
    return None


def column_of(matrix: tree.Matrix, j: int) -> tree.Matrix:
    """A column of a tree."""
    return tree.Matrix(tuple((row[j],) for row in matrix.rows))


def block_of(matrix: tree.Matrix, rows: int, first: int, last: int) -> tree.Matrix:
    """The first rows of some columns of a tree."""
    return tree.Matrix(tuple(row[first:last] for row in matrix.rows[:rows]))


def side_by_side(parts: Sequence[Node]) -> Row:
    """Formulas on one line, commas between them."""
    row: list[Node] = []
    for part in parts:
        row += [part] if not row else [Words(", "), part]
    return Row(tuple(row))


def listed(parts: Sequence[Prose | Node | str], conjunction: str = "and") -> Prose:
    """a, b and c

    >>> listed(["a", "b", "c"])
    ('a', ', ', 'b', ' and ', 'c')
    """
    prose: list[Inline] = []
    for i, part in enumerate(parts):
        if i:
            prose.append(f" {conjunction} " if i == len(parts) - 1 else ", ")
        prose += list(part) if isinstance(part, tuple) else [part]
    return tuple(prose)


def is_small(*nodes: Node) -> bool:
    """Whether trees are small enough to be put into a formula and still be read."""
    return next(islice(walk(*nodes), LARGEST_WORKING, None), None) is None
