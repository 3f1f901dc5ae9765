"""The verdict of a set of configurations: singular ones, branches of the inverse kinematics."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction

from dynsolve.answers.answer_verdict import MAY_FOLLOW, in_order
from dynsolve.answers.diagnosis.slips.configurations import SET_SLIPS
from dynsolve.answers.judging.configurations import ConfigurationKey
from dynsolve.answers.judging.explanation import Explanations
from dynsolve.answers.submission import ConfigurationAnswer
from dynsolve.answers.verdict import JudgedAnswer, Verdict


def judged_set(
    key: ConfigurationKey,
    answer: ConfigurationAnswer,
    of: Fraction,
    explanations: Explanations,
    unread: Mapping[str, str],
) -> JudgedAnswer:
    """What is said of a set; `of` are its marks, `unread` as in `Explanations.before`."""
    base = JudgedAnswer(answer.name, Verdict.UNREADABLE, place=answer.place, read_as=answer.text, of=of)
    if answer.fault:
        return replace(base, fault=answer.fault, expected=answer.expected)
    if answer.name not in key.values:
        return replace(base, fault=f"{answer.name} is not asked for in this problem")
    if key.is_skipped(answer.name):
        return replace(base, fault=f"{answer.name} could not be derived here; a person must judge it")
    found = key.verdict(answer)
    if found.is_right:
        return replace(base, verdict=Verdict.CORRECT, notes=found.notes)
    if zero := key.vanishing(answer.name):
        graph = explanations.hand_in.graph
        for own in explanations.own_values(zero):
            if key.is_where_zero(answer, own.value):
                return replace(base, verdict=Verdict.FOLLOWS, follows_from=in_order(graph, own.used))
        if sources := in_order(graph, explanations.before(zero, unread)):
            return replace(base, fault=MAY_FOLLOW.format(" and ".join(sources)))
    slip = SET_SLIPS[found.code].told(number=str(found.number), where=found.where)
    return replace(base, verdict=Verdict.WRONG, diagnosis=(slip,))
