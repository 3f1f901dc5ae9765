"""One entry of `masses:` -> Body: where its centre is, which tensor it has, about which axes."""

from __future__ import annotations

from fractions import Fraction

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.problem.bodies import AxesSheet, BodySheet, CenterSheet, ShapeSheet, TensorSheet
from dynsolve.problem.geometry import Links
from dynsolve.problem.source import Faults
from dynsolve.problem.values import CellValues
from dynsolve.robot.model import Axes, AxesKind, Body
from dynsolve.robot.shapes import AXES, KINDS, Shape

_TIP_ROW = (
    "add a fixed row for the tip, {theta: 0, d: 0, a: l, alpha: 0} with its length, "
    "or give the centre as [x, y, z]"
)


class BodyBuilder:
    """Makes bodies; `links` is None where the table has errors, and geometry waits until it has none."""

    def __init__(self, report: Faults, values: CellValues, links: Links | None) -> None:
        self.report, self.values, self.links = report, values, links
        self.ring = values.ring

    def body(self, sheet: BodySheet) -> Body | None:
        """The body of a sheet, None where something of it was reported."""
        mass = self._mass(sheet)
        axes = self._axes(sheet)
        tensor = self._tensor(sheet.tensor, sheet) if sheet.tensor else None
        center = self._center(sheet.center, sheet) if sheet.center else None
        about = self._about(sheet)
        shape = self._shape(sheet.shape, sheet, axes) if sheet.shape and not sheet.tensor else None
        if sheet.faulty or mass is None or axes is None or center is None or sheet.link is None:
            return None
        if tensor is None and shape is not None and shape.kind != "point":
            tensor = shape.inertia(mass)
        return Body(
            name=sheet.name,
            mass=mass,
            link=sheet.link,
            center=center,
            axes=axes,
            inertia=tensor,
            shape=shape,
            about=sheet.about,
            about_point=about,
            center_written=self._written(sheet),
        )

    def _mass(self, sheet: BodySheet) -> Expr | None:
        mass = self.values.expr(sheet.mass) if sheet.mass else None
        if mass is not None and sheet.mass and mass.is_number and mass.number < 0:
            self.report.error(
                sheet.mass.span, f"the mass of body {sheet.index} is negative", "masses are not negative"
            )
        return mass

    def _written(self, sheet: BodySheet) -> str:
        if sheet.center is None or "center" not in sheet.fields:
            return "tip"
        return self.report.source.text[slice(*sheet.center.span)]

    # -- where the centre is -----------------------------------------------------------------------

    def _center(self, center: CenterSheet, sheet: BodySheet) -> Matrix | None:
        """The mass centre in frame `link`, 3×1."""
        given = self.values.column(center.cells) if center.kind in ("near", "at") else None
        fraction = self.values.expr(center.cells[0]) if center.kind == "along" else None
        if center.kind == "at":
            return given
        if self.links is None or sheet.link is None:
            return None
        if center.kind == "origin":
            return self.links.origin()
        near, far = self.links.near_end(sheet.link), self.links.far_end(sheet.link)
        if center.kind == "near":
            point = near + given if given else None
        elif far is None:
            message = f"link {sheet.link} has no far end: the table has no row {sheet.link + 1}"
            self.report.error(center.span, message, _TIP_ROW)
            return None
        elif center.kind == "tip":
            point = far
        else:
            half = self.ring.constant(Fraction(1, 2)) if center.kind == "midpoint" else fraction
            point = near + (far - near).scale(half) if half is not None else None
        if point is not None and not self.links.is_fixed(point):
            self._report_moving(center, sheet)
            return None
        return point

    def _report_moving(self, center: CenterSheet, sheet: BodySheet) -> None:
        assert self.links is not None and sheet.link is not None
        link = sheet.link
        written = "tip" if center.kind == "tip" else self._written(sheet)
        message = f"`{written}` would not be fixed in link {link}: "
        if self.links.modified:
            message += f"its far end moves with the prismatic joint {link + 1}"
            help = f"add a fixed row for the tip before it, or give the centre in frame {link}: [x, y, z]"
        else:
            message += f"its near end slides along it, for joint {link} is prismatic"
            help = f"measure from the tip, in frame {link}: center: {self._back(link)}"
        self.report.error(center.span, message, help)

    def _back(self, link: int) -> str:
        """The point a length lc back from the tip of a prismatic link, as a list."""
        assert self.links is not None
        joint = self.links.joints[link - 1]
        entries = [self.ring.zero, -self.ring.sin(joint.alpha), -self.ring.cos(joint.alpha)]
        words = {0: "0", 1: f"lc{link}", -1: f"-lc{link}"}
        if all(entry.is_number and entry.number in words for entry in entries):
            return "[" + ", ".join(words[int(entry.number)] for entry in entries) + "]"
        return "[x, y, z]"

    def _about(self, sheet: BodySheet) -> Matrix | None:
        """The point that a given tensor is about, 3×1; None for the mass centre."""
        if sheet.about == "center" or self.links is None or sheet.link is None:
            return None
        point = self.links.origin() if sheet.about == "origin" else self.links.near_end(sheet.link)
        if not self.links.is_fixed(point):
            message = (
                f"`about: joint` is no fixed point of link {sheet.link}: joint {sheet.link} is prismatic"
            )
            help = "give the inertia about the centre, or about the origin of the frame"
            self.report.error(sheet.fields.span_of("about"), message, help)
        return point

    # -- inertia -----------------------------------------------------------------------------------

    def _tensor(self, tensor: TensorSheet, sheet: BodySheet) -> Matrix | None:
        zero = self.ring.zero
        rows = [[self.values.expr(cell) if cell else zero for cell in row] for row in tensor.rows]
        known = [[entry for entry in row if entry is not None] for row in rows]
        asymmetric = False
        for i, j in ((0, 1), (0, 2), (1, 2)):
            above, below = rows[i][j], rows[j][i]
            if tensor.listed and above is not None and below is not None and above != below:
                asymmetric = True
                self._report_asymmetry(tensor, sheet, i, j)
        if asymmetric or any(len(row) < 3 for row in known):
            return None
        return Matrix.of(self.ring, known)

    def _report_asymmetry(self, tensor: TensorSheet, sheet: BodySheet, i: int, j: int) -> None:
        above, below = tensor.rows[i][j], tensor.rows[j][i]
        assert above and below
        key = AXES[i] + AXES[j]
        message = (
            f"the inertia of body {sheet.index} is not symmetric: "
            f"I_{key[::-1]} = {below.text} is not I_{key} = {above.text}"
        )
        self.report.error(
            below.span, message, "an inertia tensor is symmetric: write the same entry in both places"
        )

    def _shape(self, shape: ShapeSheet, sheet: BodySheet, axes: Axes | None) -> Shape | None:
        values = {key: self.values.expr(cell) for key, cell in shape.dimensions.items()}
        for key, cell in shape.dimensions.items():
            value = values[key]
            if value is not None and value.is_number and value.number < 0:
                self.report.error(cell.span, f"{cell.what} is negative", "dimensions are not negative")
        record = KINDS[shape.kind]
        axis = shape.axis
        if record.has_axis and not axis:
            axis = self._axis_along(shape, sheet, axes) if record.along_link else "z"
        known = tuple((key, value) for key, value in values.items() if value is not None)
        if len(known) < len(values) or (record.has_axis and not axis):
            return None
        return Shape(shape.kind, known, axis)

    def _axis_along(self, shape: ShapeSheet, sheet: BodySheet, axes: Axes | None) -> str:
        """The body-attached axis that lies along the link; empty (reported) where none does."""
        if self.links is None or sheet.link is None or axes is None:
            return ""
        far = self.links.far_end(sheet.link)
        example = f"write the axis of the {shape.kind} in the body-attached frame: axis: x"
        if far is None:
            message = f"link {sheet.link} has no far end that the {shape.kind} could lie along"
            self.report.error(shape.span, message, example)
            return ""
        direction = self._axes_in_link(axes, sheet.link).T @ (far - self.links.near_end(sheet.link))
        along = [axis for axis, entry in zip(AXES, direction.entries, strict=True) if not entry.is_zero]
        if len(along) == 1:
            return along[0]
        what = "has no length" if not along else "lies along none of the body-attached axes"
        self.report.error(
            shape.span, f"link {sheet.link} {what}, so that the {shape.kind} has no default axis", example
        )
        return ""

    # -- axes --------------------------------------------------------------------------------------

    def _axes(self, sheet: BodySheet) -> Axes | None:
        axes = sheet.axes
        if axes is None or axes.rotation is None:
            return Axes(
                axes.kind if axes else AxesKind.LINK, Matrix.identity(self.ring, 3), self._axes_written(axes)
            )
        rotation = self.values.rotation(axes.rotation, f"the axes of body {sheet.index}")
        return Axes(axes.kind, rotation, axes.written) if rotation else None

    @staticmethod
    def _axes_written(axes: AxesSheet | None) -> str:
        return axes.written if axes else ""

    def _axes_in_link(self, axes: Axes, link: int) -> Matrix:
        """The body-attached axes seen from the link's frame at q = 0, 3×3."""
        assert self.links is not None
        if axes.kind is AxesKind.LINK:
            return axes.rotation
        return self.links.rotation_at_rest(link).T @ axes.rotation.map(self.ring.at_rest)
