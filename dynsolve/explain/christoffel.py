"""The step of the Christoffel symbols: the distinct ones, each with the derivatives it is made of."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace

from dynsolve.algebra import matrix as algebra
from dynsolve.derivation.agreement import agreement
from dynsolve.document import Prose, Reference
from dynsolve.explain.context import Context
from dynsolve.explain.step import Detail, Line, Step
from dynsolve.explain.working.derivatives import coriolis_rows, inertia_rate, slopes
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

MOST_ZEROS = 20
"""Up to this number Christoffel symbols that are zero are named one by one."""

_I, _J, _K = (Symbol(name) for name in "ijk")


def _d(*indices: Node) -> Letter:
    return Letter("d", Row(indices))


SLOPES = Parenthesized(
    Sum((
        letters.partial_derivative(_d(_K, _J), Letter("q", _I)),
        letters.partial_derivative(_d(_K, _I), Letter("q", _J)),
        Negative(letters.partial_derivative(_d(_I, _J), Letter("q", _K))),
    ))
)  # fmt: skip
"""Twice c_ijk, by the derivatives of D."""

Slope = tuple[tuple[int, int], int]
"""((a, b), c) of ∂d_ab/∂q_c, a ≤ b, from 0."""


def christoffel_step(context: Context) -> Step:
    """c_ijk = ½ (∂d_kj/∂q_i + ∂d_ki/∂q_j - ∂d_ij/∂q_k), those that are not zero."""
    n = context.robot.n
    nonzero, zero = _sorted_symbols(context)
    general = equation(Letter("c", Row((_I, _J, _K))), Product((letters.HALF, SLOPES)))
    results = tuple(_symbol(context, *indices) for indices in nonzero)
    way = slopes(context)
    return Step(
        id="christoffel",
        stage=STAGE,
        title="Christoffel symbols",
        why=_christoffel_why(n, len(nonzero)),
        formula=general,
        source=spong("7.3"),
        lines=way.lines,
        concluding=way.concluding,
        result=results,
        hint=(
            "Each is made of three partial derivatives of entries of D. The "
            "first two indices may be swapped, which halves the work.",
        ),
        notes=tuple(_zero_note(context, zero)) if nonzero else (),
    )


def equal_symbols(context: Context) -> Reference:
    """The equations of the symbols that are equal by twos: c_121 = c_211, a number each."""
    nonzero, _ = _sorted_symbols(context)
    labels = ("christoffel", *(f"christoffel-{place}" for place in range(2, len(nonzero) + 1)))
    return Reference(
        tuple(label for label, (i, j, _) in zip(labels, nonzero, strict=True) if i != j), ", as in "
    )


def _christoffel_why(n: int, count: int) -> Prose:
    if not count:
        return (
            letters.D,
            " is constant, so every Christoffel symbol is zero.",
        )
    swapped = equation(Letter("c", Row((_I, _J, _K))), Letter("c", Row((_J, _I, _K))))
    why: Prose = ("They are made of the derivatives of ", letters.D, " with respect to the coordinates. ")
    if n > 1:
        why += ("The first two indices may be swapped: ", swapped, ". ")
    return (*why, "Partial derivatives that are zero are left out.")


def _sorted_symbols(context: Context) -> tuple[list[tuple[int, int, int]], list[tuple[int, int, int]]]:
    """The indices (from 0) of the distinct symbols, i ≤ j: those that are not zero, and those that are."""
    symbols = context.values["christoffel"]
    order = sorted(symbols, key=lambda ijk: (ijk[2], ijk[0], ijk[1]))
    nonzero = [ijk for ijk in order if not symbols[ijk].is_zero]
    return nonzero, [ijk for ijk in order if symbols[ijk].is_zero]


def _symbol(context: Context, i: int, j: int, k: int) -> Node:
    """c_ijk = c_jik = ½ (...) = its value; partial derivatives that are zero are left out."""
    value = context.forms.christoffel(i, j, k)
    names: list[Node] = [letters.entry("c", i + 1, j + 1, k + 1)]
    if i != j:
        names.append(letters.entry("c", j + 1, i + 1, k + 1))
    weights = [weight for weight in _weights(context, i, j, k).values() if weight]
    slopes = in_slopes(context, i, j, k)
    if weights == [2]:  # two equal slopes, which their half is one of
        names.append(Product((letters.HALF, Parenthesized(Sum((slopes, slopes))))))
    return equation(*names, slopes, value)


def with_slopes(context: Context, slopes: Iterable[Slope]) -> tuple[str, ...]:
    """The equations of the symbols that say what derivatives of D are: of each alone, or else all with it."""
    nonzero, _ = _sorted_symbols(context)
    found: dict[str, None] = {}
    made = [{key for key, weight in _weights(context, *ijk).items() if weight} for ijk in nonzero]
    for slope in slopes:
        places = [place for place, keys in enumerate(made, start=1) if slope in keys]
        alone = [place for place in places if len(made[place - 1]) == 1]
        found |= dict.fromkeys(f"christoffel#{place}" for place in alone[:1] or places)
    return tuple(found)


def in_slopes(context: Context, i: int, j: int, k: int) -> Node:
    """½ (∂d_kj/∂q_i + ∂d_ki/∂q_j - ∂d_ij/∂q_k) without those that are zero or cancel, of indices from 0."""
    weights = _weights(context, i, j, k)
    return _halved([_weighted(context, key, weight) for key, weight in weights.items() if weight])


def _weights(context: Context, i: int, j: int, k: int) -> dict[Slope, int]:
    """How often each slope ∂d_ab/∂q_c that is not zero, a ≤ b, occurs in twice c_ijk; 0 where two cancel."""
    ring, D = context.robot.ring, context.values["D"]
    weights: dict[Slope, int] = {}
    for (row, col), by, sign in (((k, j), i, 1), ((k, i), j, 1), ((i, j), k, -1)):
        if not ring.diff(D[row, col], by).is_zero:
            key = ((min(row, col), max(row, col)), by)
            weights[key] = weights.get(key, 0) + sign
    return weights


def _weighted(context: Context, key: Slope, weight: int) -> tuple[int, Node]:
    (row, col), by = key
    name = letters.entry("d", row + 1, col + 1)
    return weight, letters.partial_derivative(name, Symbol(context.robot.coordinates[by].name))


def _halved(parts: Sequence[tuple[int, Node]]) -> Node:
    """½ (Σ weight · ∂d/∂q), with weights 1, 2 and -1; a factor 2 that stands alone cancels."""
    if len(parts) == 1:
        weight, derivative = parts[0]
        node = derivative if abs(weight) == 2 else Product((letters.HALF, derivative))
        return Negative(node) if weight < 0 else node
    terms = []
    for weight, derivative in parts:
        term = Product((Number(2), derivative)) if abs(weight) == 2 else derivative
        terms.append(Negative(term) if weight < 0 else term)
    return Product((letters.HALF, Parenthesized(Sum(tuple(terms)))))


def _zero_note(context: Context, zero: Sequence[tuple[int, int, int]]) -> Iterator[Prose]:
    if not zero:
        return
    if len(zero) > MOST_ZEROS:
        yield ("All the others are zero.",)
        return
    cancelled = [ijk for ijk in zero if _weights(context, *ijk)]
    names = _named([ijk for ijk in zero if ijk not in cancelled])
    note: Prose = (*names, " are zero." if len(names) > 1 else " is zero.") if names else ()
    if cancelled:
        by_symmetry = not any(weight for ijk in cancelled for weight in _weights(context, *ijk).values())
        note += (f"{' ' * bool(note)}In ", *_named(cancelled), " the derivatives cancel")
        note += (", ", letters.D, " being symmetric.") if by_symmetry else (".",)
    yield note


def _named(symbols: Sequence[tuple[int, int, int]]) -> Prose:
    """c_111 and c_222"""
    return listed([letters.entry("c", i + 1, j + 1, k + 1) for i, j, k in symbols])


# -- steps of the checks: both ways to D, C q̇ and g agree, and Ḋ - 2C is skew-symmetric -----------

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
