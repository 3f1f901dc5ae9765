"""`edition`: by which edition of the course's book the sections are counted."""

from __future__ import annotations

import re

import pytest

import dynsolve
from dynsolve.document import Document, Fold, Formula, Text
from dynsolve.explain.step import Detail
from dynsolve.explain.writing import SPONG
from dynsolve.solution.documents import solution_document

ARM = """
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses:
  - {mass: m1, link: 1, center: midpoint, inertia: {zz: I1}}
  - {mass: m2, link: 2, center: tip, shape: point}
springs: [{stiffness: k, of: q1}]
task: [tip.x, tip.y]
find: [tau, inverse]
"""


def sources(document: Document) -> list[str]:
    """The references beside formulas and in sentences, in order."""
    blocks = [
        inner
        for block in document.blocks
        for inner in (block.blocks if isinstance(block, Fold) else (block,))
    ]
    told = [block.source for block in blocks if isinstance(block, Formula)]
    words = (
        part for block in blocks if isinstance(block, Text) for part in block.parts if isinstance(part, str)
    )
    return [*told, *(reference for text in words for reference in re.findall(r"§[0-9.]*[0-9]", text))]


@pytest.mark.parametrize("detail", Detail)
def test_the_second_edition_has_dynamics_in_its_chapter_6(detail: Detail) -> None:
    first = sources(solution_document(dynsolve.solve(ARM), detail))
    second = sources(solution_document(dynsolve.solve("edition: 2" + ARM), detail))
    assert len(first) == len(second)
    for one, other in zip(first, second, strict=True):
        if "Siciliano" in one or not re.search(r"§[37]", one) or re.search(r"§3\.[12]", one):
            assert other == one
        else:
            assert other == one.replace("§7.", "§6.").replace("§3.3.", "§5.").replace("§3.3", "§5")


@pytest.mark.parametrize(("edition", "year"), [("", "2006"), ("edition: 2", "2020")])
def test_the_edition_is_named_and_in_full_its_sections_have_titles(edition: str, year: str) -> None:
    page = dynsolve.solve(edition + ARM).to_markdown("full")
    assert year in page and ("1st" in page) != ("2nd" in page)
    chapter = "6" if edition else "7"
    assert f"§{chapter}.1 {SPONG.sections['7.1']}" in page


def test_a_hint_has_the_sections_of_the_edition() -> None:
    assert sources(dynsolve.solve("edition: 2" + ARM).hint("energy"))
    assert not any(
        "§7" in source and "Siciliano" not in source
        for source in sources(dynsolve.solve("edition: 2" + ARM).hint("energy"))
    )
