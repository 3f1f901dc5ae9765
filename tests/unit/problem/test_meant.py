"""What was meant: answers by the words of the field, and decimals with a comma."""

from __future__ import annotations

import pytest

from dynsolve.quantities.families import FAMILIES
from tests.unit.problem.marked import errors, places, unmarked

ARM = """
dh: [{theta: q1*, a: l1}, {d: d2*}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
"""


def test_a_term_is_of_one_family() -> None:
    terms = [term for family in FAMILIES for term in family.terms]
    assert len(set(terms)) == len(terms) > 90


@pytest.mark.parametrize("key", ["find: [{}]", "marks: {{{}: 2}}", "remarks: {{{}: Mind the sign.}}"])
@pytest.mark.parametrize(
    ("word", "name"),
    [
        ("torque", "tau"),
        ("torques", "tau"),
        ("Kinetic", "K"),
        ("kinetic_energy", "K"),
        ("potential energy", "P"),
        ("kinetic energy 2", "K2"),
        ("torque 2", "f2"),
        ("lagrangain", "L"),
        ("inertia-matrix", "D"),
        ("coriolis", "C"),
        ("gravity", "g"),
        ("jacobian", "J"),
        ("singularities", "singular"),
        ("inverse kinematics", "inverse"),
        ("determinant", "det"),
        ("taw1", "tau1"),
    ],
)
def test_a_word_of_the_field_is_understood(key: str, word: str, name: str) -> None:
    (error,) = errors(f"{key.format(word)}\n" + ARM)
    assert error.help == f"did you mean `{name}`?"


@pytest.mark.parametrize("word", ["foo", "weather"])
def test_a_word_of_no_field_is_told_what_there_is(word: str) -> None:
    (error,) = errors(f"find: [{word}]\n" + ARM)
    assert error.help.startswith("answers are tau, D, C, g")


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("values: {g: «9,81»}\n" + ARM, "9.81"),
        ("values: {l1: «0,4», m1: 2}\n" + ARM, "0.4"),
        ("values:\n  g: 9«,»81\n" + ARM, "9.81"),
        ("gravity: «[0, 0, -9,81]»\n" + ARM, "-9.81"),
        ("marks: {P: «2,5», K: 1}\n" + ARM, "2.5"),
        ("limits: {q1: [0, 90deg], d2: «[0, 1,5]»}\nfind: [inverse]\n" + ARM, "1.5"),
        ("dh: [{theta: q1*, a: «0,4»}]\n", "0.4"),
        ("dh: [«[q1*, 0, 0,4, 0]»]\n", "0.4"),
        ("dh: [{theta: q1*, a: '2*(0«,»5 + l)'}]\n", "0.5"),
        ("dh: [{theta: q1*}]\nmasses: [{mass: «1,5», link: 1, center: tip}]\n", "1.5"),
    ],
)
def test_a_decimal_comma_is_seen_once_where_it_stands(text: str, number: str) -> None:
    plain, expected = unmarked(text)
    found = errors(plain)
    assert places(found) == expected
    assert f"did you mean {number}?" in found[0].help


@pytest.mark.parametrize("text", ["gravity: [0,0,-9]\n" + ARM, "dh: [[q1*,0,1,0]]\n", "find: [D,g]\n" + ARM])
def test_commas_between_values_are_left_alone(text: str) -> None:
    assert not errors(text)
