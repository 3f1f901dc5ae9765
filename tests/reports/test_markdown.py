"""Markdown reports: what GitHub and Jupyter need to show the mathematics."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from dynsolve.explain.step import Detail
from dynsolve.solution.reports import Format
from tests.reports.tools import HOSTILE_PROBLEM, made, typeset
from tests.support import LIBRARY

SMALL = [path for path in LIBRARY if path.stem not in ("puma560", "panda-7r")]
DISPLAY = re.compile(r"^\$\$\n(.*?)\n\$\$$", re.DOTALL | re.MULTILINE)


@pytest.mark.parametrize("problem", SMALL, ids=lambda path: path.stem)
def test_displays_stand_alone_and_survive_markdown(problem: Path) -> None:
    text = made(problem, Format.MARKDOWN).decode()
    displays = DISPLAY.findall(text)
    assert len(displays) > 15
    for display in displays:
        assert "\n\n" not in display
        assert "$" not in display
        # Markdown takes the backslash from these before the mathematics is read
        assert not re.search(r"\\[\\,;!{}#%&_]", display)
    outside = DISPLAY.sub("", text)
    assert "$$" not in outside
    assert outside.replace("&#36;", "").count("$") % 2 == 0
    assert re.search(r"\\tag\{1\}", text)


@pytest.mark.latex
@pytest.mark.parametrize("name", ["in3140-rp", "elbow-3r"])
def test_its_mathematics_is_sound_latex(name: str, tmp_path: Path) -> None:
    problem = next(path for path in LIBRARY if path.stem == name)
    text = made(problem, Format.MARKDOWN).decode()
    displays = "\n".join(f"\\[{display}\\]" for display in DISPLAY.findall(text))
    inline = "\n\n".join(re.findall(r"\$[^$\n]+\$", DISPLAY.sub("", text)))
    source = (
        f"\\documentclass{{article}}\\usepackage{{amsmath}}\\begin{{document}}\n{displays}\n\n{inline}"
        "\n\\end{document}\n"
    )
    assert typeset(source, tmp_path).code == 0


def test_a_hostile_title_is_text() -> None:
    first = made(HOSTILE_PROBLEM, Format.MARKDOWN).decode().splitlines()[0]
    assert "&lt;script&gt;" in first
    assert r"\\input\{/etc/passwd\}" in first
    assert r"\[s\](t) \*u\*" in first
    assert "&#36;x^2&#36;" in first
    assert not set("\u202e\u202c\u200f<") & set(first)


def test_signs_of_a_list_in_a_table_have_the_commas_of_words() -> None:
    problem = next(path for path in LIBRARY if path.stem == "in3140-rp")
    text = made(problem, Format.MARKDOWN, detail=Detail.FULL).decode()
    assert "| $m_{1}$, $m_{2}$, $m_{i}$ | mass of body $i$ | $\\text{kg}$ |" in text
