"""The lines between a formula and its result, each by one operation that is named.

The stages take their lines from here, a function for each kind of step:

    kinetic          from ½ m vᵀ v to the kinetic energy of translation
    rotational       from ½ ωᵀ 𝓘 ω to that of rotation, along the axes in which it is short
    column_products  from m J_vᵀ J_v to what a body adds to D
    products         the identities by which a product of matrices becomes what is printed
    other_axes       a velocity, or J_v, along the axes of another frame, for these two
    own_axes         ω, or J_ω, along a body's own axes, where `rotational` takes these
    sums             those by which a sum of earlier results does
    derivatives      d/dt of a momentum, ∂L/∂q, the slopes of D, the entries of C, Ḋ

and these are made of:

    proved           a chain of lines, shown only where each is proved equal to its value
    squares          how the squares of a velocity's components become the square of the speed
    differentiation  derivatives term by term, by product and chain rule
    expansion        products of sums, multiplied out
    identities       which identities of sine and cosine lead from one line to the next
    unreduced        the value of a line before s² + c² = 1 is used

To explain a further operation, return a `proved.Way` from a function here, and put it into the step.
"""
