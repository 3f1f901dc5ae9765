"""Hyper-dual numbers a + b ε₁ + c ε₂ + d ε₁ε₂ with ε₁² = ε₂² = 0: exact first and second derivatives.

f(x + ε₁ + ε₂) has f' beside ε₁ and f'' beside ε₁ε₂, with no formula for either.
Fike, Alonso, The development of hyper-dual numbers for exact second-derivative
calculations (2011).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, slots=True)
class HyperDual:
    """a + b ε₁ + c ε₂ + d ε₁ε₂

    >>> x = HyperDual(3.0, 1.0, 1.0)
    >>> (x * x * x).mixed
    18.0
    """

    value: float
    first: float = 0.0
    second: float = 0.0
    mixed: float = 0.0

    def __add__(self, other: HyperDual | float) -> HyperDual:
        o = _dual(other)
        return HyperDual(
            self.value + o.value, self.first + o.first, self.second + o.second, self.mixed + o.mixed
        )

    __radd__ = __add__

    def __neg__(self) -> HyperDual:
        return HyperDual(-self.value, -self.first, -self.second, -self.mixed)

    def __sub__(self, other: HyperDual | float) -> HyperDual:
        return self + -_dual(other)

    def __rsub__(self, other: float) -> HyperDual:
        return -self + other

    def __mul__(self, other: HyperDual | float) -> HyperDual:
        o = _dual(other)
        return HyperDual(
            self.value * o.value,
            self.value * o.first + self.first * o.value,
            self.value * o.second + self.second * o.value,
            self.value * o.mixed + self.first * o.second + self.second * o.first + self.mixed * o.value,
        )

    __rmul__ = __mul__

    def __truediv__(self, other: HyperDual | float) -> HyperDual:
        return self * _dual(other).mapped(lambda x: 1 / x, lambda x: -1 / x**2, lambda x: 2 / x**3)

    def __rtruediv__(self, other: float) -> HyperDual:
        return _dual(other) / self

    def __pow__(self, exponent: int) -> HyperDual:
        if exponent < 0:
            return 1.0 / self**-exponent
        result = HyperDual(1.0)
        for _ in range(exponent):
            result = result * self
        return result

    def mapped(
        self,
        f: Callable[[float], float],
        slope: Callable[[float], float],
        curvature: Callable[[float], float],
    ) -> HyperDual:
        """f of it, by f, f' and f''."""
        x, df = self.value, slope(self.value)
        mixed = df * self.mixed + curvature(x) * self.first * self.second
        return HyperDual(f(x), df * self.first, df * self.second, mixed)


def _dual(number: HyperDual | float) -> HyperDual:
    return number if isinstance(number, HyperDual) else HyperDual(float(number))


def sin(x: HyperDual | float) -> HyperDual:
    """The sine."""
    return _dual(x).mapped(math.sin, math.cos, lambda a: -math.sin(a))


def cos(x: HyperDual | float) -> HyperDual:
    """The cosine."""
    return _dual(x).mapped(math.cos, lambda a: -math.sin(a), lambda a: -math.cos(a))


def sqrt(x: HyperDual | float) -> HyperDual:
    """The square root."""
    return _dual(x).mapped(math.sqrt, lambda a: 0.5 / math.sqrt(a), lambda a: -0.25 / math.sqrt(a) ** 3)


FUNCTIONS: Mapping[str, Callable[[Any], Any]] = {
    "sin": sin,
    "cos": cos,
    "tan": lambda x: sin(x) / cos(x),
    "sqrt": sqrt,
}
"""The functions of formulas, on hyper-dual numbers."""
