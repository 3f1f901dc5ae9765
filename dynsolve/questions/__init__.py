"""What an exercise asks beyond the course's chain: a folder a question, complete.

    frames            the frames of a drawing
    task              points by name, a task r(q), its Jacobian and the rates of Jacobians
    singular          where the Jacobian has less than its greatest rank
    inverse           which configurations reach a point, or a pose
    rates             joint rates and accelerations for those of the task; what joints and task can do
    newton_euler      the recursions link by link
    parameters        τ = Y a
    equilibria        where nothing moves, what balances gravity, and the linearized equations
    forward_dynamics  the accelerations that given forces make
    task_inertia      the inertia that a force at the task meets
    definite          whether a matrix can be an inertia matrix
    statics           forces from outside, and the torques that hold them
    constraints       constraints, and the multipliers that keep them

A folder has the name of its stage (`quantities.stages`), and these files, of which it may lack some:

    __init__    `FAMILIES`, the records of its quantities: data alone, loaded with every robot
    keys        `KEYS`, those of the problem file: data alone, loaded with every file
    file        `read(...)`: what the file gives by them, as a `problem.state.Given`; `build(...)`: the robot
                with it; imported where a file has one of the keys
    derive      `rules(robot)`: the rules of its quantities, and their formulas
    check       `verify(held)`: the results as they are printed, held by a computation that shares no formula
                (`held`)
    explain     `steps(context)`: its chapter of the solution; `given(forms)`: what the file gives for it, in
                words; for its hint `AT_HAND`, what one has, the results `inputs(context)`, and `PITFALLS`,
                of which those are told whose `facts(robot)` hold
    export      `value(export, name)` of what is no matrix or number, `beside(export)` what the JSON says
                beside it (`export`)
    judge       `KEYS`: of each answer that is a set, the class that judges it, and its faults;
                `EQUIVALENCES`: what is right without being the key's (`judging`; sets of equations are in
                `equation_sets`, as formulas in `set_forms`)

Files that several explain with are `shared_divisor`, a name for what many entries are over, and
`independent_rows`, where a Jacobian has its rank.

`Stage.part` imports a file by its path when it is asked for: rooms below and beside these name no question,
and one that nobody asks costs nothing.  A new question is a line in `Stage` and such a folder; if it needs
something from the file, a field of `robot.questions` for it.  Keys that several questions share (points, the
task, `state`) are in `problem.kinematic_keys`, and read in `problem.questions`.
"""
