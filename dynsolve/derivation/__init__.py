"""The derivation: one file a section of the textbook, each function one formula of it.

In the order of the course (Spong, Hutchinson, Vidyasagar, Robot Modeling and Control, 2006):

    kinematics      3.2, 4.6   A_i of a row of the table, H_i as their product; J_v and J_ω, a column a joint
    link_frame      7.2   r_c's tensor: axes of the body, parallel axes, R I Rᵀ; v = J_v q̇, ω = J_ω q̇, K_v,
                    K_ω, P; K and D faster, by Jacobians in each link's own frame
    euler_lagrange  7.1, 7.3   L, ∂L/∂q̇, d/dt ∂L/∂q̇, ∂L/∂q, τ; D, the Christoffel symbols, C, g; whether
                    these come out the same both ways
    actions         energies of springs and rotors, friction (Siciliano et al., 7.1), and their rules
    mechanism       bodies by their positions: Jacobians by differentiation, orientation by turns

What a file asks beyond it is in `dynsolve.questions`.  What hangs together how:

    graph           a `Rule` computes one quantity from others, a `Derivation` evaluates rules
    rules           the rules of the textbook; `derive(robot)` gives the `Derivation` of a robot
    model_rules     those of bodies by their positions and of given energies

What several questions solve equations with:

    singular        the common zeros of equations, by factors: where a matrix loses rank, where forces are 0
    search_ring     the ring in which coordinates are solved for
    configurations  solutions put into formulas in numbers, and zeros found by Newton's method
    reached         configurations in numbers: what they give the task, whether two are the same
    elimination     systems, determinants and ranks of numbers; the signs of polynomials in parameters
    allowed         the rank of the constraint matrix where the constraints hold
    existence       for which parameters sums of sines and cosines can be 0 together

And the independent check, which shares no formula with any of these:

    newton_euler    recursive Newton-Euler on floating-point numbers
    arm_values      the robot put in numbers, as these want it
    verification    what is printed, evaluated at random states, against that; forces of springs, friction
                    and dampers, by energies and powers
    drawn_motion    a table that was made from a drawing, against the drawn joint axes
    mechanism_check models without a table, by virtual work, or by Lagrange's equations on numbers

A rule takes exact values and returns an exact value, and does nothing else: what a
person reads of it is made in `dynsolve.explain`.  To add a quantity, write its record
in `dynsolve.quantities.families`, its formula in the file of its section and its rule in
`rules`.  Values put into a `Derivation` stand for their rules, and what depends on them follows: so an
answer that follows from an earlier slip is recognized, and a slip is the graph with one rule replaced.
"""
