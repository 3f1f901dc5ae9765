r"""Names as they are written, and the scripts behind them: `\dot{L}_2^{\star 2}`, theta1'', q^T.

Moving over the tokens of one formula: one is looked at, brackets close, levels are counted.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from fractions import Fraction

from msgspec import Struct, field

from dynsolve.answers.reading.grids import MAX_EXPONENT, MAX_NESTING, Value
from dynsolve.answers.reading.lexer import Token
from dynsolve.answers.reading.vocabulary import DRIVING, Vocabulary
from dynsolve.errors import ReadError
from dynsolve.notation.tree import Function, Negative, Node, Number, Power, Product, Quotient, Sum
from dynsolve.quantities import families
from dynsolve.quantities.letters import key

# Moving over the tokens of one formula


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
            raise _unclosed(opening, kind)
        raise self.unexpected(f"`{kind}` is expected here")

    def unexpected(self, help: str = "") -> ReadError:
        """The error about the token that is looked at."""
        token = self.token
        if token.kind == "end":
            return ReadError("the formula ends here too early", max(token.start - 1, 0), 1, help)
        if token.kind in (")", "]", "}"):
            help = help or "delete it, or add the bracket that it belongs to"
            return token.fault(f"this `{token.text}` closes nothing", help, 1)
        beside = self.tokens[self.position - 1].kind, self.peek().kind
        if token.kind == "," and beside == ("number", "number"):
            help = "a decimal is written with a point: 9.81"
        shown = "\\" + token.text if token.kind in ("command", "letter") else token.text
        help = help or "a sum of products of numbers, names and functions is expected"
        return token.fault(f"`{shown[:40]}` cannot stand here", help)

    def enter(self) -> None:
        """One level deeper."""
        self.nesting += 1
        if self.nesting > MAX_NESTING:
            message = f"more than {MAX_NESTING} levels of brackets, fractions and signs"
            raise self.token.fault(message, "name a part of it with an abbreviation", 1)

    def group(self) -> list[Token]:
        """The tokens of an argument: those between braces, or one token."""
        opening = self.take()
        if opening.kind == "end":
            raise ReadError("an argument is missing here", max(opening.start - 1, 0), 1, "write it in { }")
        if opening.kind == "(":
            return [opening, *self.until(")", opening), Token(")", ")", opening.start, opening.start + 1)]
        return self.until("}", opening) if opening.kind == "{" else [opening]

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
        raise _unclosed(opening, closing)


def _unclosed(opening: Token, closing: str) -> ReadError:
    return opening.fault(
        f"this `{opening.text}` is never closed", f"add the `{closing}` that it belongs to", 1
    )


# Powers: which exponents are read, and the trees they make


RAISED = str.maketrans("⁻⁺⁰¹²³⁴⁵⁶⁷⁸⁹", "-+0123456789")


def raised_number(token: Token) -> int:
    """The number that raised digits spell."""
    digits = token.text.translate(RAISED)
    if len(digits) > 4:
        raise token.fault("an exponent is a small whole number")
    return int(digits)


def bounded(value: Fraction, sign: Token) -> Fraction:
    """The exponent, if it is one that is read."""
    if abs(value) != Fraction(1, 2) and (value.denominator != 1 or abs(value) > MAX_EXPONENT):
        message = f"an exponent is a whole number from -{MAX_EXPONENT} to {MAX_EXPONENT}"
        raise sign.fault(message, "a square root is written \\sqrt{x} or sqrt(x)")
    return value


def raise_to(base: Node, power: Fraction) -> Node:
    """base^power; a half is a root, |x|² is x² and √x² is x."""
    match base:
        case Product((x, Function("sgn"))) if power % 2 == 0 and base == magnitude(x):
            base = x
        case Function("sqrt", x) if power % 2 == 0 and power:
            return x if power == 2 else raise_to(x, power / 2)
    if power.denominator == 2:
        root = Function("sqrt", base)
        return root if power > 0 else Quotient(Number(1), root)
    whole = Number(abs(power.numerator))
    return Power(base, Negative(whole) if power < 0 else whole)


def magnitude(x: Node) -> Node:
    """|x| as x sgn x."""
    return Product((x, Function("sgn", x)))


def constant(node: Node) -> Fraction | None:
    """The value of a tree of small numbers, None for every other."""
    match node:
        case Number(p, q):
            return Fraction(p, q)
        case Negative(argument):
            inner = constant(argument)
            return None if inner is None else -inner
        case Quotient(numerator, denominator):
            top, bottom = constant(numerator), constant(denominator)
            return top / bottom if top is not None and bottom else None
        case Sum(terms):
            values = [constant(term) for term in terms]
            return sum((v for v in values if v is not None), Fraction(0)) if None not in values else None
        case Product(factors):
            product = Fraction(1)
            for factor in factors[:4]:
                value = constant(factor)
                if value is None:
                    return None
                product *= value
            return product if len(factors) <= 4 else None
    return None


# A name as it is written, with what stands over, under and beside it: `\dot{L}_2^{\star 2}`

PSEUDO_INVERSE = "pinv"
"""What the name of a pseudo-inverse ends in: J^# is a name of its own."""


class Scripts(Struct):
    """What stands behind a factor: the mark of a joint variable, powers, T, primes."""

    powers: list[Fraction] = field(default_factory=list)
    mark: bool = False
    transposed: bool = False
    primes: int = 0

    @property
    def any(self) -> bool:
        """Whether there is one."""
        return bool(self.powers or self.mark or self.transposed or self.primes)


class Form(Struct):
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


_OF_ANGLE = frozenset({"name", "letter", "+", "-", "command"})
r"""What an index holds that is an angle rather than digits: `\theta_1`, `q_1+q_2`, `1+2`."""

ACCENTS: Mapping[str, int] = {"dot": 1, "ddot": 2, "dddot": 3}

BEGINS = frozenset({"number", "fraction", "name", "letter", "command", "(", "[", "{", "√", "begin", "|"})
"""The tokens that a factor begins with."""

_PARTS = {
    text: part
    for part, texts in {"v": "t v lin trans tran linear", "w": "r w omega rot ang angular"}.items()
    for text in texts.split()
}
"""What stands as the superscript of a kinetic energy for its translation, v, and its rotation, w."""

MARKS = ("bar", "hat", "tilde")
r"""Accents that make another name: `\bar J` is the student's own, and so is a pseudo-inverse `J^\#`."""

_PSEUDO = frozenset({"sharp", "dagger", "dag", "ddagger"})
_OF_FORCES = frozenset("nc nk np ext act gen mot".split())
"""What stands above a generalized force and tells it from no other."""

_FORCES = (families.TAU, families.FORCE)

_TRANSPOSES = frozenset({"T", "t", "Tr", "intercal", "top"})


class ScriptCursor(Cursor):
    """Takes names and scripts; what they mean is for who derives from it."""

    __slots__ = ("vocabulary",)

    def __init__(self, tokens: list[Token], vocabulary: Vocabulary) -> None:
        super().__init__(tokens)
        self.vocabulary = vocabulary

    @abstractmethod
    def inner(self, tokens: list[Token]) -> Value:
        """The value of tokens that stand inside this text."""

    def form(self) -> Form:
        """A name with its accents and scripts, before it is looked up."""
        self.enter()
        token, mark = self.take(), ""
        if token.kind == "command" and (
            token.text in ACCENTS or token.text in MARKS or token.text == "script"
        ):
            form = self.under(token)
            form.script = form.script or token.text == "script"
            form.dots += ACCENTS.get(token.text, 0)
            form.repaired = form.repaired or bool(token.text in ACCENTS and form.scripts.powers)
            mark = token.text if token.text in MARKS else ""
        elif token.kind in ("name", "letter"):
            form = Form(token.text, token.start, token.end, dots=token.dots)
        else:
            self.position -= 1
            self.token = token
            raise self.unexpected("a name is expected here")
        form.start = token.start
        self.beside(form)
        scripts, symbol = form.scripts, self.vocabulary.symbols.get(form.key)
        is_parameter = symbol is not None and self.vocabulary.coordinate(symbol) is None
        if is_parameter and (scripts.mark or scripts.primes):  # I^* and I' are names of the student's own
            mark += "star" * scripts.mark + "prime" * scripts.primes
            scripts.mark, scripts.primes = False, 0
        form.index += mark
        self.nesting -= 1
        return form

    def under(self, command: Token) -> Form:
        """The name that an accent or a face stands over."""
        if self.token.kind == "{":
            opening = self.take()
            form = self.form()
            if self.token.kind != "}":
                message = f"more than one name stands under `\\{command.text}`"
                length = max(self.token.start - opening.start, 1)
                raise opening.fault(message, "one name is read there", length)
            self.take()
            return form
        token = self.token
        if token.kind in ("name", "letter"):
            self.take()
            return Form(token.text, token.start, token.end, dots=token.dots)
        if token.kind == "command":
            return self.form()
        raise self.unexpected(f"a name is expected under `\\{command.text}`")

    def beside(self, form: Form) -> None:
        """The indices and scripts that follow a name."""
        while True:
            kind = self.token.kind
            if kind == "_":
                self.take()
                tokens = self.group()
                form.index += index_text(tokens)
                if any(t.kind in _OF_ANGLE for t in tokens):
                    form.angle = tokens
            elif kind == "^" and (part := self.energy_part(form)):
                form.index += part
            elif kind == "^" and self.pseudo_inverse():
                form.index += PSEUDO_INVERSE
            elif kind == "^" and self.raised_index(form):
                continue
            elif kind == "[" and (index := self.bracketed_index(form)):
                form.index += index
            elif kind == "*" and self.star_is_mark(form):
                self.take()
                form.scripts.mark = True
            elif not self.script(form.scripts):
                break
        form.end = self.tokens[max(self.position - 1, 0)].end

    def raised_index(self, form: Form) -> bool:
        r"""Whether an index stands above a name, which is taken: `\tau^{(2)}`, `I_1^b`, `Q^{nc}`."""
        braced = self.peek().kind == "{"
        vocabulary, ahead = self.vocabulary, 2 if braced else 1
        inside = [self.peek(ahead + i) for i in range(3)]
        named = vocabulary.named(form.key)
        if [t.kind for t in inside] == ["(", "number", ")"]:
            name = form.key + inside[1].text
            if vocabulary.symbol(name) is None and not vocabulary.named(name):
                return False
            form.index += inside[1].text
        elif self._is_letter_of_frame(inside, braced) and vocabulary.named(form.key + inside[0].text):
            form.index += inside[0].text
        else:
            is_force = all(vocabulary.quantities[one].family in _FORCES for one in named)
            is_mark = inside[0].text in _OF_FORCES and (named or DRIVING.fullmatch(form.key))
            if not is_mark or not is_force:
                return False
        self.take()
        self.group()
        return True

    @staticmethod
    def _is_letter_of_frame(inside: list[Token], braced: bool) -> bool:
        """Whether a superscript is a letter, and no transpose."""
        first, second, _ = inside
        return first.kind == "name" and first.text not in _TRANSPOSES and (not braced or second.kind == "}")

    def bracketed_index(self, form: Form) -> str:
        """The index in brackets, which is taken, of a name with it: `m[1]`, `q[2](t)`, `D[0,0]`, `D[0][0]`.

        Of a name that has an index 0 in the file every index counts from 0, as Python's do.
        """
        found: list[Token] = []
        ahead = 0
        while self.peek(ahead).kind == "[" and not self.peek(ahead).spaced and len(found) < 2:
            found.append(self.peek(ahead + 1))
            ahead += 2
            if self.peek(ahead).kind == ",":
                found.append(self.peek(ahead + 1))
                ahead += 2
            if self.peek(ahead).kind != "]":
                return ""
            ahead += 1
        if any(t.kind not in ("number", "name") or t.text == "t" for t in found):
            return ""
        shift = int(form.key in self.vocabulary.from_zero)
        index = "".join(str(int(t.text) + shift) if t.text.isdigit() else t.text for t in found)
        name = form.key + index
        if self.vocabulary.symbol(name) is None and not self.vocabulary.named(name):
            return ""
        for _ in range(ahead):
            self.take()
        return index

    def energy_part(self, form: Form) -> str:
        r"""The letter of the part of an energy that its superscript names, which is taken: `K_1^{rot}`."""
        if form.base.partition("_")[0] not in ("K", "T", "E") or not (form.index or form.base_index):
            return ""
        ahead = 2 if self.peek(1).kind == "{" else 1
        part = _PARTS.get(self.peek(ahead).text, "")
        if part:
            self.take()
            self.group()
        return part

    def pseudo_inverse(self) -> bool:
        r"""Whether the superscript marks another matrix, which is taken: `J^\#`, `J^\dagger`, `J^+`."""
        braced = self.peek(1).kind == "{"
        mark, after = self.peek(2 if braced else 1), self.peek(3 if braced else 2)
        is_mark = mark.text in _PSEUDO if mark.kind == "command" else mark.kind == "+"
        ends = after.kind == "}" if braced else mark.kind == "command" or after.kind in ("=", "end")
        if is_mark and ends:
            self.take()
            self.group()
        return is_mark and ends

    def star_is_mark(self, form: Form) -> bool:
        """Whether the star here touches a coordinate's name and no factor follows."""
        if self.token.spaced or self.peek().kind in BEGINS or self.is_quoted(1):
            return False
        meaning = self.vocabulary.symbol(form.key)
        return meaning is not None and self.vocabulary.coordinate(meaning.value) is not None

    def is_quoted(self, ahead: int = 0) -> bool:
        """Whether Maxima's `'diff(` stands there, whose quote is no prime of what is before it."""
        return self.peek(ahead).kind == "'" and self.peek(ahead + 1).text == "diff"

    def script(self, scripts: Scripts) -> bool:
        """Take one script, if one stands here."""
        token = self.token
        if token.kind == "raised":
            self.take()
            scripts.powers.append(bounded(Fraction(raised_number(token)), token))
            return True
        if (token.kind == "'" or token.kind == "''") and not self.is_quoted():
            self.take()
            scripts.primes += len(token.kind)
            return True
        if token.kind == "." and self.peek().text == "T" and not self.peek().spaced:
            self.take(), self.take()
            scripts.transposed = True
            return True
        if token.kind == "." and self.peek().text == "diff" and self.peek(2).kind == "(":
            self.take(), self.take()
            arguments = self.until(")", self.take())
            numbers = [int(t.text) for t in arguments if t.kind == "number" and t.text in ("1", "2")]
            scripts.primes += numbers[0] if numbers else sum(t.text == "t" for t in arguments)
            return True
        if token.kind != "^":
            return False
        self.take()
        self.enter()
        self.superscript(scripts, token)
        self.nesting -= 1
        return True

    def superscript(self, scripts: Scripts, sign: Token) -> None:
        """What stands after `^`."""
        signs = [self.take()] if self.token.kind in ("-", "+") else []
        tokens = [
            t for t in [*signs, *self.group()] if t.kind != "command" or t.text not in ("quad", "qquad")
        ]
        if tokens and tokens[0].kind == "*":
            scripts.mark = True
            tokens = [t for t in tokens[1:] if t.kind not in ("^", "{", "}")]
        elif tokens and tokens[-1].kind == "*":
            scripts.mark = True
            tokens = tokens[:-1]
        if not tokens:
            return
        if all(t.kind == "cdot" for t in tokens):  # (m r² φ̇)^·
            scripts.primes += len(tokens)
        elif all(t.kind in ("'", "''") for t in tokens):
            scripts.primes += sum(len(t.kind) for t in tokens)
        elif len(tokens) == 1 and tokens[0].text in _TRANSPOSES:
            scripts.transposed = True
        else:
            scripts.powers.append(bounded(self.exponent(tokens, sign), sign))

    def exponent(self, tokens: list[Token], sign: Token) -> Fraction:
        """The value of an exponent, a small constant."""
        first = tokens[0]
        if len(tokens) == 1 and first.kind == "number" and first.text.isdigit() and len(first.text) < 4:
            return Fraction(int(first.text))
        value = self.inner(tokens)
        found = constant(value) if isinstance(value, Node) else None
        if found is None:
            length = max(tokens[-1].end - sign.start, 1)
            raise sign.fault("this exponent is no number", "an exponent is a small whole number", length)
        return found
