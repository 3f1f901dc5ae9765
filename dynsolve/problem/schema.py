"""The JSON Schema of a problem file, for editors: completion, descriptions, a first check.

It is made from the specification of the keys.  It says what a file looks like;
whether it makes sense only `dynsolve lint` can say.
"""

from __future__ import annotations

from typing import Any

from dynsolve.problem.kinds import Key, Keyed, ListOf, MapOf, OneOf, Plain, Shared, ValueKind, Word
from dynsolve.problem.specification import PROBLEM

Schema = dict[str, Any]

_PLAIN = {"true": True, "false": False, "1": 1, "2": 2}
"""What an editor makes of these words before it looks at the schema."""

_DRAFT = "https://json-schema.org/draft/2020-12/schema"


def schema() -> Schema:
    """The schema, as data that `json.dumps` prints.

    >>> schema()["oneOf"][0]
    {'required': ['dh']}
    """
    description = "One robot: its Denavit-Hartenberg table, its bodies, what the exercise asks for."
    return schema_of_file(PROBLEM, "dynsolve problem", description)


def schema_of_file(keys: Keyed, title: str, description: str) -> Schema:
    """The schema of a file with these keys."""
    shared: dict[str, Schema] = {}
    head = {"$schema": _DRAFT, "title": title, "description": description}
    return {**head, **_schema_of(keys, shared), **_given({"$defs": shared or None})}


def _schema_of(kind: ValueKind, shared: dict[str, Schema]) -> Schema:
    """What JSON Schema says of a kind of value; kinds of several keys are gathered in `shared`."""
    match kind:
        case Plain(_, json):
            return dict(json)
        case Word((only,)):
            return {"const": only}
        case Word(choices):
            return {"enum": [*choices, *(_PLAIN[word] for word in choices if word in _PLAIN)]}
        case ListOf(items, _, least, most):
            bounds = {"minItems": least or None, "maxItems": most}
            return {"type": "array", "items": _schema_of(items, shared), **_given(bounds)}
        case MapOf(values):
            return {"type": "object", "additionalProperties": _schema_of(values, shared)}
        case Keyed(keys, least, one_of):
            required = [key.name for key in kind.required]
            one = [{"required": [name]} for name in one_of]
            return {
                "type": "object",
                "additionalProperties": False,
                "properties": {key.name: _schema_of_key(key, shared) for key in keys},
                **_given(
                    {"required": required or None, "minProperties": least or None, "oneOf": one or None}
                ),
            }
        case OneOf(kinds):
            return {"anyOf": [_schema_of(one, shared) for one in kinds]}
        case Shared(name, inner, _, meaning):
            if name not in shared:
                shared[name] = {}  # keeps its place before the kinds that it is made of
                shared[name] |= {**_given({"description": meaning or None}), **_schema_of(inner, shared)}
            return {"$ref": f"#/$defs/{name}"}


def _schema_of_key(key: Key, shared: dict[str, Schema]) -> Schema:
    words = key.kind.choices if isinstance(key.kind, Word) else ()
    told = {"description": key.meaning or None, "default": key.default if key.default in words else None}
    return {**_schema_of(key.kind, shared), **_given(told)}


def _given(entries: Schema) -> Schema:
    return {name: value for name, value in entries.items() if value is not None}
