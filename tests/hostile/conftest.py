"""Hostile files are read within a bound of processor time, of which what other tests left is no part."""

from __future__ import annotations

import pytest


@pytest.fixture(autouse=True)
def _own_time(frozen_heap: None) -> None:
    """Every test here."""
