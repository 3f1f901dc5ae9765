"""The lines between a formula and its result, each by one operation that is named.

proved           a chain of lines, shown only where each is proved equal to its value
kinetic          from ½ m vᵀ v and ½ ωᵀ 𝓘 ω to the kinetic energy
squares          how the squares of a velocity's components become the square of the speed
identities       which identities of sine and cosine lead from one line to the next
unreduced        the value of a line before s² + c² = 1 is used
differentiation  derivatives term by term, by product and chain rule
"""
