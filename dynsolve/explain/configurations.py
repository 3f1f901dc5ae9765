"""Singular configurations and the inverse kinematics as formulas."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cached_property
from math import lcm
from typing import TYPE_CHECKING, Any

from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.positivity import is_positive
from dynsolve.algebra.ring import Ring
from dynsolve.algebra.trig_factor import ratio, trig_factors
from dynsolve.derivation.configuration_check import Condition as Equality
from dynsolve.derivation.configuration_check import Conditions
from dynsolve.derivation.configurations import Inverse, without_number
from dynsolve.derivation.graph import Derivation, Skipped
from dynsolve.derivation.inverse.solving import Relation as Equation
from dynsolve.derivation.inverse.subproblems import Solved
from dynsolve.derivation.singular.conditions import Condition
from dynsolve.derivation.singular.sets import SingularSet
from dynsolve.document import Prose
from dynsolve.explain.forms import Forms, is_numeric, leading_names, parallel_coordinates
from dynsolve.explain.inverse_formulas import InverseFormulas
from dynsolve.explain.writing import as_row, listed, side_by_side
from dynsolve.notation.build import cost, split_sign, times
from dynsolve.notation.python import to_python
from dynsolve.notation.tree import Matrix, Negative, Node, Number, Relation, Sum, Symbol, column, equation
from dynsolve.notation.walk import mapped
from dynsolve.robot.model import Robot

if TYPE_CHECKING:
    from dynsolve.explain.target import TargetForms


class ConfigurationForms:
    """The formulas of the rules `singular` and `inverse` of one robot."""

    def __init__(self, robot: Robot, values: Derivation) -> None:
        self.robot = robot
        self.values = values

    # -- singular configurations -------------------------------------------------------------------

    @cached_property
    def singular_set(self) -> SingularSet | None:
        """Where the Jacobian of the task loses rank; None where it is too long."""
        found = self.values["singular"]
        return found if isinstance(found, SingularSet) else None

    @cached_property
    def singular(self) -> tuple[tuple[Node, ...], ...]:
        """The alternatives: expressions that are 0 together."""
        if self.singular_set is None:
            return ()
        return tuple(tuple(map(self.condition, one)) for one in self.singular_set.alternatives)

    @cached_property
    def equilibria(self) -> tuple[tuple[Node, ...], ...]:
        """The equilibria: alternatives of expressions that are 0 together; none where they are too long."""
        found = self.values["equilibria"]
        if isinstance(found, Skipped):
            return ()
        return tuple(tuple(map(self.condition, one)) for one in found.alternatives)

    def inequality(self, bound: Bound) -> Relation:
        """l W² > g: what is positive of it on one side, what is negative on the other."""
        ring = bound.value.ring
        sides: tuple[dict[Any, Any], dict[Any, Any]] = {}, {}
        for exponents, factor in bound.value.poly.to_dict().items():
            sides[factor < 0][exponents] = abs(factor)
        form = self.compactor(ring).form
        left, right = (form(Expr(ring, ring.ctx.from_dict(side))) for side in sides)
        return Relation((left, right), (">" if bound.is_strict else "≥",))

    def existence(self, name: str, exist: Sequence[Sequence[Bound]]) -> Iterator[Prose]:
        """For which parameters the alternatives of a set are there that are not for all."""
        for case, bounds in zip(self.alternatives(name), exist, strict=True):
            if bounds:
                together = side_by_side([equation(value, Number(0)) for value in case])
                yield (together, " has solutions where ", side_by_side([*map(self.inequality, bounds)]), ".")

    @cached_property
    def balance(self) -> tuple[Node, ...]:
        """What must be 0 for gravity to be balanced; none where it is too long."""
        found = self.values["balance"]
        if isinstance(found, Skipped):
            return ()
        ring = self.robot.ring
        form = Compactor(ring, leading_names(self.robot), decimal=is_numeric(self.robot)).form
        return tuple(map(form, found))

    @cached_property
    def reduced(self) -> tuple[tuple[Node, Node], ...]:
        """Both sides of the equations of motion without multipliers; none where they are too long."""
        found = self.values["reduced"]
        form = self.compactor(self.robot.ring).form
        return () if isinstance(found, Skipped) else tuple((form(a), form(b)) for a, b in found.equations)

    def conditions(self, name: str) -> tuple[tuple[Node, Node], ...]:
        """Both sides of equations that all hold, by the name of these."""
        return self.reduced if name == "reduced" else tuple((node, Number(0)) for node in self.balance)

    def alternatives(self, name: str) -> tuple[tuple[Node, ...], ...]:
        """The alternatives of a set of equations, by its name."""
        return self.equilibria if name == "equilibria" else self.singular

    @cached_property
    def lost(self) -> tuple[tuple[Matrix, ...], ...]:
        """At each alternative the directions that are lost, each a column."""
        if self.singular_set is None:
            return ()
        return tuple(
            tuple(column(*map(self.compactor(d[0].ring).form, d)) for d in loss.directions)
            for loss in self.singular_set.losses
        )

    def condition(self, condition: Condition) -> Node:
        """What is 0 where a condition holds, with whole coefficients but where the file has decimals."""
        whole = 1 if is_numeric(self.robot) else lcm(*(int(c.q) for c in condition.expr.poly.coeffs()))
        return self.zero(condition.expr * whole)

    def zero(self, expr: Expr) -> Node:
        """What is 0, with the sign that leaves fewer minus signs."""
        return self._signed(expr)[0]

    def vanishing(self, value: Expr) -> Node:
        """What is 0 where an expression is, without the factors that never are."""
        product = value.ring.one
        for factor, _ in trig_factors(value):
            if not is_positive(factor):
                product = product * factor
        return self.zero(product)

    def product(self, value: Expr) -> Node:
        """An expression as the product of its factors in sines and cosines."""
        product = value.ring.one
        shown: list[tuple[Node, int]] = []
        for factor, power in trig_factors(value):
            node, signed = self._signed(factor)
            shown.append((node, power))
            product = product * signed**power
        number = ratio(value, product)
        if not number.is_number:
            shown.append((self.compactor(value.ring).form(number), 1))
        return times(
            number.number if number.is_number else Fraction(1),
            sorted(shown, key=lambda part: (cost(part[0]), to_python(part[0]))),
        )

    def _signed(self, expr: Expr) -> tuple[Node, Expr]:
        """±expr with the sign that leaves fewer minus signs, as a formula and as it is."""
        form = self.compactor(expr.ring).form
        return min(((form(e), e) for e in (expr, -expr)), key=lambda both: _minus_signs(both[0]))

    # -- inverse kinematics ------------------------------------------------------------------------

    @cached_property
    def solved(self) -> Inverse | None:
        """The solution of the task; None where no closed form was found."""
        found = self.values["inverse"]
        return found if isinstance(found, Inverse) else None

    @property
    def without_number(self) -> str:
        """The first parameter that has no number, where `reach` has them; nothing where all have."""
        (task,) = self.values.rules["inverse"].inputs
        return without_number(self.robot, self.values[task])

    @cached_property
    def target(self) -> TargetForms | None:
        """What reaches the numbers of `reach`; None where it has none."""
        if self.robot.questions.target is None or isinstance(self.values["inverse"], Skipped):
            return None
        if self.without_number:
            return None
        from dynsolve.explain.target import TargetForms

        branches = None if self.solved is None else list(zip(self.inverse, self.when, strict=True))
        (task,) = self.values.rules["inverse"].inputs
        return TargetForms(self.robot, self.values[task], Forms(self.robot, self.values)(task), branches)

    @cached_property
    def inverse(self) -> tuple[dict[str, Node], ...]:
        """The branches: a formula for each coordinate, in the order in which they are solved for."""
        if self.solved is None:
            return ()
        steps = self.solved.solving.solved
        return tuple(
            {
                step.coordinate: self._written_out(self.solutions(step)[index])
                for step, index in zip(steps, branch.choice, strict=True)
            }
            for branch in self.solved.branches
        )

    @cached_property
    def when(self) -> tuple[Conditions, ...]:
        """Of each branch the conditions under which it gives r(q) = r."""
        if self.solved is None:
            return ()
        return tuple(tuple(map(self._equality, branch.when)) for branch in self.solved.branches)

    def _equality(self, relation: Equation) -> Equality:
        left, right = (self.inverse_formulas.form(side) for side in (relation.left, relation.right))
        return Equality((left, right), relation.is_angle)

    def _written_out(self, formula: Node) -> Node:
        """A formula with what is put for the names that were given on the way."""
        return mapped(formula, self._meant) if self._meanings else formula

    def _meant(self, part: Node) -> Node:
        return self._meanings.get(part.name, part) if isinstance(part, Symbol) else part

    @cached_property
    def _meanings(self) -> dict[str, Node]:
        """What each name stands for, in the values of the task and in coordinates."""
        found: dict[str, Node] = {}
        assert self.solved is not None
        for part in self.solved.solving.parts:
            for definition in part.definitions:
                value = self.inverse_formulas.form(definition.value)
                found[definition.name] = mapped(
                    value, lambda inner: found.get(inner.name, inner) if isinstance(inner, Symbol) else inner
                )
        return found

    def solutions(self, step: Solved) -> tuple[Node, ...]:
        """The solutions of a step, each as a formula."""
        return self.inverse_formulas.solutions(step)

    @cached_property
    def inverse_formulas(self) -> InverseFormulas:
        """The formulas of the steps."""
        assert self.solved is not None
        solving = self.solved.solving
        return InverseFormulas(self.compactor(solving.ring), solving.solved)

    def compactor(self, ring: Ring) -> Compactor:
        """The compactor of a ring of the search: the values of the task lead its sums, then masses."""
        named = (*self.robot.questions.reached, *ring.plan.signed, *leading_names(self.robot))
        leading = [name for name in dict.fromkeys(named) if ring.has_symbol(name)]
        return Compactor(ring, leading, parallel_coordinates(self.robot), decimal=is_numeric(self.robot))


def vanishing(conditions: tuple[Node, ...]) -> Node:
    """a = 0 and b = 0, in one line"""
    return as_row(listed([equation(value, Number(0)) for value in conditions]))


def _minus_signs(node: Node) -> int:
    """How many terms of a sum are negative; a sum that begins with a minus counts one more."""
    terms = node.terms if isinstance(node, Sum) else (node,)
    return sum(isinstance(term, Negative) for term in terms) + (split_sign(terms[0])[0] < 0)
