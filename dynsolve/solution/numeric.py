"""Results as NumPy functions of the state and the parameters.

Trees -> SymPy, node by node; no text is ever parsed.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import sympy
from msgspec import Struct
from numpy.typing import ArrayLike, NDArray

from dynsolve.errors import UsageError
from dynsolve.notation.python import python_name
from dynsolve.notation.tree import (
    Degrees,
    Function,
    Matrix,
    Negative,
    Node,
    Number,
    Parenthesized,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
)
from dynsolve.notation.tree_values import DOTS, Program, compile_trees, plain_name
from dynsolve.problem import Problem
from dynsolve.quantities.index import quantities

_FUNCTIONS = {"sin": np.sin, "cos": np.cos, "tan": np.tan, "sqrt": np.sqrt, "sgn": np.sign}


class NumericFunction(Struct, frozen=True, dict=True):
    """f(q, qd, qdd, **parameters), a NumPy function.

    `q`, `qd`, `qdd` hold n entries each, in the order of the coordinates; angles
    are in radians.  An entry may itself be an array, so that many states are
    evaluated at once: the axes of the entries come last in the result.  Rates that
    are left out are zero.  Parameters go by their names in the problem file
    (`lambda_` for `lambda`); those that the file gives `values` for may be left out.

    A column vector comes as an array of n entries, a matrix as rows and columns, a
    scalar as a number.
    """

    name: str
    coordinates: tuple[str, ...]
    parameters: tuple[str, ...]
    defaults: Mapping[str, float]
    program: Program
    is_vector: bool

    @staticmethod
    def of(name: str, tree: Node, problem: Problem) -> NumericFunction:
        """The function of a tree."""
        program = compile_trees([tree], _FUNCTIONS)
        coordinates = tuple(q.name for q in problem.robot.coordinates)
        states = {q + dots for q in coordinates for dots in DOTS}
        parameters = tuple(name for name in program.symbols if name not in states and name != "pi")
        defaults = {name: float(value) for name, value in problem.values.items()}
        quantity = quantities(problem.robot).result(name)
        is_vector = quantity is not None and quantity.family.is_vector
        return NumericFunction(name, coordinates, parameters, defaults, program, is_vector)

    def __call__(
        self,
        q: ArrayLike,
        qd: ArrayLike | None = None,
        qdd: ArrayLike | None = None,
        /,
        **parameters: ArrayLike,
    ) -> NDArray[np.float64]:
        """The value at a state; UsageError for a missing parameter or a wrong number of coordinates."""
        values: dict[str, Any] = {"pi": math.pi}
        for dots, vector in zip(DOTS, (q, qd, qdd), strict=True):
            values |= self._vector(dots, vector)
        spelled = {python_name(name): name for name in self.parameters}
        given = {spelled.get(name, name): np.asarray(value, float) for name, value in parameters.items()}
        values = {**values, **self.defaults, **given}
        missing = [python_name(name) for name in self.parameters if name not in values]
        if missing:
            raise UsageError(f"{self.name} needs values for {', '.join(missing)}")
        (result,) = self.program.run(values)
        if self.is_vector:
            result = [entry for (entry,) in result]
        shape = np.broadcast_shapes(*(np.shape(entry) for entry in _flat(result)))
        return np.array(_broadcast(result, shape), dtype=float)

    def _vector(self, dots: str, vector: ArrayLike | None) -> dict[str, Any]:
        if vector is None:
            return {name + dots: 0.0 for name in self.coordinates}
        entries = [np.asarray(entry, float) for entry in np.atleast_1d(np.asarray(vector, float))]
        if len(entries) != len(self.coordinates):
            what = "q" + ("", "d", "dd")[DOTS.index(dots)]
            raise UsageError(
                f"{what} has {len(entries)} entries, the robot {len(self.coordinates)} coordinates"
            )
        return {name + dots: entry for name, entry in zip(self.coordinates, entries, strict=True)}


def _flat(result: Any) -> list[Any]:
    if not isinstance(result, list):
        return [result]
    return [entry for part in result for entry in _flat(part)]


def _broadcast(result: Any, shape: tuple[int, ...]) -> Any:
    if isinstance(result, list):
        return [_broadcast(part, shape) for part in result]
    return np.broadcast_to(result, shape)


# Trees -> SymPy, node by node; no text is ever parsed

_SYMBOLIC_FUNCTIONS = {
    "sin": sympy.sin,
    "cos": sympy.cos,
    "tan": sympy.tan,
    "sqrt": sympy.sqrt,
    "sgn": sympy.sign,
}


def to_sympy(node: Node) -> Any:
    """The SymPy object of a tree, all of its symbols real; velocities are `theta1_dot`.

    >>> to_sympy(Product((Symbol("m1"), Power(Symbol("theta1", 1), Number(2)))))
    m1*theta1_dot**2
    """
    return _Converter().convert(node)


class _Converter:
    """Converts each shared part once."""

    def __init__(self) -> None:
        self._known: dict[int, Any] = {}

    def convert(self, node: Node) -> Any:
        if id(node) not in self._known:
            self._known[id(node)] = self._converted(node)
        return self._known[id(node)]

    def _converted(self, node: Node) -> Any:
        match node:
            case Number(p, q):
                return sympy.Rational(p, q)
            case Degrees(p, q):
                return sympy.pi * sympy.Rational(p, 180 * q)
            case Symbol("pi", 0):
                return sympy.pi
            case Symbol():
                return sympy.Symbol(plain_name(node), real=True)
            case Sum(terms):
                return sympy.Add(*map(self.convert, terms))
            case Product(factors):
                return sympy.Mul(*map(self.convert, factors))
            case Quotient(numerator, denominator):
                return self.convert(numerator) / self.convert(denominator)
            case Power(base, exponent):
                return self.convert(base) ** self.convert(exponent)
            case Negative(argument):
                return -self.convert(argument)
            case Parenthesized(argument):
                return self.convert(argument)
            case Function(name, argument):
                return _SYMBOLIC_FUNCTIONS[name](self.convert(argument))
            case Matrix(rows):
                return sympy.ImmutableMatrix([[self.convert(entry) for entry in row] for row in rows])
        raise TypeError(f"{type(node).__name__} has no meaning in SymPy")
