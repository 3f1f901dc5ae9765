"""The derivation as a grader sees it: which answers lead to which.

A quantity has one route or several to it (D from τ or from K, g from τ or from P).
Between τ and D, C, g there are routes both ways: some read D, C and g off from τ, others
assemble τ from them.  A walk takes them one way, `assembled` or not, so that nothing ever
leads to itself.
The formulas are the textbook's rules on the robot in the answers' ring; here stands only what
they are fed with.  Many matrices C give the same C q̇, so this
vector is what the Coriolis term is compared by.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property, partial
from typing import Any

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.judging.answer_ring import AnswerRing
from dynsolve.answers.judging.differentiation_routes import differentiation_routes
from dynsolve.answers.judging.model_routes import model_routes
from dynsolve.answers.judging.recursion_routes import recursion_routes
from dynsolve.answers.judging.route import Route
from dynsolve.answers.judging.task_routes import task_routes
from dynsolve.derivation import vectorized
from dynsolve.derivation.energy import velocities
from dynsolve.quantities import action_families, families
from dynsolve.quantities.index import Quantities, quantities
from dynsolve.quantities.model_families import PARAMETERS, REFERENCE
from dynsolve.robot.model import Body, Robot

_STATED = (families.H0, families.A, families.I_BODY, action_families.PS, action_families.FRICTION)
"""What the problem says, so that nothing of the student's leads to it."""

_LINEAR = (
    families.J, families.K_BODY, families.K, families.P, families.L, families.DLDQD, families.DDT,
    families.DLDQ, families.FORCE, families.TAU,
)  # fmt: skip
"""What is made of sums and derivatives alone."""


MODEL = ("D", "Cqd", "g")
"""What τ is assembled from, with friction where there is any."""


class AnswerGraph:
    """The graph of one robot in one ring.

    `zero_potential` is the potential that a unit of mass has at the key's zero of height,
    where the student has chosen another zero; `parameters` are those of τ = Y a that the student
    has chosen, by name.
    """

    def __init__(
        self,
        answer_ring: AnswerRing,
        zero_potential: Expr | None = None,
        parameters: Mapping[str, Matrix] | None = None,
    ) -> None:
        self.parameters = parameters or {}
        self._regressors: dict[str, Any] = {}
        self.answer_ring = answer_ring
        self.robot: Robot = answer_ring.robot
        self.zero_potential = zero_potential

    # -- names -------------------------------------------------------------------------------------

    @cached_property
    def quantities(self) -> Quantities:
        """What the robot has that an answer may be given for."""
        return quantities(self.robot)

    def node(self, name: str) -> str:
        """The node of the graph that an answer is compared at: f2 at tau2, C at Cqd."""
        quantity = self.quantities.get("Cqd" if name == "C" else name)
        return name if quantity is None else quantity.rule

    def answer(self, node: str) -> str:
        """The answer's name of a node: tau2 is f2 where coordinate 2 slides."""
        quantity = self.quantities.of_rule(node)
        return node if quantity is None else quantity.name

    # -- values ------------------------------------------------------------------------------------

    def key(self, node: str) -> Any:
        """The key's value of a node; at the student's own zero of height, for own parameters a."""
        if node in self.parameters:
            return self.parameters[node]
        if (PARAMETERS.get(node) or (node == REFERENCE and PARAMETERS["Y"])) in self.parameters:
            return self._own_regressor(node)
        value = self.answer_ring.key(node)
        if self.zero_potential is None:
            return value
        if node == "L":
            return value - self.zero_potential * self._mass
        if node == "P":
            return value + self.zero_potential * self._mass
        body = self._lifted(node)
        return value if body is None else value + self.zero_potential * body.mass

    def _own_regressor(self, node: str) -> Any:
        """The regressor that belongs to the student's own parameters."""
        if node not in self._regressors:
            rule = self.answer_ring.rules[node]
            self._regressors[node] = rule.compute(*map(self.key, rule.inputs))
        return self._regressors[node]

    def _lifted(self, node: str) -> Body | None:
        """The body whose potential energy a node is."""
        quantity = self.quantities.of_rule(node)
        is_lifted = quantity is not None and quantity.family is families.P_BODY
        return self.robot.bodies[quantity.index[0] - 1] if quantity is not None and is_lifted else None

    @property
    def _mass(self) -> Expr:
        total = self.answer_ring.ring.zero
        for body in self.robot.bodies:
            total = total + body.mass
        return total

    def routes(self, node: str, assembled: bool = False) -> Sequence[Route]:
        """The routes to a node; none for what the table gives.

        `assembled`: τ from D, C and g too, and none of these from τ.
        """
        quantity = self.quantities.of_rule(node)
        if node not in self.answer_ring.rules or quantity is None or quantity.family in _STATED:
            return ()
        rule = self.answer_ring.rules[node]
        match node:
            case "D" | "Cqd" | "g":
                found = self._routes_of_model(node)
                return tuple(r for r in found if "tau" not in r.inputs) if assembled else found
            case _ if node in PARAMETERS or node == REFERENCE:
                return tuple(model_routes(rule, self.key))
            case "C" | "christoffel":
                return (Route(("D",), self._symbols if node == "christoffel" else self._coriolis_matrix),)
        body = self._lifted(node)
        if self.zero_potential is not None and body is not None:
            lift = self.zero_potential * body.mass
            return (Route(rule.inputs, lambda rc: rule.compute(rc) + lift, linear=False),)
        lagrange = (Route(rule.inputs, rule.compute, quantity.family in _LINEAR),) if rule.inputs else ()
        if node in self._further:
            lagrange = (*lagrange, *self._further[node])
        if assembled and quantity.family is families.FORCE:
            together = partial(vectorized.torque, self.robot, k=quantity.index[0] - 1)
            return (*lagrange, Route((*MODEL, *self._friction), together))
        return lagrange

    @cached_property
    def _further(self) -> dict[str, tuple[Route, ...]]:
        """Further routes, by their nodes: about the task, by the recursions, by differentiating."""
        rules = self.answer_ring.rules
        found: dict[str, tuple[Route, ...]] = {}
        for quantity in self.quantities.values():
            if quantity.rule in rules:
                ways = (
                    *task_routes(self.robot.questions, quantity, self.key),
                    *recursion_routes(self.answer_ring, quantity),
                    *differentiation_routes(self.robot, quantity),
                )
                if ways:
                    found[quantity.rule] = ways
        return found

    @cached_property
    def _friction(self) -> tuple[str, ...]:
        """The node of friction, where there is any: it stands in the equation beside D, C and g."""
        return ("friction",) if "friction" in self.answer_ring.rules else ()

    def _routes_of_model(self, node: str) -> tuple[Route, ...]:
        """The routes to D, C q̇ and g."""
        if node == "D":
            return (Route(("tau",), self._inertia), Route(("K",), self._inertia_from_energy))
        if node == "g":
            return (Route(("tau",), self._gravity), Route(("P",), self._gravity_vector))
        return (
            Route(("tau", *self._friction), self._coriolis),
            Route(("D",), self._coriolis_from_inertia),
            Route(("D",), self._coriolis_entry_by_entry),
        )

    # -- the vectorized form, from what students have ----------------------------------------------

    def linear(self, tau: Matrix) -> bool:
        """Whether τ is linear in q̈."""
        ring = self.answer_ring.ring
        D = vectorized.inertia_from_torque(self.robot, tau)
        return not any(_has_dots(ring, entry, 2) for entry in D.entries)

    def _inertia(self, tau: Matrix) -> Matrix | None:
        return vectorized.inertia_from_torque(self.robot, tau) if self.linear(tau) else None

    def _gravity(self, tau: Matrix) -> Matrix | None:
        return vectorized.gravity_from_torque(self.robot, tau) if self.linear(tau) else None

    def _coriolis(self, tau: Matrix, friction: Matrix | None = None) -> Matrix | None:
        if not self.linear(tau):
            return None
        g = vectorized.gravity_from_torque(self.robot, tau)
        return vectorized.coriolis_from_torque(self.robot, tau, g, friction)

    def _inertia_from_energy(self, K: Expr) -> Matrix | None:
        D = vectorized.inertia_from_energy(self.robot, K)
        return None if any(_has_dots(self.answer_ring.ring, e, 1) for e in D.entries) else D

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
        partials = [D.map(partial(ring.diff, k=k)) @ rates for k in range(self.robot.n)]
        moved = [
            ring.dot([moving.entries[k] for moving in partials], rates.entries) for k in range(self.robot.n)
        ]
        halves = [(rates.T @ moving).entries[0] * vectorized.HALF for moving in partials]
        return Matrix.column(ring, [a - b for a, b in zip(moved, halves, strict=True)])

    def _gravity_vector(self, P: Expr) -> Matrix:
        return vectorized.gravity_vector(self.robot, P)


def _has_dots(ring: Any, expr: Expr, dots: int) -> bool:
    if not expr.poly:
        return False
    degrees = expr.poly.degrees()
    return any(degrees[ring.symbol_indices[(name, dots)]] > 0 for name in ring.names)
