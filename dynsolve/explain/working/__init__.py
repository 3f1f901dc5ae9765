"""The lines between a formula and its result, each by one operation that is named.

The stages take their lines from here, a function for each kind of step:

    kinetic          from ½ m vᵀ v to the kinetic energy of translation
    rotational       from ½ ωᵀ 𝓘 ω to that of rotation, along the axes in which it is short
    column_products  from m J_vᵀ J_v to what a body adds to D
    derivatives      d/dt of a momentum, ∂L/∂q, the slopes of D, the entries of C, Ḋ

and these are made of:

    squares          how the squares of a velocity's components become the square of the speed
    differentiation  derivatives term by term, by product and chain rule; products of sums multiplied out
    identities       a chain of lines, each proved equal to its value, by which identities of sine and cosine

To explain a further operation, return an `identities.Way` from a function here, and put it into the step.
"""
