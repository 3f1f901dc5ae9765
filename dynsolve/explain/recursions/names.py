"""The letters of the recursions: every vector of link i along the axes of frame i, as ω_i^i and r_{ci}^i."""

from __future__ import annotations

from dataclasses import dataclass

from dynsolve.notation.tree import Letter, Node, Number, Row, Symbol, Words
from dynsolve.quantities import letters
from dynsolve.robot.model import Body, Convention, Robot


@dataclass(frozen=True, slots=True)
class LinkNames:
    """The letters of a link, by its index and that of the frame before it.

    In the `standard` convention the joint lies on the axis of the frame before.
    """

    i: Node
    before: Node
    standard: bool

    @staticmethod
    def of(robot: Robot, link: int) -> LinkNames:
        """Those of one link."""
        before = robot.joints[link - 1].parent
        return LinkNames(Number(link), Number(before), robot.convention is Convention.STANDARD)

    @staticmethod
    def general(standard: bool) -> LinkNames:
        """Those of link i."""
        return LinkNames(Symbol("i"), letters.BEFORE, standard)

    @property
    def R(self) -> Letter:
        """R_i^{i-1}: frame i seen from frame i-1."""
        return letters.bold("R", self.i, self.before)

    @property
    def axis(self) -> Letter:
        """The axis of joint i along the axes of frame i: z_{i-1}^i, in the modified convention z_i^i."""
        return letters.bold("z", self.before if self.standard else self.i, self.i)

    @property
    def lever(self) -> Letter:
        """From o_{i-1} to o_i: along the axes of frame i, in the modified convention of frame i-1."""
        return letters.bold(
            "r", Row((self.before, Words(","), self.i)), self.i if self.standard else self.before
        )

    @property
    def gravity(self) -> Letter:
        """g_0^i"""
        return letters.bold("g", Number(0), self.i)

    def vector(self, base: str, dots: int = 0) -> Letter:
        """A vector of the link along its own axes: ω_i^i, f_i^i."""
        return letters.bold(base, self.i, self.i, dots)

    def vector_before(self, base: str, dots: int = 0) -> Letter:
        """The same of the link before: ω_{i-1}^{i-1}."""
        return letters.bold(base, self.before, self.before, dots)


@dataclass(frozen=True, slots=True)
class BodyNames:
    """The letters of a body by its index, in the frame of its link."""

    index: Node
    link: LinkNames

    @staticmethod
    def of(robot: Robot, body: Body) -> BodyNames:
        """Those of one body."""
        return BodyNames(letters.index_of(body.name), LinkNames.of(robot, body.link))

    def _at_center(self, base: str) -> Letter:
        return letters.bold(base, Row((Words("c"), self.index)), self.link.i)

    @property
    def center(self) -> Letter:
        """r_{ci}^i, from o_i to the mass centre."""
        return self._at_center("r")

    @property
    def lever(self) -> Letter:
        """r_{i-1,ci}^i, from o_{i-1} to the mass centre."""
        between = Row((self.link.before, Words(","), Words("c"), self.index))
        return letters.bold("r", between, self.link.i)

    @property
    def tensor(self) -> Letter:
        """I_{ci}^i"""
        return self._at_center("I")

    @property
    def acceleration(self) -> Letter:
        """a_{ci}^i"""
        return self._at_center("a")
