"""Plain-text formulas: `m1*L1**2*cos(theta1 + 90deg)` -> the notation tree.

A tokenizer and a recursive descent over this grammar; nothing is ever evaluated.

    sum      = [sign] term {("+" | "-") term}
    term     = factor {("*" | "/") factor}
    factor   = {sign} power
    power    = atom [("^" | "**") factor]            the exponent is a whole number, or 1/2
    atom     = number | degrees | name | function "(" sum ")" | "atan2" "(" sum "," sum ")" | "(" sum ")"
"""

from __future__ import annotations

from fractions import Fraction

from msgspec import Struct

from dynsolve.errors import ReadError
from dynsolve.notation import mistakes
from dynsolve.notation.characters import SUPERSCRIPT_DIGITS, normalize
from dynsolve.notation.size import MAX_EXPONENT, MAX_LENGTH, MAX_NESTING, check_size
from dynsolve.notation.tokens import ARCS, FUNCTIONS, FormulaToken, rational, tokens
from dynsolve.notation.tree import (
    Arguments,
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
)

_BEGINS_FACTOR = frozenset({"number", "degrees", "name", "(", "√"})
_RAISED = str.maketrans("⁻" + SUPERSCRIPT_DIGITS, "-0123456789")


class Name(Struct, frozen=True):
    """A symbol's name where it stands in the text; `star`: it carries the mark of a joint variable."""

    name: str
    offset: int
    length: int
    star: bool = False


class FormulaText(Struct, frozen=True):
    """What was read: the formula, and every occurrence of a name in it, in order (`pi` is none)."""

    tree: Node
    names: tuple[Name, ...]


def read(text: str, *, stars: bool = False, dots: bool = False, arcs: bool = False) -> FormulaText:
    """Read a formula in plain text.

    With `stars`, a star directly after a name marks a joint variable when what
    follows cannot begin a factor; otherwise every `*` is a product.  With `dots`,
    `x_dot` and `x_ddot` are the time derivatives of x, and rates may have a sign, sgn(x_dot).
    With `arcs` there are also acos, asin, atan and atan2(y, x).

    Whole exponents become a `Number` or its `Negative`, x^(1/2) becomes sqrt(x),
    `pi` the symbol of that name.  Raises ReadError with the place and a remedy.

    >>> read("theta1* + 90deg", stars=True).tree
    Sum(terms=(Symbol(name='theta1', dots=0, star=True), Degrees(p=90, q=1)))
    """
    if len(text) > MAX_LENGTH:
        raise ReadError(
            f"a formula of {len(text)} characters; at most {MAX_LENGTH} are read",
            MAX_LENGTH,
            1,
            "name parts of it with symbols of their own",
        )
    reader = _Reader(text, stars, dots, arcs)
    tree = reader.formula()
    check_size(tree, len(text))
    return FormulaText(tree, tuple(reader.names))


class _Reader:
    """The descent: `token` is the one that is looked at, `before` the last one taken."""

    __slots__ = ("text", "stars", "dots", "arcs", "names", "tokens", "position", "token", "before", "nesting")

    def __init__(self, text: str, stars: bool, dots: bool, arcs: bool) -> None:
        self.text, self.stars, self.dots, self.arcs = text, stars, dots, arcs
        self.names: list[Name] = []
        self.tokens = tokens(text)
        self.position = 0
        self.token = self.tokens[0]
        self.before: FormulaToken | None = None
        self.nesting = 0

    def formula(self) -> Node:
        if self.token.kind == "end":
            raise mistakes.empty(self.text)
        tree = self.sum()
        if self.token.kind != "end":
            raise mistakes.unexpected(self.text, self.token)
        return tree

    def take(self) -> FormulaToken:
        token = self.token
        self.position += 1
        self.before, self.token = token, self.tokens[self.position]
        return token

    def enter(self) -> None:
        self.nesting += 1
        if self.nesting > MAX_NESTING:
            raise mistakes.too_deep(self.token)

    def sum(self) -> Node:
        self.enter()
        terms: list[Node] = []
        sign = self.take().kind if self.token.kind in ("+", "-") else "+"
        while True:
            term = self.term()
            terms.append(Negative(term) if sign == "-" else term)
            sign = self.token.kind
            if sign != "+" and sign != "-":
                break
            self.take()
        self.nesting -= 1
        return terms[0] if len(terms) == 1 else Sum(tuple(terms))

    def term(self) -> Node:
        factors = [self.factor()]
        while True:
            kind = self.token.kind
            if kind == "*":
                self.take()
                factors.append(self.factor())
            elif kind == "/":
                self.take()
                factors = [Quotient(_product(factors), self.factor())]
            elif kind in _BEGINS_FACTOR:
                raise mistakes.missing_product(self.text, self.tokens, self.position)
            else:
                return _product(factors)

    def factor(self) -> Node:
        kind = self.token.kind
        if kind != "-" and kind != "+":
            return self.power()
        self.enter()
        self.take()
        factor = self.factor()
        self.nesting -= 1
        return Negative(factor) if kind == "-" else factor

    def power(self) -> Node:
        base = self.atom()
        if self.token.kind != "^" and self.token.kind != "raised":
            return base
        start = self.token
        node = _power(base, self.exponent(), start)
        if self.token.kind in ("raised", "^"):
            raise mistakes.second_power(self.token)
        return node

    def exponent(self) -> Fraction:
        """The value of the exponent that stands at the token `^` or is a raised number."""
        sign = self.take()
        if sign.kind == "raised":
            digits = sign.text.translate(_RAISED)
            if len(digits) > 3:
                raise mistakes.exponent(sign, sign.start, sign.end)
            return Fraction(int(digits))
        self.enter()
        start = self.token.start
        value = _constant(self.factor())
        self.nesting -= 1
        if value is None:
            end = self.before.end if self.before else start
            raise mistakes.exponent(sign, start, end)
        return value

    def atom(self) -> Node:
        token = self.token
        kind = token.kind
        if kind == "name":
            return self.name()
        if kind == "number":
            value = rational(self.take())
            return Number(value.numerator, value.denominator)
        if kind == "(":
            return self.parentheses()
        if kind == "degrees":
            value = rational(self.take())
            return Degrees(value.numerator, value.denominator)
        if kind == "√":
            self.enter()
            self.take()
            root = Function("sqrt", self.atom())
            self.nesting -= 1
            return root
        raise mistakes.no_factor(self.text, self.before, token)

    def parentheses(self) -> Node:
        opening = self.take()
        if self.token.kind == ")":
            raise mistakes.empty_parentheses(opening, self.token)
        inner = self.sum()
        if self.token.kind != ")":
            raise mistakes.unclosed(self.text, opening, self.token)
        self.take()
        return inner

    def name(self) -> Node:
        token = self.take()
        more = (token.text == "sgn" and self.dots) or (token.text in ARCS and self.arcs)
        if more or token.text in FUNCTIONS:
            return self.function(token)
        name = normalize(token.text)
        follower = self.token
        if follower.kind == "(" and (error := mistakes.unknown_function(token, name)):
            raise error
        if name in ("pi", "deg") or (token.text[0] == "π" and token.text != "π"):
            return self.constant(token, name)
        star = self.stars and follower.kind == "*" and follower.start == token.end and self.star_is_mark()
        if star:
            self.take()
        self.names.append(Name(name, token.start, token.end - token.start, star))
        if self.dots and name.endswith("dot"):
            if name.endswith("_ddot"):
                return Symbol(name[:-5], 2, star)
            if name.endswith("_dot"):
                return Symbol(name[:-4], 1, star)
        return Symbol(name, 0, star)

    def constant(self, token: FormulaToken, name: str) -> Node:
        if name == "deg":
            raise mistakes.bare_degrees(token)
        if token.text[0] == "π" and len(token.text) > 1:
            raise mistakes.glued_pi(token)
        return Symbol("pi")

    def star_is_mark(self) -> bool:
        """Whether the star at the token is a joint variable's mark: no factor begins after it."""
        return self.tokens[self.position + 1].kind not in _BEGINS_FACTOR

    def function(self, name: FormulaToken) -> Node:
        """`sin(x)`, or `sin^2(x)` for its square."""
        sign = self.token
        exponent = self.function_power(name) if sign.kind in ("raised", "^") else None
        if self.token.kind != "(":
            raise mistakes.no_argument(self.text, name, self.token)
        node = Function(name.text, self.two_arguments(name) if name.text == "atan2" else self.parentheses())
        return node if exponent is None else _power(node, exponent, sign)

    def two_arguments(self, name: FormulaToken) -> Node:
        """`(y, x)`"""
        opening = self.take()
        y = self.sum()
        if self.token.kind != ",":
            length = name.end - name.start
            raise ReadError(f"{name.text} has two arguments", name.start, length, "write atan2(y, x)")
        self.take()
        x = self.sum()
        if self.token.kind != ")":
            raise mistakes.unclosed(self.text, opening, self.token)
        self.take()
        return Arguments((y, x))

    def function_power(self, name: FormulaToken) -> Fraction:
        value = self.exponent()
        if value < 1 or name.text == "sqrt":
            raise mistakes.inverse_function(name, self.before or name)
        return value


def _product(factors: list[Node]) -> Node:
    return factors[0] if len(factors) == 1 else Product(tuple(factors))


def _power(base: Node, exponent: Fraction, sign: FormulaToken) -> Node:
    if exponent == Fraction(1, 2):
        return Function("sqrt", base)
    if exponent.denominator != 1 or abs(exponent) > MAX_EXPONENT:
        raise mistakes.exponent(sign, sign.start, sign.end)
    whole = Number(abs(exponent.numerator))
    return Power(base, Negative(whole) if exponent < 0 else whole)


def _constant(node: Node) -> Fraction | None:
    """The value of an exponent, None for what is no small constant; works on bounded numbers only."""
    match node:
        case Number():
            return Fraction(node.p, node.q)
        case Negative():
            inner = _constant(node.argument)
            return None if inner is None else -inner
        case Quotient():
            p, q = _constant(node.numerator), _constant(node.denominator)
            return p / q if p is not None and q else None
        case Power(Number() as base, Number() as exponent) if base.p <= MAX_EXPONENT and base.q == 1:
            return Fraction(base.p) ** exponent.p
    return None
