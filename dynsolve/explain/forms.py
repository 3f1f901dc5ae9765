"""The compact forms of a derivation's values, each made once and shared.

Small values are written from their own normal form.  Where a value is long, and is
by its formula a combination of values that have forms already, those are put
together instead: C from the Christoffel symbols, d/dt ∂L/∂q̇ from D and the
Christoffel symbols (∂d_kj/∂q_i = c_ijk + c_ikj), I_base from R.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from functools import cached_property, partial, reduce
from itertools import islice
from math import comb, lcm, prod
from operator import and_

from msgspec.structs import replace

from dynsolve.algebra.angles import names_of
from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.algebra.factors import trig_factors
from dynsolve.algebra.fraction import RationalExpr, clear_inverses, exactly_divided, is_zero, with_integers
from dynsolve.algebra.linear_systems import FractionMatrix
from dynsolve.algebra.matrix import Matrix, minors
from dynsolve.algebra.rationals import fraction
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import evaluate
from dynsolve.algebra.sampling import Transfer, samples
from dynsolve.derivation.actions import stored_apart
from dynsolve.derivation.graph import Derivation, Skipped
from dynsolve.derivation.kinematics import distances_from_axis
from dynsolve.errors import AlgebraError
from dynsolve.explain.entry_formulas import EntryFormulas, Factor, coriolis_matrix, pairs, rates_of_pair
from dynsolve.explain.parameter_meanings import angles_in, names_in
from dynsolve.notation import tree
from dynsolve.notation.build import cost, factors_of, negated, number_in_front, split_sign, times, total
from dynsolve.notation.printing import decimal_text
from dynsolve.notation.tree import (
    ZERO,
    Function,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Symbol,
    walk,
)
from dynsolve.quantities import families, letters
from dynsolve.quantities.action_families import KM, PS
from dynsolve.quantities.index import quantities
from dynsolve.quantities.stages import Stage
from dynsolve.robot.dimensions import Dimensions
from dynsolve.robot.geometry import Turn, parallel_groups, turned_otherwise
from dynsolve.robot.model import Body, Convention, Robot
from dynsolve.robot.typed_sums import deflection, printed_sums
from dynsolve.robot.units import INERTIA, MASS

LONG_MODEL = 1500
"""The operations in D, C and g together from which on names make them readable: some five pages."""

LONG = 300
"""From this number of terms on a value is put together from parts."""

LONG_REGRESSOR = 1500
"""From this number of terms on a regressor is written a hundredth longer, in a third of the time."""

_KINETIC = (families.KV, families.KW, families.K_BODY, families.K, KM)
"""Of decimals, too, they keep their ½: what is beside it are then the digits of D."""

_ENERGIES = (*_KINETIC, PS)
"""Their ½ stands in front, as in their definitions."""

LONG_INTEGER = 10**6
"""An integer from which on decimals are shorter."""

MOST_OF_RADII = 4
"""Up to this number of coordinates squares of radii are looked for."""

_SHORT = 5
"""The terms of an entry of a long regressor for which both ways are tried."""


def entry_of(whole: Node, place: tuple[int, ...]) -> Node:
    """An entry of a matrix; what is said in place of the matrix where it was not worked out."""
    if not isinstance(whole, tree.Matrix):
        return whole
    row, column = place
    return whole.rows[row][column]


class Forms:
    """forms(name): the compact tree of the value of that name, a `tree.Matrix` for a matrix.

    Names are those of `dynsolve.derivation.graph`.  `decimal` says that lengths alone may be decimals, too.
    """

    def __init__(self, robot: Robot, values: Derivation, *, decimal: bool = False) -> None:
        self.robot = robot
        self._decimal = decimal or robot.has_decimals
        self.values = values
        self._made: dict[str, Node] = {}
        self._symbols: dict[tuple[int, int, int], Node] = {}

    @cached_property
    def compactor(self) -> Compactor:
        """The compactor of this robot's ring."""
        few = self.robot.n <= MOST_OF_RADII
        radii = list(distances_from_axis(self.robot, self.values)) if few else []
        return self._compactor(typed=self.robot.decimals, spelled=self.spelled, radii=radii)

    @cached_property
    def spelled(self) -> tuple[tree.Sum, ...]:
        """The sums that formulas are written with as the file has them."""
        return tuple(printed_sums(self.robot, self._compactor().form))

    @property
    def _compactor(self) -> Callable[..., Compactor]:
        return partial(Compactor, self.robot.ring, *self.collecting, decimal=self._decimal)

    @property
    def collecting(self) -> tuple[list[str], list[frozenset[str]]]:
        """The arguments of this robot's compactor: its masses and inertias, its parallel joints."""
        return leading_names(self.robot), parallel_coordinates(self.robot)

    @cached_property
    def are_long(self) -> bool:
        """Whether D, C and g written out are too long to be read."""
        known: dict[int, tuple[Node, int]] = {}
        rows = (row for name in ("D", "C", "g") for row in self.matrix(name).rows)
        return sum(cost(entry, known) for row in rows for entry in row) > LONG_MODEL

    def __call__(self, name: str) -> Node:
        """The compact tree of a value, a `tree.Matrix` for a matrix."""
        found = self._made.get(name)
        if found is None:
            found = self._make(name)
            quantity = quantities(self.robot).of_rule(name)
            if quantity is not None and quantity.family in (families.P_BODY, families.P):
                found = _without_minus(found, self.spelled)
            elif quantity is not None and quantity.family in _ENERGIES:
                found = found if isinstance(found, Quotient) and self._decimal else number_in_front(found)
                found = _with_squares_first(_without_minus(found), self.robot.ring.names)
            self._made[name] = found
        return found

    def in_ring(self, ring: Ring) -> Forms:
        """The same of values of another ring, such as that of a matrix that is to be judged."""
        other = Forms(replace(self.robot, ring=ring), self.values, decimal=self._decimal)
        other.spelled = self.spelled
        return other

    def of(self, value: Expr | RationalExpr | Matrix | FractionMatrix) -> Node:
        """The compact tree of any value of this robot's ring."""
        return self.products.of(value)

    @cached_property
    def products(self) -> ProductForms:
        """Products and quotients of this robot's ring."""
        return ProductForms(self.compactor, decimal=self._decimal)

    def mass(self, body: Body) -> Node:
        """The mass of a body in a formula."""
        return letters.mass(self.robot, body, self.of(body.mass))

    def christoffel(self, i: int, j: int, k: int) -> Node:
        """c_ijk, from 0."""
        key = min(i, j), max(i, j), k
        found = self._symbols.get(key)
        if found is None:
            found = self._symbols[key] = self.of(self.values["christoffel"][key])
        return found

    def _make(self, name: str) -> Node:
        own = quantities(self.robot).get(name)
        if own is not None and own.is_read_off:
            if len(own.entry) == 2:
                return entry_of(self(own.whole), own.entry)
            return self.christoffel(*own.entry)
        value = self.values[name]
        if isinstance(value, Skipped):
            return tree.Words(f"({value.why})")
        if isinstance(value, RationalExpr | FractionMatrix):
            return self.of(value)
        if name == "det":
            (jacobian,) = self.values.rules[name].inputs
            return self.products.determinant(value, self.values[jacobian])
        entries = value.entries if isinstance(value, Matrix) else (value,)
        quantity = quantities(self.robot).of_rule(name)
        is_regressor = quantity is not None and quantity.family.stage is Stage.PARAMETERS
        if is_regressor and len(entries) > len(value.rows) and sum(map(len, entries)) > LONG_REGRESSOR:
            quick = Compactor(self.robot.ring, *self.collecting, decimal=self._decimal, large=_SHORT)
            return quick.matrix(value)
        if max(map(len, entries), default=0) > LONG:
            made = self._from_parts(name)
            if made is not None:
                return made
        if quantity is not None and self.robot.has_decimals:
            if quantity.family is families.DLDQD:
                return self._momentum_in_decimals(value)
            if quantity.family in _KINETIC:
                return self._kinetic_in_decimals(value)
        if self.robot.actions.stored and name == "g":
            return tree.column(*(self._beside_springs(entry, k) for k, entry in enumerate(entries)))
        if self.robot.actions.stored and quantity and quantity.family in (families.FORCE, families.DLDQ):
            sign = 1 if quantity.family is families.FORCE else -1
            return self._beside_springs(value, quantity.index[0] - 1, sign)
        if name == "tau":
            return tree.column(*(self(f"tau{q.index}") for q in self.robot.coordinates))
        if name == "L":
            return total([self("K"), negated(self("P"))])
        if name == "Ps":
            return _with_halves(total(list(map(self.of, stored_apart(self.robot)))))
        if name == "P":
            return _with_halves(self._potential_energy(value))
        return self.of(value)

    def _potential_energy(self, energy: Expr) -> Node:
        """Σ P_i as it is added up, its bodies collected where they share terms; or what is much shorter."""
        stored, names = self.robot.actions.stored, [f"P{body.name}" for body in self.robot.bodies]
        whole = energy - self.values["Ps"] if stored else energy
        found = self.of(whole)
        if not self.robot.is_numeric and len(whole) == sum(len(self.values[name]) for name in names):
            added = total([self(name) for name in names])
            found = added if cost(added) <= 1.5 * cost(found) else found
        return total([found, *([self("Ps")] if stored else [])])

    def _momentum_in_decimals(self, momentum: Expr) -> Node:
        """Σ d_kj q̇_j, by the rates: decimals that two of them share are no reason to draw them together."""
        ring = momentum.ring
        rates = [Symbol(q.name, 1) for q in self.robot.coordinates]
        terms = ((self.of(ring.diff_velocity(momentum, k)), rate) for k, rate in enumerate(rates))
        return total(
            [times(1, [(d, 1), (rate, 1)], decimal=not isinstance(d, Quotient)) for d, rate in terms]
        )

    def _beside_springs(self, force: Expr, k: int, sign: int = 1) -> Node:
        """A force with a term for each spring with a rest position: k (x₂ - x₁ - a) - k (x₃ - x₂ - a).

        The number of 250 (z - 0.4) is not added to a weight.
        """
        pulls = list(self._pulls(k, sign))
        if len({along for along, _, _ in pulls}) > 1:
            for _, pull, _ in pulls:
                force = force - pull
            return total([self.of(force), *(printed for _, _, printed in pulls)])
        springs = force.ring.diff(self.values["Ps"], k) * sign
        rest = force - springs
        numbers = {(0,) * len(force.ring.generators)}
        if self.robot.has_decimals and numbers <= {*rest.poly.monoms()} & {*springs.poly.monoms()}:
            return total([self.of(rest), self.of(springs)])
        return self.of(force)

    def _pulls(self, k: int, sign: int) -> Iterator[tuple[Expr, Expr, Node]]:
        """(x, force, the force as printed) of each spring with a rest position that pulls coordinate k."""
        for act in self.robot.actions.stored:
            pull = act.energy.ring.diff(act.energy, k) * sign
            for along, at_rest in act.differences:
                size = pull.quotient(along - at_rest)
                if size and not pull.is_zero and not at_rest.is_zero:
                    factors = [(self.of(size), 1), (deflection(along, at_rest, self.of), 1)]
                    yield along, pull, times(1, factors, decimal=self._decimal)

    def _kinetic_in_decimals(self, energy: Expr) -> Node:
        """½ (d_11 q̇_1² + 2 d_12 q̇_1 q̇_2 + …), each d_kj as it is rounded elsewhere; 0 of no energy."""
        ring, names = energy.ring, self.robot.ring.names
        inner = _without_minus(self.of(energy * 2))
        if inner == ZERO:
            return ZERO
        if isinstance(inner, tree.Sum):
            terms: list[Node] = []
            for j, k in pairs(len(names)):
                entry = self.of(ring.diff_velocity(ring.diff_velocity(energy, j), k))
                factors = [(entry, 1), *rates_of_pair(names, j, k)]
                terms.append(times(1 if j == k else 2, factors, decimal=not isinstance(entry, Quotient)))
            inner = total(terms)
        if isinstance(inner, Quotient) and isinstance(inner.denominator, Number):  # m l² q̇²/4
            return times(Fraction(1, 2 * inner.denominator.p), [(inner.numerator, 1)])
        first, *others = factors_of(inner)
        # ½·8 q̇² and, beside letters, ½ (1/12) m q̇² are one number
        is_exact = isinstance(first, Number) and decimal_text(first.p, first.q) is None
        has_letters = not tree.names_in(inner).isdisjoint(ring.parameters)
        if isinstance(first, Number) and (first.q == 1 or (is_exact and has_letters)):
            return times(Fraction(first.p, 2 * first.q), [(factor, 1) for factor in others], decimal=True)
        return Product((letters.HALF, *factors_of(inner)))

    # -- long values from their parts --------------------------------------------------------------

    def _from_parts(self, name: str) -> Node | None:
        quantity = quantities(self.robot).of_rule(name)
        if quantity is None:
            return None
        formulas, index = self._formulas, quantity.index[0] - 1 if quantity.index else 0
        match quantity.family:
            case families.K:
                return formulas.kinetic_energy()
            case families.C:
                return coriolis_matrix(self.robot.ring.names, self.christoffel)
            case families.CQD:
                return tree.column(*(total(formulas.coriolis_terms(k)) for k in range(self.robot.n)))
            case families.I:
                body = self.robot.bodies[index].name
                R, tensor = self.matrix(f"R{body}").rows, self.matrix(f"I_body{body}")
                return tree.Matrix(tuple(tuple(_sandwich(left, tensor, right) for right in R) for left in R))
            case families.K_BODY:
                body = self.robot.bodies[index].name
                return total([self(f"Kv{body}"), self(f"Kw{body}")])
            case families.DLDQD:
                return formulas.momentum(index)
            case families.DDT:
                return formulas.momentum_rate(index)
            case families.DLDQ:
                return formulas.lagrangian_derivative(index)
            case families.FORCE:
                return formulas.force(index)
        return None

    @cached_property
    def _formulas(self) -> EntryFormulas:
        """The formulas in the entries of D and g and the Christoffel symbols, written by their forms."""
        rubs = self.robot.actions.resisting
        return EntryFormulas(
            self.robot.ring.names,
            lambda i, j: self.matrix("D").rows[i][j],
            self.christoffel,
            lambda k: self.matrix("g").rows[k][0],
            lambda k: self.matrix("friction").rows[k][0] if rubs else ZERO,
        )

    def matrix(self, name: str) -> tree.Matrix:
        """The compact tree of a value that is a matrix."""
        form = self(name)
        assert isinstance(form, tree.Matrix)
        return form


def _without_minus(node: Node, spelled: Sequence[Node] = ()) -> Node:
    """An energy without a minus that a sum, if not `spelled`, can take: -½ (a - b) q̇² is ½ (b - a) q̇²."""
    if not (isinstance(node, Negative) and isinstance(node.argument, Product)):
        return node
    factors = node.argument.factors
    for k, factor in enumerate(factors):
        if isinstance(factor, tree.Sum) and factor not in spelled:
            opposite = [_without_minus(negated(term)) for term in factor.terms]
            terms = sorted(opposite, key=lambda term: isinstance(term, Negative))
            if not isinstance(terms[0], Negative):
                return Product((*factors[:k], tree.Sum(tuple(terms)), *factors[k + 1 :]))
    return node


def _with_halves(node: Node) -> Node:
    """An energy in decimals with the ½ and ¼ of its powers: 0.5 k x² + 0.25 μ x⁴ is ½ k x² + ¼ μ x⁴."""
    match node:
        case tree.Sum(terms):
            return tree.Sum(tuple(map(_with_halves, terms)))
        case Product((Number(1, 2 | 4 as q), *others)) if any(isinstance(f, Power) for f in others):
            return Product((Quotient(Number(1), Number(q)), *others))
    return node


def _with_squares_first(node: Node, names: Sequence[str]) -> Node:
    """An energy without a minus before a square: - (a - b) q̇₁² is (b - a) q̇₁², in its place."""
    if isinstance(node, Product):
        return Product(tuple(_with_squares_first(factor, names) for factor in node.factors))
    if not isinstance(node, tree.Sum):
        return node
    terms = (_without_minus(term) if _has_square(term) else term for term in node.terms)
    turned = [_with_squares_first(term, names) for term in terms]
    if turned == list(node.terms):
        return node
    return tree.Sum(tuple(sorted(turned, key=lambda term: _rates(term, names))))


def _has_square(term: Node) -> bool:
    """Whether the square of a rate, a sine or a cosine is a factor of a term."""
    bases = [f.base for f in factors_of(split_sign(term)[1]) if isinstance(f, Power)]
    return any(base.dots == 1 if isinstance(base, Symbol) else isinstance(base, Function) for base in bases)


def _rates(term: Node, names: Sequence[str]) -> list[int]:
    """The coordinates whose rates stand in a term, that of a square twice."""
    found: list[int] = []
    for factor in factors_of(split_sign(term)[1]):
        places = [names.index(part.name) for part in walk(factor) if isinstance(part, Symbol) and part.dots]
        found += places * (2 if isinstance(factor, Power) else 1)
    return sorted(found)


def _sandwich(left: tuple[Node, ...], tensor: tree.Matrix, right: tuple[Node, ...]) -> Node:
    """Σ_kl left_k tensor_kl right_l"""
    terms = []
    for k, row in enumerate(tensor.rows):
        inner = total([times(1, [(entry, 1), (right[m], 1)]) for m, entry in enumerate(row) if entry != ZERO])
        terms.append(times(1, [(left[k], 1), (inner, 1)]))
    return total(terms)


def leading_names(robot: Robot) -> list[str]:
    """The masses or densities and then the moments of inertia, in the order of the bodies, rotors last.

    Of a model that is given they are what has these dimensions.
    """
    masses = [name for body in robot.bodies for name in (*_linear_names(body.mass), *_of_density(body))]
    given = [body.inertia for body in robot.bodies if body.inertia is not None and body.shape is None]
    rotors = [name for motor in robot.actions.rotors for name in _linear_names(motor.inertia)]
    inertias = [name for tensor in given for entry in tensor.entries for name in _linear_names(entry)]
    if robot.given is not None:
        model = robot.given.D or robot.given.K or robot.given.L
        ring = robot.ring if model is None else model.ring
        dimensions = Dimensions(ring, robot)
        of = {name: dimensions.of(ring.symbol(name)) for name in ring.parameters}
        masses, inertias = ([name for name in of if of[name] == each] for each in (MASS, INERTIA))
    return list(dict.fromkeys([*masses, *inertias, *rotors]))


def _of_density(body: Body) -> list[str]:
    """The parameters of a density that are no length of the shape."""
    if body.density is None or body.density.shape is None:
        return []
    lengths = {name for _, size in body.density.shape.dimensions for name in names_in(size)}
    inside = tree.names_in(body.density.formula) - lengths
    return [name for name in names_in(body.mass) if name in inside]


def _linear_names(expr: Expr) -> list[str]:
    """The parameters that are a term of an expression by themselves, perhaps over a denominator."""
    found = []
    for exponents in expr.poly.monoms():
        above = [
            (g, int(e))
            for g, e in zip(expr.ring.generators, exponents, strict=True)
            if e and g.kind != "inverse"
        ]
        if len(above) == 1 and above[0][1] == 1 and above[0][0].kind == "symbol":
            found.append(above[0][0].name)
    return found


def parallel_coordinates(robot: Robot) -> list[frozenset[str]]:
    """The names whose angles add up: coordinates that turn about parallel axes, constant angles beside them.

    Without joints all that stand in angles.  A constant angle is with the joints before what it stands in,
    but not where it turns about another axis.
    """
    if not robot.has_table:
        return [frozenset(name for pair in robot.ring.pairs for name in names_of(pair.angle))]
    turns = [
        Turn(joint.theta, joint.alpha, joint.variable == "theta", joint.parent) for joint in robot.joints
    ]
    modified = robot.convention is Convention.MODIFIED
    runs = parallel_groups(turns, robot.ring.names, modified)
    if len(runs) == 1:
        return [runs[0] | _constant_angles(robot) - turned_otherwise(turns, modified)]
    placed = [(body.link, body.center) for body in robot.bodies]
    placed += [(point.link, point.position) for point in robot.questions.points]
    for link, place in placed:
        angles = {name for entry in place.entries for name in angles_in(entry)} & _constant_angles(robot)
        turned = _turned_by(robot, link)
        runs = [run | angles if turned & run else run for run in runs]
    return runs


def _constant_angles(robot: Robot) -> frozenset[str]:
    names = (frozenset(names_of(pair.angle)) for pair in robot.ring.pairs)
    return frozenset().union(*(own for own in names if own.isdisjoint(robot.ring.names)))


def _turned_by(robot: Robot, link: int) -> frozenset[str]:
    """The coordinates in the angle of the last joint that turns a link."""
    while link and robot.joints[link - 1].variable != "theta":
        link = robot.joints[link - 1].parent
    return frozenset(names_of(robot.joints[link - 1].theta)) & {*robot.ring.names} if link else frozenset()


# -- compact forms of products and quotients: a determinant in its factors, fractions --------------

MOST_MINORS = 10
"""The squares of more are not added up."""

SIGNS = 12
"""So many states show whether an expression changes its sign."""

LONG_FACTORS = 150
"""Expressions of more terms are not taken apart: over roots that takes minutes."""


class ProductForms:
    """Writes expressions of one ring as products, where that is shorter than as sums.

    Where numbers are `decimal`, fractions that would have long integers are of decimals.
    """

    def __init__(self, compactor: Compactor, *, decimal: bool = False) -> None:
        self.compactor = compactor
        self.decimal = decimal
        self.ring = compactor.ring

    def of(self, value: Expr | RationalExpr | Matrix | FractionMatrix) -> Node:
        """The tree of any value of the ring, with products in fractions alone."""
        if isinstance(value, RationalExpr):
            return self.fraction(value)
        if isinstance(value, FractionMatrix):
            return self.matrix(value)
        return self.compactor.matrix(value) if isinstance(value, Matrix) else self.compactor.form(value)

    def form(self, expr: Expr, *, apart: bool = False) -> Node:
        """The shorter of the product of an expression's factors and its compact form."""
        coefficient, factors = self._factors(expr, apart=apart)
        return times(coefficient, factors, decimal=self.decimal)

    def determinant(self, value: Expr, jacobian: Matrix) -> Node:
        """det J, or det(J Jᵀ), which is the sum of the squares of the minors, as that where it is shorter."""
        found, (rows, columns) = self.form(value), jacobian.shape
        is_long = len(value) > LONG_FACTORS or comb(max(rows, columns), min(rows, columns)) > MOST_MINORS
        if rows == columns or value.is_zero or is_long:
            return found
        terms = []
        for minor in minors(jacobian, min(rows, columns)):
            number, factors = self._product(minor) or (Fraction(1), [(self.compactor.form(minor), 1)])
            powers = Counter[Node]()
            for node, power in factors:
                powers[node] += 2 * power
            terms.append((number**2, powers))
        shared = reduce(and_, (powers for _, powers in terms))
        rests = [
            times(n, [(node, p - shared[node]) for node, p in powers.items() if p != shared[node]])
            for n, powers in terms
        ]
        squares = times(1, [*shared.items(), (total(rests), 1)])
        return min(found, squares, key=cost)

    def fraction(self, value: RationalExpr) -> Node:
        """A fraction, numerator and denominator as products."""
        return self.matrix(FractionMatrix(self.ring, ((value,),))).rows[0][0]

    def matrix(self, values: FractionMatrix) -> tree.Matrix:
        """The same of each entry, all with integers or all with decimals."""
        whole = tuple(tuple(map(with_integers, row)) for row in values.rows)
        parts = (part for row in whole for one in row for part in (one.numerator, one.denominator))
        rows = values.rows if self.decimal and any(map(_has_long, parts)) else whole
        return tree.Matrix(tuple(tuple(map(self._quotient, row)) for row in rows))

    def _quotient(self, value: RationalExpr) -> Node:
        """A quotient of products; what the denominator divides stands apart where that is shorter."""
        numerator, divisor = value.numerator, value.divisor
        if divisor is None:
            return self.form(numerator)
        for index, inverted in self.ring.inverses.items():  # 1/R² above and below
            degree = max(int(one.poly.degrees()[index]) for one in (numerator, divisor))
            if degree > 0:
                base = Expr(self.ring, inverted) ** degree
                numerator, divisor = numerator * base, divisor * base
        if self._is_negative(divisor):  # of a determinant, a₁ a₃ - a₂² c², and not its opposite
            numerator, divisor = -numerator, -divisor
        over, under = numerator, divisor
        if max(len(over), len(under)) <= LONG_FACTORS:
            over, under = map(self._mirrored, (over, under))
        mirrored = divmod(over.poly, under.poly)
        choices = (divmod(numerator.poly, divisor.poly), exactly_divided(numerator, divisor), mirrored)
        splits = [[Expr(self.ring, self.ring.reduce(part)) for part in parts] for parts in choices]
        best = min(splits, key=lambda parts: (_has_halves(*parts), sum(map(len, parts))))
        whole, rest = map(self._mirrored, best) if best is splits[-1] else best
        if (
            _has_halves(whole, rest) <= _has_halves(numerator)
            and sum(map(len, best)) < min(len(numerator), len(over))
            and not rest.is_zero
        ):
            return total([self.form(whole), self._quotient(RationalExpr(rest, divisor))])
        below, factors = self._factors(divisor, apart=True)
        return self.over(numerator, below, *factors)

    def _mirrored(self, expr: Expr) -> Expr:
        """With sines for the cosines of what moves, and cosines for its sines."""
        place = list(self.ring.ctx.gens())
        for pair in self.ring.pairs:
            if not pair.angle.is_constant:
                s, c = pair.sine, pair.cosine
                place[s], place[c] = place[c], place[s]
        return Expr(self.ring, self.ring.reduce(expr.poly.compose(*place, ctx=self.ring.ctx)))

    def over(self, numerator: Expr, number: Fraction | int, *under: Factor) -> Node:
        """A numerator over a number and factors; with a minus in front where that is shorter."""

        def signed(sign: int) -> Node:
            above, over = self._factors(numerator * sign)
            factors = [*over, *((node, -power) for node, power in under)]
            return times(sign * above / number, factors, decimal=self.decimal)

        found = signed(1)
        return found if split_sign(found)[0] > 0 else min(signed(-1), found, key=cost)

    def _is_negative(self, expr: Expr) -> bool:
        """Whether it is at many states, or, of changing sign, of the terms without a coordinate more."""
        signs = (evaluate(expr, at) < 0 for at in islice(samples(self.ring), SIGNS))
        first = next(signs)
        if all(sign == first for sign in signs):
            return first
        moving = self.ring.moving
        fixed = (f for e, f in expr.poly.terms() if not any(n and k in moving for k, n in enumerate(e)))
        return sum(map(fraction, fixed), start=Fraction(0)) < 0

    def _factors(self, expr: Expr, *, apart: bool = False) -> tuple[Fraction, list[Factor]]:
        """(number, factors with their exponents) that make the shortest form.

        Of two that are as long it is that with the factors `apart`, each of which is then as it is elsewhere.
        """
        plain = self.compactor.form(expr)
        found = None if expr.is_number or len(expr) > LONG_FACTORS else self._product(expr)
        if found is None or cost(times(*found)) >= cost(plain) + (apart and len(expr) > 1):
            return Fraction(1), [(plain, 1)]
        return found

    def _product(self, expr: Expr) -> tuple[Fraction, list[Factor]] | None:
        """An expression taken apart; None where its factors have no form in this ring."""
        from dynsolve.derivation.search_ring import search_ring

        relative = search_ring(self.ring, (), {})
        there, back = Transfer(self.ring, relative), Transfer(relative, self.ring)
        degrees = {index: int(expr.poly.degrees()[index]) for index in self.ring.inverses}
        below = [(Expr(self.ring, self.ring.inverses[i]), -degree) for i, degree in degrees.items() if degree]
        whole, expr = expr, clear_inverses(expr)
        over = prod((self.ring.generator(i) ** degree for i, degree in degrees.items()), start=self.ring.one)
        if not is_zero(expr * over - whole):  # a parameter below another
            return None
        try:
            factors = [(self._whole(back(factor)), power) for factor, power in trig_factors(there(expr))]
        except AlgebraError:
            return None
        product = self.ring.one
        for factor, power in factors:
            product = product * factor**power
        coefficient = fraction(expr.poly.leading_coefficient() / product.poly.leading_coefficient())
        if product * coefficient != expr:
            return None
        factors += below
        factors.sort(key=self._place)
        return coefficient, [(self.compactor.form(factor), power) for factor, power in factors]

    def _place(self, factor: tuple[Expr, int]) -> tuple[object, ...]:
        """What does not move first, short before long, letters in their order."""
        collector, expr = self.compactor.collector, factor[0]
        _, mono = collector.decompose(self.compactor.form(expr))
        return self.ring.depends_on_coordinates(expr), len(expr), collector.order(mono)

    def _whole(self, expr: Expr) -> Expr:
        """A factor, not negative where nothing moves, with integers where these are not long."""
        if self._is_negative(expr):
            expr = -expr
        whole = expr * lcm(*(int(c.q) for c in expr.poly.coeffs()))
        return expr if self.decimal and _has_long(whole) else whole


def _has_halves(*exprs: Expr) -> bool:
    return any(factor.q != 1 for expr in exprs for factor in expr.poly.coeffs())


def _has_long(expr: Expr) -> bool:
    """Whether a coefficient has more digits than are shown of a decimal."""
    return any(abs(int(factor.p)) >= LONG_INTEGER for factor in expr.poly.coeffs())
