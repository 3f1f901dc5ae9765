"""Formulas with one mistake, and what a message about it claims: in plain Python, at plain numbers.

Nothing here uses the exact ring: a tree is evaluated with `math`, and a message is taken by its
words, its formulas read as a student's would be.
"""

from __future__ import annotations

import math
import random
import re
from collections.abc import Callable, Iterator

from dynsolve.notation.tree import (
    Function,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    with_children,
)  # fmt: skip

FUNCTIONS: dict[str, Callable[[float], float]] = {
    "sin": math.sin, "cos": math.cos, "tan": math.tan, "sqrt": math.sqrt,
}  # fmt: skip

Mistake = tuple[str, Node]
"""What kind of mistake was made, and the formula with it."""


def value(node: Node, seed: int) -> float:
    """A formula at numbers that belong to its symbols, whatever the formula."""
    match node:
        case Number(p, q):
            return p / q
        case Symbol("pi"):
            return math.pi
        case Symbol(name, dots):
            return random.Random(f"{seed} {name} {dots}").uniform(0.4, 1.7)
        case Sum(terms):
            return sum(value(term, seed) for term in terms)
        case Product(factors):
            return math.prod(value(factor, seed) for factor in factors)
        case Quotient(above, below):
            return value(above, seed) / value(below, seed)
        case Power(base, exponent):
            return float(value(base, seed) ** value(exponent, seed))
        case Negative(argument):
            return -value(argument, seed)
        case Parenthesized(argument):
            return value(argument, seed)
        case Function(name, argument):
            return FUNCTIONS[name](value(argument, seed))
    raise ValueError(node)


def near(a: float, b: float) -> bool:
    """Whether two values are one but for rounding."""
    return abs(a - b) <= 1e-9 * (1 + abs(a) + abs(b))


# -- mistakes --------------------------------------------------------------------------------------


def mistakes(node: Node, names: list[str]) -> Iterator[Mistake]:
    """A formula with one mistake, for each place and each kind; `names` are the robot's symbols."""
    yield from _here(node, names)
    for old in _parts(node):
        for kind, new in mistakes(old, names):
            yield kind, _replaced(node, old, new)


def _parts(node: Node) -> tuple[Node, ...]:
    match node:
        case Sum(parts) | Product(parts):
            return parts
        case Quotient(above, _):
            return (above,)
        case Power(base, _):
            return (base,)
        case Negative(argument) | Parenthesized(argument):
            return (argument,)
    return ()


def _replaced(node: Node, old: Node, new: Node) -> Node:
    """A node with one part replaced, that and no other."""
    return with_children(node, lambda part: new if part is old else part)


def _here(node: Node, names: list[str]) -> Iterator[Mistake]:
    match node:
        case Sum(terms):
            for i, term in enumerate(terms):
                before, after = terms[:i], terms[i + 1 :]
                yield "sign", Sum((*before, Negative(term), *after))
                yield "number", Sum((*before, Product((Number(2), term)), *after))
                yield "number", Sum((*before, Product((Number(1, 2), term)), *after))
                yield "missing", Sum((*before, *after)) if len(terms) > 2 else (*before, *after)[0]
        case Product(factors):
            for i, factor in enumerate(factors):
                before, after = factors[:i], factors[i + 1 :]
                if isinstance(factor, Symbol | Function | Power):
                    yield "left out", Product((*before, *after)) if len(factors) > 2 else (*before, *after)[0]
                if isinstance(factor, Symbol) and not factor.dots:
                    yield "squared", Product((*before, Power(factor, Number(2)), *after))
        case Power(Symbol() as base, Number(2)):
            yield "not squared", base
        case Function("sin" | "cos" as name, argument):
            yield "function", Function("cos" if name == "sin" else "sin", argument)
            for angle in argument.terms if isinstance(argument, Sum) else ():
                yield "angle", Function(name, angle)
        case Symbol(name, dots):
            if dots:
                yield "dot", Symbol(name, dots - 1)
            letters = re.sub(r"\d", "", name)
            for other in names:
                if other != name and re.sub(r"\d", "", other) == letters:
                    yield "index", Symbol(other, dots)


# -- what a message claims -------------------------------------------------------------------------

_FORMS = [
    (re.compile(pattern), claim)
    for pattern, claim in (
        (r"The sign of (?P<t>.+) is wrong\.", "sign"),
        (r"(?:Your answer|Entry .+) has the wrong sign\.", "all"),
        (r"The terms with gravity have the wrong sign\.", "all"),
        (r"(?P<t>.+) has (?P<y>.+) in front where (?P<o>.+) belongs\.", "number"),
        (r"(?:Your answer|Entry .+) is (?P<p>.+) times what it should be\.", "times"),
        (r"The term (?P<t>.+) is missing\.", "missing"),
        (r"The term (?P<t>.+) does not belong here\.", "needless"),
        (r"In (?P<y>.+) the (?:mass |moment of inertia |velocity |factor )?(?P<p>.+)"
         r" (?:is left out|should be squared)\.", "left out"),
        (r"In (?P<y>.+) the (?:factor )?(?P<p>.+) (?:is too many|has one power too many)\.", "too many"),
        (r"In (?P<y>.+) stands (?P<p>.+) where (?:its derivative )?(?P<o>.+) belongs\.", "instead"),
        (r"(?P<y>.+) stands where (?P<o>.+) belongs\.", "another"),
    )
]  # fmt: skip


def mended(message: str, mine: float, seed: int, read: Callable[[str], Node]) -> list[float] | None:
    """What the answer should be by a message, in each way to take it; None where it claims no formula."""
    for pattern, claim in _FORMS:
        found = pattern.fullmatch(message)
        if found is None:
            continue
        formulas = {letter: read(text) for letter, text in found.groupdict().items()}
        t, y, o, p = (value(formulas[x], seed) if x in formulas else 1.0 for x in "tyop")
        exchanged = [mine - y + y * o / p]
        if claim == "instead":
            swapped = _swapped(formulas["y"], formulas["p"], formulas["o"])
            exchanged.append(mine - y + value(swapped, seed))
        return {
            "sign": [mine - 2 * t],
            "all": [-mine],
            "number": [mine + (o - y) * t],
            "times": [mine / p],
            "missing": [mine + t],
            "needless": [mine - t],
            "left out": [mine - y + y * p],
            "too many": [mine - y + y / p],
            "instead": exchanged,
            "another": [mine - y + o],
        }[claim]
    return None


def _swapped(node: Node, old: Node, new: Node) -> Node:
    """A formula with one part replaced wherever it stands."""
    return new if node == old else with_children(node, lambda part: _swapped(part, old, new))
