"""When the unknowns of inverse kinematics have values, when they coincide, and when one is free."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from math import prod

from dynsolve.algebra.factors import is_never_zero, trig_factors
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.sampling import Transfer
from dynsolve.derivation.elimination import ParameterSigns
from dynsolve.derivation.singular.sets import Special, TooLong, common_zeros, existence
from dynsolve.derivation.singular.zeros import never_hold
from dynsolve.document import Prose
from dynsolve.document.sentences import say
from dynsolve.errors import AlgebraError
from dynsolve.explain.writing import listed
from dynsolve.notation.template import formula
from dynsolve.notation.tree import Node, Number, Relation, Symbol, equation
from dynsolve.questions.inverse.forms import InverseForms
from dynsolve.questions.inverse.solving import Part, Solving, Turn
from dynsolve.questions.inverse.subproblems import Length, OneLine, RootLength, Solved, TwoLines


class Existence:
    """Under which conditions the steps of a solving give values to their unknowns."""

    def __init__(self, forms: InverseForms, solving: Solving) -> None:
        self.forms = forms
        self.solving = solving

    def boundary(self, step: Solved) -> Node | None:
        """The condition under which an unknown has its values; None where it always has."""
        formulas = self.forms.inverse_formulas
        match step:
            case OneLine(_, cosine, sine, value) if value.is_zero:
                return None
            case OneLine(_, cosine, sine, value) if cosine.is_zero or sine.is_zero:
                return formula("-1 ≤ {ratio} ≤ 1", ratio=formulas.ratio(value, cosine + sine))
            case OneLine():
                return formulas.boundary(step)
            case RootLength() if not step.always_exists:
                return formula("{radicand} ≥ 0", radicand=formulas.radicand(step))
        return None

    def needed(self, step: Solved) -> Iterator[Node]:
        """That what is divided by is not 0, where it may be."""
        for divisor in _divisors(step):
            if not is_never_zero(divisor):
                yield formula("{divisor} ≠ 0", divisor=self.forms.vanishing(divisor))

    @property
    def all_needed(self) -> list[Node]:
        """What the steps of all parts need; a wrist's are told where it is singular."""
        parts = [part for part in self.solving.parts if not _is_of_wrist(part)]
        return [node for part in parts for step in part.solved for node in self.needed(step)]

    @cached_property
    def free(self) -> dict[str, list[Node]]:
        """Of each coordinate that is free somewhere the equations that hold there; without wrists."""
        free: dict[str, list[Node]] = {}
        divided: set[Expr] = set()
        for part in self.solving.parts:
            for step in part.solved:
                if not _is_of_wrist(part) and (zeros := self._where_free(step, divided)):
                    free[step.coordinate] = zeros
                divided |= {factor for value in _divisors(step) for factor, _ in trig_factors(value)}
        return free

    @property
    def is_free_somewhere(self) -> bool:
        """Whether there are tasks at which some coordinate is free."""
        return any(map(_is_of_wrist, self.solving.parts)) or bool(self.free)

    def notes(self, step: Solved, part: Part) -> Iterator[Prose]:
        """When there is a solution, and when there are infinitely many."""
        if part.turn is not None and part.turn.is_wrist:
            yield from self._of_wrist(part.turn, step)
            return
        if needed := [*self.needed(step)]:
            yield say("This needs {needed}.", needed=listed(needed))
        if (there := self.boundary(step)) is not None:
            text = "This equation has solutions where {there}; on the boundary, with =, the two are one."
            yield say(text, there=there)
        if zeros := self.free.get(step.coordinate):
            text = "Where {zeros}, {q} is free: infinitely many solutions."
            yield say(text, zeros=listed(zeros), q=Symbol(step.coordinate))

    def _of_wrist(self, turn: Turn, step: Solved) -> Iterator[Prose]:
        """Where a spherical wrist is singular; said with its first angle that has two values."""
        if not isinstance(step, OneLine):
            return
        first, middle, last = map(Symbol, turn.names)
        where = formula("sin {middle} = 0", middle=middle)
        if len(turn.made[2, 2]) != 1:  # else it is ± the cosine of the angle between the outer axes
            where = Relation((self.forms.inverse_formulas.form(turn.known[2, 2]), Number(1)), ("= ±",))
        text = (
            "Where {where} the first and the last axis of the wrist are one line: the wrist is singular. "
            "Only the sum of {first} and {last}, or their difference, is given then, and one of them is "
            "free: infinitely many solutions."
        )
        yield say(text, where=where, first=first, last=last)

    def _where_free(self, step: Solved, divided: set[Expr]) -> list[Node]:
        """The equations that hold where an unknown is free; `divided` are not 0, as earlier steps need it."""
        factors: list[Expr] = []
        match step:
            case OneLine(_, cosine, sine, value) if value.is_zero:
                factors = [sine, cosine]
            case OneLine(_, cosine, sine, value) if not (cosine.is_zero or sine.is_zero):
                factors = [sine, cosine, value]
            case OneLine(_, cosine, sine, value) if self._moves_nothing(step, cosine + sine):
                factors = [cosine + sine, value]
            case Length(_, factor, value) if self._moves_nothing(step, factor):
                factors = [factor, value]
            case TwoLines(_, (cosine, sine, _), _) if step.is_rotation:
                factors = [factor for factor in (cosine, sine) if not factor.is_zero]
        left = [
            prod((f for f, _ in trig_factors(one) if f not in divided), start=one.ring.one) for one in factors
        ]
        if not factors or never_hold(left) or not self._may_be_reached(left):
            return []
        return [equation(self.forms.vanishing(factor), Number(0)) for factor in left]

    def _may_be_reached(self, zeros: list[Expr]) -> bool:
        """Whether a task at which these are 0 may be that of a configuration: x = y = 0 is not, if e > l."""
        solving = self.solving
        ring = solving.ring
        try:
            values = zip(
                solving.values, map(Transfer(solving.task.ring, ring), solving.task.entries), strict=True
            )
            images = {ring.symbol_indices[name, 0]: value.poly for name, value in values}
            special = Special(ParameterSigns())
            found = common_zeros([ring.put(one, images) for one in zeros], special)
        except (TooLong, AlgebraError):  # the ring has not every angle
            return True
        return not special.is_empty or any(existence(one) is not None for one in found)

    def _moves_nothing(self, step: Solved, divisor: Expr) -> bool:
        """Whether a coordinate does not move the task where what it is divided by is 0."""
        ring = divisor.ring
        place = ring.names.index(step.coordinate)
        slopes = [ring.diff(one.right, place) for one in self.solving.components]
        return not is_never_zero(divisor) and all(slope.quotient(divisor) is not None for slope in slopes)


def _is_of_wrist(part: Part) -> bool:
    return part.turn is not None and part.turn.is_wrist


def _divisors(step: Solved) -> Iterator[Expr]:
    """What a step divides by."""
    match step:
        case OneLine(_, cosine, sine, value) if not value.is_zero and (cosine.is_zero or sine.is_zero):
            yield cosine + sine
        case TwoLines() if not step.is_rotation:
            yield step.determinant
        case Length(_, divisor) | RootLength(_, divisor):
            yield divisor
