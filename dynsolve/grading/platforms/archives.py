"""Zips that a platform takes back: the same files give the same bytes."""

from __future__ import annotations

import zipfile
from collections.abc import Iterable
from pathlib import Path

from dynsolve.render.files import changed


def write_archive(path: Path, files: Iterable[tuple[str, bytes]], executable: str = "") -> None:
    """Write a zip of files by their names, one in memory at a time; one of them may be a program."""
    with changed(path) as stream, zipfile.ZipFile(stream, "w") as archive:
        for name, content in files:
            entry = zipfile.ZipInfo(name)  # dated 1980
            entry.external_attr = (0o755 if name == executable else 0o644) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)
