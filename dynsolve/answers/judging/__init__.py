"""Comparing what a student wrote with the key, and with what the student's own answers lead to.

answer_ring, ring_extension   the ring that holds the key and all that was written
evaluate                      a formula tree -> its value in that ring
answer_values                 the answers of a hand-in with their values
own_coordinates               answers in the student's own coordinates, turned to the problem's
inputs                        names of generalized forces in λ and q̈: what the motors give
own_names                     what a name inside a value stands for
route, task_routes            one way to an answer; those by way of the task's Jacobian
own_constraint                A_c by its rows, its rate, and λ by A_cᵀ λ, where the constraint holds
moved_multipliers             equations of motion in which A_cᵀ λ stands
recursion_routes              the ways from the recursions to a force
differentiation_routes        the ways from a position to velocities and Jacobians
graph                         which answers lead to which, by which routes
entry_comparison              whether two scalars are equal
key_comparison                an answer compared with the key, entry by entry
other_solutions               rates that are right, though not those of least norm
equilibria                    sets of equilibria, in numbers
own_parameters                the parameters a of τ = Y a that the student has chosen
model_routes                  ways to a regressor, for the key's parameters or the student's
spans                         vectors that span a space
planar                        vectors and Jacobians of planar robots, without rows of zeros
mechanism                     whether two Denavit-Hartenberg tables describe one mechanism
zero_height                   the zero of height that the student has chosen
hand_in                       all of these for one hand-in
student_values                the student's own values, where the next two start
follow_through                the values that they lead to
content                       what a wrong answer keeps of the key, so that inventions lead nowhere
direction                     which way between τ and D, C, g, so that nothing explains itself
explanation                   which of those explains an answer
configurations                sets: singular configurations, in numbers
example_point                 a configuration in round numbers, as an example of what is said of a set
branches, target_branches     branches of the inverse; configurations that are to reach numbers
set_verdict                   what is found of a set
held_equations                equations that hold together, in numbers; angles count modulo 2π
"""
