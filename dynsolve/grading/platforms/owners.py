"""Whose file it is, from its path, as each learning platform names what it hands out.

A file that no platform has named belongs to the folder that it lies in, or is named for
its student.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from pathlib import PurePosixPath
from unicodedata import normalize

from dynsolve.answers.reading.files import ENDINGS
from dynsolve.grading.platforms import canvas, gradescope, moodle
from dynsolve.grading.platforms.gradescope import Submitters
from dynsolve.grading.platforms.members import Groups
from dynsolve.grading.platforms.owner import FileOwner

_MOST_AROUND = 4


_NAMED_BY: tuple[Callable[[tuple[str, ...]], FileOwner | None], ...] = (moodle.owner, canvas.owner)
"""Moodle first: a name of Moodle's may hold two numbers, as those of Canvas do."""


class FileOwners:
    """Tells whose file each one is; `files` are all that were handed in.

    `metadata` is Gradescope's, `late` are the days that those were late, by the platform's ids,
    as far as it tells them elsewhere than in the names; `is_problem` tells whether a file's
    name is that of a problem; `groups` are those whose members are known.
    """

    def __init__(
        self,
        files: Iterable[PurePosixPath],
        metadata: Submitters | None = None,
        late: Mapping[str, int] | None = None,
        is_problem: Callable[[str], bool] = lambda name: False,
        groups: Groups | None = None,
    ) -> None:
        files = list(files)
        self.depth = _wrapping(files, is_problem)
        self.exports = gradescope.exports(files)
        self.submitters = metadata or {}
        self.late = late or {}
        self.groups = groups or Groups()

    def of(self, path: PurePosixPath) -> tuple[FileOwner, ...]:
        """The owners of a file: one, or the members of a group."""
        return tuple(
            replace(
                owner,
                student=normalize("NFC", owner.student),
                late=max(owner.late, self.late.get(owner.id, 0)),
            )
            for named in self._of(path)
            for owner in self.groups.of(named)
        )

    def _of(self, path: PurePosixPath) -> tuple[FileOwner, ...]:
        for export in self.exports:
            owners = gradescope.owners(export, path, self.submitters)
            if owners:
                return owners
        parts = path.parts[self.depth :] if len(path.parts) > self.depth else path.parts
        for named_by in _NAMED_BY:
            owner = named_by(parts)
            if owner is not None:
                return (owner,)
        if len(parts) > 1:
            return (FileOwner(parts[0], "", parts[0], "/".join(parts[1:])),)
        stem = PurePosixPath(parts[0]).stem
        return (FileOwner(stem, "", stem, parts[0], certain=False),)


def _wrapping(files: list[PurePosixPath], is_problem: Callable[[str], bool]) -> int:
    """How many folders stand around everything: 1 where a download lies in a folder of its own.

    Files beside it that are no answers, such as a roster, do not matter.
    """
    level = [path.parts for path in files]
    for depth in range(_MOST_AROUND):
        if any(map(_is_of_platform, level)):
            return depth
        beside = any(len(parts) == 1 and _is_answer(parts[0]) for parts in level)
        if beside or len({parts[0] for parts in level if len(parts) > 1}) != 1:
            break
        level = [parts[1:] for parts in level if len(parts) > 1]
    return int(_is_around_students([path.parts for path in files], is_problem))


def _is_of_platform(parts: tuple[str, ...]) -> bool:
    return any(named_by(parts) is not None for named_by in _NAMED_BY)


def _is_answer(name: str) -> bool:
    return PurePosixPath(name).suffix.lower() in ENDINGS


def _is_around_students(files: list[tuple[str, ...]], is_problem: Callable[[str], bool]) -> bool:
    """Whether the one folder that there is holds a folder a student, or a file a student."""
    if any(len(parts) < 2 for parts in files) or len({parts[0] for parts in files}) != 1:
        return False
    loose = [parts[1] for parts in files if len(parts) == 2]
    if not loose:
        return len({parts[1] for parts in files}) > 1
    of_one = any(is_problem(PurePosixPath(name).stem) for name in loose)
    return sum(map(_is_answer, loose)) > 1 and len(loose) == len(files) and not of_one
