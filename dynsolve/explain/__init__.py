"""Quantities -> steps: why, the formula with its source, the formula of this robot, the result.

A stage is a file of its name with a function `steps`, which yields its steps in order: `kinematics`,
`jacobian`, `inertia` (with `mass_centers`), `energy`, `lagrangian`, `torque`, `vectorized` (with
`christoffel` and `agreement`); `frames` of a drawing; `points`, `task`, `singular`, `inverse`, `rates`,
`newton_euler` (made in `recursions`), `parameters`, `equilibria`, `forward_dynamics`, `task_inertia`,
`definite`, `statics` and `constraints` where something of them is asked.  To explain a further
quantity, yield a `Step` in the file of its stage:

    yield Step(
        id="K",                          # the quantity, by its name in an answer file
        stage=STAGE,
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

Everything a step is made from is in its `Context`; `writing` has what several stages write.

    step        what a step is, and in which detail it is shown
    context     the robot, its exact values, their compact forms
    forms       the compact form of every value; how long ones are put together from parts
    placed_bodies
                bodies that are given by their positions: r_c, turns, Jacobians by differentiation
    turned_tensors
                R I Rᵀ of a body, or why the rotation keeps the tensor
    rotational_energy
                K_ω of a body, along its own axes where these make it short
    jacobian_columns
                the columns of Jacobians in letters, and with axes and levers put in
    body_parts  what each body adds to D, its products multiplied out
    given_model energies and D of a model that is given without bodies
    product_forms
                products and quotients: a determinant in its factors, fractions
    entry_formulas
                energies, momenta and forces in the entries of D and g and the Christoffel symbols
    statement   what is given and what is to be found
    hypotheses  what it rests on: joints, gravity, friction, values
    given_bodies
                what is given of each body: mass, dimensions, mass centre, moments of inertia
    given_actions, given_questions
                what is given of springs, friction and motors; of the task, the state, the constraints
    shapes      what uniform shapes and their dimensions are called
    style       how a robot's formulas look: s_1 for sin θ_1
    short_arms  which arms are worked out line by line
    widths      how wide formulas are as text
    signs       the style of a report, in which no sign stands for two things
    citations   the books and their sections that steps refer to
    writing     sentences and pieces of formulas
    configurations
                singular configurations and branches of the inverse, as formulas
    steady      what the step of equilibria says of motions at constant rates
    singular_figures
                drawings of singular configurations: the arm there, and what is lost
    inverse_formulas
                the solutions of inverse kinematics: atan2(y, x) - …, ± arccos(…)
    target, branch_values
                the configurations that reach a target in numbers
    inverse_target
                their steps
    inverse_way the lines to each of them: components turned, squared and added, sorted
    inverse_figures
                their drawings: a projection, the triangle of two lengths
    inverse_pose
                of a full pose: the point that is left in place by the wrist, the rotation that is left for it
    recursions  the Newton-Euler recursions, link by link
    actions     what acts beside gravity: springs, rotors, friction
    acting      where their steps are imported, of robots that have any
    potential   the potential energy of each body
    base_frame  H_0 in the world, the elementary motions
    given_axes  axes of a body that are given from the base: how they lie in the frame of the link
    density     a body with a density, by integration
    terms       what each term of a force is: inertial, centrifugal, Coriolis, friction, gravity
    sanity      checks that a person can do on the finished model
    matrix_factors  what all entries of a matrix share, in front of it
    closing     the step of D q̈ + C q̇ + g = τ
    working     the lines between a formula and its result, each proved before it is shown

What the signs of a report mean:

    notation_list      the list of notation: a line for every sign that occurs
    definition_units   the units of abbreviations, from the formulas that define them
    textbook_letters   the lines of the textbook's letters
    roles              what the parameters of a problem are: a mass, a length of the table
    parameter_meanings the same in words: the length of link 2, from o_1 to o_2
    sign_kinds         which signs occur in a document

Long models are written in names (`--abbreviate`):

    abbreviations        which constants and terms get names, and D, C and g in these
    base_parameters      the inertial constants that D and g are made of
    recurring            what stands in several places
    recurring_multiples  sums that are multiples of each other
    abbreviated_steps    the steps of a derivation in these names
    named_steps          which sums of a short model have names, where these are introduced; its steps in them
    inertia_names        names for its long sums of masses and lengths, from the kinetic energy on
    symbol_names         names for its Christoffel symbols
    exchanges            a sum or a product exchanged for its name
    long_model           those of a long model, which stay in d_ij, c_ijk and g_k where they can

And hints (`--hint`), made of the same steps:

    hint        what to do in a stage, without its results
    pitfalls    what goes wrong most often there
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from importlib import import_module

from dynsolve.errors import attempted
from dynsolve.explain.context import Context
from dynsolve.explain.matrix_factors import with_factors_in_front
from dynsolve.explain.step import Detail, Step
from dynsolve.notation.tree import Words, equation
from dynsolve.quantities.family import FORMED
from dynsolve.quantities.index import quantities
from dynsolve.quantities.robot_stages import stages_of
from dynsolve.quantities.stages import Stage

__all__ = ["Detail", "Step", "explain"]

_OF_BODIES = (Stage.INERTIA, Stage.ENERGY)
"""The stages whose matrices have the factors that their entries share, masses and lengths, in front."""


def explain(context: Context, stages: Iterable[str] | None = None) -> Iterator[Step]:
    """The steps of the given stages, or of all, in the order of the course."""
    wanted = set(Stage if stages is None else stages)
    for stage in stages_of(context.robot):
        if stage in wanted:
            yield from _of_stage(stage, context)


def _of_stage(stage: Stage, context: Context) -> Iterator[Step]:
    """The steps of a stage; where one fails, the bare results of those that are missing."""
    shown: list[Step] = []

    def explained() -> None:
        steps = _steps(stage)(context)
        for step in with_factors_in_front(steps, context) if stage in _OF_BODIES else steps:
            shown.append(step)  # noqa: PERF402 - what comes before a failure stays

    def bare() -> None:
        told = {name for step in shown for name in (step.id, *step.also)}
        shown.extend(step for step in bare_steps(stage, context) if step.id not in told)

    attempted(explained, bare, f"the explanation of the stage {stage}")
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


def _steps(stage: Stage) -> Callable[[Context], Iterator[Step]]:
    """The function `steps` of the stage's file, imported when it is asked for."""
    steps: Callable[[Context], Iterator[Step]] = import_module(f"{__name__}.{stage}").steps
    return steps
