"""The lines between a formula and its result, each by one operation that is named.

    squares          from ½ m vᵀ v to the kinetic energy of translation
    rotational       from ½ ωᵀ 𝓘 ω to that of rotation, along the axes in which it is short
    column_products  from m J_vᵀ J_v to what a body adds to D
    derivatives      d/dt of a momentum, ∂L/∂q, the slopes of D, the entries of C, Ḋ

They name their tactics, each with its words and the form that it gives; `identities.chain` proves each form
equal to the value and makes the lines; `identities` finds which ones of sine and cosine lead from one line
to the next.

To explain a further operation, give it to `chain` in a function here, and put the `Way` into the step.
"""
