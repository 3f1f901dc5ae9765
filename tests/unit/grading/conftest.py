"""A set of two problems, for what is taken in."""

from __future__ import annotations

import pytest

from dynsolve.grading.problem_set import ProblemSet
from dynsolve.grading.set_file import load_set


@pytest.fixture(scope="module")
def problems(tmp_path_factory: pytest.TempPathFactory) -> ProblemSet:
    from dynsolve.problem.library import find

    folder = tmp_path_factory.mktemp("set")
    for name in ("in3140-rp", "planar-2r"):
        (folder / f"{name}.yaml").write_text(find(name).read_text())
    return load_set(str(folder))
