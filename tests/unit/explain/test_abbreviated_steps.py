"""The steps in names."""

from __future__ import annotations

import math
import random
import re
from collections.abc import Iterator, Sequence
from typing import Any

import pytest

import dynsolve
from dynsolve.document import Equations
from dynsolve.explain.step import Detail
from dynsolve.notation.tree import (
    BigSum,
    Derivative,
    Letter,
    Matrix,
    Negative,
    Node,
    Number,
    Product,
    Relation,
    Row,
    Sum,
    Symbol,
    Words,
)
from dynsolve.notation.tree_values import evaluate
from dynsolve.notation.unicode import to_unicode
from dynsolve.solution.documents import definition_blocks, solution_document
from tests.support import ROOT, document, solved
from tests.unit.explain.in_names import (
    assert_means_the_same,
    assert_same,
    short,
    state,
    with_definitions,
)


def entry(letter: Letter) -> tuple[str, ...]:
    sub = letter.sub.parts if isinstance(letter.sub, Row) else (letter.sub,)
    return (letter.base, *(str(part.p) for part in sub if isinstance(part, Number)))


def numbered(node: Node) -> Node:
    """The names of entries as symbols: d_12 as d_1_2."""
    match node:
        case Letter():
            return Symbol("_".join(entry(node)), node.dots)
        case Sum(parts):
            return Sum(tuple(map(numbered, parts)))
        case Product(parts):
            return Product(tuple(map(numbered, parts)))
        case Negative(part):
            return Negative(numbered(part))
        case Matrix(rows):
            return Matrix(tuple(tuple(map(numbered, row)) for row in rows))
    return node


def entries(solution: dynsolve.Solution, values: dict[str, float]) -> dict[str, float]:
    """d_1_2, its rate d_1_2_dot, c_1_2_1 and g_1, from the plain forms."""
    n = solution.robot.n
    D, g = (evaluate(solution.forms(name), values) for name in ("D", "g"))
    rates = [values[q.velocity] for q in solution.robot.coordinates]
    c = {
        (i, j, k): evaluate(solution.forms.christoffel(i, j, k), values)
        for i in range(n)
        for j in range(n)
        for k in range(n)
    }
    known = dict(values)
    for i in range(n):
        known[f"g_{i + 1}"] = g[i][0]
        for j in range(n):
            known[f"d_{i + 1}_{j + 1}"] = D[i][j]
            moving = sum((c[m, j, i] + c[m, i, j]) * rates[m] for m in range(n))
            known[f"d_{i + 1}_{j + 1}_dot"] = moving
            known |= {f"c_{i + 1}_{j + 1}_{k + 1}": c[i, j, k] for k in range(n)}
    return known


@pytest.mark.slow
def test_formulas_in_names_are_right() -> None:
    solution = solved("stanford-6")
    values = state(solution, 3)
    known = entries(solution, values)
    steps = {step.id: step for step in solution.explain(short=short("stanford-6"))}
    names = [f"{stem}{q.index}" for q in solution.robot.coordinates for stem in ("dLdqd", "ddt", "tau")]
    for name in ["K", "C_entries", *names]:
        (result,) = steps[name].result
        assert isinstance(result, Relation)
        ours = evaluate(numbered(result.parts[-1]), known)
        assert_same(ours, evaluate(solution.forms(name.removesuffix("_entries")), values))


@pytest.mark.parametrize("problem", ["stanford-6"])
def test_what_is_said_once_leaves_nothing_out(problem: str) -> None:
    """Every step stands in the full account; the normal one leads on to nothing that it does not show."""
    solution = solved(problem)
    one_way = {"D_direct", "Cqd", "agreement"}  # D has its own way, and nothing is read off
    plain = [step.id for step in solution.explain() if step.id not in one_way]
    steps = list(solution.explain(short=short(problem)))
    ids = [step.id for step in steps]
    assert [name for name in ids if name in plain] == plain
    general = {name for name in ids if name not in plain}
    assert general == {
        "rows",
        "columns",
        "rc",
        "tensors",
        "potentials",
        "kinetics",
        "forces",
        "C_entries",
        "D_entry",
    }
    shown = [step.id for step in steps if step.detail < Detail.FULL]
    assert len(shown) < 30 < len(plain)
    for name in ("H6", "J", "P", "K", "L", "D", "christoffel", "C", "g", "model"):
        assert name in shown
    for step in steps:
        if step.detail < Detail.FULL:
            assert {name for name in step.uses or () if name in ids} <= set(shown)


def test_the_general_forces_are_those_of_each_coordinate() -> None:
    """τ_k = Σ_j d_kj q̈_j + Σ_i Σ_j c_ijk q̇_i q̇_j + g_k, summed for each k."""
    solution = solved("stanford-6")
    values = state(solution, 5)
    known = entries(solution, values)
    (step,) = (s for s in solution.explain(["torque"], short("stanford-6")) if s.id == "forces")
    (result,) = step.result
    assert isinstance(result, Relation)
    tau, n = evaluate(solution.forms("tau"), values), solution.robot.n
    for k in range(n):
        summed = sum(summand(part, known, {"k": k + 1}, solution) for part in result.parts[-1].terms)
        assert summed == pytest.approx(tau[k][0])


def summand(node: Node, known: dict[str, float], at: dict[str, int], solution: dynsolve.Solution) -> float:
    """The value of a term with sums over indices."""
    if isinstance(node, BigSum):
        places = range(1, solution.robot.n + 1)
        return sum(summand(node.body, known, {**at, node.index.name: i}, solution) for i in places)
    if isinstance(node, Product):
        return math.prod(summand(part, known, at, solution) for part in node.factors)
    assert isinstance(node, Letter)
    indices = [at[i.name] for i in (node.sub.parts if isinstance(node.sub, Row) else [node.sub])]
    if node.base == "q":
        q = solution.robot.coordinates[indices[0] - 1]
        return known[(q.name, q.velocity, q.acceleration)[node.dots]]
    return known["_".join((node.base, *map(str, indices)))]


def test_christoffel_symbols_stand_together() -> None:
    solution = solved("stanford-6")
    names = short("stanford-6")
    known = with_definitions(names, state(solution, 4))
    (step,) = (s for s in solution.explain(["vectorized"], names) if s.id == "christoffel")
    met = set()
    for row in step.result:
        assert isinstance(row, Relation)
        *members, value = row.parts
        for member in members:
            sign, letter = (-1, member.argument) if isinstance(member, Negative) else (1, member)
            assert isinstance(letter, Letter)
            i, j, k = (int(part) - 1 for part in entry(letter)[1:])
            met.add((i, j, k))
            assert_same(sign * evaluate(names.christoffel[i, j, k], known), evaluate(value, known))
    assert met == {key for key, value in names.christoffel.items() if value != Number(0)}


def test_definitions_come_before_what_uses_them() -> None:
    solution = solved("stanford-6")
    blocks = solution_document(solution).blocks
    headings = [block.text for block in blocks if hasattr(block, "text")]
    assert headings.index("Abbreviations") + 1 == headings.index("7. The matrix form")
    assert [b for b in blocks if b in list(definition_blocks(short("stanford-6"), "arm"))]


def displayed(blocks: Sequence[Any]) -> Iterator[Node]:
    for block in blocks:
        if isinstance(block, Equations):
            yield from block.nodes
        elif hasattr(block, "blocks"):
            yield from displayed(block.blocks)
        elif hasattr(block, "node"):
            yield block.node


@pytest.mark.slow
def test_nothing_fills_pages() -> None:
    style = solved("puma560").style
    for node in displayed(document("puma560", Detail.NORMAL).blocks):
        value = node.parts[-1] if isinstance(node, Relation) else node
        rows = value.rows if isinstance(value, Matrix) else ((value,),)
        for row in rows:
            for part in row:
                if not isinstance(part, Derivative | Words):
                    assert len(to_unicode(part, style)) < 600


@pytest.mark.slow
def test_a_long_model_with_numbers_for_its_masses() -> None:
    """Numbers need no names; what recurs does, and the steps say what they are made of all the same."""
    draw = random.Random(1)
    head, masses = (ROOT / "problems" / "puma560.yaml").read_text().split("masses:")
    masses = masses.split("find:")[0]
    numbers = re.sub(r"\b([mxyz]\d|I\d\w\w)\b", lambda _: f"{draw.uniform(0.1, 2):.2f}", masses)
    solution = dynsolve.solve(f"{head}masses:{numbers}")
    names = solution.abbreviated("auto")
    assert names is not None and names.long and not names.constants
    assert_means_the_same(solution, names)
    style = solution.style
    for node in displayed(solution_document(solution).blocks):
        if not isinstance(node, Relation) or not isinstance(node.parts[-1], Matrix):
            assert len(to_unicode(node, style)) < 800
