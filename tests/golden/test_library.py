"""The library of problems: whole, with its sources, and every file of it solved and verified."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.oracle.reading import load
from tests.support import ALL_PROBLEMS, LIBRARY, solve_json, solved

STEMS = {
    "articulated-6r",
    "ball-and-beam",
    "box-cylinder-rod-sphere",
    "cartesian-pp",
    "cart-pole",
    "crane",
    "crustcrawler-2r",
    "cylindrical-rpp",
    "elastic-joint",
    "elbow-3r",
    "five-bar",
    "furuta-pendulum",
    "in3140-rp",
    "inertia-candidates",
    "inf3480-painting-rrp",
    "inf3480-ppr",
    "inf3480-rpr",
    "inf3480-rprr-drawn",
    "inf3480-rrp",
    "inf3480-rrp-drawn",
    "knife-edge",
    "numeric-2r",
    "panda-7r",
    "planar-2r",
    "planar-2r-friction",
    "planar-2r-motors",
    "planar-2r-reach",
    "planar-2r-remote",
    "planar-3r-redundant",
    "planar-rrp-task",
    "pr-factorizations",
    "puma560",
    "puma560-first3",
    "rp-parameters",
    "rp-vertical",
    "scara-rrpr",
    "spatial-3r-acceleration",
    "spherical-rrp",
    "stanford-6",
}


def test_the_library_is_whole() -> None:
    assert {path.stem for path in ALL_PROBLEMS} == STEMS


@pytest.mark.parametrize("path", ALL_PROBLEMS, ids=lambda path: path.stem)
def test_a_problem_says_what_it_is_and_where_it_comes_from(path: Path) -> None:
    problem = load(path)
    assert problem["title"]
    assert len(problem["source"]) > 20
    assert problem["find"]


@pytest.mark.parametrize("path", LIBRARY, ids=lambda path: path.stem)
def test_a_problem_of_dynamics_asks_for_the_matrices(path: Path) -> None:
    assert {"D", "C", "g"} <= set(load(path)["find"])


@pytest.mark.parametrize("path", [p for p in ALL_PROBLEMS if p not in LIBRARY], ids=lambda path: path.stem)
def test_a_problem_of_kinematics_has_what_it_asks_for(path: Path) -> None:
    results = solve_json(path)["results"]
    assert all(results[name] for name in load(path)["find"])


@pytest.mark.parametrize("path", LIBRARY, ids=lambda path: path.stem)
def test_a_solution_is_as_the_contract_says(path: Path) -> None:
    solution = json.loads(json.dumps(solved(path).to_json()))
    n = len(solution["coordinates"])
    problem, results = load(path), solution["results"]
    assert solution["format"] == "dynsolve-solution/1"
    assert solution["problem"]["title"] == problem["title"]
    assert solution["problem"]["source"] == problem["source"]
    assert solution["problem"]["convention"] == problem.get("convention", "standard")
    assert len(results["A"]) == len(results["H"]) == len(problem["dh"])
    assert len(results["bodies"]) == len(problem["masses"])
    assert len(results["euler_lagrange"]) == n
    assert [len(results[name]) for name in ("Jv", "Jw", "tau", "D", "C", "g")] == [3, 3, n, n, n, n]
    assert all(step["id"] and step["title"] and step["stage"] for step in solution["steps"])
    assert len({step["id"] for step in solution["steps"]}) == len(solution["steps"])
    assert solution["verified"]["states"] >= 5
    assert solution["verified"]["max_relative_error"] < 1e-9
