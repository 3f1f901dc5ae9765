"""Values and states as users write them: read exactly, every fault at its place."""

from __future__ import annotations

from fractions import Fraction

import pytest

import dynsolve
from dynsolve.algebra.rationals import rational_value
from dynsolve.errors import InputError
from dynsolve.notation.tree import Degrees, Number
from dynsolve.problem import Problem, read_problem
from dynsolve.solution.numbers.given import Given, of_option, parameters, state

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
