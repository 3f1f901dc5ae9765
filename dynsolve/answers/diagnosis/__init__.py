"""Diagnosis: which slip explains an answer that is wrong, told to the person it happened to.

A slip is a record in `slips`: its code, its kind in a few words, a message in the second
person that says what happened, and what to look at.  A diagnosis is true or silent: every slip
brings its mend (`mends`), and is told only where the mend, put into the student's own value,
gives exactly the value that the student's own nearest answers lead to; where no slip does, what
differs is said (`wrong_entry`), and no more.  What is true of that value and not of the key says so; a
slip of a step is told of an entry only where it spoils none that is right; of C an entry is spoken of
where it alone is not Christoffel's, else a row of C q̇.  `diagnoser` decides that, and tries the
explanations one after the other, the nearest first, in the order of the list at its end:

    steps            this step done otherwise, from the student's own inputs
    exchanges        one factor where another belongs (`factors` has the pairs), a sign, a number, a missing
                     term, and the words of the mend; several such slips, each in a term of its own
    substitution     one symbol, angle or function for another throughout
    own_steps        an earlier step done otherwise, and all that follows from it; one slip that explains
                     all the wrong entries of a matrix

What they share: `wrong_entry` (the scalar that is wrong, its terms in words, a number for a letter),
`mends` (what mends an answer, and an expression as terms), `own_steps` (what steps give from the student's
own answers).

To add a slip, write its record in `slips`, an example in the tests, and its recognition with
its mend in the file above that it belongs to; the tests run every example.
"""
