"""The JSON Schema of a `set.yaml`, for editors."""

from __future__ import annotations

from typing import Any

from dynsolve.quantities.stages import Stage

_NUMBER = {"type": ["string", "number"], "description": "4, 0.5 or 1/2"}


def set_schema() -> dict[str, Any]:
    """The schema, as data that `json.dumps` prints.

    >>> sorted(set_schema()["properties"])
    ['marks', 'policy', 'problems', 'title']
    """
    policy = {
        "follow": _told("The share that an answer earns which follows from an earlier slip. Default 1."),
        "caps": {
            "type": "object",
            "additionalProperties": False,
            "properties": {stage.value: _NUMBER for stage in Stage},
            "description": "The most marks that the answers of a stage earn together.",
        },
        "rounding": _told("The step that the marks of an answer are rounded to. Default 0.01."),
        "late": _told(
            "The share that a late hand-in keeps, where the platform says who was late. Default 1."
        ),
        "hints": {"enum": [1, 2, 3], "description": "1 says where, 2 what kind of slip, 3 how. Default 3."},
    }
    marks = {"type": "object", "additionalProperties": _NUMBER}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "dynsolve problem set",
        "description": "The problems of a folder, and how hand-ins to them are marked.",
        "type": "object",
        "additionalProperties": False,
        "properties": {
            "title": {"type": ["string", "number"], "description": "The name of the assignment."},
            "problems": {
                "type": "array",
                "items": {"type": "string"},
                "description": "The problem files, in order. Default: all of the folder.",
            },
            "marks": {
                "type": "object",
                "additionalProperties": marks,
                "description": "Points by problem and answer: {in3140-rp: {P: 2, K: 4}}.",
            },
            "policy": {"type": "object", "additionalProperties": False, "properties": policy},
        },
    }


def _told(description: str) -> dict[str, Any]:
    return {**_NUMBER, "description": description}
