"""Names for what Christoffel symbols are: h of the planar elbow, or σ₁, σ₂, ...

Symbols are equal, or opposite, again and again: c_112 = -c_121.  Where all are one value but for its sign,
that is the books' h (Spong, Hutchinson, Vidyasagar, section 7.4).  Otherwise they get names where C would
fill half a page; C, Ḋ and N = Ḋ - 2C are then short sums of names and rates.

What recurs in the energies already is named there (`inertia_names`), and the symbols are written by that.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

from dynsolve.algebra.expr import Expr
from dynsolve.explain.abbreviations import RECURRING, SINGLE, Abbreviated, Index, free_names
from dynsolve.explain.entry_formulas import coriolis_matrix
from dynsolve.explain.forms import Forms
from dynsolve.explain.inertia_names import InertiaNames, name_inertias
from dynsolve.explain.recurring import Definition
from dynsolve.explain.short_arms import is_short
from dynsolve.notation import tree
from dynsolve.notation.build import cost, negated, split_sign, times, total
from dynsolve.notation.printing import flat_factors
from dynsolve.notation.tree import ZERO, Matrix, Negative, Node, Sum

LONG = 50
"""The operations of C from which on its symbols get names: it would not fit the page as a matrix."""

SHORTEST = 4
"""The operations from which on a symbol is worth a name."""


def name_symbols(forms: Forms) -> Abbreviated | None:
    """The model with names for its Christoffel symbols, and for long sums of masses and lengths in it.

    None where it is short without, or the arm longer.
    """
    robot, C = forms.robot, forms("C")
    if not is_short(robot, forms.values) or not isinstance(C, Matrix):
        return None
    taken = {*robot.ring.parameters, *robot.ring.names}
    free = free_names(RECURRING, taken)
    inertias = name_inertias(forms, free)
    is_long = sum(cost(inertias.put(entry)) for row in C.rows for entry in row) >= LONG
    if SINGLE not in taken and _is_one_value(forms):
        definitions, symbols = _one_named(forms, inertias)
    elif is_long:
        definitions, symbols = _named(forms, inertias, free)
    else:
        definitions, symbols = (), _written(forms, inertias)
    if not (inertias.definitions or definitions):
        return None
    D, g = inertias.put(forms("D")), inertias.put(forms("g"))
    assert isinstance(D, Matrix) and isinstance(g, Matrix)
    C = coriolis_matrix(robot.ring.names, lambda i, j, k: symbols[min(i, j), max(i, j), k])
    sums = (*inertias.definitions, *definitions)
    return Abbreviated((), sums, D, C, g, symbols, at_symbols=True, inertias=inertias)


def _is_one_value(forms: Forms) -> bool:
    """Whether several symbols are not zero, all of them the same but for sign, and worth a name."""
    values: Mapping[Index, Expr] = forms.values["christoffel"]
    found = [value for value in values.values() if not value.is_zero]
    alike = all(value in (found[0], -found[0]) for value in found)
    return len(found) > 1 and alike and cost(forms.of(found[0])) >= SHORTEST


def _one_named(forms: Forms, inertias: InertiaNames) -> tuple[tuple[Definition, ...], dict[Index, Node]]:
    """h, with the sign of the symbol that is shown first, and every symbol by it."""
    values: Mapping[Index, Expr] = forms.values["christoffel"]
    order = (values[key] for key in _as_shown(values))
    first = next(value for value in order if not value.is_zero)
    name = tree.Symbol(SINGLE)
    by_name: dict[Expr, Node] = {first: name, -first: Negative(name)}
    symbols = {key: by_name.get(value, ZERO) for key, value in values.items()}
    return (Definition(name, inertias.put(forms.of(first))),), symbols


def _as_shown(indices: Iterable[Index]) -> list[Index]:
    """The indices in the order in which the symbols are shown."""
    return sorted(indices, key=lambda ijk: (ijk[2], ijk[0], ijk[1]))


def _written(forms: Forms, inertias: InertiaNames) -> dict[Index, Node]:
    """The symbols without names of their own."""
    return {ijk: inertias.put(forms.christoffel(*ijk)) for ijk in forms.values["christoffel"]}


def _named(
    forms: Forms, inertias: InertiaNames, free: Iterator[tree.Symbol]
) -> tuple[tuple[Definition, ...], dict[Index, Node]]:
    """The definitions, in the order in which the symbols are shown, and every symbol by them."""
    values: Mapping[Index, Expr] = forms.values["christoffel"]
    order = _as_shown(values)
    namer = _Namer(lambda value: inertias.put(forms.of(value)), [values[key] for key in order], free)
    symbols = {key: namer.written(values[key]) for key in order}
    return tuple(namer.definitions), {key: symbols[key] for key in values}


class _Namer:
    """Gives a name to each symbol worth one; what has another one as factor or part is written by that."""

    def __init__(
        self, form: Callable[[Expr], Node], values: Sequence[Expr], names: Iterator[tree.Symbol]
    ) -> None:
        self.forms: dict[Expr, Node] = {}
        for value in values:
            if value not in self.forms and -value not in self.forms:
                self.forms[value] = form(value)
        self.definitions: list[Definition] = []
        self._names = names
        self._done: dict[Expr, Node] = {}

    def written(self, value: Expr) -> Node:
        """A symbol by its name, by that of another one, or as it is."""
        if value not in self.forms:
            return total([negated(self.written(-value))])
        found = self._done.get(value)
        if found is None:
            form = self.forms[value]
            found = form if cost(form) < SHORTEST else self._multiple(value) or self._named(self._sum(form))
            self._done[value] = found
        return found

    def _named(self, form: Node) -> Node:
        minus = _starts_with_minus(form)
        name = next(self._names)
        self.definitions.append(Definition(name, total([negated(form)]) if minus else form))
        return Negative(name) if minus else name

    def _multiple(self, value: Expr) -> Node | None:
        """The symbol as a product in which another one, worth a name, is a factor."""
        sign, inner = split_sign(self.forms[value])
        factors = Counter(_factors(inner))
        for other, form in self.forms.items():
            other_sign, part = split_sign(form)
            own = Counter(_factors(part))
            if cost(part) >= SHORTEST and own < factors:
                rest = [(factor, 1) for factor in (factors - own).elements()]
                return times(sign * other_sign, [(self.written(other), 1), *rest])
        return None

    def _sum(self, form: Node) -> Node:
        """A sum in which all terms of another symbol's stand, with the name of that in their place."""
        terms = _summands(form)
        for other, part in self.forms.items():
            for sign in (1, -1):
                own = _summands(part) if sign > 0 else tuple(map(negated, _summands(part)))
                if 1 < len(own) < len(terms) and set(own) <= set(terms):
                    rest = [term for term in terms if term not in own]
                    return total([*rest, times(sign, [(self.written(other), 1)])])
        return form


def _summands(node: Node) -> tuple[Node, ...]:
    return node.terms if isinstance(node, Sum) else (node,)


def _factors(node: Node) -> tuple[Node, ...]:
    return flat_factors(node) if isinstance(node, tree.Product) else (node,)


def _starts_with_minus(node: Node) -> bool:
    """Whether a form starts with a minus: of a sum, that every term has one."""
    return isinstance(node.terms[0] if isinstance(node, Sum) else node, Negative)
