"""Robots that nobody chose, against Pinocchio."""

from __future__ import annotations

import pytest
from hypothesis import given, note, settings

from tests.oracle.comparison import assert_agrees
from tests.oracle.reading import load
from tests.robots import robots
from tests.support import solve_json

pytestmark = pytest.mark.slow


@settings(max_examples=150)
@given(text=robots())
def test_agrees_with_pinocchio(text: str) -> None:
    note(text)
    assert_agrees(load(text), solve_json(text), states=2)
