"""One entry of D in full: that of two joints which move the same few bodies at the end of the arm."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property, partial, reduce
from itertools import chain

from msgspec import Struct

from dynsolve.algebra import matrix as algebra
from dynsolve.algebra.ring import Expr
from dynsolve.derivation.kinematics import dh_matrix, joint_frame, linear_jacobian, origin, rotation
from dynsolve.document import Prose
from dynsolve.document.books import spong
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.inertia import has_link_axes, is_moved
from dynsolve.explain.jacobian import ZERO, column_letters, columns_shown, coordinate_column
from dynsolve.explain.last_frame import halves
from dynsolve.explain.matrix_factors import matrix_width
from dynsolve.explain.recurring import expanded_once
from dynsolve.explain.step import Detail, Line, Step
from dynsolve.explain.working.identities import new_angles
from dynsolve.explain.writing import listed, side_by_side
from dynsolve.notation import tree
from dynsolve.notation.build import cost, total
from dynsolve.notation.differentiation import product_of
from dynsolve.notation.template import formula
from dynsolve.notation.tree import Cross, Node, Parenthesized, Product, Sum, Transpose, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Body, Joint, JointType

brief_step = partial(Step, detail=Detail.BRIEF, uses=())
"""A step that stands for many."""


class InertiaEntry(Struct, frozen=True, dict=True):
    """d_jk of two joints, counted from 0, by what each of the bodies adds that both move."""

    context: Context
    row: int
    column: int
    shares: tuple[BodyShare, ...]

    @property
    def is_whole(self) -> bool:
        """Whether the shares are the entry of D."""
        added = sum((share.value for share in self.shares), start=self.context.robot.ring.zero)
        return bool(added == self.context.values["D"][self.row, self.column])

    @property
    def is_of_both_parts(self) -> bool:
        """Whether every body adds something, and something moves and turns."""
        turned = any(not share.angular.is_zero for share in self.shares)
        moved = any(not share.linear.is_zero for share in self.shares)
        return turned and moved and all(not share.value.is_zero for share in self.shares)

    def step(self) -> Step:
        """From the formula of D to the entry in the names of the model."""
        short, show, shares = self.context.names, self.context.show, self.shares
        assert short is not None
        name = letters.entry("d", self.row + 1, self.column + 1)
        form = short.D.rows[self.row][self.column]
        whole = total([show(share.value) for share in shares])
        members = dict.fromkeys((whole, expanded_once(short.sums, form), form))
        many = len(shares) > 1
        are_multiplied = many and any(not (one.linear.is_zero or one.angular.is_zero) for one in shares)
        lines: list[Line] = []
        for share in shares:
            lines += share.lines()
            lines += [share.products()] if are_multiplied else []
        added = "Added up" if are_multiplied else "Put in"
        return Step(
            id="D_entry",
            stage=Stage.VECTORIZED,
            title="One entry of the inertia matrix in full",
            why=say(
                "Joint {joint} moves {what} {bodies} alone, so {name} has the terms of {these}. Products of "
                "vectors, and of a tensor with them, are the same along any axes: {those} of the link "
                "{each}are taken.",
                joint=self.context.robot.number_of(shares[0].last.joint),
                what="bodies" if many else "body",
                bodies=listed([share.body.name for share in shares]),
                name=name,
                these="these" if many else "this body",
                those="those" if many else "here those",
                each="of each body " if many else "",
            ),
            formula=equation(name, Sum(tuple(chain(*(share.in_letters for share in shares))))),
            source=spong("7.2.2"),
            lines=tuple(lines),
            concluding=(f"{added}{', and collected in the abbreviations' if len(members) > 1 else ''}:",),
            result=(equation(name, *members),),
            notes=(
                ("The other entries are made alike, with such terms of each body that both joints move.",),
            ),
            uses=(),
        )


MOST_BODIES = 2
"""The bodies of which the terms of an entry are shown."""


def worked_entry(context: Context) -> InertiaEntry | None:
    """The entry that is worked out: of two bodies where one is found, else of the last body alone."""
    robot = context.robot
    if robot.is_tree or not robot.has_table or not robot.moves_each_joint_alone or robot.actions.rotors:
        return None
    entries = list(_entries(context))
    several = [entry for entry in entries if len(entry.shares) > 1 and entry.is_of_both_parts]
    for entry in (*several, *(entry for entry in entries if len(entry.shares) == 1)):
        if entry.is_whole and any(not share.value.is_zero for share in entry.shares):
            return entry
    return None


def _entries(context: Context) -> Iterator[InertiaEntry]:
    """The entries of the last two columns above the diagonal that few bodies add to, upwards from it."""
    moving = [joint for joint in context.robot.joints if joint.type]
    for column in range(context.robot.n - 2, context.robot.n):
        carried = [body for body in context.robot.bodies if body.link >= moving[column].index]
        if len(carried) > MOST_BODIES or not all(has_link_axes(b) and not is_moved(b) for b in carried):
            continue
        for row in reversed(range(column)):
            both = moving[row], moving[column]
            shares = (BodyShare(context, body, *(_side(context, body, j) for j in both)) for body in carried)
            yield InertiaEntry(context, row, column, tuple(shares))


# -- what one body adds to an entry of D, by vectors along the axes of its own link ----------------
# Along these the tensor and the mass centre are constant, and the axes of the joints are rows of short
# products of the table's matrices, so that a person can follow with a pencil.

BESIDE = 30
"""The characters that two levers may have to stand side by side."""


class _Side(Struct, frozen=True, dict=True):
    """A joint and, along the axes of the link of a body that it moves, Rᵀ z, Rᵀ (r_c - o), the column of J_v.

    `way` are the rows from the joint's axis to the body's frame, `names` J_v and J_ω in letters.
    """

    joint: Joint
    turns: bool
    way: tuple[Joint, ...]
    names: tuple[Node, Node]
    axis: algebra.Matrix
    lever: algebra.Matrix
    column: algebra.Matrix


def _side(context: Context, body: Body, joint: Joint) -> _Side:
    robot, turns = context.robot, joint.type is JointType.REVOLUTE
    way = robot.joints[joint_frame(robot, joint) : body.link]
    matrices = (dh_matrix(robot, row) for row in way)
    along = reduce(lambda left, right: left @ right, matrices, algebra.Matrix.identity(robot.ring, 4))
    back = rotation(along).T
    axis, lever = back.column_at(2), body.center + back @ origin(along)
    column = algebra.cross(axis, lever) if turns else axis
    return _Side(joint, turns, way, column_letters(context, joint, letters.rc(body)), axis, lever, column)


class BodyShare(Struct, frozen=True, dict=True):
    """m (J_v)_jᵀ (J_v)_k + (J_ω)_jᵀ I (J_ω)_k of one body and two joints that move it."""

    context: Context
    body: Body
    first: _Side
    last: _Side

    @property
    def value(self) -> Expr:
        """Both parts together."""
        return self.linear + self.angular

    @cached_property
    def linear(self) -> Expr:
        """m (J_v)_jᵀ (J_v)_k"""
        left, right = self.first.column.entries, self.last.column.entries
        return self.context.robot.ring.dot(left, right) * self.body.mass

    @cached_property
    def angular(self) -> Expr:
        """(J_ω)_jᵀ I (J_ω)_k, zero where one of the joints slides."""
        if not (self.first.turns and self.last.turns):
            return self.context.robot.ring.zero
        tensor: algebra.Matrix = self.context.values[f"I_body{self.body.name}"]
        return (self.first.axis.T @ tensor @ self.last.axis)[0, 0]

    @property
    def in_letters(self) -> tuple[Node, ...]:
        """m (J_v)_jᵀ (J_v)_k and (J_ω)_jᵀ 𝓘 (J_ω)_k in axes and levers."""
        (v, w), (other_v, other_w) = self.first.names, self.last.names
        linear = Product((self.context.forms.mass(self.body), Transpose(_bracketed(v)), _bracketed(other_v)))
        tensor = letters.base_tensor(letters.index_of(self.body.name))
        both_turn = self.first.turns and self.last.turns
        return (linear, Product((Transpose(w), tensor, other_w))) if both_turn else (linear,)

    def lines(self) -> Iterator[Line]:
        """The vectors along the axes of the body, and their cross products."""
        yield Line(self._on_the_axes(), self._vectors())
        crosses = [
            equation(
                self._turned(_bracketed(side.names[0])),
                Cross(self._shown(side.axis), self._shown(side.lever)),
                self._shown(side.column),
            )
            for side in (self.first, self.last)
            if side.turns
        ]
        if crosses:
            yield Line(("The cross products of these:",), tuple(crosses))

    def products(self) -> Line:
        """m (J_v)_jᵀ (J_v)_k entry by entry, and (J_ω)_jᵀ 𝓘 (J_ω)_k."""
        show, (moved, *turned) = self.context.show, self.in_letters
        rows = zip(self._shown(self.first.column).rows, self._shown(self.last.column).rows, strict=True)
        entries = Parenthesized(total([product_of(1, [(a, 1), (b, 1)]) for (a,), (b,) in rows]))
        linear, angular = show(self.linear), show(self.angular)
        used = new_angles(self.context.robot.ring, self._factors(), [linear, angular])
        return Line(
            (f"Multiplied, for body {self.body.name}", *((", with ", *listed(used)) if used else ()), ":"),
            (
                equation(moved, Product((self.context.forms.mass(self.body), entries)), linear),
                equation(*turned, angular),
            ),
        )

    def _factors(self) -> list[Node]:
        """What is multiplied: the columns, the axes and the tensor."""
        tensor = self.context.values[f"I_body{self.body.name}"]
        vectors = [x for side in (self.first, self.last) for x in (side.column, side.axis)]
        return [self.context.show(each) for each in (*vectors, tensor)]

    def _turned(self, vector: Node) -> Node:
        """Rᵀ times a vector, in letters."""
        return Product((Transpose(letters.of_body("R", self.body, "bold")), vector))

    def _shown(self, vector: algebra.Matrix) -> tree.Matrix:
        shown = self.context.show(vector)
        assert isinstance(shown, tree.Matrix)
        return shown

    def _axis(self, side: _Side) -> Node:
        return self._turned(letters.z(joint_frame(self.context.robot, side.joint)))

    def _on_the_axes(self) -> Prose:
        """Along which axes the vectors are written, and where those of the joints are read off."""
        sides = [side for side in (self.first, self.last) if side.way]
        read_off = say(
            "; {axes} {be} in {products}. A lever is the mass centre in frame {link} plus the fourth column "
            "of the same product, turned to these axes",
            axes=listed([self._axis(side) for side in sides]),
            be="are the third rows of the rotations"
            if len(sides) > 1
            else "is the third row of the rotation",
            products=listed([_product([letters.A(row.index) for row in side.way]) for side in sides]),
            link=self.body.link,
        )
        return say(
            "Along the axes of frame {link} the tensor is {tensor}{read_off}:",
            link=self.body.link,
            tensor=letters.tensor(self.context.robot, self.body),
            read_off=read_off if sides else "",
        )

    def _vectors(self) -> tuple[Node, ...]:
        """The axes and levers along the axes of the body."""
        axes, levers = [], []
        for side in (self.first, self.last):
            axes.append(equation(self._axis(side), self._shown(side.axis)))
            if side.turns:
                frame = joint_frame(self.context.robot, side.joint)
                arm = formula("({center} - {o})", center=letters.rc(self.body), o=letters.o(frame))
                levers.append((self._turned(arm), self._shown(side.lever)))
        if len(levers) == 2 and levers[0][1] == levers[1][1]:
            return side_by_side(axes), equation(*(name for name, _ in levers), levers[0][1])
        shown = [equation(*each) for each in levers]
        width = sum(matrix_width(self.context, value) for _, value in levers)
        beside = len(levers) == 2 and width <= BESIDE
        return side_by_side(axes), *([side_by_side(shown)] if beside else shown)


def _product(factors: Sequence[Node]) -> Node:
    return factors[0] if len(factors) == 1 else Product(tuple(factors))


def _bracketed(node: Node) -> Node:
    return Parenthesized(node) if isinstance(node, Cross) else node


# -- the kinetic energy of each body of a long model: the columns of its Jacobians, worked out for one body

LONGEST_ENTRY = 30
"""The operations in an entry of a body's Jacobian up to which its columns are worked out."""


def kinetic_step(context: Context) -> Step:
    """v_i = J_vi q̇ and ω_i = J_ωi q̇, what the columns are, and K_i."""
    example = tuple(_example(context))
    j = formula("j - 1" if context.standard else "j")
    sliding = any(joint.type is JointType.PRISMATIC for joint in context.robot.joints)
    both = say(" where the joint is revolute, $𝐳_{j}$ and {zero} where it is prismatic", j=j, zero=ZERO)
    v = letters.transposed_product(formula("𝐯_i"))
    w = letters.transposed_product(formula("𝛚_i"), formula("𝓘_i"))
    return brief_step(
        id="kinetics",
        stage=Stage.ENERGY,
        title="Kinetic energy of each body",
        why=say(
            "The Jacobians of a mass centre are like those of the arm, with its place instead of {end}: for "
            "each joint j up to the body's link, column $j$ of $𝐉_v_i$ is $𝐳_{j} × (𝐫_ci - 𝐨_{j})$ and that "
            "of $𝐉_ω_i$ is $𝐳_{j}${both}. The columns of the joints after it are zero.",
            end=context.end,
            j=j,
            both=both if sliding else "",
        ),
        formula=formula("𝐯_i = 𝐉_v_i 𝐪̇, 𝛚_i = 𝐉_ω_i 𝐪̇"),
        source=spong("7.2.2"),
        lines=example,
        concluding=("The kinetic energy of a body:",) if example else (),
        result=(formula("K_i = ½ m_i {v} + ½ {w}", v=v, w=w),),
    )


def _example(context: Context) -> Iterator[Line]:
    """J_v of the body half-way along the arm: where its mass centre is, and the columns."""
    robot = context.robot
    link = halves(robot)[0][-1].index
    body = next((body for body in robot.bodies if body.link == link), None)
    if robot.is_tree or body is None or not robot.moves_each_joint_alone:
        return
    frames = [context.values[f"H{i}"] for i in range(link + 1)]
    J = context.show(linear_jacobian(robot, frames, context.values[f"rc{body.name}"], link))
    assert isinstance(J, tree.Matrix)
    names = [coordinate_column(context, k, link, letters.rc(body)) for k in range(robot.n)]
    named = [k for k, name in enumerate(names) if name is not None]
    if max(cost(row[k]) for row in J.rows for k in named) > LONGEST_ENTRY:
        return
    yield Line(
        say(
            "For example, the columns of {J} that are not zero, with the mass centre of body {body}:",
            J=letters.jv(body),
            body=body.name,
        ),
        (equation(letters.rc(body), context.form(f"rc{body.name}")), *columns_shown(names, J)),
    )
