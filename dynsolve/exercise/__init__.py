"""What a lecturer hands out: the exercise on a sheet, templates of hand-ins, variants for each student.

asked       what an exercise asks for, part by part, in words, with points
sheet       the exercise without its solution, or with the key behind it, in every form
"""
