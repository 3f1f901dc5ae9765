"""Singular configurations: where a Jacobian has less than its greatest rank.

A matrix loses rank exactly where all minors of the size of its greatest rank are 0.  Each
minor is taken apart into factors; at a singular configuration one factor of every minor is 0.

    core        what is left of a matrix when everything is cleared that is never 0
    zeros       whether equations can hold together, and what follows from them
    conditions  one equation f(q) = 0, and what other expressions become where it holds
    losses      the rank at a singular configuration, and the directions that are lost there
    sets        all minors at once: the alternatives, each a list of conditions

Spong, Hutchinson, Vidyasagar, section 4.9 (2006).
"""
