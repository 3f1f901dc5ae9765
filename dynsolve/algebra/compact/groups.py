"""Angles that turn about parallel axes, together: only they combine in sums like θ₂ + θ₃."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.compact.choice import FormChoice
from dynsolve.algebra.compact.constant_forms import ConstantForms
from dynsolve.algebra.generators import Pair
from dynsolve.algebra.ring import Ring


@dataclass(frozen=True, slots=True)
class AngleGroup:
    """Basic angles that combine, the indices of their generators, and the choice of form for them."""

    angles: tuple[Angle, ...]
    places: tuple[int, ...]
    forms: FormChoice

    def angle(self, multiples: Sequence[int]) -> Angle:
        """The angle of these multiples of the basic ones."""
        total = Angle()
        for basic, multiple in zip(self.angles, multiples, strict=True):
            total = total + basic * multiple
        return total


def angle_groups(ring: Ring, parallel: Iterable[Iterable[str]] = ()) -> list[AngleGroup]:
    """The ring's angles in groups, from the base outwards; constant ones last."""
    groups = [
        AngleGroup(
            tuple(pair.angle for pair in pairs),
            tuple(i for pair in pairs for i in (pair.sine, pair.cosine)),
            FormChoice(),
        )
        for pairs in _parallel_pairs(ring, parallel)
    ]
    constant = [
        AngleGroup((g.angle,), (g.index,), FormChoice(ConstantForms(g.angle.degrees)))
        for g in ring.generators
        if g.kind == "constant"
    ]
    return groups + constant


def _parallel_pairs(ring: Ring, parallel: Iterable[Iterable[str]]) -> list[tuple[Pair, ...]]:
    """The ring's basic angles by parallel group, from the base outwards.

    Two angles belong together where they share a coordinate, or where their
    coordinates stand in one group of `parallel`.
    """
    given = [frozenset(names) for names in parallel]
    groups: list[tuple[set[str], list[Pair]]] = []
    for pair in ring.pairs:
        names = {name for atom, _ in pair.angle.terms for name, _ in atom}
        names = names & set(ring.names) or names
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
