"""What is given and what is to be found, before the solution."""

from __future__ import annotations

from typing import TypeGuard

import pytest

from dynsolve.document import Block, Text
from dynsolve.explain.statement import statement
from dynsolve.notation.unicode import to_unicode
from dynsolve.solution.documents import solution_document
from tests.support import solved

CASES = [
    (
        "in3140-rp",
        "Given: the table of the arm (1.1) and two bodies: body 1 in link 1, of mass m₁; "
        "body 2 in link 2, a point of mass m₂.",
        "To be found: the generalized forces 𝛕, the inertia matrix 𝐃, the matrix of Coriolis and centrifugal "
        "terms 𝐂 and the gravity terms 𝐠.",
    ),
    (
        "puma560",
        "Given: the table of the arm (1.1), and mass, mass centre and tensor of 6 bodies.",
        "To be found: the inertia matrix 𝐃, the matrix of Coriolis and centrifugal terms 𝐂, the gravity "
        "terms 𝐠 and the generalized forces 𝛕.",
    ),
    (
        "inf3480-rrp-drawn",
        "To be found: the Denavit-Hartenberg parameters, the task vector 𝐫, 𝐉_v, the determinant det 𝐉_r "
        "and the singular configurations.",
    ),
    (
        "knife-edge",
        "To be found: the generalized forces 𝛕, the inertia matrix 𝐃, the matrix of Coriolis and "
        "centrifugal terms 𝐂, the gravity terms 𝐠, the matrix of the constraints 𝐀_c, its rate 𝐀̇_c "
        "and the multipliers 𝛌.",
    ),
]


@pytest.mark.parametrize(("problem", "told"), [(name, told) for name, *told in CASES])
def test_the_exercise_is_stated_before_it_is_solved(problem: str, told: list[str]) -> None:
    solution = solved(problem)
    found = statement(solution.forms, solution.problem.find)
    texts = [
        "".join(part if isinstance(part, str) else to_unicode(part, solution.style) for part in text)
        for text in found
    ]
    assert texts == told


def test_a_part_of_a_solution_has_no_statement() -> None:
    def texts(stages: list[str] | None) -> str:
        document = solution_document(solved("planar-2r"), stages=stages)
        return "".join(block.parts[0] for block in document.blocks if is_words(block))

    assert "To be found: " in texts(None)
    assert "To be found: " not in texts(["jacobian"])


def is_words(block: Block) -> TypeGuard[Text]:
    return isinstance(block, Text) and isinstance(block.parts[0], str)
