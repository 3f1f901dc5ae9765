"""Powers: which exponents are read, and the trees they make."""

from __future__ import annotations

from fractions import Fraction

from dynsolve.answers.reading.limits import MAX_EXPONENT
from dynsolve.answers.reading.tokens.lexer import Token
from dynsolve.errors import ReadError
from dynsolve.notation.tree import Function, Negative, Node, Number, Power, Product, Quotient, Sum

_RAISED = str.maketrans("⁻⁺⁰¹²³⁴⁵⁶⁷⁸⁹", "-+0123456789")


def raised_number(token: Token) -> int:
    """The number that raised digits spell."""
    digits = token.text.translate(_RAISED)
    if len(digits) > 4:
        raise ReadError("an exponent is a small whole number", token.start, token.end - token.start, "")
    return int(digits)


def bounded(value: Fraction, sign: Token) -> Fraction:
    """The exponent, if it is one that is read."""
    if (
        value != Fraction(1, 2)
        and value != Fraction(-1, 2)
        and (value.denominator != 1 or abs(value) > MAX_EXPONENT)
    ):
        message = f"an exponent is a whole number from -{MAX_EXPONENT} to {MAX_EXPONENT}"
        raise ReadError(
            message,
            sign.start,
            max(sign.end - sign.start, 1),
            "a square root is written \\sqrt{x} or sqrt(x)",
        )
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
