"""Steps of the singular configurations: what vanishes, taken apart, and each alternative."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.document import Prose
from dynsolve.explain.citations import spong
from dynsolve.explain.configurations import ConfigurationForms
from dynsolve.explain.context import Context
from dynsolve.explain.step import Detail, Step
from dynsolve.explain.writing import listed
from dynsolve.notation.tree import Letter, Node, Number, Relation, Row, Words, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage

STAGE = Stage.SINGULAR
_SOURCE = spong("4.9")


def steps(context: Context) -> Iterator[Step]:
    """The minors of the Jacobian as products, and where all of them are 0."""
    if "singular" not in context.wanted:
        return
    forms = ConfigurationForms(context.robot, context.values)
    yield _rank(context, forms)
    yield _alternatives(forms)


def _rank(context: Context, forms: ConfigurationForms) -> Step:
    found = forms.singular_set
    rows, columns = context.values[_matrix(context)].shape
    J = letters.J if _matrix(context) == "J" else letters.J_TASK
    if rows == columns == found.rank:
        why: Prose = (J, " is square: it has an inverse unless its determinant is 0.")
        results: tuple[Node, ...] = (equation(_det(J), forms.product(found.minors[0])),)
    else:
        why = (J, f" is {rows}×{columns}, and its rank is {found.rank} almost everywhere. It is less where "
               f"the determinants of all its parts of {found.rank} rows and columns are 0.")  # fmt: skip
        results = tuple(
            equation(Letter("M", Number(k)), forms.product(m)) for k, m in enumerate(found.minors, 1)
        )
    return Step(
        id="singular_minors",
        stage=STAGE,
        title="What must vanish",
        why=why,
        source=_SOURCE,
        result=results,
        listed=len(results) > 1,
        uses=(_matrix(context),),
    )


def _alternatives(forms: ConfigurationForms) -> Step:
    found = forms.singular
    if not found:
        return Step(
            id="singular",
            stage=STAGE,
            title="No singular configuration",
            why=("No factor becomes 0 for any q: the rank is the same everywhere.",),
            detail=Detail.BRIEF,
        )
    one = "A product is 0 where one of its factors is. Lengths are not 0, so one case is left."
    several = "A product is 0 where one of its factors is; each of these cases is enough. Lengths are not 0."
    return Step(
        id="singular",
        stage=STAGE,
        title="The singular configurations",
        why=(one if len(found) == 1 else several,),
        result=tuple(_together(one) for one in found),
        detail=Detail.BRIEF,
        uses=("singular_minors",),
    )


def _together(conditions: tuple[Node, ...]) -> Node:
    """Equations that hold together, in one line."""
    equations = listed([Relation((value, Number(0))) for value in conditions])
    return Row(tuple(part if isinstance(part, (Relation,)) else Words(str(part)) for part in equations))


def _det(matrix: Node) -> Node:
    return Row((Words("det "), matrix))


def _matrix(context: Context) -> str:
    return context.values.rules["singular"].inputs[0]
