"""Every key of a `set.yaml`, said once: for its reader, its JSON Schema and the documentation.

To add one, write its record here and read it in `set_file.py`.
"""

from __future__ import annotations

from dynsolve.problem.kinds import Key, Keyed, ListOf, MapOf, OneOf, Plain
from dynsolve.problem.schema import Schema, schema_of_file
from dynsolve.problem.value_kinds import NAME, TEXT
from dynsolve.quantities.stages import Stage

_POINTS = Plain("a number", {"type": ["string", "number"], "description": "4, 0.5 or 1/2"})

CAPS = Keyed(tuple(Key(stage, _POINTS) for stage in Stage))

POLICY = Keyed(
    (
        Key(
            "follow",
            _POINTS,
            "The share that an answer earns which follows from an earlier slip. Default 1.",
            "1/2",
            "1",
        ),
        Key(
            "caps",
            CAPS,
            "The most marks that the answers of a stage earn together.",
            "{energy: 5}",
            "no caps",
        ),
        Key(
            "rounding",
            _POINTS,
            "The step that the marks of an answer are rounded to. Default 0.01.",
            "1/2",
            "0.01",
        ),
        Key(
            "late",
            OneOf((_POINTS, ListOf(_POINTS, "a list of shares"))),
            "The share that a late hand-in keeps of what it earns, where the platform says who was late; a "
            "list has the share of each day, the last for all later ones. Default 1.",
            "[0.9, 0.8, 0.5]",
            "1",
        ),
        Key(
            "hints",
            Plain("1, 2 or 3", {"enum": [1, 2, 3]}),
            "1 says where, 2 what kind of slip, 3 how. Default 3.",
            "2",
            "3",
            remedy="write 1 (where), 2 (what kind) or 3 (how)",
        ),
    )
)

SET = Keyed(
    (
        Key("title", TEXT, "The name of the assignment.", "Assignment 2", "the name of the folder"),
        Key(
            "problems",
            ListOf(NAME, "a list of files"),
            "The problem files, in order. Default: all of the folder.",
            "[a.yaml, b.yaml]",
            "all of the folder",
        ),
        Key(
            "marks",
            MapOf(MapOf(_POINTS, "points by answer"), "points by problem and answer"),
            "Points by problem and answer: {in3140-rp: {P: 2, K: 4}}.",
            "{in3140-rp: {P: 2, K: 4}}",
            "those of the problem files",
        ),
        Key("policy", POLICY, example="{follow: 1/2, hints: 2}"),
    )
)
"""The keys of a `set.yaml`, in the order of the documentation."""


def set_schema() -> Schema:
    """The schema, as data that `json.dumps` prints.

    >>> sorted(set_schema()["properties"])
    ['marks', 'policy', 'problems', 'title']
    """
    description = "The problems of a folder, and how hand-ins to them are marked."
    return schema_of_file(SET, "dynsolve problem set", description)
