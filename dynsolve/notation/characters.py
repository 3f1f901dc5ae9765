"""The characters that a formula may contain, and the errors about all others.

Latin and Greek letters, digits and a few operators are read.  Letters that only
look like them (a Cyrillic `а`, a Greek capital `Α`) and characters that cannot be
seen are refused by code point, for nobody could find them by looking.
"""

from __future__ import annotations

from dynsolve.errors import ReadError

GREEK: dict[str, str] = {
    "alpha": "α",
    "beta": "β",
    "gamma": "γ",
    "delta": "δ",
    "epsilon": "ε",
    "zeta": "ζ",
    "eta": "η",
    "theta": "θ",
    "iota": "ι",
    "kappa": "κ",
    "lambda": "λ",
    "mu": "μ",
    "nu": "ν",
    "xi": "ξ",
    "pi": "π",
    "rho": "ρ",
    "sigma": "σ",
    "tau": "τ",
    "upsilon": "υ",
    "phi": "φ",
    "chi": "χ",
    "psi": "ψ",
    "omega": "ω",
    "Gamma": "Γ",
    "Delta": "Δ",
    "Theta": "Θ",
    "Lambda": "Λ",
    "Xi": "Ξ",
    "Pi": "Π",
    "Sigma": "Σ",
    "Phi": "Φ",
    "Psi": "Ψ",
    "Omega": "Ω",
}
"""Spelled-out name -> letter, for the letters that cannot be taken for Latin ones."""

SPELLED: dict[str, str] = {letter: name for name, letter in GREEK.items()} | {
    "ϑ": "theta",
    "ϕ": "phi",
    "ϵ": "epsilon",
    "ϱ": "rho",
    "ϖ": "pi",
    "ϰ": "kappa",
    "ς": "sigma",
    "\u00b5": "mu",  # the micro sign
    "\u2126": "Omega",  # the ohm sign
    "\u2206": "Delta",  # the increment
}
"""Letter -> spelled-out name; the variants and the signs that are the same letter too."""

SUBSCRIPT_DIGITS = "₀₁₂₃₄₅₆₇₈₉"
SUPERSCRIPT_DIGITS = "⁰¹²³⁴⁵⁶⁷⁸⁹"

_SCRIPT = {"I": "ℐ", "L": "ℒ", "B": "ℬ", "E": "ℰ", "F": "ℱ", "H": "ℋ", "M": "ℳ", "R": "ℛ"}
"""The letters of the script alphabet that have a place of their own in Unicode."""


def script_letter(base: str) -> str:
    """A capital Latin letter in script; everything else as it is.

    >>> script_letter("L"), script_letter("K"), script_letter("ab")
    ('ℒ', '𝒦', 'ab')
    """
    if len(base) == 1 and "A" <= base <= "Z":
        return _SCRIPT.get(base) or chr(0x1D49C + ord(base) - ord("A"))
    return base


def bold_script_letter(base: str) -> str:
    """A capital Latin letter in bold script; everything else as it is.

    >>> bold_script_letter("I"), bold_script_letter("ab")
    ('𝓘', 'ab')
    """
    return chr(0x1D4D0 + ord(base) - ord("A")) if len(base) == 1 and "A" <= base <= "Z" else base


_BOLD = {"A": 0x1D400, "a": 0x1D41A, "Α": 0x1D6A8, "α": 0x1D6C2, "0": 0x1D7CE}
"""The first of each row of letters -> the code point of the bold one."""


def bold_letter(base: str) -> str:
    """A Latin or Greek letter, or a digit, in bold; everything else as it is.

    >>> bold_letter("z"), bold_letter("τ"), bold_letter("ab")
    ('𝐳', '𝛕', 'ab')
    """
    if len(base) == 1:
        for first, code in _BOLD.items():
            place = ord(base) - ord(first)
            if 0 <= place < (10 if first == "0" else 26):
                return chr(code + place)
    return base


# Letters of other alphabets that cannot be told from a Latin letter by eye.
_LOOK_ALIKES = dict(
    zip(
        "АВЕЅІЈКМНОРСТУХҮавеѕіјкмнорсту" + "хһԁԛԝ" + "ΑΒΕΖΗΙΚΜΝΟΡΤΥΧο" + "ıɡɑℓ",
        "ABESIJKMHOPCTYXYabesijkmhopcty" + "xhdqw" + "ABEZHIKMNOPTYXo" + "igal",
        strict=True,
    )
)

_REMEDIES = {
    "'": "a derivative is no part of a formula here",
    "=": "write the right-hand side alone",
    ",": "a decimal is written with a point: 9.81",
    "[": "parentheses are written ( )",
    "]": "parentheses are written ( )",
    "{": "parentheses are written ( )",
    "}": "parentheses are written ( )",
    "\\": "write it in plain text: theta1, sin(theta1), a/b",
    "°": "degrees are written after a number: 90deg",
    "_": "a name begins with a letter",
    ".": "a decimal has a digit beside its point: 0.5",
    "—": "a minus is written -",
    "‐": "a minus is written -",
    "‑": "a minus is written -",
}

_UNSEEN = frozenset({"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"})


def character_error(character: str, offset: int) -> ReadError:
    """The error about a character that no formula contains."""
    import unicodedata

    code = f"U+{ord(character):04X}"
    name = unicodedata.name(character, "")
    label = f"{code} {name}".rstrip()
    if unicodedata.category(character) in _UNSEEN:
        return ReadError(
            f"a character that cannot be seen ({label})", offset, 1, "delete it and type the text anew"
        )
    if unicodedata.category(character) in ("Mn", "Me"):
        return ReadError(
            f"a mark over or under a letter ({label}) has no meaning here", offset, 1, "delete it"
        )
    if character.isascii():
        help = _REMEDIES.get(character, "")
        return ReadError(f"`{character}` has no meaning here", offset, 1, help)
    message = f"`{character}` ({label}) has no meaning here"
    return ReadError(message, offset, 1, _remedy(character))


def _remedy(character: str) -> str:
    import unicodedata

    if twin := _LOOK_ALIKES.get(character):
        return f"it looks like the Latin letter `{twin}`: type that"
    if character in _REMEDIES:
        return _REMEDIES[character]
    plain = unicodedata.normalize("NFKC", character).replace("\u2044", "/")
    if plain.isascii() and plain.isprintable():
        return f"type `{plain}` from the keyboard"
    bare = unicodedata.normalize("NFD", character)[0]
    if bare != character and (bare in SPELLED or bare.isascii()):
        return f"type `{bare}` without the accent"
    return "names are made of Latin and Greek letters, digits and _"
