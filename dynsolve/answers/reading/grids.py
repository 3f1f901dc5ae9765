"""Matrices of trees, put together as they are written: products, transposes, stacks.

Nothing is computed: an entry of a product is the tree of the sum of products.  Only
zeros and ones that matrices are full of are left out.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import partial

from msgspec import Struct

from dynsolve.errors import ReadError
from dynsolve.notation.size import MAX_DEPTH, Size, TooLargeError, size
from dynsolve.notation.tree import (
    ONE,
    ZERO,
    Matrix,
    Negative,
    Node,
    Product,
    Quotient,
    Reference,
    Sum,
    Symbol,
    walk,
)

# How much is read: a hand-in over one of these bounds is `unreadable`, and says which

MAX_BYTES = 20_000_000
"""Of a file: notebooks and web pages carry their pictures with them."""

MAX_LENGTH = 60_000
"""Characters of one equation."""

MAX_TOKENS = 40_000
"""Tokens of one equation, its macros written out."""

MAX_NESTING = 60
"""Levels of parentheses, fractions, signs and powers."""

MAX_IDENTIFIER = 200
"""Characters of one name."""

MAX_EQUATIONS = 1_000
"""Equations of one file."""

MAX_ANSWERS = 2_000
"""Values of one file."""

MAX_MEMBERS = 50
"""Members of one chain a = b = c."""

MAX_ENTRIES = 1_000
"""Entries of one matrix."""

MAX_INVERSE = 3
"""Rows of a matrix whose inverse is written as a power."""

MAX_NODES = 60_000
"""Nodes of one value, its abbreviations written out."""

MAX_TERMS = 200_000
"""Terms of one value, multiplied out; an upper bound known from the tree alone."""

MAX_DEGREE = 200
"""The degree of one value."""

MAX_EXPONENT = 20
MAX_MACROS = 500
MAX_MACRO_LENGTH = 2_000
MAX_DEFINITIONS = 300

_MOST = Size(nodes=MAX_NODES, depth=MAX_DEPTH, terms=MAX_TERMS, degree=MAX_DEGREE)
_SAID = {
    "nodes": f"this is too large: over {MAX_NODES} signs when its abbreviations are written out",
    "depth": f"this is nested over {MAX_DEPTH} levels deep",
    "terms": f"this is too large: multiplied out it would have over {MAX_TERMS} terms",
    "degree": f"this is too large: it holds powers over {MAX_DEGREE}",
}


def check_size(node: Node) -> Size:
    """The size of a value; raises ReadError for one over the bounds."""
    try:
        return size(node, _MOST)
    except TooLargeError as error:
        raise ReadError(_SAID[error.measure], help="write it shorter, or as a sum of its terms") from None


_TEXT = "name a part of it with an abbreviation"

Rows = tuple[tuple[Node, ...], ...]


class Grid(Struct, frozen=True, eq=False):
    """A matrix of trees.

    `quantity` is the canonical name where it stands for an answer as a whole;
    `is_rates` says that it is the column of the coordinates (0), the velocities (1) or
    the accelerations (2), -1 otherwise.  `factors` are the two matrices of a product,
    `terms` the matrices of a sum, as they were written.
    """

    rows: Rows
    quantity: str = ""
    is_rates: int = -1
    factors: tuple[Grid, Grid] | None = None
    terms: tuple[Grid, ...] = ()

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return len(self.rows), len(self.rows[0]) if self.rows else 0

    @property
    def node(self) -> Matrix:
        """The matrix as a tree."""
        return Matrix(self.rows)

    @property
    def entries(self) -> list[Node]:
        """Its entries, row by row."""
        return [entry for row in self.rows for entry in row]


class Abstract(Struct, frozen=True):
    """What stands for no value of this robot: a running index, z_0, an operator; `why` names it."""

    why: str


Value = Node | Grid | Abstract

_ANY_SIZE = Abstract("a matrix of any size is named here")


def symbols_in(value: Value) -> list[Symbol]:
    """The symbols of a value, each as often as it stands there."""
    nodes = value.entries if isinstance(value, Grid) else [value] if isinstance(value, Node) else []
    return [part for node in nodes for part in walk(node) if isinstance(part, Symbol)]


def grid(rows: Iterable[Iterable[Node]]) -> Grid:
    """A matrix of these rows; raises ReadError where they differ in length."""
    entries = tuple(tuple(row) for row in rows)
    lengths = {len(row) for row in entries}
    if len(lengths) != 1 or 0 in lengths:
        raise ReadError("the rows of this matrix differ in length", help="give every row as many entries")
    if sum(map(len, entries)) > MAX_ENTRIES:
        raise ReadError(f"a matrix of more than {MAX_ENTRIES} entries", help=_TEXT)
    return Grid(entries)


def negative(value: Value) -> Value:
    """-value"""
    if isinstance(value, Abstract):
        return value
    return mapped(value, _minus) if isinstance(value, Grid) else Negative(value)


def _minus(node: Node) -> Node:
    if node == ZERO:
        return node
    return node.argument if isinstance(node, Negative) else Negative(node)


def mapped(value: Grid, change: Callable[[Node], Node]) -> Grid:
    """The matrix with every entry changed."""
    return Grid(tuple(tuple(change(entry) for entry in row) for row in value.rows))


def _of_any_size(value: Value) -> bool:
    """Whether a value is the name of a matrix that may have any size, as Y and a have."""
    return isinstance(value, Grid) and 0 in value.shape


def total(terms: Sequence[Value]) -> Value:
    """The sum of terms, all scalars or all matrices of one shape."""
    abstract = next((term for term in terms if isinstance(term, Abstract)), None)
    if abstract is not None:
        return abstract
    if len(terms) > 1 and any(map(_of_any_size, terms)):
        return _ANY_SIZE
    grids = [term for term in terms if isinstance(term, Grid)]
    if not grids:
        return Sum(tuple(terms))  # type: ignore[arg-type]
    others = [term for term in terms if not isinstance(term, Grid)]
    if any(other != ZERO for other in others):
        raise ReadError("a matrix and a scalar are added here", help="add matrices of one shape")
    if len({g.shape for g in grids}) > 1:
        shapes = " and ".join(sorted({f"{r}×{c}" for r, c in (g.shape for g in grids)}))
        raise ReadError(f"matrices of different shapes are added here: {shapes}", help="check the shapes")
    rows = zip(*(g.rows for g in grids), strict=True)
    return Grid(tuple(tuple(map(_sum, zip(*row, strict=True))) for row in rows), terms=tuple(grids))


def _sum(terms: Sequence[Node]) -> Node:
    kept = [term for term in terms if term != ZERO]
    if not kept:
        return ZERO
    return kept[0] if len(kept) == 1 else Sum(tuple(kept))


def times(left: Value, right: Value, sign: str = "") -> Value:
    """left right; `sign` is `times` for a cross, `cdot` for a dot between vectors."""
    if isinstance(left, Abstract):
        return left
    if isinstance(right, Abstract):
        return right
    if _of_any_size(left) or _of_any_size(right):
        return _ANY_SIZE
    if not isinstance(left, Grid) and not isinstance(right, Grid):
        return Product((*left.factors, right)) if type(left) is Product else Product((left, right))
    if not isinstance(left, Grid):
        assert isinstance(right, Grid)
        return mapped(right, partial(scaled, left))
    if not isinstance(right, Grid):
        factor = right
        return mapped(left, lambda entry: scaled(entry, factor))
    if sign == "times" and left.shape == right.shape == (3, 1):
        return _cross(left, right)
    if sign == "cdot" and left.shape == right.shape and left.shape[1] == 1:
        return _product(Grid(tuple(zip(*left.rows, strict=True))), right)
    return _product(left, right)


def scaled(left: Node, right: Node) -> Node:
    """left right, without the ones and zeros."""
    if left == ZERO or right == ZERO:
        return ZERO
    if left == ONE:
        return right
    if right == ONE:
        return left
    if type(left) is Negative:
        return Negative(scaled(left.argument, right))
    if type(right) is Negative:
        return Negative(scaled(left, right.argument))
    return Product((left, right))


def _product(left: Grid, right: Grid) -> Value:
    (rows, inner), (height, columns) = left.shape, right.shape
    if left.quantity == "friction" and right.is_rates == 1:
        return left  # F_v q̇, of which F_v has no name of its own
    if inner != height:
        message = f"a {rows}×{inner} matrix cannot be multiplied by a {height}×{columns} one"
        raise ReadError(message, help="check the shapes, and which one is transposed")
    if rows * inner * columns > MAX_NODES:
        raise ReadError("a product of matrices that is too large", help=_TEXT)
    entries = tuple(
        tuple(_sum([scaled(left.rows[i][k], right.rows[k][j]) for k in range(inner)]) for j in range(columns))
        for i in range(rows)
    )
    if rows == columns == 1:
        return entries[0][0]
    if left.quantity == "C" and right.is_rates == 1:
        return Grid(entries, quantity="Cqd", factors=(left, right))
    return Grid(entries, factors=(left, right))


def _cross(left: Grid, right: Grid) -> Grid:
    a, b = ([row[0] for row in g.rows] for g in (left, right))
    return Grid(
        tuple((_sum([scaled(a[i], b[j]), _minus(scaled(a[j], b[i]))]),) for i, j in ((1, 2), (2, 0), (0, 1)))
    )


def transposed(value: Value) -> Value:
    """The transpose; a scalar is its own."""
    if not isinstance(value, Grid):
        return value
    return Grid(tuple(zip(*value.rows, strict=True)))


def inverse(value: Grid) -> Value:
    """The adjugate over the determinant, of a matrix of at most three rows.

    >>> from dynsolve.notation.tree import Symbol
    >>> a, b = Symbol("a"), Symbol("b")
    >>> inverse(grid([[a, ZERO], [ZERO, b]])).rows[0][0] == Quotient(b, Product((a, b)))
    True
    """
    (n, columns), help = value.shape, "multiply the equation by it, or write its inverse out"
    if n != columns:
        raise ReadError(f"a {n}×{columns} matrix has no inverse", help="check the shapes")
    if n > MAX_INVERSE and any(isinstance(part, Reference) for part in walk(value.node)):
        return Abstract("the inverse of a matrix of the derivation")
    if n > MAX_INVERSE:
        raise ReadError(f"the inverse of a matrix of more than {MAX_INVERSE} rows", help=help)
    divisor = _determinant(value.rows)
    if divisor == ZERO:
        raise ReadError("a singular matrix has no inverse", help="check its rows")
    rows = tuple(tuple(_over(_cofactor(value.rows, j, i), divisor) for j in range(n)) for i in range(n))
    return Grid(rows) if n > 1 else rows[0][0]


def _over(above: Node, below: Node) -> Node:
    return above if above == ZERO else Quotient(above, below)


def _determinant(rows: Rows) -> Node:
    if not rows:
        return ONE
    return _sum([scaled(entry, _cofactor(rows, 0, j)) for j, entry in enumerate(rows[0])])


def _cofactor(rows: Rows, i: int, j: int) -> Node:
    minor = _determinant(tuple(row[:j] + row[j + 1 :] for k, row in enumerate(rows) if k != i))
    return _minus(minor) if (i + j) % 2 else minor


def divided(left: Value, right: Value) -> Value:
    """left / right, where right is a scalar."""
    if isinstance(left, Abstract):
        return left
    if isinstance(right, Abstract):
        return right
    if isinstance(right, Grid):
        raise ReadError("a division by a matrix", help="a matrix cannot divide")
    if isinstance(left, Grid):
        divisor = right
        return mapped(left, lambda entry: _over(entry, divisor))
    return Quotient(left, right)


def stacked(rows: Sequence[Sequence[Value]]) -> Value:
    """The matrix of these entries, blocks among them."""
    entries = [entry for row in rows for entry in row]
    abstract = next((entry for entry in entries if isinstance(entry, Abstract)), None)
    if abstract is not None:
        return abstract
    if not any(isinstance(entry, Grid) for entry in entries):
        return grid(rows)  # type: ignore[arg-type]
    lines: list[list[Node]] = []
    for row in rows:
        height = max(entry.shape[0] if isinstance(entry, Grid) else 1 for entry in row)
        lines += [[node for entry in row for node in _line(entry, i, height)] for i in range(height)]
    return grid(lines)


def _line(entry: Value, i: int, height: int) -> tuple[Node, ...]:
    if isinstance(entry, Grid):
        if entry.shape[0] != height:
            raise ReadError("blocks of different heights stand in one row here", help="check the shapes")
        return entry.rows[i]
    assert isinstance(entry, Node)
    if height > 1 and entry != ZERO:
        raise ReadError("a scalar stands beside a matrix here", help="check the shapes")
    return (entry,)
