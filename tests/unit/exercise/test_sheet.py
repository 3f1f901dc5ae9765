"""Sheets: what is given and asked, in every form, and nothing of the solution."""

import re
from pathlib import Path

import pytest

from dynsolve.answers.reading.files import pandoc
from dynsolve.exercise.asked import parts
from dynsolve.exercise.sheet import SheetFormat, exam_source, sheet
from dynsolve.explain.step import Detail
from dynsolve.grading.set_file import load_set
from dynsolve.notation.markup import LatexPrinter
from dynsolve.notation.tree import Matrix, Node
from dynsolve.notation.unicode import UnicodePrinter
from dynsolve.problem.reader import bundled
from dynsolve.quantities.family import FORMED
from dynsolve.quantities.index import quantities
from tests.conftest import LARGE
from tests.support import solved, with_files

ARM = """title: Two links
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
find: [A, D]
marks: {A1: 1, A2: 1/2, D: 3}
"""
SHORT = 12
"""What is shorter than this may stand in any exercise."""


def told(file: Path, **options: str) -> str:
    return sheet(load_set(str(file)), SheetFormat.TEXT, **options).decode()


@pytest.fixture
def arm(tmp_path: Path) -> Path:
    return with_files(tmp_path, {"arm.yaml": ARM}) / "arm.yaml"


def test_what_is_asked_is_told_with_its_points(arm: Path) -> None:
    text = told(arm)
    assert "4.5 points" in text
    assert "a) Find the matrices 𝐀₁ and 𝐀₂ of the rows of the table. (1.5 points)" in text
    assert "b) Find the inertia matrix 𝐃. (3 points)" in text
    assert "arm: A1, A2, D." in text


def test_an_author_may_say_it_in_words(tmp_path: Path) -> None:
    words = "before: 'It weighs $(m1+m2)*g$.', given: 'See the figure.', D: 'Show that $l1$ is in D.'"
    file = with_files(tmp_path, {"arm.yaml": f"{ARM}text: {{{words}}}\n"}) / "arm.yaml"
    text = told(file)
    assert "It weighs (m₁ + m₂) g." in text
    assert "See the figure." in text and "Given:" not in text
    assert "b) Show that l₁ is in D. (3 points)" in text


WEIGHTED = ARM.replace(
    "find: [A, D]\nmarks: {A1: 1, A2: 1/2, D: 3}", "task: [tip.x]\nvelocity: [v]\nfind: [qd]"
)
CONVENTIONS = {
    "knife-edge": "Their sign is such that 𝐃 𝐪̈ + 𝐂 𝐪̇ + 𝐠 equals 𝛕 + 𝐀_cᵀ 𝛌.",
    "crane": "near the equilibrium. The state is in the order (",
    WEIGHTED + "weights: {q1: w, q2: 1}\n": "Of many, take those with the least 𝐪̇ᵀ 𝐖 𝐪̇.",
    WEIGHTED + "weights: D\n": "Of many, take those with the least 𝐪̇ᵀ 𝐃 𝐪̇.",
    WEIGHTED: "Find the rates of the coordinates 𝐪̇.",
}


@pytest.mark.parametrize("name", CONVENTIONS)
def test_what_a_sign_or_an_order_is_counted_by_is_told(name: str, tmp_path: Path) -> None:
    file = with_files(tmp_path, {"own.yaml": name}) / "own.yaml" if "\n" in name else Path(name)
    assert re.sub(r"\s+", "", CONVENTIONS[name]) in re.sub(r"\s+", "", told(file))


@pytest.mark.parametrize("name", sorted(bundled().keys() - LARGE))
def test_no_sheet_tells_what_is_asked(name: str) -> None:
    problems = load_set(name)
    robot = problems.items[0].problem.robot
    text = re.sub(r"\s+", "", told(Path(name)))
    write = UnicodePrinter().text
    known = quantities(robot)
    for part in parts(problems.items[0].problem, dict(problems.items[0].problem.marks)):
        for answer in part.names:
            if known[answer].family.kind in FORMED and answer != "DH":
                shown = solved(name).forms(known[answer].rule)
                for entry in entries(shown):
                    result = re.sub(r"\s+", "", write(entry))
                    assert len(result) < SHORT or result not in text, (answer, result)


def entries(shown: Node) -> list[Node]:
    return [entry for row in shown.rows for entry in row] if isinstance(shown, Matrix) else [shown]


def test_where_the_table_is_asked_for_no_frame_is_told() -> None:
    text = told(Path("inf3480-rrp-drawn"))
    assert "lengths in the figure (m)" in text
    assert "𝐨" not in text and "𝐳" not in text and "α" not in text
    page = sheet(load_set("inf3480-rrp-drawn"), SheetFormat.HTML).decode()
    assert "with its frames" not in page and ">z<" not in page


def test_a_folder_is_one_sheet(tmp_path: Path) -> None:
    other = ARM.replace("Two links", "Others")
    folder = with_files(tmp_path, {"a.yaml": ARM, "b.yaml": other, "set.yaml": "title: Week 3\n"})
    text = told(folder, date="3 December")
    assert text.startswith("Week 3\n") and "3 December, 9 points" in text
    assert "Exercise 1: Two links (4.5 points)" in text and "Exercise 2: Others (4.5 points)" in text


def test_a_key_stands_behind_the_sheet(arm: Path) -> None:
    page = sheet(load_set(str(arm)), SheetFormat.MARKDOWN, key=Detail.RESULTS).decode()
    before, _, behind = page.partition("# Key: Two links")
    result = LatexPrinter().text(solved(arm).forms("D").rows[1][1])
    assert result not in before and result in behind


@pytest.mark.parametrize("form", [SheetFormat.PDF, SheetFormat.LATEX, SheetFormat.HTML, SheetFormat.MARKDOWN])
def test_a_sheet_has_each_form(form: SheetFormat, arm: Path) -> None:
    data = sheet(load_set(str(arm)), form, key=Detail.RESULTS)
    begins = {
        SheetFormat.PDF: b"%PDF",
        SheetFormat.LATEX: b"\\documentclass",
        SheetFormat.HTML: b"<!DOCTYPE html>",
        SheetFormat.MARKDOWN: b"# Two links",
    }
    assert data.startswith(begins[form])
    assert data == sheet(load_set(str(arm)), form, key=Detail.RESULTS)


@pytest.mark.skipif(pandoc() is None, reason="the extra `office` is not installed")
def test_a_word_document_holds_the_picture(arm: Path) -> None:
    import io
    import zipfile

    data = sheet(load_set(str(arm)), SheetFormat.DOCX)
    with zipfile.ZipFile(io.BytesIO(data)) as file:
        assert any(name.startswith("word/media/") and name.endswith(".png") for name in file.namelist())
        assert "Find the inertia matrix" in file.read("word/document.xml").decode()


def test_the_class_exam_has_questions_and_parts_with_points(arm: Path) -> None:
    source = exam_source(load_set(str(arm)))
    assert source.startswith("\\documentclass[a4paper]{exam}")
    assert source.count("\\question") == 1 and source.count("\\part") == 2
    assert "\\part[3] Find the inertia matrix" in source
