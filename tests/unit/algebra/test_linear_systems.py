"""Systems of linear equations and determinants."""

from __future__ import annotations

from random import Random

import pytest

from dynsolve.algebra.angles import Angle
from dynsolve.algebra.fraction import RationalExpr, add, cancelled, equal, multiply
from dynsolve.algebra.linear_systems import (
    FractionMatrix,
    fraction_of,
    is_solvable,
    pseudoinverse_times,
    rank_parts,
    same_span,
)
from dynsolve.algebra.matrix import Matrix, determinant, minors
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.ring_values import build_ring, value_of
from dynsolve.algebra.spaces import nullspace, rangespace
from dynsolve.notation.text import read
from dynsolve.notation.tree import Symbol

# -- systems of linear equations, solved exactly: the four equations of Penrose, and least norm by hand


Q1, BOTH = Angle.of("q1"), Angle.of("q1") + Angle.of("q2")
RING = build_ring(
    [("q1", "revolute"), ("q2", "revolute")],
    [read("a*b*x*y + sqrt(2) + cos(q1)").tree],
    [Q1, BOTH],
    [Q1, BOTH],
)


def value(text: str) -> Expr:
    return value_of(RING, read(text).tree)


def matrix(*rows: str) -> Matrix:
    return Matrix.of(RING, ([value(entry) for entry in row.split()] for row in rows))


MATRICES = {
    "square": matrix("a b", "0 a"),
    "wide": matrix("a b 1", "0 a 2"),
    "tall": matrix("a b", "0 a", "1 1"),
    "a row": matrix("a b x"),
    "rank 1": matrix("a b 0", "2*a 2*b 0"),
    "rank 2 of 3": matrix("a b 1", "0 1 x", "a b+1 x+1"),
    "zero": matrix("0 0", "0 0"),
    "turning": matrix("-a*sin(q1) -b*sin(q1+q2)", "a*cos(q1) b*cos(q1+q2)"),
    "turning, rank 1": matrix("a*sin(q1) b*sin(q1)", "a*cos(q1) b*cos(q1)"),
    "roots": matrix("sqrt(2) a", "1 sqrt(2)*b"),
}


def columns(J: Matrix) -> list[list[RationalExpr]]:
    """The columns of the pseudoinverse."""
    height = J.shape[0]
    units = Matrix.identity(RING, height)
    found = [pseudoinverse_times(J, units.column_at(k)) for k in range(height)]
    return [[fraction_of(entry) for entry in x.entries] for x in found]


def times(A: list[list[RationalExpr]], B: list[list[RationalExpr]]) -> list[list[RationalExpr]]:
    product = []
    for row in A:
        product.append([])
        for j in range(len(B[0])):
            total = RationalExpr(RING.zero)
            for k, entry in enumerate(row):
                total = cancelled(add(total, multiply(entry, B[k][j])))
            product[-1].append(total)
    return product


def same(A: list[list[RationalExpr]], B: list[list[RationalExpr]]) -> bool:
    return all(equal(x, y) for r, s in zip(A, B, strict=True) for x, y in zip(r, s, strict=True))


@pytest.mark.parametrize("J", MATRICES.values(), ids=MATRICES)
def test_penrose(J: Matrix) -> None:
    """A X A = A, X A X = X, and A X and X A are symmetric (Penrose 1955)."""
    A = [[RationalExpr(entry) for entry in row] for row in J.rows]
    X = [list(row) for row in zip(*columns(J), strict=True)]
    AX, XA = times(A, X), times(X, A)
    assert same(times(AX, A), A) and same(times(XA, X), X)
    for product in (AX, XA):
        assert same(product, [list(row) for row in zip(*product, strict=True)])


@pytest.mark.parametrize(
    ("name", "rank"),
    [("square", 2), ("wide", 2), ("tall", 2), ("rank 1", 1), ("rank 2 of 3", 2), ("zero", 0),
     ("turning", 2), ("turning, rank 1", 1)],
)  # fmt: skip
def test_rank(name: str, rank: int) -> None:
    assert rank_parts(MATRICES[name]).rank == rank


def test_what_has_a_solution() -> None:
    J = MATRICES["rank 1"]
    assert is_solvable(J, matrix("x", "2*x")) and not is_solvable(J, matrix("x", "x"))


def test_a_value_without_denominators_is_a_matrix_of_polynomials() -> None:
    assert pseudoinverse_times(matrix("1 a", "0 1"), matrix("x", "y")) == matrix("x-a*y", "y")
    assert isinstance(pseudoinverse_times(matrix("a b"), matrix("x")), FractionMatrix)


@pytest.mark.parametrize(
    ("above", "below", "numerator", "denominator"),
    [
        ("a*b", "a^2", "b", "a"),
        ("0", "a", "0", ""),
        ("2*a", "4", "a/2", ""),
        ("a*sin(q1)^2", "1 - cos(q1)^2", "a", ""),
        ("1 - cos(q1)^2", "a*sin(q1)", "sin(q1)", "a"),
        ("a*sin(q1)", "b*sin(q1)*cos(q1)", "a", "b*cos(q1)"),
        ("a", "sqrt(2)*b", "a*sqrt(2)/2", "b"),
        ("b*cos(q1)", "a*b*(sin(q1+q2)*cos(q1) - cos(q1+q2)*sin(q1))", "cos(q1)", "a*sin(q2)"),
    ],
)
def test_what_is_shared_is_cancelled(above: str, below: str, numerator: str, denominator: str) -> None:
    ring = build_ring(
        [("q1", "revolute"), ("q2", "revolute")], [read("a*b + sqrt(2)").tree], [Q1, BOTH, Angle.of("q2")]
    )
    a, b, c, d = (value_of(ring, read(text or "1").tree) for text in (above, below, numerator, denominator))
    found = cancelled(RationalExpr(a, b))
    assert equal(found, RationalExpr(c, d))
    assert (found.divisor is None) == (not denominator)
    assert len(found.numerator) <= len(a) and len(found.denominator) <= len(b)


@pytest.mark.parametrize("J", MATRICES.values(), ids=MATRICES)
def test_spaces_have_their_dimension_and_are_across_each_other(J: Matrix) -> None:
    """A N = 0, Aᵀ L = 0 and Lᵀ R = 0; rank and nullity add up."""
    rank, (height, width) = rank_parts(J).rank, J.shape
    N, R, L = nullspace(J), rangespace(J), nullspace(J.T)
    assert (N.shape, R.shape, L.shape) == ((width, width - rank), (height, rank), (height, height - rank))
    assert not N.shape[1] or (J @ N).is_zero
    assert not L.shape[1] or ((J.T @ L).is_zero and (rank == 0 or (R.T @ L).is_zero))
    assert not rank or same_span(R, J)


def test_the_same_space_by_other_vectors() -> None:
    one = matrix("a 0", "b 0", "0 1")
    assert same_span(one, matrix("a 2*a", "b 2*b", "x 1")) and not same_span(one, matrix("a", "b", "x"))
    assert not same_span(one, matrix("a 1", "b 0", "x 0"))


# -- determinants by their properties: products, transposes, rows that depend on each other ----------


SYMBOLS = build_ring([], [Symbol(name) for name in "abc"])


def random_matrix(size: int, seed: int) -> Matrix:
    random = Random(seed)
    symbols = [SYMBOLS.symbol(name) for name in "abc"]
    return Matrix.of(
        SYMBOLS,
        (
            [
                symbols[random.randrange(3)] * random.randint(-3, 3) + SYMBOLS.one * random.randint(-2, 2)
                for _ in range(size)
            ]
            for _ in range(size)
        ),
    )


@pytest.mark.parametrize("size", [1, 2, 3, 4])
def test_the_determinant_of_a_product(size: int) -> None:
    a, b = random_matrix(size, 1), random_matrix(size, 2)
    assert determinant(a @ b) == determinant(a) * determinant(b)
    assert determinant(a.T) == determinant(a)


def test_the_minors_of_a_matrix_of_rank_one() -> None:
    column = Matrix.column(SYMBOLS, [SYMBOLS.symbol(name) for name in "abc"])
    product = column @ column.T
    assert list(minors(product, 2)) == []
    assert len(list(minors(product, 1))) == 9
