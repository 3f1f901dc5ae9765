"""The way to an unknown of the inverse kinematics: components turned, squared and added, then sorted."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from dynsolve.algebra.expr import Expr
from dynsolve.derivation.inverse.equations import Direct, Equation, Given, Squared, Turned, lineage
from dynsolve.derivation.inverse.subproblems import OneLine, Solved, TwoLines
from dynsolve.document import Prose
from dynsolve.explain.inverse_formulas import InverseFormulas
from dynsolve.explain.step import Line
from dynsolve.explain.writing import listed
from dynsolve.notation.build import power, times, total
from dynsolve.notation.tree import Function, Node, Symbol, equation


@dataclass(frozen=True)
class InverseWay:
    """The lines to the equations of one step; `before` are the steps that were taken earlier."""

    formulas: InverseFormulas
    step: Solved
    before: tuple[Solved, ...]

    @property
    def working(self) -> tuple[Node, ...]:
        """The equations that it begins with: components of the task, or equations of earlier steps."""
        return tuple(map(self._equation, sorted(self._first, key=_component)))

    @property
    def lines(self) -> Iterator[Line]:
        """How the others are made of them, and how the unknown is taken out."""
        pairs: dict[tuple[Expr, Expr, str], dict[bool, Equation]] = {}
        for made in self._made:
            match made.origin:
                case Turned(first, second, name, is_second):
                    pairs.setdefault((first.expr, second.expr, name), {})[is_second] = made
        told: set[tuple[Expr, Expr, str]] = set()
        for made in self._made:
            match made.origin:
                case Turned(first, second, name):
                    key = first.expr, second.expr, name
                    if key not in told:
                        told.add(key)
                        yield self._turned((first, second), name, pairs[key])
                case Squared(parts):
                    squares = equation(
                        total([power(self._form(e.left), 2) for e in parts if not e.left.is_zero]),
                        total([power(self._form(e.right), 2) for e in parts]),
                    )
                    yield Line(("The squares of these equations, added:",), (squares,))
                    yield Line(("Multiplied out, with s² + c² = 1:",), (self._equation(made),))
        yield from self._sorted()

    # -- where the equations come from -------------------------------------------------------------

    @property
    def _shown(self) -> Mapping[Expr, None]:
        """What is 0 by an equation that an earlier step has shown."""
        return dict.fromkeys(e.expr for step in self.before for e in lineage(step.equations))

    @property
    def _needed(self) -> tuple[Equation, ...]:
        """The equations of this step with those that they come from, as far as they are new, each once."""
        return tuple({e.expr: e for e in self._new(self.step.equations)}.values())

    def _new(self, equations: tuple[Equation, ...]) -> Iterator[Equation]:
        for e in equations:
            if e.expr not in self._shown:
                match e.origin:
                    case Turned(first, second):
                        yield from self._new((first, second))
                    case Squared(parts):
                        yield from self._new(parts)
            yield e

    @property
    def starts_anew(self) -> bool:
        """Whether an equation that it starts from was in no earlier step."""
        return any(e.expr not in self._shown for e in self._first)

    @property
    def _first(self) -> tuple[Equation, ...]:
        return tuple(e for e in self._needed if self._is_first(e))

    @property
    def _made(self) -> tuple[Equation, ...]:
        return tuple(e for e in self._needed if not self._is_first(e))

    def _is_first(self, e: Equation) -> bool:
        return isinstance(e.origin, Direct) or e.expr in self._shown

    def _turned(self, pair: tuple[Equation, Equation], name: str, made: Mapping[bool, Equation]) -> Line:
        """Two components turned back by an angle, as the sums that a hand writes."""
        c, s = (Function(f, Symbol(name)) for f in ("cos", "sin"))
        one, other = (self._form(e.left) for e in pair)
        ways: dict[bool, Prose] = {
            False: (c, " times the equation of ", one, " plus ", s, " times that of ", other),
            True: (c, " times the equation of ", other, " minus ", s, " times that of ", one),
        }
        said = listed([ways[is_second] for is_second in sorted(made)])
        by: Prose = ("Turned back by ", Symbol(name), " (", *said, "):")
        return Line(by, tuple(self._equation(made[is_second]) for is_second in sorted(made)))

    # -- the unknown -------------------------------------------------------------------------------

    def _sorted(self) -> Iterator[Line]:
        """The equations as sums of the cosine and the sine of the unknown."""
        q = Symbol(self.step.coordinate)
        match self.step:
            case TwoLines(_, first, second):
                if max(map(len, (*first[:2], *second[:2]))) > 1:
                    by: Prose = ("Sorted by the cosine and the sine of ", q, ":")
                    yield Line(by, (self._line(*first), self._line(*second)))
            case OneLine(_, cosine, sine, value) if not value.is_zero:
                if cosine.is_zero or sine.is_zero:
                    name = "cos" if sine.is_zero else "sin"
                    solved = equation(Function(name, q), self.formulas.ratio(value, cosine + sine))
                    yield Line((f"Solved for the {'cosine' if sine.is_zero else 'sine'}:",), (solved,))
                else:
                    by = ("Sorted by the cosine and the sine of ", q, ":")
                    yield Line(by, (self._line(cosine, sine, value),))

    def _line(self, cosine: Expr, sine: Expr, value: Expr) -> Node:
        """A cos q + B sin q = X"""
        q = Symbol(self.step.coordinate)
        terms = [
            times(1, [(self._form(factor), 1), (Function(name, q), 1)])
            for factor, name in ((cosine, "cos"), (sine, "sin"))
            if not factor.is_zero
        ]
        return equation(total(terms), self._form(value))

    def _equation(self, e: Equation) -> Node:
        return equation(self._form(e.left), self._form(e.right))

    def _form(self, expr: Expr) -> Node:
        return self.formulas.form(expr)


def _component(e: Equation) -> float:
    """Components of the task in their order, what was made of them behind."""
    return e.origin.index if isinstance(e.origin, Given) else float("inf")
