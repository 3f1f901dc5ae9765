"""The files that were handed in, out of a folder or a zip, and those that are refused.

A name that leads out of the folder, a link, a name that cannot be seen, a file that
unpacks to far more than it is: each is refused by name, and the rest is taken.
Nothing is unpacked to disk.
"""

from __future__ import annotations

import hashlib
import io
import os
import re
import stat
import zipfile
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import reduce
from operator import or_
from pathlib import Path, PurePosixPath
from typing import IO

from dynsolve.errors import Finding, InputError

MAX_FILE = 2_000_000
"""A larger file is not read: what is handed in takes a few pages."""

MAX_FILES = 200_000
MAX_TOTAL = 4_000_000_000
"""So much may a whole zip unpack to."""

MAX_INSIDE = 100
MAX_INSIDE_TOTAL = 20_000_000
"""So many files, and so many bytes of them, a zip may hold that a student handed in."""

MAX_RATIO = 200
"""What is packed tighter than this, and is no trifle, is a bomb."""

_TRIFLE = 100_000
_UNSEEN = re.compile("[\x00-\x1f\x7f-\x9f\u200b-\u200f\u2028-\u202e\u2066-\u2069\ufeff\ud800-\udfff]")
_LEFT_ALONE = re.compile(
    r"(^|/)((\.DS_Store|Thumbs\.db|desktop\.ini|\._[^/]*|~\$[^/]*|\.~lock\.[^/]*)$"
    r"|(__MACOSX|\.ipynb_checkpoints|__pycache__|\.git)/)"
)
"""What systems and editors leave behind."""

_WHOSE = re.compile(r"([^/]+/)?submission_metadata\.yml")
_MAX_WHOSE = 30_000_000
"""Gradescope's list of whose the submissions are holds the output of its programs, too."""


@dataclass(frozen=True, slots=True)
class Upload:
    """A file by its path within what was handed in; `order` grows with its date.

    `within` is the zip that was handed in with the file in it.
    """

    path: PurePosixPath
    order: tuple[int, ...]
    size: int
    within: Upload | None = None


@dataclass(frozen=True, slots=True)
class Refused:
    """A file that is not taken: its name as it may be shown, and why."""

    name: str
    reason: str


def printable(name: str) -> str:
    r"""A name with invisible characters written as escapes.

    >>> printable("a\nb")
    'a\\x0ab'
    """
    return _UNSEEN.sub(lambda m: f"\\x{ord(m[0]):02x}" if ord(m[0]) < 256 else f"\\u{ord(m[0]):04x}", name)


def digest(content: bytes) -> str:
    """What identifies a content."""
    return hashlib.sha256(content).hexdigest()


class Uploads:
    """What was handed in: `files` that may be read, and `refused` ones; nothing that lies in `besides`.

    Raises InputError where there is neither a folder nor a zip.
    """

    def __init__(self, path: Path, besides: Path | None = None) -> None:
        self.path = path
        self.refused: list[Refused] = []
        self._besides = besides
        self._zip: zipfile.ZipFile | None = None
        self._members: dict[PurePosixPath, zipfile.ZipInfo] = {}
        try:
            if path.is_dir():
                self.files = tuple(sorted(self._walk(), key=lambda upload: upload.path))
                return
            self._zip = zipfile.ZipFile(path)
            self.files = tuple(sorted(self._list(self._zip), key=lambda upload: upload.path))
        except zipfile.BadZipFile:
            message, help = "this is neither a folder nor a zip", "give the download of the learning platform"
        except OSError as error:
            message, help = f"it cannot be read: {(error.strerror or str(error)).lower()}", "check the path"
        else:
            return
        raise InputError([Finding(message, help, str(path))])

    def close(self) -> None:
        """Close the zip, where it is one."""
        if self._zip is not None:
            self._zip.close()

    def read(self, upload: Upload) -> bytes:
        """The bytes of a file.

        Raises InputError where it cannot be read, or is no more what it was when it was listed.
        """
        most = _most(str(upload.path))
        try:
            with self._opened(upload) as stream:
                content: bytes = stream.read(most + 1)
        except (
            OSError,
            zipfile.BadZipFile,
            NotImplementedError,
            RuntimeError,
            EOFError,
            ValueError,
        ) as error:
            reason = getattr(error, "strerror", None) or str(error) or type(error).__name__
            raise InputError([Finding(f"cannot be read: {reason.lower()}", "", str(upload.path))]) from None
        except Exception as error:  # zlib.error, lzma.LZMAError: a damaged member
            if type(error).__module__ not in ("zlib", "lzma", "_lzma", "bz2"):
                raise
            raise InputError([Finding("cannot be read: it is damaged", "", str(upload.path))]) from None
        if len(content) > most:
            raise InputError([Finding(_of_size(str(upload.path), len(content)), "", str(upload.path))])
        return content

    def inside(self, archive: Upload) -> tuple[list[Upload], list[Refused]]:
        """The files of a zip that was handed in, and those that are refused; it is held in memory.

        Raises InputError where it cannot be read.
        """
        taken: list[Upload] = []
        refused: list[Refused] = []
        content = self.read(archive)
        try:
            members = zipfile.ZipFile(io.BytesIO(content)).infolist()
        except (zipfile.BadZipFile, NotImplementedError, ValueError) as error:
            reason = "it is damaged, or no zip"
            raise InputError([Finding(reason, "", str(archive.path))]) from error
        total = 0
        for member in members:
            name = _name(member)
            if name.endswith("/") or _LEFT_ALONE.search(name):
                continue
            total += member.file_size
            reason = self._of_member(member, name)
            if len(taken) >= MAX_INSIDE or total > MAX_INSIDE_TOTAL:
                reason = "the zip holds too much"
            path = archive.path / name if not reason else archive.path
            if reason:
                refused.append(Refused(printable(name), reason))
            else:
                taken.append(Upload(path, (*member.date_time,), member.file_size, archive))
        return taken, refused

    def _opened(self, upload: Upload) -> IO[bytes]:
        if upload.within is not None:
            archive = zipfile.ZipFile(io.BytesIO(self.read(upload.within)))
            name = upload.path.relative_to(upload.within.path)
            return archive.open(next(m for m in archive.infolist() if PurePosixPath(_name(m)) == name))
        if self._zip is not None:
            return self._zip.open(self._members[upload.path])
        flags = (getattr(os, name, 0) for name in ("O_NOFOLLOW", "O_NONBLOCK", "O_BINARY"))
        number = os.open(self.path / upload.path, reduce(or_, flags, os.O_RDONLY))
        if not stat.S_ISREG(os.fstat(number).st_mode):  # by now it is a pipe, say
            os.close(number)
            raise OSError("it is no ordinary file")
        return os.fdopen(number, "rb")

    def _refuse(self, name: str, reason: str) -> None:
        self.refused.append(Refused(printable(name), reason))

    # -- a folder ----------------------------------------------------------------------------------

    def _walk(self) -> Iterator[Upload]:
        besides = self._besides.resolve() if self._besides is not None else None
        count = 0
        for folder, folders, files in os.walk(self.path, onerror=self._unread, followlinks=False):
            here = Path(folder)
            folders[:] = [name for name in folders if self._is_entered(here / name, besides)]
            for name in files:
                relative = (here / name).relative_to(self.path).as_posix()
                if _LEFT_ALONE.search(relative):
                    continue
                count += 1
                if count > MAX_FILES:
                    self._refuse(relative, f"the folder has more than {MAX_FILES} files")
                    return
                upload = self._taken(here / name, relative)
                if upload is not None:
                    yield upload

    def _is_entered(self, folder: Path, besides: Path | None) -> bool:
        relative = folder.relative_to(self.path).as_posix()
        reason = "a link" if folder.is_symlink() else _HIDDEN if _UNSEEN.search(folder.name) else ""
        if reason:
            self._refuse(relative, reason)
        return not reason and (besides is None or folder.resolve() != besides)

    def _taken(self, path: Path, relative: str) -> Upload | None:
        try:
            found = path.lstat()
        except OSError as error:  # it was there a moment ago
            self._unread(error)
            return None
        reason = _of_mode(found.st_mode) or _of_name(relative) or _of_size(relative, found.st_size)
        if reason:
            self._refuse(relative, reason)
            return None
        return Upload(PurePosixPath(relative), (found.st_mtime_ns,), found.st_size)

    def _unread(self, error: OSError) -> None:
        """A folder or file that cannot be looked at; raises where it is all that there is."""
        path = Path(os.fsdecode(error.filename))
        if path == self.path:
            raise error
        self._refuse(
            path.relative_to(self.path).as_posix(), f"cannot be read: {(error.strerror or '').lower()}"
        )

    # -- a zip -------------------------------------------------------------------------------------

    def _list(self, archive: zipfile.ZipFile) -> Iterator[Upload]:
        found: dict[PurePosixPath, Upload] = {}
        total = 0
        for place, member in enumerate(archive.infolist()):
            name = _name(member)
            if name.endswith("/") or _LEFT_ALONE.search(name):
                continue
            total += min(member.file_size, MAX_FILE)
            reason = self._of_member(member, name) or ("the zip holds too much" if total > MAX_TOTAL else "")
            if place >= MAX_FILES:
                self._refuse(name, f"the zip has more than {MAX_FILES} files")
                break
            if reason:
                self._refuse(name, reason)
                continue
            path = PurePosixPath(name)
            if path in found:
                self._refuse(name, "the zip holds this name twice; the later one counts")
            self._members[path] = member
            found[path] = Upload(path, (*member.date_time,), member.file_size)
        yield from found.values()

    def _of_member(self, member: zipfile.ZipInfo, name: str) -> str:
        mode = member.external_attr >> 16
        if member.flag_bits & 1:
            return "it is locked with a password"
        if member.file_size > _TRIFLE and member.file_size > MAX_RATIO * max(member.compress_size, 1):
            return "it unpacks to far more than it is (a zip bomb)"
        return (
            (_of_mode(mode) if stat.S_IFMT(mode) else "")
            or _of_name(getattr(member, "orig_filename", name))
            or _of_name(name)
            or _of_size(name, member.file_size)
        )


_UTF_8 = 0x800
"""The bit of a zip's member that tells that its name is UTF-8."""


def _name(member: zipfile.ZipInfo) -> str:
    """The name of a member: macOS does not say that it is UTF-8, some programs write backslashes."""
    name = member.filename
    if not member.flag_bits & _UTF_8:
        with suppress(UnicodeError):
            name = name.encode("cp437").decode("utf-8")
    return name.replace("\\", "/")


_HIDDEN = "its name holds characters that cannot be seen"


def _of_mode(mode: int) -> str:
    """Why a file of this kind is refused, or nothing."""
    if stat.S_ISLNK(mode):
        return "a link"
    return "" if stat.S_ISREG(mode) else "no ordinary file"


def _of_name(name: str) -> str:
    """Why a name is refused, or nothing.

    >>> _of_name("../x"), _of_name("/etc/x"), _of_name("a/b.yaml")
    ('its name leads out of the folder', 'its name leads out of the folder', '')
    """
    if _UNSEEN.search(name):
        return _HIDDEN
    parts = name.replace("\\", "/").split("/")
    if not PurePosixPath(name).parts:
        return "it has no name"
    if ".." in parts or name.startswith(("/", "\\")) or re.match(r"[A-Za-z]:", name):
        return "its name leads out of the folder"
    if len(name) > 1000 or len(parts) > 30:
        return "its name is too long"
    return ""


def _of_size(name: str, size: int) -> str:
    return f"it is larger than {_most(name) // 1_000_000} MB" if size > _most(name) else ""


def _most(name: str) -> int:
    """How many bytes a file may have."""
    return _MAX_WHOSE if _WHOSE.fullmatch(name) else MAX_FILE
