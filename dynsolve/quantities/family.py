"""A family of quantities: one record for K₁, K₂, ... together.

Names and spellings are templates.  What stands in braces is the owner's:

    {i}                 the row's number, or the coordinate's place
    {b}                 the body's name
    {p}                 the name of a point that the exercise names
    {i}{j}, {i}{j}{k}   the indices of an entry
    {force}             the coordinate's generalized force: tau1 of an angle, f1 of a length
    {q}                 each of the names of a coordinate: its own, q1, and theta1 or d1
    {name}, {s}         its own name, and the subscript of that
"""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum
from typing import Literal

from msgspec import Struct

from dynsolve.notation.tree import Node
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Body, Coordinate, Robot
from dynsolve.robot.questions import NamedPoint
from dynsolve.robot.units import Dimension


class Owner(Enum):
    """The kind of thing that owns one quantity of a family each."""

    ROBOT = 0
    ROW = 1
    BODY = 2
    COORDINATE = 3
    PAIR = 4
    """Two coordinates: the entries of an n×n matrix."""
    TRIPLE = 5
    """Three coordinates: the Christoffel symbols."""
    POINT = 6
    """A point that the exercise names."""
    LOAD = 7
    """A force from outside."""
    TASK = 8
    """A component of the task."""
    CONSTRAINT = 9
    """A constraint."""


class Kind(Enum):
    """What a quantity is."""

    VALUE = "value"
    """An expression, a vector or a matrix."""
    EQUATIONS = "equations"
    """Where something holds: alternatives, each of equations that hold together."""
    CONDITIONS = "conditions"
    """Equations that all hold."""
    BRANCHES = "branches"
    """Solutions: alternatives, each an expression for every coordinate."""
    VERDICTS = "verdicts"
    """Yes, no or if, of each of some matrices by its name."""
    SPAN = "span"
    """A space, by a matrix whose columns span it."""


FORMED = (Kind.VALUE, Kind.SPAN)
"""The kinds of quantities that have a compact form."""


Size = int | Literal["n", "m", "c", "any"]
"""Rows or columns; n is the number of coordinates, m that of the components of the task, c of constraints.

How many vectors span a space is known when it is computed: there may be any number.
"""

LetterMaker = Callable[..., Node]
"""letter(robot, *index): what a quantity is set with; the printers make every notation of it."""


def of_robot(letter: Node) -> LetterMaker:
    """The letter of a quantity that a robot has one of."""
    return lambda robot: letter


def of_body(letter: Callable[[Body], Node]) -> LetterMaker:
    """The letter of a body's quantity."""
    return lambda robot, b: letter(robot.bodies[b - 1])


def of_coordinate(letter: Callable[[Coordinate], Node]) -> LetterMaker:
    """The letter of a coordinate's quantity."""
    return lambda robot, i: letter(robot.coordinates[i - 1])


def of_point(letter: Callable[[NamedPoint], Node]) -> LetterMaker:
    """The letter of the quantity of a point."""
    return lambda robot, p: letter(robot.questions.points[p - 1])


def _no_letter(robot: Robot, *index: int) -> Node:
    raise LookupError("this quantity is never printed by itself")


class Family(Struct, frozen=True, eq=False, kw_only=True):
    """The quantities of one kind.

    `name` is the template of the names that answers and results have, `rule` of those of
    the rules of the derivation that give them (an entry has that of its matrix).
    `kind` is what it is, `stage` where it is derived and explained; `capped_in` the stage that its marks
    count in, where that is another.  `shape` is rows and columns, None for a scalar: what a rule
    gives is a `Matrix` or an `Expr`, where it divides a `FractionMatrix` or a `RationalExpr`, or `Skipped`.
    `called` is what it is called in words, "one|several" where members differ, `{}` where the letters stand
    if not behind.  `letter` is what it is set with; `json` its key in `results`, empty for what is not
    exported.

    The dimension of an entry is `dimension` over that of the coordinates that `per`
    names: of its row, its column, or of the quantity's owner.  `unit` is what a unit of
    `dimension` is called (N m, and not J, of a torque).  An answer whose terms have
    another dimension is told so where `dimension_is_told`.

    `spellings` are what students write for it besides its name, `fallback_spellings` what they may
    write where it means nothing else; a family without `is_answer` is none of the answers.
    `aliases` are the further names that `find` and `marks` take; `terms` what the field calls it, which an
    error takes for a name that was meant.

    `needs` is what a file must give for there to be any: `velocity`, `linearize`, ... (`Questions.given`);
    `at_state` says that it is for the state that a file gives, where it gives one.
    `holds_forces` says that a result holds the generalized forces by their names.
    `brought_by` is what must act beside gravity for there to be any, a `term` of `robot.actions`.
    `part_of` is the whole it is added up to, or an entry of.  `needs_rotation` marks what a point
    mass has in name only; `is_symmetric_entry` an entry that equals the one across the diagonal.
    """

    name: str
    stage: Stage
    kind: Kind = Kind.VALUE
    owner: Owner = Owner.ROBOT
    rule: str = ""
    shape: tuple[Size, Size] | None = None
    capped_in: Stage | None = None
    called: str = ""
    letter: LetterMaker = _no_letter
    json: str = ""
    dimension: Dimension | None = None
    per: tuple[Literal["row", "column", "owner"], ...] = ()
    unit: str = ""
    dimension_is_told: bool = True
    is_answer: bool = True
    spellings: tuple[str, ...] = ()
    fallback_spellings: tuple[str, ...] = ()
    aliases: tuple[str, ...] = ()
    terms: tuple[str, ...] = ()
    needs: str = ""
    at_state: bool = False
    holds_forces: bool = False
    brought_by: str = ""
    part_of: str = ""
    needs_rotation: bool = False
    is_symmetric_entry: bool = False

    def called_of(self, robot: Robot) -> str:
        """What it is called, where the gravity terms are those of springs, too, or of springs alone."""
        return self.called.replace("gravity", " and ".join(robot.held))

    @property
    def stem(self) -> str:
        """What the names of its members begin with: `Kv` of `Kv{b}`."""
        return self.name.partition("{")[0]

    def names(self, name: str) -> bool:
        """Whether a quantity so named is of this family: wl2 of wl{i}, acltool of acl{b}, K1_x of K{b}_x.

        >>> family = Family(name="K{b}_x", stage=Stage.ENERGY, owner=Owner.BODY)
        >>> [family.names(name) for name in ("K1_x", "K_x", "K1", "K1_xx")]
        [True, False, False, False]
        """
        stem, end = self.stem, self.name.rpartition("}")[2]
        if end == self.name:
            return name == self.name
        index = name.removeprefix(stem).removesuffix(end)
        if not index or name != f"{stem}{index}{end}":
            return False
        return self.owner is Owner.BODY or index.isdecimal()

    @property
    def has_letter(self) -> bool:
        """Whether it is ever printed by itself."""
        return self.letter is not _no_letter

    @property
    def is_vector(self) -> bool:
        """Whether it is a column vector by its nature, and no matrix that may have one column."""
        return self.shape is not None and self.shape[1] == 1

    def __repr__(self) -> str:
        return f"<Family {self.name}>"
