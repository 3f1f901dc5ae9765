"""The JSON Schema says of a file what the reader says, as far as a schema can."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import jsonschema
import pytest
import yaml

from dynsolve.problem.kinds import CENTERS
from dynsolve.problem.schema import schema, template
from dynsolve.problem.specification import ABOUT, BODY, PROBLEM, ROW, TENSOR
from dynsolve.robot.shapes import KINDS
from tests.support import LIBRARY, TEXTBOOKS

VALIDATOR = jsonschema.Draft202012Validator(schema())


def described(node: Any) -> bool:
    return "description" in node or "$ref" in node


def test_it_is_a_schema() -> None:
    jsonschema.Draft202012Validator.check_schema(schema())


@pytest.mark.parametrize("path", LIBRARY + TEXTBOOKS, ids=lambda path: path.stem)
def test_it_accepts_the_library_and_the_textbooks(path: Path) -> None:
    VALIDATOR.validate(yaml.safe_load(path.read_text(encoding="utf-8")))


def test_it_accepts_the_template() -> None:
    VALIDATOR.validate(yaml.safe_load(template()))


@pytest.mark.parametrize(
    "text",
    [
        "title: x",
        "dh: []",
        "dh: [{theta: q1*, alfa: 0}]",
        "dh: [{theta: q1*}]\nmass: []",
        "dh: [{theta: q1*}]\nmasses: [{mass: m}]",
        "dh: [{theta: q1*}]\nmasses: [{mass: m, link: 0}]",
        "dh: [{theta: q1*}]\nmasses: [{mass: m, link: 1, center: mid}]",
        "dh: [{theta: q1*}]\nmasses: [{mass: m, link: 1, shape: {rod: {len: 1}}}]",
        "dh: [{theta: q1*}]\nmasses: [{mass: m, link: 1, inertia: {zx: 1}}]",
        "dh: [{theta: q1*}]\ngravity: [0, 1]",
    ],
)
def test_it_refuses_what_the_reader_refuses(text: str) -> None:
    assert list(VALIDATOR.iter_errors(yaml.safe_load(text)))


def test_it_knows_every_key_and_describes_it() -> None:
    made = schema()
    body = made["$defs"]["body"]["properties"]
    assert tuple(made["properties"]) == PROBLEM.names
    assert set(body) == set(BODY.names)
    assert tuple(made["$defs"]["row"]["properties"]) == ROW.names
    assert body["center"]["anyOf"][0]["enum"] == list(CENTERS.choices)
    assert body["about"]["enum"] == list(ABOUT.choices)
    assert tuple(body["inertia"]["anyOf"][0]["properties"]) == TENSOR.names
    shapes = [next(iter(s["properties"])) for s in made["$defs"]["shape"]["anyOf"] if "properties" in s]
    assert set(shapes) == set(KINDS) - {"point"}
    assert all(described(node) for node in (*made["properties"].values(), *body.values()))
