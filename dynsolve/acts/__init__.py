"""What acts on a manipulator beside gravity: a folder a kind, complete.

    springs     ½ k (x - rest)², or an energy that is given
    dampers     b ẋ
    friction    f_v q̇ + f_c sgn(q̇)
    motors      rotors, with their gears

A kind is a key of the problem file and a folder of that name, with these files:

    __init__    `KEY`, the key of the problem file: data alone, loaded with every file
    act         the record, a class of `robot.model` by the term of the equations that it is a part of: what
                its values are and in which units, its energy or force, exact and, by another formula, in
                numbers, and what goes wrong with it; `TERM`, that class; `build(values, given)`, the record
                of what the file gives of one, by the helpers of `problem.acting`; where that is not the list
                under its key, or is held to more than its keys say, `read(decoder, fields)`; imported where
                a file has the key
    explain     `given(forms, act)`, the sentence among what is given, and its part of the step of its term;
                imported for a solution. Of the energy P_s `why(acts)`, `term(context, act)`, None of an
                energy that is given, and if there is more to say `HINT` and `PITFALL`. Of friction
                `dissipation(context, act)`, its term of Rayleigh's function, None where there is none, and
                `beside(context, acts)`, what is said of what that does not have, with its term of the
                formula. `LETTERS` are rows of `explain.textbook_letters` for letters in these

`robot.actions.KINDS` is the list of them, and `robot.actions.part` imports a file by its path: no other room
names a kind.  A new one is a name there and such a folder.
"""
