"""The derivation as a grader sees it: which answers lead to which.

A quantity has one route or several to it (D from τ or from K, g from τ or from P).
Between τ and D, C, g there are routes both ways: some read D, C and g off from τ, others
assemble τ from them.  A walk takes them one way, `assembled` or not, so that nothing ever
leads to itself.
The formulas are the textbook's rules on the robot in the answers' ring; here stands only what
they are fed with.  Many matrices C give the same C q̇, so this
vector is what the Coriolis term is compared by.

Further routes: by differentiating, v = ṙ_c and J_v = ∂r_c/∂q; J_r by rows of J_v, and forces to the
joints by J_rᵀ; the component of a force of the recursions along the joint's axis; Y by the key's
parameters or by the student's.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property, partial
from typing import Any

from msgspec import Struct

from dynsolve.algebra.linear_systems import FractionMatrix
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.answers.judging.answer_ring import AnswerRing
from dynsolve.derivation import euler_lagrange, kinematics
from dynsolve.derivation.graph import Rule, Skipped
from dynsolve.derivation.link_frame import velocities
from dynsolve.derivation.mechanism import position_jacobian
from dynsolve.errors import AlgebraError
from dynsolve.notation.tree import Reference
from dynsolve.quantities import action_families, families
from dynsolve.quantities.index import Quantities, Quantity, quantities
from dynsolve.questions import statics
from dynsolve.questions import task as of_task
from dynsolve.questions.newton_euler.derive import torque_rule
from dynsolve.questions.parameters import PARAMETERS, REFERENCE
from dynsolve.questions.statics.derive import wrench as force_and_moment
from dynsolve.robot.model import Body, Robot
from dynsolve.robot.questions import TIP, Load, Questions, Task

# One way in which an answer may be come to from others

Key = Callable[[str], Any]
"""The key's value of a node, by its name."""


class Route(Struct, frozen=True):
    """value = compute(*inputs); compute gives None where these inputs lead nowhere.

    `linear`: sums and derivatives alone, whose work grows with the inputs and not with their products.
    """

    inputs: tuple[str, ...]
    compute: Callable[..., Any]
    linear: bool = True


# Velocities and Jacobians by differentiating, beside the geometric way


def differentiation_routes(robot: Robot, quantity: Quantity) -> Iterator[Route]:
    """The routes to a velocity or a Jacobian of a point in the world's axes from where the point is."""
    owner = quantity.rule.removeprefix(quantity.family.stem)
    match quantity.family:
        case families.JV_BODY:
            yield Route((f"rc{owner}",), partial(position_jacobian, robot))
        case families.V:
            yield Route((f"rc{owner}",), _rate)
        case families.JV:
            tip = f"H{len(robot.joints)}"
            yield Route((tip,), lambda H: position_jacobian(robot, kinematics.origin(H)))
        case of_task.JV_POINT if _is_in_world(robot, owner):
            yield Route((f"p{owner}",), partial(position_jacobian, robot))
        case of_task.V_POINT if _is_in_world(robot, owner):
            yield Route((f"p{owner}",), _rate)


def _rate(position: Matrix) -> Matrix:
    return position.map(position.ring.time_derivative)


def _is_in_world(robot: Robot, name: str) -> bool:
    """Whether the velocity of a named point is wanted along the axes in which its position is given."""
    return any(point.name == name and point.axes is None for point in robot.questions.points)


# Ways to what is asked of the equations of motion


def model_routes(rule: Rule, key: Key) -> Iterator[Route]:
    """The routes to a regressor, from its rule."""
    *forces, parameters = rule.inputs

    def by_key(*values: Any) -> Matrix | FractionMatrix:
        return _found(rule.compute(*values, key(parameters)))

    yield Route(tuple(forces), by_key, linear=False)
    yield Route(rule.inputs, lambda *values: _found(rule.compute(*values)), linear=False)


def _found(value: Matrix | FractionMatrix | Skipped) -> Matrix | FractionMatrix:
    if isinstance(value, Skipped):
        raise AlgebraError(value.why)
    return value


# The way to a force from what the recursions give: the component along the joint's axis


def recursion_routes(answer_ring: AnswerRing, quantity: Quantity) -> Iterator[Route]:
    """The route to a force by the recursions, where an exercise asks for these."""
    if quantity.family is families.FORCE and "nl1" in answer_ring.rules:
        rule = torque_rule(answer_ring.robot, answer_ring.robot.coordinates[quantity.index[0] - 1])
        yield Route(rule.inputs, rule.compute)


# Further ways to results about the task


def task_routes(questions: Questions, quantity: Quantity, key: Key) -> Iterator[Route]:
    """The routes to a quantity beside that of its rule."""
    task = questions.task
    if task is None or task.is_twist:
        return
    if quantity.family is of_task.JR:
        rows = [_axis(entry) for entry in task.entries]
        if None not in rows:
            yield Route(("Jv",), lambda Jv: Matrix(Jv.ring, tuple(Jv.rows[k] for k in rows if k is not None)))
    elif quantity.family is statics.LOAD:
        load = questions.loads[quantity.index[0] - 1]
        wrench = _task_wrench(task, load, quantity.rule, key)
        if wrench is not None:
            yield Route(("Jr",), lambda J: J.T @ wrench, linear=False)


def _axis(entry: object) -> int | None:
    """Which coordinate of the tip a component of the task is, None for any other component."""
    if isinstance(entry, Reference) and entry.quantity == TIP and entry.row is not None:
        return entry.row - 1
    return None


def _task_wrench(task: Task, load: Load, rule: str, key: Key) -> Matrix | None:
    """The force along each component of the task with which J_rᵀ gives the generalized forces; None of none.

    Along a coordinate of the tip it is that of the force, along an angle one of the moment.
    """
    if load.point != TIP:
        return None
    J, wanted = key("Jr"), key(rule)
    force, moment = force_and_moment(load, key(f"H{load.link}"))
    for around in range(3):
        parts: list[Expr] = []
        for entry in task.entries:
            axis = _axis(entry)
            parts.append(moment[around, 0] if axis is None else force[axis, 0])
        wrench = Matrix.column(J.ring, parts)
        if J.T @ wrench == wanted:
            return wrench
    return None


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
        self._routes: dict[tuple[str, bool], Sequence[Route]] = {}
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
        if node not in self._regressors:
            rule = self.answer_ring.rules[node]
            self._regressors[node] = rule.compute(*map(self.key, rule.inputs))
        return self._regressors[node]

    def _lifted(self, node: str) -> Body | None:
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
        found = self._routes.get((node, assembled))
        if found is None:
            found = self._routes[node, assembled] = self._routes_to(node, assembled)
        return found

    def _routes_to(self, node: str, assembled: bool) -> Sequence[Route]:
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
            together = partial(euler_lagrange.torque, self.robot, k=quantity.index[0] - 1)
            return (*lagrange, Route((*MODEL, *self.robot.actions.resistance), together))
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

    def _routes_of_model(self, node: str) -> tuple[Route, ...]:
        if node == "D":
            return (Route(("tau",), self._inertia), Route(("K",), self._inertia_from_energy))
        if node == "g":
            of_energy = partial(euler_lagrange.gravity_vector, self.robot)
            return (Route(("tau",), self._gravity), Route(("P",), of_energy))
        return (
            Route(("tau", *self.robot.actions.resistance), self._coriolis),
            Route(("D",), lambda D: self._coriolis_matrix(D) @ velocities(self.robot)),
            Route(("D",), self._coriolis_entry_by_entry),
        )

    # -- the vectorized form, from what students have ----------------------------------------------

    def linear(self, tau: Matrix) -> bool:
        """Whether τ is linear in q̈."""
        ring = self.answer_ring.ring
        D = euler_lagrange.inertia_from_torque(self.robot, tau)
        return not any(_has_dots(ring, entry, 2) for entry in D.entries)

    def _inertia(self, tau: Matrix) -> Matrix | None:
        return euler_lagrange.inertia_from_torque(self.robot, tau) if self.linear(tau) else None

    def _gravity(self, tau: Matrix) -> Matrix | None:
        return euler_lagrange.gravity_from_torque(self.robot, tau) if self.linear(tau) else None

    def _coriolis(self, tau: Matrix, friction: Matrix | None = None) -> Matrix | None:
        if not self.linear(tau):
            return None
        g = euler_lagrange.gravity_from_torque(self.robot, tau)
        return euler_lagrange.coriolis_from_torque(self.robot, tau, g, friction)

    def _inertia_from_energy(self, K: Expr) -> Matrix | None:
        D = euler_lagrange.inertia_from_energy(self.robot, K)
        return None if any(_has_dots(self.answer_ring.ring, e, 1) for e in D.entries) else D

    def _symbols(self, D: Matrix) -> Any:
        return euler_lagrange.christoffel_symbols(self.robot, D)

    def _coriolis_matrix(self, D: Matrix) -> Matrix:
        return euler_lagrange.coriolis_matrix(self.robot, self._symbols(D))

    def _coriolis_entry_by_entry(self, D: Matrix) -> Matrix | None:
        """Σ_i ∂D/∂q_i q̇_i q̇ - ½ ∂(q̇ᵀ D q̇)/∂q of a D that is not symmetric: each d_ij from its own place."""
        if D.rows == D.T.rows:
            return None
        ring, rates = D.ring, velocities(self.robot)
        partials = [D.map(partial(ring.diff, k=k)) @ rates for k in range(self.robot.n)]
        moved = [
            ring.dot([moving.entries[k] for moving in partials], rates.entries) for k in range(self.robot.n)
        ]
        halves = [(rates.T @ moving).entries[0] * euler_lagrange.HALF for moving in partials]
        return Matrix.column(ring, [a - b for a, b in zip(moved, halves, strict=True)])


def _has_dots(ring: Any, expr: Expr, dots: int) -> bool:
    if not expr.poly:
        return False
    degrees = expr.poly.degrees()
    return any(degrees[ring.symbol_indices[(name, dots)]] > 0 for name in ring.names)
