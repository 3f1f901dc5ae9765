"""Rods whose density varies: their integrals by hand, and what is refused."""

from __future__ import annotations

import pytest

import dynsolve
from dynsolve.errors import ProblemError
from dynsolve.problem import read_problem

PENDULUM = """
gravity: [0, -g, 0]
dh: [{{theta: q1*, a: l}}]
masses:
  - {{link: 1, shape: {{rod: {{length: l, axis: x, density: {density}}}}}}}
find: [D, g]
"""


@pytest.mark.parametrize(
    ("density", "D", "g"),
    [
        ("rho0", "l**3*rho0/3", "g*l**2*rho0*cos(q1)/2"),
        ("rho0*(1 + x/l)", "7*l**3*rho0/12", "5*g*l**2*rho0*cos(q1)/6"),
        ("rho0*x^2/l^2", "l**3*rho0/5", "g*l**2*rho0*cos(q1)/4"),
        ("m/l", "m*l**2/3", "m*g*l*cos(q1)/2"),
    ],
)
def test_the_moments_by_hand(density: str, D: str, g: str) -> None:
    """∫ ρ x² dx about the joint, and the weight times ∫ ρ x dx."""
    import sympy

    found = dynsolve.solve(PENDULUM.format(density=density))
    names = {name: sympy.Symbol(name, real=True) for name in ("l", "rho0", "g", "m", "q1")}
    assert sympy.simplify(found.D[0, 0] - sympy.sympify(D, names)) == 0
    assert sympy.simplify(found.g[0] - sympy.sympify(g, names)) == 0


def test_a_mass_that_divides_the_centre() -> None:
    """ρ = a + b x: the centre is a quotient, and D is ∫ ρ x² dx all the same."""
    import sympy

    found = dynsolve.solve(PENDULUM.format(density="a + b*x"))
    a, b, l = sympy.symbols("a b l", real=True)  # noqa: E741
    assert sympy.simplify(found.D[0, 0] - (a * l**3 / 3 + b * l**4 / 4)) == 0


def test_the_integrals_are_a_step() -> None:
    steps = {step.id: step for step in dynsolve.solve(PENDULUM.format(density="rho0")).steps}
    assert len(steps["density1"].lines) == 3


@pytest.mark.parametrize(
    ("density", "message"),
    [
        ("sin(x)", "no polynomial in x|x stands|sin"),
        ("1/(1 + x)", "no polynomial in x|denominator|divi"),
        ("x^9", "no polynomial in x"),
        ("0", "the mass that comes of this density is 0"),
        ("q1", "joint variables stand in the table|coordinate"),
    ],
)
def test_what_is_no_density(density: str, message: str) -> None:
    with pytest.raises(ProblemError, match=message):
        read_problem(PENDULUM.format(density=density), "rod.yaml")


@pytest.mark.parametrize("key", ["mass: m", "center: midpoint", "inertia: {zz: I}"])
def test_what_follows_is_not_given(key: str) -> None:
    text = PENDULUM.format(density="rho0").replace("{link: 1,", f"{{link: 1, {key},")
    with pytest.raises(ProblemError, match="from which its"):
        read_problem(text, "rod.yaml")
