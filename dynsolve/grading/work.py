"""The work on one hand-in: its verdicts, its marks and the student's page.

A pure function of a payload that travels as JSON, so that it runs in this process, in
a worker on this machine or on a cluster alike; nothing in it depends on time.

The key of each answer as the page of the queue sets it; a worker, which has derived it, makes it.
"""

from __future__ import annotations

import base64
import os
import re
from collections.abc import Callable, Mapping
from contextlib import suppress
from fractions import Fraction
from functools import lru_cache, partial
from hashlib import sha256
from typing import Any, TypeVar

from msgspec.structs import replace

from dynsolve.answers.judge import Checker, Judge
from dynsolve.answers.limits import REMEDY, Stopped, limited
from dynsolve.answers.marks import Marked, from_data, mark
from dynsolve.answers.reading.answer_list import readable
from dynsolve.answers.verdict import (
    Answer,
    ConfigurationAnswer,
    JudgedAnswer,
    NotRecognized,
    Submission,
    Verdict,
    VerdictAnswer,
)
from dynsolve.document import Document, Formula
from dynsolve.explain.context import style_of
from dynsolve.explain.forms import Forms
from dynsolve.grading.record import basis
from dynsolve.grading.teacher import student_page
from dynsolve.notation.tree import Matrix
from dynsolve.problem.reader import read_problem
from dynsolve.quantities.index import Quantities
from dynsolve.render.html import render

# The key of each answer as the page of the queue sets it

SECONDS = 5.0
"""The processor time in which the keys of a problem are set; else the page does without."""

_LONGEST = 200_000


def key_pages(checker: Checker) -> dict[str, str]:
    """The key of each answer that has marks, in HTML; sets and tables have none."""
    with suppress(Stopped):
        return limited(partial(_key_pages, checker), SECONDS)
    return {}


def _key_pages(checker: Checker) -> dict[str, str]:
    robot, style = checker.problem.robot, style_of(checker.problem.robot)
    compare = Judge(checker, Submission("", "", "", ())).hand_in.compare
    forms = Forms(robot, checker.key)
    found = {}
    for name in checker.problem.marks:
        target = compare.target(name)
        node, entry = (name, ()) if name in checker.graph.answer_ring.rules else (target.node, target.entry)
        if node in checker.graph.answer_ring.rules:
            shown = forms(node)
            if entry and isinstance(shown, Matrix):
                row, column = (*entry, 0)[:2]
                shown = shown.rows[row][column]
            page = render(Document((Formula(shown),)), style)
            found[name] = page.partition("<main>")[2].partition("</main>")[0].strip()
    return {name: page for name, page in found.items() if len(page) <= _LONGEST}


Data = dict[str, Any]

Placed = TypeVar("Placed", Answer, NotRecognized, ConfigurationAnswer, VerdictAnswer)

SHARE = 8
"""One answer may take this part of the time that its hand-in may take."""

MOST_TEXT = 2000
"""So much is kept of how an answer was read."""

MOST_LISTED = 50
"""So many equations that were not judged are kept."""

MOST_TOLD = 300
"""So much is kept of what is said of a slip."""


def grade_one(payload: Data, answer_by_answer: float = 0.0) -> Data:
    """Judge and mark a hand-in; `payload` has problem, marks, policy and files.

    With `answer_by_answer` seconds every answer is tried by itself first; what is too much is unreadable.
    A payload with a `key` has no hand-in, and asks for the key of each answer.
    """
    checker = checker_of(payload)
    if payload.get("key"):
        return key_pages(checker)
    read = [checker.reader(base64.b64decode(file["content"]), file["name"]) for file in payload["files"]]
    submission = _joined(read, checker.reader.vocabulary.quantities)
    if not answer_by_answer:
        return _graded(checker, submission, payload)
    tried = sound(submission, lambda one: _graded(checker, one, payload), answer_by_answer)
    return {**_graded(checker, tried, payload), **({"over": True} if tried != submission else {})}


def checker_of(payload: Data) -> Checker:
    """What judges the hand-ins to a payload's problem; it is made once a worker."""
    stated = payload["problem"]
    return _checker(stated["file"], stated["text"], tuple(payload["marks"].items()))


def _graded(checker: Checker, submission: Submission, payload: Data) -> Data:
    problem, policy = checker.problem, from_data(payload["policy"])
    letters = payload.get("letters", {})
    judge = Judge(checker, submission)
    report = checker.report(judge)
    marked = mark(report.answers, judge.graph.quantities, policy)
    html, markdown = student_page(report, problem, policy.hints)
    return {
        "answers": [
            {
                **_answer(answer, marks),
                "form": _form(judge, answer, letters),
                "basis": basis(answer),
            }
            for answer, marks in zip(report.answers, marked, strict=True)
        ],
        "not_recognized": [_listed(n) for n in report.not_recognized[:MOST_LISTED]],
        "set_aside": [f"{_listed(n)} ({n.why})" for n in report.set_aside[:MOST_LISTED]],
        "faults": [fault.message for fault in report.faults],
        "html": html,
        "markdown": markdown,
    }


def _listed(found: NotRecognized) -> str:
    return f"{found.place}: {found.text[:200]}"


@lru_cache(maxsize=64)
def _checker(file: str, text: str, marks: tuple[tuple[str, str], ...]) -> Checker:
    problem = read_problem(text, file)
    return Checker(replace(problem, marks={name: Fraction(of) for name, of in marks}))


def _joined(read: list[Submission], quantities: Quantities) -> Submission:
    """Several files of one student as one hand-in, in their order; each place then says its file."""
    if len(read) == 1:
        return read[0]
    answers, general, chains = [], [], 0
    for one in read:
        answers += [_in_file(answer, one.file, chains) for answer in one.answers]
        general += [_in_file(answer, one.file, chains) for answer in one.general]
        chains += 1 + max((a.occurrence[0] for a in (*one.answers, *one.general)), default=0)
    kept, lost = readable(answers, quantities)
    return Submission(
        read[0].problem,
        read[0].student,
        ", ".join(one.file for one in read),
        tuple(kept),
        (*(_placed(n, one.file) for one in read for n in one.not_recognized), *lost),
        tuple(replace(f, message=f"{one.file}: {f.message}") for one in read for f in one.faults),
        tuple(_placed(n, one.file) for one in read for n in one.left_alone),
        tuple(general),
        tuple(_placed(c, one.file) for one in read for c in one.configurations),
        tuple(_placed(v, one.file) for one in read for v in one.verdicts),
    )


def _in_file(answer: Answer, file: str, chains: int) -> Answer:
    """An answer whose place says its file, behind so many equations of the files before it."""
    chain, member = answer.occurrence
    return replace(_placed(answer, file), occurrence=(chain + chains, member))


def _placed(record: Placed, file: str) -> Placed:
    return replace(record, place=replace(record.place, file=file))


def _answer(answer: JudgedAnswer, marked: Marked) -> Data:
    place = answer.place
    where = [str(place)] if place and place.file else []
    slips: dict[str, str] = {}
    for said in (*answer.diagnosis, *(d for entry in answer.entries for d in entry.diagnosis)):
        if said.code:
            slips.setdefault(said.code, " ".join(said.message.split())[:MOST_TOLD])
    return {
        "name": answer.name,
        "label": answer.label,
        "verdict": str(answer.verdict),
        "marks": str(marked.marks),
        "of": str(marked.of),
        "why": marked.why,
        "line": place.line if place else 0,
        "diagnosis": list(slips),
        "message": "\n".join(slips.values()),
        "read_as": answer.read_as[:MOST_TEXT],
        "note": "; ".join([*where, *answer.notes])[:MOST_TEXT],
        "fault": answer.fault[:MOST_TEXT],
        "loss": answer.loss,
    }


def _form(judge: Judge, answer: JudgedAnswer, letters: Mapping[str, str]) -> str:
    """A hash that is the same for wrong answers of the same value, however they are written.

    `letters` are names of a variant that the problem has others for.
    """
    compared = judge.hand_in.comparisons.get(answer.name)
    if answer.verdict is not Verdict.WRONG or compared is None or not compared.rows:
        return ""
    entries = [
        "/".join(_terms(part, letters) for part in (e.value.numerator, e.value.denominator))
        for row in compared.rows
        for e in row
    ]
    return sha256(";".join(entries).encode()).hexdigest()[:16]


def _terms(expr: Any, letters: Mapping[str, str]) -> str:
    """The terms in an order that does not depend on what else the hand-in holds."""
    text = re.sub(r"[^\W\d]\w*?(?=_d?dot\b|\b)", lambda name: letters.get(name[0], name[0]), repr(expr))
    terms = text.replace(" - ", " + -").split(" + ")
    return "+".join(sorted("*".join(sorted(term.split("*"))) for term in terms))


# -- answer by answer --------------------------------------------------------------------------------


def sound(submission: Submission, work: Callable[[Submission], Any], seconds: float) -> Submission:
    """The hand-in with the answers that are too much, or that `work` fails on, unreadable.

    Raises Stopped where trying them takes more than `seconds`.
    """
    limit, start = seconds / SHARE, _spent()
    answers = []
    for answer in submission.answers:
        fault = _fault(replace(submission, answers=(answer,)), work, limit)
        answers.append(replace(answer, node=None, fault=fault, expected=REMEDY) if fault else answer)
        if _spent() - start > seconds:
            raise Stopped
    return replace(submission, answers=tuple(answers))


def _fault(alone: Submission, work: Callable[[Submission], Any], limit: float) -> str:
    """Why a hand-in of one answer cannot be judged, or nothing."""

    def tried() -> str:
        try:
            work(alone)
        except MemoryError:
            raise
        except Exception as error:  # noqa: BLE001  # whatever happens, the others are judged
            return failure(error)
        return ""

    try:
        return limited(tried, limit)
    except Stopped:
        return f"this takes more than {limit:g} s, or more memory than there is, to work out"


def failure(error: Exception) -> str:
    """What is said of a hand-in that the program failed on."""
    if isinstance(error, RecursionError):
        return "it is nested too deeply"
    return f"the program failed on it ({type(error).__name__}: {error})"[:300]


def _spent() -> float:
    times = os.times()
    return times.children_user + times.children_system
