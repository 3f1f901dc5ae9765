"""Moving over the tokens of one formula: one is looked at, brackets close, levels are counted."""

from __future__ import annotations

from dynsolve.answers.reading.limits import MAX_NESTING
from dynsolve.answers.reading.tokens.lexer import Token
from dynsolve.errors import ReadError


class Cursor:
    """A place in a list of tokens; `token` is the one that is looked at, `nesting` the level it is on."""

    __slots__ = ("nesting", "position", "token", "tokens")

    def __init__(self, tokens: list[Token]) -> None:
        end = tokens[-1].end if tokens else 0
        self.tokens = tokens if tokens and tokens[-1].kind == "end" else [*tokens, Token("end", "", end, end)]
        self.position = 0
        self.token = self.tokens[0]
        self.nesting = 0

    def take(self) -> Token:
        """The token that is looked at; the next one is looked at then."""
        token = self.token
        self.position += 1
        self.token = self.tokens[self.position] if self.position < len(self.tokens) else self.tokens[-1]
        return token

    def peek(self, ahead: int = 1) -> Token:
        """A token further on."""
        at = self.position + ahead
        return self.tokens[at] if at < len(self.tokens) else self.tokens[-1]

    def expect(self, kind: str, opening: Token) -> Token:
        """Take the token that closes a bracket."""
        if self.token.kind == kind:
            return self.take()
        if self.token.kind == "end":
            message = f"this `{opening.text}` is never closed"
            raise ReadError(message, opening.start, 1, f"add the `{kind}` that it belongs to")
        raise self.unexpected(f"`{kind}` is expected here")

    def unexpected(self, help: str = "") -> ReadError:
        """The error about the token that is looked at."""
        token = self.token
        if token.kind == "end":
            return ReadError("the formula ends here too early", max(token.start - 1, 0), 1, help)
        if token.kind in (")", "]", "}"):
            help = help or "delete it, or add the bracket that it belongs to"
            return ReadError(f"this `{token.text}` closes nothing", token.start, 1, help)
        if (
            token.kind == ","
            and self.peek().kind == "number"
            and self.tokens[self.position - 1].kind == "number"
        ):
            help = "a decimal is written with a point: 9.81"
        shown = "\\" + token.text if token.kind in ("command", "letter") else token.text
        help = help or "a sum of products of numbers, names and functions is expected"
        length = max(token.end - token.start, 1)
        return ReadError(f"`{shown[:40]}` cannot stand here", token.start, length, help)

    def enter(self) -> None:
        """One level deeper."""
        self.nesting += 1
        if self.nesting > MAX_NESTING:
            message = f"more than {MAX_NESTING} levels of brackets, fractions and signs"
            raise ReadError(message, self.token.start, 1, "name a part of it with an abbreviation")

    def group(self) -> list[Token]:
        """The tokens of an argument: those between braces, or one token."""
        opening = self.take()
        if opening.kind == "end":
            raise ReadError("an argument is missing here", max(opening.start - 1, 0), 1, "write it in { }")
        if opening.kind not in ("{", "("):
            return [opening]
        if opening.kind == "(":
            return [opening, *self.until(")", opening), Token(")", ")", opening.start, opening.start + 1)]
        return self.until("}", opening)

    def until(self, closing: str, opening: Token) -> list[Token]:
        """The tokens up to the bracket that closes, which is taken too."""
        level, start = 1, self.position
        while self.token.kind != "end":
            level += (self.token.kind == opening.kind != closing) - (self.token.kind == closing)
            if level == 0:
                found = self.tokens[start : self.position]
                self.take()
                return found
            self.take()
        message = f"this `{opening.text}` is never closed"
        raise ReadError(message, opening.start, 1, f"add the `{closing}` that it belongs to")
