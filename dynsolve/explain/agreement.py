"""Steps of the checks: both ways to D, C q̇ and g agree, and Ḋ - 2C is skew-symmetric."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from dynsolve.algebra import matrix as algebra
from dynsolve.derivation.agreement import agreement
from dynsolve.document import Prose, Reference
from dynsolve.explain.christoffel import SLOPES
from dynsolve.explain.context import Context
from dynsolve.explain.step import Detail, Line, Step
from dynsolve.explain.working.derivatives import coriolis_rows, inertia_rate
from dynsolve.explain.writing import counted_sum, is_small, listed, spong
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
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage

STAGE = Stage.VECTORIZED

SKEW = Sum((letters.bold("D", dots=1), Negative(Product((Number(2), letters.C)))))

ROWS = "Cqd-rows"
"""The label of the rows of C q̇ that are compared."""


def compared_rows(
    context: Context, named: Callable[[int, int, int], Node] | None = None, *, written_out: bool = False
) -> tuple[Line, ...]:
    """The rows of C q̇ by the Christoffel symbols, with a number; what they are, the step's text says."""
    rows = coriolis_rows(context, named, written_out=written_out)
    return tuple(replace(line, by=(), label=ROWS) for line in rows)


def agreement_step(context: Context) -> Step:
    """Whether D, C q̇ and g, read off from the forces, are those assembled directly."""
    agreed = context.agreement or agreement(context.robot, context.values)
    coriolis = Product((letters.C, letters.QD))
    rows = compared_rows(context) if agreed.coriolis else ()
    verdicts = (
        ((letters.D, Reference(("D", "D_sum"), " in ")), agreed.inertia),
        ((coriolis, Reference(("Cqd", ROWS if rows else "C"), " in ")), agreed.coriolis),
        ((letters.G, Reference(("Cqd-2", "g"), " in ")), agreed.gravity),
    )
    same = [name for name, holds in verdicts if holds]
    wrong = [name for name, holds in verdicts if not holds]
    why: Prose = ()  # after the rows that it speaks of
    if same:
        why += ("Read off and assembled directly: the same ", *listed(same), ".")
    if wrong:
        why += (" The two ways differ in " if same else "The two ways differ in ", *listed(wrong), ".")
    return Step(
        id="agreement",
        stage=STAGE,
        title="Both ways agree" if not wrong else "The two ways differ",
        why=("The rows of ", coriolis, ", multiplied out:") if rows else why,
        source=spong("7.3"),
        lines=rows,
        concluding=why if rows else (),
        detail=Detail.NORMAL if wrong else Detail.FULL,
        outcome=("Read off from the forces and assembled directly: the same ", *listed(same), "."),
        uses=("christoffel", "C"),
        is_task=False,
    )


def _by_entries(n: int) -> Prose:
    """n_ij = -n_ji, where there is more than one entry."""
    if n == 1:
        return ()
    i, j = Symbol("i"), Symbol("j")
    return (", ", equation(Letter("n", Row((i, j))), Negative(Letter("n", Row((j, i))))))


_I, _J, _K = (Symbol(name) for name in "ijk")


def _in_general(n: int) -> Line:
    """n_kj from the derivatives of D, of which half cancel: what is left changes its sign with k and j."""

    def slope(row: Node, column: Node, by: Node) -> Node:
        return letters.partial_derivative(Letter("d", Row((row, column))), Letter("q", by))

    def over_rates(factor: Node) -> Node:
        return counted_sum(Product((factor, Letter("q", _I, dots=1))), _I, n)

    place = Row((_K, _J))
    spread = Sum((slope(_K, _J, _I), Negative(SLOPES)))
    left = Sum((slope(_I, _J, _K), Negative(slope(_K, _I, _J))))
    entry = Sum((Letter("d", place, dots=1), Negative(Product((Number(2), Letter("c", place))))))
    by: Prose = ("Its entries, with ", Letter("d", place, dots=1), " by the chain rule and ")
    by += (Letter("c", place), " by the derivatives of ", letters.D, ":")
    sums = (over_rates(Parenthesized(spread)), over_rates(Parenthesized(left)))
    return Line(by, (equation(Letter("n", place), entry, *sums),))


def _exchanged() -> Prose:
    """Why the general entry changes its sign."""
    return (
        *("With ", _K, " and ", _J, " exchanged, the two derivatives change places, for "),
        *(letters.D, " is symmetric, and the sum changes its sign:"),
    )


def _nothing_to_check(name: Node) -> Step:
    """N of a constant D, of which no Christoffel symbol is left."""
    zero = letters.bold("0")
    return Step(
        id="skew",
        stage=STAGE,
        title="Check: a matrix that must be skew-symmetric",
        why=(letters.D, " is constant, and ", equation(letters.C, zero), ": nothing is left to be checked."),
        formula=equation(name, SKEW),
        source=spong("7.5.1"),
        result=(equation(name, zero),),
        detail=Detail.FULL,
        outcome=(letters.D, " is constant, and ", equation(letters.C, zero), "."),
        is_task=False,
    )


def skew_step(context: Context) -> Step:
    """N = Ḋ - 2C, and N + Nᵀ = 0."""
    robot = context.robot
    ring = robot.ring
    D, C = context.values["D"], context.values["C"]
    result: tuple[Node, ...] = ()
    rate = inertia_rate(context)
    if rate or is_small(context.form("D"), context.form("C")):
        N: algebra.Matrix = D.map(ring.time_derivative) - C.scale(ring.constant(2))
        result = (equation(letters.bold("N"), context.show(N)),)
    name = letters.bold("N")
    if C.is_zero:
        return _nothing_to_check(name)
    general = () if result or robot.n == 1 else (_in_general(robot.n),)
    passive = " Passivity follows from this." if not context.is_short else ""  # of short arms the energy does
    return Step(
        id="skew",
        stage=STAGE,
        title="Check: a matrix that must be skew-symmetric",
        why=(
            "With ",
            *((letters.C, Reference(("C",))) if context.is_short else (letters.C,)),
            " from the Christoffel symbols",
            *(() if context.is_short else (Reference(("christoffel",)),)),
            ", ",
            name,
            " must be skew-symmetric",
            *_by_entries(robot.n),
            ", so that ",
            equation(letters.transposed_product(letters.QD, name), Number(0)),
            f".{passive}",
        ),
        formula=equation(name, SKEW),
        lines=rate or general,
        uses=() if rate or general else ("D",),
        concluding=_exchanged() if general else (),
        entries=letters.entries("n", robot.n) if robot.n > 1 else (),
        source=spong("7.5.1"),
        result=(*result, equation(Sum((name, Transpose(name))), letters.bold("0"))),
        detail=Detail.FULL,
        outcome=(equation(name, SKEW), " is skew-symmetric", *_by_entries(robot.n), "."),
        hint=(
            "A check at the end: with ",
            letters.C,
            " from the Christoffel symbols, ",
            name,
            " plus its transpose must come out as zero.",
        ),
    )
