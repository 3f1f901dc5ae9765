"""How verdicts become marks; `dynsolve check` and `dynsolve grade` share it.

`marks` has all of it: what a course decides on (`Policy`: shares, caps, rounding, lateness), what an
answer is worth beside its verdict, and the marks, each with the one line that explains it.

A rule of marking is a field of `marks.Policy`, applied below it.
"""
