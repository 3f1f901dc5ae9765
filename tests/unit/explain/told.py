"""What the steps of a solution say, show and work out, as text."""

from __future__ import annotations

from dynsolve.document import Prose, Reference
from dynsolve.explain.step import Step
from dynsolve.notation.unicode import to_unicode
from tests.support import STEMS, solved

SMALL = sorted(STEMS - {"puma560", "panda-7r", "stanford-6"})


def step(problem: str, id: str) -> Step:
    (found,) = (step for step in solved(problem).steps if step.id == id)
    return found


def said(prose: Prose, problem: str) -> str:
    style = solved(problem).style
    parts = (part for part in prose if not isinstance(part, Reference))  # as on a page without numbers
    return "".join(part if isinstance(part, str) else to_unicode(part, style) for part in parts)


def shown(problem: str, id: str) -> list[str]:
    return [to_unicode(node, solved(problem).style) for node in step(problem, id).result]


def everything_said(problem: str) -> str:
    parts = [said(text, problem) for step in solved(problem).steps for text in (step.why, *step.notes)]
    return "\n".join(parts + [step.title for step in solved(problem).steps])


def shown_working(problem: str, id: str) -> list[str]:
    return [to_unicode(node, solved(problem).style) for node in step(problem, id).working]


def formula(problem: str, id: str) -> str:
    node = step(problem, id).formula
    assert node is not None
    return to_unicode(node, solved(problem).style)
