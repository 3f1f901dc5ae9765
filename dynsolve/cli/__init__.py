"""The commands, one file each: `solve`, `draw`, `check`, `grade`, `override`, `lint`, `new` and others.

`main` puts them together, and makes every error a message and an exit code.  What
several commands share:

    common      reading a problem from wherever it is, showing findings
    numbers     the options that put numbers in: --set, --at, --digits
    output      where results go and in which form: -o, --format
    page        a document on a terminal
    progress    a bar, or a line now and then

What costs time to import is imported inside a command, so that `--help` is quick.
"""
