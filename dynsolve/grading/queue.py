"""What waits for a human: one list, for the teacher's page, for `queue.csv` and for the terminal.

An entry is an answer that waits for marks, alone or with the others of a file that no program can
judge, or a file that should be looked at.  An answer leaves the list when a teacher has given it marks,
a file beside a hand-in that was judged, or a picture in one, when a teacher has said a word on one of its
answers.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace

from dynsolve.answers.submission import PICTURE
from dynsolve.answers.unwritten import BY_PARTS
from dynsolve.grading.record import Key, Record, RecordedAnswer

OVERTAKEN = "its marks were set by hand for an earlier hand-in"
LEFT_ASIDE = "left aside: a newer copy counts"


@dataclass(frozen=True, slots=True)
class Entry:
    """Something for a human: `what` it is, a file or an answer, why, and the answer that waits for marks."""

    student: str
    problem: str
    what: str
    why: str
    answer: RecordedAnswer | None = None


def queue(record: Record, stems: Collection[str]) -> list[Entry]:
    """All that waits, files first; `stems` are the problems of the set."""
    unjudged = {(s, p): why for s, found in record.unjudged().items() for p, why in found.items()}
    judged_by_hand = {(s, p) for s, p, _ in record.overrides()}
    answers, single = _answers(record, unjudged, judged_by_hand)
    hand_ins = [replace(row, html=b"", markdown=b"") for row in record.rows()]
    reasons = {(row.student, row.problem): row.reason for row in hand_ins}
    found: list[Entry] = []
    for w in record.waiting():
        keys = [(w.student, stem) for stem in ((w.problem,) if w.problem else stems)]
        open_ = [key for key in keys if key in unjudged]
        settled = not open_ and any(reasons.get(key) or key in judged_by_hand for key in keys)
        if not settled:
            own = [answer for key in open_ for answer in answers.pop(key, ())]
            found += _each(Entry(w.student, w.problem, w.file, w.reason), own)
    for row in hand_ins:
        key = (row.student, row.problem)
        if key in answers:
            found += _each(Entry(*key, ", ".join(row.files), row.reason), answers[key])
        if row.left and key not in judged_by_hand:
            found.append(Entry(*key, ", ".join(row.left), LEFT_ASIDE))
    return found + single


def _each(entry: Entry, answers: Sequence[RecordedAnswer]) -> list[Entry]:
    """An entry for each of some answers; without any it stands alone."""
    return [replace(entry, problem=a.problem, answer=a) for a in answers] or [entry]


def _answers(
    record: Record, unjudged: Collection[Key], judged_by_hand: Collection[Key]
) -> tuple[dict[Key, list[RecordedAnswer]], list[Entry]]:
    """The answers of the hand-ins that nobody has judged, and the single answers of others that wait."""
    of_unjudged: dict[Key, list[RecordedAnswer]] = {}
    single: list[Entry] = []
    overtaken = record.overtaken()
    for a in record.answers():
        key, what = (a.student, a.problem), f"{a.answer} {a.label}".strip()
        if (*key, a.answer) in overtaken:
            single.append(Entry(*key, what, OVERTAKEN, a))
        elif a.of == "0" or a.said or (a.fault == PICTURE and key in judged_by_hand):
            continue
        elif key in unjudged:
            of_unjudged.setdefault(key, []).append(a)
        elif reason := for_a_human(a):
            single.append(Entry(*key, what, reason, a))
    return of_unjudged, single


def for_a_human(a: RecordedAnswer) -> str:
    """Why an answer that was judged should be looked at by a human, or an empty text.

    A wrong whole whose parts have a diagnosis need not be.
    """
    if a.verdict == "unreadable":
        return a.fault or "it could not be read"
    if a.verdict == "missing" and a.fault:
        return f"no answer was read, but line {a.line} names it: {a.fault}"
    if a.loss:
        return f"{a.verdict}, but {a.loss}"
    if a.verdict == "wrong" and not a.diagnosis and BY_PARTS not in a.note:
        return "it is wrong, and no slip was found that explains it"
    return ""
