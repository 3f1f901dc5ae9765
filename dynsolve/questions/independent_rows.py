"""Where the rows of a Jacobian are independent: `where 𝐀_c is not 0: not where s₁ = 0 and s₂ = 0`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from dynsolve.algebra.factors import is_never_zero
from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.graph import Skipped
from dynsolve.document import Prose
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.notation.tree import Node
from dynsolve.questions.set_forms import SetForms, vanishing
from dynsolve.questions.singular.derive import where_singular

if TYPE_CHECKING:
    from dynsolve.derivation.singular.sets import SingularSet


def where_independent(context: Context, matrix: Matrix, name: Node) -> Prose:
    """Where the rows, which are independent somewhere, are so; nothing where they always are."""
    found = where_singular(matrix)
    cases = () if isinstance(found, Skipped) else found.alternatives
    if not (cases or isinstance(found, Skipped)) and _never_all_zero(found):
        return ()
    text = "where {name} is not 0" if matrix.shape[0] == 1 else "where the rows of {name} are independent"
    told, forms = say(text, name=name), SetForms(context.robot, context.values)
    for k, case in enumerate(cases):
        zeros = vanishing(tuple(map(forms.condition, case)))
        told += say(f"{', nor' if k else ': not'} where {{zeros}}", zeros=zeros)
    return told


def _never_all_zero(found: SingularSet) -> bool:
    """Whether the minors of a set without alternatives are found not to be all 0, whatever the parameters."""
    if not (found.special or found.may_be_others):
        return True
    squares = (minor * minor for minor in found.minors)
    return is_never_zero(sum(squares, start=found.minors[0].ring.zero))
