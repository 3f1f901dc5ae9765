"""The step that counts the solutions of inverse kinematics and says which choices go together."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from dynsolve.derivation.configurations import Conditions
from dynsolve.document import Prose, Table
from dynsolve.document.sentences import opened, paragraph, say
from dynsolve.explain.step import NOTED, Detail, Step
from dynsolve.explain.writing import agreeing, listed
from dynsolve.notation.build import cost
from dynsolve.notation.tree import Node, Symbol, equation, names_in
from dynsolve.questions.inverse.existence import Existence
from dynsolve.questions.inverse.forms import InverseForms
from dynsolve.questions.inverse.subproblems import Remainder, Solved
from dynsolve.questions.inverse.target import task_of

SHORT = 4
"""Formulas with more operations are not repeated in the table of the branches."""


class Branches:
    """All solutions of a task, each a choice among the values of the unknowns that have two."""

    def __init__(self, forms: InverseForms, existence: Existence) -> None:
        assert forms.solved is not None
        self.forms = forms
        self.existence = existence
        self.solving = forms.solved.solving
        self.choices = forms.solved.branches
        self.count = len(forms.inverse)
        self.task = task_of(forms.robot)
        self.names = [step.coordinate for step in self.solving.solved]
        self.one, self.several = ("branch", "branches") if forms.target else ("solution", "solutions")

    @cached_property
    def two_valued(self) -> dict[int, Solved]:
        """The unknowns that have two values, by their places among all."""
        found = enumerate(self.solving.solved)
        return {k: step for k, step in found if len(self.forms.inverse_formulas.solutions(step)) > 1}

    @cached_property
    def is_every_choice(self) -> bool:
        """Whether every choice of a value goes with every other, wherever the task is one of letters."""
        is_one_condition = len(set(self.forms.when)) <= 1
        is_every = len(self.choices) == 2 ** len(self.two_valued)
        return self.forms.target is None and is_one_condition and is_every

    @cached_property
    def is_tested(self) -> bool:
        """Whether a choice decides whether the others solve the task."""
        tested = names_in(*(side for when in self.forms.when for one in when for side in one.sides))
        return not tested.isdisjoint(self.names)

    @cached_property
    def is_certain(self) -> bool:
        """Whether no choice decides whether another unknown has values, or solves the task."""
        conditions = [self.existence.boundary(step) for step in self.two_valued.values()]
        decided = names_in(*(there for there in conditions if there is not None))
        return not self.is_tested and decided.isdisjoint(step.coordinate for step in self.two_valued.values())

    def step(self) -> Step:
        """Each solution is put into r(q); a table where not every choice goes with every other."""
        table = None if self.is_every_choice or not self.two_valued else self._table()
        notes = (*self._conditions(), *self._free_coordinates())
        together = self._together()
        starts = tuple(f"inverse_{what}_{number}" for what, number in self._defined())
        return Step(
            id=id_of_branches(self.forms),
            title=self._title(),
            why=say(
                "{together} {each} is put into {task} to see that it gives what is asked. {same}",
                together=together,
                each="Each" if self.count > 1 else "It",
                task=self.task,
                same=self._same(table),
            ),
            table=table,
            notes=notes,
            outcome=paragraph((self._in_short(together), *notes)),
            normal=NOTED,
            detail=Detail.BRIEF,
            uses=(*(f"inverse_{name}" for name in self.names), *starts),
            hint=say(
                "Put every choice among these into {task}: those that give what is asked are the solutions.",
                task=self.task,
            ),
            hint_title="The solutions",
        )

    def _title(self) -> str:
        if self.count == 1:
            return f"The {self.one}"
        return f"The {self.count} {self.several}" if self.is_certain else f"The {self.several}"

    def _number(self) -> str:
        """How many there are."""
        if self.count == 1:
            return f"there is one {self.one}"
        return f"there are {'' if self.is_certain else 'at most '}{self.count} {self.several}"

    def _each_free(self) -> Prose:
        free = [Symbol(name) for name in self.solving.free]
        return say(" for each value of {free}", free=listed(free)) if free else ()

    def _where(self) -> Prose:
        """Where they exist, if no choice decides that."""
        found = [self.existence.boundary(step) for step in self.two_valued.values()]
        inside = [one for one in found if one is not None and self.is_certain]
        if not inside:
            return ()
        return say(
            " where {inside}, {which} coincide on the boundary, and none elsewhere{free}",
            inside=listed(inside),
            which="which" if len(self.two_valued) == 1 else "some of which",
            free=", and infinitely many where a coordinate is free" * self.existence.is_free_somewhere,
        )

    def _together(self) -> Prose:
        """Which unknowns have two values, and how many solutions that gives."""
        if not (self.is_every_choice and self.two_valued):
            return say("{number}{free}.", number=opened(self._number()), free=self._each_free())
        text = "{q} has two values: {number}{free}{where}."
        if len(self.two_valued) > 1:
            gives = f"every choice {'gives' if self.is_certain else 'that exists gives'} a solution"
            text = f"{{q}} have two values each{'' if self.is_tested else f', and {gives}'}: "
            text += "{number}{free}{where}."
        chosen = listed([Symbol(step.coordinate) for step in self.two_valued.values()])
        return say(text, q=chosen, number=self._number(), free=self._each_free(), where=self._where())

    def _same(self, table: Table | None) -> str:
        """Of which solution a coordinate is that stands in a formula, where one does."""
        shown = [node for step in self.solving.solved for node in self.forms.inverse_formulas.solutions(step)]
        if table is not None:
            shown = [cell for row in table.rows for cell in row if isinstance(cell, Node)]
        if self.count == 1 or names_in(*shown).isdisjoint(self.names):
            return ""
        which = "solution" if self.is_every_choice else "line"
        return f"A coordinate that stands in a formula is that of the same {which}."

    def _in_short(self, together: Prose) -> Prose:
        """Their number, and what they need."""
        needed = self.existence.all_needed
        said = ["{together}"] if self.is_every_choice and self.two_valued else []
        subject = f"{self.several} need" if self.count > 1 else f"{self.one} needs"
        said += [f"The {subject} {{needed}}."] if needed else []
        return say(" ".join(said), together=together, needed=listed(needed))

    def _defined(self) -> Iterator[tuple[str, int]]:
        """The steps that define names for what the unknowns are found from, by their kinds and numbers."""
        for number, part in enumerate(self.solving.parts, 1):
            if part.turn is not None and part.turn.definitions:
                yield "turn", number
            if part.point is not None and part.point.definitions:
                yield "point", number

    def _table(self) -> Table:
        """A branch a row: the values of the unknowns that have two, or which of them is meant."""
        formulas, rows = self.forms.inverse_formulas, []
        for number, branch in enumerate(self.choices, 1):
            row: list[Node | str] = [str(number)]
            for k, step in self.two_valued.items():
                solutions, index = formulas.solutions(step), branch.choice[k]
                which = ("with +", "with -") if formulas.has_signs(step) else ("the first", "the second")
                row.append(solutions[index] if cost(solutions[index]) <= SHORT else which[index])
            rows.append(tuple(row))
        names = [Symbol(step.coordinate) for step in self.two_valued.values()]
        return Table(("", *names), tuple(rows))

    def _conditions(self) -> Iterator[Prose]:
        """Where the branches are solutions, those with the same conditions together."""
        lines: dict[Conditions, list[str]] = {}
        for number, when in enumerate(self.forms.when, 1):
            lines.setdefault(when, []).append(str(number))
        for when, numbers in lines.items():
            if when:
                which = "Line|Lines {numbers} holds|hold" if len(lines) > 1 else "This|They holds|hold"
                text = " where {conditions} alone: the joints give {task} no other values."
                if len(when) == len(self.forms.robot.questions.reached):
                    text = " only where {task} is then what is given: the joints give it no other values."
                yield say(
                    agreeing(which, len(numbers)) + text,
                    numbers=listed(numbers),
                    conditions=listed([equation(*one.sides) for one in when]),
                    task=self.task,
                )

    def _free_coordinates(self) -> Iterator[Prose]:
        """Coordinates that the task leaves free, and those that it does not hold."""
        sums = [step for step in self.solving.solved if isinstance(step, Remainder)]
        bound = [name for name in self.solving.free if any(name in dict(step.others) for step in sums)]
        unused = [name for name in self.solving.free if name not in bound]
        if bound:
            yield say("{q} may be anything; the others follow.", q=listed([*map(Symbol, bound)]))
        if unused:
            text = agreeing("{q} does|do not change the task, and may be anything.", len(unused))
            yield say(text, q=listed([*map(Symbol, unused)]))


def id_of_branches(forms: InverseForms) -> str:
    """Where the target is given in numbers, the answer comes after the branches."""
    return "inverse" if forms.target is None else "inverse_branches"
