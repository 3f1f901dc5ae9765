"""What the derivation names: A_1, J_v2, K_v1, ∂L/∂q̇_1, τ, D, c_121, C q̇, ..., one record a family.

    stages      the stages of a solution, with their headings
    family      what a record says: owner, shape, dimension, letter, spellings, parts
    families    the records, in the order of the derivation; by files those of the course;
                those of a question are in its folder
    action_families
                what acts beside gravity: springs, rotors, friction
    owners      what a robot's quantities belong to, which families and which stages it has
    index       the quantities of one robot by name, and what is part of what
    letters     what they are set with, which the printers write in every notation; how students spell names

`families` says how a quantity is added.  One of something that robots did not have so far also
needs an owner in `family`, and `Owners` to say which ones a robot has.
"""
