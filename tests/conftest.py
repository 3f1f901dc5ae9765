"""How the tests run: Hypothesis draws the same robots on every CI run, and fresh ones at home.

Whatever is done with a robot of six or more joints takes long, so it is marked as slow here.
"""

from __future__ import annotations

import gc
import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

# As the program has it: solutions are kept whole, and to look for garbage among them took a tenth of the time
gc.set_threshold(50_000)

LARGE = {"panda-7r", "puma560", "stanford-6"}
"""The problems of the library with six or more joints."""

settings.register_profile(
    "home",
    deadline=None,
    max_examples=60,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
)
settings.register_profile("ci", parent=settings.get_profile("home"), derandomize=True, print_blob=True)
settings.load_profile("ci" if os.environ.get("CI") else "home")


@pytest.fixture
def frozen_heap() -> Iterator[None]:
    """What other tests have left is not looked through in a time that is measured."""
    gc.freeze()
    yield
    gc.unfreeze()


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark as slow what is done with a large robot."""
    for item in items:
        given = item.callspec.params.values() if hasattr(item, "callspec") else ()
        names = {
            value.stem if isinstance(value, Path) else value
            for value in given
            if isinstance(value, Path | str)
        }
        if names & LARGE:
            item.add_marker(pytest.mark.slow)
