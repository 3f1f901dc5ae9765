"""Angles as linear forms, exact: Σ rᵢ·atomᵢ + degrees.

An atom is a monomial of names, `(("theta1", 1),)` for the coordinate θ₁ and
`(("L", -1), ("s", 1))` for the quotient s/L; rᵢ are rational.  An angle that is a
product of coordinates is an atom too, so that nothing is refused for its form.

The symbols, angles, roots and denominators that a ring needs for given formulas.

A basis of angles: independent linear forms such that every given form is an integer combination of them.

θ₁ and θ₁ + θ₂ are such a basis of themselves; θ₁/2 is one of θ₁ and 3θ₁/2.  An angle is
a vector of rational rates here; the eliminations are FLINT's.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from fractions import Fraction
from math import lcm, pi, prod
from typing import Self

from flint import fmpq_mat, fmpz_mat
from msgspec import Struct

from dynsolve.algebra.rationals import fraction, rational, rational_value
from dynsolve.errors import AlgebraError
from dynsolve.notation.build import negated, times, total
from dynsolve.notation.tree import (
    Degrees,
    Function,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    children,
)

Atom = tuple[tuple[str, int], ...]
"""A monomial: names with their exponents, sorted by name."""

_Laurent = dict[Atom, Fraction]
"""A polynomial in names and their inverses; π counts as the name `pi`."""

_DEGREES_PER_PI = 180
_PI: Atom = (("pi", 1),)


class Angle(Struct, frozen=True):
    """Σ rᵢ·atomᵢ + degrees, the atoms sorted.

    >>> from dynsolve.notation.tree import Symbol, Sum, Degrees
    >>> angle_from_tree(Sum((Symbol("theta1"), Degrees(90)))) - Angle.of("theta1")
    Angle(terms=(), degrees=Fraction(90, 1))
    """

    terms: tuple[tuple[Atom, Fraction], ...] = ()
    degrees: Fraction = Fraction(0)

    @staticmethod
    def zero() -> Angle:
        """The angle 0."""
        return Angle()

    @staticmethod
    def of(name: str, rate: Fraction | int = 1) -> Angle:
        """The angle rate·name."""
        return Angle((((((name, 1),)), Fraction(rate)),)) if rate else Angle()

    def radians(self, values: Mapping[str, float]) -> float:
        """Its size where these are the values of its symbols."""
        size = float(self.degrees / _DEGREES_PER_PI) * pi
        for atom, rate in self.terms:
            size += float(rate) * prod(values[name] ** exponent for name, exponent in atom)
        return size

    def __add__(self, other: Angle) -> Angle:
        total = dict(self.terms)
        for atom, rate in other.terms:
            total[atom] = total.get(atom, Fraction(0)) + rate
        return _angle(total, self.degrees + other.degrees)

    def __neg__(self) -> Angle:
        return self * Fraction(-1)

    def __sub__(self, other: Angle) -> Angle:
        return self + -other

    def __mul__(self, factor: Fraction | int) -> Angle:
        return _angle({atom: rate * factor for atom, rate in self.terms}, self.degrees * factor)

    @property
    def linear(self) -> Angle:
        """The angle without its constant degrees."""
        return Angle(self.terms)

    @property
    def is_constant(self) -> bool:
        """Whether the angle is a number of degrees and nothing else."""
        return not self.terms


def name_alone(atom: Atom) -> str:
    """The name that an atom is; '' of x/r, of a number of radians, of any other."""
    return atom[0][0] if len(atom) == 1 and atom[0][1] == 1 else ""


def _angle(terms: _Laurent, degrees: Fraction) -> Angle:
    return Angle(tuple(sorted((a, r) for a, r in terms.items() if r)), Fraction(degrees))


def angle_from_tree(node: Node, *, radians: bool = False) -> Angle:
    """Read a tree as an angle: `theta1 + 90deg`, `pi/6 - beta/2`, `p2 - p1`.

    With `radians`, a bare number counts them: it is the atom `()` times that number.
    Raises AlgebraError for a bare number (90 for 90deg), for a function or a sum
    in a denominator inside an angle.
    """
    terms = _laurent(node)
    degrees = terms.pop(_PI, Fraction(0)) * _DEGREES_PER_PI
    bare = Fraction(0) if radians else terms.pop((), Fraction(0))
    if bare:
        raise AlgebraError(
            f"the bare number {bare} stands as an angle",
            f"did you mean {bare}deg? Angles are written in degrees (90deg) or with pi (pi/2)",
        )
    return _angle(terms, degrees)


def _laurent(node: Node) -> _Laurent:
    match node:
        case Number(p, q):
            return {(): Fraction(p, q)} if p else {}
        case Degrees(p, q):
            return {_PI: Fraction(p, q * _DEGREES_PER_PI)} if p else {}
        case Symbol(name, 0):
            return {((name, 1),): Fraction(1)}
        case Negative(argument):
            return {atom: -rate for atom, rate in _laurent(argument).items()}
        case Parenthesized(argument):
            return _laurent(argument)
        case Sum(terms):
            total: _Laurent = {}
            for term in terms:
                for atom, rate in _laurent(term).items():
                    total[atom] = total.get(atom, Fraction(0)) + rate
            return {atom: rate for atom, rate in total.items() if rate}
        case Product(factors):
            product: _Laurent = {(): Fraction(1)}
            for factor in factors:
                product = _times(product, _laurent(factor))
            return product
        case Quotient(numerator, denominator):
            return _times(_laurent(numerator), _inverse(_laurent(denominator)))
        case Power(base, Number(p, 1)):
            return _power(_laurent(base), p)
        case Power(base, Negative(Number(p, 1))):
            return _power(_inverse(_laurent(base)), p)
    raise AlgebraError(
        "an angle must be a sum of names and degrees", "name the angle with a symbol of its own"
    )


def _times(left: _Laurent, right: _Laurent) -> _Laurent:
    total: _Laurent = {}
    for a, ra in left.items():
        for b, rb in right.items():
            exponents = dict(a)
            for name, exponent in b:
                exponents[name] = exponents.get(name, 0) + exponent
            atom = tuple(sorted((n, e) for n, e in exponents.items() if e))
            total[atom] = total.get(atom, Fraction(0)) + ra * rb
    return {atom: rate for atom, rate in total.items() if rate}


def _inverse(terms: _Laurent) -> _Laurent:
    if len(terms) != 1:
        raise AlgebraError(
            "an angle is divided by a sum, or by zero", "name the angle with a symbol of its own"
        )
    ((atom, rate),) = terms.items()
    return {tuple((name, -exponent) for name, exponent in atom): 1 / rate}


_MOST_TERMS = 1000


def _power(terms: _Laurent, exponent: int) -> _Laurent:
    product: _Laurent = {(): Fraction(1)}
    for _ in range(exponent):
        product = _times(product, terms)
        if len(product) > _MOST_TERMS:
            raise AlgebraError("an angle has too many terms", "name the angle with a symbol of its own")
    return product


def names_of(angle: Angle) -> Iterator[str]:
    """The names that occur in an angle."""
    for atom, _ in angle.terms:
        for name, _ in atom:
            yield name


def angle_node(angle: Angle, coordinates: Sequence[str] = ()) -> Node:
    """An angle as a tree: θ₁ + θ₂, 2θ₂ - β/2, coordinates before symbols and positive terms first."""
    moving: dict[Atom, int] = {((name, 1),): i for i, name in enumerate(coordinates)}
    ordered = sorted(angle.terms, key=lambda term: (moving.get(term[0], len(moving)), term[0]))
    terms = [times(rate, [(Symbol(name), e) for name, e in atom]) for atom, rate in ordered]
    if angle.degrees:
        constant = Degrees(abs(angle.degrees.numerator), angle.degrees.denominator)
        terms.append(negated(constant) if angle.degrees < 0 else constant)
    return total(terms)


def in_degrees(value: Node, coordinates: Sequence[str] = ()) -> Node:
    """90° for π/2, as angles are given, and q₁ - 90° beside coordinates; all else as it is."""
    with suppress(AlgebraError):
        angle = angle_from_tree(value)
        is_turned = {*coordinates}.issuperset(names_of(angle)) and all(
            len(atom) == 1 for atom, _ in angle.terms
        )
        return angle_node(angle, coordinates) if angle.degrees and is_turned else value
    return value


# The symbols, angles, roots and denominators that a ring needs for given formulas


class Contents(Struct, frozen=True):
    """What occurs in some formulas, each once, in order of first appearance.

    `angles` are those whose sine or cosine occurs, `radicands` the numbers under a root,
    `roots` the formulas under one (an inner root before the outer), `denominators` those
    that are no numbers, `functions` those whose argument is no angle and no radicand: each
    is a generator of its own.
    """

    symbols: tuple[str, ...] = ()
    angles: tuple[Angle, ...] = ()
    radicands: tuple[Fraction, ...] = ()
    roots: tuple[Node, ...] = ()
    denominators: tuple[Node, ...] = ()
    functions: tuple[Function, ...] = ()

    def __bool__(self) -> bool:
        """Whether there is anything in it."""
        return any(getattr(self, f) for f in self.__struct_fields__)

    def joined(self, other: Self) -> Self:
        """The union of two contents."""
        pairs = ((f, getattr(self, f), getattr(other, f)) for f in self.__struct_fields__)
        return type(self)(**{name: tuple(dict.fromkeys((*a, *b))) for name, a, b in pairs})


class ContentsCollector:
    """Walks trees and notes what they hold; a subclass may leave out what is known, or take more."""

    def __init__(self) -> None:
        self.symbols: dict[str, None] = {}
        self.angles: dict[Angle, None] = {}
        self.radicands: dict[Fraction, None] = {}
        self.roots: dict[Node, None] = {}
        self.denominators: dict[Node, None] = {}
        self.functions: dict[Function, None] = {}

    def collect(self, trees: Iterable[Node]) -> None:
        """Note the contents of trees.  Raises AlgebraError for a formula that no ring can hold."""
        waiting = [*trees][::-1]
        while waiting:
            waiting.extend(reversed(self.note(waiting.pop())))

    @property
    def contents(self) -> Contents:
        """The contents noted so far."""
        return Contents(
            tuple(self.symbols),
            tuple(self.angles),
            tuple(self.radicands),
            tuple(self.roots),
            tuple(self.denominators),
            tuple(self.functions),
        )

    def note(self, node: Node) -> Sequence[Node]:
        """Note one node, and return the parts that are still to be walked."""
        match node:
            case Symbol(name, dots):
                self.symbol(name, dots)
                return ()
            case Degrees():
                self.symbols.setdefault("pi")
                return ()
            case Quotient(numerator, denominator):
                if rational_value(denominator) is None:
                    self.denominators.setdefault(denominator)
                return numerator, denominator
            case Power(base, exponent):
                if isinstance(exponent, Negative) and rational_value(base) is None:
                    self.denominators.setdefault(base)
                return (base,)
            case Function("sqrt", argument):
                self.root(node, argument)
                return ()
            case Function():
                return self.function(node)
        return children(node)

    def symbol(self, name: str, dots: int) -> None:
        """Note a symbol; the derivatives of coordinates come with them."""
        if not dots:
            self.symbols.setdefault(name)

    def function(self, node: Function) -> Sequence[Node]:
        """Note a function of an angle, and return the parts that are still to be walked."""
        if node.name == "sgn":
            self.functions.setdefault(node)
            return ()
        self.angle(angle_from_tree(node.argument))
        if node.name == "tan":
            self.denominators.setdefault(Function("cos", node.argument))
        return ()

    def angle(self, angle: Angle) -> None:
        """Note an angle with the names in it; the slope of x/h has h below."""
        self.angles.setdefault(angle)
        for atom, _ in angle.terms:
            for name, exponent in atom:
                self.symbols.setdefault(name)
                if exponent < 0:
                    self.denominators.setdefault(Symbol(name))

    def root(self, node: Function, argument: Node) -> None:
        """Note a root, after those inside it."""
        value = rational_value(argument)
        if value is None:
            self.collect([argument])
            self.roots.setdefault(argument)
        elif value < 0:
            raise AlgebraError("the root of a negative number", "lengths and masses are real")
        else:
            self.radicands.setdefault(value)


# A basis of angles

Vector = tuple[Fraction, ...]


def coordinates_in(
    basis: Sequence[Sequence[int | Fraction]], vector: Sequence[int | Fraction]
) -> tuple[Fraction, ...] | None:
    """The coefficients of `vector` in a `basis`; None outside its span, or where it is no basis.

    >>> basis = [(Fraction(1), Fraction(0)), (Fraction(1), Fraction(1))]
    >>> coordinates_in(basis, (Fraction(0), Fraction(2)))
    (Fraction(-2, 1), Fraction(2, 1))
    """
    if not basis:
        return None if any(vector) else ()
    last = len(basis) - 1
    columns = [*basis, vector]
    echelon, rank = fmpq_mat([[rational(v[i]) for v in columns] for i in range(len(vector))]).rref()
    if rank != len(basis) or not echelon[last, last]:
        return None
    return tuple(fraction(echelon[j, len(basis)]) for j in range(len(basis)))


def integer_basis(vectors: Sequence[Vector]) -> list[Vector]:
    """Independent vectors whose integer combinations are exactly those of `vectors`.

    The given vectors are kept as long as they serve, in their order, so that the
    caller chooses the basis by what it names first.

    >>> half = Fraction(1, 2)
    >>> integer_basis([(Fraction(1),), (half,)])
    [(Fraction(1, 2),)]
    """
    basis: list[Vector] = []
    for vector in vectors:
        if not any(vector):
            continue
        found = coordinates_in(basis, vector)
        if found is None:
            basis.append(vector)
        elif any(c.denominator != 1 for c in found):
            basis = _hermite([*basis, vector])
    return basis


def _hermite(vectors: Sequence[Vector]) -> list[Vector]:
    """The rows of Hermite's normal form of dependent vectors, over a common denominator."""
    scale = lcm(*(x.denominator for v in vectors for x in v))
    rows = fmpz_mat([[int(x * scale) for x in v] for v in vectors]).hnf().tolist()
    return [tuple(Fraction(int(x), scale) for x in row) for row in rows if any(row)]
