"""Points by name, a task r(q), its Jacobian, and how Jacobians change in time."""

from __future__ import annotations

from dynsolve.notation.tree import Node
from dynsolve.quantities import letters
from dynsolve.quantities.family import Family, Owner, of_point, of_robot
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Robot
from dynsolve.robot.units import LENGTH, NONE, PER_SECOND, VELOCITY

P_POINT = Family(
    name="p{p}",
    called="the position|positions {} of the point|points",
    owner=Owner.POINT,
    stage=Stage.TASK,
    shape=(3, 1),
    letter=of_point(lambda point: letters.of_point("p", point.name)),
    dimension=LENGTH,
    spellings=("r{p}", "o{p}"),
)


JV_POINT = Family(
    name="Jv{p}",
    called="the linear part|parts {} of the Jacobian|Jacobians of the point|points",
    owner=Owner.POINT,
    stage=Stage.TASK,
    shape=(3, "n"),
    letter=of_point(lambda point: letters.j_of_point("v", point.name, point.axes)),
    dimension=LENGTH,
    per=("column",),
    dimension_is_told=False,
    spellings=("J{p}",),
)


JW_POINT = Family(
    name="Jw{p}",
    called="the angular part|parts {} of the Jacobian|Jacobians of the point|points",
    owner=Owner.POINT,
    stage=Stage.TASK,
    shape=(3, "n"),
    letter=of_point(lambda point: letters.j_of_point("omega", point.name, point.axes)),
    dimension=NONE,
    dimension_is_told=False,
    spellings=("Jomega{p}",),
)


V_POINT = Family(
    name="v{p}",
    called="the velocity|velocities {} of the point|points",
    owner=Owner.POINT,
    stage=Stage.TASK,
    shape=(3, 1),
    letter=of_point(lambda point: letters.of_point("v", point.name, point.axes)),
    dimension=VELOCITY,
    spellings=("p{p}dot", "r{p}dot", "o{p}dot"),
)


JV_DOT = Family(
    name="Jv_dot",
    called="the time derivative {} of the linear part of the Jacobian",
    stage=Stage.TASK,
    shape=(3, "n"),
    letter=of_robot(letters.rate(letters.JV)),
    dimension=VELOCITY,
    per=("column",),
    dimension_is_told=False,
    spellings=("dJv",),
    part_of="J_dot",
)


JW_DOT = Family(
    name="Jw_dot",
    called="the time derivative {} of the angular part of the Jacobian",
    stage=Stage.TASK,
    shape=(3, "n"),
    letter=of_robot(letters.rate(letters.JW)),
    dimension=PER_SECOND,
    dimension_is_told=False,
    spellings=("Jomegadot", "dJw"),
    part_of="J_dot",
)


J_DOT = Family(
    name="J_dot",
    called="the time derivative {} of the Jacobian",
    stage=Stage.TASK,
    shape=(6, "n"),
    letter=of_robot(letters.rate(letters.J)),
    spellings=("dJ",),
)


R = Family(
    name="r",
    called="the task vector",
    stage=Stage.TASK,
    shape=("m", 1),
    letter=of_robot(letters.TASK),
    spellings=("p", "pe", "ptip"),
    needs="function",
    terms=("task", "task function"),
)


R_ENTRY = Family(
    name="r{i}",
    called="the component|components {} of the task",
    rule="r",
    owner=Owner.TASK,
    stage=Stage.TASK,
    letter=lambda robot, i: letters.entry("r", i),
    spellings=("{name}",),
    part_of="r",
    needs="function",
)


JR = Family(
    name="Jr",
    called="the Jacobian of the task",
    stage=Stage.TASK,
    shape=("m", "n"),
    letter=of_robot(letters.J_TASK),
    spellings=("J", "Ja"),
    terms=("task jacobian",),
)


JR_DOT = Family(
    name="Jr_dot",
    called="the time derivative {} of the Jacobian of the task",
    stage=Stage.TASK,
    shape=("m", "n"),
    letter=of_robot(letters.rate(letters.J_TASK)),
    spellings=("dJr", "Jdot", "dJ"),
)


def _determinant(robot: Robot) -> Node:
    """Of J of six joints without a task, or of that of the task."""
    from dynsolve.questions.rates.derive import whole_or_task

    if whole_or_task(robot) == "J":
        return letters.determinant(letters.J, 6, 6)
    task = robot.questions.task
    return letters.determinant(letters.J_TASK, task.rows if task else robot.n, robot.n)


DET = Family(
    name="det",
    called="the determinant",
    stage=Stage.TASK,
    letter=_determinant,
    spellings=("detJ", "detJr", "detJJT", "Delta"),
    terms=("determinant", "jacobian determinant"),
)

FAMILIES: tuple[Family, ...] = tuple(record for record in vars().values() if isinstance(record, Family))
"""The records above, in their order."""
