"""Angles that turn about parallel axes, together: only they combine in sums like θ₂ + θ₃."""

from __future__ import annotations

from collections.abc import Iterable

from dynsolve.algebra.expr import Pair
from dynsolve.algebra.ring import Ring


def angle_groups(ring: Ring, parallel: Iterable[Iterable[str]] = ()) -> list[tuple[Pair, ...]]:
    """The ring's basic angles by parallel group, from the base outwards; constant angles last.

    Two angles belong together where they share a coordinate, or where their
    coordinates stand in one group of `parallel`.
    """
    given = [frozenset(names) for names in parallel]
    groups: list[tuple[set[str], list[Pair]]] = []
    for pair in ring.pairs:
        names = {name for atom, _ in pair.angle.terms for name, _ in atom}
        for together in given:
            if names & together:
                names |= together
        touching = [group for group in groups if names & group[0]]
        for group in touching:
            groups.remove(group)
            names |= group[0]
        groups.append((names, [member for group in touching for member in group[1]] + [pair]))
    last = len(ring.names)
    groups.sort(
        key=lambda group: min((ring.names.index(n) for n in group[0] if n in ring.names), default=last)
    )
    return [tuple(members) for _, members in groups]
