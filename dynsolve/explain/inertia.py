"""Steps of the bodies: mass centre, inertia tensor, its orientation, and the tensor in the base frame."""

from __future__ import annotations

import re
from collections.abc import Iterator

from dynsolve.algebra import matrix as algebra
from dynsolve.derivation import inertia
from dynsolve.document import Prose
from dynsolve.errors import ReadError
from dynsolve.explain.course import Course, block_of, is_small, shv, side_by_side
from dynsolve.explain.step import Detail, Step
from dynsolve.notation.text import read
from dynsolve.notation.tree import (
    Letter,
    Matrix,
    Negative,
    Node,
    Number,
    Parenthesized,
    Product,
    Row,
    Sum,
    Symbol,
    Transpose,
    Words,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import AxesKind, Body

STAGE = Stage.INERTIA

_SHAPES = {
    "box": "rectangular solid",
    "cylinder": "solid cylinder",
    "hollow_cylinder": "hollow cylinder",
    "rod": "slender rod",
    "disk": "thin disk",
    "sphere": "solid sphere",
    "shell": "thin spherical shell",
}


_SOURCES = {
    "box": shv("7.2.1"),
    **dict.fromkeys(("cylinder", "sphere"), "Lynch and Park 8.2.1"),
    **dict.fromkeys(("hollow_cylinder", "rod", "disk", "shell"), f"by the integrals of {shv('7.2.1')}"),
}
"""Where the moments of a shape stand; Lynch and Park is Modern Robotics, Cambridge, 2017."""


def steps(course: Course) -> Iterator[Step]:
    """Of each body: r_c, and unless it is a point, I, R and I in the base frame."""
    bodies = course.robot.bodies
    off_origin = next((body for body in bodies if not body.center.is_zero), None)
    framed = next(
        (body for body in bodies if _has_link_axes(body) and any(_right_frame(course, body.link))), None
    )
    for body in bodies:
        yield _center(course, body, tells=body is off_origin)
        if body.is_point:
            yield _point(course, body)
            continue
        yield _tensor(course, body)
        if _is_moved(body):
            yield _parallel_axis(course, body)
        yield _rotation(course, body, tells=body is framed)
        yield _base_tensor(course, body)


def name_of(body: Body) -> str:
    """How sentences call a body."""
    return f"body {body.name}"


# -- the mass centre -------------------------------------------------------------------------------


def _center(course: Course, body: Body, tells: bool) -> Step:
    link = body.link
    r, H = letters.rc(body), letters.H(course.robot, link)
    local = course.show(body.center)
    frame = Letter("r", letters.rc(body).sub, Number(link), "bold")
    at_origin = body.center.is_zero
    why: Prose = (f"The mass centre of {name_of(body)} ", *_where(course, body), ".")
    if not any(joint.type for joint in course.robot.joints[:link]):
        why += (" No joint comes before that link, so the body belongs to the ground and does not move.",)
    formula: Node = equation(r, Sum((Product((letters.R(course.robot, link), frame)), letters.o(link))))
    working: tuple[Node, ...] = ()
    if at_origin:
        formula = equation(r, letters.o(link))
    else:
        working = (equation(frame, *_measured(course, body), local),)
        if is_small(local, block_of(course.matrix(f"H{link}"), 3, 0, 4)):
            rotation, origin = _parts(course, link)
            working += (equation(r, Sum((Product((rotation, local)), origin))),)
    return Step(
        id=f"rc{body.name}",
        stage=STAGE,
        title=f"Mass centre of {name_of(body)}",
        why=why,
        formula=formula,
        source=shv("7.2"),
        working=working,
        result=(equation(r, course.form(f"rc{body.name}")),),
        notes=(_not_the_origin(body, H),) if tells else (),
        detail=Detail.BRIEF,
    )


def _parts(course: Course, link: int) -> tuple[Matrix, Matrix]:
    H = course.matrix(f"H{link}")
    return block_of(H, 3, 0, 3), block_of(H, 3, 3, 4)


def _where(course: Course, body: Body) -> Prose:
    link, written = body.link, body.center_written
    near, far = (link - 1, link) if course.standard else (link, link + 1)
    if written == "tip":
        return (f"is at the far end of link {link}, ", letters.o(far))
    if written == "origin":
        return ("is at the origin ", letters.o(link), f" of frame {link}")
    if written == "midpoint":
        direction = "back" if course.standard else "on"
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
        return ("falls on the origin ", letters.o(link), f" of frame {link}")
    if _given(body, "near") and course.standard:
        return (
            f"is given from the near end of link {link}, ",
            letters.o(near),
            f", along the axes of frame {link}. The origin of that frame is at the far end, ",
            letters.o(far),
            ", so the way back from there is added",
        )
    if _given(body, "along"):
        ends: Prose = ("from ", letters.o(near), " to ", letters.o(far))
        fraction = _fraction(body)
        if fraction is None:
            return (f"is on link {link}, at the given part of the way ", *ends)
        return ("is ", fraction, f" of the way along link {link}, ", *ends)
    return (f"is given by its coordinates in frame {link}, which are constant",)


def _given(body: Body, key: str) -> bool:
    """Whether the problem gives the centre as `{near: ...}` or `{along: ...}`."""
    return re.match(rf"\W*{key}\b", body.center_written) is not None


def _fraction(body: Body) -> Node | None:
    """The part of the way, as the problem writes it; None where it cannot be read."""
    try:
        return read(re.sub(r"^\W*along\W*:|[{}'\"]", "", body.center_written).strip()).tree
    except ReadError:
        return None


def _measured(course: Course, body: Body) -> tuple[Node, ...]:
    """A centre in its frame, from the ends of the link between which the problem gives it."""
    robot, link = course.robot, body.link
    if not (course.standard or link < len(robot.joints)):
        return ()
    row = robot.joints[link - 1 if course.standard else link]
    ring = robot.ring
    sine, cosine = ring.sin(row.alpha), ring.cos(row.alpha)
    across = row.d * sine if course.standard else -(row.d * sine)
    length = algebra.Matrix.column(ring, (row.a, across, row.d * cosine))  # from the near to the far end
    if _given(body, "near") and course.standard and not length.is_zero:
        return (Sum((course.show(-length), course.show(body.center + length))),)
    if body.center_written == "midpoint":
        return (Product((letters.HALF, course.show(-length if course.standard else length))),)
    return ()


def _not_the_origin(body: Body, H: Letter) -> Prose:
    return (
        f"The mass centre is not the origin of frame {body.link}: the fourth column of ",
        H,
        " is not ",
        letters.rc(body),
        ".",
    )


# -- the tensor ------------------------------------------------------------------------------------


def _is_moved(body: Body) -> bool:
    """Whether the tensor is given about a point that is not the mass centre."""
    return body.about_point is not None and body.about_point != body.center


def _point(course: Course, body: Body) -> Step:
    tensor = letters.tensor(course.robot, body)
    return Step(
        id=f"I{body.name}",
        stage=STAGE,
        title=f"Inertia of {name_of(body)}",
        why=(
            "A point mass has no extent, so its tensor about its own mass centre is zero and it has no "
            "rotational energy. No R and no ",
            letters.of_body("I", body, "script"),
            " are needed.",
        ),
        source=shv("7.2.1"),
        result=(equation(tensor, Number(0)),),
    )


def _tensor(course: Course, body: Body) -> Step:
    tensor = letters.tensor(course.robot, body)
    assert body.inertia is not None
    about = "the mass centre"
    if _is_moved(body):
        tensor = Letter("I", Row((letters.index_of(body.name), Words(","), Words("given"))), None, "bold")
        about = f"the origin of frame {body.link}" if body.about == "origin" else "the near end of its link"
    formula, working, why = _shape(course, body)
    if body.shape is None or not body.shape.formulas:
        why = (f"The tensor of {name_of(body)} is given, about {about}, along the axes of its own frame.",)
    return Step(
        id=f"I_given{body.name}" if _is_moved(body) else f"I_body{body.name}",
        stage=STAGE,
        title=f"Inertia tensor of {name_of(body)} in its own frame",
        why=why,
        formula=formula,
        source=shv("7.2.1") if formula is None or body.shape is None else _SOURCES[body.shape.kind],
        working=working,
        result=(equation(tensor, course.show(body.inertia)),),
    )


def _shape(course: Course, body: Body) -> tuple[Node | None, tuple[Node, ...], Prose]:
    """The formula of a uniform shape, with what its letters are here."""
    shape = body.shape
    if shape is None or not shape.formulas:
        return None, (), ()
    formula = side_by_side([
        equation(Letter("I", Words(axes)), moment) for axes, moment in shape.formulas
    ])  # fmt: skip
    given = [equation(Symbol("m"), course.show(body.mass))]
    given += [equation(Symbol(letter), course.show(value)) for letter, value in shape.letters]
    given = [relation for relation in given if relation.parts[0] != relation.parts[1]]
    why: Prose = (f"{name_of(body).capitalize()} is a uniform {_SHAPES[shape.kind]}",)
    if shape.axis:
        why += (f", its own axis along {shape.axis} of the body's frame",)
    why += (". Its principal moments about the mass centre:",)
    return formula, (side_by_side(given),) if given else (), why


def _parallel_axis(course: Course, body: Body) -> Step:
    b = body.name
    tensor = letters.tensor(course.robot, body)
    given = Letter("I", Row((letters.index_of(b), Words(","), Words("given"))), None, "bold")
    r = Letter("r", style="bold")
    mass = course.mass(body)
    square = Product((Transpose(r), r, letters.bold("E")))
    shift = Product((mass, Sum((square, Negative(Product((r, Transpose(r))))))))
    H = course.values[f"H{body.link}"]
    relative = inertia.axes_in_link(course.robot, body, H)
    assert body.about_point is not None
    offset = relative.T @ (body.center - body.about_point)
    return Step(
        id=f"I_body{b}",
        stage=STAGE,
        title=f"Parallel axis: the tensor of {name_of(body)} about its mass centre",
        why=(
            "The given tensor is about another point, but the kinetic energy asks for the one about the mass "
            "centre. r goes from the given point to the mass centre, in the body's axes; E is the identity.",
        ),
        formula=equation(tensor, Sum((given, Negative(shift)))),
        source="parallel-axis theorem; Craig 6.3",
        working=(
            equation(r, course.show(offset)),
            equation(shift, course.show(inertia.steiner(body.mass, offset))),
        ),
        result=(equation(tensor, course.form(f"I_body{b}")),),
    )


# -- its orientation -------------------------------------------------------------------------------


def _has_link_axes(body: Body) -> bool:
    """Whether the body-attached axes are those of its link's frame, the default."""
    axes = body.axes
    one = algebra.Matrix.identity(axes.rotation.ring, 3)
    return not body.is_point and axes.kind is AxesKind.LINK and axes.rotation == one


def _rotation(course: Course, body: Body, tells: bool) -> Step:
    robot, link = course.robot, body.link
    rotation, frame = letters.of_body("R", body, "bold"), letters.R(robot, link)
    turned = course.show(body.axes.rotation)
    notes: tuple[Prose, ...] = ()
    formula: Node | None = None
    match body.axes.kind:
        case AxesKind.LINK if _has_link_axes(body):
            which = "the frame that comes after the mass and" if _ends_after(course, body) else "which"
            why: Prose = (f"The body's axes are those of frame {link}, {which} is fixed in the same link.",)
            formula = equation(rotation, frame)
            notes = tuple(_right_frame(course, link)) if tells else ()
        case AxesKind.LINK:
            why = (f"The body's axes are turned in frame {link}, as the problem gives them.",)
            formula = equation(rotation, Product((frame, turned)))
        case AxesKind.REST:
            why = (
                "The body's axes are parallel to frame 0 at q = 0 and turn with the link: first back by how "
                "the link is turned at q = 0, then on as it is turned.",
            )
            at_rest = Row((frame, Words("(0)")))
            factors: list[Node] = [frame, Transpose(Parenthesized(at_rest))]
            if letters.has_base(robot):
                factors.append(letters.R(robot, 0))
            formula = equation(rotation, Product(tuple(factors)))
        case AxesKind.BASE:
            why = (f"The rotation from the base to the frame of {name_of(body)} is given by the problem.",)
            if letters.has_base(robot):
                formula = equation(rotation, Product((letters.R(robot, 0), turned)))
            if not inertia.turns_with_link(robot, body, course.values[f"H{link}"]):
                notes = (
                    (
                        f"This frame does not turn with link {link}. It may be used all the same: the "
                        "kinetic energy comes out as with the frame that turns (compared exactly).",
                    ),
                )
    return Step(
        id=f"R{body.name}",
        stage=STAGE,
        title=f"Orientation of {name_of(body)}",
        why=why,
        formula=formula,
        source=shv("7.2"),
        result=(equation(rotation, course.form(f"R{body.name}")),),
        notes=notes,
    )


def _ends_after(course: Course, body: Body) -> bool:
    """Whether the frame of the link is known to lie behind the mass: the mass is between the link's ends."""
    between = body.center_written in ("tip", "midpoint") or _given(body, "near") or _given(body, "along")
    return course.standard and between


def _right_frame(course: Course, link: int) -> Iterator[Prose]:
    """Which frame is mistaken for that of the link: the one at its other end."""
    joints = course.robot.joints
    if course.standard:
        if link > 1 and joints[link - 1].type:
            yield (
                f"Frame {link} is the one to take, not frame {link - 1}, which is not fixed in link {link}.",
            )
    elif link < len(joints) and joints[link].type:
        yield (
            f"Frame {link} is the one to take, at the near end of the link in the modified convention. "
            f"Frame {link + 1}, after the mass, moves with the next link.",
        )


def _base_tensor(course: Course, body: Body) -> Step:
    b = body.name
    inertia_, R, tensor = (
        letters.of_body("I", body, "script"),
        letters.of_body("R", body, "bold"),
        letters.tensor(course.robot, body),
    )
    rotation, given = course.form(f"R{b}"), course.form(f"I_body{b}")
    product = Product((R, tensor, Transpose(R)))
    members: list[Node] = [inertia_, product]
    if is_small(rotation, rotation, given):
        members.append(Product((rotation, given, Transpose(rotation))))
    base = course.form(f"I{b}")
    notes: tuple[Prose, ...] = ()
    if base == given:
        notes = (("Here the turn changes nothing.",),)
    return Step(
        id=f"I{b}",
        stage=STAGE,
        title=f"Inertia tensor of {name_of(body)} in {course.ground} coordinates",
        why=(
            f"ω is found in {course.ground} coordinates, so the tensor must be too: R turns the body's axes "
            f"into the {course.ground}'s.",
        ),
        formula=equation(*members[:2]),
        source=shv("7.2.1"),
        working=(equation(inertia_, members[2]),) if len(members) > 2 else (),
        result=(equation(inertia_, base),),
        notes=notes,
        detail=Detail.BRIEF if is_small(base) else Detail.NORMAL,
    )
