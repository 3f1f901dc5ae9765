"""The pages under the names that Canvas looks for, read as Canvas reads them.

`infer_comment_context_from_filename` of instructure/canvas-lms, `app/models/abstract_assignment.rb`: without
`LATE`, the first two parts that are digits alone are the student's number and the file's; of an
anonymous name the two parts after `anon`.
"""

from __future__ import annotations

import io
import json
import re
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from dynsolve.grading.platforms.canvas import write_comments
from dynsolve.grading.record import Record, Waiting


@pytest.fixture
def record(tmp_path: Path) -> Iterator[Record]:
    opened = Record(tmp_path)
    yield opened
    opened.close()


def _seen_by_canvas(name: str) -> tuple[str, str]:
    parts = [part for part in name.split("_") if part != "LATE"]
    if parts[0] == "anon":
        return parts[1], parts[2]
    user, file = [part for part in parts if re.fullmatch("[0-9]+", part)][:2]
    return user, file


def _written(
    tmp_path: Path,
    record: Record,
    uploads: dict[tuple[str, str], tuple[str, ...]],
    waiting: tuple[Waiting, ...] = (),
) -> tuple[dict[str, bytes], list[str]]:
    """The files of the zip, and the warnings, for pages that say whose they are."""
    keys = {*uploads, *((w.student, w.problem) for w in waiting)}
    record.set_intake({student: "" for student, _ in keys}, waiting)
    record.set_uploads(uploads)
    empty = {
        "answers": [],
        "files": [],
        "left": [],
        "late": 0,
        "reason": "",
        "notes": [],
        "html": "",
        "markdown": "",
    }
    for student, problem in keys:
        record.write((student, problem), "", "{}", empty)
        place = tmp_path / "feedback" / student
        place.mkdir(parents=True, exist_ok=True)
        (place / f"{problem}.html").write_text(f"<p>{problem} of {student.partition('-')[0]}</p>")
        (place / f"{problem}.md").write_text(f"{problem} of {student.partition('-')[0]}")
    warnings = list(write_comments(tmp_path, record))
    with zipfile.ZipFile(tmp_path / "canvas-comments.zip") as packed:
        return {name: packed.read(name) for name in packed.namelist()}, warnings


@pytest.mark.parametrize(
    ("path", "user", "file"),
    [
        ("lovelaceada_101_9001_rp.yaml", "101", "9001"),
        ("download/van_der_bergåse_LATE_103_9003_2_rp.md", "103", "9003"),
        ("anon_xY3aB_9001_rp.tex", "xY3aB", "9001"),
    ],
)
def test_canvas_finds_whose_each_page_is(
    tmp_path: Path, record: Record, path: str, user: str, file: str
) -> None:
    both = {("s", "rp"): (path,), ("s", "elbow"): (path,)}
    found, warnings = _written(tmp_path, record, both)
    assert [_seen_by_canvas(name) for name in found] == [(user, file)] * 2 and not warnings
    assert {content.decode() for content in found.values()} == {"rp of s", "elbow of s"}


def test_a_page_is_what_its_name_promises(tmp_path: Path, record: Record) -> None:
    names = ("a_1_11_x.html", "b_2_12_x.ipynb", "c_3_13_x.zip/rp.yaml", "d_4_14_x.tex")
    found, warnings = _written(tmp_path, record, {(name[0], "rp"): (name,) for name in names})
    assert list(found) == ["a_1_11_x.html", "b_2_12_x.ipynb", "c_3_13_x.zip", "d_4_14_x.tex"] and not warnings
    html, notebook, packed, text = found.values()
    assert html == b"<p>rp of a</p>" and text == b"rp of d"
    assert json.loads(notebook)["cells"][0]["source"] == "rp of b"
    with zipfile.ZipFile(io.BytesIO(packed)) as inner:
        assert inner.read("rp.html") == b"<p>rp of c</p>"


def test_what_cannot_carry_a_page_is_named(tmp_path: Path, record: Record) -> None:
    waits = (Waiting("c", "rp", "c_3_13_scan.pdf", "a PDF"), Waiting("d", "rp", "d_4_14_scan.pdf", "a PDF"))
    uploads = {
        ("a", "rp"): ("a_1_text.html",),
        ("b", "rp"): ("b_2_12_x.docx",),
        ("c", "elbow"): ("c_3_15_x.md",),
    }
    found, warnings = _written(tmp_path, record, uploads, waits)
    assert list(found) == ["c_3_15_elbow_x.md", "c_3_15_rp_x.md"]  # the PDF's page goes with the other file
    assert warnings == [
        "Canvas cannot give back the pages of who handed in no file that can carry them: a; b; d"
    ]


def test_the_members_of_a_group_share_a_page(tmp_path: Path, record: Record) -> None:
    path = ("group1_1_11_rp.yaml",)
    found, warnings = _written(tmp_path, record, {("g-1", "rp"): path, ("g-2", "rp"): path})
    assert found == {"group1_1_11_rp.yaml": b"rp of g"} and not warnings
    found, warnings = _written(tmp_path, record, {("g-1", "rp"): path, ("h-3", "rp"): path})
    assert not found
    differ = "in Canvas a group reads one page, and those of its members differ: group1_1_11_rp.yaml"
    assert warnings[-1] == differ
