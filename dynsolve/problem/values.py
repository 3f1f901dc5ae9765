"""The values of the cells of a problem file, exact.

The exact position of a point that is fixed in a link; one that would not be is reported.

The mass and the inertia tensor of a body, made exact; what is wrong with them is reported.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction

from msgspec import Struct

from dynsolve.algebra.factors import is_positive
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import build_ring, value_of
from dynsolve.errors import AlgebraError
from dynsolve.problem.base import ParsedRotation
from dynsolve.problem.bodies import ParsedPlace, ParsedTensor
from dynsolve.problem.cells import Cell
from dynsolve.problem.yaml_nodes import Faults
from dynsolve.robot.geometry import Links, elementary, is_rotation
from dynsolve.robot.shapes import AXES

# The values of the cells of a file in its ring


class CellValues:
    """The values of cells in one ring; what has none is reported, once.

    `written` are the numbers under `values`, as they stand in the file.
    """

    def __init__(
        self, faults: Faults, ring: Ring, left_out: frozenset[int], written: Mapping[str, str]
    ) -> None:
        self.faults, self.ring, self._left_out, self.written = faults, ring, left_out, written

    def alone(self, cells: Iterable[Cell]) -> CellValues:
        """The values of some cells, in a ring that holds no more than these."""
        trees = [cell.tree for cell in cells if id(cell) not in self._left_out]
        ring = build_ring(self.ring.coordinates, trees)
        return CellValues(self.faults, ring, self._left_out, self.written)

    def expr(self, cell: Cell) -> Expr | None:
        """The value of a cell, None where something of it was reported."""
        if id(cell) in self._left_out:
            return None
        try:
            return value_of(self.ring, cell.tree)
        except AlgebraError as error:
            self.faults.error(cell.span, f"{cell.what}: {error.message}", error.help)
            return None

    def column(self, cells: Iterable[Cell]) -> Matrix | None:
        """The values of three cells as a column."""
        entries = [self.expr(cell) for cell in cells]
        return None if None in entries else Matrix.column(self.ring, [e for e in entries if e is not None])

    def matrix(self, rows: Iterable[Iterable[Cell]]) -> Matrix | None:
        """The values of a matrix, None where something of it was reported."""
        columns = [self.column(row) for row in rows]
        known = [column.entries for column in columns if column]
        return Matrix.of(self.ring, known) if len(known) == len(columns) else None

    def rotation(self, parsed: ParsedRotation, what: str) -> Matrix | None:
        """The matrix of a rotation; a list that is no rotation is reported."""
        if parsed.turns:
            matrix = Matrix.identity(self.ring, 3)
            for turn in parsed.turns:
                matrix = matrix @ elementary(self.ring, turn.axis, turn.angle)
            return matrix
        listed = self.matrix(parsed.rows)
        if listed is None:
            return None
        orthogonal, proper = is_rotation(listed)
        if orthogonal and proper:
            return listed
        if orthogonal:
            message = f"{what} are no rotation: the determinant is -1"
            help = "this is a reflection: turn the sign of one axis, so that x, y and z are right-handed"
        else:
            message = f"{what} are no rotation: R Rᵀ is not the identity"
            help = (
                "entries are exact: write cos(30deg) or sqrt(3)/2, not 0.866; or a product such as Rz(30deg)"
            )
        self.faults.error(parsed.span, message, help)
        return None


# The exact position of a point that is fixed in a link; one that would not be is reported

_TIP_ROW = (
    "give the centre as [x, y, z], or in a table add a fixed row for the tip, "
    "{theta: 0, d: 0, a: l, alpha: 0} with its length"
)


class PlaceBuilder(Struct, frozen=True):
    """The exact positions of points; `links` is None where the table has errors, and geometry waits."""

    faults: Faults
    values: CellValues
    links: Links | None

    def position(self, place: ParsedPlace, link: int | None, key: str, written: str) -> Matrix | None:
        """The point in frame `link`, 3×1; `key` is the one that says it, as `written`.

        None (reported) for a point that would not be fixed there.
        """
        given = self.values.column(place.cells) if place.kind in ("near", "at", "drawn") else None
        fraction = self.values.expr(place.cells[0]) if place.kind == "along" else None
        if place.kind == "at":
            return given
        if place.kind == "drawn":
            return self._drawn(place, given, link)
        if self.links is None or link is None:
            return None
        if place.kind == "origin":
            return self.links.origin()
        near, far = self.links.near_end(link), self.links.far_end(link)
        if place.kind == "near":
            point = near + given if given else None
        elif far is None:
            self._report_no_end(self.links, place, link)
            return None
        elif place.kind == "tip":
            point = far
        else:
            half = self.values.ring.constant(Fraction(1, 2)) if place.kind == "midpoint" else fraction
            point = near + (far - near).scale(half) if half is not None else None
        if point is not None and not self.links.is_fixed(point):
            self._report_moving(self.links, place, link, key, written)
            return None
        return point

    def _drawn(self, place: ParsedPlace, given: Matrix | None, link: int | None) -> Matrix | None:
        """A point of the drawing, which must slide with what its link slides on."""
        if given is None or self.links is None or self.links.is_fixed(given):
            return given
        message = f"this point is not fixed in link {link}: it slides otherwise than the drawing of the link"
        help = (
            "add the letters of the slides before the link that the axes have, and no others: "
            "a slide that no axis has is 0 as drawn"
        )
        self.faults.error(place.span, message, help)
        return None

    def _report_no_end(self, links: Links, place: ParsedPlace, link: int) -> None:
        message, help = f"link {link} has no far end: no row comes after it", _TIP_ROW
        if following := [str(row.index) for row in links.rows_after(link)]:
            rows = " and ".join((", ".join(following[:-1]), following[-1]))
            message = f"link {link} has several far ends: rows {rows} come after it"
            help = f"give the centre in frame {link}, [x, y, z]"
        self.faults.error(place.span, message, help)

    def _report_moving(self, links: Links, place: ParsedPlace, link: int, key: str, written: str) -> None:
        shown = "tip" if place.kind == "tip" else written
        message = f"`{shown}` would not be fixed in link {link}: "
        if links.modified:
            message += f"its far end moves with the prismatic joint {link + 1}"
            help = f"add a fixed row for the tip before it, or give the centre in frame {link}: [x, y, z]"
        else:
            message += f"its near end slides along it, for joint {link} is prismatic"
            help = f"measure from the tip, in frame {link}: {key}: {self._back(links, link)}"
        self.faults.error(place.span, message, help)

    def _back(self, links: Links, link: int) -> str:
        """The point a length lc back from the tip of a prismatic link, as a list."""
        ring, joint = self.values.ring, links.joints[link - 1]
        entries = [ring.zero, -ring.sin(joint.alpha), -ring.cos(joint.alpha)]
        words = {0: "0", 1: f"lc{link}", -1: f"-lc{link}"}
        if all(entry.is_number and entry.number in words for entry in entries):
            return "[" + ", ".join(words[int(entry.number)] for entry in entries) + "]"
        return "[x, y, z]"


# The mass and the inertia tensor of a body, made exact; what is wrong with them is reported


def mass_value(values: CellValues, cell: Cell | None, index: int) -> Expr | None:
    """The mass of body `index`; None where a fault of it was reported."""
    mass = values.expr(cell) if cell else None
    if mass is not None and cell and is_positive(-mass):
        values.faults.error(cell.span, f"the mass of body {index} is negative", "masses are not negative")
    return mass


def tensor_value(values: CellValues, tensor: ParsedTensor, index: int) -> Matrix | None:
    """The tensor of body `index`, 3×3; None where a fault of it was reported."""
    zero = values.ring.zero
    rows = [[values.expr(cell) if cell else zero for cell in row] for row in tensor.rows]
    known = [[entry for entry in row if entry is not None] for row in rows]
    asymmetric = False
    for i, j in ((0, 1), (0, 2), (1, 2)):
        above, below = rows[i][j], rows[j][i]
        if tensor.listed and above is not None and below is not None and above != below:
            asymmetric = True
            _report_asymmetry(values, tensor, index, i, j)
    if asymmetric or any(len(row) < 3 for row in known):
        return None
    return Matrix.of(values.ring, known)


def _report_asymmetry(values: CellValues, tensor: ParsedTensor, index: int, i: int, j: int) -> None:
    above, below = tensor.rows[i][j], tensor.rows[j][i]
    assert above and below
    key = AXES[i] + AXES[j]
    message = (
        f"the inertia of body {index} is not symmetric: I_{key[::-1]} = {below.text} is not "
        f"I_{key} = {above.text}"
    )
    help = "an inertia tensor is symmetric: write the same entry in both places"
    values.faults.error(below.span, message, help)
