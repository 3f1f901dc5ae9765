"""What a Python user holds: a solution, its numbers, its forms as JSON, SymPy, NumPy and reports.

    solution        `load`, `solve` and the `Solution` that it gives
    dynamics        what a solution is made of: a robot's dynamics, derived by the Lagrangian or the
                    recursions, and
                    verified; what the problem's author says of results
    asked_checks    what only some exercises ask, verified; the state that reaches a target
    given_axes      whether orientations that the problem gives may stand as they are
    numbers/        values for parameters, and what holds at a state
    numeric         a result as a NumPy function, or as SymPy
    json_export     everything as JSON
    documents       a solution as a document: stages, steps, numbers
    summary         the section that closes it
    leading         which steps lead to what is asked
    depths          what a depth shows of the steps, and which equations before it a step uses
    reports         that document as text, LaTeX, PDF, HTML or Markdown, and in a notebook

`Solution` uses all of these; they take a `Dynamics`, and know nothing of `Solution`.
"""
