"""Sentences as claims: true ones pass, planted false ones are found, and none goes unheld."""

from __future__ import annotations

from itertools import product

import pytest

from dynsolve.document import Block, Fold, Formula, Heading, Text
from dynsolve.document.sentences import Value, say
from dynsolve.explain.abbreviations import Abbreviate
from dynsolve.explain.step import Detail
from dynsolve.explain.writing import listed
from dynsolve.notation.tree import (
    Derivative,
    Function,
    Letter,
    Matrix,
    Negative,
    Node,
    Number,
    Relation,
    Sum,
    Symbol,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.solution.documents import solution_document
from tests.strangers.claims import untrue_sentences
from tests.strangers.mechanism import Mechanism
from tests.strangers.test_strangers import ELBOW
from tests.support import ROOT, solved

LEVEL = ELBOW.replace("[0, -g, 0]", "[0, 0, -g]")
NEAR_HALF = ELBOW.replace("{near: [lc1, 0, 0]}", "{near: [l1/3, 0, 0]}")
TASK = "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\ntask: [tip.x, tip.y]\nfind: [Jr, singular]"
SPARE = (
    "gravity: none\ndh: [{theta: q1*, alpha: 90deg}, {theta: q2*, a: a}, {theta: q3*, a: b}, {theta: q4*}, "
    "{theta: q5*, a: e}]\ntask: pose\nfind: [inverse]"
)
SLIDING = (
    "gravity: [-g, 0, 0]\ndh: [{d: q1*, alpha: 90deg}, {d: q2*}, {theta: q3*, a: l}]\n"
    "masses: [{mass: m, link: 3}]"
)
INDEFINITE = "model:\n  {coordinates: {q1: revolute, q2: revolute}, D: [[a, 2*b], [2*b, a]]}"

Q1, Q2, D3 = Symbol("q1"), Symbol("q2"), Symbol("d3")
MASS, ZERO, L = Symbol("m1"), Number(0), Letter("L", style="script")
BENT, STRETCHED = (equation(Function(name, Q2), ZERO) for name in ("cos", "sin"))
TAU_1, TAU_2 = (equation(Letter("tau", Number(i)), ZERO) for i in (1, 2))
TAU = equation(letters.TAU, letters.bold("0"))
P_1, J_R = Derivative(L, Symbol("q1", 1)), letters.bold("J", Symbol("r"))
C_111, C_211 = (letters.entry("c", i, 1, 1) for i in (1, 2))
D_11, D_33 = (letters.entry("d", i, i) for i in (1, 3))

SLIDES = "{q} moves everything after it along the axis {z}."
CENTER = "The column of each joint, taken at the mass centre; {q} does not move it."
HALF_WAY = "The mass centre of body 1 is {part} of the way along link 1, from {o} to {e}."
MASS_MOVED = "{d} is constant: of all that joint 3 moves, it is the mass."
ENERGY = "The energy changes by the power of {t} alone: as long as {c} it is conserved."
MOMENTUM = (
    "As long as {tau}, the Euler-Lagrange equation says that the momentum {p} (the angular momentum of the "
    "arm about {z}) is conserved."
)
RANK = "{J} is 2×2, and its rank is at most {i}."
HANGS = "At {e}: {stable}, but for {q}, along which nothing changes."

KEPT = "What is asked must have {c}: no joint moves this."
SLID = "{none}: sliding along a level axis changes no height."
G_1, G_2, G_3 = (equation(letters.entry("g", i), ZERO) for i in (1, 2, 3))

PLANTED: list[tuple[str, str, str, dict[str, Value], dict[str, Value]]] = [
    (ELBOW, "", SLIDES, {"q": D3, "z": letters.z(2)}, {"z": letters.z(3)}),
    (ELBOW, "", SLIDES, {"q": D3, "z": letters.z(0)}, {"q": Q2}),
    (ELBOW, "body 2", CENTER, {"q": D3}, {"q": Q2}),
    (ELBOW, "body 2", "The speed does not depend on {q}.", {"q": Q1}, {"q": Q2}),
    (
        NEAR_HALF,
        "",
        HALF_WAY,
        {"part": Number(1, 3), "o": letters.o(0), "e": letters.o(1)},
        {"part": Number(1, 2)},
    ),
    (ELBOW, "", "{c} is zero.", {"c": C_111}, {"c": C_211}),
    (ELBOW, "", MASS_MOVED, {"d": D_33}, {"d": D_11}),
    (ELBOW, "", "{q} does not appear in ℒ: a cyclic coordinate.", {"q": D3}, {"q": Q1}),
    (ELBOW, "", ENERGY, {"t": letters.TAU, "c": TAU}, {"c": TAU_1}),
    (LEVEL, "", MOMENTUM, {"tau": TAU_1, "p": P_1, "z": letters.z(0)}, {"z": letters.z(1)}),
    (LEVEL, "", MOMENTUM, {"tau": TAU_1, "p": P_1, "z": letters.z(0)}, {"tau": TAU_2}),
    (TASK, "", RANK, {"J": J_R, "i": 2}, {"i": 1}),
    (TASK, "", "Where {c}, the rank is 1 instead of 2.", {"c": STRETCHED}, {"c": BENT}),
    (SPARE, "", KEPT, {"c": equation(Symbol("r33"), ZERO)}, {"c": equation(Symbol("r32"), ZERO)}),
    (SLIDING, "", SLID, {"none": listed([G_1, G_2])}, {"none": listed([G_1, G_3])}),
    ("crane", "", HANGS, {"e": equation(Q2, ZERO), "stable": "stable", "q": Q1}, {"stable": "not stable"}),
]
"""Problem, title of the step, sentence, its values, and those with which it is false."""


def wrong(problem: str, title: str, *blocks: Block) -> list[str]:
    """What is wrong with the sentences of a step."""
    solution = solved(problem)
    document = solution_document(solution, Detail.FULL, None, Abbreviate.NEVER)
    step = (Heading("A planted step"), Fold(title, blocks))
    return [why for _, why in untrue_sentences(Mechanism(solution, document, 1), step)]


@pytest.mark.parametrize(("problem", "title", "text", "true", "false"), PLANTED)
def test_a_false_sentence_is_found(
    problem: str, title: str, text: str, true: dict[str, Value], false: dict[str, Value]
) -> None:
    assert wrong(problem, title, Text(say(text, **true))) == []
    assert wrong(problem, title, Text(say(text, **true | false))) == ["is not true"]


@pytest.mark.parametrize(
    ("problem", "text"),
    [
        (ELBOW, "$𝐃$ is constant, so every Christoffel symbol is zero."),
        (ELBOW, "Here it is diagonal: no acceleration enters the force of another coordinate."),
        (ELBOW, "It does not depend on any coordinate, so $𝐠$ is zero."),
        (INDEFINITE, "So $𝐃$ is positive definite."),
        ("scara-rrpr", "All other entries are zero, so $𝐃$ is positive definite."),
    ],
)
def test_a_sentence_that_holds_of_other_mechanisms_is_found(problem: str, text: str) -> None:
    assert wrong(problem, "", Text(say(text))) == ["is not true"]


@pytest.mark.parametrize(("term", "is_true"), [(MASS, True), (Negative(MASS), False)])
def test_a_negative_term_is_found(term: Node, is_true: bool) -> None:
    shown = Formula(equation(letters.entry("d", 1, 1), Sum((Symbol("I1"), term))))
    said = Text(
        say("In the last expression no term is negative, and {more}.", more=Relation((MASS, ZERO), (">",)))
    )
    assert wrong(ELBOW, "", shown, said) == ([] if is_true else ["is not true"])


@pytest.mark.parametrize(("last", "is_true"), [(-1, True), (1, False)])
def test_of_minors_it_is_held_that_not_all_are_positive(last: int, is_true: bool) -> None:
    shown = Formula(equation(letters.D, Matrix(((Number(1), ZERO), (ZERO, Number(last))))))
    minors = listed([Letter("Delta", Number(k)) for k in (1, 2)])
    said = Text(say("{minors} are not both positive in every configuration.", minors=minors))
    assert wrong(ELBOW, "", shown, said) == ([] if is_true else ["is not true"])


def test_a_claim_that_nothing_holds_is_found() -> None:
    assert wrong(ELBOW, "", Text(("The arm never moves at all.",))) == ["a claim that nothing holds"]


PROBLEMS = sorted(
    path.stem for path in (ROOT / "problems").glob("*.yaml") if path.stem not in ("panda-7r", "puma560")
)


@pytest.mark.parametrize("name", PROBLEMS)
def test_what_the_library_says_is_true(name: str) -> None:
    solution = solved(name)
    document = solution_document(solution, Detail.FULL, None, Abbreviate.NEVER)
    found = untrue_sentences(Mechanism(solution, document, 1), document.blocks)
    assert [f"{sentence.where}: {why}: {sentence}" for sentence, why in found] == []


def test_what_is_said_with_constraints_is_held() -> None:
    """The energy of a skate on a slope without motors, and of one that friction brakes."""
    skate = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, y: prismatic, phi: revolute}
  bodies: [{mass: m, at: [x, y, 0], turn: phi, inertia: {zz: J}}]
constraints: [{rates: x'*sin(phi) - y'*cos(phi)}]
passive: [x, y, phi]
find: [D, Ac]
"""
    text = Text(("No motor drives: the energy is conserved. ",))
    assert wrong(skate, "", text) == []
    assert wrong(f"{skate}friction: {{x: b}}\n", "", text) == ["is not true"]


BRANCHES = """
convention: standard
dh:
  - {theta: q1*, a: a1, alpha: 90deg}
  - {theta: q2*, a: a2}
  - {theta: q3*, a: a3, from: 1}
masses:
  - {mass: m2, link: 2, center: midpoint, inertia: {zz: J2}}
  - {mass: m3, link: 3, center: midpoint, inertia: {zz: J3}}
"""
MOTOR = BRANCHES + "motors: [{turns: q2, inertia: Jm, ratio: n, carrier: 1}]\n"


@pytest.mark.parametrize(
    ("problem", "text", "is_true"),
    [
        (BRANCHES, "all that joint {joint} moves", True),
        (MOTOR, "all that joint {joint} moves", False),
        (MOTOR, "the bodies that joint {joint} moves, with what the rotor adds", True),
    ],
)
def test_a_reflected_inertia_is_no_moment_of_inertia_of_what_moves(
    problem: str, text: str, is_true: bool
) -> None:
    """And the axis of a joint on a branch is that of the row it starts from."""
    theorem = ": in simple poses the parallel-axis theorem gives the same"
    entries = {2: letters.entry("d", 2, 2), 3: letters.entry("d", 3, 3)}
    for joint, ending in product((2, 3) if is_true else (2,), ("", theorem)):
        words = f"{{d}} is the moment of inertia of {text}{ending}."
        told = Text(say(words, d=entries[joint], joint=str(joint)))
        assert wrong(problem, "", told) == ([] if is_true else ["is not true"])


def test_the_rank_is_that_of_the_jacobian_whose_singular_configurations_are_told() -> None:
    """Of a spherical wrist on an arm with a slide all six rows, and not those of the tip alone."""
    wrist = """
gravity: none
dh:
  - {theta: q1*, d: h, alpha: -90deg}
  - {theta: q2*, alpha: 90deg}
  - {d: q3*}
  - {theta: q4*, alpha: -90deg}
  - {theta: q5*, alpha: 90deg}
  - {theta: q6*}
find: [det, singular]
"""
    solution = solved(wrist)
    document = solution_document(solution, Detail.FULL, None, Abbreviate.NEVER)
    assert not list(untrue_sentences(Mechanism(solution, document, 1), document.blocks))


def test_the_lesser_rank_of_a_part_of_a_singular_set_is_told() -> None:
    """Two links alike that are folded: the joints between leave the tip where it is."""
    arm = """
gravity: none
dh: [{theta: q1*, d: h, alpha: 90deg}, {theta: q2*, a: l}, {theta: q3*, a: l}, {theta: q4*, alpha: 90deg}]
task: [tip.x, tip.y, tip.z, q2 + q3 + q4]
find: [singular]
"""
    solution = solved(arm)
    document = solution_document(solution, Detail.FULL, None, Abbreviate.NEVER)
    told = "the rank is in general 3 instead of 4. Where $q_{3} = 180^{\\circ}$, the rank is 2."
    assert told in " ".join(solution.to_markdown().split())
    assert list(untrue_sentences(Mechanism(solution, document, 1), document.blocks)) == []
