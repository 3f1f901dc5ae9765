"""Exact values put for symbols, in expressions (`Substitution`) and in a whole robot (`robot_with`)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from fractions import Fraction
from functools import cached_property
from typing import Any

from dynsolve.algebra.angles import Angle, angle_from_tree, angle_node
from dynsolve.algebra.build import build_ring
from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.generators import Generator
from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.rationals import rational_value
from dynsolve.algebra.ring import Ring
from dynsolve.algebra.ring_values import value_of
from dynsolve.notation.tree import (
    Degrees,
    Function,
    Node,
    Number,
    Parenthesized,
    Quotient,
    Symbol,
    number,
)
from dynsolve.notation.tree_values import sign
from dynsolve.notation.walk import mapped
from dynsolve.robot.actions import Actions, Spring
from dynsolve.robot.candidates import Candidate
from dynsolve.robot.mechanism import BodyTurn, GivenModel
from dynsolve.robot.model import AxisTurns, Body, Joint, Robot
from dynsolve.robot.model_questions import ModelQuestions
from dynsolve.robot.questions import Load, Questions, State

Replacements = Mapping[tuple[str, int], Node]
"""Constant formulas by (name, number of dots): ("theta1", 1) is a velocity."""


def replaced(node: Node, values: Replacements) -> Node:
    """A tree with formulas in place of symbols.

    >>> replaced(Quotient(Symbol("L1"), Number(3)), {("L1", 0): Number(2, 5)}).numerator
    Number(p=2, q=5, decimal=False)
    """
    return mapped(
        node, lambda part: values.get((part.name, part.dots), part) if isinstance(part, Symbol) else part
    )


class Substitution:
    """Carries exact expressions of one ring over into a ring in which symbols have values.

    The map respects sums and products.

    A coordinate that has a value is none in the new ring, so either all of them have
    one or none.  The new ring also holds the formulas `more`.  Raises AlgebraError where
    a value leaves a formula without a meaning: a denominator that becomes 0, the root of a negative number.

    >>> ring = build_ring([], [Symbol("L"), Symbol("m")])
    >>> put = Substitution(ring, {("L", 0): Number(1, 2)})
    >>> put(ring.symbol("L") * ring.symbol("m"))
    Expr(1/2*m)
    """

    def __init__(
        self, source: Ring, values: Replacements, angles: Iterable[Angle] = (), more: Iterable[Node] = ()
    ) -> None:
        self.source, self.values = source, values
        coordinates = [(name, kind) for name, kind in source.coordinates if (name, 0) not in values]
        basic = [self.angle(pair.angle) for pair in source.pairs]
        trees = [*more, *(tree for g in source.generators for tree in self._needs(g))]
        every = [*basic, *(self.angle(angle) for angle in angles)]
        self.ring = build_ring(coordinates, trees, every, basic)

    def angle(self, angle: Angle) -> Angle:
        """An angle with values in it; numbers that are left are radians."""
        known = {name for name, dots in self.values if not dots}
        if not any(name in known for atom, _ in angle.terms for name, _ in atom):
            return angle
        return angle_from_tree(replaced(angle_node(angle), self.values), radians=True)

    def _needs(self, g: Generator) -> Iterator[Node]:
        """The formulas that the new ring must hold so that a generator has a value in it."""
        match g.kind:
            case "symbol" if not g.dots or (g.name, g.dots) in self.values:
                yield replaced(Symbol(g.name, g.dots), self.values)
            case "root":
                yield self._root(g)
            case "inverse" if g.index in self.source.inverses:
                yield Quotient(Number(1), self._denominator(g))
            case "constant":
                yield Function("cos", angle_node(g.angle))
            case "function":
                yield self._function(g)

    def _root(self, g: Generator) -> Node:
        assert g.node is not None
        return Function("sqrt", replaced(g.node, self.values))

    def _function(self, g: Generator) -> Node:
        """The sign of a rate; of one that has a value it is a number."""
        assert isinstance(g.node, Function)
        argument = replaced(g.node.argument, self.values)
        value = rational_value(argument)
        return Function(g.node.name, argument) if value is None else number(Fraction(int(sign(value))))

    def _denominator(self, g: Generator) -> Node:
        tree = Compactor(self.source).form(Expr(self.source, self.source.inverses[g.index]))
        return replaced(tree, self.values)

    @cached_property
    def _images(self) -> tuple[Any, ...]:
        """The image of every generator."""
        return tuple(self._image(g).poly for g in self.source.generators)

    def _image(self, g: Generator) -> Expr:
        match g.kind:
            case "sin":
                return self.ring.sin(self.angle(g.angle))
            case "cos" | "constant":
                return self.ring.cos(self.angle(g.angle))
            case "symbol":
                return value_of(self.ring, replaced(Symbol(g.name, g.dots), self.values))
            case "root":
                return value_of(self.ring, self._root(g))
            case "function":
                return value_of(self.ring, self._function(g))
            case "inverse" if g.index in self.source.inverses:
                return value_of(self.ring, Quotient(Number(1), self._denominator(g)))
        return self.ring.zero  # an inverse that was set aside and never used

    def __call__(self, expr: Expr) -> Expr:
        """The expression with the values in it."""
        if expr.is_number:
            return self.ring.constant(expr.number)
        return Expr(self.ring, self.ring.reduce(expr.poly.compose(*self._images, ctx=self.ring.ctx)))

    def matrix(self, matrix: Matrix) -> Matrix:
        """The matrix with the values in it."""
        return Matrix.of(self.ring, (map(self, row) for row in matrix.rows))


# -- a robot with numbers for some of its parameters: a robot like any other -----------------------


def robot_with(robot: Robot, values: Replacements, more: Iterable[Node] = ()) -> Robot:
    """The robot with these values for its parameters, its ring holding the formulas `more`, too.

    Raises AlgebraError where a formula has no meaning with them.
    """
    angles = [angle for joint in robot.joints for angle in (joint.theta, joint.alpha)]
    put = Substitution(robot.ring, values, angles, more)
    return Robot(
        ring=put.ring,
        convention=robot.convention,
        coordinates=robot.coordinates,
        joints=tuple(_joint(joint, put) for joint in robot.joints),
        bodies=tuple(_body(body, put) for body in robot.bodies),
        gravity=put.matrix(robot.gravity),
        base_rotation=put.matrix(robot.base_rotation),
        base_position=put.matrix(robot.base_position),
        base_turns=_axis_turns(robot.base_turns, put),
        parameters=tuple(name for name in robot.parameters if (name, 0) not in values),
        questions=_questions(robot.questions, put),
        actions=_actions(robot.actions, put),
        given=None if robot.given is None else _given(robot.given, put),
    )


def _actions(acting: Actions, put: Substitution) -> Actions:
    """What acts, with values in it."""
    return replace(
        acting,
        friction=tuple(
            replace(one, viscous=put(one.viscous), coulomb=put(one.coulomb)) for one in acting.friction
        ),
        dampers=tuple(replace(one, damping=put(one.damping), of=put(one.of)) for one in acting.dampers),
        springs=tuple(_spring(spring, put) for spring in acting.springs),
        motors=tuple(replace(m, inertia=put(m.inertia), ratio=put(m.ratio)) for m in acting.motors),
    )


def _spring(spring: Spring, put: Substitution) -> Spring:
    law = spring.law
    if law is not None:
        law = replace(law, stiffness=put(law.stiffness), of=put(law.of), rest=put(law.rest))
    return replace(spring, energy=put(spring.energy), law=law)


def _questions(questions: Questions, put: Substitution) -> Questions:
    """What is asked, with values in it."""
    task = questions.task
    values = ((name, dots, replaced(value, put.values)) for name, dots, value in questions.state.values)
    return replace(
        questions,
        points=tuple(replace(point, position=put.matrix(point.position)) for point in questions.points),
        task=task and replace(task, entries=tuple(replaced(entry, put.values) for entry in task.entries)),
        loads=tuple(_load(load, put) for load in questions.loads),
        constraints=tuple(
            replace(one, entry=replaced(one.entry, put.values)) for one in questions.constraints
        ),
        state=State(tuple(values)),
        candidates=tuple(_candidate(one, put) for one in questions.candidates),
        velocity=questions.velocity and put.matrix(questions.velocity),
        acceleration=questions.acceleration and put.matrix(questions.acceleration),
        weights=questions.weights and put.matrix(questions.weights),
        model=_model(questions.model, put),
    )


def _model(model: ModelQuestions, put: Substitution) -> ModelQuestions:
    """What is asked of the model, with values in it."""
    return replace(
        model,
        linearize=tuple((name, dots, replaced(value, put.values)) for name, dots, value in model.linearize),
        balanced=model.balanced and put.matrix(model.balanced),
        steady=tuple((name, replaced(rate, put.values)) for name, rate in model.steady),
        assumed=_bounds(model.assumed, put),
    )


def _bounds(bounds: Iterable[Bound], put: Substitution) -> tuple[Bound, ...]:
    return tuple(Bound(put(bound.value), bound.is_strict) for bound in bounds)


def _candidate(candidate: Candidate, put: Substitution) -> Candidate:
    return replace(candidate, matrix=put.matrix(candidate.matrix), assumed=_bounds(candidate.assumed, put))


def _load(load: Load, put: Substitution) -> Load:
    return replace(
        load,
        position=put.matrix(load.position),
        force=put.matrix(load.force),
        moment=put.matrix(load.moment),
        axes=None if load.axes is None else put.matrix(load.axes),
    )


def _joint(joint: Joint, put: Substitution) -> Joint:
    theta, d, a, alpha = (_written(node, put.values) for node in joint.written)
    return replace(
        joint,
        theta=put.angle(joint.theta),
        d=put(joint.d),
        a=put(joint.a),
        alpha=put.angle(joint.alpha),
        written=(theta, d, a, alpha),
    )


def _written(node: Node, values: Replacements) -> Node:
    """A cell of the table with values in it; one that is a number is written as one."""
    if isinstance(node, Symbol | Number | Degrees):
        tree = replaced(node, values)
    else:
        bare = {key: Parenthesized(value) if not isinstance(value, Number) else value
                for key, value in values.items()}  # fmt: skip
        tree = replaced(node, bare)
    value: Fraction | None = rational_value(tree)
    return tree if value is None else number(value)


def _body(body: Body, put: Substitution) -> Body:
    shape = body.shape
    if shape is not None:
        shape = replace(shape, dimensions=tuple((key, put(value)) for key, value in shape.dimensions))
    return replace(
        body,
        mass=put(body.mass),
        center=put.matrix(body.center),
        axes=replace(
            body.axes, rotation=put.matrix(body.axes.rotation), turns=_axis_turns(body.axes.turns, put)
        ),
        inertia=None if body.inertia is None else put.matrix(body.inertia),
        shape=shape,
        about_point=None if body.about_point is None else put.matrix(body.about_point),
        turns=tuple(_turn(turn, put) for turn in body.turns),
    )


def _axis_turns(turns: AxisTurns, put: Substitution) -> AxisTurns:
    return tuple((axis, _written(angle, put.values)) for axis, angle in turns)


def _turn(turn: BodyTurn, put: Substitution) -> BodyTurn:
    return BodyTurn(
        axis=put.matrix(turn.axis),
        rates=put.matrix(turn.rates),
        rotation=put.matrix(turn.rotation),
        angle=_written(turn.angle, put.values),
    )


def _given(given: GivenModel, put: Substitution) -> GivenModel:
    D = None if given.D is None else put.matrix(given.D)
    K, P, L = (None if energy is None else put(energy) for energy in (given.K, given.P, given.L))
    return GivenModel(D, K, P, L)
