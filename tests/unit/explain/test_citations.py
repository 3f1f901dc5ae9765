"""Sources: each book once in full, and every section one of its table of contents.

The course document (IN3140, dynamics overview) itself refers to 4.6.3 for the columns of the Jacobian, 7.2.1
for the moments of a rectangular solid and 7.3 for the model in matrix form.
"""

from __future__ import annotations

import re
from functools import lru_cache

import pytest

from dynsolve.document import Document, Text
from dynsolve.document.books import BOOKS, CRAIG, GEOMETRY, GIVEN, LYNCH_PARK, SPONG, spong
from dynsolve.explain.step import Detail, Step
from dynsolve.render.line_breaking import formulas
from tests.support import STEMS, document, solved

LONG = {"puma560", "panda-7r", "stanford-6"}
SHORT = sorted(STEMS - LONG)

# Spong, Hutchinson, Vidyasagar, Robot Modeling and Control, 2006: what stands in which section
CONTENTS = [
    ("A", "Forward Kinematics: The Denavit-Hartenberg Convention"),
    ("H2", "Kinematic Chains"),
    ("axes", "Derivation of the Jacobian"),
    ("J1", "Combining the Linear and Angular Velocity Jacobians"),
    ("rc2", "Rigid Motions"),
    ("I2", "The Inertia Tensor"),
    ("P1", "Potential Energy for an n-Link Robot"),
    ("P", "Potential Energy for an n-Link Robot"),
    ("v1", "Kinetic Energy for an n-Link Robot"),
    ("Kv1", "Kinetic and Potential Energy"),
    ("K", "Kinetic Energy for an n-Link Robot"),
    ("L", "The Euler-Lagrange Equations"),
    ("tau1", "The Euler-Lagrange Equations"),
    ("D_direct", "Kinetic Energy for an n-Link Robot"),
    ("christoffel", "Equations of Motion"),
    ("C", "Equations of Motion"),
    ("g", "Equations of Motion"),
    ("skew", "Skew Symmetry and Passivity"),
    ("model", "Equations of Motion"),
]


@lru_cache
def steps(problem: str) -> tuple[Step, ...]:
    return solved(problem).steps


def words(document: Document) -> str:
    """The words of a document outside its steps."""
    texts = (block.parts for block in document.blocks if isinstance(block, Text))
    return "\n".join(part for parts in texts for part in parts if isinstance(part, str))


@pytest.mark.parametrize(("id", "title"), CONTENTS)
def test_a_formula_is_in_the_section_that_is_named(id: str, title: str) -> None:
    (source,) = (step.source for step in steps("planar-2r") if step.id == id)
    assert SPONG.sections[source.removeprefix("§")] == title


@pytest.mark.parametrize("problem", SHORT)
def test_every_section_is_in_the_table(problem: str) -> None:
    """Nothing that is cited looks like the number of an equation or of a step."""
    for step in steps(problem):
        if step.source in (GEOMETRY, GIVEN):
            assert step.id.startswith(("rc", "R")), step.id
            continue
        book = next((b for b in BOOKS if b.name and b.name in step.source), SPONG)
        (number,) = re.findall(r"§([\d.]+)", step.source)
        assert number in book.sections, step.source


def test_no_section_is_named_that_does_not_have_the_formula() -> None:
    """§2.6 has p = R p + d, and neither a half of two origins nor a point that the problem gives."""
    sources = {step.id: step.source for step in steps("in3140-rp")}
    assert (sources["rc1"], sources["rc2"]) == (GEOMETRY, GIVEN)


def test_a_section_that_nobody_checked_is_an_error() -> None:
    with pytest.raises(KeyError, match="is not in the table"):
        spong("9.9")


@pytest.mark.parametrize(
    ("problem", "books"),
    [
        ("planar-2r", [SPONG]),
        ("rp-vertical", [SPONG, CRAIG]),
        ("box-cylinder-rod-sphere", [SPONG, LYNCH_PARK]),
    ],
)
def test_each_book_that_is_cited_is_named_once_in_full(problem: str, books: list[object]) -> None:
    page = document(problem, Detail.NORMAL)
    told = words(page)
    assert [book for book in BOOKS if book.full in told] == books
    assert all(told.count(book.full) == 1 for book in BOOKS if book in books)
    shown = [formula.source for formula in formulas(page.blocks)]
    assert not any("2006" in source or "Spong" in source for source in shown)


@pytest.mark.parametrize("detail", Detail)
def test_a_book_is_named_where_it_is_cited_and_no_other(detail: Detail) -> None:
    page = document("planar-2r", detail)
    sources = {formula.source for formula in formulas(page.blocks) if formula.source}
    assert bool(sources) == (detail > Detail.RESULTS)
    assert all(source.removeprefix("from ").startswith("§") for source in sources)
    assert [book for book in BOOKS if book.full in words(page)] == [SPONG] * bool(sources)


def test_json_names_the_book_with_each_section() -> None:
    step = solved("planar-2r").to_json()["steps"][0]
    assert step["source"] == "Spong et al. §3.2"
