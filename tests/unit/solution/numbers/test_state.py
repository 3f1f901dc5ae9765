"""What holds at a state: exact where that makes sense, decimals elsewhere, true everywhere."""

from __future__ import annotations

import math

import numpy as np
import pytest
import sympy

import dynsolve
from dynsolve.errors import InputError
from dynsolve.notation.printing import PLAIN
from dynsolve.notation.unicode import to_unicode


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
