"""The examples of the README and of the pages for readers do what they say.

The commands of a section run one after the other in one folder.  The blocks marked `sh`
install and test, and are run by CI.  Python examples are doctests.
"""

from __future__ import annotations

import re
import shutil
import zipfile
from pathlib import Path

import pytest

from tests.repository.pages import blocks, examples, files, run, sections
from tests.support import ROOT

README = (ROOT / "README.md").read_text(encoding="utf-8")
PAGES = {
    "README": README,
    **{
        name: (ROOT / "problems" / f"{name}.md").read_text(encoding="utf-8")
        for name in ("students", "teachers", "python")
    },
}
SHELL = blocks(README, "sh")
EXAMPLES = [
    (name, section)
    for name, page in PAGES.items()
    for section, text in sections(page).items()
    if examples(text)
]
WORDS = 1200
"""So long may the front door be."""


def test_there_are_examples() -> None:
    assert {name for name, _ in EXAMPLES} == PAGES.keys()
    shown = {file for page in PAGES.values() for file in files(page)}
    assert shown == {"mine.yaml", "rp.yaml", "answer.yaml", "set.yaml"}


def test_the_front_door_is_short() -> None:
    assert len(README.split()) <= WORDS


def test_two_lines_install_and_test_and_ci_runs_them() -> None:
    install = "python3 -m venv .venv && .venv/bin/pip install ."
    assert [f"{install} && .venv/bin/dynsolve solve problems/in3140-rp.yaml\n", ".ci/run\n"] == SHELL
    assert "sed -n '/^```sh$/,/^```$/{/^```/!p;/^```$/q}' README.md" in (ROOT / ".ci" / "run").read_text()


def _course(folder: Path) -> None:
    """What a teacher has: the folder of the problems, a download of Canvas and its gradebook."""
    import random

    from tests.grading.generate import hand_in

    (folder / "course").mkdir()
    shutil.move(folder / "set.yaml", folder / "course" / "set.yaml")
    people = {101: ("Lovelace, Ada", ""), 102: ("Babbage, Charles", "_LATE"), 103: ("Hopper, Grace", "")}
    rows = ["Student,ID,SIS User ID,SIS Login ID,Section,Assignment 2 (555)", "    Points Possible,,,,,38"]
    with zipfile.ZipFile(folder / "submissions.zip", "w") as packed:
        for number, (name, late) in people.items():
            rows.append(f'"{name}",{number},s{number},{number}@uni.example,A,')
            who = re.sub(r"[^a-z]", "", name.lower())
            for stem in ("in3140-rp", "planar-2r"):
                file, text = hand_in(stem, who, random.Random(number))
                packed.writestr(f"{who}{late}_{number}_9{number}_{stem}{Path(file).suffix}", text)
        packed.writestr("hoppergrace_103_9999_scan.pdf", b"%PDF-1.7")
    rows.append('"Else, Somebody",104,s104,104@uni.example,A,')
    (folder / "gradebook.csv").write_text("\n".join(rows) + "\n")
    for stem in ("in3140-rp", "planar-2r"):
        shutil.copy(folder / "problems" / f"{stem}.yaml", folder / "course")


@pytest.mark.slow
@pytest.mark.parametrize(("page", "section"), EXAMPLES)
def test_the_examples_print_what_they_say(page: str, section: str, tmp_path: Path) -> None:
    shutil.copytree(ROOT / "problems", tmp_path / "problems")
    for shown in (PAGES["students"], PAGES[page]):  # which has the arm that other pages speak of
        for name, text in files(shown).items():
            (tmp_path / name).write_text(text, encoding="utf-8")
    text = sections(PAGES[page])[section]
    if "set.yaml" in files(PAGES[page]):
        _course(tmp_path)
    run(examples(text), tmp_path)
