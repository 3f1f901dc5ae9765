"""One rule for -o: the suffix or --format says the form, and a file is written whole or not at all."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.cli.running import dynsolve

pytestmark = pytest.mark.slow

BEGINNINGS = {
    "sol.pdf": b"%PDF-",
    "sol.html": b"<!DOCTYPE html>",
    "sol.htm": b"<!DOCTYPE html>",
    "sol.md": b"# RP manipulator",
    "sol.tex": b"\\documentclass",
    "sol.txt": "RP manipulator\n═".encode(),
    "sol.json": b'{"format": "dynsolve-solution/1"',
}


def names_in(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


@pytest.mark.parametrize("name", BEGINNINGS)
def test_the_suffix_says_the_form(name: str, tmp_path: Path) -> None:
    done = dynsolve("solve", "in3140-rp", "-o", str(tmp_path / name))
    assert (done.code, done.out, done.err) == (0, "", "")
    assert (tmp_path / name).read_bytes().startswith(BEGINNINGS[name])
    assert names_in(tmp_path) == [name]


@pytest.mark.parametrize(
    ("options", "beginning"),
    [
        (["--latex"], "\\documentclass"),
        (["--fragment"], "% Needs"),
        (["--html"], "<!DOCTYPE"),
        (["--markdown"], "# RP"),
        (["--format", "markdown"], "# RP"),
        (["--format", "text"], "RP manipulator"),
        (["--json"], '{"format"'),
    ],
)
def test_forms_on_standard_output_and_under_any_name(
    options: list[str], beginning: str, tmp_path: Path
) -> None:
    printed = dynsolve("solve", "in3140-rp", *options)
    assert printed.code == 0
    assert printed.out.startswith(beginning)
    written = dynsolve("solve", "in3140-rp", *options, "-o", str(tmp_path / "any"))
    assert written.code == 0
    assert (tmp_path / "any").read_text(encoding="utf-8") == printed.out


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["-o", "sol.xyz"], "--format"),
        (["-o", "sol"], "--format"),
        (["--html", "--latex"], "one form at a time"),
        (["--html", "-o", "sol.pdf"], "named as pdf"),
        (["--fragment", "--html"], "one form at a time"),
        (["-o", "no/such/folder/sol.pdf"], "there is no folder no/such/folder"),
    ],
)
def test_contradictions_are_refused_before_any_work(options: list[str], message: str, tmp_path: Path) -> None:
    done = dynsolve("solve", "in3140-rp", *options)
    assert done.code == 2
    assert message in done.err
    assert len(done.err.splitlines()) == 1


def test_several_problems_go_into_a_folder(tmp_path: Path) -> None:
    done = dynsolve("solve", "in3140-rp", "planar-2r", "--html", "-o", f"{tmp_path}/out/")
    assert done.code == 0
    assert names_in(tmp_path / "out") == ["in3140-rp.html", "planar-2r.html"]
    refused = dynsolve("solve", "in3140-rp", "planar-2r", "-o", str(tmp_path / "both.pdf"))
    assert refused.code == 2
    assert "give a folder" in refused.err
    together = dynsolve("solve", "in3140-rp", "planar-2r", "-o", str(tmp_path / "both.json"))
    assert together.code == 0
    lines = (tmp_path / "both.json").read_text(encoding="utf-8").splitlines()
    titles = [json.loads(line)["problem"]["title"] for line in lines]
    assert titles == ["RP manipulator", "Planar elbow manipulator"]


def test_a_faulty_problem_leaves_the_old_file(tmp_path: Path) -> None:
    path = tmp_path / "sol.pdf"
    path.write_text("old")
    done = dynsolve("solve", "-", "-o", str(path), stdin="title: nothing else\n")
    assert done.code == 2
    assert path.read_text() == "old"


def test_what_cannot_be_written_is_refused(tmp_path: Path) -> None:
    done = dynsolve("solve", "in3140-rp", "--html", "-o", "/proc/sol.html")
    assert done.code == 2
    assert "cannot be written" in done.err


def test_star_marks_joint_variables_everywhere() -> None:
    starred = dynsolve("solve", "in3140-rp", "--star", "--stage", "torque")
    assert "L₂⋆" in starred.out
    plain = dynsolve("solve", "in3140-rp", "--stage", "torque")
    assert "⋆" not in plain.out
