"""The derivation: one file a section of the textbook, each function one formula of it.

In the order of the course (Spong, Hutchinson, Vidyasagar, Robot Modeling and Control, 2006):

    kinematics      3.2   A_i of a row of the table, H_i as their product
    jacobian        4.6   J_v and J_ω, a column a joint
    inertia         7.2   r_c's tensor: axes of the body, parallel axes, R I Rᵀ
    energy          7.2   v = J_v q̇, ω = J_ω q̇, K_v, K_ω, P
    euler_lagrange  7.1   L, ∂L/∂q̇, d/dt ∂L/∂q̇, ∂L/∂q, τ
    vectorized      7.3   D, the Christoffel symbols, C, g
    actions         energies of springs and rotors, friction (Siciliano et al., 7.1)
    task            4.6, 4.8, 4.11   points, the task r(q), J_r, J̇: where a file asks for them
    singular        4.9   where a Jacobian loses rank
    inverse         3.3   q from r(q): one unknown after the other, in known forms; the branches
    rates           4.9, 4.11   det J, q̇ and q̈ for those of the task: likewise
    constraints     A_c q̇ = 0 and its multipliers (Murray, Li, Sastry 6.1): likewise
    reduced         the equations without multipliers, by a basis of the free rates: likewise
    recursions      7.6   Newton-Euler in link frames: ω, ω̇, accelerations, f, n: likewise
    balance         conditions on the parameters for gravity to move nothing: likewise
    equilibria      where gravity and springs move nothing: likewise
    existence       for which parameters an angle makes a sum of its cosine and sine 0
    stability       how stable equilibria are, and under which conditions on the parameters
    parameter_signs the signs of polynomials in parameters, under what is assumed of these
    steady          equilibria where some coordinates move at constant rates
    linearization   the motion near an equilibrium: likewise
    forward_dynamics
                    q̈ from the forces: likewise
    task_inertia    the inertia that a force at the task meets: likewise
    regressor       7.5.3 τ = Y a, with a of minimal length: likewise
    statics         4.10  forces from outside, the torques that hold them: likewise
    definite        7.5   whether a matrix can be an inertia matrix: likewise; `smallest` takes its minors
                          to their smallest values

What hangs together how:

    graph           a `Rule` computes one quantity from others, a `Derivation` evaluates rules
    rules           the rules of the textbook; `derive(robot)` gives the `Derivation` of a robot
    kinematic_rules those of what a file asks of the kinematics
    action_rules    those of what acts beside gravity
    model_rules     those of what a file asks of the equations of motion
    static_rules    those of forces from outside
    constraint_rules those of constraints
    recursion_rules those of the recursions; by their method also of τ
    configurations  those of singular configurations and of inverse kinematics
    mechanism       bodies by their positions: Jacobians by differentiation, orientation by turns
    mechanism_rules the rules of these, and of given energies, in the place of frames and joints
    link_frame      rules that give K and D faster, by Jacobians in each link's own frame
    agreement       whether D, C q̇ and g come out the same both ways

And the independent check, which shares no formula with any of these:

    newton_euler    recursive Newton-Euler on floating-point numbers
    arm_values      the robot put in numbers, as these want it
    elimination     systems, determinants and ranks of numbers
    action_check    forces of springs, friction and dampers, by energies and powers
    verification    what is printed, evaluated at random states, against that
    drawn_motion    a table that was made from a drawing, against the drawn joint axes
    kinematic_check points, the task and Jacobians, against the motion of the arm
    reached         configurations in numbers: what they give the task, whether two are the same
    configuration_check
                    singular configurations and branches of the inverse, put in
    rate_check      determinants, rates and accelerations, against elimination on numbers
    reduced_check   equations without multipliers, at states that the constraints allow
    constraint_check constraints against the motion of the arm, the multipliers against elimination
    recursion_check the recursions in the links' frames, against those on numbers
    balance_check   these conditions put in
    equilibrium_check
                    equilibria put in, looked for, and their stability, by differences
    forward_check   q̈ put back into the equations of motion
    linear_check    linearization and the task's inertia, against elimination and differences
    model_check     Y a against τ, its length against the rank of numbers
    static_check    generalized forces and holding torques, against the power of the forces
    mechanism_check models without a table, by virtual work, or by Lagrange's equations on numbers
    definite_check  whether matrices are positive definite, by elimination on numbers
    hyper_dual      numbers that carry first and second derivatives, for that

A rule takes exact values and returns an exact value, and does nothing else: what a
person reads of it is made in `dynsolve.explain`.  To add a quantity, write its record
in `dynsolve.quantities.families`, its formula in the file of its section and its rule in
`rules`.  Values put into a `Derivation`
stand for their rules, and what depends on them follows: so an answer that follows from
an earlier slip is recognized, and a slip is the graph with one rule replaced.
"""
