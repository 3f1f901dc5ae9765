"""Models without a table at random states, sharing no formula with the derivation.

Of bodies by their positions: the accelerations of each body come from its position and its
turns as functions of time, Newton's and Euler's laws give the force and the moment that it
takes, and virtual displacements bring these to the coordinates (d'Alembert's principle).
Of given energies: Lagrange's equations on numbers.  All derivatives are those of hyper-dual
numbers.

Hyper-dual numbers a + b ε₁ + c ε₂ + d ε₁ε₂ with ε₁² = ε₂² = 0: exact first and second derivatives.

f(x + ε₁ + ε₂) has f' beside ε₁ and f'' beside ε₁ε₂, with no formula for either.
Fike, Alonso, The development of hyper-dual numbers for exact second-derivative
calculations (2011).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from msgspec import Struct

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_values import evaluate, evaluate_with
from dynsolve.derivation.arm_values import states_with
from dynsolve.derivation.newton_euler import Vector, cross, dot, plus, scaled
from dynsolve.notation.tree_values import compile_trees
from dynsolve.robot.model import Body, GivenModel, Robot

# Hyper-dual numbers a + b ε₁ + c ε₂ + d ε₁ε₂ with ε₁² = ε₂² = 0


class HyperDual(Struct, frozen=True):
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

Values = Mapping[str, float | HyperDual]
Rows = list[list[HyperDual]]

BY_BODIES = "Newton's and Euler's laws of each body with virtual work"
BY_ENERGIES = "Lagrange's equations on numbers"


class Mechanism(Struct, frozen=True):
    """A model without a table at a state: its parameters, coordinates, rates and accelerations in numbers."""

    robot: Robot
    values: Mapping[str, float]

    @property
    def qd(self) -> tuple[float, ...]:
        """The rates."""
        return tuple(self.values[q.velocity] for q in self.robot.coordinates)

    @property
    def qdd(self) -> tuple[float, ...]:
        """The accelerations."""
        return tuple(self.values[q.acceleration] for q in self.robot.coordinates)

    def forces(self, qd: Sequence[float], qdd: Sequence[float], has_gravity: bool) -> list[float]:
        """The generalized forces of masses and rotors, n of them; without gravity, of the kinetic energy."""
        masses = self._of_masses(qd, qdd, has_gravity)
        for k, inertia in self._rotors:
            masses[k] += inertia * qdd[k]
        return masses

    @property
    def _rotors(self) -> list[tuple[int, float]]:
        """(coordinate, moment of inertia felt there) of each rotor: no link carries one."""
        rotors = self.robot.actions.rotors
        return [(one.turns, self._number(one.inertia) * self._number(one.ratio) ** 2) for one in rotors]

    def _of_masses(self, qd: Sequence[float], qdd: Sequence[float], has_gravity: bool) -> list[float]:
        given = self.robot.given
        if given is not None:
            return [self._by_lagrange(given, k, qd, qdd, has_gravity) for k in range(self.robot.n)]
        total = [0.0] * self.robot.n
        for body in self.robot.bodies:
            for k, force in enumerate(self._by_newton(body, qd, qdd, has_gravity)):
                total[k] += force
        return total

    def energies(self) -> tuple[float, float]:
        """(K, P) of masses and rotors at the state."""
        kinetic, potential = self._energies_of_masses()
        return kinetic + sum(i * self.qd[k] ** 2 / 2 for k, i in self._rotors), potential

    def _energies_of_masses(self) -> tuple[float, float]:
        given = self.robot.given
        if given is not None:
            still = self._with([HyperDual(0.0)] * self.robot.n)
            P = -_lagrangian(given, still).value
            return _lagrangian(given, self.values).value + P, P
        kinetic, potential = 0.0, 0.0
        for body in self.robot.bodies:
            mass, moving = self._number(body.mass), self._moving(body, self.qd, self.qdd)
            kinetic += (mass * dot(moving.v, moving.v) + dot(moving.w, moving.momentum)) / 2
            potential -= mass * dot(self._gravity, moving.p)
        return kinetic, potential

    @property
    def size(self) -> float:
        """The size of what moves, or could turn, below which results are rounding."""
        K, P = self.energies()
        entries = (entry for body in self.robot.bodies if body.inertia for entry in body.inertia.entries)
        return abs(K) + abs(P) + max((abs(self._number(entry)) for entry in entries), default=0.0)

    # -- bodies ------------------------------------------------------------------------------------

    def _by_newton(
        self, body: Body, qd: Sequence[float], qdd: Sequence[float], has_gravity: bool
    ) -> list[float]:
        """What a body's motion asks of each coordinate."""
        moving = self._moving(body, qd, qdd)
        pull = self._gravity if has_gravity else (0.0, 0.0, 0.0)
        force = scaled(plus(moving.a, scaled(pull, -1.0)), self._number(body.mass))
        found = []
        for k in range(self.robot.n):
            step = [float(i == k) for i in range(self.robot.n)]
            virtual = self._moving(body, step, [0.0] * self.robot.n)
            found.append(dot(force, virtual.v) + dot(moving.moment, virtual.w))
        return found

    def _moving(self, body: Body, qd: Sequence[float], qdd: Sequence[float]) -> _Moving:
        """A body's motion along q + q̇ t + ½ q̈ t²: both ε are t, so that ε₁ε₂ holds the second derivative."""
        names = self.robot.ring.names
        path: dict[str, float | HyperDual] = dict(self.values)
        for name, rate, acceleration in zip(names, qd, qdd, strict=True):
            path[name] = HyperDual(self.values[name], rate, rate, acceleration)
        p = [_hyper_dual(entry, path) for entry in body.center.entries]
        R = _orientation(body, path)
        inertia = (
            [[self._number(entry) for entry in row] for row in body.inertia.rows] if body.inertia else []
        )
        return _Moving.of(p, R, inertia)

    @property
    def _gravity(self) -> Vector:
        x, y, z = (self._number(entry) for entry in self.robot.gravity.entries)
        return x, y, z

    def _number(self, expr: Expr) -> float:
        return evaluate(expr, self.values)

    # -- energies ----------------------------------------------------------------------------------

    def _by_lagrange(
        self, given: GivenModel, k: int, qd: Sequence[float], qdd: Sequence[float], has_gravity: bool
    ) -> float:
        """d/dt ∂L/∂q̇_k - ∂L/∂q_k: t is ε₁, and the change of q̇_k or q_k is ε₂."""
        q = [self.values[name] for name in self.robot.ring.names]
        one = [float(i == k) for i in range(self.robot.n)]
        along = [HyperDual(x, rate) for x, rate in zip(q, qd, strict=True)]
        rates = [HyperDual(*parts) for parts in zip(qd, qdd, one, strict=True)]
        momentum_rate = _lagrangian(given, self._with(rates, along), has_gravity).mixed
        shifted = [HyperDual(x, 0.0, step) for x, step in zip(q, one, strict=True)]
        held = [HyperDual(rate) for rate in qd]
        return momentum_rate - _lagrangian(given, self._with(held, shifted), has_gravity).second

    def _with(self, rates: Sequence[HyperDual], q: Sequence[HyperDual] = ()) -> Values:
        """The values with these rates, and these coordinates where they are given."""
        found: dict[str, float | HyperDual] = dict(self.values)
        found.update(zip((c.velocity for c in self.robot.coordinates), rates, strict=True))
        found.update(zip((c.name for c in self.robot.coordinates), q, strict=False))
        return found


class _Moving(Struct, frozen=True):
    """A body's motion in the world, and the moment that it takes about its mass centre."""

    p: Vector
    v: Vector
    a: Vector
    w: Vector
    momentum: Vector
    moment: Vector

    @staticmethod
    def of(p: Sequence[HyperDual], R: Rows, inertia: list[list[float]]) -> _Moving:
        """From the position and the orientation as functions of time."""
        turned = _product(R, _product(inertia, _transposed(R))) if inertia else []
        spin = _product(_derived(R), _transposed(R))  # S(ω) = Ṙ Rᵀ, whose derivative is S(α)
        w = (spin[2][1], spin[0][2], spin[1][0])
        momentum = [sum((row[j] * w[j] for j in range(3)), HyperDual(0.0)) for row in turned]
        angular = momentum or [HyperDual(0.0)] * 3
        return _Moving(
            _vector([x.value for x in p]),
            _vector([x.first for x in p]),
            _vector([x.mixed for x in p]),
            _vector([x.value for x in w]),
            _vector([x.value for x in angular]),
            _vector([x.second for x in angular]),
        )


def _vector(entries: Sequence[float]) -> Vector:
    x, y, z = entries
    return x, y, z


def _derived(R: Rows) -> Rows:
    """dR/dε₁, as a function of ε₂."""
    return [[HyperDual(x.first, 0.0, x.mixed) for x in row] for row in R]


def _transposed(R: Rows) -> Rows:
    return [list(column) for column in zip(*R, strict=True)]


def _product(A: Sequence[Sequence[HyperDual | float]], B: Rows) -> Rows:
    columns = list(zip(*B, strict=True))
    return [[sum((a * b for a, b in zip(row, c, strict=True)), HyperDual(0.0)) for c in columns] for row in A]


def _orientation(body: Body, values: Values) -> Rows:
    """The product of the body's turns: each vector b becomes b cos φ + a × b sin φ + a (a·b)(1 - cos φ)."""
    R = [[HyperDual(float(i == j)) for j in range(3)] for i in range(3)]
    for turn in body.turns:
        (angle,) = compile_trees([turn.angle], FUNCTIONS).run(values)  # type: ignore[arg-type]
        axis = _vector([_hyper_dual(entry, values).value for entry in turn.axis.entries])
        c, s = cos(angle), sin(angle)
        columns = []
        for k in range(3):
            unit = _vector([float(i == k) for i in range(3)])
            across = cross(axis, unit)
            columns.append([unit[i] * c + across[i] * s + axis[i] * axis[k] * (1.0 - c) for i in range(3)])
        R = _product(R, _transposed(columns))
    return R


def _lagrangian(given: GivenModel, values: Values, has_gravity: bool = True) -> HyperDual:
    """L as the file gives it, or K - P; without P where there is no gravity."""
    if given.L is not None:
        L = _hyper_dual(given.L, values)
        return L if has_gravity else L - _hyper_dual(given.L.ring.without(given.L, 1), values)
    kinetic = _hyper_dual(given.K, values) if given.K is not None else _of_matrix(given.D, values)
    if given.P is None or not has_gravity:
        return kinetic
    return kinetic - _hyper_dual(given.P, values)


def _of_matrix(D: Matrix | None, values: Values) -> HyperDual:
    """½ Σ d_ij q̇_i q̇_j"""
    total = HyperDual(0.0)
    if D is not None:
        rates = [values[f"{name}_dot"] for name in D.ring.names]
        for row, left in zip(D.rows, rates, strict=True):
            for entry, right in zip(row, rates, strict=True):
                total = total + _hyper_dual(entry, values) * left * right * 0.5
    return total


def _hyper_dual(expr: Expr, values: Values) -> HyperDual:
    value: HyperDual | float = evaluate_with(expr, values, FUNCTIONS)
    return HyperDual(0.0) + value


def mechanisms(robot: Robot) -> Iterator[tuple[dict[str, float], Mechanism]]:
    """States, with parameters for which every root and quotient has a value, and the mechanism there."""

    def at(values: Mapping[str, float]) -> Mechanism:
        mechanism = Mechanism(robot, values)
        mechanism.energies()
        return mechanism

    return states_with(robot.ring, at)
