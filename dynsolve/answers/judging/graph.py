"""The derivation as a grader sees it: which answers lead to which, what is part of what, in which order.

A quantity has one route or several to it (D from τ or from K, g from τ or from P).
The formulas are the textbook's rules on the field's robot; here stands only what
they are fed with.  The Coriolis term is held by its vector C q̇, since C is free.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Any

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.judging.answer_ring import Field
from dynsolve.derivation import vectorized
from dynsolve.derivation.energy import velocities
from dynsolve.problem.answer_names import AnswerNames
from dynsolve.robot.model import Robot

_ENTRY = re.compile(r"([dCg])([1-9])([1-9])?")
_SYMBOL = re.compile(r"c([1-9])([1-9])([1-9])")


@dataclass(frozen=True, slots=True)
class Route:
    """value = compute(*inputs); compute gives None where these inputs lead nowhere.

    `linear`: sums and derivatives alone, whose work grows with the inputs and not with their products.
    """

    inputs: tuple[str, ...]
    compute: Callable[..., Any]
    linear: bool = True


@dataclass(frozen=True, slots=True)
class MatrixEntry:
    """An answer that is one entry of a matrix: its whole and the place in it, from 0."""

    whole: str
    row: int
    column: int


class AnswerGraph:
    """The graph of one robot in one field; `shift` is the potential a mass of 1 has at zero height."""

    def __init__(self, field: Field, shift: Expr | None = None) -> None:
        self.field = field
        self.robot: Robot = field.robot
        self.shift = shift

    # -- names -------------------------------------------------------------------------------------

    @cached_property
    def _forces(self) -> dict[str, str]:
        return {q.force: f"tau{q.index}" for q in self.robot.coordinates}

    def node(self, name: str) -> str:
        """The node of the graph that an answer is held at: f2 at tau2, C at Cqd."""
        return "Cqd" if name == "C" else self._forces.get(name, name)

    def answer(self, node: str) -> str:
        """The answer's name of a node: tau2 is f2 where coordinate 2 slides."""
        return next((force for force, name in self._forces.items() if name == node), node)

    def entry(self, name: str) -> MatrixEntry | None:
        """The whole and the place of d11, C12, g1, None for an answer that is no entry."""
        found = _ENTRY.fullmatch(name)
        if found is None:
            return None
        whole = {"d": "D", "C": "C", "g": "g"}[found[1]]
        if (whole == "g") != (found[3] is None):
            return None
        return MatrixEntry(whole, int(found[2]) - 1, int(found[3] or 1) - 1)

    def whole(self, name: str) -> tuple[str, tuple[int, int]]:
        """The matrix that an answer is an entry of, and its place there, from 1; an empty name for others."""
        entry, node = self.entry(name), self.node(name)
        if entry is not None:
            return entry.whole, (entry.row + 1, entry.column + 1)
        if node in self._forces.values():
            return "tau", (int(node.removeprefix("tau")), 1)
        return "", (0, 0)

    def christoffel(self, name: str) -> tuple[int, int, int] | None:
        """(i, j, k) from 0 of c121, with i ≤ j."""
        found = _SYMBOL.fullmatch(name)
        if found is None:
            return None
        i, j, k = (int(digit) - 1 for digit in found.groups())
        return min(i, j), max(i, j), k

    def parts(self, name: str) -> tuple[str, ...]:
        """The answers that a whole can be given by."""
        bodies = [body.name for body in self.robot.bodies]
        n = self.robot.n
        if name in ("P", "K"):
            return tuple(f"{name}{b}" for b in bodies)
        if name == "tau":
            return tuple(self._forces)
        if name == "g":
            return tuple(f"g{k + 1}" for k in range(n))
        if name in ("D", "C"):
            letter = "d" if name == "D" else "C"
            return tuple(f"{letter}{i + 1}{j + 1}" for i in range(n) for j in range(n))
        if name == "J":
            return ("Jv", "Jw")
        if name[0] == "K" and name[1:] in bodies:
            body = next(b for b in self.robot.bodies if b.name == name[1:])
            return (f"Kv{body.name}",) if body.is_point else (f"Kv{body.name}", f"Kw{body.name}")
        return ()

    @cached_property
    def _places(self) -> dict[str, int]:
        return {name: place for place, name in enumerate(self._ordered())}

    def _ordered(self) -> Iterator[str]:
        for name in self.field.rules:
            if name == "christoffel":
                n = range(1, self.robot.n + 1)
                yield from (f"c{i}{j}{k}" for i in n for j in n for k in n)
                continue
            yield self.answer(name)
            if self.robot.bodies and name in ("D", "C", "g"):
                yield from self.parts(name)

    def place(self, name: str) -> int:
        """Where a name stands in the order of the derivation."""
        return self._places.get(name, len(self._places))

    @cached_property
    def names(self) -> AnswerNames:
        """The names of this robot's answers."""
        robot = self.robot
        forces = [q.force for q in robot.coordinates]
        return AnswerNames(len(robot.joints), forces, [body.name for body in robot.bodies])

    # -- values ------------------------------------------------------------------------------------

    def key(self, node: str) -> Any:
        """The key's value of a node; the zero level of height is the student's."""
        value = self.field.key(node)
        if self.shift is None:
            return value
        if node == "L":
            return value - self.shift * self._mass
        if node == "P":
            return value + self.shift * self._mass
        body = next((b for b in self.robot.bodies if node == f"P{b.name}"), None)
        return value if body is None else value + self.shift * body.mass

    @property
    def _mass(self) -> Expr:
        total = self.field.ring.zero
        for body in self.robot.bodies:
            total = total + body.mass
        return total

    def routes(self, node: str) -> Sequence[Route]:
        """The routes to a node; none for what the table gives."""
        if node not in self.field.rules or node.startswith(("I_body", "A")) or node == "H0":
            return ()
        rule = self.field.rules[node]
        match node:
            case "D":
                return (Route(("tau",), self._inertia), Route(("K",), self._inertia_from_energy))
            case "Cqd":
                return (
                    Route(("tau",), self._coriolis),
                    Route(("D",), self._coriolis_from_inertia),
                    Route(("D",), self._coriolis_entry_by_entry),
                )
            case "g":
                return (Route(("tau",), self._gravity), Route(("P",), self._gravity_vector))
            case "C" | "christoffel":
                return (Route(("D",), self._symbols if node == "christoffel" else self._coriolis_matrix),)
        if self.shift is not None and any(node == f"P{b.name}" for b in self.robot.bodies):
            mass = next(b.mass for b in self.robot.bodies if node == f"P{b.name}")
            lift = self.shift * mass
            return (Route(rule.inputs, lambda rc: rule.compute(rc) + lift, linear=False),)
        linear = node in self._sums or node.startswith(("dLdq", "ddt", "tau"))
        return (Route(rule.inputs, rule.compute, linear),) if rule.inputs else ()

    @cached_property
    def _sums(self) -> frozenset[str]:
        return frozenset({"K", "P", "L", "J", *(f"K{body.name}" for body in self.robot.bodies)})

    # -- the vectorized form, from what students have ----------------------------------------------

    def linear(self, tau: Matrix) -> bool:
        """Whether τ is linear in q̈."""
        ring = self.field.ring
        D = vectorized.inertia_from_torque(self.robot, tau)
        return not any(_has_dots(ring, entry, 2) for entry in D.entries)

    def _inertia(self, tau: Matrix) -> Matrix | None:
        return vectorized.inertia_from_torque(self.robot, tau) if self.linear(tau) else None

    def _gravity(self, tau: Matrix) -> Matrix | None:
        return vectorized.gravity_from_torque(self.robot, tau) if self.linear(tau) else None

    def _coriolis(self, tau: Matrix) -> Matrix | None:
        if not self.linear(tau):
            return None
        g = vectorized.gravity_from_torque(self.robot, tau)
        return vectorized.coriolis_from_torque(self.robot, tau, g)

    def _inertia_from_energy(self, K: Expr) -> Matrix | None:
        D = vectorized.inertia_from_energy(self.robot, K)
        return None if any(_has_dots(self.field.ring, e, 1) for e in D.entries) else D

    def _symbols(self, D: Matrix) -> Any:
        return vectorized.christoffel_symbols(self.robot, D)

    def _coriolis_matrix(self, D: Matrix) -> Matrix:
        return vectorized.coriolis_matrix(self.robot, self._symbols(D))

    def _coriolis_from_inertia(self, D: Matrix) -> Matrix:
        return self._coriolis_matrix(D) @ velocities(self.robot)

    def _coriolis_entry_by_entry(self, D: Matrix) -> Matrix | None:
        """Σ_i ∂D/∂q_i q̇_i q̇ - ½ ∂(q̇ᵀ D q̇)/∂q of a D that is not symmetric: each d_ij from its own place."""
        if D.rows == D.T.rows:
            return None
        ring, rates = D.ring, velocities(self.robot)
        slopes = [D.map(partial(ring.diff, k=k)) @ rates for k in range(self.robot.n)]
        moved = [ring.dot([slope.entries[k] for slope in slopes], rates.entries) for k in range(self.robot.n)]
        halves = [(rates.T @ slope).entries[0] * vectorized.HALF for slope in slopes]
        return Matrix.column(ring, [a - b for a, b in zip(moved, halves, strict=True)])

    def _gravity_vector(self, P: Expr) -> Matrix:
        return vectorized.gravity_vector(self.robot, P)


def _has_dots(ring: Any, expr: Expr, dots: int) -> bool:
    if not expr.poly:
        return False
    degrees = expr.poly.degrees()
    return any(degrees[ring.symbol_indices[(name, dots)]] > 0 for name in ring.names)
