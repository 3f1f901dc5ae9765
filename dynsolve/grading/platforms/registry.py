"""The platforms whose files are written, and for which of them a record is.

Who the members of a group are, and so whose its files: the platform's list and `groups.csv` say so.
Whose file it is, from its path, as each platform names what it hands out; a file that none has named
belongs to the folder that it lies in, or is named for its student.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path, PurePosixPath
from unicodedata import normalize

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.answers.reading.files import ENDINGS
from dynsolve.errors import UsageError
from dynsolve.grading.platforms import canvas, gradescope, moodle
from dynsolve.grading.platforms.gradescope import FileOwner, Person, Submitters
from dynsolve.grading.platforms.roster import Roster, from_text, read_roster, to_text
from dynsolve.grading.record import Record
from dynsolve.grading.set_file import Membership, ProblemSet


class Platform(Struct, frozen=True):
    """How a platform's files are written; `check` raises for a faulty roster before anything is graded.

    A platform without a check needs no roster.  `late` tells the days that the
    platform's ids were late, None where the roster does not say; Canvas says it in the names of files.
    `people` are the students of the roster.
    """

    write: Callable[[Path, ProblemSet, Record, Roster], Iterator[str]]
    check: Callable[[ProblemSet, Roster], object] | None = None
    late: Callable[[Roster], dict[str, int] | None] = lambda roster: None
    people: Callable[[Roster], Iterator[Person]] = lambda roster: iter(())


PLATFORMS = {
    "canvas": Platform(canvas.write, canvas.check, people=canvas.people),
    "moodle": Platform(moodle.write, moodle.check, moodle.late, moodle.people),
    "gradescope": Platform(gradescope.write, late=gradescope.late, people=gradescope.people),
}

_PLATFORM, _ROSTER, _NAMES = "platform", "roster", "names"


def chosen_roster(problems: ProblemSet, platform: str, path: Path | None) -> Roster:
    """The roster of a platform, an empty one where it needs none.

    Raises UsageError where the platform is not known or its roster is needed, InputError
    where that is not what the platform exports.
    """
    known = PLATFORMS.get(platform)
    if known is None:
        raise UsageError(f"`{platform}` is no platform that is known: {', '.join(PLATFORMS)}")
    if path is None and known.check is None:
        return Roster("", ())
    if path is None:
        raise UsageError(f"--lms {platform} needs --roster, the CSV that {platform.capitalize()} exports")
    roster = read_roster(path)
    if known.check is not None:
        known.check(problems, roster)
    return roster


def keep_platform(record: Record, platform: str, roster: Roster) -> None:
    """Keep in the record for which platform files are written: an override, too, writes them anew."""
    record.set_run(_PLATFORM, platform)
    record.set_run(_ROSTER, to_text(roster))


def late(record: Record) -> dict[str, int] | None:
    """How many days late who was, by the roster that is kept; None where nothing says so."""
    platform = record.run(_PLATFORM)
    return PLATFORMS[platform].late(from_text(record.run(_ROSTER))) if platform else None


def people(record: Record) -> tuple[Person, ...]:
    """The students of the roster that is kept, none where there is none."""
    platform = record.run(_PLATFORM)
    return tuple(PLATFORMS[platform].people(from_text(record.run(_ROSTER)))) if platform else ()


def keep_names(record: Record, names: Mapping[str, str]) -> None:
    """Keep what students are called where the names of their files say it."""
    record.set_run(_NAMES, json.dumps(names, ensure_ascii=False))


def names(record: Record) -> dict[str, str]:
    """What students are called, as far as it is known: by the roster, else by the names of their files."""
    called = json.loads(record.run(_NAMES) or "{}")
    listed = people(record)
    called |= {person.student: person.name for person in listed if person.name}
    of_id = {person.id: person.name for person in listed if person.id}
    found = {s: of_id.get(id) or called.get(s, "") for s, id in record.students().items()}
    return {student: name for student, name in found.items() if name}


def export(folder: Path, problems: ProblemSet, record: Record) -> tuple[str, ...]:
    """Write the files of the platform that is kept, if one is; returns warnings."""
    platform = record.run(_PLATFORM)
    if not platform:
        return ()
    roster = from_text(record.run(_ROSTER))
    return tuple(PLATFORMS[platform].write(folder, problems, record, roster))


# Who the members of a group are, and so whose its files

_REMOVED = re.compile(r"""[\x00-\x1f\x7f&<>"`|':\\/]|\.\.+""")
"""What Moodle takes out of the names of files (`clean_filename`)."""

_NUMBER = re.compile(r"(?:.*_)?(\d+)", re.DOTALL)


class Groups:
    """Whose a group's files are: its members' as `listed`, else as the platform says of its `people`.

    Of groups that are not known they are the group's own.
    """

    def __init__(self, listed: Iterable[Membership] = (), people: Iterable[Person] = ()) -> None:
        people = tuple(people)
        self._by_id = {person.id: person for person in people if person.id}
        self._platform_has_groups = any(person.group for person in people)
        members: dict[str, dict[str, Person]] = {}
        for person in people:
            if person.group:
                members.setdefault(person.group, {})[person.student] = person
        said: dict[str, dict[str, Person]] = {}
        for one in listed:
            person = _person(one.student, people)
            said.setdefault(one.group, {})[person.student] = person
        self._members = _by_spelling({**members, **said})

    def of(self, owner: FileOwner) -> tuple[FileOwner, ...]:
        """The members of the group that a file is of, else its owner.

        >>> groups = Groups([Membership("Group A", "41"), Membership("Group A", "42")])
        >>> [member.student for member in groups.of(FileOwner("Group A_77", "77", "", "hw.md"))]
        ['41', '42']
        """
        called = owner.student.removesuffix(f"_{owner.id}") if owner.id else owner.student
        spelled = (spell(name) for spell in (_in_moodle, _in_canvas) for name in (owner.student, called))
        members = next((self._members[name] for name in spelled if name in self._members), ())
        if members:
            return tuple(
                replace(
                    owner,
                    student=member.student,
                    id=member.id,
                    group=owner.student,
                    certain=True,
                    called=member.name,
                )
                for member in members
            )
        return (replace(owner, id="") if self._is_unknown_group(owner) else owner,)

    def _is_unknown_group(self, owner: FileOwner) -> bool:
        """Whether the number is that of a group that nothing is known of, and no student's."""
        if not (self._platform_has_groups and owner.id):
            return False
        person = self._by_id.get(owner.id)
        return person is None or _in_moodle(person.name) not in _in_moodle(owner.student)


def _person(said: str, people: tuple[Person, ...]) -> Person:
    """The one student who is called so; else somebody of this name, with the number that it ends in."""
    found = [person for person in people if person.is_called(said)]
    if len(found) == 1:
        return found[0]
    number = _NUMBER.fullmatch(said)
    return Person(said, number[1] if number else "", said)


def _by_spelling(groups: Mapping[str, Mapping[str, Person]]) -> dict[str, tuple[Person, ...]]:
    """The members by each way that a platform writes a group's name; not where that is another's, too."""
    spelled: dict[str, set[str]] = {}
    for name in groups:
        for spelling in {_in_moodle(name), _in_canvas(name)}:
            spelled.setdefault(spelling, set()).add(name)
    return {
        spelling: tuple(groups[name].values())
        for spelling, names in spelled.items()
        for name in names
        if len(names) == 1 and spelling
    }


def _in_moodle(name: str) -> str:
    """A name as Moodle puts it into the names of files.

    >>> _in_moodle("Group_A: best")
    'Group A best'
    """
    return _REMOVED.sub("", normalize("NFC", name).replace("_", " ")).strip()


def _in_canvas(name: str) -> str:
    """A name as Canvas puts it into the names of files.

    >>> _in_canvas("Group A")
    'groupa'
    """
    return re.sub(r"[\W_]", "", normalize("NFC", name).casefold())


# Whose file it is, from its path, as each learning platform names what it hands out

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
        if any(named_by(parts) is not None for parts in level for named_by in _NAMED_BY):
            return depth
        beside = any(len(parts) == 1 and _is_answer(parts[0]) for parts in level)
        if beside or len({parts[0] for parts in level if len(parts) > 1}) != 1:
            break
        level = [parts[1:] for parts in level if len(parts) > 1]
    return int(_is_around_students([path.parts for path in files], is_problem))


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
