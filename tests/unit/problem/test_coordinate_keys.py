"""Mappings that have coordinates as their keys: each takes a coordinate in every spelling, and once."""

from __future__ import annotations

import pytest

from dynsolve.problem.kinds import MapOf, OneOf
from dynsolve.problem.specification import PROBLEM
from tests.unit.problem.marked import errors

TABLE = """
dh: [{theta: θ1*, a: l1}, {theta: theta2*, a: l2}, {theta: θ3*, a: l3}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}, {mass: m3, link: 3}]
velocity: [vx, vy]
"""
VALUES = {"limits": "[0, 90deg]", "coordinates": "revolute", "weights": "1"}


def is_by_coordinate(kind: object) -> bool:
    kinds = kind.kinds if isinstance(kind, OneOf) else (kind,)
    words = ("by coordinate", "types by name")
    return any(isinstance(one, MapOf) and one.called.endswith(words) for one in kinds)


KEYS = [key.name for key in PROBLEM.keys if is_by_coordinate(key.kind)]


def given(key: str, *names: str) -> str:
    value = VALUES.get(key, "0")
    rest = ["theta2", "θ3"] if key == "coordinates" else []
    return f"{key}: {{{', '.join(f'{name}: {value}' for name in (*names, *rest))}}}\n" + TABLE


def test_the_keys_are_those_of_the_contract() -> None:
    assert set(KEYS) == {"coordinates", "friction", "limits", "state", "weights", "linearize", "steady"}


@pytest.mark.parametrize("key", KEYS)
@pytest.mark.parametrize("name", ["θ1", "theta1"])
def test_a_coordinate_is_a_key_in_both_spellings(key: str, name: str) -> None:
    assert not errors(given(key, name))


@pytest.mark.parametrize("key", KEYS)
def test_a_coordinate_is_a_key_once(key: str) -> None:
    (error,) = errors(given(key, "θ1", "theta1"))
    assert "keep one of them" in error.help or "listed twice" in error.message


@pytest.mark.parametrize("key", KEYS)
def test_what_is_no_coordinate_is_no_key(key: str) -> None:
    (error,) = errors(given(key, "θ1", "theta4"))
    assert "theta4" in error.message or "theta4" in error.help


def test_a_type_that_is_not_that_of_the_table() -> None:
    (error,) = errors(given("coordinates").replace("θ3: revolute", "θ1: revolute, θ3: prismatic"))
    assert error.message == "theta3 is revolute in the table, and prismatic here"
