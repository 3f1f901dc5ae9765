"""Putting values in: sums and products are kept, and numbers stay exact."""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy

import dynsolve
from dynsolve.algebra.angles import Angle
from dynsolve.algebra.ring_values import build_ring, value_of
from dynsolve.errors import AlgebraError, UsageError
from dynsolve.notation.text import read
from dynsolve.notation.tree import Degrees, Node, Number
from dynsolve.solution.numbers.substitution import Substitution, rounded, significant, without_constants
from tests.support import STEMS, solved

SMALL = sorted(STEMS - {"puma560", "panda-7r", "stanford-6"})


def tree(text: str) -> Node:
    return read(text).tree


@pytest.mark.parametrize("problem", SMALL)
def test_it_does_not_matter_when_the_numbers_are_put_in(problem: str) -> None:
    """Solving with numbers gives what putting numbers into the solution gives, held in SymPy."""
    solution = solved(problem)
    names = solution.robot.parameters
    values = {name: f"{3 * i + 2}/{7 + i}" for i, name in enumerate(names) if name not in ("beta", "alpha")}
    valued = solution.with_values(**{name.replace("lambda", "lambda_"): v for name, v in values.items()})
    put = {sympy.Symbol(name, real=True): sympy.Rational(v) for name, v in values.items()}
    for name in ("tau", "D"):
        gap = (solution.symbolic(name).subs(put) - valued.symbolic(name)).applyfunc(
            lambda entry: sympy.expand(sympy.expand_trig(entry))
        )
        state = {
            symbol: sympy.Rational(k + 1, 5) for k, symbol in enumerate(sorted(gap.free_symbols, key=str))
        }
        assert max((abs(sympy.N(entry.subs(state))) for entry in gap), default=0) < 1e-12
    assert valued.verification.max_relative_error < 1e-9


def test_it_respects_sums_and_products() -> None:
    trees = [tree("a*sqrt(b) + 1/(a + b)"), tree("cos(beta)*a")]
    ring = build_ring([("q", "revolute")], trees, [Angle.of("q") + Angle.of("beta")])
    x, y = (value_of(ring, t) for t in trees)
    put = Substitution(ring, {("a", 0): Number(2), ("b", 0): Number(3), ("beta", 0): Degrees(30)})
    assert put(x * y) == put(x) * put(y) and put(x + y) == put(x) + put(y)
    assert put(y) == value_of(put.ring, tree("sqrt(3)"))
    assert put(x) == value_of(put.ring, tree("2*sqrt(3) + 1/5"))


def test_formulas_that_lose_their_meaning_are_refused() -> None:
    ring = build_ring([], [tree("1/(a - b)"), tree("sqrt(a)")])
    with pytest.raises(AlgebraError, match="denominator is zero"):
        Substitution(ring, {("a", 0): Number(1), ("b", 0): Number(1)})(value_of(ring, tree("1/(a - b)")))
    text = "dh: [{theta: q1*, a: 1/(l - k)}]\nmasses: [{mass: m1, link: 1}]"
    with pytest.raises(UsageError, match="with these values the robot has no solution"):
        dynsolve.solve(text).with_values(l=1, k=1)


def test_significant_digits() -> None:
    assert significant(Fraction(2, 3), 4) == Fraction("0.6667")
    assert significant(Fraction(2, 300), 3) == Fraction("0.00667")
    assert significant(Fraction("123456.789"), 4) == 123457
    assert significant(Fraction("9.9999"), 4) == 10
    assert significant(Fraction(0), 4) == 0
    assert significant(Fraction("0.15625"), 4) == Fraction("0.1563")  # a half goes up, as it is taught
    assert significant(Fraction("-0.078125"), 4) == Fraction("-0.07813")


def test_rounding_touches_numbers_and_not_exponents() -> None:
    assert rounded(tree("x^12/3 + 1/3*y"), 2) == rounded(tree("x^12/3 + 0.33*y"), 2)


def test_constants_become_decimals_to_forty_digits() -> None:
    ring = build_ring(
        [], [tree(t) for t in ("sqrt(2)", "cos(17deg)", "1/cos(17deg)", "x", "sqrt(1 + sqrt(2))")]
    )
    one = without_constants(value_of(ring, tree("cos(17deg)")) * value_of(ring, tree("1/cos(17deg)")))
    assert one == ring.one
    nested = without_constants(value_of(ring, tree("sqrt(1 + sqrt(2))")))
    assert float(nested.number) == pytest.approx(1.5537739740300374, abs=1e-15)
    mixed = without_constants(value_of(ring, tree("sqrt(2)*x")))
    assert not mixed.is_number and len(mixed) == 1
