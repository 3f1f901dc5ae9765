"""What the derivation names: A_1, J_v2, K_v1, ∂L/∂q̇_1, τ, D, c_121, C q̇, ..., one record a family.

    stages      the stages of a solution, with their headings
    family      what a record says: owner, shape, dimension, letter, spellings, parts
    families    the records, in the order of the derivation; by files those of the course
    action_families
                those of what acts beside gravity: springs, rotors, friction
    kinematic_families
                those of what exercises ask of the kinematics: points, tasks
    constraint_families
                those of constraints
    definite_families
                what is asked of matrices
    recursion_families
                those of the Newton-Euler recursions
    model_families
                those of what exercises ask of the equations of motion
    static_families
                those of what exercises ask of forces from outside
    robot_stages
                which stages one robot has
    owners      what its quantities belong to, and which families it has
    index       the quantities of one robot by name, and what is part of what
    letters     what they are set with; the printers make every notation of it
    spelling    how students spell names

`families` says how a quantity is added.  One of something that robots did not have so far also
needs an owner in `family`, and `Owners` to say which ones a robot has.
"""
