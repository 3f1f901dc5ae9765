"""From files to hand-ins: a student, a problem, and the files that count.

The platform's student wins over the one in the file.  The problem comes from the
file's front matter, then its name, then its heading.  What no program can judge, and
what names no problem, waits for a human with its reason.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from contextlib import suppress
from pathlib import PurePosixPath

from msgspec import Struct, field
from msgspec.structs import replace

from dynsolve.answers.reading.files import ENDINGS
from dynsolve.errors import InputError
from dynsolve.grading.platforms.gradescope import METADATA, FileOwner, Submitters, exports, read_metadata
from dynsolve.grading.platforms.registry import FileOwners, Groups
from dynsolve.grading.record import Waiting
from dynsolve.grading.set_file import ProblemSet
from dynsolve.grading.uploads import Upload, Uploads, days_late, digest, printable
from dynsolve.grading.which_problem import (
    Span,
    also_named,
    beginning,
    by_name,
    folded,
    parts_of,
    problem_of,
    said_student,
    within,
)

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


class File(Struct, frozen=True):
    """A file that counts: where it lies, the name it was handed in under, and what identifies it.

    `others` are the parts of its text that are for other problems.
    """

    upload: Upload
    name: str
    digest: str
    others: tuple[Span, ...] = ()


class HandIn(Struct, frozen=True):
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
    def paths(self) -> tuple[str, ...]:
        """Where its files lie in what was handed in, as it may be shown."""
        return tuple(printable(str(file.upload.path)) for file in self.files)


class Intake(Struct, frozen=True):
    """All that was handed in.

    `students` are the rows, with the platform's id of each, `groups` those of the students whose group
    handed in, `files` all that can be opened, those that wait for a human too; `names` are what people
    call the students, where the names of the files say it; `late` are the days that what waits is late.
    """

    students: dict[str, str]
    hand_ins: tuple[HandIn, ...]
    waiting: tuple[Waiting, ...]
    groups: dict[str, str] = field(default_factory=dict)
    files: tuple[Upload, ...] = ()
    names: dict[str, str] = field(default_factory=dict)
    late: dict[tuple[str, str], int] = field(default_factory=dict)


class _Piece(Struct, frozen=True):
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
    owners = FileOwners(paths, metadata, late, lambda stem: bool(folded(stem, problems)), groups)
    students: dict[str, str] = {}
    in_groups: dict[str, str] = {}
    names: dict[str, str] = {}
    delays: dict[tuple[str, str], int] = {}
    files: dict[Upload, None] = {}
    waiting: set[Waiting] = set()
    pieces: dict[tuple[str, str], list[_Piece]] = {}
    for upload in uploads.files:
        if upload.path in lists:
            continue
        for piece in _sorted(problems, uploads, owners, upload):
            student = piece.student
            students[student] = students.get(student) or piece.owner.id
            if piece.owner.called:
                names[student] = piece.owner.called
            if piece.owner.group:
                in_groups[student] = piece.owner.group
            upload_of = piece.file.upload if isinstance(piece, _Piece) else piece.upload
            if upload_of is not None:
                files[upload_of] = None
            if isinstance(piece, _Piece):
                pieces.setdefault((student, piece.problem), []).append(piece)
            else:
                waiting.add(Waiting(student, piece.problem, piece.file, piece.reason))
                for stem in (piece.problem,) if piece.problem else problems.stems:
                    days = days_late(problems.extensions, student, students[student], stem, piece.owner.late)
                    delays[student, stem] = max(days, delays.get((student, stem), 0))
    for refused in uploads.refused:
        for student, id in _owners_of_refused(owners, PurePosixPath(refused.name)):
            if student:
                students[student] = students.get(student) or id
            waiting.add(Waiting(student, "", refused.name, refused.reason))
    hand_ins = []
    for (student, problem), found in sorted(pieces.items()):
        hand_in = _counting(student, problem, found)
        days = days_late(problems.extensions, student, students[student], problem, hand_in.late)
        hand_ins.append(replace(hand_in, late=days))
    rows = dict(sorted(students.items()))
    return Intake(rows, tuple(hand_ins), tuple(sorted(waiting)), in_groups, tuple(files), names, delays)


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


class _Left(Struct, frozen=True):
    """A file that waits for a human, with the reason."""

    owner: FileOwner
    student: str
    problem: str
    file: str
    reason: str
    upload: Upload | None = None


def _sorted(
    problems: ProblemSet, uploads: Uploads, owners: FileOwners, upload: Upload
) -> Iterator[_Piece | _Left]:
    for owner in owners.of(upload.path):
        if PurePosixPath(owner.name).suffix.lower() == ".zip":
            yield from _unzipped(problems, uploads, owner, upload)
        else:
            yield from _one(problems, uploads, owner, upload)


def _unzipped(
    problems: ProblemSet, uploads: Uploads, owner: FileOwner, upload: Upload
) -> Iterator[_Piece | _Left]:
    """The files of a zip that a student handed in; what is refused waits for a human."""
    shown, named = printable(str(upload.path)), by_name(problems, owner.name)
    try:
        inner, refused = uploads.inside(upload)
    except InputError as error:
        yield _Left(owner, owner.student, named, shown, f"an archive: {error.findings[0].message}", upload)
        return
    for other in refused:
        yield _Left(owner, owner.student, named, f"{shown}/{other.name}", other.reason)
    if not inner and not refused:
        yield _Left(owner, owner.student, named, shown, "an archive without a file in it", upload)
    for one in inner:
        name = str(one.path.relative_to(upload.path))
        if not within(name, problems):
            name = f"{PurePosixPath(owner.name).stem}/{name}"
        yield from _one(problems, uploads, replace(owner, name=name), one)


def _one(
    problems: ProblemSet, uploads: Uploads, owner: FileOwner, upload: Upload
) -> Iterator[_Piece | _Left]:
    shown, named = printable(str(upload.path)), by_name(problems, owner.name)
    ending = PurePosixPath(owner.name).suffix.lower()
    if ending not in ENDINGS:
        kind = _KINDS.get(ending, f"a file of an unknown kind ({ending or 'without an ending'})")
        yield _Left(owner, owner.student, named, shown, f"{kind}: a human reads it", upload)
        return
    try:
        content = uploads.read(upload)
    except InputError as error:
        yield _Left(owner, owner.student, named, shown, error.findings[0].message)
        return
    text, reason = beginning(content, ending)
    if reason:
        yield _Left(owner, owner.student, named, shown, f"{_KINDS[ending]}: {reason}", upload)
        return
    student = owner.student if owner.certain else said_student(text, ending) or owner.student
    problem, reason = problem_of(problems, text, owner.name, ending)
    if reason:
        yield _Left(owner, student, problem, shown, reason, upload)
        return
    file = File(upload, owner.name, digest(content))
    told = parts_of(problems, content, owner.name, text)
    for stem, others in told.items():
        yield _Piece(owner, student, stem, replace(file, others=others))
    if not told:
        yield _Piece(owner, student, problem, file)
        for other in also_named(problems, text, owner.name, ending):
            reason = f"it was read as an answer to {problem}; its headings name {other}, too"
            yield _Left(owner, student, other, shown, reason, upload)


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
