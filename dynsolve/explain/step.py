"""Steps: the derivation as data, for whoever prints it.

A step says why it is taken, gives the textbook's formula and where it stands, the
formula with this robot's matrices put in, and the result.  Every detail level
shows the same values; a level only chooses which steps are shown.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

from dynsolve.document import Prose, Table
from dynsolve.document.figures import ArmFigure, Figure
from dynsolve.notation.tree import Node
from dynsolve.quantities.stages import Stage


class Detail(IntEnum):
    """The level of detail from which on a step is shown."""

    BRIEF = 1
    NORMAL = 2
    FULL = 3


@dataclass(frozen=True, slots=True)
class Line:
    """A line between the formula and the result: the operation, in words, and the formulas it gives.

    Words that end in a colon lead on; where what goes in is put in without more, there are none.
    `uses` names the earlier steps whose results go in here, and not before.  Formulas that are referred
    to later have a `label`, and so one number; many short ones stand `in_columns`.
    """

    by: Prose
    formulas: tuple[Node, ...]
    uses: tuple[str, ...] = ()
    label: str = ""
    in_columns: bool = False


@dataclass(frozen=True, slots=True)
class Step:
    """One step of a derivation.

    `id` is the name of what it gives (`A1`, `Jv2`, `tau1`), `also` the names of further
    results.  `formula` is general and stands in the textbook at `source`, `further` are formulas in
    letters that belong to it; `working` is the same with this robot's quantities; `lines` lead on
    from there to the `result`, what comes out, one operation after the other, the last one being
    said in `concluding`.  `uses` names the earlier steps that it is computed from, unless these are
    the inputs of its rule; `x#2` is the second result of x alone.  `names` are the labels of lines that
    define what it is written in.

    How it is shown: `entries` names the entries of a result that is a matrix too wide for
    the page; an `optional` result says nothing new, and is left out where it does not fit;
    results that are `listed` stand in one display, those that are `together` side by side;
    a table that is `table_last` stands after the lines;
    `detail` says from which level on; `figure` is drawn beside it where drawings can be shown.

    What a hint makes of it: `hint` is said in place of a `why` that tells something of the
    result, `hint_title` in place of such a title, `task` is the formula where it is not `formula`; what
    is no `is_task` is left out, being given by the problem or a mere comparison.
    """

    id: str
    stage: Stage
    title: str
    why: Prose = ()
    formula: Node | None = None
    source: str = ""
    further: tuple[Node, ...] = ()
    working: tuple[Node, ...] = ()
    lines: tuple[Line, ...] = ()
    concluding: Prose = ()
    result: tuple[Node, ...] = ()
    notes: tuple[Prose, ...] = ()
    table: Table | None = None
    table_last: bool = False
    figure: Figure | ArmFigure | None = None
    entries: tuple[tuple[Node, ...], ...] = ()
    optional: bool = False
    listed: bool = False
    together: bool = False
    detail: Detail = Detail.NORMAL
    also: tuple[str, ...] = ()
    uses: tuple[str, ...] | None = None
    names: tuple[str, ...] = ()
    hint: Prose = ()
    hint_title: str = ""
    task: Node | None = None
    is_task: bool = True
