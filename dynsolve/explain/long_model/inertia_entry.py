"""One entry of D in full: that of two joints which move the same few bodies at the end of the arm."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.document import Prose
from dynsolve.explain.inertia import has_link_axes, is_moved
from dynsolve.explain.long_model.body_share import BodyShare
from dynsolve.explain.long_model.model import LongModel
from dynsolve.explain.recurring import expanded_once
from dynsolve.explain.step import Line, Step
from dynsolve.explain.writing import listed, spong
from dynsolve.notation.build import total
from dynsolve.notation.tree import Node, Sum, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage


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
