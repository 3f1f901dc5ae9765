"""Comparing what a student wrote with the key, and with what the student's own answers lead to.

answer_ring        the ring that holds the key and all that was written
evaluate           what a formula tree brings to that ring, and its value in it
answer_values      the answers of a hand-in with their values: in the problem's coordinates, with names of the
                   student's own, names of generalized forces, and the rows that planar robots leave out
graph              which answers lead to which, by which routes
entry_comparison   whether two scalars are equal, and whether vectors span the same space
key_comparison     an answer compared with the key, entry by entry
equivalences       what is right without being the key's: a table of tests and words, with the rows that
                   questions have in their folders
state_order        A and B of a linear motion in another order of the state
mechanism          whether two Denavit-Hartenberg tables describe one mechanism
hand_in            all of these for one hand-in; the zero of height, equations in which A_cᵀ λ stands
follow_through     the values that the student's own answers lead to, and which way between τ and D, C, g,
                   so that nothing explains itself
explanation        which of those explains an answer, and what a wrong one keeps of the key, so that
                   inventions lead nowhere
own_accelerations  accelerations that are written by others of the same motion
configurations     answers that are sets, each judged in the folder of its question
"""
