"""What is diagnosed: one scalar that is wrong, and whether its terms can be added at all."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator
from fractions import Fraction
from math import isqrt, prod
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.fraction import RationalExpr, as_expr, cancelled
from dynsolve.algebra.generators import Generator
from dynsolve.algebra.linear_systems import FractionMatrix
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.rationals import fraction
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_values import evaluate
from dynsolve.answers.diagnosis.mends import Exchange, is_small, likeness, monomial_expr, parts
from dynsolve.answers.diagnosis.slips import slip
from dynsolve.answers.judging.answer_ring import AnswerRing
from dynsolve.answers.judging.entry_comparison import WrittenEntry
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.judging.key_comparison import Target
from dynsolve.answers.verdict import Diagnosis
from dynsolve.explain.context import style_of
from dynsolve.explain.forms import ProductForms, leading_names, parallel_coordinates
from dynsolve.notation.build import ends, power, times
from dynsolve.notation.tree import (
    Function,
    Negative,
    Node,
    Number,
    Product,
    Quotient,
    Symbol,
    names_in,
    number,
)
from dynsolve.notation.unicode import UnicodePrinter
from dynsolve.quantities.index import Quantity
from dynsolve.robot.model import Robot
from dynsolve.robot.units import Dimension, describe

# A number where a letter belongs: 9.81 for g, in some terms of an answer or in all of them

PLAIN = {Fraction(p, q) for p in (-4, -2, -1, 0, 1, 2, 4) for q in (1, 2, 4)}
"""What stands before a term by itself is taken for no letter."""

Exponents = tuple[int, ...]
Found = tuple[Generator, Fraction, Exchange]
"""A letter, the number in its place, and what mends that."""


def number_for_a_letter(mine: Expr, expected: Expr, given: Collection[int]) -> Found | None:
    """The number that stands for a letter in the most terms; `given` may stand as either."""
    absent = _absent(mine, expected)
    letters = (g for g in absent if g.index not in given)
    found = (one for g in letters if (one := _of(g, absent, mine, expected)) is not None)
    return max(found, key=lambda one: len(one[2].have), default=None)


def letters_in_numbers(mine: Expr, expected: Expr) -> list[Generator]:
    """The letters in whose places numbers stand, in all terms that differ; none where any is no such term."""
    absent = _absent(mine, expected)
    right = expected.poly.to_dict()
    terms: dict[Exponents, list[Exponents]] = {}
    for exponents in right:
        terms.setdefault(_without(exponents, absent), []).append(exponents)
    missing = set()
    for bare, value in mine.poly.to_dict().items() if mine.poly else ():
        if bare not in right:
            there = terms.get(bare, [])
            if not there or any(fraction(value / right[e]) in PLAIN for e in there):
                return []
            missing |= {g for g in absent for e in there if e[g.index]}
    return sorted(missing, key=lambda g: g.index)


def has_a_plain_number(expr: Expr) -> bool:
    """Whether a term of it has no number that may stand for a letter."""
    return any(fraction(value) in PLAIN for value in expr.poly.to_dict().values())


def _absent(mine: Expr, expected: Expr) -> list[Generator]:
    ring, here = mine.ring, set(mine.used)
    found = (ring.generators[i] for i in expected.used if i not in here)
    return [g for g in found if g.kind == "symbol" and not g.dots and g.name not in (*ring.names, "pi")]


def _of(g: Generator, absent: list[Generator], mine: Expr, expected: Expr) -> Found | None:
    """The number in place of one letter, None where there is none, or it may be that of another term."""
    if not mine.poly:
        return None
    ours, right = mine.poly.to_dict(), expected.poly.to_dict()
    alike = Counter(_without(exponents, absent) for exponents in right)
    ratios = Counter(
        _root(fraction(ours[bare] / value), int(exponents[g.index]))
        for exponents, value in right.items()
        if exponents[g.index] and (bare := _without(exponents, [g])) in ours and bare not in right
        and alike[_without(exponents, absent)] == 1
    )  # fmt: skip
    number = next((one for one, _ in ratios.most_common() if one not in PLAIN), None)
    if number is None:
        return None
    ring = mine.ring
    put = expected.ring.put(expected, {g.index: ring.constant(number).poly}).poly.to_dict()
    moved = {_without(exponents, [g]) for exponents in right if exponents[g.index]}
    there = {bare for bare in moved if bare in ours and ours[bare] == put.get(bare)}
    if not there:
        return None
    want = _kept(mine, right, {e for e in right if _without(e, [g]) in there})
    others = {bare for bare, value in ours.items() if bare not in (*right, *there) and _has(value, number)}
    more = _kept(mine, ours, others)
    want = want + more * ring.generator(g.index) * (1 / number)
    return g, number, Exchange(ring.one, _kept(mine, ours, there) + more, want)


def _has(value: Any, number: Fraction) -> bool:
    """Whether a number is a factor of another, which is no usual one itself."""
    return fraction(value) not in PLAIN and fraction(value) / number in PLAIN


def _root(value: Fraction, power: int) -> Fraction:
    """The number with a power, 0 where none is rational."""
    root = value if power == 1 else Fraction(isqrt(abs(value.numerator)), isqrt(value.denominator))
    return root if root**power == value else Fraction(0)


def _without(exponents: Any, letters: list[Generator]) -> Exponents:
    places = {g.index for g in letters}
    return tuple(0 if i in places else int(e) for i, e in enumerate(exponents))


def _kept(mine: Expr, terms: dict[Any, Any], places: Collection[Exponents]) -> Expr:
    return Expr(mine.ring, mine.ring.ctx.from_dict({e: v for e, v in terms.items() if e in places}))


# Terms in words: exact expressions as one line of Unicode, for messages

LONGEST = 160

LONG_DENOMINATOR = 100
"""What is over such an integer came of a decimal."""

MOST_PRINTED = 4_000
"""So many parts of trees are remembered."""


class TermWriter:
    """Writes expressions of one ring as a person reads them; `problem` is the robot in the problem's ring."""

    def __init__(self, answer_ring: AnswerRing, problem: Robot) -> None:
        ring, robot = answer_ring.ring, answer_ring.robot
        self.ring = ring
        self._problem = {*problem.ring.parameters, *ring.names, "pi"}
        self.compactor = Compactor(ring, leading_names(robot), parallel_coordinates(robot))
        self._printer = UnicodePrinter(style_of(robot))

    @property
    def remembers_many(self) -> bool:
        """Whether it is to be begun anew, so that the memory of a long process does not grow without end."""
        return self._printer.remembered > MOST_PRINTED

    def form(self, expr: Expr) -> Node:
        """The compact tree."""
        return self.compactor.form(expr)

    def of(self, expr: Expr) -> str:
        """An expression in one line."""
        text = self._printer.text(self.form(expr))
        return text if len(text) <= LONGEST else text[: LONGEST - 1] + "…"

    def fraction(self, value: RationalExpr) -> str:
        """A fraction in one line, with decimals where its own are long."""
        value = cancelled(value)
        numbers = (*value.numerator.poly.coeffs(), *value.denominator.poly.coeffs())
        decimal = any(fraction(number).denominator >= LONG_DENOMINATOR for number in numbers)
        if decimal and not names_in(self.form(value.numerator * value.denominator)):
            return f"{evaluate(value.numerator, {}) / evaluate(value.denominator, {}):.4g}"
        return self._printer.text(ProductForms(self.compactor, decimal=decimal).fraction(value))

    def number(self, value: Fraction) -> str:
        """A number."""
        return self._printer.text(number(value))

    def in_decimals(self, expr: Expr) -> str:
        """A term in one line, with a decimal before it where a fraction ends as one: 9.8 s₁₂, not 49s₁₂/5."""
        before = self.coefficient(expr)
        rest = self.form(expr * (1 / before))
        return self._printer.text(times(before, [(rest, 1)], decimal=ends(before.denominator)))

    def coefficient(self, expr: Expr) -> Fraction:
        """The number before an expression as a person writes it."""
        return _coefficient(self.form(expr)) or Fraction(1)

    def generator(self, g: Generator) -> str:
        """A symbol."""
        return self.power(g, 1)

    def power(self, g: Generator, exponent: int) -> str:
        """A symbol's power."""
        node = Symbol(g.name, g.dots) if g.kind == "symbol" else self.form(self.ring.generator(g.index))
        return self._printer.text(power(node, exponent))

    def is_unknown(self, g: Generator) -> bool:
        """Whether a symbol, or a sine or cosine of an unexpected argument, is none of the problem's."""
        is_odd = isinstance(g.node, Function) and g.node.name in ("sin", "cos", "tan")
        is_known = g.name in self._problem if g.kind == "symbol" else not (g.kind == "function" and is_odd)
        return not is_known


def _coefficient(node: Node) -> Fraction:
    match node:
        case Number(p, q):
            return Fraction(p, q)
        case Negative(argument):
            return -_coefficient(argument)
        case Product(factors):
            return prod((_coefficient(factor) for factor in factors), start=Fraction(1))
        case Quotient(numerator, denominator):
            return _coefficient(numerator) / (_coefficient(denominator) or 1)
    return Fraction(1)


class WrongEntry(Struct, frozen=True):
    """One scalar that is wrong: what was written, and what its own inputs lead to, the nearest first.

    The last one that is expected is the key.  `called` is what a message calls it; by `factor` one side of
    `... = 0` is multiplied here, since it was divided by that.
    """

    name: str
    target: Target
    written: WrittenEntry
    expected: tuple[Expr, ...]
    row: int = 0
    column: int = 0
    called: str = "Your answer"
    factor: Expr | None = None

    @property
    def mine(self) -> Expr | None:
        """The answer as an element of the ring."""
        return as_expr(self.written.value)

    @property
    def is_of_fractions(self) -> bool:
        """Whether a value that is expected is no element of the ring."""
        return not all(isinstance(value, Expr) for value in self.expected)

    def at(self, value: Any) -> Expr | None:
        """What a value of the node has at the place of this scalar, None where it has no such place."""
        found = self.target.of(value)
        if isinstance(found, Matrix | FractionMatrix):
            rows, columns = found.shape
            if self.row >= rows or self.column >= columns:
                return None
            found = found[self.row, self.column]
        return found if isinstance(found, Expr) else None


def multiplied_back(wrong: WrongEntry) -> WrongEntry:
    """One side of `... = 0` times what it was divided by, with which it is most like what is expected."""
    written = wrong.written.value
    mine, denominator = written.numerator, written.denominator
    if wrong.is_of_fractions or not is_small(mine):
        return wrong
    best, most = wrong, Fraction(0)
    if written.divisor is None:
        most = max(likeness(mine, value) for value in wrong.expected)
    for expected in filter(is_small, wrong.expected):
        for its, own in _factors(mine, expected):
            factor = as_expr(cancelled(RationalExpr(its * denominator, own)))
            whole = as_expr(cancelled(RationalExpr(its * mine, own)))
            if factor is None or whole is None:
                continue
            if (alike := likeness(whole, expected)) > most:
                most, value = alike, replace(wrong.written, value=RationalExpr(whole))
                best = replace(wrong, written=value, factor=factor)
    return best


def _factors(mine: Expr, expected: Expr) -> Iterator[tuple[Expr, Expr]]:
    """What is expected before an acceleration, or before what moves, and what is written there."""
    ring = mine.ring
    yield ring.one, ring.one
    for name in ring.names:
        its, own = (ring.coefficient(value, name, 2) for value in (expected, mine))
        if not its.is_zero and not own.is_zero:
            yield its, own
    theirs, ours = _by_motion(expected), _by_motion(mine)
    yield from ((its, ours[motion]) for motion, its in theirs.items() if motion in ours)


def _by_motion(expr: Expr) -> dict[Exponents, Expr]:
    """The factors in parameters and numbers of all that moves."""
    ring = expr.ring
    still = [g for g in ring.generators if g.kind == "symbol" and not g.dots and g.name not in ring.names]
    moving = [g for g in ring.generators if g not in still]
    found: dict[Exponents, dict[Exponents, Any]] = {}
    for exponents, value in expr.poly.to_dict().items() if expr.poly else ():
        found.setdefault(_without(exponents, still), {})[_without(exponents, moving)] = value
    return {motion: Expr(ring, ring.ctx.from_dict(terms)) for motion, terms in found.items()}


class DimensionCheck:
    """Finds terms that cannot be added: masses, lengths and times have units by their role.

    Where the problem gives numbers for symbols a term may lack its unit, and nothing is told; nor of a
    term with another number than ½ or 2, which may stand for a letter.
    """

    def __init__(self, graph: AnswerGraph, words: TermWriter, has_numbers: bool) -> None:
        self.graph = graph
        self.ring = graph.answer_ring.ring
        self.dimensions = graph.answer_ring.dimensions
        self.words = words
        self.has_numbers = has_numbers

    def first_that_fits(self, wrong: WrongEntry) -> Expr:
        """The nearest of the expected values whose terms can be added."""
        wanted = self.dimension(wrong)
        if wanted is not None and not self.has_numbers:
            for value in wrong.expected:
                if self.dimensions.fits(value, wanted):
                    return value
        return wrong.expected[0]

    def __call__(self, question: WrongEntry, mine: Expr) -> Iterator[Diagnosis]:
        """Terms that cannot be added to the others."""
        wanted = self.dimension(question)
        if wanted is None or not self.dimensions.known or self.has_numbers:
            return
        if not self.dimensions.fits(question.expected[-1], wanted):
            return
        by_monomial = parts(mine) if is_small(mine) else {}
        terms = [monomial_expr(self.ring, m) for m, term in by_monomial.items() if has_a_plain_number(term)]
        known = [(term, found) for term in terms if (found := self.dimensions.of(term)) is not None]
        for term, found in known:
            if found != wanted:
                mixed = any(other != found for _, other in known)
                how = "but it is added to what is" if mixed else "where this should be"
                yield slip(
                    "dimensions",
                    term=self.words.of(term),
                    part=describe(found),
                    how=how,
                    other=describe(wanted),
                )
                return

    def dimension(self, question: WrongEntry) -> Dimension | None:
        """The dimension of an answer, None where nothing is told of it."""
        quantity = self.quantity(question)
        if quantity is None or not quantity.family.dimension_is_told:
            return None
        place = question.target.entry or (question.row, question.column)
        return self.graph.quantities.dimension(quantity, place[0], place[1])

    def quantity(self, question: WrongEntry) -> Quantity | None:
        """What the answer is, or is an entry of."""
        return self.graph.quantities.of_rule(question.target.node)


# What differs, where no slip explains it: said of the terms, with nothing read into them

MOST_NAMED = 4
"""So many terms are named."""


def what_differs(words: TermWriter, called: str, mine: Expr, expected: Expr) -> Iterator[Diagnosis]:
    """How many terms are missing, which are none of those expected, and which have another factor.

    What is missing is not shown, so that an answer 0 does not reveal the solution.
    """
    if mine.is_zero:
        yield slip("zero", yours=called)
        return
    if mine.is_number and not expected.is_number:
        yield slip("constant", yours=called, part=words.of(mine))
        return
    letters = letters_in_numbers(mine, expected)
    if letters:
        yield slip("numbers_for_letters", other=_listed([words.generator(g) for g in letters]))
        return
    ours, theirs = parts(mine), parts(expected)
    missing = len(theirs.keys() - ours.keys())
    extra = [term for monomial, term in ours.items() if monomial not in theirs]
    changed = [m for m, term in ours.items() if m in theirs and theirs[m] != term]
    if not extra and not changed:
        yield slip("terms_missing", yours=f"{missing} terms are" if missing > 1 else "A term is")
        return
    said = []
    if missing:
        said.append(f"{missing} {'is' if missing == 1 else 'are'} missing.")
    if changed:
        terms = [words.of(monomial_expr(mine.ring, monomial)) for monomial in changed if monomial]
        said += [f"Another factor belongs to {_listed(terms)}."] if terms else []
        said += ["What has no letter is not right."] if () in changed else []
    if extra:
        said.append(f"Not among the right terms: {_listed([words.of(term) for term in extra])}.")
    yield slip("terms_differ", yours=" ".join(said))


def _listed(terms: list[str]) -> str:
    more = len(terms) - MOST_NAMED
    return ", ".join(terms[:MOST_NAMED]) + (f", and {more} more" if more > 0 else "")
