"""Units: their size, their dimension, and what results are measured in."""

from __future__ import annotations

from fractions import Fraction

import pytest

import dynsolve
from dynsolve.notation.markup import to_latex
from dynsolve.notation.printing import PLAIN
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem import read_problem
from dynsolve.robot import units
from dynsolve.robot.dimensions import measured_along
from dynsolve.solution.numbers import given


@pytest.mark.parametrize(
    ("text", "size", "si"),
    [
        ("m", "1", "m"),
        ("mm", "1/1000", "m"),
        ("g", "1/1000", "kg"),
        ("kg m^2", "1", "kg m^2"),
        ("g*cm²", "1/10000000", "kg m^2"),
        ("m s^-2", "1", "m/s^2"),
        ("m/s**2", "1", "m/s^2"),
        ("N·m", "1", "J"),
        ("Nm", "1", "J"),
        ("kN", "1000", "N"),
        ("1", "1", ""),
    ],
)
def test_known_units(text: str, size: str, si: str) -> None:
    unit = units.parse(text)
    assert unit is not None and unit.size == Fraction(size) and units.si(unit.dimension) == si


@pytest.mark.parametrize("text", ["furlong", "%", "kg/(m s)", "m^", "deg m", "m^x"])
def test_unknown_units(text: str) -> None:
    assert units.parse(text) is None


def test_units_are_upright_with_raised_powers() -> None:
    assert to_unicode(units.node("kg m^2/s"), PLAIN) == "kg m²/s"
    assert to_latex(units.node("kg m²"), PLAIN) == r"\text{kg } \mathrm{m}^{2}"


def test_parameters_have_the_dimension_of_their_role() -> None:
    found = given.of_parameters(dynsolve.load("in3140-rp").robot)
    assert {name: units.si(dim) for name, dim in found.items()} == {
        "L1": "m", "m1": "kg", "I1zz": "kg m^2", "m2": "kg", "g": "m/s^2",
    }  # fmt: skip


def test_results_of_an_angle_and_a_length() -> None:
    robot = dynsolve.load("in3140-rp").robot

    def of(name: str) -> object:
        return given.of_result(robot, name)

    assert of("D") == [["kg m^2", "kg m"], ["kg m", "kg"]]
    assert of("C") == [["kg m^2/s", "kg m/s"], ["kg m/s", "kg/s"]]
    assert of("tau") == of("g") == [["N m"], ["N"]]
    assert (of("tau1"), of("tau2"), of("dLdqd1"), of("dLdqd2")) == ("N m", "N", "kg m^2/s", "kg m/s")
    assert of("P") == of("K") == of("L") == of("Kv1") == of("K2") == "J"
    assert of("rc1") == [["m"]] * 3 and of("v2") == [["m/s"]] * 3 and of("w1") == [["rad/s"]] * 3
    assert of("I1") == [["kg m^2"] * 3] * 3
    assert of("Jv2") == [["m", ""]] * 3 and of("R1") == ""


def test_a_size_of_a_shape_is_a_length_also_where_the_mass_is_a_number() -> None:
    box = "{mass: 2, link: 1, center: tip, shape: {box: {x: b, y: b, z: e}}}"
    found = given.of_parameters(read_problem(f"dh: [{{theta: q1*, a: l1}}]\nmasses: [{box}]\n").robot)
    assert {name: units.si(found[name]) for name in "be"} == {"b": "m", "e": "m"}


@pytest.mark.parametrize(
    ("form", "unit"),
    [
        ("y - 0.2*p", "m"),
        ("y - p", "m"),
        ("2*y - 3*p", "m"),
        ("y - b*p", "m"),
        ("p - 5*y", ""),
        ("2*p", ""),
        ("b*p", None),
    ],
)
def test_a_length_that_stands_alone_makes_a_form_a_length(form: str, unit: str | None) -> None:
    model = "model: {coordinates: {y: prismatic, p: revolute}, bodies: [{mass: m, at: [b, y, 0], turn: p}]}\n"
    robot = read_problem(f"{model}springs: [{{stiffness: 400, of: {form}}}]\n").robot
    (spring,) = robot.actions.acts
    found = measured_along(robot, spring.along[0])
    assert (found and units.si(found)) == unit
