"""Answers that are asked for and not written by themselves: judged by what is written of them.

- a whole by its parts, where all of them are written: K by K1 and K2, D by its entries;
- an entry by the matrix that it stands in, or by the entry that it mirrors in D;
- the entries of C by their row of C q̇, since C itself is free.

What nothing is written of is missing.

Formulas of names alone that count as answers: τ = D q̈ + C q̇ + g beside a D, a C and a g of one's own.

A formula like this says how a quantity is found, and is a definition.  Where the quantity is
asked for, and nothing else in the file gives it, it is what the student's own answers make of it.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from fractions import Fraction

from msgspec.structs import replace

from dynsolve.answers.answer_verdict import AnswerJudge, in_order
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.judging.key_comparison import KeyComparison
from dynsolve.answers.verdict import Answer, JudgedAnswer, Submission, Verdict, worst
from dynsolve.quantities import families
from dynsolve.quantities.index import Quantities

# Formulas of names alone that count as answers

_JACOBIANS = frozenset({"J", "Jv", "Jr"})
"""What a hand-in calls J is any of these, by its shape."""


def general_formulas(submission: Submission, asked: Collection[str], named: Quantities) -> Iterator[Answer]:
    """The formulas of names alone that answer what is asked and not given, from what is given.

    They come behind all that they are put together from, which does not follow from them.
    """
    given = {answer.name for answer in submission.answers}
    behind = 1 + max((answer.occurrence[0] for answer in submission.answers), default=0)
    for place, answer in enumerate(submission.general):
        if answer.name not in asked or is_given(named, answer.name, given):
            continue
        if (
            answer.node is not None
            and answer.references
            and all(is_given(named, name, given) for name in needed(named, answer.name, answer.references))
        ):
            yield replace(answer, occurrence=(behind + place, 0))


def needed(named: Quantities, name: str, references: Iterable[str]) -> list[str]:
    """What a formula of an answer needs: what stands in it, but for forces that are its inputs."""
    forces = (families.TAU, families.FORCE) if families.holds_forces(name) else ()
    return [other for other in references if named[other].family not in forces]


def is_given(named: Quantities, name: str, given: Collection[str]) -> bool:
    """Whether a quantity is written, by itself or by an entry or a part of it."""
    return (
        name in given
        or (name in _JACOBIANS and not _JACOBIANS.isdisjoint(given))
        or any(named.entry_of(other)[0] == name for other in given)
        or any(part in given for part in named.parts(name))
    )


# Answers that are asked for and not written by themselves

BY_PARTS = "judged by its parts"
BY_MIRROR = "judged as the entry that it mirrors: D is symmetric"

_ROWS_OF_J = {"Jv": range(1, 4), "Jw": range(4, 7)}

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
    found = JudgedAnswer(name, verdict, parts[0].label, parts[0].place, of=of, given=False, notes=(BY_PARTS,))
    waits = all(part.waits for part in parts if part.verdict is Verdict.UNREADABLE)
    return replace(found, follows_from=in_order(graph, used), waits=waits and verdict is Verdict.UNREADABLE)


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
    """An entry as it stands in the matrix, or as the one that it mirrors in D; J_v and J_ω as rows of J."""
    name, entry = graph.quantities.entry_of(base.name)
    rows = _ROWS_OF_J.get(base.name, ())
    mirrored = answers.get(graph.quantities.mirrored(base.name))
    if mirrored is not None and mirrored.given:
        return replace(mirrored, name=base.name, of=base.of, given=False, notes=(BY_MIRROR,))
    whole = answers.get("J" if rows else name)
    if whole is None or not whole.given:
        return None
    place = tuple(i + 1 for i in entry)
    own = [e for e in whole.entries if e.index[0] in rows or place in (e.index, (*e.index, *place[1:2]))]
    verdict = worst([e.verdict for e in own]) if own else whole.verdict
    found = next((e for e in own if e.verdict is verdict), None)
    block = tuple(replace(e, index=(e.index[0] - rows[0] + 1, *e.index[1:])) for e in own) if rows else ()
    return replace(
        base, verdict=verdict, label=whole.label, place=whole.place, entries=block,
        notes=(f"{'rows' if rows else 'an entry'} of {whole.name}",),
        follows_from=found.follows_from if found else (),
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
            told = {"diagnosis": row.diagnosis, "difference": row.difference}
            yield name, replace(answers[name], verdict=row.verdict, follows_from=row.follows_from, **told)
