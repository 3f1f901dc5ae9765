"""The values at which formulas are compared: every quadrant, sign and order, in few samples."""

from __future__ import annotations

from itertools import combinations, islice, permutations
from math import pi

import pytest

from dynsolve.algebra.ring import Ring
from dynsolve.algebra.ring_values import build_ring
from dynsolve.algebra.sampling import ENOUGH, samples
from dynsolve.notation.tree import Symbol

LENGTHS = ("l1", "l2", "l3", "l4")


def ring_of(kinds: str) -> Ring:
    """A ring with a coordinate for each letter: r turns, p slides."""
    types = {"r": "revolute", "p": "prismatic"}
    coordinates = [(f"q{k}", types[kind]) for k, kind in enumerate(kinds, 1)]
    return build_ring(coordinates, [Symbol(name) for name in LENGTHS])


def quadrant(angle: float) -> int:
    return int(angle // (pi / 2))


@pytest.mark.parametrize("kinds", ["rr", "rrrr", "rrrrrr", "rpr", "prrp"])
def test_every_coordinate_goes_all_round_in_four_samples(kinds: str) -> None:
    for first in (0, 4, 8, 20):
        found = list(islice(samples(ring_of(kinds)), first, first + 4))
        for k, kind in enumerate(kinds, 1):
            values = [at[f"q{k}"] for at in found]
            if kind == "r":
                assert {quadrant(value) for value in values} == {-2, -1, 0, 1}
            else:
                assert sorted(value > 0 for value in values) == [False, False, True, True]


@pytest.mark.parametrize("kinds", ["rr", "rrr", "rrrr"])
def test_any_two_angles_are_in_every_pair_of_quadrants(kinds: str) -> None:
    found = list(islice(samples(ring_of(kinds)), ENOUGH))
    for a, b in combinations(range(1, len(kinds) + 1), 2):
        assert len({(quadrant(at[f"q{a}"]), quadrant(at[f"q{b}"])) for at in found}) == 16


def test_any_angle_is_obtuse_with_any_two_lengths_in_either_order() -> None:
    """Where l1 + l2 cos q2 < 0: the elbow is bent back, and the second link is the longer."""
    found = list(islice(samples(ring_of("rr")), ENOUGH))
    for q in ("q1", "q2"):
        for a, b in permutations(LENGTHS, 2):
            orders = {(abs(at[q]) > pi / 2, at[a] < at[b]) for at in found}
            assert len(orders) == 4


def test_parameters_are_positive_and_rates_of_either_sign() -> None:
    found = list(islice(samples(ring_of("rp"), ["more"]), ENOUGH))
    assert all(at[name] > 0 for at in found for name in LENGTHS)
    for name in ("q1_dot", "q2_dot", "q1_ddot", "q2_ddot", "more"):
        assert sum(at[name] > 0 for at in found) == ENOUGH / 2


def test_samples_are_the_same_every_time() -> None:
    ring = ring_of("rr")
    assert list(islice(samples(ring), 3)) == list(islice(samples(ring), 3))
