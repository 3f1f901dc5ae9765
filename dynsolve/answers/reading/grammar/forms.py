r"""A name as it is written, with what stands over, under and beside it: `\dot{L}_2^{\star 2}`."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction

from dynsolve.answers.reading.tokens.lexer import Token
from dynsolve.quantities.spelling import key

PSEUDO_INVERSE = "pinv"
"""What the name of a pseudo-inverse ends in: J^# is a name of its own."""


@dataclass(slots=True)
class Scripts:
    """What stands behind a factor: the mark of a joint variable, powers, T, primes."""

    powers: list[Fraction] = field(default_factory=list)
    mark: bool = False
    transposed: bool = False
    primes: int = 0

    @property
    def any(self) -> bool:
        """Whether there is one."""
        return bool(self.powers or self.mark or self.transposed or self.primes)


@dataclass(slots=True)
class Form:
    r"""A name before it is looked up.

    `base` with `index` is the name; `script` says that it is set in calligraphic type;
    `dots` are those over it.  `angle` are the tokens of an index that is an angle
    (`C_{\theta_1}`).  `repaired` says that a power stood under the dot.
    """

    base: str
    start: int
    end: int
    index: str = ""
    script: bool = False
    dots: int = 0
    angle: list[Token] = field(default_factory=list)
    scripts: Scripts = field(default_factory=Scripts)
    repaired: bool = False

    @property
    def key(self) -> str:
        """The letters and digits of the name."""
        return key(self.base + self.index)

    @property
    def marked_key(self) -> str:
        """The key with the mark, the primes and dots, or the square behind it: of I^*, I', v_1^2."""
        scripts = self.scripts
        squared = "^2" if scripts.powers == [2] else ""
        return f"{self.key}{'*' * scripts.mark}{chr(39) * (self.dots + scripts.primes)}{squared}"

    @property
    def base_index(self) -> str:
        """The index of a name that is written in one piece: the i of P_i."""
        return self.base.partition("_")[2]

    @property
    def text(self) -> str:
        """The name as messages show it."""
        index = self.index.strip("_{}").removesuffix(PSEUDO_INVERSE)
        mark = "^#" if self.index.endswith(PSEUDO_INVERSE) else ""
        return (f"{self.base}_{{{index}}}" if index else self.base) + mark


def index_text(tokens: list[Token]) -> str:
    r"""The index that tokens spell: `{\omega_1}` is omega1, `{1,zz}` is 1zz."""
    kept, dots = [], ""
    for token in tokens:
        if token.kind == "command" and token.text in ("dot", "ddot"):
            dots = token.text  # SymPy sets the ddot of theta1_ddot as a d with a dot
        elif token.kind in ("name", "letter", "number", "+", "-"):
            kept.append(token.text + (dots or ("", "dot", "ddot")[token.dots]))
            dots = ""
    return key("".join(kept))


def is_angle(tokens: list[Token]) -> bool:
    r"""Whether an index is an angle rather than digits: `\theta_1`, `q_1+q_2`, `1+2`."""
    return any(t.kind in ("name", "letter", "+", "-", "command") for t in tokens)
