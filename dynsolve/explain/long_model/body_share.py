"""What one body adds to an entry of D, by vectors along the axes of its own link.

Along these the tensor and the mass centre are constant, and the axes of the joints are rows of short
products of the table's matrices, so that a person can follow with a pencil.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property, reduce

from dynsolve.algebra import matrix as algebra
from dynsolve.algebra.expr import Expr
from dynsolve.derivation.jacobian import joint_frame
from dynsolve.derivation.kinematics import dh_matrix, origin, rotation
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.jacobian_columns import column_letters
from dynsolve.explain.step import Line
from dynsolve.explain.widths import matrix_width
from dynsolve.explain.working.differentiation import product_of
from dynsolve.explain.working.identities import doubled_angles
from dynsolve.explain.writing import listed, side_by_side
from dynsolve.notation.build import total
from dynsolve.notation.tree import (
    Cross,
    Matrix,
    Negative,
    Node,
    Parenthesized,
    Product,
    Sum,
    Transpose,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.robot.model import Body, Joint, JointType

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
        assert isinstance(column, Matrix)
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
                assert isinstance(lever, Matrix)
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
