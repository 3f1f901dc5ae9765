"""The step of a mass centre: where it is in its link, and seen from the base."""

from __future__ import annotations

import re

from dynsolve.algebra import matrix as algebra
from dynsolve.derivation.kinematics import origin
from dynsolve.document import Prose
from dynsolve.errors import ReadError
from dynsolve.explain.context import Context
from dynsolve.explain.step import Detail, Line, Step
from dynsolve.explain.working.identities import said
from dynsolve.explain.working.products import used_in_product
from dynsolve.explain.working.proved import MOST_JOINTS
from dynsolve.explain.writing import block_of, is_small, name_of, spong
from dynsolve.notation.text import read
from dynsolve.notation.tree import (
    Letter,
    Matrix,
    Negative,
    Node,
    Number,
    Parenthesized,
    Product,
    Sum,
    Transpose,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Body, Convention, Robot

STAGE = Stage.INERTIA


def mass_center_step(context: Context, body: Body, tells: bool) -> Step:
    """r_c = R r + o; with `tells` it warns that the mass centre is not the frame's origin."""
    link = body.link
    r, H = letters.rc(body), letters.H(context.robot, link)
    local = context.show(body.center)
    frame = Letter("r", letters.rc(body).sub, Number(link), "bold")
    at_origin = body.center.is_zero
    why: Prose = (f"The mass centre of {name_of(body)} ", *_where(context, body), ".")
    if not any(joint.type for joint in context.robot.path(link)):
        why += (" No joint comes before that link, so the body belongs to the ground and does not move.",)
    formula: Node = equation(r, Sum((Product((letters.R(context.robot, link), frame)), letters.o(link))))
    working: tuple[Node, ...] = ()
    back = None if at_origin else _between_the_ends(context, body)
    if at_origin:
        formula = equation(r, letters.o(link))
    else:
        working = (equation(frame, *_measured(context, body), local),)
        if is_small(local, block_of(context.matrix(f"H{link}"), 3, 0, 4)):
            rotation, origin = _parts(context, link)
            working += (equation(r, Sum((Product((rotation, local)), origin))),)
    return Step(
        id=f"rc{body.name}",
        stage=STAGE,
        title=f"Mass centre of {name_of(body)}",
        why=why,
        formula=formula,
        source=spong("2.6"),
        working=() if back else working,
        lines=(back, *(Line((), (each,)) for each in working)) if back else (),
        result=(equation(r, context.form(f"rc{body.name}")),),
        notes=(_not_the_origin(body, H),) if tells else (),
        detail=Detail.BRIEF,
        uses=(f"H{link}", "axes") if back else None,
    )


def _parts(context: Context, link: int) -> tuple[Matrix, Matrix]:
    H = context.matrix(f"H{link}")
    return block_of(H, 3, 0, 3), block_of(H, 3, 3, 4)


def _where(context: Context, body: Body) -> Prose:
    link, written = body.link, body.center_written
    near, far = ends(context.robot, body)
    if written == "tip":
        return (f"is at the far end of link {link}, ", letters.o(far))
    if written == "origin":
        return ("is at the origin ", letters.o(link), f" of frame {link}")
    if written == "midpoint":
        direction = "back" if context.standard else "on"
        return (
            f"is half-way along link {link}, between ",
            letters.o(near),
            " and ",
            letters.o(far),
            ": from ",
            letters.o(link),
            f", half the way {direction}",
        )
    if body.center.is_zero:
        return ("is at the origin ", letters.o(link), f" of frame {link}")
    if is_given_by(body, "near") and context.standard:
        return (
            f"is given from the near end of link {link}, ",
            letters.o(near),
            f", along the axes of frame {link}. The origin of that frame is at the far end, ",
            letters.o(far),
            ", so the vector back from there is added",
        )
    if is_given_by(body, "along"):
        way: Prose = ("from ", letters.o(near), " to ", letters.o(far))
        fraction = part_of_the_way(body)
        if fraction is None:
            return (f"is on link {link}, at the given part of the way ", *way)
        return ("is ", fraction, f" of the way along link {link}, ", *way)
    return (f"is given by its coordinates in frame {link}, which are constant",)


def is_given_by(body: Body, key: str) -> bool:
    """Whether the problem gives the centre as `{near: ...}` or `{along: ...}`."""
    return re.match(rf"\W*{key}\b", body.center_written) is not None


def part_of_the_way(body: Body) -> Node | None:
    """The part of the way, as the problem writes it; None where it cannot be read."""
    try:
        return read(re.sub(r"^\W*along\W*:|[{}'\"]", "", body.center_written).strip()).tree
    except ReadError:
        return None


def _measured(context: Context, body: Body) -> tuple[Node, ...]:
    """A centre in its frame, from the ends of the link where it is given so: in letters, then in values."""
    found = other_end(context.robot, body)
    if found is None:
        return ()
    way, length = _way(context, body, found[0]), found[1]
    if body.center_written == "midpoint":
        return Product((letters.HALF, *way.factors)), Product((letters.HALF, context.show(length)))
    given = context.show(body.center - length)
    return Sum((way, given)), Sum((context.show(length), given))


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


def _way(context: Context, body: Body, other: int) -> Product:
    """Rᵀ (o_j - o_i), in letters."""
    between = Parenthesized(Sum((letters.o(other), Negative(letters.o(body.link)))))
    return Product((Transpose(letters.R(context.robot, body.link)), between))


def _between_the_ends(context: Context, body: Body) -> Line | None:
    """Rᵀ (o_j - o_i) with this robot's values, of short arms; None where no centre is given from there."""
    found = other_end(context.robot, body)
    if found is None or context.robot.n > MOST_JOINTS:
        return None
    other, length = found
    R, end, own = (
        context.values[f"H{body.link}"].block(0, 3, 0, 3),
        origin(context.values[f"H{other}"]),
        origin(context.values[f"H{body.link}"]),
    )
    used = used_in_product(context, R.T, end - own, length)
    by: Prose = (f"Along the axes of frame {body.link}",)
    by += (", with ", *said(used), ":") if used else (":",)
    values = Product((Transpose(context.show(R)), context.show(end - own)))
    return Line(by, (equation(_way(context, body, other), values, context.show(length)),))


def _not_the_origin(body: Body, H: Letter) -> Prose:
    return (
        f"The mass centre is not the origin of frame {body.link}: the fourth column of ",
        H,
        " is not ",
        letters.rc(body),
        ".",
    )
