"""The tables of keys in `problems/README.md`, as Markdown; a test holds that they stand there.

    python -m dynsolve.problem.reference

prints them, to be put there after a key was added.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable, Sequence

from dynsolve.problem.kinds import BRACKETS, Key, Record, Word, either, ways
from dynsolve.problem.specification import BODY, PROBLEM, ROW, SHAPE
from dynsolve.robot.shapes import KINDS

_DEFAULT = re.compile(r" Default:? [^.]*\.$")


def tables() -> tuple[str, ...]:
    """The keys of a file, the columns of a row, the keys of a body, the shapes."""
    return (*map(_keys, (PROBLEM, ROW, BODY)), _shapes())


def _keys(record: Record) -> str:
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
