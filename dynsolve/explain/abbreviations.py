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

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from enum import StrEnum
from fractions import Fraction
from functools import partial
from itertools import count

from msgspec import Struct, field

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.ring_values import value_of
from dynsolve.derivation.euler_lagrange import christoffel_symbols
from dynsolve.explain.context import is_short
from dynsolve.explain.entry_formulas import (
    collected_coriolis_force,
    coriolis_matrix,
    forms_of_long_model,
    pairs,
)
from dynsolve.explain.forms import Forms, is_numeric
from dynsolve.explain.recurring import Definition, exchanged, expanded, name_recurring, rewritten
from dynsolve.explain.working.differentiation import by_symbol, differentiated, product_of
from dynsolve.notation import tree
from dynsolve.notation.build import cost, negated, split_sign, summands, times, total
from dynsolve.notation.printing import flat_factors
from dynsolve.notation.tree import (
    ZERO,
    Function,
    Matrix,
    Negative,
    Node,
    Number,
    Product,
    Quotient,
    Relation,
    Sum,
    Symbol,
    children,
    equation,
    walk,
    with_children,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage

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
    With `inertias`, names from the kinetic energy on, the others are those of Christoffel symbols.
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
    inertias: InertiaNames | None = None
    P: Node | None = None
    forms: Mapping[str, Node] = field(default_factory=dict)

    @property
    def at_symbols(self) -> bool:
        """Whether the names are introduced where they are met, those of Christoffel symbols the last."""
        return self.inertias is not None

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
        return () if self.inertias is None else self.sums[len(self.inertias.definitions) :]

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
        return (CONSTANTS_LIST,) * bool(self.constants) + (SUMS_LIST,) * bool(self.sums)


def is_long(forms: Forms) -> bool:
    """Whether D, C and g written out are too long to be read."""
    known: dict[int, tuple[Node, int]] = {}
    rows = (row for name in ("D", "C", "g") for row in forms.matrix(name).rows)
    return sum(cost(entry, known) for row in rows for entry in row) > LONG


def abbreviate(forms: Forms, constants: bool | None = None) -> Abbreviated:
    """The explicit model of a robot, its constants and what recurs in it named.

    `constants` says whether the inertial constants get names; where it is not given,
    they do in a long model.
    """
    BaseParameters = Stage.PARAMETERS.part("explain").BaseParameters

    values = forms.values
    if not (is_long(forms) if constants is None else constants):
        symbols = {key: forms.christoffel(*key) for key in values["christoffel"]}
        return _assembled(forms, (), forms.matrix("D"), forms.matrix("g"), symbols)
    base = BaseParameters.of(forms.robot, values["D"], values["g"], CONSTANT)
    leading, parallel = forms.collecting
    collected, decimal = [*base.meanings, *leading], is_numeric(forms.robot)
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
    taken = {*forms.robot.ring.parameters, *coordinates}
    name = partial(name_recurring, list(parts.values()), whole=long, decimal=is_numeric(forms.robot))
    sums, used = name(free_names(RECURRING, taken))
    if len(sums) == 1 and SINGLE not in taken:
        (one,), used = name(iter([Symbol(SINGLE)]))
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


def free_names(letter: str, taken: set[str]) -> Iterator[Symbol]:
    """letter1, letter2, ..., without names that the problem uses."""
    return (Symbol(f"{letter}{k}") for k in count(1) if f"{letter}{k}" not in taken)


# -- names for the moments of inertia that come up again and again, from the kinetic energy on: σ₁, σ₂, ...
# The kinetic energy of an arm with bodies of many parts has long sums of masses and lengths as factors:
#
#     m₂ (4l₂² - b²)/12 + m₃ ((d₃ - l₃/2)² + l₃²/12) + m₄ d₃²
#
# Each stands in L, in momenta, forces, D, C and the summary.  It is named where it is met first
# (`explain.named_steps`), with its derivative where a joint that slides changes it.

LEAST_SAVED_BY_SUMS = 80
"""The operations that a name saves in the energies, momenta, forces and D, at least: four lines of text."""

SHORTEST = 4
"""The operations from which on such a sum, or one in its derivative, is worth a name."""


# -- which sums get a name -------------------------------------------------------------------------


def name_inertias(forms: Forms, names: Iterator[Symbol]) -> InertiaNames:
    """Names for the sums by which LEAST_SAVED_BY_SUMS operations are saved; none of robots in numbers."""
    robot = forms.robot
    if is_numeric(robot):
        return InertiaNames()
    of_coordinates = (
        f"{stem}{q.index}" for q in robot.coordinates for stem in ("dLdqd", "ddt", "dLdq", "tau")
    )
    counted = (name for name in ("K", "D", "Cqd", *of_coordinates) if name in forms.values.rules)
    trees = [forms(name) for name in counted]
    found: list[Definition] = []
    while (best := _worth_a_name(trees)) is not None:
        found.append(Definition(next(names), best))
        trees = [Exchange.of(found[-1]).put(node) for node in trees]
    return _with_slopes(forms, found, names)


def _worth_a_name(trees: Iterable[Node]) -> Sum | None:
    """The sum without sines and rates by which most operations are saved."""
    uses = Counter(part for tree in trees for part in _sums(tree) if not _moves(part))
    saved = {part: (count - 1) * cost(part) for part, count in uses.items() if cost(part) >= SHORTEST}
    best = max(saved, key=lambda part: saved[part], default=None)
    return None if best is None or saved[best] < LEAST_SAVED_BY_SUMS else best


def _sums(node: Node) -> Iterator[Sum]:
    """The sums in a tree but those of angles."""
    if isinstance(node, Sum):
        yield node
    if not isinstance(node, Function):
        for part in children(node):
            yield from _sums(part)


def _moves(node: Node) -> bool:
    """Whether there are sines or rates in a tree, and not parameters and lengths alone."""
    return any(isinstance(part, Function) or (isinstance(part, Symbol) and part.dots) for part in walk(node))


def _with_slopes(forms: Forms, found: Sequence[Definition], names: Iterator[Symbol]) -> InertiaNames:
    """The names with their derivatives by the coordinates; sums in these have names too."""
    ring = forms.robot.ring
    slopes: list[tuple[Node, Symbol, Node, Node]] = []
    for one, meaning in zip(found, expanded(found, [one.name for one in found]), strict=True):
        value = value_of(ring, meaning)
        for k, by in enumerate(map(Symbol, ring.names)):
            if not (slope := ring.diff(value, k)).is_zero:
                in_letters = letters.partial_derivative(one.name, by)
                slopes.append((in_letters, by, differentiated(meaning, by_symbol(by)).tree, forms.of(slope)))
    sums = (part for *_, collected in slopes for part in walk(collected) if isinstance(part, Sum))
    long = (part for part in dict.fromkeys(sums) if cost(part) >= SHORTEST)
    definitions = (*found, *(Definition(name, part) for part, name in zip(long, names, strict=False)))
    named = InertiaNames(definitions, (), tuple(map(Exchange.of, definitions)))
    equal: dict[Node, list[Node]] = {}
    exchanges = list(named.exchanges)
    for name, by, termwise, collected in slopes:
        short, rate = named.put(collected), Symbol(by.name, 1)
        equal.setdefault(short, []).append(name)
        pairs = ((termwise, short), (_times(termwise, rate), _times(short, rate)))
        exchanges += [Exchange(written, form) for written, form in pairs if isinstance(written, Sum)]
    return InertiaNames(
        definitions,
        tuple(equation(*left, right) for right, left in equal.items()),
        tuple(exchanges),
        frozenset(ring.names.index(by.name) + 1 for _, by, _, _ in slopes),
    )


def _times(node: Node, rate: Symbol) -> Node:
    """The terms of a sum times a rate, as the chain rule has them."""
    return total([product_of(1, [(term, 1), (rate, 1)]) for term in summands(node)])


# -- names for what Christoffel symbols are: h of the planar elbow, or σ₁, σ₂,  --------------------
# Symbols are equal, or opposite, again and again: c_112 = -c_121.  Where all are one value but for its sign,
# that is the books' h (Spong, Hutchinson, Vidyasagar, section 7.4).  Otherwise they get names where C would
# fill half a page; C, Ḋ and N = Ḋ - 2C are then short sums of names and rates.
#
# What recurs in the energies already is named there, and the symbols are written by that.

LONG_CORIOLIS = 50
"""The operations of C from which on its symbols get names: it would not fit the page as a matrix."""


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

    def form(value: Expr) -> Node:
        return inertias.put(forms.of(value))

    values: Mapping[Index, Expr] = forms.values["christoffel"]
    order = [values[key] for key in as_shown(values)]
    definitions: Sequence[Definition] = ()
    made: dict[Expr, Node] = {}
    if SINGLE not in taken and _is_one_value(forms, values):
        first = next(value for value in order if not value.is_zero)  # it has a plus
        definitions = (Definition(Symbol(SINGLE), form(first)),)
        made = {first: Symbol(SINGLE), -first: Negative(Symbol(SINGLE)), robot.ring.zero: ZERO}
    elif sum(cost(inertias.put(entry)) for row in C.rows for entry in row) >= LONG_CORIOLIS:
        namer = _SymbolNames(form, order, free)
        made, definitions = {value: namer.written(value) for value in order}, namer.definitions
    symbols = {key: made[value] if made else form(value) for key, value in values.items()}
    sums = (*inertias.definitions, *definitions)
    if not sums:
        return None
    D, g = inertias.put(forms("D")), inertias.put(forms("g"))
    assert isinstance(D, Matrix) and isinstance(g, Matrix)
    C = coriolis_matrix(robot.ring.names, lambda i, j, k: symbols[min(i, j), max(i, j), k])
    return Abbreviated((), sums, D, C, g, symbols, inertias=inertias)


def _is_one_value(forms: Forms, symbols: Mapping[Index, Expr]) -> bool:
    """Whether several symbols are not zero, all of them the same but for sign, and worth a name."""
    found = [value for value in symbols.values() if not value.is_zero]
    alike = all(value in (found[0], -found[0]) for value in found)
    return len(found) > 1 and alike and cost(forms.of(found[0])) >= SHORTEST


class _SymbolNames:
    """Gives a name to each symbol worth one; what has another one as factor or part is written by that."""

    def __init__(self, form: Callable[[Expr], Node], values: Sequence[Expr], names: Iterator[Symbol]) -> None:
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
        minus = isinstance(summands(form)[0], Negative)  # of a sum, that every term has one
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
        terms = summands(form)
        for other, part in self.forms.items():
            for sign in (1, -1):
                own = summands(part) if sign > 0 else tuple(map(negated, summands(part)))
                if 1 < len(own) < len(terms) and set(own) <= set(terms):
                    rest = [term for term in terms if term not in own]
                    return total([*rest, times(sign, [(self.written(other), 1)])])
        return form


def _factors(node: Node) -> tuple[Node, ...]:
    return flat_factors(node) if isinstance(node, Product) else (node,)
