"""One display of a report, cut into equations, and these into the members of a chain."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.answers.reading.grids import MAX_LENGTH
from dynsolve.answers.reading.lexer import SEPARATORS, Token
from dynsolve.answers.verdict import Place

Locate = Callable[[int, int], Place]
"""(offset, length) in the text of a display -> where that is in the file."""


class Display(Struct, frozen=True):
    """The text of one displayed equation, or of several below one another.

    `plain` is one in plain text; `among_prose` one in a line that may be a sentence, which is
    listed, never unreadable, where it cannot be read; `aside` says why a formula in the midst of a
    sentence is no equation of its own: it may say what a letter means, and answers what nothing else does;
    `in_case` says why what stands before a display may say that it does not hold in general.
    """

    text: str
    label: str
    locate: Locate
    plain: bool = False
    aside: str = ""
    among_prose: bool = False
    in_case: str = ""

    def behind(self, start: int) -> Display:
        """The part that begins at an offset."""
        return replace(
            self, text=self.text[start:], locate=lambda offset, length: self.locate(start + offset, length)
        )


_GOES_ON = re.compile(r"[\s&]*(?:\\(?:quad|qquad|,|;|!|\s))*\s*(?:[-+=*/]|\\(?:cdot|times)(?![A-Za-z]))")
_IS_OPEN = re.compile(r"(?:[-+=*/(\[]|\\(?:cdot|times|left[(\[]))[\s&]*(?:\\\\)?\s*\Z")
"""How a display begins that goes on with the one before, and how one ends that has not ended."""


def continued(displays: Sequence[tuple[int, Display]]) -> list[tuple[int, Display]]:
    """The displays, those that are one equation put together: `P = a` and, below it, `+ b`."""
    found: list[tuple[int, Display]] = []
    last = -1
    for offset, display in displays:
        before = found[last][1] if last >= 0 and not display.aside else None
        is_typed = before is None or before.plain or display.plain
        if before is not None and not is_typed and _is_one(before.text, display.text):
            found[last] = (found[last][0], _joined(before, display))
        else:
            last = last if display.aside else len(found)
            found.append((offset, display))
    return found


def _is_one(before: str, text: str) -> bool:
    if "=" not in before or len(before) + len(text) > MAX_LENGTH:
        return False
    begins = _GOES_ON.match(text)
    if begins is not None:
        return begins.group().strip(" &\n").endswith("=") or "=" not in text
    return _IS_OPEN.search(before) is not None and "=" not in text


def _joined(first: Display, second: Display) -> Display:
    border = len(first.text) + 1

    def locate(offset: int, length: int) -> Place:
        return first.locate(offset, length) if offset < border else second.locate(offset - border, length)

    label = " ".join(filter(None, (first.label, second.label)))
    return Display(f"{first.text} {second.text}", label, locate)


class Equation(Struct):
    """The members of one chain a = b = c."""

    members: list[list[Token]]
    label: str = ""


OPENS = {"(": 1, "[": 1, "{": 1, "begin": 1, "⟨": 1, ")": -1, "]": -1, "}": -1, "close": -1, "⟩": -1}
_ENDINGS = frozenset({",", ";", ".", ":"})


def equations(tokens: list[Token]) -> list[Equation]:
    """The equations of one display, each with the number that stands in it."""
    found: list[Equation] = []
    for row in _rows(_unwrapped(tokens)):
        own, row = _label(row)
        for piece in _pieces(row):
            members = _members(piece)
            if members:
                found.append(Equation(members, own))
    return found


def _unwrapped(tokens: list[Token]) -> list[Token]:
    r"""The rows of a system in `\left\{ \begin{array} ... \end{array} \right.`; others as they are."""
    inside = [t for t in tokens if t.kind not in ("end", "tag")]
    one_sided = _is_one_sided(inside)
    if inside and inside[0].text in _LEFT_BRACES:
        inside = inside[1:]
    if inside and inside[-1].text in _RIGHT_BRACES:
        inside = inside[:-1]
    if one_sided:
        tokens = [*inside, *(t for t in tokens if t.kind in ("tag", "end"))]
    if len(inside) < 3 or inside[0].kind != "begin" or inside[-1].kind != "close":
        return tokens
    level, holds = 0, False
    for position, token in enumerate(inside):
        level += (token.kind == "begin") - (token.kind == "close")
        if level == 0 and position < len(inside) - 1:
            return tokens
        holds = holds or (level == 1 and token.kind == "=")
    return [*inside[1:-1], *(t for t in tokens if t.kind in ("tag", "end"))] if holds else tokens


def _is_one_sided(tokens: list[Token]) -> bool:
    r"""Whether a brace beside a system of equations, `\left\{ ... \right.`, has no other one."""
    level = sum(OPENS.get(t.kind, 0) for t in tokens if t.kind in ("(", ")"))
    if not tokens or abs(level) != 1:
        return False
    return tokens[0].text in _LEFT_BRACES if level == 1 else tokens[-1].text in _RIGHT_BRACES


_LEFT_BRACES, _RIGHT_BRACES = ("\\{", "\\lbrace"), ("\\}", "\\rbrace")


def is_label(tokens: list[Token]) -> str:
    """The number of an equation, if a display holds nothing else: `(17)`."""
    shown = [t for t in tokens if t.kind not in ("end",) and t.text not in SEPARATORS]
    if [t.kind for t in shown] == ["tag"]:
        return f"({shown[0].text.strip('()')})"
    if 3 <= len(shown) <= 6 and shown[0].kind == "(" and shown[-1].kind == ")":
        inside = shown[1:-1]
        if "number" in {t.kind for t in inside} <= {"number", "name", ".", "'"}:
            return "(" + "".join(t.text for t in inside) + ")"
    return ""


def _rows(tokens: list[Token]) -> list[list[Token]]:
    """The rows of a display; one that goes on with the equation before is added to it."""
    rows: list[list[Token]] = [[]]
    level = 0
    for token in tokens:
        if token.kind in ("begin", "{"):
            level += 1
        elif token.kind in ("close", "}"):
            level = max(level - 1, 0)
        if token.kind == "end":
            break
        if token.kind == "\\\\" and level == 0:
            rows.append([])
        else:
            rows[-1].append(token)
    rows = [_without_tabs(row) for row in rows]
    joined: list[list[Token]] = []
    for row in rows:
        if joined and _goes_on(joined[-1], row):
            joined[-1] += row
        elif row:
            joined.append(row)
    return joined


def _without_tabs(row: list[Token]) -> list[Token]:
    """The row without the `&` that only align its equations; one that stands between two of them stays."""
    kept: list[Token] = []
    level = 0
    for position, token in enumerate(row):
        level += (token.kind in ("begin", "{")) - (token.kind in ("close", "}"))
        if token.kind == "&" and level <= 0:
            after = row[position + 1].kind if position + 1 < len(row) else "end"
            if not kept or kept[-1].kind in ("=", "&") or after in ("=", "&", "end"):
                continue
        kept.append(token)
    return kept


def _goes_on(before: list[Token], row: list[Token]) -> bool:
    previous, content = (
        [t for t in tokens if t.text not in SEPARATORS and t.kind != "tag"] for tokens in (before, row)
    )
    if not content or any(t.kind in _OPERATORS for t in (content[0], *previous[-1:])):
        return True
    return not any(t.kind == "=" for t in content) and not is_label(content)


_OPERATORS = frozenset({"=", "+", "-", "*", "cdot", "times", "/"})


def _label(row: list[Token]) -> tuple[str, list[Token]]:
    """The number inside a row, and the row without it."""
    tags = [token.text.strip("()") for token in row if token.kind == "tag"]
    label = f"({tags[-1]})" if tags else ""
    kept = [token for token in row if token.kind != "tag"]
    if not label and len(kept) > 4 and [t.kind for t in kept[-3:]] == ["(", "number", ")"]:
        before = kept[-4]
        if before.text in SEPARATORS or (
            kept[-3].spaced and kept[-2].text.isdigit() and before.kind not in _PENDING
        ):
            label = f"({kept[-2].text})"
            kept = kept[:-3]
    if (length := _leading_number(kept)) and not label:
        label = "(" + "".join(t.text for t in kept[:length] if t.kind in ("number", "name", ".")) + ")"
    return label, kept[length:]


def _leading_number(row: list[Token]) -> int:
    """How many tokens the number of an equation takes that stands before it: `(4.7) g_2 =`, `a) g_2 =`."""
    end = next((place for place, token in enumerate(row[:6]) if token.kind == ")"), 0)
    inside = [t for t in row[:end] if t.kind != "."]
    is_open = inside[:1] != [] and inside[0].kind == "("
    inside = inside[is_open:]
    is_number = 0 < len(inside) < 3 and all(t.kind == "number" or len(t.text) == 1 for t in inside)
    if not is_number or any(t.kind not in ("number", "name") for t in inside):
        return 0
    after = row[end + 1 : end + 3]
    has_digit = any(t.kind == "number" for t in inside)
    begins = after[:1] != [] and after[0].kind in ("name", "letter", "command") and after[0].spaced
    return end + 1 if begins and (has_digit or not is_open) and any(t.kind == "=" for t in row) else 0


_PENDING = _OPERATORS | {"command"}


def _pieces(row: list[Token]) -> list[list[Token]]:
    r"""The equations that stand beside one another in a row: `P_1 = 0, \quad P_2 = 0`."""
    merged: list[list[Token]] = []
    for boundary, piece in _cut(_without_parentheses(row)):
        if all(t.kind in _ENDINGS or t.kind == "text" for t in piece):
            continue
        if merged and not _is_equation(piece) and any(map(_is_relation, piece)):
            continue  # it says something else of the equation: `c \\in \\mathbb{R}^2`, `m > 0`
        if not merged:
            merged.append(piece)
        elif _is_equation(piece) and piece[0].kind != "=":
            if not _is_equation(merged[-1]):
                merged.pop()
            merged.append(piece)
        elif boundary is None or (boundary.kind in ("&", "command") and boundary.text not in _CONCLUSIONS):
            merged[-1] += piece
        elif boundary.kind in (",", ";"):
            merged[-1] += [boundary, *piece]
    return [_trimmed(piece) for piece in merged]


_CONCLUSIONS = SEPARATORS - {"quad", "qquad"}


def _without_parentheses(row: list[Token]) -> list[Token]:
    """The row with `;` for parentheses around equations beside its own: `K = ... (ω = q̇, v = ṙ)`."""
    found = list(row)
    level, opening, has_sides = 0, 0, False
    for position, token in enumerate(row):
        level += OPENS.get(token.kind, 0)
        has_sides = has_sides or (token.kind == "=" and level <= 0)
        if token.kind == "(" and level == 1 and has_sides:
            before = row[position - 1]
            is_apart = before.text in SEPARATORS or (token.spaced and before.kind not in _PENDING)
            opening = position if is_apart else 0
        elif token.kind == ")" and level == 0 and opening:
            ends = position + 1 == len(row) or row[position + 1].kind in _ENDINGS
            if ends and _is_equation(row[opening + 1 : position]):
                found[opening], found[position] = (t._replace(kind=";") for t in (row[opening], token))
            opening = 0
    return found


def _cut(row: list[Token]) -> list[tuple[Token | None, list[Token]]]:
    """The pieces of a row between commas, wide blanks and words, each with what stands before it."""
    pieces: list[tuple[Token | None, list[Token]]] = [(None, [])]
    level = 0
    for token in row:
        level = max(level + OPENS.get(token.kind, 0), 0)
        wide = token.text in SEPARATORS and token.kind == "command"
        if level == 0 and (wide or token.kind in ("separator", ",", ";", "&")):
            before, last = pieces[-1]
            if last or not wide:
                pieces.append((token, []))
            elif before is None:
                continue
        else:
            pieces[-1][1].append(token)
    return pieces


_MEMBERSHIPS = frozenset("in ni notin subset forall exists to mapsto".split())
_UNEQUAL = frozenset({"neq", "ne"})
_RELATIONS = _MEMBERSHIPS | _UNEQUAL | frozenset("geq ge leq le gt lt < >".split())


def _is_relation(token: Token) -> bool:
    return token.kind in ("command", "<", ">") and token.text in _RELATIONS


def _is_equation(piece: list[Token]) -> bool:
    level = 0
    for token in piece:
        level += OPENS.get(token.kind, 0)
        if token.kind == "=" and level <= 0:
            return True
    return False


def _trimmed(piece: list[Token]) -> list[Token]:
    is_odd = sum(token.kind == "|" for token in piece) % 2  # \\left. ... \\right|
    while piece and piece[-1].kind in (_ENDINGS | {"|"} if is_odd else _ENDINGS):
        piece = piece[:-1]
    while piece and piece[0].kind in _ENDINGS:
        piece = piece[1:]
    return [t for t in piece if not (t.kind == "command" and t.text in SEPARATORS)]


def _members(piece: list[Token]) -> list[list[Token]]:
    members: list[list[Token]] = [[]]
    level = 0
    for position, token in enumerate(piece):
        level = max(level + OPENS.get(token.kind, 0), 0)
        if token.kind == "=" and level == 0:
            if "approx" in token.text and len(members) > 1 and not _has_decimals(piece[position:]):
                break
            members.append([])
        else:
            members[-1].append(token)
    said = [_without_remark(member) for member in members if member]
    return said if len(members) > 1 else []


def _has_decimals(tokens: list[Token]) -> bool:
    """Whether numbers are rounded, and no formula: `0.333 m l^2`."""
    return any(token.kind == "number" and "." in token.text for token in tokens) or not any(
        token.kind == "name" for token in tokens
    )


def _without_remark(member: list[Token]) -> list[Token]:
    r"""A member without what is said of it: `m_2 l_1 \neq 0`, `c \in \mathbb{R}`; `m_1 < m_2` is no value"""
    level = 0
    for position, token in enumerate(member):
        level += OPENS.get(token.kind, 0)
        if level == 0 and position and _is_relation(token):
            said = [t.text for t in member[position + 1 :]]
            ends = token.text in _MEMBERSHIPS or token.text in _UNEQUAL or said[:1] == ["0"]
            return member[:position] if ends else member
    return member


def chain(tokens: list[Token]) -> list[list[Token]]:
    """The members of a value as an answer file gives it, which is no display: a = b, or one value alone."""
    return pieces(_trimmed([token for token in tokens if token.kind not in ("end", "tag")]), "=")


def pieces(tokens: Sequence[Token], *kinds: str) -> list[list[Token]]:
    """What stands between signs of these kinds that are in no bracket."""
    found: list[list[Token]] = [[]]
    level = 0
    for token in tokens:
        level = max(level + OPENS.get(token.kind, 0), 0)
        if token.kind in kinds and level == 0:
            found.append([])
        else:
            found[-1].append(token)
    return found
