"""How verdicts become marks; `dynsolve check` and `dynsolve grade` share it.

    policy      what a course decides on: shares, caps, rounding, lateness
    substance   what an answer is worth beside its verdict: which entries carry nothing in
                the key, what an answer that follows has lost, what is judged by its parts
    marks       verdicts and substance -> marks, each with the one line that explains it

A rule of marking is a field of `policy.Policy`, applied in `marks`.
"""
