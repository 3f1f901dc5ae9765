"""Equilibria, and what balances gravity, as formulas."""

from __future__ import annotations

from fractions import Fraction
from functools import cached_property

from msgspec.structs import replace

from dynsolve.algebra.angles import Angle, angle_node, in_degrees
from dynsolve.algebra.factors import ratio, trig_factors
from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.linear_systems import MOST_DIGITS
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.sampling import Transfer
from dynsolve.derivation.elimination import turn_of
from dynsolve.derivation.existence import coordinates_in, discriminant, quadratic_of, square_of
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.singular.sets import Alternative
from dynsolve.derivation.singular.zeros import Condition
from dynsolve.notation.build import cost, times, total
from dynsolve.notation.tree import Function, Node, Number, Power, Quotient, Relation, Symbol, equation
from dynsolve.questions.equilibria.solving import Equilibria, SpecialCase, assumed_signs
from dynsolve.questions.equilibria.stability import by_coordinates, quarter_turns, turned
from dynsolve.questions.set_forms import SetForms, may_vanish
from dynsolve.robot.model import JointType


class EquilibriaForms(SetForms):
    """The alternatives and the conditions of one robot."""

    @cached_property
    def equilibria(self) -> tuple[tuple[Node, ...], ...]:
        """The equilibria: alternatives of expressions that are 0 together; none where they are too long."""
        found = self.values["equilibria"]
        if isinstance(found, Skipped):
            return ()
        return tuple(tuple(self._shortest(one, case, found) for one in case) for case in found.alternatives)

    def alternatives(self, name: str) -> tuple[tuple[Node, ...], ...]:
        """The alternatives of a set of equations, by its name."""
        return self.equilibria if name == "equilibria" else super().alternatives(name)

    def _shortest(self, condition: Condition, case: Alternative, found: Equilibria) -> Node:
        """What is 0 where a condition holds, or a row that is so beside fixed angles and lengths."""
        there = Transfer(self.robot.ring, condition.expr.ring)
        forms = [self.condition(condition)]
        for row in () if condition.fixes_coordinate else found.rows:
            value = there(row)
            for other in case:
                value = other.reduced(value) if other.fixes_coordinate else value
            if not value.is_zero and value == condition.expr * ratio(value, condition.expr):
                forms.append(self.condition(Condition(row)))
        return min(forms, key=cost)

    @cached_property
    def excluded(self) -> tuple[tuple[tuple[Node, ...], ...], ...]:
        """Of each of the equilibria the sets within it at which constraints do not hold the forces."""
        found = self.values["equilibria"]
        if isinstance(found, Skipped):
            return ()
        return tuple(tuple(tuple(map(self.condition, one)) for one in sets) for sets in found.excluded)

    def relations(self, case: Alternative, zeros: tuple[Node, ...]) -> list[Node]:
        """What is 0 in a case, as equations: an angle, its tangent, a length, where these have one value."""
        return [
            self._angle(one)
            or self._tangent(one)
            or self._sine(one)
            or self._length(one, case)
            or self._square(one)
            or self._quadratic(one)
            or equation(value, Number(0))
            for one, value in zip(case, zeros, strict=True)
        ]

    def _angle(self, condition: Condition) -> Node | None:
        """q = 180° where 1 + cos q = 0, or cos(q/2) = 0."""
        turn = turn_of(condition.expr)
        if turn is None or not turn.is_one_sided:
            return None
        rates = {rate for _, rate in turn.pair.angle.terms}
        factor = turn.cosine + turn.sine
        is_one = {factor, -factor} & {turn.rest} or (turn.rest.is_zero and rates == {Fraction(1, 2)})
        angle, degrees = turned(tuple(quarter_turns(condition)))[0] if is_one else (None, 0)
        if angle is None:
            return None
        moving, fixed = by_coordinates(angle, condition.expr.ring.names)
        return equation(
            angle_node(moving, condition.expr.ring.names),
            angle_node(fixed + Angle(degrees=Fraction(degrees))),
        )

    def _sine(self, condition: Condition) -> Node | None:
        """cos θ = b/a where a cos θ = b, neither depends on coordinates, and a is not 0."""
        turn = turn_of(condition.expr)
        ring = condition.expr.ring
        if turn is None or not turn.is_one_sided or turn.rest.is_zero:
            return None
        factor, name = (turn.sine, "sin") if turn.cosine.is_zero else (turn.cosine, "cos")
        if any(map(ring.depends_on_coordinates, (factor, turn.rest))):
            return None
        return self._quotient(Function(name, angle_node(turn.pair.angle, ring.names)), -turn.rest, factor)

    def _length(self, condition: Condition, case: Alternative) -> Node | None:
        """x = b/a where a x = b, and a is a parameter that is not 0; of an angle where b is one, too.

        So also q₂ = n q₁ where no sine stands beside: of one that nothing else in the case fixes, if there
        is one.  Nothing of x = 0.
        """
        ring, expr = condition.expr.ring, condition.expr
        others = {name for one in case if one is not condition for name in coordinates_in(one.expr)}
        is_linear = all(ring.generators[i].kind == "symbol" for i in expr.used)
        found = []
        for q in self.robot.coordinates:
            factor = ring.coefficient(expr, q.name, 0)
            rest = expr - factor * ring.symbol(q.name)
            is_alone = q.type is JointType.PRISMATIC or is_linear or not ring.depends_on_coordinates(rest)
            if (
                is_alone
                and ring.coefficient(rest, q.name, 0).is_zero
                and not (factor.is_zero or rest.is_zero or ring.depends_on_coordinates(factor))
            ):
                found.append((q.name, rest, factor))
        ways = sorted(found, key=lambda one: (one[0] in others, not one[2].is_number))
        solved = next((self._quotient(Symbol(name), -rest, factor) for name, rest, factor in ways), None)
        if isinstance(solved, Relation) and (ways[0][0], "revolute") in ring.coordinates:
            return replace(solved, parts=(solved.parts[0], in_degrees(solved.parts[1], ring.names)))
        return solved

    def _square(self, condition: Condition) -> Node | None:
        """x² = n/m where m x² = n, and m is not 0."""
        found = square_of(condition.expr)
        if found is None:
            return None
        index, factor, rest = found
        name = condition.expr.ring.generators[index].name
        return self._quotient(Power(Symbol(name), Number(2)), -rest, factor)

    def _quadratic(self, condition: Condition) -> Node | None:
        """y = -b/(2a) ± √(b² - 4a c)/(2a) where a y² + b y + c = 0, and a is not 0."""
        found = self.roots_of(condition)
        if found is None:
            return None
        index, a, b, c = found
        ring = a.ring
        halves = 2 if all(int(number.p) % 2 == 0 for number in b.poly.coeffs()) else 1
        below = a * Fraction(2, halves)
        middle = self._quotient(Symbol(ring.generators[index].name), -b / halves, below)
        form = self.compactor(ring).form
        root = Function("sqrt", form(discriminant(a, b, c) / halves**2))
        size: Node = root if below == ring.one else Quotient(root, form(below))
        assert isinstance(middle, Relation)
        return Relation((*middle.parts, size), ("=", "±"))

    def roots_of(self, condition: Condition) -> tuple[int, Expr, Expr, Expr] | None:
        """(generator y, a, b, c) of a y² + b y + c = 0 with a > 0; None of any other."""
        found = quadratic_of(condition.expr)
        if found is None:
            return None
        index, *parts = found
        signs = assumed_signs(self.robot, Transfer(self.robot.ring, condition.expr.ring))
        shared = self.content(parts)
        for sign in (1, -1):
            if signs.is_positive(parts[0] * sign):
                a, b, c = (part * (sign / shared) for part in parts)
                return index, a, b, c
        return None

    def positive_root(self, condition: Condition, value: Expr) -> int:
        """1 where m y + n is positive at the greater root y, negative at the other; -1; 0 if unknown."""
        found = self.roots_of(condition)
        if found is None:
            return 0
        index, a, b, c = found
        ring = a.ring
        y = ring.generator(index)
        m = ring.coefficient(value, ring.generators[index].name, 0)
        n = value - m * y
        if any(map(ring.depends_on_coordinates, (m, n))):
            return 0
        signs = assumed_signs(self.robot, Transfer(self.robot.ring, ring)).beside(
            Bound(discriminant(a, b, c))
        )
        product = a * n * n - m * n * b + m * m * c  # of both values, times a
        between = [sign for sign in (1, -1) if signs.is_positive(m * sign) and signs.is_positive(-product)]
        return next(iter(between), 0)

    def _quotient(self, letter: Node, above: Expr, below: Expr) -> Node | None:
        """letter = s₀ - g M/k, cancelled; nothing where the lower part may be 0, and that is not told."""
        ring, form = above.ring, self.compactor(above.ring).form
        for index, inverted in ring.inverses.items():
            highest = max(int(part.poly.degrees()[index]) for part in (above, below))
            above, below = (part * Expr(ring, inverted) ** max(highest, 0) for part in (above, below))
        signs = assumed_signs(self.robot, Transfer(self.robot.ring, ring))
        sign = next((sign for sign in (1, -1) if signs.is_positive(below * sign)), 0)
        if not sign and all(signs.is_positive(one) or one in self._nonzero for one, _ in trig_factors(below)):
            numbers = [*above.poly.coeffs(), *below.poly.coeffs()]
            sign = 1 if 2 * sum(number > 0 for number in numbers) >= len(numbers) else -1
        common = above.poly.gcd(below.poly)
        parts = [Expr(ring, part.poly / common) for part in (above, below)]
        if not sign:
            return None
        above, below = (part * (sign / self.content(parts)) for part in parts)
        upper, lower = form(above), form(below)
        shortest: Node = Quotient(upper, lower)
        if below.is_number and (self.robot.has_decimals or below == ring.one):
            value = above / below.number
            ends = all(10**MOST_DIGITS % int(number.q) == 0 for number in value.poly.coeffs())
            return equation(letter, form(value) if ends else shortest)
        apart, rest = (Expr(ring, part) for part in divmod(above.poly, below.poly))
        if not (apart.is_zero or len(above) == 1 or ring.depends_on_coordinates(above)):
            shortest = min(shortest, total([form(apart), self._over(rest, below)]), key=cost)
        return equation(letter, shortest)

    def _over(self, above: Expr, below: Expr) -> Node:
        """±above/below, cancelled."""
        common = above.poly.gcd(below.poly)
        sign = -1 if all(number < 0 for number in above.poly.coeffs()) else 1
        form = self.compactor(above.ring).form
        upper, lower = (form(Expr(above.ring, part.poly / common)) for part in (above * sign, below))
        return times(sign, [(upper, 1), (lower, -1)])

    def _tangent(self, condition: Condition) -> Node | None:
        """tan θ = b/a where a sin θ = b cos θ, and a is not 0; 2θ = ±90° where a and b are of one size."""
        turn, names = turn_of(condition.expr), condition.expr.ring.names
        if turn is None or turn.is_one_sided or not turn.rest.is_zero:
            return None
        if turn.cosine in (turn.sine, -turn.sine):
            moving, fixed = by_coordinates(turn.pair.angle * 2, names)
            quarter = Fraction(-90 if turn.cosine == turn.sine else 90)
            return equation(angle_node(moving, names), angle_node(fixed + Angle(degrees=quarter)))
        angle = Function("tan", angle_node(turn.pair.angle, names))
        return self._quotient(angle, -turn.cosine, turn.sine)

    @cached_property
    def _nonzero(self) -> frozenset[Expr]:
        """The factors of what is told to be other than 0."""
        found = self.values["equilibria"]
        special = () if isinstance(found, Skipped) else found.special
        return frozenset(factor for one in special for factor, _ in trig_factors(one.factor))

    @property
    def for_special(self) -> EquilibriaForms:
        """The same where it is not told what is other than 0."""
        return _SpecialForms(self.robot, self.values)

    def special_exceptions(self, case: SpecialCase) -> tuple[tuple[Node, ...], ...]:
        """The sets that are no equilibria for special parameters."""
        return tuple(tuple(map(self.condition, one)) for one in case.excluded)

    def special_cases(self, case: SpecialCase) -> tuple[tuple[Node, ...], ...]:
        """The alternatives of what is 0 for special parameters."""
        return tuple(tuple(map(self.condition, one)) for one in case.cases or ())

    def special_needs(self, case: SpecialCase) -> tuple[Relation, ...]:
        """Equations between parameters alone that must hold, too, for there to be equilibria."""
        return tuple(self.comparison(may_vanish(one), "=") for one in case.needs)

    @cached_property
    def balance(self) -> tuple[Node, ...]:
        """What must be 0 for gravity to be balanced; none where it is too long."""
        found = self.values["balance"]
        if isinstance(found, Skipped):
            return ()
        return tuple(map(self.compactor(self.robot.ring).form, found))


class _SpecialForms(EquilibriaForms):
    _nonzero = frozenset()
