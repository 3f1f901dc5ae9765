"""A report as a document: what a student reads, or a teacher.

The first slip comes first; what rests on it is said to rest on it.  A student is
told as much as the level of hints allows (1 where, 2 what kind, 3 how), and
never the solution; a teacher sees the differences too.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from msgspec import Struct

from dynsolve.answers.verdict import (
    Diagnosis,
    EntryVerdict,
    JudgedAnswer,
    NotRecognized,
    Place,
    Report,
    Verdict,
)
from dynsolve.document import (
    Block,
    Document,
    Fold,
    Formula,
    Heading,
    Inline,
    List,
    Note,
    Prose,
    Table,
    Text,
    Verbatim,
)
from dynsolve.errors import Finding
from dynsolve.notation.tree import Letter, Node, Number, Power, Relation, Row, Symbol

_SAID = {
    Verdict.CORRECT: "correct",
    Verdict.FOLLOWS: "follows from your earlier answers",
    Verdict.WRONG: "wrong",
    Verdict.UNREADABLE: "could not be read",
    Verdict.MISSING: "missing",
}


_NOTES = {
    "rounded": "a decimal rounds the exact value",
    "incomplete": "right; there are further branches",
    "in_degrees": "its angles were read as degrees; write 90deg",
}


_NOTHING_FOUND = "No slip was found that explains it."

_LETTER = re.compile(r"(?P<letter>tau|[A-Za-z])(?P<index>\d*)")

_POWERS = {"²": 2, "³": 3, "⁴": 4}
_WRITTEN = re.compile(
    r"(?<![^\W_])(?P<number>\d+)(?=[^\W\d_](?:\W*[₀-₉]|_))"
    rf"|(?<![^\W\d_])(?P<letter>[^\W\d_])_(?P<index>[A-Za-z0-9]+)(?P<power>[{''.join(_POWERS)}]?)"
)

_MOST = 2000
"""So many characters of what a student wrote are shown."""

_MOST_SET = 8000
"""Up to so many characters it is set as a formula."""


class FeedbackView(Struct, frozen=True):
    """How much is shown: the level of hints, a teacher's differences, how correct answers were read."""

    level: int = 3
    teacher: bool = False
    readings: bool = False


def feedback(report: Report, title: str, view: FeedbackView) -> Document:
    """The report as a document."""
    rows = tuple((_named(one), _said(one), "; ".join(_remarks(one))) for one in report.answers)
    blocks = (
        Heading(title, 1),
        *_marks(report),
        *opening(report),
        *slips(report, view),
        Heading("All answers"),
        Table(("answer", "verdict", "note"), rows),
        *readings(report, view),
        *not_recognized(report),
    )
    return Document(blocks)


def opening(report: Report) -> Iterator[Block]:
    """How it went, in a sentence or two."""
    count = sum(a.verdict is Verdict.CORRECT for a in report.answers)
    if not any(a.given or a.fault for a in report.answers):
        how = ", and the value is in the symbols of the problem: other letters make a general formula."
        yield Text(
            ("No answer was found in it. The name stands before the value: ", Verbatim("K = ..."), how)
        )
    elif report.all_correct:
        yield Text((f"All {count} answers are correct." if count > 1 else "The answer is correct.",))
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


def _marks(report: Report) -> Iterator[Block]:
    if report.of:
        yield Text((f"Marks: {_number(report.marks)} of {_number(report.of)}.",))


def slips(report: Report, view: FeedbackView) -> Iterator[Block]:
    """What is wrong, the first slip first, then what could not be read."""
    for answer in report.answers:
        if answer.verdict is Verdict.WRONG and answer.given:
            yield Fold(f"{_named(answer)}: wrong", tuple(_wrong(answer, view)))
    for answer in report.answers:
        if answer.verdict is Verdict.UNREADABLE and answer.given:
            yield Fold(f"{_named(answer)}: {_said(answer)}", tuple(_unreadable(answer, view)))


def not_recognized(report: Report) -> Iterator[Block]:
    """Equations that are no answers, each with the reason; first those that wait for a human."""
    for title, found in (
        ("For a human to look at", [n for n in report.not_recognized if n.waits]),
        ("Not recognized", [n for n in report.not_recognized if not n.waits]),
    ):
        if found:
            yield Heading(title)
            yield List(tuple(map(_listed, found)))
    if aside := [n for n in report.set_aside if n.answers]:
        yield Fold("Read, and set aside", (List(tuple(map(_listed, aside))),))


def _listed(found: NotRecognized) -> Prose:
    reasons = "; ".join(filter(None, (f"for {', '.join(found.waits)}" if found.waits else "", found.why)))
    return (f"{found.place}: ", Verbatim(_short(found.text)), f" ({reasons})" if reasons else "")


def _number(value: object) -> str:
    return f"{float(value):g}"  # type: ignore[arg-type]


def _named(answer: JudgedAnswer) -> str:
    return f"{answer.name} {answer.label}".strip()


def _said(answer: JudgedAnswer) -> str:
    return "for a human to judge" if answer.waits else _SAID[answer.verdict]


def _where(answer: JudgedAnswer) -> str:
    return f" ({answer.place})" if answer.place and answer.place.line else ""


def _wrong(answer: JudgedAnswer, view: FeedbackView) -> Iterator[Block]:
    yield from _reading(f"Read{_where(answer)} as", answer)
    bad = [e for e in answer.entries if e.verdict is Verdict.WRONG]
    if bad:
        right = [e for e in answer.entries if e.verdict is not Verdict.WRONG]
        text = f"Wrong in {_places(bad, answer)}"
        yield Text((text + ("; the others are right or follow." if right else "."),))
    if view.level >= 2 or view.teacher:
        yield from _slips(answer, bad, view)
    if view.teacher:
        yield from _differences(answer, bad)
    for note in (*answer.notes, *_times(answer)):
        yield Note((_NOTES.get(note, note),))


def _differences(answer: JudgedAnswer, bad: Sequence[EntryVerdict]) -> Iterator[Block]:
    if answer.difference is not None:
        yield Text(("Yours minus what was expected:",))
        yield Formula(answer.difference)
    for entry in bad:
        if entry.difference is not None:
            yield Text((f"Entry {_index(entry)}, yours minus what was expected:",))
            yield Formula(entry.difference)


def _places(entries: Sequence[EntryVerdict], answer: JudgedAnswer) -> str:
    """Some entries of an answer: `entry 2` of a column, `entries (1, 1), (2, 2)`, `row 1` of C."""
    is_column = all(e.index[-1] == 1 for e in answer.entries)
    word = "row" if len(entries[0].index) == 1 else "entry"
    plural = {"row": "rows", "entry": "entries"}[word] if len(entries) > 1 else word
    return f"{plural} {', '.join(str(e.index[0]) if is_column else _index(e) for e in entries)}"


def _where_told(told: Diagnosis, bad: Sequence[EntryVerdict], answer: JudgedAnswer) -> str:
    """Which of several wrong entries a slip is in, where it is not in all of them and does not say so."""
    there = [entry for entry in bad if told in entry.diagnosis]
    if not 0 < len(there) < len(bad) or told.message.startswith(("Entry", "Row")):
        return ""
    places = _places(there, answer)
    return f"{places[0].upper()}{places[1:]}: "


def _slips(answer: JudgedAnswer, bad: Sequence[EntryVerdict], view: FeedbackView) -> Iterator[Block]:
    told = answer.diagnosis
    if view.level >= 3 or view.teacher:
        items = [typeset(_where_told(d, bad, answer) + f"{d.message} {d.look}".strip()) for d in told]
        if items:
            yield List(tuple(items))
        else:
            yield Text((_NOTHING_FOUND,))
    else:
        kinds = dict.fromkeys(d.kind for d in told if d.kind)
        yield Text((f"What kind of slip: {'; '.join(kinds)}.",) if kinds else (_NOTHING_FOUND,))


def typeset(text: str) -> Prose:
    """A message of ours with its symbols as formulas, which it has in Unicode: 2m₂ l_c2² and I_1zz too.

    >>> typeset("2m₂ l_c2² is wrong")
    ('2', 'm₂ ', Power(base=Symbol(name='lc2', ...), exponent=Number(...)), ' is wrong')
    >>> typeset("+ 2l_c2 (")
    ('+ ', '2', Symbol(name='lc2', ...), ' (')
    >>> [type(part).__name__ for part in typeset("c_ijk = ½")]
    ['Letter', 'str']
    """
    parts: list[Inline] = []
    place = 0
    for found in _WRITTEN.finditer(text):
        parts.append(text[place : found.start()])
        place = found.end()
        if found["number"]:
            parts.append(found["number"])
            continue
        power = _POWERS.get(found["power"])
        symbol = _symbol(found["letter"], found["index"])
        parts.append(symbol if power is None else Power(symbol, Number(power)))
    return tuple(part for part in (*parts, text[place:]) if part != "")


def _symbol(letter: str, index: str) -> Node:
    """l_c2 is the problem's symbol lc2, c_ijk a letter with running indices."""
    if index.isalpha():
        return Letter(letter, Row(tuple(map(Symbol, index))))
    return Symbol(letter + index)


def _index(entry: EntryVerdict) -> str:
    return str(entry.index[0]) if len(entry.index) == 1 else f"({entry.index[0]}, {entry.index[1]})"


def _unreadable(answer: JudgedAnswer, view: FeedbackView) -> Iterator[Block]:
    place = answer.place
    where = f"{place}: " if place and place.line else ""
    yield Text((f"{where[:1].upper()}{where[1:]}{answer.fault}.",))
    if place is not None and place.excerpt:
        start = place.column - 1
        end = start + max(place.length, 1)
        before, here, after = place.excerpt[max(start - 60, 0) : start], place.excerpt[start:end], ""
        after = place.excerpt[end : end + 30]
        yield Text((Verbatim(f"{before} ▸{here}◂ {after}".strip()),))
    if answer.expected:
        yield Note((answer.expected,))
    bad = [e for e in answer.entries if e.verdict is Verdict.WRONG]
    if bad:
        yield Text(
            (f"Of what could be read, {_places(bad, answer)} {'are' if len(bad) > 1 else 'is'} wrong.",)
        )
        yield from _slips(answer, bad, view) if view.level >= 2 or view.teacher else ()
    elif answer.entries:
        yield Text(("What could be read of it is right or follows.",))


def findings(report: Report) -> Iterator[Finding]:
    """What could not be read, with its place and a caret."""
    for answer in report.answers:
        if answer.verdict is Verdict.UNREADABLE and answer.given:
            place = answer.place or Place(0, 0)
            yield Finding(
                f"{answer.name}: {answer.fault}", answer.expected, report.file,
                place.line, place.column, place.length, place.excerpt,
            )  # fmt: skip


def _remarks(answer: JudgedAnswer) -> Iterator[str]:
    if answer.follows_from:
        yield "from " + ", ".join(answer.follows_from)
    if answer.verdict is not Verdict.WRONG:  # what is wrong has its remarks above, beside the slip
        yield from (_NOTES.get(note, note) for note in answer.notes)
        yield from _times(answer)


def _times(answer: JudgedAnswer) -> Iterator[str]:
    """Where an answer was given, if more than once."""
    if len(answer.occurrences) > 1:
        each = ", ".join(f"{o.label or o.place} {o.verdict}" for o in answer.occurrences)
        yield f"given {len(answer.occurrences)} times, the last counts: {each}"


def readings(report: Report, view: FeedbackView) -> Iterator[Block]:
    """How answers were read: those that follow, or all; wrong ones have it beside them already."""
    silent = {Verdict.WRONG} if view.readings else {Verdict.WRONG, Verdict.CORRECT}
    read = [a for a in report.answers if a.read_as and a.verdict not in silent]
    if read:
        yield Heading("How the answers were read")
    for answer in read:
        remarks = "; ".join(_remarks(answer)) if view.readings else ""
        told = f", {_said(answer)}" + (f" ({remarks})" if remarks else "")
        yield from _reading(f"{_named(answer)}{_where(answer)}{told}", answer)


def _reading(said: str, answer: JudgedAnswer) -> Iterator[Block]:
    """What was read: a matrix, and what is to be looked at, as a formula; else, or if too long, as text."""
    is_set = answer.verdict is not Verdict.CORRECT
    if is_set and answer.written is not None and len(answer.read_as) <= _MOST_SET:
        yield Text((f"{said}:",))
        yield Formula(_equation(answer.name, answer.written))
    elif answer.read_as:
        yield Text((f"{said}: ", Verbatim(_short(answer.read_as))))


def _equation(name: str, value: Node) -> Node:
    """The value with the letter that the answer has on paper, where it is one letter."""
    found = _LETTER.fullmatch(name)
    if found is None:
        return value
    index = Number(int(found["index"])) if found["index"] else None
    return Relation((Letter(found["letter"], index), value), ("=",))


def _short(text: str, most: int = _MOST) -> str:
    text = " ".join(text.split())
    return text if len(text) <= most else text[: most - 1] + "…"
