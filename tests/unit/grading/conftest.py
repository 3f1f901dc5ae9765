"""A set of two problems, for what is taken in."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from dynsolve.grading.set_file import ProblemSet, load_set
from tests.grading.here import working_here


@pytest.fixture(scope="module")
def problems(tmp_path_factory: pytest.TempPathFactory) -> ProblemSet:
    from dynsolve.problem.reader import find

    folder = tmp_path_factory.mktemp("set")
    for name in ("in3140-rp", "planar-2r"):
        (folder / f"{name}.yaml").write_text(find(name).read_text())
    return load_set(str(folder))


@pytest.fixture(scope="module", autouse=True)
def _here() -> Iterator[None]:
    """A run starts no workers; a test of these puts `LocalPool` back."""
    with working_here():
        yield
