"""The commands, one file each with one function.

    solve, draw                     derive a model; draw its robot
    check, grade, override          judge one hand-in, a course's hand-ins; change marks
    autograder                      the zip that makes Gradescope run dynsolve
    lint, new, schema, problems     problem files: a second look, a first draft, their JSON
                                    Schema, the library
    docs                            the formats of files, verdicts and exit codes

`main` puts them together, and makes every error a message and an exit code.  To add a
command, write its file, register it in `main.app`, and add its row to the README.  What
several commands share:

    common      reading a problem from wherever it is, showing findings
    numbers     the options that put numbers in: --set, --at, --digits
    output      where results go and in which form: -o, --format
    page        a document on a terminal
    progress    a bar, or a line now and then

What costs time to import is imported inside a command, so that `--help` is quick.
"""
