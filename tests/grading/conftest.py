"""Courses are graded in the process of the test; the workers are tested in `test_cluster.py` and `cli/`."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.grading.here import working_here


@pytest.fixture(scope="module", autouse=True)
def _here() -> Iterator[None]:
    """A run starts no workers; a test of these puts `LocalPool` back."""
    with working_here():
        yield
