"""Rows of the table as lists [θ, d, a, α]: the same robot as with names, and what is refused."""

from __future__ import annotations

from random import Random

import jsonschema
import pytest
import yaml

from dynsolve.problem import read_problem
from dynsolve.problem.schema import schema
from tests.unit.problem.marked import errors, places, unmarked

CHOICES = {
    "theta": ["q{}*", "q{}* + 90deg", "-q{}*", "q{}* + beta"],
    "d": ["0", "L{}", "1/2", "-h"],
    "a": ["0", "l{}", "2*l"],
    "alpha": ["0", "90deg", "-90deg", "beta"],
}


@pytest.mark.parametrize("convention", ["standard", "modified"])
@pytest.mark.parametrize("seed", range(6))
def test_a_list_is_the_row_with_its_names(convention: str, seed: int) -> None:
    random = Random(seed)
    rows = []
    for k in range(1, random.randint(1, 4) + 1):
        row = {column: random.choice(texts).format(k) for column, texts in CHOICES.items()}
        if random.random() < 0.3:
            row |= {"theta": random.choice(["0", "30deg"]), "d": f"d{k}*"}
        rows.append(row)
    listed = yaml.safe_dump({"convention": convention, "dh": [list(row.values()) for row in rows]})
    named = yaml.safe_dump({"convention": convention, "dh": rows})
    jsonschema.validate(yaml.safe_load(listed), schema())
    one, other = read_problem(listed).robot, read_problem(named).robot
    assert one.joints == other.joints
    assert one.coordinates == other.coordinates


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("dh: [«[q1*, 0, l]»]", "row 1 is [θ, d, a, α], not 3 cells"),
        ("dh: [[q1*, 0, l, 0], «[q2*]»]", "row 2 is [θ, d, a, α], not 1 cell"),
        ("dh: [«[q1*, 0, l, 0, 0]»]", "not 5 cells"),
        ("convention: modified\ndh: [«[0, l, 0, q1*]»]", "its star stands in the place of a or α"),
        ("dh: [[q1*, 0, l, «90»]]", "the bare number 90"),
        ("dh: [[q1*, 0, l, «[0]»]]", "alpha of row 1 is an expression"),
    ],
)
def test_a_list_that_is_no_row(text: str, message: str) -> None:
    plain, expected = unmarked(text)
    found = errors(plain)
    assert places(found) == expected
    assert message in found[0].message
    assert found[0].help
