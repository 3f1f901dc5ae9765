r"""Text of an answer, plain or LaTeX, cut into tokens that know their place.

One scan serves both notations, since people mix them: `\frac{1}{2}*m2*\dot\theta_1^2`.
What only moves ink about (`\left`, `\,`, `\displaystyle`) yields no token.
"""

from __future__ import annotations

import re
from typing import NamedTuple

from dynsolve.answers.reading.limits import MAX_IDENTIFIER, MAX_LENGTH, MAX_TOKENS
from dynsolve.errors import ReadError
from dynsolve.notation.characters import SPELLED, SUBSCRIPT_DIGITS, SUPERSCRIPT_DIGITS, character_error


class Token(NamedTuple):
    """A piece of the text.

    `kind` is number, name, command, raised, end, or the sign itself; `text` is the
    piece in ASCII, without its backslash; `dots` are the dots over the first letter of
    a name; `spaced` says that blank space stands before it, `broken` a line's end.
    """

    kind: str
    text: str
    start: int
    end: int
    dots: int = 0
    spaced: bool = False
    broken: bool = False


_DOTTED = {"\u0307": 1, "\u0308": 2}
_GREEK = "".join(SPELLED)
_LETTER = f"A-Za-z{_GREEK}\U0001d400-\U0001d7cbℋℐℒℛℬℰℱℳ"
_INDEX = f"0-9{SUBSCRIPT_DIGITS}"
_BRACED = r"_\{[ ]?[A-Za-z0-9]{1,20}(?:(?:,[ ]?|[ ])[A-Za-z0-9]{1,20}){0,5}[ ]?\}"
_NAME_PART = rf"[{_LETTER}{_INDEX}](?![\u0307\u0308])|_(?=[A-Za-z0-9])|{_BRACED}"
_TOKEN = re.compile(
    rf"""[ ]*(?:
      (?P<name>[{_LETTER}](?![\u0307\u0308])(?:{_NAME_PART})*)
    | (?P<space>(?:[ \t\r\n\u00a0\u2000-\u200a\u202f~]|%(?!pi\b)[^\n]*(?:\n|$)
          |\\(?:[,;:!\ >]|\n)|\\(?:left|right)[ ]?\.)+)
    | (?P<number>(?:[0-9]+(?:\.[0-9]+|\.(?![A-Za-z.*/^\\']))?|\.[0-9]+)(?:[eE][+-]?[0-9]+(?![A-Za-z_]))?)
    | (?P<command>\\(?:[A-Za-z]+\*?|[\\{{}}()\[\]|&\#%$_]))
    | (?P<sign>\*\*|\.\*|\./|\.\^|\.'|:=|==|[-+*/^_=(){{}}\[\],;&'|.:°−–·⋅∙×∗⋆÷∕⁄√∂’′″]|[ẋẏżḋṗ])
    | (?P<raised>⁻?[{SUPERSCRIPT_DIGITS}]+)
    | (?P<dotted>[{_LETTER}][\u0307\u0308]{{1,2}}(?:[{_INDEX}](?![\u0307\u0308])|_(?=[0-9])|_\{{[0-9]+\}})*)
    | (?P<percent>%pi)
    | (?P<fraction>[½⅓⅔¼¾⅙⅚⅛⅜⅝⅞])
    )""",
    re.VERBOSE,
)
_SIGNS = {
    "**": "^",
    ".*": "*",
    "./": "/",
    ".^": "^",
    ".'": "'",
    "−": "-",
    "–": "-",
    "·": "cdot",
    "⋅": "cdot",
    "∙": "cdot",
    "×": "times",
    "∗": "*",
    "⋆": "*",
    "÷": "/",
    "∕": "/",
    "⁄": "/",
    "’": "'",
    "′": "'",
    "==": "=",
    ":=": "=",
}
_ASCII = str.maketrans(SPELLED | {digit: str(value) for value, digit in enumerate(SUBSCRIPT_DIGITS)})
_FRACTIONS = dict(zip("½⅓⅔¼¾⅙⅚⅛⅜⅝⅞", "1/2 1/3 2/3 1/4 3/4 1/6 5/6 1/8 3/8 5/8 7/8".split(), strict=True))
_DOTTED_LETTERS = {"ẋ": "x", "ẏ": "y", "ż": "z", "ḋ": "d", "ṗ": "p"}

# Commands that set type and mean nothing; with the sizes of brackets.
_INK = frozenset(
    "left right big Big bigg Bigg bigl bigr Bigl Bigr biggl biggr Biggl Biggr bigm middle "
    "displaystyle textstyle "
    "scriptstyle limits nolimits nonumber notag quad qquad enspace thinspace medspace thickspace "
    "negthinspace hfill hfil noindent centering small normalsize large Large it rm cal sf tt scriptsize "
    "footnotesize allowbreak newline hline protect relax smallskip medskip bigskip par".split()
)
SEPARATORS = frozenset(
    "quad qquad implies Rightarrow Leftrightarrow Longrightarrow iff therefore because".split()
)
"""Commands that stand between two equations of one display."""

# Commands whose argument is no formula; those in `_KEPT` leave a token of their own.
_WORDS = frozenset(
    "text textrm textit textbf textnormal textsf texttt mbox hbox intertext shortintertext label tag "
    "hspace vspace color ref eqref cite class cssId begin end textcolor notag hskip fontsize".split()
)
_KEPT = {"tag": "tag", "begin": "begin", "end": "close", "intertext": "separator"}
_SIGN_COMMANDS = {
    "cdot": "cdot",
    "times": "times",
    "ast": "*",
    "star": "*",
    "bullet": "cdot",
    "div": "/",
    "over": "over",
    "lbrack": "[",
    "rbrack": "]",
    "lparen": "(",
    "rparen": ")",
    "{": "(",
    "}": ")",
    "lbrace": "(",
    "rbrace": ")",
    "prime": "'",
    "\\": "\\\\",
    "cr": "\\\\",
    "tabularnewline": "\\\\",
    "&": "&",
    "equiv": "=",
    "triangleq": "=",
    "coloneqq": "=",
    "approx": "=",
    "lvert": "|",
    "rvert": "|",
    "colon": ":",
    "|": "|",
    "Vert": "|",
    "lVert": "|",
    "rVert": "|",
    "vert": "|",
}
_GREEK_COMMANDS = {
    "vartheta": "theta",
    "varphi": "phi",
    "varepsilon": "epsilon",
    "varrho": "rho",
    "varpi": "pi",
    "varkappa": "kappa",
    "varsigma": "sigma",
} | {name: name for name in SPELLED.values()}
_DIMENSION = re.compile(r"\s*\[\s*-?[0-9.]+\s*(?:pt|em|ex|mm|cm|in|mu)\s*\]")


def tokenize(text: str) -> list[Token]:
    r"""The tokens of a text, an `end` token last.

    Raises ReadError for a character of no formula, and for a text over the bounds.

    >>> [token.text for token in tokenize(r"m_2 \dot{θ}")]
    ['m_2', 'dot', '{', 'theta', '}', '']
    """
    if len(text) > MAX_LENGTH:
        message = f"an equation of {len(text)} characters; at most {MAX_LENGTH} are read"
        raise ReadError(message, MAX_LENGTH, 1, "name parts of it with abbreviations")
    found: list[Token] = []
    offset, length = 0, len(text)
    spaced = broken = False
    match = _TOKEN.match
    new = tuple.__new__  # a named tuple's own constructor is a call more for each token
    while offset < length:
        if len(found) > MAX_TOKENS:
            message = f"an equation of more than {MAX_TOKENS} signs"
            raise ReadError(message, offset, 1, "name parts of it with abbreviations")
        piece = match(text, offset)
        if piece is None:
            raise character_error(text[offset], offset)
        kind, end = str(piece.lastgroup), piece.end()
        text_of = piece[kind]
        if offset + len(text_of) < end:
            spaced, offset = True, end - len(text_of)
        if kind == "space":
            spaced = True
            broken = broken or "\n" in text_of
        else:
            if kind == "number" or (kind == "name" and text_of.isascii() and end - offset <= MAX_IDENTIFIER):
                found.append(new(Token, (kind, text_of, offset, end, 0, spaced, broken)))
                spaced = broken = False
                offset = end
                continue
            sign = _ONE_SIGN.get(text_of)
            if sign is not None:
                found.append(new(Token, (sign[0], sign[1], offset, end, 0, spaced, broken)))
                spaced = broken = False
                offset = end
                continue
            token = _token(kind, text_of, offset, end, spaced, broken)
            if token is None:
                spaced = True
            else:
                if token.kind == "command" and token.text in _WORDS:
                    token, end = _words(text, token)
                found.append(token)
                spaced = broken = False
                if token.kind == "\\\\" and (skipped := _DIMENSION.match(text, end)):
                    end = skipped.end()
        offset = end
    found.append(Token("end", "", length, length, 0, spaced, broken))
    return found


_ONE_SIGN = (
    {sign: (sign, sign) for sign in "+-*/^_=(){}[],;&|:"}
    | {"\\" + name: ("letter", greek) for name, greek in _GREEK_COMMANDS.items()}
    | {"\\" + name: (sign, "\\" + name) for name, sign in _SIGN_COMMANDS.items() if sign != "\\\\"}
    | {"\\" + name: ("command", name) for name in ("frac", "dot", "ddot", "sin", "cos")}
)
"""The pieces that most formulas are made of, with kind and text: the others take a longer way."""


def _token(kind: str, piece: str, start: int, end: int, spaced: bool, broken: bool) -> Token | None:
    if kind == "sign":
        if piece in _DOTTED_LETTERS:
            return Token("name", _DOTTED_LETTERS[piece], start, end, 1, spaced, broken)
        if piece == "″":
            return Token("''", piece, start, end, 0, spaced, broken)
        if piece == "∂":
            return Token("command", "partial", start, end, 0, spaced, broken)
        return Token(_SIGNS.get(piece, piece), piece, start, end, 0, spaced, broken)
    if kind == "name" or kind == "dotted":
        return _name(piece, start, end, spaced, broken)
    if kind == "command":
        return _command(piece[1:], start, end, spaced, broken)
    if kind == "percent":
        return Token("name", "pi", start, end, 0, spaced, broken)
    if kind == "fraction":
        return Token("fraction", _FRACTIONS[piece], start, end, 0, spaced, broken)
    return Token(kind, piece, start, end, 0, spaced, broken)


def _words(text: str, command: Token) -> tuple[Token, int]:
    """A command with the argument that is no formula."""
    at = command.end
    while at < len(text) and text[at] in " *":
        at += 1
    if text[at : at + 1] != "{":
        return command._replace(kind="text", text=""), command.end
    end = closing_brace(text, at)
    content = text[at + 1 : end - 1]
    kind = _KEPT.get(command.text, "text")
    return command._replace(kind=kind, text=content.strip() if len(content) < 200 else "", end=end), end


def closing_brace(text: str, opening: int, longest: int = MAX_LENGTH) -> int:
    """Where the group that opens there has ended; raises ReadError where it does not."""
    depth = 0
    for brace in _BRACE.finditer(text, opening, opening + longest):
        depth += {"{": 1, "}": -1}.get(brace.group(), 0)
        if depth == 0:
            return brace.end()
    raise ReadError("this `{` is never closed", opening, 1, "add the `}` that it belongs to")


_BRACE = re.compile(r"\\.|[{}]", re.DOTALL)


def _name(piece: str, start: int, end: int, spaced: bool, broken: bool) -> Token:
    if len(piece) > MAX_IDENTIFIER:
        message = f"a name of {len(piece)} characters; at most {MAX_IDENTIFIER} are read"
        raise ReadError(message, start, 1, "a name is a letter with an index: m1, theta1")
    dots = 0
    if not piece.isascii():
        dots = sum(_DOTTED.get(character, 0) for character in piece[1:3])
        piece = _plain(piece)
    return Token("name", piece, start, end, dots, spaced, broken)


def _plain(piece: str) -> str:
    """Letters of every face as ASCII, Greek ones spelled out."""
    import unicodedata

    piece = "".join(character for character in piece if character not in _DOTTED)
    piece = piece.translate(_ASCII)
    return piece if piece.isascii() else unicodedata.normalize("NFKC", piece).translate(_ASCII)


def _command(name: str, start: int, end: int, spaced: bool, broken: bool) -> Token | None:
    name = name.removesuffix("*") if len(name) > 1 else name
    if name in _INK and name not in SEPARATORS:
        return None
    if name in ("(", ")", "[", "]", "$", "#", "%", "_"):
        raise ReadError(f"`\\{name}` cannot stand inside an equation", start, 2, "write the formula alone")
    sign = _SIGN_COMMANDS.get(name)
    if sign is not None:
        return Token(sign, "\\" + name, start, end, 0, spaced, broken)
    greek = _GREEK_COMMANDS.get(name)
    if greek is not None:
        return Token("letter", greek, start, end, 0, spaced, broken)
    return Token("command", name, start, end, 0, spaced, broken)
