"""Plain-text formulas: `m1*L1**2*cos(theta1 + 90deg)` -> the notation tree.

A tokenizer and a recursive descent over this grammar; nothing is ever evaluated.

    sum      = [sign] term {("+" | "-") term}
    term     = factor {("*" | "/") factor}
    factor   = {sign} power
    power    = atom [("^" | "**") factor]            the exponent is a whole number, or 1/2
    atom     = number | degrees | name | function "(" sum ")" | "atan2" "(" sum "," sum ")" | "(" sum ")"

First the tokens, each with its place; last the errors: the place, the fault, the remedy.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

from msgspec import Struct

from dynsolve.errors import ReadError
from dynsolve.notation.characters import (
    GREEK,
    SPELLED,
    SUBSCRIPT_DIGITS,
    SUPERSCRIPT_DIGITS,
    character_error,
    normalize,
)
from dynsolve.notation.size import MAX_DIGITS, MAX_EXPONENT, MAX_LENGTH, MAX_NESTING, check_size
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

FUNCTIONS = ("sin", "cos", "tan", "sqrt")
"""The functions of a formula."""

ARCS = ("acos", "asin", "atan", "atan2")
"""The functions that give angles, where a formula may have them."""

_GREEK = "".join(SPELLED)
_NUMBER = r"(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"
_TOKEN = re.compile(
    rf"""
      (?P<space>[ \t\r\n\u00a0\u2000-\u200a\u202f]+)
    | (?P<degrees>{_NUMBER}\s*(?:°|deg(?![A-Za-z0-9_])))
    | (?P<number>{_NUMBER})
    | (?P<name>[A-Za-z{_GREEK}][A-Za-z0-9_{_GREEK}{SUBSCRIPT_DIGITS}]*)
    | (?P<power>\*\*|\^)
    | (?P<raised>⁻?[{SUPERSCRIPT_DIGITS}]+)
    | (?P<operator>[-+*/(),−–·⋅∙×∗⋆÷∕⁄√])
    """,
    re.VERBOSE,
)
_OPERATORS = dict(zip("-+*/(),√−–·⋅∙×∗⋆÷∕⁄", "-+*/(),√--******///", strict=True))


class FormulaToken(NamedTuple):
    """A piece of the text: `kind` is number, degrees, name, ^, raised, end or the operator itself."""

    kind: str
    text: str
    start: int
    end: int


def tokens(text: str) -> list[FormulaToken]:
    """The tokens of a formula, an `end` token last; raises ReadError for a character of no formula."""
    result: list[FormulaToken] = []
    offset = 0
    match = _TOKEN.match
    while offset < len(text):
        found = match(text, offset)
        if found is None:
            raise character_error(text[offset], offset)
        kind, end = found.lastgroup or "", found.end()
        if kind != "space":
            piece = found.group()
            kind = _OPERATORS[piece] if kind == "operator" else "^" if kind == "power" else kind
            result.append(FormulaToken(kind, piece, offset, end))
        offset = end
    result.append(FormulaToken("end", "", len(text), len(text)))
    return result


_EXPONENT = re.compile("[eE]")
_DECIMAL = re.compile(r"(?<!\w)(?:\d*\.\d|\d+\.(?!\w)|\d+[eE][-+]?\d)")


def rational(token: FormulaToken) -> Fraction:
    """The exact value of a number: `9.81` is 981/100, `1e-3` is 1/1000.

    Raises ReadError for more digits than anyone measures, before they are converted.
    """
    mantissa, _, exponent = _EXPONENT.sub("e", token.text.removesuffix("°").removesuffix("deg")).partition(
        "e"
    )
    whole, _, decimals = mantissa.strip().partition(".")
    power = exponent.strip().lstrip("+-").lstrip("0")
    if len(whole) + len(decimals) > MAX_DIGITS or len(power) > 2 or int(power or 0) > MAX_DIGITS:
        length = token.end - token.start
        raise ReadError(f"a number of more than {MAX_DIGITS} digits", token.start, length, "write it shorter")
    shift = (-int(power or 0) if "-" in exponent else int(power or 0)) - len(decimals)
    digits = int((whole + decimals) or "0")
    return Fraction(digits * 10**shift) if shift >= 0 else Fraction(digits, 10**-shift)


def has_decimals(text: str) -> bool:
    """Whether a number of a formula is a decimal: 0.5 or 1e-3, and not 1/2.

    >>> [has_decimals(text) for text in ("l/2 + 1e-3", "0.5*l", "2.", ".5", "l/2 + 30deg", "tip.x - P1.y")]
    [True, True, True, True, False, False]
    """
    return _DECIMAL.search(text) is not None


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
            help = "write a number, a name or a formula"
            raise ReadError("there is no formula here", 0, max(len(self.text), 1), help)
        tree = self.sum()
        if self.token.kind != "end":
            raise _unexpected(self.text, self.token)
        return tree

    def take(self) -> FormulaToken:
        token = self.token
        self.position += 1
        self.before, self.token = token, self.tokens[self.position]
        return token

    def enter(self) -> None:
        self.nesting += 1
        if self.nesting > MAX_NESTING:
            message = f"more than {MAX_NESTING} levels of parentheses, signs and powers"
            help = "name a part of it with a symbol of its own"
            raise ReadError(message, self.token.start, 1, help)

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
                raise _missing_product(self.text, self.tokens, self.position)
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
            raise _fault(self.token, "a power of a power needs parentheses", "write (x^2)^3, or x^6")
        return node

    def exponent(self) -> Fraction:
        """The value of the exponent that stands at the token `^` or is a raised number."""
        sign = self.take()
        if sign.kind == "raised":
            digits = sign.text.translate(_RAISED)
            if len(digits) > 3:
                raise _no_exponent(sign, sign.start, sign.end)
            return Fraction(int(digits))
        self.enter()
        start = self.token.start
        value = _constant(self.factor())
        self.nesting -= 1
        if value is None:
            end = self.before.end if self.before else start
            raise _no_exponent(sign, start, end)
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
        raise _no_factor(self.before, token)

    def parentheses(self) -> Node:
        opening = self.take()
        if self.token.kind == ")":
            message = "there is nothing between these parentheses"
            raise _fault(opening, message, "write what belongs there", self.token.end)
        inner = self.sum()
        if self.token.kind != ")":
            raise _unclosed(self.text, opening, self.token)
        self.take()
        return inner

    def name(self) -> Node:
        token = self.take()
        more = (token.text == "sgn" and self.dots) or (token.text in ARCS and self.arcs)
        if more or token.text in FUNCTIONS:
            return self.function(token)
        name = normalize(token.text)
        follower = self.token
        if follower.kind == "(" and (error := _unknown_function(token, name)):
            raise error
        if name == "deg":
            raise _bare_degrees(token)
        if token.text[0] == "π" and token.text != "π":
            help = f"products are written out: π*{token.text[1:]}"
            raise ReadError(f"a `*` is missing after the π of `{token.text}`", token.start, 1, help)
        if name == "pi":
            return Symbol("pi")
        star = self.stars and follower.kind == "*" and follower.start == token.end
        if star and self.tokens[self.position + 1].kind in _BEGINS_FACTOR:
            star = False  # a product: only where no factor follows is it the mark of a joint variable
        if star:
            self.take()
        self.names.append(Name(name, token.start, token.end - token.start, star))
        if self.dots and name.endswith("dot"):
            if name.endswith("_ddot"):
                return Symbol(name[:-5], 2, star)
            if name.endswith("_dot"):
                return Symbol(name[:-4], 1, star)
        return Symbol(name, 0, star)

    def function(self, name: FormulaToken) -> Node:
        """`sin(x)`, or `sin^2(x)` for its square."""
        sign = self.token
        exponent = self.exponent() if sign.kind in ("raised", "^") else None
        if exponent is not None and (exponent < 1 or name.text == "sqrt"):
            end = (self.before or name).end
            help = f"a power is written {name.text}(x)^2; there are no inverse functions"
            raise _fault(name, f"this power of `{name.text}` cannot be read", help, end)
        if self.token.kind != "(":
            argument = self.token.text if self.token.kind in ("name", "number", "degrees") else "..."
            message = f"`{name.text}` needs its argument in parentheses"
            raise _fault(name, message, f"write {name.text}({argument})")
        node = Function(name.text, self.two_arguments(name) if name.text == "atan2" else self.parentheses())
        return node if exponent is None else _power(node, exponent, sign)

    def two_arguments(self, name: FormulaToken) -> Node:
        """`(y, x)`"""
        opening = self.take()
        y = self.sum()
        if self.token.kind != ",":
            raise _fault(name, f"{name.text} has two arguments", "write atan2(y, x)")
        self.take()
        x = self.sum()
        if self.token.kind != ")":
            raise _unclosed(self.text, opening, self.token)
        self.take()
        return Arguments((y, x))


def _product(factors: list[Node]) -> Node:
    return factors[0] if len(factors) == 1 else Product(tuple(factors))


def _power(base: Node, exponent: Fraction, sign: FormulaToken) -> Node:
    if exponent == Fraction(1, 2):
        return Function("sqrt", base)
    if exponent.denominator != 1 or abs(exponent) > MAX_EXPONENT:
        raise _no_exponent(sign, sign.start, sign.end)
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


# -- what cannot be read -----------------------------------------------------------------------------

_FUNCTIONS = ", ".join(FUNCTIONS[:-1]) + f" and {FUNCTIONS[-1]}"
_KNOWN_ELSEWHERE = frozenset(
    "exp log ln asin acos atan atan2 arcsin arccos arctan sinh cosh tanh sec csc cot sgn abs pow max min "
    "sind cosd sine cosine tangent root".split()
)
_UNITS = frozenset("m cm mm kg g s N Nm rad".split())
_EXCERPT = 60


def _fault(token: FormulaToken, message: str, help: str = "", end: int | None = None) -> ReadError:
    """What is wrong with a token, or with the text from there to `end`, and the remedy."""
    return ReadError(message, token.start, (token.end if end is None else end) - token.start, help)


def _missing_product(text: str, tokens: Sequence[FormulaToken], position: int) -> ReadError:
    """Two factors side by side: the remedy shows the text with its `*`."""
    before, after = tokens[position - 1], tokens[position]
    if after.text.startswith("deg"):
        return _bare_degrees(after)
    offset, length = before.end, max(after.start - before.end, 1)
    both_numbers = before.kind == after.kind == "number"
    what = "an operator" if both_numbers else "a `*`"
    message = f"{what} is missing between `{before.text}` and `{after.text}`"
    if both_numbers:
        return ReadError(message, offset, length, "a decimal is written with one point: 9.81")
    left, right = text[max(0, before.end - _EXCERPT) : before.end], text[after.start : after.start + _EXCERPT]
    left = left if before.end <= _EXCERPT else "..." + left
    right = right if after.start + _EXCERPT >= len(text) else right + "..."
    help = f"products are written out: {' '.join(f'{left}*{right}'.split())}"
    if before.kind == "number" and after.text in _UNITS:
        help += f"; if `{after.text}` is the unit, leave it out"
    return ReadError(message, offset, length, help)


def _unknown_function(token: FormulaToken, name: str) -> ReadError | None:
    """The error about `name(`, or None where a product with a parenthesis is the likelier reading."""
    message = f"unknown function `{token.text}`"
    if name.lower() in FUNCTIONS:
        return _fault(token, message, f"did you mean `{name.lower()}`?")
    if name in _KNOWN_ELSEWHERE:
        return _fault(token, message, f"functions are {_FUNCTIONS}")
    if name.isalpha() and len(name) > 2 and name not in GREEK:
        from difflib import get_close_matches

        if close := get_close_matches(name, FUNCTIONS, 1):
            return _fault(token, message, f"did you mean `{close[0]}`, or the product `{token.text}*(...)`?")
        if len(name) > 3:
            help = f"functions are {_FUNCTIONS}; a product is written `{token.text}*(...)`"
            return _fault(token, message, help)
    return None


def _with_point(text: str, comma: FormulaToken) -> str:
    """What is said of a comma: the number that it was meant in, where digits stand on both sides."""
    before = re.search(r"[0-9]+\Z", text[: comma.start])
    after = re.match(r"[0-9]+", text[comma.end :])
    if before and after:
        return f"did you mean {before[0]}.{after[0]}? A decimal is written with a point"
    return "a decimal is written with a point: 9.81"


def _unexpected(text: str, token: FormulaToken) -> ReadError:
    """A token that cannot follow a whole formula."""
    if token.kind == ")":
        return _fault(token, "this `)` closes nothing", "delete it, or add the `(` that it belongs to")
    if token.kind == ",":
        return _fault(token, "a `,` has no meaning here", _with_point(text, token))
    return _fault(token, f"`{token.text}` cannot stand here")


def _no_factor(before: FormulaToken | None, token: FormulaToken) -> ReadError:
    """A number, a name or a parenthesis is expected, and `token` is none."""
    what = "a number, a name or a parenthesis"
    if token.kind == "end":
        after = before or token
        help = f"write {what} after it, or delete it"
        if after.kind == "*":
            help += (
                "; the star that marks a joint variable stands directly after its name, in theta and d alone"
            )
        return _fault(after, f"the formula ends after `{after.text}`", help)
    begins = f"the formula begins with `{token.text}`"
    message = f"`{token.text}` cannot follow `{before.text}`" if before else begins
    return _fault(token, message, f"{what} is expected here")


def _unclosed(text: str, opening: FormulaToken, token: FormulaToken) -> ReadError:
    """A parenthesis that does not close before `token`."""
    if token.kind == "end":
        return _fault(opening, "this `(` is never closed", "add the `)` that it belongs to")
    if token.kind == ",":
        help = f"functions take one argument; {_with_point(text, token)}"
        return _fault(token, "a `,` has no meaning here", help)
    return _unexpected(text, token)


def _no_exponent(sign: FormulaToken, start: int, end: int) -> ReadError:
    """An exponent that is no small whole number."""
    message = f"an exponent is a whole number from -{MAX_EXPONENT} to {MAX_EXPONENT}"
    return ReadError(message, start, max(end - start, 1), "a square root is written sqrt(x) or x^(1/2)")


def _bare_degrees(token: FormulaToken) -> ReadError:
    """A `deg` that follows no number."""
    if token.text != "deg":
        return _fault(token, f"degrees are written `deg`, not `{token.text}`", "write 90deg")
    return _fault(token, "`deg` stands directly after a number", "write 90deg, or x*pi/180")
