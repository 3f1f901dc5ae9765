r"""Groups in braces: around one token, an argument, `{a \over b}`, or there to set type alone."""

from __future__ import annotations

from dataclasses import dataclass

from dynsolve.answers.reading.limits import MAX_NESTING
from dynsolve.answers.reading.tokens.lexer import SEPARATORS, Token

_SINGLE = frozenset({"name", "letter", "number", "text"})
_FUNCTIONS = frozenset("sin cos tan sqrt cot sec csc".split())
_FRACTIONS = ("frac", "binom")
_SIGNS = frozenset({"+", "-", "="})


@dataclass(slots=True)
class Group:
    """A `{` that is open: where it stands among the tokens so far, what its end becomes, how deep it is."""

    start: int
    closes_matrix: bool = False
    depth: int = 0


def close_group(closing: Token, group: Group, out: list[Token], following: str) -> None:
    """A group around one token is that token, an empty one nothing; braces that set type are left out."""
    start = group.start
    inside = len(out) - start - 1
    if group.closes_matrix:
        out.append(closing._replace(kind="close", text="matrix"))
    elif inside == 0:
        del out[start:]
    elif inside == 1 and _is_one(out, start):
        out[start:] = [out[-1]._replace(spaced=out[start].spaced)]
    elif group.depth > MAX_NESTING:  # it will not be read, and looking through it would take for ever
        out.append(closing)
    elif (bar := _bar(out, start)) > 0:
        _written_as_fraction(out, start, bar, closing)
    elif following not in ("^", "_", "raised", "'") and (
        _only_sets_type(out, start) or _is_fraction_alone(out, start)
    ):
        del out[start]
    else:
        out.append(closing)


def _is_one(out: list[Token], start: int) -> bool:
    r"""Whether the token that stands alone in its group is one factor: `ml` below a line may be two."""
    token = out[-1]
    if token.kind in ("name", "text") and len(token.text) > 1 and _is_divided(out, start):
        return False
    return token.kind in _SINGLE or token.text in _FUNCTIONS


def frame_follows(tokens: list[Token], position: int) -> bool:
    r"""Whether the number of a frame stands there, so that the `{}` before it begins a name: `{}^0T_2`."""
    if tokens[position].kind not in ("^", "_"):
        return False
    ahead = [token.kind for token in tokens[position + 1 : position + 4]]
    return ahead[:1] == ["number"] or ahead == ["{", "number", "}"]


def level_of(token: Token) -> int:
    """1 for what opens a level, -1 for what closes one."""
    return (token.kind in ("{", "(", "[", "begin")) - (token.kind in ("}", ")", "]", "close"))


def _only_sets_type(out: list[Token], start: int) -> bool:
    r"""Whether the group that opens there is no argument, and holds an equation or a signed term.

    `{\color{red} K = a}` is `K = a`, and `a {\color{red} - b}` is `a - b`, as they look in print.
    """
    first = out[start + 1].kind
    level, holds = 0, first in _SIGNS or out[-1].kind in _SIGNS
    for token in out[start + 1 :]:
        level += level_of(token)
        holds = holds or (level == 0 and token.kind in ("=", "&", "\\\\"))
        if level == 0 and token.kind == ",":
            return False  # a list, as Mathematica writes it
    return holds and not _is_argument(out, start)


def _is_fraction_alone(out: list[Token], start: int) -> bool:
    r"""Whether the group that opens there holds one fraction, as Maple writes it: `{\frac {d}{dt}}r`."""
    if out[start + 1].text != "frac" or _is_argument(out, start):
        return False
    inside, position = [*out[start + 2 :], out[-1]._replace(kind="end")], 0
    for _ in range(2):
        _, position = taken_group(inside, position)
    return position == len(inside) - 1


def _is_argument(out: list[Token], start: int) -> bool:
    """Whether the group that opens there belongs to a script or a command."""
    before = start - 1
    if before < 0:
        return False
    if out[before].kind in ("_", "^") or (
        out[before].kind == "command" and out[before].text not in SEPARATORS
    ):
        return True
    return _is_divided(out, start)


def _is_divided(out: list[Token], start: int) -> bool:
    """Whether the group that opens there is an argument of a fraction, or stands under a root."""
    before = start - 1
    if before >= 0 and out[before].kind == "command" and out[before].text in (*_FRACTIONS, "sqrt"):
        return True
    level = 0
    while before >= 0:  # the second argument of a fraction
        level -= level_of(out[before])
        before -= 1
        if level <= 0:
            break
    return before >= 0 and out[before].kind == "command" and out[before].text in _FRACTIONS


def _bar(out: list[Token], start: int) -> int:
    r"""Where the `\over` of a group stands, 0 where there is none."""
    level = 0
    for position in range(start + 1, len(out)):
        level += level_of(out[position])
        if level == 0 and out[position].kind == "over":
            return position
    return 0


def _written_as_fraction(out: list[Token], start: int, bar: int, closing: Token) -> None:
    r"""`{a \over b}` as `\frac{a}{b}`."""
    opening, above, below = out[start], _bare(out[start + 1 : bar]), _bare(out[bar + 1 :])
    end = closing._replace(kind="}", text="}")
    command = opening._replace(kind="command", text="frac")
    out[start:] = [command, opening, *above, end, opening, *below, end]


def _bare(tokens: list[Token]) -> list[Token]:
    """The tokens without the braces around all of them."""
    if len(tokens) < 3 or tokens[0].kind != "{" or tokens[-1].kind != "}":
        return tokens
    level = 0
    for position, token in enumerate(tokens):
        level += level_of(token)
        if level == 0:
            return tokens[1:-1] if position == len(tokens) - 1 else tokens
    return tokens


def taken_group(tokens: list[Token], position: int) -> tuple[list[Token], int]:
    """The tokens of the argument there, without its braces, and where it has ended."""
    if tokens[position].kind != "{":
        single = tokens[position].kind != "end"
        return tokens[position : position + single], position + single
    start, level = position + 1, 0
    while tokens[position].kind != "end":
        level += {"{": 1, "}": -1}.get(tokens[position].kind, 0)
        position += 1
        if level == 0:
            return tokens[start : position - 1], position
    return tokens[start:position], position
