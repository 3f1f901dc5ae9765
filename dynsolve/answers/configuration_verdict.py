"""The verdict of a set of configurations: singular ones, branches of the inverse kinematics."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from dynsolve.answers.diagnosis.slips.configurations import SET_SLIPS
from dynsolve.answers.judging.configurations import ConfigurationKey
from dynsolve.answers.submission import ConfigurationAnswer
from dynsolve.answers.verdict import JudgedAnswer, Verdict


def judged_set(key: ConfigurationKey, answer: ConfigurationAnswer, of: Fraction) -> JudgedAnswer:
    """What is said of a set; `of` are its marks."""
    base = JudgedAnswer(answer.name, Verdict.UNREADABLE, place=answer.place, read_as=answer.text, of=of)
    if answer.fault:
        return replace(base, fault=answer.fault, expected=answer.expected)
    if answer.name not in key.values:
        return replace(base, fault=f"{answer.name} is not asked for in this problem")
    if key.is_skipped(answer.name):
        return replace(base, fault=f"{answer.name} could not be derived here; a person must judge it")
    found = key.verdict(answer)
    if not found.is_right:
        slip = SET_SLIPS[found.code].told(number=str(found.number), where=found.where)
        return replace(base, verdict=Verdict.WRONG, diagnosis=(slip,))
    return replace(base, verdict=Verdict.CORRECT, notes=found.notes)
