"""A rod whose density varies along it: mass, centre and moments by integration, as cells of the file.

With M_k = ∫ ρ x^k dx from the near end, x = 0, to the length l, the mass is M_0, the centre lies at
M_1 / M_0, and the moment across the rod about it is M_2 - M_1²/M_0.  The density is a polynomial in x.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from dynsolve.algebra.build import build_ring
from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.fraction import RationalExpr, cancelled
from dynsolve.algebra.ring import Ring
from dynsolve.algebra.ring_values import value_of
from dynsolve.errors import AlgebraError
from dynsolve.notation.build import times
from dynsolve.notation.tree import Function, Node, Symbol
from dynsolve.notation.walk import names_in, walk
from dynsolve.problem.cells import Cell
from dynsolve.problem.source import Faults
from dynsolve.robot.shapes import AXES, LineDensity

ALONG = "x"
"""The name of the place along the rod, from its near end."""

MAX_DEGREE = 8


def line_density(faults: Faults, density: Cell, length: Cell, axis: str) -> LineDensity | None:
    """The integrals of a density over the rod, as formulas.

    None (reported) for a density that is no polynomial in x.
    """
    if ALONG in names_in(length.tree):
        message = f"{length.what}: {ALONG} is the place along the rod here"
        faults.error(length.span, message, "give the length another name")
        return None
    try:
        ring = build_ring([], [density.tree, length.tree, Symbol(ALONG)])
        powers = None if _is_applied(density.tree) else _powers(ring, value_of(ring, density.tree))
        if powers is None or max(powers, default=0) > MAX_DEGREE:
            help = f"write a sum of powers of {ALONG} up to {MAX_DEGREE}: rho0*(1 + {ALONG}/l)"
            faults.error(density.span, f"the density is no polynomial in {ALONG}", help)
            return None
        moments = [_integral(ring, powers, value_of(ring, length.tree), k) for k in range(3)]
    except AlgebraError as error:
        faults.error(density.span, f"{density.what}: {error.message}", error.help)
        return None
    if moments[0].is_zero:
        faults.error(density.span, "the mass that comes of this density is 0", "check its signs")
        return None
    return _formulas(Compactor(ring), density.tree, length.tree, moments, axis)


def _is_applied(tree: Node) -> bool:
    """Whether x stands in the argument of a function."""
    return any(isinstance(part, Function) and ALONG in names_in(part) for part in walk(tree))


def _powers(ring: Ring, density: Expr) -> dict[int, Expr] | None:
    """The coefficients of the powers of x; None where x stands elsewhere than in such powers."""
    place = ring.symbol_indices[(ALONG, 0)]
    if any(inverted.degrees()[place] > 0 for inverted in ring.inverses.values()):
        return None
    found: dict[int, Expr] = {}
    for exponents, value in density.poly.to_dict().items():
        power = int(exponents[place])
        rest = (*exponents[:place], 0, *exponents[place + 1 :])
        term = Expr(ring, ring.ctx.from_dict({rest: value}))
        found[power] = found.get(power, ring.zero) + term
    return found


def _integral(ring: Ring, powers: dict[int, Expr], length: Expr, k: int) -> Expr:
    """M_k = Σ c_j l^(j+k+1)/(j+k+1)"""
    terms = (c * length ** (j + k + 1) * Fraction(1, j + k + 1) for j, c in powers.items())
    return sum(terms, start=ring.zero)


def _formulas(
    compactor: Compactor, density: Node, length: Node, moments: list[Expr], axis: str
) -> LineDensity:
    mass, first, second = moments
    center = cancelled(RationalExpr(first, mass))
    across = cancelled(RationalExpr(second * mass - first * first, mass))

    def form(value: RationalExpr) -> Node:
        above = compactor.form(value.numerator)
        return (
            above
            if value.divisor is None
            else times(Fraction(1), [(above, 1), (compactor.form(value.divisor), -1)])
        )

    mass_form, first_form, second_form = (compactor.form(moment) for moment in moments)
    return LineDensity(
        density, length, axis or AXES[0], mass_form, first_form, second_form, form(center), form(across)
    )


def cell_of(beside: Cell, what: str, tree: Node) -> Cell:
    """A cell for what follows from the density, which stands where that does."""
    names = tuple(name for name in beside.names if name.name != ALONG)
    return replace(beside, what=what, tree=tree, names=names)
