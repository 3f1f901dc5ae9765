"""A solution has the sections that lead to what is asked, and no others; `full` has them all."""

from __future__ import annotations

import pytest

from dynsolve.document import Heading
from dynsolve.explain.step import Detail, Step
from dynsolve.quantities.stages import Stage
from dynsolve.solution.documents import solution_document
from dynsolve.solution.leading import leading, needs_forces
from tests.support import solved

ARM = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
task: [tip.x, tip.y]
find: [%s]
"""
_KINEMATICS = ["Forward kinematics"]
_TASK = ["Points and tasks", "Singular configurations"]
_ENERGY = ["The Jacobian", "The bodies: mass centres and inertia", "Potential and kinetic energy"]
_FORCES = ["The Lagrangian", "The Euler-Lagrange equations"]


def _sections(find: str, detail: Detail = Detail.NORMAL) -> list[str]:
    blocks = solution_document(solved(ARM % find), detail).blocks
    headings = [block.text for block in blocks if isinstance(block, Heading) and block.level == 2]
    return [text.partition(". ")[2] for text in headings if text[0].isdigit()]


@pytest.mark.parametrize(
    ("find", "sections"),
    [
        ("r", [*_KINEMATICS, "Points and tasks"]),
        ("singular", [*_KINEMATICS, *_TASK]),
        ("inverse", [*_KINEMATICS, "Points and tasks", "Inverse kinematics"]),
        ("J", [*_KINEMATICS, "The Jacobian"]),
        ("K", [*_KINEMATICS, *_ENERGY]),
        ("P", [*_KINEMATICS, *_ENERGY]),
        ("tau1", [*_KINEMATICS, *_ENERGY, *_FORCES]),
        ("tau, singular", [*_KINEMATICS, _ENERGY[0], *_TASK, *_ENERGY[1:], *_FORCES]),
        ("tau, D", [*_KINEMATICS, *_ENERGY, *_FORCES, "The matrix form"]),
        ("D", [*_KINEMATICS, *_ENERGY, "The matrix form"]),
        ("D, C, g", [*_KINEMATICS, *_ENERGY, "The matrix form"]),
    ],
)
def test_a_section_leads_to_what_is_asked(find: str, sections: list[str]) -> None:
    assert _sections(find) == sections


@pytest.mark.parametrize(
    "acting", ["", "friction: {q1: {viscous: b}}\n", "springs: [{stiffness: k, of: q2}]\n"]
)
@pytest.mark.parametrize("find", ["D", "D, C, g", "Lambda", "D, g"])
def test_without_forces_to_find_the_inertia_is_read_off_from_the_energy(find: str, acting: str) -> None:
    """Spong, Hutchinson, Vidyasagar (2006), section 7.3: D from K, C from D, g from P."""
    text = acting + ARM % find
    (D,) = (one for one in _steps(text) if one.id == "D")
    assert D.uses == ("K",)
    ids = {one.id for one in _steps(text)}
    assert ids.isdisjoint({"L", "dLdqd1", "ddt1", "dLdq1", "tau1", "Cqd"})
    assert ("friction" in ids) is ("friction" in acting and "C" in find)
    assert "tau1" in {one.id for one in solved(text).steps}


def _steps(text: str) -> tuple[Step, ...]:
    solution = solved(text)
    steps = tuple(solution.explain())
    assert not needs_forces(solution, steps)
    return leading(solution, tuple(solution.explain(by_energies=True)))


def test_full_has_every_section() -> None:
    assert _sections("r", Detail.FULL)[-1] == "The matrix form"


def test_of_energy_alone_no_step_is_told_that_nothing_needs() -> None:
    solution = solved(ARM % "g")
    told = leading(solution, solution.steps)
    assert [step.id for step in told if step.stage is Stage.ENERGY] == ["P1", "P2", "P"]
    assert [step.id for step in told if step.stage is Stage.VECTORIZED] == ["g"]


def test_of_a_whole_model_every_step_is_told() -> None:
    solution = solved(ARM % "tau, D, C, g")
    assert {step.id for step in solution.steps} - {
        step.id for step in leading(solution, solution.steps)
    } == set()


def test_without_g_it_is_a_whole_model_where_nothing_pulls() -> None:
    level = (ARM % "tau, D, C").replace("gravity: [0, -g, 0]", "gravity: none")
    assert level != ARM % "tau, D, C"
    for text, is_whole in ((level, True), (ARM % "tau, D, C", False)):
        solution = solved(text)
        assert ("model" in {step.id for step in leading(solution, solution.steps)}) is is_whole
