"""PDF reports: made without TeX, the same bytes each time."""

from __future__ import annotations

import re
import subprocess
import sys
import time
from pathlib import Path

import pytest

from dynsolve.document import Document, Heading, Text
from dynsolve.explain.step import Detail
from dynsolve.render.typst import render
from dynsolve.solution.reports import Format
from tests.cli.running import dynsolve_afresh
from tests.reports.tools import FEWEST_LINES, HOSTILE_PROBLEM, SEEN, lines_of, made, text_of, words_of
from tests.support import ALL_PROBLEMS, LIBRARY, ROOT

pytestmark = pytest.mark.slow

CHOSEN = {"box-cylinder-rod-sphere", "elbow-3r", "five-bar", "in3140-rp", "inf3480-rprr-drawn", "inf3480-rpr"}
CHOSEN |= {"knife-edge", "numeric-2r", "planar-2r", "planar-2r-motors", "rp-parameters", "spherical-rrp"}
"""A report of each kind; the pages of all are looked at as pdflatex makes them."""


@pytest.mark.parametrize(
    "problem", [path for path in ALL_PROBLEMS if path.stem in CHOSEN], ids=lambda path: path.stem
)
def test_every_problem_gives_a_pdf_in_which_no_page_is_nearly_empty(problem: Path, tmp_path: Path) -> None:
    pdf = tmp_path / "report.pdf"
    pdf.write_bytes(made(problem, Format.PDF))
    pages = lines_of(pdf)
    shown = " ".join(line for page in pages for line in page)
    if re.search(r"^(?:dh|axes):", problem.read_text(encoding="utf-8"), re.MULTILINE):
        assert "Forward kinematics" in shown
        assert "(10)" in shown
    assert min(map(len, pages)) >= FEWEST_LINES


@pytest.mark.parametrize(
    ("name", "most"), [("in3140-rp", 5), ("planar-2r", 6), ("elbow-3r", 11), ("puma560", 12)]
)
def test_a_report_has_few_pages(name: str, most: int, tmp_path: Path) -> None:
    pdf = tmp_path / "report.pdf"
    pdf.write_bytes(made(next(path for path in LIBRARY if path.stem == name), Format.PDF))
    assert len(lines_of(pdf)) <= most


@pytest.mark.parametrize("name", ["planar-2r", "elbow-3r"])
def test_every_equation_has_its_number_once(name: str, tmp_path: Path) -> None:
    pdf = tmp_path / "report.pdf"
    pdf.write_bytes(made(next(path for path in LIBRARY if path.stem == name), Format.PDF, detail=Detail.FULL))
    pages = lines_of(pdf)
    beside = [int(found[1]) for page in pages for line in page if (found := NUMBER.search(line))]
    assert beside == list(range(1, len(beside) + 1))
    assert len(beside) > 50


def test_both_sides_of_an_equation_stand_on_one_line(tmp_path: Path) -> None:
    """τ = ... row by row: the two sides are cells of a grid, which knows of no line of writing."""
    pdf = tmp_path / "report.pdf"
    pdf.write_bytes(made(next(path for path in LIBRARY if path.stem == "spherical-rrp"), Format.PDF))
    words = words_of(pdf)
    torques = [k for k, (word, _) in enumerate(words) if word == "𝜏"]
    apart = [
        abs(words[k][1] - top) for k in torques for word, top in words[k + 1 : k + 3] if word.startswith("=")
    ]
    assert len(apart) > 3 and max(apart) < 0.2


def test_a_report_has_contents_and_page_numbers(tmp_path: Path) -> None:
    pdf = tmp_path / "report.pdf"
    pdf.write_bytes(
        made(next(path for path in LIBRARY if path.stem == "elbow-3r"), Format.PDF, detail=Detail.FULL)
    )
    first, *others = lines_of(pdf)
    listed = dict(
        re.findall(r"^ *(\d\. [A-Z].*?)[ .\u2060]{5,}(\d+)$", "\n".join([*first, *others[0]]), re.MULTILINE)
    )
    assert len(listed) >= 7
    for heading, number in listed.items():
        assert any(line.strip() == heading for line in [first, *others][int(number) - 1])
    for number, page in enumerate(others, 2):
        assert page[0].split() == [*"Spatial elbow manipulator (3R)".split(), str(number)]


@pytest.mark.parametrize("name", ["elbow-3r", "box-cylinder-rod-sphere"])
def test_no_page_ends_with_a_heading_or_a_formula_of_the_book(name: str, tmp_path: Path) -> None:
    pdf = tmp_path / "report.pdf"
    pdf.write_bytes(made(next(path for path in LIBRARY if path.stem == name), Format.PDF, detail=Detail.FULL))
    pages = lines_of(pdf)
    laws = [line for page in pages for line in page if LAW.search(line)]
    assert len(laws) > 20
    assert [page[-1] for page in pages if LAW.search(page[-1]) or HEADING.match(page[-1])] == []


@pytest.mark.parametrize("name", ["elbow-3r", "box-cylinder-rod-sphere"])
def test_no_line_of_a_sentence_ends_with_a_sign_between_two_parts(name: str, tmp_path: Path) -> None:
    pdf = tmp_path / "report.pdf"
    pdf.write_bytes(made(next(path for path in LIBRARY if path.stem == name), Format.PDF, detail=Detail.FULL))
    lines = [line for page in lines_of(pdf) for line in page if re.search("[a-z]{2} [a-z]{2}", line)]
    assert sum("=" in line for line in lines) > 10
    assert [line for line in lines if line.rstrip().endswith(("=", "−", "+"))] == []


def written(paragraphs: int, closing: int, pdf: Path) -> list[list[str]]:
    """The lines on the pages of a document with paragraphs of a word before its summary, and in that."""
    words = [Text((f"Word{k}.",)) for k in range(paragraphs)]
    summary = [Heading("Summary", closing=True), *(Text((f"Result{k}.",)) for k in range(closing))]
    pdf.write_bytes(render(Document((Heading("Title", 1), *words, *summary))))
    return lines_of(pdf)


@pytest.mark.parametrize(("filled", "page_of_summary"), [(0.3, 1), (0.55, 1), (0.75, 2), (0.9, 2)])
def test_the_summary_is_on_one_page_unless_that_left_much_of_another_empty(
    filled: float, page_of_summary: int, tmp_path: Path
) -> None:
    """One that takes half a page begins where a third is left; where less is, on a page of its own."""
    pdf = tmp_path / "report.pdf"
    room = len(written(200, 0, pdf)[0])
    pages = written(round(filled * room), room // 2, pdf)
    found = [k for k, page in enumerate(pages, 1) if any(line.strip() == "Summary" for line in page)]
    assert found == [page_of_summary]


def test_no_page_begins_with_a_note(tmp_path: Path) -> None:
    pdf = tmp_path / "report.pdf"
    pdf.write_bytes(made(next(path for path in LIBRARY if path.stem == "elbow-3r"), Format.PDF))
    firsts = [page[1].strip() for page in lines_of(pdf)[1:]]
    assert not any(line.startswith("Note.") for line in firsts)


LAW = re.compile(r" {3,}§[\d.]+$")
"""The section of the textbook, at the right edge."""

HEADING = re.compile(r" *\d+\.(?:\d+(?:\.\d+)?)? +[A-Z]")
"""The beginning of the title of a section, or of a step."""

NUMBER = re.compile(r" {3,}\((\d+)\)$")
"""The number of an equation, at the right edge."""


def test_the_same_bytes_in_every_process_and_at_every_time(tmp_path: Path) -> None:
    reports = []
    for seed in ("1", "2"):
        done = dynsolve_afresh("solve", "in3140-rp", "-o", str(tmp_path / f"{seed}.pdf"), PYTHONHASHSEED=seed)
        assert (done.code, done.out) == (0, "")
        reports.append((tmp_path / f"{seed}.pdf").read_bytes())
        time.sleep(1.1)
    assert reports[0] == reports[1]
    assert reports[0].startswith(b"%PDF-")


def test_a_hostile_title_is_text(tmp_path: Path) -> None:
    pdf = tmp_path / "report.pdf"
    pdf.write_bytes(made(HOSTILE_PROBLEM, Format.PDF))
    shown = text_of(pdf)
    for part in SEEN:
        assert part.replace(" ", "") in shown.replace(" ", "")
    assert "root:" not in shown


def test_without_the_extra_the_message_says_what_to_install() -> None:
    script = (
        "import sys; sys.modules['typst'] = None; from dynsolve.cli.main import main; "
        "main(['solve', 'in3140-rp', '--pdf', '-o', 'never.pdf'])"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, cwd=ROOT, check=False)
    assert done.returncode == 2
    assert "pip install 'dynsolve[pdf]'" in done.stderr.decode()
    assert not (ROOT / "never.pdf").exists()
