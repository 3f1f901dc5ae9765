"""The derivation: one file a section of the textbook, each function one formula of it.

In the order of the course (Spong, Hutchinson, Vidyasagar, Robot Modeling and Control, 2006):

    kinematics      3.2, 4.6   A_i of a row of the table, H_i as their product; J_v and J_ω, a column a
                    joint
    link_frame      7.2   r_c's tensor: axes of the body, parallel axes, R I Rᵀ; v = J_v q̇, ω = J_ω q̇,
                    K_v, K_ω, P;
                    K and D faster, by Jacobians in each link's own frame
    euler_lagrange  7.1, 7.3   L, ∂L/∂q̇, d/dt ∂L/∂q̇, ∂L/∂q, τ; D, the Christoffel symbols, C, g; whether
                    these
                    come out the same both ways
    actions         energies of springs and rotors, friction (Siciliano et al., 7.1), and their rules

where a file asks for them:

    task            4.6, 4.8, 4.11   points, the task r(q), J_r, J̇, and the rules of the kinematics
    singular        4.9   where a Jacobian loses rank
    inverse         3.3   q from r(q): one unknown after the other, in known forms; the branches
    configurations  the rules of singular configurations and of inverse kinematics, put in
    rates           4.9, 4.11   det J, q̇ and q̈ for those of the task
    constraints     A_c q̇ = 0 and its multipliers (Murray, Li, Sastry 6.1)
    forward_dynamics q̈ from the forces; the equations without multipliers, by a basis of the free rates
    recursions      7.6   Newton-Euler in link frames: ω, ω̇, accelerations, f, n
    balance         conditions on the parameters for gravity to move nothing
    equilibria      where gravity and springs move nothing, and how stable that is
    linearization   the motion near an equilibrium; equilibria of steady motion; the inertia that a force at
                    the
                    task meets
    regressor       7.5.3 τ = Y a, with a of minimal length
    statics         4.10  forces from outside, the torques that hold them
    definite        7.5   whether a matrix can be an inertia matrix
    mechanism       bodies by their positions: Jacobians by differentiation, orientation by turns

What hangs together how:

    graph           a `Rule` computes one quantity from others, a `Derivation` evaluates rules
    rules           the rules of the textbook; `derive(robot)` gives the `Derivation` of a robot
    model_rules     those of what a file asks of the equations of motion; those of bodies by their positions
                    and of given energies
    recursion_rules those of the recursions; by their method also of τ

And the independent check, which shares no formula with any of these:

    newton_euler    recursive Newton-Euler on floating-point numbers
    arm_values      the robot put in numbers, as these want it
    elimination     systems, determinants and ranks of numbers; the signs of polynomials in parameters
    verification    what is printed, evaluated at random states, against that; forces of springs, friction
                    and
                    dampers, by energies and powers
    drawn_motion    a table that was made from a drawing, against the drawn joint axes
    kinematic_check points, the task and Jacobians, against the motion of the arm
    reached         configurations in numbers: what they give the task, whether two are the same
    rate_check      determinants, rates and accelerations, and holding torques, against numbers
    reduced_check   equations without multipliers, at states that the constraints allow
    equilibrium_check
                    equilibria put in, looked for, and their stability, by differences
    model_check     the recursions, Y a, its length, and definite matrices, against numbers
    mechanism_check models without a table, by virtual work, or by Lagrange's equations on numbers

A rule takes exact values and returns an exact value, and does nothing else: what a
person reads of it is made in `dynsolve.explain`.  To add a quantity, write its record
in `dynsolve.quantities.families`, its formula in the file of its section and its rule in
`rules`.  Values put into a `Derivation`
stand for their rules, and what depends on them follows: so an answer that follows from
an earlier slip is recognized, and a slip is the graph with one rule replaced.
"""
