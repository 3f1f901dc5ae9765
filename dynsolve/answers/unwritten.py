"""Answers that are asked for and not written by themselves: judged by what is written of them.

- a whole by its parts, where all of them are written: K by K1 and K2, D by its entries;
- an entry by the matrix that it stands in, or by the entry that it mirrors in D;
- the entries of C by their row of C q̇, since C itself is free.

What nothing is written of is missing.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from fractions import Fraction

from dynsolve.answers.answer_verdict import AnswerJudge, in_order
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.judging.key_comparison import KeyComparison
from dynsolve.answers.verdict import JudgedAnswer, Verdict, worst

BY_PARTS = "judged by its parts"
BY_MIRROR = "judged as the entry that it mirrors: D is symmetric"

Answers = Mapping[str, JudgedAnswer]


def unwritten(graph: AnswerGraph, name: str, of: Fraction, answers: Answers) -> JudgedAnswer:
    """The verdict of what is not written, from the answers that are; `of` are its marks."""
    parts = _written_parts(graph, name, answers)
    if parts is None:
        notes = tuple(_incomplete(graph, name, answers))
        base = JudgedAnswer(name, Verdict.MISSING, of=of, given=False, notes=notes)
        return _within_whole(graph, base, answers) or base
    verdict = worst([part.verdict for part in parts])
    used = [source for part in parts for source in part.follows_from] if verdict is Verdict.FOLLOWS else []
    return JudgedAnswer(
        name,
        verdict,
        parts[0].label,
        parts[0].place,
        of=of,
        given=False,
        notes=(BY_PARTS,),
        follows_from=in_order(graph, used),
    )


def _incomplete(graph: AnswerGraph, name: str, answers: Answers) -> Iterator[str]:
    """Which parts of a whole are there, and which are not, where only some are."""
    parts = graph.quantities.parts(name)
    there = [part for part in parts if {part, graph.quantities.mirrored(part)} & answers.keys()]
    if there:
        lacking = ", ".join(
            dict.fromkeys(min(p, graph.quantities.mirrored(p)) for p in parts if p not in there)
        )
        yield f"{', '.join(there)} {'are' if len(there) > 1 else 'is'} there, but not {lacking}"


def _within_whole(graph: AnswerGraph, base: JudgedAnswer, answers: Answers) -> JudgedAnswer | None:
    """An entry as it stands in the matrix, or as the one that it mirrors in D."""
    name, entry = graph.quantities.entry_of(base.name)
    mirrored = answers.get(graph.quantities.mirrored(base.name))
    if mirrored is not None and mirrored.given:
        return replace(mirrored, name=base.name, of=base.of, given=False, notes=(BY_MIRROR,))
    whole = answers.get(name)
    if whole is None or not whole.given:
        return None
    place = tuple(i + 1 for i in entry)
    found = next((e for e in whole.entries if place in (e.index, (*e.index, place[1]))), None)
    return replace(
        base, verdict=found.verdict if found else whole.verdict, label=whole.label, place=whole.place,
        notes=(f"an entry of {whole.name}",), follows_from=found.follows_from if found else (),
        diagnosis=found.diagnosis if found else whole.diagnosis, fault=whole.fault,
        expected=whole.expected, difference=found.difference if found else None,
    )  # fmt: skip


def _written_parts(graph: AnswerGraph, name: str, answers: Answers) -> list[JudgedAnswer] | None:
    """The written answers that a whole is made of, None where one of them is missing."""
    found: list[JudgedAnswer] = []
    for part in graph.quantities.parts(name):
        mirrored = graph.quantities.mirrored(part)
        if part in answers:
            found.append(answers[part])
        elif mirrored in answers:
            found.append(answers[mirrored])
        else:
            inner = _written_parts(graph, part, answers)
            if inner is None:
                return None
            found += inner
    return found or None


def coriolis_entries(
    judge: AnswerJudge, assembled: KeyComparison, answers: Answers
) -> Iterator[tuple[str, JudgedAnswer]]:
    """The entries of C, each with the verdict of its row of C q̇; `assembled` is C made of them."""
    whole = judge.compared(JudgedAnswer("C", Verdict.WRONG), assembled)
    if assembled.obstacles:
        return
    for row in whole.entries:
        for j in range(len(whole.entries)):
            name = f"C{row.index[0]}{j + 1}"
            yield (
                name,
                replace(
                    answers[name],
                    verdict=row.verdict,
                    follows_from=row.follows_from,
                    diagnosis=row.diagnosis,
                    difference=row.difference,
                ),
            )
