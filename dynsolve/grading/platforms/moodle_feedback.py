"""The zip of feedback files for Moodle: a folder a participant, or a group, named as its downloads are.

Moodle finds whose a folder is by the number in its name; that of a group reaches all its members
(`importziplib.php` of its feedback files), so that they must read the same.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from dynsolve.grading.files import folder_name
from dynsolve.grading.platforms.archives import write_archive
from dynsolve.grading.record import Record

_NUMBERED = re.compile(r".+_\d+", re.DOTALL)


def write_feedback(folder: Path, record: Record) -> Iterator[str]:
    """Write `moodle-feedback.zip`, giving warnings on who cannot get a page by it."""
    groups = record.groups()
    members: dict[str, list[str]] = {}
    for student, id in record.students().items():
        if student in groups:
            members.setdefault(groups[student], []).append(student)
        elif id:
            members[student] = [student]
    apart = [name for name, students in members.items() if _differ(folder, students)]
    unknown = [name for name in members if not _NUMBERED.fullmatch(name)]
    told = {
        name: _pages(folder, members[name][0]) for name in sorted(members) if name not in (*apart, *unknown)
    }
    write_archive(folder / "moodle-feedback.zip", _entries(told))
    for name in apart:
        yield f"the pages of {name} are not the same for all its members, as Moodle has them: see feedback/"
    for name in unknown:
        yield f"the files of {name} have no number, by which Moodle would know whose their pages are"


def _pages(folder: Path, student: str) -> list[Path]:
    return sorted((folder / "feedback" / folder_name(student)).glob("*.html"))


def _differ(folder: Path, students: list[str]) -> bool:
    """Whether the pages of a group's members are not the same."""
    first, *others = ({p.name: p.read_bytes() for p in _pages(folder, student)} for student in students)
    return any(other != first for other in others)


def _entries(told: dict[str, list[Path]]) -> Iterator[tuple[str, bytes]]:
    for whose, pages in told.items():
        safe = re.sub(r"[/\\:*?\"<>|]", "_", whose)
        for page in pages:
            name = "feedback.html" if len(pages) == 1 else page.name
            yield f"{safe}_assignfeedback_file/{name}", page.read_bytes()
