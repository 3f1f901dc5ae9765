"""Exact expressions: the ring of polynomials in sines, cosines and symbols, and their compact form.

Arrows run one way, from the first of these files to the last:

    rationals           rational numbers
    angles              linear forms of angles, a basis of which every angle is an integer combination, and
                        what
                        formulas hold
    ring_plan           what a ring must hold for them; cosines of constant angles, roots of numbers
    generators          the variables of a ring's polynomials in order; s² + c² = 1 and the normal form
    ring                the ring with its derivatives, and its elements
    fourier             a polynomial in sines and cosines as a sum of those of multiples of angles
    factors             factors in sines and cosines, those of polynomials with roots of numbers, what is
                        positive by its form
    lowest_terms        what expressions share: fractions in lowest terms
    fraction            fractions over a ring
    ring_values         the value of a formula in a ring, its value in floating point, and making a ring
    trig_identities     which identities of sine and cosine lead from one formula to an equal one
    matrix              matrices, determinants and minors; values put for coordinates
    sampling            the values at which formulas are compared; from one ring into another
    parameter_span      combinations of unknown parameters over the fractions in known ones
    linear_systems      matrices of fractions, systems of linear equations
    spaces              what a matrix takes to zero, what it reaches
    inequality          inequalities between parameters that follow from others
    surds               sums of square roots, angles with such sines and cosines, formulas of numbers
    compact             what a textbook would print

To add a kind of generator (a variable of the polynomials), name it in `generators.Generator` and lay it
out there, find the formulas that need it in `angles` and `ring_plan`, write its relation there and its
derivative in `ring`, its value in `ring_values`.
"""
