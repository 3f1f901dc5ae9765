"""Derivatives that a student leaves to be taken: d/dt(m r² φ̇), ∂/∂q_1(½ m l² sin² q_1), term by term.

Powers: which exponents are read, and the trees they make.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from dynsolve.answers.reading.grids import MAX_EXPONENT, scaled
from dynsolve.answers.reading.tokens.lexer import Token
from dynsolve.answers.reading.vocabulary import Vocabulary
from dynsolve.notation.build import negated, total
from dynsolve.notation.tree import (
    ONE,
    ZERO,
    Degrees,
    Function,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    number,
)

# Powers: which exponents are read, and the trees they make

_RAISED = str.maketrans("⁻⁺⁰¹²³⁴⁵⁶⁷⁸⁹", "-+0123456789")


def raised_number(token: Token) -> int:
    """The number that raised digits spell."""
    digits = token.text.translate(_RAISED)
    if len(digits) > 4:
        raise token.fault("an exponent is a small whole number")
    return int(digits)


def bounded(value: Fraction, sign: Token) -> Fraction:
    """The exponent, if it is one that is read."""
    if abs(value) != Fraction(1, 2) and (value.denominator != 1 or abs(value) > MAX_EXPONENT):
        message = f"an exponent is a whole number from -{MAX_EXPONENT} to {MAX_EXPONENT}"
        raise sign.fault(message, "a square root is written \\sqrt{x} or sqrt(x)")
    return value


def magnitude(x: Node) -> Node:
    """|x| as x sgn x."""
    return Product((x, Function("sgn", x)))


def raise_to(base: Node, power: Fraction) -> Node:
    """base^power; a half is a root, |x|² is x² and √x² is x."""
    match base:
        case Product((x, Function("sgn"))) if power % 2 == 0 and base == magnitude(x):
            base = x
        case Function("sqrt", x) if power % 2 == 0 and power:
            return x if power == 2 else raise_to(x, power / 2)
    if power.denominator == 2:
        root = Function("sqrt", base)
        return root if power > 0 else Quotient(Number(1), root)
    whole = Number(abs(power.numerator))
    return Power(base, Negative(whole) if power < 0 else whole)


def constant(node: Node) -> Fraction | None:
    """The value of a tree of small numbers, None for every other."""
    match node:
        case Number(p, q):
            return Fraction(p, q)
        case Negative(argument):
            inner = constant(argument)
            return None if inner is None else -inner
        case Quotient(numerator, denominator):
            top, bottom = constant(numerator), constant(denominator)
            return top / bottom if top is not None and bottom else None
        case Sum(terms):
            values = [constant(term) for term in terms]
            return sum((v for v in values if v is not None), Fraction(0)) if None not in values else None
        case Product(factors):
            product = Fraction(1)
            for factor in factors[:4]:
                value = constant(factor)
                if value is None:
                    return None
                product *= value
            return product if len(factors) <= 4 else None
    return None


Rule = Callable[[Symbol], Node | None]
"""The derivative of a symbol, None where it has none."""


def by_time(vocabulary: Vocabulary) -> Rule:
    """d/dt: coordinates and their velocities gain a dot, parameters are constant."""

    def rate(symbol: Symbol) -> Node | None:
        if vocabulary.coordinate(symbol) is None and not vocabulary.is_reference(symbol.name):
            return ZERO
        return Symbol(symbol.name, symbol.dots + 1) if symbol.dots < 2 else None

    return rate


def by_symbol(variable: Symbol) -> Rule:
    """∂/∂variable: every other symbol is constant."""
    return lambda symbol: ONE if (symbol.name, symbol.dots) == (variable.name, variable.dots) else ZERO


def derivative(node: Node, rule: Rule) -> Node | None:
    """The derivative of an expression; None where a part of it has none, as the name of an answer.

    >>> from dynsolve.notation.unicode import to_unicode
    >>> to_unicode(derivative(Function("sin", Product((Number(2), Symbol("x")))), by_symbol(Symbol("x"))))
    'cos(2x)·2'
    """
    match node:
        case Number() | Degrees() | Function("sgn"):
            return ZERO
        case Symbol():
            return rule(node)
        case Negative(argument):
            inner = derivative(argument, rule)
            return None if inner is None else negated(inner)
        case Sum(terms):
            found = [derivative(term, rule) for term in terms]
            return None if None in found else total([term for term in found if term is not None])
        case Product(factors):
            return _of_product(factors, rule)
        case Quotient(above, below):
            return _of_quotient(above, below, rule)
        case Power(base, exponent):
            inner, power = derivative(base, rule), constant(exponent)
            if inner is None or power is None:
                return None
            lower = base if power == 2 else raise_to(base, power - 1)
            return scaled(scaled(number(power), lower), inner)
        case Function(name, argument):
            inner = derivative(argument, rule)
            return None if inner is None else _of_function(name, argument, inner)
    return None


def _of_product(factors: tuple[Node, ...], rule: Rule) -> Node | None:
    terms: list[Node] = []
    for place, factor in enumerate(factors):
        inner = derivative(factor, rule)
        if inner is None:
            return None
        others = (*factors[:place], *factors[place + 1 :])
        if inner != ZERO:
            terms.append(scaled(Product(others) if len(others) > 1 else others[0], inner))
    return total(terms)


def _of_quotient(above: Node, below: Node, rule: Rule) -> Node | None:
    over, under = derivative(above, rule), derivative(below, rule)
    if over is None or under is None:
        return None
    first = ZERO if over == ZERO else Quotient(over, below)
    second = ZERO if under == ZERO else Quotient(Product((above, under)), Power(below, Number(2)))
    return total([first, negated(second)])


def _of_function(name: str, argument: Node, inner: Node) -> Node | None:
    if inner == ZERO:
        return ZERO
    match name:
        case "sin":
            return scaled(Function("cos", argument), inner)
        case "cos":
            return negated(scaled(Function("sin", argument), inner))
        case "tan":
            return Quotient(inner, Power(Function("cos", argument), Number(2)))
        case "sqrt":
            return Quotient(inner, Product((Number(2), Function(name, argument))))
    return None
