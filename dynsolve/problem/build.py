"""Parsed file -> Robot: the exact values of all cells, and the checks that need them.

Of a body: where its mass centre is in the frame of its link, which tensor it has, about
which axes.  What is wrong is reported at its place; nothing is built of it.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from msgspec.structs import replace

from dynsolve.algebra.matrix import Matrix
from dynsolve.notation import text
from dynsolve.notation.characters import split
from dynsolve.notation.tree import Number, walk
from dynsolve.problem.bodies import ParsedShape
from dynsolve.problem.cells import Cell
from dynsolve.problem.decoder import Record
from dynsolve.problem.parsed import ParsedFile, evaluate
from dynsolve.problem.questions import named_point, with_questions
from dynsolve.problem.table import COLUMNS, DHRow
from dynsolve.problem.values import CellValues, PlaceBuilder, mass_value, tensor_value
from dynsolve.problem.yaml_nodes import Faults
from dynsolve.quantities.families import holds_forces
from dynsolve.robot import names
from dynsolve.robot.geometry import Links
from dynsolve.robot.model import Axes, AxesKind, Body, Joint, Robot
from dynsolve.robot.questions import reference
from dynsolve.robot.shapes import AXES, KINDS, Density, Shape
from dynsolve.robot.typed_sums import typed_sums


def build_robot(
    faults: Faults, parsed: ParsedFile, asked: frozenset[str], written: Mapping[str, str]
) -> Robot | None:
    """The robot of a file, None where something of it was reported.

    `asked` are the answers asked for that a derivation has only where they are, `written` its `values`.
    """
    inputs = names.inputs(parsed.coordinates, parsed.spelled) if any(map(holds_forces, asked)) else ()
    references = tuple(reference(q.name) for q in parsed.coordinates) if "Yr" in asked else ()
    _check_alike(faults, parsed)
    _check_references(faults, parsed, references)
    values = evaluate(faults, parsed, written, inputs, references)
    if values is None:
        return None
    ring = values.ring
    joints = [_joint(values, parsed, row) for row in parsed.table.rows]
    known = [joint for joint in joints if joint]
    whole = len(known) == len(joints) and bool(joints) and parsed.table.sound
    model = parsed.model
    links = Links(ring, parsed.convention, known) if whole else None
    rotation = values.rotation(parsed.base.rotation, "the axes of the base") if parsed.base.rotation else None
    move = values.column(parsed.base.move) if parsed.base.move else None
    gravity = values.column(parsed.gravity) if parsed.gravity else None
    builder = BodyBuilder(faults, values, links)
    given, bodies = None, [builder.body(body) for body in parsed.bodies]
    if model is not None:
        from dynsolve.problem.mechanism import given_model, placed_bodies

        given, bodies = given_model(values, model), placed_bodies(values, model)
    if parsed.normals is not None and rotation is not None:
        bodies = [body and _given_from_world(body, rotation) for body in bodies]
    asked_points = [named_point(builder.places, point) for point in parsed.questions.points]
    points = [point for point in asked_points if point]
    if faults.errors or gravity is None:
        return None
    robot = Robot(
        ring=ring,
        convention=parsed.convention,
        coordinates=parsed.coordinates,
        joints=tuple(known),
        bodies=tuple(body for body in bodies if body),
        gravity=gravity,
        base_rotation=rotation or Matrix.identity(ring, 3),
        base_position=move or Matrix.zero(ring, 3, 1),
        base_turns=parsed.base.rotation.factors if parsed.base.rotation else (),
        given=given,
        parameters=tuple(name for name in ring.parameters if name not in ("pi", *inputs)),
        inputs=inputs,
    )
    decimals = frozenset[Fraction]().union(*map(_decimals, parsed.cells))
    has_decimals = any(_has_decimals(cell, robot) for cell in parsed.cells)
    sums = tuple(typed_sums(cell.tree for cell in parsed.cells))
    robot = replace(robot, has_decimals=has_decimals, decimals=decimals, typed_sums=sums)
    if parsed.acting is not None:
        from dynsolve.problem.acting import actions

        robot = replace(robot, actions=actions(values, parsed.acting))
    robot = with_questions(values, robot, parsed.questions, points, asked, parsed.normals is not None)
    robot = _with_candidates(values, parsed, robot)
    return None if faults.errors else robot


def _has_decimals(cell: Cell, robot: Robot) -> bool:
    """Whether a number of a cell is a decimal; a half or a quarter of a letter is a fraction, too: 0.5 l."""
    if robot.is_numeric or not cell.names:
        return text.has_decimals(cell.text)
    return bool(cell.text) and any(number.denominator % 5 == 0 for number in _decimals(cell))


def _decimals(cell: Cell) -> frozenset[Fraction]:
    """The decimals of a cell that are not whole."""
    numbers = (node for node in walk(cell.tree) if isinstance(node, Number))
    return frozenset(Fraction(node.p, node.q) for node in numbers if node.q != 1)


def _check_alike(faults: Faults, parsed: ParsedFile) -> None:
    """Report a name that is printed as another one is, l_1 beside l1."""
    cells = sorted(parsed.cells, key=lambda cell: cell.start)
    places = {name.name: cell.span_of(name) for cell in reversed(cells) for name in reversed(cell.names)}
    met = {split(q.name): q.name for q in parsed.coordinates if q.name not in places}
    for name in sorted(places, key=lambda name: places[name]):
        other = met.setdefault(split(name), name)
        if other != name:
            faults.error(places[name], f"{name} is printed as {other} is", "give it another name")


def _check_references(faults: Faults, parsed: ParsedFile, references: tuple[str, ...]) -> None:
    """Report what is called as a reference is, of which Yr has the rates."""
    found = {name.name: cell.span_of(name) for cell in parsed.cells for name in cell.names}
    for name in found.keys() & set(references):
        message = f"{name} is the reference in Yr of the coordinate {name[:-1]}"
        faults.error(found[name], message, "give it another name")


def _given_from_world(body: Body, base: Matrix) -> Body:
    """A body of a drawing, whose axes that the problem gives from the base are given from the world."""
    if body.axes.kind is not AxesKind.BASE:
        return body
    return replace(body, axes=replace(body.axes, rotation=base.T @ body.axes.rotation))


def _with_candidates(values: CellValues, parsed: ParsedFile, robot: Robot) -> Robot:
    """The robot with the matrices that may be its inertia matrix, where a file has any."""
    if parsed.candidates is None:
        return robot
    from dynsolve.problem.mechanism import assumed, candidates

    judged = candidates(values, parsed.candidates, parsed.model.D if parsed.model else None)
    asks = replace(robot.questions.model, assumed=assumed(values, parsed.candidates))
    return replace(robot, questions=replace(robot.questions, candidates=judged, model=asks))


def _joint(values: CellValues, parsed: ParsedFile, row: DHRow) -> Joint | None:
    if row.faulty:
        return None
    d, a = values.expr(row.cells["d"]), values.expr(row.cells["a"])
    if d is None or a is None:
        return None
    order = parsed.table.names
    theta, d_cell, a_cell, alpha = (row.cells[column].tree for column in COLUMNS)
    return Joint(
        index=row.index,
        theta=row.angles["theta"],
        d=d,
        a=a,
        alpha=row.angles["alpha"],
        variable=row.variable,
        rates=tuple(sorted((order.index(name), rate) for name, rate in row.rates.items())),
        written=(theta, d_cell, a_cell, alpha),
        branch=row.branch,
    )


class BodyBuilder:
    """Makes bodies; `links` is None where the table has errors, and geometry waits until it has none."""

    def __init__(self, faults: Faults, values: CellValues, links: Links | None) -> None:
        self.faults, self.values, self.links = faults, values, links
        self.ring = values.ring
        self.places = PlaceBuilder(faults, values, links)

    def body(self, body: Record) -> Body | None:
        """The `Body` of a body entry of `masses:`; None where a fault of it was reported."""
        mass = mass_value(self.values, body["mass"], body.index)
        axes = self._axes(body)
        tensor = tensor_value(self.values, body["inertia"], body.index) if body["inertia"] else None
        written = self._written(body)
        link, center, shape = (body[key] for key in ("link", "center", "shape"))
        drawn = center.drawn if center else None
        center = self.places.position(center, link, "center", written) if center else None
        about = self._about(body)
        shape = self._shape(shape, body, axes) if shape and not body["inertia"] else None
        if body.faulty or mass is None or axes is None or center is None or link is None:
            return None
        density = body["density"]
        if density is not None:
            found = self._integrated(body, density, axes, shape)
            if found is None:
                return None
            offset, tensor = found
            center = center + offset if density.begins else center
            density, shape = replace(density, shape=shape), None
        elif tensor is None and shape is not None and shape.kind != "point":
            tensor = shape.inertia(mass)
        return Body(
            name=body["name"],
            mass=mass,
            link=link,
            center=center,
            axes=axes,
            inertia=tensor,
            shape=shape,
            about=body["about"],
            about_point=about,
            center_written=written,
            drawn=drawn,
            density=density,
        )

    def _written(self, body: Record) -> str:
        if body["density"] is not None and body["density"].begins:  # its centre counts from the near end
            return "near"
        if body["center"] is None or "center" not in body:
            return "tip"
        return self.faults.source.text[slice(*body["center"].span)]

    def _about(self, body: Record) -> Matrix | None:
        """The point that a given tensor is about, 3×1; None for the mass centre."""
        about, link = body["about"], body["link"]
        if about == "center" or self.links is None or link is None:
            return None
        point = self.links.origin() if about == "origin" else self.links.near_end(link)
        if not self.links.is_fixed(point):
            message = f"`about: joint` is no fixed point of link {link}: joint {link} is prismatic"
            help = "give the inertia about the centre, or about the origin of the frame"
            self.faults.error(body.span_of("about"), message, help)
        return point

    # -- inertia -----------------------------------------------------------------------------------

    def _shape(self, shape: ParsedShape, body: Record, axes: Axes | None) -> Shape | None:
        values = {key: self.values.expr(cell) for key, cell in shape.dimensions.items()}
        for key, cell in shape.dimensions.items():
            value = values[key]
            if value is not None and value.is_number and value.number < 0:
                self.faults.error(cell.span, f"{cell.what} is negative", "dimensions are not negative")
        record = KINDS[shape.kind]
        axis = shape.axis
        has_axis, density = record.has_axis, body["density"]
        if density is not None and (density.varies or density.begins):
            has_axis = True
        if has_axis and not axis:
            along = record.along_link or not record.has_axis
            axis = self._axis_along(shape, body, axes) if along else "z"
        known = tuple((key, value) for key, value in values.items() if value is not None)
        if len(known) < len(values) or (has_axis and not axis):
            return None
        return Shape(shape.kind, known, axis)

    def _integrated(
        self, body: Record, density: Density, axes: Axes, shape: Shape | None
    ) -> tuple[Matrix, Matrix] | None:
        """Of a body with a density: its mass centre from its near end in frame i, 3×1, and its tensor."""
        link, cells = body["link"], body["integrals"]
        values = [value for cell in cells if (value := self.values.expr(cell)) is not None]
        if len(values) < len(cells) or self.links is None or link is None or shape is None:
            return None
        center, *moments = values
        own, zero = AXES.index(shape.axis or AXES[-1]), self.ring.zero
        order = [(own + k) % 3 for k in range(3)]
        tensor = [[moments[order.index(i)] if i == j else zero for j in range(3)] for i in range(3)]
        way = self.links.axes_in_link(axes, link).block(0, 3, own, own + 1)
        far = self.links.far_end(link)
        along = (way.T @ (far - self.links.near_end(link)))[0, 0] if far else zero
        if not along.is_zero and all(factor < 0 for factor in along.poly.coeffs()):
            center = -center  # the link runs against the axis
        return way.scale(center), Matrix.of(self.ring, tensor)

    def _axis_along(self, shape: ParsedShape, body: Record, axes: Axes | None) -> str:
        """The body-attached axis that lies along the link; empty (reported) where none does."""
        link = body["link"]
        if self.links is None or link is None or axes is None:
            return ""
        far = self.links.far_end(link)
        example = f"write the axis of the {shape.kind} in the body-attached frame: axis: x"
        if far is None:
            no = "several far ends, and none" if self.links.rows_after(link) else "no far end"
            message = f"link {link} has {no} that the {shape.kind} could lie along"
            self.faults.error(shape.span, message, example)
            return ""
        direction = self.links.axes_in_link(axes, link).T @ (far - self.links.near_end(link))
        along = [axis for axis, entry in zip(AXES, direction.entries, strict=True) if not entry.is_zero]
        if len(along) == 1:
            return along[0]
        what = "has no length" if not along else "lies along none of the body-attached axes"
        self.faults.error(
            shape.span, f"link {link} {what}, so that the {shape.kind} has no default axis", example
        )
        return ""

    # -- axes --------------------------------------------------------------------------------------

    def _axes(self, body: Record) -> Axes | None:
        axes = body["axes"]
        if axes is None:
            return Axes(AxesKind.LINK, Matrix.identity(self.ring, 3))
        if axes.rotation is None:
            return Axes(axes.kind, Matrix.identity(self.ring, 3), axes.written)
        rotation = self.values.rotation(axes.rotation, f"the axes of body {body.index}")
        return Axes(axes.kind, rotation, axes.written, axes.rotation.factors) if rotation else None
