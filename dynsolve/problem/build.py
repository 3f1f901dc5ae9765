"""Sheet -> Robot: the values of all cells, the geometry of links, the checks that need exact algebra."""

from __future__ import annotations

from dynsolve.algebra.matrix import Matrix
from dynsolve.problem.build_body import BodyBuilder
from dynsolve.problem.geometry import Links
from dynsolve.problem.sheet import Sheet
from dynsolve.problem.source import Faults
from dynsolve.problem.table import COLUMNS, DHRow
from dynsolve.problem.values import CellValues, evaluate
from dynsolve.robot.model import Coordinate, Joint, JointType, Robot


def build_robot(report: Faults, sheet: Sheet) -> Robot | None:
    """The robot of a file, None where something of it was reported."""
    values = evaluate(report, sheet)
    if values is None:
        return None
    ring = values.ring
    joints = [_joint(values, sheet, row) for row in sheet.table.rows]
    known = [joint for joint in joints if joint]
    whole = len(known) == len(joints) and bool(joints) and sheet.table.sound
    links = Links(ring, sheet.convention, known, sheet.table.names) if whole else None
    rotation = values.rotation(sheet.base.rotation, "the axes of the base") if sheet.base.rotation else None
    move = values.column(sheet.base.move) if sheet.base.move else None
    gravity = values.column(sheet.gravity) if sheet.gravity else None
    builder = BodyBuilder(report, values, links)
    bodies = [builder.body(body) for body in sheet.bodies]
    if report.errors or gravity is None:
        return None
    return Robot(
        ring=ring,
        convention=sheet.convention,
        coordinates=tuple(
            Coordinate(name, JointType(kind), index)
            for index, (name, kind) in enumerate(sheet.table.coordinates, 1)
        ),
        joints=tuple(known),
        bodies=tuple(body for body in bodies if body),
        gravity=gravity,
        base_rotation=rotation or Matrix.identity(ring, 3),
        base_position=move or Matrix.zero(ring, 3, 1),
        parameters=tuple(name for name in ring.parameters if name != "pi"),
    )


def _joint(values: CellValues, sheet: Sheet, row: DHRow) -> Joint | None:
    if row.faulty:
        return None
    d, a = values.expr(row.cells["d"]), values.expr(row.cells["a"])
    if d is None or a is None:
        return None
    order = sheet.table.names
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
    )
