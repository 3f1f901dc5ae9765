"""What a depth shows of a solution can be read by itself: no name, sentence or result is without its own."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cache
from itertools import pairwise

import pytest

from dynsolve.document import (
    Block,
    Equations,
    Fold,
    Formula,
    Heading,
    List,
    Picture,
    Prose,
    Table,
    Text,
    Uses,
)
from dynsolve.explain.sign_kinds import formulas_in, kind_of
from dynsolve.explain.step import Detail
from dynsolve.notation.printing import Style
from dynsolve.notation.tree import Letter, Node, Relation, Row, Symbol
from dynsolve.notation.unicode import to_unicode
from dynsolve.notation.walk import children, walk
from dynsolve.render.formats import Format
from dynsolve.render.page_ends import leads_on
from dynsolve.solution.documents import solution_document
from dynsolve.solution.reports import report
from tests.strangers.generator import stranger, written
from tests.support import solved

PROBLEMS = [
    "in3140-rp", "planar-2r", "elbow-3r", "spherical-rrp", "scara-rrpr", "cartesian-pp", "numeric-2r",
    "planar-2r-friction", "planar-2r-motors", "elastic-joint", "cart-pole", "five-bar",
    "planar-3r-redundant", "inf3480-rrp-drawn", "box-cylinder-rod-sphere", "knife-edge",
    *map(written, map(stranger, (1, 2, 3, 5))),
]  # fmt: skip
SHOWN = [(problem, detail) for problem in PROBLEMS for detail in Detail]


@cache
def blocks_of(problem: str, detail: Detail) -> tuple[Block, ...]:
    return solution_document(solved(problem), detail).blocks


def units(blocks: Iterable[Block]) -> Iterator[tuple[str, tuple[Block, ...]]]:
    """The steps and what stands between them, each with what it is called."""
    for block in blocks:
        if isinstance(block, Fold):
            yield block.title, block.blocks
        else:
            yield type(block).__name__, (block,)


# -- names -------------------------------------------------------------------------------------------


def signs(nodes: Iterable[Node], style: Style) -> set[Node]:
    """The names and letters of formulas, without their dots and what only counts."""
    found: set[Node] = set()
    pending = list(nodes)
    while pending:
        node = pending.pop()
        if kind_of(node, style):
            found.add(replace(node, dots=0) if isinstance(node, Letter | Symbol) and node.dots else node)
        elif not isinstance(node, Letter):
            pending += children(node)
    return found


def left_sides(nodes: Iterable[Node]) -> Iterator[Node]:
    yield from (part for node in walk(*nodes) if isinstance(node, Relation) for part in node.parts[:-1])


def in_words(blocks: Iterable[Block]) -> Iterator[Node]:
    for block in blocks:
        match block:
            case Text(parts) | Uses(_, parts):
                yield from (part for part in parts if isinstance(part, Node))
            case List(items):
                yield from (part for item in items for part in item if isinstance(part, Node))
            case Table(header, rows):
                yield from (cell for row in (header, *rows) for cell in row if isinstance(cell, Node))


def unintroduced(problem: str, detail: Detail) -> list[str]:
    style = solved(problem).style
    known: set[Node] = set()
    missing = []
    for title, blocks in units(blocks_of(problem, detail)):
        nodes = list(formulas_in(blocks))
        known |= signs((*in_words(blocks), *left_sides(nodes)), style)
        missing += [f"{title}: {to_unicode(sign, style)}" for sign in signs(nodes, style) - known]
        known |= signs(nodes, style)
    return missing
