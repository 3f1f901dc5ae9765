"""What a lecturer hands out: the exercise on a sheet, templates of hand-ins, variants for each student.

asked       what an exercise asks for, part by part, in words, with points
sheet       the exercise without its solution, or with the key behind it, in every form
template    the hand-in with empty answers, in every format that is read
hardness    how much work a result is; which variants are equally hard
plot        how hard the variants are, as a picture
variants    a variant for each student: the draw and the folder that it is written to

What may vary is read by `problem.variation`; `grading` finds each student's problem file by its place.
"""
