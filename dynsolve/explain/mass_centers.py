"""The step of a mass centre: where it is in its link, and seen from the base."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from msgspec import Struct

from dynsolve.algebra import matrix as algebra
from dynsolve.algebra.ring_values import value_of
from dynsolve.document import Prose
from dynsolve.document.books import GEOMETRY, GIVEN, spong
from dynsolve.document.sentences import Value, say
from dynsolve.errors import ReadError
from dynsolve.explain.context import Context
from dynsolve.explain.forms import Forms
from dynsolve.explain.jacobian import told_frames
from dynsolve.explain.matrix_factors import factored
from dynsolve.explain.parameter_meanings import SHAPES
from dynsolve.explain.step import TOLD, Detail, Line, Part, Step
from dynsolve.explain.working.identities import product_named
from dynsolve.explain.working.rotational import factor_of_identity
from dynsolve.explain.writing import block_of, flat, is_small, name_of
from dynsolve.notation.build import number_in_front
from dynsolve.notation.template import formula
from dynsolve.notation.text import read
from dynsolve.notation.tree import (
    ONE,
    ZERO,
    Integral,
    Letter,
    Matrix,
    Node,
    Number,
    Product,
    Row,
    Symbol,
    Transpose,
    Words,
    column,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.robot.model import Body, Convention, Robot
from dynsolve.robot.shapes import Density


def mass_center_step(context: Context, body: Body, tells: bool) -> Step:
    """r_c = R r + o; with `tells` it warns that the mass centre is not the frame's origin."""
    r, way = letters.rc(body), _way(context, body)
    kind, where = _where(context, body)
    ground = ""
    if not any(joint.type for joint in context.robot.path(body.link)):
        kind = ""
        ground = " No joint comes before that link, so the body belongs to the ground and does not move."
    not_the_origin = say(
        "The mass centre is not the origin of frame {i}: the fourth column of {H} is not {r}.",
        i=body.link,
        H=letters.H(context.robot, body.link),
        r=r,
    )
    return Step(
        id=f"rc{body.name}",
        title=f"Mass centre of {name_of(body)}",
        why=say("The mass centre of {body} {where}.{ground}", body=name_of(body), where=where, ground=ground),
        formula=equation(r, way.named),
        source=way.source,
        further=way.given,
        working=(equation(r, way.values),) if way.values else (),
        result=(equation(r, factored(context, context.form(f"rc{body.name}"))),),
        notes=(not_the_origin,) if tells else (),
        detail=Detail.BRIEF,
        normal=TOLD & ~Part.FURTHER if way.values and not body.drawn else TOLD,
        said=f"center {kind}" if kind else "",
        uses=way.uses,
    )


class _Way(Struct, frozen=True):
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
    part, other = part_of_the_way(body), other_end(context.robot, body)
    c = letters.index_of(body.name)
    if other is None:
        own = formula("𝐫_c{c}^{i}", c=c, i=body.link)
        return _from(context, body, body.link, own, body.center)
    if part is not None:
        near, far = ends(context.robot, body)
        values = [_origin(context, end) for end in (near, far)]
        return _Way(
            _between(part, letters.o(near), letters.o(far)),
            _between(part, *values) if is_small(*values) else None,
            uses=("axes",),
            source=GEOMETRY,
        )
    end, back = other
    if (body.center - back).is_zero:
        return _Way(letters.o(end), uses=_told_at(context.robot, end), source=GIVEN)
    lever = letters.bold("r", Row((Number(end), Words(","), Words("c"), c)), Number(body.link))
    return _from(context, body, end, lever, body.center - back)


def _from(context: Context, body: Body, start: int, lever: Node, value: algebra.Matrix) -> _Way:
    """R r + o: the lever r from origin `start`, given along the axes of the link's frame."""
    link, shown = body.link, context.show(value)
    rotation, origin = block_of(context.matrix(f"H{link}"), 3, 0, 3), _origin(context, start)
    is_short = is_small(shown, rotation, origin)
    return _Way(
        formula("{R} {r} + {o}", R=letters.R(context.robot, link), r=lever, o=letters.o(start)),
        formula("{R} {r} + {o}", R=rotation, r=shown, o=origin) if is_short else None,
        (equation(lever, *_seen_in_drawing(context, body), shown),),
        None if start == link else (f"H{link}", "axes"),
    )


def _seen_in_drawing(context: Context, body: Body) -> Iterator[Node]:
    """Rᵀ (r_c - o) in the pose of a drawing: how the centre's place in its frame follows from it."""
    if body.drawn is not None:
        R, r, o = letters.R(context.robot, body.link), letters.rc(body), letters.o(body.link)
        yield formula("{R}ᵀ ({r} - {o})", R=R, r=r, o=o)
        rows = tuple(in_formulas(context.forms, axis) for axis in body.drawn.axes)
        yield Product((Matrix(rows), column(*in_formulas(context.forms, body.drawn.away))))


def in_formulas(forms: Forms, vector: Iterable[Node]) -> tuple[Node, ...]:
    """A vector of trees as it is written in formulas."""
    return tuple(forms.of(value_of(forms.robot.ring, entry)) for entry in vector)


def _origin(context: Context, frame: int) -> Matrix:
    return block_of(context.matrix(f"H{frame}"), 3, 3, 4)


def _told_at(robot: Robot, frame: int) -> tuple[str, ...]:
    """The step that tells the origin of a frame: that of axes and origins, else the frame's own."""
    return ("axes",) if frame in told_frames(robot) else (f"H{frame}",)


def _between(part: Node, near: Node, far: Node) -> Node:
    """The point at that part of the way from one to the other."""
    if part == letters.HALF:
        return formula("½ ({near} + {far})", near=near, far=far)
    return formula("{near} + {part} ({far} - {near})", part=part, near=near, far=far)


_FROM_THE_NEAR_END = (
    "{given} from the near end of link {link}, {near}, along the axes of frame {link}, which is fixed in "
    "the link"
)


def _where(context: Context, body: Body) -> tuple[str, Prose]:
    """How a mass centre is given: the kind of it, and in words."""
    written, part = body.center_written, part_of_the_way(body)
    kind, words = "frame", "is given by its coordinates in frame {link}, which are constant"
    if body.drawn and not body.center.is_zero:
        kind = ""
        words = "is drawn at {point}; its constant coordinates in frame {link} are found in that pose"
    elif body.density is not None and body.density.begins:
        kind, words = "found", _FROM_THE_NEAR_END
    elif written == "tip":
        kind, words = written, "is at the far end of link {link}, {far}"
    elif part == letters.HALF:
        kind, words = "midpoint", "is half-way along link {link}, between {near} and {far}"
    elif body.center.is_zero:
        kind, words = "origin", "is at the origin {own} of frame {link}"
    elif is_given_by(body, "near") and context.standard:
        other = other_end(context.robot, body)
        is_end = other is not None and (body.center - other[1]).is_zero
        kind = "" if is_end else "near"
        words = "is at the near end of link {link}, {near}" if is_end else _FROM_THE_NEAR_END
    elif is_given_by(body, "along"):
        kind, words = "", "is {part} of the way along link {link}, from {near} to {far}"
        if part is None:
            words = "is on link {link}, at the given part of the way from {near} to {far}"
    near, far = map(letters.o, ends(context.robot, body))
    own = letters.o(body.link)
    point = flat(in_formulas(context.forms, body.drawn.at if body.drawn else ()))
    given = "was found by integration," if kind == "found" else "is given"
    of_link: dict[str, Value] = {"link": body.link, "near": near, "far": far, "own": own}
    return kind, say(words, **of_link, part=part or "", given=given, point=point)


class Place(Struct, frozen=True):
    """A point of a link that is no body's mass centre, as far as it is told in the same words."""

    link: int
    center: algebra.Matrix
    center_written: str


def is_given_by(body: Body | Place, key: str) -> bool:
    """Whether the problem gives the centre as `{near: ...}`, `{along: ...}` or `{drawn: ...}`."""
    return re.match(rf"\W*{key}\b", body.center_written) is not None


def part_of_the_way(body: Body | Place) -> Node | None:
    """The part of the way along its link, as the problem writes it; None where it is given otherwise."""
    if body.center_written == "midpoint":
        return letters.HALF
    if not is_given_by(body, "along"):
        return None
    try:
        part = read(re.sub(r"^\W*along\W*:|[{}'\"]", "", body.center_written).strip()).tree
    except ReadError:
        return None
    return letters.HALF if part == Number(1, 2) else part


def ends(robot: Robot, body: Body | Place) -> tuple[int, int]:
    """The frames at the near and at the far end of a body's link."""
    if robot.convention is Convention.STANDARD:
        return robot.joints[body.link - 1].parent, body.link
    return body.link, next(iter(robot.links_after(body.link)), body.link + 1)


def other_end(robot: Robot, body: Body | Place) -> tuple[int, algebra.Matrix] | None:
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
        return (row.parent, back) if is_near or part_of_the_way(body) is not None else None
    onward = algebra.Matrix.column(ring, (row.a, -(row.d * sine), row.d * cosine))
    return (row.index, onward) if part_of_the_way(body) is not None else None


# -- how the tensor of a body along the axes of the base comes about: R I Rᵀ, or why it stays as it is


class Turning(Struct, frozen=True):
    """How R I Rᵀ comes about: its lines, and the identities there; the tensor that it is the `same` as."""

    lines: tuple[Node, ...]
    why: Prose = ()
    concluding: Prose = ()
    same: Letter | None = None


def turning_of(context: Context, body: Body, R: Letter) -> Turning:
    """By the factor of the identity, or by two products of matrices."""
    factor = factor_of_identity(context.values[f"I_body{body.name}"])
    if factor is not None:
        return Turning(
            (formula("{k} {R} {R}ᵀ", k=number_in_front(context.show(factor)), R=R),),
            say(
                "The tensor is a multiple of the identity matrix: whatever {R} is, ${R} {R}ᵀ$ is the "
                "identity matrix, and the rotation keeps the tensor.",
                R=R,
            ),
            same=letters.tensor(context.robot, body),
        )
    b, lines = body.name, tuple(_turned(context, body))
    rotation, given, base = (context.values[name] for name in (f"R{b}", f"I_body{b}", f"I{b}"))
    named = product_named(context, rotation, given @ rotation.T, base) if lines else ()
    return Turning(lines, (), named)


def _turned(context: Context, body: Body) -> Iterator[Node]:
    """R I Rᵀ with their entries, then R (I Rᵀ): one product of matrices from a line to the next."""
    b = body.name
    rotation, given = context.form(f"R{b}"), context.form(f"I_body{b}")
    if not is_small(rotation, rotation, given):
        return
    yield Product((rotation, given, Transpose(rotation)))
    R, tensor, base = (context.values[name] for name in (f"R{b}", f"I_body{b}", f"I{b}"))
    half = tensor @ R.T
    if context.is_short and half not in (tensor, R.T, base):
        shown = context.show(half)
        if is_small(rotation, shown):
            yield Product((rotation, shown))


# -- the step of a body with a density: its mass, centre and moments, by integration along its axis

_MASS_OF_A_DISK = "The {what} has the mass {mass}, its density times its area."
_MASS_OF_SLICES = (
    "The {what} is made of slices dx with the mass ${mass} 'dx'$; $x$ runs{along} from the near end, 0, to "
    "the far one. Each power of $x$ is integrated by itself."
)


def density_step(context: Context, body: Body, density: Density) -> Step:
    """m = ∫ ρ A dx, x_c = ∫ ρ A x dx / m, and the moments, moved to the mass centre by the parallel axes."""
    assert density.shape is not None
    index, m = letters.index_of(body.name), letters.of_body("m", body)
    rho, x = formula("{rho}(x)", rho=Letter("rho")), Symbol("x")
    one, other = density.tilted
    across = (one,) if one.slice == other.slice else density.tilted  # of what is round one, for both
    weight = [rho if density.varies else density.formula]
    weight += [density.measure] if density.measure != ONE else []

    def over(*factors: Node) -> Node:
        """The integral of ρ A times a factor over the body; the product where it has no extent."""
        integrand = Product((*weight, *factors))
        return integrand if density.extent is None else Integral(integrand, x, ZERO, density.extent)

    def moment(about: str, axes: str = "") -> Node:
        """I about the `axis`, or across it about the near end or c; with the axes where these differ."""
        named = (Words(axes), Words(",")) if axes and len(across) > 1 else ()
        return Letter("I", Row((index, Words(","), *named, Words(about))))

    mass = (density.mass,) if density.extent is None else (over(), density.mass)
    lines = [Line(("The mass:",), (equation(m, *mass),))]
    if density.extent is not None:
        first = formula("{m} x_c{i} = {over} = {value}", m=m, i=index, over=over(x), value=density.first)
        center = formula("x_c{i} = {value}", i=index, value=density.center)
        lines.append(Line(("The first moment, and the centre that it gives:",), (first, center)))
    if density.turned.slice != ZERO:
        own = equation(moment("axis"), over(density.turned.slice), density.turned.integral)
        lines.append(Line(("The moment of inertia about its axis:",), (own,)))
    if density.extent is None:
        concluding = "The moment of inertia across it, in its plane:"
        result = [equation(moment("c", of.axes), over(of.slice), of.value) for of in across]
    else:
        concluding, result, near = "About the mass centre, by the parallel-axis theorem:", [], []
        for of in across:
            square = formula("x²") if of.slice == ZERO else formula("x² + {own}", own=of.slice)
            at_end = moment("near", of.axes)
            near.append(equation(at_end, over(square), of.integral))
            moved = formula("{I} - {m} x_c{i}²", I=at_end, m=m, i=index)
            result.append(equation(moment("c", of.axes), moved, of.value))
        lines.append(Line(("The moment of inertia across it, about its near end:",), tuple(near)))
    return Step(
        id=f"density{body.name}",
        title=f"Mass, centre and moments of {name_of(body)} by integration",
        why=say(
            _MASS_OF_A_DISK if density.extent is None else _MASS_OF_SLICES,
            what=SHAPES[density.shape.kind],
            mass=Product(tuple(weight)),
            along=f" along {density.shape.axis} of its frame" if density.shape.axis else "",
        ),
        formula=equation(rho, density.formula) if density.varies else None,
        source=spong("7.2.1"),
        lines=tuple(lines),
        concluding=(concluding,),
        result=tuple(result),
        uses=(),
    )
