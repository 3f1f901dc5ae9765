r"""A text made ready for the grammar: its tokens, with macros written out and fonts left out.

What is left has one spelling for one thing: `\mathbf{q}_{1}`, `{q}_1` and `q_1` are the same
tokens.  Nothing here depends on the problem; runs of letters are cut into its names later
(`name_splitting`).

`\begin` and `\end`: those that only align are left out, with the arguments that are no formula.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType

from msgspec import Struct

from dynsolve.answers.reading.grids import MAX_NESTING
from dynsolve.answers.reading.lexer import (
    SEPARATORS,
    Macro,
    Token,
    accent,
    expand,
    is_qualified,
    is_unit,
    token_of_word,
    tokenize,
)
from dynsolve.notation.characters import SPELLED

# Groups in braces: around one token, an argument, `{a \over b}`, or there to set type alone

_SINGLE = frozenset({"name", "letter", "number", "text"})
_FUNCTIONS = frozenset("sin cos tan sqrt cot sec csc".split())
_GROUPS_FRACTIONS = ("frac", "binom")
_SIGNS = frozenset({"+", "-", "="})


class Group(Struct):
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
    if start == 0:
        return False
    before = out[start - 1]
    is_command = before.kind == "command" and before.text not in SEPARATORS
    return is_command or before.kind in ("_", "^") or _is_divided(out, start)


def _is_divided(out: list[Token], start: int) -> bool:
    """Whether the group that opens there is an argument of a fraction, or stands under a root."""
    before = start - 1
    if before >= 0 and out[before].kind == "command" and out[before].text in (*_GROUPS_FRACTIONS, "sqrt"):
        return True
    level = 0
    while before >= 0:  # the second argument of a fraction
        level -= level_of(out[before])
        before -= 1
        if level <= 0:
            break
    return before >= 0 and out[before].kind == "command" and out[before].text in _GROUPS_FRACTIONS


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
    inside, end = taken_group([*tokens, tokens[-1]._replace(kind="end")], 0)
    return inside if end == len(tokens) else tokens


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


# `\begin` and `\end`

_ENVIRONMENTS = frozenset(
    "equation align aligned split gather gathered multline multlined eqnarray "
    "alignat alignedat flalign xalignat displaymath math subequations dmath dgroup darray empheq "
    "IEEEeqnarray IEEEeqnarraybox lgathered rgathered".split()
)
"""Environments that only align."""
_SYSTEMS = frozenset({"cases", "dcases", "rcases", "drcases"})
"""Environments with a brace at their side: around equations, or around the entries of a column."""
_WITH_COLUMNS = ("array", "alignat", "alignedat", "xalignat", "IEEEeqnarray", "empheq")
"""Environments whose name is followed by an argument that is no formula."""


def simplify_environment(
    token: Token, tokens: list[Token], position: int, out: list[Token], systems: list[list[int]]
) -> int:
    r"""`\begin` or `\end`, left out where the environment only aligns; gives where to go on.

    `systems` are where the `cases` that are open begin, with 1 where they hold equations; a column
    holds none.
    """
    name = token.text.rstrip("*")
    if name in _SYSTEMS and token.kind == "begin":
        systems.append([len(out), 0])
    elif name in _SYSTEMS and systems:
        start, holds_equations = systems.pop()
        if systems:
            systems[-1][1] |= holds_equations
        if start and not holds_equations:
            out.insert(start, token._replace(kind="begin", text="matrix"))
            out.append(token._replace(text="matrix"))
    elif name not in _ENVIRONMENTS:
        out.append(token)
    return _skip_arguments(tokens, position, name) if token.kind == "begin" else position


def _skip_arguments(tokens: list[Token], position: int, environment: str) -> int:
    r"""Behind the `[t]` of `\begin{aligned}[t]`, the `[1.3]` of a matrix, the `{cc}` of an array."""
    option = tokens[position : position + 3]
    kinds = [t.kind for t in option]
    is_aligned = kinds == ["[", "name", "]"] and option[1].text in ("t", "b", "c")
    is_stretched = kinds == ["[", "number", "]"] and "matrix" in environment and not option[0].spaced
    if is_aligned or is_stretched:
        position += 3
    elif option[0].kind == "[" and environment == "empheq":
        while tokens[position].kind not in ("]", "end"):
            position += 1
        position += tokens[position].kind == "]"
    if environment.startswith(_WITH_COLUMNS) and tokens[position].kind == "{":
        _, position = taken_group(tokens, position)
    return position


_FONTS = frozenset(
    "mathbf boldsymbol bm mathrm mathit mathsf mathtt mathbb mathnormal pmb bf rm vec underline "
    "overrightarrow operatorname ensuremath boxed fbox framebox mathop mathord mathrel mathbin smash bold "
    "underbar uline uuline undertilde utilde symbf symbfit symrm mathbfit si unit qty quantity "
    "bigstrut".split()
)
_SCRIPT = frozenset("mathcal mathscr mathfrak cal script".split())
_MATRICES = {"pmatrix": "pmatrix", "bmatrix": "bmatrix", "matrix": "matrix", "mqty": "matrix"} | {
    "pmqty": "pmatrix", "bmqty": "bmatrix", "Pmqty": "pmatrix", "smqty": "matrix"
}  # fmt: skip
"""Commands whose argument is a matrix: `\\pmatrix{a\\cr b}`, as Maxima and plain TeX write it."""
_CANCELLED = frozenset("cancel bcancel xcancel hcancel sout st".split())
_ACCENTS = {"widehat": "hat", "widetilde": "tilde", "overline": "bar"}
_BEFORE_TERM = frozenset({"+", "-", "=", "&", "\\\\", "(", "[", "{", "begin"})
_AFTER_TERM = frozenset({"+", "-", "=", "&", "\\\\", ")", "]", "}", "close", "end", ",", ";"})
"""What stands beside a whole term."""
_DERIVATIVES = {"dv": "d", "odv": "d", "derivative": "d", "pdv": "partial", "partialderivative": "partial"}
_STACKED = frozenset({"overset", "underset", "stackrel"})
_FRACTIONS = frozenset("frac dfrac tfrac cfrac nicefrac sfrac flatfrac xfrac".split())
_ONE_TOKEN = re.compile(
    rf"(?P<first>(?:{'|'.join(SPELLED.values())}|[A-Za-z])(?:_(?:\{{[^}}]*\}}|[A-Za-z0-9]))?|[0-9])"
    r"(?P<digits>[0-9]*)(?P<rest>(?:[A-Za-z].*)?)"
)
"""What an argument without braces is cut into: what TeX takes, a number, and what is left."""
_POWERED = frozenset("sin cos tan".split())
_BEFORE_LIST = frozenset({"=", "⟨", ",", "|", "(", "+", "-", "*"})
"""After which `<` begins a list, as Maple writes one, and compares nothing."""
_INTRODUCING = frozenset("where with hvor".split())
"""Words of plain text before a definition: `where h = ...`."""


def prepared(text: str, macros: Mapping[str, Macro] = MappingProxyType({})) -> list[Token]:
    r"""The tokens of a text, ready for the grammar, an `end` token last; raises ReadError where it has none.

    >>> [token.text for token in prepared(r"\mathbf{D}_{1} \tfrac12")]
    ['D', '_', '1', 'frac', '1', '2', '']
    """
    return simplified(expand(tokenize(text), macros))


def simplified(tokens: list[Token]) -> list[Token]:
    """Tokens without fonts, environments that only align, and groups around one token."""
    out: list[Token] = []
    groups: list[Group] = []
    systems: list[list[int]] = []
    position, angles = 0, 0
    while position < len(tokens):
        token = tokens[position]
        position += 1
        kind = token.kind
        if kind == "{":
            groups.append(Group(len(out)))
            out.append(token)
        elif kind == "}" and groups:
            is_first = out[groups[-1].start - 1].text == "frac" and groups[-1].start > 0
            _close(token, tokens, position, groups, out)
            if is_first:
                _one_token(tokens, position)
        elif kind == "command":
            position = _simplify_command(token, tokens, position, groups, out)
        elif kind == "begin" or kind == "close":
            position = simplify_environment(token, tokens, position, out, systems)
        elif kind == "text":
            said = token_of_word(token, out)
            if said is not None:
                out.append(said)
        elif kind == "]" and is_unit(out, tokens[position]):
            del out[-2:]
        elif kind == "accent" and out:
            accent(token, out)
        elif kind == "■" and tokens[position].kind == "(":
            position = _word_matrix(tokens, position, token, out)
        elif kind == "name" and token.text in _INTRODUCING and tokens[position].spaced:
            out.append(token._replace(kind="separator"))
        elif kind == "name" and is_qualified(token, tokens, position):
            position += 1
        elif kind == "$" and out and (out[-1].kind == "{" or tokens[position].kind == "}"):
            continue  # a box around a formula: \\fbox{$a$}
        elif kind == "=" and systems:
            systems[-1][1] = 1
            out.append(token)
        elif kind == "<" and out and out[-1].kind in _BEFORE_LIST:
            angles += 1
            out.append(token._replace(kind="⟨"))
        elif kind == ">" and angles:
            angles -= 1
            out.append(token._replace(kind="⟩"))
        elif kind == "_" and out and (power := _power_before(out)):
            position = _index(tokens, position, token, power, out)
        else:
            out.append(token)
    return out


def _close(brace: Token, tokens: list[Token], position: int, groups: list[Group], out: list[Token]) -> None:
    """The end of a group; an empty one stays before the frame of what follows: {}^0 R."""
    group = groups.pop()
    is_empty = len(out) == group.start + 1 and not group.closes_matrix
    if is_empty and frame_follows(tokens, position):
        out.append(brace)
    else:
        close_group(brace, group, out, tokens[position].kind)
    if groups and out[-1].kind == "}":
        groups[-1].depth = max(groups[-1].depth, group.depth + 1)


def _word_matrix(tokens: list[Token], position: int, sign: Token, out: list[Token]) -> int:
    """Word's `■(a&b@c&d)` as a matrix; gives where to go on."""
    inside: list[Token] = []
    level, opening = 1, tokens[position]
    while level:
        position += 1
        token = tokens[position]
        if token.kind == "end":
            raise opening.fault("this `(` is never closed", "add the `)` that it belongs to", 1)
        level += {"(": 1, ")": -1}.get(token.kind, 0)
        inside.append(token)
    end = inside.pop()
    out.append(sign._replace(kind="begin", text="matrix"))
    out += simplified([*inside, end._replace(kind="end", text="")])[:-1]
    out.append(end._replace(kind="close", text="matrix"))
    return position + 1


def _power_before(out: list[Token]) -> int:
    """Where the power begins that stands between a name and its index: the `^` of m^2_1; 0 for none."""
    last = len(out) - 1
    if out[last].kind == "}":
        level = 0
        while last > 0:
            level -= level_of(out[last])
            if level == 0:
                break
            last -= 1
    caret = last - 1
    if caret < 1 or out[caret].kind != "^":
        return 0
    return caret if out[caret - 1].kind in ("name", "letter", "}", "text") else 0


def _index(tokens: list[Token], position: int, sign: Token, power: int, out: list[Token]) -> int:
    """Put the index that follows before the power; gives where to go on."""
    index = [sign, tokens[position]]
    position += 1
    if index[1].kind == "{":
        level = 1
        while level and tokens[position].kind != "end":
            index.append(tokens[position])
            level += level_of(tokens[position])
            position += 1
    elif index[1].kind == "end":
        index.pop()
        position -= 1
    out[power:power] = simplified([*index, Token("end", "", sign.end, sign.end)])[:-1]
    return position


def _simplify_command(
    token: Token, tokens: list[Token], position: int, groups: list[Group], out: list[Token]
) -> int:
    """A command with one spelling, or left out if it is a font; gives where to go on."""
    if token.text in _FONTS:
        if token.spaced and tokens[position].kind != "end":
            tokens[position] = tokens[position]._replace(spaced=True)
        return _script_inside(tokens, position, out)
    if token.text in _CANCELLED or token.text == "cancelto":
        return _without_cancelled(token, tokens, position, out)
    if token.text in ("underbrace", "overbrace"):
        _, end = taken_group(tokens, position)
        if tokens[end].kind in ("_", "^"):
            del tokens[end : taken_group(tokens, end + 1)[1]]
        return position
    if token.text in _FRACTIONS:
        out.append(token._replace(text="frac"))
        if tokens[position].kind in ("name", "number", "letter"):
            _one_token(tokens, position)
            out.append(tokens[position])
            position += 1
            _one_token(tokens, position)
        return position
    if token.text in _MATRICES and tokens[position].kind == "{":
        groups.append(Group(len(out), True))
        out.append(token._replace(kind="begin", text=_MATRICES[token.text]))
        return position + 1
    if token.text in _DERIVATIVES:
        return _write_derivative(tokens, position, token, out)
    if token.text in _STACKED:
        over, position = taken_group(tokens, position)
        if 0 < len(over) < 3 and all(t.kind in (".", "cdot") for t in over):
            out.append(token._replace(text="dot" if len(over) == 1 else "ddot"))
        return position
    empty = [t.kind for t in tokens[position : position + 2]] == ["{", "}"]
    if token.text in ("dot", "ddot") and empty and out and out[-1].kind == ")":  # (m r²)\dot{}
        power, dot = token._replace(kind="^", text="^"), token._replace(kind="cdot")
        out += [power, token._replace(kind="{"), *[dot] * (len(token.text) - 2), token._replace(kind="}")]
        return position + 2
    text = "script" if token.text in _SCRIPT else _ACCENTS.get(token.text, token.text)
    out.append(token._replace(text=text))
    has_power = token.text in _POWERED and tokens[position].kind == "^"
    if has_power or token.text == "sqrt":
        _one_token(tokens, position + has_power)
    return position


def _without_cancelled(command: Token, tokens: list[Token], position: int, out: list[Token]) -> int:
    r"""`\cancel{a}`: of a term nothing is left, of a factor or a numerator 1; `\cancelto{0}{a}` says what.

    Gives where to go on.
    """
    inside, end = taken_group(tokens, position)
    if command.text == "cancelto":
        del tokens[end : taken_group(tokens, end)[1]]
        return position
    before = out[-1].kind if out else "="
    if before in _BEFORE_TERM and tokens[end].kind in _AFTER_TERM and inside[:1] != []:
        is_argument = before == "{" and tokens[end].kind == "}"
        left = "1" if is_argument else "0"
        if inside[0].kind not in ("+", "-"):
            out.append(command._replace(kind="number", text=left))
    return end


def _script_inside(tokens: list[Token], position: int, out: list[Token]) -> int:
    r"""A script letter in bold, `\boldsymbol{\mathcal{I}}`, is one without: its outer braces are left out."""
    inner = tokens[position : position + 6]
    kinds = [token.kind for token in inner]
    is_bare = kinds in (["{", "command", "{", kind, "}", "}"] for kind in ("name", "letter"))
    if not is_bare or inner[1].text not in _SCRIPT:
        return position
    out += [inner[1]._replace(text="script"), *inner[2:5]]
    return position + len(inner)


def _one_token(tokens: list[Token], position: int) -> None:
    r"""Cut an argument without braces off from what is run together with it: the `c` of `\frac c2`.

    TeX takes one character; the index of a letter stays with it.
    """
    token = tokens[position]
    found = _ONE_TOKEN.fullmatch(token.text) if token.kind in ("name", "number") else None
    if found is None or token.text == "dt":
        return
    tokens[position : position + 1] = [
        token._replace(
            kind="number" if piece.isdigit() else "name",
            text=piece,
            start=min(token.start + found.start(group), token.end),
            end=min(token.start + found.end(group), token.end),
        )
        for group in ("first", "digits", "rest")
        if (piece := found[group])
    ]


def _write_derivative(tokens: list[Token], position: int, command: Token, out: list[Token]) -> int:
    r"""`\dv{x}{t}` as `\frac{d x}{d t}`, `\dv{t}` as `\frac{d}{d t}`; gives where to go on."""
    d = command._replace(kind="name", text="d")
    if _DERIVATIVES[command.text] == "partial":
        d = command._replace(text="partial")
    order: list[Token] = []
    if tokens[position].kind == "[" and tokens[position + 2].kind == "]":
        order = [command._replace(kind="^", text="^"), tokens[position + 1]]
        position += 3
    opening, closing = command._replace(kind="{", text="{"), command._replace(kind="}", text="}")
    of, position = taken_group(tokens, position)
    by: list[Token] = of
    if tokens[position].kind == "{":
        by, position = taken_group(tokens, position)
    else:
        of = []
    end = Token("end", "", command.end, command.end)
    above, below = simplified([*of, end])[:-1], simplified([*by, end])[:-1]
    out.append(command._replace(text="frac"))
    out += [opening, d, *order, *above, closing, opening, d, *below, *order, closing]
    return position
