"""Quantities -> steps: why, the formula with its source, the formula of this robot, the result.

A stage of the course is a file of its name with a function `steps`, which yields its steps in order:
`kinematics`, `jacobian`, `inertia` (with `mass_centers`), `energy`, `torque` (with the Lagrangian),
`vectorized` (with `christoffel`); that of a question is the file `explain` of its folder in
`dynsolve.questions`.  To explain a further quantity, yield a `Step` in the file of its stage:

    yield Step(
        id="K",                          # the quantity, by its name in an answer file
        title="Total kinetic energy",
        why=("The sum over the bodies.",),             # words, and formulas between them
        formula=equation(letters.K, Sum((...))),       # the textbook's, in its letters
        source=spong("7.2"),
        working=(...,),                                # the same with this robot's entries
        result=(equation(letters.K, context.form("K")),),
    )

A step may say more of how it is shown (`step`): which of its parts a worked example has (`normal`), of
which `group` it is, what it says in a line where it is not shown itself (`outcome`), and what it tells that
a step like it has told (`said`).  `solution.depths` makes of this what a depth shows.

Everything a step is made from is in its `Context`: the robot, its exact values and their compact `forms`;
`writing` has what several stages write.  Beside the stages:

    given, placed_bodies, mass_centers, actions, matrix_factors, body_parts, terms
                         what several steps of the stages are made of
    working, sanity      the lines between a formula and its result; checks that a person can do on a model
    inequalities         what bounds parameters
    notation_list, signs, textbook_letters, parameter_meanings
                         what the signs of a report mean
    hint                 hints (`--hint`), made of the same steps: what to do, without its results

Long models are written in names (`--abbreviate`), which `Context.names` has before the first step is made;
what each result is in them, `Context.result`.  The energies and forces of a long model stay in d_ij, c_ijk
and g_k (`Context.is_in_letters`), and what is alike is said once for all:

    recurring            what stands in several places
    abbreviations        which constants and sums get names, and results in these
    short_names          of a short model, which moments of inertia and Christoffel symbols
    entry_formulas       the formulas in d_ij, c_ijk and g_k
    long_model           what is said once, and D, c_ijk, C and g of a long model; `last_frame` its last frame
    named_steps          the steps of a short model in names, and where these are introduced
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from importlib import import_module

from msgspec.structs import replace

from dynsolve.errors import attempted
from dynsolve.explain import named_steps
from dynsolve.explain.context import Context
from dynsolve.explain.step import Detail, Step
from dynsolve.notation.tree import Words, equation
from dynsolve.quantities.family import FORMED
from dynsolve.quantities.index import quantities
from dynsolve.quantities.owners import stages_of
from dynsolve.quantities.stages import Stage

__all__ = ["Detail", "Step", "explain"]

_BESIDE = {Stage.LAGRANGIAN: ("torque", "lagrangian_steps")}
"""The stages that stand in the file of another, and their functions there."""

_IN_LETTERS = {Stage.VECTORIZED: ("long_model.vectorized", "steps")}
"""The stages that have a file of their own where a long model stays in letters."""

_Told = Callable[[Iterator[Step], Stage], Iterator[Step]]


def explain(context: Context, stages: Iterable[str] | None = None) -> Iterator[Step]:
    """The steps of the given stages, or of all, in the order of the course."""
    wanted = set(Stage if stages is None else stages)
    shown = [stage for stage in stages_of(context.robot) if stage in wanted]
    if context.names is not None:
        context = named_steps.in_names(context, shown)
    told = None
    if context.is_in_letters:
        from dynsolve.explain.long_model.general import said_once

        told = said_once(context)
    for stage in shown:
        yield from _of_stage(stage, context, told)


def _of_stage(stage: Stage, context: Context, told: _Told | None) -> Iterator[Step]:
    """The steps of a stage; where one fails, the bare results of those that are missing.

    `told` says those of a long model that are alike once.  What fails in names is for whoever asked for them:
    a name that was to be introduced there is missing everywhere after it.
    """
    shown: list[Step] = []

    def explained() -> None:
        steps = _steps(stage, context)
        for step in steps if told is None else told(steps, stage):
            stays = replace(step, stage=step.stage or stage)
            shown.append(stays)  # though a later one may fail

    def bare() -> None:
        named = {name for step in shown for name in (step.id, *step.also)}
        shown.extend(step for step in bare_steps(stage, context) if step.id not in named)

    if context.names is None:
        attempted(explained, bare, f"the explanation of the stage {stage}")
    else:
        explained()
    yield from shown


def bare_steps(stage: Stage, context: Context) -> Iterator[Step]:
    """The results of a stage without a word."""
    robot = context.robot
    for name, quantity in quantities(robot).items():
        family = quantity.family
        if family.stage is not stage or family.kind not in FORMED or quantity.is_read_off or not family.json:
            continue
        if quantity.rule in context.values.rules and quantity.rule != "christoffel":  # they stand in C
            letter = quantity.letter(robot) if family.has_letter else Words(name)
            result = equation(letter, context.form(quantity.rule))
            yield Step(id=name, stage=stage, title=name, result=(result,))


def _steps(stage: Stage, context: Context) -> Iterator[Step]:
    """The steps of the stage's file, or of its question's, imported when it is asked for."""
    file, name = _BESIDE.get(stage, (stage, "steps"))
    if context.is_in_letters:
        file, name = _IN_LETTERS.get(stage, (file, name))
    chapter = stage.part("explain") or import_module(f"{__name__}.{file}")
    steps: Iterator[Step] = getattr(chapter, name)(context)
    return steps
