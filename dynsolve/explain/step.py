"""Steps: the derivation as data, for whoever prints it.

A step says why it is taken, gives the textbook's formula and where it stands, the
formula with this robot's matrices put in, and the result.  A depth is a view: every one shows the same
values, and chooses which steps and lines are shown (`solution.depths`).
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import Flag, IntEnum, auto
from typing import cast

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.document import Prose, Table
from dynsolve.document.figures import ArmFigure, Figure
from dynsolve.document.sentences import opened
from dynsolve.notation.tree import Node, Relation
from dynsolve.quantities.stages import Stage


class Detail(IntEnum):
    """The depth from which on a step, or a line of it, is shown."""

    RESULTS = 1
    BRIEF = 2
    NORMAL = 3
    FULL = 4


class Group(Struct, frozen=True):
    """Steps that are alike or lead to one thing: in full a section of its own, else one step.

    `why` is said in place of what the steps say one by one, and `formula` stands in place of theirs;
    `concluding` leads to the result of the last one.
    """

    id: str
    title: str
    why: Prose = ()
    formula: Node | None = None
    source: str = ""
    concluding: Prose = ()


class Part(Flag):
    """The parts of a step."""

    WHY = auto()
    FORMULA = auto()
    FURTHER = auto()
    WORKING = auto()
    LINES = auto()
    CONCLUDING = auto()
    RESULT = auto()
    NOTES = auto()


NOTED = ~Part(0)
"""All parts."""
RESUMED = NOTED & ~Part.WORKING
"""All but this robot's quantities in the formula, which an earlier step has."""
TOLD = NOTED & ~Part.NOTES
"""All parts but the notes."""
WORKED = TOLD & ~Part.WHY
"""The formulas with what leads from one to the next."""
STATED = Part.FORMULA | Part.RESULT
"""The formula in letters and the result."""


class Line(Struct, frozen=True):
    """A line between the formula and the result: the operation, in words, and the formulas it gives.

    Words that end in a colon lead on; where what goes in is put in without more, there are none.
    `uses` names the earlier steps whose results go in here, and not before.  Formulas that are referred
    to later have a `label`, and so one number; many short ones stand `in_columns`.  A matrix that is
    `is_kept` is told entry by entry where it does not fit, any other is left out there.  `detail` is the
    depth from which the line is shown; `joined` are the words of both where the line before is not.
    """

    by: Prose
    formulas: tuple[Node, ...]
    uses: tuple[str, ...] = ()
    label: str = ""
    in_columns: bool = False
    is_kept: bool = False
    detail: Detail = Detail.NORMAL
    joined: Prose = ()


def outlined(lines: Sequence[Line]) -> tuple[Line, ...]:
    """Lines of which a worked example has the last, and those by an identity; the others can be found."""
    return tuple(
        line
        if line is lines[-1] or any(isinstance(part, Relation) for part in line.by)
        else replace(line, detail=Detail.FULL)
        for line in lines
    )


OF_ITS_FILE = cast(Stage, "")
"""The stage of a step that says none: `explain` gives it that of the file it comes from."""


class Step(Struct, frozen=True):
    """One step of a derivation.

    `id` is the name of what it gives (`A1`, `Jv2`, `tau1`), `also` the names of further
    results.  `formula` is general and stands in the textbook at `source`, `further` are formulas in
    letters that belong to it; `working` is the same with this robot's quantities; `lines` lead on
    from there to the `result`, what comes out, one operation after the other, the last one being
    said in `concluding`.  `uses` names the earlier steps that it is computed from, unless these are
    the inputs of its rule; `x#2` is the second result of x alone.  `names` are the labels of lines that
    define what it is written in; `defines` are those of its results that define names for later ones.

    How it is shown: `entries` names the entries of a result that is a matrix too wide for
    the page; an `optional` result says nothing new, and is left out where it does not fit;
    results that are `listed` stand in one display, those that are `together` side by side;
    a table that is `table_last` stands after the lines;
    `detail` says from which depth on, `normal` which of its parts a worked example has; in a `group` it
    is one of the steps that are shown as one; `outcome` is said of it where it is not shown itself, and what
    its result `holds` under stands beside it in the summary;
    of the steps that are alike, `said` names what `why` tells, and the first alone tells it;
    `figure` is drawn beside it where drawings can be shown.

    What a hint makes of it: `hint` is said in place of a `why` that tells something of the
    result, `hint_title` in place of such a title, `task` is the formula where it is not `formula`; what
    is no `is_task` is left out, being given by the problem or a mere comparison.
    """

    id: str
    stage: Stage = OF_ITS_FILE
    title: str = ""
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
    normal: Part = TOLD
    group: Group | None = None
    outcome: Prose = ()
    holds: Prose = ()
    said: str = ""
    also: tuple[str, ...] = ()
    uses: tuple[str, ...] | None = None
    names: tuple[str, ...] = ()
    defines: tuple[Node, ...] = ()
    hint: Prose = ()
    hint_title: str = ""
    task: Node | None = None
    is_task: bool = True


NOT_DERIVED = ": not derived"
"""How the title of a step ends that has no result."""


def not_derived(id: str, what: str, why: str, group: Group | None = None) -> Step:
    """What a step says of a result, told in words, that is not derived."""
    said = (f"{opened(why)}.",)
    return Step(
        id, title=f"{what}{NOT_DERIVED}", why=said, detail=Detail.BRIEF, group=group, outcome=said, uses=()
    )
