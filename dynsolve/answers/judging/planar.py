"""Planar robots: vectors and Jacobians without the rows that are zero for every q.

A robot is planar where no point of it ever moves along one axis and everything turns about
that axis alone.  Then 2-vectors, J_v as 2×n, J_ω as 1×n and J as 3×n (the velocity in
the plane, and the rotation) say all that there is to say.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TypeVar

from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.judging.answer_ring import AnswerRing
from dynsolve.quantities import families
from dynsolve.quantities import kinematic_families as asked
from dynsolve.quantities.index import Quantity, quantities

_LINEAR = (
    families.RC, families.V, families.JV, families.JV_BODY,
    asked.P_POINT, asked.V_POINT, asked.JV_POINT, asked.JV_DOT,
)  # fmt: skip
_ANGULAR = (families.W, families.JW, families.JW_BODY, asked.JW_POINT, asked.JW_DOT)
_BOTH = (families.J, asked.J_DOT)
_POSITIONS = (families.RC, asked.P_POINT)

Entry = TypeVar("Entry")


@dataclass(frozen=True, slots=True)
class Plane:
    """The axes across the plane of a robot; several where it slides along one line and turns nowhere."""

    across: tuple[int, ...]

    def kept(self, quantity: Quantity) -> Iterator[tuple[int, ...]]:
        """The rows that may be handed in alone, from 0."""
        for axis in self.across:
            within = tuple(row for row in range(3) if row != axis)
            if quantity.family in _LINEAR:
                yield within
            elif quantity.family in _ANGULAR:
                yield (axis,)
            elif quantity.family in _BOTH:
                yield (*within, 3 + axis)


def plane(answer_ring: AnswerRing) -> Plane | None:
    """The plane of a planar robot, None for all others."""
    named = quantities(answer_ring.robot)
    found = [q for q in named.values() if q.family in (*_LINEAR, *_ANGULAR) and q.family not in _POSITIONS]
    keys = [(q, answer_ring.key(q.rule)) for q in found if q.rule in answer_ring.rules]
    moving = {i for q, key in keys if q.family in _LINEAR for i in _rows_that_move(key)}
    turning = {i for q, key in keys if q.family in _ANGULAR for i in _rows_that_move(key)}
    still = set(range(3)) - moving
    if not still or not turning <= still or len(turning) > 1:
        return None
    return Plane(tuple(sorted(turning or still)))


def _rows_that_move(key: Matrix) -> list[int]:
    return [i for i, row in enumerate(key.rows) if any(not entry.is_zero for entry in row)]


def unfolded(
    answer_ring: AnswerRing, quantity: Quantity, rows: Sequence[Sequence[Entry]], zero: Entry
) -> tuple[tuple[Entry, ...], ...] | None:
    """Rows with those that are zero for every q put in again; None where they do not fit."""
    if quantity.family not in (*_LINEAR, *_ANGULAR, *_BOTH) or quantity.rule not in answer_ring.rules:
        return None
    key: Matrix = answer_ring.key(quantity.rule)
    height, width = key.shape
    given = [list(row) for row in rows]
    if width == 1 and len(given) == 1:
        given = [[entry] for entry in given[0]]
    if len(given) >= height or len(given[0]) != width:
        return None
    found = plane(answer_ring)
    for kept in found.kept(quantity) if found is not None else ():
        left_out = set(range(height)) - set(kept)
        if len(kept) == len(given) and not left_out & set(_rows_that_move(key)):
            filled = dict(zip(kept, given, strict=True))
            return tuple(tuple(filled.get(i, [zero] * width)) for i in range(height))
    return None
