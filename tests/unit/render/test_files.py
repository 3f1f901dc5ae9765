"""Files are written whole or not at all, and a file that would not change is left alone."""

from __future__ import annotations

from pathlib import Path

import pytest

from dynsolve.errors import UsageError
from dynsolve.render import files


def _names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


@pytest.fixture
def full_disk(monkeypatch: pytest.MonkeyPatch) -> None:
    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(files.os, "fsync", full)


@pytest.mark.usefixtures("full_disk")
def test_a_failure_half_way_leaves_the_old_file(tmp_path: Path) -> None:
    path = tmp_path / "sol.tex"
    path.write_text("old")
    with pytest.raises(UsageError, match="no space left on device"):
        files.write_whole(path, b"new")
    with pytest.raises(OSError, match="No space left"):
        files.write_changed(path, b"new")
    assert path.read_text() == "old"
    assert _names(tmp_path) == ["sol.tex"]


@pytest.mark.usefixtures("full_disk")
def test_only_what_is_durable_waits_for_the_disk(tmp_path: Path) -> None:
    files.write_changed(tmp_path / "page.html", b"new", durable=False)
    assert _names(tmp_path) == ["page.html"]


def test_links_and_permissions_are_kept(tmp_path: Path) -> None:
    real = tmp_path / "real.md"
    real.write_text("old")
    real.chmod(0o640)
    (tmp_path / "link.md").symlink_to(real)
    files.write_whole(tmp_path / "link.md", b"new")
    assert (tmp_path / "link.md").is_symlink()
    assert real.read_text() == "new"
    assert real.stat().st_mode & 0o777 == 0o640


def test_what_does_not_change_is_not_written(tmp_path: Path) -> None:
    path = tmp_path / "out" / "grades.csv"
    files.write_changed(path, b"one")
    before = path.stat()
    files.write_changed(path, b"one")
    after = path.stat()
    assert (after.st_ino, after.st_mtime_ns) == (before.st_ino, before.st_mtime_ns)
    files.write_changed(path, b"two")
    assert path.read_bytes() == b"two"


def test_a_file_in_pieces_is_whole_or_not_at_all(tmp_path: Path) -> None:
    path = tmp_path / "pages.zip"
    for _ in range(2):
        with files.changed(path) as stream:
            stream.write(b"one")
            stream.write(b"two")
        before = path.stat().st_ino if path.exists() else 0
    assert path.read_bytes() == b"onetwo" and path.stat().st_ino == before
    with pytest.raises(KeyError), files.changed(path) as stream:
        stream.write(b"half")
        raise KeyError
    assert path.read_bytes() == b"onetwo" and _names(tmp_path) == ["pages.zip"]


def test_what_a_killed_run_left_is_taken_away(tmp_path: Path) -> None:
    path = tmp_path / "grades.csv"
    files.temporary_of(path).write_bytes(b"half")
    files.write_changed(path, b"whole")
    assert _names(tmp_path) == ["grades.csv"]
