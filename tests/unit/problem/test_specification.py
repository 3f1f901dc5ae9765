"""The reader, the schema and `dynsolve new` know the same keys; every example in the specification holds."""

from __future__ import annotations

import re

import jsonschema
import pytest
import yaml

from dynsolve.problem import read_problem
from dynsolve.problem.kinds import Key
from dynsolve.problem.lint import lint_text
from dynsolve.problem.schema import schema, template
from dynsolve.problem.specification import BODY, DRAWING, PROBLEM, ROW, dimensions
from dynsolve.robot.shapes import KINDS
from tests.unit.problem.marked import RP, errors

MATRICES = ("candidates", "assume", "chain")
VALIDATOR = jsonschema.Draft202012Validator(schema())


def names(keys: tuple[Key, ...]) -> list[str]:
    return [key.name for key in keys]


def holds(text: str) -> None:
    """The reader, and the schema, accept a text."""
    assert not errors(text)
    VALIDATOR.validate(yaml.safe_load(text))


def test_what_new_writes_has_every_key_and_its_meaning() -> None:
    written = template()
    assert names(PROBLEM.keys) == re.findall(r"^(?:# )?([a-z_]+): ?(?:\S.*)?$", written, re.MULTILINE)
    folded = " ".join(written.replace("#", " ").split())
    for record in (PROBLEM, ROW, BODY):
        assert all(" ".join(key.described.split()) in folded for key in record.keys)
        assert all(key.described for key in record.keys)
    assert all(f"{{{shape}: {{" in folded for shape in KINDS if shape != "point")


def test_what_new_writes_as_a_comment_can_be_uncommented() -> None:
    beside_a_table = [name for name in PROBLEM.names if name not in (*DRAWING, "model", *MATRICES)]
    whole = re.sub(rf"^# (?=(?:{'|'.join(beside_a_table)}):)", "", template(), flags=re.MULTILINE)
    assert list(yaml.safe_load(whole)) == beside_a_table
    served = {key.serves[0] for key in PROBLEM.keys if key.serves}
    asked = ["tau", "D", "C", "g", "pP", "Q", *sorted(served)]
    whole = whole.replace("find: [tau, D, C, g]", f"find: [{', '.join(asked)}]")
    holds(whole)
    assert not lint_text(whole)


def test_the_examples_of_a_drawing_hold_in_the_place_of_a_table() -> None:
    whole = "\n".join(f"{name}: {PROBLEM[name].example}" for name in DRAWING)
    holds(whole)
    assert not lint_text(whole)


def test_the_examples_of_candidates_hold_in_the_place_of_a_table() -> None:
    keys = "".join(f"{name}: {PROBLEM[name].example}\n" for name in MATRICES)
    holds(f"coordinates: {{q1: revolute, q2: revolute}}\n{keys}")


def test_the_example_of_a_model_holds_in_the_place_of_a_table() -> None:
    whole = f"model: {PROBLEM['model'].example}"
    holds(whole)
    assert not lint_text(whole)


@pytest.mark.parametrize("key", BODY.keys, ids=names(BODY.keys))
def test_the_example_of_a_body_s_key_holds(key: Key) -> None:
    given = {"mass": "m1", "link": "1", "center": "midpoint", "inertia": "{zz: I1}"} | {key.name: key.example}
    entries = ", ".join(f"{name}: {value}" for name, value in given.items())
    holds(f"{RP}masses:\n  - {{{entries}}}\n")


@pytest.mark.parametrize("key", ROW.keys, ids=names(ROW.keys))
def test_the_example_of_a_column_holds(key: Key) -> None:
    holds(f"dh:\n  - {{theta: q1*}}\n  - {{{key.name}: {key.example}}}\n")


@pytest.mark.parametrize("shape", [shape for shape in KINDS if shape != "point"])
def test_the_dimensions_of_a_shape_are_those_of_its_record(shape: str) -> None:
    record = dimensions(shape)
    assert tuple(names(record.required)) == KINDS[shape].keys
    beside_a_density = ("density",) if KINDS[shape].has_axis else ("density", "axis")
    keys = [key.name for key in record.keys if key.name not in beside_a_density]
    written = ", ".join(f"{name}: {'x' if name == 'axis' else 'b'}" for name in keys)
    robot = read_problem(
        f"{RP}masses: [{{mass: m1, link: 1, center: midpoint, shape: {{{shape}: {{{written}}}}}}}]"
    ).robot
    assert robot.bodies[0].shape is not None
    assert tuple(key for key, _ in robot.bodies[0].shape.dimensions) == KINDS[shape].keys
