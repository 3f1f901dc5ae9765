"""Names for the moments of inertia that come up again and again, from the kinetic energy on: σ₁, σ₂, ...

The kinetic energy of an arm with bodies of many parts has long sums of masses and lengths as factors:

    m₂ (4l₂² - b²)/12 + m₃ ((d₃ - l₃/2)² + l₃²/12) + m₄ d₃²

Each stands in L, in momenta, forces, D, C and the summary.  A textbook names it where it is met first, with
its derivative where a joint that slides changes it; what follows is written with the names.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from dynsolve.algebra.ring_values import value_of
from dynsolve.document import Inline, Prose
from dynsolve.explain.forms import Forms, is_numeric
from dynsolve.explain.recurring import Definition, expanded
from dynsolve.explain.step import Line, Step
from dynsolve.explain.working.derivatives import are_alike
from dynsolve.explain.working.differentiation import by_symbol, differentiated, product_of
from dynsolve.notation.build import cost, negated, total
from dynsolve.notation.tree import (
    Entry,
    Function,
    Letter,
    Matrix,
    Negative,
    Node,
    Product,
    Relation,
    Sum,
    Symbol,
    equation,
)
from dynsolve.notation.walk import children, walk, with_children
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage

LEAST_SAVED = 80
"""The operations that a name saves in the energies, momenta, forces and D, at least: four lines of text."""

SHORTEST = 4
"""The operations from which on such a sum, or one in its derivative, is worth a name."""

_AFTER = (Stage.LAGRANGIAN, Stage.TORQUE, Stage.VECTORIZED)
"""The stages whose steps are in the names, as is the total kinetic energy."""

_BODY_BY_BODY = frozenset({"inertia_poses", "point_masses"})
"""The checks that ask what each body adds, and so show it."""


INERTIAS = "inertia-names"
"""The label of the names' definitions."""

DERIVATIVES = "inertia-derivatives"
"""The label of the names' derivatives."""

_COLLECTED = frozenset({"D_sum", "g"})
"""The steps that are worked out anew from what stands before the names, and end in these."""

_DIFFERENTIATED = re.compile(r"ddt\d|christoffel")
"""The steps that differentiate what they are written in, by the time or by all coordinates."""


@dataclass(frozen=True, slots=True)
class _Exchange:
    """A sum, and what stands in its place."""

    terms: frozenset[Node]
    name: Node


@dataclass(frozen=True, slots=True)
class InertiaNames:
    """The definitions in order, their derivatives by the coordinates, and the formulas in these names.

    `by` are the coordinates, from 1, that the named sums depend on.
    """

    definitions: tuple[Definition, ...] = ()
    slopes: tuple[Relation, ...] = ()
    exchanges: tuple[_Exchange, ...] = ()
    by: frozenset[int] = frozenset()

    def put(self, node: Node) -> Node:
        """The tree with the names in the places of what they mean.

        >>> from dynsolve.notation.python import to_python
        >>> a, b, c, name = map(Symbol, "abcs")
        >>> names = InertiaNames(exchanges=(_Exchange(frozenset({a, b}), name),))
        >>> to_python(names.put(Product((c, Sum((a, c, b))))))
        'c*(s + c)'
        """
        for exchange in self.exchanges:
            node = _exchanged(node, exchange)
        return node

    @property
    def symbols(self) -> frozenset[Node]:
        """The names."""
        return frozenset(one.name for one in self.definitions)

    def lines(self) -> Iterator[Line]:
        """Where the names are defined, and the derivatives that follow from that."""
        defined = (equation(one.name, one.meaning) for one in self.definitions)
        yield Line(("Abbreviations:",), tuple(defined), label=INERTIAS)
        if self.slopes:
            yield Line(("Hence:",), self.slopes, label=DERIVATIVES)

    def in_steps(self, steps: Iterable[Step]) -> Iterator[Step]:
        """The steps from the total kinetic energy on with the names, defined in the first that has one."""
        defined = False
        for step in steps:
            named = step.id == "K" or (step.stage in _AFTER and step.id not in _BODY_BY_BODY)
            written = self._in_step(step) if named else step
            if named:
                written = replace(written, names=(*written.names, *self._used_in(written)))
            if written != step and not defined:
                defined = True
                written = self._defining(step, written)
            yield written

    def _used_in(self, step: Step) -> Iterator[str]:
        """The labels of what a step needs to be written in the names."""
        in_names = self._names_in(step.result)
        if step.id in {f"dLdq{k}" for k in self.by} or (
            self.slopes and in_names and _DIFFERENTIATED.match(step.id)
        ):
            yield DERIVATIVES
        elif in_names and step.id in _COLLECTED:
            yield INERTIAS

    def _defining(self, step: Step, written: Step) -> Step:
        """The step that defines the names: its result stands before them without any, if it was collected."""
        if not step.concluding:
            return replace(written, lines=(*written.lines, *self.lines()))
        collected = Line(step.concluding, step.result)
        return replace(written, lines=(*written.lines, collected, *self.lines()), concluding=("With these:",))

    def _names_in(self, nodes: Iterable[Node]) -> bool:
        """Whether formulas are written in the names."""
        return not self.symbols.isdisjoint(walk(*nodes))

    def _in_step(self, step: Step) -> Step:
        """A step in the names; its last line is left out where only the order of the result differs."""
        lines = step.lines  # the plain sum of K stands before the names are defined
        if step.id != "K":
            put = self._last if step.id in _COLLECTED else self.put
            lines = tuple(replace(line, formulas=tuple(map(put, line.formulas))) for line in lines)
        result = tuple(map(self._last if step.id in _COLLECTED else self.put, step.result))
        written = replace(
            step,
            why=self._prose(step.why),
            working=tuple(map(self.put, step.working)),
            lines=lines,
            result=result,
            notes=tuple(map(self._prose, step.notes)),
            table=step.table and replace(step.table, rows=tuple(map(self._prose, step.table.rows))),
        )
        alike = written != step and lines and result and are_alike(lines[-1].formulas[-1], result[0])
        return replace(written, lines=lines[:-1], concluding=()) if alike else written

    def _last(self, node: Node) -> Node:
        """An equation whose last member is in the names: beside the sum as it stands, or in its place."""
        if not isinstance(node, Relation):
            return self.put(node)
        *before, last = node.parts
        named = self.put(last)
        is_alone = named != last and not isinstance(last, Matrix) and all(map(_is_letter, before))
        return equation(*before, *([last] if is_alone else []), named)

    def _prose(self, parts: tuple[Inline, ...]) -> Prose:
        return tuple(self.put(part) if isinstance(part, Node) else part for part in parts)


def _is_letter(node: Node) -> bool:
    """Whether a member of an equation names a quantity."""
    return isinstance(node, Letter | Entry)


def _exchanged(node: Node, exchange: _Exchange) -> Node:
    """A tree with one sum exchanged, wherever its terms stand in a sum, with either sign."""
    if isinstance(node, Function):  # no angle has a name
        return node
    changed = with_children(node, lambda part: _exchanged(part, exchange))
    match changed:
        case Sum(terms) if len(terms) >= len(exchange.terms):
            for own, name in (
                (exchange.terms, exchange.name),
                (frozenset(map(negated, exchange.terms)), negated(exchange.name)),
            ):
                if own <= set(terms):
                    place = next(i for i, term in enumerate(terms) if term in own)
                    rest = [term for term in terms if term not in own]
                    before = sum(term not in own for term in terms[:place])
                    return total([*rest[:before], name, *rest[before:]])
        case Product(factors) if changed is not node and any(
            isinstance(factor, Product | Negative) for factor in factors
        ):
            return product_of(1, [(factor, 1) for factor in factors])
    return changed


# -- which sums get a name -------------------------------------------------------------------------


def name_inertias(forms: Forms, names: Iterator[Symbol]) -> InertiaNames:
    """Names for the sums by which LEAST_SAVED operations are saved; none of robots in numbers."""
    robot = forms.robot
    if is_numeric(robot):
        return InertiaNames()
    trees = [forms(name) for name in _counted(robot.n) if name in forms.values.rules]
    found: list[Definition] = []
    while (best := _worth_a_name(trees)) is not None:
        found.append(Definition(next(names), best))
        trees = [_exchanged(node, _by_name(found[-1])) for node in trees]
    return _with_slopes(forms, found, names)


def _counted(n: int) -> Iterator[str]:
    """The values in which sums are counted."""
    yield from ("K", "D", "Cqd")
    for k in range(1, n + 1):
        yield from (f"dLdqd{k}", f"ddt{k}", f"dLdq{k}", f"tau{k}")


def _worth_a_name(trees: Iterable[Node]) -> Sum | None:
    """The sum without sines and rates by which most operations are saved."""
    uses = Counter(part for tree in trees for part in _sums(tree) if _is_inertia(part))
    saved = {part: (count - 1) * cost(part) for part, count in uses.items() if cost(part) >= SHORTEST}
    best = max(saved, key=lambda part: saved[part], default=None)
    return None if best is None or saved[best] < LEAST_SAVED else best


def _sums(node: Node) -> Iterator[Sum]:
    """The sums in a tree but those of angles."""
    if isinstance(node, Sum):
        yield node
    if not isinstance(node, Function):
        for part in children(node):
            yield from _sums(part)


def _is_inertia(node: Sum) -> bool:
    """Whether a sum is made of parameters and lengths alone."""
    moving = (isinstance(part, Function) or (isinstance(part, Symbol) and part.dots) for part in walk(node))
    return not any(moving)


def _by_name(definition: Definition) -> _Exchange:
    assert isinstance(definition.meaning, Sum)
    return _Exchange(frozenset(definition.meaning.terms), definition.name)


# -- their derivatives -----------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Slope:
    """The derivative of a named sum by a coordinate: as it is differentiated, and collected."""

    of: Definition
    by: Symbol
    termwise: Node
    collected: Node


def _with_slopes(forms: Forms, found: Sequence[Definition], names: Iterator[Symbol]) -> InertiaNames:
    """The names with their derivatives by the coordinates; sums in these have names too."""
    slopes = [slope for one in found for slope in _slopes(forms, found, one)]
    sums = (part for slope in slopes for part in walk(slope.collected) if isinstance(part, Sum))
    long = (part for part in dict.fromkeys(sums) if cost(part) >= SHORTEST)
    definitions = (*found, *(Definition(name, part) for part, name in zip(long, names, strict=False)))
    named = InertiaNames(definitions, (), tuple(map(_by_name, definitions)))
    equal: dict[Node, list[Node]] = {}
    exchanges = list(named.exchanges)
    for slope in slopes:
        short = named.put(slope.collected)
        equal.setdefault(short, []).append(letters.partial_derivative(slope.of.name, slope.by))
        rate = Symbol(slope.by.name, 1)
        for tree, name in (
            (slope.termwise, short),
            (_times(slope.termwise, rate), _times(short, rate)),
        ):
            if isinstance(tree, Sum):
                exchanges.append(_Exchange(frozenset(tree.terms), name))
    return InertiaNames(
        definitions,
        tuple(equation(*left, right) for right, left in equal.items()),
        tuple(exchanges),
        frozenset(forms.robot.ring.names.index(slope.by.name) + 1 for slope in slopes),
    )


def _slopes(forms: Forms, found: Sequence[Definition], one: Definition) -> Iterator[_Slope]:
    """The derivatives of a named sum by the coordinates that it depends on."""
    ring = forms.robot.ring
    (meaning,) = expanded(found, [one.name])
    value = value_of(ring, meaning)
    for k, coordinate in enumerate(map(Symbol, ring.names)):
        if not (slope := ring.diff(value, k)).is_zero:
            yield _Slope(
                one, coordinate, differentiated(meaning, by_symbol(coordinate)).tree, forms.of(slope)
            )


def _times(node: Node, rate: Symbol) -> Node:
    """The terms of a sum times a rate, as the chain rule has them."""
    terms = node.terms if isinstance(node, Sum) else (node,)
    return total([product_of(1, [(term, 1), (rate, 1)]) for term in terms])
