"""The tests lie where one looks for them, each is collected, and the tools are what the documents say."""

from __future__ import annotations

import ast
import re
import tomllib
from pathlib import Path

import pytest

import dynsolve
from tests.support import ROOT

PACKAGE = Path(dynsolve.__file__).parent
TESTS = ROOT / "tests"
FILES = sorted(TESTS.rglob("*.py"))
ELSEWHERE = {"cli"}
"""Rooms whose tests lie in a folder of their own: commands are tested as a user runs them."""

OF_A_KIND = ("questions/", "acts/")
"""Rooms with a folder a kind: the files that these have in common are named once."""

TOOLS = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]
MARKERS = [marker.partition(":")[0] for marker in TOOLS["pytest"]["ini_options"]["markers"]]


def folders(top: Path) -> set[str]:
    """The folders below `top` that hold Python files, by their paths."""
    return {path.parent.relative_to(top).as_posix() for path in top.rglob("*.py")} - {"."}


def test_every_room_of_the_package_has_unit_tests_and_no_folder_of_them_is_without_its_room() -> None:
    rooms, tested = folders(PACKAGE), folders(TESTS / "unit")
    kinds = {room for room in rooms if room.startswith(OF_A_KIND)}
    assert tested <= rooms
    assert rooms - kinds - tested == ELSEWHERE
    assert folders(TESTS) >= ELSEWHERE


ROOMS = sorted(path for path in PACKAGE.rglob("__init__.py") if path.parent != PACKAGE)


@pytest.mark.parametrize("init", ROOMS, ids=lambda path: path.parent.relative_to(PACKAGE).as_posix())
def test_the_docstring_of_a_room_names_every_file_in_it(init: Path) -> None:
    """As a whole word: `trees` does not name `tree`.  The page of the house may name its path instead."""
    words = set(re.findall(r"\w+", ast.get_docstring(ast.parse(init.read_text(encoding="utf-8"))) or ""))
    page = (PACKAGE / "README.md").read_text(encoding="utf-8")
    room = init.parent.relative_to(PACKAGE).as_posix()
    files = {path.stem for path in init.parent.glob("*.py")} - {"__init__"}
    if f"{room}/" in OF_A_KIND:
        files |= {path.parent.name for path in init.parent.glob("*/__init__.py")}
    if room.startswith(OF_A_KIND):
        common = ast.get_docstring(ast.parse((init.parent.parent / "__init__.py").read_text("utf-8"))) or ""
        files -= set(re.findall(r"\w+", common))
    assert not {name for name in files - words if f"`{room}/{name}.py`" not in page}


def test_what_looks_like_a_test_is_collected() -> None:
    for path in FILES:
        tree = ast.parse(path.read_text(encoding="utf-8"))
        functions = [node.name for node in tree.body if isinstance(node, ast.FunctionDef)]
        tests = [name for name in functions if name.startswith("test_")]
        assert bool(tests) == path.name.startswith("test_"), path
        assert len(tests) == len(set(tests)), f"{path}: a second test of a name hides the first"


def test_the_documents_name_every_folder_every_marker_and_every_task() -> None:
    guide = (TESTS / "README.md").read_text(encoding="utf-8")
    top = {path.relative_to(TESTS).parts[0] for path in FILES if path.parent != TESTS}
    assert top == set(re.findall(r"^\| `(\w+)/` \|", guide, re.MULTILINE))
    assert set(MARKERS) == set(re.findall(r"^\| `(\w+)` \|", guide, re.MULTILINE))
    contributing = (ROOT / ".github" / "CONTRIBUTING.md").read_text(encoding="utf-8")
    assert set(TOOLS["poe"]["tasks"]) == set(re.findall(r"^\| `poe (\w+)` \|", contributing, re.MULTILINE))


def test_quick_leaves_out_what_is_marked() -> None:
    (words,) = re.findall(r"-m 'not \((.*)\)'", TOOLS["poe"]["tasks"]["quick"]["cmd"])
    assert words.split(" or ") == MARKERS


def test_the_constraints_say_how_they_are_made_and_name_no_host() -> None:
    first, *pins = (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines()
    assert re.match(r"# .*: uv pip compile pyproject\.toml --extra all ", first)
    assert all(re.fullmatch(r"[a-z0-9-]+==[\w.]+( ; .+)?", pin) for pin in pins)
