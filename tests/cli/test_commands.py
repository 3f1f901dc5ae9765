"""The commands as a user runs them: output, pipes, colour, help."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

import jsonschema
import pytest

from dynsolve.cli.main import app
from dynsolve.notation.unicode import width
from tests.cli.running import dynsolve, dynsolve_afresh, environment, in_terminal, started
from tests.support import ROOT

COMMANDS = {command.callback.__name__: command.callback for command in app().registered_commands}
LINE = 66
"""The columns that `--help` leaves for the sentence of a command."""


def test_help_lists_every_command_with_its_help() -> None:
    ran = dynsolve("--help")
    assert ran.code == 0 and not ran.err
    for command, function in COMMANDS.items():
        (line,) = (line for line in ran.out.splitlines() if line.startswith(f"  {command} "))
        sentence, shown = str(function.__doc__).splitlines()[0], line.split(maxsplit=1)[1]
        assert sentence.endswith(".")
        assert shown == sentence if len(sentence) <= LINE else sentence.startswith(shown.removesuffix("..."))


def test_the_readme_has_a_row_for_every_command() -> None:
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    assert COMMANDS.keys() == set(re.findall(r"^\| `dynsolve (\w+)\b[^`]*` \|", readme, re.MULTILINE))


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_has_help(command: str) -> None:
    ran = dynsolve(command, "--help")
    assert ran.code == 0
    assert f"Usage: dynsolve {command}" in ran.out
    assert dynsolve(command, "-h").out == ran.out


def test_version() -> None:
    import dynsolve as package

    assert dynsolve("--version").out == f"dynsolve {package.__version__}\n"


def loaded_by(*commands: str) -> set[str]:
    """What is loaded by these command lines, one after the other."""
    code = (
        "import sys; from dynsolve.cli.main import _run; "
        f"[_run(line.split(), True) for line in {commands!r}]; print(*sys.modules, file=sys.stderr)"
    )
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, capture_output=True, cwd=ROOT, text=True, check=True, env=environment())
    return set(done.stderr.split())


def test_help_loads_nothing_heavy() -> None:
    assert not loaded_by("--help") & {"sympy", "numpy", "rich", "flint", "yaml"}


def test_a_command_in_a_pipe_needs_neither_sympy_nor_numpy_nor_rich() -> None:
    loaded = loaded_by("schema", "new -", "lint planar-2r", "solve planar-2r")
    assert not loaded & {"sympy", "numpy", "rich"}


def test_solve_prints_the_whole_derivation_in_plain_text() -> None:
    ran = dynsolve_afresh("solve", "problems/in3140-rp.yaml")
    assert ran.code == 0 and not ran.err
    assert "\x1b" not in ran.out
    assert ran.out.startswith("RP manipulator\n")
    assert "    τ₁ = (m₂ L₂² + I_1zz) θ̈₁ + 2m₂ L₂ θ̇₁ L̇₂\n" in ran.out
    (verified,) = (line for line in ran.out.splitlines() if line.startswith("Verified:"))
    assert "recursive Newton-Euler at 5 random states" in verified


def test_a_stem_names_a_bundled_problem_from_anywhere(tmp_path: Path) -> None:
    ran = dynsolve_afresh("solve", "in3140-rp", "--detail", "brief", cwd=tmp_path, PYTHONPATH=str(ROOT))
    assert ran.code == 0 and ran.out.startswith("RP manipulator\n")


def test_standard_input() -> None:
    text = (ROOT / "problems" / "planar-2r.yaml").read_text()
    assert dynsolve("solve", "-", stdin=text).out == dynsolve("solve", "planar-2r").out


def test_json_is_one_object_a_line_in_the_format_of_the_contract() -> None:
    ran = dynsolve("solve", "planar-2r", "in3140-rp", "--json")
    first, second = (json.loads(line) for line in ran.out.splitlines())
    assert first["format"] == second["format"] == "dynsolve-solution/1"
    assert first["results"]["D"][1] == ["m2*(lc2**2 + l1*lc2*cos(q2)) + I2", "m2*lc2**2 + I2"]
    assert second["coordinates"][1] == {
        "name": "L2",
        "type": "prismatic",
        "velocity": "L2_dot",
        "acceleration": "L2_ddot",
        "force": "f2",
    }
    assert second["results"]["tau"][1] == "m2*L2_ddot - m2*L2*theta1_dot**2"
    assert second["verified"]["states"] == 5 and second["verified"]["max_relative_error"] < 1e-12


def test_json_has_every_key_of_the_contract() -> None:
    solution = json.loads(dynsolve("solve", "in3140-rp", "--json").out)
    assert list(solution) == ["format", "problem", "coordinates", "results", "steps", "verified"]
    assert {"A", "H", "Jv", "Jw", "bodies", "P", "K", "L", "euler_lagrange", "tau", "D", "C", "g"} == set(
        solution["results"]
    )
    body = {"name", "r_c", "R", "Jv", "Jw", "v", "w", "I_body", "I_base", "P", "Kv", "Kw", "K"}
    assert all(set(entry) == body for entry in solution["results"]["bodies"])
    assert set(solution["results"]["euler_lagrange"][0]) == {"dL_dqdot", "ddt", "dL_dq", "force"}
    assert all({"id", "stage", "title", "why", "latex", "text"} <= set(step) for step in solution["steps"])


def test_one_stage() -> None:
    out = dynsolve("solve", "planar-2r", "--stage", "torque").out
    assert "6. The Euler-Lagrange equations" in out and "1. Forward kinematics" not in out


def test_from_and_to() -> None:
    out = dynsolve("solve", "planar-2r", "--from", "energy", "--to", "lagrangian").out
    headings = [
        line for line in out.splitlines() if line[:2] in {f"{i}." for i in range(1, 8)} and line[2] == " "
    ]
    assert headings == ["4. Potential and kinetic energy", "5. The Lagrangian"]


@pytest.mark.slow
def test_levels_of_detail_differ_in_length() -> None:
    brief, normal, full = (
        len(dynsolve("solve", "rp-vertical", "--detail", level).out) for level in ("brief", "normal", "full")
    )
    assert brief < normal / 2 < normal < full


@pytest.mark.slow
def test_a_terminal_has_colour_and_its_own_width() -> None:
    ran = in_terminal("solve", "in3140-rp", columns=72)
    assert ran.code == 0 and "\x1b[1m" in ran.out
    plain = in_terminal("solve", "in3140-rp", columns=72, NO_COLOR="1")
    assert "\x1b" not in plain.out
    assert max(map(width, plain.out.splitlines())) <= 72
    assert re.sub(r"\x1b\[[0-9;]*m", "", ran.out) == plain.out, "colour changes no text"


def test_whoever_stops_reading_gets_no_complaint() -> None:
    with started("solve", "puma560-first3") as process:
        assert process.stdout is not None and process.stderr is not None
        process.stdout.readline()
        process.stdout.close()
        assert process.stderr.read() == b""
    assert process.returncode == 0


def test_new_writes_a_problem_that_solves(tmp_path: Path) -> None:
    file = tmp_path / "mine.yaml"
    assert dynsolve("new", str(file)).code == 0
    assert dynsolve("solve", str(file), "--detail", "brief").code == 0
    again = dynsolve("new", str(file))
    assert again.code == 2 and "--force overwrites it" in again.err
    assert dynsolve("new", str(file), "--force").code == 0


def test_new_writes_a_few_lines_or_a_bundled_problem_or_every_key() -> None:
    assert len(dynsolve("new", "-").out.splitlines()) <= 30
    assert dynsolve("new", "-", "--like", "scara-rrpr").out == dynsolve("problems", "scara-rrpr").out
    assert "\n# vary: " in dynsolve("new", "-", "--all").out
    both = dynsolve("new", "-", "--all", "--like", "scara-rrpr")
    assert both.code == 2 and "choose one of them" in both.err


def test_a_shell_completes_the_stems_of_the_library() -> None:
    asked = {"_DYNSOLVE_COMPLETE": "complete_bash", "COMP_WORDS": "dynsolve solve sca", "COMP_CWORD": "2"}
    assert dynsolve_afresh(**asked).out.split() == ["scara-rrpr"]


def test_a_sheet_a_template_and_variants_are_written(tmp_path: Path) -> None:
    file = tmp_path / "mine.yaml"
    assert dynsolve("new", str(file)).code == 0
    assert "a) Find the inertia matrix" in dynsolve("sheet", str(file)).out
    assert dynsolve("sheet", str(file), "-o", str(tmp_path / "sheet.tex"), "--key").code == 0
    assert "Key: My arm" in (tmp_path / "sheet.tex").read_text()
    ran = dynsolve("sheet", str(file), str(file))
    assert ran.code == 2 and "mine is named twice" in ran.err
    ran = dynsolve("sheet", str(file), "-o", str(tmp_path / "sheet.xls"))
    assert ran.code == 2 and ".docx" in ran.err
    assert dynsolve("template", str(file), "-o", str(tmp_path / "answer.yaml")).code == 0
    assert "\n  tau:\n" in (tmp_path / "answer.yaml").read_text()
    (tmp_path / "students.csv").write_text("student\nada\nben\n")
    file.write_text(file.read_text() + "vary: {letters: {l1: [l1, a1]}}\n")
    words = ("vary", str(file), "--roster", str(tmp_path / "students.csv"), "--seed", "1")
    ran = dynsolve(*words, "-o", str(tmp_path / "out"))
    assert ran.code == 0 and "2 students" in ran.err
    (tmp_path / "students.csv").write_text("student\nada\nben\ncarl\n")
    ran = dynsolve(*words, "-o", str(tmp_path / "other"))
    assert ran.code == 2 and "2 variants that are equally hard, for 3 students" in ran.err
    assert not (tmp_path / "other").exists()


def test_new_says_why_it_cannot_write(tmp_path: Path) -> None:
    ran = dynsolve("new", str(tmp_path / "no" / "such" / "folder.yaml"))
    assert ran.code == 2 and "there is no folder" in ran.err


def test_schema_is_a_json_schema() -> None:
    jsonschema.Draft202012Validator.check_schema(json.loads(dynsolve("schema").out))


def test_problems_are_listed_and_printed() -> None:
    listed = dynsolve("problems").out
    assert "in3140-rp " in listed and "RP manipulator" in listed
    assert dynsolve("problems", "in3140-rp").out == (ROOT / "problems" / "in3140-rp.yaml").read_text()


def test_lint_of_a_clean_file_finds_nothing() -> None:
    ran = dynsolve("lint", "in3140-rp", "planar-2r")
    assert ran.code == 0 and not ran.out


def test_completion_is_offered() -> None:
    no_detection = {
        "_TYPER_COMPLETE_TEST_DISABLE_SHELL_DETECTION": "1"
    }  # the test may have no shell above it
    assert "_DYNSOLVE_COMPLETE=complete_bash" in dynsolve("--show-completion", "bash", **no_detection).out
