"""Points of a drawing in the frames of their links: `{drawn: [x, y, z]}`, and `axes: base`.

In frame i with origin o and axes x, y, z a point p of the drawing is (x·(p - o), y·(p - o), z·(p - o)).
The letter of a slide is its drawn value there, and falls out of what is fixed in its link.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.matrix import Matrix, cross
from dynsolve.notation.build import negated, times, total
from dynsolve.notation.tree import Node
from dynsolve.problem.cells import Cell
from dynsolve.problem.places import ParsedPlace
from dynsolve.problem.rotations import ParsedRotation
from dynsolve.problem.source import Faults
from dynsolve.problem.yaml_nodes import Span
from dynsolve.robot.drawing.procedure import Normals, frames
from dynsolve.robot.model import Convention, JointType


@dataclass(frozen=True, slots=True)
class DrawnFrames:
    """The frames in the pose that is drawn, each as the trees of x, y, z and the origin, the hand's last.

    Of a table there are none.
    """

    frames: tuple[tuple[tuple[Node, ...], ...], ...] = ()
    slides: frozenset[str] = frozenset()
    turns_are_drawn: bool = True

    @staticmethod
    def of(normals: Normals | None, names: Sequence[tuple[str, str]]) -> DrawnFrames:
        """Those of a drawing; `names` are (coordinate, kind)."""
        if normals is None:
            return DrawnFrames()
        drawing = normals.drawing
        form = Compactor(drawing.ring).form

        def trees(vector: Matrix) -> tuple[Node, ...]:
            return tuple(map(form, vector.entries))

        found = [
            (trees(x), trees(cross(z, x)), trees(z), trees(origin))
            for origin, x, z in frames(normals, drawing.convention is Convention.MODIFIED)
        ]
        slides = frozenset(name for name, kind in names if kind == JointType.PRISMATIC.value)
        hand, x = normals.hand, normals.hand_x
        found.append((trees(x), trees(cross(hand.direction, x)), trees(hand.direction), trees(hand.point)))
        return DrawnFrames(tuple(found), slides, drawing.zero_is_drawn)

    def place(self, faults: Faults, place: ParsedPlace | None, link: int | None) -> ParsedPlace | None:
        """A place in the frame of its link; one that is not drawn as it is, None where it was reported."""
        if place is None or place.kind != "drawn":
            return place
        if not self.frames:
            help = "give the point in the frame of its link: [x, y, z], or the joint axes with `axes`"
            faults.error(place.span, "there is no drawing in which this point could be", help)
            return None
        if link is None:
            return None
        *axes, origin = self.frames[link]
        away = [total([cell.tree, negated(start)]) for cell, start in zip(place.cells, origin, strict=True)]
        pairs = zip(place.cells, axes, strict=True)
        return replace(place, cells=tuple(self._cell(cell, _dot(axis, away)) for cell, axis in pairs))

    def _cell(self, cell: Cell, tree: Node) -> Cell:
        names = tuple(name for name in cell.names if name.name not in self.slides)
        return replace(cell, tree=tree, names=names)

    def axes_of_base(self, link: int | None, span: Span) -> ParsedRotation | None:
        """Frame 0 seen from a link's frame in the pose that is drawn; None where that is q = 0 anyhow."""
        if not self.frames or self.turns_are_drawn or link is None:
            return None
        frame, base = self.frames[link], self.frames[0]
        rows = tuple(
            tuple(Cell("the axes of the base", _dot(mine, theirs), (), "", span[0]) for theirs in base[:3])
            for mine in frame[:3]
        )
        return ParsedRotation(span, "base", rows=rows)


def _dot(a: Sequence[Node], b: Sequence[Node]) -> Node:
    """a · b of trees."""
    return total([times(1, [(x, 1), (y, 1)]) for x, y in zip(a, b, strict=True)])


NOT_DRAWN = DrawnFrames()
"""The frames of a file with a table."""
