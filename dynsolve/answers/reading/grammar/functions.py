r"""Sines, cosines and roots as people write them: `\sin 2\theta_1 L_2`, `cos^2(q1)`, `sin q_1`."""

from __future__ import annotations

from fractions import Fraction

from dynsolve.answers.reading.grammar.exponents import magnitude
from dynsolve.answers.reading.grammar.forms import Scripts
from dynsolve.answers.reading.grammar.reader import Reader
from dynsolve.answers.reading.grids import Abstract, Grid, Value
from dynsolve.answers.reading.tokens.lexer import Token
from dynsolve.answers.reading.vocabulary import Vocabulary
from dynsolve.errors import ReadError
from dynsolve.notation.tree import Arguments, Function, Negative, Node, Number, Power, Product, Quotient, Sum

_NAMES = {"sin": "sin", "cos": "cos", "tan": "tan", "sqrt": "sqrt", "cot": "cot", "sec": "sec", "csc": "csc"}
_NAMES |= (
    {name.capitalize(): name for name in _NAMES} | {name.upper(): name for name in _NAMES} | {"cosec": "csc"}
)
_NAMES |= {"sgn": "sgn", "sign": "sgn", "signum": "sgn", "abs": "abs", "Abs": "abs"}
_INVERSES = {name: name for name in ("asin", "acos", "atan", "atan2")}
_INVERSES |= {f"arc{name}": f"a{name}" for name in ("sin", "cos", "tan", "tan2")}
_INVERSES |= {name.capitalize(): meant for name, meant in _INVERSES.items()}
_RECIPROCALS = {"cot": ("cos", "sin"), "sec": ("", "cos"), "csc": ("", "sin")}
_ELSEWHERE = frozenset(
    "exp log ln asin acos atan atan2 arcsin arccos arctan sinh cosh tanh max min pow "
    "sind cosd root det inv simplify eval exec open input print import".split()
)


def name_of(token: Token, vocabulary: Vocabulary) -> str | None:
    """The function that a token names; arccos and its like where the inverse kinematics is asked for."""
    if token.kind not in ("name", "command") or token.dots:
        return None
    known = _NAMES.get(token.text)
    return _INVERSES.get(token.text) if known is None and vocabulary.has_inverse_functions else known


def is_elsewhere(token: Token) -> bool:
    """Whether a token is a function that no answer holds."""
    return token.kind in ("name", "command") and token.text in _ELSEWHERE


def read(reader: Reader, function: str) -> Value:
    """A function with its power and its argument."""
    reader.enter()
    name = reader.take()
    if function == "atan" and reader.token.text == "2" and reader.peek().kind == "(":
        reader.take()  # \\arctan2(y, x)
        function = "atan2"
    scripts = Scripts()
    if function == "sqrt" and reader.token.kind == "[":
        raise ReadError("only square roots are read", reader.token.start, 1, "write \\sqrt{x}")
    if function != "sqrt":
        while reader.script(scripts):
            pass
    if scripts.powers == [-1] and f"a{function}" in _INVERSES and reader.vocabulary.has_inverse_functions:
        function, scripts.powers = f"a{function}", []  # cos⁻¹ is never 1/cos beside arccos
    if scripts.transposed or scripts.primes or scripts.mark or any(power < 1 for power in scripts.powers):
        length = max(reader.token.start - name.start, 1)
        raise ReadError(
            f"this exponent of {function} cannot be read",
            name.start,
            length,
            f"write {function}(x)^2 for a square",
        )
    if function == "atan2":
        found: Value = Function(function, _two_arguments(reader, name))
        reader.nesting -= 1
        return found
    argument, outer = _argument(reader, name)
    found = applied(reader, function, argument, name)
    for power in [*scripts.powers, *outer]:
        found = reader.raised(found, power, name.start)
    reader.nesting -= 1
    if not outer and _is_closed(reader):
        found = reader.scripted(found)
    return found


def _two_arguments(reader: Reader, name: Token) -> Arguments:
    """(y, x) of atan2."""
    help = f"write {name.text}(y, x)"
    if reader.token.kind != "(":
        raise ReadError(f"`{name.text}` has no arguments", name.start, name.end - name.start, help)
    opening = reader.take()
    parts = [reader.sum()]
    if reader.token.kind != ",":
        raise reader.unexpected(help)
    reader.take()
    parts.append(reader.sum())
    reader.expect(")", opening)
    y, x = parts
    if not isinstance(y, Node) or not isinstance(x, Node):
        raise ReadError(f"`{name.text}` of a matrix or a vector", name.start, name.end - name.start, help)
    return Arguments((y, x))


def _is_closed(reader: Reader) -> bool:
    before = reader.tokens[max(reader.position - 1, 0)]
    return before.kind in (")", "}", "]") or reader.token.kind not in ("'", "''")


def _argument(reader: Reader, name: Token) -> tuple[Value, list[Fraction]]:
    """The argument, and the powers that stand at its end and belong to the function."""
    token = reader.token
    if token.kind == "(" or token.kind == "{" or token.kind == "[":
        return _closed(reader), []
    if token.kind == "end":
        message = f"`{name.text}` has no argument"
        raise ReadError(message, name.start, name.end - name.start, f"write {name.text}(theta1)")
    sign = False
    while reader.token.kind in ("-", "+"):
        sign = (reader.take().kind == "-") != sign
    if name.text.lower() == "sqrt":
        return reader.atom(), []
    value, powers = _open(reader)
    if sign:
        value = Negative(value) if isinstance(value, Node) else value
    return value, powers


def _closed(reader: Reader) -> Value:
    """The argument in its brackets."""
    opening = reader.take()
    closing = {"(": ")", "{": "}", "[": "]"}[opening.kind]
    if reader.token.kind == closing:
        raise ReadError("there is no argument here", opening.start, 2, "write what the function is of")
    value = reader.sum()
    if reader.token.kind == ",":
        raise reader.unexpected("functions take one argument; a decimal is written with a point: 9.81")
    reader.expect(closing, opening)
    return value


def _open(reader: Reader) -> tuple[Value, list[Fraction]]:
    """An optional number and one factor."""
    parts: list[Node] = []
    if reader.token.kind in ("number", "fraction") or _is_numeric_fraction(reader):
        number = reader.atom()
        if not isinstance(number, Node):
            return number, []
        parts.append(number)
        if reader.token.kind in ("*", "cdot") and reader.peek().kind in ("name", "letter"):
            reader.take()
        if reader.token.kind not in ("name", "letter", "(", "command", "{") or name_of(
            reader.token, reader.vocabulary
        ):
            return number, []
    factor = reader.atom()
    if not isinstance(factor, Node):
        return factor, []
    powers: list[Fraction] = []
    if isinstance(factor, Power) and isinstance(factor.exponent, Number):
        reader.notes.setdefault(
            "a power behind an angle without parentheses is read as the power of the function"
        )
        powers, factor = [Fraction(factor.exponent.p)], factor.base
    parts.append(factor)
    return (parts[0] if len(parts) == 1 else Product(tuple(parts))), powers


def _is_numeric_fraction(reader: Reader) -> bool:
    return reader.token.text == "frac" and reader.peek(1).kind == reader.peek(2).kind == "number"


def _degrees_meant(argument: Node) -> str:
    """The number in an angle that was meant in degrees by its looks: the 90 of theta_1 + 90."""
    terms = argument.terms if isinstance(argument, Sum) else (argument,)
    for term in terms:
        number = term.argument if isinstance(term, Negative) else term
        if isinstance(number, Number) and number.q == 1 and number.p and number.p % 15 == 0:
            return str(number.p)
    return ""


def applied(reader: Reader, function: str, argument: Value, name: Token) -> Value:
    """The function of an argument."""
    if isinstance(argument, Abstract):
        return argument
    if isinstance(argument, Grid):
        message = f"`{name.text}` of a matrix or a vector"
        raise ReadError(message, name.start, name.end - name.start, "write it of one angle")
    reader.symbols.setdefault("")
    if (degrees := _degrees_meant(argument)) and function != "sqrt":
        reader.notes.setdefault(f"{degrees} is read as {degrees} rad; degrees are written {degrees}°")
    if function == "abs":
        return magnitude(argument)
    if function in _RECIPROCALS:
        above, below = _RECIPROCALS[function]
        return Quotient(Function(above, argument) if above else Number(1), Function(below, argument))
    return Function(function, argument)
