"""The step that closes a derivation: D q̈ + C q̇ + g = τ, with this robot's matrices where they fit.

Friction stands beside g, forces from outside beside τ, where there are any.
"""

from __future__ import annotations

from dynsolve.document import Prose
from dynsolve.explain.citations import spong
from dynsolve.explain.context import Context
from dynsolve.explain.step import Detail, Step
from dynsolve.explain.style import style_of
from dynsolve.explain.working.proved import MOST_JOINTS
from dynsolve.notation.tree import ZERO, Matrix, Node, Product, Sum, Symbol, column, equation
from dynsolve.notation.unicode import UnicodePrinter, width
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage

ID = "model"
"""The closing step; reports show it in their last section, with what it is made of."""


WIDEST = 84
"""The characters up to which matrices are written out in the equation; wider ones stand by themselves."""


def closing_step(context: Context) -> Step:
    """D q̈ + C q̇ + g = τ, with friction on the left and Q on the right where there are any."""
    robot = context.robot
    inertial, coriolis = Product((letters.D, letters.QDD)), Product((letters.C, letters.QD))
    rubs, loaded = "friction" in context.values.rules, bool(robot.questions.loads)
    parts = [context.matrix(name) for name in ("D", "C", *(("friction",) if rubs else ()), "g")]
    qd = column(*(Symbol(q.name, 1) for q in robot.coordinates))
    qdd = column(*(Symbol(q.name, 2) for q in robot.coordinates))
    passive = robot.actions.passive
    forces = column(*(ZERO if k in passive else letters.force(q) for k, q in enumerate(robot.coordinates)))
    result: tuple[Node, ...] = ()
    if robot.n <= MOST_JOINTS and all(_width(context, part) <= WIDEST for part in parts):
        left = Sum((Product((parts[0], qdd)), Product((parts[1], qd)), *parts[2:]))
        result = (equation(left, Sum((forces, letters.Q_FORCES)) if loaded else forces),)
    beside = (letters.FRICTION,) if rubs else ()
    right: Node = Sum((letters.TAU, letters.Q_FORCES)) if loaded else letters.TAU
    return Step(
        id=ID,
        stage=Stage.VECTORIZED,
        title="The dynamical model",
        why=_meanings(context, rubs, loaded),
        formula=equation(Sum((inertial, coriolis, *beside, letters.G)), right),
        source=spong("7.3"),
        result=result,
        detail=Detail.BRIEF,
    )


def _meanings(context: Context, rubs: bool, loaded: bool) -> Prose:
    """What the terms of the equation are."""
    why: Prose = (Product((letters.D, letters.QDD)), " are the inertial forces, ")
    why += (Product((letters.C, letters.QD)), " the Coriolis and centrifugal ones, ")
    why += (letters.FRICTION, " those of friction, ") if rubs else ()
    why += (letters.G, " those of gravity", " and springs." if context.robot.actions.springs else ".")
    why += (" ", letters.Q_FORCES, " are those from outside.") if loaded else ()
    if context.robot.actions.passive:
        from dynsolve.explain.actions import passive_prose

        why += passive_prose(context)
    return why


def _width(context: Context, matrix: Matrix) -> int:
    """How wide a matrix is in characters, two blanks between its columns."""
    printer = UnicodePrinter(style_of(context.robot))
    columns = zip(*matrix.rows, strict=True)
    return sum(max(width(printer.text(entry)) for entry in column) + 2 for column in columns)
