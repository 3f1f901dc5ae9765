"""Equilibria, and what balances gravity, as formulas."""

from __future__ import annotations

from functools import cached_property

from dynsolve.algebra.angles import angle_node
from dynsolve.algebra.factors import is_positive
from dynsolve.algebra.ring import Expr
from dynsolve.derivation.elimination import turn_of
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.singular.sets import Alternative
from dynsolve.derivation.singular.zeros import Condition
from dynsolve.explain.set_forms import SetForms
from dynsolve.notation.tree import Function, Node, Number, Quotient, equation
from dynsolve.questions.equilibria.solving import SpecialCase


class EquilibriaForms(SetForms):
    """The alternatives and the conditions of one robot."""

    @cached_property
    def equilibria(self) -> tuple[tuple[Node, ...], ...]:
        """The equilibria: alternatives of expressions that are 0 together; none where they are too long."""
        return self.alternatives("equilibria")

    @cached_property
    def excluded(self) -> tuple[tuple[tuple[Node, ...], ...], ...]:
        """Of each of the equilibria the sets within it at which constraints do not hold the forces."""
        found = self.values["equilibria"]
        if isinstance(found, Skipped):
            return ()
        return tuple(tuple(tuple(map(self.condition, one)) for one in sets) for sets in found.excluded)

    def relations(self, case: Alternative, zeros: tuple[Node, ...]) -> list[Node]:
        """What is 0 in a case, as equations: the tangent of an angle where that has one value."""
        return [
            self._tangent(one) or equation(value, Number(0)) for one, value in zip(case, zeros, strict=True)
        ]

    def _tangent(self, condition: Condition) -> Node | None:
        """tan θ = b/a where a sin θ = b cos θ, and a is not 0."""
        turn = turn_of(condition.expr)
        if turn is None or turn.is_one_sided or not turn.rest.is_zero:
            return None
        sign = next((sign for sign in (1, -1) if is_positive(turn.sine * sign)), 0)
        ring, form = condition.expr.ring, self.compactor(condition.expr.ring).form
        common = turn.sine.poly.gcd(turn.cosine.poly)
        above, below = (form(Expr(ring, part.poly / common) * sign) for part in (-turn.cosine, turn.sine))
        angle = Function("tan", angle_node(turn.pair.angle, ring.names))
        return equation(angle, above if below == Number(1) else Quotient(above, below)) if sign else None

    def special_exceptions(self, case: SpecialCase) -> tuple[tuple[Node, ...], ...]:
        """The sets that are no equilibria for special parameters."""
        return tuple(tuple(map(self.condition, one)) for one in case.excluded)

    def special_forces(self, case: SpecialCase) -> tuple[Node, ...] | None:
        """What must be 0 for special parameters, without what never is; None where it cannot be."""
        assert case.forces is not None
        if any(is_positive(force) or is_positive(-force) for force in case.forces):
            return None
        return tuple(dict.fromkeys(map(self.vanishing, case.forces)))

    @cached_property
    def balance(self) -> tuple[Node, ...]:
        """What must be 0 for gravity to be balanced; none where it is too long."""
        found = self.values["balance"]
        if isinstance(found, Skipped):
            return ()
        return tuple(map(self.compactor(self.robot.ring).form, found))
