"""What the parameters must satisfy for gravity to move nothing, in whatever configuration.

A sum of products of what moves is 0 for every q where each of its coefficients is, and these are
combinations of a few: the entries of a in g = Y a.  Masses and the acceleration of gravity are
not 0, and no factors.

Spong, Hutchinson, Vidyasagar, section 7.5.3 (2006), for g = Y a.
"""

from __future__ import annotations

from dataclasses import replace

from dynsolve.algebra.expr import Expr
from dynsolve.algebra.matrix import Matrix
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.regressor import minimal_parameters
from dynsolve.robot.model import Robot


def never_zero(robot: Robot) -> frozenset[str]:
    """The names of the masses and of the acceleration of gravity."""
    exprs = [*(body.mass for body in robot.bodies), *robot.gravity.entries]
    generators = robot.ring.generators
    used = {i for e in exprs if e.poly for i, degree in enumerate(e.poly.degrees()) if degree > 0}
    return frozenset(generators[i].name for i in used if generators[i].kind == "symbol")


def balance(robot: Robot, gravity: Matrix) -> tuple[Expr, ...] | Skipped:
    """Expressions of parameters, all of which are 0 where g(q) is, for every q, the one that is asked for."""
    wanted = robot.questions.model.balanced
    forces = gravity if wanted is None else gravity - wanted
    held = frozenset(
        g.name
        for g in robot.ring.generators
        if any(e.poly and e.poly.degrees()[g.index] > 0 for e in robot.gravity.entries)
    )
    model = replace(robot.questions.model, known=held)
    found = minimal_parameters(replace(robot, questions=replace(robot.questions, model=model)), forces)
    if isinstance(found, Skipped):
        return found
    return tuple(_without_factors(entry, never_zero(robot)) for entry in found.entries)


def _without_factors(expr: Expr, names: frozenset[str]) -> Expr:
    """The expression over all powers of these names that all its terms share."""
    ring = expr.ring
    terms = expr.poly.to_dict()
    least = [min(column) for column in zip(*terms, strict=True)]
    shared = [
        int(e) if g.kind == "symbol" and g.name in names else 0
        for g, e in zip(ring.generators, least, strict=True)
    ]
    rest = {tuple(int(a) - b for a, b in zip(e, shared, strict=True)): f for e, f in terms.items()}
    return Expr(ring, ring.ctx.from_dict(rest))
