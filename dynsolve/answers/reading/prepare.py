"""Tokens made ready for reading: the student's macros written out, faces of type left out.

What is left has one spelling for one thing: a group of one token is that token, runs
of letters are cut into the names of the problem (`m_2gL_1` is m_2, g, L_1).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from dynsolve.answers.reading.lexer import Token
from dynsolve.answers.reading.limits import MAX_TOKENS
from dynsolve.answers.reading.vocabulary import Vocabulary, key
from dynsolve.errors import ReadError

_FACES = frozenset(
    "mathbf boldsymbol bm mathrm mathit mathsf mathtt mathbb mathnormal pmb bf rm vec underline "
    "overrightarrow operatorname ensuremath boxed mathop mathord mathrel mathbin smash bold".split()
)
_SCRIPT = frozenset("mathcal mathscr mathfrak cal script".split())
_ENVIRONMENTS = frozenset(
    "cases equation align aligned split gather gathered multline eqnarray alignat alignedat flalign "
    "displaymath math subequations dmath IEEEeqnarray".split()
)
_SINGLE = frozenset({"name", "letter", "number", "text"})
_WORDS = frozenset("and og where hvor der with med so such or eller for då da".split())
_CALLABLE = frozenset("sin cos tan sqrt cot sec csc".split())


@dataclass(frozen=True, slots=True)
class Macro:
    """What a student's own command stands for; `#1` is its argument where `takes` is 1."""

    body: tuple[Token, ...]
    takes: int = 0


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
    """Tokens without faces of type, environments that only align, and groups around one token."""
    out: list[Token] = []
    groups: list[int] = []
    position, last = 0, len(tokens) - 1
    while position <= last:
        token = tokens[position]
        position += 1
        kind = token.kind
        if kind == "command":
            if token.text in _FACES:
                if token.text == "boxed" and tokens[position].kind == "{":
                    groups.append(-1)
                    position += 1
                continue
            if token.text in _SCRIPT:
                token = token._replace(text="script")
            elif token.text in ("frac", "dfrac", "tfrac", "cfrac"):
                token = token._replace(text="frac")
                position = _split_digits(tokens, position, token, out)
                continue
        elif kind in ("begin", "close") and token.text.rstrip("*") in _ENVIRONMENTS:
            position = (
                _skip_columns(tokens, position) if token.text.startswith(("aligned", "alignat")) else position
            )
            continue
        elif kind == "begin" and token.text.startswith("array"):
            position = _skip_group(tokens, position)
        elif kind == "text":
            word = _word(token, out)
            if word is None:
                continue
            token = word
        elif kind == "{":
            groups.append(len(out))
        elif kind == "}" and groups:
            start = groups.pop()
            if start < 0:
                continue
            inside = len(out) - start - 1
            if inside == 1 and out[-1].kind in _SINGLE and out[-1].kind != "text":
                out[start:] = [out[-1]._replace(spaced=out[start].spaced)]
                continue
            if inside == 0:
                del out[start:]
                continue
        out.append(token)
    return out


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
    if word in _CALLABLE:
        return token._replace(kind="name")
    if any(part.strip(",.:;").lower() in _WORDS for part in word.split()):
        return token._replace(kind="separator")
    return None


def _in_script(out: list[Token]) -> bool:
    back = next((i for i in range(len(out) - 1, max(len(out) - 8, -1), -1) if out[i].kind == "{"), -1)
    return back > 0 and out[back - 1].kind in ("_", "^")


def cut_names(tokens: list[Token], vocabulary: Vocabulary, naming: bool = False) -> list[Token]:
    """Runs of letters cut into names: `m_2gL_1` into m_2, g and L_1."""
    out: list[Token] = []
    script = 0
    for position, token in enumerate(tokens):
        if token.kind == "{" and out and out[-1].kind in ("_",):
            script += 1
        elif token.kind == "}" and script:
            script -= 1
        if (
            token.kind != "name"
            or len(token.text) < 2
            or script
            or vocabulary.bare_symbol(token.text) is not None
            or (out and out[-1].kind == "_")
        ):
            out.append(token)
            continue
        open_end = tokens[position + 1].kind == "_" if position + 1 < len(tokens) else False
        called = position + 1 < len(tokens) and tokens[position + 1].kind == "("
        pieces = _pieces(token.text, vocabulary, open_end, called, naming)
        if len(pieces) == 1:
            out.append(token)
            continue
        start = token.start
        for number, piece in enumerate(pieces):
            end = start + len(piece) if token.end - token.start == len(token.text) else token.end
            dots = token.dots if number == 0 else 0
            out.append(Token("name", piece, start, end, dots, token.spaced and number == 0))
            start = end if end != token.end else start
    return out


_LONGEST_RUN = 60


def _pieces(text: str, vocabulary: Vocabulary, open_end: bool, called: bool, naming: bool) -> list[str]:
    """The fewest names that make up a run of letters; the run itself where there are none."""
    if _known(text, vocabulary, naming) or text in CALLS or len(text) > _LONGEST_RUN:
        return [text]
    starts = _starts(text)
    ends = [*starts[1:], len(text)]
    best: dict[int, list[str] | None] = {len(text): []}
    for start in reversed(starts):
        found: list[str] | None = None
        for end in reversed([e for e in ends if e > start]):
            rest = best.get(end)
            piece = text[start:end]
            if rest is None or (found is not None and len(rest) + 1 >= len(found)):
                continue
            final = end == len(text)
            good = _known(piece, vocabulary, naming) or (final and open_end and len(piece) == 1)
            good = good or (piece in _CALLABLE and (not final or called))
            if good:
                found = [piece, *rest]
        best[start] = found
    return best[starts[0]] or [text]


def _starts(text: str) -> list[int]:
    """Where a name may begin: at the letters that are no part of an index in braces."""
    starts, inside = [], False
    for i, character in enumerate(text):
        inside = inside or character == "{"
        if character == "}":
            inside = False
        elif character.isalpha() and not inside and (i == 0 or text[i - 1] != "_"):
            starts.append(i)
    return starts


def _known(piece: str, vocabulary: Vocabulary, naming: bool) -> bool:
    if piece[-1] == "_":
        return False
    name = key(piece)
    if vocabulary.symbol(name) is not None:
        return True
    if name in vocabulary.quantities and (naming or len(name) > 1 or len(piece) == 1):
        return True
    return vocabulary.short_angle(name) is not None


CALLS = frozenset(
    "sin cos tan sqrt cot sec csc Sin Cos Tan Sqrt SIN COS Derivative diff Diff Matrix matrix Rational "
    "transpose Transpose MutableDenseMatrix ImmutableMatrix ImmutableDenseMatrix Integer deg array np".split()
)
"""Words that are functions, never products of letters."""
