"""Steps of the bodies: inertia tensor, its orientation, and the tensor in the base frame.

The first step of a body, its mass centre, is in `mass_centers`, how R I Rᵀ comes about in `turned_tensors`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations_with_replacement

from msgspec.structs import replace

from dynsolve.algebra import matrix as algebra
from dynsolve.algebra.linear_systems import is_diagonal
from dynsolve.derivation import link_frame
from dynsolve.document import Prose, Reference
from dynsolve.document.books import GIVEN, LYNCH_PARK, spong
from dynsolve.document.sentences import opened, say
from dynsolve.explain.context import Context
from dynsolve.explain.forms import Forms
from dynsolve.explain.kinematics import product_of_axes, why_axes
from dynsolve.explain.mass_centers import density_step, mass_center_step, turning_of
from dynsolve.explain.matrix_factors import factored
from dynsolve.explain.parameter_meanings import SHAPES, letters_of, shape_letters
from dynsolve.explain.placed_bodies import center_step, orientation_step
from dynsolve.explain.step import TOLD, Detail, Group, Part, Step
from dynsolve.explain.working.rotational import along_own_axes, factor_of_identity, turning_axes
from dynsolve.explain.writing import is_small, listed, measured, name_of, side_by_side
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    ZERO,
    Entry,
    Letter,
    Node,
    Parenthesized,
    Product,
    Row,
    Symbol,
    Transpose,
    Words,
    equation,
    mapped,
)
from dynsolve.quantities import letters
from dynsolve.robot.model import AxesKind, Body
from dynsolve.robot.shapes import MASS, Shape

_SOURCES = {
    "box": spong("7.2.1"),
    "cylinder": LYNCH_PARK.section("8.2.1"),
    "sphere": f"from {LYNCH_PARK.section('8.2.1')}",  # which has the ellipsoid
    **dict.fromkeys(("hollow_cylinder", "rod", "disk", "shell"), f"by the integrals of {spong('7.2.1')}"),
}
"""Where the moments of a shape stand."""


def steps(context: Context) -> Iterator[Step]:
    """Of each body: r_c, and unless it is a point, I, R and I in the base frame."""
    bodies, has_table = context.robot.bodies, context.robot.has_table
    off_origin = next((body for body in bodies if not body.center.is_zero), None)
    framed = next((body for body in bodies if has_link_axes(body) and _right_frame(context, body.link)), None)
    for body in bodies:
        if body.density is not None:
            yield density_step(context, body, body.density)
    for body in bodies:
        center = (
            mass_center_step(context, body, body is off_origin) if has_table else center_step(context, body)
        )
        yield replace(center, group=Group("rc", "The mass centres"))
    for body in bodies:
        for step in _of_extent(context, body, body is framed):
            yield replace(step, group=Group("I", "The inertia tensors"))


def _of_extent(context: Context, body: Body, tells: bool) -> Iterator[Step]:
    """The inertia tensor of a body, along its axes and those of the base."""
    if body.is_point:
        yield Step(
            id=f"I{body.name}",
            title=f"Inertia of {name_of(body)}",
            why=(
                "A point mass has no extent, so its tensor about its own mass centre is zero and it has no "
                "rotational energy.",
            ),
            source=spong("7.2.1"),
            result=(equation(letters.tensor(context.robot, body), letters.bold("0")),),
            said="point mass",
        )
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


def _tensor(context: Context, body: Body) -> Step:
    tensor: Node = letters.tensor(context.robot, body)
    about = "the mass centre"
    assert body.inertia is not None
    if is_moved(body):
        tensor = formula("𝐈_({i},'given')", i=letters.index_of(body.name))
        about = f"the origin of frame {body.link}" if body.about == "origin" else "the near end of its link"
    moments, working, why, said = _shape(context, body) or _given(context, body, about)
    if body.density is not None:
        why = (f"The moments of {name_of(body)} were found above; by symmetry there are no others.",)
        said = ""
    if letters.tensor(context.robot, body).sup is not None:
        why = (*why, " The superscript b is for the body's own axes.")
    return Step(
        id=f"I_given{body.name}" if is_moved(body) else f"I_body{body.name}",
        title=f"Inertia tensor of {name_of(body)} in its own frame",
        why=why,
        formula=moments,
        task=_principal_moments(body, body.shape, shape_letters(context.robot))
        if moments and body.shape
        else None,
        source=spong("7.2.1") if moments is None or body.shape is None else _SOURCES[body.shape.kind],
        working=working,
        result=_entries(context, body, tensor)
        or (equation(tensor, factored(context, context.show(body.inertia))),),
        said=said,
        uses=(),
    )


def _entries(context: Context, body: Body, tensor: Node) -> tuple[Node, ...]:
    """The entries of a tensor that is given in part; none of others."""
    assert body.inertia is not None
    axes = axes_given(context, body)
    places = [("xyz".index(a), "xyz".index(b)) for a, b in combinations_with_replacement(axes, 2)]
    return tuple(
        equation(Entry(tensor, Words("xyz"[i] + "xyz"[j])), context.show(body.inertia[i, j]))
        for i, j in places
        if not body.inertia[i, j].is_zero
    )


_Told = tuple[Node | None, tuple[Node, ...], Prose, str]
"""The formula of a tensor, what its letters are, the sentence about it, and what that tells."""


def _given(context: Context, body: Body, about: str) -> _Told:
    assert body.inertia is not None
    if entering := axes_given(context, body):
        return None, (), _left_out(context, body, entering, about), f"tensor {entering, about}"
    zero = tuple(entry.is_zero for entry in body.inertia.entries)
    if context.values[f"Jw{body.name}"].is_zero:
        rest = "" if all(map(any, _filled(body.inertia))) else ": what is not given is taken as 0"
        told = f"{opened(name_of(body))} does not turn, so its tensor does not enter{rest}."
        return None, (), (told,), f"still tensor {zero}"
    why = say(
        "The tensor of {name} is given, about {about}, along {axes}.{principal}",
        name=name_of(body),
        about=about,
        axes=f"the axes of frame {body.link}" if _in_frame(context, body) else "its own axes",
        principal=_principal(context, body, body.inertia),
    )
    return None, (), why, f"tensor {is_moved(body), _in_frame(context, body), zero}"


def axes_given(context: Context, body: Body) -> list[str]:
    """The body's axes about which it turns, where its tensor is 0 for all others; none else."""
    if body.inertia is None or body.shape is not None or body.density is not None:
        return []
    if all(any(row) for row in _filled(body.inertia)):
        return []
    turning = turning_axes(context, body)
    still = [i for i in range(3) if i not in turning]
    if not still or not all(e.is_zero for i in still for e in body.inertia.rows[i]):
        return []
    if any(body.inertia[i, i].is_zero for i in turning):  # a moment that is not given
        return []
    found = ["xyz"[i] for i in turning]
    return [] if is_moved(body) and len(found) > 1 else found  # its products would have to be brought there


def _filled(tensor: algebra.Matrix) -> list[list[bool]]:
    """Which entries are not 0."""
    return [[not entry.is_zero for entry in row] for row in tensor.rows]


def _left_out(context: Context, body: Body, entering: list[str], about: str) -> Prose:
    """What is given of a tensor that is 0 where Rᵀ J_ω has a row of zeros: the body never turns so."""
    shown = [axis_named(context, body, name, f"its axis {name}") for name in entering]
    entries, along, otherwise = "what belongs to ", "has components along these axes alone", ""
    if len(entering) == 1:
        entries, along = "the moment about ", "is parallel to that axis"
        if isinstance(shown[0][0], Letter):
            entries += "the axis parallel to "
            otherwise = "" if _in_frame(context, body) else f", the body's {entering[0]}-axis,"
    return say(
        "Of the tensor of {name} about {about} {entries}{axes}{otherwise} is given. The angular velocity "
        "{along}, so nothing else enters the energy, and the other entries are taken as 0.",
        name=name_of(body),
        about="its mass centre" if about == "the mass centre" else about,
        entries=entries,
        axes=listed(shown),
        otherwise=otherwise,
        along=along,
    )


def _principal(context: Context, body: Body, tensor: algebra.Matrix) -> Prose:
    """That the axes of a given tensor are principal, where its products of inertia are zero."""
    if not is_diagonal(tensor):
        return ()
    told: Prose = (" They are principal axes: there are no products of inertia.",)
    absent = [
        axis_named(context, body, name, f"its {name}") for i, name in enumerate("xyz") if tensor[i, i].is_zero
    ]
    if absent:
        moments = "moments about {axes} are" if len(absent) > 1 else "moment about {axes} is"
        told += say(f" The {moments} taken as 0.", axes=listed(absent))
    return told


def _in_frame(context: Context, body: Body) -> bool:
    """Whether the body's axes are known to be those of its link's frame."""
    return context.robot.has_table and has_link_axes(body)


def axis_named(context: Context, body: Body, name: str, otherwise: str) -> Prose:
    """An axis of a body: 𝐳₁ of its link's frame, 𝐳₀ where it stays with this, else what it is called."""
    if _in_frame(context, body):
        return (Letter(name, letters.index_of(str(body.link)), style="bold"),)
    if stays_with_base(context.forms, body, "xyz".index(name)):
        return (Letter(name, ZERO, style="bold"),)
    return (otherwise,)


def stays_with_base(forms: Forms, body: Body, place: int) -> bool:
    """Whether an axis of a body is always parallel to that of frame 0 with its name."""
    seen = forms.values[f"R{body.name}"]
    base = seen.identity(seen.ring, 3)
    known = forms.robot.has_table and not letters.has_base(forms.robot)
    return known and all(seen[i, place] == base[i, place] for i in range(3))


def _shape(context: Context, body: Body) -> _Told | None:
    """The formula of a uniform shape: in this body's letters, or with what its own are; None of others."""
    shape = body.shape
    if shape is None or not shape.formulas:
        return None
    values = {letter: context.show(value) for letter, value in letters_of(body)}
    given: list[Node] = []
    if all(isinstance(value, Symbol) for value in values.values()):
        moments = _principal_moments(body, shape, values)
    else:
        signs = shape_letters(context.robot)
        moments = _principal_moments(body, shape, signs)
        measures = (
            (signs[letter], value, "kg" if letter == MASS else "m") for letter, value in values.items()
        )
        given = [equation(sign, measured(value, unit)) for sign, value, unit in measures if sign != value]
    axis: Prose = ()
    if shape.axis:
        along = axis_named(context, body, shape.axis, f"{shape.axis} of the body's frame")
        axis = say(", its own axis along {along}", along=along)
    why = say(
        "{body} is a uniform {shape}{axis}. Its principal moments about the mass centre:",
        body=opened(name_of(body)),
        shape=SHAPES[shape.kind],
        axis=axis,
    )
    return moments, (side_by_side(given),) if given else (), why, ""


def _principal_moments(body: Body, shape: Shape, letter: Mapping[str, Node]) -> Node:
    """I_xx, I_yy and I_zz of a uniform shape, its mass and dimensions as these letters."""
    signs: dict[Node, Node] = {Symbol(name): sign for name, sign in letter.items()}
    alike: dict[Node, list[Node]] = {}
    for axes, moment in shape.formulas:
        name = formula("I_{i}{axes}", i=letters.index_of(body.name), axes=axes)
        alike.setdefault(mapped(moment, lambda part: signs.get(part, part)), []).append(name)
    return side_by_side([equation(*names, moment) for moment, names in alike.items()])


def _parallel_axis(context: Context, body: Body) -> Step:
    """The tensor brought to the mass centre, or of one that enters by an axis alone the moment about that."""
    b, axes = body.name, axes_given(context, body)
    relative = link_frame.axes_in_link(context.robot, body, context.values[f"H{body.link}"])
    assert body.about_point is not None
    offset = relative.T @ (body.center - body.about_point)

    def entering(node: Node) -> Node:
        return Entry(node, Words(axes[0] * 2)) if axes else node

    tensor = entering(letters.tensor(context.robot, body))
    shift = Product((context.forms.mass(body), entering(formula("𝐝ᵀ 𝐝 𝐄 - 𝐝 𝐝ᵀ"))))
    value: Node = context.form(f"I_body{b}")
    working: tuple[Node, ...] = (formula("𝐝 = {d}", d=factored(context, context.show(offset))),)
    if axes:
        place = "xyz".index(axes[0])
        value = context.matrix(f"I_body{b}").rows[place][place]
    else:
        steiner = context.show(link_frame.steiner(body.mass, offset))
        working, value = (*working, equation(shift, factored(context, steiner))), factored(context, value)
    return Step(
        id=f"I_body{b}",
        title=f"Parallel axis: the {'moment' if axes else 'tensor'} of {name_of(body)} about its mass centre",
        why=say(
            "The kinetic energy needs the {what} the mass centre. $𝐝$ goes from the given point to the mass "
            "centre, in the body's axes; $𝐄$ is the identity.",
            what="moment about the parallel axis through" if axes else "tensor about",
        ),
        formula=formula(
            "{I} = {given} - {shift}",
            I=tensor,
            given=entering(formula("𝐈_({i},'given')", i=letters.index_of(b))),
            shift=shift,
        ),
        source="parallel-axis theorem; Craig 6.3",
        working=working,
        result=(equation(tensor, value),),
        said=f"parallel axis {len(axes)}",
        uses=(),
    )


# -- its orientation -------------------------------------------------------------------------------


def has_link_axes(body: Body) -> bool:
    """Whether the body-attached axes are those of its link's frame, the default."""
    axes = body.axes
    one = algebra.Matrix.identity(axes.rotation.ring, 3)
    return not body.is_point and axes.kind is AxesKind.LINK and axes.rotation == one


def is_its_links(body: Body) -> bool:
    """Whether R_2 is that of frame 2, and not told in a step of its own."""
    return has_link_axes(body) and body.name == str(body.link)


def orientation_named(context: Context, body: Body) -> Node:
    """R_2 where it has been told what it is, else R_2 = R_2^0."""
    R = letters.of_body("R", body, "bold")
    return equation(R, letters.R(context.robot, body.link)) if is_its_links(body) else R


def lies_as_drawn(body: Body) -> bool:
    """Whether the body-attached axes are those of the world in the pose of a drawing."""
    return body.axes.kind is AxesKind.LINK and body.axes.written == "base"


def _rotation(context: Context, body: Body, tells: bool) -> Step:
    R = letters.of_body("R", body, "bold")
    why, product, notes = _orientation(context, body)
    is_known = has_link_axes(body) or bool(axes_given(context, body))
    is_unneeded = _is_kept(context, body) or (is_known and len(turning_axes(context, body)) < 2)
    is_unneeded &= f"R{body.name}" not in context.wanted
    return Step(
        id=f"R{body.name}",
        title=f"Orientation of {name_of(body)}",
        why=why,
        formula=None if product is None else equation(R, product),
        source=GIVEN if body.axes.kind is AxesKind.BASE else f"from {spong('7.2.1')}",
        working=_turned_back(context, body, R),
        result=(equation(R, context.form(f"R{body.name}")),),
        notes=_right_frame(context, body.link) if tells else notes,
        said="axes of the link" if has_link_axes(body) else "",
        uses=(),
        detail=Detail.FULL if is_unneeded or is_its_links(body) else Detail.NORMAL,
    )


def _is_kept(context: Context, body: Body) -> bool:
    """Whether every rotation leaves the tensor of a body as it is."""
    return factor_of_identity(context.values[f"I_body{body.name}"]) is not None


def _orientation(context: Context, body: Body) -> tuple[Prose, Node | None, tuple[Prose, ...]]:
    """Which way the body's axes point: why, R in letters, notes."""
    robot, link = context.robot, body.link
    frame, turned = letters.R(robot, link), Reference((f"H{link}",), " in ")
    match body.axes.kind:
        case AxesKind.LINK if has_link_axes(body):
            why = "The body's axes are those of frame {link}{turned}, which is fixed in link {link}."
            return say(why, link=link, turned=turned), frame, ()
        case AxesKind.LINK:
            why = f"The body's axes are turned in frame {link}, as the problem gives them."
            if lies_as_drawn(body):
                why = f"The body's axes are those of the world as drawn, and fixed in frame {link}."
            return (why,), Product((frame, context.show(body.axes.rotation))), ()
        case AxesKind.REST:
            turning = say(
                "The body's axes are parallel to frame 0 at $𝐪 = 𝟎$ and turn with the link: its rotation"
                "{turned}, times the inverse, which is the transpose, of that at $𝐪 = 𝟎$.",
                turned=turned,
            )
            at_rest = Row((frame, Parenthesized(letters.bold("0"))))
            base = (letters.R(robot, 0),) if letters.has_base(robot) else ()
            return turning, Product((frame, Transpose(Parenthesized(at_rest)), *base)), ()
        case AxesKind.BASE:
            fixed = not link_frame.turns_with_link(robot, body, context.values[f"H{link}"])
            note = ("They may still be used: the kinetic energy is the same as with axes that do.",)
            return why_axes(context, body), product_of_axes(context, body), (note,) if fixed else ()


def _turned_back(context: Context, body: Body, name: Letter) -> tuple[Node, ...]:
    """R R(0)ᵀ with the link's rotation put in, for axes that are those of frame 0 at q = 0."""
    if body.axes.kind is not AxesKind.REST or letters.has_base(context.robot):
        return ()
    turned = context.values[f"H{body.link}"].block(0, 3, 0, 3)
    shown, rest = context.show(turned), context.show(turned.map(context.robot.ring.at_rest))
    return (equation(name, Product((shown, Transpose(rest)))),) if is_small(shown, rest) else ()


def _right_frame(context: Context, link: int) -> tuple[Prose, ...]:
    """The frame that is easily mistaken for the link's: the one at its other end."""
    joints = context.robot.joints
    take = f"Frame {link} is the one to take"
    if context.standard and link > 1 and joints[link - 1].type:
        other = joints[link - 1].parent
        return ((f"{take}, not frame {other}, which is not fixed in link {link}.",),)
    if not context.standard and link < len(joints) and joints[link].type:
        fixed = f"in the modified convention it is fixed in link {link}"
        return ((f"{take}: {fixed}, and frame {link + 1} moves with the next link.",),)
    return ()


def _base_tensor(context: Context, body: Body) -> Step:
    b, tensor, R = body.name, letters.tensor(context.robot, body), letters.of_body("R", body, "bold")
    name, base = letters.base_tensor(letters.index_of(b)), context.form(f"I{b}")
    is_kept, turning = _is_kept(context, body), turning_of(context, body, R)
    same, detail = (turning.same,) if turning.same else (), _detail(context, body, base)
    why = "{w} will be written in {ground} coordinates, so the tensor must be, too: {leads}{turning}"
    if is_kept:
        why = "{turning}"
    elif len(turning_axes(context, body)) < 2:
        why = "{leads}{turning}"
    elif detail is Detail.FULL:
        below = "Below the energy is worked out along the body's own axes, where the tensor is {I}."
        why = f"{{leads}} {below}{{turning}}"
    return Step(
        id=f"I{b}",
        title=f"Inertia tensor of {name_of(body)} in {context.ground} coordinates",
        why=say(
            why,
            w=letters.of_body("omega", body, "bold"),
            ground=context.ground,
            leads=say(
                "{R} leads from the body's axes to those of the {ground}.",
                R=orientation_named(context, body),
                ground=context.ground,
            ),
            I=tensor,
            turning=turning.why,
        ),
        formula=equation(name, Product((R, tensor, Transpose(R))), *same),
        source=spong("7.2.1"),
        working=tuple(equation(name, factored(context, line)) for line in turning.lines),
        concluding=turning.concluding,
        result=(equation(name, *same, factored(context, base)),),
        normal=Part.WHY | Part.FORMULA if same else TOLD,
        uses=(f"I_body{b}",) if is_kept else None,
        detail=detail,
    )


def _detail(context: Context, body: Body, base: Node) -> Detail:
    """𝓘 is shown only if asked for, where the energy needs the moments about axes of the body alone."""
    is_needed = len(turning_axes(context, body)) > 1 and not along_own_axes(context, body)
    if not is_needed and f"I{body.name}" not in context.wanted:
        return Detail.FULL
    is_unturned = context.values[f"I{body.name}"] == context.values[f"I_body{body.name}"]
    return Detail.BRIEF if is_small(base) and not is_unturned else Detail.NORMAL
