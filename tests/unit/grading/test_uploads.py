"""What is taken from folders and zips, and what is refused by name."""

from __future__ import annotations

import os
import stat
import zipfile
from pathlib import Path

import pytest

from dynsolve.errors import InputError
from dynsolve.grading.uploads import MAX_FILE, Uploads


def _zip(path: Path, *members: tuple[zipfile.ZipInfo | str, bytes]) -> Uploads:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in members:
            archive.writestr(name, content)
    return Uploads(path)


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
