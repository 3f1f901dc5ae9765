"""Matrices of which an exercise asks whether they can be inertia matrices."""

from __future__ import annotations

from dataclasses import dataclass

from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.matrix import Matrix


@dataclass(frozen=True, slots=True)
class Candidate:
    """A matrix, n×n, and what is assumed of its parameters.

    `is_relative` says that the coordinates are those of a chain, each counted from the link before,
    so that an inertia matrix is the same wherever the first one stands.
    """

    name: str
    matrix: Matrix
    assumed: tuple[Bound, ...] = ()
    is_relative: bool = False
