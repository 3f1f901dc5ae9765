"""A report as JSON: `dynsolve-check/1`, the contract with other programs."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from dynsolve.answers.verdict import Diagnosis, EntryVerdict, JudgedAnswer, Place, Report, Verdict

FORMAT = "dynsolve-check/1"


def to_json(report: Report, *, level: int = 3, teacher: bool = False) -> dict[str, Any]:
    """The report as JSON; `level` is the level of hints, see `told`."""
    return {
        "format": FORMAT,
        "problem": report.problem,
        "student": report.student,
        "answers": [_answer(a, level, teacher) for a in report.answers],
        "not_recognized": [
            {
                "text": n.text,
                "label": n.label,
                "where": {"line": n.place.line, "column": n.place.column},
                "why": n.why,
            }
            for n in report.not_recognized
        ],
        "first_wrong": report.first_wrong,
        "marks": number(report.marks),
        "of": number(report.of),
        "queued": [
            *(_line(n.place, n.text, n.waits, n.why) for n in report.not_recognized if n.waits),
            *(
                _line(a.place, a.place.excerpt, (a.name,), a.fault)
                for a in report.answers
                if a.given and a.verdict is Verdict.UNREADABLE and a.place
            ),
        ],
        "set_aside": [_line(n.place, n.text, n.answers, n.why) for n in report.set_aside],
    }


def _line(place: Place, text: str, names: Sequence[str], reason: str) -> dict[str, Any]:
    """An equation that was not judged, with the answers that it names, and the reason."""
    where = {"line": place.line, "column": place.column}
    return {**where, "text": text, "name": ", ".join(names), "reason": reason}


def _answer(answer: JudgedAnswer, level: int, teacher: bool) -> dict[str, Any]:
    place = answer.place
    found: dict[str, Any] = {
        "name": answer.name,
        "label": answer.label,
        "verdict": str(answer.verdict),
        "marks": number(answer.marks),
        "of": number(answer.of),
        "where": {"line": place.line, "column": place.column} if place else None,
        "read_as": answer.read_as,
        "note": "; ".join(answer.notes),
        "follows_from": list(answer.follows_from),
        "occurrences": [
            {
                "label": o.label,
                "verdict": str(o.verdict),
                "where": {"line": o.place.line, "column": o.place.column},
            }
            for o in answer.occurrences
        ],
        "entries": [_entry(e, level, teacher) for e in answer.entries],
        "diagnosis": [told(d, level) for d in answer.diagnosis],
    }
    if answer.fault:
        found["fault"] = {"message": answer.fault, "expected": answer.expected}
    if teacher:
        found["difference"] = _text(answer.difference)
    return found


def _entry(entry: EntryVerdict, level: int, teacher: bool) -> dict[str, Any]:
    found: dict[str, Any] = {
        "index": list(entry.index),
        "verdict": str(entry.verdict),
        "follows_from": list(entry.follows_from),
        "diagnosis": [told(d, level) for d in entry.diagnosis],
    }
    if teacher:
        found["difference"] = _text(entry.difference)
    return found


def told(diagnosis: Diagnosis, level: int) -> dict[str, str]:
    """A diagnosis at a level of hints: 1 says where, 2 what kind of slip, 3 how."""
    if level >= 3:
        return {"code": diagnosis.code, "message": diagnosis.message}
    if level == 2:
        return {"code": diagnosis.code, "message": diagnosis.kind}
    return {"code": "", "message": ""}


def _text(node: Any) -> str:
    if node is None:
        return ""
    from dynsolve.notation.python import to_python

    return to_python(node)


def number(value: Fraction) -> int | float:
    """Marks as JSON has them: whole where they are."""
    return int(value) if value.denominator == 1 else float(value)
