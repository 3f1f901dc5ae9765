"""Numbers put into results: values, states, and sets of them."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
import sympy

import dynsolve
from dynsolve import solve
from dynsolve.algebra.angles import Angle
from dynsolve.algebra.rationals import rational_value
from dynsolve.algebra.ring_values import build_ring, value_of
from dynsolve.errors import AlgebraError, InputError, UsageError
from dynsolve.notation.printing import PLAIN
from dynsolve.notation.text import read
from dynsolve.notation.tree import Degrees, Node, Number
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem import Problem, read_problem
from dynsolve.solution.numbers.given import Given, of_call, of_option, parameters, state
from dynsolve.solution.numbers.substitution import Substitution, rounded, significant, without_constants
from tests.support import STEMS, solved

# -- values and states as users write them: read exactly, every fault at its place -------------------


RP = dynsolve.load("in3140-rp")
TILTED = read_problem(
    "dh: [{theta: q1*, a: l1, alpha: beta}, {d: d2*}]\n"
    "masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]\n"
    "values: {l1: 400, beta: 30deg, m2: 0.5}\n"
    "units: {l1: mm, beta: deg}\n"
)


def at(text: str, problem: Problem = RP) -> Given:
    return state(problem, of_option("--at", [text]))


def put(*texts: str, problem: Problem = RP) -> Given:
    return parameters(problem, of_option("--set", texts))


def faults(text: str, read: object = at) -> list[str]:
    with pytest.raises(InputError) as raised:
        read(text)  # type: ignore[operator]
    return [str(finding) for finding in raised.value.findings]


def test_a_state_is_exact() -> None:
    values = at("theta1=30deg, L2=0.2, θ1'=1/2, L2_ddot=-3").values
    assert values["theta1", 0] == Degrees(30)
    assert rational_value(values["L2", 0]) == Fraction(1, 5)
    assert rational_value(values["theta1", 1]) == Fraction(1, 2)
    assert rational_value(values["L2", 2]) == -3
    assert values["theta1", 2] == values["L2", 1] == Number(0)


def test_whether_a_decimal_goes_in() -> None:
    assert not at("theta1=30deg,L2=1/5").decimal
    assert at("theta1=30deg,L2=0.2").decimal
    assert at("theta1=30.5deg,L2=1").decimal
    assert at("theta1=30deg,L2=2e-1").decimal


def test_the_unit_of_a_value_is_the_files_or_the_one_of_its_role() -> None:
    entries = put("L1=0.4", "I1zz=1,g=9.81").entries
    assert [entries[name, 0].unit for name in ("L1", "I1zz", "g")] == ["m", "kg m^2", "m/s^2"]


def test_values_of_the_file_are_turned_into_si_units() -> None:
    given = parameters(TILTED, ())
    assert rational_value(given.values["l1", 0]) == Fraction(2, 5)
    assert given.entries["l1", 0].unit == "mm" and given.entries["l1", 0].text == "400"
    assert given.values["beta", 0] == Degrees(30)
    assert ("m1", 0) not in given.entries


def test_what_is_set_wins_over_the_file() -> None:
    given = put("l1=500", "beta=45", problem=TILTED)
    assert rational_value(given.values["l1", 0]) == Fraction(1, 2)  # in the unit of the file
    assert given.values["beta", 0] == Degrees(45)


def test_roots_and_pi_are_values() -> None:
    assert ("L1", 0) in put("L1=sqrt(2)/2").values
    assert ("theta1", 0) in at("theta1=pi/6,L2=1").values


@pytest.mark.parametrize(
    ("text", "said", "help"),
    [
        ("theta1=30,L2=1", "--at:8: the bare number 30 stands as an angle", "did you mean 30deg?"),
        ("theta1=30deg,theta=2deg,L2=1", "--at:14: theta does not occur in this problem", "`theta1`?"),
        ("theta1=30deg", "--at: the state lacks L2", "add L2=0.2"),
        ("L2=1", "--at: the state lacks theta1", "add theta1=30deg"),
        ("L2_dot=1", "--at: the state lacks theta1 and L2", "add theta1=30deg,L2=0.2"),
        ("theta1=1deg,L2=1,L1=2", "--at:18: L1 is a parameter of the robot", "--set L1=2"),
        ("theta1=1deg,L2=30deg", "--at:16: L2 is a length, and is given an angle", ""),
        ("theta1=1deg,L2=(1", "this `(` is never closed", ""),
        ("theta1=1deg,L2=2*L1", "--at:18: the value of L2 contains the name L1", "a value is a number"),
        ("theta1=1deg,L2=1,L2=2", "--at:18: L2 has a value already", ""),
        ("theta1", "--at:1: `theta1` is no assignment", "write name=value"),
        ("", "--at:1: nothing is assigned", "write name=value"),
    ],
)
def test_faults_of_a_state(text: str, said: str, help: str) -> None:
    (found,) = faults(text)
    assert said in found and help in found


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("L3=1", "did you mean `L1`?"),
        ("theta1=30deg", "give it as a state: --at theta1=..."),
        ("L2_dot=1", "changes with the motion"),
        ("L1=30deg", "L1 is no angle"),
        ("m1=9**9**9", "exponent"),
        ("m1=__import__('os')", "--set:4"),
    ],
)
def test_faults_of_a_parameter(text: str, said: str) -> None:
    (found,) = faults(text, put)
    assert said in found


def test_all_faults_come_at_once() -> None:
    assert len(faults("theta1=30,L2=x,v=2")) == 3


def test_units_that_do_not_fit_are_remarked() -> None:
    text = "dh: [{theta: q1*, a: l1}]\nmasses: [{mass: m1, link: 1}]\n"
    text += "values: {l1: 2, m1: 1}\nunits: {l1: kg, m1: ell}\n"
    one, other = parameters(read_problem(text), ()).warnings
    assert "the unit of l1 is kg; where it stands it is measured in m" in str(one)
    assert "the unit `ell` of m1 is not known" in str(other) and str(other).startswith("4:")


# -- singular configurations and equilibria of a robot with numbers: in these, letters beside them ---


ARM = "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2, alpha: 90deg}, {theta: q3*, a: l3}]\nfind: [singular]\n"
"""Where l2 + l3 cos q3 = 0 the tip is on the axis of joint 2, which it reaches where l3 ≥ l2."""

HOOP = """gravity: [0, 0, -g]
model:
  coordinates: {phi: revolute, theta: revolute}
  bodies:
    - {mass: m, at: [a*sin(theta)*cos(phi), a*sin(theta)*sin(phi), -a*cos(theta)]}
steady: {phi: W}
find: [equilibria]
"""
"""Goldstein, Poole, Safko (2002), exercise 2.18: off the axis where a W² > g, at cos θ = g/(a W²)."""


def with_values(text: str, **values: str) -> tuple[dict[str, Any], dict[str, Any]]:
    """The results in letters, and those with values."""
    found = solve(f"title: Sets\n{text}").beside(of_call(values)).to_json()
    return found["results"], found["values"]["results"]


@pytest.mark.parametrize(
    ("l2", "l3", "singular"),
    [
        ("1", "2", [["1 + 2*cos(q3) = 0"], ["sin(q2) = 0"], ["cos(q3) = 0"]]),
        ("0.5", "4", [["1 + 8*cos(q3) = 0"], ["sin(q2) = 0"], ["cos(q3) = 0"]]),
        ("2", "1", [["sin(q2) = 0"], ["cos(q3) = 0"]]),
    ],
)
def test_where_an_arm_of_these_lengths_is_singular(l2: str, l3: str, singular: list[list[str]]) -> None:
    letters, numbers = with_values(f"gravity: none\n{ARM}", l1="3", l2=l2, l3=l3)
    assert ["l2 + l3*cos(q3) = 0"] in letters["singular"]
    assert letters["singular_exist"]
    assert sorted(numbers["singular"]) == sorted(singular)
    assert "singular_exist" not in numbers


@pytest.mark.parametrize(
    ("rate", "equilibria", "below"),
    [
        ("1", [["sin(theta) = 0"]], "stable"),
        ("3", [["3*cos(theta) - 1.09 = 0"], ["sin(theta) = 0"]], "unstable"),
    ],
)
def test_where_a_hoop_of_this_rate_has_its_bead(rate: str, equilibria: list[list[str]], below: str) -> None:
    letters, numbers = with_values(HOOP, a="3", m="1", g="9.81", W=rate)
    assert letters["equilibria"] == [["a*W**2*cos(theta) - g = 0"], ["sin(theta) = 0"]]
    assert numbers["equilibria"] == equilibria
    assert numbers["equilibria_stability"][-1][0] == {"theta": "0", "stability": below}
    assert "equilibria_exist" not in numbers


def test_inequalities_that_are_assumed_go_with_the_numbers() -> None:
    spring = """gravity: [0, -g, 0]
dh: [{theta: q1* + 90deg, a: l}]
masses: [{mass: m, link: 1}]
springs: [{energy: k*(1 - cos(q1))}]
assume: [k > m*g*l]
find: [equilibria]
"""
    letters, numbers = with_values(spring, m="2", l="1/2")
    for results in (letters, numbers):
        points = [point for one in results["equilibria_stability"] for point in one]
        assert {point["q1"]: point["stability"] for point in points}["0"] == "stable"


# -- what holds at a state: exact where that makes sense, decimals elsewhere, true everywhere --------


@pytest.fixture(scope="module")
def rp() -> dynsolve.Solution:
    return dynsolve.solve("in3140-rp")


def test_thirty_degrees_are_exact(rp: dynsolve.Solution) -> None:
    state = rp.at(theta1="30deg", L2="1/5", theta1_dot=2)
    assert state.symbolic("H2")[0, 3] == sympy.sqrt(3) / 10
    assert state.symbolic("tau")[1] == -sympy.Rational(4, 5) * sympy.Symbol("m2", real=True)
    assert to_unicode(state.shown("v2"), PLAIN) == "[[-1/5], [√3/5], [0]]"


def test_a_decimal_makes_decimals(rp: dynsolve.Solution) -> None:
    shown = rp.at(theta1="30deg", L2=0.2, theta1_dot=2).shown("v2")
    assert to_unicode(shown, PLAIN) == "[[-0.2], [0.3464], [0]]"
    odd = rp.at(theta1="17deg", L2=1)
    assert to_unicode(odd.shown("H2"), PLAIN).startswith("[[-0.2924, 0, 0.9563, 0.9563]")


def test_zeros_are_zeros_at_any_angle(rp: dynsolve.Solution) -> None:
    """K does not depend on the angle, so that its square sum must not leave rounding."""
    state = rp.at(theta1="17.3deg", L2="1/3", theta1_dot=1)
    m2, I1zz = sympy.symbols("m2 I1zz", real=True)
    assert sympy.expand(state.symbolic("K") - m2 / 18 - I1zz / 2) == 0


@pytest.mark.parametrize(
    "problem", ["planar-2r", "rp-vertical", "scara-rrpr", "numeric-2r", "planar-2r-remote"]
)
def test_a_state_is_what_the_numpy_function_gives(problem: str) -> None:
    solution = dynsolve.solve(problem)
    names = solution.robot.parameters
    values = {name: 0.3 + 0.1 * i for i, name in enumerate(names)}
    angles = [37.0, -20.5, 15.0, 60.0]
    given: dict[str, object] = {}
    q = []
    for coordinate, degrees in zip(solution.robot.coordinates, angles, strict=False):
        turns = coordinate.type.value == "revolute"
        given[coordinate.name] = f"{degrees}deg" if turns else 0.25
        q.append(math.radians(degrees) if turns else 0.25)
        given[coordinate.velocity] = 0.5
        given[coordinate.acceleration] = -1.5
    state = solution.with_values(**values).at(**given)  # type: ignore[arg-type]
    n = len(q)
    for name in ("D", "C", "tau", "g", "K", "P"):
        numpy = solution.numeric(name)(q, [0.5] * n, [-1.5] * n, **values)
        np.testing.assert_allclose(np.ravel(state.number(name)), np.ravel(numpy), rtol=1e-12, atol=1e-12)


def test_a_symbol_that_is_left_has_no_float(rp: dynsolve.Solution) -> None:
    state = rp.at(theta1=0, L2=1)
    assert state.number("g") == [[0.0], [0.0]]
    with pytest.raises(ValueError, match="D holds parameters without values"):
        state.number("D")


def test_missing_coordinates_are_named(rp: dynsolve.Solution) -> None:
    with pytest.raises(InputError, match="the state lacks L2"):
        rp.at(theta1="30deg")


def test_values_of_the_file_are_used_on_request() -> None:
    text = "dh: [{theta: q1*, a: l1}]\nmasses: [{mass: m1, link: 1}]\nvalues: {l1: 1/2, m1: 2}"
    solution = dynsolve.solve(text)
    assert solution.D[0] == sympy.Symbol("l1", real=True) ** 2 * sympy.Symbol("m1", real=True)
    assert solution.with_values().D[0] == sympy.Rational(1, 2)
    assert solution.with_values(m1=4).D[0] == 1
    assert solution.with_values(m1=4).given.entries["m1", 0].text == "4"


# -- putting values in: sums and products are kept, and numbers stay exact ---------------------------


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
    exact, given = (to_unicode(rounded(tree(text), 2)) for text in ("x^12/3 + 1/3*y", "x^12/3 + 0.33*y"))
    assert exact == given


def test_what_is_rounded_remembers_it() -> None:
    for text, wanted in (("1/3", True), ("0.33", False), ("0.333", True)):
        number = rounded(tree(text), 2)
        assert isinstance(number, Number) and number.rounded is wanted


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
