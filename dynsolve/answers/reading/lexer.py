r"""The lexer: the text of an answer, plain or LaTeX, cut into tokens that know their place.

One lexer serves both notations, since people mix them: `\frac{1}{2}*m2*\dot\theta_1^2`.
What only sets type (`\left`, `\,`, `\displaystyle`) yields no token.  A sign or a command that
means the same as another (`\cdot`, `·`) is one more row in a table here.

Words in formulas: `\text{...}`, units, the names of modules, dots that stand behind a name.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Mapping
from typing import NamedTuple

from msgspec import Struct

from dynsolve.answers.reading.grids import MAX_IDENTIFIER, MAX_LENGTH, MAX_TOKENS
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

    def fault(self, message: str, help: str = "", length: int = 0) -> ReadError:
        """The error about this token, or about so many characters from it on."""
        return ReadError(message, self.start, length or max(self.end - self.start, 1), help)


_DOTTED = {"\u0307": 1, "\u0308": 2}
_DOTS_BEHIND = str.maketrans({"˙": "\u0307", "¨": "\u0308"})
_PRECOMPOSED = "ȧḃċḋėḟġḣṁṅȯṗṙṡṫẇẋẏżḦḧẍẅÿ"
"""Letters that Unicode has with their dots, in one code point."""
_SCRIPT_TENSOR = "𝓘ℐ"
"""The letter of the tensor in base coordinates, which is another than the tensor I in the body's axes."""
_GREEK = "".join(SPELLED)
_LETTER = f"A-Za-z{_GREEK}\U0001d400-\U0001d7cbℂℊℋℌℍℎℐℑℒℓℕℙℚℛℜℝℤℨℬℭℯℰℱℳℴⅆ"
_INDEX = f"0-9{SUBSCRIPT_DIGITS}"
_BRACED = r"_\{[ ]?[A-Za-z0-9]{1,20}(?:(?:,[ ]?|[ ])[A-Za-z0-9]{1,20}){0,5}[ ]?\}"
_UNDOTTED = rf"(?!(?:_?[{_INDEX}]+|_\{{[0-9]+\}})?[\u0307\u0308])"
_NAME_PART = (
    rf"[{_LETTER}]{_UNDOTTED}|[{_INDEX}](?![\u0307\u0308])|_(?=[A-Za-z{_INDEX}](?![\u0307\u0308]))|{_BRACED}"
)
_TOKEN = re.compile(
    rf"""[ ]*(?:
      (?P<name>[{_LETTER}]{_UNDOTTED}(?:{_NAME_PART})*)
    | (?P<space>(?:[ \t\r\n\u00a0\u2000-\u200a\u202f\u2061-\u2064~]|%(?!pi\b)[^\n]*(?:\n|$)
          |\\(?:[,;:!\ >]|\n)|\\(?:left|right)[ ]?\.)+)
    | (?P<comma>[0-9]+\{{,\}}[0-9]+)
    | (?P<number>(?<=_)[0-9]+(?=[.](?![0-9]))
          |(?:[0-9]+(?:\.[0-9]+|\.(?![A-Za-z.*/^\\']))?|\.[0-9]+)(?:[eE][+-]?[0-9]+(?![A-Za-z_]))?)
    | (?P<mathematica>\\\[[A-Z][a-z]{{1,12}}\][A-Za-z0-9]{{0,20}})
    | (?P<command>\\(?:[A-Za-z]+\*?|[\\{{}}()\[\]|&\#%$_]))
    | (?P<sign>\*\*|\.\*|\./|\.\^|\.'|:=|=:|==
          |[-+*/^_=<>(){{}}\[\],;&'|.:°º˚−–—‐‑‒―﹣·⋅∙•×∗⁎⋆÷∕⁄√∂∇∑≠∈∀⇒⟹⇔→⟶∴’′ʹ＇"”″ʺ■@〖〗!$≡≜≔≕≝⟨⟩])
    | (?P<half>(?<![\w)\]}}\u0307\u0308])[{SUPERSCRIPT_DIGITS}]+[⁄∕/][{SUBSCRIPT_DIGITS}]+)
    | (?P<raised>[⁻⁺]?[{SUPERSCRIPT_DIGITS}]+)
    | (?P<dotted>(?:[{_LETTER}][\u0307\u0308]{{1,2}}|[{_PRECOMPOSED}])
          (?:[{_INDEX}](?![\u0307\u0308])|_(?=[{_INDEX}])|_\{{[0-9]+\}})*
          |[{_LETTER}](?:_?[{_INDEX}]+|_\{{[0-9]+\}})[\u0307\u0308]{{1,2}})
    | (?P<percent>%pi)
    | (?P<accent>[\u0307\u0308])
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
    **dict.fromkeys("−–—‐‑‒―﹣", "-"),
    **dict.fromkeys("·⋅∙•", "cdot"),
    "×": "times",
    **dict.fromkeys("∗⁎⋆", "*"),
    **dict.fromkeys("÷∕⁄", "/"),
    **dict.fromkeys("’′ʹ＇", "'"),
    **dict.fromkeys('"”″ʺ', "''"),
    **dict.fromkeys("º˚", "°"),
    **dict.fromkeys(("==", ":=", "=:", *"≡≜≔≕≝"), "="),
    "@": "\\\\",  # Word's rows
    "〖": "{",
    "〗": "}",
}
_COMMANDS = {
    "∂": "partial", "∇": "nabla", "∑": "sum", "≠": "neq", "∈": "in", "∀": "forall", "⇒": "Rightarrow",
    "⟹": "Longrightarrow", "⇔": "Leftrightarrow", "→": "rightarrow", "⟶": "rightarrow", "∴": "therefore",
}  # fmt: skip
"""Signs that are one of LaTeX's commands."""
_ASCII = str.maketrans(SPELLED | {digit: str(value) for value, digit in enumerate(SUBSCRIPT_DIGITS)})
_FRACTIONS = dict(zip("½⅓⅔¼¾⅙⅚⅛⅜⅝⅞", "1/2 1/3 2/3 1/4 3/4 1/6 5/6 1/8 3/8 5/8 7/8".split(), strict=True))

# Commands that only set type, the sizes of brackets among them: they yield no token.
_LAYOUT = frozenset(
    "left right big Big bigg Bigg bigl bigr Bigl Bigr biggl biggr Biggl Biggr bigm middle "
    "displaystyle textstyle "
    "scriptstyle limits nolimits nonumber notag quad qquad enspace thinspace medspace thickspace "
    "negthinspace hfill hfil noindent centering small normalsize large Large it rm cal sf tt scriptsize "
    "footnotesize allowbreak newline hline protect relax smallskip medskip bigskip par bfseries itshape "
    "upshape mathstrut strut null displaybreak nobreak IEEEnonumber IEEEyesnumber empheqlbrace empheqlbrack "
    "toprule midrule bottomrule xspace unskip ignorespaces boldmath unboldmath "
    "checkmark blacksquare square Box qed".split()
)
SEPARATORS = frozenset(
    "quad qquad implies rightarrow longrightarrow Rightarrow Leftrightarrow Longrightarrow iff therefore "
    "because".split()
)
"""Commands that stand between two equations of one display."""

# Commands that vanish with their argument, and those whose argument is no formula but leaves a token.
_VANISHING = dict.fromkeys(
    "label vspace color ref eqref cite class cssId textcolor notag phantom hphantom vphantom footnote index "
    "marginpar colorbox pagecolor raisebox hskip vskip mskip mkern kern cline".split(),
    1,
)
_VANISHING |= dict.fromkeys(
    "fontsize fcolorbox rule setlength IEEEeqnarraymulticol multicolumn addtolength".split(), 2
)
_VANISHING["definecolor"] = 3
_TEXTS = dict.fromkeys(
    "text textrm textit textbf textnormal textsf texttt textup mbox hbox emph".split(), "text"
)
_TEXTS |= {"tag": "tag", "begin": "begin", "end": "close"}
_TEXTS |= {"intertext": "separator", "shortintertext": "separator"}
_WIDE = frozenset({"hspace"})
"""Wide blanks by their length, which part equations as `\\quad` does."""
_COMMANDS_OF_SIGNS = {
    "cdot": "cdot bullet",
    "times": "times",
    "over": "over",
    "*": "ast star",
    "/": "div",
    "[": "lbrack",
    "]": "rbrack",
    "(": "lparen { lbrace",
    ")": "rparen } rbrace",
    "'": "prime",
    "\\\\": "\\ cr tabularnewline",
    "&": "&",
    "=": "equiv triangleq coloneqq coloneq eqqcolon doteq approx",
    "|": "lvert rvert | Vert lVert rVert vert",
    ":": "colon",
}
_SIGN_COMMANDS = {name: sign for sign, names in _COMMANDS_OF_SIGNS.items() for name in names.split()}
_VARIANTS = "theta phi epsilon rho pi kappa sigma".split()
GREEK_COMMANDS = {f"var{name}": name for name in _VARIANTS} | {name: name for name in SPELLED.values()}
GREEK_COMMANDS["ell"] = "l"
_LENGTH = re.compile(r"\s*-?[0-9.]+\s*(?:pt|em|ex|mm|cm|in|mu)(?![A-Za-z])")
_OPTION = re.compile(r"\*?\s*\[[^\[\]{}]{0,60}\](?=\s*\{)")
_LINE_BREAK_END = re.compile(
    r"\*?(?:\s*\[\s*-?[0-9.]+\s*(?:pt|em|ex|mm|cm|in|mu|\\baselineskip|\\jot)\s*\])?"
)


def tokenize(text: str) -> list[Token]:
    r"""The tokens of a text, an `end` token last.

    Raises ReadError for a character of no formula, and for a text over the bounds.

    >>> [token.text for token in tokenize(r"m_2 \dot{θ}")]
    ['m_2', 'dot', '{', 'theta', '}', '']
    """
    if len(text) > MAX_LENGTH:
        message = f"an equation of {len(text)} characters; at most {MAX_LENGTH} are read"
        raise ReadError(message, MAX_LENGTH, 1, "name parts of it with abbreviations")
    text = text.translate(_DOTS_BEHIND)
    found: list[Token] = []
    offset, length = 0, len(text)
    spaced = broken = False
    match = _TOKEN.match
    new = tuple.__new__  # a named tuple's own constructor is a call more for each token
    while offset < length:
        if len(found) > MAX_TOKENS:
            message = f"an equation of more than {MAX_TOKENS} signs"
            raise ReadError(message, offset, 1, "name parts of it with abbreviations")
        match_here = match(text, offset)
        if match_here is None:
            raise character_error(text[offset], offset)
        kind, end = str(match_here.lastgroup), match_here.end()
        piece = match_here[kind]
        if offset + len(piece) < end:
            spaced, offset = True, end - len(piece)
        if kind == "space":
            spaced, broken, offset = True, broken or "\n" in piece, end
            continue
        is_plain = kind == "number" or (kind == "name" and piece.isascii() and len(piece) <= MAX_IDENTIFIER)
        frequent = (kind, piece) if is_plain else _FREQUENT.get(piece)
        if frequent is not None:
            found.append(new(Token, (*frequent, offset, end, 0, spaced, broken)))
            spaced = broken = False
        else:
            token, end = _rare_token(text, Token(kind, piece, offset, end, 0, spaced, broken))
            if token is None:
                spaced = True
            else:
                if piece[0] in _SCRIPT_TENSOR and token.kind == "name":
                    found.append(token._replace(kind="command", text="mathcal", end=token.start))
                found.append(token)
                spaced = broken = False
        offset = end
    found.append(Token("end", "", length, length, 0, spaced, broken))
    return found


_FREQUENT = (
    {sign: (sign, sign) for sign in "+-*/^_=(){}[],;&|:"}
    | {"\\" + name: ("letter", greek) for name, greek in GREEK_COMMANDS.items()}
    | {"\\" + name: (sign, "\\" + name) for name, sign in _SIGN_COMMANDS.items() if sign != "\\\\"}
    | {"\\" + name: ("command", name) for name in ("frac", "dot", "ddot", "sin", "cos")}
)
"""The pieces that most formulas are made of, with kind and text: the others take a longer way."""


def _rare_token(text: str, piece: Token) -> tuple[Token | None, int]:
    """The token that a piece of the text is, None where it only sets type; and where the text goes on."""
    token, end = _token(piece), piece.end
    if token is None:
        return token, end
    if token.kind == "command" and (token.text in _TEXTS or token.text in _VANISHING or token.text in _WIDE):
        return _words(text, token)
    if token.kind == "\\\\" and (skipped := _LINE_BREAK_END.match(text, end)):
        end = skipped.end()
    return token, end


def _token(piece: Token) -> Token | None:
    kind, text = piece.kind, piece.text
    if kind == "sign":
        if text in _COMMANDS:
            return piece._replace(kind="command", text=_COMMANDS[text])
        return piece._replace(kind=_SIGNS.get(text, text))
    if kind == "name" or kind == "dotted":
        return _name(piece)
    if kind == "command":
        return _command(piece)
    if kind == "mathematica":  # \[Theta]1
        letter, _, index = text[2:].partition("]")
        return piece._replace(kind="name", text=letter.lower() + index)
    if kind == "comma":
        return piece._replace(kind="number", text=text.replace("{,}", "."))
    if kind == "percent":
        return piece._replace(kind="name", text="pi")
    if kind == "fraction":
        return piece._replace(text=_FRACTIONS[text])
    if kind == "half":  # ¹⁄₂
        return piece._replace(
            kind="fraction", text=unicodedata.normalize("NFKC", text).replace("\u2044", "/")
        )
    return piece


def _words(text: str, command: Token) -> tuple[Token | None, int]:
    """A command with the argument that is no formula; no token where it vanishes."""
    end, content = command.end, ""
    if option := _OPTION.match(text, end):
        end = option.end()
    for _ in range(_VANISHING.get(command.text, 1)):
        at = end
        while at < len(text) and text[at] in " *":
            at += 1
        if text[at : at + 1] == "{":
            end = closing_brace(text, at)
            content = text[at + 1 : end - 1].strip() if end - at < 200 else ""
    if command.text in _VANISHING:
        length = _LENGTH.match(text, end) if end == command.end else None
        return None, length.end() if length else end
    if command.text in _WIDE:
        return command._replace(text="quad", end=end), end
    return command._replace(kind=_TEXTS[command.text], text=content, end=end), end


def closing_brace(text: str, opening: int, longest: int = MAX_LENGTH) -> int:
    """Where the group that opens there has ended; raises ReadError where it does not."""
    depth = 0
    for brace in _BRACE.finditer(text, opening, opening + longest):
        depth += {"{": 1, "}": -1}.get(brace.group(), 0)
        if depth == 0:
            return brace.end()
    raise ReadError("this `{` is never closed", opening, 1, "add the `}` that it belongs to")


_BRACE = re.compile(r"\\.|[{}]", re.DOTALL)


def _name(piece: Token) -> Token:
    text, dots = piece.text, 0
    if len(text) > MAX_IDENTIFIER:
        message = f"a name of {len(text)} characters; at most {MAX_IDENTIFIER} are read"
        raise piece.fault(message, "a name is a letter with an index: m1, theta1", 1)
    if not text.isascii():
        if text[0] in _PRECOMPOSED:
            text = unicodedata.normalize("NFD", text[0]) + text[1:]
        dots = sum(_DOTTED.get(character, 0) for character in text)
        text = _plain(text)
    return piece._replace(kind="name", text=text, dots=dots)


def _plain(piece: str) -> str:
    """Letters of every face as ASCII, Greek ones spelled out."""
    piece = "".join(character for character in piece if character not in _DOTTED)
    piece = piece.translate(_ASCII)
    return piece if piece.isascii() else unicodedata.normalize("NFKC", piece).translate(_ASCII)


def _command(piece: Token) -> Token | None:
    name = piece.text[1:]
    name = name.removesuffix("*") if len(name) > 1 else name
    if name in _LAYOUT and name not in SEPARATORS:
        return None
    if name == "#":
        return piece._replace(kind="command", text="sharp")
    if name in ("(", ")", "[", "]", "$", "%", "_"):
        raise piece.fault(f"`\\{name}` cannot stand inside an equation", "write the formula alone", 2)
    sign = _SIGN_COMMANDS.get(name)
    if sign is not None:
        return piece._replace(kind=sign, text="\\" + name)
    greek = GREEK_COMMANDS.get(name)
    if greek is not None:
        return piece._replace(kind="letter", text=greek)
    return piece._replace(kind="command", text=name)


# Words in formulas

_FUNCTIONS = frozenset("sin cos tan sqrt cot sec csc sgn sign".split())
_SYMMETRIC = frozenset({"sym", "symm", "symmetric"})
_WORD_AS_NAME = re.compile(r"[A-Za-z][A-Za-z0-9]*(?:_\{?[A-Za-z0-9,]+\}?)?")
_WORDS = frozenset("and og where hvor der with med so such or eller for für alle all då da".split())
_UNITS = frozenset({"J", "N", "Nm", "rad", "kg"})
UPRIGHT_UNITS = frozenset("J N Nm kg m s rad kgm Ws".split())
"""What is a unit where it stands upright, and no symbol of the problem."""

_MODULES = frozenset("sp sym sympy smp np numpy math".split())
_OF_MODULES = frozenset(
    "sin cos tan sqrt pi Matrix array matrix Rational Derivative diff Integer transpose"
    " simplify expand trigsimp factor nsimplify".split()
)


def token_of_word(token: Token, out: list[Token]) -> Token | None:
    r"""`\text{...}`: an index, a function, a word between equations, or nothing."""
    word = token.text
    if word.strip(". ").lower() in _SYMMETRIC and out and out[-1].kind in ("&", "\\\\", "begin"):
        return token._replace(kind="name", text="sym")
    if (
        out
        and not word.isdecimal()
        and (out[-1].kind in ("_", "^") or (out[-1].kind in ("{", ",", "name") and _in_script(out)))
    ):
        word = "".join(character for character in word if character.isalnum())
        return token._replace(kind="name", text=word) if word.isascii() and word[:1].isalpha() else None
    if word in _FUNCTIONS:
        return token._replace(kind="name")
    if word.isdecimal() and word.isascii():
        return token._replace(kind="number")
    if out and out[-1].kind in ("+", "-"):
        word = word.rstrip(".")
        token = token._replace(text=word)
    if _WORD_AS_NAME.fullmatch(word) and word.lower() not in _WORDS:
        return token
    if (units := word.split()) and UPRIGHT_UNITS.issuperset(units):  # its last word may have a power behind
        return token._replace(text=units[-1])
    if any(part.strip(",.:;").lower() in _WORDS for part in word.split()):
        return token._replace(kind="separator")
    return None


def _in_script(out: list[Token]) -> bool:
    back = next((i for i in range(len(out) - 1, max(len(out) - 8, -1), -1) if out[i].kind == "{"), -1)
    return back > 0 and out[back - 1].kind in ("_", "^")


def is_unit(out: list[Token], after: Token) -> bool:
    r"""Whether the bracket that closes here holds a unit alone: `[\text{J}]`, or `[J]` at the end."""
    if len(out) < 3 or out[-2].kind != "[":
        return False
    at_end = after.kind in ("end", "\\\\", ",", ".", ";", "tag", "}", "&")
    return out[-1].kind == "text" or (at_end and out[-1].kind == "name" and out[-1].text in _UNITS)


def is_qualified(module: Token, tokens: list[Token], position: int) -> bool:
    """Whether a function follows the name of its module: `sp.sin(q1)`."""
    if module.text not in _MODULES:
        return False
    dot, name = tokens[position], tokens[min(position + 1, len(tokens) - 1)]
    return dot.kind == "." and name.text in _OF_MODULES and dot.end == name.start


def accent(accent: Token, out: list[Token]) -> None:
    """The dots that Word writes behind what they stand over: `(θ_1 ) ̇`, `q ̇_1`."""
    dots = 1 if accent.text == "\u0307" else 2
    last = len(out) - 1
    if out[last].kind == ")" and last > 1 and out[last - 2].kind == "(":
        del out[last], out[last - 2]
        last -= 2
    if out[last].kind in ("name", "letter"):
        out[last] = out[last]._replace(kind="name", dots=out[last].dots + dots, end=accent.end)
    else:
        raise accent.fault("these dots stand over no name", "write \\dot{q}_1", 1)


# The student's own commands, written out


class Macro(Struct, frozen=True):
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
            raise token.fault(message, "write the formula out")
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
