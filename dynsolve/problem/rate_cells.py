"""Expressions in which rates of coordinates may stand: x' or x_dot."""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import replace

from dynsolve.errors import ReadError
from dynsolve.notation.text import Name, read
from dynsolve.notation.tree import Node, Symbol
from dynsolve.notation.walk import walk
from dynsolve.problem.cells import Cell, read_cell
from dynsolve.problem.source import Faults
from dynsolve.problem.yaml_nodes import ScalarNode, YamlNode

_PRIMES = re.compile(r"(?<=\w)'{1,2}")


def read_rate_cell(
    faults: Faults, node: YamlNode | None, what: str, coordinates: Collection[str]
) -> Cell | None:
    """The expression of a node, None (reported) where it cannot be read; its names are those of no rate."""
    if not isinstance(node, ScalarNode) or not node.text.strip():
        return read_cell(faults, node, what)
    text = _PRIMES.sub(_spelled_out, node.text)
    try:
        reading = read(text, dots=True)
    except ReadError as error:
        at, end = (node.start + _place(node.text, error.offset + k) for k in (0, error.length))
        faults.error((at, max(end, at + 1)), error.message, error.help)
        return None
    rates = {f"{part.name}_{'d' * part.dots}ot": part for part in _rates(reading.tree)}
    cell = Cell(what, reading.tree, (), node.text, node.start)
    names = [_placed(node.text, name) for name in reading.names]
    for name in names:
        if name.name in rates and not _is_rate(faults, cell, name, rates[name.name], coordinates):
            return None
    return replace(cell, names=tuple(name for name in names if name.name not in rates))


def _spelled_out(primes: re.Match[str]) -> str:
    return f"_{'d' * len(primes[0])}ot"


def _rates(tree: Node) -> list[Symbol]:
    return [part for part in walk(tree) if isinstance(part, Symbol) and part.dots]


def _is_rate(faults: Faults, cell: Cell, name: Name, rate: Symbol, coordinates: Collection[str]) -> bool:
    """Whether it is the first derivative of a coordinate; what it is else is reported."""
    if rate.name not in coordinates:
        message = f"{rate.name} is no coordinate, and so has no rate"
        help = f"coordinates are {', '.join(coordinates)}"
    elif rate.dots > 1:
        message = f"the acceleration of {rate.name} stands in {cell.what}"
        help = "energies hold coordinates and rates alone"
    else:
        return True
    faults.error(cell.span_of(name), message, help)
    return False


def _placed(text: str, name: Name) -> Name:
    """A name where it stands in the text before its primes were spelled out."""
    start, end = _place(text, name.offset), _place(text, name.offset + name.length)
    return replace(name, offset=start, length=end - start)


def _place(text: str, offset: int) -> int:
    """The place in the text of a character of it with its primes spelled out."""
    for primes in _PRIMES.finditer(text):
        if primes.start() >= offset:
            break
        longer = len(_spelled_out(primes)) - len(primes[0])
        offset -= min(longer, offset - primes.start())
    return offset
