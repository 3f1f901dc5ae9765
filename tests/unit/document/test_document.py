"""Documents are data: frozen, comparable, free of markup."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain, pairwise, takewhile
from typing import get_args

import pytest
from msgspec import Struct

import dynsolve
from dynsolve import document
from dynsolve.document import Block, Document, Fold, Formula, Heading, Text
from dynsolve.explain.abbreviations import Abbreviate
from dynsolve.explain.step import Detail
from dynsolve.notation.tree import Node, Relation, Row, walk
from dynsolve.quantities.stages import COURSE
from dynsolve.solution.depths import CHECKS
from dynsolve.solution.documents import solution_document
from dynsolve.solution.summary import TITLE
from tests.support import solved


@pytest.mark.parametrize("kind", get_args(Block), ids=lambda kind: kind.__name__)
def test_a_block_is_frozen_and_says_what_it_is(kind: type) -> None:
    assert issubclass(kind, Struct) and kind.__doc__
    assert kind.__struct_config__.frozen


def test_a_document_cannot_be_changed() -> None:
    page = Document((Heading("Energy"),))
    with pytest.raises(AttributeError, match="immutable"):
        page.blocks = ()  # type: ignore[misc]


def blocks_of(page: Document) -> list[Block]:
    found: list[Block] = []
    pending = list(page.blocks)
    while pending:
        block = pending.pop(0)
        found.append(block)
        pending += block.blocks if isinstance(block, Fold) else ()
    return found


def equations_of(page: Document) -> Iterator[tuple[Node, ...]]:
    """What is displayed, of a chain a = b = c the equations a = b and a = c."""
    for block in blocks_of(page):
        shown = (block.node,) if isinstance(block, Formula) else getattr(block, "nodes", ())
        for node in chain.from_iterable(one.parts if isinstance(one, Row) else (one,) for one in shown):
            if isinstance(node, Relation):
                yield from ((node.parts[0], part) for part in node.parts[1:])


@pytest.fixture(scope="module")
def solution() -> dynsolve.Solution:
    return dynsolve.solve("in3140-rp")


@pytest.fixture(scope="module")
def turned() -> dynsolve.Solution:
    """An arm whose tensors in base coordinates are a detail, its energies being worked out along own axes."""
    return dynsolve.solve("rp-vertical")


def test_a_level_of_detail_only_chooses(turned: dynsolve.Solution) -> None:
    """What is shown in brief is shown in full too: the same equations, of which others make one display."""
    shown = {detail: set(equations_of(solution_document(turned, detail))) for detail in Detail}
    for less, more in pairwise(sorted(Detail)):
        assert shown[less] < shown[more]


def test_stages_keep_their_numbers_when_shown_alone(solution: dynsolve.Solution) -> None:
    alone = blocks_of(solution_document(solution, stages=["torque"]))
    assert "6. The Euler-Lagrange equations" in [block.text for block in alone if isinstance(block, Heading)]
    titles = [block.title for block in alone if isinstance(block, Fold)]
    assert titles[0].startswith("6.1 ") and all(title.startswith("6.") for title in titles)


def test_no_markup_of_a_renderer_in_prose(solution: dynsolve.Solution) -> None:
    for block in blocks_of(solution_document(solution, Detail.FULL)):
        if isinstance(block, Text):
            words = "".join(part for part in block.parts if isinstance(part, str))
            assert not set("\\<>*{}$") & set(words), words


def test_every_name_is_public() -> None:
    assert document.Document.__struct_fields__ == ("blocks",)


def titles(solution: dynsolve.Solution, detail: Detail) -> list[str]:
    return [
        block.title for block in blocks_of(solution_document(solution, detail)) if isinstance(block, Fold)
    ]


def test_a_step_has_the_same_number_in_every_detail(turned: dynsolve.Solution) -> None:
    full, normal = (titles(turned, detail) for detail in (Detail.FULL, Detail.NORMAL))
    assert {title for title in normal if not title.endswith(CHECKS)} < set(full)
    assert "3.2.3 Inertia tensor of body 1 in base coordinates" in full
    last = [int(title.split()[0].split(".")[1]) for title in normal if title.startswith("3.")]
    assert last == list(range(1, len(last) + 1))


def test_no_heading_stands_over_nothing(solution: dynsolve.Solution) -> None:
    for detail in Detail:
        blocks = solution_document(solution, detail).blocks
        for block, below in pairwise(blocks):
            assert not (isinstance(block, Heading) and isinstance(below, Heading))


def test_in_brief_every_stage_has_its_result(solution: dynsolve.Solution) -> None:
    for stage in COURSE:
        assert any(
            isinstance(block, Formula)
            for block in blocks_of(solution_document(solution, Detail.BRIEF, [stage]))
        )


@pytest.mark.parametrize(
    "problem, stages", [("spherical-rrp", None), ("spherical-rrp", ["lagrangian"]), ("elbow-3r", ["torque"])]
)
def test_in_brief_each_name_is_defined_before_it_is_used(problem: str, stages: list[str] | None) -> None:
    """Where the step that defines it is not shown too; the summary tells all names once more."""
    short = solved(problem).abbreviated(Abbreviate.AUTO)
    assert short is not None
    undefined = {one.name for one in short.definitions}
    page = solution_document(solved(problem), Detail.BRIEF, stages)
    before = takewhile(lambda block: block != Heading(TITLE, closing=True), page.blocks)
    for left, right in equations_of(Document(tuple(before))):
        assert undefined.isdisjoint(walk(right))
        undefined.discard(left)
    assert not undefined


def test_in_brief_a_result_stands_with_the_formula_that_it_comes_from(solution: dynsolve.Solution) -> None:
    """H, J, the bodies, the energies, L, the forces, D, C and g; the table is what all begins with."""
    for fold in solution_document(solution, Detail.BRIEF).blocks:
        if isinstance(fold, Fold) and not fold.title.startswith("1.1 "):
            first = fold.blocks[0]
            assert isinstance(first, Formula) and first.source and not first.label, fold.title


TYPED = r"2m₁ q_1 $x$ `b` <i> \frac{1}{2} | # 50%"


@pytest.mark.parametrize("form", ["html", "latex", "markdown", "terminal", "typst"])
def test_what_somebody_typed_stays_as_it_was_typed(form: str) -> None:
    from importlib import import_module

    renderer = import_module(f"dynsolve.render.{form}")
    render = renderer.to_typst_document if form == "typst" else renderer.render
    shown = render(Document((Heading("Title", 1), Text(("Read: ", document.Verbatim(TYPED))))))
    page = "\n".join(line.text for line in shown) if form == "terminal" else shown
    assert {
        "html": '<code dir="auto">2m₁ q_1 $x$ `b` &lt;i&gt; \\frac{1}{2} | # 50%</code>',
        "latex": r"\texttt{2m1 q\_1 \$x\$ ",
        "markdown": f"`` {TYPED} ``",
        "terminal": f"Read: {TYPED}",
        "typst": '#raw("2m₁ q_1 $x$ `b` <i> \\\\frac{1}{2} | # 50%");',
    }[form] in page
