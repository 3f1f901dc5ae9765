"""Names for the moments of inertia that come up again and again, from the kinetic energy on: σ₁, σ₂, ...

The kinetic energy of an arm with bodies of many parts has long sums of masses and lengths as factors:

    m₂ (4l₂² - b²)/12 + m₃ ((d₃ - l₃/2)² + l₃²/12) + m₄ d₃²

Each stands in L, in momenta, forces, D, C and the summary.  It is named where it is met first
(`explain.named_steps`), with its derivative where a joint that slides changes it.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from dynsolve.algebra.ring_values import value_of
from dynsolve.explain.exchanges import Exchange
from dynsolve.explain.forms import Forms, is_numeric
from dynsolve.explain.recurring import Definition, expanded
from dynsolve.explain.working.differentiation import by_symbol, differentiated, product_of
from dynsolve.notation.build import cost, total
from dynsolve.notation.tree import (
    Function,
    Node,
    Relation,
    Sum,
    Symbol,
    equation,
)
from dynsolve.notation.walk import children, walk
from dynsolve.quantities import letters

LEAST_SAVED = 80
"""The operations that a name saves in the energies, momenta, forces and D, at least: four lines of text."""

SHORTEST = 4
"""The operations from which on such a sum, or one in its derivative, is worth a name."""


@dataclass(frozen=True, slots=True)
class InertiaNames:
    """The definitions in order, their derivatives by the coordinates, and the formulas in these names.

    `by` are the coordinates, from 1, that the named sums depend on.
    """

    definitions: tuple[Definition, ...] = ()
    slopes: tuple[Relation, ...] = ()
    exchanges: tuple[Exchange, ...] = ()
    by: frozenset[int] = frozenset()

    def put(self, node: Node) -> Node:
        """The tree with the names in the places of what they mean."""
        for exchange in self.exchanges:
            node = exchange.put(node)
        return node

    @property
    def symbols(self) -> frozenset[Node]:
        """The names."""
        return frozenset(one.name for one in self.definitions)


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
        trees = [Exchange.of(found[-1]).put(node) for node in trees]
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
    named = InertiaNames(definitions, (), tuple(map(Exchange.of, definitions)))
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
                exchanges.append(Exchange(tree, name))
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
