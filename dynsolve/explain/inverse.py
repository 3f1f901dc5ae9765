"""Steps of the inverse kinematics: one unknown after the other, and the branches."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from dynsolve.derivation.inverse.equations import Equation, Given, Origin, Squared, Turned
from dynsolve.derivation.inverse.search import Solving
from dynsolve.derivation.inverse.subproblems import Length, OneLine, Remainder, RootLength, Solved, TwoLines
from dynsolve.document import Prose, Table
from dynsolve.explain.citations import spong
from dynsolve.explain.configurations import ConfigurationForms
from dynsolve.explain.context import Context
from dynsolve.explain.step import Detail, Step
from dynsolve.explain.writing import listed
from dynsolve.notation.build import cost, negated
from dynsolve.notation.tree import (
    Arguments,
    Function,
    Letter,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Relation,
    Sum,
    Symbol,
    column,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage

STAGE = Stage.INVERSE
_SOURCE = spong("3.3")

SHORT = 4
"""Formulas with more operations are not repeated in the table of the branches."""

_ORDINALS = ("the first", "the second")


def steps(context: Context) -> Iterator[Step]:
    """What is to be solved, the unknowns in the order in which they are found, and the branches."""
    if "inverse" not in context.wanted:
        return
    forms = ConfigurationForms(context.robot, context.values)
    yield _task(context)
    if forms.solved is None:
        yield _unsolved()
        return
    explainer = _Explainer(context, forms, forms.solved.solving)
    for step in forms.solved.solving.solved:
        yield explainer.step(step)
    yield explainer.branches()


def _task(context: Context) -> Step:
    names = context.robot.questions.reached
    wanted = column(*(Symbol(name) for name in names))
    return Step(
        id="inverse_task",
        stage=STAGE,
        title="What is to be solved",
        why=("The values of the task are given, and the joint variables that give them are looked for.",),
        formula=equation(letters.TASK, wanted),
        source=_SOURCE,
        result=(equation(context.form("r"), wanted),),
        uses=("r",),
        is_task=False,
    )


def _unsolved() -> Step:
    return Step(
        id="inverse",
        stage=STAGE,
        title="No closed form",
        why=(
            "No equation with one unknown in a known form was found: turned into the frames of the joints, "
            "squared and added, these equations stay coupled. Such arms are solved numerically.",
        ),
        detail=Detail.BRIEF,
        uses=(),
    )


@dataclass(frozen=True)
class _Explainer:
    """Explains how one task is solved."""

    context: Context
    forms: ConfigurationForms
    solving: Solving

    def step(self, step: Solved) -> Step:
        """How one unknown is found."""
        unknown = Symbol(step.coordinate)
        return Step(
            id=f"inverse_{step.coordinate}",
            stage=STAGE,
            title=f"Solving for {step.coordinate}",
            why=self._why(step),
            formula=_general(step),
            source=_SOURCE,
            working=tuple(self._equation(e) for e in step.equations),
            result=tuple(equation(unknown, value) for value in self.forms.solutions(step)),
            notes=tuple(self._notes(step)),
            uses=(),
        )

    def _equation(self, equation_: Equation) -> Node:
        form = self.forms.compactor(self.solving.ring).form
        return equation(form(equation_.left), form(equation_.right))

    # -- words -------------------------------------------------------------------------------------

    def _why(self, step: Solved) -> Prose:
        if isinstance(step, Remainder):
            return ("The task gives the sum of the angles; the others are known now.",)
        origins = [e.origin for e in step.equations]
        return (*self._origin(origins), *self._form(step))

    def _origin(self, origins: Sequence[Origin]) -> Prose:
        """Where the equations come from."""
        if all(isinstance(origin, Given) for origin in origins):
            which = "component" if len(origins) == 1 else "components"
            numbers = listed([str(o.index + 1) for o in origins if isinstance(o, Given)])
            return (f"The {which} ", *numbers, " of the task hold", "s" if len(origins) == 1 else "",
                    " no other unknown. ")  # fmt: skip
        (origin, *_) = origins
        if isinstance(origin, Squared):
            turns = _turned_by(origin.parts)
            first: Prose = (
                ("The components are turned by ", *listed([Symbol(name) for name in turns]), ", and ")
                if turns
                else ("The ",)
            )
            return (*first, "squares of ", str(len(origin.parts)), " components are added: turning a vector "
                    "does not change its length, so the other angles drop out. ")  # fmt: skip
        turns = _turned_by(origins)
        return (
            "The equations are turned back by ",
            *listed([Symbol(name) for name in turns]),
            ", which then stands on the left alone. ",
        )

    def _form(self, step: Solved) -> Prose:
        """What kind of equation it is."""
        unknown = Symbol(step.coordinate)
        match step:
            case TwoLines():
                return ("Two equations in the sine and the cosine of ", unknown, " give the angle at once.")
            case OneLine() if step.value.is_zero:
                return ("The equation gives the direction of ", unknown, ", up to half a turn.")
            case OneLine() if step.sine.is_zero:
                return ("The cosine of ", unknown, " leaves its sign open.")
            case OneLine() if step.cosine.is_zero:
                return ("The sine of ", unknown, " leaves two angles open.")
            case OneLine():
                return ("A cosine and a sine of ", unknown, " with one equation: two angles.")
            case Length():
                return (unknown, " stands in it to the first power.")
            case _:
                return (unknown, " stands in it as a square: two lengths.")

    def _notes(self, step: Solved) -> Iterator[Prose]:
        """When there is a solution, and when there are infinitely many."""
        form = self.forms.compactor(self.solving.ring).form
        match step:
            case OneLine() if not step.value.is_zero and (step.cosine.is_zero or step.sine.is_zero):
                ratio = self.forms.ratio(step.value, step.cosine + step.sine)
                within = Relation((Negative(Number(1)), ratio, Number(1)), ("≤", "≤"))
                yield ("Within reach where ", within, "; at the ends the two angles are one.")
            case OneLine() if not step.value.is_zero:
                square = step.cosine * step.cosine + step.sine * step.sine
                reach = Relation((form(step.value * step.value), form(square)), ("≤",))
                yield ("Within reach where ", reach, "; with = the two angles are one.")
            case RootLength():
                radicand = step.linear * step.linear - step.square * step.constant * 4
                yield ("Within reach where ", Relation((form(radicand), Number(0)), ("≥",)),
                       "; with = the two lengths are one.")  # fmt: skip
        free = self._free(step)
        if free:
            yield (
                "Where ",
                *listed(free),
                ", ",
                Symbol(step.coordinate),
                " is free: infinitely many solutions.",
            )

    def _free(self, step: Solved) -> list[Node]:
        """The equations under which an angle may be anything, as far as they can hold."""
        if not isinstance(step, OneLine) or not step.value.is_zero:
            return []
        return [equation(self.forms.zero(factor), Number(0)) for factor in (step.sine, step.cosine)]

    # -- the branches ------------------------------------------------------------------------------

    def branches(self) -> Step:
        """All of them, each put into r(q)."""
        found = self.forms.inverse
        names = [step.coordinate for step in self.solving.solved]
        table = Table(("", *map(Symbol, names)), tuple(self._rows()))
        count = len(found)
        why: Prose = ("There is one solution",) if count == 1 else (f"Together there are {count} solutions",)
        return Step(
            id="inverse",
            stage=STAGE,
            title="The solution" if count == 1 else f"The {count} solutions",
            why=(*why, ", found to give the task when put into r(q); a coordinate that stands in a formula "
                 "is that of the same line."),
            table=table,
            notes=tuple(self._free_coordinates()),
            detail=Detail.BRIEF,
            uses=tuple(f"inverse_{name}" for name in names),
        )  # fmt: skip

    def _rows(self) -> Iterator[tuple[Node | str, ...]]:
        """A branch a row: formulas that are short, and of the others which of their two is meant."""
        assert self.forms.solved is not None
        for number, branch in enumerate(self.forms.solved.branches, 1):
            row: list[Node | str] = [str(number)]
            for step, index in zip(self.solving.solved, branch.choice, strict=True):
                solutions = self.forms.solutions(step)
                shown = solutions[index]
                short = cost(shown) <= SHORT
                row.append(shown if short else "as above" if len(solutions) == 1 else _ORDINALS[index])
            yield tuple(row)

    def _free_coordinates(self) -> Iterator[Prose]:
        free = self.solving.free
        if free:
            verb = " does" if len(free) == 1 else " do"
            yield (
                *listed([Symbol(name) for name in free]),
                f"{verb} not change the task, and may be anything.",
            )


def _turned_by(origins: Sequence[Origin]) -> tuple[str, ...]:
    """The angles by which equations were turned, each once."""
    found: dict[str, None] = {}
    for origin in origins:
        match origin:
            case Turned(first, second, name):
                found |= dict.fromkeys((*_turned_by([first, second]), name))
            case Squared(parts):
                found |= dict.fromkeys(_turned_by(parts))
    return tuple(found)


# -- the general formulas --------------------------------------------------------------------------

_A, _B, _C, _D = (Letter(letter, style="italic") for letter in "ABCD")
_ANGLE = Symbol("psi")
_COS, _SIN = Function("cos", _ANGLE), Function("sin", _ANGLE)


def _general(step: Solved) -> Node | None:
    """The form that an equation has, and its solution."""
    match step:
        case TwoLines() if step.is_rotation:
            return None
        case OneLine() if not (step.value.is_zero or step.cosine.is_zero or step.sine.is_zero):
            square = [Power(letter, Number(2)) for letter in (_A, _B, _D)]
            root = Function("sqrt", Sum((square[0], square[1], negated(square[2]))))
            middle, either = _atan2(_B, _A), _atan2(root, _D)
            return Relation(
                (
                    Sum((Product((_A, _COS)), Product((_B, _SIN)))),
                    _D,
                    equation(_ANGLE, Relation((middle, either), ("±",))),
                ),
                ("=", "⇒"),
            )
    return None


def _atan2(y: Node, x: Node) -> Node:
    return Function("atan2", Arguments((y, x)))
