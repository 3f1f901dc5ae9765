"""Files that are written whole or not at all: what stood there before stays until the new one is complete.

The forms that results have, and the suffixes of files that say them.
"""

from __future__ import annotations

import os
import stat
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from enum import StrEnum
from filecmp import cmp
from pathlib import Path
from typing import IO

from dynsolve.errors import UsageError


def check_place(path: Path) -> None:
    """Refuse a place that cannot be written, before any work is done for it.

    Raises UsageError.
    """
    folder = path.resolve().parent
    if path.is_dir():
        raise UsageError(f"{path} is a folder")
    if not folder.is_dir():
        raise UsageError(f"{path} cannot be written: there is no folder {path.parent}")
    if not os.access(path if path.exists() else folder, os.W_OK):
        raise UsageError(f"{path} cannot be written: permission denied")


def write_whole(path: Path, data: bytes) -> None:
    """Write a file that the user named, with the permissions and through the link that it has.

    Raises UsageError where it cannot be written.
    """
    check_place(path)
    try:
        if path.exists() and not path.is_file():  # a pipe or a device
            path.write_bytes(data)
            return
        place = path.resolve()
        handle, name = tempfile.mkstemp(prefix=f".{place.name[:40]}.", dir=place.parent)
        os.close(handle)
        _by_way_of(Path(name), place, data, mode=_mode(place))
    except OSError as error:
        raise UsageError(f"{path} cannot be written: {(error.strerror or str(error)).lower()}") from None


def write_changed(path: Path, data: bytes, *, durable: bool = True) -> None:
    """Write a file of a folder that this process holds alone, and only where something changes.

    The temporary file's name is certain, so that the next run takes away what a killed
    one left.  What is not `durable` may be torn by a power cut; the next run mends it.

    Raises OSError where it cannot be written.
    """
    try:
        if path.read_bytes() == data:
            return
    except OSError:
        pass  # there is none yet, or none that can be read: it is written anew
    path.parent.mkdir(parents=True, exist_ok=True)
    _by_way_of(temporary_of(path), path, data, durable=durable)


@contextmanager
def changed(path: Path) -> Iterator[IO[bytes]]:
    """A stream to write such a file to piece by piece, for what is too large to be held at once.

    Raises OSError where it cannot be written.
    """
    temporary = temporary_of(path)
    try:
        with temporary.open("wb") as stream:
            yield stream
            stream.flush()
            os.fsync(stream.fileno())
        if path.is_file() and cmp(temporary, path, shallow=False):
            temporary.unlink()
        else:
            temporary.replace(path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def temporary_of(path: Path) -> Path:
    """The temporary file that `write_changed` writes first.

    >>> temporary_of(Path("out/grades.csv")).name
    '.grades.csv.new'
    """
    return path.with_name(f".{path.name}.new")


def _by_way_of(
    temporary: Path, path: Path, data: bytes, *, mode: int | None = None, durable: bool = True
) -> None:
    try:
        with temporary.open("wb") as stream:
            stream.write(data)
            if durable:  # else a power cut could leave the new name with nothing in it
                stream.flush()
                os.fsync(stream.fileno())
        if mode is not None:
            temporary.chmod(mode)
        temporary.replace(path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def _mode(path: Path) -> int:
    """The permissions of the old file, or those of a new one."""
    if path.exists():
        return stat.S_IMODE(path.stat().st_mode)
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask


# The forms that results have, and the suffixes of files that say them


class Format(StrEnum):
    """The forms of a solution."""

    TEXT = "text"
    JSON = "json"
    LATEX = "latex"
    PDF = "pdf"
    HTML = "html"
    MARKDOWN = "markdown"


SUFFIXES = {
    ".txt": Format.TEXT,
    ".json": Format.JSON,
    ".tex": Format.LATEX,
    ".pdf": Format.PDF,
    ".html": Format.HTML,
    ".htm": Format.HTML,
    ".md": Format.MARKDOWN,
    ".markdown": Format.MARKDOWN,
}
"""What the suffix of a file says; the first of a form is the one that is written."""


def suffix_of(format: Format) -> str:
    """The suffix of a form's files."""
    return next(suffix for suffix, named in SUFFIXES.items() if named is format)
