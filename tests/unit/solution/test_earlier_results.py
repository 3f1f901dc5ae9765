"""References: every equation that a step uses, and no other."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import lru_cache

import pytest

from dynsolve.document import Block, Equations, Fold, Formula, Note, Prose, Reference, Text, Uses
from dynsolve.explain.step import Step
from dynsolve.notation.tree import Function, Letter, Node, Number, Relation, Row, Sum, Symbol, children
from dynsolve.notation.unicode import to_unicode
from dynsolve.render import markdown
from dynsolve.render.line_breaking import numbered
from dynsolve.solution.depths import labelled_results
from tests.support import ALL_PROBLEMS, document, solved

LONG = ["puma560", "stanford-6"]
SHORT = sorted({path.stem for path in ALL_PROBLEMS} - {*LONG, "panda-7r"})
PROBLEMS = [*SHORT, *(pytest.param(name, marks=pytest.mark.slow) for name in LONG)]


@lru_cache
def folds(problem: str) -> tuple[Fold, ...]:
    return tuple(steps_in(document(problem).blocks))


def steps_in(blocks: tuple[Block, ...]) -> Iterator[Fold]:
    """The steps, those of a group one by one."""
    for block in blocks:
        if isinstance(block, Fold):
            inner = tuple(steps_in(block.blocks))
            yield from inner or (block,)


def cited(problem: str, title: str) -> tuple[str, ...]:
    """The labels that the step of a title refers to, line by line."""
    uses = (block for block in fold_of(problem, title).blocks if isinstance(block, Uses))
    return tuple(dict.fromkeys(label for block in uses for label in block.labels))


def fold_of(problem: str, title: str) -> Fold:
    (fold,) = (fold for fold in folds(problem) if fold.title.split(" ", 1)[1] == title)
    return fold


# title of the step -> the labels of what stands in its formula
USED = [
    ("Column 2 of the Jacobian", ("axes-2", "axes-4")),  # z₁ × (o₃ - o₁): z₁, o₁ are in the second
    ("Jacobians of the mass centre of body 2", ("axes", "axes-2", "rc2")),
    ("Translational kinetic energy of body 2", ("v2",)),
    ("Rotational kinetic energy of body 1", ("w1", "I_body1")),  # about one of its axes
    ("Rotational kinetic energy of body 2", ("w2", "R2", "I_body2")),
    ("What body 2 adds to the inertia matrix: the linear part", ("Jv2",)),
    ("What body 2 adds to the inertia matrix: the rotational part", ("Jw2", "R2", "I_body2")),
    ("Coordinate 1: the torque", ("ddt1", "dLdq1")),
    ("Christoffel symbols", ("D", "names-ddt1", "names-ddt2")),
    ("The gravity terms, from the potential energy", ("P",)),
]


@pytest.mark.parametrize(("title", "labels"), USED)
def test_every_equation_that_is_used_is_cited(title: str, labels: tuple[str, ...]) -> None:
    assert cited("elbow-3r", title) == labels


def test_what_goes_in_is_named_before_it_is_put_in() -> None:
    kinds = [type(block).__name__ for block in fold_of("elbow-3r", "Column 1 of the Jacobian").blocks]
    assert kinds == ["Text", "Formula", "Uses", "Formula", "Formula"]


def test_what_goes_in_is_named_in_the_words_that_lead_on() -> None:
    blocks = fold_of("elbow-3r", "Coordinate 1: time derivative of the momentum").blocks
    (uses,) = (block for block in blocks if isinstance(block, Uses))
    assert uses == Uses(("dLdqd1",), ("Term by term:",))


def test_both_jacobians_are_defined_before_anything_is_put_in() -> None:
    _, linear, angular, uses, *_ = fold_of("elbow-3r", "Jacobians of the mass centre of body 2").blocks
    assert isinstance(linear, Formula) and isinstance(angular, Formula) and isinstance(uses, Uses)


def test_c_is_made_of_all_christoffel_symbols_that_stand_in_it() -> None:
    labels = cited("elbow-3r", "The Coriolis matrix, from the Christoffel symbols")
    assert labels == ("christoffel", *(f"christoffel-{k}" for k in range(2, 8)))


@pytest.mark.parametrize("problem", PROBLEMS)
def test_a_reference_is_to_an_equation_before_it(problem: str) -> None:
    page = document(problem)
    numbers = numbered(page)
    seen: set[str] = set()
    for fold in folds(problem):
        for block in fold.blocks:
            if isinstance(block, Uses):
                shown = [label for label in block.labels if label in numbers]
                assert set(shown) <= seen, fold.title
            elif isinstance(block, Formula | Equations) and block.label:
                seen.add(block.label)
    text = markdown.render(page)
    tags = {int(number) for number in re.findall(r"\\tag\{(\d+)\}", text)}
    cited_numbers = {
        int(n) for line in re.findall(r"^With .*", text, re.M) for n in re.findall(r"\((\d+)\)", line)
    }
    assert cited_numbers <= tags


@pytest.mark.parametrize("case", [1, 2])
def test_what_is_lost_refers_to_its_own_case(case: int) -> None:
    own = {1: "singular", 2: "singular-2"}[case]
    assert cited("inf3480-rpr", f"What is lost in case {case}") == ("Jr", own)


# -- every result that is used is referred to --------------------------------------------------------


def left_sides(node: Node) -> Iterator[Node]:
    """What an equation tells the value of, or several on one line; q_1 = 90°, sin q_1 = 1 is one of many."""
    for part in node.parts if isinstance(node, Row) else (node,):
        if isinstance(part, Relation) and not isinstance(part.parts[0], Symbol | Function | Sum):
            yield part.parts[0]


def right_sides(node: Node) -> Iterator[Node]:
    for part in node.parts if isinstance(node, Row) else (node,):
        yield from part.parts[1:] if isinstance(part, Relation) else (part,)


def references(prose: Prose) -> set[str]:
    return {label for part in prose if isinstance(part, Reference) for label in part.labels}


def cited_anywhere(step: Step, problem: str) -> set[str]:
    """The labels that a step refers to, in its sentences and before its formulas."""
    (fold,) = (fold for fold in folds(problem) if fold.title.split(" ", 1)[1] == step.title)
    labels: set[str] = set()
    for block in fold.blocks:
        match block:
            case Uses(uses, parts):
                labels.update(uses, references(parts))
            case Text(parts) | Note(parts):
                labels |= references(parts)
    return labels


def worked_with(step: Step) -> Iterator[Node]:
    """The formulas with this robot's quantities: right sides, those in letters left out."""
    for node in (*step.working, *(node for line in step.lines for node in line.formulas), *step.result):
        yield from right_sides(node)


def quantities_in(node: Node, told: Mapping[Node, object]) -> Iterator[Node]:
    """The quantities with a value of their own in a formula, the largest: ∂L/∂q̇, and not the L in it."""
    if node in told:
        yield node
    else:
        for child in children(node):
            yield from quantities_in(child, told)


IN_LETTERS = ("conserved",)
"""The steps whose lines hold of every robot: no value goes into them, as where it is one `whatever` it is."""


@pytest.mark.parametrize("problem", SHORT)
def test_whatever_a_line_uses_has_its_equation_named(problem: str) -> None:
    told: dict[Node, set[str]] = {}
    missing: list[str] = []
    own_entries = {Letter("d", Row((Number(i), Number(j)))): "D" for i in (1, 2, 3) for j in (1, 2, 3)}
    for step in solved(problem).steps:
        if step.id == "model":
            continue
        results = [*labelled_results(step)]
        results += [(node, line.label) for line in step.lines if line.label for node in line.formulas]
        own = {left for node, _ in results for left in left_sides(node)}
        labels = cited_anywhere(step, problem)
        if step.id not in IN_LETTERS and not any(
            "whatever " in str(part) for part in step.why if isinstance(part, str)
        ):
            for node in (part for formula in worked_with(step) for part in quantities_in(formula, told)):
                wanted = {own_entries[node]} if node in own_entries else told[node]
                if node not in own and not wanted & labels:
                    missing.append(f"{step.title}: {to_unicode(node)}")
        for node, label in results:
            for left in left_sides(node):
                told.setdefault(left, set()).add(label)
    assert missing == []
