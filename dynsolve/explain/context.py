"""The data that every step is made from: the robot, its exact values, their compact forms."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from msgspec import Struct, field

from dynsolve.algebra.angles import names_of
from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.rationals import fraction
from dynsolve.algebra.ring import Expr
from dynsolve.derivation.euler_lagrange import Agreement
from dynsolve.derivation.graph import Derivation
from dynsolve.document.books import craig, spong
from dynsolve.explain.forms import Forms
from dynsolve.explain.writing import are_counted, machine
from dynsolve.notation import tree
from dynsolve.notation.characters import split
from dynsolve.notation.printing import Style, decimal_text
from dynsolve.notation.tree import Node, Symbol
from dynsolve.quantities import letters
from dynsolve.robot.model import Convention, Robot
from dynsolve.robot.names import names_taken

if TYPE_CHECKING:
    from dynsolve.explain.abbreviations import Abbreviated, Definition
    from dynsolve.robot.drawing.normals import Normals


class Context(Struct, frozen=True):
    """A robot with its derivation, exact and as trees, and whether the two ways to D, C, g agree.

    `find` are the names of what the exercise asks for.
    `normals` are those of a drawing that the table was found from, `lengths` values in m as the
    file has them.  `names` are those that the steps are written in, where they are in some,
    and `introduced` which of them a step brings in, by its id.  With `by_energies` 𝐃 is read off from 𝒦:
    nothing that is asked for needs the forces, and the equations of Lagrange are not told.
    """

    robot: Robot
    values: Derivation
    forms: Forms
    agreement: Agreement | None = None
    normals: Normals | None = None
    lengths: Mapping[str, str] = field(default_factory=dict)
    names: Abbreviated | None = None
    introduced: Mapping[str, tuple[Definition, ...]] = field(default_factory=dict)
    find: tuple[str, ...] = ()
    by_energies: bool = False

    @property
    def wanted(self) -> frozenset[str]:
        """What the exercise asks for beside the course's derivation, and what that is derived from."""
        return self.values.leading_to(self.robot.questions.asked)

    @property
    def standard(self) -> bool:
        """Whether the table is in the standard convention."""
        return self.robot.convention is Convention.STANDARD

    def by_convention(self, standard: str, modified: str) -> str:
        """The section of the book whose convention the table is in: Spong's, or Craig's."""
        return spong(standard) if self.standard else craig(modified)

    @property
    def is_short(self) -> bool:
        """Whether every line is shown; of longer arms they would fill pages."""
        return is_short(self.robot, self.forms)

    def has_friction(self, k: int) -> bool:
        """Whether a coordinate (from 0) has friction."""
        return bool(self.robot.actions.resisting) and not self.values["friction"][k, 0].is_zero

    def form(self, name: str) -> Node:
        """The tree of a quantity."""
        return self.forms(name)

    def result(self, name: str) -> Node:
        """The tree of a quantity as its own step gives it: in names, where it has some."""
        named = None if self.names is None else self.names.forms.get(name)
        return self.form(name) if named is None else named

    def named(self, node: Node) -> Node:
        """A tree with the names of the sums of masses and lengths in it."""
        return node if self.names is None else self.names.inertias.put(node)

    def symbol(self, i: int, j: int, k: int) -> Node:
        """c_ijk, from 0, as its own step gives it."""
        return self.forms.christoffel(i, j, k) if self.names is None else self.names.symbol(i, j, k)

    @property
    def has_named_symbols(self) -> bool:
        """Whether C and what is made of it are written by the Christoffel symbols in their names."""
        return self.names is not None and self.names.at_symbols

    @property
    def leaves_values_out(self) -> bool:
        """Whether equations end before values in full: of a short model whose names were asked for."""
        return self.names is not None and not (self.names.long or self.names.at_symbols)

    @property
    def is_in_letters(self) -> bool:
        """Whether the energies, momenta and forces stay in d_ij, c_ijk and g_k: those of a long model."""
        return self.names is not None and self.names.long

    def matrix(self, name: str) -> tree.Matrix:
        """The tree of a quantity that is a matrix."""
        return self.forms.matrix(name)

    def show(self, value: Expr | Matrix) -> Node:
        """The tree of any exact value."""
        return self.forms.of(value)

    @property
    def are_masses_counted(self) -> bool:
        """Whether the masses are called m_1, m_2, ..., as a sum over the bodies has them."""
        bodies = self.robot.bodies
        own = [(Symbol(f"m{body.name}"), letters.of_body("m", body)) for body in bodies]
        named = all(self.forms.mass(body) in names for body, names in zip(bodies, own, strict=True))
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


# -- which arms are worked out line by line: of others every line would fill pages -----------------

MOST_JOINTS = 3
"""Up to this number of coordinates every line is shown."""

MOST_TERMS = 20
"""The terms in the last frame up to which more coordinates without dynamics are like these."""


def is_short(robot: Robot, forms: Forms) -> bool:
    """Whether there are few coordinates; or many, and D, C and g, or only the last frame, are not long."""
    if robot.n <= MOST_JOINTS:
        return True
    if robot.has_dynamics:
        return not forms.are_long
    return sum(len(entry.poly) for entry in forms.values[f"H{len(robot.joints)}"].entries) <= MOST_TERMS


# -- how a robot's formulas look: the shorthands s_1 and c_12, decimal numbers ---------------------


def style_of(robot: Robot) -> Style:
    """The style of a robot: s_1 for sin θ_1, of all sines and cosines or of none.

    None is short where one would have no index or that of another, or where something else is called like
    one, as a length c_2: there is no cos(q_1) beside c_3.
    """
    in_angles = {name for pair in robot.ring.pairs for name in names_of(pair.angle)}
    turning = [q.name for q in robot.coordinates if q.name in in_angles]
    shorthand = {name: ",".join(split(name)[1]) for name in turning}
    is_taken = any(
        name[:1] in ("s", "c") and name[1:].replace(",", "").isdecimal() for name in names_taken(robot)
    )
    if is_taken or not all(shorthand.values()) or len({*shorthand.values()}) < len(turning):
        shorthand = {}
    return Style(shorthand=shorthand, star=True, decimal=robot.has_decimals)


DIGITS = 4
"""The significant digits of numbers that are no exact decimals, unless the problem gives more."""


def shown_digits(robot: Robot) -> int:
    """The digits with which numbers are shown: as many as the longest number of the problem has.

    >>> from dynsolve.problem import load
    >>> from dynsolve.problem.reader import find
    >>> shown_digits(load(find("numeric-2r")).robot)
    4
    """
    given = [*(e for joint in robot.joints for e in (joint.d, joint.a)), *robot.gravity.entries]
    given += [e for body in robot.bodies for e in (body.mass, *body.center.entries)]
    numbers = (fraction(factor) for expr in given for factor in expr.poly.to_dict().values())
    texts = (decimal_text(number.numerator, number.denominator) or "" for number in numbers)
    return max([DIGITS, *(len(text.replace(".", "").lstrip("-0")) for text in texts)])
