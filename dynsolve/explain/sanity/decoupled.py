"""The relation between parameters that makes D diagonal: a factor of all entries beside the diagonal."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from functools import reduce
from itertools import combinations

from flint import fmpq_mpoly

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.inequality import Bound
from dynsolve.document import Prose
from dynsolve.explain.configurations import ConfigurationForms
from dynsolve.explain.context import Context
from dynsolve.explain.step import Step
from dynsolve.explain.writing import spong
from dynsolve.notation.tree import Relation, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage


def decoupled_step(context: Context) -> Step | None:
    """What makes D diagonal in every configuration; None where no relation between parameters does."""
    n, D = context.robot.n, context.values["D"]
    coupling = [D[i, j] for i, j in combinations(range(n), 2) if not D[i, j].is_zero]
    if not coupling:
        return None
    factor = _of_parameters(coupling)
    if factor is None:
        return None
    shown = ConfigurationForms(context.robot, context.values).inequality(Bound(factor))
    told: Prose = ("Where ", Relation(shown.parts, ("=",)), ", ", letters.D, " is diagonal in every ")
    told += ("configuration: no coordinate is coupled with another by its acceleration.",)
    ring = context.robot.ring
    if not any(ring.depends_on_coordinates(D[i, i]) for i in range(n)):
        told += (" ", letters.D, " is then constant, and ", equation(letters.C, letters.bold("0")), ".")
    return Step(
        id="decoupled",
        stage=Stage.VECTORIZED,
        title="What decouples the coordinates",
        why=told,
        source=spong("7.4"),
        outcome=told,
        is_task=False,
    )


def _of_parameters(values: Iterable[Expr]) -> Expr | None:
    """A sum of parameters alone, of both signs, that divides all values: it may be 0 for positive ones."""
    values = list(values)
    ring = values[0].ring
    own = [
        g.index for g in ring.generators if g.kind == "symbol" and not g.dots and g.name in ring.parameters
    ]
    parts: dict[tuple[int, ...], fmpq_mpoly] = defaultdict(lambda: ring.zero.poly)
    for number, value in enumerate(values):
        for exponents, size in value.poly.to_dict().items():
            alone = tuple(e if k in own else 0 for k, e in enumerate(exponents))
            rest = tuple(0 if k in own else e for k, e in enumerate(exponents))
            parts[(number, *rest)] += ring.ctx.from_dict({alone: size})
    common = reduce(lambda one, other: one.gcd(other), parts.values())
    _, found = common.factor()
    both = (one for one, _ in found if len({sign > 0 for sign in one.to_dict().values()}) == 2)
    factor = next(both, None)
    return None if factor is None else Expr(ring, factor)
