"""The key of each answer as the page of the queue sets it; a worker, which has derived it, makes it."""

from __future__ import annotations

from contextlib import suppress
from functools import partial

from dynsolve.answers.judge import Checker, Judge
from dynsolve.answers.sandbox import Stopped, limited
from dynsolve.answers.submission import Submission
from dynsolve.document import Document, Formula
from dynsolve.explain.context import style_of
from dynsolve.explain.forms import Forms
from dynsolve.notation.tree import Matrix, Node
from dynsolve.render.html import render

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
        node, entry = (name, ()) if name in checker.answer_ring.rules else (target.node, target.entry)
        if node in checker.answer_ring.rules:
            page = render(Document((Formula(_entry(forms(node), entry)),)), style)
            found[name] = page.partition("<main>")[2].partition("</main>")[0].strip()
    return {name: page for name, page in found.items() if len(page) <= _LONGEST}


def _entry(node: Node, entry: tuple[int, ...]) -> Node:
    if not entry or not isinstance(node, Matrix):
        return node
    row, column = (*entry, 0)[:2]
    return node.rows[row][column]
