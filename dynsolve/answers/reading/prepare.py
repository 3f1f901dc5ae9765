r"""A text made ready for the grammar: its tokens, with macros written out and fonts left out.

What is left has one spelling for one thing: `\mathbf{q}_{1}`, `{q}_1` and `q_1` are the same
tokens.  Nothing here depends on the problem; runs of letters are cut into its names later
(`name_splitting`).
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from dynsolve.answers.reading.lexer import SEPARATORS, Token, tokenize
from dynsolve.answers.reading.limits import MAX_NESTING, MAX_TOKENS
from dynsolve.errors import ReadError

_FONTS = frozenset(
    "mathbf boldsymbol bm mathrm mathit mathsf mathtt mathbb mathnormal pmb bf rm vec underline "
    "overrightarrow operatorname ensuremath boxed fbox framebox mathop mathord mathrel mathbin smash bold "
    "underbar uline uuline undertilde utilde symbf symbfit symrm mathbfit qty quantity bigstrut".split()
)
_SCRIPT = frozenset("mathcal mathscr mathfrak cal script".split())
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

_MATRICES = {"pmatrix": "pmatrix", "bmatrix": "bmatrix", "matrix": "matrix", "mqty": "matrix"} | {
    "pmqty": "pmatrix", "bmqty": "bmatrix", "Pmqty": "pmatrix", "smqty": "matrix"
}  # fmt: skip
"""Commands whose argument is a matrix: `\\pmatrix{a\\cr b}`, as Maxima and plain TeX write it."""

_DERIVATIVES = {"dv": "d", "odv": "d", "derivative": "d", "pdv": "partial", "partialderivative": "partial"}
_STACKED = frozenset({"overset", "underset", "stackrel"})
_FUNCTIONS = frozenset({"sin", "cos", "tan"})
"""The functions that MathML, made to LaTeX, has in a group of their own: `{\\cos}(q_1)`."""

_SINGLE = frozenset({"name", "letter", "number", "text"})
_FRACTIONS = frozenset("frac dfrac tfrac cfrac nicefrac sfrac flatfrac xfrac".split())
_SIGNS = frozenset({"+", "-", "="})
_WORD_AS_NAME = re.compile(r"[A-Za-z][A-Za-z0-9]*(?:_\{?[A-Za-z0-9,]+\}?)?")
_WORDS = frozenset("and og where hvor der with med so such or eller for då da".split())
_FUNCTIONS = frozenset("sin cos tan sqrt cot sec csc".split())
_SYMMETRIC = frozenset({"sym", "symm", "symmetric"})


@dataclass(frozen=True, slots=True)
class Macro:
    """What a student's own command stands for; `#1` is its argument where `takes` is 1."""

    body: tuple[Token, ...]
    takes: int = 0


def prepared(text: str, macros: Mapping[str, Macro] = MappingProxyType({})) -> list[Token]:
    r"""The tokens of a text, ready for the grammar, an `end` token last; raises ReadError where it has none.

    >>> [token.text for token in prepared(r"\mathbf{D}_{1} \tfrac12")]
    ['D', '_', '1', 'frac', '1', '2', '']
    """
    return simplified(expand(tokenize(text), macros))


def expand(tokens: list[Token], macros: Mapping[str, Macro]) -> list[Token]:
    """Write out the student's own commands; raises ReadError where that never ends."""
    if not macros or not any(t.kind == "command" and t.text in macros for t in tokens):
        return tokens
    done: list[Token] = []
    waiting = [(token, 0) for token in reversed(tokens)]
    work = 0
    while waiting:
        token, depth = waiting.pop()
        macro = macros.get(token.text) if token.kind == "command" else None
        if macro is None:
            done.append(token)
            continue
        argument = _argument(waiting) if macro.takes else []
        body = _filled(macro, argument, token)
        work += len(body) + 1
        if work > MAX_TOKENS or depth > 20:
            message = f"the command `\\{token.text}` never ends, or grows without bound"
            raise ReadError(message, token.start, token.end - token.start, "write the formula out")
        waiting += [(part, depth + 1) for part in reversed(body)]
    return done


def _argument(waiting: list[tuple[Token, int]]) -> list[Token]:
    if not waiting or waiting[-1][0].kind == "end":
        return []
    first, _ = waiting.pop()
    if first.kind != "{":
        return [first]
    taken, level = [], 1
    while waiting and waiting[-1][0].kind != "end":
        token, _ = waiting.pop()
        level += {"{": 1, "}": -1}.get(token.kind, 0)
        if level == 0:
            break
        taken.append(token)
    return taken


def _filled(macro: Macro, argument: list[Token], call: Token) -> list[Token]:
    body: list[Token] = []
    for token in macro.body:
        if token.kind == "argument":
            body += argument
        else:
            body.append(token._replace(start=call.start, end=call.end))
    return body


def simplified(tokens: list[Token]) -> list[Token]:
    """Tokens without fonts, environments that only align, and groups around one token."""
    out: list[Token] = []
    groups: list[_Group] = []
    systems: list[list[int]] = []
    position, last, angles = 0, len(tokens) - 1, 0
    while position <= last:
        token = tokens[position]
        position += 1
        kind = token.kind
        if kind == "{":
            groups.append(_Group(len(out)))
            out.append(token)
        elif kind == "}" and groups:
            group = groups.pop()
            if len(out) == group.start + 1 and not group.closes_matrix and _frame_follows(tokens, position):
                out.append(token)
            else:
                _close_group(token, group, out, tokens[position].kind)
            if groups and out[-1].kind == "}":
                groups[-1].depth = max(groups[-1].depth, group.depth + 1)
        elif kind == "command":
            position = _simplify_command(token, tokens, position, groups, out)
        elif kind == "begin" or kind == "close":
            position = _simplify_environment(token, tokens, position, out, systems)
        elif kind == "text":
            word = _word(token, out)
            if word is not None:
                out.append(word)
        elif kind == "]" and _is_unit(out, tokens[position]):
            del out[-2:]
        elif kind == "accent" and out:
            _accent(token, out)
        elif kind == "■" and tokens[position].kind == "(":
            position = _word_matrix(tokens, position, token, out)
        elif kind == "name" and token.text in _INTRODUCING and tokens[position].spaced:
            out.append(token._replace(kind="separator"))
        elif kind == "name" and token.text in _MODULES and _is_qualified(tokens, position):
            position += 1
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


_BEFORE_LIST = frozenset({"=", "⟨", ",", "|", "(", "+", "-", "*"})
"""After which `<` begins a list, as Maple writes one, and compares nothing."""

_UNITS = frozenset({"J", "N", "Nm", "rad", "kg"})


def _is_unit(out: list[Token], after: Token) -> bool:
    r"""Whether the bracket that closes here holds a unit alone: `[\text{J}]`, or `[J]` at the end."""
    if len(out) < 3 or out[-2].kind != "[":
        return False
    at_end = after.kind in ("end", "\\\\", ",", ".", ";", "tag", "}", "&")
    return out[-1].kind == "text" or (at_end and out[-1].kind == "name" and out[-1].text in _UNITS)


_INTRODUCING = frozenset("where with hvor".split())
"""Words of plain text before a definition: `where h = ...`."""
_MODULES = frozenset("sp sym sympy smp np numpy math".split())
_OF_MODULES = frozenset(
    "sin cos tan sqrt pi Matrix array matrix Rational Derivative diff Integer transpose".split()
)


def _is_qualified(tokens: list[Token], position: int) -> bool:
    """Whether a function follows the name of its module: `sp.sin(q1)`."""
    dot, name = tokens[position], tokens[min(position + 1, len(tokens) - 1)]
    return dot.kind == "." and name.text in _OF_MODULES and dot.end == name.start


def _accent(accent: Token, out: list[Token]) -> None:
    """The dots that Word writes behind what they stand over: `(θ_1 ) ̇`, `q ̇_1`."""
    dots = 1 if accent.text == "\u0307" else 2
    last = len(out) - 1
    if out[last].kind == ")" and last > 1 and out[last - 2].kind == "(":
        del out[last], out[last - 2]
        last -= 2
    if out[last].kind in ("name", "letter"):
        out[last] = out[last]._replace(kind="name", dots=out[last].dots + dots, end=accent.end)
    else:
        raise ReadError("these dots stand over no name", accent.start, 1, "write \\dot{q}_1")


def _word_matrix(tokens: list[Token], position: int, sign: Token, out: list[Token]) -> int:
    """Word's `■(a&b@c&d)` as a matrix; gives where to go on."""
    inside: list[Token] = []
    level, opening = 1, tokens[position]
    while level:
        position += 1
        token = tokens[position]
        if token.kind == "end":
            raise ReadError("this `(` is never closed", opening.start, 1, "add the `)` that it belongs to")
        level += {"(": 1, ")": -1}.get(token.kind, 0)
        inside.append(token)
    end = inside.pop()
    out.append(sign._replace(kind="begin", text="matrix"))
    out += simplified([*inside, end._replace(kind="end", text="")])[:-1]
    out.append(end._replace(kind="close", text="matrix"))
    return position + 1


@dataclass(slots=True)
class _Group:
    """A `{` that is open: where it stands among the tokens so far, what its end becomes, how deep it is."""

    start: int
    closes_matrix: bool = False
    depth: int = 0


def _close_group(closing: Token, group: _Group, out: list[Token], following: str) -> None:
    """A group around one token is that token, an empty one nothing; braces that set type are left out."""
    start = group.start
    inside = len(out) - start - 1
    if group.closes_matrix:
        out.append(closing._replace(kind="close", text="matrix"))
    elif inside == 0:
        del out[start:]
    elif inside == 1 and (out[-1].kind in _SINGLE or out[-1].text in _FUNCTIONS):
        out[start:] = [out[-1]._replace(spaced=out[start].spaced)]
    elif group.depth > MAX_NESTING:  # it will not be read, and looking through it would take for ever
        out.append(closing)
    elif (bar := _bar(out, start)) > 0:
        _written_as_fraction(out, start, bar, closing)
    elif following not in ("^", "_", "raised", "'") and _only_sets_type(out, start):
        del out[start]
    else:
        out.append(closing)


def _frame_follows(tokens: list[Token], position: int) -> bool:
    r"""Whether the number of a frame stands there, so that the `{}` before it begins a name: `{}^0T_2`."""
    if tokens[position].kind not in ("^", "_"):
        return False
    ahead = [token.kind for token in tokens[position + 1 : position + 4]]
    return ahead[:1] == ["number"] or ahead == ["{", "number", "}"]


def _level_of(token: Token) -> int:
    return (token.kind in ("{", "(", "[", "begin")) - (token.kind in ("}", ")", "]", "close"))


def _only_sets_type(out: list[Token], start: int) -> bool:
    r"""Whether the group that opens there is no argument, and holds an equation or a signed term.

    `{\color{red} K = a}` is `K = a`, and `a {\color{red} - b}` is `a - b`, as they look in print.
    """
    first = out[start + 1].kind
    level, holds = 0, first in _SIGNS or out[-1].kind in _SIGNS
    for token in out[start + 1 :]:
        level += _level_of(token)
        holds = holds or (level == 0 and token.kind in ("=", "&", "\\\\"))
        if level == 0 and token.kind == ",":
            return False  # a list, as Mathematica writes it
    return holds and not _is_argument(out, start)


def _is_argument(out: list[Token], start: int) -> bool:
    """Whether the group that opens there belongs to a script or a command."""
    before = start - 1
    if before < 0:
        return False
    if out[before].kind in ("_", "^") or (
        out[before].kind == "command" and out[before].text not in SEPARATORS
    ):
        return True
    level = 0
    while before >= 0:  # the second argument of a fraction
        level -= _level_of(out[before])
        before -= 1
        if level <= 0:
            break
    return before >= 0 and out[before].kind == "command" and out[before].text in ("frac", "binom")


def _bar(out: list[Token], start: int) -> int:
    r"""Where the `\over` of a group stands, 0 where there is none."""
    level = 0
    for position in range(start + 1, len(out)):
        level += _level_of(out[position])
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
        level += _level_of(token)
        if level == 0:
            return tokens[1:-1] if position == len(tokens) - 1 else tokens
    return tokens


def _power_before(out: list[Token]) -> int:
    """Where the power begins that stands between a name and its index: the `^` of m^2_1; 0 for none."""
    last = len(out) - 1
    if out[last].kind == "}":
        level = 0
        while last > 0:
            level -= _level_of(out[last])
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
            level += _level_of(tokens[position])
            position += 1
    elif index[1].kind == "end":
        index.pop()
        position -= 1
    out[power:power] = simplified([*index, Token("end", "", sign.end, sign.end)])[:-1]
    return position


def _simplify_command(
    token: Token, tokens: list[Token], position: int, groups: list[_Group], out: list[Token]
) -> int:
    """A command with one spelling, or left out if it is a font; gives where to go on."""
    if token.text in _FONTS:
        return position
    if token.text in _FRACTIONS:
        return _split_digits(tokens, position, token._replace(text="frac"), out)
    if token.text in _MATRICES and tokens[position].kind == "{":
        groups.append(_Group(len(out), True))
        out.append(token._replace(kind="begin", text=_MATRICES[token.text]))
        return position + 1
    if token.text in _DERIVATIVES:
        return _write_derivative(tokens, position, token, out)
    if token.text in _STACKED:
        over, position = _taken_group(tokens, position)
        dots = sum(len(t.text) if t.kind == "." else t.kind == "cdot" for t in over)
        if dots and dots == len(over) and dots < 3:
            out.append(token._replace(text="dot" if dots == 1 else "ddot"))
        return position
    out.append(token._replace(text="script") if token.text in _SCRIPT else token)
    return position


def _simplify_environment(
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


def _split_digits(tokens: list[Token], position: int, command: Token, out: list[Token]) -> int:
    r"""`\frac12`: each digit is an argument."""
    out.append(command)
    token = tokens[position]
    if token.kind == "number" and len(token.text) > 1 and token.text.isdigit():
        first, second = token.start, token.start + 1
        out.append(token._replace(text=token.text[0], end=second))
        out.append(token._replace(text=token.text[1], start=second, end=second + 1))
        if len(token.text) > 2:
            out.append(token._replace(text=token.text[2:], start=first + 2))
        return position + 1
    return position


def _skip_arguments(tokens: list[Token], position: int, environment: str) -> int:
    r"""Behind the `[t]` of `\begin{aligned}[t]`, the `[1.3]` of a matrix, the `{cc}` of an array."""
    option = tokens[position : position + 3]
    if [t.kind for t in option] == ["[", "name", "]"] and option[1].text in ("t", "b", "c"):
        position += 3
    elif option[0].kind == "[" and environment == "empheq":
        while tokens[position].kind not in ("]", "end"):
            position += 1
        position += tokens[position].kind == "]"
    elif (
        [t.kind for t in option] == ["[", "number", "]"] and "matrix" in environment and not option[0].spaced
    ):
        position += 3
    if environment.startswith(_WITH_COLUMNS) and tokens[position].kind == "{":
        _, position = _taken_group(tokens, position)
    return position


def _taken_group(tokens: list[Token], position: int) -> tuple[list[Token], int]:
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
    of, position = _taken_group(tokens, position)
    by: list[Token] = of
    if tokens[position].kind == "{":
        by, position = _taken_group(tokens, position)
    else:
        of = []
    end = Token("end", "", command.end, command.end)
    above, below = simplified([*of, end])[:-1], simplified([*by, end])[:-1]
    out.append(command._replace(text="frac"))
    out += [opening, d, *order, *above, closing, opening, d, *below, *order, closing]
    return position


def _word(token: Token, out: list[Token]) -> Token | None:
    r"""`\text{...}`: an index, a function, a word between equations, or nothing."""
    word = token.text
    if word.strip(". ").lower() in _SYMMETRIC and out and out[-1].kind in ("&", "\\\\", "begin"):
        return token._replace(kind="name", text="sym")
    if (
        out
        and not word.isdecimal()
        and (out[-1].kind in ("_", "^") or (out[-1].kind in ("{", ",", "name") and _in_script(out)))
    ):
        return (
            token._replace(kind="name") if word.isascii() and word.isalnum() and word[0].isalpha() else None
        )
    if word in _FUNCTIONS:
        return token._replace(kind="name")
    if word.isdecimal() and word.isascii():
        return token._replace(kind="number")
    if _WORD_AS_NAME.fullmatch(word) and word.lower() not in _WORDS:
        return token
    if any(part.strip(",.:;").lower() in _WORDS for part in word.split()):
        return token._replace(kind="separator")
    return None


def _in_script(out: list[Token]) -> bool:
    back = next((i for i in range(len(out) - 1, max(len(out) - 8, -1), -1) if out[i].kind == "{"), -1)
    return back > 0 and out[back - 1].kind in ("_", "^")
