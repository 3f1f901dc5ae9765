"""One entry of D in full: that of two joints which move the same few bodies at the end of the arm."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property, reduce
from itertools import chain, groupby
from operator import itemgetter

from dynsolve.algebra import matrix as algebra
from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.jacobian import joint_frame, linear_jacobian
from dynsolve.derivation.kinematics import dh_matrix, origin, rotation
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.inertia import has_link_axes, is_moved
from dynsolve.explain.jacobian import ZERO, column_letters, coordinate_column
from dynsolve.explain.long_model.model import LongModel, halves
from dynsolve.explain.matrix_factors import matrix_width
from dynsolve.explain.recurring import expanded_once
from dynsolve.explain.step import Detail, Line, Step
from dynsolve.explain.working.differentiation import product_of
from dynsolve.explain.working.identities import doubled_angles
from dynsolve.explain.writing import column_of, listed, side_by_side, spong
from dynsolve.notation import tree
from dynsolve.notation.build import cost, total
from dynsolve.notation.tree import (
    Cross,
    Letter,
    Negative,
    Node,
    Number,
    Parenthesized,
    Product,
    Row,
    Sum,
    Symbol,
    Transpose,
    Words,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Body, Joint, JointType


@dataclass(frozen=True)
class InertiaEntry:
    """d_jk of two joints, counted from 0, by what each of the bodies adds that both move."""

    model: LongModel
    row: int
    column: int
    shares: tuple[BodyShare, ...]

    @property
    def is_whole(self) -> bool:
        """Whether the shares are the entry of D."""
        zero = self.model.context.robot.ring.zero
        return sum((share.value for share in self.shares), start=zero) == self._value

    @property
    def is_of_both_parts(self) -> bool:
        """Whether every body adds something, and something moves and turns."""
        turned = any(not share.angular.is_zero for share in self.shares)
        moved = any(not share.linear.is_zero for share in self.shares)
        return turned and moved and all(not share.value.is_zero for share in self.shares)

    @property
    def _value(self) -> Expr:
        D: Matrix = self.model.context.values["D"]
        return D[self.row, self.column]

    def step(self) -> Step:
        """From the formula of D to the entry in the names of the model."""
        short, show = self.model.short, self.model.context.show
        name = letters.entry("d", self.row + 1, self.column + 1)
        form = short.D.rows[self.row][self.column]
        parts = [show(share.value) for share in self.shares]
        members = dict.fromkeys((total(parts), expanded_once(short.sums, form), form))
        return Step(
            id="D_entry",
            stage=Stage.VECTORIZED,
            title="One entry of the inertia matrix in full",
            why=self._on_the_bodies(name),
            formula=equation(name, Sum(tuple(chain(*(share.in_letters for share in self.shares))))),
            source=spong("7.2.2"),
            lines=tuple(self._lines()),
            concluding=(self._on_the_sum(collected=len(members) > 1),),
            result=(equation(name, *members),),
            notes=(
                ("The other entries are made alike, with such terms of each body that both joints move.",),
            ),
            uses=(),
        )

    @property
    def _are_multiplied(self) -> bool:
        """Whether the products are written out: of several bodies, of which some move and turn."""
        return len(self.shares) > 1 and any(share.has_both_parts for share in self.shares)

    def _on_the_sum(self, *, collected: bool) -> str:
        """How the entry comes from the products."""
        added = "Added up" if self._are_multiplied else "Put in"
        return f"{added}{', and collected in the abbreviations' if collected else ''}:"

    def _on_the_bodies(self, name: Node) -> Prose:
        """Why there are these terms only, and along which axes they are best worked out."""
        bodies = [share.body.name for share in self.shares]
        many = len(bodies) > 1
        return (
            f"Joint {self.shares[0].last.index} moves {'bodies' if many else 'body'} ",
            *listed(bodies),
            " alone, so ",
            name,
            f" has the terms of {'these' if many else 'this body'}. Products of vectors, and of a tensor "
            f"with them, are the same along any axes: {'those' if many else 'here those'} of the link "
            f"{'of each body ' if many else ''}are taken.",
        )

    def _lines(self) -> Iterator[Line]:
        """The vectors of each body, and their products."""
        for share in self.shares:
            yield from share.lines()
            if self._are_multiplied:
                yield share.products()


MOST_BODIES = 2
"""The bodies of which the terms of an entry are shown."""


def worked_entry(model: LongModel) -> InertiaEntry | None:
    """The entry that is worked out: of two bodies where one is found, else of the last body alone."""
    robot = model.context.robot
    if robot.is_tree or not robot.has_table or not robot.moves_each_joint_alone or robot.actions.motors:
        return None
    entries = list(_entries(model))
    several = [entry for entry in entries if len(entry.shares) > 1 and entry.is_of_both_parts]
    for entry in (*several, *(entry for entry in entries if len(entry.shares) == 1)):
        if entry.is_whole and any(not share.value.is_zero for share in entry.shares):
            return entry
    return None


def _entries(model: LongModel) -> Iterator[InertiaEntry]:
    """The entries of the last two columns above the diagonal that few bodies add to, upwards from it."""
    context = model.context
    moving = [joint for joint in context.robot.joints if joint.type]
    for column in range(model.n - 2, model.n):
        carried = [body for body in context.robot.bodies if body.link >= moving[column].index]
        if len(carried) > MOST_BODIES or not all(has_link_axes(b) and not is_moved(b) for b in carried):
            continue
        for row in reversed(range(column)):
            shares = (BodyShare(context, body, moving[row], moving[column]) for body in carried)
            yield InertiaEntry(model, row, column, tuple(shares))


# -- what one body adds to an entry of D, by vectors along the axes of its own link ----------------
# Along these the tensor and the mass centre are constant, and the axes of the joints are rows of short
# products of the table's matrices, so that a person can follow with a pencil.

BESIDE = 30
"""The characters that two levers may have to stand side by side."""


@dataclass(frozen=True)
class BodyShare:
    """m (J_v)_jᵀ (J_v)_k + (J_ω)_jᵀ I (J_ω)_k of one body and two joints that move it."""

    context: Context
    body: Body
    first: Joint
    last: Joint

    @property
    def joints(self) -> tuple[Joint, Joint]:
        """The two joints, the one nearer to the base first."""
        return self.first, self.last

    # -- exactly -----------------------------------------------------------------------------------

    @cached_property
    def value(self) -> Expr:
        """Both parts together."""
        return self.linear + self.angular

    @cached_property
    def linear(self) -> Expr:
        """m (J_v)_jᵀ (J_v)_k"""
        left, right = map(self._column, self.joints)
        return self.context.robot.ring.dot(left.entries, right.entries) * self.body.mass

    @cached_property
    def angular(self) -> Expr:
        """(J_ω)_jᵀ I (J_ω)_k, zero where one of the joints slides."""
        if not self._turns:
            return self.context.robot.ring.zero
        left, right = map(self._axis, self.joints)
        tensor: algebra.Matrix = self.context.values[f"I_body{self.body.name}"]
        return (left.T @ tensor @ right)[0, 0]

    @property
    def _turning(self) -> tuple[Joint, ...]:
        return tuple(joint for joint in self.joints if joint.type is JointType.REVOLUTE)

    @property
    def _turns(self) -> bool:
        return len(self._turning) == len(self.joints)

    def _way(self, joint: Joint) -> tuple[Joint, ...]:
        """The rows from the joint's axis to the body's frame."""
        robot = self.context.robot
        return robot.joints[joint_frame(robot, joint) : self.body.link]

    def _along(self, joint: Joint) -> algebra.Matrix:
        """The body's frame seen from that of the joint's axis, 4×4."""
        robot = self.context.robot
        matrices = (dh_matrix(robot, row) for row in self._way(joint))
        return reduce(lambda left, right: left @ right, matrices, algebra.Matrix.identity(robot.ring, 4))

    def _axis(self, joint: Joint) -> algebra.Matrix:
        """Rᵀ z"""
        return rotation(self._along(joint)).T.column_at(2)

    def _lever(self, joint: Joint) -> algebra.Matrix:
        """Rᵀ (r_c - o)"""
        way = self._along(joint)
        return self.body.center + rotation(way).T @ origin(way)

    def _column(self, joint: Joint) -> algebra.Matrix:
        """The column of J_v."""
        axis = self._axis(joint)
        return algebra.cross(axis, self._lever(joint)) if joint.type is JointType.REVOLUTE else axis

    # -- in letters --------------------------------------------------------------------------------

    @property
    def in_letters(self) -> tuple[Node, ...]:
        """m (J_v)_jᵀ (J_v)_k and (J_ω)_jᵀ 𝓘 (J_ω)_k in axes and levers."""
        left, right = map(self._letters, self.joints)
        mass = self.context.mass(self.body)
        linear = Product((mass, Transpose(_bracketed(left[0])), _bracketed(right[0])))
        tensor = letters.base_tensor(letters.index_of(self.body.name))
        return (linear, Product((Transpose(left[1]), tensor, right[1]))) if self._turns else (linear,)

    def _letters(self, joint: Joint) -> tuple[Node, Node]:
        return column_letters(self.context, joint, letters.rc(self.body))

    @property
    def _turned(self) -> Node:
        return Transpose(letters.of_body("R", self.body, "bold"))

    def lines(self) -> Iterator[Line]:
        """The vectors along the axes of the body, and their cross products."""
        yield Line(self._on_the_axes(), self._vectors())
        crosses = tuple(map(self._cross, self._turning))
        if crosses:
            yield Line(("The cross products of these:",), crosses)

    @property
    def has_both_parts(self) -> bool:
        """Whether the body moves and turns with both joints."""
        return not self.linear.is_zero and not self.angular.is_zero

    def products(self) -> Line:
        """m (J_v)_jᵀ (J_v)_k entry by entry, and (J_ω)_jᵀ 𝓘 (J_ω)_k."""
        show, terms = self.context.show, self.in_letters
        left, right = (self._shown(joint) for joint in self.joints)
        each = [product_of(1, [(a, 1), (b, 1)]) for a, b in zip(left, right, strict=True)]
        entries = Parenthesized(total(each))
        linear, angular = show(self.linear), show(self.angular)
        by: Prose = (f"Multiplied, for body {self.body.name}",)
        if used := dict.fromkeys(doubled_angles(linear, angular)):
            by += (", with ", *listed(list(used)))
        shown = equation(terms[0], Product((self.context.mass(self.body), entries)), linear)
        return Line((*by, ":"), (shown, equation(terms[1], angular)))

    def _shown(self, joint: Joint) -> tuple[Node, ...]:
        """The entries of the column of J_v."""
        column = self.context.show(self._column(joint))
        assert isinstance(column, tree.Matrix)
        return tuple(entry for (entry,) in column.rows)

    def _on_the_axes(self) -> Prose:
        """Along which axes the vectors are written, and where those of the joints are read off."""
        tensor = letters.tensor(self.context.robot, self.body)
        why: Prose = (f"Along the axes of frame {self.body.link} the tensor is ", tensor)
        rows = [(joint, product) for joint in self.joints if (product := self._product(joint))]
        if not rows:
            return (*why, ":")
        be = "are the third rows of the rotations" if len(rows) > 1 else "is the third row of the rotation"
        axes = listed([self._turned_axis(joint) for joint, _ in rows])
        why += ("; ", *axes, f" {be} in ", *listed([each for _, each in rows]))
        told = f". A lever is the mass centre in frame {self.body.link} plus the fourth column of the same "
        return (*why, f"{told}product, turned to these axes:")

    def _product(self, joint: Joint) -> Node | None:
        """The matrices of the rows from the joint's axis to the body's frame."""
        matrices = tuple(letters.A(row.index) for row in self._way(joint))
        return Product(matrices) if len(matrices) > 1 else next(iter(matrices), None)

    def _turned_axis(self, joint: Joint) -> Node:
        return Product((self._turned, letters.z(joint_frame(self.context.robot, joint))))

    def _vectors(self) -> tuple[Node, ...]:
        """The axes and levers along the axes of the body."""
        context = self.context
        axes, levers = [], []
        for joint in self.joints:
            frame = joint_frame(context.robot, joint)
            axes.append(equation(self._turned_axis(joint), context.show(self._axis(joint))))
            if joint.type is JointType.REVOLUTE:
                arm = Parenthesized(Sum((letters.rc(self.body), Negative(letters.o(frame)))))
                lever = context.show(self._lever(joint))
                assert isinstance(lever, tree.Matrix)
                levers.append((Product((self._turned, arm)), lever))
        if len(levers) == 2 and levers[0][1] == levers[1][1]:
            return side_by_side(axes), equation(*(name for name, _ in levers), levers[0][1])
        shown = [equation(*each) for each in levers]
        beside = len(levers) == 2 and sum(matrix_width(context, value) for _, value in levers) <= BESIDE
        return side_by_side(axes), *([side_by_side(shown)] if beside else shown)

    def _cross(self, joint: Joint) -> Node:
        """The column of J_v of a joint that turns, as a cross product."""
        show = self.context.show
        return equation(
            Product((self._turned, _bracketed(self._letters(joint)[0]))),
            Cross(show(self._axis(joint)), show(self._lever(joint))),
            show(self._column(joint)),
        )


def _bracketed(node: Node) -> Node:
    return Parenthesized(node) if isinstance(node, Cross) else node


# -- the kinetic energy of each body of a long model: the columns of its Jacobians, worked out for one body

LONGEST_ENTRY = 30
"""The operations in an entry of a body's Jacobian up to which its columns are worked out."""

_I, _J = Symbol("i"), Symbol("j")
_CENTER = Letter("r", Row((Words("c"), _I)), style="bold")
_JV, _JW = (letters.bold("J", Letter(base, _I)) for base in ("v", "omega"))


def kinetic_step(context: Context) -> Step:
    """v_i = J_vi q̇ and ω_i = J_ωi q̇, what the columns are, and K_i."""
    v, w = (Letter(base, _I, style="bold") for base in ("v", "omega"))
    velocities = [equation(v, Product((_JV, letters.QD))), equation(w, Product((_JW, letters.QD)))]
    linear = Product((letters.HALF, Letter("m", _I), letters.transposed_product(v)))
    rotational = Product((letters.HALF, letters.transposed_product(w, letters.base_tensor(_I))))
    example = tuple(_example(context))
    return Step(
        id="kinetics",
        stage=Stage.ENERGY,
        title="Kinetic energy of each body",
        why=_on_columns(context),
        formula=side_by_side(velocities),
        source=spong("7.2.2"),
        lines=example,
        concluding=("The kinetic energy of a body:",) if example else (),
        result=(equation(Letter("K", _I), Sum((linear, rotational))),),
        detail=Detail.BRIEF,
        uses=(),
    )


def _on_columns(context: Context) -> Prose:
    """What the columns of a body's Jacobians are, by the kinds of joints that there are."""
    which = Sum((_J, Negative(Number(1)))) if context.standard else _J
    z, o = letters.bold("z", which), letters.bold("o", which)
    turning = (Cross(z, Parenthesized(Sum((_CENTER, Negative(o))))), z)
    kinds = {joint.type for joint in context.robot.joints}
    words: Prose = (
        f"The Jacobians of a mass centre are like those of the arm, with its place instead of {context.end}: "
        "for each joint j up to the body's link, column ",
        *(_J, " of ", _JV, " is ", turning[0], " and that of ", _JW, " is ", turning[1]),
    )
    if JointType.PRISMATIC in kinds:
        words += (" where the joint is revolute, ", z, " and ", ZERO, " where it is prismatic")
    return (*words, ". The columns of the joints after it are zero.")


def _example(context: Context) -> Iterator[Line]:
    """J_v of the body half-way along the arm: where its mass centre is, and the columns."""
    robot = context.robot
    link = halves(robot)[0][-1].index
    body = next((body for body in robot.bodies if body.link == link), None)
    if robot.is_tree or body is None or not robot.moves_each_joint_alone:
        return
    columns = _columns(context, body)
    if max(cost(entry) for _, value in columns for row in value.rows for entry in row) > LONGEST_ENTRY:
        return
    center = equation(letters.rc(body), context.form(f"rc{body.name}"))
    shown = []
    for value, equal in groupby(columns, itemgetter(1)):
        is_zero = all(row == (tree.ZERO,) for row in value.rows)
        shown.append(equation(*(name for name, _ in equal), ZERO if is_zero else value))
    yield Line(
        (
            "For example, the columns of ",
            letters.jv(body),
            f" that are not zero, with the mass centre of body {body.name}:",
        ),
        (center, *shown),
    )


def _columns(context: Context, body: Body) -> list[tuple[Node, tree.Matrix]]:
    """z × (r_c - o) or z of each coordinate up to the body's link, in letters and worked out."""
    robot = context.robot
    frames = [context.values[f"H{i}"] for i in range(body.link + 1)]
    J = context.show(linear_jacobian(robot, frames, context.values[f"rc{body.name}"], body.link))
    assert isinstance(J, tree.Matrix)
    named = [coordinate_column(context, k, body.link, letters.rc(body)) for k in range(robot.n)]
    return [(name[0], column_of(J, k)) for k, name in enumerate(named) if name is not None]
