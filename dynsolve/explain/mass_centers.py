"""The step of a mass centre: where it is in its link, and seen from the base."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from dynsolve.algebra import matrix as algebra
from dynsolve.document import Prose
from dynsolve.errors import ReadError
from dynsolve.explain.context import Context
from dynsolve.explain.jacobian import told_frames
from dynsolve.explain.parameter_meanings import SHAPES
from dynsolve.explain.step import TOLD, WORKED, Detail, Line, Part, Step
from dynsolve.explain.working.identities import product_named
from dynsolve.explain.working.rotational import factor_of_identity
from dynsolve.explain.writing import GEOMETRY, GIVEN, block_of, is_small, name_of, spong
from dynsolve.notation.build import number_in_front
from dynsolve.notation.text import read
from dynsolve.notation.tree import (
    ONE,
    ZERO,
    Integral,
    Letter,
    Matrix,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
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
from dynsolve.robot.model import Body, Convention, Robot
from dynsolve.robot.shapes import Density, SliceMoment

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


# -- how the tensor of a body along the axes of the base comes about: R I Rᵀ, or why it stays as it is


@dataclass(frozen=True, slots=True)
class Turning:
    """How R I Rᵀ comes about: what is said of it, its lines, and the identities that lead to the result.

    `same` is the tensor that it is equal to, where the rotation does not change it, being about its `axis`.
    """

    lines: tuple[Node, ...]
    why: Prose = ()
    concluding: Prose = ()
    notes: tuple[Prose, ...] = ()
    same: Letter | None = None
    axis: str = ""


def turning_of(context: Context, body: Body, R: Letter) -> Turning:
    """By the factor of the identity, by an axis of symmetry, or by two products of matrices."""
    factor, axis = factor_of_identity(context.values[f"I_body{body.name}"]), _axis_of_symmetry(context, body)
    if factor is not None:
        line = Product((number_in_front(context.show(factor)), R, Transpose(R)))
        why: Prose = ("The tensor is a multiple of the identity matrix: whatever ", R, " is, ")
        why += (Product((R, Transpose(R))), " is the identity matrix, and the rotation keeps the tensor.")
        return Turning((line,), why, same=letters.tensor(context.robot, body))
    if axis is not None:
        tensor = context.values[f"I_body{body.name}"]
        alone = sum(not entry.is_zero for entry in tensor.entries) == 1
        kept = f"the moment about {axis} alone enters" if alone else f"the moments across {axis} are equal"
        why = (
            " Here ",
            R,
            f" is a rotation about {axis}, and {kept}, so the tensor stays as it is.",
        )
        return Turning((), why, same=letters.tensor(context.robot, body), axis=axis)
    lines = tuple(_turned(context, body))
    is_kept = context.form(f"I{body.name}") == context.form(f"I_body{body.name}")
    notes: tuple[Prose, ...] = (("This rotation does not change the tensor.",),) if is_kept else ()
    return Turning(lines, (), _turned_named(context, body) if lines else (), notes)


def _axis_of_symmetry(context: Context, body: Body) -> str | None:
    """The axis of the body that R turns about, where the tensor is the same about all axes across it."""
    R, tensor = context.values[f"R{body.name}"], context.values[f"I_body{body.name}"]
    one, unturned = R[0, 0].ring.one, algebra.Matrix.identity(R[0, 0].ring, 3)
    if R @ tensor @ R.T != tensor or unturned == R:
        return None
    return next((name for k, name in enumerate("xyz") if R[k, k] == one), None)


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


def _turned_named(context: Context, body: Body) -> Prose:
    """The identities by which R (I Rᵀ) becomes what is printed."""
    R, given, base = (context.values[f"{letter}{body.name}"] for letter in ("R", "I_body", "I"))
    return product_named(context, R, given @ R.T, base)


# -- the step of a body with a density: its mass, centre and moments, by integration along its axis

_X = Symbol("x")
_RHO = Row((Letter("rho"), Parenthesized(_X)))


def density_step(context: Context, body: Body, density: Density) -> Step:
    """m = ∫ ρ A dx, x_c = ∫ ρ A x dx / m, and the moments, moved to the mass centre by the parallel axes."""
    m, center = letters.of_body("m", body), Letter("x", Row((Words("c"), letters.index_of(body.name))))
    square = Product((m, Power(center, Number(2))))
    across = [
        (
            equation(_moment(body, "near", of), _over(density, _squared(of)), of.integral),
            equation(_moment(body, "c", of), Sum((_moment(body, "near", of), Negative(square))), of.value),
        )
        for of in _across(density)
    ]
    mass = (_over(density), density.mass) if density.extent is not None else (density.mass,)
    lines = [Line(("The mass:",), (equation(m, *mass),))]
    if density.extent is not None:
        first = equation(Product((m, center)), _over(density, _X), density.first)
        told: Prose = ("The first moment, and the centre that it gives:",)
        lines.append(Line(told, (first, equation(center, density.center))))
    if density.turned.slice != ZERO:
        own = equation(
            _moment(body, "axis", None), _over(density, density.turned.slice), density.turned.integral
        )
        lines.append(Line(("The moment of inertia about its axis:",), (own,)))
    if density.extent is not None:
        told = ("The moment of inertia across it, about its near end:",)
        lines.append(Line(told, tuple(near for near, _ in across)))
        concluding: Prose = ("About the mass centre, by the parallel-axis theorem:",)
        result = tuple(centred for _, centred in across)
    else:
        concluding = ("The moment of inertia across it, in its plane:",)
        result = tuple(
            equation(_moment(body, "c", of), _over(density, of.slice), of.value) for of in _across(density)
        )
    return Step(
        id=f"density{body.name}",
        stage=Stage.INERTIA,
        title=f"Mass, centre and moments of {name_of(body)} by integration",
        why=_why(density),
        formula=equation(_RHO, density.formula) if density.varies else None,
        source=spong("7.2.1"),
        lines=tuple(lines),
        concluding=concluding,
        result=result,
        uses=(),
    )


def _why(density: Density) -> Prose:
    assert density.shape is not None
    what, axis = SHAPES[density.shape.kind], density.shape.axis
    mass = Product((_rho(density), *_measure(density)))
    if density.extent is None:
        return (f"The {what} has the mass ", mass, ", its density times its area.")
    along = f" runs along {axis} of its frame" if axis else " runs"
    return (
        f"The {what} is made of slices dx with the mass ",
        Product((mass, Words("dx"))),
        "; ",
        _X,
        f"{along} from the near end, 0, to the far one. Each power of ",
        _X,
        " is integrated by itself.",
    )


def _rho(density: Density) -> Node:
    return _RHO if density.varies else density.formula


def _measure(density: Density) -> Iterator[Node]:
    if density.measure != ONE:
        yield density.measure


def _across(density: Density) -> tuple[SliceMoment, ...]:
    """The moments across the axis; of what is round one, for both."""
    one, other = density.tilted
    return (one,) if one.slice == other.slice else density.tilted


def _squared(of: SliceMoment) -> Node:
    """x² and what a slice has about its own centre."""
    square = Power(_X, Number(2))
    return square if of.slice == ZERO else Sum((square, of.slice))


def _over(density: Density, factor: Node = ONE) -> Node:
    """The integral of ρ A times a factor over the body; the product where it has no extent."""
    integrand = Product((_rho(density), *_measure(density), *((factor,) if factor != ONE else ())))
    if density.extent is None:
        return integrand
    return Integral(integrand, _X, Number(0), density.extent)


def _moment(body: Body, about: str, of: SliceMoment | None) -> Letter:
    """I about the `axis`, or across it about the near end or c; with the axes where these differ."""
    density = body.density
    assert density is not None
    axes = (Words(of.axes), Words(",")) if of is not None and len(_across(density)) > 1 else ()
    return Letter("I", Row((letters.index_of(body.name), Words(","), *axes, Words(about))))
