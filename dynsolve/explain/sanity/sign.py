"""Whether a formula is positive whatever the pose, for positive masses and moments of inertia.

Seen from its compact form, as a person sees it: sums, products and quotients of what is positive,
and even powers of anything, (L₂ c₂ + l_c3 c₂₃)² among them.  What cannot be seen in this way is
not said.
"""

from __future__ import annotations

from dynsolve.algebra.expr import Expr
from dynsolve.explain.context import Context
from dynsolve.notation.tree import (
    Function,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
)
from dynsolve.robot.model import Robot

Names = frozenset[str]
"""The parameters that are positive."""


def masses_and_moments(robot: Robot) -> Names:
    """The masses and the moments of inertia of a problem; products of inertia may be negative."""
    tensors = [body.inertia for body in robot.bodies if body.inertia is not None]
    places = [(i, j) for i in range(3) for j in range(3)]
    products = {name for t in tensors for i, j in places if i != j for name in _names(t[i, j])}
    moments = {name for t in tensors for i, j in places if i == j for name in _names(t[i, j])}
    masses = {name for body in robot.bodies for name in _names(body.mass)}
    rotors = {name for motor in robot.actions.motors for name in _names(motor.inertia)}
    return frozenset((masses | moments | rotors) - products)


def with_lengths(robot: Robot) -> Names:
    """Every parameter but the products of inertia: lengths and the size of gravity too."""
    tensors = [body.inertia for body in robot.bodies if body.inertia is not None]
    products = {name for t in tensors for i in range(3) for j in range(i) for name in _names(t[i, j])}
    return frozenset(robot.ring.parameters) - products


def _names(expr: Expr) -> set[str]:
    """The parameters that occur in an expression."""
    degrees = expr.poly.degrees()
    return {g.name for g in expr.ring.generators if g.name in expr.ring.parameters and degrees[g.index] > 0}


def is_nonnegative(node: Node, positive: Names) -> bool:
    """Whether no part of a formula can make it negative."""
    match node:
        case Number():
            return True
        case Symbol(name, 0):
            return name in positive
        case Function("sqrt", _):
            return True
        case Parenthesized(argument):
            return is_nonnegative(argument, positive)
        case Power(base, Number(p, 1)):
            return p % 2 == 0 or is_nonnegative(base, positive)
        case Sum(parts) | Product(parts):
            return all(is_nonnegative(part, positive) for part in parts)
        case Quotient(numerator, denominator):
            return is_nonnegative(numerator, positive) and is_nonnegative(denominator, positive)
    return False


def is_positive(node: Node, positive: Names, constant: Names) -> bool:
    """Whether a formula is positive in every pose; `constant` are the parameters, none of which is 0.

    >>> l, m, q = map(Symbol, "lmq")
    >>> square = Product((m, Power(l, Number(2))))
    >>> names = frozenset("m"), frozenset("lm")
    >>> is_positive(square, *names), is_positive(Product((square, Function("sin", q))), *names)
    (True, False)
    """
    match node:
        case Number(p, _):
            return p > 0
        case Power(base, _):
            nonzero = isinstance(base, Symbol) and base.name in constant and not base.dots
            return is_nonnegative(node, positive) and (nonzero or is_positive(base, positive, constant))
        case Sum(parts):
            return is_nonnegative(node, positive) and any(is_positive(p, positive, constant) for p in parts)
        case Product(parts):
            return all(is_positive(part, positive, constant) for part in parts)
        case Quotient(numerator, denominator):
            return is_positive(numerator, positive, constant) and is_positive(denominator, positive, constant)
        case Parenthesized(argument) | Function("sqrt", argument):
            return is_positive(argument, positive, constant)
    return isinstance(node, Symbol) and is_nonnegative(node, positive)


def sign_of(context: Context, value: Expr) -> int:
    """The sign of a value in every pose, lengths positive: 1 or -1; 0 where none is seen."""
    positive, constant = with_lengths(context.robot), frozenset(context.robot.ring.parameters)
    return next((sign for sign in (1, -1) if is_positive(context.show(value * sign), positive, constant)), 0)
