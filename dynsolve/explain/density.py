"""The step of a rod whose density varies: its mass, centre and moment, by integration along it."""

from __future__ import annotations

from dynsolve.explain.citations import spong
from dynsolve.explain.context import Context
from dynsolve.explain.step import Line, Step
from dynsolve.explain.writing import name_of
from dynsolve.notation.tree import (
    Integral,
    Letter,
    Negative,
    Node,
    Number,
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
from dynsolve.robot.shapes import LineDensity

_X, _RHO = Symbol("x"), Symbol("rho")


def density_step(context: Context, body: Body, rod: LineDensity) -> Step:
    """m = ∫ ρ dx, x_c = ∫ ρ x dx / m, and the moment about the mass centre by the parallel-axis theorem."""
    m, center = letters.of_body("m", body), Letter("x", Row((Words("c"), letters.index_of(body.name))))
    near, across = _moment(body, "near"), _moment(body, "c")
    return Step(
        id=f"density{body.name}",
        stage=Stage.INERTIA,
        title=f"Mass, centre and moment of {name_of(body)} by integration",
        why=(
            "The rod is made of slices dx with the mass ρ dx; ",
            _X,
            f" runs along {rod.axis} of its frame from the near end, 0, to the far one. Each power of ",
            _X,
            " is integrated by itself.",
        ),
        formula=equation(_RHO, rod.density),
        source=spong("7.2.1"),
        lines=(
            Line(("The mass:",), (equation(m, _over(rod, _RHO), rod.mass),)),
            Line(
                ("The first moment, and the centre that it gives:",),
                (
                    equation(Product((m, center)), _over(rod, Product((_RHO, _X))), rod.first),
                    equation(center, rod.center),
                ),
            ),
            Line(
                ("The moment of inertia across the rod, about its near end:",),
                (equation(near, _over(rod, Product((_RHO, Power(_X, Number(2))))), rod.second),),
            ),
        ),
        concluding=("About the mass centre, by the parallel-axis theorem:",),
        result=(equation(across, Sum((near, Negative(Product((m, Power(center, Number(2))))))), rod.across),),
        uses=(),
    )


def _over(rod: LineDensity, integrand: Node) -> Integral:
    """The integral over the rod."""
    return Integral(integrand, _X, Number(0), rod.length)


def _moment(body: Body, about: str) -> Letter:
    return Letter("I", Row((letters.index_of(body.name), Words(","), Words(about))))
