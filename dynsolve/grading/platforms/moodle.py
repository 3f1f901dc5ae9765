"""Moodle: the names of its files, and the offline grading worksheet; the pages of feedback.

Moodle finds a column by its header in the site's language, so the worksheet is given
back as it came, with Grade and Feedback comments filled in.  Headers are known in some
languages; in others the columns are found by what stands in them.

The zip of feedback files for Moodle: a folder a participant, or a group, named as its downloads are.

Moodle finds whose a folder is by the number in its name; that of a group reaches all its members
(`importziplib.php` of its feedback files), so that they must read the same.

Zips that a platform takes back: the same files give the same bytes.
"""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Collection, Iterable, Iterator
from fractions import Fraction
from pathlib import Path
from typing import IO

from dynsolve.grading.cohort import Standing, most, standings
from dynsolve.grading.files import decimal, folder_name
from dynsolve.grading.platforms.gradescope import FileOwner, Person
from dynsolve.grading.platforms.roster import MOST_NAMED, Roster, not_judged, number, unmatched
from dynsolve.grading.record import Record
from dynsolve.grading.set_file import ProblemSet
from dynsolve.render.files import changed

# Zips that a platform takes back: the same files give the same bytes

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


# The zip of feedback files for Moodle

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
    reached = [name for name in sorted(members) if name not in (*apart, *unknown)]
    told = {name: _pages(folder, members[name][0]) for name in reached}
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


# Moodle

_NAMED = re.compile(r"(?P<who>.+?)(?:_(?P<id>\d+))?_assignsubmission_[a-z]+_?(?P<name>.*)", re.DOTALL)

_GRADE = ("Grade", "Bewertung")
_STATUS = (
    "Status", "Statut", "Stato", "Estado", "Estat", "Tila", "Stav", "Stare", "Stanje", "Állapot", "Olek",
    "Статус", "Состояние", "Състояние", "ステータス", "状态", "狀態", "상태",
)  # fmt: skip
_COMMENTS = ("Feedback comments", "Feedback als Kommentar")
_NUMBER = re.compile(r"(\d+)\s*$")
_NOT_IN_FILES = re.compile(r"[\x00-\x1f\x7f&<>\"`|':\\/]")
"""What Moodle takes out of the names of files, those of people among them: O'Neil is ONeil there."""

_DATE = re.compile(r"\d{4}|\d[:.h]\d{2}")
_DAY = re.compile(
    r"days?|tage?n?|da[gn](?:er|ar|e|en|a|i|o)?|d[øy]g?n|jours?|d[ií]as?|dies|giorn[oi]|päivää?|päev\w*|vrk|dzień|dni|den|"
    r"dn[yůíi]|d[eě]n|день|дн\w*|ден\w*|nap(?:ja|pal)?|gün|η?μέρ\w*|zile?|zi|dien\w*|egun\w*|[日天일].*"
)
"""A day in the languages that Moodle is used in most."""
_TIME = re.compile(r"\d{1,2}[:.]\d{2}")


def owner(parts: tuple[str, ...]) -> FileOwner | None:
    """`<Full name>_<participant id>_assignsubmission_file[_]/<path>`, or the same without folders.

    Where groups hand in, it is the name of the group and its number, without a number for those of no
    group; before Moodle 4.1 `<Group>-<Full name>_<participant id>`, once for each member.
    """
    found = _NAMED.fullmatch(parts[0])
    if found is None:
        return None
    rest = [piece for piece in (found["name"], *parts[1:]) if piece]
    id = found["id"] or ""
    who, name = found["who"], "/".join(rest) or "onlinetext.html"
    return FileOwner(f"{who}_{id}" if id else who, id, "", name, called=who)


def check(problems: ProblemSet, roster: Roster) -> int:
    """The column of the grade; raises InputError for what is no worksheet."""
    if len(roster.header) < 4 or not all(re.search(r"\d$", row[0].strip()) for row in roster.rows[1:]):
        help = "in the assignment in Moodle: Download grading worksheet"
        raise roster.fault("this is no grading worksheet of Moodle", help)
    return _grade(roster)


def write(folder: Path, problems: ProblemSet, record: Record, roster: Roster) -> Iterator[str]:
    """Write `moodle.csv` and `moodle-feedback.zip`."""
    grade, comments = check(problems, roster), _comments(roster)
    of = sum(most(problems).values(), Fraction(0))
    all_of = list(standings(record))
    by_id = {standing.id: standing for standing in all_of if standing.id}
    out = [roster.header]
    seen: set[str] = set()
    without: list[str] = []
    for row in roster.rows[1:]:
        cells = [*row, *("" for _ in roster.header[len(row) :])]
        digits = _NUMBER.search(cells[0])
        found = by_id.get(digits[1]) if digits else None
        if found is None:
            without.append(cells[0])
        else:
            seen.add(found.student)
            if not found.unjudged:
                cells[grade] = roster.marks(found.total)
            if comments is not None and not found.unjudged:
                stands = re.sub(r"<[^>]*>", "", cells[comments]).strip()
                if not stands or stands.startswith(f"{problems.stems[0]}: "):  # none, or one of ours
                    cells[comments] = _comment(found, problems)
        out.append(tuple(cells))
    roster.write(folder / "moodle.csv", out, trusted=comments)
    yield from write_feedback(folder, record)
    maximum = next((number(row[grade + 1]) for row in roster.rows[1:] if len(row) > grade + 1), None)
    if maximum not in (None, of):
        assert maximum is not None
        yield f"the maximum grade in Moodle is {decimal(maximum)}, the problem set has {decimal(of)}"
    yield from _over(all_of, maximum)
    if comments is None:
        yield "the worksheet has no column for comments: turn on Feedback comments in the assignment"
    yield from not_judged(all_of)
    yield from unmatched(all_of, seen, without, roster)


def _over(all_of: list[Standing], maximum: Fraction | None) -> Iterator[str]:
    """Warnings on grades that Moodle will not take."""
    if maximum is None and all_of:
        yield "the assignment is graded with a scale: Moodle takes its words, not marks"
    over = [s.student for s in all_of if maximum is not None and s.total > maximum]
    if over:
        assert maximum is not None
        yield f"over the maximum of {decimal(maximum)}, which Moodle refuses: {'; '.join(over[:MOST_NAMED])}"


def people(roster: Roster) -> Iterator[Person]:
    """The participants of a worksheet; where groups hand in, the column after the status names theirs.

    Where names are hidden there is none, and the files are called as the identifiers are.
    """
    grade, status = _grade(roster), _status(roster)
    for row in roster.rows[1:]:
        digits = _NUMBER.search(row[0])
        if digits is None or len(row) <= grade:
            continue
        hidden = status in (None, 1)
        name = row[0][: digits.start()].strip() if hidden else row[1]
        group = row[status + 1].strip() if status is not None and status + 1 < grade else ""
        also = tuple(cell for cell in row[2:status] if cell) if not hidden else ()
        in_files = _NOT_IN_FILES.sub("", name.replace("_", " "))
        yield Person(f"{in_files}_{digits[1]}", digits[1], name, group, also)


def late(roster: Roster) -> dict[str, int] | None:
    """The days that participants are late by their status; None where the worksheet has no such column.

    The parts of a status are joined by ` - `, in every language; one that holds a length of time
    and no date says how late it is.
    """
    place = _status(roster)
    if place is None:
        return None
    rows = ((_NUMBER.search(row[0]), _days(row[place])) for row in roster.rows[1:] if len(row) > place)
    return {digits[1]: days for digits, days in rows if digits and days}


def _days(status: str) -> int:
    """The days that a status says a hand-in is late, begun ones counted; one where the unit is not known.

    >>> _days("Submitted for grading - 1 day 2 hours late"), _days("Abgegeben - 3 Tage verspätet")
    (2, 3)
    >>> _days("Levert - 5 min for sent"), _days("Submitted - Extension granted until: 1 May 2026")
    (1, 0)
    """
    for part in re.split(r"(?:^|\s)[-–]\s", status):
        numbers = re.findall(r"(\d+)\s*([^\W\d]*)", part)
        if not numbers or ":" in part or _DATE.search(part):
            continue
        (first, unit), more = numbers[0], len(numbers) > 1
        return int(first[:6]) + more if _DAY.fullmatch(unit.casefold()) else 1
    return 0


def _status(roster: Roster) -> int | None:
    """The column of the status: by its name, else the one after the addresses, else that before the grade."""
    grade = _grade(roster)
    for place, name in enumerate(roster.header[:grade]):
        if name in _STATUS:
            return place
    addresses = [i for i in range(grade) if any("@" in row[i] for row in roster.rows[1:] if len(row) > i)]
    found = addresses[-1] + 1 if addresses else grade - 1
    return found if 1 <= found < grade else None


def _grade(roster: Roster) -> int:
    """The column of the grade: by its name, else the one before the maximum, which is the same for all."""
    for place, name in enumerate(roster.header):
        if name in _GRADE:
            return place
    rows = [row for row in roster.rows[1:] if len(row) == len(roster.header)]
    found = [
        place
        for place in range(1, len(roster.header) - 1)
        if rows
        and number(rows[0][place + 1])
        and all(row[place + 1] == rows[0][place + 1] for row in rows)
        and all(row[place].strip() in ("", "-") or number(row[place]) is not None for row in rows)
    ]
    if len(found) != 1:
        message = "which column has the grade cannot be told in this language"
        raise roster.fault(message, "set your language in Moodle to English, and download it again")
    return found[0]


def _comments(roster: Roster) -> int | None:
    """The column of the comments: by its name, else the last one unless that holds times."""
    for place, name in enumerate(roster.header):
        if name in _COMMENTS:
            return place
    if any(name in _GRADE for name in roster.header):
        return None  # the language is known, and there is no such column
    last = len(roster.header) - 1
    cells = [row[last].strip() for row in roster.rows[1:] if len(row) > last]
    is_time = all(cell == "-" or _TIME.search(cell) for cell in cells)
    return None if cells and is_time else last


def _comment(standing: Standing, problems: ProblemSet) -> str:
    late = {stem: f" (late: {decimal(line.marks)})" for stem, line in standing.late.items()}
    parts = [
        f"{stem}: {decimal(standing.marks.get(stem, Fraction(0)))}{late.get(stem, '')}"
        for stem in problems.stems
    ]
    return "; ".join(parts)
