"""What is taken from folders and zips, and what is refused by name."""

from __future__ import annotations

import io
import os
import stat
import time
import zipfile
from pathlib import Path, PurePosixPath

import pytest

from dynsolve.errors import InputError
from dynsolve.grading import uploads as uploads_module
from dynsolve.grading.hand_ins import take_in
from dynsolve.grading.set_file import ProblemSet
from dynsolve.grading.uploads import MAX_FILE, MAX_INSIDE, Uploads
from tests.unit.grading.taken import ANSWER

# -- what is taken from folders and zips, and what is refused by name --------------------------------


def _zip(path: Path, *members: tuple[zipfile.ZipInfo | str, bytes]) -> Uploads:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in members:
            archive.writestr(name, content)
    return Uploads(path)


class _Raw(zipfile.ZipInfo):
    """A member whose name is written as these bytes, without the mark of UTF-8."""

    def __init__(self, name: bytes) -> None:
        super().__init__(repr(name))
        self.raw = name

    def _encodeFilenameFlags(self) -> tuple[bytes, int]:
        return self.raw, self.flag_bits & ~0x800


def _refused(uploads: Uploads) -> dict[str, str]:
    return {refused.name: refused.reason for refused in uploads.refused}


@pytest.mark.parametrize("name", ["../x.yaml", "/etc/x.yaml", "a/../../x.yaml", "C:/x.yaml", "..\\x.yaml"])
def test_a_name_that_leads_out_of_the_folder_is_refused(tmp_path: Path, name: str) -> None:
    uploads = _zip(tmp_path / "a.zip", (zipfile.ZipInfo(name), b"K: 0"), ("good.yaml", b"K: 0"))
    assert [str(upload.path) for upload in uploads.files] == ["good.yaml"]
    assert list(_refused(uploads).values()) == ["its name leads out of the folder"]


def test_a_link_in_a_zip_is_refused(tmp_path: Path) -> None:
    link = zipfile.ZipInfo("link.yaml")
    link.external_attr = (stat.S_IFLNK | 0o777) << 16
    uploads = _zip(tmp_path / "a.zip", (link, b"/etc/passwd"))
    assert _refused(uploads) == {"link.yaml": "a link"}


def test_a_bomb_is_refused_and_never_unpacked(tmp_path: Path) -> None:
    uploads = _zip(tmp_path / "a.zip", ("bomb.yaml", b"\0" * 50_000_000), ("good.yaml", b"K: 0"))
    assert _refused(uploads) == {"bomb.yaml": "it unpacks to far more than it is (a zip bomb)"}


def test_a_size_that_lies_is_read_no_further_than_the_bound(tmp_path: Path) -> None:
    path = tmp_path / "a.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("a.yaml", os.urandom(MAX_FILE // 2) * 3)
    uploads = Uploads(path)
    assert "larger than" in _refused(uploads)["a.yaml"]


def test_characters_that_cannot_be_seen_are_shown_as_such(tmp_path: Path) -> None:
    uploads = _zip(tmp_path / "a.zip", ("a\x1b[31m.yaml", b""), ("b\u202elmay.exe", b""))
    assert set(_refused(uploads)) == {"a\\x1b[31m.yaml", "b\\u202elmay.exe"}


def test_links_and_pipes_in_a_folder_are_refused(tmp_path: Path) -> None:
    (tmp_path / "good.yaml").write_text("K: 0")
    (tmp_path / "link.yaml").symlink_to("/etc/passwd")
    (tmp_path / "out").symlink_to("/etc")
    os.mkfifo(tmp_path / "pipe.yaml")
    uploads = Uploads(tmp_path)
    assert [str(upload.path) for upload in uploads.files] == ["good.yaml"]
    assert _refused(uploads) == {"link.yaml": "a link", "out": "a link", "pipe.yaml": "no ordinary file"}


def test_a_damaged_member_is_an_input_error_of_its_own(tmp_path: Path) -> None:
    path = tmp_path / "a.zip"
    _zip(path, ("a.yaml", b"K: " + b"m1*g" * 300), ("b.yaml", b"K: 0")).close()
    data = bytearray(path.read_bytes())
    place = data.index(b"a.yaml") + 8
    data[place : place + 6] = b"\xff" * 6
    path.write_bytes(bytes(data))
    uploads = Uploads(path)
    with pytest.raises(InputError):
        uploads.read(uploads.files[0])
    assert uploads.read(uploads.files[1]) == b"K: 0"


def test_what_is_neither_folder_nor_zip_says_so(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("no zip")
    with pytest.raises(InputError, match="neither a folder nor a zip"):
        Uploads(tmp_path / "a.txt")
    with pytest.raises(InputError, match="no such file"):
        Uploads(tmp_path / "nowhere")


def test_names_that_windows_and_macos_write(tmp_path: Path) -> None:
    names = ["Bjørn Ærlig/k.yaml", "windows\\sub\\x.yaml", "windows\\sub\\", "plain/y.yaml"]
    uploads = _zip(tmp_path / "a.zip", *((_Raw(name.encode()), b"K: 0") for name in names))
    assert [str(upload.path) for upload in uploads.files] == [
        "Bjørn Ærlig/k.yaml", "plain/y.yaml", "windows/sub/x.yaml",
    ]  # fmt: skip
    assert all(uploads.read(upload) == b"K: 0" for upload in uploads.files)


def test_a_name_in_the_old_code_page_stays_readable(tmp_path: Path) -> None:
    uploads = _zip(tmp_path / "a.zip", (_Raw("ål/k.yaml".encode("cp437")), b"K: 0"))
    assert [str(upload.path) for upload in uploads.files] == ["ål/k.yaml"]


def test_what_systems_and_editors_leave_behind_is_left_alone(tmp_path: Path) -> None:
    names = [
        "__MACOSX/s1/._a.yaml", "s1/.DS_Store", "s1/._a.yaml", "s1/~$report.docx", "s1/.~lock.a.odt#",
        "s1/.ipynb_checkpoints/a-checkpoint.ipynb", "s1/.git/config", "s1/a.yaml",
    ]  # fmt: skip
    uploads = _zip(tmp_path / "a.zip", *((name, b"") for name in names))
    assert ([str(upload.path) for upload in uploads.files], uploads.refused) == (["s1/a.yaml"], [])
    with zipfile.ZipFile(tmp_path / "a.zip") as archive:
        archive.extractall(tmp_path / "folder")
    uploads = Uploads(tmp_path / "folder")
    assert ([str(upload.path) for upload in uploads.files], uploads.refused) == (["s1/a.yaml"], [])


def test_the_folder_of_the_results_is_no_hand_in(tmp_path: Path) -> None:
    for name in ("s1/a.yaml", "out/feedback/s1/a.html", "s2/out/b.yaml"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("K: 0")
    uploads = Uploads(tmp_path, besides=tmp_path / "s1" / ".." / "out")
    assert [str(upload.path) for upload in uploads.files] == ["s1/a.yaml", "s2/out/b.yaml"]


def test_a_file_that_is_another_when_it_is_read_is_an_input_error(tmp_path: Path) -> None:
    for name in ("gone", "pipe", "link", "grown"):
        (tmp_path / f"{name}.yaml").write_text("K: 0")
    uploads = Uploads(tmp_path)
    for name in ("gone", "pipe", "link"):
        (tmp_path / f"{name}.yaml").unlink()
    os.mkfifo(tmp_path / "pipe.yaml")
    (tmp_path / "link.yaml").symlink_to("/etc/passwd")
    (tmp_path / "grown.yaml").write_bytes(b"x" * (MAX_FILE + 1))
    for upload in uploads.files:
        with pytest.raises(InputError):
            uploads.read(upload)


def test_a_folder_that_cannot_be_looked_at_is_refused_by_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("locked/a.yaml", "open/b.yaml"):
        (tmp_path / name).parent.mkdir()
        (tmp_path / name).write_text("K: 0")
    real = os.scandir

    def scandir(path: str) -> object:
        if str(path).endswith("locked"):
            raise PermissionError(13, "Permission denied", str(path))
        return real(path)

    monkeypatch.setattr(os, "scandir", scandir)
    uploads = Uploads(tmp_path)
    assert [str(upload.path) for upload in uploads.files] == ["open/b.yaml"]
    assert _refused(uploads) == {"locked": "cannot be read: permission denied"}


def test_a_socket_and_a_device_are_refused(tmp_path: Path) -> None:
    import socket

    with socket.socket(socket.AF_UNIX) as one:
        one.bind(os.fspath(tmp_path / "s.yaml"))
    assert _refused(Uploads(tmp_path)) == {"s.yaml": "no ordinary file"}


def test_no_more_files_than_may_be_are_taken(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(uploads_module, "MAX_FILES", 3)
    for i in range(9):
        (tmp_path / f"{i}.yaml").write_text("K: 0")
    uploads = Uploads(tmp_path)
    assert len(uploads.files) == 3
    assert list(_refused(uploads).values()) == ["the folder has more than 3 files"]


@pytest.mark.parametrize("name", ["", ".", "./", "a\0b.yaml"])
def test_a_member_without_a_name_harms_nothing(tmp_path: Path, name: str) -> None:
    uploads = _zip(tmp_path / "a.zip", (zipfile.ZipInfo(name), b""), ("good.yaml", b"K: 0"))
    assert "good.yaml" in [str(upload.path) for upload in uploads.files]
    assert all(upload.path.parts for upload in uploads.files)


def test_members_that_overlap_are_not_read_twice_over(tmp_path: Path) -> None:
    path = tmp_path / "a.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("a.yaml", os.urandom(100_000))
        archive.writestr("b.yaml", b"K: 0")
    with zipfile.ZipFile(path, "a") as archive:
        archive.getinfo("b.yaml").header_offset = 0
        archive._didModify = True  # type: ignore[attr-defined]
    uploads = Uploads(path)
    with pytest.raises(InputError):
        uploads.read(next(upload for upload in uploads.files if upload.path.name == "b.yaml"))


# -- hand-ins that are refused, that attack, or that come in a ZIP -----------------------------------


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
