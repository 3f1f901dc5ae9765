"""Small constructors of notation trees, and the cost of a tree to its reader.

The cost of a formula is what a person counts in it: every + - * /, power, sign
and function call.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from math import gcd, prod

from dynsolve.notation.tree import (
    ONE,
    ZERO,
    Arguments,
    Degrees,
    Function,
    Letter,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
)


def cost(node: Node, known: dict[int, tuple[Node, int]] | None = None) -> int:
    """The operations of a formula as it is printed.

    `known` keeps the counts of shared parts from call to call, by identity.

    >>> square = Power(Symbol("l"), Number(2))
    >>> cost(Sum((Product((Symbol("m"), square)), Negative(Function("cos", Symbol("q"))))))
    4
    """
    known = {} if known is None else known
    match node:
        case Letter() | Symbol() | Number(_, 1):
            return 0
        case Number():
            return 1
    found = known.get(id(node))
    if found is None:
        found = known[id(node)] = (node, _count(node, known))
    return found[1]


def _count(node: Node, known: dict[int, tuple[Node, int]]) -> int:
    match node:
        case Sum(terms):
            inner = sum(cost(t.argument if isinstance(t, Negative) else t, known) for t in terms)
            return inner + len(terms) - 1 + isinstance(terms[0], Negative)
        case Product(factors):
            return sum(cost(f, known) for f in factors) + len(factors) - 1
        case Power(left, right) | Quotient(left, right):
            return cost(left, known) + cost(right, known) + 1
        case Arguments(parts):
            return sum(cost(part, known) for part in parts)
        case Negative(argument) | Function(_, argument):
            return cost(argument, known) + 1
        case Parenthesized(inner):
            return cost(inner, known)
        case Degrees():
            return 0
    raise TypeError(f"no cost for {type(node).__name__}")


def power(base: Node, exponent: int) -> Node:
    """base^exponent, exponent ≥ 1."""
    return base if exponent == 1 else Power(base, Number(exponent))


def split_sign(node: Node) -> tuple[int, Node]:
    """(±1, the tree without its leading sign)"""
    return (-1, node.argument) if isinstance(node, Negative) else (1, node)


def factors_of(node: Node) -> tuple[Node, ...]:
    """The factors of a product; anything else is its own one."""
    return node.factors if isinstance(node, Product) else (node,)


def summands(node: Node) -> tuple[Node, ...]:
    """The terms of a sum; anything else is its own one."""
    return node.terms if isinstance(node, Sum) else (node,)


def total(terms: Sequence[Node]) -> Node:
    """The sum of terms, flattened; it starts with a plus where that leaves accelerations in order.

    Terms with a minus at the front go behind positive ones that follow: ρ̇ - w q̇, I_yy s² + I_xx c² - I_zz.
    """
    flat: list[Node] = []
    for term in terms:
        sign, inner = split_sign(term)
        if isinstance(inner, Sum):
            flat.extend(inner.terms if sign > 0 else map(negated, inner.terms))
        elif inner != ZERO:
            flat.append(term)
    if not flat:
        return ZERO
    if len(flat) == 1:
        return flat[0]
    stays = not isinstance(flat[0], Negative) or _accelerates(flat[0])
    return Sum(tuple(flat if stays else plus_first(flat)))


def plus_first(terms: Sequence[Node]) -> list[Node]:
    """The terms with the first positive ones before the negative ones that they start with."""
    first = next((i for i, t in enumerate(terms) if not isinstance(t, Negative)), 0)
    last = next((i for i in range(first, len(terms)) if isinstance(terms[i], Negative)), len(terms))
    return [*terms[first:last], *terms[:first], *terms[last:]]


def _accelerates(term: Node) -> bool:
    """Whether a term is an acceleration, or a sum of these, times something."""
    factors = [factor for factor in factors_of(split_sign(term)[1]) if not isinstance(factor, Number)]
    return len(factors) > 1 and max(map(_dots, factors)) == 2


def _dots(node: Node) -> int:
    """The highest derivative with respect to time in a factor."""
    match node:
        case Symbol():
            return node.dots
        case Sum(terms) | Product(terms):
            return max(map(_dots, terms))
        case Negative(inner) | Power(inner) | Quotient(inner):
            return _dots(inner)
    return 0


def negated(node: Node) -> Node:
    """-node, without double signs."""
    return node.argument if isinstance(node, Negative) else node if node == ZERO else Negative(node)


QUARTERS = (2, 4, 8)
"""Beside fractions and roots decimals with these below the line are fractions, too: 7/24 + c₂²/8, √2/2."""

_PI = Symbol("pi")
_DEGREES = 180


def times(coefficient: Fraction | int, factors: Iterable[tuple[Node, int]], *, decimal: bool = False) -> Node:
    """coefficient · Π node^exponent; negative exponents go below the fraction line.

    Signs and numbers of the factors are drawn to the front, products flattened, in
    the given order: 1/(2·3 a) is 1/(6 a).  With `decimal`, and of a decimal, a fraction is one number in
    front, 0.12 c₂ and not 3 c₂/25; one that does not end is kept exact, and rounded where it is shown.
    Parts of a turn stay fractions: π/6; so do halves of a root: √2/2.
    """
    factors = tuple(factors)
    above: list[Node] = []
    below: list[Node] = []
    for node, exponent in factors:
        sign, inner = split_sign(node)
        if isinstance(inner, Sum) and all(isinstance(t, Negative) for t in inner.terms):
            sign, inner = -sign, total([negated(t) for t in inner.terms])
        if sign < 0 and exponent % 2:
            coefficient = -coefficient
        match inner:
            case Product((Number(p, q), *others)) if exponent != 1:
                coefficient = coefficient * Fraction(p, q) ** exponent
                inner = others[0] if len(others) == 1 else Product(tuple(others))
            case Function("sqrt", Number(p, q)) if exponent % 2 == 0:
                coefficient = coefficient * Fraction(p, q) ** (exponent // 2)
                continue
        if exponent == 1:
            coefficient = _put_factor(inner, coefficient, above)
        elif isinstance(inner, Number):
            coefficient = coefficient * Fraction(inner.p, inner.q) ** exponent
        elif exponent > 0:
            above.append(power(inner, exponent))
        else:
            below.append(power(inner, -exponent))
    coefficient = _inside(coefficient, above) * _one_root(above)
    if (front := _one_root(below)) != 1:
        coefficient = coefficient * Fraction(1, front)
    if not coefficient:
        return ZERO
    if coefficient == -1 and not below and len(above) == 1 and isinstance(above[0], Sum):
        return total([negated(term) for term in above[0].terms])
    size = coefficient if coefficient > 0 else -coefficient
    is_turn = _PI in above and _DEGREES % size.denominator == 0
    is_decimal = decimal or any(_begins_with_decimal(node) for node, _ in factors)
    has_root = any(isinstance(factor, Function) and factor.name == "sqrt" for factor in above)
    is_fraction = is_turn or (has_root and size.denominator in QUARTERS)
    if size.denominator != 1 and is_decimal and not is_fraction:
        node = _decimal(size, above)
        node = Quotient(node, _product(below)) if below else node
    else:
        node = _fraction(size, above, below)
    return Negative(node) if coefficient < 0 else node


def _inside(coefficient: Fraction | int, factors: list[Node]) -> Fraction | int:
    """A number with what is put of it into a sum of fractions: m/4 + n s² and not 2 (m/8 + n s²/2).

    >>> from dynsolve.notation.unicode import to_unicode
    >>> m, n, k = map(Symbol, "mnk")
    >>> to_unicode(times(2, [(k, 1), (Sum((Quotient(m, Number(8)), Quotient(n, Number(2)))), 1)]))
    'k (m/4 + n)'
    """
    sums = (i for i, factor in enumerate(factors) if isinstance(factor, Sum))
    if coefficient.numerator in (1, -1) or (place := next(sums, None)) is None:
        return coefficient
    terms = summands(factors[place])
    common = gcd(coefficient.numerator, *map(_divided_by, terms))
    if common == 1:
        return coefficient
    factors[place] = total([times(common, [(term, 1)]) for term in terms])
    return Fraction(coefficient, common)


def _divided_by(term: Node) -> int:
    """The number that stands below a term."""
    match split_sign(term)[1]:
        case Number(_, q) | Quotient(_, Number(q, 1)) | Product((Number(_, q), *_)):
            return q
    return 1


def _one_root(factors: list[Node]) -> int:
    """Make one of all roots of whole numbers, √2 √3 = √6; given is what comes out, 2 of √2 √6 = 2 √3.

    >>> from dynsolve.notation.unicode import to_unicode
    >>> to_unicode(times(1, [(Function("sqrt", Number(root)), 1) for root in (2, 6)]))
    '2√3'
    """
    roots = [one for one in factors if isinstance(one, Function) and one.name == "sqrt"]
    numbers = [root.argument for root in roots if isinstance(root.argument, Number) and root.argument.q == 1]
    if len(numbers) < 2:
        return 1
    front = under = 1
    for number in numbers:
        common = gcd(number.p, under)
        front, under = front * common, number.p * under // common**2
    factors[:] = [one for one in factors if not (one in roots and one.argument in numbers)]
    if under != 1:
        factors.insert(0, Function("sqrt", Number(under)))
    return front


def number_in_front(node: Node) -> Node:
    """Each term of a sum with its fraction as a factor in front, as energies have it: ½ m v².

    >>> square = Power(Symbol("v"), Number(2))
    >>> number_in_front(Quotient(square, Number(2))) == Product((Number(1, 2), square))
    True
    """
    match node:
        case Sum(terms):
            return Sum(tuple(map(number_in_front, terms)))
        case Negative(argument):
            return Negative(number_in_front(argument))
        case Quotient(Product((Number(p, 1), *others)), Number(q, 1)):
            return Product((Number(p, q), *others))
        case Quotient(Product(factors), Number(q, 1)):
            return Product((Number(1, q), *factors))
        case Quotient(Symbol() | Power() | Sum() | Quotient() as numerator, Number(q, 1)):
            return Product((Number(1, q), numerator))
    return node


def _put_factor(node: Node, coefficient: Fraction | int, above: list[Node]) -> Fraction | int:
    """Put one positive factor above the line, its numbers into the coefficient."""
    match node:
        case Number(p, q):
            return coefficient * p if q == 1 else coefficient * Fraction(p, q)
        case Quotient(numerator, Number(p, 1)):
            return _put_factor(numerator, coefficient * Fraction(1, p), above)
        case Product(factors):
            for factor in factors:
                if isinstance(factor, Number):
                    coefficient = coefficient * Fraction(factor.p, factor.q)
                else:
                    above.append(factor)
        case _:
            above.append(node)
    return coefficient


def _begins_with_decimal(node: Node) -> bool:
    first = factors_of(split_sign(node)[1])[0]
    return isinstance(first, Number) and first.decimal


def _decimal(coefficient: Fraction | int, above: list[Node]) -> Node:
    """A number in front, as one decimal."""
    front = Number(coefficient.numerator, coefficient.denominator, decimal=True)
    return Product((front, *above)) if above else front


def ends(denominator: int) -> bool:
    """Whether a fraction with this denominator is a decimal that comes to an end."""
    for prime in (2, 5):
        while denominator % prime == 0:
            denominator //= prime
    return denominator == 1


def _is_decimal(denominator: int) -> bool:
    """Whether a fraction was surely written as a decimal: 981/200 is 4.905, but 2/5 and 3/8 are fractions."""
    return denominator % 25 == 0 and ends(denominator)


def _fraction(coefficient: Fraction | int, above: list[Node], below: list[Node]) -> Node:
    if coefficient.numerator != 1:
        above = [Number(coefficient.numerator), *above]
    if coefficient.denominator != 1:
        below = [Number(coefficient.denominator), *below]
    numerator = _product(above)
    if not below:
        return numerator
    if below == [Number(coefficient.denominator)] and _is_decimal(coefficient.denominator):
        return _decimal(coefficient, above[coefficient.numerator != 1 :])
    if isinstance(numerator, Number) and len(below) == 1 and isinstance(below[0], Number):
        return Number(numerator.p, below[0].p)
    return Quotient(numerator, _product(below))


def _product(factors: list[Node]) -> Node:
    if not factors:
        return ONE
    if all(isinstance(f, Number) for f in factors):
        return Number(prod(f.p for f in factors if isinstance(f, Number)))
    return factors[0] if len(factors) == 1 else Product(tuple(factors))
