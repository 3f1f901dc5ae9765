"""Steps of τ = Y a: the combinations of parameters that count, and what stands beside each of them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from dynsolve.algebra.fraction import RationalExpr
from dynsolve.algebra.fraction_matrix import FractionMatrix
from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.energy import accelerations
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.regressor import combinations, known_names
from dynsolve.document import Prose
from dynsolve.explain.citations import SLOTINE_LI, spong
from dynsolve.explain.context import Context
from dynsolve.explain.step import NOTED, Detail, Group, Line, Step
from dynsolve.explain.writing import listed
from dynsolve.notation.build import times, total
from dynsolve.notation.tree import Entry, Letter, Node, Number, Product, Row, Sum, Symbol, Words, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage

STAGE = Stage.PARAMETERS
_SOURCE = spong("7.5.3")

MOST_SHOWN = 24
"""With more coefficients only the parameters are shown."""


@dataclass(frozen=True, slots=True)
class _Linear:
    """Forces that are linear in parameters: the names of both factors, and how the forces are called."""

    Y: str
    a: str
    forces: Node
    Y_letter: Letter
    a_letter: Letter


_ALL = (
    _Linear("Y", "a", letters.TAU, letters.REGRESSOR, letters.PARAMETERS),
    _Linear(
        "YM", "aM", Product((letters.D, letters.QDD)), letters.of_part("Y", "M"), letters.of_part("a", "M")
    ),
    _Linear("Yg", "ag", letters.G, letters.of_part("Y", "g"), letters.of_part("a", "g")),
)


def steps(context: Context) -> Iterator[Step]:
    """The parameters and the regressor of the forces, and of a part of them where that is asked for."""
    wanted = context.wanted
    for linear in _ALL:
        if {linear.a, linear.Y} & wanted and _forces(context, linear).is_zero:
            why: Prose = (linear.forces, " is 0 in every state, so that there are no parameters in it.")
            yield Step(linear.a, STAGE, _title(linear), why, detail=Detail.BRIEF)
            continue
        formula = equation(linear.forces, Product((linear.Y_letter, linear.a_letter)))
        group = Group(linear.a, f"{_title(linear)} and the regressor", (), formula, _SOURCE)
        if linear.a in wanted:
            yield replace(_parameters(context, linear), group=group, normal=NOTED)
        if linear.Y in wanted:
            yield replace(_regressor(context, linear), group=group)
    if "Yr" in wanted and not context.values["tau"].is_zero:
        yield _with_references(context)


def _forces(context: Context, linear: _Linear) -> Matrix:
    """The forces that are linear in the parameters."""
    values = context.values
    found: Matrix = {"Y": lambda: values["tau"], "Yg": lambda: values["g"]}.get(
        linear.Y, lambda: values["D"] @ accelerations(context.robot)
    )()
    return found


# -- the parameters --------------------------------------------------------------------------------


def _parameters(context: Context, linear: _Linear) -> Step:
    asked = context.robot.questions.model
    value = context.values[linear.a]
    is_given = linear.a == "a" and asked.parameters is not None
    if isinstance(value, Skipped):
        return Step(linear.a, STAGE, "Not derived", (value.why.capitalize() + ".",), detail=Detail.BRIEF)
    why: Prose = (
        "Multiplied out, ", linear.forces, " is a sum of products: what moves (coordinates, rates, "
        "accelerations, sines and cosines) times a coefficient of parameters. ", *_known(context),
    )  # fmt: skip
    if is_given:
        why = (*why, "The problem gives the entries of ", linear.a_letter, ".")
    return Step(
        id=linear.a,
        stage=STAGE,
        title=_title(linear),
        why=why,
        formula=equation(linear.forces, Product((linear.Y_letter, linear.a_letter))),
        source=_SOURCE,
        lines=() if is_given else tuple(_lines(context, linear, value)),
        result=(equation(linear.a_letter, context.form(linear.a)),),
        notes=() if is_given else ((_minimal(len(value.rows)),),),
        detail=Detail.BRIEF,
    )


def _title(linear: _Linear) -> str:
    return {"a": "The parameters", "aM": "The parameters of the inertia matrix"}.get(
        linear.a, "The parameters of gravity"
    )


def _known(context: Context) -> Prose:
    known = sorted(known_names(context.robot))
    if not known:
        return ()
    return (*listed([Symbol(name) for name in known]), f" count{'s' * (len(known) == 1)} as known. ")


def _minimal(count: int) -> str:
    entries = "one entry" if count == 1 else f"{count} entries"
    return f"Fewer than {entries} are not enough: that is the rank of the forces over motions and parameters."


def _lines(context: Context, linear: _Linear, parameters: Matrix) -> Iterator[Line]:
    """The coefficients, and those that others give; none where there are too many to be read."""
    found = combinations(context.robot, _forces(context, linear), parameters)
    if not 0 < len(found) <= MOST_SHOWN:
        return
    by: Prose = (
        "The coefficients that occur, without numbers and known factors that all terms of one share:",
    )
    yield Line(by, tuple(context.show(coefficient) for coefficient, _ in found))
    names = [Entry(linear.a_letter, Number(k)) for k in range(1, len(parameters.rows) + 1)]
    dependent = [
        equation(context.show(coefficient), _sum(context, names, factors))
        for coefficient, factors in found
        if coefficient not in parameters.entries
    ]
    if dependent:
        yield Line(
            ("Some are combinations of the entries that are chosen below, and need none of their own:",),
            tuple(dependent),
        )


def _sum(context: Context, names: Sequence[Node], factors: tuple[RationalExpr, ...]) -> Node:
    """Σ y_k (a)_k"""
    terms = []
    for name, factor in zip(names, factors, strict=True):
        if not factor.is_zero:
            (row,) = _shown(context, factor)
            terms.append(times(1, [(row, 1), (name, 1)]))
    return total(terms)


def _shown(context: Context, factor: RationalExpr) -> tuple[Node]:
    form = context.forms.of(FractionMatrix(factor.ring, ((factor,),)))
    ((node,),) = form.rows  # type: ignore[attr-defined]
    return (node,)


# -- the regressor ---------------------------------------------------------------------------------


def _regressor(context: Context, linear: _Linear) -> Step:
    value = context.values[linear.Y]
    if isinstance(value, Skipped):
        return Step(linear.Y, STAGE, "Not derived", (value.why.capitalize() + ".",), detail=Detail.BRIEF)
    why: Prose = (
        "Each force has a row. Column k holds what stands in it beside entry k of ", linear.a_letter, ".",
    )  # fmt: skip
    return Step(
        id=linear.Y,
        stage=STAGE,
        title={"Y": "The regressor", "YM": "The regressor of the inertia matrix"}.get(
            linear.Y, "The regressor of gravity"
        ),
        why=why,
        formula=equation(linear.forces, Product((linear.Y_letter, linear.a_letter))),
        source=_SOURCE,
        result=(equation(linear.Y_letter, context.form(linear.Y)),),
        detail=Detail.BRIEF,
    )


def _with_references(context: Context) -> Step:
    value = context.values["Yr"]
    if isinstance(value, Skipped):
        return Step("Yr", STAGE, "Not derived", (value.why.capitalize() + ".",), detail=Detail.BRIEF)
    rates, accelerations = (letters.bold("q", Symbol("r"), dots=dots) for dots in (1, 2))
    Y = letters.of_part("Y", "r")
    return Step(
        id="Yr",
        stage=STAGE,
        title="The regressor with reference rates",
        why=("Adaptive control puts reference rates ", rates, " and accelerations ", accelerations,
             " in the place of the arm's own where these are multiplied by ", letters.D, " and ", letters.C,
             "; the rates inside ", letters.C, " stay. The parameters are the same."),
        formula=equation(
            Sum((Product((letters.D, accelerations)), Product((letters.C, rates)), letters.G)),
            Product((Y, letters.PARAMETERS)),
        ),
        source=SLOTINE_LI.section("9.2"),
        result=(equation(Y, context.form("Yr")),),
        notes=(("Here the choice of ", letters.C, " counts: with that of Christoffel ",
                Row((letters.rate(letters.D), Words(" - 2"), letters.C)), " is skew-symmetric."),),
        detail=Detail.BRIEF,
    )  # fmt: skip
