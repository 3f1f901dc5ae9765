"""What is right without being the key's: tables of equivalences, each row with its test and its words.

Those of the course are here, those of a question in its folder.  The equation of a coordinate that no motor
drives, ... = 0, may be multiplied by anything.  C q̇: friction may be counted in it.  Energies: a constant
of the springs is free, as the zero of height is.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.answers.judging.answer_values import AnswerValue, as_value
from dynsolve.answers.reading.vocabulary import ENERGY_LEVELS
from dynsolve.quantities import action_families, families
from dynsolve.quantities.stages import Stage
from dynsolve.questions.judging import Case, Equivalence, Missed, right_as
from dynsolve.questions.parameters import REGRESSORS

UP_TO_CONSTANT = "right; the letter that is added is the potential energy at the zero of height"
SPRINGS_FROM_ELSEWHERE = "right; the energy of the springs is counted from elsewhere than in the key"
UP_TO_FACTOR = "right: where no motor drives, the equation may be multiplied by a factor"
WITH_FRICTION = "right with the friction in it, which is a term of its own in the key"


def _differs_by_level(case: Case) -> bool:
    """Whether an energy differs from the key by a letter alone, for the energy at the zero of height."""
    difference = case.difference()
    if difference is None or len(difference.poly.monoms()) != 1:
        return False
    used = [g for g in difference.ring.generators if difference.poly.degrees()[g.index] > 0]
    own = case.robot.parameters
    return (
        len(used) == 1
        and used[0].name in ENERGY_LEVELS
        and used[0].name not in own
        and difference.poly.total_degree() == 1
    )


def _differs_by_springs(case: Case) -> bool:
    """Whether an energy differs from the key by a constant in which every term has a stiffness.

    The constant has none of masses or gravity: these have one zero of height for all bodies.
    """
    robot, difference = case.robot, case.difference()
    stored = robot.actions.stored
    if not stored or difference is None:
        return False
    own = _parameters(act.energy for act in stored)
    own -= _parameters((*(body.mass for body in robot.bodies), *robot.gravity.entries))
    symbols = robot.ring.symbol_indices
    stiff = _parameters(act.along[1] if act.along else act.energy for act in stored)
    places = [symbols[name, 0] for name in stiff & own]
    return (
        not difference.is_zero
        and not robot.ring.depends_on_coordinates(difference)
        and _parameters([difference]) <= own | {"pi"}
        and all(any(exponents[i] for i in places) for exponents in difference.poly.monoms())
    )


def _parameters(values: Iterable[Expr]) -> set[str]:
    found: set[str] = set()
    for value in values:
        degrees, known = value.poly.degrees(), value.ring.parameters
        found |= {g.name for g in value.ring.generators if degrees[g.index] > 0 and g.name in known}
    return found


def _is_multiple(case: Case) -> bool:
    """Whether forces, which are said to be 0, are right up to a factor."""
    if not case.is_equation:
        return False
    robot, key = case.robot, case.key
    first = 0 if isinstance(key, Matrix) else case.index - 1
    wanted = key.entries if isinstance(key, Matrix) else (key,)
    for row, (right, written) in enumerate(zip(wanted, case.entries, strict=True)):
        if case.agrees(right, row):
            continue
        acceleration, given = robot.coordinates[first + row].name, written.numerator
        own, its = (robot.ring.coefficient(one, acceleration, 2) for one in (given, right))
        if own.is_zero or given * its != right * own:
            return False
    return True


def _holds_friction(case: Case) -> bool:
    """Whether a vector is C q̇ and friction together."""
    return bool(case.robot.actions.resisting) and case.is_entry_by_entry(
        (case.result("Cqd") + case.result("friction")).entries
    )


_OF_THE_COURSE = (
    right_as(UP_TO_FACTOR, _is_multiple, families.TAU, families.FORCE),
    right_as(UP_TO_CONSTANT, _differs_by_level, families.P, families.P_BODY, families.L),
    right_as(SPRINGS_FROM_ELSEWHERE, _differs_by_springs, families.P, families.L, action_families.PS),
    right_as(WITH_FRICTION, _holds_friction, "Cqd"),
)


@cache
def _of_question(stage: Stage) -> tuple[Equivalence, ...]:
    """The rows of a question, which stand in its folder."""
    return getattr(stage.part("judge"), "EQUIVALENCES", ())


def other_solution(case: Case, stages: Iterable[Stage]) -> str:
    """How an answer that is not the key's is right all the same, by the first row that holds; else empty.

    `stages` are those of the robot.
    """
    of = {case.node} if case.quantity is None else {case.node, case.quantity.family}
    rows = (*(row for stage in dict.fromkeys(stages) for row in _of_question(stage)), *_OF_THE_COURSE)
    return next((row.words for row in rows if row.of & of and row.holds(case)), "")


def missed(case: Case, stages: Iterable[Stage]) -> Missed | None:
    """The equation that an answer does not satisfy, where its question has one; `stages` as above."""
    judges = (getattr(stage.part("judge"), "MISSED", {}) for stage in dict.fromkeys(stages))
    return next((judge[case.node](case) for judge in judges if case.node in judge), None)


# Answers in which the student may choose


def as_matrix(value: AnswerValue, name: str) -> Matrix | None:
    """What was written for a regressor or its parameters; None of what is no matrix over the ring.

    Parameters may stand in a row as well as in a column.
    """
    if value.rows is None:
        return None
    rows = value.rows
    if name in REGRESSORS and len(rows) == 1:
        rows = tuple((entry,) for entry in rows[0])
    found = as_value(rows, Matrix.of(rows[0][0].ring, ()))
    return found if isinstance(found, Matrix) and (name not in REGRESSORS or found.shape[1] == 1) else None
