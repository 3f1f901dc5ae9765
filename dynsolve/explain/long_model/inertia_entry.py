"""One entry of D in full: that of two joints of which the last body alone is moved by both.

Along the axes of the last link the tensor and the mass centre are constant, and the axes of the two
joints are rows of short products of the table's matrices, so that a person can follow with a pencil.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, reduce

from dynsolve.algebra import matrix as algebra
from dynsolve.algebra.expr import Expr
from dynsolve.derivation.jacobian import joint_frame
from dynsolve.derivation.kinematics import dh_matrix, origin, rotation
from dynsolve.document import Prose
from dynsolve.explain.abbreviations import expanded_once
from dynsolve.explain.inertia import has_link_axes, is_moved
from dynsolve.explain.jacobian_columns import column_letters
from dynsolve.explain.long_model.model import LongModel
from dynsolve.explain.step import Line, Step
from dynsolve.explain.writing import listed, side_by_side, spong
from dynsolve.notation.tree import (
    Cross,
    Negative,
    Node,
    Parenthesized,
    Product,
    Sum,
    Transpose,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Body, Joint, JointType


def inertia_entry(model: LongModel) -> Step | None:
    """The step that works out one entry, of a chain that ends in a body with a tensor in its link."""
    entry = _worked(model)
    return entry.step() if entry else None


def worked_row(model: LongModel) -> int | None:
    """The row (from 0) of the entry that is worked out, in the last column."""
    entry = _worked(model)
    return entry.k if entry else None


def _worked(model: LongModel) -> _Entry | None:
    robot, D = model.context.robot, model.context.values["D"]
    if robot.is_tree or not robot.has_table or not robot.moves_each_joint_alone or robot.actions.motors:
        return None
    moving = [joint for joint in robot.joints if joint.type]
    carried = [body for body in robot.bodies if body.link >= moving[-1].index]
    if len(carried) != 1 or not has_link_axes(carried[0]) or is_moved(carried[0]):
        return None
    for k in reversed(range(len(moving) - 1)):
        entry = _Entry(model, carried[0], k, moving[k], moving[-1])
        if not D[k, model.n - 1].is_zero:
            return entry if entry.value == D[k, model.n - 1] else None
    return None


@dataclass(frozen=True)
class _Entry:
    """d_kn of joint k + 1 and the last one, by the vectors along the axes of the body that both move."""

    model: LongModel
    body: Body
    k: int
    first: Joint
    last: Joint

    @property
    def joints(self) -> tuple[Joint, Joint]:
        return self.first, self.last

    @cached_property
    def value(self) -> Expr:
        """m (J_v)_kᵀ (J_v)_n + (J_ω)_kᵀ I (J_ω)_n"""
        return self.linear + self.angular

    @cached_property
    def linear(self) -> Expr:
        left, right = map(self._column, self.joints)
        return self.model.context.robot.ring.dot(left.entries, right.entries) * self.body.mass

    @cached_property
    def angular(self) -> Expr:
        """Zero where one of the joints slides."""
        if not self._turns:
            return self.model.context.robot.ring.zero
        left, right = map(self._axis, self.joints)
        tensor: algebra.Matrix = self.model.context.values[f"I_body{self.body.name}"]
        return (left.T @ tensor @ right)[0, 0]

    @property
    def _turns(self) -> bool:
        return all(joint.type is JointType.REVOLUTE for joint in self.joints)

    def _way(self, joint: Joint) -> tuple[Joint, ...]:
        """The rows from the joint's axis to the body's frame."""
        robot = self.model.context.robot
        return robot.joints[joint_frame(robot, joint) : self.body.link]

    def _along(self, joint: Joint) -> algebra.Matrix:
        """The body's frame seen from that of the joint's axis, 4×4."""
        robot = self.model.context.robot
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

    def step(self) -> Step:
        """From the formula of D to the entry in the names of the model."""
        short, name = self.model.short, letters.entry("d", self.k + 1, self.model.n)
        form = short.D.rows[self.k][self.model.n - 1]
        worked = self.model.context.show(self.value)
        members = tuple(dict.fromkeys((worked, expanded_once(short.sums, form), form)))
        return Step(
            id="D_entry",
            stage=Stage.VECTORIZED,
            title="One entry of the inertia matrix in full",
            why=self._on_the_body(name),
            formula=equation(name, self._in_letters()),
            source=spong("7.2.2"),
            lines=(Line(self._on_the_axes(), self._vectors()), *self._products()),
            concluding=("Put in:" if len(members) == 1 else "Put in, and collected in the abbreviations:",),
            result=(equation(name, *members),),
            notes=(
                ("The other entries are made alike, with such terms of each body that both joints move.",),
            ),
            uses=(),
        )

    def _on_the_body(self, name: Node) -> Prose:
        """Why there is one term only."""
        body = letters.index_of(self.body.name)
        return (
            f"Joint {self.last.index} moves body ",
            body,
            " alone, so ",
            name,
            " has the terms of this body.",
        )

    def _in_letters(self) -> Node:
        """m (J_v)_kᵀ (J_v)_n + (J_ω)_kᵀ 𝓘 (J_ω)_n in axes and levers."""
        left, right = map(self._letters, self.joints)
        mass = self.model.context.mass(self.body)
        linear = Product((mass, Transpose(_bracketed(left[0])), _bracketed(right[0])))
        tensor = letters.base_tensor(letters.index_of(self.body.name))
        return Sum((linear, Product((Transpose(left[1]), tensor, right[1])))) if self._turns else linear

    def _letters(self, joint: Joint) -> tuple[Node, Node]:
        return column_letters(self.model.context, joint, letters.rc(self.body))

    @property
    def _turned(self) -> Node:
        return Transpose(letters.of_body("R", self.body, "bold"))

    def _on_the_axes(self) -> Prose:
        """Along which axes the vectors are written, and where those of the joints are read off."""
        tensor = letters.tensor(self.model.context.robot, self.body)
        why: Prose = ("Products of vectors, and of a tensor with them, are the same along any axes. ",)
        why += (f"Along those of frame {self.body.link} the tensor is ", tensor)
        rows = [(joint, product) for joint in self.joints if (product := self._product(joint))]
        if not rows:
            return (*why, ":")
        be = (
            " are the third rows of the rotations in "
            if len(rows) > 1
            else " is the third row of the rotation in "
        )
        return (
            *why,
            "; ",
            *listed([self._turned_axis(joint) for joint, _ in rows]),
            be,
            *listed([each for _, each in rows]),
            ":",
        )

    def _product(self, joint: Joint) -> Node | None:
        """The matrices of the rows from the joint's axis to the body's frame."""
        matrices = tuple(letters.A(row.index) for row in self._way(joint))
        return Product(matrices) if len(matrices) > 1 else next(iter(matrices), None)

    def _turned_axis(self, joint: Joint) -> Node:
        return Product((self._turned, letters.z(joint_frame(self.model.context.robot, joint))))

    def _vectors(self) -> tuple[Node, ...]:
        """The axes and levers along the axes of the body."""
        context = self.model.context
        axes, levers = [], []
        for joint in self.joints:
            frame = joint_frame(context.robot, joint)
            axes.append(equation(self._turned_axis(joint), context.show(self._axis(joint))))
            if joint.type is JointType.REVOLUTE:
                arm = Parenthesized(Sum((letters.rc(self.body), Negative(letters.o(frame)))))
                levers.append((Product((self._turned, arm)), context.show(self._lever(joint))))
        if len(levers) == 2 and levers[0][1] == levers[1][1]:
            return side_by_side(axes), equation(*(name for name, _ in levers), levers[0][1])
        return side_by_side(axes), *(equation(*lever) for lever in levers)

    def _products(self) -> tuple[Line, ...]:
        """The columns of J_v of joints that turn, as cross products."""
        show = self.model.context.show
        turning = [joint for joint in self.joints if joint.type is JointType.REVOLUTE]
        crosses = tuple(
            equation(
                Product((self._turned, _bracketed(self._letters(joint)[0]))),
                Cross(show(self._axis(joint)), show(self._lever(joint))),
                show(self._column(joint)),
            )
            for joint in turning
        )
        return (Line(("The cross products of these:",), crosses),) if crosses else ()


def _bracketed(node: Node) -> Node:
    return Parenthesized(node) if isinstance(node, Cross) else node
