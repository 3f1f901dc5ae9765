"""Fractions of sines and cosines in lowest terms: what is shared as a product of half angles goes, too."""

from __future__ import annotations

import pytest

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.factors import ratio
from dynsolve.algebra.fraction import RationalExpr, cancelled, equal, with_integers
from dynsolve.algebra.linear_systems import primitive
from dynsolve.algebra.lowest_terms import is_decided
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_values import build_ring, value_of
from dynsolve.algebra.spaces import dependent_where, nullspace
from dynsolve.notation.text import read
from dynsolve.notation.tree import Symbol

Q1, BOTH, DELTA = Angle.of("q1"), Angle.of("q1") + Angle.of("q2"), Angle.of("delta")
RING = build_ring(
    [("q1", "revolute"), ("q2", "revolute")],
    [Symbol("l"), Symbol("m"), read("sqrt(2) + pi + sqrt(l + m)").tree],
    [Q1, BOTH, DELTA],
)


def value(text: str) -> Expr:
    return value_of(RING, read(text).tree)


FRACTIONS = {
    "sin(2*q1 + q2)*l / sin(q2)*sin(2*q1 + q2)": "l / sin(q2)",
    "cos(2*q1 + q2) - 1 / m*(cos(q1) - cos(q1 + q2))^2": "-1 / m*(1 - cos(q2))",
    "1 + cos(q2) / sin(q2)^2": "1 / 1 - cos(q2)",
    "1 - cos(q1) / sin(q1)": "sin(q1) / 1 + cos(q1)",
    "sin(q1) / 1 + cos(q1)": "sin(q1) / 1 + cos(q1)",
    "sin(q1 + delta)*l / cos(delta)^2 - cos(q1)^2": "l / sin(q1 - delta)",
    "sin(q1)*(cos(q1) + l) / 1 - cos(q1)^2": "cos(q1) + l / sin(q1)",
    "2*cos(q1)^2 - 1 / cos(q1) - sqrt(2)/2": "2*cos(q1) + sqrt(2) / 1",
    "l*sin(q1) / m*cos(q1)": "l*sin(q1) / m*cos(q1)",
}
"""Fractions, above / below, and the same in lowest terms."""


@pytest.mark.parametrize("text", FRACTIONS)
def test_a_fraction_in_lowest_terms(text: str) -> None:
    above, below = map(value, text.split(" / "))
    wanted_above, wanted_below = map(value, FRACTIONS[text].split(" / "))
    found = cancelled(RationalExpr(above, below))
    assert equal(found, RationalExpr(above, below))
    assert ratio(found.denominator, wanted_below) * wanted_below == found.denominator
    assert ratio(found.numerator, wanted_above) * wanted_above == found.numerator


def test_a_vector_without_what_its_entries_share() -> None:
    shared = value("l*sin(delta) - m*cos(delta)")
    vector = [RING.zero, value("cos(delta)") * shared, value("sin(delta)") * shared]
    assert primitive(vector) == [RING.zero, value("cos(delta)"), value("sin(delta)")]


def test_what_half_an_angle_shares_stays_where_no_vector_is_without() -> None:
    vector = [value("sin(q1)"), value("1 + cos(q1)")]
    assert primitive([entry * entry for entry in vector]) == [value("cos(q1) - 1"), value("-1 - cos(q1)")]
    assert primitive(vector) == vector


def row(text: str) -> Matrix:
    return Matrix.of(RING, [map(value, text.split(", "))])


@pytest.mark.parametrize(
    ("text", "where"),
    [
        ("q1, q2, l", "l"),  # the last column is the one that depends on the others
        ("cos(q1), sin(q1), q2", "1"),  # their squares add up to 1
        ("m*sin(q1), l*sin(q1), m*sin(q1)", "1"),
        ("sin(q1), 1 + cos(q1)", "1 + cos(q1)"),
    ],
)
def test_where_the_vectors_of_a_null_space_are_dependent(text: str, where: str) -> None:
    found, wanted = dependent_where(nullspace(row(text))), value(where)
    assert found is not None and ratio(found, wanted) * wanted == found


def test_with_a_root_of_letters_nothing_is_said_to_be_cancelled() -> None:
    assert is_decided(value("sin(q1)"), value("sqrt(2) + cos(q1)"))
    assert not is_decided(value("sqrt(l + m)"), value("l + m"))


def test_half_of_pi_stays() -> None:
    found = with_integers(RationalExpr(value("q1 - pi/2"), value("l/3")))
    assert (found.numerator, found.denominator) == (value("3*q1 - 3*pi/2"), value("l"))
