"""Pieces of formulas and sentences that several stages write."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from itertools import islice
from types import MappingProxyType

from msgspec import Struct

from dynsolve.document import Inline, Prose
from dynsolve.notation.build import split_sign
from dynsolve.notation.tree import (
    ZERO,
    BigSum,
    Letter,
    Matrix,
    Node,
    Number,
    Row,
    Sum,
    Symbol,
    Words,
    mapped,
    walk,
)
from dynsolve.robot import units
from dynsolve.robot.model import Body, Coordinate, JointType, Robot

SIGN = "§"
"""What a section's number begins with: a bare 7.2 would read as the number of a step or an equation."""


class Book(Struct, frozen=True):
    """A book: what a step calls it (nothing for the course's own), the edition in full, its sections."""

    name: str
    full: str
    sections: Mapping[str, str]

    def section(self, number: str) -> str:
        """A reference to a section, as it stands beside a formula.

        Raises KeyError for a section that is not in the table.

        >>> spong("7.2.2"), craig("3.5"), siciliano("7.1.3"), mls("6.1.2")
        ('§7.2.2', 'Craig §3.5', 'Siciliano et al. §7.1.3', 'Murray, Li, Sastry §6.1.2')
        """
        if number not in self.sections:
            raise KeyError(f"{self.full}: section {number} is not in the table of citations")
        return f"{self.name} {SIGN}{number}".strip()


SPONG = Book(
    name="",
    full="M. W. Spong, S. Hutchinson, M. Vidyasagar, Robot Modeling and Control, 1st edition, Wiley, 2006",
    sections={
        "2.5.3": "Axis/Angle Representation",
        "2.6": "Rigid Motions",
        "2.7": "Homogeneous Transformations",
        "3.1": "Kinematic Chains",
        "3.2": "Forward Kinematics: The Denavit-Hartenberg Convention",
        "3.3": "Inverse Kinematics",
        "3.3.1": "The General Inverse Kinematics Problem",
        "3.3.2": "Kinematic Decoupling",
        "4.6": "Derivation of the Jacobian",
        "4.6.1": "Angular Velocity",
        "4.6.2": "Linear Velocity",
        "4.6.3": "Combining the Linear and Angular Velocity Jacobians",
        "4.8": "The Analytical Jacobian",
        "4.9": "Singularities",
        "4.10": "Static Force/Torque Relationships",
        "4.11": "Inverse Velocity and Acceleration",
        "4.12": "Manipulability",
        "7.1": "The Euler-Lagrange Equations",
        "7.2": "Kinetic and Potential Energy",
        "7.2.1": "The Inertia Tensor",
        "7.2.2": "Kinetic Energy for an n-Link Robot",
        "7.2.3": "Potential Energy for an n-Link Robot",
        "7.3": "Equations of Motion",
        "7.4": "Some Common Configurations",
        "7.5": "Properties of Robot Dynamic Equations",
        "7.5.1": "Skew Symmetry and Passivity",
        "7.5.2": "Bounds on the Inertia Matrix",
        "7.5.3": "Linearity in the Parameters",
        "7.6": "Newton-Euler Formulation",
    },
)

CRAIG = Book(
    name="Craig",
    full=(
        "J. J. Craig, Introduction to Robotics: Mechanics and Control, 3rd edition, "
        "Pearson Prentice Hall, 2005"
    ),
    sections={
        "3.4": "Convention for Affixing Frames to Links",
        "3.5": "Manipulator Kinematics",
        "4.6": "Pieper's Solution When Three Axes Intersect",
        "5.6": "Velocity Propagation from Link to Link",
        "5.7": "Jacobians",
        "6.5": "Iterative Newton-Euler Dynamic Formulation",
    },
)

SICILIANO = Book(
    name="Siciliano et al.",
    full=(
        "B. Siciliano, L. Sciavicco, L. Villani, G. Oriolo, Robotics: Modelling, Planning and Control, "
        "Springer, 2009"
    ),
    sections={
        "7.1.1": "Computation of Kinetic Energy",
        "7.1.2": "Computation of Potential Energy",
        "7.1.3": "Equations of Motion",
    },
)

LYNCH_PARK = Book(
    name="Lynch and Park",
    full="K. M. Lynch, F. C. Park, Modern Robotics, Cambridge University Press, 2017",
    sections={
        "8.2.1": "Classical Formulation",
        "8.5": "Forward Dynamics of Open Chains",
        "8.6": "Dynamics in the Task Space",
    },
)

MURRAY_LI_SASTRY = Book(
    name="Murray, Li, Sastry",
    full=(
        "R. M. Murray, Z. Li, S. S. Sastry, A Mathematical Introduction to Robotic Manipulation, "
        "CRC Press, 1994"
    ),
    sections={
        "6.1.1": "Pfaffian constraints",
        "6.1.2": "Lagrange multipliers",
        "6.1.3": "Lagrange-d'Alembert formulation",
    },
)

KHALIL_DOMBRE = Book(
    name="Khalil and Dombre",
    full="W. Khalil, E. Dombre, Modeling, Identification and Control of Robots, Hermes Penton, 2002",
    sections={"9.4": "Determination of the Base Inertial Parameters"},
)

GAUTIER_KHALIL = (
    "M. Gautier, W. Khalil, Direct calculation of minimum set of inertial parameters of serial robots, "
    "IEEE Transactions on Robotics and Automation 6, 1990"
)
"""How base parameters of serial arms are found; cited in full where they are told of."""

SLOTINE_LI = Book(
    name="Slotine and Li",
    full="J.-J. E. Slotine, W. Li, Applied Nonlinear Control, Prentice Hall, 1991",
    sections={
        "3.1": "Nonlinear Systems and Equilibrium Points",
        "3.3": "Linearization and Local Stability",
        "3.4": "Lyapunov's Direct Method",
        "9.2": "Adaptive Robot Trajectory Control",
    },
)

GOLDSTEIN = Book(
    name="Goldstein, Poole, Safko",
    full="H. Goldstein, C. Poole, J. Safko, Classical Mechanics, 3rd edition, Addison Wesley, 2002",
    sections={"2.7": "Energy Function and the Conservation of Energy"},
)

BOOKS = (SPONG, CRAIG, SICILIANO, LYNCH_PARK, MURRAY_LI_SASTRY, KHALIL_DOMBRE, SLOTINE_LI, GOLDSTEIN)

GIVEN, GEOMETRY = "given", "geometry"
"""What stands in the place of a section where a formula is the problem's own, or needs no book."""

_IN_A_LIST = "Spong et al."
"""What the course's own book is called where no report names it at its start."""


spong, craig, siciliano, mls = (book.section for book in (SPONG, CRAIG, SICILIANO, MURRAY_LI_SASTRY))
"""References to these books by the number of a section."""


def by_itself(source: str) -> str:
    """A reference that is understood without the beginning of a report.

    >>> by_itself("§7.1"), by_itself("Craig §3.5"), by_itself("by the integrals of §7.2.1")
    ('Spong et al. §7.1', 'Craig §3.5', 'by the integrals of Spong et al. §7.2.1')
    """
    named = any(book.name and book.name in source for book in BOOKS)
    return source if named else source.replace(SIGN, f"{_IN_A_LIST} {SIGN}")


LARGEST_WORKING = 260
"""Matrices whose entries have more parts than this are not put into a formula; it stays in letters."""


def turns(q: Coordinate) -> bool:
    """Whether a coordinate is an angle."""
    return q.type is JointType.REVOLUTE


def machine(robot: Robot) -> str:
    """What moves, in a sentence."""
    return "arm" if robot.has_table else "mechanism"


def name_of(body: Body) -> str:
    """The name of a body in a sentence."""
    return f"body {body.name}"


def are_counted(bodies: Sequence[Body]) -> bool:
    """Whether bodies are called 1, 2, ..., as a sum over them counts."""
    return [body.name for body in bodies] == [str(place) for place in range(1, len(bodies) + 1)]


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


def and_joined(names: Sequence[str]) -> str:
    """a, b and c

    >>> and_joined(["1"]), and_joined(["1", "2", "3"])
    ('1', '1, 2 and 3')
    """
    return "".join(part for part in listed(names) if isinstance(part, str))


def agreeing(text: str, count: int) -> str:
    """A sentence of one or of several things, from "singular|plural" where they differ.

    >>> agreeing("Branch|Branches 2 is|are not real", 1), agreeing("Branch|Branches 1, 2 is|are not real", 2)
    ('Branch 2 is not real', 'Branches 1, 2 are not real')
    """
    return re.sub(r"(\w+)\|(\w+)", r"\1" if count == 1 else r"\2", text)


def side_by_side(parts: Sequence[Node]) -> Node:
    """Formulas on one line, commas between them; one alone as it is."""
    if len(parts) == 1:
        return parts[0]
    row: list[Node] = []
    for part in parts:
        row += [part] if not row else [Words(", "), part]
    return Row(tuple(row))


def as_row(prose: Prose) -> Row:
    """Words and formulas as one formula."""
    return Row(tuple(part if isinstance(part, Node) else Words(str(part)) for part in prose))


def scalar(form: Node) -> Node:
    """The entry of a 1×1 matrix: what there is one of is written as a number.  Other forms as they are."""
    match form:
        case Matrix(((entry,),)):
            return entry
    return form


def measured(form: Node, unit: str) -> Node:
    """A number with its unit: 2.5 kg.  Other forms, and 0, as they are."""
    if not isinstance(split_sign(form)[1], Number) or form == ZERO:
        return form
    return Row((form, Words(" "), units.node(unit)))


def sum_of(terms: Sequence[Node]) -> Node:
    """The sum of terms as they are; 0 of none."""
    if not terms:
        return ZERO
    return terms[0] if len(terms) == 1 else Sum(tuple(terms))


def counted_sum(body: Node, index: Node, count: int, own: Mapping[Node, Node] = MappingProxyType({})) -> Node:
    """Σ_{index=1}^{count} body; of one its index put in, and `own`, what its letters are called."""
    if count > 1:
        return BigSum(body, index, Number(1), Number(count))
    named = mapped(body, lambda node: own.get(node, node))
    return mapped(named, lambda node: Number(1) if node == index else node)


def sum_over_coordinates(body: Node, index: Node, robot: Robot) -> Node:
    """Σ_{index=1}^{n} body; a single coordinate is called by its name."""
    name = robot.coordinates[0].name
    own: dict[Node, Node] = {Letter("q", index, dots=dots): Symbol(name, dots) for dots in (0, 1)}
    return counted_sum(body, index, robot.n, own)


def column_of(matrix: Matrix, j: int) -> Matrix:
    """A column of a tree."""
    return Matrix(tuple((row[j],) for row in matrix.rows))


def block_of(matrix: Matrix, rows: int, first: int, last: int) -> Matrix:
    """The first rows of some columns of a tree."""
    return Matrix(tuple(row[first:last] for row in matrix.rows[:rows]))


def is_small(*nodes: Node) -> bool:
    """Whether trees are small enough to be put into a formula and still be read."""
    return next(islice(walk(*nodes), LARGEST_WORKING, None), None) is None


def flat(entries: Iterable[Node]) -> Node:
    """(v_x, v_y): a column as a line of text can hold it, its commas nearer than those of a list."""
    parts: list[Node] = []
    for entry in entries:
        parts += [Words(",\N{NO-BREAK SPACE}"), entry] if parts else [entry]
    return Row((Words("("), *parts, Words(")")))
