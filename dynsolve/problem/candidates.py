"""`candidates`, `assume` and `chain` of a problem file: matrices to be judged, and what is assumed.

Matrices that are to be judged, and what is assumed of their parameters, with exact values.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from itertools import pairwise

from msgspec import Struct

from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.matrix import Matrix
from dynsolve.errors import ReadError
from dynsolve.notation.characters import normalize
from dynsolve.problem.action_keys import ASSUME, CANDIDATES, CHAIN, MAX_ASSUMED, MAX_CANDIDATES
from dynsolve.problem.cells import Cell, forbid, read_text
from dynsolve.problem.kinds import Fields, describe, did_you_mean, word
from dynsolve.problem.mechanism import read_square
from dynsolve.problem.values import CellValues
from dynsolve.problem.yaml_nodes import Faults, FaultyNode, ListNode, MappingNode, ScalarNode, YamlNode
from dynsolve.robot.actions import Candidate

# `candidates`, `assume` and `chain` of a problem file

_SIGN = re.compile(r">=|<=|[<>≥≤]")
EVERY = ""
"""The name under which stands what is assumed of all matrices."""


class ParsedInequality(Struct, frozen=True):
    """left > right, or ≥ where it is not strict."""

    left: Cell
    right: Cell
    is_strict: bool


class ParsedCandidates(Struct, frozen=True):
    """The matrices by name, and what is assumed of each, or under no name of all."""

    matrices: Mapping[str, tuple[tuple[Cell, ...], ...]]
    assumed: Mapping[str, tuple[ParsedInequality, ...]]
    is_relative: bool = False
    faulty: bool = False

    @property
    def moving(self) -> Iterator[Cell]:
        """The entries of the matrices."""
        for rows in self.matrices.values():
            for row in rows:
                yield from row

    @property
    def constant(self) -> Iterator[Cell]:
        """The sides of the inequalities."""
        for inequalities in self.assumed.values():
            for one in inequalities:
                yield from (one.left, one.right)


def read_candidates(faults: Faults, fields: Fields, coordinates: Mapping[str, str]) -> ParsedCandidates:
    """The matrices of a file and what is assumed; everything wrong with them is reported."""
    before = len(faults.errors)
    matrices = dict(_read_matrices(faults, fields.get("candidates"), len(coordinates)))
    assumed = _read_assumed(faults, fields.get("assume"), matrices)
    for inequalities in assumed.values():
        for one in inequalities:
            forbid(faults, (one.left, one.right), coordinates, "it is said of parameters alone")
    chain = word(faults, fields.get("chain"), CHAIN.choices, "chain", "write chain: relative")
    return ParsedCandidates(matrices, assumed, chain is not None, len(faults.errors) > before)


def _read_matrices(
    faults: Faults, node: YamlNode | None, n: int
) -> Iterator[tuple[str, tuple[tuple[Cell, ...], ...]]]:
    if not isinstance(node, MappingNode):
        if node is not None and not isinstance(node, FaultyNode):
            faults.error(node.span, f"candidates are matrices by name, not {describe(node)}", CANDIDATES.help)
        return
    if len(node.entries) > MAX_CANDIDATES:
        message = f"{len(node.entries)} candidates; at most {MAX_CANDIDATES} are read"
        faults.error(node.span, message, "leave some out")
    for key, value in node.entries[:MAX_CANDIDATES]:
        try:
            name = normalize(key.decoded)
        except ReadError as error:
            at = key.start + error.offset
            faults.error((at, at + error.length), error.message, error.help)
            continue
        rows = read_square(faults, value, name, n, CANDIDATES.help) if n else None
        if rows is not None:
            yield name, rows


def _read_assumed(
    faults: Faults, node: YamlNode | None, names: Mapping[str, object]
) -> dict[str, tuple[ParsedInequality, ...]]:
    if isinstance(node, MappingNode):
        found = {}
        for key, value in node.entries:
            if key.decoded not in names:
                help = did_you_mean(key.decoded, names) or "it is said of a candidate by its name"
                faults.error(key.span, f"there is no candidate {key.decoded}", help)
            found[key.decoded] = tuple(_inequalities(faults, value))
        return found
    return {EVERY: tuple(_inequalities(faults, node))}


def _inequalities(faults: Faults, node: YamlNode | None) -> Iterator[ParsedInequality]:
    if node is None or isinstance(node, FaultyNode):
        return
    if not isinstance(node, ListNode):
        faults.error(node.span, f"assume is a list of inequalities, not {describe(node)}", ASSUME.help)
        return
    for item in node.items[:MAX_ASSUMED]:
        if isinstance(item, ScalarNode):
            yield from _inequality(faults, item)
        elif not isinstance(item, FaultyNode):
            faults.error(item.span, f"an inequality is expected, not {describe(item)}", ASSUME.help)


def _inequality(faults: Faults, node: ScalarNode) -> Iterator[ParsedInequality]:
    """a > b, or a > b > c as a > b and b > c."""
    signs = list(_SIGN.finditer(node.text))
    if not signs:
        faults.error(node.span, f"`{node.text[:40]}` is no inequality", ASSUME.help)
        return
    ends = [0, *(sign.end() for sign in signs)]
    starts = [*(sign.start() for sign in signs), len(node.text)]
    sides = [
        read_text(faults, node.text[a:b], node.start + a, "an inequality")
        for a, b in zip(ends, starts, strict=True)
    ]
    for sign, (left, right) in zip(signs, pairwise(sides), strict=True):
        if left is not None and right is not None:
            is_strict = sign[0] in "<>"
            yield ParsedInequality(*((left, right) if sign[0][0] in ">≥" else (right, left)), is_strict)


# Matrices that are to be judged, and what is assumed of their parameters, with exact values


def candidates(values: CellValues, parsed: ParsedCandidates, given: Matrix | None) -> tuple[Candidate, ...]:
    """The matrices to be judged, or the D that a model is given by; what is wrong is reported."""
    every = _bounds(values, parsed.assumed.get(EVERY, ()))
    if not parsed.matrices:
        return (Candidate("D", given, every, parsed.is_relative),) if given is not None else ()
    made = []
    for name, cells in parsed.matrices.items():
        rows = [[values.expr(cell) for cell in row] for row in cells]
        known = [[entry for entry in row if entry is not None] for row in rows]
        if all(len(row) == len(cells) for row in known):
            own = _bounds(values, parsed.assumed.get(name, ()))
            made.append(Candidate(name, Matrix.of(values.ring, known), (*every, *own), parsed.is_relative))
    return tuple(made)


def assumed(values: CellValues, parsed: ParsedCandidates) -> tuple[Bound, ...]:
    """What is assumed of the parameters, whatever matrix they stand in."""
    return _bounds(values, parsed.assumed.get(EVERY, ()))


def _bounds(values: CellValues, parsed: tuple[ParsedInequality, ...]) -> tuple[Bound, ...]:
    found = []
    for one in parsed:
        left, right = values.expr(one.left), values.expr(one.right)
        if left is not None and right is not None:
            found.append(Bound(left - right, one.is_strict))
    return tuple(found)
