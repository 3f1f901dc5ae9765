"""A sentence that holds for every body or coordinate stands once; what differs is said each time."""

from __future__ import annotations

import pytest

from dynsolve.document import Document, Fold, Reference, Text
from dynsolve.explain.step import Detail
from dynsolve.notation.unicode import to_unicode
from dynsolve.solution.documents import solution_document
from tests.support import solved


def said(document: Document) -> dict[str, str]:
    """The first sentences of each step, by its title without its number."""
    found = {}
    for fold in document.blocks:
        if isinstance(fold, Fold) and fold.blocks and isinstance(fold.blocks[0], Text):
            parts = fold.blocks[0].parts
            found[fold.title.partition(" ")[2]] = "".join(
                part if isinstance(part, str) else to_unicode(part)  # type: ignore[arg-type]
                for part in parts
                if not isinstance(part, Reference)  # as on a page without numbers
            )
    return found


# title -> how what it says begins
ELBOW = [
    ("Potential energy of body 1", "g₀ is the acceleration of gravity"),
    ("Potential energy of body 3", "η₃ is the third entry"),  # as short as a reference
    ("Column 2 of the Jacobian", "As for column 1."),  # about z₁ and o₁ in place of z₀ and o₀
    ("Translational kinetic energy of body 2", "Half the mass"),  # the mass centre of body 1 does not move
    ("Translational kinetic energy of body 3", "As for body 2."),
    ("Coordinate 3: generalized momentum", "As for coordinate 1."),
    ("Coordinate 2: time derivative of the momentum", "Everything that changes"),  # other rates than for 1
    ("Coordinate 3: time derivative of the momentum", "As for coordinate 2."),
    ("Coordinate 3: the torque", "θ₃ is an angle"),  # as short as a reference
]


@pytest.fixture(scope="module")
def elbow() -> dict[str, str]:
    return said(solution_document(solved("elbow-3r")))


@pytest.mark.parametrize(("title", "begins"), ELBOW)
def test_what_holds_for_several_is_said_once(title: str, begins: str, elbow: dict[str, str]) -> None:
    assert elbow[title].startswith(begins)


@pytest.mark.parametrize("name", ["elbow-3r", "inf3480-rpr"])
def test_no_long_sentence_stands_twice_and_references_lead_to_what_is_shown(name: str) -> None:
    solution = solved(name)
    for detail in (Detail.NORMAL, Detail.FULL):
        sentences = said(solution_document(solution, detail))
        long = [text for text in sentences.values() if len(text) > 60]
        assert len(long) == len(set(long))
        for title, text in sentences.items():
            if text.startswith("As for ") and len(text) < 30:
                assert any(text[7:-1] in other.lower() for other in sentences if other != title)
