"""The steps of a short model in names: which sums have one, and where it is introduced.

Which:  a sum of masses and lengths that comes up again and again from the kinetic energy on, and what its
        derivatives are made of (`name_inertias`): σ₁, σ₂, ...
        what Christoffel symbols are, where C would fill half a page (`name_symbols`): σ₃, ...
        what all of them are but for sign: h.
Where:  in the first step from the kinetic energy on in whose result it stands, after that result, which is
        then written with the name; h beside the first symbol that it is, as in the book.
After:  every result has the name in its place.  What a symbol is stands in forces beside products of rates,
        and is looked for there alone.

A name has one meaning in a report, and its line in the list of notation has the unit of that.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from math import gcd

from msgspec.structs import replace

from dynsolve.document import DEFINITIONS, Inline, Prose, Reference
from dynsolve.document.sentences import opened, say
from dynsolve.explain.abbreviations import Abbreviated, Definition
from dynsolve.explain.christoffel import compared_rows, with_slopes
from dynsolve.explain.context import Context
from dynsolve.explain.entry_formulas import collected_coriolis_force
from dynsolve.explain.step import Line, Step
from dynsolve.explain.terms import Kind, name_of_term, rates_of, rows_in_names, terms_of
from dynsolve.explain.working.derivatives import inertia_rate, varying
from dynsolve.explain.working.identities import are_alike
from dynsolve.explain.writing import listed
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
    column,
    equation,
    walk,
    with_children,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage

DERIVATIVES = "derivatives-of-names"
"""The label of the derivatives of named sums."""

_AFTER = (Stage.LAGRANGIAN, Stage.TORQUE, Stage.VECTORIZED)
"""The stages whose steps are in the names of sums, as is the total kinetic energy."""

_BODY_BY_BODY = frozenset({"inertia_poses", "point_masses"})
"""The checks that ask what each body adds, and so show it."""

_LOOKED_AT = {"definite": "D", "inertia_poses": "D", "point_masses": "D", "equilibrium": "g"}
"""The checks in which D, or g row by row, is looked at."""

_COLLECTED = frozenset({"D_sum", "g"})
"""The steps that are worked out anew from what stands before the names, and end in these."""

_DIFFERENTIATED = re.compile(r"ddt\d+|christoffel")
"""The steps that differentiate what they are written in, by the time or by all coordinates."""

_WITH_RATES = re.compile(r"ddt\d+|dLdq\d+|tau\d+|Cqd")
"""The steps in whose results Christoffel symbols stand beside products of rates."""

_ENDING_IN_VALUES = frozenset({"agreement", "skew"})
"""The steps whose lines end in values: Ḋ by the derivatives of D alone, C q̇ by the symbols alone."""

_BY_SYMBOLS = re.compile(r"ddt\d+|dLdq\d+|christoffel")
"""The steps that bring the names of symbols in, and so refer to them."""


def in_names(steps: Iterable[Step], context: Context, short: Abbreviated) -> Iterator[Step]:
    """The steps, with names in them and, of a long model, without what fills pages."""
    if short.at_symbols:
        return steps_in_names(steps, context, short)
    return iter(steps) if short.long else _of_short_model(steps, context, short)


def _of_short_model(steps: Iterable[Step], context: Context, short: Abbreviated) -> Iterator[Step]:
    """The steps with names in D, the Christoffel symbols, C and g alone, as they were asked for."""
    forms, names = context.forms, context.robot.ring.names
    rows = (collected_coriolis_force(names, short.symbol, k) for k in range(context.robot.n))
    named = {
        **_named_symbols(context, short),
        forms("D"): short.D,
        forms("C"): short.C,
        forms("g"): short.g,
        forms("Cqd"): column(*rows),
    }
    for step in steps:
        if step.stage is Stage.VECTORIZED:
            step = _result_exchanged(step, named)
        if step.id in _ENDING_IN_VALUES:
            step = replace(step, lines=_in_lines(step.lines, _without_value))
        yield _with_cells(step, _without_value) if step.id == "terms" else step


def _named_symbols(context: Context, short: Abbreviated) -> dict[Node, Node]:
    return {context.forms.christoffel(*ijk): symbol for ijk, symbol in short.christoffel.items()}


def _without_value(node: Node) -> Node:
    """A chain of equations without its last member, which is the value written out."""
    if not isinstance(node, Relation):
        return node
    return node.parts[0] if len(node.parts) == 2 else equation(*node.parts[:-1])


def _result_exchanged(step: Step, named: Mapping[Node, Node]) -> Step:
    """The step with parts of its results exchanged."""

    def exchanged(node: Node) -> Node:
        found = named.get(node)
        if found is not None:
            return found
        return with_children(node, exchanged) if isinstance(node, Relation | Sum | Product) else node

    return replace(step, result=tuple(map(exchanged, step.result)))


def _with_cells(step: Step, change: Callable[[Node], Node]) -> Step:
    """The step with the formulas of its table changed."""
    assert step.table is not None
    rows = tuple(_changed(row, change) for row in step.table.rows)
    return replace(step, table=replace(step.table, rows=rows))


def _in_lines(lines: Iterable[Line], change: Callable[[Node], Node]) -> tuple[Line, ...]:
    return tuple(replace(line, formulas=tuple(map(change, line.formulas))) for line in lines)


def _changed(parts: Iterable[Inline], change: Callable[[Node], Node]) -> Prose:
    return tuple(change(part) if isinstance(part, Node) else part for part in parts)


# -- the names of sums and of symbols, each where it is met first -----------------------------------


def labels_of_names(steps: Iterable[Step], short: Abbreviated) -> tuple[str, ...]:
    """The labels of where names are introduced."""
    found = tuple(line.label for step in steps for line in step.lines if line.label.startswith(DEFINITIONS))
    return found if short.single is None else (*found, "christoffel")


def steps_in_names(steps: Iterable[Step], context: Context, short: Abbreviated) -> Iterator[Step]:
    """The steps in the names of `short`, each introduced in the first in whose result it stands."""
    names = _Names(context, short)
    for step in steps:
        in_sums = names.in_sums(step)
        written = names.in_symbols(names.ending_in_sums(in_sums))
        met = names.first_met(written)
        labels = tuple(dict.fromkeys((*written.names, *names.used(written))))
        written = names.on_named(replace(written, names=labels))
        if met:
            plain = in_sums if met[0] in short.of_symbols else step
            written = names.introducing(plain, written, met)
        yield written
        names.labels |= dict.fromkeys((one.name for one in met), f"{DEFINITIONS}{step.id}")


def _symbols(nodes: Iterable[Node]) -> list[Symbol]:
    return [node for node in walk(*nodes) if isinstance(node, Symbol)]


class _Names:
    """The names of a short model, and the labels of those that are introduced already."""

    def __init__(self, context: Context, short: Abbreviated) -> None:
        assert short.inertias is not None
        self.context, self.short, self.sums = context, short, short.inertias
        self.single = short.single
        self.symbols = [one.name for one in short.of_symbols if one != self.single]
        self.labels: dict[Symbol, str] = {}
        if self.single is not None:
            self.labels[self.single.name] = "christoffel"

    # -- where names are introduced, and referred to ---------------------------------------------------

    def first_met(self, written: Step) -> tuple[Definition, ...]:
        """The definitions of the names in a result that are not known, and those that these need."""
        needed = set(_symbols(written.result)) - self.labels.keys()
        for one in reversed(self.short.sums):
            if one.name in needed:
                slopes = (slope for slope in self.sums.slopes if one.name in set(walk(slope)))
                needed.update(_symbols((one.meaning, *slopes)))
        return tuple(one for one in self.short.sums if one.name in needed - self.labels.keys())

    def introducing(self, plain: Step, written: Step, met: Sequence[Definition]) -> Step:
        """The step that introduces names: its plain result stands before them, if it was collected."""
        abbreviations = "abbreviations" if len(met) > 1 else "abbreviation"
        meanings = tuple(equation(one.name, one.meaning) for one in met)
        lines = [Line((f"{opened(abbreviations)}:",), meanings, label=f"{DEFINITIONS}{plain.id}")]
        names = {one.name for one in met}
        slopes = tuple(slope for slope in self.sums.slopes if not names.isdisjoint(walk(slope)))
        if slopes:
            lines.append(Line(("Hence:",), slopes, label=DERIVATIVES))
        after = written.concluding
        result = plain.result[0]
        is_matrix = isinstance(result, Relation) and isinstance(result.parts[-1], Matrix)
        if plain.id == "christoffel":
            after = ("Put into the formula:",)
        elif plain.concluding or not (plain.lines or is_matrix):
            lines.insert(0, Line(plain.concluding, plain.result))
            after = (f"With the {abbreviations}:",)
        return replace(written, lines=(*written.lines, *lines), concluding=after)

    def used(self, written: Step) -> Iterator[str]:
        """The labels of what a step needs to be written in the names."""
        id, names = written.id, [name for name in _symbols(written.result) if name in self.labels]
        of_sums = [name for name in names if name in self.sums.symbols]
        differentiated = self.sums.slopes and of_sums and _DIFFERENTIATED.fullmatch(id)
        if differentiated or id in {f"dLdq{k}" for k in self.sums.by}:
            yield DERIVATIVES
        elif id in _COLLECTED:
            yield from (self.labels[name] for name in of_sums)
        if _BY_SYMBOLS.fullmatch(id) and not (_WITH_RATES.fullmatch(id) and _has_way(written)):
            yield from (self.labels[name] for name in names if name in self.symbols)

    def on_named(self, step: Step) -> Step:
        """A check on D, or on g row by row, with the equations of what the names in these mean."""
        looked_at = _LOOKED_AT.get(step.id)
        if looked_at is None:
            return step
        found = set(_symbols([self.sums.put(self.context.matrix("D"))]))
        if looked_at == "g":
            found = set(_put_in(node for line in step.lines for node in line.formulas))
        named = (one.name for one in self.sums.definitions if one.name in found)
        defined = tuple(dict.fromkeys(self.labels[name] for name in named))
        why = tuple(
            replace(part, labels=(looked_at, *defined))
            if isinstance(part, Reference) and part.labels == (looked_at,)
            else part
            for part in step.why
        )
        return replace(step, why=why, names=(*step.names, *defined) if step.result else step.names)

    def _ending_in(self, step: Step, names: Sequence[Symbol]) -> Step:
        """The step with what is said before its result: collected, written with σ₁ in (55)."""
        if not names:
            return step
        *before, last = step.concluding
        assert isinstance(last, str)
        known = tuple(dict.fromkeys(self.labels[name] for name in names if name in self.labels))
        said = say(
            "{last}, written with {names}{known}:",
            last=last.removesuffix(":"),
            names=listed(list(names)),
            known=Reference(known, " in ") if known else "",
        )
        return replace(step, concluding=(*before, *said))

    # -- steps in the names of sums --------------------------------------------------------------------

    def in_sums(self, step: Step) -> Step:
        """A step in the names of sums; of the Christoffel symbols and what is made of them, in all names."""
        named = step.id == "K" or (step.stage in _AFTER and step.id not in _BODY_BY_BODY)
        written = self._made_of_symbols(step)
        return self._in_inertias(written) if named else written

    def _in_inertias(self, step: Step) -> Step:
        """A step in the names; its last line is left out where only the order of the result differs."""
        put = self.sums.put
        last = self._last_put if step.id in _COLLECTED else put
        # the plain sum of K stands before the names are defined
        lines = step.lines if step.id == "K" else _in_lines(step.lines, last)
        written = replace(
            step if step.table is None else _with_cells(step, put),
            why=_changed(step.why, put),
            working=tuple(map(put, step.working)),
            lines=lines,
            result=tuple(map(last, step.result)),
            notes=tuple(_changed(note, put) for note in step.notes),
        )
        result = written.result
        alike = written != step and lines and result and are_alike(lines[-1].formulas[-1], result[0])
        return replace(written, lines=lines[:-1], concluding=()) if alike else written

    def _last_put(self, node: Node) -> Node:
        """An equation whose last member is in the names: beside the sum as it stands, or in its place."""
        if not isinstance(node, Relation):
            return self.sums.put(node)
        *before, last = node.parts
        named = self.sums.put(last)
        in_letters = all(isinstance(part, Letter | Entry) for part in before)
        is_alone = named != last and not isinstance(last, Matrix) and in_letters
        return equation(*before, *([last] if is_alone else []), named)

    def ending_in_sums(self, step: Step) -> Step:
        """A derivative of L that is collected in names which the line before has not: they are said."""
        if not (step.id.startswith("dLdq") and _has_way(step)):
            return step
        before = set(walk(*step.lines[-1].formulas))
        names = (name for name in _symbols(step.result) if name in self.sums.symbols and name not in before)
        return self._ending_in(step, list(dict.fromkeys(names)))

    # -- steps in the names of symbols -----------------------------------------------------------------

    def in_symbols(self, step: Step) -> Step:
        """A step whose result has the names of symbols beside products of rates."""
        if not _WITH_RATES.fullmatch(step.id):
            return step

        def put(node: Node) -> Node:
            match node:
                case Relation(parts):
                    return equation(*parts[:-1], put(parts[-1]))
                case Matrix():
                    return with_children(node, put)
                case Sum(terms):
                    return total(list(map(put, terms)))
            return self.short.put_symbols(node) if any(name.dots == 1 for name in _symbols([node])) else node

        written = replace(step, result=tuple(map(put, step.result)))
        names = set(walk(*written.result)) - set(walk(*step.result))
        shown = [one.name for one in self.short.of_symbols if one.name in names]
        return self._ending_in(written, shown) if _has_way(step) else written

    def _made_of_symbols(self, step: Step) -> Step:
        context, short = self.context, self.short
        match step.id:
            case "christoffel":
                return self._christoffel(step)
            case "C":
                return _result_exchanged(step, {context.form("C"): short.C})
            case "model":
                step = _result_exchanged(step, {context.form("C"): short.C})
                has_rows = self.single is not None  # the forces were derived before h
                return replace(step, lines=(rows_in_names(context, short.symbol),)) if has_rows else step
            case "agreement":
                rows = compared_rows(context, short.symbol, written_out=self.single is not None)
                return replace(step, lines=rows)
            case "skew":
                return self._skew(step)
            case "terms":
                return self._terms(step)
        return step

    def _christoffel(self, step: Step) -> Step:
        """The symbols and the slopes that they are made of by their names; h is introduced at the first."""

        def also_named(node: Node) -> Node:
            if not isinstance(node, Relation):
                return node
            named = self.short.put_symbols(node.parts[-1])
            return node if named == node.parts[-1] else equation(*node.parts, named)

        written = _result_exchanged(step, _named_symbols(self.context, self.short))
        written = replace(written, lines=_in_lines(step.lines, also_named))
        if self.single is None:
            return written
        first, *others = written.result
        assert isinstance(first, Relation)
        *before, name = first.parts
        return replace(
            written,
            why=(*step.why, " The symbol ", before[0], " is named ", name, "."),
            result=(Relation((*before, self.single.meaning, name), (*first.signs, NAMED)), *others),
        )

    def _skew(self, step: Step) -> Step:
        """Ḋ and N by the symbols: ∂d_kj/∂q_i = c_ijk + c_ikj, so that n_kj = Σ_i (c_ikj - c_ijk) q̇_i."""
        context, c = self.context, self.short.symbol
        n, rates = context.robot.n, [letters.velocity(q) for q in context.robot.coordinates]

        def entry(sign: int, k: int, j: int) -> Node:
            """Σ_i (c_ikj ± c_ijk) q̇_i"""
            pairs = [((sign, c(i, j, k), rate), (1, c(i, k, j), rate)) for i, rate in enumerate(rates)]
            return _collected(term for pair in pairs for term in pair)

        N = Matrix(tuple(tuple(entry(-1, k, j) for j in range(n)) for k in range(n)))
        slopes = [((i, j), q.index - 1) for i, j, q in varying(context)]
        named = (self.labels[name] for name in self.symbols)
        used = tuple(dict.fromkeys((*named, *with_slopes(context, slopes))))
        lines = inertia_rate(context, lambda i, j: entry(1, i, j), used)
        return replace(step, lines=lines, result=(equation(letters.bold("N"), N), *step.result[-1:]))

    def _terms(self, step: Step) -> Step:
        """The table of the terms of the forces, centrifugal and Coriolis terms by the names."""
        context, named = self.context, dict[Node, Node]()
        for k in range(context.robot.n):
            for term in terms_of(context, k):
                if term.kind in (Kind.CENTRIFUGAL, Kind.CORIOLIS):
                    (i, _), (j, _) = term.rates
                    symbol = self.short.symbol(i, j, k)
                    name = name_of_term(context, term)
                    value = times(term.count, [(symbol, 1), *rates_of(context, term)])
                    named[name] = equation(name, value)
        return _with_cells(
            step, lambda cell: named.get(cell.parts[0] if isinstance(cell, Relation) else cell, cell)
        )


def _has_way(step: Step) -> bool:
    """Whether lines lead to the result, and something is said before that."""
    return bool(step.lines and step.concluding)


def _put_in(nodes: Iterable[Node]) -> Iterator[Symbol]:
    """The names of sums that are in one member of an equation, and no more in the next."""
    for relation in (node for node in walk(*nodes) if isinstance(node, Relation)):
        for before, after in pairwise(relation.parts):
            left = set(walk(after))
            yield from (name for name in _symbols([before]) if name not in left)


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
