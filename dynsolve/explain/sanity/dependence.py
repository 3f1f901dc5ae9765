"""On what D depends: a joint moves what comes after it as one body, and changes no inertia of it."""

from __future__ import annotations

from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.entry_formulas import pairs
from dynsolve.explain.step import Step
from dynsolve.explain.writing import listed, spong, turns
from dynsolve.notation.build import cost
from dynsolve.notation.tree import Letter, Relation, Row, Symbol, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage

LONGEST = 30
"""The operations up to which the last entry of D is written out."""


def dependence_step(context: Context) -> Step | None:
    """The coordinates that no entry may depend on, and the entry that is constant."""
    robot = context.robot
    if not is_carried_along(context) or robot.actions.motors:
        return None
    last = robot.coordinates[-1]
    entry = letters.entry("d", last.index, last.index)
    value = context.values["D"][last.index - 1, last.index - 1]
    form = context.show(value)
    why = (*on_carried_links(), *on_last_entry(context))
    return Step(
        id="dependence",
        stage=Stage.VECTORIZED,
        title="Check: on what the inertia matrix depends",
        why=why,
        source=spong("7.2"),
        result=(equation(entry, form),) if cost(form) <= LONGEST else (),
        outcome=why,
        is_task=False,
    )


def on_carried_links() -> Prose:
    """Which entries do not depend on which coordinates, and why."""
    j, k, i = (Symbol(name) for name in "jki")
    within = (Relation((i, other), ("≤",)) for other in (j, k))
    return (
        "Joint i moves the links from ",
        i,
        " on like one body. So no ",
        Letter("d", Row((j, k))),
        " depends on ",
        Letter("q", i),
        " where ",
        *listed(list(within)),
        ". ",
    )


def on_last_entry(context: Context) -> Prose:
    """What the last entry of the diagonal is."""
    last = context.robot.coordinates[-1]
    what = "moment of inertia about its axis" if turns(last) else "mass"
    entry = letters.entry("d", last.index, last.index)
    return (entry, f" is constant: of all that joint {last.index} moves, it is the {what}.")


def is_carried_along(context: Context) -> bool:
    """Whether no d_jk depends on q_i with i ≤ j, k: the inertia of a chain about its own joints."""
    robot, D = context.robot, context.values["D"]
    if robot.is_tree or not robot.has_table or not robot.moves_each_joint_alone:
        return False
    return all(robot.ring.diff(D[j, k], i).is_zero for j, k in pairs(robot.n) for i in range(j + 1))
