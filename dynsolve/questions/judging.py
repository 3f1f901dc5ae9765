"""What the judge of a question is given, and what it says.

Of an answer that is a set: whether it is right (`SetKey`), and what may be wrong with it (`Fault`).  Of a
value that is not the key's: what is right all the same (`Equivalence`).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping, Sequence, Set
from fractions import Fraction
from typing import Any, ClassVar

from msgspec import Struct

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.fraction import RationalExpr
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.derivation.graph import Derivation, Skipped
from dynsolve.explain.forms import Forms
from dynsolve.notation.tree import Node
from dynsolve.quantities.family import Family
from dynsolve.quantities.index import Quantity
from dynsolve.robot.model import Robot


class Part(Struct, frozen=True):
    """One formula of an alternative: that of a coordinate, or without a name what is 0."""

    coordinate: str
    node: Node


Alternatives = Sequence[Sequence[Part]]


class Fault(Struct, frozen=True):
    """What may be wrong: its class in a few words, what is said of it, and what to look at.

    In the words {number} counts the branch or alternative, or is the name of a matrix.
    """

    code: str
    kind: str
    message: str
    look: str


def by_code(*faults: Fault) -> dict[str, Fault]:
    """A table of faults."""
    return {fault.code: fault for fault in faults}


class SetVerdict(Struct, frozen=True):
    """Whether a set is right, else the `code` of what is said of alternative `number`, `where` and of `what`.

    `notes` are what is said of one that is right.
    """

    is_right: bool
    code: str = ""
    number: int = 0
    notes: tuple[str, ...] = ()
    where: str = ""
    what: str = ""


RIGHT = SetVerdict(True)


class Judged(Struct, frozen=True):
    """What a question judges by: the robot, its results, as they are printed, and the problem's numbers.

    `exact` are the decimals that stand in its file.
    """

    robot: Robot
    values: Derivation
    forms: Forms
    numbers: Mapping[str, float]
    exact: frozenset[Fraction]


class SetKey(ABC):
    """The key of a set: alternatives, each of formulas that hold together.

    `made_of` are results that a student's own values may stand for, see `verdict_with`;
    `vanishing` is the result that is 0 on the set, where there is one; `names` are what may stand in it
    beside coordinates and parameters.
    """

    faults: ClassVar[Mapping[str, Fault]] = {}
    made_of: ClassVar[Sequence[str]] = ()

    def __init__(self, judged: Judged, name: str) -> None:
        self.judged, self.name = judged, name
        self.robot, self.forms = judged.robot, judged.forms
        self.vanishing = ""
        self.names: Set[str] = frozenset()

    @abstractmethod
    def verdict(self, given: Alternatives) -> SetVerdict:
        """Whether a set is that of the key."""

    def verdict_with(self, given: Alternatives, own: Mapping[str, Any]) -> SetVerdict:
        """The verdict where own values stand for some of what the set is made of."""
        raise NotImplementedError

    @property
    def is_skipped(self) -> bool:
        """Whether the key has no such set, because it would be too long."""
        return isinstance(self.judged.values[self.name], Skipped)

    def zeros(self, value: Any) -> Sequence[Node]:
        """What is 0 where a value of `vanishing` is."""
        return [Compactor(value.ring).form(value)]


def nodes_of(given: Iterable[Sequence[Part]]) -> list[Node]:
    """The formulas of all alternatives."""
    return [part.node for one in given for part in one]


class Case(Struct, frozen=True):
    """An answer that is not the key's, in the ring of the answers.

    `node` is what it is an answer to, `quantity` the same as a record; `entries` are the first of each row
    that was written, and `value` all of them of the kind of another value, None where they are none.
    `agrees` says whether the entry of a row stands for a value, `makes` whether Σ factorⱼ entryⱼ does with
    the problem's numbers, which `in_numbers` puts in.  `result` gives the key's values,
    `chosen` are columns as the student chose them.  `is_equation` says that it was written as one side of
    `... = 0`.
    """

    robot: Robot
    node: str
    quantity: Quantity | None
    entries: Sequence[RationalExpr]
    value: Callable[[Any], Any]
    agrees: Callable[[Expr, int], bool]
    result: Callable[[str], Any]
    chosen: Mapping[str, Matrix]
    in_numbers: Callable[[RationalExpr], RationalExpr]
    makes: Callable[[Sequence[Expr], Expr], bool]
    is_equation: bool = False

    @property
    def index(self) -> int:
        """Of which body, coordinate or link it is, from 1."""
        return self.quantity.index[0] if self.quantity is not None else 1

    @property
    def key(self) -> Any:
        """The key's value."""
        return self.result(self.node)

    def difference(self) -> Expr | None:
        """A scalar less the key; None of a fraction."""
        written = self.entries[0]
        return None if written.divisor is not None else written.numerator - self.key

    def is_entry_by_entry(self, wanted: Sequence[Expr]) -> bool:
        """Whether a column has these entries, as an answer may have them."""
        assert len(wanted) == len(self.entries)
        return all(self.agrees(entry, row) for row, entry in enumerate(wanted))


class Missed(Struct, frozen=True):
    """An equation that an answer does not satisfy, in that row, from 1: there `left` is `value`, not `goal`.

    Of what is too long to be put in no row is known.  Where the key `is_one_of_many` solutions, or the
    nearest to one, its entries are no measure.
    """

    equation: str
    row: int = 0
    left: str = ""
    value: RationalExpr | None = None
    goal: RationalExpr | None = None
    is_one_of_many: bool = False


class Equivalence(Struct, frozen=True):
    """What is right though it is not the key: of which families or nodes, by which test, and its words."""

    words: str
    holds: Callable[[Case], bool]
    of: frozenset[Family | str]


def right_as(words: str, holds: Callable[[Case], bool], *of: Family | str) -> Equivalence:
    """A row of a table of equivalences."""
    return Equivalence(words, holds, frozenset(of))
