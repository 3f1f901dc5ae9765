"""Steps of τ = Y a: the combinations of parameters that count, and what stands beside each of them."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import cached_property
from itertools import combinations_with_replacement, count
from typing import TypeVar

from flint import fmpq
from msgspec import Struct, field

from dynsolve.algebra.compact.terms import Exponents, primitive
from dynsolve.algebra.fraction import RationalExpr
from dynsolve.algebra.linear_systems import FractionMatrix
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.rationals import fraction
from dynsolve.algebra.ring import Expr, Ring
from dynsolve.algebra.ring_values import with_symbols
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.link_frame import accelerations
from dynsolve.document import Prose
from dynsolve.document.books import SLOTINE_LI, spong
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.step import NOTED, Detail, Group, Line, Step, not_derived
from dynsolve.explain.writing import listed, scalar
from dynsolve.notation.build import times, total
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    Entry,
    Function,
    Letter,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Row,
    Sum,
    Symbol,
    Words,
    equation,
    walk,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.questions.parameters.derive import combinations, known_names
from dynsolve.robot.model import Robot
from dynsolve.robot.names import names_taken

STAGE = Stage.PARAMETERS
_SOURCE = spong("7.5.3")

MOST_SHOWN = 24
"""With more coefficients only the parameters are shown."""


class _Linear(Struct, frozen=True):
    """Forces that are linear in parameters: τ = Y a, and the same of a part of them."""

    Y: str
    a: str
    forces: Node
    of: str = ""

    @property
    def formula(self) -> Node:
        """τ = Y a"""
        return equation(self.forces, Product((self.letter("Y"), self.letter("a"))))

    def letter(self, base: str) -> Letter:
        """Y or a; Y_M of a part."""
        return letters.of_part(base, self.Y[1:]) if self.of else letters.bold(base)


_ALL = (
    _Linear("Y", "a", letters.TAU),
    _Linear("YM", "aM", Product((letters.D, letters.QDD)), " of the inertia matrix"),
    _Linear("Yg", "ag", letters.G, " of gravity"),
)


LETTERS = """
* {regressors} | regressor: the factor of the parameters in the forces, in a part of them
* {parameters} | column of the parameters in these
"""
"""The lines of its letters in the list of notation."""


def steps(context: Context) -> Iterator[Step]:
    """The parameters and the regressor of the forces, and of a part of them where that is asked for."""
    wanted, values = context.wanted, context.values
    for linear in _ALL:
        title = f"The parameters{linear.of}"
        if {linear.a, linear.Y} & wanted and _forces(context, linear).is_zero:
            why: Prose = (linear.forces, " is 0 in every state, so that there are no parameters in it.")
            yield Step(linear.a, STAGE, title, why, detail=Detail.BRIEF)
            continue
        group = Group(linear.a, f"{title} and the regressor", (), linear.formula, _SOURCE)
        for name, made in ((linear.a, _parameters), (linear.Y, _regressor)):
            if name in wanted:
                value = values[name]
                if isinstance(value, Skipped):
                    yield not_derived(
                        name, title if name == linear.a else f"The regressor{linear.of}", value.why, group
                    )
                else:
                    yield made(context, linear, group)
    if "Yr" in wanted and not values["tau"].is_zero:
        value = values["Yr"]
        if isinstance(value, Skipped):
            yield not_derived("Yr", "The regressor of reference motions", value.why)
        else:
            yield _with_references(context)


def _forces(context: Context, linear: _Linear) -> Matrix:
    """The forces that are linear in the parameters."""
    name = {"Y": "tau", "Yg": "g"}.get(linear.Y, "D")
    found: Matrix = context.values[name]
    return found @ accelerations(context.robot) if name == "D" else found


# -- the parameters --------------------------------------------------------------------------------


def _parameters(context: Context, linear: _Linear, group: Group) -> Step:
    value: Matrix = context.values[linear.a]
    is_given = linear.a == "a" and context.robot.questions.model.parameters is not None
    known = sorted(known_names(context.robot))
    of_known: Prose = ()
    if known:
        of_known = (*listed(list(map(Symbol, known))), f" count{'s' * (len(known) == 1)} as known. ")
    count = len(value.rows)
    fewest = say(
        f"Fewer than {count} entries are not enough: that is the rank of {{forces}} over {{motions}} and "
        "parameters.",
        forces=linear.forces,
        motions="configurations" if linear.Y == "Yg" else "motions",
    )
    return Step(
        id=linear.a,
        stage=STAGE,
        title=f"The parameters{linear.of}",
        why=say(
            "Multiplied out, {forces} is a sum of products: what moves (coordinates, rates, accelerations, "
            "sines and cosines) times a coefficient of parameters. {known}{given}",
            forces=linear.forces,
            known=of_known,
            given=say("The problem gives the entries of {a}.", a=linear.letter("a")) if is_given else (),
        ),
        formula=linear.formula,
        source=_SOURCE,
        lines=() if is_given else tuple(_lines(context, linear, value)),
        result=(equation(linear.letter("a"), context.form(linear.a)),),
        notes=(fewest,) if count > 1 and not is_given else (),
        detail=Detail.BRIEF,
        normal=NOTED,
        group=group,
    )


def _lines(context: Context, linear: _Linear, parameters: Matrix) -> Iterator[Line]:
    """The coefficients, and those that others give; none where there are too many to be read."""
    found = combinations(context.robot, _forces(context, linear), parameters)
    if not 0 < len(found) <= MOST_SHOWN:
        return
    squares = _squares_of_sines(context, linear)
    by = say(
        "The coefficients that occur{used}, without numbers and known factors that all terms of one share:",
        used=say(" with {identities}", identities=listed(squares)) if squares else "",
    )
    yield Line(by, tuple(context.show(coefficient) for coefficient, _ in found))
    names = [Entry(linear.letter("a"), Number(k)) for k in range(1, len(parameters.rows) + 1)]
    dependent = [
        equation(context.show(coefficient), _sum(context, names, factors))
        for coefficient, factors in found
        if coefficient not in parameters.entries
    ]
    if dependent:
        chosen = say(
            "The entries of {a}, below, are chosen: independent ones of which all of these are combinations. "
            "Other independent combinations serve as well:",
            a=linear.letter("a"),
        )
        yield Line(chosen, tuple(dependent))


def _squares_of_sines(context: Context, linear: _Linear) -> list[Node]:
    """sin² q = 1 - cos² q of each angle whose sine stands squared in the forces as they are printed."""
    names = {"Y": ("tau",), "Yg": ("g",)}.get(linear.Y, ("D",))
    shown = list(walk(*map(context.form, names)))
    squared = walk(*(node.base for node in shown if isinstance(node, Power) and node.exponent == Number(2)))
    angles = [node.argument for node in squared if isinstance(node, Function) and node.name == "sin"]
    return [
        equation(_square("sin", angle), Sum((Number(1), Negative(_square("cos", angle)))))
        for angle in dict.fromkeys(angles)
    ]


def _square(function: str, angle: Node) -> Node:
    return Power(Function(function, angle), Number(2))


def _sum(context: Context, names: Sequence[Node], factors: tuple[RationalExpr, ...]) -> Node:
    """Σ y_k (a)_k"""
    terms = []
    for name, factor in zip(names, factors, strict=True):
        if not factor.is_zero:
            shown = scalar(context.forms.of(FractionMatrix(factor.ring, ((factor,),))))
            terms.append(times(1, [(shown, 1), (name, 1)]))
    return total(terms)


# -- the regressor ---------------------------------------------------------------------------------


def _regressor(context: Context, linear: _Linear, group: Group) -> Step:
    a = linear.letter("a")
    return Step(
        id=linear.Y,
        stage=STAGE,
        title=f"The regressor{linear.of}",
        why=say("Each force has a row. Column k holds what stands in it beside entry k of {a}.", a=a),
        formula=linear.formula,
        source=_SOURCE,
        result=(equation(linear.letter("Y"), context.form(linear.Y)),),
        detail=Detail.BRIEF,
        group=group,
    )


def _with_references(context: Context) -> Step:
    return Step(
        id="Yr",
        stage=STAGE,
        title="The regressor with reference rates",
        why=say(
            "Adaptive control puts reference rates $𝐪̇_r$ and accelerations $𝐪̈_r$ in the place of the arm's "
            "own where these are multiplied by $𝐃$ and $𝐂$; the rates inside $𝐂$ stay. The parameters are "
            "the same."
        ),
        formula=formula("𝐃 𝐪̈_r + 𝐂 𝐪̇_r + 𝐠 = 𝐘_r 𝐚"),
        source=SLOTINE_LI.section("9.2"),
        result=(equation(letters.of_part("Y", "r"), context.form("Yr")),),
        notes=(say("Here the choice of $𝐂$ counts: with that of Christoffel {skew} is skew-symmetric.",
                   skew=Row((letters.rate(letters.D), Words(" - 2"), letters.C))),),
        detail=Detail.BRIEF,
    )  # fmt: skip


# -- base parameters: the few combinations of masses, moments and lengths that the motion depends on
# D and g are linear in what the links weigh and how their mass is spread, and the ten
# parameters a link occur in certain combinations only.  Those are found here, exactly:
# the coefficients of the products of sines and cosines in D and g span, over the
# polynomials in the lengths of the table, a space of which the base parameters are a
# basis.  (Khalil and Dombre, Modeling, Identification and Control of Robots, 2002,
# section 9.4; of the PUMA 560 with ten parameters a link there are 36.)  Their values
# cannot be told apart further by any measurement of the forces of the joints.

Coefficient = dict[Exponents, Fraction]
"""A polynomial in the parameters: factors by the exponents of all generators."""

Combination = dict[tuple[Exponents, int], Fraction]
"""Σ factor · (product of lengths) · (base parameter): factors by those two."""

HIGHEST = 2
"""The degree up to which lengths multiply a base parameter; a moment of inertia is mass times length²."""


class _Row(Struct, frozen=True):
    """A product of lengths and a base parameter, without what the rows before it hold of it."""

    lead: Exponents
    values: Coefficient
    made_of: Combination


class BaseParameters(Struct, dict=True):
    """The base parameters of a robot, and the ring in which they are symbols.

    `letter` begins their names.  A coefficient that is one symbol keeps it.
    """

    robot: Robot
    letter: str
    _rows: dict[Exponents, _Row] = field(default_factory=dict)
    _found: list[Coefficient] = field(default_factory=list)
    _split: dict[Expr, dict[Exponents, Coefficient]] = field(default_factory=dict)
    _carried: dict[Expr, Expr] = field(default_factory=dict)

    @staticmethod
    def of(robot: Robot, D: Matrix, g: Matrix, letter: str) -> BaseParameters:
        """The base parameters that D and g are made of."""
        found = BaseParameters(robot, letter)
        coefficients = {
            frozenset(c.items()): c
            for expr in dict.fromkeys((*D.entries, *g.entries))
            for c in found._coefficients(expr).values()
        }
        for coefficient in sorted(coefficients.values(), key=_size):
            found._add(coefficient)
        return found

    # -- which generator is what -------------------------------------------------------------------

    @cached_property
    def _lengths(self) -> tuple[int, ...]:
        """The lengths of the table and of gravity, which are no property of a body."""
        robot = self.robot
        exprs = [e for joint in robot.joints for e in (joint.d, joint.a)]
        used = _generators_in([*exprs, *robot.gravity.entries, *robot.base_position.entries])
        return tuple(sorted(used & self._parameters))

    @cached_property
    def _parameters(self) -> frozenset[int]:
        ring = self.robot.ring
        names = set(ring.names)
        return frozenset(g.index for g in ring.generators if g.kind == "symbol" and g.name not in names)

    @cached_property
    def _factors(self) -> tuple[Exponents, ...]:
        """The products of lengths that are tried, 1 first; gravity is drawn out before."""
        size = len(self.robot.ring.generators)
        gravity = _generators_in(self.robot.gravity.entries)
        lengths = [i for i in self._lengths if i not in gravity]
        return tuple(
            tuple(chosen.count(i) for i in range(size))
            for degree in range(HIGHEST + 1)
            for chosen in combinations_with_replacement(lengths, degree)
        )

    # -- coefficients ------------------------------------------------------------------------------

    def _coefficients(self, expr: Expr) -> dict[Exponents, Coefficient]:
        """The coefficient of every product of sines, cosines and coordinates."""
        if expr in self._split:
            return self._split[expr]
        result: dict[Exponents, Coefficient] = {}
        for e, f in expr.poly.to_dict().items():
            motion = tuple(0 if i in self._parameters else int(x) for i, x in enumerate(e))
            own = tuple(int(x) if i in self._parameters else 0 for i, x in enumerate(e))
            result.setdefault(motion, {})[own] = fraction(f)
        self._split[expr] = result
        return result

    def _without_lengths(self, coefficient: Coefficient) -> tuple[Exponents, Coefficient]:
        """(the lengths that all terms share, the rest)"""
        least = [min(column) for column in zip(*coefficient, strict=True)]
        shared = tuple(x if i in self._lengths else 0 for i, x in enumerate(least))
        return shared, {_minus(e, shared): f for e, f in coefficient.items()}

    def _reduced(self, coefficient: Coefficient) -> tuple[Coefficient, Combination]:
        """(the part outside the span of the known base parameters, the combination that gives the rest)"""
        rest, made_of = dict(coefficient), Combination()
        pending = sorted(self._rows.keys() & rest.keys())
        while pending:
            lead = pending.pop()
            if factor := rest.get(lead):
                row = self._rows[lead]
                _add_to(rest, row.values, -factor)
                _add_to(made_of, row.made_of, factor)
            pending = pending or sorted(self._rows.keys() & rest.keys())
        return rest, made_of

    def _add(self, coefficient: Coefficient) -> None:
        """Make a base parameter of the part outside the span of the known ones."""
        _, whole = self._without_lengths(coefficient)
        if not self._reduced(whole)[0]:
            return
        number = len(self._found)
        self._found.append(self._shortened(whole))
        for factor in self._factors:
            product = {_plus(e, factor): f for e, f in self._found[number].items()}
            self._put(product, {(factor, number): Fraction(1)})

    def _shortened(self, coefficient: Coefficient) -> Coefficient:
        """A coefficient less known base parameters, as long as each makes it shorter."""
        best = _normalized(coefficient)
        while True:
            choices = [
                _normalized(_weighted_sum(best, product, sign))
                for product in self._found
                if not best.keys().isdisjoint(product)
                for sign in (1, -1)
            ]
            shorter = min(choices, key=_length, default=best)
            if _length(shorter) >= _length(best):
                return best
            best = shorter

    def _put(self, product: Coefficient, made_of: Combination) -> None:
        rest, known = self._reduced(product)
        if not rest:
            return
        made_of = dict(made_of)
        _add_to(made_of, known, Fraction(-1))
        lead = max(rest)
        scale = rest[lead]
        self._rows[lead] = _Row(
            lead, {e: f / scale for e, f in rest.items()}, {k: f / scale for k, f in made_of.items()}
        )

    # -- the ring in which they are symbols --------------------------------------------------------

    @cached_property
    def symbols(self) -> tuple[str | None, ...]:
        """The name of each; None where it is a symbol of the problem by itself."""
        taken = names_taken(self.robot)
        names = (name for k in count(1) if (name := f"{self.letter}{k}") not in taken)
        return tuple(next(names) if len(c) > 1 or sum(next(iter(c))) > 1 else None for c in self._found)

    @property
    def kept(self) -> tuple[str, ...]:
        """Those that are a symbol of the problem by themselves, and keep its name."""
        generators = self.robot.ring.generators
        alone = [c for c, name in zip(self._found, self.symbols, strict=True) if name is None]
        return tuple(
            g.name for c in alone for exponents in c for g, e in zip(generators, exponents, strict=True) if e
        )

    @cached_property
    def ring(self) -> Ring:
        """The robot's ring with the base parameters as further symbols."""
        return with_symbols(self.robot.ring, [name for name in self.symbols if name])

    @cached_property
    def meanings(self) -> Mapping[str, Expr]:
        """The meaning of each, in the robot's ring."""
        ring = self.robot.ring
        return {
            name: Expr(ring, ring.ctx.from_dict({e: fmpq(f.numerator, f.denominator) for e, f in c.items()}))
            for name, c in zip(self.symbols, self._found, strict=True)
            if name
        }

    def matrix(self, matrix: Matrix) -> Matrix:
        """A matrix in base parameters."""
        return Matrix.of(self.ring, (map(self.expr, row) for row in matrix.rows))

    def expr(self, expr: Expr) -> Expr:
        """D's or g's entry in base parameters, in `ring`."""
        if expr in self._carried:
            return self._carried[expr]
        ring = self.ring
        total: dict[Exponents, Fraction] = {}
        for motion, coefficient in self._coefficients(expr).items():
            for own, f in self._written(coefficient):
                e = tuple(x + (motion[i] if i < len(motion) else 0) for i, x in enumerate(own))
                total[e] = total.get(e, Fraction(0)) + f
        terms = {e: fmpq(f.numerator, f.denominator) for e, f in total.items() if f}
        self._carried[expr] = Expr(ring, ring.reduce(ring.ctx.from_dict(terms)))
        return self._carried[expr]

    def _written(self, coefficient: Coefficient) -> Iterator[tuple[Exponents, Fraction]]:
        shared, whole = self._without_lengths(coefficient)
        rest, made_of = self._reduced(whole)
        names = [name for name in self.symbols if name]
        for e, f in rest.items():  # beyond HIGHEST: it stays as it is
            yield (*_plus(e, shared), *(0 for _ in names)), f
        for (factor, number), f in made_of.items():
            name = self.symbols[number]
            own = _plus(shared, factor)
            if name is None:
                ((symbol, scale),) = self._found[number].items()
                own, f = _plus(own, symbol), f * scale
            yield (*own, *(int(other == name) for other in names)), f


def _generators_in(exprs: Iterable[Expr]) -> set[int]:
    """The places of the generators that occur."""
    return {i for e in exprs for i, degree in enumerate(e.poly.degrees()) if degree > 0}


_K = TypeVar("_K", bound=Hashable)


def _normalized(coefficient: Coefficient) -> Coefficient:
    """Whole numbers without a common divisor, and positive for the most part."""
    scale: Fraction = Fraction(primitive(coefficient)[1])
    positive = sum(f * scale > 0 for f in coefficient.values())
    if 2 * positive < len(coefficient):
        scale = -scale
    return {e: f / scale for e, f in coefficient.items()}


def _length(coefficient: Coefficient) -> float:
    """Its length to a reader: its terms, with a small extra for a minus sign or a number."""
    return len(coefficient) + sum(0.5 * (abs(f) != 1) + 0.2 * (f < 0) for f in coefficient.values())


def _size(coefficient: Coefficient) -> tuple[int, int]:
    return len(coefficient), sum(map(sum, coefficient))


def _plus(a: Exponents, b: Exponents) -> Exponents:
    return tuple(x + y for x, y in zip(a, b, strict=True))


def _minus(a: Exponents, b: Exponents) -> Exponents:
    return tuple(x - y for x, y in zip(a, b, strict=True))


def _weighted_sum(a: Coefficient, b: Coefficient, factor: int) -> Coefficient:
    """a + factor · b"""
    total = dict(a)
    _add_to(total, b, Fraction(factor))
    return total


def _add_to(total: dict[_K, Fraction], other: Mapping[_K, Fraction], factor: Fraction) -> None:
    """total += factor · other"""
    for key, f in other.items():
        value = total.get(key, 0) + factor * f
        if value:
            total[key] = value
        else:
            del total[key]


# -- hints -----------------------------------------------------------------------------------------

AT_HAND = "You have the equations of motion, one for each coordinate:"

PITFALLS = """
    Multiply the forces out first: what stands beside one function of the motion is one coefficient.
    Coefficients that are sums of others need no entry of their own.
    Y contains no parameter that is unknown, and a nothing that moves.
"""


def inputs(context: Context) -> list[tuple[Node, str]]:
    """The results that it starts from, by letter and name."""
    return [(letters.force(q), f"tau{q.index}") for q in context.robot.coordinates]
