"""A report as a document: what a student reads, or a teacher.

The first slip comes first; what rests on it is said to rest on it.  A student is
told as much as the rung of the ladder allows (1 where, 2 what kind, 3 how), and
never the solution; a teacher sees the differences too.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from dynsolve.answers.submission import Place
from dynsolve.answers.verdict import Diagnosis, EntryVerdict, Judged, Report, Verdict
from dynsolve.document import Block, Document, Fold, Formula, Heading, List, Note, Prose, Table, Text
from dynsolve.errors import Finding
from dynsolve.notation.tree import Node

_SAID = {
    Verdict.CORRECT: "correct",
    Verdict.FOLLOWS: "follows from your earlier answers",
    Verdict.WRONG: "wrong",
    Verdict.UNREADABLE: "could not be read",
    Verdict.MISSING: "missing",
}


_NOTES = {
    "rounded": "a decimal rounds the exact value",
    "not_from_own": "right, though your own earlier answers lead elsewhere",
}


@dataclass(frozen=True, slots=True)
class View:
    """How much is shown: the rung of the ladder, whether differences are, whether every reading is."""

    level: int = 3
    teacher: bool = False
    readings: bool = False


def feedback(report: Report, title: str, view: View) -> Document:
    """The report as a document."""
    return Document(tuple(_blocks(report, title, view)))


def _blocks(report: Report, title: str, view: View) -> Iterator[Block]:
    yield Heading(title, 1)
    yield from _opening(report, view)
    wrong = [a for a in report.answers if a.verdict is Verdict.WRONG and a.given]
    for answer in wrong:
        yield Fold(f"{_named(answer)}: wrong", tuple(_wrong(answer, report, view)))
    unread = [a for a in report.answers if a.verdict is Verdict.UNREADABLE and a.given]
    for answer in unread:
        yield Fold(f"{_named(answer)}: could not be read", tuple(_unreadable(answer)))
    yield Heading("All answers")
    yield Table(("answer", "verdict", "note"), tuple(_row(a, view) for a in report.answers))
    yield from _readings(report, view)
    if report.not_recognized:
        yield Heading("Not recognized")
        yield List(tuple((f"{n.place}: {_short(n.text)}",) for n in report.not_recognized))


def _opening(report: Report, view: View) -> Iterator[Block]:
    count = sum(a.verdict is Verdict.CORRECT for a in report.answers)
    if report.all_correct:
        yield Text((f"All {count} answers are correct.",))
    elif report.first_wrong:
        first = next(a for a in report.answers if a.name == report.first_wrong)
        resting = sum(a.verdict is Verdict.FOLLOWS for a in report.answers)
        text = f"It first went wrong at {_named(first)}{_where(first)}."
        if resting:
            verb = "answer follows" if resting == 1 else "answers follow"
            text += f" {resting} later {verb} from earlier slips."
        yield Text((text,))
    else:
        yield Text((f"{count} of {len(report.answers)} answers are correct.",))
    if report.of:
        yield Text((f"Marks: {_number(report.marks)} of {_number(report.of)}.",))


def _number(value: object) -> str:
    return f"{float(value):g}"  # type: ignore[arg-type]


def _named(answer: Judged) -> str:
    return f"{answer.name} {answer.label}".strip()


def _where(answer: Judged) -> str:
    return f" ({answer.place})" if answer.place and answer.place.line else ""


def _wrong(answer: Judged, report: Report, view: View) -> Iterator[Block]:
    if answer.read_as:
        yield Text((f"Read as: {_short(answer.read_as)}",))
    bad = [e for e in answer.entries if e.verdict is Verdict.WRONG]
    if bad:
        right = [e for e in answer.entries if e.verdict is not Verdict.WRONG]
        places = ", ".join(map(_index, bad))
        word = "row" if len(bad[0].index) == 1 else "entry"
        plural = {"row": "rows", "entry": "entries"}[word] if len(bad) > 1 else word
        text = f"Wrong in {plural} {places}"
        yield Text((text + ("; the others are right or follow." if right else "."),))
    told = answer.diagnosis
    if view.level >= 2 or view.teacher:
        yield from _slips(told, view)
    if view.teacher:
        if answer.difference is not None:
            yield Text(("Yours minus what was expected:",))
            yield Formula(answer.difference)
        for entry in bad:
            if entry.difference is not None:
                yield Text((f"Entry {_index(entry)}, yours minus what was expected:",))
                yield Formula(entry.difference)
    for note in answer.notes:
        yield Note((note,))


def _slips(told: Sequence[Diagnosis], view: View) -> Iterator[Block]:
    if view.level >= 3 or view.teacher:
        items: list[Prose] = [(f"{d.message} {d.look}".strip(),) for d in told]
        if items:
            yield List(tuple(items))
    else:
        kinds = tuple(dict.fromkeys(d.kind for d in told if d.kind))
        if kinds:
            yield List(tuple((f"What kind of slip: {kind}.",) for kind in kinds))


def _index(entry: EntryVerdict) -> str:
    return str(entry.index[0]) if len(entry.index) == 1 else f"({entry.index[0]}, {entry.index[1]})"


def _unreadable(answer: Judged) -> Iterator[Block]:
    yield Text((f"{answer.fault}{_where(answer)}.",))
    place = answer.place
    if place is not None and place.excerpt:
        start = place.column - 1
        end = start + max(place.length, 1)
        before, here, after = place.excerpt[max(start - 60, 0) : start], place.excerpt[start:end], ""
        after = place.excerpt[end : end + 30]
        yield Text((f"{before} ▸{here}◂ {after}".strip(),))
    if answer.expected:
        yield Note((answer.expected,))


def findings(report: Report) -> Iterator[Finding]:
    """What could not be read, with its place and a caret."""
    for answer in report.answers:
        if answer.verdict is Verdict.UNREADABLE and answer.given:
            place = answer.place or Place(0, 0)
            yield Finding(
                f"{answer.name}: {answer.fault}", answer.expected, report.file,
                place.line, place.column, place.length, place.excerpt,
            )  # fmt: skip


def _row(answer: Judged, view: View) -> tuple[str | Node, ...]:
    return _named(answer), _SAID[answer.verdict], "; ".join(_remarks(answer, view))


def _remarks(answer: Judged, view: View) -> Iterator[str]:
    if answer.follows_from:
        yield "from " + ", ".join(answer.follows_from)
    if answer.verdict is not Verdict.WRONG:
        yield from (_NOTES.get(note, note) for note in answer.notes)
    if len(answer.occurrences) > 1:
        yield "given {} times: {}".format(
            len(answer.occurrences),
            ", ".join(f"{o.label or o.place} {o.verdict}" for o in answer.occurrences),
        )


def _readings(report: Report, view: View) -> Iterator[Block]:
    """How answers were read: those that are not correct, or all; wrong ones have it beside them already."""
    silent = {Verdict.WRONG} if not view.readings else set()
    if not view.readings:
        silent.add(Verdict.CORRECT)
    items = [
        (f"{_named(a)}: {_short(a.read_as)}",)
        for a in report.answers
        if a.read_as and a.verdict not in silent
    ]
    if items:
        yield Heading("How the answers were read")
        yield List(tuple(items))


def _short(text: str, most: int = 2000) -> str:
    text = " ".join(text.split())
    return text if len(text) <= most else text[: most - 1] + "…"
