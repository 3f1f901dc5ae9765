"""Diagnosis: which slip explains an answer that is wrong, told to the person it happened to.

A slip is a record in `slips`: its code, its kind in a few words, a message in the second
person that says what happened, and what to look at.  `diagnoser` tries the explanations
one after the other, the simplest first, in the order of the list at its end:

    steps            this step done otherwise, from the student's own inputs
    terms            one number for the whole; one slip, or several, in single terms:
                     in `symbol_slips` (a mass, a square, a dot), in `function_slips`
                     (sine for cosine, a wrong angle, a number)
    substitution     one symbol, angle or function for another throughout
    changed_rules    an earlier step done otherwise, and all that follows from it

What they share: `wrong_entry` (the scalar that is wrong), `fourier` (an expression as terms),
`term_slips` (a slip between two terms), `term_writer` (terms in words).

To add a slip, write its record with an example in `slips`, and its recognition in the
file above that it belongs to; the tests run every example.
"""
