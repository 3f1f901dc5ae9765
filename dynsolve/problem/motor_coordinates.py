"""The coordinates that motors bring: `turns: thm1*`, an angle that no row of the table has."""

from __future__ import annotations

import re
from collections.abc import Collection

from dynsolve.errors import ReadError
from dynsolve.notation.names import normalize
from dynsolve.problem.fields import Fields
from dynsolve.problem.yaml_nodes import ListNode, MappingNode, ScalarNode

STARRED = re.compile(r"(.*\S)\s*\*")
"""A name with the mark of a joint variable."""


def motor_coordinates(fields: Fields, known: Collection[str]) -> dict[str, str]:
    """Their names with their kind, revolute, in the order of the file; those of the table are none.

    What is wrong with a motor is reported where motors are read (`actions`).
    """
    listed = fields.get("motors")
    found: dict[str, str] = {}
    for item in listed.items if isinstance(listed, ListNode) else ():
        for key, value in item.entries if isinstance(item, MappingNode) else ():
            starred = STARRED.fullmatch(value.text.strip()) if isinstance(value, ScalarNode) else None
            if key.decoded != "turns" or starred is None:
                continue
            try:
                name = normalize(starred[1])
            except ReadError:
                continue
            if name not in known:
                found[name] = "revolute"
    return found
