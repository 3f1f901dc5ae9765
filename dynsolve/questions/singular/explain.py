"""Steps of the singular configurations: what vanishes, taken apart, and each alternative."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import comb, prod

from msgspec.structs import replace

from dynsolve.algebra.factors import is_never_zero, trig_factors
from dynsolve.algebra.matrix import Place
from dynsolve.derivation.elimination import ParameterSigns
from dynsolve.derivation.existence import is_seen
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.singular.losses import Loss
from dynsolve.derivation.singular.sets import SingularSet
from dynsolve.document import Prose
from dynsolve.document.books import spong
from dynsolve.document.figures import ArmArrow, ArmFigure
from dynsolve.document.sentences import Value, opened, paragraph, say
from dynsolve.explain.context import Context
from dynsolve.explain.step import NOTED, TOLD, Detail, Group, Part, Step, not_derived
from dynsolve.explain.working.identities import SILENT
from dynsolve.explain.writing import agreeing, and_joined, listed, turns
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    ZERO,
    Degrees,
    Matrix,
    Node,
    Reference,
    Row,
    Symbol,
    Transpose,
    Words,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.questions.rates.explain import loads_along
from dynsolve.questions.set_forms import vanishing
from dynsolve.questions.singular.forms import SingularForms
from dynsolve.questions.task.explain import determinant_way, zero_lines
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import TIP

_LOST = spong("4.10")

_TITLE = "The singular configurations"
_SETS = Group("singular", _TITLE)


def steps(context: Context) -> Iterator[Step]:
    """The minors of the Jacobian as products, and where all of them are 0."""
    if "singular" not in context.wanted:
        return
    forms = SingularForms(context.robot, context.values)
    found = context.values["singular"]
    if isinstance(found, Skipped):
        at_values = "At given values of q the rank of the Jacobian shows whether the arm is singular"
        yield not_derived("singular", _TITLE, f"{found.why}. {at_values}")
        return
    yield replace(_rank(context, forms, found), group=_SETS)
    yield replace(_alternatives(forms, found, _letter(context)), group=_SETS, normal=NOTED)
    lost = Group("singular_lost", "What is lost") if all(forms.lost_here) else None
    for case in range(len(found.losses)):
        step = replace(_loss(context, forms, found, case), group=lost)
        yield replace(step, normal=step.normal & ~Part.FORMULA) if lost and case else step


def _rank(context: Context, forms: SingularForms, found: SingularSet) -> Step:
    """The minors of J, or of what is left of it where rows and columns are cleared, as products."""
    name, J, size = _matrix(context), _letter(context), found.rank - found.pivots
    rows, columns = context.values[name].shape
    distinct = [k for k, m in enumerate(found.minors) if not {m, -m} & {*found.minors[:k]}]
    minors = [forms.product(found.minors[k]) for k in distinct]
    of = context.values[name] if found.core is None else found.core
    left_out: Prose = ()
    if size > 1 and len(minors) < prod(comb(count, size) for count in of.shape):
        these = "this" if len(minors) == 1 else "these"
        left_out = (f"All others are 0, or differ from {these} in sign alone:",)
    names = [_of_part(found.places[k], of.shape) for k in distinct]
    results: tuple[Node, ...] = tuple(
        equation(name, minor) for name, minor in zip(names, minors, strict=True)
    )
    working: tuple[Node, ...] = ()
    way, is_told = SILENT, False
    still = zero_lines(context.values[name]) if found.rank < min(rows, columns) else ""
    text = f"${{J}}$ is {{rows}}×{{columns}}, and its rank is at most {{rank}}{f'; {still}' * bool(still)}. "
    if found.core is not None:
        text += (
            "Its rows may be turned among each other, as by other axes, and multiples of rows and columns "
            "added to others: that leaves the rank as it is. Where an entry is never 0, its row and column "
            "can so be cleared and count 1. "
        )
        if size:
            text += "The rank of ${J}$ is {more} that of what is left. It is less where {of_all}"
            working = (forms.matrix(found.core),)
        else:
            cleared = "One row and one column" if found.pivots == 1 else "{pivots} rows and columns"
            is_all = found.pivots == min(rows, columns)
            text += f"{cleared} are cleared so, and {'no other is' if is_all else 'only zeros are'} left."
    elif rows == columns == found.rank:
        text = "${J}$ is square: it has an inverse unless its determinant is 0."
        results = (formula("det {J} = {minor}", J=J, minor=minors[0]),)
        is_told = "det" in context.wanted
        if not is_told:
            way = determinant_way(context, formula("det {J}", J=J), context.values[name], minors[0])
    else:
        text += "It is less where {of_all}"
    return Step(
        id="singular_minors",
        title="What must vanish",
        why=say(
            text,
            J=J,
            rows=rows,
            columns=columns,
            rank=found.rank,
            pivots=found.pivots,
            more=f"{found.pivots} more than" if found.pivots else "as great as",
            of_all=f"the determinants of all its parts of {size} rows and columns are 0."
            if size > 1
            else "all its entries are 0.",
        ),
        source=spong("4.9"),
        working=working,
        lines=way.lines,
        concluding=way.concluding or left_out,
        result=results,
        listed=len(results) > 1,
        normal=TOLD & ~Part.RESULT if is_told else TOLD,
        uses=(name,),
    )


def _of_part(place: Place, shape: tuple[int, int]) -> Node:
    """`minor (columns 1, 2)`: with the rows where these are not all."""
    told = [
        f"{what}{'s' * (len(chosen) > 1)} {', '.join(str(k + 1) for k in chosen)}"
        for what, chosen, count in zip(("row", "column"), place, shape, strict=True)
        if len(chosen) < count
    ]
    return Words(f"minor ({', '.join(told)})" if told else "determinant")


def _alternatives(forms: SingularForms, found: SingularSet, J: Node) -> Step:
    cases, special = forms.singular, tuple(_of_special(forms, found))
    none = ""
    if found.rank > found.pivots:
        never = (
            "the minors are never all 0 at once"
            if len(found.minors) > 1
            else "no factor of the minor becomes 0"
        )
        none = f", as {never}"
    why = say("The rank of ${J}$ is {rank} in every configuration{none}.", J=J, rank=found.rank, none=none)
    step = Step(
        id="singular",
        title="No singular configuration",
        why=why,
        detail=Detail.BRIEF,
        notes=special,
        outcome=paragraph((why, *special)),
        hint=("A product is 0 where one of its factors is. Constant lengths are not 0.",),
        hint_title=_TITLE,
    )
    if not cases:
        return step
    seen = [is_seen([each.expr for each in case], ParameterSigns()) for case in found.alternatives]
    exist = tuple(forms.existence("singular", found.exist, seen))
    return replace(
        step,
        title=_TITLE,
        why=_of_factors(found),
        result=tuple(map(vanishing, cases)),
        notes=(*exist, *special),
        outcome=paragraph(exist),
        uses=("singular_minors",),
    )


def _of_factors(found: SingularSet) -> Prose:
    """How the cases come from the minors: by the factors of those that are products."""
    factors = [[factor for factor, times in trig_factors(m) for _ in range(times)] for m in found.minors]
    fixed = (f for of_minor in factors for f in of_minor if not f.ring.depends_on_coordinates(f))
    lengths = " Constant lengths are not 0" if any(map(is_never_zero, fixed)) else ""
    at_once = ", and all the minors have to be 0 at once" if len(found.minors) > 1 else ""
    if all(len(of_minor) < 2 for of_minor in factors):
        return ("All the minors have to be 0 at once.",) if at_once else ()
    product = "A product is 0 where one of its factors is"
    if len(found.alternatives) > 1:
        return (f"{product}; each of these cases is enough.", f"{lengths}." if lengths else "")
    return (f"{product}{at_once}.", f"{lengths}, so one case is left." if lengths else "")


def _of_special(forms: SingularForms, found: SingularSet) -> Iterator[Prose]:
    """For which parameters these are all."""
    if found.special:
        where = listed([forms.comparison(factor, "≠") for factor in found.special])
        yield say("This is so where {where}; for other parameters there may be more.", where=where)
    if found.may_be_others:
        yield ("For special values of the parameters there may be others.",)


def _loss(context: Context, forms: SingularForms, found: SingularSet, case: int) -> Step:
    """The rank at one of the alternatives, the matrix there, and what is lost."""
    loss, lost, J = found.losses[case], forms.lost_here[case], _letter(context)
    several = [formula("𝐰_{k}", k=k) for k in range(1, len(lost) + 1)]
    names = [formula("𝐰")] if len(lost) == 1 else several
    told: Prose = ()
    if lost and not any(forms.lost_here[:case]):
        loads = loads_along(context, _matrix(context), loss.here)
        told = say(
            " Every velocity that the joints can give is orthogonal to {w}{lost}. {Loads} along "
            "{it} no {effort} of the joints.{everywhere}",
            w=listed(names),
            lost=_lost(loss),
            Loads=opened(and_joined(loads)),
            it=f"{'it' if len(names) == 1 else 'them'} {'needs' if len(loads) == 1 else 'need'}",
            effort=_effort(context.robot),
            everywhere=_elsewhere(loss),
        )
    if not loss.are_independent:
        told += say(
            " In general {w} are independent." if len(names) > 1 else " Where {w} is 0 it tells nothing.",
            w=listed(names),
        )
    exact = all(condition.keeps_values for condition in found.alternatives[case])
    what = "What is lost" if lost else "The rank"
    return Step(
        id=f"singular_{case + 1}",
        title=f"{what} in case {case + 1}" if len(found.losses) > 1 else f"{what} there",
        why=say(
            "Where {these}, the rank is {general}{rank} instead of {most}.{lesser}{told}",
            these=vanishing(forms.singular[case]),
            general="" if loss.rank_holds else "in general ",
            rank=loss.rank,
            lesser=tuple(_lesser(loss)),
            most=found.rank,
            told=told,
        ),
        formula=_in_general(context) if lost else None,
        source=_LOST if lost else "",
        working=(equation(J, forms.matrix(loss.jacobian)),) if lost and exact else (),
        result=tuple(equation(name, value) for name, value in zip(names, lost, strict=True)),
        figure=_figure(context.robot, _matrix(context), forms.singular[case], names, lost),
        uses=(_matrix(context), f"singular#{case + 1}"),
        hint=(
            "In each case: how great is the rank, and which w is orthogonal to every velocity that the "
            "joints can give?",
        ),
        hint_title="What is lost there",
        task=_in_general(context),
        is_task=case == 0,
    )


def _lesser(loss: Loss) -> Iterator[str | Node]:
    """The ranks of parts of the set."""
    for name, degrees, rank in loss.lesser:
        yield from (" Where ", equation(Symbol(name), Degrees(degrees)), f", the rank is {rank}.")


def _lost(loss: Loss) -> str:
    """That these motions are lost, where they are possible elsewhere."""
    if loss.everywhere < loss.impossible:
        return ""
    return agreeing(": that|these motion|motions is|are lost", len(loss.here))


def _elsewhere(loss: Loss) -> str:
    """That some motions of the task are impossible anyhow, which are not said to be lost there."""
    if not loss.impossible:
        return ""
    lesser = loss.everywhere < loss.impossible
    motions = f"{'more ' * (not lesser)}motion|motions is|are impossible in every configuration"
    here = f", here {len(loss.directions)}" * lesser
    count = "One" if loss.impossible == 1 else loss.impossible
    return f" {count} {agreeing(motions, loss.impossible)}{here}."


def _effort(robot: Robot) -> str:
    """What the joints exert: torques where they turn, forces where they slide."""
    turning = [turns(q) for q in robot.coordinates]
    return "torque" if all(turning) else "torque or force" if any(turning) else "force"


def _in_general(context: Context) -> Node:
    J, w = _letter(context), letters.bold("w")
    still, unloaded = Row((Transpose(w), J)), Row((Transpose(J), w))
    return formula("{still} = 𝟎 ⇒ 𝛕 = {unloaded} = 𝟎", still=still, unloaded=unloaded)


def _letter(context: Context) -> Node:
    """J of the whole arm, or of the task."""
    return letters.J if _matrix(context) == "J" else letters.J_TASK


def _matrix(context: Context) -> str:
    return context.values.rules["singular"].inputs[0]


# -- the arm there, and the directions that are lost at its tip -------------------------------------

MOST_ARROWS = 3


def _figure(
    robot: Robot, matrix: str, zeros: Sequence[Node], names: Sequence[Node], lost: Sequence[Matrix]
) -> ArmFigure | None:
    """The arm where the conditions hold; None without links, or where no motion of the tip is lost.

    `matrix` is the Jacobian that loses rank, `lost` the columns w with wᵀ J = 0; a row of it is a velocity of
    the tip along one of the `axes` of the world, or something else.
    """
    if not robot.has_table:
        return None
    task = robot.questions.task
    axes: tuple[int | None, ...] = (0, 1, 2, None, None, None)
    if matrix != "J" and task is not None and not task.is_twist:
        entries = [e if isinstance(e, Reference) and e.quantity == TIP else None for e in task.entries]
        axes = tuple(entry.row - 1 if entry and entry.row is not None else None for entry in entries)
    motions = [(name, _motion(w, axes)) for name, w in zip(names, lost, strict=True)]
    arrows = tuple(ArmArrow(name, direction) for name, direction in motions if direction is not None)
    if not arrows or len(arrows) > MOST_ARROWS:
        return None
    those = agreeing("the arrow|arrows", len(arrows))
    return ArmFigure(f"The arm in this case: its tip cannot move along {those}.", tuple(zeros), arrows)


def _motion(w: Matrix, axes: Sequence[int | None]) -> tuple[Node, Node, Node] | None:
    """A lost direction as a motion of the tip; None where something else takes part in it."""
    found: list[Node] = [ZERO, ZERO, ZERO]
    for (component,), axis in zip(w.rows, axes, strict=True):
        if axis is not None:
            found[axis] = component
        elif component != ZERO:
            return None
    return (found[0], found[1], found[2]) if any(part != ZERO for part in found) else None


# -- hints -----------------------------------------------------------------------------------------

AT_HAND = "You have the Jacobian of the task:"

PITFALLS = """
    Write the determinant as a product before you look for its zeros: each factor is a case.
    default? The first joint moves the whole arm and changes no rank: it appears in no condition.
"""


def inputs(context: Context) -> list[tuple[Node, str]]:
    """The results that it starts from, by letter and name."""
    return [(letters.J_TASK, "Jr")]


def facts(robot: Robot) -> dict[str, Value]:
    """What its pitfalls are about."""
    return {"default": robot.questions.task is None or robot.questions.task.is_default}
