"""The derivation as a graph of rules, and how it is evaluated.

A rule is a name, the names of its inputs and a pure function of them.  Names are
those of the answer file: `H2`, `Jv1`, `Kv1`, `K`, `dLdqd1`, `tau`, `D`; a body's
index is its name, a coordinate's its place.  `course_rules` is the derivation as
the textbook goes; a `Derivation` evaluates rules on demand, each once.  Values put
in at the start stand for their rules, so that what follows from them follows.

To add a quantity, write its formula in `dynsolve.derivation` and its rule here.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix, vstack
from dynsolve.derivation import (
    energy,
    inertia,
    jacobian,
    kinematics,
    lagrangian,
    link_frame,
    torque,
    vectorized,
)
from dynsolve.robot.model import AxesKind, Body, Robot

Value = Expr | Matrix | vectorized.Christoffel
"""What a rule gives: a scalar, a matrix, or the Christoffel symbols."""


@dataclass(frozen=True, slots=True)
class Rule:
    """name = compute(*inputs)"""

    name: str
    inputs: tuple[str, ...]
    compute: Callable[..., Any]


class Derivation(Mapping[str, Any]):
    """The values of a graph of rules, each computed when first asked for.

    >>> from dynsolve.derivation.graph import Derivation, Rule
    >>> graph = Derivation([Rule("a", (), lambda: 2), Rule("b", ("a",), lambda a: a + 1)])
    >>> graph["b"], Derivation(graph.rules.values(), {"a": 5})["b"]
    (3, 6)
    """

    def __init__(self, rules: Any, given: Mapping[str, Any] | None = None) -> None:
        self.rules: dict[str, Rule] = {rule.name: rule for rule in rules}
        self._values: dict[str, Any] = dict(given or {})

    def __getitem__(self, name: str) -> Any:
        if name not in self._values:
            rule = self.rules[name]
            self._values[name] = rule.compute(*(self[i] for i in rule.inputs))
        return self._values[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.rules)

    def __len__(self) -> int:
        return len(self.rules)


def derive(robot: Robot) -> Derivation:
    """The derivation of a robot, with the fast rules in place of the textbook's where both give the same."""
    return Derivation([*course_rules(robot), *link_frame_rules(robot)])


def course_rules(robot: Robot) -> Iterator[Rule]:
    """Every rule of the textbook's derivation, in its order."""
    yield from _kinematics(robot)
    if not robot.bodies:
        return
    for body in robot.bodies:
        yield from _body(robot, body)
    yield from _energies(robot)
    yield from _euler_lagrange(robot)
    yield from _vectorized(robot)


def _kinematics(robot: Robot) -> Iterator[Rule]:
    yield Rule("H0", (), partial(kinematics.base_transform, robot))
    for joint in robot.joints:
        i = joint.index
        yield Rule(f"A{i}", (), partial(kinematics.dh_matrix, robot, joint))
        yield Rule(f"H{i}", (f"H{i - 1}", f"A{i}"), kinematics.frame)
    frames = frame_names(robot, len(robot.joints))

    def tip(*H: Matrix) -> tuple[Matrix, Matrix]:
        return jacobian.jacobian(robot, H, kinematics.origin(H[-1]), len(robot.joints))

    yield Rule("Jv", frames, lambda *H: tip(*H)[0])
    yield Rule("Jw", frames, lambda *H: tip(*H)[1])
    yield Rule("J", ("Jv", "Jw"), vstack)


def frame_names(robot: Robot, link: int) -> tuple[str, ...]:
    """H0..H<link>"""
    return tuple(f"H{i}" for i in range(link + 1))


def _body(robot: Robot, body: Body) -> Iterator[Rule]:
    b, link = body.name, body.link
    frames = frame_names(robot, link)
    ring = robot.ring
    relative = inertia.axes_in_link

    def central(H: Matrix) -> Matrix:
        return inertia.central_inertia(body, relative(robot, body, H))

    yield Rule(f"rc{b}", (f"H{link}",), lambda H: kinematics.point(H, body.center))
    yield Rule(f"Jv{b}", (*frames, f"rc{b}"), lambda *x: jacobian.jacobian(robot, x[:-1], x[-1], link)[0])
    yield Rule(f"Jw{b}", (*frames, f"rc{b}"), lambda *x: jacobian.jacobian(robot, x[:-1], x[-1], link)[1])
    yield Rule(f"v{b}", (f"Jv{b}",), partial(energy.velocity, robot))
    yield Rule(f"w{b}", (f"Jw{b}",), partial(energy.velocity, robot))
    yield Rule(f"R{b}", (f"H{link}",), lambda H: inertia.body_rotation(robot, body, H))
    yield Rule(f"I_body{b}", (f"H{link}",), central)
    yield Rule(f"I{b}", (f"R{b}", f"I_body{b}"), inertia.base_inertia)
    yield Rule(f"P{b}", (f"rc{b}",), partial(energy.potential_energy, robot, body.mass))
    yield Rule(f"Kv{b}", (f"v{b}",), partial(energy.linear_energy, body.mass))
    if body.is_point:
        yield Rule(f"Kw{b}", (), lambda: ring.zero)
    else:
        yield Rule(f"Kw{b}", (f"w{b}", f"I{b}"), energy.rotational_energy)
    yield Rule(f"K{b}", (f"Kv{b}", f"Kw{b}"), lambda v, w: v + w)


def _energies(robot: Robot) -> Iterator[Rule]:
    names = [body.name for body in robot.bodies]
    yield Rule("P", tuple(f"P{b}" for b in names), lambda *parts: energy.total(robot.ring, parts))
    yield Rule("K", tuple(f"K{b}" for b in names), lambda *parts: energy.total(robot.ring, parts))
    yield Rule("L", ("K", "P"), lagrangian.lagrangian)


def _euler_lagrange(robot: Robot) -> Iterator[Rule]:
    for q in robot.coordinates:
        k = q.index
        yield Rule(f"dLdqd{k}", ("L",), partial(lagrangian.momentum, k=k - 1))
        yield Rule(f"ddt{k}", (f"dLdqd{k}",), lagrangian.momentum_rate)
        yield Rule(f"dLdq{k}", ("L",), partial(lagrangian.slope, k=k - 1))
        yield Rule(f"tau{k}", (f"ddt{k}", f"dLdq{k}"), torque.generalized_force)
    forces = tuple(f"tau{q.index}" for q in robot.coordinates)
    yield Rule("tau", forces, lambda *parts: torque.force_vector(robot, parts))


def _vectorized(robot: Robot) -> Iterator[Rule]:
    yield Rule("D", ("tau",), partial(vectorized.inertia_from_torque, robot))
    yield Rule("christoffel", ("D",), partial(vectorized.christoffel_symbols, robot))
    yield Rule("C", ("christoffel",), partial(vectorized.coriolis_matrix, robot))
    yield Rule("g", ("tau",), partial(vectorized.gravity_from_torque, robot))
    yield Rule("Cqd", ("tau", "g"), partial(vectorized.coriolis_from_torque, robot))
    yield Rule("g_direct", ("P",), partial(vectorized.gravity_vector, robot))


def link_frame_rules(robot: Robot) -> Iterator[Rule]:
    """The rules that take K_v and K_ω from Jacobians in the link's own frame, and D from them."""
    if not robot.bodies:
        return
    ring = robot.ring
    yield Rule("link_jacobians", (), lambda: tuple(link_frame.link_jacobians(robot)))
    for body in robot.bodies:
        b = body.name
        yield Rule(f"Dv{b}", ("link_jacobians",), partial(_linear_part, body))
        yield Rule(
            f"Dw{b}", ("link_jacobians", f"I_body{b}", f"H{body.link}"), partial(_angular_part, robot, body)
        )
        yield Rule(f"Kv{b}", (f"Dv{b}",), partial(_quadratic, robot))
        if body.is_point:
            yield Rule(f"Kw{b}", (), lambda: ring.zero)
        else:
            yield Rule(f"Kw{b}", (f"Dw{b}",), partial(_quadratic, robot))
    parts = tuple(f"D{kind}{body.name}" for body in robot.bodies for kind in "vw")
    yield Rule("D_direct", parts, partial(_matrix_sum, robot))


def _linear_part(body: Body, jacobians: tuple[link_frame.LinkJacobian, ...]) -> Matrix:
    return link_frame.linear_inertia(jacobians[body.link - 1].at(body.center)).scale(body.mass)


def _angular_part(
    robot: Robot, body: Body, jacobians: tuple[link_frame.LinkJacobian, ...], tensor: Matrix, H: Matrix
) -> Matrix:
    if body.is_point:
        return Matrix.zero(robot.ring, robot.n, robot.n)
    relative = inertia.axes_in_link(robot, body, H)
    return link_frame.rotational_inertia(jacobians[body.link - 1].angular, relative @ tensor @ relative.T)


def _quadratic(robot: Robot, part: Matrix) -> Expr:
    """½ q̇ᵀ D q̇"""
    rates = energy.velocities(robot)
    return (rates.T @ part @ rates)[0, 0] / 2


def _matrix_sum(robot: Robot, *parts: Matrix) -> Matrix:
    total = Matrix.zero(robot.ring, robot.n, robot.n)
    for part in parts:
        total = total + part
    return total


@dataclass(frozen=True, slots=True)
class Agreement:
    """Whether the two ways to D, C and g give the same, exactly."""

    inertia: bool
    coriolis: bool
    gravity: bool
    skew_symmetric: bool

    @property
    def holds(self) -> bool:
        """All of them."""
        return self.inertia and self.coriolis and self.gravity and self.skew_symmetric


def agreement(robot: Robot, values: Derivation) -> Agreement:
    """Hold what is read off from τ against what is assembled directly.

    D, C q̇ and g must be equal; Ḋ - 2C must be skew-symmetric.
    """
    rates = energy.velocities(robot)
    C: Matrix = values["C"]
    skew = values["D"].map(robot.ring.time_derivative) - C.scale(robot.ring.constant(2))
    return Agreement(
        inertia=values["D"] == values["D_direct"],
        coriolis=C @ rates == values["Cqd"],
        gravity=values["g"] == values["g_direct"],
        skew_symmetric=(skew + skew.T).is_zero,
    )


def given_axes_agree(robot: Robot, body: Body, values: Derivation) -> bool:
    """Whether a given R_b that does not turn with its link gives the same kinetic energy all the same.

    Holds the textbook's K_ω, with R_b as given, against that of the frame which
    coincides with it at q = 0 and turns with the link.
    """
    if body.axes.kind is not AxesKind.BASE or body.is_point:
        return True
    w, tensor = values[f"w{body.name}"], values[f"I{body.name}"]
    return energy.rotational_energy(w, tensor) == _quadratic(robot, values[f"Dw{body.name}"])
