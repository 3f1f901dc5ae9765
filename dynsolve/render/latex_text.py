r"""Any text as LaTeX text that pdflatex sets with its own fonts."""

from __future__ import annotations

import unicodedata

from dynsolve.notation.characters import GREEK
from dynsolve.render.prose import visible

_ESCAPES = {
    "\\": r"\textbackslash{}",
    "^": r"\textasciicircum{}",
    "~": r"\textasciitilde{}",
    "<": r"\textless{}",
    ">": r"\textgreater{}",
    "|": r"\textbar{}",
    '"': r"\textquotedblright{}",
    "`": r"\textasciigrave{}",
    "'": r"{'}",
    "[": "{[}",
    "]": "{]}",
    "!": "{!}",
    "?": "{?}",
    "–": r"\textendash{}",
    "—": r"\textemdash{}",
    "−": "$-$",
    "“": r"\textquotedblleft{}",
    "”": r"\textquotedblright{}",
    "„": ",,",
    "‘": r"\textquoteleft{}",
    "’": r"\textquoteright{}",
    "…": r"\textellipsis{}",
    "°": r"$^\circ$",
    "·": r"$\cdot$",
    "•": r"$\bullet$",
    "×": r"$\times$",
    "÷": r"$\div$",
    "±": r"$\pm$",
    "½": r"$\tfrac12$",
    "¼": r"$\tfrac14$",
    "¾": r"$\tfrac34$",
    "²": "$^2$",
    "³": "$^3$",
    "¹": "$^1$",
    "≤": r"$\leq$",
    "≥": r"$\geq$",
    "≠": r"$\neq$",
    "≈": r"$\approx$",
    "→": r"$\rightarrow$",
    "⇒": r"$\Rightarrow$",
    "∂": r"$\partial$",
    "√": r"$\surd$",
    "Σ": r"$\Sigma$",
    "⋆": r"$\star$",
    "©": r"\textcopyright{}",
    "§": r"$\S$",
    "€": r"\texteuro{}",
    "£": r"\pounds{}",
    "ß": r"\ss{}",
    "æ": r"\ae{}",
    "Æ": r"\AE{}",
    "œ": r"\oe{}",
    "Œ": r"\OE{}",
    "ø": r"\o{}",
    "Ø": r"\O{}",
    "å": r"\aa{}",
    "Å": r"\AA{}",
    "ł": r"\l{}",
    "Ł": r"\L{}",
    "ı": r"\i{}",
    "\u00a0": "~",
} | {character: "\\" + character for character in "{}$&#%_"}
_ESCAPES |= {letter: rf"$\{name}$" for name, letter in GREEK.items()}

_ACCENTS = {
    "\u0300": r"\`",
    "\u0301": r"\'",
    "\u0302": r"\^",
    "\u0303": r"\~",
    "\u0304": r"\=",
    "\u0306": r"\u",
    "\u0307": r"\.",
    "\u0308": r"\"",
    "\u030a": r"\r",
    "\u030b": r"\H",
    "\u030c": r"\v",
    "\u0323": r"\d",
    "\u0327": r"\c",
    "\u0331": r"\b",
}


def latex_text(text: str) -> str:
    r"""Any text as LaTeX text; a letter that the fonts lack stands as its code point.

    >>> print(latex_text(r"Ü_1 \input{x} 中"))
    \"{U}\_1 \textbackslash{}input\{x\} {[}U+4E2D{]}
    """
    text = visible(text)
    pieces: list[str] = []
    for character in text:
        if character in _ESCAPES:
            pieces.append(_ESCAPES[character])
        elif character.isascii():
            pieces.append(character)
        elif unicodedata.combining(character) and character in _ACCENTS and pieces:
            pieces.append(f"{_ACCENTS[character]}{{{pieces.pop()}}}")
        else:
            pieces.append(_foreign(character))
    return "".join(pieces).replace("--", "-{}-").replace("--", "-{}-")


def _foreign(character: str) -> str:
    parts = unicodedata.normalize("NFD", character)
    if len(parts) == 2 and parts[0].isascii() and parts[1] in _ACCENTS:
        base = (
            {"i": r"\i", "j": r"\j"}.get(parts[0], parts[0]) if parts[1] not in "\u0323\u0327" else parts[0]
        )
        return f"{_ACCENTS[parts[1]]}{{{base}}}"
    plain = unicodedata.normalize("NFKD", character)
    if plain != character and plain.isascii() and plain.isalnum():
        return plain
    return f"{{[}}U+{ord(character):04X}{{]}}"
