"""Long results in names: constants, recurring terms, then D, the Christoffel symbols, C and g in these.

An explicit model of a six-joint arm is read as Armstrong, Khatib and Burdick wrote
theirs (The explicit dynamic model and inertial parameters of the PUMA 560 arm, ICRA
1986): inertial constants are defined once, and every entry is a short sum of products
of sines, cosines and these.

1. The inertial constants are the base parameters (`questions.parameters.explain`), named
   κ₁, κ₂, ...: J, I and K, letters that books use for them, mean the Jacobian, a tensor
   and the energy here.
2. What then recurs is named σ₁, σ₂, ... (`explain.recurring`).

A short model needs no constants.  What recurs in it gets a name alone; if that is one term, it is the
books' h: h = -m₂ l₁ l_c2 s₂ of the planar elbow.  Unless names are asked for, a short model has some for
moments of inertia and Christoffel symbols alone (`name_symbols`).
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from collections.abc import Set as AbstractSet
from enum import StrEnum
from fractions import Fraction
from functools import partial
from itertools import count

from msgspec import Struct, field

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.ring import Expr
from dynsolve.derivation.euler_lagrange import christoffel_symbols
from dynsolve.explain.entry_formulas import (
    collected_coriolis_force,
    coriolis_matrix,
    forms_of_long_model,
    pairs,
)
from dynsolve.explain.forms import Forms
from dynsolve.explain.recurring import Definition, exchanged, name_recurring, rewritten
from dynsolve.notation import tree
from dynsolve.notation.build import negated, split_sign, times, total
from dynsolve.notation.differentiation import product_of
from dynsolve.notation.printing import flat_factors
from dynsolve.notation.tree import (
    Function,
    Negative,
    Node,
    Number,
    Product,
    Quotient,
    Relation,
    Sum,
    Symbol,
    with_children,
)
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Robot
from dynsolve.robot.names import names_taken

__all__ = ["Abbreviate", "Abbreviated", "Definition", "abbreviate"]

CONSTANT, RECURRING, SINGLE = "kappa", "sigma", ("h", "kappa", "chi")

CONSTANTS_LIST, SUMS_LIST = "constants", "recurring"
"""What the two lists of names are called where others refer to them."""

WITH_RATES = re.compile(r"ddt\d+|dLdq\d+|tau\d+|Cqd")
"""The results in which Christoffel symbols stand beside products of rates."""

Index = tuple[int, int, int]


def as_shown(indices: Iterable[Index]) -> list[Index]:
    """The indices of Christoffel symbols in the order in which these are shown."""
    return sorted(indices, key=lambda ijk: (ijk[2], ijk[0], ijk[1]))


class Abbreviate(StrEnum):
    """Whether long results are written with names."""

    AUTO = "auto"
    NEVER = "never"
    ALWAYS = "always"


# -- a part of formulas exchanged for its name, wherever it stands, with either sign ---------------

_Monomial = tuple[Fraction, Counter[Node]]
"""A number and factors, each with how often it stands above the line, or (negative) below."""


class Exchange(Struct, frozen=True):
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
        for own, name in ((meaning.terms, self.name), (map(negated, meaning.terms), negated(self.name))):
            part = set(own)
            if part <= set(node.terms):
                return total(exchanged(node.terms, part, name))
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


# -- the model in names ----------------------------------------------------------------------------


class InertiaNames(Struct, frozen=True):
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


class Abbreviated(Struct, frozen=True):
    """Definitions in the order in which they build on each other, and the forms that use them.

    `D`, `C` and `g` are matrices, `christoffel` holds c_ijk at (i, j, k) with i ≤ j and from 0.
    `kept` are the base parameters that are a symbol of the problem already, and need no name.
    A `long` model is one whose constants have names, or would have if they were no numbers; `P` is its
    potential energy.
    Names `at_symbols` are introduced where they are met: those of `inertias` from the kinetic energy on, the
    others are those of Christoffel symbols.
    `forms` are the results of steps as they are written with the names, by the names of the quantities.
    """

    constants: tuple[Definition, ...]
    sums: tuple[Definition, ...]
    D: tree.Matrix
    C: tree.Matrix
    g: tree.Matrix
    christoffel: Mapping[Index, Node]
    long: bool = False
    kept: tuple[Symbol, ...] = ()
    inertias: InertiaNames = InertiaNames()
    at_symbols: bool = False
    P: Node | None = None
    forms: Mapping[str, Node] = field(default_factory=dict)

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
        return self.sums[len(self.inertias.definitions) :] if self.at_symbols else ()

    @property
    def single(self) -> Definition | None:
        """h, where it is what all Christoffel symbols are but for sign."""
        return next((one for one in self.of_symbols if one.name.name in SINGLE), None)

    @property
    def symbols(self) -> frozenset[Node]:
        """The names of sums and symbols."""
        return frozenset(one.name for one in self.sums)

    @property
    def lists(self) -> tuple[str, ...]:
        """The lists that there are of them."""
        return (CONSTANTS_LIST,) * bool(self.constants) + (SUMS_LIST,) * bool(self.sums)


def symbols_put(symbols: Iterable[Definition], node: Node) -> Node:
    """A tree with the names of symbols in the places of what they mean; not with h, which is a glance."""
    for one in symbols:
        node = node if one.name.name in SINGLE else Exchange.of(one).put(node)
    return node


def abbreviate(forms: Forms, constants: bool | None = None) -> Abbreviated:
    """The explicit model of a robot, its constants and what recurs in it named.

    `constants` says whether the inertial constants get names; where it is not given,
    they do in a long model.
    """
    BaseParameters = Stage.PARAMETERS.part("explain").BaseParameters

    values = forms.values
    if not (forms.are_long if constants is None else constants):
        symbols = {key: forms.christoffel(*key) for key in values["christoffel"]}
        return _assembled(forms, (), forms.matrix("D"), forms.matrix("g"), symbols)
    base = BaseParameters.of(forms.robot, values["D"], values["g"], CONSTANT)
    leading, parallel = forms.collecting
    collected, decimal = [*base.meanings, *leading], forms.robot.has_decimals
    compactor = Compactor(base.ring, collected, parallel, decimal=decimal, angles_outside=True)
    inertia = base.matrix(values["D"])
    return _assembled(
        forms,
        tuple(Definition(Symbol(name), forms.of(value)) for name, value in base.meanings.items()),
        compactor.matrix(inertia),
        compactor.matrix(base.matrix(values["g"])),
        _forms_of(christoffel_symbols(forms.robot, inertia), compactor),
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
    n, coordinates, long = forms.robot.n, forms.robot.ring.names, potential is not None
    parts: dict[tuple[str | int, ...], Node] = {("d", i, j): D.rows[i][j] for i, j in pairs(n)}
    parts |= {("g", k): entry for k, (entry,) in enumerate(g.rows)}
    parts |= {("c", *ijk): symbol for ijk, symbol in symbols.items()}
    if potential is not None:
        parts["P",] = potential
    taken = short_names_taken(forms.robot)
    name = partial(name_recurring, list(parts.values()), whole=long, decimal=forms.robot.has_decimals)
    sums, used = name(free_names(RECURRING, taken))
    if len(sums) == 1 and (single := free_single(taken)):
        (one,), used = name(iter([single]))
        minus, written = negated(one.name), dict(zip(parts, used, strict=True))
        shown = [written["c", *ijk] for ijk in as_shown(symbols)]
        if next((each for each in shown if each in (one.name, minus)), None) == minus:
            # the sign of the first symbol, as the books' h = -m₂ l₁ l_c2 s₂ has it
            one = Definition(one.name, negated(one.meaning))
            used = [rewritten(node, lambda leaf: minus if leaf == one.name else leaf) for node in used]
        sums = (one,)
    short = dict(zip(parts, used, strict=True))

    def c(i: int, j: int, k: int) -> Node:
        return short["c", min(i, j), max(i, j), k]

    D = tree.Matrix(tuple(tuple(short["d", min(i, j), max(i, j)] for j in range(n)) for i in range(n)))
    C, g = coriolis_matrix(coordinates, c), tree.column(*(short["g", k] for k in range(n)))
    of_long = forms_of_long_model(forms.robot, forms.values) if long else {}
    Cqd = tree.column(*(collected_coriolis_force(coordinates, c, k) for k in range(n)))
    return Abbreviated(
        constants,
        sums,
        D=D,
        C=C,
        g=g,
        christoffel={ijk: short["c", *ijk] for ijk in symbols},
        long=long,
        kept=kept,
        P=short.get(("P",)),
        forms={"D": D, "C": C, "g": g, "Cqd": Cqd, **of_long},
    )


def short_names_taken(robot: Robot) -> frozenset[str]:
    """What already means something: parameters, coordinates, bodies, and h where constraints are h = 0."""
    own = {"h"} if robot.questions.constraints else set()
    return names_taken(robot).union((body.name for body in robot.bodies), own)


def free_single(taken: AbstractSet[str]) -> Symbol | None:
    """h, or what stands in for it where the problem has an h."""
    return next((Symbol(name) for name in SINGLE if name not in taken), None)


def free_names(letter: str, taken: AbstractSet[str]) -> Iterator[Symbol]:
    """letter1, letter2, ..., without names that the problem uses."""
    return (Symbol(f"{letter}{k}") for k in count(1) if f"{letter}{k}" not in taken)
