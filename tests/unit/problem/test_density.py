"""Shapes with a density: their integrals against sums over small pieces, by hand, and what is refused."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from itertools import product
from math import cos, pi, sin

import pytest

import dynsolve
from dynsolve.errors import ProblemError
from dynsolve.problem import read_problem
from dynsolve.problem.lint import lint_text
from dynsolve.robot.model import Body
from dynsolve.robot.shapes import KINDS
from tests.unit.problem.marked import errors

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


# -- every shape, against a sum over pieces --------------------------------------------------------

SIZES = {
    "x": 0.8, "y": 0.5, "z": 0.3, "radius": 0.4, "outer": 0.5, "inner": 0.2, "length": 0.9,
}  # fmt: skip
PIECES = 24
Piece = tuple[float, float, float, float]
"""x along the axis from the near end, two places across it from the axis, and how much of the shape it is."""


def middles(low: float, high: float) -> list[tuple[float, float]]:
    step = (high - low) / PIECES
    return [(low + (k + 0.5) * step, step) for k in range(PIECES)]


def around(radius: float) -> list[tuple[float, float]]:
    return [(radius * cos(2 * pi * k / 8), radius * sin(2 * pi * k / 8)) for k in range(8)]


def rings(inner: float, outer: float) -> list[tuple[float, float, float]]:
    """(two places, area) of pieces of an annulus."""
    return [(u, v, 2 * pi * r * dr / 8) for r, dr in middles(inner, outer) for u, v in around(r)]


def solid(length: float, across: list[tuple[float, float, float]]) -> list[Piece]:
    return [(x, u, v, dx * dA) for (x, dx), (u, v, dA) in product(middles(0, length), across)]


def box(axis: str) -> list[Piece]:
    own = "xyz".index(axis)
    length, *sides = (SIZES["xyz"[(own + k) % 3]] for k in range(3))
    pieces = [middles(-side / 2, side / 2) for side in sides]
    return solid(length, [(u, v, du * dv) for (u, du), (v, dv) in product(*pieces)])


def ball(hollow: bool) -> list[Piece]:
    r = SIZES["radius"]
    if hollow:
        return [
            (r - r * cos(t), u, v, 2 * pi * r * r * sin(t) * dt / 8)
            for t, dt in middles(0, pi)
            for u, v in around(r * sin(t))
        ]
    return [
        (x, u, v, dx * dA)
        for x, dx in middles(0, 2 * r)
        for u, v, dA in rings(0, (r * r - (x - r) ** 2) ** 0.5)
    ]


PIECES_OF: dict[str, Callable[[str], list[Piece]]] = {
    "rod": lambda _: [(x, 0.0, 0.0, dx) for x, dx in middles(0, SIZES["length"])],
    "cylinder": lambda _: solid(SIZES["length"], rings(0, SIZES["radius"])),
    "hollow_cylinder": lambda _: solid(SIZES["length"], rings(SIZES["inner"], SIZES["outer"])),
    "box": box,
    "disk": lambda _: [(0.0, u, v, dA) for u, v, dA in rings(0, SIZES["radius"])],
    "sphere": lambda _: ball(hollow=False),
    "shell": lambda _: ball(hollow=True),
}


def body(kind: str, axis: str, density: str, more: str = "") -> Body:
    sizes = ", ".join(f"{key}: {SIZES[key]}" for key in KINDS[kind].keys)
    shape = f"{{{kind}: {{{sizes}, axis: {axis}, density: {density}}}}}"
    return read_problem(
        f"dh: [{{theta: q1*, a: 1}}]\nmasses: [{{link: 1, shape: {shape}{more}}}]"
    ).robot.bodies[0]


def number(value: object) -> float:
    from dynsolve.algebra.ring import Expr

    assert isinstance(value, Expr)
    names = [g.name for g in value.ring.generators]
    known = {"pi": pi, "rho0": 2.0}
    total = 0.0
    for exponents, factor in value.poly.to_dict().items():
        term = float(Fraction(int(factor.p), int(factor.q)))
        for name, exponent in zip(names, exponents, strict=True):
            if exponent:
                term *= known[name] ** int(exponent)
        total += term
    return total


@pytest.mark.parametrize("axis", "xyz")
@pytest.mark.parametrize("kind", sorted(set(KINDS) - {"point"}))
def test_every_shape_is_the_sum_of_its_pieces(kind: str, axis: str) -> None:
    varies = kind != "disk"
    found = body(kind, axis, "rho0*(1 + 3*x^2)" if varies else "rho0")
    pieces = [
        (x, u, v, 2 * (1 + 3 * x * x if varies else 1) * amount) for x, u, v, amount in PIECES_OF[kind](axis)
    ]
    mass = sum(dm for *_, dm in pieces)
    center = sum(x * dm for x, _, _, dm in pieces) / mass
    moments = (
        sum((u * u + v * v) * dm for _, u, v, dm in pieces),
        sum(((x - center) ** 2 + v * v) * dm for x, _, v, dm in pieces),
        sum(((x - center) ** 2 + u * u) * dm for x, u, _, dm in pieces),
    )
    own = "xyz".index(axis)
    assert found.inertia is not None
    assert number(found.mass) == pytest.approx(mass, rel=3e-3)
    near = [-1.0, 0.0, 0.0]  # the near end of the link, in its frame
    near[own] += center
    assert [number(entry) for entry in found.center.entries] == pytest.approx(near, abs=3e-3)
    for k, moment in enumerate(moments):
        i = (own + k) % 3
        assert number(found.inertia[i, i]) == pytest.approx(moment, rel=3e-3, abs=1e-9)
    assert all(found.inertia[i, j].is_zero for i in range(3) for j in range(3) if i != j)


@pytest.mark.parametrize("kind", sorted(set(KINDS) - {"point"}))
def test_a_constant_density_gives_the_moments_of_the_uniform_shape(kind: str) -> None:
    found = body(kind, "x", "rho0", ", center: tip")
    assert found.density is not None and found.density.shape is not None and found.inertia is not None
    assert found.inertia == found.density.shape.inertia(found.mass)
    assert found.center.is_zero


@pytest.mark.parametrize(("row", "place"), [("a: l1", "-l1/2"), ("a: -l1", "l1/2"), ("d: l1", "-l1/2")])
def test_x_runs_along_the_link_from_its_near_end(row: str, place: str) -> None:
    text = (
        f"dh: [{{theta: q1*, {row}}}]\nmasses: [{{link: 1, shape: {{rod: {{length: l1, density: rho0}}}}}}]"
    )
    found = read_problem(text).robot.bodies[0].center
    ring = found.ring
    half = ring.symbol("l1") * Fraction(1, 2)
    assert found.entries[2 if row.startswith("d") else 0] == (half if place == "l1/2" else -half)


def test_the_axes_of_the_body_turn_what_begins_at_the_near_end() -> None:
    text = """
dh: [{theta: q1*, a: l1}]
masses: [{link: 1, axes: Rz(90deg), shape: {rod: {length: b, axis: x, density: rho0}}}]
"""
    found = read_problem(text).robot.bodies[0].center
    assert found[0, 0] == -found.ring.symbol("l1")
    assert found[1, 0] == found.ring.symbol("b") * Fraction(1, 2)


@pytest.mark.parametrize(("kind", "lines"), [("rod", 3), ("disk", 2), ("sphere", 4)])
def test_the_integrals_are_a_step(kind: str, lines: int) -> None:
    sizes = ", ".join(f"{key}: {key[0]}0" for key in KINDS[kind].keys)
    text = f"""
dh: [{{theta: q1*, a: l}}]
masses: [{{link: 1, shape: {{{kind}: {{{sizes}, axis: x, density: rho0}}}}}}]
"""
    steps = {step.id: step for step in dynsolve.solve(text).steps}
    assert len(steps["density1"].lines) == lines
    assert not lint_text(text)


def test_a_length_may_be_a_term_of_the_mass_that_follows() -> None:
    """1 + 2 x over the length b is b + b²: b is no mass for that."""
    assert not errors(
        "dh: [{theta: q1*, a: b}]\nmasses: [{link: 1, shape: {rod: {length: b, density: 1 + 2*x}}}]"
    )


# -- what is refused -------------------------------------------------------------------------------


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


@pytest.mark.parametrize("key", ["mass: m", "inertia: {zz: I}"])
def test_what_follows_is_not_given(key: str) -> None:
    text = PENDULUM.format(density="rho0").replace("{link: 1,", f"{{link: 1, {key},")
    with pytest.raises(ProblemError, match="from which its"):
        read_problem(text, "rod.yaml")


@pytest.mark.parametrize(
    ("shape", "message", "help"),
    [
        ("disk: {radius: r, density: rho0*x}", "no extent along its axis", "rho0"),
        ("box: {x: a, y: b, z: h, density: rho0}", "no axis that x runs along", "axis: x"),
        ("sphere: {radius: r, axis: z}", "nothing varies", "density"),
        ("cylinder: {radius: x, length: l, density: rho0}", "x is the place along", "another name"),
    ],
)
def test_a_density_that_cannot_be_integrated(shape: str, message: str, help: str) -> None:
    mass = "" if "density" in shape else ", mass: m, center: tip"
    (error,) = errors(f"dh: [{{theta: q1*, a: l}}]\nmasses: [{{link: 1, shape: {{{shape}}}{mass}}}]")
    assert message in error.message
    assert help in error.help


def test_bodies_without_a_mass_are_told_names_of_their_own() -> None:
    bodies = ", ".join("{link: 1, shape: {rod: {length: l}}, center: tip}" for _ in range(3))
    found = errors(f"dh: [{{theta: q1*, a: l}}]\nmasses: [{bodies}]")
    assert [f"mass: m{k}" in error.help and "density" in error.help for k, error in enumerate(found, 1)] == [
        True
    ] * 3
