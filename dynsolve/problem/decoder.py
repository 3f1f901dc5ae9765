"""Nodes -> values, by what the specification says of their keys.

A `Record` is a mapping of the file: the value of each key as its kind has it, and where it stands.  An
expression is a `Cell`, a vector three of them, a word or the name of a coordinate a string, a link a number,
a rotation a `ParsedRotation`.  A value that was reported is None, as one that is not given; what a kind does
not say (a name of a body, a tensor) is read by the file of its part.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from dynsolve.algebra.angles import Angle
from dynsolve.notation.tree import Function
from dynsolve.problem.base import ParsedRotation, read_rotation
from dynsolve.problem.cells import Cell, forbid, read_cell, read_vector
from dynsolve.problem.kinds import (
    ROTATION,
    Coordinate,
    Expression,
    Fields,
    Key,
    Keyed,
    Link,
    ListOf,
    Shared,
    ValueKind,
    Word,
    describe,
    items,
    read_link,
    word,
)
from dynsolve.problem.table import STARRED, coordinate_name, known_coordinate
from dynsolve.problem.yaml_nodes import Faults, FaultyNode, ListNode, MappingNode, ScalarNode, YamlNode


class Record(Fields):
    """A mapping of the file with the values of its keys; what is wrong with one is reported."""

    def __init__(self, decoder: Decoder, node: MappingNode, kind: Keyed, what: str, index: int = 0) -> None:
        before = len(decoder.faults.errors)
        super().__init__(decoder.faults, node, kind.names, what)
        self.index = index
        for key in kind.required:
            if self.lacks(key.name):
                self.faults.error(
                    self.span, f"{what} has no `{key.name}`", f"add {key.help.removeprefix('write ')}"
                )
        self._decoded = {
            key.name: decoder.value(key, self.get(key.name), what)
            for key in kind.keys
            if key.name in self and not key.own
        }
        self.faulty = len(decoder.faults.errors) > before

    def __getitem__(self, key: str) -> Any:
        """The value of a key, None where it is not given or was reported."""
        return self._decoded.get(key)

    def __setitem__(self, key: str, value: Any) -> None:
        """Put in what the file of its part has read."""
        self._decoded[key] = value


class Stated(NamedTuple):
    """An expression that was decoded: what a symbol is that stands alone in it.

    `moves` says that coordinates may stand in it; it is None of an `angle` that is turned by.
    """

    cell: Cell
    role: str = ""
    moves: bool | None = True
    angle: Angle | None = None


class Decoder:
    """Decodes the values of one file: `coordinates` are their types by name, `rows` those of the table.

    `stated` gathers the expressions that were decoded, in the order of the keys, `functions` what stands in
    none of them.
    """

    def __init__(self, faults: Faults, coordinates: Mapping[str, str], rows: int) -> None:
        self.faults, self.coordinates, self.rows = faults, coordinates, rows
        self.stated: list[Stated] = []
        self.functions: list[Function] = []

    def value(self, key: Key, node: YamlNode | None, of: str) -> Any:
        """The value of a key of the mapping `of`; None where it was reported, or nothing is decoded."""
        what = (key.called or "`{key}` of {of}").format(key=key.name, of=of, last=of.rpartition(" of ")[2])
        return self._value(key.kind, node, what, key)

    def _value(self, kind: ValueKind, node: YamlNode | None, what: str, key: Key) -> Any:
        if kind is ROTATION:
            return read_rotation(self.faults, node, what)
        match kind:
            case Shared():
                return self._value(kind.kind, node, what, key)
            case Expression():
                return self.cell(kind, read_cell(self.faults, node, what))
            case ListOf(Expression() as entry, _, 3, 3):
                cells = read_vector(self.faults, node, what)
                return cells and tuple(self.cell(entry, cell) for cell in cells)
            case Word(choices):
                return word(self.faults, node, choices, what, key.remedy)
            case Coordinate():
                return node and self._coordinate(kind, node, key.help)
            case Link():
                return read_link(self.faults, node, self.rows, kind.ground)
        return None

    def cell(self, kind: Expression, cell: Cell | None) -> Cell | None:
        """A cell as one of this kind; a coordinate that may not stand in it is reported."""
        self.keep([cell], kind.role, kind.constant)
        return cell

    def keep(self, cells: Iterable[Cell | None], role: str = "", constant: str = "") -> None:
        """Gather expressions; `role` and `constant` are those of an `Expression`."""
        known = [cell for cell in cells if cell]
        self.stated += [Stated(cell, role, not constant) for cell in known]
        if constant:
            forbid(self.faults, known, self.coordinates, constant)

    def keep_rotation(self, rotation: ParsedRotation, constant: str = "") -> None:
        """Gather the angles and the entries of a rotation."""
        self.stated += [Stated(turn.cell, "an angle", None, turn.angle) for turn in rotation.turns]
        self.keep(rotation.entries, constant=constant)
        if constant:
            forbid(self.faults, (turn.cell for turn in rotation.turns), self.coordinates, constant)

    def _coordinate(self, kind: Coordinate, node: YamlNode, help: str) -> str | None:
        starred = STARRED.fullmatch(node.text.strip()) if isinstance(node, ScalarNode) else None
        if not (kind.new and starred):
            return known_coordinate(self.faults, node, self.coordinates, help)
        name = coordinate_name(self.faults, node, help)
        if name is not None and name not in self.coordinates:
            self.faults.error(node.span, f"`{starred[1]}` cannot be a coordinate", help)
        return name

    def entries(self, fields: Fields, key: Key) -> Iterator[Record]:
        """The mappings in the list under a key, each decoded when it is taken; what is none is reported."""
        kind = key.kind
        assert isinstance(kind, ListOf) and isinstance(kind.items, Shared)
        record = kind.items.kind
        assert isinstance(record, Keyed)
        for index, node in enumerate(self.listed(fields, key), 1):
            what = f"{kind.items.called.partition(' ')[2]} {index}"
            if isinstance(node, MappingNode):
                yield Record(self, node, record, what, index)
            elif not isinstance(node, FaultyNode):
                self.faults.error(node.span, f"{what} is not a mapping but {describe(node)}", key.help)

    def listed(self, fields: Fields, key: Key) -> Sequence[YamlNode]:
        """The items of the list under a key, no more of them than are read."""
        kind, node = key.kind, fields.get(key.name)
        assert isinstance(kind, ListOf)
        found = items(self.faults, node, key.name, kind.told + key.help)
        if node is None:
            return found
        span = fields.key_span(key.name) if kind.at_key else node.span
        if kind.most is not None and len(found) > kind.most:
            message = f"{len(found)} {kind.called.rpartition(' ')[2]}; at most {kind.most} are read"
            self.faults.error(span, message, "leave some out")
            return found[: kind.most]
        if kind.empty and isinstance(node, ListNode) and not found:
            self.faults.error(span, kind.empty, key.help)
        return found
