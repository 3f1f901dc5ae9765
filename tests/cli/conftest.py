"""A set of one problem with marks."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.cli.grading import set_in


@pytest.fixture
def set_folder(tmp_path: Path) -> Path:
    return set_in(tmp_path)
