"""Steps from joint axes as they are drawn to the table: each frame with the reason for its choice."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.matrix import Matrix
from dynsolve.document import Inline, Prose, Table
from dynsolve.explain.context import Context
from dynsolve.explain.kinematics import table_of
from dynsolve.explain.step import Detail, Group, Step
from dynsolve.explain.writing import craig, listed, side_by_side, spong
from dynsolve.notation import tree
from dynsolve.notation.tree import Node, Symbol, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.drawing.normals import Normal, Relation
from dynsolve.robot.drawing.procedure import Normals, frames
from dynsolve.robot.model import Convention

STAGE = Stage.FRAMES

FRAMES = Group("frames", "The frames")

_HINT: Prose = (
    "See how the two axes lie, the one of the joint and the next one. Skew axes have one common normal: x "
    "lies along it. Where they meet, x is perpendicular to both, through that point. Of parallel axes, or of "
    "two on one line, any common normal will do: take the one with which d is 0. The origin is where x "
    "meets z.",
)

_MEASURED = {
    Convention.STANDARD: (
        "In the standard convention (Spong) θ_i turns x_{i-1} to x_i about z_{i-1}, and d_i is the way along "
        "it; a_i is the distance from z_{i-1} to z_i along x_i, and α_i the angle between them about it."
    ),
    Convention.MODIFIED: (
        "In the modified convention (Craig) θ_i turns x_{i-1} to x_i about z_i, and d_i is the way along it; "
        "a_{i-1} is the distance from z_{i-1} to z_i along x_{i-1}, and α_{i-1} the angle between them about "
        "it."
    ),
}
_VERIFIED = (
    "At random joint values this table moves the hand as the product of the exponentials of the drawn axes "
    "does."
)


def steps(context: Context) -> Iterator[Step]:
    """The drawn axes, the frames one by one, the table."""
    if context.normals is None:
        return
    explained = _Explained(context, context.normals)
    yield explained.axes()
    for i in range(len(explained.frames)):
        yield replace(explained.frame(i), group=FRAMES)
    yield explained.table()


class _Explained:
    """The steps of one drawing."""

    def __init__(self, context: Context, normals: Normals) -> None:
        self.context, self.normals = context, normals
        self.drawing = normals.drawing
        self.modified = self.drawing.convention is Convention.MODIFIED
        self.frames = list(frames(normals, self.modified))
        self.form = Compactor(self.drawing.ring).form
        self.source = craig("3.4") if self.modified else spong("3.2")

    # -- what is drawn -----------------------------------------------------------------------------

    def axes(self) -> Step:
        """The joint axes and the hand, as they are given."""
        rows = tuple(
            (str(i), Symbol(axis.coordinate), "slides along" if axis.slides else "turns about",
             self._row(axis.line.direction), self._row(axis.line.point) if axis.is_placed else "anywhere")
            for i, axis in enumerate(self.drawing.axes, 1)
        )  # fmt: skip
        hand = self.drawing.hand
        why: Prose = (
            "The joint axes in the pose that is drawn, in world coordinates; the hand is at ",
            self._row(hand.at),
            ". ",
            letters.bold("z"),
            " lies along each joint axis in the direction that is given.",
        )
        return Step(
            id="axes",
            stage=STAGE,
            title="The joint axes",
            why=why,
            source=self.source,
            notes=tuple(self._notes()),
            table=Table(("joint", "", "", "direction", "through"), rows),
            detail=Detail.BRIEF,
            is_task=False,
        )

    def _notes(self) -> Iterator[Prose]:
        open_places = [str(i) for i, axis in enumerate(self.drawing.axes, 1) if not axis.is_placed]
        if open_places:
            yield (
                f"{'The axes of joints' if len(open_places) > 1 else 'The axis of joint'} ",
                *listed(open_places),
                " may be anywhere along the direction, for a slide has no place. The line is taken with "
                "which fewest lengths of the table differ from 0.",
            )
        if self.drawing.ring.parameters:
            yield (
                "Letters are positive and independent of each other: what vanishes for some of their values "
                "alone does not count as 0.",
            )

    def _row(self, vector: Matrix) -> Node:
        x, y, z = map(self.form, vector.entries)
        between = tree.Words(", ")
        return tree.Row((tree.Words("("), x, between, y, between, z, tree.Words(")")))

    def _column(self, vector: Matrix) -> Node:
        return tree.column(*map(self.form, vector.entries))

    # -- the frames --------------------------------------------------------------------------------

    def frame(self, i: int) -> Step:
        """One frame: how the axes lie, and what follows for it."""
        origin, x, z = self.frames[i]
        shown = (
            equation(letters.o(i), self._column(origin)),
            equation(letters.bold("x", tree.Number(i)), self._column(x)),
            equation(letters.z(i), self._column(z)),
        )
        return Step(
            id=f"frame{i}",
            stage=STAGE,
            title=f"Frame {i}",
            why=self._prose(self._why(i)),
            source=self.source,
            result=(side_by_side(shown),),
            hint=_HINT if i else (),
        )

    def _why(self, i: int) -> str:
        normal = self.normals.all[i]
        if normal.relation is Relation.BASE:
            return self._why_base(normal)
        n = len(self.drawing.axes)
        if i == n and self.drawing.hand.z is None:
            return self._why_hand(normal, n)
        following = f"the axis of joint {i + 1}" if i < n else "the z of the hand"
        is_told = any(each.relation is normal.relation for each in self.normals.all[1:i])
        return _of_two(normal.relation, i, following, "i" if self.modified else "next", is_told)

    def _why_base(self, normal: Normal) -> str:
        start = (
            "z_0 lies along the axis of joint 1; the origin may be anywhere on it, and x_0 may point "
            "anywhere across it. "
        )
        if normal.end.is_zero:
            return f"{start}The origin is that of the world, and x_0 an axis of the world."
        return f"{start}The origin is the point nearest to that of the world, and x_0 an axis of the world."

    def _why_hand(self, normal: Normal, n: int) -> str:
        if normal.relation is Relation.COINCIDENT:
            return (
                f"The hand lies on the axis of joint {n}. z_{n} stays along it, and x_{n} may point anywhere "
                f"across: it is that of frame {n - 1}, so that nothing is turned in the pose that is drawn."
            )
        return (
            f"The hand lies beside the axis of joint {n}: x_{n} points from the axis across to it, and "
            f"z_{n} stays parallel to the axis."
        )

    # -- the table ---------------------------------------------------------------------------------

    def table(self) -> Step:
        """The rows, measured from frame to frame."""
        why = f"{_MEASURED[self.drawing.convention]} {self._zero()}"
        if len(self.context.robot.joints) > len(self.drawing.axes):
            why += " One row more, without a joint, takes the last frame to the hand."
        return Step(
            id="DH",
            stage=STAGE,
            title="The Denavit-Hartenberg table",
            why=self._prose(why),
            source=self.source,
            notes=((_VERIFIED,),),
            table=table_of(self.context),
            detail=Detail.BRIEF,
            hint=("Measure from frame to frame: about z, along z, along x, about x.",),
        )

    def _zero(self) -> str:
        if self.drawing.zero_is_drawn:
            return (
                "Turning joints are at 0 as drawn, so that θ_i is the coordinate plus the angle that is "
                "drawn. The star marks the joint variables."
            )
        return "The coordinates are the variables of the table, marked by a star: nothing is added to them."

    def _prose(self, text: str) -> Prose:
        """A sentence with its letters set: o_1, x_{i-1}, and θ_i as the columns of the table are called."""
        pieces: list[Inline] = []
        done = 0
        for found in _LETTER.finditer(text):
            written = found[2].strip("{}")
            index = tree.Number(int(written)) if written.isdecimal() else _COUNTS[written]
            pieces += [text[done : found.start()], self._letter(found[1], index)]
            done = found.end()
        return tuple(piece for piece in (*pieces, text[done:]) if piece)

    def _letter(self, base: str, index: Node) -> Node:
        if base in _COLUMNS:
            return letters.columns(self.context.robot, index)[_COLUMNS.index(base)]
        return letters.bold(base, index)


_LIE = {
    Relation.SKEW: "are skew",
    Relation.INTERSECTING: "meet",
    Relation.PARALLEL: "are parallel",
    Relation.COINCIDENT: "lie on one line",
}
_COUNTS = {"i": letters.COUNT, "i-1": letters.BEFORE}
_COLUMNS = "θdaα"
_LETTER = re.compile(r"(?<![A-Za-z])([oxzda]|θ|α)_(\{[^}]*\}|[0-9i])")


def _of_two(relation: Relation, i: int, following: str, side: str, is_told: bool) -> str:
    """How two axes lie that follow each other, and what is chosen; of the second that lie so, how alone."""
    both = f"The axis of joint {i} and {following}"
    if is_told:
        return f"{both} {_LIE[relation]}, too."
    foot = f"the axis of joint {i}" if side == "i" else following
    match relation:
        case Relation.SKEW:
            return (
                f"{both} are skew: they have one common normal. x_{i} lies along it, from the first to the "
                f"second, and o_{i} is where it meets {foot}."
            )
        case Relation.INTERSECTING:
            return (
                f"{both} meet, so that a_{i} is 0: o_{i} is the point where they do, and x_{i} is "
                f"perpendicular to both. Of its two directions the one nearer to x_{i - 1} is taken."
            )
        case Relation.PARALLEL:
            return (
                f"{both} are parallel: every line across is a common normal. The one with d_{i} = 0 is "
                f"taken, and x_{i} points from the first to the second."
            )
    return (
        f"{both} lie on one line: x_{i} may point anywhere across, and o_{i} be anywhere on it. x_{i - 1} "
        f"is kept, and the origin with which d_{i} has no constant part."
    )
