"""The JSON Schema of a problem file, for editors: completion, descriptions, a first check.

It is made from the same tables as the reader (keys, shapes, answers).  It says
what a file looks like; whether it makes sense only `dynsolve lint` can say.
"""

from __future__ import annotations

from typing import Any

Schema = dict[str, Any]

_DRAFT = "https://json-schema.org/draft/2020-12/schema"
_NUMBER = {"type": ["string", "number"]}


def schema() -> Schema:
    """The schema, as data that `json.dumps` prints.

    >>> sorted(schema()["required"])
    ['dh']
    """
    return {
        "$schema": _DRAFT,
        "title": "dynsolve problem",
        "description": "One robot: its Denavit-Hartenberg table, its bodies, what the exercise asks for.",
        "type": "object",
        "required": ["dh"],
        "additionalProperties": False,
        "properties": _properties(),
        "$defs": _definitions(),
    }


def _properties() -> Schema:
    return {
        "title": _text("The name of the robot or of the exercise."),
        "source": _text("Where it comes from; shown in the solution."),
        "convention": {
            "enum": ["standard", "modified"],
            "default": "standard",
            "description": "standard (Spong): A_i = Rot_z(θ) Trans_z(d) Trans_x(a) Rot_x(α). "
            "modified (Craig): A_i = Rot_x(α) Trans_x(a) Rot_z(θ) Trans_z(d).",
        },
        "gravity": {
            "description": "The acceleration of gravity in base coordinates, or none. Default [0, 0, -g].",
            "anyOf": [{"$ref": "#/$defs/vector"}, {"const": "none"}],
        },
        "base": _base(),
        "dh": {
            "type": "array",
            "minItems": 1,
            "maxItems": 30,
            "description": "The Denavit-Hartenberg table, a row a frame; missing columns are 0.",
            "items": {"$ref": "#/$defs/row"},
        },
        "coordinates": {
            "type": "array",
            "items": {"type": "string"},
            "description": "Another order of the generalized coordinates than that of the table.",
        },
        "masses": {
            "type": "array",
            "maxItems": 100,
            "description": "Every body that has mass; a link without one is massless.",
            "items": {"$ref": "#/$defs/body"},
        },
        "values": _map(_NUMBER, "Numbers for numeric results and plots: {L1: 0.4, g: 9.81}."),
        "units": _map({"type": "string"}, "Units of symbols: {L1: m}."),
        "marks": _map(
            {"anyOf": [{"type": "number", "minimum": 0}, {"type": "string"}]},
            "Points for grading, by the name of the answer: {P: 2, K: 4, tau: 6}.",
        ),
        "find": {
            "description": "What the exercise asks for. Default [tau, D, C, g].",
            "anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}}],
        },
    }


def _definitions() -> Schema:
    expression = {
        "type": ["string", "number"],
        "description": "A number, a name or a formula: m1*lc1^2, 9.81, sqrt(3)/2, 90deg.",
    }
    reference = {"$ref": "#/$defs/expression"}
    return {
        "expression": expression,
        "vector": {"type": "array", "items": reference, "minItems": 3, "maxItems": 3},
        "matrix": {"type": "array", "items": {"$ref": "#/$defs/vector"}, "minItems": 3, "maxItems": 3},
        "rotation": {
            "description": "A product of rotations, left to right: Rz(90deg) Rx(30deg); or a 3×3 list.",
            "anyOf": [{"type": "string", "pattern": "^R[xyz] ?\\("}, {"$ref": "#/$defs/matrix"}],
        },
        "row": _object(
            {
                "theta": _described(
                    reference, "θ, the turn about z. A star marks the variable of a revolute joint: theta1*."
                ),
                "d": _described(
                    reference, "d, the way along z. A star marks the variable of a prismatic joint: d2*."
                ),
                "a": _described(reference, "a, the way along x. Constant."),
                "alpha": _described(reference, "α, the turn about x. Constant."),
            }
        ),
        "body": _body(),
        "shape": _shape(),
    }


def _base() -> Schema:
    rotation = {"$ref": "#/$defs/rotation"}
    placed = _object({"rotate": rotation, "move": {"$ref": "#/$defs/vector"}})
    return {
        "description": "Frame 0 in the world: a rotation, or {rotate: ..., move: [0, 0, h]}.",
        "anyOf": [rotation, placed],
    }


def _body() -> Schema:
    from dynsolve.problem.bodies import ABOUT, CENTERS, TENSOR

    reference, rotation = {"$ref": "#/$defs/expression"}, {"$ref": "#/$defs/rotation"}
    vector = {"$ref": "#/$defs/vector"}
    tensor = _object(dict.fromkeys(TENSOR, reference)) | {"minProperties": 1}
    body = _object(
        {
            "mass": _described(reference, "A symbol, a number or an expression."),
            "name": {
                "type": ["string", "integer"],
                "description": "Its index in symbols (K_1): one letter at most, not v or w, then digits.",
            },
            "link": {
                "type": "integer",
                "minimum": 1,
                "description": "The row of the table that it moves with.",
            },
            "center": {
                "description": "The mass centre. Default tip, for a point.",
                "anyOf": [
                    {"enum": list(CENTERS)},
                    _object({"along": reference}) | {"required": ["along"]},
                    _object({"near": vector}) | {"required": ["near"]},
                    vector,
                ],
            },
            "shape": {"$ref": "#/$defs/shape"},
            "inertia": {
                "description": "The tensor in the body-attached frame. Wins over a shape.",
                "anyOf": [tensor, {"$ref": "#/$defs/matrix"}],
            },
            "about": {
                "enum": list(ABOUT),
                "default": "center",
                "description": "The point that the inertia is about.",
            },
            "axes": {
                "description": "The body-attached axes. Default: those of the link's frame.",
                "anyOf": [{"const": "base"}, rotation, _object({"base": rotation}) | {"required": ["base"]}],
            },
        }
    )
    return body | {"required": ["mass", "link"]}


def _shape() -> Schema:
    from dynsolve.robot.shapes import AXES, KINDS

    kinds: list[Schema] = [{"const": "point"}]
    for kind in KINDS.values():
        if not kind.dimensions:
            continue
        dimensions: Schema = {key: {"$ref": "#/$defs/expression"} for key in kind.keys}
        if kind.has_axis:
            dimensions["axis"] = {"enum": list(AXES), "description": "The axis in the body-attached frame."}
        one = _object(dimensions) | {"required": list(kind.keys)}
        kinds.append(_object({kind.name: one}) | {"required": [kind.name]})
    return {"description": "A uniform body: {rod: {length: l1, axis: x}}.", "anyOf": kinds}


def _object(properties: Schema) -> Schema:
    return {"type": "object", "additionalProperties": False, "properties": properties}


def _map(values: Schema, description: str) -> Schema:
    return {"type": "object", "additionalProperties": values, "description": description}


def _text(description: str) -> Schema:
    return {"type": ["string", "number"], "description": description}


def _described(schema: Schema, description: str) -> Schema:
    return {**schema, "description": description}
