"""The files of OUT, written from the record alone: the same record gives the same bytes.

A human's marks in bulk: a CSV with the columns student, problem, answer, marks, comment.

`queue.csv` of OUT is such a page, with what waits for a human; rows that are not filled in are
left out, and further columns are not read.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction
from itertools import groupby
from pathlib import Path

from msgspec import Struct

from dynsolve.answers.marks import deduction, points, shown
from dynsolve.errors import Finding, InputError
from dynsolve.grading.cohort import Entry, for_a_human, most, queue, standings
from dynsolve.grading.files import decimal, folder_name, remove_others, safe, table, write
from dynsolve.grading.files import text as html_text
from dynsolve.grading.queue_page import FILE as QUEUE_PAGE
from dynsolve.grading.queue_page import queue_page
from dynsolve.grading.record import Record, RecordedAnswer, RecordedHandIn
from dynsolve.grading.set_file import ProblemSet
from dynsolve.grading.teacher import HEAD_HERE, absent_page, teachers_page, unpack
from dynsolve.grading.uploads import FOLDER, rows_of
from dynsolve.render.markdown import escaped
from dynsolve.render.prose import visible

# A human's marks in bulk: a CSV with the columns student, problem, answer, marks, comment

COLUMNS = ("student", "problem", "answer", "marks", "comment")


class ByHand(Struct, frozen=True):
    """Marks, a comment or both for one answer; `line` is where they stand."""

    student: str
    problem: str
    answer: str
    marks: str
    comment: str
    line: int


def read_by_hand(path: Path) -> Iterator[ByHand]:
    """The rows of a CSV that say something; raises InputError where it is none."""
    try:
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        reason = (getattr(error, "strerror", None) or str(error)).lower()
        raise InputError([Finding(f"cannot be read: {reason}", "give a CSV in UTF-8", str(path))]) from None
    for line, row in rows_of(text, path, COLUMNS, COLUMNS, InputError, others=True):
        # without the apostrophe that keeps a spreadsheet from running a cell
        cells = [c[1:] if c[:1] == "'" and safe(c[1:]) == c else c for c in map(row.__getitem__, COLUMNS)]
        student, problem, answer, marks, comment = cells
        if marks or comment:
            yield ByHand(student, problem, answer, marks, comment, line)


_ANSWERS = ("student", "problem", "answer", "verdict", "marks", "of", "line", "diagnosis")


def write_outputs(
    folder: Path, problems: ProblemSet, record: Record, names: Mapping[str, str]
) -> tuple[Entry, ...]:
    """Write everything but the record itself; files that are the same already are left alone.

    `names` are what students are called, where the platform's list says it.  Gives what waits for a human.
    """
    waits = tuple(queue(record, problems.stems))
    write(folder / "grades.csv", table(_grades(problems, record)))
    write(folder / "answers.csv", table(_answers(record)))
    write(folder / "queue.csv", table(_queue(waits)))
    _feedback(folder / "feedback", problems, record, names)
    write(folder / QUEUE_PAGE, queue_page(folder, problems, record, waits, names))
    copies = {path.name for path in (folder / FOLDER).glob("*")}
    write(folder / "report.html", teachers_page(problems, record, waits, names, copies))
    return waits


def _grades(problems: ProblemSet, record: Record) -> Iterator[tuple[str, ...]]:
    of = decimal(sum(most(problems).values(), Fraction(0)))
    yield ("student", *problems.stems, "total", "of")
    for standing in standings(record):
        cells = (
            "" if stem in standing.unjudged else decimal(standing.marks.get(stem, Fraction(0)))
            for stem in problems.stems
        )
        yield (standing.student, *cells, decimal(standing.total), of)


def _queue(waits: Iterable[Entry]) -> Iterator[tuple[str, ...]]:
    """The page to fill: `dynsolve override OUT --from` takes it back.

    What waits without an answer that waits for marks, such as a file of nobody, is a row to look at.
    """
    yield (*COLUMNS, "of", "reason")
    for entry in waits:
        a = entry.answer
        name, of = (a.answer, decimal(points(a.of))) if a else ("", "")
        yield (entry.student, entry.problem, name, "", "", of, f"{entry.what}: {entry.why}")


def _answers(record: Record) -> Iterator[tuple[str, ...]]:
    yield _ANSWERS
    for a in record.answers():
        marks, of = decimal(points(a.marks)), decimal(points(a.of))
        line = str(a.line) if a.line else ""
        yield (a.student, a.problem, a.answer, a.verdict, marks, of, line, ";".join(a.diagnosis))
    for entry in record.waiting():
        if not entry.student:
            yield ("", entry.problem, entry.file, "unreadable", "0", "0", "", "for_a_human")


# -- feedback ----------------------------------------------------------------------------------------


def _feedback(folder: Path, problems: ProblemSet, record: Record, names: Mapping[str, str]) -> None:
    written: set[Path] = set()
    whose = _whose(record, names)
    answers = groupby(record.answers(), key=lambda a: (a.student, a.problem))
    waiting = next(answers, None)
    for row in record.rows():
        own: list[RecordedAnswer] = []
        if waiting is not None and waiting[0] == (row.student, row.problem):
            own = list(waiting[1])
            waiting = next(answers, None)
        if row.html:
            pages = (unpack(row.html), unpack(row.markdown))
        elif any(answer.said or answer.comment for answer in own):
            pages = absent_page()
        else:
            continue
        head = _head(problems, row, own, whose.get(row.student, row.student))
        place = folder / folder_name(row.student)
        for ending, put_in, page in zip((".html", ".md"), (_html, _markdown), pages, strict=True):
            path = place / f"{row.problem}{ending}"
            written.add(path)
            write(path, put_in(head, page), durable=False)
    remove_others(folder, written, (".html", ".md"))


def _whose(record: Record, names: Mapping[str, str]) -> dict[str, str]:
    """Who stands over the page of each student: a name; a group with its members, who read the same."""
    groups = record.groups()
    members: dict[str, list[str]] = {}
    for student, group in groups.items():
        members.setdefault(group, []).append(names.get(student, student))
    return {**names, **{s: f"{group} ({', '.join(members[group])})" for s, group in groups.items()}}


class _Head(Struct, frozen=True):
    """The head of a student's page: whose it is, of which set, the marks, and of each answer why."""

    title: str
    assignment: str
    total: str
    told: tuple[str, ...]
    rows: tuple[tuple[str, str, str], ...]


def _head(problems: ProblemSet, row: RecordedHandIn, answers: list[RecordedAnswer], whose: str) -> _Head:
    title = problems.item(row.problem).problem.title
    marks, of = points(*(a.marks for a in answers)), points(*(a.of for a in answers))
    rows = list(_explained(row, answers))
    if line := deduction(marks, row.late, problems.policy):
        marks += line.marks
        rows.append((line.name, f"\u2212{shown(-line.marks)}", line.why))
    return _Head(
        f"{title}: {whose}",
        problems.title if problems.title != title else "",
        f"Marks: {shown(marks)} of {shown(of)}",
        tuple(_told(row)),
        tuple(rows),
    )


def _told(row: RecordedHandIn) -> Iterator[str]:
    if row.late:
        yield "It was handed in late."
    if len(row.files) > 1:
        yield f"It was read from {', '.join(row.files)}, in this order."
    if row.left:
        yield f"The newest copy counts; left aside: {', '.join(row.left)}."


def _explained(row: RecordedHandIn, answers: list[RecordedAnswer]) -> Iterator[tuple[str, str, str]]:
    """Each answer with its marks and why; nothing of a hand-in that was not judged but a teacher's words."""
    for a in answers:
        if a.of != "0" and (a.said or a.comment or not row.reason or a.fault != row.reason):
            name = f"{a.answer} {a.label}".strip()
            looks = "; your teacher looks at it" if for_a_human(a) and not a.said else ""
            yield name, f"{shown(points(a.marks))} of {shown(points(a.of))}", f"{a.why}{looks}"


def _html(head: _Head, page: str) -> str:
    """The page with its head."""
    rows = "".join(
        "<tr>" + "".join(f"<td>{html_text(cell)}</td>" for cell in cells) + "</tr>\n" for cells in head.rows
    )
    names = "".join(f'<th scope="col">{name}</th>' for name in ("answer", "marks", "why"))
    body = f"<thead><tr>{names}</tr></thead><tbody>\n{rows}</tbody>"
    title = html_text(head.title)
    parts = (
        f'<h1 dir="auto">{title}</h1>',
        f"<p>{html_text(head.assignment)}</p>" if head.assignment else "",
        f"<p><strong>{head.total}</strong></p>",
        *(f"<p>{html_text(sentence)}</p>" for sentence in head.told),
        f'<div class="scroll"><table class="marks">{body}</table></div>' if rows else "",
    )
    page = _put(page, "<title>[^<]*</title>", f"<title>{title}</title>")
    return _put(page, f"<p[^>]*>{HEAD_HERE}</p>", "\n".join(filter(None, parts)))


def _markdown(head: _Head, page: str) -> str:
    """The page in Markdown with its head."""
    title, assignment, *told = (escaped(visible(s)) for s in (head.title, head.assignment, *head.told))
    rows = [" | ".join(escaped(visible(cell)) for cell in cells) for cells in head.rows]
    lines = ["answer | marks | why", ":---: | :---: | :---", *rows]
    table = "\n".join(f"| {line} |" for line in lines) if rows else ""
    parts = (f"# {title}", assignment, f"**{head.total}**", *told, table)
    return _put(page, f"(?m)^{HEAD_HERE}$", "\n\n".join(filter(None, parts)))


def _put(page: str, place: str, text: str) -> str:
    """The page with a text put in at the first match, which is before anything a student wrote."""
    found = re.search(place, page)
    return page if found is None else page[: found.start()] + text + page[found.end() :]
