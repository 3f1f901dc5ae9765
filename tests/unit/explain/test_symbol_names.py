"""Names for Christoffel symbols: C, Ḋ, N and the terms of the forces mean the same with them."""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator
from functools import cache
from typing import Any

import pytest

import dynsolve
from dynsolve.document import DEFINITIONS, Block, Table, Text
from dynsolve.errors import ExplanationWarning
from dynsolve.explain import vectorized
from dynsolve.explain.abbreviations import Abbreviate, Abbreviated
from dynsolve.explain.context import Context
from dynsolve.explain.entry_formulas import collected_coriolis_force
from dynsolve.explain.step import Detail, Step
from dynsolve.notation.build import summands
from dynsolve.notation.tree import Letter, Matrix, Node, Number, Relation, Row, Symbol, walk, with_children
from dynsolve.notation.tree_values import evaluate
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem import load
from dynsolve.problem.reader import find
from dynsolve.quantities import letters
from dynsolve.render.line_breaking import unfolded
from dynsolve.robot.questions import Method
from dynsolve.solution.documents import solution_document
from dynsolve.solution.dynamics import by_method
from dynsolve.solution.solution import Solution
from tests.support import document, solved
from tests.unit.explain.test_abbreviated_steps import displayed

NAMED = ("elbow-3r", "box-cylinder-rod-sphere", "spherical-rrp")
WITH_H = ("planar-2r", "crustcrawler-2r", "five-bar")


def named(problem: str) -> Abbreviated:
    short = solved(problem).abbreviated("auto")
    assert short is not None
    return short


@cache
def steps(problem: str) -> dict[str, Step]:
    return {step.id: step for step in solved(problem).explain(short=named(problem))}


def known(problem: str) -> dict[str, float]:
    """A state, and the values of the names there."""
    solution, draw = solved(problem), random.Random(3)
    values = {name: draw.uniform(0.5, 1.5) for name in solution.robot.ring.parameters}
    for q in solution.robot.coordinates:
        values |= {name: draw.uniform(-1, 1) for name in (q.name, q.velocity, q.acceleration)}
    for definition in named(problem).definitions:
        values[definition.name.name] = evaluate(definition.meaning, values)
    return values


SLIDING = """
title: a slider on two joints
gravity: none
dh: [{theta: q1*, a: %s}, {theta: q2* + 90deg, alpha: 90deg}, {d: q3*}]
masses:
  - {mass: m, link: 3, center: [0, 0, -l/2], shape: {rod: {length: l, axis: z}}}
  - {mass: M, link: 1, center: tip}
"""


def test_rates_beside_a_name_are_a_product_where_they_are_one() -> None:
    single = dynsolve.solve(SLIDING % 0).abbreviated("auto")
    assert single is not None

    def c(i: int, j: int, k: int) -> Node:
        return single.christoffel[min(i, j), max(i, j), k]

    forces = [to_unicode(collected_coriolis_force(("q1", "q2", "q3"), c, k)) for k in range(3)]
    assert forces == ["2h q̇₃ (q̇₁ + q̇₂)", "2h q̇₃ (q̇₁ + q̇₂)", "-h (q̇₁ + q̇₂)²"]
    several = dynsolve.solve(SLIDING % "a").abbreviated("auto")
    assert several is not None
    assert "2σ₂ q̇₃ (q̇₁ + q̇₂) - σ₁ (2q̇₁ q̇₂ + q̇₂²)" in to_unicode(several.forms["tau1"])


def assert_same(ours: Any, theirs: Any) -> None:
    for row, other in zip(ours, theirs, strict=True):
        assert row == pytest.approx(other)


def test_the_elbow_has_three_names() -> None:
    """As c_221 and others of the planar elbow are ±h in Spong, Hutchinson, Vidyasagar, section 7.4."""
    style, short = solved("elbow-3r").style, named("elbow-3r")
    assert [to_unicode(one.name, style) for one in short.definitions] == ["σ₁", "σ₂", "σ₃"]
    assert to_unicode(short.definitions[2].meaning, style) == "m₃ L₂ l_c3 s₃"
    assert to_unicode(short.C, style) == (
        "[[-σ₁ θ̇₂ - σ₂ θ̇₃, -σ₁ θ̇₁, -σ₂ θ̇₁], [σ₁ θ̇₁, -σ₃ θ̇₃, -σ₃ (θ̇₂ + θ̇₃)], [σ₂ θ̇₁, σ₃ θ̇₂, 0]]"
    )


GYROPENDULUM = """
gravity: [0, 0, -g]
model:
  coordinates: {psi: revolute, th: revolute, phi: revolute}
  bodies:
    - mass: m
      at: [l*sin(th)*cos(psi), l*sin(th)*sin(psi), -l*cos(th)]
      turn: [{by: psi, about: [0, 0, 1]}, {by: -th, about: [0, 1, 0]}, {by: phi, about: [0, 0, 1]}]
      inertia: {xx: A, yy: A, zz: C}
"""

FOUR_LINKS = """
gravity: [0, -g, 0]
model:
  coordinates: {a: revolute, r: prismatic, b: revolute, p: prismatic}
  bodies:
    - {mass: m1, at: [r*cos(a), r*sin(a), 0]}
    - {mass: m2, at: [r*cos(a) + p*cos(b), r*sin(a) + p*sin(b), 0]}
"""


@pytest.mark.parametrize(
    ("problem", "meanings"),
    [
        (GYROPENDULUM, ["(m l² + A - C) sin(θ) cos(θ)"]),  # twice C sin(θ)/2 is as long as its name
        (FOUR_LINKS, ["m₂ r p sin(b - a)"]),  # m₂ p cos(b - a) stands in D
    ],
)
def test_what_is_short_or_stands_in_D_has_no_name(problem: str, meanings: list[str]) -> None:
    style = solved(problem).style
    assert [to_unicode(one.meaning, style) for one in named(problem).definitions] == meanings


def test_a_part_of_a_symbol_is_written_by_its_name() -> None:
    """c_221 of the first joints of a Puma is a sum of which c_231 is a part."""
    style, short = solved("puma560-first3").style, named("puma560-first3")
    own = {to_unicode(one.name, style): to_unicode(one.meaning, style) for one in short.definitions}
    assert own["σ₇"] == "(m₂ y₂ z₂ - I_2yz) s₂ - σ₃ c₂ + σ₆"
    assert [to_unicode(short.symbol(*ijk), style) for ijk in ((1, 2, 0), (1, 1, 0))] == ["σ₆", "σ₇"]


def test_what_is_named_in_the_energies_is_in_the_symbols() -> None:
    """c_131 of the box and the rod is c_232 times c₂²; both are short by the names of `inertia_names`."""
    style, short = solved("box-cylinder-rod-sphere").style, named("box-cylinder-rod-sphere")
    symbols = [to_unicode(short.symbol(*ijk), style) for ijk in ((0, 2, 0), (1, 2, 1), (0, 1, 0))]
    assert symbols == ["σ₃ c₂²", "σ₃", "-σ₁ s₂ c₂"]


@pytest.mark.parametrize("problem", [*NAMED, *WITH_H])
def test_the_rows_of_the_summary_are_in_the_names(problem: str) -> None:
    """d_kj q̈_j + the names + g_k come to the forces, which are the rows where they are in the names."""
    solution, values = solved(problem), known(problem)
    D, g = evaluate(solution.forms("D"), values), evaluate(solution.forms("g"), values)
    n = solution.robot.n
    for i in range(n):
        values |= {f"d{i + 1}{j + 1}": D[i][j] for j in range(n)} | {f"g{i + 1}": g[i][0]}
    found = steps(problem)
    own = [row for line in found["model"].lines for row in line.formulas]
    assert bool(own) == (problem in WITH_H)
    rows = own or [found[f"tau{q.index}"].result[0] for q in solution.robot.coordinates]
    for q, row in zip(solution.robot.coordinates, rows, strict=True):
        assert isinstance(row, Relation)
        ours = evaluate(with_symbols(row.parts[1]), values)
        assert ours == pytest.approx(evaluate(solution.forms(f"tau{q.index}"), values))


def with_symbols(node: Node) -> Node:
    """The letters d_11 and g_2 as symbols."""
    if not isinstance(node, Letter):
        return with_children(node, with_symbols)
    assert isinstance(node.sub, Row)
    return Symbol(node.base + "".join(str(part.p) for part in node.sub.parts if isinstance(part, Number)))


@pytest.mark.parametrize("problem", [*NAMED, *WITH_H])
def test_C_and_N_mean_the_same(problem: str) -> None:
    solution, values, found = solved(problem), known(problem), steps(problem)
    C, N = (last(found[name].result[0]) for name in ("C", "skew"))
    assert_same(evaluate(C, values), evaluate(solution.forms("C"), values))
    ring, D = solution.robot.ring, solution.values["D"]
    theirs = solution.forms.of(D.map(ring.time_derivative) - solution.values["C"].scale(ring.constant(2)))
    assert_same(evaluate(N, values), evaluate(theirs, values))


def test_both_sides_of_a_row_have_one_order() -> None:
    style, (line,) = (
        solved("box-cylinder-rod-sphere").style,
        steps("box-cylinder-rod-sphere")["agreement"].lines,
    )
    assert to_unicode(line.formulas[0], style).endswith(
        " = 2c₁₃₁ θ̇₁ d\u0307₃ + 2c₁₂₁ θ̇₁ θ̇₂ = 2σ₃ c₂² θ̇₁ d\u0307₃ - 2σ₁ s₂ c₂ θ̇₁ θ̇₂"
    )


@pytest.mark.parametrize("problem", NAMED)
def test_the_rates_of_D_and_the_terms_mean_the_same(problem: str) -> None:
    values = known(problem)
    plain = {step.id: step for step in solved(problem).explain(["vectorized"])}
    for name, other in steps(problem).items():
        if name == "skew":
            for ours, theirs in zip(other.lines[0].formulas, plain[name].lines[0].formulas, strict=True):
                assert evaluate(last(ours), values) == pytest.approx(evaluate(last(theirs), values))
        if name == "terms":
            for ours, theirs in zip(relations(other.table), relations(plain[name].table), strict=True):
                if isinstance(ours, Relation) and isinstance(theirs, Relation):
                    assert evaluate(last(ours), values) == pytest.approx(evaluate(last(theirs), values))


def last(node: Node) -> Node:
    assert isinstance(node, Relation)
    return node.parts[-1]


def relations(table: Table | None) -> list[Any]:
    """The cells of the terms."""
    assert table is not None
    return [row[1] for row in table.rows]


def told(blocks: Iterable[Block]) -> Iterator[Node]:
    """The displayed formulas and those in sentences, in their order."""
    for block in unfolded(blocks):
        if isinstance(block, Text):
            yield from (part for part in block.parts if isinstance(part, Relation))
        else:
            yield from displayed([block])


@pytest.mark.parametrize("detail", list(Detail))
@pytest.mark.parametrize("problem", ["elbow-3r", "planar-2r", "puma560-first3"])
def test_names_are_defined_before_they_are_used(detail: Detail, problem: str) -> None:
    shown = list(told(document(problem, detail).blocks))
    for one in named(problem).definitions:
        first = next(node for node in shown if one.name in set(walk(node)))
        assert isinstance(first, Relation)
        place = first.parts.index(one.name)
        assert place == 0 or first.signs[place - 1] == "=:"


def test_a_summary_defines_what_h_is_made_of_before_h() -> None:
    shown = [to_unicode(node) for node in displayed(document("five-bar", Detail.RESULTS).blocks)]
    (h,) = (text for text in shown if text.startswith("h = "))
    (sigma,) = (text for text in shown if text.startswith("σ₁ = "))
    assert "σ₁" in h and shown.index(sigma) < shown.index(h)


WITH_AN_H = """
gravity: none
dh: [{theta: q1*, d: h, a: l}, {theta: q2*, a: l}]
masses: [{mass: m, link: 2, center: tip}]
"""


@pytest.mark.parametrize(("problem", "symbols"), [
    ("planar-2r", ["-m₂ l₁ l_c2 s₂ =: h", "h", "-h"]),  # section 7.4
    ("crustcrawler-2r", ["-L₂² (m₂/3 + m_p) s₂ c₂ =: h", "-h"]),
    ("five-bar", ["-σ₁ sin(q₂ - q₁) =: h", "-h"]),
    (WITH_AN_H, ["-m l² s₂ =: κ", "κ", "-κ"]),
])  # fmt: skip
def test_what_all_symbols_are_is_the_books_h(problem: str, symbols: list[str]) -> None:
    style, result = solved(problem).style, steps(problem)["christoffel"].result
    shown = [to_unicode(node, style) for node in result]
    assert [text.endswith(f"= {end}") for text, end in zip(shown, symbols, strict=True)] == [True] * len(
        symbols
    )


@pytest.mark.parametrize(("problem", "introduced"), [
    ("elbow-3r", {"ddt1": ["σ₁", "σ₂"], "ddt2": ["σ₃"]}),
    ("spherical-rrp", {"K": ["σ₁"]}),
    ("puma560-first3", {"K": ["σ₁", "σ₂", "σ₃"], "ddt1": ["σ₄", "σ₅", "σ₆", "σ₇"], "ddt2": ["σ₈"]}),
    ("planar-2r", {}),  # h stands beside the symbol that it is
])  # fmt: skip
def test_each_name_is_introduced_once_where_it_first_comes_up(
    problem: str, introduced: dict[str, list[str]]
) -> None:
    style, names = solved(problem).style, {one.name for one in named(problem).definitions}
    found: dict[str, list[str]] = {}
    for step in steps(problem).values():
        for line in step.lines:
            for node in line.formulas:
                if isinstance(node, Relation) and node.parts[0] in names:
                    found.setdefault(step.id, []).append(to_unicode(node.parts[0], style))
    assert found == introduced


@pytest.mark.parametrize("problem", ["elbow-3r", "puma560-first3"])
@pytest.mark.parametrize("name", ["tau1", "tau2", "tau3", "ddt1", "ddt2", "ddt3", "dLdq2", "dLdq3", "Cqd"])
def test_forces_in_names_mean_the_same(problem: str, name: str) -> None:
    found = steps(problem)[name]
    values, wanted = known(problem), solved(problem).forms(name)
    ours, theirs = evaluate(last(found.result[0]), values), evaluate(wanted, values)
    assert_same(ours, theirs) if isinstance(ours, list) else assert_same([ours], [theirs])
    assert "- (-" not in to_unicode(found.result[0])


def test_by_the_recursions_names_are_introduced_in_the_forces() -> None:
    solution = Solution.of(by_method(load(find("elbow-3r")), Method.NEWTON_EULER), states=1)
    steps = solution.explain(short=solution.abbreviated("auto"))
    labels = [line.label for step in steps for line in step.lines if line.label.startswith(DEFINITIONS)]
    assert labels == [f"{DEFINITIONS}tau1", f"{DEFINITIONS}tau2"]


def test_a_stage_that_fails_in_names_is_told_without_them(monkeypatch: pytest.MonkeyPatch) -> None:
    ending, solution = vectorized.ending, dynsolve.solve("planar-2r")

    def failing(context: Context, *rest: Any) -> Any:
        if context.names is not None:
            raise LookupError("planted")
        return ending(context, *rest)

    in_full = solution_document(solution, abbreviate=Abbreviate.NEVER)
    monkeypatch.setattr(vectorized, "ending", failing)
    with pytest.warns(ExplanationWarning, match="names"):
        assert solution_document(solution, abbreviate=Abbreviate.ALWAYS) == in_full


def test_never_is_never() -> None:
    assert solved("elbow-3r").abbreviated("never") is None


@pytest.mark.parametrize("problem", [*NAMED, *WITH_H])
def test_the_summary_tells_where_names_stand(problem: str) -> None:
    """Of each matrix and of the rows it is said that names stand there just where some do."""
    blocks = solution_document(solved(problem), Detail.NORMAL).blocks
    place, text = next(
        (place, block)
        for place, block in enumerate(blocks)
        if isinstance(block, Text) and block.parts[0] == "In " and block.parts[1] in (letters.C, letters.D)
    )
    names, nodes = named(problem).symbols, list(displayed(blocks[place + 1 :]))
    rows = [node for node in nodes if isinstance(node, Relation) and not has_matrix(node)][len(names) - 1 :]
    below = [node for node in rows if to_unicode(node.parts[0])[0] in "τf"]
    assert below
    told = "the rows below" in text.parts or "the results below" in text.parts
    assert told == (not names.isdisjoint(walk(*below)))
    for letter in (letters.D, letters.C, letters.G):
        (entry,) = (one for one in named_matrices(problem) if one[0] == letter)
        assert (letter in text.parts) == (not names.isdisjoint(walk(entry[1])))


IN_NUMBERS = """
gravity: [0, 0, -9.81]
dh: [{theta: q1*, d: 0.3, alpha: 90deg}, {theta: q2*, a: 0.5, d: 0.2}, {theta: q3*, a: 0.4}]
masses:
  - {mass: 2, name: 2, link: 2, center: tip}
  - {mass: 1.5, name: 3, link: 3, center: tip}
"""


@pytest.mark.parametrize("problem", ["puma560-first3", IN_NUMBERS])
def test_slopes_end_in_the_names_of_symbols(problem: str) -> None:
    """∂d_kj/∂q_i is c_ijk + c_ikj; no part of it has a name by accident, as 0.48 c₂₃ = 4σ₄."""
    names, values = named(problem).symbols, known(problem)
    lines = [node for line in steps(problem)["christoffel"].lines for node in line.formulas]
    slopes = [node for node in lines if isinstance(node, Relation) and node.parts[0] not in names]
    assert slopes
    for slope in slopes:
        *_, before, last = slope.parts
        assert {part for part in walk(last) if isinstance(part, Symbol)} <= names, to_unicode(slope)
        assert evaluate(last, values) == pytest.approx(evaluate(before, values))


def test_forces_beside_a_matrix_with_h_have_it_too() -> None:
    """Where the whole model is not asked for, and so is not there, the rows are written as C is."""
    asked = find("planar-2r").read_text().replace("find: [D, C, g, tau]", "find: [C, tau]")
    assert "find: [C, tau]" in asked
    nodes = list(displayed(document(asked, Detail.RESULTS).blocks))
    assert {to_unicode(last(node)).count("h") for node in nodes if to_unicode(node)[0] == "τ"} == {1}


def test_equal_inertias_have_their_accelerations_in_one_sum() -> None:
    nodes = displayed(document("scara-rrpr", Detail.RESULTS).blocks)
    assert "τ₄ = I₄ (θ̈₄ - θ̈₁ - θ̈₂)" in {to_unicode(node) for node in nodes}


def has_matrix(node: Node) -> bool:
    return any(isinstance(part, Matrix) for part in walk(node))


def named_matrices(problem: str) -> list[tuple[Node, Node]]:
    short = named(problem)
    return [(letters.D, short.D), (letters.C, short.C), (letters.G, short.g)]


MIDPOINTS = """
dh:
  - {theta: q1*, d: L1, alpha: 90deg}
  - {theta: q2*, a: L2}
  - {theta: q3*, a: L3}
masses:
  - {mass: m1, link: 1, shape: {cylinder: {radius: r, length: L1}}, center: midpoint}
  - {mass: m2, link: 2, shape: {rod: {length: L2}}, center: midpoint}
  - {mass: m3, link: 3, shape: {rod: {length: L3}}, center: midpoint}
"""


@pytest.mark.parametrize("problem", [*NAMED, MIDPOINTS])
def test_names_are_numbered_as_they_are_met(problem: str) -> None:
    """σ₁ is defined before σ₂, and no name stands in an equation before its own."""
    met: list[str] = []
    names = {one.name for one in named(problem).sums}
    for node in displayed(solution_document(solved(problem), Detail.FULL).blocks):
        for part in walk(node):
            if isinstance(part, Relation) and part.parts[0] in names and part.parts[0].name not in met:
                met.append(part.parts[0].name)
        used = {part.name for part in walk(node) if part in names}
        assert used <= {*met}
    assert met == [f"sigma{k}" for k in range(1, len(names) + 1)]


BELT_DRIVEN = """
gravity: [0, -g, 0]
dh:
  - {theta: p1*, a: l1}
  - {theta: p2* - p1*, a: l2, alpha: -90deg}
  - {theta: p3*, d: l3, a: l4}
masses:
  - {mass: m2, link: 2, center: midpoint, shape: {rod: {length: l2}}}
  - {mass: m3, link: 3, center: {near: [l4/3, 0, l3]}, inertia: {xx: I3x, yy: I3y, zz: I3z, yz: I3yz}}
"""


def test_a_symbol_is_named_beside_its_rates_with_either_sign_and_behind_common_factors() -> None:
    """Each product of rates of the forces has names alone beside it, and the value that it had."""
    names, values = named(BELT_DRIVEN).symbols, known(BELT_DRIVEN)
    for k in (1, 2, 3):
        for name in (f"ddt{k}", f"dLdq{k}", f"tau{k}"):
            row = last(steps(BELT_DRIVEN)[name].result[0])
            assert evaluate(row, values) == pytest.approx(evaluate(solved(BELT_DRIVEN).forms(name), values))
            for term in summands(row):
                if any(isinstance(part, Symbol) and part.dots == 1 for part in walk(term)):
                    symbols = {part for part in walk(term) if isinstance(part, Symbol) and not part.dots}
                    assert len(symbols) == 1 and symbols <= names, to_unicode(term)
