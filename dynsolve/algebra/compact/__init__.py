"""The compact form: from the normal form of the ring to what a textbook would print.

The normal form multiplies everything out and has no s²; a person wants

    d₁₁ = m₁ l_c1² + m₂ (l₁² + l_c2² + 2 l₁ l_c2 c₂) + I₁ + I₂.

Three steps lead there; `compactor` takes them in turn, and where two orders compete
it keeps the shorter result.

1. Group the terms by their monomial in the velocities and the parameters (`terms`).
   What stands beside each monomial is a small polynomial in sines and cosines with
   rational coefficients.

2. Write each of these in its best form.  Angles about parallel axes make a group
   (`trig_forms`), and only they combine.  `trig_forms` gives the forms worth considering,
   and `trig_forms` takes the cheapest, preferring sines and cosines that other coefficients
   are written with already.  This is where c₂c₂₃ + s₂s₂₃ becomes c₃: with the basic
   angles α₁ = θ₂ and α₂ = θ₂ + θ₃ it is cos α₁ cos α₂ + sin α₁ sin α₂, and its Fourier
   form (`algebra.ring`) has the one term cos(α₂ - α₁).  An angle that
   does not move is a group by itself, and is added to another where a sum asks for that,
   sin(θ + β) (`atoms`).  `trig_forms` does the same for
   polynomials in the cosine of a constant angle (4 cos³10° - 3 cos 10° = √3/2).

3. Collect (`collect`): velocities that share a coefficient are merged, (q̇₂ + q̇₃), and a
   few products of them with other coefficients stand apart; then sines and cosines; the
   polynomials in the parameters last, common factors out, masses first, squares
   completed, (a₃ + x₃)²; beside a mass also those of sums of sines and cosines
   (`terms`), (L₂ c₂ + l_c3 c₂₃)².  What is printed as one factor is an atom
   (`atoms`; `atoms` makes those of a ring); `terms` has the arithmetic.
   `collect` finds what all entries of a matrix share.  A sum that stands in several places has one
   spelling there, in all formulas that a compactor writes (`spelling`).

What comes out is held to its polynomial, and the plain polynomial stands in its place if it is not equal to
it (`proof`).

Add a form of sines and cosines in `trig_forms.trig_forms`: the choice takes it where it
is cheaper, and nothing else needs to know.
"""
