"""Long results in names: constants, recurring terms, then D, the Christoffel symbols, C and g in these.

An explicit model of a six-joint arm is read as Armstrong, Khatib and Burdick wrote
theirs (The explicit dynamic model and inertial parameters of the PUMA 560 arm, ICRA
1986): inertial constants are defined once, and every entry is a short sum of products
of sines, cosines and these.

1. The inertial constants are the base parameters (`explain.base_parameters`), named
   κ₁, κ₂, ...: J, I and K, letters that books use for them, mean the Jacobian, a tensor
   and the energy here.
2. What then recurs is named σ₁, σ₂, ... (`explain.recurring`).

A short model needs no constants; unless names are asked for, `explain.named_steps` says what has some.
What recurs in it gets a name alone; if that is one term, it is the books' h:
h = -m₂ l₁ l_c2 s₂ of the planar elbow.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from functools import partial
from itertools import count
from typing import TYPE_CHECKING

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.expr import Expr
from dynsolve.derivation.vectorized import christoffel_symbols
from dynsolve.explain.forms import Forms, coriolis_matrix, is_numeric, pairs
from dynsolve.explain.parameters import BaseParameters
from dynsolve.explain.recurring import Definition, name_recurring, rewritten
from dynsolve.explain.working.differentiation import product_of
from dynsolve.notation import tree
from dynsolve.notation.build import cost, negated, split_sign, times, total
from dynsolve.notation.printing import flat_factors
from dynsolve.notation.tree import Function, Negative, Node, Number, Product, Quotient, Sum, Symbol
from dynsolve.notation.walk import with_children

if TYPE_CHECKING:
    from dynsolve.explain.names import InertiaNames

__all__ = ["Abbreviate", "Abbreviated", "Definition", "abbreviate", "is_long"]

LONG = 1500
"""The operations in D, C and g together from which on names make them readable: some five pages."""

CONSTANT, RECURRING, SINGLE = "kappa", "sigma", "h"

CONSTANTS_LIST, SUMS_LIST = "constants", "recurring"
"""What the two lists of names are called where others refer to them."""

Index = tuple[int, int, int]


def as_shown(indices: Iterable[Index]) -> list[Index]:
    """The indices of Christoffel symbols in the order in which these are shown."""
    return sorted(indices, key=lambda ijk: (ijk[2], ijk[0], ijk[1]))


class Abbreviate(StrEnum):
    """Whether long results are written with names."""

    AUTO = "auto"
    NEVER = "never"
    ALWAYS = "always"


@dataclass(frozen=True, slots=True)
class Abbreviated:
    """Definitions in the order in which they build on each other, and the forms that use them.

    `D`, `C` and `g` are matrices, `christoffel` holds c_ijk at (i, j, k) with i ≤ j and from 0.
    `kept` are the base parameters that are a symbol of the problem already, and need no name.
    A `long` model is one whose constants have names, or would have if they were no numbers; `P` is its
    potential energy.
    With `at_symbols` the names are those of Christoffel symbols (`explain.symbol_names`), after those of
    `inertias`, from the kinetic energy on (`explain.inertia_names`).
    """

    constants: tuple[Definition, ...]
    sums: tuple[Definition, ...]
    D: tree.Matrix
    C: tree.Matrix
    g: tree.Matrix
    christoffel: Mapping[Index, Node]
    long: bool = False
    kept: tuple[Symbol, ...] = ()
    at_symbols: bool = False
    inertias: InertiaNames | None = None
    P: Node | None = None

    def symbol(self, i: int, j: int, k: int) -> Node:
        """c_ijk, the same as c_jik."""
        return self.christoffel[min(i, j), max(i, j), k]

    @property
    def definitions(self) -> tuple[Definition, ...]:
        """All definitions in order."""
        return (*self.constants, *self.sums)

    @property
    def of_symbols(self) -> tuple[Definition, ...]:
        """Those of Christoffel symbols, where they have names of their own."""
        early = () if self.inertias is None else self.inertias.definitions
        return self.sums[len(early) :] if self.at_symbols else ()

    @property
    def single(self) -> Definition | None:
        """h, where it is what all Christoffel symbols are but for sign."""
        return next((one for one in self.of_symbols if one.name == Symbol(SINGLE)), None)

    def put_symbols(self, node: Node) -> Node:
        """A tree with the names of symbols in the places of what they mean; not with h, which is a glance."""
        for one in self.of_symbols:
            node = node if one == self.single else Exchange.of(one).put(node)
        return node

    @property
    def lists(self) -> tuple[str, ...]:
        """The lists that there are of them."""
        return tuple(
            label for label, names in ((CONSTANTS_LIST, self.constants), (SUMS_LIST, self.sums)) if names
        )

    @property
    def cost(self) -> int:
        """The operations of everything that is printed but C: definitions, D, g, the c_ijk and P."""
        entries = [e for matrix in (self.D, self.g) for row in matrix.rows for e in row]
        potential = [] if self.P is None else [self.P]
        meanings = [d.meaning for d in self.definitions]
        return sum(map(cost, (*meanings, *entries, *self.christoffel.values(), *potential)))


def is_long(forms: Forms) -> bool:
    """Whether D, C and g written out are too long to be read."""
    known: dict[int, tuple[Node, int]] = {}
    size = 0
    for name in ("D", "C", "g"):
        matrix = forms(name)
        assert isinstance(matrix, tree.Matrix)
        size += sum(cost(entry, known) for row in matrix.rows for entry in row)
    return size > LONG


def abbreviate(forms: Forms, constants: bool | None = None) -> Abbreviated:
    """The explicit model of a robot, its constants and what recurs in it named.

    `constants` says whether the inertial constants get names; where it is not given,
    they do in a long model.
    """
    if constants is None:
        constants = is_long(forms)
    return _with_constants(forms) if constants else _without_constants(forms)


def _with_constants(forms: Forms) -> Abbreviated:
    robot, values = forms.robot, forms.values
    base = BaseParameters.of(robot, values["D"], values["g"], CONSTANT)
    leading, parallel = forms.collecting
    names = list(base.meanings)
    compactor = Compactor(
        base.ring, [*names, *leading], parallel, decimal=is_numeric(robot), angles_outside=True
    )
    D, g = base.matrix(values["D"]), base.matrix(values["g"])
    symbols = christoffel_symbols(robot, D)
    meanings = tuple(Definition(Symbol(name), forms.of(value)) for name, value in base.meanings.items())
    return _assembled(
        forms,
        meanings,
        compactor.matrix(D),
        compactor.matrix(g),
        _forms_of(symbols, compactor),
        kept=tuple(map(Symbol, base.kept)),
        potential=compactor.form(base.expr(values["P"])),
    )


def _forms_of(symbols: Mapping[Index, Expr], compactor: Compactor) -> dict[Index, Node]:
    """The trees of the symbols, half of which are others' or their opposites."""
    made: dict[Expr, Node] = {}
    for value in symbols.values():
        if value not in made:
            made[value] = negated(made[-value]) if -value in made else compactor.form(value)
    return {key: made[value] for key, value in symbols.items()}


def _without_constants(forms: Forms) -> Abbreviated:
    D, g = forms("D"), forms("g")
    assert isinstance(D, tree.Matrix) and isinstance(g, tree.Matrix)
    symbols = {(i, j, k): forms.christoffel(i, j, k) for i, j, k in forms.values["christoffel"]}
    return _assembled(forms, (), D, g, symbols)


def _assembled(
    forms: Forms,
    constants: tuple[Definition, ...],
    D: tree.Matrix,
    g: tree.Matrix,
    symbols: Mapping[Index, Node],
    kept: tuple[Symbol, ...] = (),
    potential: Node | None = None,
) -> Abbreviated:
    """The forms with names; the potential energy is that of a long model."""
    n, long = forms.robot.n, potential is not None
    upper = pairs(n)
    entries = [*(D.rows[i][j] for i, j in upper), *(row[0] for row in g.rows), *symbols.values()]
    entries += [] if potential is None else [potential]
    taken = {*forms.robot.ring.parameters, *forms.robot.ring.names}
    name = partial(name_recurring, entries, whole=long, decimal=is_numeric(forms.robot))
    sums, used = name(free_names(RECURRING, taken))
    if len(sums) == 1 and SINGLE not in taken:
        keys = list(symbols)
        places = [len(upper) + n + keys.index(key) for key in as_shown(keys)]
        sums, used = _leading_with_plus(*name(iter([Symbol(SINGLE)])), places)
    d = dict(zip(upper, used, strict=False))
    short = dict(zip(symbols, used[len(upper) + n :], strict=False))
    return Abbreviated(
        constants=constants,
        sums=sums,
        D=tree.Matrix(tuple(tuple(d[min(i, j), max(i, j)] for j in range(n)) for i in range(n))),
        C=coriolis_matrix(forms.robot.ring.names, lambda i, j, k: short[min(i, j), max(i, j), k]),
        g=tree.column(*used[len(upper) : len(upper) + n]),
        christoffel=short,
        long=long,
        kept=kept,
        P=used[-1] if long else None,
    )


def _leading_with_plus(
    definitions: tuple[Definition, ...], used: list[Node], symbols: Sequence[int]
) -> tuple[tuple[Definition, ...], list[Node]]:
    """The one name with the sign of its first Christoffel symbol, as the books' h = -m₂ l₁ l_c2 s₂ has it.

    `symbols` are the places of the symbols, in the order in which they are shown.
    """
    (definition,) = definitions
    minus = negated(definition.name)
    if next((used[k] for k in symbols if used[k] in (definition.name, minus)), None) != minus:
        return definitions, used

    def turned(node: Node) -> Node:
        return rewritten(node, lambda leaf: minus if leaf == definition.name else leaf)

    return (Definition(definition.name, negated(definition.meaning)),), [turned(node) for node in used]


def free_names(letter: str, taken: set[str]) -> Iterator[Symbol]:
    """letter1, letter2, ..., without names that the problem uses."""
    return (Symbol(f"{letter}{k}") for k in count(1) if f"{letter}{k}" not in taken)


# -- a part of formulas exchanged for its name, wherever it stands, with either sign ---------------

_Monomial = tuple[Fraction, Counter[Node]]
"""A number and factors, each with how often it stands above the line, or (negative) below."""


@dataclass(frozen=True, slots=True)
class Exchange:
    """A formula, and what stands in its place: of a sum also among more terms, of others among factors.

    >>> from dynsolve.notation.python import to_python
    >>> from dynsolve.notation.tree import Symbol
    >>> a, b, c, name = map(Symbol, "abcs")
    >>> to_python(Exchange(Sum((a, b)), name).put(Product((c, Sum((a, c, b))))))
    'c*(s + c)'
    >>> to_python(Exchange(Product((a, b)), name).put(Sum((c, Negative(Product((a, c, b)))))))
    'c - s*c'
    >>> to_python(Exchange(Quotient(a, Number(2)), name).put(Quotient(Product((a, b)), Number(4))))
    's*b/2'
    """

    meaning: Node
    name: Node

    @classmethod
    def of(cls, definition: Definition) -> Exchange:
        """The name of a definition for its meaning."""
        sign, meaning = split_sign(definition.meaning)
        return cls(meaning, definition.name if sign > 0 else Negative(definition.name))

    def put(self, node: Node) -> Node:
        """The tree with the name in the places of its meaning."""
        if isinstance(node, Function):  # no angle has a name
            return node
        if node == self.meaning:
            return self.name
        changed = with_children(node, self.put)
        match changed:
            case Negative(argument) if changed is not node:
                return negated(argument)
            case Sum() if isinstance(self.meaning, Sum):
                return self._in_sum(changed, self.meaning)
            case Product() | Quotient() if not isinstance(self.meaning, Sum):
                return self._in_product(changed)
            case Product(factors) if changed is not node and any(
                isinstance(factor, Product | Negative) for factor in factors
            ):
                return product_of(1, [(factor, 1) for factor in factors])
        return changed

    def _in_sum(self, node: Sum, meaning: Sum) -> Node:
        for own, name in (
            (set(meaning.terms), self.name),
            (set(map(negated, meaning.terms)), negated(self.name)),
        ):
            if own <= set(node.terms):
                place = next(i for i, term in enumerate(node.terms) if term in own)
                rest = [term for term in node.terms if term not in own]
                before = sum(term not in own for term in node.terms[:place])
                return total([*rest[:before], name, *rest[before:]])
        return node

    def _in_product(self, node: Product | Quotient) -> Node:
        """What is left beside the name, where the meaning divides the node without a new fraction."""
        (own_number, own), (number, factors) = _monomial(self.meaning), _monomial(node)
        parts_out = all(abs(factors[part]) >= abs(n) and factors[part] * n > 0 for part, n in own.items())
        parts_out &= not (
            number.numerator % own_number.numerator or number.denominator % own_number.denominator
        )
        if not parts_out:
            return node
        factors.subtract(own)
        return times(number / own_number, [(self.name, 1), *((part, n) for part, n in factors.items() if n)])


def _monomial(node: Node) -> _Monomial:
    match node:
        case Number(p, q):
            return Fraction(p, q), Counter()
        case Negative(argument):
            number, factors = _monomial(argument)
            return -number, factors
        case Quotient(numerator, denominator):
            above, factors = _monomial(numerator)
            below, others = _monomial(denominator)
            factors.subtract(others)
            return above / below, factors
        case Product():
            number, factors = Fraction(1), Counter[Node]()
            for part in flat_factors(node):
                own, its = _monomial(part)
                number *= own
                factors.update(its)
            return number, factors
    return Fraction(1), Counter([node])
