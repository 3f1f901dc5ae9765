"""The steps of a short model in names: which sums have one, and where it is introduced.

Which:  a sum of masses and lengths that comes up again and again from the kinetic energy on, and what its
        derivatives are made of (`inertia_names`): σ₁, σ₂, ...
        what Christoffel symbols are, where C would fill half a page (`symbol_names`): σ₃, ...
        what all of them are but for sign: h.
Where:  in the first step from the kinetic energy on in whose result it stands, after that result, which is
        then written with the name; h beside the first symbol that it is, as in the book.
After:  every result has the name in its place.  What a symbol is stands in forces beside products of rates,
        and is looked for there alone.

A name has one meaning in a report, and its line in the list of notation has the unit of that.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from math import gcd

from dynsolve.document import DEFINITIONS, Inline, Prose, Reference
from dynsolve.explain.abbreviations import Abbreviated, Definition
from dynsolve.explain.christoffel import compared_rows, with_slopes
from dynsolve.explain.context import Context
from dynsolve.explain.forms import collected_coriolis_force
from dynsolve.explain.long_model.steps import of_long_model
from dynsolve.explain.names import InertiaNames
from dynsolve.explain.step import Line, Step
from dynsolve.explain.terms import Kind, Term, name_of_term, rates_of, rows_in_names, terms_of
from dynsolve.explain.working.derivatives import are_alike, inertia_rate, varying
from dynsolve.explain.writing import listed
from dynsolve.notation import tree
from dynsolve.notation.build import split_sign, times, total
from dynsolve.notation.tree import (
    NAMED,
    ZERO,
    Entry,
    Letter,
    Matrix,
    Node,
    Product,
    Relation,
    Sum,
    Symbol,
    equation,
)
from dynsolve.notation.walk import walk, with_children
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage

DERIVATIVES = "derivatives-of-names"
"""The label of the derivatives of named sums."""

_AFTER = (Stage.LAGRANGIAN, Stage.TORQUE, Stage.VECTORIZED)
"""The stages whose steps are in the names of sums, as is the total kinetic energy."""

_BODY_BY_BODY = frozenset({"inertia_poses", "point_masses"})
"""The checks that ask what each body adds, and so show it."""

_ON_D = frozenset({"definite", "inertia_poses", "point_masses"})
"""The checks in which D is looked at."""

_ON_G = "equilibrium"
"""The check in which g is looked at."""

_COLLECTED = frozenset({"D_sum", "g"})
"""The steps that are worked out anew from what stands before the names, and end in these."""

_DIFFERENTIATED = re.compile(r"ddt\d+|christoffel")
"""The steps that differentiate what they are written in, by the time or by all coordinates."""

_WITH_RATES = re.compile(r"ddt\d+|dLdq\d+|tau\d+|Cqd")
"""The steps in whose results Christoffel symbols stand beside products of rates."""

_BY_SYMBOLS = re.compile(r"ddt\d+|dLdq\d+|christoffel")
"""The steps that bring the names of symbols in, and so refer to them."""


def steps_in_names(steps: Iterable[Step], context: Context, short: Abbreviated) -> Iterator[Step]:
    """The steps in the names of `short`, each introduced in the first in whose result it stands."""
    labels: dict[Symbol, str] = {}
    if short.single is not None:
        labels[short.single.name] = "christoffel"
    for step in steps:
        in_sums = _in_sums(step, context, short, labels)
        written = _in_symbols(_ending_in_sums(in_sums, short, labels), short, labels)
        met = _first_met(short, written, labels)
        referring = tuple(dict.fromkeys((*written.names, *_used(step, written, short, labels))))
        written = _on_named(replace(written, names=referring), context, short, labels)
        if met:
            plain = in_sums if met[0] in short.of_symbols else step
            written = _introducing(plain, written, met, short)
        yield written
        labels |= dict.fromkeys((one.name for one in met), f"{DEFINITIONS}{step.id}")


def labels_of_names(steps: Iterable[Step], short: Abbreviated) -> tuple[str, ...]:
    """The labels of where names are introduced."""
    found = tuple(line.label for step in steps for line in step.lines if line.label.startswith(DEFINITIONS))
    return found if short.single is None else (*found, "christoffel")


def _first_met(short: Abbreviated, written: Step, known: Mapping[Symbol, str]) -> tuple[Definition, ...]:
    """The definitions of the names in a result that are not known, and those that these need."""
    needed = {node for node in walk(*written.result) if isinstance(node, Symbol)} - known.keys()
    for one in reversed(short.sums):
        if one.name in needed:
            slopes = (slope for slope in _slopes(short) if one.name in set(walk(slope)))
            needed |= {node for node in walk(one.meaning, *slopes) if isinstance(node, Symbol)}
    return tuple(one for one in short.sums if one.name in needed - known.keys())


def _slopes(short: Abbreviated) -> tuple[Relation, ...]:
    return () if short.inertias is None else short.inertias.slopes


def _used(step: Step, written: Step, short: Abbreviated, labels: Mapping[Symbol, str]) -> Iterator[str]:
    """The labels of what a step needs to be written in the names."""
    inertias = short.inertias or InertiaNames()
    names = [node for node in walk(*written.result) if isinstance(node, Symbol) and node in labels]
    of_sums = [name for name in names if name in inertias.symbols]
    differentiated = inertias.slopes and of_sums and _DIFFERENTIATED.fullmatch(step.id)
    if differentiated or step.id in {f"dLdq{k}" for k in inertias.by}:
        yield DERIVATIVES
    elif step.id in _COLLECTED:
        yield from (labels[name] for name in of_sums)
    told_at_the_end = _WITH_RATES.fullmatch(step.id) and _has_way(written)
    if _BY_SYMBOLS.fullmatch(step.id) and not told_at_the_end:
        of_symbols = {one.name for one in short.of_symbols if one != short.single}
        yield from (labels[name] for name in names if name in of_symbols)


def _ending_in_sums(step: Step, short: Abbreviated, labels: Mapping[Symbol, str]) -> Step:
    """A derivative of L that is collected in names of sums which the line before has not: they are said."""
    if short.inertias is None or not (step.id.startswith("dLdq") and _has_way(step)):
        return step
    before = set(walk(*step.lines[-1].formulas))
    names = (node for node in walk(*step.result) if isinstance(node, Symbol) and node not in before)
    return _ending_in(step, [name for name in dict.fromkeys(names) if name in short.inertias.symbols], labels)


def _ending_in(step: Step, names: Sequence[Symbol], labels: Mapping[Symbol, str]) -> Step:
    """The step with what is said before its result: collected, written with σ₁ in (55)."""
    if not names:
        return step
    *before, last = step.concluding
    assert isinstance(last, str)
    known = tuple(dict.fromkeys(labels[name] for name in names if name in labels))
    defined = (Reference(known, " in "),) if known else ()
    said = f"{last.removesuffix(':')}, written with "
    return replace(step, concluding=(*before, said, *listed(list(names)), *defined, ":"))


def _has_way(step: Step) -> bool:
    """Whether lines lead to the result, and something is said before that."""
    return bool(step.lines and step.concluding)


def _on_named(step: Step, context: Context, short: Abbreviated, labels: Mapping[Symbol, str]) -> Step:
    """A check on D, or on g row by row, where these have names: with the equations of what the names mean."""
    if short.inertias is None or not (step.id in _ON_D or step.id == _ON_G):
        return step
    looked_at = "g" if step.id == _ON_G else "D"
    formulas = [node for line in step.lines for node in line.formulas]
    shown = list(_put_in(formulas)) if step.id == _ON_G else [short.inertias.put(context.matrix("D"))]
    found = {node for node in walk(*shown) if isinstance(node, Symbol)}
    named = (one.name for one in short.sums if one.name in short.inertias.symbols & found)
    defined = tuple(dict.fromkeys(labels[name] for name in named))

    def extended(part: Inline) -> Inline:
        if isinstance(part, Reference) and part.labels == (looked_at,):
            return replace(part, labels=(looked_at, *defined))
        return part

    names = (*step.names, *defined) if step.result else step.names
    return replace(step, why=tuple(map(extended, step.why)), names=names)


def _put_in(nodes: Iterable[Node]) -> Iterator[Node]:
    """The names of sums that are in one member of an equation, and no more in the next."""
    for relation in (node for node in walk(*nodes) if isinstance(node, Relation)):
        for before, after in pairwise(relation.parts):
            left = set(walk(after))
            yield from (node for node in walk(before) if isinstance(node, Symbol) and node not in left)


def _introducing(plain: Step, written: Step, met: Sequence[Definition], short: Abbreviated) -> Step:
    """The step that introduces names: its plain result stands before them, if it was collected."""
    names = {one.name for one in met}
    lead = "Abbreviations:" if len(met) > 1 else "Abbreviation:"
    lines = [Line((lead,), _equations(met), label=f"{DEFINITIONS}{plain.id}")]
    slopes = tuple(slope for slope in _slopes(short) if not names.isdisjoint(walk(slope)))
    if slopes:
        lines.append(Line(("Hence:",), slopes, label=DERIVATIVES))
    if plain.id == "christoffel":
        return replace(written, lines=(*written.lines, *lines), concluding=("Put into the formula:",))
    if plain.concluding or (not plain.lines and not _is_matrix(plain.result[0])):
        lines.insert(0, Line(plain.concluding, plain.result))
        after = "With the abbreviations:" if len(met) > 1 else "With the abbreviation:"
        return replace(written, lines=(*written.lines, *lines), concluding=(after,))
    return replace(written, lines=(*written.lines, *lines))


def _equations(definitions: Iterable[Definition]) -> tuple[Relation, ...]:
    return tuple(equation(one.name, one.meaning) for one in definitions)


def _is_matrix(result: Node) -> bool:
    return isinstance(result, Relation) and isinstance(result.parts[-1], Matrix)


def _in_sums(step: Step, context: Context, short: Abbreviated, labels: Mapping[Symbol, str]) -> Step:
    """A step in the names of sums; of the Christoffel symbols and what is made of them, in all names."""
    changes: dict[str, Callable[[], Step]] = {
        "christoffel": lambda: _christoffel(step, context, short),
        "C": lambda: _result_exchanged(step, {context.form("C"): short.C}),
        "model": lambda: _model(step, context, short),
        "agreement": lambda: replace(step, lines=_compared(context, short)),
        "skew": lambda: _skew(step, context, short, labels),
        "terms": lambda: _terms(step, context, short),
    }
    written = changes[step.id]() if step.id in changes else step
    named = step.id == "K" or (step.stage in _AFTER and step.id not in _BODY_BY_BODY)
    return written if short.inertias is None or not named else _in_inertias(written, short.inertias)


# -- names of sums of masses and lengths -----------------------------------------------------------


def _in_inertias(step: Step, names: InertiaNames) -> Step:
    """A step in the names; its last line is left out where only the order of the result differs."""
    last = _last_put(names) if step.id in _COLLECTED else names.put
    lines = step.lines  # the plain sum of K stands before the names are defined
    if step.id != "K":
        lines = tuple(replace(line, formulas=tuple(map(last, line.formulas))) for line in lines)

    def prose(parts: tuple[Inline, ...]) -> Prose:
        return tuple(names.put(part) if isinstance(part, Node) else part for part in parts)

    written = replace(
        step,
        why=prose(step.why),
        working=tuple(map(names.put, step.working)),
        lines=lines,
        result=tuple(map(last, step.result)),
        notes=tuple(map(prose, step.notes)),
        table=step.table and replace(step.table, rows=tuple(map(prose, step.table.rows))),
    )
    result = written.result
    alike = written != step and lines and result and are_alike(lines[-1].formulas[-1], result[0])
    return replace(written, lines=lines[:-1], concluding=()) if alike else written


def _last_put(names: InertiaNames) -> Callable[[Node], Node]:
    """An equation whose last member is in the names: beside the sum as it stands, or in its place."""

    def put(node: Node) -> Node:
        if not isinstance(node, Relation):
            return names.put(node)
        *before, last = node.parts
        named = names.put(last)
        in_letters = all(isinstance(part, Letter | Entry) for part in before)
        is_alone = named != last and not isinstance(last, Matrix) and in_letters
        return equation(*before, *([last] if is_alone else []), named)

    return put


# -- names of symbols ------------------------------------------------------------------------------


def _in_symbols(step: Step, short: Abbreviated, labels: Mapping[Symbol, str]) -> Step:
    """A step whose result has the names of symbols beside products of rates."""
    if not _WITH_RATES.fullmatch(step.id):
        return step

    def term(node: Node) -> Node:
        has_rates = any(isinstance(part, Symbol) and part.dots == 1 for part in walk(node))
        return short.put_symbols(node) if has_rates else node

    def put(node: Node) -> Node:
        match node:
            case Relation(parts):
                return equation(*parts[:-1], put(parts[-1]))
            case Matrix(rows):
                return Matrix(tuple(tuple(map(put, row)) for row in rows))
            case Sum(terms):
                return total(list(map(term, terms)))
        return term(node)

    written = replace(step, result=tuple(map(put, step.result)))
    names = set(walk(*written.result)) - set(walk(*step.result))
    shown = [one.name for one in short.of_symbols if one.name in names]
    return _ending_in(written, shown, labels) if _has_way(step) else written


def _christoffel(step: Step, context: Context, short: Abbreviated) -> Step:
    """The symbols and the derivatives that they are made of by their names; h is introduced at the first."""
    named = {context.forms.christoffel(*ijk): symbol for ijk, symbol in short.christoffel.items()}
    lines = (
        replace(line, formulas=tuple(_also_named(node, short) for node in line.formulas))
        for line in step.lines
    )
    written = replace(_result_exchanged(step, named), lines=tuple(lines))
    if short.single is None:
        return written
    first, *others = written.result
    assert isinstance(first, Relation)
    *before, name = first.parts
    signs = (*first.signs, NAMED)
    return replace(
        written,
        why=(*step.why, " The symbol ", before[0], " is named ", name, "."),
        result=(Relation((*before, short.single.meaning, name), signs), *others),
    )


def _also_named(node: Node, short: Abbreviated) -> Node:
    """An equation with its last member again in the names of symbols, where it has some."""
    if not isinstance(node, Relation):
        return node
    named = short.put_symbols(node.parts[-1])
    return node if named == node.parts[-1] else equation(*node.parts, named)


def _result_exchanged(step: Step, named: Mapping[Node, Node]) -> Step:
    """The step with parts of its results exchanged."""

    def exchanged(node: Node) -> Node:
        found = named.get(node)
        if found is not None:
            return found
        inside = isinstance(node, Relation | Sum | tree.Product)
        return with_children(node, exchanged) if inside else node

    return replace(step, result=tuple(map(exchanged, step.result)))


def _model(step: Step, context: Context, short: Abbreviated) -> Step:
    """The model; its rows with h where the forces were derived before h."""
    step = _result_exchanged(step, {context.form("C"): short.C})
    return step if short.single is None else replace(step, lines=(rows_in_names(context, short.symbol),))


def _compared(context: Context, short: Abbreviated) -> tuple[Line, ...]:
    """The rows of C q̇ in the names, and without h, which the forces came before."""
    return compared_rows(context, short.symbol, written_out=short.single is not None)


def _skew(step: Step, context: Context, short: Abbreviated, labels: Mapping[Symbol, str]) -> Step:
    """Ḋ and N by the symbols: ∂d_kj/∂q_i = c_ijk + c_ikj, so that n_kj = Σ_i (c_ikj - c_ijk) q̇_i."""
    n, c = context.robot.n, short.symbol

    def entry(signs: tuple[int, int], k: int, j: int) -> Node:
        first, second = signs
        return _collected(
            term
            for i, q in enumerate(context.robot.coordinates)
            for term in ((first, c(i, j, k), letters.velocity(q)), (second, c(i, k, j), letters.velocity(q)))
        )

    rows = tuple(tuple(entry((-1, 1), k, j) for j in range(n)) for k in range(n))
    slopes = [((i, j), q.index - 1) for i, j, q in varying(context)]
    named = (labels[one.name] for one in short.of_symbols if one != short.single)
    used = tuple(dict.fromkeys((*named, *with_slopes(context, slopes))))
    lines = inertia_rate(context, lambda i, j: entry((1, 1), i, j), used)
    return replace(step, lines=lines, result=(equation(letters.bold("N"), Matrix(rows)), *step.result[-1:]))


def _collected(terms: Iterable[tuple[int, Node, Node]]) -> Node:
    """Σ factor · symbol · rate, the rates of each symbol in one sum."""
    rates: dict[Node, dict[Node, int]] = {}
    for factor, symbol, rate in terms:
        sign, name = split_sign(symbol)
        if name != ZERO:
            own = rates.setdefault(name, {})
            own[rate] = own.get(rate, 0) + sign * factor
    return total([_product(name, own) for name, own in rates.items()])


def _product(name: Node, rates: Mapping[Node, int]) -> Node:
    """name · Σ factor · rate, with what the factors share in front."""
    shared = gcd(*rates.values())
    if not shared:
        return ZERO
    if all(factor <= 0 for factor in rates.values()):
        shared = -shared
    inner = total([times(factor // shared, [(rate, 1)]) for rate, factor in rates.items()])
    return times(shared, [(name, 1), (inner, 1)])


def _terms(step: Step, context: Context, short: Abbreviated) -> Step:
    """The table of the terms of the forces, centrifugal and Coriolis terms by the names."""
    assert step.table is not None
    by_rates = (Kind.CENTRIFUGAL, Kind.CORIOLIS)
    named: dict[Node, Node] = {}
    for k in range(context.robot.n):
        for term in terms_of(context, k):
            if term.kind in by_rates:
                name = name_of_term(context, term)
                named[name] = equation(name, _by_name(context, short, term, k))

    def cell(part: Inline) -> Inline:
        left = part.parts[0] if isinstance(part, Relation) else part
        return named.get(left, part) if isinstance(left, Node) else part

    rows = tuple(tuple(map(cell, row)) for row in step.table.rows)
    return replace(step, table=replace(step.table, rows=rows))


def _by_name(context: Context, short: Abbreviated, term: Term, k: int) -> Node:
    """The value of a term of force k, its symbol by its name."""
    (i, _), (j, _) = term.rates
    return times(term.count, [(short.symbol(i, j, k), 1), *rates_of(context, term)])


# -- the steps of a derivation in the names of `explain.abbreviations` -----------------------------
# Those of a long model are in `explain.long_model`; of a short one D, the Christoffel symbols, C and g
# have names in them.


def in_names(steps: Iterable[Step], context: Context, short: Abbreviated) -> Iterator[Step]:
    """The steps, with names in them and, of a long model, without what fills pages."""
    if short.at_symbols:
        return steps_in_names(steps, context, short)
    return of_long_model(steps, context, short) if short.long else _of_short_model(steps, context, short)


def _of_short_model(steps: Iterable[Step], context: Context, short: Abbreviated) -> Iterator[Step]:
    forms, names = context.forms, context.robot.ring.names
    named: dict[Node, Node] = {
        **{forms.christoffel(*ijk): symbol for ijk, symbol in short.christoffel.items()},
        forms("D"): short.D,
        forms("C"): short.C,
        forms("g"): short.g,
        forms("Cqd"): tree.column(
            *(collected_coriolis_force(names, short.symbol, k) for k in range(context.robot.n))
        ),
    }
    for step in steps:
        if step.stage is Stage.VECTORIZED:
            step = replace(step, result=tuple(_exchanged(node, named) for node in step.result))
        in_letters = _IN_LETTERS.get(step.id)
        yield step if in_letters is None else in_letters(step)


def _rates_in_letters(step: Step) -> Step:
    """A step whose lines end in values: Ḋ by the derivatives of D alone, C q̇ by the symbols alone."""
    lines = (replace(line, formulas=tuple(map(_without_value, line.formulas))) for line in step.lines)
    return replace(step, lines=tuple(lines))


def _terms_in_letters(step: Step) -> Step:
    """The table of the terms of the forces, each by its name alone."""
    assert step.table is not None

    def cell(part: Inline) -> Inline:
        return _without_value(part) if isinstance(part, Node) else part

    rows = tuple(tuple(map(cell, row)) for row in step.table.rows)
    return replace(step, table=replace(step.table, rows=rows))


_IN_LETTERS: Mapping[str, Callable[[Step], Step]] = {
    "agreement": _rates_in_letters,
    "skew": _rates_in_letters,
    "terms": _terms_in_letters,
}
"""The steps whose values would not be in names, by their ids."""


def _without_value(node: Node) -> Node:
    """A chain of equations without its last member, which is the value written out."""
    if not isinstance(node, Relation):
        return node
    return node.parts[0] if len(node.parts) == 2 else equation(*node.parts[:-1])


def _exchanged(node: Node, named: Mapping[Node, Node]) -> Node:
    """A formula with parts exchanged for the same in names."""
    found = named.get(node)
    if found is not None:
        return found
    inside = isinstance(node, Relation | Sum | Product)
    return with_children(node, lambda part: _exchanged(part, named)) if inside else node
