"""The verdict of what a student says of matrices: whether each can be an inertia matrix."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from dynsolve.answers.diagnosis.slips.configurations import SET_SLIPS
from dynsolve.answers.submission import VerdictAnswer
from dynsolve.answers.verdict import Diagnosis, EntryVerdict, JudgedAnswer, Verdict, worst
from dynsolve.derivation.definite import Definiteness
from dynsolve.derivation.graph import Derivation
from dynsolve.quantities.spelling import key
from dynsolve.robot.model import Robot


def judged_verdicts(robot: Robot, derived: Derivation, answer: VerdictAnswer, of: Fraction) -> JudgedAnswer:
    """What is said of the verdicts on matrices, each an entry of its own; `of` are their marks."""
    base = JudgedAnswer(answer.name, Verdict.UNREADABLE, place=answer.place, read_as=answer.text, of=of)
    if answer.fault:
        return replace(base, fault=answer.fault, expected=answer.expected)
    if answer.name not in derived.rules:
        return replace(base, fault=f"{answer.name} is not asked for in this problem")
    names = [candidate.name for candidate in robot.questions.candidates]
    spelled = {key(name): name for name in names}
    given = {spelled.get(key(name), name): word for name, word in answer.words}
    if len(names) == 1 and "" in given:
        given = {names[0]: given[""]}
    foreign = [name for name in given if name not in names]
    if foreign:
        return replace(
            base, fault=f"there is no matrix {foreign[0]}", expected=f"they are {', '.join(names)}"
        )
    entries = tuple(
        _entry(place, name, found, given.get(name, ""))
        for place, (name, found) in enumerate(zip(names, derived[answer.name], strict=True), 1)
    )
    undecided = [name for name, found in zip(names, derived[answer.name], strict=True)
                 if not isinstance(found, Definiteness)]  # fmt: skip
    if undecided:
        return replace(base, fault=f"{', '.join(undecided)} must be judged by a person", entries=entries)
    slips = tuple(dict.fromkeys(one for entry in entries for one in entry.diagnosis))
    return replace(base, verdict=worst([e.verdict for e in entries]), entries=entries, diagnosis=slips)


def _entry(place: int, name: str, found: object, word: str) -> EntryVerdict:
    if not isinstance(found, Definiteness):
        return EntryVerdict((place,), Verdict.UNREADABLE)
    if not word:
        return EntryVerdict((place,), Verdict.MISSING)
    if word == found.answer.value:
        return EntryVerdict((place,), Verdict.CORRECT)
    return EntryVerdict((place,), Verdict.WRONG, (_slip(name, found),))


def _slip(name: str, found: Definiteness) -> Diagnosis:
    if found.refusal is None:
        code = "definite_if" if found.conditions else "is_definite"
    else:
        code = f"refused_{found.refusal.name.lower()}"
    return SET_SLIPS[code].told(number=name)
