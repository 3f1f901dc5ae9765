r"""A text made ready for the grammar: its tokens, with macros written out and fonts left out.

What is left has one spelling for one thing: `\mathbf{q}_{1}`, `{q}_1` and `q_1` are the same
tokens.  Nothing here depends on the problem; runs of letters are cut into its names later
(`name_splitting`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from dynsolve.answers.reading.lexer import Token, tokenize
from dynsolve.answers.reading.limits import MAX_TOKENS
from dynsolve.errors import ReadError

_FONTS = frozenset(
    "mathbf boldsymbol bm mathrm mathit mathsf mathtt mathbb mathnormal pmb bf rm vec underline "
    "overrightarrow operatorname ensuremath boxed mathop mathord mathrel mathbin smash bold".split()
)
_SCRIPT = frozenset("mathcal mathscr mathfrak cal script".split())
_ENVIRONMENTS = frozenset(
    "cases equation align aligned split gather gathered multline eqnarray alignat alignedat flalign "
    "displaymath math subequations dmath IEEEeqnarray".split()
)
_SINGLE = frozenset({"name", "letter", "number"})
_WORDS = frozenset("and og where hvor der with med so such or eller for då da".split())
_FUNCTIONS = frozenset("sin cos tan sqrt cot sec csc".split())


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
    groups: list[int] = []  # where in `out` each open `{` stands; -1 for one that is left out
    position, last = 0, len(tokens) - 1
    while position <= last:
        token = tokens[position]
        position += 1
        kind = token.kind
        if kind == "{":
            groups.append(len(out))
            out.append(token)
        elif kind == "}" and groups:
            _close_group(token, groups.pop(), out)
        elif kind == "command":
            position = _simplify_command(token, tokens, position, groups, out)
        elif kind == "begin" or kind == "close":
            position = _simplify_environment(token, tokens, position, out)
        elif kind == "text":
            word = _word(token, out)
            if word is not None:
                out.append(word)
        else:
            out.append(token)
    return out


def _close_group(closing: Token, start: int, out: list[Token]) -> None:
    """A group around one token is that token, an empty one is nothing."""
    if start < 0:
        return
    inside = len(out) - start - 1
    if inside == 0:
        del out[start:]
    elif inside == 1 and out[-1].kind in _SINGLE:
        out[start:] = [out[-1]._replace(spaced=out[start].spaced)]
    else:
        out.append(closing)


def _simplify_command(
    token: Token, tokens: list[Token], position: int, groups: list[int], out: list[Token]
) -> int:
    """A command with one spelling, or left out if it is a font; gives where to go on."""
    if token.text in _FONTS:
        if token.text == "boxed" and tokens[position].kind == "{":
            groups.append(-1)
            return position + 1
        return position
    if token.text in ("frac", "dfrac", "tfrac", "cfrac"):
        return _split_digits(tokens, position, token._replace(text="frac"), out)
    out.append(token._replace(text="script") if token.text in _SCRIPT else token)
    return position


def _simplify_environment(token: Token, tokens: list[Token], position: int, out: list[Token]) -> int:
    r"""`\begin` or `\end`, left out where the environment only aligns; gives where to go on."""
    name = token.text
    if name.rstrip("*") in _ENVIRONMENTS:
        return _skip_columns(tokens, position) if name.startswith(("aligned", "alignat")) else position
    out.append(token)
    return _skip_group(tokens, position) if token.kind == "begin" and name.startswith("array") else position


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


def _skip_columns(tokens: list[Token], position: int) -> int:
    r"""The `{2}` of `\begin{alignat}{2}`."""
    if [t.kind for t in tokens[position : position + 3]] == ["{", "number", "}"]:
        return position + 3
    return position


def _skip_group(tokens: list[Token], position: int) -> int:
    r"""The `{cc}` of `\begin{array}{cc}`."""
    if tokens[position].kind != "{":
        return position
    while position < len(tokens) - 1 and tokens[position].kind != "}":
        position += 1
    return min(position + 1, len(tokens) - 1)


def _word(token: Token, out: list[Token]) -> Token | None:
    r"""`\text{...}`: an index, a function, a word between equations, or nothing."""
    word = token.text
    if out and (out[-1].kind in ("_", "^") or (out[-1].kind in ("{", ",", "name") and _in_script(out))):
        return (
            token._replace(kind="name") if word.isascii() and word.isalnum() and word[0].isalpha() else None
        )
    if word in _FUNCTIONS:
        return token._replace(kind="name")
    if any(part.strip(",.:;").lower() in _WORDS for part in word.split()):
        return token._replace(kind="separator")
    return None


def _in_script(out: list[Token]) -> bool:
    back = next((i for i in range(len(out) - 1, max(len(out) - 8, -1), -1) if out[i].kind == "{"), -1)
    return back > 0 and out[back - 1].kind in ("_", "^")
