"""What the steps of a long model are made from: the robot, its names, and formulas in them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from functools import cached_property, partial
from itertools import groupby
from operator import itemgetter

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.kinematics import base_transform, dh_matrix
from dynsolve.document import Prose
from dynsolve.explain.abbreviations import Abbreviated
from dynsolve.explain.context import Context
from dynsolve.explain.forms import EntryFormulas, Factor
from dynsolve.explain.jacobian import ZERO as ZERO_VECTOR
from dynsolve.explain.step import Detail, Step
from dynsolve.explain.working.identities import Identity, used_in_product
from dynsolve.explain.writing import column_of
from dynsolve.notation import tree
from dynsolve.notation.build import cost, times
from dynsolve.notation.tree import ZERO, Node, Number, Product, Relation, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Joint, Robot

QUADRATIC = Product((letters.HALF, letters.transposed_product(letters.QD, letters.D)))
"""½ q̇ᵀ D q̇"""

brief_step = partial(Step, detail=Detail.BRIEF, uses=())
"""A step that stands for many."""


class LongModel(Struct, frozen=True, dict=True):
    """A model in names; `direct` is the step that assembles D from the Jacobians, if there is one."""

    context: Context
    short: Abbreviated
    direct: Step | None

    @property
    def n(self) -> int:
        """The number of coordinates."""
        return self.context.robot.n

    def varying(self, *values: Expr) -> list[int]:
        """The coordinates, from 0, that values depend on."""
        ring, each = self.context.robot.ring, set(values)
        return [k for k in range(self.n) if any(not ring.diff(value, k).is_zero for value in each)]

    @cached_property
    def formulas(self) -> EntryFormulas:
        """The formulas in d_ij, c_ijk and g_k."""
        names = self.context.robot.ring.names
        return EntryFormulas(names, self.d, self.c, self.g, self.friction, _with_number_in_front)

    def d(self, i: int, j: int) -> Node:
        """The name of d_ij."""
        return ZERO if self.short.D.rows[i][j] == ZERO else letters.entry("d", min(i, j) + 1, max(i, j) + 1)

    def c(self, i: int, j: int, k: int) -> Node:
        """The name of c_ijk, the same for c_jik."""
        i, j = min(i, j), max(i, j)
        return ZERO if self.short.symbol(i, j, k) == ZERO else letters.entry("c", i + 1, j + 1, k + 1)

    def g(self, k: int) -> Node:
        """The name of g_k."""
        return ZERO if self.short.g.rows[k][0] == ZERO else letters.entry("g", k + 1)

    def friction(self, k: int) -> Node:
        """The name of the friction of a coordinate."""
        return letters.friction(k + 1) if self.context.has_friction(k) else ZERO


def _with_number_in_front(coefficient: Fraction | int, factors: Iterable[Factor]) -> Node:
    """coefficient · Π node^exponent with names for factors: ½ d_11 q̇_1², not d_11 q̇_1² / 2."""
    product = times(1, factors)
    if coefficient == 1 or product == ZERO:
        return product
    inner = product.factors if isinstance(product, Product) else (product,)
    return Product((Number(coefficient.numerator, coefficient.denominator), *inner))


def with_result(step: Step, result: Node, more: Prose = ()) -> Step:
    """The step with a result in names, and what there is to say about it."""
    return replace(step, result=(result,), why=(*step.why, *more))


# -- which results would fill pages, and what stands in their place --------------------------------

LONGEST = 80
"""The operations up to which a result on the way to D, c_ijk and g is written out."""


def is_too_long(step: Step) -> bool:
    """Whether a step on the way would fill pages."""
    on_the_way = step.stage in (Stage.INERTIA, Stage.ENERGY)
    return on_the_way and max(map(_size, step.result), default=0) > LONGEST


def _size(node: Node) -> int:
    """The operations in a result."""
    value = node.parts[-1] if isinstance(node, Relation) else node
    if isinstance(value, tree.Matrix):
        return sum(_size(entry) for row in value.rows for entry in row)
    try:
        return cost(value)
    except TypeError:  # a formula in letters
        return 0


def left_out(step: Step) -> Step:
    """The step with its formula as its result."""
    if step.formula is None:
        return step
    note = ("Written out it would be too long to be useful; the formula defines it.",)
    return replace(step, result=(), notes=(*step.notes, note))


def columns_shown(names: Sequence[tuple[Node, Node] | None], J: tree.Matrix) -> Iterator[Node]:
    """The columns of J_v that have a name, equal neighbours in one chain."""
    named = [(column_of(J, k), name[0]) for k, name in enumerate(names) if name is not None]
    for value, equal in groupby(named, itemgetter(0)):
        is_zero = all(row == (ZERO,) for row in value.rows)
        yield equation(*(name for _, name in equal), ZERO_VECTOR if is_zero else value)


# -- half-way along an arm: where a long product is parted, and the halves worked out --------------


def halves(robot: Robot) -> tuple[tuple[Joint, ...], tuple[Joint, ...]]:
    """The rows up to the last frame in two halves: of six joints, the arm and its wrist."""
    rows = robot.path(len(robot.joints))
    return rows[: len(rows) // 2], rows[len(rows) // 2 :]


def product(context: Context, rows: Sequence[Joint]) -> tuple[Matrix, list[Identity]]:
    """The matrices of rows multiplied from the left, 4×4, and the identities that are used on the way.

    From the base on, with the frame of the base before them.
    """
    robot = context.robot
    matrices = [dh_matrix(robot, row) for row in rows]
    if rows[0].parent == 0:
        matrices = [base_transform(robot), *matrices]
    used: dict[Identity, None] = {}
    made = matrices[0]
    for A in matrices[1:]:
        before, made = made, made @ A
        used |= dict.fromkeys(used_in_product(context, before, A, made))
    return made, list(used)
