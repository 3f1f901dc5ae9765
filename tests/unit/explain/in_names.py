"""Models in names, and numbers for them."""

from __future__ import annotations

import random
from collections.abc import Iterator
from typing import Any

import dynsolve
from dynsolve.explain.abbreviations import Abbreviated
from dynsolve.notation.tree import (
    Negative,
    Node,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
)
from dynsolve.notation.tree_values import evaluate
from tests.support import solved

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
