"""The files of OUT, written from the record alone: the same record gives the same bytes."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction
from html import escape
from itertools import groupby
from pathlib import Path

from dynsolve.answers.marking.policy import points, shown
from dynsolve.grading.by_hand import COLUMNS
from dynsolve.grading.cohort import most, standings
from dynsolve.grading.copies import FOLDER
from dynsolve.grading.files import decimal, folder_name, remove_others, table, write
from dynsolve.grading.pages import MARKS_HERE, TABLE_HERE, absent_page, unpack
from dynsolve.grading.problem_set import ProblemSet
from dynsolve.grading.queue import Entry, queue
from dynsolve.grading.record import Record, RecordedAnswer, RecordedHandIn
from dynsolve.grading.teacher import teachers_page
from dynsolve.render.markdown import escaped
from dynsolve.render.prose import visible

_Explained = list[tuple[str, str, str]]
"""Of each answer its name, its marks and why."""

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
    _feedback(folder / "feedback", problems, record)
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
        reason = f"{entry.what}: {entry.why}"
        for a in entry.answers:
            yield (a.student, a.problem, a.answer, "", "", decimal(points(a.of)), reason)
        if not entry.answers:
            yield (entry.student, entry.problem, "", "", "", "", reason)


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


def _feedback(folder: Path, problems: ProblemSet, record: Record) -> None:
    written: set[Path] = set()
    groups = record.groups()
    answers = groupby(record.answers(), key=lambda a: (a.student, a.problem))
    waiting = next(answers, None)
    for row in record.rows():
        own: list[RecordedAnswer] = []
        if waiting is not None and waiting[0] == (row.student, row.problem):
            own = list(waiting[1])
            waiting = next(answers, None)
        if row.html:
            html, markdown = unpack(row.html), unpack(row.markdown)
        elif any(answer.said or answer.comment for answer in own):
            html, markdown = absent_page(
                problems.item(row.problem).problem.title, groups.get(row.student, row.student)
            )
        else:
            continue
        place = folder / folder_name(row.student)
        total, explained = _total(own), _explained(row, own)
        for ending, page in (
            (".html", _html(row, total, explained, html)),
            (".md", _markdown(row, total, explained, markdown)),
        ):
            path = place / f"{row.problem}{ending}"
            written.add(path)
            write(path, page, durable=False)
    remove_others(folder, written, (".html", ".md"))


def _total(answers: list[RecordedAnswer]) -> str:
    marks, of = points(*(a.marks for a in answers)), points(*(a.of for a in answers))
    return f"Marks: {shown(marks)} of {shown(of)}"


def _told(row: RecordedHandIn) -> Iterator[str]:
    if row.late:
        yield "It was handed in late."
    if len(row.files) > 1:
        yield f"It was read from {', '.join(row.files)}, in this order."
    if row.left:
        yield f"The newest copy counts; left aside: {', '.join(row.left)}."


def _explained(row: RecordedHandIn, answers: list[RecordedAnswer]) -> _Explained:
    """Each answer with its marks and why; nothing of a hand-in that was not judged but a teacher's words."""
    return [
        (f"{a.answer} {a.label}".strip(), f"{shown(points(a.marks))} of {shown(points(a.of))}", a.why)
        for a in answers
        if a.of != "0" and (a.said or a.comment or not row.reason or a.fault != row.reason)
    ]


def _html(row: RecordedHandIn, total: str, explained: _Explained, page: str) -> str:
    """The page with the marks in it."""
    told = "".join(f"<p>{_escaped(sentence)}</p>\n" for sentence in _told(row))
    rows = "".join(
        "<tr>" + "".join(f"<td>{_escaped(cell)}</td>" for cell in cells) + "</tr>\n" for cells in explained
    )
    head = "".join(f'<th scope="col">{name}</th>' for name in ("answer", "marks", "why"))
    body = f"<thead><tr>{head}</tr></thead><tbody>\n{rows}</tbody>"
    table = f'<div class="scroll"><table class="marks">{body}</table></div>' if rows else ""
    page = _put(page, f"<p[^>]*>{MARKS_HERE}</p>", f"<p><strong>{total}</strong></p>\n{told}")
    return _put(page, f"<p[^>]*>{TABLE_HERE}</p>", table)


def _markdown(row: RecordedHandIn, total: str, explained: _Explained, page: str) -> str:
    """The page in Markdown with the marks in it."""
    told = [escaped(visible(sentence)) for sentence in _told(row)]
    rows = [" | ".join(escaped(visible(cell)) for cell in cells) for cells in explained]
    lines = ["answer | marks | why", ":---: | :---: | :---", *rows]
    table = "\n".join(f"| {line} |" for line in lines) if rows else ""
    page = _put(page, f"(?m)^{MARKS_HERE}$", "\n\n".join([f"**{total}**", *told]))
    return _put(page, f"(?m)^{TABLE_HERE}$", table)


def _put(page: str, place: str, text: str) -> str:
    """The page with a text put in at the first match, which is before anything a student wrote."""
    found = re.search(place, page)
    return page if found is None else page[: found.start()] + text + page[found.end() :]


def _escaped(text: str) -> str:
    return escape(visible(text))
