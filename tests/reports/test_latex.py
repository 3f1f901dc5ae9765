"""LaTeX reports through a real pdflatex."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from dynsolve.explain.step import Detail
from dynsolve.solution.reports import Format
from tests.reports.tools import FEWEST_LINES, HOSTILE_PROBLEM, SEEN, lines_of, made, text_of, typeset
from tests.support import ALL_PROBLEMS, LIBRARY, TEXTBOOKS

MOST_PAGES = {
    "puma560": 12,
    "stanford-6": 15,
    "elbow-3r": 11,
    "panda-7r": 25,
    "planar-2r": 6,
    "in3140-rp": 5,
}
"""What somebody who wants the model still reads."""

RP = next(path for path in LIBRARY if path.stem == "in3140-rp")


@pytest.mark.latex
@pytest.mark.parametrize("problem", ALL_PROBLEMS, ids=lambda path: path.stem)
def test_every_problem_of_the_library_compiles_without_complaint(problem: Path, tmp_path: Path) -> None:
    done = typeset(made(problem, Format.LATEX).decode(), tmp_path, once=problem.stem not in MOST_PAGES)
    assert done.complaints == []
    assert done.code == 0
    assert done.settled, "two runs are enough, and one leaves nothing but references open"
    assert done.pages <= MOST_PAGES.get(problem.stem, 30)
    assert min(map(len, lines_of(done.pdf))) >= FEWEST_LINES


@pytest.mark.latex
@pytest.mark.parametrize("name", ["craig-6-5-rp", "mls-scara", "spong-five-bar-trick"])
def test_with_stars_too(name: str, tmp_path: Path) -> None:
    problem = next(path for path in TEXTBOOKS if path.stem == name)
    done = typeset(made(problem, Format.LATEX, star=True).decode(), tmp_path)
    assert (done.code, done.complaints) == (0, [])


@pytest.mark.latex
@pytest.mark.parametrize(
    ("name", "size"), [("in3140-rp", "11pt"), ("elbow-3r", "12pt"), ("puma560-first3", "10pt")]
)
def test_a_fragment_fits_the_standard_classes(name: str, size: str, tmp_path: Path) -> None:
    problem = next(path for path in LIBRARY if path.stem == name)
    (tmp_path / "part.tex").write_bytes(made(problem, Format.LATEX, fragment=True))
    source = (
        f"\\documentclass[{size}]{{article}}\\usepackage{{amsmath}}\\begin{{document}}\n"
        "Before.\\input{part}\nAfter.\\end{document}\n"
    )
    done = typeset(source, tmp_path)
    assert (done.code, done.complaints) == (0, [])
    assert text_of(done.pdf).count("After.") == 1


def test_nothing_but_amsmath_is_used() -> None:
    source = made(RP, Format.LATEX).decode()
    assert re.findall(r"\\usepackage(?:\[.*?\])?\{(.*?)\}", source) == ["amsmath"]
    assert re.findall(r"\\documentclass\[.*?\]\{(.*?)\}", source) == ["article"]
    assert "\\documentclass" not in made(RP, Format.LATEX, fragment=True).decode()


def test_textbook_notation() -> None:
    plain, starred = (made(RP, Format.LATEX, star=star).decode() for star in (False, True))
    for sign in (r"\mathbf{H}_{2}^{0}", r"\dot{\theta}_{1}", r"\tau_{1} & {} =", "f_{2} & {} ="):
        assert sign in plain
    assert r"L_{2}^{\star 2}" in starred
    assert r"L_{2}^{\star 2}" not in plain
    assert r"\theta_{1}^{\star}" in plain, "the table marks joint variables, as the course's do"
    elbow = made(next(path for path in LIBRARY if path.stem == "planar-2r"), Format.LATEX).decode()
    assert "c_{12}" in elbow


def test_equations_are_numbered_and_the_text_refers_to_them() -> None:
    source = made(RP, Format.LATEX, detail=Detail.FULL).decode()
    labels = re.findall(r"\\label\{(.*?)\}", source)
    references = re.findall(r"\\eqref\{(.*?)\}", source)
    assert len(labels) == len(set(labels)) > 30
    assert len(references) > 30
    places = {label: source.index(f"\\label{{{label}}}") for label in labels}
    for reference in set(references):
        assert places[reference] < source.index(f"\\eqref{{{reference}}}"), "only what stands before is used"


@pytest.mark.latex
def test_a_hostile_title_is_text(tmp_path: Path) -> None:
    done = typeset(made(HOSTILE_PROBLEM, Format.LATEX).decode(), tmp_path)
    assert (done.code, done.complaints) == (0, [])
    shown = text_of(done.pdf).replace("\u02c6", "^")
    for part in SEEN:
        assert part.replace("_", " ") in shown, "the fonts draw _ as a line"
    assert "root:" not in shown
    assert "[U+05D0][U+4E2D]" in shown
