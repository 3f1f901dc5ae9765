"""Configurations that reach a target, found in numbers: where no closed form is known, or one fails.

Newton's method with the pseudoinverse of the Jacobian, q ← q + J⁺ (target - r(q)), from many
starts of a fixed seed, all of them side by side (Spong, section 5.5 (2006); Siciliano, section 3.7).
What it finds is put into r(q); what it does not find may still be there.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import pi
from typing import Any

import numpy as np
import numpy.typing as npt
from msgspec import Struct

from dynsolve.algebra.ring import Ring
from dynsolve.derivation.reached import same_configuration
from dynsolve.notation.tree import Node
from dynsolve.notation.tree_values import Program, compile_trees

Array = npt.NDArray[np.float64]

STARTS = 200
STEPS = 50
SEED = 2006

ACCURATE = 1e-10
"""What r(q) may be off at a configuration that counts, lengths and angles being about 1."""

_DIFFERENCE = 1e-6
_LONGEST_STEP = 0.6
_SINGULAR = 1e-7

_FUNCTIONS = {"sin": np.sin, "cos": np.cos, "tan": np.tan, "sqrt": np.sqrt}


class Found(Struct, frozen=True):
    """Configurations that stand alone, and others, at which the Jacobian has less than rank n.

    Around the others there may be infinitely many.
    """

    isolated: tuple[Mapping[str, float], ...]
    others: tuple[Mapping[str, float], ...]


def search(
    ring: Ring,
    task: Node,
    angles: Sequence[bool],
    given: Mapping[str, float],
    target: Sequence[float],
) -> Found:
    """Every configuration with r(q) = target that is found; `given` are the values of the parameters.

    `task` is r(q), m×1, `angles` says which of its components count modulo 2π.
    """
    system = _System(ring, compile_trees([task], _FUNCTIONS), np.array(angles), given, np.array(target))
    isolated: list[Mapping[str, float]] = []
    others: list[Mapping[str, float]] = []
    for q, is_alone in system.solutions():
        kept = isolated if is_alone else others
        if not any(same_configuration(ring, q, other) for other in kept):
            kept.append(q)
    return Found(tuple(isolated), tuple(others))


class _System(Struct, frozen=True, dict=True):
    """r(q) = target; configurations are the columns of an n×k array."""

    ring: Ring
    program: Program
    angles: npt.NDArray[np.bool_]
    given: Mapping[str, float]
    target: Array

    def solutions(self) -> Iterator[tuple[dict[str, float], bool]]:
        """What the starts lead to, with whether the Jacobian has rank n there."""
        names = [name for name, _ in self.ring.coordinates]
        turning = np.array([kind == "revolute" for _, kind in self.ring.coordinates])
        q = self._starts(turning)
        with np.errstate(all="ignore"):
            for _ in range(STEPS):
                if np.abs(self._gap(q)).max() < ACCURATE:
                    break
                step = (np.linalg.pinv(self._jacobians(q), rcond=1e-12) @ self._gap(q).T[:, :, None])[
                    :, :, 0
                ].T
                longest = np.abs(step).max(axis=0)
                q = q + step * np.minimum(1.0, _LONGEST_STEP / np.maximum(longest, _LONGEST_STEP))
        q = q[:, np.isfinite(q).all(axis=0)]
        q = q[:, np.abs(self._gap(q)).max(axis=0) < ACCURATE * max(1.0, float(np.abs(self.target).max()))]
        wrapped = np.where(turning[:, None], (q + pi) % (2 * pi) - pi, q)
        sizes = np.linalg.svd(self._jacobians(q), compute_uv=False)
        for column, values in zip(wrapped.T, sizes, strict=True):
            alone = len(values) == len(names) and values[-1] > _SINGULAR * max(1.0, values[0])
            yield dict(zip(names, map(float, column), strict=True)), bool(alone)

    def _starts(self, turning: npt.NDArray[np.bool_]) -> Array:
        """Angles all around, lengths as long as what is given."""
        random = np.random.default_rng(SEED)
        reach = 1.0 + float(np.abs(self.target[~self.angles]).sum()) if not self.angles.all() else 1.0
        scale = np.where(turning, pi, reach)
        return random.uniform(-1, 1, (len(turning), STARTS)) * scale[:, None]

    def _task(self, q: Array) -> Array:
        """r(q), m×k."""
        values: dict[str, Any] = dict(self.given)
        values |= {name: row for (name, _), row in zip(self.ring.coordinates, q, strict=True)}
        (rows,) = self.program.run(values)
        return np.array([np.broadcast_to(entry, q.shape[1:]) for (entry,) in rows])

    def _gap(self, q: Array) -> Array:
        """target - r(q), angles the shortest way round."""
        gap = self.target[:, None] - self._task(q)
        return np.where(self.angles[:, None], (gap + pi) % (2 * pi) - pi, gap)

    def _jacobians(self, q: Array) -> Array:
        """∂r/∂q by central differences, k×m×n."""
        columns = []
        for k in range(len(q)):
            step = np.zeros_like(q)
            step[k] = _DIFFERENCE
            columns.append((self._task(q + step) - self._task(q - step)) / (2 * _DIFFERENCE))
        return np.moveaxis(np.array(columns), (0, 1, 2), (2, 1, 0))
