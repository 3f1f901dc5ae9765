"""`problems/README.md`, which `dynsolve docs` prints, says what the program does.

Its console examples run, its problem files have no fault and no finding, and its tables hold
every key, verdict, exit code and command that there is.
"""

from __future__ import annotations

import json
import re
import shutil
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
import yaml

import dynsolve
from dynsolve.answers.report import to_json
from dynsolve.answers.verdict import Verdict
from dynsolve.cli.library import PAGES, topics
from dynsolve.errors import ExitCode
from dynsolve.grading.set_file import POLICY, SET
from dynsolve.problem.lint import lint_text
from dynsolve.problem.schema import table_of_keys, tables
from dynsolve.robot.units import KNOWN
from tests.repository.pages import blocks, examples, files, run, sections
from tests.support import ROOT

PAGE = (ROOT / "problems" / "README.md").read_text(encoding="utf-8")
FILES = files(PAGE)
SECTIONS = sections(PAGE)
PROBLEMS = [
    block for block in blocks(PAGE, "yaml") if re.search("^(?:dh|model|candidates):", block, re.MULTILINE)
]
EXAMPLES = {name: found for name, section in SECTIONS.items() if (found := examples(section))}


def written(text: str) -> set[str]:
    """Everything that a text sets as code."""
    return set(re.findall(r"`([^`\n]+)`", text))


def _folder(folder: Path) -> None:
    """The files of the page, and a course with two hand-ins."""
    for name, text in FILES.items():
        (folder / name).write_text(text, encoding="utf-8")
    (folder / "course").mkdir()
    for name in ("rp.yaml", "set.yaml"):
        shutil.copy(folder / name, folder / "course")
    for student, name in (("ada", "answer.yaml"), ("ben", "report.md")):
        (folder / "hand-ins" / student).mkdir(parents=True)
        shutil.copy(folder / name, folder / "hand-ins" / student / f"rp{Path(name).suffix}")


def test_there_are_examples() -> None:
    files = (
        "rp drawn cart candidates rrp elbow target wrist rates adaptive hanging balanced held driven line "
        "answer slips spellings set varied"
    ).split()
    assert {*(f"{name}.yaml" for name in files), "report.md"} == FILES.keys()
    sections = {
        "Problem file",
        "Solution JSON",
        "Answer file",
        "Verdicts",
        "Grading",
        "Sheets and variants",
        "Commands",
    }
    assert sections == EXAMPLES.keys()
    assert len(PROBLEMS) >= 5


@pytest.mark.parametrize("text", PROBLEMS, ids=range(len(PROBLEMS)))
def test_a_problem_file_is_sound_and_solved(text: str) -> None:
    assert not lint_text(text)
    assert dynsolve.solve(text).to_json()["format"] == "dynsolve-solution/1"


@pytest.mark.slow
@pytest.mark.parametrize("section", EXAMPLES)
def test_the_examples_print_what_they_say(section: str, tmp_path: Path) -> None:
    _folder(tmp_path)
    run(EXAMPLES[section], tmp_path)


def test_every_yaml_block_is_read_as_it_is_shown() -> None:
    known = set(PROBLEMS) | set(FILES.values())
    assert all(block in known for block in blocks(PAGE, "yaml"))


def test_the_tables_of_keys_are_those_of_the_specification() -> None:
    for table in (*tables(), table_of_keys(POLICY)):
        rows = table.splitlines()
        wrong = [f"{above}\n{below}" for above, below in pairwise(rows) if f"{above}\n{below}" not in PAGE]
        assert not wrong, f"in problems/README.md these rows do not stand one below the other:\n{wrong[0]}"


def keys(value: Any) -> set[str]:
    """Every key in JSON."""
    if isinstance(value, dict):
        return set(value).union(*map(keys, value.values()))
    return set().union(*map(keys, value)) if isinstance(value, list) else set()


def test_every_key_of_the_json_is_in_its_table() -> None:
    solution = json.loads(json.dumps(dynsolve.solve(FILES["rp.yaml"]).to_json()))
    assert keys(solution) <= written(SECTIONS["Solution JSON"].replace("results.", ""))
    judged = to_json(dynsolve.check(FILES["rp.yaml"], FILES["slips.yaml"]))
    assert keys(judged) <= written(SECTIONS["Verdicts"])


def test_nothing_is_left_out() -> None:
    assert {str(verdict) for verdict in Verdict} <= written(SECTIONS["Verdicts"])
    codes = re.findall(r"^\| ([0-9]+) \|", SECTIONS["Commands"], re.MULTILINE)
    assert [int(code) for code in codes] == [int(code) for code in ExitCode]
    assert tuple(yaml.safe_load(FILES["set.yaml"])) == SET.names
    assert tuple(yaml.safe_load(FILES["set.yaml"])["policy"]) == POLICY.names


def test_every_unit_that_is_named_is_known() -> None:
    (named,) = re.findall(r"^- \*\*`units`\*\*[^`]*`([^`]+)`", SECTIONS["Problem file"], re.MULTILINE)
    assert {unit.strip() for unit in named.split(",")} == set(KNOWN) - {"1", "°"}


def test_docs_prints_every_section() -> None:
    found = topics()
    own = [name for name in found if name not in PAGES]
    sections = "problem-file solution-json answer-file verdicts grading sheets-and-variants commands"
    assert own == sections.split()
    assert "".join(found[name] for name in own) in PAGE
    assert all(f"(#{topic})" in PAGE for topic in own)
    links = re.findall(r"\]\(#([\w-]+)\)", PAGE)
    headings = [title.lower().replace(" ", "-") for title in re.findall("^##+ (.*)$", PAGE, re.MULTILINE)]
    assert set(links) <= set(headings)
