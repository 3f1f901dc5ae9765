r"""The descent: prepared tokens -> a value in the symbols of the problem.

    sum      = [sign] term {("+" | "-") term}
    term     = factor {["*" | "/" | cdot | times] factor}        a product needs no sign
    factor   = {sign} atom
    atom     = (number | name | function | fraction | matrix | "(" sum ")" | derivative) scripts

Each rule is a method of `FormulaReader`, or a function of the module that is named after
what it reads: `brackets`, `references`, `derivatives`, `names`.  Values are only put
together: nothing is computed.
"""

from __future__ import annotations

from fractions import Fraction

from dynsolve.answers.reading.grammar import brackets, derivatives, names, references
from dynsolve.answers.reading.grammar.reader import Reader
from dynsolve.answers.reading.grammar.scripts import ACCENTS, BEGINS, MARKS, Form, Scripts
from dynsolve.answers.reading.grids import Grid, Value, divided, negative, times, total
from dynsolve.answers.reading.lexer import Token
from dynsolve.errors import ReadError
from dynsolve.notation import text as plain
from dynsolve.notation.tree import Degrees, Node, Number, Product, Quotient

# Numbers as they are written: decimals, and degrees as `90°`, `90 deg` or `90^\circ`

_BEFORE_DEGREES = frozenset({"°", "name", "^"})
"""The tokens that the sign of degrees may begin with."""

_DEGREES = frozenset({"deg", "degrees", "degree", "Grad", "grader"})


def read(reader: Reader) -> Value:
    """A number, with its degrees."""
    token = reader.take()
    if token.text == "0" and reader.token.kind == "_":  # 0_{2×2}
        reader.take(), reader.group()
    if len(token.text) == 1 and reader.token.kind not in _BEFORE_DEGREES:  # as most numbers are
        return reader.scripted(Number(int(token.text)))
    value = plain.rational(plain.FormulaToken("number", token.text, token.start, token.end))
    if reader.token.kind == "°" or (reader.token.kind == "name" and reader.token.text in _DEGREES):
        reader.take()
        return Degrees(value.numerator, value.denominator)
    if reader.token.kind == "^" and _circle(reader):
        return Degrees(value.numerator, value.denominator)
    return reader.scripted(_written(value, token.text))


def _circle(reader: Reader) -> bool:
    r"""Take `^\circ`, if that is what stands here."""
    is_braced = (reader.peek(1).kind, reader.peek(3).kind) == ("{", "}")
    is_one = reader.peek(2 if is_braced else 1).text == "circ"
    if is_one:
        for _ in range(4 if is_braced else 2):
            reader.take()
    return is_one


def _written(value: Fraction, text: str) -> Number:
    """A number with as many decimals as were written: 0.10 is 10/100, which rounds more than 0.1 does."""
    _, point, decimals = text.partition(".")
    scale = 10 ** len(decimals) if point and decimals.isdigit() and value else value.denominator
    return Number(int(value * scale), scale, scale != 1)


_PRODUCT_SIGNS = frozenset({"*", "cdot", "times"})


class FormulaReader(Reader):
    """Reads one list of prepared tokens; `token` is the next one."""

    __slots__ = ()

    def value(self) -> Value:
        """The value of all tokens; raises ReadError for what cannot be read."""
        if self.token.kind == "end":
            raise self.token.fault("there is nothing here", "write the formula", 1)
        found = self.sum()
        if self.token.kind != "end":
            raise self.unexpected()
        return found

    def inner(self, tokens: list[Token], naming: bool | None = None) -> Value:
        """The value of tokens that stand inside this text; what it is made of is added here."""
        self.enter()
        naming = self.naming if naming is None else naming
        reader = FormulaReader(tokens, self.vocabulary, naming, self.owner, self.options)
        reader.nesting = self.nesting
        reader.references, reader.symbols = self.references, self.symbols
        reader.notes, reader.free = self.notes, self.free
        found = reader.value()
        self.names_used += reader.names_used
        self.nesting -= 1
        return found

    # Sums and products

    def sum(self, first: Form | None = None) -> Value:
        """Terms with their signs; `first` is a name that was taken already."""
        self.enter()
        sign = self._leading_sign() if first is None else "+"
        terms: list[Value] = []
        while True:
            start = self.token.start
            term = self.term(first)
            first = None
            terms.append(negative(term) if sign == "-" else term)
            sign = self.token.kind
            if (sign != "+" and sign != "-") or (self.rows_by_line and self.token.broken):
                break
            if self.by_blanks and self.token.spaced and not self.peek().spaced:  # MATLAB's [a -b]
                break
            self.take()
        self.nesting -= 1
        if len(terms) > 1:
            terms = references.vectors_for_letters(self, terms)
        found = terms[0] if len(terms) == 1 else self.placed(start, total, terms)
        if sign == "over":
            self.take()
            return self.placed(start, divided, found, self.sum())
        return found

    def _leading_sign(self) -> str:
        sign = "+"
        while self.token.kind in ("+", "-"):
            sign = "-" if (self.take().kind == "-") != (sign == "-") else "+"
        return sign

    def term(self, first: Form | None = None) -> Value:
        """Factors, with or without a sign between them; `first` is a name that was taken already."""
        start = self.token.start
        scalars: list[Node] = []
        other: Value | None = None
        sign, value = "", self.factor() if first is None else names.value_of(self, first)
        while True:
            if isinstance(value, Node):
                scalars.append(value)
            else:
                if other is None and len(scalars) == 1:
                    other = references.matrix_for_letter(self, scalars[0], value)
                    scalars = scalars if other is None else []
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
        """Whether a product goes on at the next token."""
        token = self.token
        kind = token.kind
        if kind in BEGINS:
            if self.by_blanks and token.spaced:
                return False
            if kind == "command" and token.text in brackets.STOPS:
                return False
            if kind == "|" and self.bars_separate:
                return False
        elif kind not in _PRODUCT_SIGNS and (
            kind != "'" or not self.is_quoted() or (self.by_blanks and token.spaced)
        ):
            return False
        return not (self.rows_by_line and token.broken)

    def factor(self) -> Value:
        """Signs, then an atom with its scripts."""
        kind = self.token.kind
        if kind != "-" and kind != "+":
            return self.atom()
        self.enter()
        self.take()
        found = self.factor()
        self.nesting -= 1
        return negative(found) if kind == "-" else found

    # Atoms

    def atom(self) -> Value:
        """A number, a name, a bracket, a function; with the scripts behind it."""
        token = self.token
        kind = token.kind
        if kind == "name" or kind == "letter":
            return self.word(token)
        if kind == "number":
            return read(self)
        if kind == "fraction":
            p, _, q = self.take().text.partition("/")
            return self.scripted(Quotient(Number(int(p)), Number(int(q))))
        if kind == "command":
            return self.command(token)
        if kind in ("(", "[", "{", "begin", "⟨"):
            return self.bracketed()
        if kind == "√":
            self.enter()
            self.take()
            argument = self.atom()
            self.nesting -= 1
            return references.applied(self, "sqrt", argument, token)
        if kind in ("^", "_"):
            return self.framed()
        if kind == "|":
            return self.norm()
        if self.is_quoted():
            self.take()
            return self.word(self.token)
        raise self.unexpected()

    def word(self, token: Token) -> Value:
        """A letter or a run of them: a function, a call, a derivative or a name."""
        if token.kind == "name":
            if derivatives.stands_here(self):
                return self.scripted(derivatives.read(self))
            if (function := references.name_of(token, self.vocabulary)) is not None:
                return references.read(self, function)
            if derivatives.is_call(self):
                return self.scripted(derivatives.read_call(self))
        if references.is_short_function(self):
            return references.read(self, "sin" if token.text in "sS" else "cos")
        return names.value_of(self, self.form())

    def bracketed(self) -> Value:
        """A parenthesis, a group or a matrix, with its scripts."""
        self.enter()
        if self.token.kind == "{":
            opening = self.take()
            if self.token.kind == "}" and self.peek().kind in ("^", "_"):
                self.take()
                self.nesting -= 1
                return self.framed()
            form = self.form() if self.begins_with_name() else None
            if form is not None and self.token.kind == "}":
                self.take()
                self.beside(form)
                self.nesting -= 1
                return names.value_of(self, form)
            found = brackets.listed(self, self.sum(form), opening)
        else:
            found = brackets.read(self)
        self.nesting -= 1
        return self.scripted(found)

    def begins_with_name(self) -> bool:
        """Whether a name stands here that is no function, call or derivative."""
        token = self.token
        accented = token.kind == "command" and (token.text in ACCENTS or token.text in MARKS)
        if token.kind not in ("name", "letter") and not accented:
            return False
        return not (
            references.name_of(token, self.vocabulary) is not None
            or derivatives.is_call(self)
            or derivatives.stands_here(self)
            or references.is_short_function(self)
        )

    def framed(self) -> Value:
        """A name with the frames before it: `{}^0T_2`, `{}^0_2T`."""
        sign = self.token
        frames: dict[str, str] = {}
        while self.token.kind in ("^", "_") and self.token.kind not in frames:
            kind = self.take().kind
            frame = self.group()
            if len(frame) == 1 and frame[0].kind == "number" and len(frame[0].text) < 3:
                frames[kind] = frame[0].text
        if "^" in frames and self.token.text == "hat" and (vector := self.unit_vector()) is not None:
            return vector
        if "^" not in frames or not self.begins_with_name():
            raise sign.fault(f"nothing stands before this `{sign.text}`", "a script follows its base", 1)
        form = self.form()
        form.scripts.powers.insert(0, Fraction(int(frames["^"])))
        if not form.index and "_" not in form.base:
            form.index = frames.get("_", "")
        return names.value_of(self, form)

    def norm(self) -> Value:
        """The absolute value of a scalar, or the length of a vector, of which the square alone is read."""
        opening = self.take()
        tokens = self.until("|", opening)
        is_matrix = any(token.kind in ("begin", ",", ";") for token in tokens)
        if is_matrix and self.vocabulary.shape(self.owner) not in (None, (1, 1)):
            ends = (opening._replace(kind=kind) for kind in "[]")
            return self.scripted(self.inner([next(ends), *tokens, next(ends)]))
        value = self.inner(tokens)
        scripts = Scripts()
        if self.script(scripts) and scripts.powers == [Fraction(2)]:
            return self.with_scripts(value, scripts, opening.start)
        if isinstance(value, Node):
            return self.with_scripts(references.applied(self, "abs", value, opening), scripts, opening.start)
        help = "write it out; |v|^2 is read for a vector v"
        raise opening.fault("the length of a vector cannot be read", help, 1)

    def command(self, token: Token) -> Value:
        """What a LaTeX command begins: an accent, a function, a fraction, a derivative."""
        name = token.text
        if name == "hat" and (vector := self.unit_vector()) is not None:
            return vector
        after = self.peek().kind
        if name in ACCENTS and (after == "(" or (after == "{" and self.peek(2).kind == "(")):
            self.take()
            return self.scripted(derivatives.total_rate(self, self.atom(), ACCENTS[name]))
        if name in ACCENTS or name in MARKS or name == "script":
            return names.value_of(self, self.form())
        if (function := references.name_of(token, self.vocabulary)) is not None:
            return references.read(self, function)
        if name == "frac":
            return self.scripted(self.fraction())
        if derivatives.stands_here(self):
            return self.scripted(derivatives.read(self))
        if name in ("sum", "int", "prod"):
            return derivatives.running_sum(self)
        if name == "binom":
            self.take()
            above, below = self.group(), self.group()
            return self.scripted(brackets.finished(self, [[self.inner(above)], [self.inner(below)]], token))
        if name == "nabla":
            return self.gradient()
        if name in ("cdots", "ldots", "dots", "vdots", "ddots"):
            raise token.fault("dots stand for something that was left out", "write it out")
        raise token.fault(f"unknown command `\\{name[:40]}`", "the commands of LaTeX's formulas are read")

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

    def gradient(self) -> Value:
        r"""`\nabla P`, which is g."""
        start = self.take().start
        if self.token.kind == "_":
            self.take(), self.group()
        form = self.form() if self.begins_with_name() else None
        is_potential = form is not None and "P" in self.vocabulary.named(form.key)
        found = references.quantity(self, Form("g", start, self.token.start), "g") if is_potential else None
        if found is None:
            help = "the gradient of the potential energy is read"
            raise ReadError("this is the gradient of nothing known", start, 1, help)
        return found

    def unit_vector(self) -> Value | None:
        r"""`\hat{k}`, which is taken: a unit vector of the base frame; other names with a hat are none."""
        position = self.position
        form = self.form()
        axis = {"i": 0, "x": 0, "x0": 0, "j": 1, "y": 1, "y0": 1, "k": 2, "z": 2, "z0": 2}.get(
            form.key.replace("hat", "")
        )
        if axis is None or form.key in self.vocabulary.defined:
            self.position, self.token = position, self.tokens[position]
            return None
        return Grid(tuple((Number(int(row == axis)),) for row in range(3)))


def _with_scalars(scalars: list[Node], other: Value | None) -> Value:
    if other is None:
        return scalars[0] if len(scalars) == 1 else Product(tuple(scalars))
    if not scalars:
        return other
    return times(_with_scalars(scalars, None), other)
