"""The platforms whose files are written, and for which of them a record is."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from msgspec import Struct

from dynsolve.errors import UsageError
from dynsolve.grading.platforms import canvas, gradescope, moodle
from dynsolve.grading.platforms.gradescope import Person
from dynsolve.grading.platforms.roster import Roster, from_text, read_roster, to_text
from dynsolve.grading.record import Record
from dynsolve.grading.set_file import ProblemSet


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
