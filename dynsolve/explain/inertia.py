"""Steps of the bodies: inertia tensor, its orientation, and the tensor in the base frame.

The first step of a body, its mass centre, is in `mass_centers`, how R I Rᵀ comes about in `turned_tensors`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from dynsolve.algebra import matrix as algebra
from dynsolve.derivation import inertia
from dynsolve.document import Prose, Reference
from dynsolve.explain.context import Context
from dynsolve.explain.forms import Forms
from dynsolve.explain.kinematics import product_of_axes, why_axes
from dynsolve.explain.mass_centers import density_step, mass_center_step, turning_of
from dynsolve.explain.parameter_meanings import SHAPES, letters_of, shape_letters
from dynsolve.explain.placed_bodies import center_step, orientation_step
from dynsolve.explain.step import TOLD, Detail, Group, Part, Step
from dynsolve.explain.working.rotational import along_own_axes, factor_of_identity
from dynsolve.explain.writing import (
    GIVEN,
    LYNCH_PARK,
    is_small,
    listed,
    measured,
    name_of,
    side_by_side,
    spong,
)
from dynsolve.notation.tree import (
    Letter,
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
from dynsolve.notation.walk import mapped
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import AxesKind, Body
from dynsolve.robot.shapes import MASS

STAGE = Stage.INERTIA

CENTERS = Group("rc", "The mass centres")
TENSORS = Group("I", "The inertia tensors")

_SOURCES = {
    "box": spong("7.2.1"),
    "cylinder": LYNCH_PARK.section("8.2.1"),
    "sphere": f"from {LYNCH_PARK.section('8.2.1')}",  # which has the ellipsoid
    **dict.fromkeys(("hollow_cylinder", "rod", "disk", "shell"), f"by the integrals of {spong('7.2.1')}"),
}
"""Where the moments of a shape stand."""


def steps(context: Context) -> Iterator[Step]:
    """Of each body: r_c, and unless it is a point, I, R and I in the base frame."""
    bodies = context.robot.bodies
    off_origin = next((body for body in bodies if not body.center.is_zero), None)
    framed = next(
        (body for body in bodies if has_link_axes(body) and any(_right_frame(context, body.link))), None
    )
    placed = not context.robot.has_table
    for body in bodies:
        if body.density is not None:
            yield density_step(context, body, body.density)
    for body in bodies:
        center = center_step(context, body) if placed else mass_center_step(context, body, body is off_origin)
        yield replace(center, group=CENTERS)
    for body in bodies:
        for step in _of_extent(context, body, body is framed):
            yield replace(step, group=TENSORS)


def _of_extent(context: Context, body: Body, tells: bool) -> Iterator[Step]:
    """The inertia tensor of a body, along its axes and those of the base."""
    if body.is_point:
        yield _point(context, body)
        return
    yield _tensor(context, body)
    if is_moved(body):
        yield _parallel_axis(context, body)
    yield _rotation(context, body, tells) if context.robot.has_table else orientation_step(context, body)
    yield _base_tensor(context, body)


# -- the tensor ------------------------------------------------------------------------------------


def is_moved(body: Body) -> bool:
    """Whether the tensor is given about a point that is not the mass centre."""
    return body.about_point is not None and body.about_point != body.center


def _point(context: Context, body: Body) -> Step:
    tensor = letters.tensor(context.robot, body)
    return Step(
        id=f"I{body.name}",
        stage=STAGE,
        title=f"Inertia of {name_of(body)}",
        why=(
            "A point mass has no extent, so its tensor about its own mass centre is zero and it has no "
            "rotational energy.",
        ),
        source=spong("7.2.1"),
        result=(equation(tensor, letters.bold("0")),),
        said="point mass",
    )


def _tensor(context: Context, body: Body) -> Step:
    tensor = letters.tensor(context.robot, body)
    assert body.inertia is not None
    about = "the mass centre"
    if is_moved(body):
        tensor = Letter("I", Row((letters.index_of(body.name), Words(","), Words("given"))), None, "bold")
        about = f"the origin of frame {body.link}" if body.about == "origin" else "the near end of its link"
    formula, working, why = _shape(context, body)
    said = ""
    if body.density is not None:
        why = (f"The moments of {name_of(body)} were found above; by symmetry there are no others.",)
    elif body.shape is None or not body.shape.formulas:
        axes = f"the axes of frame {body.link}" if _in_frame(context, body) else "its own axes"
        why = (f"The tensor of {name_of(body)} is given, about {about}, along {axes}.",)
        why = _left_out(context, body) or (*why, *_principal(context, body))
        said = f"tensor {_entering(context, body) or _given_as(context, body)}"
    return Step(
        id=f"I_given{body.name}" if is_moved(body) else f"I_body{body.name}",
        stage=STAGE,
        title=f"Inertia tensor of {name_of(body)} in its own frame",
        why=why,
        formula=formula,
        source=spong("7.2.1") if formula is None or body.shape is None else _SOURCES[body.shape.kind],
        working=working,
        result=(equation(tensor, context.show(body.inertia)),),
        said=said,
        uses=(),
    )


def _entering(context: Context, body: Body) -> list[str]:
    """The body's axes about which it turns, where its tensor is 0 for all others; none else."""
    if not context.is_short or is_moved(body) or body.inertia is None:
        return []
    turning = context.values[f"R{body.name}"].T @ context.values[f"Jw{body.name}"]
    still = [i for i in range(3) if all(entry.is_zero for entry in turning.rows[i])]
    if not still or not all(e.is_zero for i in still for e in body.inertia.rows[i]):
        return []
    return [name for i, name in enumerate("xyz") if i not in still]


def _left_out(context: Context, body: Body) -> Prose:
    """What is given of a tensor that is 0 where Rᵀ J_ω has a row of zeros: the body never turns so."""
    turning_axes = _entering(context, body)
    if not turning_axes:
        return ()
    axes = listed([_axis(context, body, name, f"its axis {name}") for name in turning_axes])
    entries, along = "what belongs to ", "has components along these axes alone"
    if len(turning_axes) == 1:
        entries, along = "the moment about ", "is parallel to that axis"
        entries += "the axis parallel to " if isinstance(axes[0], Letter) else ""
        if isinstance(axes[0], Letter) and not _in_frame(context, body):
            axes += (f", the body's {turning_axes[0]}-axis,",)
    return (
        f"Of the tensor of {name_of(body)} about its mass centre {entries}",
        *axes,
        f" is given. The angular velocity {along}, so nothing else enters, and the other entries are "
        "taken as 0.",
    )


def _principal(context: Context, body: Body) -> Prose:
    """That the axes of a given tensor are principal, where its products of inertia are zero."""
    assert body.inertia is not None
    if any(not body.inertia[i, j].is_zero for i in range(3) for j in range(3) if i != j):
        return ()
    told: Prose = (" They are principal axes: there are no products of inertia.",)
    slender = [name for i, name in enumerate("xyz") if body.inertia[i, i].is_zero]
    if len(slender) == 1:
        told += (
            " The moment about ",
            *_axis(context, body, slender[0], f"its {slender[0]}"),
            " is taken as 0: the body is slender.",
        )
    return told


def _given_as(context: Context, body: Body) -> tuple[bool, bool, tuple[bool, ...]]:
    """How a tensor is given: about which point, along which axes, which of its entries are zero."""
    assert body.inertia is not None
    return is_moved(body), _in_frame(context, body), tuple(entry.is_zero for entry in body.inertia.entries)


def _in_frame(context: Context, body: Body) -> bool:
    """Whether the body's axes are known to be those of its link's frame."""
    return context.robot.has_table and has_link_axes(body)


def _axis(context: Context, body: Body, name: str, otherwise: str) -> Prose:
    """An axis of a body: 𝐳₁ of its link's frame, 𝐳₀ where it stays with this, else what it is called."""
    if _in_frame(context, body):
        return (Letter(name, letters.index_of(str(body.link)), style="bold"),)
    if stays_with_base(context.forms, body, "xyz".index(name)):
        return (Letter(name, Number(0), style="bold"),)
    return (otherwise,)


def stays_with_base(forms: Forms, body: Body, place: int) -> bool:
    """Whether an axis of a body is always parallel to that of frame 0 with its name."""
    seen = forms.values[f"R{body.name}"]
    base = seen.identity(seen.ring, 3)
    known = forms.robot.has_table and not letters.has_base(forms.robot)
    return known and all(seen[i, place] == base[i, place] for i in range(3))


def _shape(context: Context, body: Body) -> tuple[Node | None, tuple[Node, ...], Prose]:
    """The formula of a uniform shape, with what its letters are here."""
    shape = body.shape
    if shape is None or not shape.formulas:
        return None, (), ()
    signs: dict[Node, Node] = {Symbol(name): sign for name, sign in shape_letters(context.robot).items()}
    formula = side_by_side([
        equation(
            Letter("I", Row((letters.index_of(body.name), Words(axes)))),
            mapped(moment, lambda part: signs.get(part, part)),
        )
        for axes, moment in shape.formulas
    ])  # fmt: skip
    given = [
        equation(signs[Symbol(letter)], measured(context.show(value), "kg" if letter == MASS else "m"))
        for letter, value in letters_of(body)
    ]
    given = [relation for relation in given if relation.parts[0] != relation.parts[1]]
    why: Prose = (f"{name_of(body).capitalize()} is a uniform {SHAPES[shape.kind]}",)
    if shape.axis:
        why += (
            ", its own axis along ",
            *_axis(context, body, shape.axis, f"{shape.axis} of the body's frame"),
        )
    why += (". Its principal moments about the mass centre:",)
    return formula, (side_by_side(given),) if given else (), why


def _parallel_axis(context: Context, body: Body) -> Step:
    b = body.name
    tensor = letters.tensor(context.robot, body)
    given = Letter("I", Row((letters.index_of(b), Words(","), Words("given"))), None, "bold")
    d = letters.bold("d")
    mass = context.mass(body)
    square = Product((Transpose(d), d, letters.bold("E")))
    shift = Product((mass, Sum((square, Negative(Product((d, Transpose(d))))))))
    H = context.values[f"H{body.link}"]
    relative = inertia.axes_in_link(context.robot, body, H)
    assert body.about_point is not None
    offset = relative.T @ (body.center - body.about_point)
    return Step(
        id=f"I_body{b}",
        stage=STAGE,
        title=f"Parallel axis: the tensor of {name_of(body)} about its mass centre",
        why=(
            "The given tensor is about another point, but the kinetic energy needs the one about the mass "
            "centre. d goes from the given point to the mass centre, in the body's axes; E is the identity.",
        ),
        formula=equation(tensor, Sum((given, Negative(shift)))),
        source="parallel-axis theorem; Craig 6.3",
        working=(
            equation(d, context.show(offset)),
            equation(shift, context.show(inertia.steiner(body.mass, offset))),
        ),
        result=(equation(tensor, context.form(f"I_body{b}")),),
        uses=(),
    )


# -- its orientation -------------------------------------------------------------------------------


def has_link_axes(body: Body) -> bool:
    """Whether the body-attached axes are those of its link's frame, the default."""
    axes = body.axes
    one = algebra.Matrix.identity(axes.rotation.ring, 3)
    return not body.is_point and axes.kind is AxesKind.LINK and axes.rotation == one


def _rotation(context: Context, body: Body, tells: bool) -> Step:
    rotation = letters.of_body("R", body, "bold")
    why, formula, notes = _orientation(context, body)
    is_its_links = has_link_axes(body) and body.name == str(body.link)  # R_2 is that of frame 2
    is_unneeded = _is_kept(context, body) and f"R{body.name}" not in context.wanted
    if tells:
        notes = tuple(_right_frame(context, body.link))
    return Step(
        id=f"R{body.name}",
        stage=STAGE,
        title=f"Orientation of {name_of(body)}",
        why=why,
        formula=None if formula is None else equation(rotation, formula),
        source=GIVEN if body.axes.kind is AxesKind.BASE else f"from {spong('7.2.1')}",
        working=_turned_back(context, body, rotation),
        result=(equation(rotation, context.form(f"R{body.name}")),),
        notes=notes,
        said="axes of the link" if has_link_axes(body) else "",
        uses=(),
        detail=Detail.FULL if is_unneeded or is_its_links else Detail.NORMAL,
    )


def _is_kept(context: Context, body: Body) -> bool:
    """Whether every rotation leaves the tensor of a body as it is."""
    return factor_of_identity(context.values[f"I_body{body.name}"]) is not None


def _orientation(context: Context, body: Body) -> tuple[Prose, Node | None, tuple[Prose, ...]]:
    """Which way the body's axes point: why, R in letters, notes."""
    robot, link = context.robot, body.link
    frame, turned = letters.R(robot, link), context.show(body.axes.rotation)
    match body.axes.kind:
        case AxesKind.LINK if has_link_axes(body):
            why = f"The body's axes are those of frame {link}"
            return (why, Reference((f"H{link}",), " in "), f", which is fixed in link {link}."), frame, ()
        case AxesKind.LINK:
            why = f"The body's axes are turned in frame {link}, as the problem gives them."
            return (why,), Product((frame, turned)), ()
        case AxesKind.REST:
            at_zero = equation(letters.Q, letters.bold("0"))
            turning: Prose = (
                "The body's axes are parallel to frame 0 at ",
                at_zero,
                " and turn with the link: its rotation",
                Reference((f"H{link}",), " in "),
                ", times the inverse, which is the transpose, of that at ",
                at_zero,
                ".",
            )
            at_rest = Row((frame, Parenthesized(letters.bold("0"))))
            base = (letters.R(robot, 0),) if letters.has_base(robot) else ()
            return turning, Product((frame, Transpose(Parenthesized(at_rest)), *base)), ()
        case AxesKind.BASE:
            fixed = not inertia.turns_with_link(robot, body, context.values[f"H{link}"])
            note = ("They may still be used: the kinetic energy is the same as with axes that do.",)
            return why_axes(context, body), product_of_axes(context, body), (note,) if fixed else ()


def _turned_back(context: Context, body: Body, name: Letter) -> tuple[Node, ...]:
    """R R(0)ᵀ with the link's rotation put in, for axes that are those of frame 0 at q = 0."""
    if body.axes.kind is not AxesKind.REST or letters.has_base(context.robot):
        return ()
    turned = context.values[f"H{body.link}"].block(0, 3, 0, 3)
    rest = context.show(turned.map(context.robot.ring.at_rest))
    shown = context.show(turned)
    return (equation(name, Product((shown, Transpose(rest)))),) if is_small(shown, rest) else ()


def _right_frame(context: Context, link: int) -> Iterator[Prose]:
    """The frame that is easily mistaken for the link's: the one at its other end."""
    joints = context.robot.joints
    if context.standard:
        if link > 1 and joints[link - 1].type:
            yield (
                f"Frame {link} is the one to take, not frame {joints[link - 1].parent}, which is not "
                f"fixed in link {link}.",
            )
    elif link < len(joints) and joints[link].type:
        yield (
            f"Frame {link} is the one to take: in the modified convention it is fixed in link {link}, and "
            f"frame {link + 1} moves with the next link.",
        )


def _base_tensor(context: Context, body: Body) -> Step:
    name, R = letters.base_tensor(letters.index_of(body.name)), letters.of_body("R", body, "bold")
    turning, base = turning_of(context, body, R), context.form(f"I{body.name}")
    same = (turning.same,) if turning.same else ()
    detail = _detail(context, body, base)
    leads: Prose = (R, f" leads from the body's axes to those of the {context.ground}.")
    if _is_kept(context, body):
        leads = ()
    if detail is Detail.FULL and leads:
        leads += (
            " Below the energy is worked out along the body's own axes, where the tensor is ",
            letters.tensor(context.robot, body),
            ".",
        )
    elif leads:
        told = f" will be written in {context.ground} coordinates, so the tensor must be, too: "
        leads = (letters.of_body("omega", body, "bold"), told, *leads)
    return Step(
        id=f"I{body.name}",
        stage=STAGE,
        title=f"Inertia tensor of {name_of(body)} in {context.ground} coordinates",
        why=(*leads, *turning.why),
        formula=equation(name, Product((R, letters.tensor(context.robot, body), Transpose(R))), *same),
        source=spong("7.2.1"),
        working=tuple(equation(name, line) for line in turning.lines),
        concluding=turning.concluding,
        result=(equation(name, *same, base),),
        normal=Part.WHY | Part.FORMULA if same else TOLD,
        notes=turning.notes,
        said=f"turned tensor {turning.axis}" if turning.axis else "",
        uses=(f"I_body{body.name}",) if _is_kept(context, body) else None,
        detail=detail,
    )


def _detail(context: Context, body: Body, base: Node) -> Detail:
    """Where the energy is worked out along the body's own axes, 𝓘 is shown only if it is asked for."""
    if along_own_axes(context, body) and f"I{body.name}" not in context.wanted:
        return Detail.FULL
    is_kept = context.values[f"I{body.name}"] == context.values[f"I_body{body.name}"]
    return Detail.BRIEF if is_small(base) and not is_kept else Detail.NORMAL
