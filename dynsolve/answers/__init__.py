"""What a student wrote: from a line of LaTeX to its verdict.

    reading         the file -> equations -> formula trees, one `Answer` each
    judging         the trees -> values in one ring -> compared with the key, and with what
                    the student's own earlier answers lead to
    diagnosis       what is left is wrong: which slip explains it
    marks           verdicts -> marks, by the policy of a course
    feedback        the `Report` as JSON, and as a document for a student or a teacher
    verdict         the records of all that is said, of a hand-in as it was read, and of what was not judged

`judge` ties them together: `Checker` for one problem, `Judge` for one hand-in; `limits` runs them in a child
process with limits of time and memory.  Why an answer got its verdict is decided, in this order, by

    judging.key_comparison   is every entry equal to the key's?  (`entry_comparison`:
                             exactly, with numbers for symbols, or rounded)       correct
    judging.explanation      do the student's own answers lead to it?             follows
    answer_verdict           neither                                              wrong
    diagnosis.diagnoser      why: the first explanation of its list that fits
    unwritten                a formula of names alone is what the student's own answers make of it; what is
                             asked for and not written by itself                  missing

A Denavit-Hartenberg table is judged as a whole, by the mechanism that it describes: `table_verdict`;
sets of configurations are held in numbers, and of what is said of matrices each is an entry:
`answer_verdict`.  What was not judged waits for a human, or is set aside: `verdict.Ledger`.
`public` is `dynsolve.check`.
"""
