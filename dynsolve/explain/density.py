"""The step of a body with a density: its mass, centre and moments, by integration along its axis."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.document import Prose
from dynsolve.explain.citations import spong
from dynsolve.explain.context import Context
from dynsolve.explain.shapes import SHAPES
from dynsolve.explain.step import Line, Step
from dynsolve.explain.writing import name_of
from dynsolve.notation.tree import (
    ONE,
    ZERO,
    Integral,
    Letter,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Row,
    Sum,
    Symbol,
    Words,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Body
from dynsolve.robot.shapes import Density, SliceMoment

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
