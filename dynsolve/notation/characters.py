"""The characters that a formula may contain, and the errors about all others.

Latin and Greek letters, digits and a few operators are read.  Letters that only
look like them (a Cyrillic `а`, a Greek capital `Α`) and characters that cannot be
seen are refused by code point, for nobody could find them by looking.

Names: how an identifier is spelled, and how it is set on paper.

θ1 -> theta1 -> θ with the index 1        I1zz -> I with the indices 1 and zz
"""

from __future__ import annotations

import keyword
import re
from functools import lru_cache

from dynsolve.errors import ReadError

_NAMES_OF_GREEK = (
    "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi pi rho sigma tau upsilon phi "
    "chi psi omega Gamma Delta Theta Lambda Xi Pi Sigma Phi Psi Omega"
)
GREEK: dict[str, str] = dict(zip(_NAMES_OF_GREEK.split(), "αβγδεζηθικλμνξπρστυφχψωΓΔΘΛΞΠΣΦΨΩ", strict=True))
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
        message, help = f"a character that cannot be seen ({label})", "delete it and type the text anew"
    elif unicodedata.category(character) in ("Mn", "Me"):
        message, help = f"a mark over or under a letter ({label}) has no meaning here", "delete it"
    elif character.isascii():
        message, help = f"`{character}` has no meaning here", _REMEDIES.get(character, "")
    else:
        message, help = f"`{character}` ({label}) has no meaning here", _remedy(character)
    return ReadError(message, offset, 1, help)


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


# Names: how an identifier is spelled, and how it is set on paper

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_GROUP = re.compile(r"[A-Za-z]*[0-9]+|[A-Za-z]+")
_LETTERS = re.compile(r"[A-Za-z]+")
_THETA = re.compile(r"th(?![A-Za-z]{2}|[A-Z])")
_INERTIA = re.compile(r"[IJ](?=[xyz]{2})")
_WORD_LENGTH = 4
_ASCII = SPELLED | {digit: str(value) for value, digit in enumerate(SUBSCRIPT_DIGITS)}
_LONGEST_FIRST = tuple(sorted(GREEK, key=len, reverse=True))


def normalize(name: str) -> str:
    """The one ASCII spelling of a name: Greek letters spelled out, `lambda_` back to `lambda`.

    Raises ReadError for what is no name, a letter that only looks like a Latin one above all.

    >>> normalize("θ1"), normalize("theta1"), normalize("I₁zz"), normalize("lambda_")
    ('theta1', 'theta1', 'I1zz', 'lambda')
    """
    if not name.isascii():
        name = "".join(_letter(character, offset) for offset, character in enumerate(name))
    if not _NAME.fullmatch(name):
        raise _no_name(name)
    if name.endswith("_") and keyword.iskeyword(name[:-1]):
        return name[:-1]
    return name


def _letter(character: str, offset: int) -> str:
    if character.isascii():
        return character
    if (spelled := _ASCII.get(character)) is None:
        raise character_error(character, offset)
    return spelled


def _no_name(name: str) -> ReadError:
    help = "a name is a letter and then letters, digits and _: m1, lc2, theta1"
    if not name:
        return ReadError("a name is expected here", 0, 1, help)
    start = _NAME.match(name)
    offset = start.end() if start else 0
    if name[offset] in "0123456789_":
        return ReadError(f"a name cannot begin with `{name[offset]}`", offset, 1, help)
    error = character_error(name[offset], offset)
    return ReadError(error.message, offset, 1, error.help or help)


@lru_cache(maxsize=4096)
def split(name: str) -> tuple[str, tuple[str, ...]]:
    """The base of a name and its groups of indices, as they are set on paper.

    The base is a letter, a spelled-out Greek letter, th for theta, with an index of one letter at most, or
    a word of four letters or more.  A new group of indices begins at an underscore and at a letter after a
    digit.

    >>> split("I1zz"), split("lc1"), split("thm1"), split("load")
    (('I', ('1', 'zz')), ('l', ('c1',)), ('theta', ('m1',)), ('load', ()))
    """
    if _THETA.match(name):
        name = name.replace("th", "theta", 1)
    base = _base(name)
    pieces = name[len(base) :].split("_")
    return base, tuple(group for piece in pieces for group in _GROUP.findall(piece))


_RUN = re.compile(r"[A-Za-z]+|[^A-Za-z]+")
_ITALIC = frozenset("ijknrvxyz")
"""What is italic in an index, as elsewhere: what counts, the axes, and quantities (v in J_v, r in J_r)."""


def runs(index: str) -> list[str]:
    """The runs of letters and of others in a group of indices.

    >>> runs("c1")
    ['c', '1']
    """
    return _RUN.findall(index)


def describes(run: str) -> bool:
    """Whether a run of an index only describes, as the c of l_c1, so that it is set upright.

    >>> [run for run in ("c", "zz", "i", "max", "omega", "1") if describes(run)]
    ['c', 'max']
    """
    return run.isalpha() and run not in GREEK and not _ITALIC.issuperset(run)


def _base(name: str) -> str:
    for greek in _LONGEST_FIRST:
        if name.startswith(greek) and _indices_may_follow(greek, name[len(greek) :]):
            return greek
    if _INERTIA.match(name):
        return name[0]
    letters = _LETTERS.match(name)
    if letters and len(letters.group()) >= _WORD_LENGTH:
        return letters.group()
    return name[:1]


def _indices_may_follow(greek: str, rest: str) -> bool:
    """Whether `rest` reads as indices: `mus` is μ_s, but `pin` and `nuance` hold no Greek letter."""
    letters = _LETTERS.match(rest)
    if not letters:
        return True
    if greek in ("pi", "Pi", "xi", "Xi"):
        return False
    return len(greek) >= _WORD_LENGTH or len(letters.group()) <= 2
