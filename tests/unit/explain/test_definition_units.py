"""The units of abbreviations, each by hand from the formula that defines it."""

from __future__ import annotations

import pytest

from dynsolve.explain.recurring import Definition
from dynsolve.explain.signs import units_of
from dynsolve.notation.text import read
from dynsolve.notation.tree import Symbol
from tests.support import solved

# definitions in order, unit -> the names in it; of the elbow, with L in m, m in kg and I in kg m²
CASES: list[tuple[dict[str, str], dict[str, list[str]]]] = [
    ({"s1": "m2*lc2^2 + I2xx"}, {"kg m^2": ["s1"]}),
    ({"s1": "m2*lc2/3 - m3*L2"}, {"kg m": ["s1"]}),
    ({"s1": "m3*L2", "s2": "L2*s1 - I3zz", "s3": "s2/L2"}, {"kg m": ["s1", "s3"], "kg m^2": ["s2"]}),
    ({"s1": "m2*sin(theta2)*theta2_dot"}, {"kg/s": ["s1"]}),
    ({"s1": "m2 + L2", "s2": "2*s1"}, {"": ["s1", "s2"]}),
]  # fmt: skip


@pytest.mark.parametrize(("meanings", "units"), CASES)
def test_a_name_has_the_unit_of_its_formula(meanings: dict[str, str], units: dict[str, list[str]]) -> None:
    definitions = [Definition(Symbol(name), read(text, dots=True).tree) for name, text in meanings.items()]
    assert units_of(solved("elbow-3r").robot, definitions) == units


def test_nothing_is_said_where_numbers_stand_for_lengths() -> None:
    definition = Definition(Symbol("s1"), read("5*q1").tree)
    assert units_of(solved("numeric-2r").robot, [definition]) == {"": ["s1"]}
