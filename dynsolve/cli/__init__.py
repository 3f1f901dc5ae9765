"""The commands, one function each.

    solve                 derive a model
    check, grade          judge one hand-in, a course's hand-ins; change marks; the zip that makes
                          Gradescope run dynsolve
    exercise              sheets, templates of hand-ins, a variant for each student
    draw                  the robot of a problem file drawn
    library               a first draft of a file, a second look at one, its JSON Schema, the library of
                          problems, the formats of files and exit codes

`main` puts them together, and makes every error a message and an exit code.  To add a
command, write its function, name it in `main.COMMANDS`, and add its row to the README.  What
several commands share:

    numbers     reading a problem from wherever it is, showing findings; --set, --at, --digits
    output      where results go and in which form: -o, --format; a document on a terminal; progress

What costs time to import is imported inside a command, so that `--help` is quick.
"""
