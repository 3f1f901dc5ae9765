"""Steps of the inverse kinematics at numbers: each configuration that reaches them, or why there is none."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import groupby
from math import degrees

from dynsolve.algebra.rationals import rational_value
from dynsolve.document import Prose, Table
from dynsolve.explain.branch_values import decimal
from dynsolve.explain.step import NOTED, Detail, Group, Step
from dynsolve.explain.target import Configuration, Lost, TargetForms
from dynsolve.explain.writing import listed
from dynsolve.notation.build import cost
from dynsolve.notation.tree import Degrees, Function, Negative, Node, Number, Relation, Symbol, equation
from dynsolve.notation.walk import names_in, walk
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage

_DIGITS = 4
_LIMITS = "Limits"

LONGEST = 60
"""A formula with more operations is no help to a reader; its value stands alone."""

_TITLE = "The configurations that reach it"
_HINT = (
    "Put the numbers into every branch. Look at the arguments of roots, of arccos and arcsin: is the branch "
    "real, is it one with another? And at atan2: are both its arguments 0?",
)
"""What a hint says of them, however many there are."""

_REAL = {
    "acos": "no angle has a cosine beyond -1 and 1",
    "asin": "no angle has a sine beyond -1 and 1",
    "sqrt": "a negative number has no real root",
}


def target_steps(forms: TargetForms) -> Iterator[Step]:
    """A step for each configuration, and the table of all."""
    whole = _all(forms)
    group = Group("inverse", whole.title)
    for number, one in enumerate(forms.configurations, 1):
        yield replace(_configuration(forms, one, number), group=group, normal=NOTED)
    yield replace(whole, group=group, normal=NOTED)


def given_numbers(forms: TargetForms) -> tuple[Node, ...]:
    """What the values of the task are."""
    return tuple(equation(Symbol(name), value) for name, value in forms.given)


# -- one configuration -----------------------------------------------------------------------------


def _configuration(forms: TargetForms, one: Configuration, number: int) -> Step:
    return Step(
        id=f"inverse_{number}",
        stage=Stage.INVERSE,
        title=f"Configuration {number}",
        why=_where_from(one),
        result=tuple(_value(forms, one, name) for name in one.formulas),
        notes=tuple(_remarks(one)),
        listed=True,
        uses=("inverse_branches",) if one.branches else (),
        is_task=False,
    )


def _where_from(one: Configuration) -> Prose:
    match one.branches:
        case ():
            return ("Found in numbers, and put into ", letters.TASK_OF_Q, ".")
        case (branch,):
            return (f"Branch {branch} with these numbers.",)
    numbers = listed([str(branch) for branch in one.branches])
    return ("Branches ", *numbers, " with these numbers: they are one, for the target is on their boundary.")


def _value(forms: TargetForms, one: Configuration, name: str) -> Node:
    """q = its formula ≈ its value"""
    formula, value = one.formulas[name], one.numbers[name]
    if rational_value(formula) == 0 or _depends(one, name):
        return equation(Symbol(name), formula)
    if cost(formula) > LONGEST:
        formula = decimal(value)
    shown = [node for node in (formula, decimal(value, _DIGITS)) if not _is_decimal(node) or node != formula]
    if rational_value(formula) is not None:
        shown = [decimal(value, _DIGITS)] if _is_decimal(formula) else [formula]
    if _turns(forms, name):
        if names_in(formula) <= {"pi"} and not _has_function(formula) and not _is_decimal(formula):
            return Relation((Symbol(name), formula, _in_degrees(value)), ("=", "="))
        shown.append(_in_degrees(value))
    return Relation((Symbol(name), *shown), ("≈" if _is_decimal(formula) else "=", *["≈"] * (len(shown) - 1)))


def _depends(one: Configuration, name: str) -> bool:
    """Whether a coordinate is given by one that is free."""
    return name in one.formulas and bool(names_in(one.formulas[name]) & set(one.free))


def _has_function(node: Node) -> bool:
    return any(isinstance(part, Function) for part in walk(node))


def _is_decimal(node: Node) -> bool:
    inner = node.argument if isinstance(node, Negative) else node
    return isinstance(inner, Number) and inner.decimal


def _turns(forms: TargetForms, name: str) -> bool:
    return dict(forms.robot.ring.coordinates)[name] == "revolute"


def _in_degrees(value: float) -> Node:
    hundredths = Fraction(round(abs(degrees(value)) * 100), 100)
    size = Degrees(hundredths.numerator, hundredths.denominator)
    return Negative(size) if value < 0 and hundredths else size


def _remarks(one: Configuration) -> Iterator[Prose]:
    if one.free:
        verb = " is" if len(one.free) == 1 else " are"
        names = listed([Symbol(name) for name in one.free])
        yield (*names, verb, " free here: infinitely many solutions.")
    if one.outside:
        verb = " is" if len(one.outside) == 1 else " are"
        yield (*listed([Symbol(name) for name in one.outside]), verb, " beyond the limits.")


# -- all of them -----------------------------------------------------------------------------------


def _all(forms: TargetForms) -> Step:
    found = forms.configurations
    if not found:
        return _none(forms)
    one = len(found) == 1
    return Step(
        id="inverse",
        stage=Stage.INVERSE,
        title="The configuration that reaches it"
        if one
        else f"The {len(found)} configurations that reach it",
        why=told(forms),
        table=_table(forms),
        notes=tuple(_lost(forms)),
        detail=Detail.BRIEF,
        uses=tuple(f"inverse_{number}" for number in range(1, len(found) + 1)),
        hint=_HINT,
        hint_title=_TITLE,
    )


def told(forms: TargetForms) -> Prose:
    """How the configurations were found, and how they are known to be right."""
    if forms.is_searched:
        return (
            "Newton's method from 200 configurations led to these, each put into ",
            letters.TASK_OF_Q,
            " to ten digits. That there are no others is not proved.",
        )
    return ("Each is put into ", letters.TASK_OF_Q, " to see that it gives the task.")


def _table(forms: TargetForms) -> Table:
    names = [q.name for q in forms.robot.coordinates]
    limited = bool(forms.robot.questions.limits)
    head = ("", *map(Symbol, names), *((_LIMITS,) if limited else ()))
    rows = []
    for number, one in enumerate(forms.configurations, 1):
        cells = [_cell(forms, one, name) for name in names]
        mark = ("beyond" if one.outside else "within",) if limited else ()
        rows.append((str(number), *cells, *mark))
    return Table(head, tuple(rows))


def _cell(forms: TargetForms, one: Configuration, name: str) -> Node | str:
    if name in one.free:
        return "free"
    if _depends(one, name):
        return one.formulas[name]
    value = one.numbers[name]
    return _in_degrees(value) if _turns(forms, name) else decimal(value, _DIGITS)


def _none(forms: TargetForms) -> Step:
    return Step(
        id="inverse",
        stage=Stage.INVERSE,
        title="Infinitely many configurations" if forms.is_family else "Out of reach",
        why=reason(forms),
        notes=tuple(_lost(forms)),
        detail=Detail.BRIEF,
        uses=(),
        hint=_HINT,
        hint_title=_TITLE,
    )


def reason(forms: TargetForms) -> Prose:
    """Why there is no configuration, or none that stands alone; nothing where there are some."""
    if forms.configurations:
        return ()
    if forms.is_family:
        return ("The configurations that reach this do not stand alone: there are infinitely many.",)
    if forms.unmet:
        return ("No configuration reaches this: no joint gives ", letters.TASK_OF_Q, " these values.")
    if forms.lost:
        return ("No configuration reaches this: no branch is real.",)
    return ("No configuration that reaches this was found: Newton's method from 200 of them led to none.",)


def _lost(forms: TargetForms) -> Iterator[Prose]:
    """Why branches are not real or no solutions, those with one reason together."""
    for condition, unmet in groupby(forms.unmet, key=lambda one: one.condition):
        numbers = listed([str(one.branch) for one in unmet])
        which = "Branch " if len(numbers) == 1 else "Branches "
        needs = " needs " if len(numbers) == 1 else " need "
        yield which, *numbers, needs, equation(*condition.sides), ", which does not hold here."

    def why(lost: Lost) -> tuple[str, str, str]:
        return lost.coordinate, lost.function, repr(lost.argument)

    for _, together in groupby(sorted(forms.lost, key=why), key=why):
        lost = list(together)
        numbers = listed([str(one.branch) for one in lost])
        one = lost[0]
        yield (
            "Branch " if len(lost) == 1 else "Branches ", *numbers,
            f" {'is' if len(lost) == 1 else 'are'} not real: ", Symbol(one.coordinate), " needs ",
            Function(one.function, one.argument), f", and {_REAL[one.function]}.",
        )  # fmt: skip
