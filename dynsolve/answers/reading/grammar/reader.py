"""What every part of the grammar works on: the tokens, the names of the problem, and what was found so far.

`Reader` is abstract: the modules for brackets, functions, derivatives and names take
one and ask it for the values inside, and `formula.FormulaReader` is the descent that ties
them together.  So none of them imports another in a circle.

Derivatives that a student leaves to be taken: d/dt(m r² φ̇), ∂/∂q_1(½ m l² sin² q_1), term by term.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from fractions import Fraction
from typing import Any

from dynsolve.answers.reading.grammar.scripts import Form, ScriptCursor, Scripts, constant, raise_to
from dynsolve.answers.reading.grids import (
    MAX_INVERSE,
    Abstract,
    Grid,
    Value,
    inverse,
    scaled,
    times,
    transposed,
)
from dynsolve.answers.reading.lexer import Token
from dynsolve.answers.reading.vocabulary import Vocabulary
from dynsolve.errors import ReadError
from dynsolve.notation.build import negated, total
from dynsolve.notation.tree import (
    ONE,
    ZERO,
    Degrees,
    Function,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    number,
)

# Time derivatives of what coordinates are written in: θ̇_1 + θ̇_2 for θ_1 + θ_2


def rate(value: Value, vocabulary: Vocabulary, dots: int) -> Value | None:
    """The time derivative of what is linear in coordinates; None for everything else."""
    if isinstance(value, Abstract):
        return value
    if isinstance(value, Grid):
        if value.is_rates >= 0 and value.is_rates + dots <= 2:
            return vocabulary.velocities(value.is_rates + dots)
        return None
    found: Node | None = value
    for _ in range(dots):
        found = _rate(found, vocabulary) if found is not None else None
    return found


def _rate(node: Node, vocabulary: Vocabulary) -> Node | None:
    match node:
        case Number() | Degrees():
            return ZERO
        case Symbol(name, dots):
            if vocabulary.coordinate(node) is None and not vocabulary.is_reference(name):
                return None
            return Symbol(name, dots + 1) if dots < 2 else None
        case Negative(argument):
            inner = _rate(argument, vocabulary)
            return None if inner is None else Negative(inner)
        case Sum(terms):
            rates = [_rate_of_term(term, vocabulary) for term in terms]
            kept = [r for r in rates if r is not None and r != ZERO]
            if any(r is None for r in rates) or not kept:
                return None
            return kept[0] if len(kept) == 1 else Sum(tuple(kept))
    return None


def _rate_of_term(node: Node, vocabulary: Vocabulary) -> Node | None:
    """That of a term of a sum: a constant has none."""
    if _is_constant(node, vocabulary):
        return ZERO
    return _rate(node, vocabulary)


def _is_constant(node: Node, vocabulary: Vocabulary) -> bool:
    match node:
        case Number() | Degrees():
            return True
        case Symbol():
            return vocabulary.coordinate(node) is None
        case Negative(argument):
            return _is_constant(argument, vocabulary)
        case Product(parts) | Sum(parts):
            return all(_is_constant(part, vocabulary) for part in parts[:20]) and len(parts) <= 20
        case Quotient(p, q):
            return _is_constant(p, vocabulary) and _is_constant(q, vocabulary)
    return False


# Derivatives that a student leaves to be taken, term by term

Rule = Callable[[Symbol], Node | None]
"""The derivative of a symbol, None where it has none."""


def by_time(vocabulary: Vocabulary) -> Rule:
    """d/dt: coordinates and their velocities gain a dot, parameters are constant."""

    def rate(symbol: Symbol) -> Node | None:
        if vocabulary.coordinate(symbol) is None and not vocabulary.is_reference(symbol.name):
            return ZERO
        return Symbol(symbol.name, symbol.dots + 1) if symbol.dots < 2 else None

    return rate


def by_symbol(variable: Symbol) -> Rule:
    """∂/∂variable: every other symbol is constant."""
    return lambda symbol: ONE if (symbol.name, symbol.dots) == (variable.name, variable.dots) else ZERO


def derivative(node: Node, rule: Rule) -> Node | None:
    """The derivative of an expression; None where a part of it has none, as the name of an answer.

    >>> from dynsolve.notation.unicode import to_unicode
    >>> to_unicode(derivative(Function("sin", Product((Number(2), Symbol("x")))), by_symbol(Symbol("x"))))
    'cos(2x)·2'
    """
    match node:
        case Number() | Degrees() | Function("sgn"):
            return ZERO
        case Symbol():
            return rule(node)
        case Negative(argument):
            inner = derivative(argument, rule)
            return None if inner is None else negated(inner)
        case Sum(terms):
            found = [derivative(term, rule) for term in terms]
            return None if None in found else total([term for term in found if term is not None])
        case Product(factors):
            return _of_product(factors, rule)
        case Quotient(above, below):
            return _of_quotient(above, below, rule)
        case Power(base, exponent):
            inner, power = derivative(base, rule), constant(exponent)
            if inner is None or power is None:
                return None
            lower = base if power == 2 else raise_to(base, power - 1)
            return scaled(scaled(number(power), lower), inner)
        case Function(name, argument):
            inner = derivative(argument, rule)
            return None if inner is None else _of_function(name, argument, inner)
    return None


def _of_product(factors: tuple[Node, ...], rule: Rule) -> Node | None:
    terms: list[Node] = []
    for place, factor in enumerate(factors):
        inner = derivative(factor, rule)
        if inner is None:
            return None
        others = (*factors[:place], *factors[place + 1 :])
        if inner != ZERO:
            terms.append(scaled(Product(others) if len(others) > 1 else others[0], inner))
    return total(terms)


def _of_quotient(above: Node, below: Node, rule: Rule) -> Node | None:
    over, under = derivative(above, rule), derivative(below, rule)
    if over is None or under is None:
        return None
    first = ZERO if over == ZERO else Quotient(over, below)
    second = ZERO if under == ZERO else Quotient(Product((above, under)), Power(below, Number(2)))
    return total([first, negated(second)])


def _of_function(name: str, argument: Node, inner: Node) -> Node | None:
    if inner == ZERO:
        return ZERO
    match name:
        case "sin":
            return scaled(Function("cos", argument), inner)
        case "cos":
            return negated(scaled(Function("sin", argument), inner))
        case "tan":
            return Quotient(inner, Power(Function("cos", argument), Number(2)))
        case "sqrt":
            return Quotient(inner, Product((Number(2), Function(name, argument))))
    return None


# What every part of the grammar works on


class Reader(ScriptCursor):
    """One list of prepared tokens that is being read, and what its value is made of.

    How it is read: `naming` makes names of answers win over symbols, as on a left-hand side;
    `owner` is the answer that the value is given for; `options` are the bolder guesses that
    are allowed (see `left_side`); `rows_by_line` says that line ends separate rows, `by_blanks` that
    blanks separate entries, `bars_separate` that `|` does.

    What was found: `references` are the names of answers in the value, `symbols` its symbols,
    `free` those that belong to no problem, `notes` what the student is told about the reading;
    `candidates` are the answers that the last name may mean, and `names_used` counts the names
    of the derivation, of which `letters` are those that may be the student's own.
    """

    __slots__ = (
        "naming", "owner", "options", "rows_by_line", "by_blanks", "bars_separate",
        "references", "symbols", "free", "notes", "candidates", "names_used", "letters",
    )  # fmt: skip

    def __init__(
        self,
        tokens: list[Token],
        vocabulary: Vocabulary,
        naming: bool = False,
        owner: str = "",
        options: frozenset[str] = frozenset(),
    ) -> None:
        super().__init__(tokens, vocabulary)
        self.naming, self.owner, self.options = naming, owner, options
        self.rows_by_line = self.by_blanks = self.bars_separate = False
        self.references: dict[str, None] = {}
        self.symbols: dict[str, None] = {}
        self.notes: dict[str, None] = {}
        self.free: dict[str, None] = {}
        self.candidates: tuple[str, ...] = ()
        self.names_used = 0
        self.letters: list[Form] = []

    # The rules of the grammar, each of which takes its tokens and gives their value

    @abstractmethod
    def sum(self) -> Value:
        """Terms with their signs."""

    @abstractmethod
    def term(self) -> Value:
        """Factors, with or without a sign between them."""

    @abstractmethod
    def follows(self) -> bool:
        """Whether a product goes on at the next token."""

    @abstractmethod
    def factor(self) -> Value:
        """Signs, then an atom."""

    @abstractmethod
    def atom(self) -> Value:
        """A number, a name, a bracket or a function, with the scripts behind it."""

    @abstractmethod
    def inner(self, tokens: list[Token], naming: bool | None = None) -> Value:
        """The value of tokens that stand inside this text; what it is made of is added here."""

    # What happens to values

    def placed(self, start: int, operation: Callable[..., Value], *values: Any) -> Value:
        """The result of an operation on values, whose errors get their place here."""
        try:
            return operation(*values)
        except ReadError as error:
            end = self.tokens[max(self.position - 1, 0)].end
            raise ReadError(error.message, start, max(end - start, 1), error.help) from None

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
                dotted = rate(value, self.vocabulary, scripts.primes)
                if dotted is None and scripts.primes == 1:
                    dotted = derivative(value, by_time(self.vocabulary))
                if dotted is None or dotted == ZERO:
                    message = "a prime stands here after what has no derivative"
                    raise ReadError(message, start, 1, "theta1' is a velocity")
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
            if power == -1 and value.shape[0] > MAX_INVERSE and not self.symbols:
                return Abstract("the inverse of a matrix of the derivation")
            if power == -1:
                return self.placed(start, inverse, value)
            raise ReadError("a power of a matrix", start, 1, "write the product out")
        return raise_to(value, power)
