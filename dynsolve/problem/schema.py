"""The JSON Schema of a problem file, for editors: completion, descriptions, a first check.

It is made from the specification of the keys.  It says what a file looks like;
whether it makes sense only `dynsolve lint` can say.

The documentation of the keys of a problem file, made from their specification.

`template` is the file that `dynsolve new` writes: valid as it stands, with every key and
its meaning; an `active` key stands with its example, any other as a comment that can be
uncommented.  `tables` are those in `problems/README.md`, as Markdown; a test holds that
they stand there, and

    python -m dynsolve.problem.schema

prints them, to be put there after a key was added.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable, Sequence
from textwrap import wrap
from typing import Any

from dynsolve.problem.kinds import (
    BRACKETS,
    Expression,
    Key,
    Keyed,
    ListOf,
    MapOf,
    OneOf,
    Plain,
    Shared,
    ValueKind,
    Word,
    either,
    ways,
)
from dynsolve.problem.specification import BODY, PLACED_BODY, PROBLEM, ROW, SHAPE
from dynsolve.robot.shapes import KINDS

Schema = dict[str, Any]

_PLAIN = {"true": True, "false": False, "1": 1, "2": 2}
"""What an editor makes of these words before it looks at the schema."""

_FORMULA = Shared(
    "expression", Plain("", {"type": ["string", "number"]}), Expression.called, Expression.meaning
)

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
        case Expression():
            return _schema_of(_FORMULA, shared)
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


# The documentation of the keys of a problem file, made from their specification

_WIDTH = 110
_SENTENCE_END = re.compile(r"(?<=[.]) (?=[A-Za-z])")
_DEFAULT = re.compile(r" Default.*$")
_FIXED_BLANK = "\N{NO-BREAK SPACE}"


FIRST = """\
# An arm with two revolute joints in a vertical plane, to be changed into yours.
# `dynsolve lint FILE` says what is wrong with it, `dynsolve solve FILE` solves it,
# `dynsolve docs problem-file` has every key.
title: My arm

# The acceleration of gravity in frame 0: y0 points upwards.
gravity: [0, -g, 0]

# The Denavit-Hartenberg table, a row a frame; columns that are 0 may be left out.
# A star marks a joint variable: in theta the joint turns, in d it slides.
# Angles: 90deg, pi/2, or a letter.
dh:
  - {theta: q1*, d: 0, a: l1, alpha: 0}
  - {theta: q2*, d: 0, a: l2, alpha: 0}

# Every body that has mass. center: tip, origin, midpoint, {along: 1/3}, or
# {near: [lc1, 0, 0]}, measured from the joint; inertia about the mass centre, or
# a shape: {rod: {length: l1}}, or neither for a point.
masses:
  - {mass: m1, link: 1, center: {near: [lc1, 0, 0]}, inertia: {zz: I1}}
  - {mass: m2, link: 2, center: midpoint, shape: {rod: {length: l2}}}

# What is asked for: tau, D, C, g, K, P, L, H, J, singular, equilibria, ...
find: [D, C, g, tau]

# Numbers, for results in numbers and the proportions of the picture.
values: {l1: 0.4, l2: 0.3, lc1: 0.2, m1: 2, m2: 1, I1: 0.03, g: 9.81}
"""
"""What `dynsolve new` writes."""


def template() -> str:
    """Every key with an example and its meaning, a valid problem file."""
    return "\n".join(map(_entry, PROBLEM.keys))


def _entry(key: Key) -> str:
    """A key with its example, under a comment that says what it means."""
    sentences = _SENTENCE_END.split(f"{key.described} {key.more}".strip())
    comment = [line for sentence in sentences for line in _wrapped("# ", sentence)]
    example = f"{key.name}: {key.example}".replace(": \n", ":\n").replace("\n", "\n  ")
    if not key.active:
        example = "# " + example.replace("\n", "\n# ")
    return "\n".join([*comment, *_parts(key), example, ""])


def _parts(key: Key) -> list[str]:
    """The keys of each item of a list, a line each."""
    items = key.kind.items if isinstance(key.kind, ListOf) else None
    items = items.kinds[0] if isinstance(items, OneOf) else items
    record = items.kind if isinstance(items, Shared) else items
    if not isinstance(record, Keyed):
        return []
    width = max(map(len, record.names)) + 2
    return [
        line
        for part in record.keys
        for line in _wrapped(f"#   {part.name:{width}}", part.described + _choice(part.kind))
    ]


def _choice(kind: ValueKind) -> str:
    """The ways in which a value can be written, where there are several."""
    kind = kind.kind if isinstance(kind, Shared) else kind
    return f" Write {either(ways(kind))}.".replace("`", "") if isinstance(kind, OneOf | Word) else ""


def _wrapped(head: str, text: str) -> list[str]:
    """The lines of a comment after its head; what stands in brackets is not broken."""
    whole = BRACKETS.sub(lambda found: found[0].replace(" ", _FIXED_BLANK), text)
    indent = "#" + " " * (len(head) - 1)
    lines = wrap(whole, _WIDTH, initial_indent=head, subsequent_indent=indent, break_on_hyphens=False)
    return [line.replace(_FIXED_BLANK, " ") for line in lines]


def tables() -> tuple[str, ...]:
    """The keys of a file, the columns of a row, the keys of a body and of one by its position, the shapes."""
    return (*map(table_of_keys, (PROBLEM, ROW, BODY, PLACED_BODY)), _shapes())


def table_of_keys(record: Keyed) -> str:
    """The keys of a mapping, a row each."""
    return _table(("key", "value", "default", "meaning"), map(_row, record.keys))


def _row(key: Key) -> tuple[str, ...]:
    default = f"`{key.default}`" if isinstance(key.kind, Word) else key.default
    values = key.kind.called if key.kind is SHAPE else either(ways(key.kind))
    meaning = _DEFAULT.sub("", key.described)  # which has a column of its own
    return (
        f"`{key.name}`",
        values,
        "must be given" if key.required else default,
        BRACKETS.sub(r"`\g<0>`", meaning),
    )


def _shapes() -> str:
    rows = []
    for shape in KINDS.values():
        moments = shape.moments or ("0", "0", "0")
        letters = [f"`{key}`" + (f" {letter}" if letter != key else "") for key, letter in shape.dimensions]
        axis = "" if not shape.has_axis else "along the link" if shape.along_link else "`z`"
        rows.append((f"`{shape.name}`", ", ".join(letters), axis, *(f"`{moment}`" for moment in moments)))
    return _table(("shape", "dimensions", "axis, if not given", "I_xx", "I_yy", "I_zz"), rows)


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "".join(f"| {' | '.join(cells)} |\n".replace("|  |", "| |") for cells in lines)


if __name__ == "__main__":
    sys.stdout.write("\n".join(tables()))
