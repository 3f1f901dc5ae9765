"""Atoms: the factors of a printed product, and their order.

An atom is whatever is printed as one factor: a mass, a length, cos θ₂, a velocity, a sum
(a₃ + x₃) that recurs as a whole.  Monomials name atoms by number; the table knows the
tree of each and its place in a product.
"""

from __future__ import annotations

from enum import IntEnum

from dynsolve.notation.tree import Function, Node
from dynsolve.notation.walk import children


class Rank(IntEnum):
    """The order in products and sums: √2 m a d (a + b) sin θ (c₁ + c₂) θ̇ (θ̇₁ + θ̇₂)."""

    ROOT = 0  # of a number
    LEADING = 1  # a mass or a moment of inertia
    PARAMETER = 2  # a length, g
    COORDINATE = 3  # d₃ by itself
    SUM = 4  # of those above
    TRIG = 5  # a sine or cosine
    TRIG_SUM = 6  # a sum with sines and cosines in it
    RATE = 7  # a velocity or an acceleration
    RATE_SUM = 8  # a sum with those in it


AtomPlace = tuple[Rank, tuple[int, ...]]
"""Where an atom stands in a product: by its rank, then among those of that rank."""


class AtomTable:
    """The table of atoms: the meaning of the numbers in a monomial, and the order of printing."""

    def __init__(self) -> None:
        self.nodes: list[Node] = []
        self.ranks: list[AtomPlace] = []
        self._numbers: dict[Node, int] = {}

    def number(self, node: Node, rank: Rank | None = None, order: tuple[int, ...] = ()) -> int:
        """The atom of a node, the same for equal nodes; a sum ranks by what it is made of.

        `order` is its place among atoms of one rank, where that is not the order of their numbers.
        """
        found = self._numbers.get(node)
        if found is None:
            rank = self._rank(node) if rank is None else rank
            found = self._numbers[node] = len(self.nodes)
            self.nodes.append(node)
            self.ranks.append((rank, (*order, found)))
        return found

    def _rank(self, node: Node) -> Rank:
        highest = self._highest(node)
        return {Rank.TRIG: Rank.TRIG_SUM, Rank.RATE: Rank.RATE_SUM}.get(highest, max(highest, Rank.SUM))

    def _highest(self, node: Node) -> Rank:
        """The highest rank that occurs in a tree, without what stands inside functions."""
        found = self._numbers.get(node)
        if found is not None:
            return self.ranks[found][0]
        parts = () if isinstance(node, Function) else children(node)
        return max(map(self._highest, parts), default=Rank.ROOT)
