"""Names for long results: they mean what they stand for, and make a model short."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings

import dynsolve
from dynsolve.errors import ProblemError, VerificationError
from dynsolve.explain.abbreviations import Abbreviated, abbreviate
from dynsolve.notation.build import cost
from dynsolve.notation.tree import (
    Negative,
)
from dynsolve.notation.tree_values import compile_trees
from dynsolve.notation.unicode import to_unicode
from dynsolve.solution.documents import solution_document
from tests.robots import robots
from tests.support import solved
from tests.unit.explain.in_names import LONG, SHORT, assert_means_the_same, short, state, symbols


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
    except ProblemError:
        return
    for constants in (True, False):
        assert_means_the_same(solution, abbreviate(solution.forms, constants))


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
        assert solved(problem).forms.are_long
    names = short("puma560")
    matrices = [entry for matrix in (names.D, names.g) for row in matrix.rows for entry in row]
    meanings = [definition.meaning for definition in names.definitions]
    assert names.P is not None
    assert sum(map(cost, (*matrices, *meanings, *names.christoffel.values(), names.P))) < 3000
    assert len(names.sums) < 45
    assert longest_chain(names) <= 4
    assert max(cost(d.meaning) for d in names.sums) < 80


@pytest.mark.parametrize("problem", SHORT)
def test_a_short_model_needs_no_constants(problem: str) -> None:
    assert not solved(problem).forms.are_long
    assert not abbreviate(solved(problem).forms).constants


@pytest.mark.parametrize("problem", ["cart-pole", "numeric-2r", "in3140-rp"])
def test_a_short_model_is_left_alone(problem: str) -> None:
    assert solved(problem).abbreviated("auto") is None
    assert solution_document(solved(problem)) == solution_document(
        solved(problem), abbreviate=dynsolve.explain.abbreviations.Abbreviate.NEVER
    )


def test_a_wrong_name_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    from dynsolve.explain import abbreviations

    right = abbreviations.abbreviate

    def wrong(forms: Any) -> Abbreviated:
        from msgspec.structs import replace

        names = right(forms)
        first = names.sums[0]
        return replace(names, sums=(replace(first, meaning=Negative(first.meaning)), *names.sums[1:]))

    monkeypatch.setattr(abbreviations, "abbreviate", wrong)
    with pytest.raises(VerificationError):
        dynsolve.solve("planar-2r").abbreviated()
