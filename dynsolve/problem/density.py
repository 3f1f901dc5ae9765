"""A shape with a density, which may vary along it: mass, centre and moments by integration, as cells.

With M_k = ∫ ρ A x^k dx over the slices of the shape, from its near end, x = 0, to the far one, the mass
is M_0, the centre lies at M_1/M_0, and a moment across the axis about it is that about the near end
less M_1²/M_0.  The density is a polynomial in x, and so is all that is integrated.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from msgspec.structs import replace

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.fraction import RationalExpr, cancelled
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import build_ring, value_of
from dynsolve.errors import AlgebraError
from dynsolve.notation.build import times
from dynsolve.notation.text import read
from dynsolve.notation.tree import Function, Node, Symbol, mapped, names_in, walk
from dynsolve.problem.cells import Cell
from dynsolve.problem.yaml_nodes import Faults
from dynsolve.robot.shapes import AXES, KINDS, Density, ShapeKind, SliceMoment

ALONG = "x"
"""The name of the place along the axis, from the near end of the shape."""

MAX_DEGREE = 8


def density_of(
    faults: Faults, density: Cell, shape: str, dimensions: Mapping[str, Cell], axis: str, *, begins: bool
) -> Density | None:
    """The integrals of a density over a shape, as formulas; `begins` where its centre is not given.

    None (reported) for a density that is no polynomial in x, or where there is no x that it could vary along.
    """
    kind = KINDS[shape]
    assert kind.slices is not None
    varies = ALONG in names_in(density.tree)
    for cell in dimensions.values():
        if ALONG in names_in(cell.tree):
            message = f"{cell.what}: {ALONG} is the place along the {shape} here"
            faults.error(cell.span, message, "give the length another name")
            return None
    if varies and not kind.slices.extent:
        message = f"a {shape} has no extent along its axis, so that its density is constant"
        faults.error(density.span, message, "write its mass per area: density: rho0")
        return None
    if not (kind.is_round or axis) and (varies or begins):
        message = f"the {shape} has {density.what}, and no axis that {ALONG} runs along"
        faults.error(density.span, message, "write the axis among its dimensions: axis: x")
        return None
    texts = (kind.slices.extent or "0", kind.slices.measure, kind.slices.turned, *kind.slices.tilted)
    sizes = _sizes(kind, dimensions, axis or AXES[-1])
    trees = [mapped(read(text).tree, lambda part: sizes.get(part, part)) for text in texts]
    try:
        ring = build_ring([], [density.tree, *trees, Symbol(ALONG)])
        powers = None if _is_applied(density.tree) else _powers(ring, value_of(ring, density.tree))
        if powers is None or max(powers, default=0) > MAX_DEGREE:
            help = f"write a sum of powers of {ALONG} up to {MAX_DEGREE}: rho0*(1 + {ALONG}/l)"
            faults.error(density.span, f"the density is no polynomial in {ALONG}", help)
            return None
        if not powers:
            faults.error(density.span, "the mass that comes of this density is 0", "check its signs")
            return None
        return _integrated(ring, axis or AXES[-1], density.tree, trees, varies=varies, begins=begins)
    except AlgebraError as error:
        faults.error(density.span, f"{density.what}: {error.message}", error.help)
        return None


def _sizes(kind: ShapeKind, dimensions: Mapping[str, Cell], axis: str) -> dict[Node, Node]:
    """What the letters of the formulas are; those of a box are turned with its axis."""
    turn = AXES.index(axis) - AXES.index("z")
    sizes: dict[Node, Node] = {}
    for key, letter in kind.dimensions:
        own = AXES[(AXES.index(key) + turn) % 3] if key in AXES else key
        sizes[Symbol(letter)] = dimensions[own].tree
    return sizes


def _is_applied(tree: Node) -> bool:
    """Whether x stands in the argument of a function."""
    return any(isinstance(part, Function) and ALONG in names_in(part) for part in walk(tree))


def _powers(ring: Ring, value: Expr) -> dict[int, Expr] | None:
    """The coefficients of the powers of x; None where x stands elsewhere than in such powers."""
    place = ring.symbol_indices[(ALONG, 0)]
    if any(inverted.degrees()[place] > 0 for inverted in ring.inverses.values()):
        return None
    found: dict[int, Expr] = {}
    for exponents, coefficient in value.poly.to_dict().items():
        power = int(exponents[place])
        rest = (*exponents[:place], 0, *exponents[place + 1 :])
        term = Expr(ring, ring.ctx.from_dict({rest: coefficient}))
        found[power] = found.get(power, ring.zero) + term
    return found


def _integrated(
    ring: Ring, axis: str, formula: Node, trees: list[Node], *, varies: bool, begins: bool
) -> Density:
    """All that follows from a density; `trees` are the extent and what `Slices` has of a slice."""
    density = value_of(ring, formula)
    extent, measure, turned, *tilted = (value_of(ring, tree) for tree in trees)
    compactor, x = Compactor(ring), ring.symbol(ALONG)

    def integral(of: Expr) -> Expr:
        """Σ c_j l^(j+1)/(j+1) over the powers of x, or what is measured where there is no extent."""
        whole = density * measure * of
        if extent.is_zero:
            return whole
        terms = (_powers(ring, whole) or {}).items()
        return sum((c * extent ** (j + 1) * Fraction(1, j + 1) for j, c in terms), start=ring.zero)

    def form(value: RationalExpr) -> Node:
        above = compactor.form(value.numerator)
        if value.divisor is None:
            return above
        return times(Fraction(1), [(above, 1), (compactor.form(value.divisor), -1)])

    mass, first = integral(ring.one), ring.zero if extent.is_zero else integral(x)

    def moment(about: int, slice: Expr, *, across: bool) -> SliceMoment:
        whole = integral(slice + x * x if across and not extent.is_zero else slice)
        centred = RationalExpr(whole * mass - first * first, mass) if across else RationalExpr(whole, None)
        return SliceMoment(
            2 * AXES[about], compactor.form(slice), compactor.form(whole), form(cancelled(centred))
        )

    own = AXES.index(axis)
    return Density(
        formula=formula,
        varies=varies,
        extent=None if extent.is_zero else compactor.form(extent),
        measure=compactor.form(measure),
        mass=compactor.form(mass),
        first=compactor.form(first),
        center=form(cancelled(RationalExpr(first, mass))),
        turned=moment(own, turned, across=False),
        tilted=(
            moment((own + 1) % 3, tilted[0], across=True),
            moment((own + 2) % 3, tilted[1], across=True),
        ),
        begins=begins,
    )


def cell_of(beside: Cell, what: str, tree: Node) -> Cell:
    """A cell for what follows from the density, which stands where that does."""
    names = tuple(name for name in beside.names if name.name != ALONG)
    return replace(beside, what=what, tree=tree, names=names)
