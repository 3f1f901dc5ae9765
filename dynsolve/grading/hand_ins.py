"""From files to hand-ins: a student, a problem, and the files that count.

The platform's student wins over the one in the file.  The problem comes from the
file's front matter, then its name, then its heading.  What no program can judge, and
what names no problem, waits for a human with its reason.
"""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import PurePosixPath

from dynsolve.answers.reading.answer_file import parsed
from dynsolve.answers.reading.documents import EXTRA, FORMATS, as_report, pandoc
from dynsolve.answers.reading.files import ENDINGS
from dynsolve.answers.reading.sources import decoded
from dynsolve.errors import InputError, ReadError
from dynsolve.grading.extensions import days_late
from dynsolve.grading.platforms.gradescope import METADATA, Submitters, exports, read_metadata
from dynsolve.grading.platforms.members import Groups
from dynsolve.grading.platforms.owner import FileOwner
from dynsolve.grading.platforms.owners import FileOwners
from dynsolve.grading.problem_set import ProblemSet
from dynsolve.grading.record import Waiting
from dynsolve.grading.sections import Span, parts, titles
from dynsolve.grading.uploads import Upload, Uploads, digest, printable

_HEAD = 20_000
_IN_PARTS = (".md", ".markdown", ".tex", ".txt", ".html", ".htm", *FORMATS)
_ANSWER_FILES = (".yaml", ".yml", ".json")
_FIELD = r"(?m)^[ \t]{{0,3}}[\"']?{}[\"']?[ \t]{{0,9}}:[ \t]{{0,99}}(\S.{{0,300}}?)[ \t]*(?:#.*)?$"
_STUDENT, _PROBLEM = (re.compile(_FIELD.format(key)) for key in ("student", "problem"))
_FRONT, _BACK = ("---", "<!--"), ("---", "...", "-->")
"""The lines that front matter stands between."""

_KINDS = {
    ".pdf": "a PDF", ".doc": "a Word file", ".docx": "a Word file", ".odt": "a word processor's file",
    ".rtf": "a word processor's file", ".pages": "a word processor's file",
    ".typ": "a typst file", ".org": "an Org file",
    ".rst": "a reStructuredText file", ".png": "a picture",
    ".jpg": "a picture", ".jpeg": "a picture", ".heic": "a picture", ".gif": "a picture",
    ".webp": "a picture", ".tif": "a picture", ".tiff": "a picture", ".bmp": "a picture",
    ".svg": "a picture", ".zip": "an archive", ".rar": "an archive", ".7z": "an archive",
    ".gz": "an archive", ".tar": "an archive",
    ".url": "an address", ".webloc": "an address",
    ".xlsx": "a spreadsheet", ".pptx": "slides", ".mp4": "a film", ".mov": "a film",
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class File:
    """A file that counts: where it lies, the name it was handed in under, and what identifies it.

    `others` are the parts of its text that are for other problems.
    """

    upload: Upload
    name: str
    digest: str
    others: tuple[Span, ...] = ()


@dataclass(frozen=True, slots=True)
class HandIn:
    """What one student handed in for one problem.

    `late` are the days that it is late, `left` the copies that do not count, `group` is the
    group that handed it in.
    """

    student: str
    problem: str
    files: tuple[File, ...]
    late: int = 0
    left: tuple[str, ...] = ()
    group: str = ""

    @property
    def key(self) -> tuple[str, str]:
        """The student and the problem."""
        return self.student, self.problem

    @property
    def whose(self) -> str:
        """Who stands over the page: the group, whose members read the same."""
        return self.group or self.student


@dataclass(frozen=True, slots=True)
class Intake:
    """All that was handed in; `students` are the rows, with the platform's id of each, `groups` theirs."""

    students: dict[str, str]
    hand_ins: tuple[HandIn, ...]
    waiting: tuple[Waiting, ...]
    groups: dict[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class _Piece:
    """A file with its owner and the problem it is for."""

    owner: FileOwner
    student: str
    problem: str
    file: File

    @property
    def copy(self) -> tuple[int, str]:
        """What identifies the delivery that the file came with."""
        return self.owner.late, self.owner.delivery

    @property
    def age(self) -> tuple[int, tuple[int, ...], str]:
        """A sort key that is greatest for the newest file."""
        return self.owner.order, self.file.upload.order, str(self.file.upload.path)


def take_in(
    problems: ProblemSet,
    uploads: Uploads,
    late: Mapping[str, int] | None = None,
    groups: Groups | None = None,
) -> Intake:
    """Sort what was handed in by student and problem; `late` are the days by the platform's ids."""
    paths = [upload.path for upload in uploads.files]
    lists = {root / METADATA for root in (PurePosixPath(*parts) for parts in exports(paths))}
    metadata = _metadata(uploads, lists)
    owners = FileOwners(paths, metadata, late, lambda stem: bool(_folded(stem, problems)), groups)
    students: dict[str, str] = {}
    in_groups: dict[str, str] = {}
    waiting: set[Waiting] = set()
    pieces: dict[tuple[str, str], list[_Piece]] = {}
    for upload in uploads.files:
        if upload.path in lists:
            continue
        for piece in _sorted(problems, uploads, owners, upload):
            student = piece.student
            students[student] = students.get(student) or piece.owner.id
            if piece.owner.group:
                in_groups[student] = piece.owner.group
            if isinstance(piece, _Piece):
                pieces.setdefault((student, piece.problem), []).append(piece)
            else:
                waiting.add(Waiting(student, piece.problem, piece.file, piece.reason))
    for refused in uploads.refused:
        for student, id in _owners_of_refused(owners, PurePosixPath(refused.name)):
            if student:
                students[student] = students.get(student) or id
            waiting.add(Waiting(student, "", refused.name, refused.reason))
    counting = (_counting(student, problem, found) for (student, problem), found in sorted(pieces.items()))
    hand_ins = tuple(_extended(problems, hand_in, students[hand_in.student]) for hand_in in counting)
    return Intake(dict(sorted(students.items())), hand_ins, tuple(sorted(waiting)), in_groups)


def _extended(problems: ProblemSet, hand_in: HandIn, id: str) -> HandIn:
    days = days_late(problems.extensions, hand_in.student, id, hand_in.problem, hand_in.late)
    return replace(hand_in, late=days)


def _metadata(uploads: Uploads, lists: Collection[PurePosixPath]) -> Submitters:
    """Who handed in each submission, by Gradescope's lists; a list that cannot be read is left out."""
    found: Submitters = {}
    for upload in uploads.files:
        if upload.path in lists:
            with suppress(InputError):
                found |= read_metadata(uploads.read(upload))
    return found


def _owners_of_refused(owners: FileOwners, path: PurePosixPath) -> list[tuple[str, str]]:
    """The students that a refused file belongs to, where its name says so without a doubt, with their ids."""
    if (
        not path.parts
        or path.is_absolute()
        or ".." in path.parts
        or "\\" in str(path)
        or ":" in path.parts[0]
    ):
        return [("", "")]
    return [(owner.student, owner.id) for owner in owners.of(path)]


@dataclass(frozen=True, slots=True)
class _Left:
    """A file that waits for a human, with the reason."""

    owner: FileOwner
    student: str
    problem: str
    file: str
    reason: str


def _sorted(
    problems: ProblemSet, uploads: Uploads, owners: FileOwners, upload: Upload
) -> Iterator[_Piece | _Left]:
    """A file for each of its owners."""
    for owner in owners.of(upload.path):
        if PurePosixPath(owner.name).suffix.lower() == ".zip":
            yield from _unzipped(problems, uploads, owner, upload)
        else:
            yield from _one(problems, uploads, owner, upload)


def _unzipped(
    problems: ProblemSet, uploads: Uploads, owner: FileOwner, upload: Upload
) -> Iterator[_Piece | _Left]:
    """The files of a zip that a student handed in; what is refused waits for a human."""
    shown, named = printable(str(upload.path)), _by_name(problems, owner.name)
    try:
        inner, refused = uploads.inside(upload)
    except InputError as error:
        yield _Left(owner, owner.student, named, shown, f"an archive: {error.findings[0].message}")
        return
    for other in refused:
        yield _Left(owner, owner.student, named, f"{shown}/{other.name}", other.reason)
    if not inner and not refused:
        yield _Left(owner, owner.student, named, shown, "an archive without a file in it")
    for one in inner:
        name = str(one.path.relative_to(upload.path))
        if not _within(name, problems):
            name = f"{PurePosixPath(owner.name).stem}/{name}"
        yield from _one(problems, uploads, replace(owner, name=name), one)


def _one(
    problems: ProblemSet, uploads: Uploads, owner: FileOwner, upload: Upload
) -> Iterator[_Piece | _Left]:
    """A file of one owner."""
    shown, named = printable(str(upload.path)), _by_name(problems, owner.name)
    ending = PurePosixPath(owner.name).suffix.lower()
    if ending not in ENDINGS:
        kind = _KINDS.get(ending, f"a file of an unknown kind ({ending or 'without an ending'})")
        yield _Left(owner, owner.student, named, shown, f"{kind}: a human reads it")
        return
    try:
        content = uploads.read(upload)
    except InputError as error:
        yield _Left(owner, owner.student, named, shown, error.findings[0].message)
        return
    text, reason = _beginning(content, ending)
    if reason:
        yield _Left(owner, owner.student, named, shown, f"{_KINDS[ending]}: {reason}")
        return
    student = owner.student if owner.certain else _said_student(text, ending) or owner.student
    problem, reason = _problem(problems, text, owner.name, ending)
    if reason:
        yield _Left(owner, student, problem, shown, reason)
        return
    file = File(upload, owner.name, digest(content))
    told = _parts(problems, content, owner.name, text)
    for stem, others in told.items():
        yield _Piece(owner, student, stem, replace(file, others=others))
    if not told:
        yield _Piece(owner, student, problem, file)
        for other in _also(problems, text, owner.name, ending):
            reason = f"it was read as an answer to {problem}; its headings name {other}, too"
            yield _Left(owner, student, other, shown, reason)


def _beginning(content: bytes, ending: str) -> tuple[str, str]:
    """The text that a file begins with, that of a notebook's first cells; or why a human has to read it."""
    if ending in FORMATS:
        return _document(content, ending)
    text = decoded(content if ending == ".ipynb" else content[:_HEAD])
    if ending == ".ipynb":
        with suppress(ValueError, RecursionError):
            book = json.loads(text)
            cells = book.get("cells", ()) if isinstance(book, dict) else ()
            sources = [cell.get("source") for cell in cells if isinstance(cell, dict)][:20]
            text = "\n\n".join("".join(map(str, s)) if isinstance(s, list) else str(s) for s in sources)
    return text[:_HEAD], ""


def _document(content: bytes, ending: str) -> tuple[str, str]:
    if pandoc() is None:
        return "", f"a human reads it, or dynsolve after `{EXTRA}`"
    try:
        text, _ = as_report(content, ending)
    except ReadError as error:
        return "", f"a human reads it ({error.message})"
    return text[:_HEAD], "" if "=" in text else "no formula stands in it, so a human reads it"


def _front(text: str, ending: str) -> str:
    """Where a file may say whose it is: an answer file's own keys, a report's front matter."""
    if ending in _ANSWER_FILES:
        return text
    first, *lines = text.lstrip().split("\n")
    last = next((i for i, line in enumerate(lines) if line.strip().startswith(_BACK)), None)
    return "\n".join(lines[:last]) if first.strip() in _FRONT and last is not None else ""


def _said(pattern: re.Pattern[str], text: str, ending: str) -> str:
    if ending in _ANSWER_FILES and text.lstrip().startswith("{"):
        file = parsed(text)
        return printable(file.problem if pattern is _PROBLEM else file.student)
    found = pattern.search(_front(text, ending))
    return printable(found[1].strip("\"', ")[:200]) if found else ""


def _said_student(text: str, ending: str) -> str:
    return _said(_STUDENT, text, ending)


def _problem(problems: ProblemSet, text: str, name: str, ending: str) -> tuple[str, str]:
    """The problem that a file is for, or why none can be named."""
    said = _said(_PROBLEM, text, ending)
    if said:
        found = _folded(said, problems)
        if found:
            return found, ""
        return "", f"it says that it is for `{said[:60]}`, which is no problem of this set"
    named = _by_name(problems, name)
    if named:
        return named, ""
    for found in _headed(problems, text):
        return found, ""
    for found in parts(text, lambda title: _within(title, problems), problems.stems):
        return found, ""
    if len(problems.items) == 1:
        return problems.items[0].stem, ""
    return "", "neither its front matter, its name nor its heading says which problem it is for"


def _headed(problems: ProblemSet, text: str) -> Iterator[str]:
    """The problems that headings name."""
    for _, title in titles(text):
        found = _within(title, problems)
        if found:
            yield found


def _parts(problems: ProblemSet, content: bytes, name: str, text: str) -> dict[str, tuple[Span, ...]]:
    """The problems that a report is on, where they are several, each with what is for the others."""
    ending = PurePosixPath(name).suffix.lower()
    if ending not in _IN_PARTS or _said(_PROBLEM, text, ending) or _by_name(problems, name):
        return {}
    return parts(as_text(content, ending), lambda title: _within(title, problems), problems.stems)


def as_text(content: bytes, ending: str) -> str:
    """The text of a report whose parts are told apart; raises ReadError."""
    return as_report(content, ending)[0] if ending in FORMATS else decoded(content)


def _also(problems: ProblemSet, text: str, name: str, ending: str) -> list[str]:
    """The further problems of a file whose problem is that of its first heading."""
    if _said(_PROBLEM, text, ending) or _by_name(problems, name):
        return []
    return list(dict.fromkeys(_headed(problems, text)))[1:]


def _by_name(problems: ProblemSet, name: str) -> str:
    return _within(name, problems) or (problems.items[0].stem if len(problems.items) == 1 else "")


def _fold(text: str) -> str:
    return re.sub(r"[\W_]+", " ", text.casefold()).strip()


def _folded(said: str, problems: ProblemSet) -> str:
    """The problem of exactly this name, however it is spelled."""
    said = PurePosixPath(said).stem if said.endswith((".yaml", ".yml")) else said
    names = {_fold(name): item.stem for item in problems.items for name in (item.problem.title, item.stem)}
    return names.get(_fold(said), "")


def _within(text: str, problems: ProblemSet) -> str:
    """The problem whose name or title occurs in a text, the longest where several do."""
    folded = f" {_fold(text)} "
    names = [(_fold(n), item.stem) for item in problems.items for n in (item.stem, item.problem.title)]
    hits = sorted((name for name in names if f" {name[0]} " in folded), key=lambda n: -len(n[0]))
    return hits[0][1] if hits else ""


def _counting(student: str, problem: str, pieces: Iterable[_Piece]) -> HandIn:
    """Of several copies the newest counts; the files that came with it belong to it."""
    pieces = list(pieces)
    copies: dict[tuple[int, str], list[_Piece]] = {}
    for piece in pieces:
        copies.setdefault(piece.copy, []).append(piece)
    newest = max(copies, key=lambda key: max(piece.age for piece in copies[key]))
    files = sorted(
        copies[newest], key=lambda piece: piece.age if piece.owner.order else (0, (), piece.file.name)
    )
    left = sorted(
        printable(str(piece.file.upload.path)) for key in copies if key != newest for piece in copies[key]
    )
    group = files[0].owner.group
    return HandIn(student, problem, tuple(piece.file for piece in files), newest[0], tuple(left), group)
