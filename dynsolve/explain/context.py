"""The data that every step is made from: the robot, its exact values, their compact forms."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.agreement import Agreement
from dynsolve.derivation.graph import Derivation
from dynsolve.explain.forms import Forms
from dynsolve.explain.short_arms import is_short
from dynsolve.explain.writing import are_counted, machine
from dynsolve.notation import tree
from dynsolve.notation.tree import Node, Symbol
from dynsolve.quantities import letters
from dynsolve.robot.drawing.procedure import Normals
from dynsolve.robot.model import Body, Convention, Robot


@dataclass(frozen=True, slots=True)
class Context:
    """A robot with its derivation, exact and as trees, and whether the two ways to D, C, g agree.

    `normals` are those of a drawing that the table was found from, `lengths` values in m as the
    file has them.
    """

    robot: Robot
    values: Derivation
    forms: Forms
    agreement: Agreement | None = None
    normals: Normals | None = None
    lengths: Mapping[str, str] = field(default_factory=dict)

    @property
    def wanted(self) -> frozenset[str]:
        """What the exercise asks for beside the course's derivation, and what that is derived from."""
        return self.values.leading_to(self.robot.questions.asked)

    @property
    def standard(self) -> bool:
        """Whether the table is in the standard convention."""
        return self.robot.convention is Convention.STANDARD

    @property
    def is_short(self) -> bool:
        """Whether every line is shown; of longer arms they would fill pages."""
        return is_short(self.robot, self.values)

    def has_friction(self, k: int) -> bool:
        """Whether a coordinate (from 0) has friction."""
        return "friction" in self.values.rules and not self.values["friction"][k, 0].is_zero

    def form(self, name: str) -> Node:
        """The tree of a quantity."""
        return self.forms(name)

    def matrix(self, name: str) -> tree.Matrix:
        """The tree of a quantity that is a matrix."""
        node = self.forms(name)
        assert isinstance(node, tree.Matrix)
        return node

    def show(self, value: Expr | Matrix) -> Node:
        """The tree of any exact value."""
        return self.forms.of(value)

    def mass(self, body: Body) -> Node:
        """The mass of a body in a formula: the problem's symbol, else m_i unless that is another thing."""
        shown = self.show(body.mass)
        if isinstance(shown, Symbol) or letters.is_taken(self.robot, "m", body):
            return shown
        return letters.of_body("m", body)

    @property
    def are_masses_counted(self) -> bool:
        """Whether the masses are called m_1, m_2, ..., as a sum over the bodies has them."""
        bodies = self.robot.bodies
        own = [(Symbol(f"m{body.name}"), letters.of_body("m", body)) for body in bodies]
        named = all(self.mass(body) in names for body, names in zip(bodies, own, strict=True))
        return named and are_counted(bodies)

    @property
    def end(self) -> str:
        """The point that the last H and the Jacobian are of, in words."""
        if self.robot.ends_in_a_joint or self.robot.is_tree:
            return f"the origin of frame {len(self.robot.joints)}"
        return "the end of the arm"

    @property
    def ground(self) -> str:
        """The frame of reference in words: frame 0 (the base), or the world in which the problem turns it."""
        return "world" if letters.has_base(self.robot) or not self.robot.has_table else "base"

    @property
    def machine(self) -> str:
        """What moves, in words."""
        return machine(self.robot)
