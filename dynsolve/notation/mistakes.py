"""The errors about a plain-text formula that cannot be read: the place, the fault, the remedy."""

from __future__ import annotations

import re
from collections.abc import Sequence

from dynsolve.errors import ReadError
from dynsolve.notation.characters import GREEK
from dynsolve.notation.size import MAX_EXPONENT, MAX_NESTING
from dynsolve.notation.tokens import FUNCTIONS, FormulaToken

_FUNCTIONS = ", ".join(FUNCTIONS[:-1]) + f" and {FUNCTIONS[-1]}"
_KNOWN_ELSEWHERE = frozenset(
    "exp log ln asin acos atan atan2 arcsin arccos arctan sinh cosh tanh sec csc cot sgn abs pow max min "
    "sind cosd sine cosine tangent root".split()
)
_UNITS = frozenset("m cm mm kg g s N Nm rad".split())
_EXCERPT = 60


def empty(text: str) -> ReadError:
    """A text without a formula."""
    return ReadError("there is no formula here", 0, max(len(text), 1), "write a number, a name or a formula")


def too_deep(token: FormulaToken) -> ReadError:
    """More levels than are read."""
    message = f"more than {MAX_NESTING} levels of parentheses, signs and powers"
    return ReadError(message, token.start, 1, "name a part of it with a symbol of its own")


def missing_product(text: str, tokens: Sequence[FormulaToken], position: int) -> ReadError:
    """Two factors side by side: the remedy shows the text with its `*`."""
    before, after = tokens[position - 1], tokens[position]
    if after.text.startswith("deg"):
        return bare_degrees(after)
    offset, length = before.end, max(after.start - before.end, 1)
    left, right = text[max(0, before.end - _EXCERPT) : before.end], text[after.start : after.start + _EXCERPT]
    left = left if before.end <= _EXCERPT else "..." + left
    right = right if after.start + _EXCERPT >= len(text) else right + "..."
    corrected = f"{left}*{right}"
    both_numbers = before.kind == after.kind == "number"
    what = "an operator" if both_numbers else "a `*`"
    message = f"{what} is missing between `{before.text}` and `{after.text}`"
    if both_numbers:
        return ReadError(message, offset, length, "a decimal is written with one point: 9.81")
    help = f"products are written out: {' '.join(corrected.split())}"
    if before.kind == "number" and after.text in _UNITS:
        help += f"; if `{after.text}` is the unit, leave it out"
    return ReadError(message, offset, length, help)


def unknown_function(token: FormulaToken, name: str) -> ReadError | None:
    """The error about `name(`, or None where a product with a parenthesis is the likelier reading."""
    length = token.end - token.start
    if name.lower() in FUNCTIONS:
        return ReadError(
            f"unknown function `{token.text}`", token.start, length, f"did you mean `{name.lower()}`?"
        )
    if name in _KNOWN_ELSEWHERE:
        return ReadError(
            f"unknown function `{token.text}`", token.start, length, f"functions are {_FUNCTIONS}"
        )
    if name.isalpha() and len(name) > 2 and name not in GREEK:
        from difflib import get_close_matches

        if close := get_close_matches(name, FUNCTIONS, 1):
            help = f"did you mean `{close[0]}`, or the product `{token.text}*(...)`?"
            return ReadError(f"unknown function `{token.text}`", token.start, length, help)
        if len(name) > 3:
            help = f"functions are {_FUNCTIONS}; a product is written `{token.text}*(...)`"
            return ReadError(f"unknown function `{token.text}`", token.start, length, help)
    return None


def _with_point(text: str, comma: FormulaToken) -> str:
    """What is said of a comma: the number that it was meant in, where digits stand on both sides."""
    before = re.search(r"[0-9]+\Z", text[: comma.start])
    after = re.match(r"[0-9]+", text[comma.end :])
    if before and after:
        return f"did you mean {before[0]}.{after[0]}? A decimal is written with a point"
    return "a decimal is written with a point: 9.81"


def unexpected(text: str, token: FormulaToken) -> ReadError:
    """A token that cannot follow a whole formula."""
    if token.kind == ")":
        return ReadError(
            "this `)` closes nothing", token.start, 1, "delete it, or add the `(` that it belongs to"
        )
    if token.kind == ",":
        return ReadError("a `,` has no meaning here", token.start, 1, _with_point(text, token))
    return ReadError(f"`{token.text}` cannot stand here", token.start, token.end - token.start)


def no_factor(text: str, before: FormulaToken | None, token: FormulaToken) -> ReadError:
    """A number, a name or a parenthesis is expected, and `token` is none."""
    what = "a number, a name or a parenthesis"
    if token.kind == "end":
        after = before or token
        help = f"write {what} after it, or delete it"
        if after.kind == "*":
            help += (
                "; the star that marks a joint variable stands directly after its name, in theta and d alone"
            )
        return ReadError(f"the formula ends after `{after.text}`", after.start, after.end - after.start, help)
    if before is None:
        message = f"the formula begins with `{token.text}`"
    else:
        message = f"`{token.text}` cannot follow `{before.text}`"
    return ReadError(message, token.start, token.end - token.start, f"{what} is expected here")


def empty_parentheses(opening: FormulaToken, closing: FormulaToken) -> ReadError:
    """Parentheses around nothing."""
    length = closing.end - opening.start
    return ReadError(
        "there is nothing between these parentheses", opening.start, length, "write what belongs there"
    )


def unclosed(text: str, opening: FormulaToken, token: FormulaToken) -> ReadError:
    """A parenthesis that does not close before `token`."""
    if token.kind == "end":
        return ReadError("this `(` is never closed", opening.start, 1, "add the `)` that it belongs to")
    if token.kind == ",":
        help = f"functions take one argument; {_with_point(text, token)}"
        return ReadError("a `,` has no meaning here", token.start, 1, help)
    return unexpected(text, token)


def second_power(token: FormulaToken) -> ReadError:
    """x²³ or x²^3: which of the two is meant?"""
    message = "a power of a power needs parentheses"
    return ReadError(message, token.start, token.end - token.start, "write (x^2)^3, or x^6")


def exponent(sign: FormulaToken, start: int, end: int) -> ReadError:
    """An exponent that is no small whole number."""
    message = f"an exponent is a whole number from -{MAX_EXPONENT} to {MAX_EXPONENT}"
    return ReadError(message, start, max(end - start, 1), "a square root is written sqrt(x) or x^(1/2)")


def no_argument(text: str, name: FormulaToken, token: FormulaToken) -> ReadError:
    """A function without parentheses."""
    argument = token.text if token.kind in ("name", "number", "degrees") else "..."
    help = f"write {name.text}({argument})"
    return ReadError(
        f"`{name.text}` needs its argument in parentheses", name.start, name.end - name.start, help
    )


def inverse_function(name: FormulaToken, sign: FormulaToken) -> ReadError:
    """sin^-1(x), or a power of a root."""
    help = f"a power is written {name.text}(x)^2; there are no inverse functions"
    return ReadError(f"this power of `{name.text}` cannot be read", name.start, sign.end - name.start, help)


def bare_degrees(token: FormulaToken) -> ReadError:
    """A `deg` that follows no number."""
    length = token.end - token.start
    if token.text != "deg":
        return ReadError(f"degrees are written `deg`, not `{token.text}`", token.start, length, "write 90deg")
    return ReadError("`deg` stands directly after a number", token.start, length, "write 90deg, or x*pi/180")


def glued_pi(token: FormulaToken) -> ReadError:
    """`πr`, one name to the reader."""
    help = f"products are written out: π*{token.text[1:]}"
    return ReadError(f"a `*` is missing after the π of `{token.text}`", token.start, 1, help)
