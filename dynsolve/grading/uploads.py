"""The files that were handed in, out of a folder or a zip, and those that are refused.

A name that leads out of the folder, a link, a name that cannot be seen, a file that
unpacks to far more than it is: each is refused by name, and the rest is taken.
Nothing is unpacked to disk.

Copies of what was handed in, in OUT, where the teacher's page links to them.

A download may be a zip, which no page can link into.  What a browser would run, or not show, is
a text there: nothing that a student wrote runs when the teacher opens it.

Extensions: who was given more days, in `extensions.csv` beside the `set.yaml`.

    student,days,problem
    lovelaceada_101,3,
    102,7,planar-2r

A student is named as in `grades.csv`, or by the platform's number, or by the name before it;
without a problem the days hold for all of them.

The lists that a teacher lays beside the `set.yaml`: CSV with the names of its columns first.
"""

from __future__ import annotations

import csv
import hashlib
import io
import os
import re
import stat
import zipfile
from collections.abc import Callable, Collection, Iterable, Iterator
from contextlib import suppress
from functools import reduce
from hashlib import sha256
from operator import or_
from pathlib import Path, PurePosixPath
from typing import IO, TypeVar

from msgspec import Struct

from dynsolve.errors import Finding, InputError, ProblemError
from dynsolve.problem.kinds import did_you_mean
from dynsolve.render.files import write_changed

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


class Upload(Struct, frozen=True):
    """A file by its path within what was handed in; `order` grows with its date.

    `within` is the zip that was handed in with the file in it.
    """

    path: PurePosixPath
    order: tuple[int, ...]
    size: int
    within: Upload | None = None


class Refused(Struct, frozen=True):
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
        self._members: dict[PurePosixPath, zipfile.ZipInfo] = {}
        try:
            self._zip = None if path.is_dir() else zipfile.ZipFile(path)
            found = self._walk() if self._zip is None else self._list(self._zip)
            self.files = tuple(sorted(found, key=lambda upload: upload.path))
        except zipfile.BadZipFile:
            message, help = "this is neither a folder nor a zip", "give the download of the learning platform"
            raise InputError([Finding(message, help, str(path))]) from None
        except OSError as error:
            message = f"it cannot be read: {(error.strerror or str(error)).lower()}"
            raise InputError([Finding(message, "check the path", str(path))]) from None

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
            if reason:
                refused.append(Refused(printable(name), reason))
            else:
                path = archive.path / name
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
        reason = f"cannot be read: {(error.strerror or '').lower()}"
        self._refuse(path.relative_to(self.path).as_posix(), reason)

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


# Copies of what was handed in, in OUT, where the teacher's page links to them

FOLDER = "hand-ins"

PICTURES = (".png", ".jpg", ".jpeg", ".gif", ".webp", ".bmp")
_SHOWN = (".pdf", *PICTURES)
_SAVED = (
    ".docx", ".doc", ".odt", ".rtf", ".pages", ".xlsx", ".pptx", ".zip", ".rar", ".7z", ".gz", ".tar",
    ".heic", ".tif", ".tiff", ".mp4", ".mov",
)  # fmt: skip
"""What a browser hands on to another program."""


def copy_name(path: str) -> str:
    """The name of the copy of a file, from its path within what was handed in.

    >>> copy_name("ada/rp.yaml"), copy_name("ada/Scan 1.pdf")
    ('ccd1e0b72fa6-rp.yaml.txt', '14d91d99e36b-Scan 1.pdf')
    """
    name = PurePosixPath(path).name
    plain = re.sub(r"[^\w .@+-]", "_", name)[-80:]
    text = "" if PurePosixPath(name).suffix.lower() in (*_SHOWN, *_SAVED) else ".txt"
    return f"{sha256(path.encode('utf-8', errors='replace')).hexdigest()[:12]}-{plain}{text}"


def write_copies(folder: Path, uploads: Uploads, files: Iterable[Upload]) -> None:
    """Write the copies of these files, and remove those of files that are there no more."""
    written: set[Path] = set()
    for upload in files:
        path = folder / FOLDER / copy_name(printable(str(upload.path)))
        try:
            content = uploads.read(upload)
        except InputError:
            continue  # it was there a moment ago, or is told as what cannot be read
        written.add(path)
        write_changed(path, content, durable=False)
    for path in (folder / FOLDER).glob("*"):
        if path not in written and path.is_file():
            path.unlink()


# The lists that a teacher lays beside the `set.yaml`

Fault = tuple[str, str]
"""What is wrong with a row, and what to do."""

Entry = TypeVar("Entry")


def read_list(
    path: Path,
    columns: tuple[str, ...],
    needed: Collection[str],
    read: Callable[[dict[str, str]], Entry | Fault],
) -> tuple[Entry, ...]:
    """What `read` makes of each row of a file, nothing where there is no such file.

    Raises ProblemError with every faulty row.
    """
    if not path.is_file():
        return ()
    found: list[Entry] = []
    findings: list[Finding] = []
    text = path.read_text(encoding="utf-8-sig", errors="replace")
    for line, cells in rows_of(text, path, columns, needed, ProblemError):
        entry = read(cells)
        if isinstance(entry, tuple):
            findings.append(Finding(entry[0], entry[1], str(path), line, 1))
        else:
            found.append(entry)
    if findings:
        raise ProblemError(findings)
    return tuple(found)


def rows_of(
    text: str,
    path: Path,
    columns: tuple[str, ...],
    needed: Collection[str],
    raised: type[ProblemError | InputError],
    others: bool = False,
) -> Iterator[tuple[int, dict[str, str]]]:
    """Each row of a CSV with its line, its cells by their columns; with `others` there may be further ones.

    The separator is a comma, a semicolon or a tab.  Raises what is to be `raised` where columns are wrong.
    """
    first = text.partition("\n")[0]
    rows = csv.DictReader(io.StringIO(text, newline=""), delimiter=max(",;\t", key=first.count))
    header = [name.strip().casefold() for name in rows.fieldnames or ()]
    if not set(needed) <= set(header) or not (others or set(header) <= set(columns)):
        message = f"the first line is `{first[:60].strip()}`, not the names of the columns"
        raise raised([Finding(message, f"write {','.join(columns)}", str(path), 1, 1)])
    rows.fieldnames = header
    for row in rows:
        yield rows.line_num, {key: (row.get(key) or "").strip() for key in columns}


# Extensions: who was given more days, in `extensions.csv` beside the `set.yaml`

FILE = "extensions.csv"
_KEYS = ("student", "days", "problem")


class Extension(Struct, frozen=True):
    """So many days more for a student, for one problem or (an empty name) for all."""

    student: str
    days: int
    problem: str = ""

    def is_for(self, student: str, id: str) -> bool:
        """Whether it is this student's.

        >>> [Extension(name, 1).is_for("Ada L_7", "7") for name in ("Ada L_7", "7", "Ada L", "Ada")]
        [True, True, True, False]
        """
        return self.student in (student, id, student.removesuffix(f"_{id}") if id else student)


def read_extensions(folder: Path, stems: Collection[str]) -> tuple[Extension, ...]:
    """The extensions of a folder, none where it has no such file; raises ProblemError for a faulty one."""

    def read(cells: dict[str, str]) -> Extension | Fault:
        fault = _fault(cells, stems)
        return fault or Extension(cells["student"], int(cells["days"]), cells["problem"])

    return read_list(folder / FILE, _KEYS, ("student", "days"), read)


def _fault(cells: dict[str, str], stems: Collection[str]) -> Fault | None:
    if not cells["student"]:
        return "no student is named", "write the name as in grades.csv"
    if not (cells["days"].isascii() and cells["days"].isdigit() and len(cells["days"]) < 5):
        return f"`{cells['days'][:40]}` is no number of days", "write 1, 2, 3, ..."
    if cells["problem"] and cells["problem"] not in stems:
        help = did_you_mean(cells["problem"], stems) or f"the problems are {', '.join(stems)}"
        return f"there is no problem `{cells['problem'][:40]}`", help
    return None


def days_late(extensions: Iterable[Extension], student: str, id: str, problem: str, days: int) -> int:
    """How many days late a hand-in is that is so many days after the date for all."""
    given = [e.days for e in extensions if e.problem in ("", problem) and e.is_for(student, id)]
    return max(0, days - max(given, default=0))
