"""The descent: prepared tokens -> a value in the symbols of the problem.

    sum      = [sign] term {("+" | "-") term}
    term     = factor {["*" | "/" | cdot | times] factor}        a product needs no sign
    factor   = {sign} atom scripts
    atom     = number | name | function | fraction | matrix | "(" sum ")" | derivative

Names are looked up in the vocabulary as they come; nothing else happens to a value
than being put together.
"""

from __future__ import annotations

from fractions import Fraction

from dynsolve.answers.reading import brackets, calls, derivatives, functions, name_resolution
from dynsolve.answers.reading.exponents import raise_to
from dynsolve.answers.reading.forms import Form, Scripts
from dynsolve.answers.reading.grids import (
    Abstract,
    Grid,
    Value,
    divided,
    negative,
    times,
    total,
    transposed,
)
from dynsolve.answers.reading.lexer import Token
from dynsolve.answers.reading.naming import ACCENTS, BEGINS, NameCursor
from dynsolve.answers.reading.vocabulary import Vocabulary
from dynsolve.errors import ReadError
from dynsolve.notation import tokens as plain
from dynsolve.notation.tree import (
    Degrees,
    Node,
    Number,
    Product,
    Quotient,
)

_PRODUCT_SIGNS = frozenset({"*", "cdot", "times"})


class Reader(NameCursor):
    """Reads one list of prepared tokens; `token` is the one that is looked at.

    `naming` makes names of answers win over symbols, as on a left-hand side.
    `references`, `symbols` and `notes` collect what the value is made of.
    """

    __slots__ = (
        "naming",
        "references",
        "symbols",
        "notes",
        "candidates",
        "free",
        "options",
        "owner",
        "names_used",
        "rows_by_line",
    )

    def __init__(
        self,
        tokens: list[Token],
        vocabulary: Vocabulary,
        naming: bool = False,
        owner: str = "",
        options: frozenset[str] = frozenset(),
    ) -> None:
        super().__init__(tokens, vocabulary)
        self.naming = naming
        self.owner = owner
        self.options = options
        self.references: dict[str, None] = {}
        self.symbols: dict[str, None] = {}
        self.notes: dict[str, None] = {}
        self.free: dict[str, None] = {}
        self.candidates: tuple[str, ...] = ()
        self.names_used = 0
        self.rows_by_line = False

    def value(self) -> Value:
        """The value of all tokens; raises ReadError for what cannot be read."""
        if self.token.kind == "end":
            raise ReadError("there is nothing here", self.token.start, 1, "write the formula")
        found = self.sum()
        if self.token.kind != "end":
            raise self.unexpected()
        return found

    def inner(self, tokens: list[Token], naming: bool | None = None) -> Value:
        """The value of tokens that stand inside this text."""
        self.enter()
        reader = Reader(
            tokens, self.vocabulary, self.naming if naming is None else naming, self.owner, self.options
        )
        reader.nesting = self.nesting
        reader.references, reader.symbols = self.references, self.symbols
        reader.notes, reader.free = self.notes, self.free
        found = reader.value()
        self.names_used += reader.names_used
        self.nesting -= 1
        return found

    # The grammar

    def sum(self, seed: Form | None = None) -> Value:
        """Terms with their signs; `seed` is a name that was taken already."""
        self.enter()
        terms: list[Value] = []
        sign = "+"
        if seed is None:
            while self.token.kind in ("+", "-"):
                sign = "-" if (self.take().kind == "-") != (sign == "-") else "+"
        while True:
            start = self.token.start
            term = self.term(seed)
            seed = None
            terms.append(negative(term) if sign == "-" else term)
            sign = self.token.kind
            if (sign != "+" and sign != "-") or (self.rows_by_line and self.token.broken):
                break
            self.take()
        self.nesting -= 1
        found = terms[0] if len(terms) == 1 else self.placed(start, total, terms)
        if self.token.kind == "over":
            self.take()
            return self.placed(start, divided, found, self.sum())
        return found

    def placed(self, start: int, operation: object, *values: object) -> Value:
        """The result of an operation on matrices, whose errors get their place here."""
        assert callable(operation)
        try:
            result: Value = operation(*values)
        except ReadError as error:
            end = self.tokens[max(self.position - 1, 0)].end
            raise ReadError(error.message, start, max(end - start, 1), error.help) from None
        return result

    def term(self, seed: Form | None = None) -> Value:
        """Factors, with or without a sign between them."""
        start = self.token.start
        scalars: list[Node] = []
        other: Value | None = None
        sign, value = "", self.factor(seed)
        while True:
            if isinstance(value, Node):
                scalars.append(value)
            else:
                other = value if other is None else self.placed(start, times, other, value, sign)
            while self.token.kind == "/":
                self.take()
                other = self.placed(start, divided, _with_scalars(scalars, other), self.factor())
                scalars = []
            if isinstance(other, Node):
                scalars.append(other)
                other = None
            if not self.follows():
                return _with_scalars(scalars, other)
            sign = self.take().kind if self.token.kind in _PRODUCT_SIGNS else ""
            value = self.factor()

    def follows(self) -> bool:
        """Whether a product or a quotient goes on at the token that is looked at."""
        kind = self.token.kind
        if kind == "command" and self.token.text in brackets.STOPS:
            return False
        if self.rows_by_line and self.token.broken:
            return False
        begins = kind in BEGINS or self.is_quoted()
        if "spaces" in self.options and self.token.spaced and begins:
            return False
        return begins or kind in _PRODUCT_SIGNS

    def factor(self, seed: Form | None = None) -> Value:
        """Signs, then an atom with its scripts."""
        if seed is not None:
            return self.named(seed)
        kind = self.token.kind
        if kind == "-" or kind == "+":
            self.enter()
            self.take()
            found = self.factor()
            self.nesting -= 1
            return negative(found) if kind == "-" else found
        return self.atom()

    def atom(self) -> Value:
        """A number, a name, a bracket, a function; with the scripts behind it."""
        token = self.token
        kind = token.kind
        if kind == "name" or kind == "letter":
            return self.word(token)
        if kind == "number":
            return self.number()
        if kind == "fraction":
            p, _, q = self.take().text.partition("/")
            return self.scripted(Quotient(Number(int(p)), Number(int(q))))
        if kind == "command":
            return self.command(token)
        if kind in ("(", "[", "{", "begin"):
            return self.bracketed()
        if kind == "√":
            self.enter()
            self.take()
            argument = self.atom()
            self.nesting -= 1
            return functions.applied(self, "sqrt", argument, token)
        if kind == "^":
            return self.framed()
        if kind == "|":
            return self.norm()
        if self.is_quoted():
            self.take()
            return self.word(self.token)
        raise self.unexpected()

    def framed(self) -> Value:
        """A name with the frame before it: `{}^0T_2`."""
        sign = self.take()
        frame = self.group()
        if (
            len(frame) != 1
            or frame[0].kind != "number"
            or len(frame[0].text) > 2
            or self.token.kind not in ("name", "letter")
        ):
            raise ReadError("nothing stands before this `^`", sign.start, 1, "a power follows its base")
        form = self.form()
        form.scripts.powers.insert(0, Fraction(int(frame[0].text)))
        return self.named(form)

    def number(self) -> Value:
        """A number, with its degrees."""
        token = self.take()
        value = plain.rational(plain.FormulaToken("number", token.text, token.start, token.end))
        if self.token.kind == "°" or (self.token.kind == "name" and self.token.text == "deg"):
            self.take()
            return Degrees(value.numerator, value.denominator)
        if self.token.kind == "^" and self.circle():
            return Degrees(value.numerator, value.denominator)
        return self.scripted(_written(value, token.text))

    def circle(self) -> bool:
        r"""Take `^\circ`, if that is what stands here."""
        ahead = [self.peek(1), self.peek(2), self.peek(3)]
        if ahead[0].text == "circ":
            self.take(), self.take()
            return True
        if ahead[0].kind == "{" and ahead[1].text == "circ" and ahead[2].kind == "}":
            self.take(), self.take(), self.take(), self.take()
            return True
        return False

    def bracketed(self) -> Value:
        """A parenthesis, a group or a matrix, with its scripts."""
        self.enter()
        if self.token.kind == "{":
            opening = self.take()
            if self.token.kind in ("name", "letter") or (
                self.token.kind == "command" and self.token.text in ACCENTS
            ):
                if not self.special():
                    form = self.form()
                    if self.token.kind == "}":
                        self.take()
                        self.nesting -= 1
                        return self.named(form)
                    found = self.sum(form)
                else:
                    found = self.sum()
            else:
                found = self.sum()
            self.expect("}", opening)
        else:
            found = brackets.read(self)
        self.nesting -= 1
        return self.scripted(found)

    def special(self) -> bool:
        """Whether the name here is a function, a call or a derivative rather than a symbol."""
        return (
            functions.name_of(self.token) is not None
            or calls.is_call(self)
            or derivatives.stands_here(self)
            or name_resolution.is_short_function(self)
        )

    def word(self, token: Token) -> Value:
        """A letter or a run of them: a function, a call, a derivative or a name."""
        if token.kind == "name":
            if derivatives.stands_here(self):
                return self.scripted(derivatives.read(self))
            if (function := functions.name_of(token)) is not None:
                return functions.read(self, function)
            if calls.is_call(self):
                return self.scripted(calls.read(self))
        if name_resolution.is_short_function(self):
            return functions.read(self, "sin" if token.text in "sS" else "cos")
        return self.named(self.form())

    def command(self, token: Token) -> Value:
        """What a LaTeX command begins: an accent, a function, a fraction, a derivative."""
        name = token.text
        if name in ACCENTS or name == "script":
            return self.named(self.form())
        if (function := functions.name_of(token)) is not None:
            return functions.read(self, function)
        if name == "frac":
            return self.scripted(self.fraction())
        if derivatives.stands_here(self):
            return self.scripted(derivatives.read(self))
        if name in ("sum", "int", "prod"):
            return calls.running_sum(self)
        if name in ("cdots", "ldots", "dots", "vdots", "ddots"):
            raise ReadError(
                "dots stand for something that was left out",
                token.start,
                token.end - token.start,
                "write it out",
            )
        if name == "hat":
            return self.unit_vector()
        if name in ("underbrace", "overbrace"):
            self.take()
            found = self.inner(self.group())
            while self.token.kind in ("_", "^"):
                self.take()
                self.group()
            return found
        message = f"unknown command `\\{name[:40]}`"
        raise ReadError(
            message, token.start, token.end - token.start, "the commands of LaTeX's formulas are read"
        )

    def norm(self) -> Value:
        """The length of a vector, of which the square alone is read."""
        opening = self.take()
        value = self.inner(self.until("|", opening))
        scripts = Scripts()
        if not isinstance(value, Node) and self.script(scripts) and scripts.powers == [Fraction(2)]:
            return self.with_scripts(value, scripts, opening.start)
        message = "a length or an absolute value cannot be read"
        raise ReadError(message, opening.start, 1, "write it out; |v|^2 is read for a vector v")

    def unit_vector(self) -> Value:
        r"""`\hat{k}`: a unit vector of the base frame; of other frames none is known."""
        self.take()
        form = self.form()
        axis = {"i": 0, "x": 0, "x0": 0, "j": 1, "y": 1, "y0": 1, "k": 2, "z": 2, "z0": 2}.get(form.key)
        if axis is None:
            self.names_used += 1
            return Abstract(f"{form.text} with a hat is a letter of the derivation")
        return Grid(tuple((Number(int(row == axis)),) for row in range(3)))

    def fraction(self) -> Value:
        r"""`\frac{a}{b}`, which may be a derivative."""
        self.enter()
        start = self.take().start
        above, below = self.group(), self.group()
        found = derivatives.quotient(self, above, below, start)
        if found is None:
            found = self.placed(start, divided, self.inner(above), self.inner(below))
        self.nesting -= 1
        return found

    def scripted(self, value: Value) -> Value:
        """The value with the scripts that follow it."""
        if self.token.kind not in ("^", "raised", "'", "''", "."):
            return value
        scripts, start = Scripts(), self.token.start
        while self.script(scripts):
            pass
        return self.with_scripts(value, scripts, start)

    def with_scripts(self, value: Value, scripts: Scripts, start: int) -> Value:
        """The value transposed and raised to its powers."""
        if scripts.transposed or scripts.primes:
            if isinstance(value, Node) and scripts.primes:
                dotted = name_resolution.rate(value, self.vocabulary, scripts.primes)
                if dotted is None:
                    raise ReadError(
                        "a prime stands here after what has no derivative", start, 1, "theta1' is a velocity"
                    )
                value = dotted
            else:
                value = transposed(value)
        for power in scripts.powers:
            value = self.raised(value, power, start)
        return value

    def raised(self, value: Value, power: Fraction, start: int) -> Value:
        """The value raised to a power."""
        if isinstance(value, Abstract):
            return value
        if isinstance(value, Grid):
            if power == 2 and value.shape[1] == 1:
                return times(transposed(value), value)
            raise ReadError("a power of a matrix", start, 1, "write the product out")
        return raise_to(value, power)

    def named(self, form: Form) -> Value:
        """The value of a name with its scripts."""
        return name_resolution.value_of(self, form)


def _written(value: Fraction, text: str) -> Number:
    """A number with as many decimals as were written: 0.10 is 10/100, which rounds more than 0.1 does."""
    _, point, decimals = text.partition(".")
    scale = 10 ** len(decimals) if point and decimals.isdigit() and value else value.denominator
    return Number(int(value * scale), scale, scale != 1)


def _with_scalars(scalars: list[Node], other: Value | None) -> Value:
    if other is None:
        return scalars[0] if len(scalars) == 1 else Product(tuple(scalars))
    if not scalars:
        return other
    return times(_with_scalars(scalars, None), other)
