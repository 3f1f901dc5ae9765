"""Which identities of sine and cosine lead from one line to the next.

Found, not guessed, by `algebra.trig_identities`.  A line that does not equal the one before it has no
identities at all: `identities` gives None.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from msgspec import Struct

from dynsolve.algebra.angles import angle_node
from dynsolve.algebra.generators import Pair
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import value_of
from dynsolve.algebra.trig_identities import Addition, angles_in, new_additions, used_between
from dynsolve.document import Prose
from dynsolve.document.sentences import say
from dynsolve.errors import AlgebraError
from dynsolve.explain.context import Context
from dynsolve.explain.matrix_factors import factored
from dynsolve.explain.step import Line
from dynsolve.explain.writing import is_small, listed, sum_of
from dynsolve.notation.build import factors_of, negated
from dynsolve.notation.differentiation import sums_of_rates
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    Function,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Relation,
    Row,
    Sum,
    Transpose,
    equation,
    mapped,
    walk,
)
from dynsolve.notation.unicode import to_unicode


class Identity(Struct, frozen=True):
    """An identity in this robot's angles: c₁ c₁₂ + s₁ s₁₂ = c₂; s² + c² = 1 has no `name`."""

    name: str
    relation: Relation | None


IN_TURN = Identity("identities of sine and cosine", None)
"""What is said where one after the other is used, and so none is found."""


def said(used: Sequence[Identity]) -> Prose:
    """s₁² + c₁² = 1 and the cosine of a difference, c₁ c₁₂ + s₁ s₁₂ = c₂"""
    named: dict[str, list[Node]] = {}
    for each in used:
        named.setdefault(each.name, []).extend([each.relation] if each.relation else [])
    found: list[Node | Prose] = [*named.pop("", [])]
    for name, relations in named.items():
        text = ("{name}", "{name}, {relation}", "{name} ({relation})")[min(len(relations), 2)]
        found.append(say(text, name=name, relation=listed(relations)))
    return listed(found)


def by(operation: str | Prose, used: Iterable[Identity], cancelled: Prose = ()) -> Prose:
    """Multiplied out, with s₁² + c₁² = 1 (the terms with s₁ c₁ cancel):"""
    named = tuple(used)
    text = "{operation}, with {used}{cancelled}:" if named else "{operation}{cancelled}:"
    return say(text, operation=operation, used=said(named), cancelled=cancelled)


def identities(ring: Ring, before: Node, after: Node) -> tuple[Identity, ...] | None:
    """The identities that are used on the way from one tree to an equal one; None if they are not equal."""
    used = used_between(ring, before, after)
    if used is None or not used.is_found:
        return None if used is None else (IN_TURN,)
    written = angles_in(before, after)
    as_written = (-one if one not in written and -one in written else one for one in used.squared)
    squared = (pythagoras(angle_node(angle, ring.names)) for angle in as_written)
    return (*squared, *(_addition(ring, each) for each in used.additions))


def new_angles(ring: Ring, before: Iterable[Node], after: Iterable[Node]) -> list[Relation]:
    """What sines and cosines stand for of angles that are met first `after`: c² - s² = cos(2θ)."""
    found = new_additions(Row(tuple(before)), Row(tuple(after)))
    return list(dict.fromkeys(_relation(ring, each) for each in found))


def pythagoras(angle: Node) -> Identity:
    """sin² + cos² = 1 of an angle."""
    found = formula("sin² {angle} + cos² {angle} = 1", angle=angle)
    assert isinstance(found, Relation)
    return Identity("", found)


_NAMES = {"sin": "sine", "cos": "cosine"}
_TWICE = {"sin": "2 sin {A} cos {A}", "cos": "cos² {A} - sin² {A}"}
_ADDED = {
    ("sin", 1): "sin {A} cos {B} + cos {A} sin {B}",
    ("sin", -1): "sin {A} cos {B} - cos {A} sin {B}",
    ("cos", 1): "cos {A} cos {B} - sin {A} sin {B}",
    ("cos", -1): "cos {A} cos {B} + sin {A} sin {B}",
}
"""The addition theorems: of the sine and the cosine of A + B and A - B."""


def _addition(ring: Ring, each: Addition) -> Identity:
    """The cosine of a difference, c₁ c₁₂ + s₁ s₁₂ = c₂, and the like."""
    words = "a sum" if each.sign > 0 else "a difference"
    whole = "twice an angle" if each.first == each.second else words
    return Identity(f"the {_NAMES[each.name]} of {whole}", _relation(ring, each))


def _relation(ring: Ring, each: Addition) -> Relation:
    """cos A cos B ∓ sin A sin B = cos(A ± B), sin A cos B ± cos A sin B = sin(A ± B), of these angles."""
    name, a, b = each.name, each.first, each.second
    if name == "cos" and len(b.terms) < len(a.terms):
        a, b = b, a  # c₁ c₁₂ + s₁ s₁₂, as it stands in a line
    text = _TWICE[name] if a == b else _ADDED[name, each.sign]
    whole, A, B = (angle_node(angle, ring.names) for angle in (each.whole, a, b))
    sides = (formula(text, A=A, B=B), Function(name, whole))
    return equation(*(reversed(sides) if each.opened else sides))


# -- the identities by which the entries of a product of matrices become what is printed, and what cancels


def used_in_product(context: Context, left: Matrix, right: Matrix, result: Matrix) -> list[Identity]:
    """Those that lead from Σ_k left_ik right_kj to the entries of the result, each once."""
    used: dict[Identity, None] = {}
    for row, entries in zip(left.rows, result.rows, strict=True):
        for column, entry in zip(right.T.rows, entries, strict=True):
            pairs = [(a, b) for a, b in zip(row, column, strict=True) if not (a.is_zero or b.is_zero)]
            products = [Product((context.show(a), context.show(b))) for a, b in pairs]
            if len(products) > 1:
                found = identities(context.robot.ring, sum_of(products), context.show(entry))
                used |= dict.fromkeys(found or ())
    return list(used)


def cancelled_in_product(context: Context, left: Matrix, right: Matrix) -> Prose:
    """That the terms with s₁ c₁ cancel, where a product of matrices loses all of them without an identity."""
    ring = context.robot.ring
    if not are_in_basic_angles(context, (*left.entries, *right.entries)):
        return ()
    left_over: set[tuple[int, ...]] = set()
    gone: set[tuple[int, ...]] = set()
    for row in left.rows:
        for column in right.T.rows:
            products = [a.poly * b.poly for a, b in zip(row, column, strict=True)]
            kept = set(sum(products, start=ring.zero.poly).to_dict())
            left_over |= kept
            gone |= {term for each in products for term in each.to_dict()} - kept
    for pair in ring.pairs:
        was, remains = (any(e[pair.sine] and e[pair.cosine] for e in terms) for terms in (gone, left_over))
        if was and not remains:
            return products_cancel(ring, pair)
    return ()


def are_in_basic_angles(context: Context, values: Iterable[Expr]) -> bool:
    """Whether some values are written in the angles of the ring alone."""
    basic = {pair.angle for pair in context.robot.ring.pairs}
    return basic.issuperset(angles_in(*map(context.show, values)))


def products_cancel(ring: Ring, pair: Pair) -> Prose:
    """(the terms with s₁ c₁ cancel)"""
    return say(" (the terms with $sin {a} cos {a}$ cancel)", a=angle_node(pair.angle, ring.names))


def product_named(context: Context, left: Matrix, right: Matrix, result: Matrix) -> Prose:
    """The sentence before the result of a product; nothing of longer arms, or where none is used."""
    used = used_in_product(context, left, right, result) if context.is_short else ()
    return say("With {used}:", used=said(used)) if used else ()


def product_line(
    context: Context,
    operation: str | Prose,
    names: Sequence[Node],
    turn: tuple[Matrix, Node],
    turned: tuple[Matrix, Node],
    uses: tuple[str, ...] = (),
    label: str = "",
    tells_what_cancels: bool = True,
) -> Line:
    """Rᵀ x with both matrices, and what it is, by the identities that are used; each with its form."""
    (R, R_form), (x, x_form) = turn, turned
    cancelled = cancelled_in_product(context, R.T, x) if tells_what_cancels else ()
    words = by(operation, used_in_product(context, R.T, x, R.T @ x), cancelled)
    shown: list[Node] = [Product((Transpose(R_form), x_form))] if is_small(R_form, x_form) else []
    members = (factored(context, node) for node in (*shown, context.show(R.T @ x)))
    return Line(words, (equation(*names, *members),), uses, label)


# -- the engine of lines ----------------------------------------------------------------------------
# Every stage names its tactics, each with its words and the form it comes to.  A form is shown only if it
# is `proved` to have the value it claims; what repeats an earlier one is left out.  `chain` makes the lines
# to a scalar of them; entries of matrices that stand in one line are proved one by one.


class Words(Struct, frozen=True):
    """What is done to a line, and what is `joined`: to the line before it, and to this one."""

    by: Prose
    joined: Prose


Tactic = tuple[str | Prose | Words, Node]
"""What is done, in words, and the form of the value that it gives."""


class Way(Struct, frozen=True):
    """The lines to a result, and what is said of the last operation, with the identities it uses.

    With a `frame` they begin afresh from the formula, along the axes of that frame.
    """

    lines: tuple[Line, ...] = ()
    concluding: Prose = ()
    frame: int | None = None
    used: tuple[Identity, ...] = ()


SILENT = Way()


def equals(tree: Node, value: Expr) -> bool:
    """Whether a scalar tree has an exact value, and this one."""
    try:
        return value_of(value.ring, tree) == value
    except AlgebraError:
        return False


def proved(value: Expr, tactics: Iterable[Tactic]) -> dict[Node, str | Prose | Words] | None:
    """The forms that the tactics come to, each once with its words, if all have the value; else None.

    One that only puts the form before it into another order stands in its place.
    """
    found: dict[Node, str | Prose | Words] = {}
    for words, form in tactics:
        if not equals(form, value):
            return None
        if found and are_alike(last := next(reversed(found)), form):
            words = found.pop(last)
        found.setdefault(form, words)
    return found


def are_alike(left: Node, right: Node) -> bool:
    """Whether two trees are the same but for order, and signs that squares lose: (a b)² is a² b².

    >>> are_alike(formula("m ((a b)² + c)"), formula("(c + a² b²) m"))
    True
    >>> are_alike(formula("m (a - b)²"), formula("(b - a)² m"))
    True
    """
    return mapped(left, _ordered) == mapped(right, _ordered)


def _ordered(node: Node) -> Node:
    match node:
        case Sum(terms):
            flat = [part for term in terms for part in (term.terms if isinstance(term, Sum) else (term,))]
            return Sum(tuple(sorted(flat, key=repr)))
        case Product(factors):
            flat = [part for factor in factors for part in factors_of(factor)]
            return Product(tuple(sorted(flat, key=repr)))
        case Power(Sum(terms), Number(2, 1)):
            opposite = tuple(sorted(map(negated, terms), key=repr))
            return Power(Sum(min(terms, opposite, key=repr)), Number(2))
        case Power(Product(factors), exponent):
            return Product(tuple(sorted((Power(factor, exponent) for factor in factors), key=repr)))
        case Parenthesized(argument):
            return argument
        case Quotient(Number(p, 1), Number(q, 1)):
            return Number(p, q)
    return node


SORTED = "Multiplied out, and sorted by the products of the rates:"


COLLECTED: Prose = ("Collected:",)
NUMBERS: Prose = ("The numbers multiplied:",)


def collected(ring: Ring, before: Node, after: Node) -> Prose:
    """What leads from a line to an equal one: what is multiplied out, and the identities that are used.

    Nothing where they are alike.
    """
    if are_alike(before, after):
        return ()
    squares, rates = opened_squares(before, after), sums_of_rates(before) - sums_of_rates(after)
    opened = "The sums of rates" if rates else ""
    if any(not sums_of_rates(square) for square in squares):
        opened = "The square of the sum" if len(squares) == 1 else "The squares of the sums"
    elif are_alike(mapped(before, _without_numbers), mapped(after, _without_numbers)):
        return NUMBERS
    used = identities(ring, before, after) or ()
    if not opened:
        return by("Collected", used)
    return with_more(by(f"{opened} multiplied out", used), ", and collected:")


def with_more(words: Prose, more: str) -> Prose:
    """By s² + c² = 1, and collected:"""
    *before, last = words
    return (*before, str(last).removesuffix(":") + more)


def _without_numbers(node: Node) -> Node:
    if not isinstance(node, Product):
        return node
    left = [each for each in node.factors if not all(isinstance(x, Number | Quotient) for x in walk(each))]
    return left[0] if len(left) == 1 else Product(tuple(left))


def opened_squares(before: Node, after: Node) -> list[Node]:
    """The squares of sums in a tree that are not in the other."""
    kept = squares_of_sums(after)
    return [one for one in squares_of_sums(before) if not any(are_alike(one, other) for other in kept)]


def squares_of_sums(node: Node) -> list[Node]:
    """(a + b)², also of ((a + b) q̇)², ((a + b)/2)² and the like in a tree."""
    powers = dict.fromkeys(part for part in walk(node) if isinstance(part, Power))
    factors = [(power, factor) for power in powers for factor in factors_of(power.base)]
    bare = [(each.numerator if isinstance(each, Quotient) else each, power) for power, each in factors]
    return [Power(base, power.exponent) for base, power in bare if isinstance(base, Sum)]


def chain(
    context: Context, result: str, name: Node, tactics: Iterable[Tactic], concluding: str | Prose | Words = ()
) -> Way:
    """The lines that the tactics come to, if each of them is proved to be the result; else nothing.

    A form that is the result but for the order gives its words to that.
    """
    forms, result_form = proved(context.values[result], tactics), context.form(result)
    if forms is None:
        return SILENT
    last = next(reversed(forms), None)
    if last is not None and (are_alike(last, result_form) or to_unicode(last) == to_unicode(result_form)):
        _, concluding = forms.popitem()
    lines = [
        Line(_prose(words), (equation(name, form),), joined=words.joined if isinstance(words, Words) else ())
        for form, words in forms.items()
    ]
    return Way(tuple(lines), _prose(concluding))


def _prose(words: str | Prose | Words) -> Prose:
    return words.by if isinstance(words, Words) else say("{by}", by=words)
