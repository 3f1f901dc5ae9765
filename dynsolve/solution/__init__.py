"""What a Python user holds: a solution, its numbers, its forms as JSON, SymPy, NumPy and reports.

    solution        `load`, `solve` and the `Solution` that it gives
    dynamics        what a solution is made of: a robot's dynamics, derived and verified
    method          the way to the forces: the Lagrangian, or the recursions
    asked_checks    what only some exercises ask, verified
    given_axes      whether orientations that the problem gives may stand as they are
    numbers/        values for parameters, and what holds at a state
    symbolic        a result as SymPy
    numeric         a result as a NumPy function
    json_export     everything as JSON
    reached_state   the state that reaches a target
    branch_export   branches of the inverse kinematics as JSON has them
    verdict_export  verdicts on matrices as JSON has them
    stability_export
                    the stability of equilibria as JSON has it
    table_export    the Denavit-Hartenberg table as JSON has it
    documents       a solution as a document: stages, steps, numbers
    measured_steps  ≈ before what is rounded, and units, in a model in numbers
    remarks         what the problem's author says of results, as notes
    depths          what a depth shows of the steps
    notebook        how a solution shows itself in a notebook
    summary         its closing section: the model, its matrices, the forces row by row
    reports         that document as text, LaTeX, PDF, HTML or Markdown

`Solution` uses all of these; they take a `Dynamics`, and know nothing of `Solution`.
"""
