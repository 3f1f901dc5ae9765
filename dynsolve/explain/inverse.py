"""Steps of the inverse kinematics: one unknown after the other, and the branches."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.positivity import is_nonnegative, is_positive
from dynsolve.derivation.configuration_check import Conditions
from dynsolve.derivation.inverse.equations import (
    Direct,
    Equation,
    Given,
    OfPoint,
    OfTurn,
    Origin,
    Squared,
    Turned,
    lineage,
)
from dynsolve.derivation.inverse.solving import Part, Solving
from dynsolve.derivation.inverse.subproblems import Length, OneLine, Remainder, RootLength, Solved, TwoLines
from dynsolve.document import Prose, Table
from dynsolve.explain.context import Context
from dynsolve.explain.inverse_figures import figure_of
from dynsolve.explain.inverse_formulas import ConfigurationForms, InverseFormulas
from dynsolve.explain.inverse_target import given_numbers, introduction, pose_task, target_steps, wrist_notes
from dynsolve.explain.step import NOTED, RESUMED, Detail, Line, Step
from dynsolve.explain.step import Part as Shown
from dynsolve.explain.writing import listed, side_by_side, spong
from dynsolve.notation.build import cost, negated, power, times, total
from dynsolve.notation.tree import (
    Arguments,
    Function,
    Letter,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Reference,
    Relation,
    Sum,
    Symbol,
    column,
    equation,
)
from dynsolve.notation.walk import names_in
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import JointType, Robot

STAGE = Stage.INVERSE
_SOURCE = spong("3.3")

SHORT = 4
"""Formulas with more operations are not repeated in the table of the branches."""

_ORDINALS = ("the first", "the second")
_SIGNS = ("with +", "with -")


def steps(context: Context) -> Iterator[Step]:
    """What is to be solved, the unknowns in the order in which they are found, and the branches."""
    if "inverse" not in context.wanted:
        return
    forms = ConfigurationForms(context.robot, context.values)
    task = context.robot.questions.task
    assert task is not None
    yield pose_task(context) if task.is_pose else _task(context, forms)
    if forms.solved is None:
        yield _unsolved(forms)
    else:
        yield from _Explainer(context, forms, forms.solved.solving).steps()
    if forms.target is not None:
        yield from target_steps(forms.target)


def _task(context: Context, forms: ConfigurationForms) -> Step:
    names = context.robot.questions.reached
    numbers = given_numbers(forms.target) if forms.target is not None else ()
    wanted = column(*(Symbol(name) for name in names))
    return Step(
        id="inverse_task",
        stage=STAGE,
        title="What is to be solved",
        why=("The values of the task are given, and the joint variables that give them are looked for.",),
        formula=equation(letters.TASK, wanted),
        source=_SOURCE,
        result=(equation(context.form("r"), wanted), *numbers),
        uses=("r",),
        is_task=False,
    )


def _unsolved(forms: ConfigurationForms) -> Step:
    return Step(
        id=_id_of_branches(forms),
        stage=STAGE,
        title="No closed form",
        why=(
            "No equation with one unknown in a known form was found: turned into the frames of the joints, "
            "squared and added, these equations stay coupled. Such arms are solved numerically.",
        ),
        detail=Detail.BRIEF,
        notes=tuple(_of_pieper(forms.robot)),
        normal=NOTED,
        uses=(),
    )


def _of_pieper(robot: Robot) -> Iterator[Prose]:
    """What is known of three joints that turn, though they are not solved for in a known form."""
    task = robot.questions.task
    wanted = [entry.quantity for entry in task.entries if isinstance(entry, Reference)] if task else []
    all_turn = robot.n == 3 and all(q.type is JointType.REVOLUTE for q in robot.coordinates)
    if all_turn and len(wanted) == 3 and len(set(wanted)) == 1:
        yield (
            "Brought to one angle, the equations of a point that three joints turn are of degree four in the "
            "tangent of half that angle (Pieper 1968; Craig, section 4.6): at most four configurations reach "
            "it, or infinitely many.",
        )


def _id_of_branches(forms: ConfigurationForms) -> str:
    """Where the target is given in numbers, the answer comes after the branches."""
    return "inverse" if forms.target is None else "inverse_branches"


@dataclass(frozen=True)
class _Explainer:
    """Explains how one task is solved."""

    context: Context
    forms: ConfigurationForms
    solving: Solving

    def steps(self) -> Iterator[Step]:
        """The unknowns, one after the other, and the branches."""
        before: tuple[Solved, ...] = ()
        general: list[Node | None] = []
        for number, part in enumerate(self.solving.parts, 1):
            yield from introduction(self.formulas, part, number, before)
            for step in part.solved:
                found = self._step(step, before, part)
                told = found.formula in general
                yield replace(found, normal=found.normal & ~Shown.FORMULA) if told else found
                general.append(found.formula)
                before = (*before, step)
        yield self._branches()

    def _step(self, step: Solved, before: tuple[Solved, ...], part: Part) -> Step:
        """How one unknown is found."""
        unknown = Symbol(step.coordinate)
        way = InverseWay(self.formulas, step, before)
        results = self.formulas.results(unknown, step)
        lines = tuple(way.lines)
        shown = names_in(*results, *(lines[-1].formulas if lines else way.working))
        return Step(
            id=f"inverse_{step.coordinate}",
            stage=STAGE,
            title=f"Solving for {step.coordinate}",
            why=self._why(step),
            working=way.working,
            lines=lines,
            formula=_general(step),
            source=_SOURCE,
            concluding=("So:",) if lines else (),
            result=results,
            figure=figure_of(self.formulas, step),
            notes=tuple(self._notes(step, part)),
            normal=NOTED if way.starts_anew or not lines else RESUMED,
            uses=("inverse_task", *(f"inverse_{s.coordinate}" for s in before if s.coordinate in shown)),
        )

    @property
    def formulas(self) -> InverseFormulas:
        return self.forms.inverse_formulas

    # -- words -------------------------------------------------------------------------------------

    def _why(self, step: Solved) -> Prose:
        if isinstance(step, Remainder):
            return ("The task gives the sum of the angles; the others are known now.",)
        return (*_origin([e.origin for e in step.equations]), *_form(step))

    def _notes(self, step: Solved, part: Part) -> Iterator[Prose]:
        """When there is a solution, and when there are infinitely many."""
        if part.turn is not None and part.turn.is_wrist:
            yield from wrist_notes(self.formulas, part.turn, step)
            return
        form = self.formulas.form
        one = "; on the boundary, with =, the two solutions are one."
        match step:
            case OneLine() if not step.value.is_zero and (step.cosine.is_zero or step.sine.is_zero):
                ratio = self.formulas.ratio(step.value, step.cosine + step.sine)
                within = Relation((Negative(Number(1)), ratio, Number(1)), ("≤", "≤"))
                yield ("There are solutions where ", within, one)
            case OneLine() if not step.value.is_zero:
                yield ("There are solutions where ", self.formulas.boundary(step), one)
            case RootLength():
                radicand = Relation((self.formulas.radicand(step), Number(0)), ("≥",))
                yield ("There are solutions where ", radicand, one)
            case Length() if not (is_nonnegative(step.factor) or is_nonnegative(-step.factor)):
                yield ("This needs ", Relation((form(step.factor), Number(0)), ("≠",)), ".")
        free = self._free(step)
        if free:
            unknown = Symbol(step.coordinate)
            yield ("Where ", *listed(free), ", ", unknown, " is free: infinitely many solutions.")

    def _free(self, step: Solved) -> list[Node]:
        """The equations under which an angle may be anything, as far as they can hold."""
        match step:
            case OneLine(_, cosine, sine, value) if value.is_zero:
                factors = [sine, cosine]
            case TwoLines(_, (cosine, sine, _), _) if step.is_rotation:
                factors = [factor for factor in (cosine, sine) if not factor.is_zero]
            case _:
                return []
        if any(is_positive(factor * factor) for factor in factors):
            return []
        return [equation(self.forms.vanishing(factor), Number(0)) for factor in factors]

    # -- the branches ------------------------------------------------------------------------------

    def _branches(self) -> Step:
        """All of them, each put into r(q)."""
        found = self.forms.inverse
        names = [step.coordinate for step in self.solving.solved]
        table = Table(("", *map(Symbol, names)), tuple(self._rows()))
        count = len(found)
        why: Prose = ("There is one solution",) if count == 1 else (f"Together there are {count} solutions",)
        return Step(
            id=_id_of_branches(self.forms),
            stage=STAGE,
            title="The solution" if count == 1 else f"The {count} solutions",
            why=(*why, ", each put into ", self._task, " to see that it gives what is asked. A coordinate "
                 "that stands in a formula is that of the same line."),
            table=table,
            notes=(*self._conditions(), *self._free_coordinates()),
            normal=NOTED,
            detail=Detail.BRIEF,
            uses=tuple(f"inverse_{name}" for name in names),
            hint=("Put every choice among these into ", self._task,
                  ": those that give what is asked are the solutions."),
            hint_title="The solutions",
        )  # fmt: skip

    @property
    def _task(self) -> Node:
        """What is to have given values."""
        task = self.context.robot.questions.task
        return letters.FRAME_OF_Q if task is not None and task.is_pose else letters.TASK_OF_Q

    def _rows(self) -> Iterator[tuple[Node | str, ...]]:
        """A branch a row: formulas that are short, and of the others which of their two is meant."""
        assert self.forms.solved is not None
        for number, branch in enumerate(self.forms.solved.branches, 1):
            row: list[Node | str] = [str(number)]
            for step, index in zip(self.solving.solved, branch.choice, strict=True):
                solutions = self.formulas.solutions(step)
                shown = solutions[index]
                if cost(shown) <= SHORT:
                    row.append(shown)
                elif len(solutions) == 1:
                    row.append("as above")
                else:
                    row.append((_SIGNS if self.formulas.has_signs(step) else _ORDINALS)[index])
            yield tuple(row)

    def _conditions(self) -> Iterator[Prose]:
        """Where the branches are solutions, those with the same conditions together."""
        lines: dict[Conditions, list[str]] = {}
        for number, when in enumerate(self.forms.when, 1):
            lines.setdefault(when, []).append(str(number))
        for when, numbers in lines.items():
            if when:
                several = len(numbers) > 1
                which = listed(numbers) if len(lines) > 1 else ()
                start = ("Lines " if several else "Line ") if which else "They" if several else "This"
                conditions = listed([equation(*one.sides) for one in when])
                yield (start, *which, " hold where " if several else " holds where ", *conditions,
                       " alone: the joints give ", self._task, " no other values.")  # fmt: skip

    def _free_coordinates(self) -> Iterator[Prose]:
        free = self.solving.free
        sums = [step for step in self.solving.solved if isinstance(step, Remainder)]
        bound = [name for name in free if any(name in dict(step.others) for step in sums)]
        if bound:
            yield (*listed(list(map(Symbol, bound))), " may be anything; the others follow.")
        unused = [name for name in free if name not in bound]
        if unused:
            verb = " does" if len(unused) == 1 else " do"
            yield (*listed(list(map(Symbol, unused))), f"{verb} not change the task, and may be anything.")


# -- words -----------------------------------------------------------------------------------------


def _origin(origins: Sequence[Origin]) -> Prose:
    """How the equations are made."""
    match origins[0]:
        case Given():
            which = "Component" if len(origins) == 1 else "Components"
            numbers = listed([str(o.index + 1) for o in origins if isinstance(o, Given)])
            verb = " has" if len(origins) == 1 else " have"
            return (f"{which} ", *numbers, f" of the task{verb} no other unknown. ")
        case OfPoint():
            which = "Coordinate" if len(origins) == 1 else "Coordinates"
            axes = listed(["xyz"[o.index] for o in origins if isinstance(o, OfPoint)])
            verb = " has" if len(origins) == 1 else " have"
            seen = _seen(origins[0].joint)
            return (f"{which} ", *axes, f" of the point{seen}{verb} no other unknown. ")
        case OfTurn():
            which = "Entry" if len(origins) == 1 else "Entries"
            places = listed([f"({o.row + 1}, {o.column + 1})" for o in origins if isinstance(o, OfTurn)])
            verb = " has" if len(origins) == 1 else " have"
            return (f"{which} ", *places, f" of the rotation{verb} no other unknown. ")
        case Squared():
            return ("Turning a vector does not change its length: in the sum of the squares the other angles "
                    "drop out, and one joint gives it its length (Paden-Kahan subproblem 3). ",)  # fmt: skip
        case Turned(_, _, name):
            return (
                "Turned back by ",
                Symbol(name),
                ", the components have that angle on the left side alone. ",
            )


def _seen(joint: int) -> str:
    """From where a point is seen that is not seen from where the arm begins."""
    return f", seen from the frame before joint {joint}," if joint else ""


def _form(step: Solved) -> Prose:
    """What kind of equation it is."""
    unknown = Symbol(step.coordinate)
    match step:
        case TwoLines() if step.is_rotation:
            return ("Two equations in the sine and the cosine of ", unknown, " give the angle: one joint "
                    "turns a vector to where it is to be (Paden-Kahan subproblem 1).")  # fmt: skip
        case TwoLines():
            return ("Two equations in the sine and the cosine of ", unknown, " give the angle.")
        case OneLine() if step.value.is_zero:
            return ("The ratio of sine and cosine gives ", unknown, " up to half a turn: two angles.")
        case OneLine() if step.sine.is_zero:
            return ("The cosine of ", unknown, " belongs to two angles, which differ by their sign.")
        case OneLine() if step.cosine.is_zero:
            return ("The sine of ", unknown, " belongs to two angles, whose sum is π.")
        case OneLine():
            return ("One equation in the cosine and the sine of ", unknown, " has two solutions.")
        case Length():
            return ("The length ", unknown, " stands in it to the first power.")
        case _:
            return ("The length ", unknown, " stands in it as a square: two lengths.")


# -- the general formulas --------------------------------------------------------------------------

_A, _B, _X, _Y = (Letter(letter, style="italic") for letter in "ABXY")
_ANGLE = Symbol("psi")
_COS, _SIN = Function("cos", _ANGLE), Function("sin", _ANGLE)


def _general(step: Solved) -> Node | None:
    """The form that an equation has, and its solution."""
    match step:
        case TwoLines() if step.is_rotation and not (step.first[0].is_zero or step.first[1].is_zero):
            turned = (
                equation(Sum((Product((_A, _COS)), Negative(Product((_B, _SIN))))), _X),
                equation(Sum((Product((_A, _SIN)), Product((_B, _COS)))), _Y),
            )
            difference = Sum((_atan2(_Y, _X), Negative(_atan2(_B, _A))))
            return _implies(side_by_side(turned), difference)
        case OneLine() if step.value.is_zero:
            both = side_by_side((_atan2(_A, _B), _atan2(Negative(_A), Negative(_B))))
            return _implies(equation(Product((_A, _COS)), Product((_B, _SIN))), both)
        case OneLine() if not (step.cosine.is_zero or step.sine.is_zero):
            square = [Power(letter, Number(2)) for letter in (_A, _B, _X)]
            root = Function("sqrt", Sum((square[0], square[1], negated(square[2]))))
            either = Relation((_atan2(_B, _A), _atan2(root, _X)), ("±",))
            return _implies(equation(Sum((Product((_A, _COS)), Product((_B, _SIN)))), _X), either)
    return None


def _atan2(y: Node, x: Node) -> Node:
    return Function("atan2", Arguments((y, x)))


def _implies(condition: Node, angle: Node) -> Node:
    """condition ⇒ ψ = angle"""
    return Relation((condition, equation(_ANGLE, angle)), ("⇒",))


# -- the way to an unknown of the inverse kinematics: components turned, squared and added, then sorted


@dataclass(frozen=True)
class InverseWay:
    """The lines to the equations of one step; `before` are the steps that were taken earlier."""

    formulas: InverseFormulas
    step: Solved
    before: tuple[Solved, ...]

    @property
    def working(self) -> tuple[Node, ...]:
        """The equations that it begins with: components of the task, or equations of earlier steps."""
        return tuple(map(self._equation, sorted(self._first, key=_component)))

    @property
    def lines(self) -> Iterator[Line]:
        """How the others are made of them, and how the unknown is taken out."""
        pairs: dict[tuple[Expr, Expr, str], dict[bool, Equation]] = {}
        for made in self._made:
            match made.origin:
                case Turned(first, second, name, is_second):
                    pairs.setdefault((first.expr, second.expr, name), {})[is_second] = made
        told: set[tuple[Expr, Expr, str]] = set()
        for made in self._made:
            match made.origin:
                case Turned(first, second, name):
                    key = first.expr, second.expr, name
                    if key not in told:
                        told.add(key)
                        yield self._turned((first, second), name, pairs[key])
                case Squared(parts):
                    squares = equation(
                        total([power(self._form(e.left), 2) for e in parts if not e.left.is_zero]),
                        total([power(self._form(e.right), 2) for e in parts]),
                    )
                    yield Line(("The squares of these equations, added:",), (squares,))
                    yield Line(("Multiplied out, with s² + c² = 1:",), (self._equation(made),))
        yield from self._sorted()

    # -- where the equations come from -------------------------------------------------------------

    @property
    def _shown(self) -> Mapping[Expr, None]:
        """What is 0 by an equation that an earlier step has shown."""
        return dict.fromkeys(e.expr for step in self.before for e in lineage(step.equations))

    @property
    def _needed(self) -> tuple[Equation, ...]:
        """The equations of this step with those that they come from, as far as they are new, each once."""
        return tuple({e.expr: e for e in self._new(self.step.equations)}.values())

    def _new(self, equations: tuple[Equation, ...]) -> Iterator[Equation]:
        for e in equations:
            if e.expr not in self._shown:
                match e.origin:
                    case Turned(first, second):
                        yield from self._new((first, second))
                    case Squared(parts):
                        yield from self._new(parts)
            yield e

    @property
    def starts_anew(self) -> bool:
        """Whether an equation that it starts from was in no earlier step."""
        return any(e.expr not in self._shown for e in self._first)

    @property
    def _first(self) -> tuple[Equation, ...]:
        return tuple(e for e in self._needed if self._is_first(e))

    @property
    def _made(self) -> tuple[Equation, ...]:
        return tuple(e for e in self._needed if not self._is_first(e))

    def _is_first(self, e: Equation) -> bool:
        return isinstance(e.origin, Direct) or e.expr in self._shown

    def _turned(self, pair: tuple[Equation, Equation], name: str, made: Mapping[bool, Equation]) -> Line:
        """Two components turned back by an angle, as the sums that a hand writes."""
        c, s = (Function(f, Symbol(name)) for f in ("cos", "sin"))
        one, other = (self._form(e.left) for e in pair)
        ways: dict[bool, Prose] = {
            False: (c, " times the equation of ", one, " plus ", s, " times that of ", other),
            True: (c, " times the equation of ", other, " minus ", s, " times that of ", one),
        }
        said = listed([ways[is_second] for is_second in sorted(made)])
        by: Prose = ("Turned back by ", Symbol(name), " (", *said, "):")
        return Line(by, tuple(self._equation(made[is_second]) for is_second in sorted(made)))

    # -- the unknown -------------------------------------------------------------------------------

    def _sorted(self) -> Iterator[Line]:
        """The equations as sums of the cosine and the sine of the unknown."""
        q = Symbol(self.step.coordinate)
        match self.step:
            case TwoLines(_, first, second):
                if max(map(len, (*first[:2], *second[:2]))) > 1:
                    by: Prose = ("Sorted by the cosine and the sine of ", q, ":")
                    yield Line(by, (self._line(*first), self._line(*second)))
            case OneLine(_, cosine, sine, value) if not value.is_zero:
                if cosine.is_zero or sine.is_zero:
                    name = "cos" if sine.is_zero else "sin"
                    solved = equation(Function(name, q), self.formulas.ratio(value, cosine + sine))
                    yield Line((f"Solved for the {'cosine' if sine.is_zero else 'sine'}:",), (solved,))
                else:
                    by = ("Sorted by the cosine and the sine of ", q, ":")
                    yield Line(by, (self._line(cosine, sine, value),))

    def _line(self, cosine: Expr, sine: Expr, value: Expr) -> Node:
        """A cos q + B sin q = X"""
        q = Symbol(self.step.coordinate)
        terms = [
            times(1, [(self._form(factor), 1), (Function(name, q), 1)])
            for factor, name in ((cosine, "cos"), (sine, "sin"))
            if not factor.is_zero
        ]
        return equation(total(terms), self._form(value))

    def _equation(self, e: Equation) -> Node:
        return equation(self._form(e.left), self._form(e.right))

    def _form(self, expr: Expr) -> Node:
        return self.formulas.form(expr)


def _component(e: Equation) -> float:
    """Components of the task in their order, what was made of them behind."""
    return e.origin.index if isinstance(e.origin, Given) else float("inf")
