"""A basis of angles: independent, and every given angle an integer combination of it."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st

from dynsolve.algebra.angles import coordinates_in, integer_basis

rates = st.sampled_from([Fraction(n, d) for n in range(-3, 4) for d in (1, 2, 3)])
vectors = st.lists(st.tuples(rates, rates, rates), max_size=5)


@given(vectors)
def test_every_vector_is_an_integer_combination(given_vectors: list[tuple[Fraction, ...]]) -> None:
    basis = integer_basis(given_vectors)
    for vector in given_vectors:
        found = coordinates_in(basis, vector)
        assert found is not None
        assert all(c.denominator == 1 for c in found)
        for i, x in enumerate(vector):
            assert sum((c * b[i] for c, b in zip(found, basis, strict=True)), Fraction(0)) == x


@given(vectors)
def test_the_basis_generates_nothing_else(given_vectors: list[tuple[Fraction, ...]]) -> None:
    basis = integer_basis(given_vectors)
    assert integer_basis([*given_vectors, *basis]) == basis


def test_what_serves_is_kept_in_its_order() -> None:
    absolute = [(Fraction(1), Fraction(0)), (Fraction(1), Fraction(1))]
    assert integer_basis([*absolute, (Fraction(0), Fraction(1))]) == absolute


def test_outside_the_span_and_of_no_basis_there_are_no_coordinates() -> None:
    one, two = (Fraction(1), Fraction(0)), (Fraction(2), Fraction(0))
    assert coordinates_in([one], (Fraction(0), Fraction(1))) is None
    assert coordinates_in([one, two], one) is None
    assert coordinates_in([], (Fraction(0),)) == ()
