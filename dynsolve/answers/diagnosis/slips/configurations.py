"""What is said of sets of configurations, and of verdicts on matrices, that are wrong.

`{number}` counts the branch or alternative, or is the name of the matrix.
"""

from __future__ import annotations

from dynsolve.answers.diagnosis.slips.record import Slip

_BRANCH = "Put the branch into r(q), at values for which you know a configuration."

_SLIPS = (
    Slip("atan2_order", "the order of atan2", "The arguments of atan2 are exchanged: it takes y first.",
         "atan2(y, x) is the angle of the point (x, y)."),
    Slip("quadrant_lost", "a quadrant", "Branch {number} gives the values of the task in some quadrants "
         "only.", "arctan(y/x), arcsin and arccos go half way round; atan2(y, x) looks at both signs."),
    Slip("branch_misses", "a branch", "Branch {number} does not give the values of the task.", _BRANCH),
    Slip("branch_sometimes_misses", "a branch",
         "Branch {number} gives the values of the task at some configurations only.", _BRANCH),
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
    Slip("branch_lacks_coordinate", "a branch", "Branch {number} gives no {where}.",
         "A branch is a formula for each coordinate."),
    Slip("branches_missing", "a branch",
         "Your branches are right, and some are missing: up to {where} configurations give the same values.",
         "A root, an arccos and an arcsin leave two values each."),
    Slip("configurations_missing", "a case",
         "{where}, the Jacobian loses rank, and no alternative of yours holds.",
         "Write the determinant as a product: each of its factors is a case."),
    Slip("not_singular", "a case",
         "{where}, alternative {number} holds, and the Jacobian has its full rank.",
         "Put such a configuration into the Jacobian."),
    Slip("condition_never_holds", "a case", "No configuration was found at which alternative {number} holds.",
         "Its equations must hold together."),
    Slip("is_definite", "a verdict", "{number} can be an inertia matrix.",
         "Look for the smallest value of each leading minor, under what is assumed."),
    Slip("definite_if", "a verdict", "Whether {number} is positive definite depends on its parameters.",
         "Take each leading minor at its smallest value over the coordinates."),
    Slip("refused_asymmetric", "a verdict", "{number} is not symmetric.", "Compare the entries across the "
         "diagonal."),
    Slip("refused_not_periodic", "a verdict", "In {number} an angle stands outside of sines and cosines.",
         "After a full turn the matrix must be the same."),
    Slip("refused_length_in_sine", "a verdict", "In {number} a length stands in a sine or cosine.",
         "Sines and cosines are of angles."),
    Slip("refused_degree", "a verdict", "In {number} a length stands in a higher power than the second.",
         "Moments of inertia are masses times squares of distances."),
    Slip("refused_base", "a verdict", "{number} depends on the coordinate of the base.",
         "The kinetic energy is the same wherever the first coordinate stands."),
    Slip("refused_indefinite", "a verdict", "{number} is not positive definite.",
         "Look at the determinant where a sine or cosine is 0, 1 or -1."),
    Slip("equilibria_missing", "a case",
         "{where}, there is an equilibrium, and no alternative of yours holds.",
         "Every choice of one factor of each force that is 0 is a case."),
    Slip("no_equilibrium", "a case",
         "{where}, alternative {number} holds, and the forces are not in balance.",
         "Put such a configuration into g(q), row by row."),
    Slip("not_balanced", "a condition", "Where your equations hold, gravity is not what it should be.",
         "Every coefficient of a sine, a cosine or a coordinate in g must be 0."),
    Slip("balance_never_holds", "a condition", "No values were found for which your equations hold together.",
         "Every coefficient of a sine, a cosine or a coordinate in g must be 0."),
    Slip("motion_differs", "an equation of motion",
         "There are motions that the constraints allow in which equation {number} does not hold.",
         "Combine the equations so that every multiplier drops out, with the forces of the motors."),
    Slip("motions_missing", "an equation of motion", "Every equation holds, and some are missing.",
         "With the constraints there are as many equations as coordinates."),
    Slip("condition_too_much", "a condition",
         "Gravity is balanced also where equation {number} does not hold.",
         "Look for the coefficients of g, and ask for no more than that these are 0."),
    Slip("foreign_name", "a name", "A name stands in it that has no meaning here.",
         "Write it in the coordinates and parameters of the problem."),
)  # fmt: skip

SET_SLIPS = {slip.code: slip for slip in _SLIPS}
