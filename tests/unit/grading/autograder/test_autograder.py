"""The autograder of Gradescope, run by its own scripts in a folder that is laid out as /autograder is.

The layout is that of Gradescope's "Autograder Specifications" (`source`, `submission`, `results`, and
`run_autograder` beside them) and "Submission Metadata" (`submission_metadata.json`).
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from dynsolve.errors import ProblemError
from dynsolve.grading.autograder import write_autograder
from dynsolve.grading.autograder.__main__ import FAILED, lateness, main
from dynsolve.problem.reader import find
from tests.support import with_files
from tests.unit.grading.platforms.test_registry import RESULTS

pytestmark = pytest.mark.slow

K = "answers:\n  K: (I1zz*theta1'^2)/2 + m2*(L2'^2 + L2^2*theta1'^2)/2\n  g: [0, 0]\n"
METADATA = {
    "created_at": "2026-05-02T12:00:00.000000-07:00",
    "assignment": {"due_date": "2026-05-01T23:00:00.000000-07:00", "title": "Assignment 2"},
    "users": [
        {"email": "ada@x", "id": 1, "name": "Ada Lovelace"},
        {"email": "wei@x", "id": 2, "name": "Wei 王"},
    ],
}


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("course")
    with_files(folder, {"in3140-rp.yaml": find("in3140-rp").read_bytes()})
    (folder / "set.yaml").write_text("marks: {in3140-rp: {K: 4, g: 2}}\npolicy: {late: [1/2, 1/4]}\n")
    (folder / "private.csv").write_text("not for Gradescope")
    write_autograder(str(folder), folder / "autograder.zip")
    return folder / "autograder.zip"


@pytest.fixture
def root(archive: Path, tmp_path: Path) -> Path:
    """As Gradescope lays it out: what is in the zip, and its script beside it."""
    with zipfile.ZipFile(archive) as packed:
        packed.extractall(tmp_path / "source")
    (tmp_path / "run_autograder").write_bytes((tmp_path / "source" / "run_autograder").read_bytes())
    (tmp_path / "results").mkdir()
    return tmp_path


def _run(root: Path, files: dict[str, str | bytes], metadata: object = None) -> dict[str, Any]:
    with_files(root / "submission", files)
    if metadata is not None:
        (root / "submission_metadata.json").write_text(json.dumps(metadata))
    here = {"AUTOGRADER_ROOT": str(root), "AUTOGRADER_PYTHON": sys.executable, "PATH": os.environ["PATH"]}
    subprocess.run(["bash", root / "run_autograder"], check=True, env=here, cwd=root)
    results: dict[str, Any] = json.loads((root / "results" / "results.json").read_text())
    jsonschema.validate(results, RESULTS)
    return results


def test_a_submission_is_marked_there_as_here_and_late_where_gradescope_says_so(root: Path) -> None:
    results = _run(root, {"hw/in3140-rp.yaml": K}, METADATA)
    tests = [(test["name"], test["score"], test["max_score"]) for test in results["tests"]]
    assert tests == [("K", 4, 4), ("g", 2, 2), ("late", -3, 0)]
    assert results["score"] == 3 and results["output_format"] == "md"
    assert "Marks: 3 of 6" in results["output"] and "It was handed in late." in results["output"]


def test_what_nobody_has_judged_is_told(root: Path) -> None:
    results = _run(root, {"scan.pdf": b"%PDF"})
    assert results["score"] == 0 and results["output"].endswith("- scan.pdf: a PDF: a human reads it")


def test_a_failure_is_told_too(root: Path) -> None:
    (root / "source" / "course" / "set.yaml").write_text("policy: {late: 7}")
    with_files(root / "submission", {"in3140-rp.yaml": K})
    main(root)
    results = json.loads((root / "results" / "results.json").read_text())
    jsonschema.validate(results, RESULTS)
    assert (results["score"], results["output"]) == (0, FAILED)


@pytest.mark.parametrize(
    ("created", "due", "own", "late"),
    [
        ("2026-05-02T12:00:00-07:00", "2026-05-01T23:00:00-07:00", None, "13:00:00"),
        ("2026-05-02T12:00:00-07:00", "2026-05-01T23:00:00-07:00", "2026-05-03T12:00:00-07:00", "0:00:00"),
        ("2026-05-02T12:00:00-07:00", "2026-05-02T18:59:58Z", "2026-05-01T12:00:00-07:00", "0:00:02"),
        ("2026-05-02T12:00:00-07:00", None, None, "0:00:00"),
        ("soon", "2026-05-01T23:00:00-07:00", None, "0:00:00"),
    ],
)
def test_a_date_of_the_students_own_counts_where_it_is_later(
    created: str, due: str | None, own: str | None, late: str
) -> None:
    users = [{"name": "Ada", "assignment": {"due_date": own}}, {"name": "Wei"}]
    assert lateness({"created_at": created, "assignment": {"due_date": due}, "users": users}) == late


def test_the_zip_holds_what_runs_there_and_nothing_else_of_the_course(archive: Path, root: Path) -> None:
    with zipfile.ZipFile(archive) as packed:
        names = set(packed.namelist())
        programs = {entry.filename for entry in packed.infolist() if entry.external_attr >> 16 & 0o100}
    outside = {name for name in names if not name.startswith("program/dynsolve/")}
    course = {"course/set.yaml", "course/in3140-rp.yaml"}
    assert outside == {"setup.sh", "run_autograder", "requirements.txt", *course}
    assert {"program/dynsolve/__init__.py", "program/dynsolve/grading/report.css"} <= names
    assert programs == {"setup.sh", "run_autograder"}
    lines = (root / "source" / "requirements.txt").read_text().split()
    assert {"sympy", "python-flint", "numpy"} <= {line.partition("==")[0] for line in lines}
    assert all(line.partition("==")[2] for line in lines)


def test_setup_makes_an_environment_with_what_dynsolve_needs(root: Path, tmp_path: Path) -> None:
    """By a Python that only writes down what it is asked for, and leaves one like it in the environment."""
    python, said = tmp_path / "python", tmp_path / "said"
    made = '[ "$2" != venv ] || (mkdir -p "$3/bin" && cp "$0" "$3/bin/python")'
    python.write_text(f'#!/bin/sh\necho "$@" >> {said}\n{made}\n')
    python.chmod(0o755)
    here = {"AUTOGRADER_ROOT": str(root), "AUTOGRADER_PYTHON": str(python), "PATH": os.environ["PATH"]}
    subprocess.run(["bash", root / "source" / "setup.sh"], check=True, env=here)
    assert said.read_text().splitlines() == [
        "-c import ensurepip, venv",
        f"-m venv {root}/venv",
        f"-m pip install -r {root}/source/requirements.txt",
    ]


def test_a_faulty_set_makes_no_autograder(tmp_path: Path) -> None:
    with_files(tmp_path / "set", {"rp.yaml": "dh: [", "set.yaml": "title: x"})
    with pytest.raises(ProblemError):
        write_autograder(str(tmp_path / "set"), tmp_path / "a.zip")
    assert not (tmp_path / "a.zip").exists()
