"""What is said of sets of configurations that are wrong; `{number}` counts the branch or alternative."""

from __future__ import annotations

from dynsolve.answers.diagnosis.slips import Slip

_BRANCH = "Put the branch into r(q), at values for which you know a configuration."

_SLIPS = (
    Slip("atan2_order", "the order of atan2", "The arguments of atan2 are exchanged: it takes y first.",
         "atan2(y, x) is the angle of the point (x, y)."),
    Slip("branch_misses", "a branch", "Branch {number} does not give the values of the task.", _BRANCH),
    Slip("branch_never_exists", "a branch", "Branch {number} gives no configuration at values that the arm "
         "reaches.", "Look at the arguments of roots, arccos and arcsin, and at what each formula needs."),
    Slip("branch_not_real", "a branch", "Branch {number} gives no real configuration for these numbers.",
         "Look at the arguments of roots, arccos and arcsin."),
    Slip("target_missed", "a branch", "Branch {number} does not reach the target.",
         "Put it into r(q), and compare with the numbers that were given."),
    Slip("out_of_reach", "a branch", "No configuration reaches these numbers, and branch {number} does not.",
         "Compare the distance of the target with the longest and the shortest that the arm can make."),
    Slip("is_reachable", "a branch", "There are configurations that reach these values.",
         "Compare the distance of the target with the longest and the shortest that the arm can make."),
    Slip("branch_lacks_coordinate", "a branch", "Branch {number} does not give every coordinate.",
         "A branch is a formula for each coordinate."),
    Slip("branches_missing", "a branch", "Every branch is right, and some are missing.",
         "A root, an arccos and an arcsin leave two values each."),
    Slip("configurations_missing", "a case", "The Jacobian also loses rank elsewhere.",
         "Write the determinant as a product: each of its factors is a case."),
    Slip("not_singular", "a case", "Where alternative {number} holds, the Jacobian has its full rank.",
         "Put such a configuration into the Jacobian."),
    Slip("condition_never_holds", "a case", "No configuration was found at which alternative {number} holds.",
         "Its equations must hold together."),
    Slip("foreign_name", "a name", "A name stands in it that has no meaning here.",
         "Write it in the coordinates and parameters of the problem."),
)  # fmt: skip

SET_SLIPS = {slip.code: slip for slip in _SLIPS}
