"""Hand-ins that are refused, that attack, or that come in a ZIP."""

from __future__ import annotations

import io
import time
import zipfile
from pathlib import Path, PurePosixPath

import pytest

from dynsolve.grading.hand_ins import take_in
from dynsolve.grading.set_file import ProblemSet
from dynsolve.grading.uploads import MAX_INSIDE, Uploads
from tests.unit.grading.taken import ANSWER


def test_a_refused_file_is_still_its_students(problems: ProblemSet, tmp_path: Path) -> None:
    path = tmp_path / "a.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("ada_41_7_bomb.yaml", b"\0" * 10_000_000)
        archive.writestr("bob_42_8_in3140-rp.yaml", ANSWER)
        archive.writestr(zipfile.ZipInfo("../x.yaml"), ANSWER)
        archive.writestr(zipfile.ZipInfo(""), ANSWER)
    intake = take_in(problems, Uploads(path))
    assert intake.students == {"ada_41": "41", "bob_42": "42"}
    assert [(w.student, w.file) for w in intake.waiting] == [
        ("", ""), ("", "../x.yaml"), ("ada_41", "ada_41_7_bomb.yaml"),
    ]  # fmt: skip


HOSTILE = {
    "fences.md": "---\n" + "\n" * 2_000_000,
    "blanks.md": "---\n" + " " * 1_000_000 + "\n---",
    "field.yaml": "problem:" + " \t" * 1_000_000,
    "fields.yaml": "problem: " * 200_000,
    "student.yaml": ("student" + " " * 30 + "\n") * 50_000,
    "tags.html": "<h1" * 600_000,
    "headings.html": "<h1>" * 500_000,
    "attributes.html": ("<h1" + " a" * 100) * 9_000,
    "setext.md": ("x" * 300 + "\n=") * 6_000,
    "titles.tex": "\\title{" * 200_000,
    "hashes.md": "#" * 2_000_000,
    "spaces.md": "# " * 1_000_000,
    "nested.ipynb": "[" * 2_000_000,
    "cells.ipynb": '{"cells": [' + "{}," * 500_000 + "{}]}",
    "sources.ipynb": '{"cells": [{"source": ' + "[" * 900 + "]" * 900 + "}]}",
    "number.ipynb": "9" * 2_000_000,
    "zeros.yaml": "\0" * 2_000_000,
    "comment.html": "<!--" * 500_000,
}


@pytest.mark.usefixtures("frozen_heap")
@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_file_is_sorted_quickly(problems: ProblemSet, tmp_path: Path, name: str) -> None:
    (tmp_path / "good.yaml").write_text("problem: in3140-rp\n" + ANSWER)
    (tmp_path / name).write_text(HOSTILE[name][:2_000_000])
    start = time.process_time()
    intake = take_in(problems, Uploads(tmp_path))
    assert time.process_time() - start < 0.5
    assert "good" in {hand_in.student for hand_in in intake.hand_ins}


def _zipped(files: dict[str, bytes]) -> bytes:
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return out.getvalue()


ZIPPED = {
    "in3140-rp.yaml": ANSWER.encode(),
    "work/planar-2r.yaml": b"answers:\n  g2: 0\n",
    "photo.jpg": b"x",
    "more.zip": _zipped({"in3140-rp.yaml": ANSWER.encode()}),
    "__MACOSX/._in3140-rp.yaml": b"x",
}


@pytest.mark.parametrize(
    ("name", "student"),
    [("lovelaceada_41_7_all.zip", "lovelaceada_41"), ("s1/all.zip", "s1"), ("s1.zip", "s1")],
)
def test_a_zip_that_was_handed_in_is_opened(
    problems: ProblemSet, tmp_path: Path, name: str, student: str
) -> None:
    path = tmp_path / name
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(_zipped(ZIPPED))
    (tmp_path / "other_42_8_in3140-rp.yaml").write_text(ANSWER)
    uploads = Uploads(tmp_path)
    intake = take_in(problems, uploads, {})
    found = {
        h.problem: [uploads.read(f.upload) for f in h.files] for h in intake.hand_ins if h.student == student
    }
    assert found == {"in3140-rp": [ZIPPED["in3140-rp.yaml"]], "planar-2r": [ZIPPED["work/planar-2r.yaml"]]}
    assert sorted(PurePosixPath(w.file).name for w in intake.waiting) == ["more.zip", "photo.jpg"]


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (b"no zip", "an archive: it is damaged, or no zip"),
        (_zipped({}), "an archive without a file in it"),
        (_zipped({"bomb.yaml": bytes(1_900_000)}), "it unpacks to far more than it is (a zip bomb)"),
        (_zipped({"../x.yaml": b"K: 0"}), "its name leads out of the folder"),
    ],
)
def test_a_zip_that_cannot_be_opened_waits(
    problems: ProblemSet, tmp_path: Path, content: bytes, reason: str
) -> None:
    (tmp_path / "ada_41_7_in3140-rp.zip").write_bytes(content)
    intake = take_in(problems, Uploads(tmp_path), {})
    assert [(w.student, w.problem, w.reason) for w in intake.waiting] == [("ada_41", "in3140-rp", reason)]
    assert not intake.hand_ins


def test_a_zip_holds_no_more_than_the_bounds(problems: ProblemSet, tmp_path: Path) -> None:
    files = {f"{i}/in3140-rp.yaml": ANSWER.encode() for i in range(MAX_INSIDE + 3)}
    (tmp_path / "ada_41_7_in3140-rp.zip").write_bytes(_zipped(files))
    intake = take_in(problems, Uploads(tmp_path), {})
    assert [len(h.files) for h in intake.hand_ins] == [MAX_INSIDE]
    assert {w.reason for w in intake.waiting} == {"the zip holds too much"}
