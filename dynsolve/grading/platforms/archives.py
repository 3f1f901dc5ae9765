"""Zips that a platform takes back: the same files give the same bytes."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Collection, Iterable
from pathlib import Path
from typing import IO

from dynsolve.render.files import changed

Files = Iterable[tuple[str, bytes]]
"""Files by their names within the zip."""


def write_archive(path: Path, files: Files) -> None:
    """Write a zip of files, one of which is in memory at a time."""
    with changed(path) as stream:
        _write(stream, files)


def zipped(files: Files, programs: Collection[str] = ()) -> bytes:
    """The bytes of a zip of files, of which some are programs."""
    stream = io.BytesIO()
    _write(stream, files, programs)
    return stream.getvalue()


def _write(stream: IO[bytes], files: Files, programs: Collection[str] = ()) -> None:
    with zipfile.ZipFile(stream, "w") as archive:
        for name, content in files:
            entry = zipfile.ZipInfo(name)  # dated 1980
            entry.external_attr = (0o100755 if name in programs else 0o100644) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)
