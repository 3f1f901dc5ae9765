"""The values of exact expressions in floating point, or in another kind of number."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from math import cos, pi, radians, sin, sqrt
from typing import Any

from flint import fmpq_mpoly

from dynsolve.algebra.angles import Atom, names_of
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.generators import Generator, dotted
from dynsolve.algebra.ring import Ring
from dynsolve.notation.tree_values import evaluate as value_of_tree

Functions = Mapping[str, Callable[[Any], Any]]

FUNCTIONS: Functions = {"sin": sin, "cos": cos, "sqrt": sqrt}


def evaluate(expr: Expr, values: Mapping[str, float]) -> float:
    """The value at plain names: `theta1`, `theta1_dot`, `theta1_ddot` and the parameters.

    Raises KeyError for a symbol that occurs and has no value.
    """
    return float(evaluate_with(expr, values, FUNCTIONS))


def evaluate_with(expr: Expr, values: Mapping[str, Any], functions: Functions) -> Any:
    """The same in another kind of number, which `functions` work on: a sine, a cosine, a square root."""
    return _Evaluation(expr.ring, values, functions).of(expr.poly)


def _require(g: Generator, values: Mapping[str, Any]) -> None:
    names = [dotted(g.name, g.dots)] if g.kind == "symbol" else names_of(g.angle)
    for name in names:
        if name != "pi" and name not in values:
            raise KeyError(name)


@dataclass(frozen=True, slots=True)
class _Evaluation:
    """The values of polynomials at a point; `known` are generators whose values were found before."""

    ring: Ring
    values: Mapping[str, Any]
    functions: Functions
    known: dict[int, Any] = field(default_factory=dict)

    def of(self, poly: fmpq_mpoly) -> Any:
        """The value of a polynomial."""
        places = [index for index, degree in enumerate(poly.degrees()) if degree > 0]
        known = self.known
        for index in places:
            if index not in known:
                g = self.ring.generators[index]
                _require(g, self.values)
                known[index] = self._generator(g)
        total: Any = 0.0
        for exponents, coefficient in zip(poly.monoms(), poly.coeffs(), strict=True):
            term: Any = int(coefficient.p) / int(coefficient.q)
            for index in places:
                if exponents[index]:
                    term *= known[index] ** int(exponents[index])
            total += term
        return total

    def _generator(self, g: Generator) -> Any:
        """The value of a generator; roots and inverses are of expressions in others."""
        match g.kind:
            case "symbol":
                return pi if g.name == "pi" else self.values[dotted(g.name, g.dots)]
            case "root":
                return self.functions["sqrt"](self.of(self.ring.radicands[g.index]))
            case "inverse":
                return 1 / self.of(self.ring.inverses[g.index])
            case "function" if g.node is not None:
                return value_of_tree(g.node, self.values)
        turn = sum(float(rate) * self._atom(atom) for atom, rate in g.angle.terms)
        angle = radians(float(g.angle.degrees)) + turn
        return self.functions["sin" if g.kind == "sin" else "cos"](angle)

    def _atom(self, atom: Atom) -> Any:
        product: Any = 1.0
        for name, exponent in atom:
            product *= pi if name == "pi" else self.values[name] ** exponent
        return product
