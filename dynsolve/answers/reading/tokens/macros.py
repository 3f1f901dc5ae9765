"""The student's own commands, written out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from dynsolve.answers.reading.limits import MAX_TOKENS
from dynsolve.answers.reading.tokens.lexer import Token
from dynsolve.errors import ReadError


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
