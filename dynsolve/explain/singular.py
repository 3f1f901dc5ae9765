"""Steps of the singular configurations: what vanishes, taken apart, and each alternative."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from dynsolve.derivation.singular.sets import SingularSet
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.inverse_figures import singular_figure_of
from dynsolve.explain.inverse_formulas import ConfigurationForms, vanishing
from dynsolve.explain.step import NOTED, TOLD, Detail, Group, Part, Step
from dynsolve.explain.writing import listed, spong
from dynsolve.notation import tree
from dynsolve.notation.tree import Letter, Node, Number, Relation, Row, Transpose, Words, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage

STAGE = Stage.SINGULAR
_SOURCE = spong("4.9")
_LOST = spong("4.10")

_TITLE = "The singular configurations"
_SETS = Group("singular", _TITLE)
_W = letters.bold("w")
_CASES = ("A product is 0 where one of its factors is. Constant lengths are not 0.",)
"""What a hint says of them, however many there are."""
_SIMPLER = (
    "Its rows may be turned among each other, as by other axes, and multiples of rows and columns added to "
    "others: that leaves the rank as it is. Where an entry is never 0, its row and column can so be cleared "
    "and count 1. "
)


def steps(context: Context) -> Iterator[Step]:
    """The minors of the Jacobian as products, and where all of them are 0."""
    if "singular" not in context.wanted:
        return
    forms = ConfigurationForms(context.robot, context.values)
    found = forms.singular_set
    if found is None:
        yield _skipped()
        return
    yield replace(_rank(context, forms, found), group=_SETS)
    yield replace(_alternatives(forms, found), group=_SETS, normal=NOTED)
    lost = Group("singular_lost", "What is lost", (), _in_general(context), _LOST)
    for case in range(len(found.losses)):
        yield replace(_loss(context, forms, found, case), group=lost if all(forms.lost) else None)


def _skipped() -> Step:
    return Step(
        id="singular",
        stage=STAGE,
        title="Not derived",
        why=("The Jacobian and its minors are too long to be taken apart into factors. "
             "At given values of q its rank shows whether the arm is singular.",),
        detail=Detail.BRIEF,
        uses=(),
    )  # fmt: skip


def _rank(context: Context, forms: ConfigurationForms, found: SingularSet) -> Step:
    rows, columns = context.values[_matrix(context)].shape
    J, size = _letter(context), found.rank - found.pivots
    of_all = f"the determinants of all its parts of {size} rows and columns are 0."
    results = tuple(
        equation(Row((Words("minor "), Number(k))), forms.product(m)) for k, m in enumerate(found.minors, 1)
    )
    working: tuple[Node, ...] = ()
    if found.core is not None:
        why: Prose = (J, f" is {rows}×{columns}, and its rank is {found.rank} almost everywhere. {_SIMPLER}")
        if size:
            more = f"{found.pivots} more than" if found.pivots else "as great as"
            why += ("The rank of ", J, f" is {more} that of this matrix. It is less where {of_all}")
            form = forms.compactor(found.core.ring).form
            working = (tree.Matrix(tuple(tuple(map(form, row)) for row in found.core.rows)),)
        else:
            why += (f"{found.pivots} rows and columns are cleared so, and only zeros, or nothing, are left.",)
    elif rows == columns == found.rank:
        why = (J, " is square: it has an inverse unless its determinant is 0.")
        results = (equation(_det(J), forms.product(found.minors[0])),)
    else:
        why = (J, f" is {rows}×{columns}, and its rank is {found.rank} almost everywhere. It is less where "
               f"{of_all}")  # fmt: skip
    return Step(
        id="singular_minors",
        stage=STAGE,
        title="What must vanish",
        why=why,
        source=_SOURCE,
        working=working,
        result=results,
        listed=len(results) > 1,
        normal=TOLD & ~Part.RESULT if len(results) == 1 and "det" in context.wanted else TOLD,
        uses=(_matrix(context),),
    )


def _alternatives(forms: ConfigurationForms, found: SingularSet) -> Step:
    cases = forms.singular
    if not cases:
        return Step(
            id="singular",
            stage=STAGE,
            title="No singular configuration",
            why=(f"The rank is {found.rank} in every configuration{_unless_a_factor(found)}.",),
            detail=Detail.BRIEF,
            hint=_CASES,
            hint_title=_TITLE,
        )
    one = "A product is 0 where one of its factors is. Constant lengths are not 0, so one case is left."
    several = (
        "A product is 0 where one of its factors is; each of these cases is enough. "
        "Constant lengths are not 0."
    )
    return Step(
        id="singular",
        stage=STAGE,
        title=_TITLE,
        why=(one if len(cases) == 1 else several,),
        result=tuple(map(vanishing, cases)),
        notes=tuple(forms.existence("singular", found.exist)),
        detail=Detail.BRIEF,
        uses=("singular_minors",),
        hint=_CASES,
    )


def _unless_a_factor(found: SingularSet) -> str:
    return ", as no factor of the minors becomes 0" if found.rank > found.pivots else ""


def _loss(context: Context, forms: ConfigurationForms, found: SingularSet, case: int) -> Step:
    """The rank at one of the alternatives, the matrix there, and what is lost."""
    loss, lost, J = found.losses[case], forms.lost[case], _letter(context)
    several = len(found.losses) > 1
    what = "What is lost" if lost else "The rank"
    general = "" if loss.rank_holds else "in general "
    where: Prose = ("Where ", vanishing(forms.singular[case]), f", the rank is {general}",
                    f"{loss.rank} instead of {found.rank}.")  # fmt: skip
    names = (
        [_W] if len(lost) == 1 else [Letter("w", Number(k), style="bold") for k in range(1, len(lost) + 1)]
    )
    generic: Prose = ()
    if not loss.are_independent:
        generic = (" In general ", *listed(names), " are independent." if len(names) > 1 else " is not 0.")
    exact = all(condition.keeps_values for condition in found.alternatives[case])
    form = forms.compactor(loss.jacobian.ring).form
    there = tree.Matrix(tuple(tuple(map(form, row)) for row in loss.jacobian.rows))
    formula = _in_general(context)
    told = lost and not any(forms.lost[:case])
    return Step(
        id=f"singular_{case + 1}",
        stage=STAGE,
        title=f"{what} in case {case + 1}" if several else f"{what} there",
        why=(*where, *(_lost_words(context) if told else ()), *generic),
        formula=formula if lost else None,
        source=_LOST if lost else "",
        working=(equation(J, there),) if lost and exact else (),
        result=tuple(equation(name, value) for name, value in zip(names, lost, strict=True)),
        figure=singular_figure_of(context.robot, _matrix(context), forms.singular[case], names, lost),
        uses=(_matrix(context), f"singular#{case + 1}"),
        hint=(
            "In each case: how great is the rank, and which w is orthogonal to every velocity that the "
            "joints can give?",
        ),
        hint_title="What is lost there",
        task=formula,
        is_task=case == 0,
    )


def _in_general(context: Context) -> Node:
    """wᵀ J = 0 ⇒ τ = Jᵀ w = 0"""
    J, zero = _letter(context), letters.bold("0")
    still = equation(letters.TAU, Row((Transpose(J), _W)), zero)
    return Relation((equation(Row((Transpose(_W), J)), zero), still), ("⇒",))


def _lost_words(context: Context) -> Prose:
    task = context.robot.questions.task
    is_force = _matrix(context) != "J" and (task is None or task.is_default)
    needs = "A force along it needs" if is_force else "A force and a moment along it need"
    return (" Every velocity that the joints can give is orthogonal to ", _W,
            f": that motion is lost. {needs} no torque of the joints.")  # fmt: skip


def _det(matrix: Node) -> Node:
    return Row((Words("det "), matrix))


def _letter(context: Context) -> Node:
    """J of the whole arm, or of the task."""
    return letters.J if _matrix(context) == "J" else letters.J_TASK


def _matrix(context: Context) -> str:
    return context.values.rules["singular"].inputs[0]
