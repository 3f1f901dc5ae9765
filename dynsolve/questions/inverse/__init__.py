"""Inverse kinematics: from r(q) = r to every q.

The equations of the task are not solved all at once.  From them others are made in which
fewer unknowns stand, as a textbook does: turned into the frame of a joint (Paul), squared
and added; where that leads no further, a length that stands in two of them is taken out.  Where one
holds a single unknown in a known form, that unknown is solved for, and counts as known from then on.

    equations     an equation left = right, and the ways in which others come from it
    subproblems   A cos ψ + B sin ψ + C in the unknowns: the forms that are solved, each with its solutions
    solving       how a task is solved, as data: the steps, the sets of signs that solve it, and equations
                  between the values of the task alone
    search        which unknown is solved for next, from which equations, and under which conditions a
                  branch solves a task with more components than joints move
    names         names for what becomes known: a wrist's centre, the entries of its rotation
    pose          a full pose, part by part: from points that some joints do not move, and the rotation that
                  is left
    numeric       configurations that reach numbers, by Newton's method from many starts
    forms         the solutions as formulas: θ₂ = ± arccos(…), θ₁ = atan2(y, x) - …
    existence     under which conditions an unknown has values, and when it is free
    branches      the step that counts the solutions
    figures       the triangles by which a solution is seen
    target        configurations that reach numbers, as steps

Spong, Hutchinson, Vidyasagar, section 3.3 (2006); Craig, chapter 4; Paul, Robot Manipulators (1981);
Pieper, The Kinematics of Manipulators under Computer Control (1968).
To add a form, add its class in `subproblems` and its recognition in `subproblems.recognized`.
"""

from __future__ import annotations

from dynsolve.quantities.family import Family, Kind
from dynsolve.quantities.stages import Stage

INVERSE = Family(
    name="inverse",
    called="the inverse kinematics",
    stage=Stage.INVERSE,
    kind=Kind.BRANCHES,
    spellings=("ik",),
    terms=("inverse kinematics", "ik"),
)

FAMILIES: tuple[Family, ...] = tuple(record for record in vars().values() if isinstance(record, Family))
"""The records above, in their order."""
