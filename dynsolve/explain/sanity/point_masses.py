"""What is left of D where every body is a point in its mass centre."""

from __future__ import annotations

from dynsolve.algebra.matrix import Matrix
from dynsolve.explain.context import Context
from dynsolve.explain.step import Step
from dynsolve.explain.writing import is_small, spong
from dynsolve.notation.tree import BigSum, Letter, Number, Product, Symbol, Transpose, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage


def point_masses_step(context: Context) -> Step | None:
    """Σ m J_vᵀ J_v: D without the tensors; None where that is D itself, or nothing."""
    values, robot = context.values, context.robot
    parts = [values[f"Dv{body.name}"] for body in robot.bodies]
    points = sum(parts, start=Matrix.zero(robot.ring, robot.n, robot.n))
    if points.is_zero or points == values["D"]:
        return None
    shown = context.show(points)
    if not is_small(shown):
        return None
    i = Symbol("i")
    jv = letters.bold("J", Letter("v", i))
    general = BigSum(Product((Letter("m", i), Transpose(jv), jv)), i, Number(1), Number(len(robot.bodies)))
    return Step(
        id="point_masses",
        stage=Stage.VECTORIZED,
        title="Check: point masses",
        why=(
            "Without the tensors",
            " and the rotors" if robot.actions.motors else "",
            ", as if each mass were concentrated at its mass centre, ",
            letters.D,
            " is made of masses times products of distances:",
        ),
        source=spong("7.2"),
        result=(equation(letters.D_POINTS, general, shown),),
        is_task=False,
    )
