"""Every robot of the library and of the textbooks against Pinocchio."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.oracle.comparison import assert_agrees
from tests.oracle.reading import load
from tests.support import ACTING, LIBRARY, TEXTBOOKS, solve_json

pytestmark = pytest.mark.slow


PLAIN = [path for path in LIBRARY if path.stem not in ACTING]
"""What Pinocchio has no joints for, rotors and springs, is held in `test_rotors` and by power."""


@pytest.mark.parametrize("path", PLAIN + TEXTBOOKS, ids=lambda path: path.stem)
def test_agrees_with_pinocchio(path: Path) -> None:
    assert_agrees(load(path), solve_json(path))
