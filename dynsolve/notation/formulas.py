"""The printer that every notation of whole formulas derives from.

It knows where parentheses, scripts and signs stand; how they are written is left to the
notation.  To add a notation, derive from `FormulaPrinter` in a file of its own: set the
attributes, and write the methods below "How a notation writes".  A notation in which
formulas stand on one line (`notation.unicode`) replaces further methods, for it needs more
parentheses.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

from dynsolve.notation.characters import GREEK, describes, runs, split
from dynsolve.notation.printing import PLAIN, Printer, Style, flat_factors, is_numeric, is_whole, shorthand
from dynsolve.notation.tree import (
    Arguments,
    BigSum,
    Cross,
    Derivative,
    Entry,
    Function,
    Letter,
    Matrix,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Reference,
    Relation,
    Row,
    Slashed,
    Sum,
    Symbol,
    Transpose,
    Words,
)

_INVERSES = {"acos": "arccos", "asin": "arcsin", "atan": "arctan"}
_SUMS = frozenset({Sum, Cross, Relation})


class FormulaPrinter(Printer):
    """A printer of whole formulas."""

    between: ClassVar[str] = " "
    """What stands between parts side by side."""

    after_operator: ClassVar[str] = " "
    """What stands between an operator (d/dt, Σ) and what it is applied to."""

    star: ClassVar[str] = ""
    """The mark of a joint variable."""

    dot: ClassVar[str] = ""
    """The sign of a product before a number."""

    cross: ClassVar[str] = " × "
    """The sign of a cross product."""

    transposition: ClassVar[str] = "T"
    """The exponent of a transpose."""

    argument_separator: ClassVar[str] = ", "
    """What stands between the arguments of a function."""

    compound: ClassVar[frozenset[type[Node]]] = frozenset({Sum, Product, Cross, BigSum, Derivative, Relation})
    """What needs parentheses beside the sign of a cross product."""

    bare_bases: ClassVar[frozenset[type[Node]]] = frozenset({Parenthesized})
    """What needs no parentheses under an exponent, beside symbols, letters and whole numbers."""

    def __init__(self, style: Style = PLAIN) -> None:
        super().__init__(style)
        self._names: dict[tuple[str, int], str] = {}

    # -- How a notation writes -------------------------------------------------------------------------

    def _base(self, base: str) -> str:
        """The base of a symbol or a word of an index: a Greek letter, a letter in italics, a word upright."""
        raise NotImplementedError

    def _styled(self, base: str, style: str) -> str:
        """A letter of the textbook in its style: `italic`, `bold`, `script`, `bold script` or `upright`."""
        raise NotImplementedError

    def _dotted(self, base: str, dots: int) -> str:
        """A base with dots over it, at least one."""
        raise NotImplementedError

    def _indices(self, groups: Sequence[str]) -> str:
        """Groups of indices as one subscript, see `_group`."""
        raise NotImplementedError

    def _run(self, text: str) -> str:
        """A run of digits, or of letters that are italic, within an index."""
        return text

    def _scripted(self, base: str, sub: str, sup: str) -> str:
        """A base with a subscript and a superscript; either may be empty."""
        raise NotImplementedError

    def _fraction(self, above: str, below: str) -> str:
        """above / below"""
        raise NotImplementedError

    def _stroke(self, above: str, below: str) -> str:
        """above / below in a line of words, whose parentheses are set."""
        return f"{above}/{below}"

    def _root(self, argument: Node) -> str:
        """The square root."""
        raise NotImplementedError

    def _applied(self, name: str, argument: str, exponent: str = "") -> str:
        """A function of an argument in parentheses, its name with an exponent: sin²(x)."""
        raise NotImplementedError

    def _bracketed(self, rows: Sequence[Sequence[str]]) -> str:
        """A matrix."""
        raise NotImplementedError

    def _one(self, text: str) -> str:
        """Text as one element, where the notation needs that."""
        return text

    def _differential(self, d: str, of: Node) -> str:
        """dx, where `d` is the sign of the differential."""
        return f"{d} {self.text(of)}"

    differentials: ClassVar[tuple[str, str]] = ("∂", "d")
    """The signs of a partial and of a total differential."""

    def _factor_sign(self, factor: Node, text: str) -> str:
        """What stands before a factor that is not the first: the sign of a product before a number."""
        return self.dot if text[:1].isdecimal() or is_numeric(factor) else ""

    def _side_by_side(self, pieces: Sequence[str]) -> str:
        """The runs of an index."""
        return "".join(pieces)

    # -- Numbers and names -----------------------------------------------------------------------------

    def _number(self, node: Number) -> str:
        if node.q == 1:
            return self._digits(str(node.p))
        if decimal := self.style.number(node):
            return self._digits(decimal)
        sign = self.minus if node.p < 0 else ""
        return sign + self._fraction(self._digits(str(abs(node.p))), self._digits(str(node.q)))

    def _group(self, index: str) -> str:
        """A group of indices: `c1` is an upright c and 1, `omega1` ω and 1, `max` a word, `xy` x and y."""
        return self._side_by_side([self._part_of_index(run) for run in runs(index)])

    def _part_of_index(self, run: str) -> str:
        """Greek letters, what counts and axes as they are elsewhere; what describes, a word or c, upright."""
        if run in GREEK or (run.isalpha() and len(run) > 2):
            return self._base(run)
        return self._styled(run, "upright") if describes(run) else self._run(run)

    def _symbol(self, node: Symbol) -> str:
        if self.style.starred(node):
            return self._scripted(*self._symbol_parts(node), self.star)
        key = (node.name, node.dots)
        text = self._names.get(key)
        if text is None:
            text = self._names[key] = self._scripted(*self._symbol_parts(node), "")
        return text

    def _symbol_parts(self, node: Symbol) -> tuple[str, str]:
        """The base of a symbol with its dots, and its subscript."""
        name, groups = split(node.name)
        base = self._base(name)
        return self._dotted(base, node.dots) if node.dots else base, self._indices(groups) if groups else ""

    def _letter(self, node: Letter) -> str:
        return self._scripted(*self._letter_parts(node), "" if node.sup is None else self._index(node.sup))

    def _letter_parts(self, node: Letter) -> tuple[str, str]:
        base = self._styled(self.style.base(node), node.style)
        sub = "" if node.sub is None else self._index(node.sub)
        return self._dotted(base, node.dots) if node.dots else base, sub

    def _index(self, node: Node) -> str:
        """A tree as a subscript or superscript."""
        if isinstance(node, Row):
            return self._one(self._joined([self._part(part) for part in node.parts]))
        return self._one(self._part(node))

    def _part(self, node: Node) -> str:
        """A part of an index: a letter, of a body or of an axis, as in the names of the problem."""
        match node:
            case Symbol(name, 0) if len(name) == 1 and not self.style.starred(node):
                return self._part_of_index(name)
            case Words(text) if text.isalpha() and not describes(text):
                return self._part_of_index(text)
        return self.text(node)

    def _reference(self, node: Reference) -> str:
        return self.text(Words(str(node)))

    def _arguments(self, node: Arguments) -> str:
        return self.argument_separator.join(map(self.text, node.parts))

    # -- Arithmetic ------------------------------------------------------------------------------------

    def _product(self, node: Product) -> str:
        factors = flat_factors(node)
        if not factors:
            return self._digits("1")
        if (over := self._over(factors)) is not None:
            return self._quotient(over)
        pieces: list[str] = []
        last = len(factors) - 1
        for position, factor in enumerate(factors):
            text = self.text(factor)
            kind = type(factor)
            if kind in _SUMS or (kind is BigSum and position < last):
                text = self.parenthesized(text)
            elif pieces:
                if text.startswith(self.minus):
                    text = self.parenthesized(text)
                else:
                    text = self._factor_sign(factor, text) + text
            pieces.append(text)
        return self.between.join(pieces)

    def _quotient(self, node: Quotient) -> str:
        return self._fraction(self._one(self.text(node.numerator)), self._one(self.text(node.denominator)))

    def _power(self, node: Power) -> str:
        base, exponent = node.base, self._one(self.text(node.exponent))
        if isinstance(base, Symbol):
            if self.style.starred(base):
                exponent = self._one(self.star + self.between + exponent)
            return self._scripted(*self._symbol_parts(base), exponent)
        if isinstance(base, Function) and base.name != "sqrt":
            if short := shorthand(base, self.style):
                return self._scripted(*self._shorthand_parts(short), exponent)
            if is_whole(node.exponent):
                return self._applied(base.name, self.text(base.argument), exponent)
            return self._raised(self.text(base), exponent)
        return self._to_the_power(base, exponent, self.style.is_digits(base) or type(base) in self.bare_bases)

    def _to_the_power(self, base: Node, exponent: str, bare: bool) -> str:
        if isinstance(base, Letter) and base.sup is None:
            return self._scripted(*self._letter_parts(base), exponent)
        text = self.text(base)
        return self._raised(text if bare else self.parenthesized(text), exponent)

    def _raised(self, text: str, exponent: str) -> str:
        """A text that may be several elements, with an exponent."""
        return self._scripted(text, "", exponent)

    def _function(self, node: Function) -> str:
        if short := shorthand(node, self.style):
            return self._scripted(*self._shorthand_parts(short), "")
        if node.name == "sqrt":
            return self._root(node.argument)
        return self._applied(_INVERSES.get(node.name, node.name), self.text(node.argument))

    def _shorthand_parts(self, short: tuple[str, str]) -> tuple[str, str]:
        return self._base(short[0]), self._indices(short[1].split(","))

    # -- Formulas of the textbook ----------------------------------------------------------------------

    def _matrix(self, node: Matrix) -> str:
        return self._bracketed([list(map(self.text, row)) for row in node.rows])

    def _entry(self, node: Entry) -> str:
        return self._scripted(self._one(self.parenthesized(self.text(node.of))), self._index(node.index), "")

    def _row(self, node: Row) -> str:
        texts = list(map(self.text, node.parts))
        for place, (before, text) in enumerate(zip(node.parts, texts[1:], strict=False), 1):
            if isinstance(before, Words) and text.startswith(self.minus):
                texts[place] = self._behind_words(text)
        return self._joined(texts)

    def _behind_words(self, text: str) -> str:
        """What begins with a minus, behind words: a negative, no difference."""
        return text

    def _joined(self, texts: Sequence[str]) -> str:
        """Parts side by side."""
        return self.between.join(texts)

    def _transpose(self, node: Transpose) -> str:
        bare = isinstance(node.argument, Symbol | Parenthesized | Matrix)
        return self._to_the_power(node.argument, self.transposition, bare)

    def _cross(self, node: Cross) -> str:
        return self._operand(node.left) + self.cross + self._operand(node.right)

    def _operand(self, node: Node) -> str:
        """An operand of a cross product."""
        text = self.text(node)
        needed = type(node) in self.compound or text.startswith(self.minus)
        return self.parenthesized(text) if needed else text

    def _summand(self, node: Node) -> str:
        """The summand of a running sum."""
        text = self.text(node)
        needed = type(node) in (Sum, Relation) or text.startswith(self.minus)
        return self.parenthesized(text) if needed else text

    def _derivative(self, node: Derivative) -> str:
        d = self.differentials[node.total]
        below = self._differential(d, node.by)
        if node.of is None:
            return self._fraction(d, below)
        if isinstance(node.of, Symbol | Letter):
            return self._fraction(self._differential(d, node.of), below)
        of = self.text(node.of)
        inner = of if isinstance(node.of, Parenthesized) else self.parenthesized(of)
        return self._fraction(d, below) + self.after_operator + inner

    def _slashed(self, node: Slashed) -> str:
        match node.fraction:
            case Quotient(numerator, denominator):
                return self._stroke(self._summand(numerator), self._below_stroke(denominator))
            case Derivative(of, by, total) if of is not None:
                d = self.differentials[total]
                return self._stroke(self._differential(d, of), self._differential(d, by))
        return self.text(node.fraction)

    def _below_stroke(self, node: Node) -> str:
        """What stands behind a stroke: a product there needs parentheses."""
        text = self.text(node)
        return self.parenthesized(text) if type(node) in self.compound else text

    def _relation(self, node: Relation) -> str:
        text = self.text(node.parts[0]) if node.parts else ""
        for sign, part in zip(node.signs, node.parts[1:], strict=True):
            text += self._relation_sign(sign) + self.text(part)
        return text

    def _relation_sign(self, sign: str) -> str:
        """The sign of a relation with the blanks around it."""
        return f" {sign} "
