"""Singular configurations: where a Jacobian has less than its greatest rank.

A matrix loses rank exactly where all minors of the size of its greatest rank are 0.  Each
minor is taken apart into factors; at a singular configuration one factor of every minor is 0.

    zeros       what is left of a matrix when everything is cleared that is never 0; one equation f(q) = 0,
                and whether equations can hold together
    losses      the rank at a singular configuration, and the directions that are lost there
    sets        all minors at once: the alternatives, each a list of conditions
    inertia     where D has no inverse, by the Jacobian of all that has an inertia

Spong, Hutchinson, Vidyasagar, section 4.9 (2006).
"""
