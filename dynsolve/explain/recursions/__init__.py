"""The Newton-Euler recursions told link by link; the stage's own file is `explain.newton_euler`.

names       the letters of a link and of a body in its frame
formulas    the terms of each recursion, in letters
parts       the lines that give the parts of a sum before it is added up
links       the step of what is known of each link
outwards    the steps of ω, ω̇ and the accelerations
inwards     the steps of the forces and the moments
general     the step that says it once for all links, of longer arms
"""
