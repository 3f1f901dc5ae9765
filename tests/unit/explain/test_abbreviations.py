"""Names for long results: they mean what they stand for, and make a model short."""

from __future__ import annotations

import math
import random
import re
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings

import dynsolve
from dynsolve.document import Equations
from dynsolve.errors import AlgebraError, VerificationError
from dynsolve.explain.abbreviations import Abbreviated, abbreviate, is_long
from dynsolve.explain.step import Detail
from dynsolve.notation.build import cost
from dynsolve.notation.tree import (
    BigSum,
    Derivative,
    Letter,
    Matrix,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Relation,
    Row,
    Sum,
    Symbol,
    Words,
)
from dynsolve.notation.tree_values import compile_trees, evaluate
from dynsolve.notation.unicode import to_unicode
from dynsolve.solution.documents import definition_blocks, solution_document
from tests.robots import robots
from tests.support import ROOT, solved

LONG = ("puma560", "stanford-6")
SHORT = ("planar-2r", "elbow-3r", "puma560-first3", "crustcrawler-2r", "in3140-rp")


def short(problem: str) -> Abbreviated:
    found = solved(problem).abbreviated()
    assert found is not None
    return found


def state(solution: dynsolve.Solution, seed: int) -> dict[str, float]:
    draw = random.Random(seed)
    values = {name: draw.uniform(0.5, 1.5) for name in solution.robot.ring.parameters}
    for q in solution.robot.coordinates:
        values |= {name: draw.uniform(-1, 1) for name in (q.name, q.velocity, q.acceleration)}
    return values


def with_definitions(names: Abbreviated, values: dict[str, float]) -> dict[str, float]:
    """The values, and those of the names; each needs those before it alone."""
    known = dict(values)
    for definition in names.definitions:
        known[definition.name.name] = evaluate(definition.meaning, known)
    return known


def assert_same(ours: Any, theirs: Any) -> None:
    flat = [[x for row in rows for x in row] if isinstance(rows, list) else [rows] for rows in (ours, theirs)]
    size = max(1.0, *map(abs, flat[1]))
    assert all(abs(a - b) <= 1e-9 * size for a, b in zip(*flat, strict=True))


def assert_means_the_same(solution: dynsolve.Solution, names: Abbreviated) -> None:
    for seed in range(2):
        values = state(solution, seed)
        try:
            plain = {name: evaluate(solution.forms(name), values) for name in ("D", "C", "g")}
        except (ValueError, ZeroDivisionError):
            continue
        known = with_definitions(names, values)
        for name, form in (("D", names.D), ("C", names.C), ("g", names.g)):
            assert_same(evaluate(form, known), plain[name])
        for (i, j, k), symbol in names.christoffel.items():
            assert_same(evaluate(symbol, known), evaluate(solution.forms.christoffel(i, j, k), values))
        if names.P is not None:
            assert_same(evaluate(names.P, known), evaluate(solution.forms("P"), values))


@pytest.mark.parametrize("problem", LONG + SHORT)
@pytest.mark.parametrize("constants", [True, False])
def test_names_mean_what_they_stand_for(problem: str, constants: bool) -> None:
    if problem == "puma560" and not constants:
        pytest.skip("nobody writes it so")
    assert_means_the_same(solved(problem), abbreviate(solved(problem).forms, constants))


@given(robots(max_joints=3))
@settings(max_examples=15, deadline=None)
def test_random_robots(text: str) -> None:
    try:
        solution = dynsolve.solve(text)
    except (AlgebraError, VerificationError, dynsolve.ProblemError):
        return
    for constants in (True, False):
        assert_means_the_same(solution, abbreviate(solution.forms, constants))


def symbols(node: Node) -> Iterator[str]:
    match node:
        case Symbol(name, 0):
            yield name
        case Sum(parts) | Product(parts):
            for part in parts:
                yield from symbols(part)
        case Negative(part):
            yield from symbols(part)
        case Power(a, b) | Quotient(a, b):
            yield from symbols(a)
            yield from symbols(b)


@pytest.mark.parametrize("problem", LONG + SHORT)
def test_definitions_use_earlier_ones_only(problem: str) -> None:
    names = short(problem)
    robot = solved(problem).robot
    known = {*robot.ring.parameters, *robot.ring.names}
    for definition in names.definitions:
        assert set(symbols(definition.meaning)) <= known
        assert definition.name.name not in known
        known.add(definition.name.name)


def test_no_name_is_taken_twice() -> None:
    text = """
title: names
dh:
  - {theta: q1*, d: 0, a: kappa1, alpha: 0}
  - {theta: q2*, d: 0, a: sigma1, alpha: 0}
masses:
  - {mass: kappa2, link: 1, shape: point, center: tip}
  - {mass: h, link: 2, shape: point, center: tip}
"""
    solution = dynsolve.solve(text)
    for constants in (True, False):
        names = abbreviate(solution.forms, constants)
        assert {d.name.name for d in names.definitions}.isdisjoint({"kappa1", "kappa2", "sigma1", "h"})
        assert_means_the_same(solution, names)


def test_the_elbow_has_the_h_of_the_books() -> None:
    """Spong, Hutchinson, Vidyasagar, section 7.4: h = -m_2 l_1 l_c2 sin q_2."""
    names = short("planar-2r")
    style = solved("planar-2r").style
    assert [to_unicode(d.name, style) + " = " + to_unicode(d.meaning, style) for d in names.definitions] == [
        "h = -m₂ l₁ l_c2 s₂"
    ]
    assert to_unicode(names.C, style) == "[[h q̇₂, h (q̇₁ + q̇₂)], [-h q̇₁, 0]]"


def rank_of_the_regressor(problem: str) -> int:
    """How many combinations of the bodies' parameters the forces depend on.

    The forces as they are written out, differentiated by each parameter at random states.
    """
    solution = solved(problem)
    robot, still = solution.robot, set()
    for joint in robot.joints:
        still |= {g for e in (joint.d, joint.a) for g in symbols(solution.forms.of(e))}
    own = [name for name in robot.ring.parameters if name not in still | {"g"}]
    program, point = compile_trees([solution.forms("tau")]), state(solution, 7)
    rows = []
    for seed in range(len(own) // robot.n + 3):
        moving = {k: v for k, v in state(solution, seed).items() if k not in robot.ring.parameters}

        def forces(name: str, by: float, moving: dict[str, float] = moving) -> Any:
            (tau,) = program.run({**point, **moving, name: point[name] + by})
            return np.array(tau)[:, 0]

        step = 1e-3
        rows.append([(forces(name, step) - forces(name, -step)) / (2 * step) for name in own])
    matrix = np.concatenate([np.array(row).T for row in rows])
    sizes = np.linalg.svd(matrix, compute_uv=False)
    return int((sizes > 1e-5 * sizes[0]).sum())


@pytest.mark.slow
@pytest.mark.parametrize(("problem", "count"), [("puma560", 36), ("puma560-first3", 15)])
def test_the_constants_are_as_few_as_can_be(problem: str, count: int) -> None:
    assert len(abbreviate(solved(problem).forms, True).constants) == count
    assert rank_of_the_regressor(problem) == count


def longest_chain(names: Abbreviated) -> int:
    """How many names are looked up one after the other, at most."""
    depth: dict[str, int] = {}
    for definition in names.sums:
        inner = (depth.get(name, 0) for name in symbols(definition.meaning))
        depth[definition.name.name] = 1 + max(inner, default=0)
    return max(depth.values())


@pytest.mark.slow
def test_a_long_model_becomes_short() -> None:
    for problem in LONG:
        assert is_long(solved(problem).forms)
    names = short("puma560")
    assert names.cost < 3000
    assert len(names.sums) < 45
    assert longest_chain(names) <= 4
    assert max(cost(d.meaning) for d in names.sums) < 80


@pytest.mark.parametrize("problem", SHORT)
def test_a_short_model_needs_no_constants(problem: str) -> None:
    assert not is_long(solved(problem).forms)
    assert not abbreviate(solved(problem).forms).constants


@pytest.mark.parametrize("problem", ["planar-2r", "crustcrawler-2r", "in3140-rp"])
def test_a_short_model_is_left_alone(problem: str) -> None:
    assert solved(problem).abbreviated("auto") is None
    assert solution_document(solved(problem)) == solution_document(
        solved(problem), abbreviate=dynsolve.explain.abbreviations.Abbreviate.NEVER
    )


def test_a_wrong_name_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    from dynsolve.explain import abbreviations

    right = abbreviations.abbreviate

    def wrong(forms: Any) -> Abbreviated:
        from dataclasses import replace

        names = right(forms)
        first = names.sums[0]
        return replace(names, sums=(replace(first, meaning=Negative(first.meaning)), *names.sums[1:]))

    monkeypatch.setattr(abbreviations, "abbreviate", wrong)
    with pytest.raises(VerificationError):
        dynsolve.solve("planar-2r").abbreviated()


# -- the steps in names ----------------------------------------------------------------------------


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
    assert general == {"rows", "columns", "rc", "tensors", "potentials", "kinetics", "forces", "C_entries"}
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
    assert headings.index("Abbreviations") + 1 == headings.index("7. The vectorized form")
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
    for node in displayed(solution_document(solved("puma560")).blocks):
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
