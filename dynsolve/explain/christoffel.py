"""The step of the Christoffel symbols: the distinct ones, each with the derivatives it is made of."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from math import gcd

from msgspec.structs import asdict, replace

from dynsolve.algebra import matrix as algebra
from dynsolve.derivation.euler_lagrange import agreement
from dynsolve.document import Prose, Reference
from dynsolve.document.books import spong
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.named_steps import ending_of_symbols, label_of
from dynsolve.explain.step import NOTED, TOLD, Detail, Line, Step
from dynsolve.explain.working.derivatives import Slope, coriolis_rows, inertia_rate, slopes, varying, weights
from dynsolve.explain.working.identities import Identity, identities, said
from dynsolve.explain.writing import counted_sum, is_small, listed
from dynsolve.notation.build import split_sign, times, total
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    NAMED,
    ZERO,
    Matrix,
    Negative,
    Node,
    Parenthesized,
    Product,
    Relation,
    Sum,
    Symbol,
    equation,
)
from dynsolve.quantities import letters

MOST_ZEROS = 20
"""Up to this number Christoffel symbols that are zero are named one by one."""

_I = Symbol("i")

SLOPES = formula("(∂d_kj/∂q_i + ∂d_ki/∂q_j - ∂d_ij/∂q_k)")
"""Twice c_ijk, by the derivatives of D."""

CONSTANT = say("$𝐃$ is constant, so every Christoffel symbol is zero.")

NO_CORIOLIS = formula("𝐂 = 𝟎")


def christoffel_step(context: Context) -> Step:
    """c_ijk = ½ (∂d_kj/∂q_i + ∂d_ki/∂q_j - ∂d_ij/∂q_k), those that are not zero."""
    nonzero, zero = _sorted_symbols(context)
    way = slopes(context)
    used = list(dict.fromkeys(one for indices in nonzero for one in _put_in(context, *indices)[1]))
    if used:
        put_in = "Put into the formula, with" if way.lines else "With"
        way = replace(way, concluding=say("{put_in} {used}:", put_in=put_in, used=said(used)))
    swapped = "The first two indices may be swapped: $c_ijk = c_jik$. " if context.robot.n > 1 else ""
    why = say(
        f"They are made of the derivatives of $𝐃$ with respect to the coordinates. {swapped}"
        "Partial derivatives that are zero are left out.{cancelling}",
        cancelling=_cancelling(context, zero),
    )
    results = [_symbol(context, *indices) for indices in nonzero]
    single = None if context.names is None else context.names.single
    if single is not None:
        first = results[0]
        assert isinstance(first, Relation)
        *before, _ = first.parts
        results[0] = Relation((*before, single.meaning, single.name), (*first.signs, NAMED))
        why = (*why, " The symbol ", before[0], " is named ", single.name, ".")
    end = ending_of_symbols(context, results, way)
    names = {f"c{a + 1}{b + 1}{k + 1}" for i, j, k in zero for a, b in ((i, j), (j, i))}
    is_asked = not names.isdisjoint(context.find)
    return Step(
        id="christoffel",
        title="Christoffel symbols",
        why=why if nonzero else CONSTANT,
        said="" if nonzero else "constant",
        formula=formula("c_ijk = ½ {slopes}", slopes=SLOPES),
        source=spong("7.3"),
        **asdict(end),
        hint=(
            "Each is made of three partial derivatives of entries of D. The first two indices may be "
            "swapped, which halves the work.",
        ),
        notes=tuple(_zero_note(context, zero)) if nonzero else (),
        normal=NOTED if is_asked else TOLD,
        detail=Detail.NORMAL if nonzero or is_asked else Detail.FULL,
    )


def equal_symbols(context: Context) -> Reference:
    """The equations of the symbols that are equal by twos: c_121 = c_211, a number each."""
    nonzero, _ = _sorted_symbols(context)
    labels = ("christoffel", *(f"christoffel-{place}" for place in range(2, len(nonzero) + 1)))
    return Reference(
        tuple(label for label, (i, j, _) in zip(labels, nonzero, strict=True) if i != j), ", as in "
    )


def _sorted_symbols(context: Context) -> tuple[list[tuple[int, int, int]], list[tuple[int, int, int]]]:
    """The indices (from 0) of the distinct symbols, i ≤ j: those that are not zero, and those that are."""
    symbols = context.values["christoffel"]
    order = sorted(symbols, key=lambda ijk: (ijk[2], ijk[0], ijk[1]))
    nonzero = [ijk for ijk in order if not symbols[ijk].is_zero]
    return nonzero, [ijk for ijk in order if symbols[ijk].is_zero]


def _symbol(context: Context, i: int, j: int, k: int) -> Node:
    """c_ijk = c_jik = ½ (...) = its value; partial derivatives that are zero are left out."""
    value = context.symbol(i, j, k)
    names: list[Node] = [letters.entry("c", i + 1, j + 1, k + 1)]
    if i != j:
        names.append(letters.entry("c", j + 1, i + 1, k + 1))
    own = [weight for weight in weights(context, i, j, k).values() if weight]
    slopes = in_slopes(context, i, j, k)
    if own == [2]:  # two equal slopes, which their half is one of
        names.append(Product((letters.HALF, Parenthesized(Sum((slopes, slopes))))))
    put_in, used = _put_in(context, i, j, k)
    return equation(*names, slopes, *[put_in] * bool(used), value)


def _put_in(context: Context, i: int, j: int, k: int) -> tuple[Node, Sequence[Identity]]:
    """c_ijk with the derivatives of D put in, and the identities that lead on to its value; of short arms."""
    if not context.is_short:
        return ZERO, ()
    ring, D = context.robot.ring, context.values["D"]
    put_in = _halved(
        [
            (weight, context.show(ring.diff(D[place], by)))
            for (place, by), weight in weights(context, i, j, k).items()
            if weight
        ]
    )
    return put_in, identities(ring, put_in, context.forms.christoffel(i, j, k)) or ()


def with_slopes(context: Context, slopes: Iterable[Slope]) -> tuple[str, ...]:
    """The equations of the symbols that say what derivatives of D are: of each alone, or else all with it."""
    nonzero, _ = _sorted_symbols(context)
    found: dict[str, None] = {}
    made = [{key for key, weight in weights(context, *ijk).items() if weight} for ijk in nonzero]
    for slope in slopes:
        places = [place for place, keys in enumerate(made, start=1) if slope in keys]
        alone = [place for place in places if len(made[place - 1]) == 1]
        found |= dict.fromkeys(f"christoffel#{place}" for place in alone[:1] or places)
    return tuple(found)


def in_slopes(context: Context, i: int, j: int, k: int) -> Node:
    """½ (∂d_kj/∂q_i + ∂d_ki/∂q_j - ∂d_ij/∂q_k) without those that are zero or cancel, of indices from 0."""
    names = context.robot.ring.names
    parts = [
        (weight, letters.partial_derivative(letters.entry("d", row + 1, col + 1), Symbol(names[by])))
        for ((row, col), by), weight in weights(context, i, j, k).items()
        if weight
    ]
    return _halved(parts)


def _halved(parts: Sequence[tuple[int, Node]]) -> Node:
    """½ (Σ weight · ∂d/∂q), with weights 1, 2 and -1; a factor 2 that stands alone cancels."""
    if len(parts) == 1:
        weight, derivative = parts[0]
        node = derivative if abs(weight) == 2 else Product((letters.HALF, derivative))
        return Negative(node) if weight < 0 else node
    terms = [times(weight, [(derivative, 1)]) for weight, derivative in parts]
    return formula("½ ({terms})", terms=Sum(tuple(terms)))


def _cancelling(context: Context, zero: Sequence[tuple[int, int, int]]) -> Prose:
    """The symbols in which derivatives that are not zero cancel."""
    made = {ijk: found for ijk in zero if (found := weights(context, *ijk))}
    if not 0 < len(made) <= MOST_ZEROS:
        return ()
    by_symmetry = not any(weight for found in made.values() for weight in found.values())
    return say(
        " In {names} the others cancel{why}.",
        names=_names(list(made)),
        why=say(", $𝐃$ being symmetric") if by_symmetry else "",
    )


def _zero_note(context: Context, zero: Sequence[tuple[int, int, int]]) -> Iterator[Prose]:
    if len(zero) > MOST_ZEROS:
        yield ("All the others are zero.",)
        return
    vanishing = [ijk for ijk in zero if not weights(context, *ijk)]
    if vanishing:
        text = "{names} are zero." if len(vanishing) > 1 else "{names} is zero."
        yield say(text, names=_names(vanishing))


def _names(symbols: Sequence[tuple[int, int, int]]) -> Prose:
    return listed([letters.entry("c", *(place + 1 for place in ijk)) for ijk in symbols])


# -- steps of the checks: both ways to D, C q̇ and g agree, and Ḋ - 2C is skew-symmetric -----------

SKEW = formula("𝐃̇ - 2 𝐂")

ROWS = "Cqd-rows"
"""The label of the rows of C q̇ that are compared."""


def agreement_step(context: Context) -> Step:
    """Whether D, C q̇ and g, read off from the forces, are those assembled directly."""
    agreed = context.agreement or agreement(context.robot, context.values)
    shown = coriolis_rows(context) if agreed.coriolis else ()
    rows = tuple(Line((), line.formulas, line.uses, ROWS) for line in shown)  # what they are, the text says
    way = "Read off from the forces and assembled directly"
    if context.by_energies:
        way = "From the equations of Lagrange"
    verdicts = (
        (say("$𝐃${where}", where=Reference(("D", "D_sum"), " in ")), agreed.inertia),
        (say("$𝐂 𝐪̇${where}", where=Reference(("Cqd", ROWS if rows else "C"), " in ")), agreed.coriolis),
        (say("$𝐠${where}", where=Reference(("Cqd-2", "g"), " in ")), agreed.gravity),
    )
    same = listed([name for name, holds in verdicts if holds])
    wrong = listed([name for name, holds in verdicts if not holds])
    agree = say("Read off and assembled directly: the same {same}.", same=same) if same else ()
    differ = say("The two ways differ in {wrong}.", wrong=wrong) if wrong else ()
    why = (*agree, *([" "] if same and wrong else []), *differ)  # after the rows that it speaks of
    return Step(
        id="agreement",
        title="Both ways agree" if not wrong else "The two ways differ",
        why=say("The rows of $𝐂 𝐪̇$, multiplied out:") if rows else why,
        source=spong("7.3"),
        lines=rows,
        concluding=why if rows else (),
        detail=Detail.NORMAL if wrong else Detail.FULL,
        outcome=say("{way}: the same {same}.", way=way, same=same),
        uses=("christoffel", "C"),
        is_task=False,
    )


def _in_general(n: int) -> Line:
    """n_kj from the derivatives of D, of which half cancel: what is left changes its sign with k and j."""
    sums = [
        counted_sum(formula("({factor}) q̇_i", factor=factor), _I, n)
        for factor in (formula("∂d_kj/∂q_i - {slopes}", slopes=SLOPES), formula("∂d_ij/∂q_k - ∂d_ki/∂q_j"))
    ]
    by = say("Its entries, with $ḋ_kj$ by the chain rule and $c_kj$ by the derivatives of $𝐃$:")
    return Line(by, (equation(*(formula(text) for text in ("n_kj", "ḋ_kj - 2 c_kj")), *sums),))


def skew_step(context: Context) -> Step:
    """N = Ḋ - 2C, and N + Nᵀ = 0; where D is constant nothing is left to be checked."""
    robot, is_short = context.robot, context.is_short
    ring = robot.ring
    D, C = context.values["D"], context.values["C"]
    step = Step(
        id="skew",
        title="Check: a matrix that must be skew-symmetric",
        formula=formula("𝐍 = {skew}", skew=SKEW),
        source=spong("7.5.1"),
        detail=Detail.FULL,
    )
    if C.is_zero:
        return replace(
            step,
            why=say("$𝐃$ is constant, and $𝐂 = 𝟎$: nothing is left to be checked."),
            result=(formula("𝐍 = 𝟎"),),
            is_task=False,
        )
    result: tuple[Node, ...] = ()
    rate = _rate_in_symbols(context) if context.has_named_symbols else inertia_rate(context)
    if context.has_named_symbols:
        n = range(robot.n)
        by_symbols = Matrix(tuple(tuple(_by_symbols(context, -1, k, j) for j in n) for k in n))
        result = (equation(letters.bold("N"), by_symbols),)
    elif rate or is_small(context.form("D"), context.form("C")):
        N: algebra.Matrix = D.map(ring.time_derivative) - C.scale(ring.constant(2))
        result = (equation(letters.bold("N"), context.show(N)),)
    general = () if result or robot.n == 1 else (_in_general(robot.n),)
    by_entries = say(", $n_ij = -n_ji$") if robot.n > 1 else ""
    return replace(
        step,
        why=say(
            "With $𝐂${of_C} from the Christoffel symbols{symbols}, $𝐍$ must be skew-symmetric{entries}, so "
            "that $𝐪̇ᵀ 𝐍 𝐪̇ = 0$.{passive}",
            of_C=Reference(("C",)) if is_short else "",
            symbols="" if is_short else Reference(("christoffel",)),
            entries=by_entries,
            passive="" if is_short else " Passivity follows from this.",  # of short arms the energy does
        ),
        lines=rate or general,
        uses=() if rate or general else ("D",),
        concluding=say(
            "With $k$ and $j$ exchanged, the two derivatives change places, for $𝐃$ is symmetric, and the "
            "sum changes its sign:"
        )
        if general
        else (),
        entries=letters.entries("n", robot.n) if robot.n > 1 else (),
        result=(*result, formula("𝐍 + 𝐍ᵀ = 𝟎")),
        outcome=say("$𝐍 = {skew}$ is skew-symmetric{entries}.", skew=SKEW, entries=by_entries),
        hint=say(
            "A check at the end: with $𝐂$ from the Christoffel symbols, $𝐍$ plus its transpose must come out "
            "as zero."
        ),
    )


def _rate_in_symbols(context: Context) -> tuple[Line, ...]:
    """Ḋ by the symbols in their names: ∂d_kj/∂q_i = c_ijk + c_ikj."""
    assert context.names is not None
    symbols = (one.name for one in context.names.of_symbols if one != context.names.single)
    slopes = [((i, j), q.index - 1) for i, j, q in varying(context)]
    used = dict.fromkeys((*(label_of(context, name) for name in symbols), *with_slopes(context, slopes)))
    return inertia_rate(context, lambda i, j: _by_symbols(context, 1, i, j), tuple(used))


def _by_symbols(context: Context, sign: int, k: int, j: int) -> Node:
    """Σ_i (c_ikj ± c_ijk) q̇_i: with + it is ḋ_kj, with - it is n_kj."""
    c, rates = context.symbol, [letters.velocity(q) for q in context.robot.coordinates]
    pairs = [((sign, c(i, j, k), rate), (1, c(i, k, j), rate)) for i, rate in enumerate(rates)]
    return _collected(term for pair in pairs for term in pair)


def _collected(terms: Iterable[tuple[int, Node, Node]]) -> Node:
    """Σ factor · symbol · rate: the rates of each symbol in one sum, what their factors share in front."""
    rates: dict[Node, Counter[Node]] = {}
    for factor, symbol, rate in terms:
        sign, name = split_sign(symbol)
        if name != ZERO:
            rates.setdefault(name, Counter())[rate] += sign * factor
    found = []
    for name, own in rates.items():
        if shared := gcd(*own.values()):
            shared = -shared if all(factor <= 0 for factor in own.values()) else shared
            inner = total([times(factor // shared, [(rate, 1)]) for rate, factor in own.items()])
            found.append(times(shared, [(name, 1), (inner, 1)]))
    return total(found)
