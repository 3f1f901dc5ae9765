"""The step of a mass centre: where it is in its link, and seen from the base."""

from __future__ import annotations

import re
from dataclasses import dataclass

from dynsolve.algebra import matrix as algebra
from dynsolve.document import Prose
from dynsolve.errors import ReadError
from dynsolve.explain.citations import GEOMETRY, GIVEN
from dynsolve.explain.context import Context
from dynsolve.explain.jacobian import told_frames
from dynsolve.explain.step import TOLD, WORKED, Detail, Part, Step
from dynsolve.explain.writing import block_of, is_small, name_of, spong
from dynsolve.notation.text import read
from dynsolve.notation.tree import (
    Letter,
    Matrix,
    Node,
    Number,
    Parenthesized,
    Product,
    Row,
    Sum,
    Words,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Body, Convention, Robot

STAGE = Stage.INERTIA


def mass_center_step(context: Context, body: Body, tells: bool) -> Step:
    """r_c = R r + o; with `tells` it warns that the mass centre is not the frame's origin."""
    r, way = letters.rc(body), _way(context, body)
    kind, where = _where(context, body)
    why: Prose = (f"The mass centre of {name_of(body)} ", *where, ".")
    if not any(joint.type for joint in context.robot.path(body.link)):
        kind = ""
        why += (" No joint comes before that link, so the body belongs to the ground and does not move.",)
    return Step(
        id=f"rc{body.name}",
        stage=STAGE,
        title=f"Mass centre of {name_of(body)}",
        why=why,
        formula=equation(r, way.named),
        source=way.source,
        further=way.given,
        working=(equation(r, way.values),) if way.values else (),
        result=(equation(r, context.form(f"rc{body.name}")),),
        notes=(_not_the_origin(body, letters.H(context.robot, body.link)),) if tells else (),
        detail=Detail.BRIEF,
        normal=WORKED & ~Part.FURTHER | Part.WHY if way.values else TOLD,
        said=f"center {kind}" if kind else "",
        uses=way.uses,
    )


@dataclass(frozen=True, slots=True)
class _Way:
    """A mass centre in letters and, where these are short, in values; what is given for it; its inputs.

    `source` is what the formula rests on: a rigid motion, unless the centre is a given point or between two.
    """

    named: Node
    values: Node | None = None
    given: tuple[Node, ...] = ()
    uses: tuple[str, ...] | None = None
    source: str = spong("2.6")


def _way(context: Context, body: Body) -> _Way:
    """From the ends of the link, where the problem gives it from there; else by its coordinates."""
    if body.center.is_zero:
        return _Way(letters.o(body.link), uses=_told_at(context.robot, body.link), source=GIVEN)
    other = other_end(context.robot, body)
    if other is None:
        own = Letter("r", letters.rc(body).sub, Number(body.link), "bold")
        return _from(context, body, body.link, own, body.center)
    if body.center_written == "midpoint":
        both = ends(context.robot, body)
        between = _half(*map(letters.o, both))
        values = [_origin(context, end) for end in both]
        shown = _half(*values) if is_small(*values) else None
        return _Way(between, shown, uses=("axes",), source=GEOMETRY)
    end, back = other
    index = Row((Number(end), Words(","), Words("c"), letters.index_of(body.name)))
    lever = letters.bold("r", index, Number(body.link))
    return _from(context, body, end, lever, body.center - back)


def _from(context: Context, body: Body, start: int, lever: Letter, value: algebra.Matrix) -> _Way:
    """R r + o: the lever r from origin `start`, given along the axes of the link's frame."""
    link, shown = body.link, context.show(value)
    rotation, origin = block_of(context.matrix(f"H{link}"), 3, 0, 3), _origin(context, start)
    values = Sum((Product((rotation, shown)), origin)) if is_small(shown, rotation, origin) else None
    named = Sum((Product((letters.R(context.robot, link), lever)), letters.o(start)))
    return _Way(named, values, (equation(lever, shown),), None if start == link else (f"H{link}", "axes"))


def _origin(context: Context, frame: int) -> Matrix:
    return block_of(context.matrix(f"H{frame}"), 3, 3, 4)


def _told_at(robot: Robot, frame: int) -> tuple[str, ...]:
    """The step that tells the origin of a frame: that of axes and origins, else the frame's own."""
    return ("axes",) if frame in told_frames(robot) else (f"H{frame}",)


def _half(near: Node, far: Node) -> Node:
    return Product((letters.HALF, Parenthesized(Sum((near, far)))))


def _where(context: Context, body: Body) -> tuple[str, Prose]:
    """How a mass centre is given: the kind of it, and in words."""
    link, written = body.link, body.center_written
    near, far = ends(context.robot, body)
    if written == "tip":
        return written, (f"is at the far end of link {link}, ", letters.o(far))
    if written == "midpoint":
        return written, (f"is half-way along link {link}, between ", letters.o(near), " and ", letters.o(far))
    if body.center.is_zero:
        return "origin", ("is at the origin ", letters.o(link), f" of frame {link}")
    if is_given_by(body, "near") and context.standard:
        return "near", (
            f"is given from the near end of link {link}, ",
            letters.o(near),
            f", along the axes of frame {link}, which is fixed in the link",
        )
    if is_given_by(body, "along"):
        way: Prose = ("from ", letters.o(near), " to ", letters.o(far))
        fraction = part_of_the_way(body)
        if fraction is None:
            return "", (f"is on link {link}, at the given part of the way ", *way)
        return "", ("is ", fraction, f" of the way along link {link}, ", *way)
    return "frame", (f"is given by its coordinates in frame {link}, which are constant",)


def is_given_by(body: Body, key: str) -> bool:
    """Whether the problem gives the centre as `{near: ...}` or `{along: ...}`."""
    return re.match(rf"\W*{key}\b", body.center_written) is not None


def part_of_the_way(body: Body) -> Node | None:
    """The part of the way, as the problem writes it; None where it cannot be read."""
    try:
        return read(re.sub(r"^\W*along\W*:|[{}'\"]", "", body.center_written).strip()).tree
    except ReadError:
        return None


def ends(robot: Robot, body: Body) -> tuple[int, int]:
    """The frames at the near and at the far end of a body's link."""
    if robot.convention is Convention.STANDARD:
        return robot.joints[body.link - 1].parent, body.link
    return body.link, next(iter(robot.links_after(body.link)), body.link + 1)


def other_end(robot: Robot, body: Body) -> tuple[int, algebra.Matrix] | None:
    """The frame at the other end of a link from which a centre is given, and the vector to it.

    The vector is in the link's own frame.
    """
    standard, link = robot.convention is Convention.STANDARD, body.link
    after = robot.links_after(link)
    if not (standard or len(after) == 1):
        return None
    row = robot.joints[link - 1 if standard else after[0] - 1]
    ring = robot.ring
    sine, cosine = ring.sin(row.alpha), ring.cos(row.alpha)
    if standard:
        back = algebra.Matrix.column(ring, (-row.a, -(row.d * sine), -(row.d * cosine)))
        is_near = is_given_by(body, "near") and not back.is_zero
        return (row.parent, back) if is_near or body.center_written == "midpoint" else None
    onward = algebra.Matrix.column(ring, (row.a, -(row.d * sine), row.d * cosine))
    return (row.index, onward) if body.center_written == "midpoint" else None


def _not_the_origin(body: Body, H: Letter) -> Prose:
    return (
        f"The mass centre is not the origin of frame {body.link}: the fourth column of ",
        H,
        " is not ",
        letters.rc(body),
        ".",
    )
